//! The proof that a cage in parts has no cracks, between its parts either.

use std::collections::HashMap;

use osculate_cage::{BoundaryRule, Cage, CagePart, NONE};

use super::{Part, Parts, WholeKey};
use crate::check::{Bits, Proof};
use crate::{CheckReport, EngineError, Surface, Tessellation};

/// A proof to which parts are added one by one. What lies inside a part is looked at and forgotten; what parts share is kept until all of them are there.
pub struct PartsProof<'a> {
    cage: &'a Cage,
    report: CheckReport,
    seams: Seams,
    /// For each face of the cage whether it is to be drawn.
    drawn: Vec<bool>,
    /// For each face of the cage whether it is still to be drawn.
    missing: Vec<bool>,
}

impl Parts<'_> {
    /// Cuts the surface into triangles in memory, part by part, and looks for cracks. Where the surface touches itself in different parts, its report by position
    /// does not see that.
    ///
    /// # Errors
    /// As [`crate::check()`] and [`Self::for_each`].
    pub fn check(&mut self, tessellation: &Tessellation) -> Result<CheckReport, EngineError> {
        let mut proof = PartsProof::new(self.cage, self.desc.boundary);
        self.for_each(|part| proof.add(part, part.surface(), tessellation))?;
        Ok(proof.finish())
    }
}

/// What is known of the records that several parts have.
#[derive(Default)]
pub(crate) struct Seams {
    /// First position and normal seen of each vertex.
    pub(crate) shared: HashMap<WholeKey, (Bits, Bits)>,
    /// Directed triangle edges: the edge record's name and the bits of the parameters.
    pub(crate) border: HashMap<(u64, u32, u32), u32>,
    /// The same between positions.
    pub(crate) welded: HashMap<(Bits, Bits), u32>,
}

impl<'a> PartsProof<'a> {
    /// Nothing of a cage is proved yet.
    pub fn new(cage: &'a Cage, boundary: Option<BoundaryRule>) -> Self {
        let rule = boundary.or(cage.boundary_rule()).unwrap_or_default();
        let drawn = cage.drawn_faces(rule);
        Self { cage, report: CheckReport::default(), seams: Seams::default(), missing: drawn.clone(), drawn }
    }

    /// Cuts a part into triangles and looks for cracks in it and towards the parts before it. `surface` is that of the part, perhaps with maps.
    ///
    /// # Errors
    /// As [`crate::check()`].
    pub fn add(&mut self, part: &Part, surface: &Surface, tessellation: &Tessellation) -> Result<(), EngineError> {
        let mut proof = Proof::new(surface.plan());
        proof.add_surface(surface, tessellation)?;
        let boundary = self.boundary_edges(part.cage()) << surface.plan().steps();
        let found = proof.finish_part(boundary, part.names(), &mut self.seams);
        self.report += found;
        let plan = surface.plan();
        let mut faces: Vec<u32> =
            plan.drawn().flatten().map(|patch| plan.locator.base_face(plan.quads[patch as usize])).collect();
        faces.sort_unstable();
        faces.dedup();
        for face in faces {
            let missing = &mut self.missing[part.cage().faces()[face as usize] as usize];
            self.report.wrong_patches += u64::from(!std::mem::take(missing));
        }
        Ok(())
    }

    /// Edges of the cage with a drawn face on one side only, which is an own face of the part. The part is not asked: a cut is no boundary.
    fn boundary_edges(&self, part: &CagePart) -> usize {
        let topology = self.cage.topology();
        let is_drawn = |h: u32| h != NONE && self.drawn[topology.face(h) as usize];
        let own =
            (0..).zip(part.faces()).filter(|&(f, _)| part.is_own(f)).flat_map(|(_, &f)| topology.face_half_edges(f));
        own.filter(|&h| is_drawn(h) && !is_drawn(topology.twin(h))).count()
    }

    /// What was found, once all parts were added.
    pub fn finish(mut self) -> CheckReport {
        for (&(edge, a, b), &count) in &self.seams.border {
            self.report.over_shared += u64::from(count - 1);
            self.report.open += u64::from(!self.seams.border.contains_key(&(edge, b, a)));
        }
        for (&(a, b), &count) in &self.seams.welded {
            self.report.weld.over_shared += u64::from(count > 1);
            self.report.weld.open += u64::from(!self.seams.welded.contains_key(&(b, a)));
        }
        self.report.wrong_patches += self.missing.iter().filter(|&&missing| missing).count() as u64;
        self.report
    }
}
