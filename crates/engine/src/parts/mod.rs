//! Cages that are too large for one set of tables: part after part, of which only one is on the device.
//!
//! A shader sees so much of a buffer and no more, and every table of a surface is one buffer. A cage whose tables are larger is divided into parts
//! ([`osculate_cage::CagePart`]), each of which is a surface. What parts have in common is computed in each of them, by the same operations on the same
//! numbers, so pictures of parts are those of the whole cage, and no crack runs between them.

mod part;
mod picture;
mod proof;
mod size;

use osculate_cage::{Cage, CagePart, divide};
use osculate_subdiv::PlanError;

pub use part::{Part, WholeKey};
pub use proof::PartsProof;
pub(crate) use proof::Seams;

use crate::{Engine, EngineError, Surface, SurfaceDesc};
use size::Needs;

/// How to divide a cage.
#[derive(Clone, Copy, Debug, Default)]
pub struct PartsDesc {
    /// What the surfaces of the parts are like.
    pub surface: SurfaceDesc,
    /// Most faces of a part; `None` takes what fits the device.
    pub most_faces: Option<usize>,
}

/// A surface that is on the device as a whole, or in parts one at a time.
pub enum WholeOrParts<'a> {
    /// The whole fits.
    Whole(Surface),
    /// Some table of the whole would be larger than a shader can see, or all of them too large for the device's memory.
    Parts(Parts<'a>),
}

/// A cage in parts, none of which is on the device yet.
pub struct Parts<'a> {
    engine: Engine,
    cage: &'a Cage,
    desc: SurfaceDesc,
    /// The faces of each part.
    sets: Vec<Vec<u32>>,
}

impl<'a> WholeOrParts<'a> {
    /// The surface of a cage: as a whole if it fits the device and `desc` does not ask for smaller parts.
    ///
    /// # Errors
    /// If the cage cannot be planned, no face is left to draw, or the device fails; and if faces that are left unrefined
    /// ([`Refinement::WhereNeeded`](crate::Refinement::WhereNeeded)) do not fit the device as a whole.
    pub fn new(engine: &Engine, cage: &'a Cage, desc: &PartsDesc) -> Result<Self, EngineError> {
        let parts = Parts::new(engine, cage, desc)?;
        // Estimates are of cages that are refined everywhere; where faces are not, the whole may fit all the same, and nothing else would do.
        let is_indivisible = desc.surface.plan().may_leave_faces();
        if parts.count() > 1 && (desc.most_faces.is_some() || !is_indivisible) {
            return Ok(Self::Parts(parts));
        }
        match Surface::new(engine, cage, &desc.surface) {
            Ok(surface) => Ok(Self::Whole(surface)),
            Err(error) if is_of_size(&error) && is_indivisible => Err(PlanError::UnrefinedParts.into()),
            Err(error) if is_of_size(&error) && cage.face_count() > 1 => Ok(Self::Parts(parts.split(0))),
            Err(error) => Err(error),
        }
    }
}

impl<'a> Parts<'a> {
    /// Divides a cage into parts that are likely to fit the device.
    ///
    /// # Errors
    /// If no face is left to draw.
    pub fn new(engine: &Engine, cage: &'a Cage, desc: &PartsDesc) -> Result<Self, EngineError> {
        let rule = desc.surface.boundary.or(cage.boundary_rule()).unwrap_or_default();
        if !cage.drawn_faces(rule).contains(&true) {
            return Err(PlanError::NothingToDraw { faces: cage.face_count() }.into());
        }
        let count = match desc.most_faces {
            Some(most) => cage.face_count().div_ceil(most.max(1)),
            None => Needs::of(cage, desc.surface.scheme).parts(&engine.device().info().limits),
        };
        let sets = divide(cage, (0..cage.face_count() as u32).collect(), count);
        Ok(Self { engine: engine.clone(), cage, desc: desc.surface, sets })
    }

    /// Number of parts.
    pub fn count(&self) -> usize {
        self.sets.len()
    }

    /// The cage that they are parts of.
    pub fn cage(&self) -> &'a Cage {
        self.cage
    }

    /// Makes the surface of one part after the other and hands it to `visit`, which should keep nothing of it: then memory is needed for one part. A part that
    /// turns out to be too large is divided further. Parts without a face that is drawn are left out.
    ///
    /// # Errors
    /// If a part cannot be planned or even a part of one face is too large for the device, if it fails; and whatever `visit` returns.
    pub fn for_each<E: From<EngineError>>(&mut self, mut visit: impl FnMut(&Part) -> Result<(), E>) -> Result<(), E> {
        let mut number = 0;
        while number < self.count() {
            match self.make(number) {
                Ok(part) => visit(&part)?,
                Err(EngineError::Plan(PlanError::NothingToDraw { .. })) => {}
                Err(error) if is_of_size(&error) && self.sets[number].len() > 1 => {
                    self.cut_in_two(number);
                    continue;
                }
                Err(error) => return Err(error.into()),
            }
            number += 1;
        }
        Ok(())
    }

    fn make(&self, number: usize) -> Result<Part, EngineError> {
        let cut = CagePart::cut(self.cage, &self.sets[number], CagePart::RINGS);
        let start = std::time::Instant::now();
        let part = Part::new(&self.engine, cut, &self.desc)?.numbered(number, self.count());
        tracing::debug!(
            "part {} of {}: {} faces, {} patches, {} bytes, made in {:.3} s",
            number + 1,
            self.count(),
            self.sets[number].len(),
            part.surface().plan().drawn_count(),
            part.surface().bytes(),
            start.elapsed().as_secs_f64()
        );
        Ok(part)
    }

    fn cut_in_two(&mut self, number: usize) {
        let halves = divide(self.cage, std::mem::take(&mut self.sets[number]), 2);
        self.sets.splice(number..=number, halves);
    }

    fn split(mut self, number: usize) -> Self {
        self.cut_in_two(number);
        self
    }
}

/// Whether fewer faces would help.
fn is_of_size(error: &EngineError) -> bool {
    matches!(error, EngineError::TooLarge { .. } | EngineError::Plan(PlanError::TooLarge { .. }))
}
