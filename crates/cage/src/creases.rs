//! Creases from shape: tags for edges that stand out by their angle or by what the faces beside them belong to.

use std::collections::HashSet;

use glam::DVec3;
use rayon::prelude::*;

use crate::progress::{Cancelled, Watch};
use crate::{Cage, Crease, FaceSetKind, FaceVarying, NONE, ReadObserver, ReadStage, Warning};

/// Which inner edges become creases. Edges that have a tag keep it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CreaseDesc {
    /// Edges whose faces enclose more than this angle between their normals, in degrees.
    pub angle: Option<f64>,
    /// Edges between smoothing groups, and those of faces without one in a file that has some.
    pub smoothing: bool,
    /// Edges between materials.
    pub materials: bool,
    /// Edges on both sides of which texture coordinates differ.
    pub uv: bool,
    /// Sharpness of the creases; from 10 on they are infinitely sharp.
    pub sharpness: f32,
}

impl Default for CreaseDesc {
    /// No edge becomes a crease; what would is infinitely sharp.
    fn default() -> Self {
        Self { angle: None, smoothing: false, materials: false, uv: false, sharpness: 10.0 }
    }
}

impl Cage {
    /// Adds the creases that `desc` asks for, in the order of the edges, with a warning that counts them.
    pub(crate) fn add_creases(&mut self, desc: &CreaseDesc, observer: Option<&ReadObserver>) -> Result<(), Cancelled> {
        let watch = Watch::new(observer, ReadStage::Creases, self.topology().edge_count() as u64)?;
        let mut missing = Vec::new();
        let found = Standing::new(self, desc, &mut missing).edges(&watch)?;
        self.add_found(&found, desc.sharpness, &missing);
        Ok(())
    }

    fn add_found(&mut self, found: &[[u32; 2]], sharpness: f32, missing: &[&'static str]) {
        let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        let known: HashSet<[u32; 2]> = self.tags().creases.iter().map(|crease| sorted(crease.vertices)).collect();
        let new = found.iter().filter(|ends| !known.contains(&sorted(**ends)));
        let new: Vec<Crease> = new.map(|&vertices| Crease { vertices, sharpness }).collect();
        let mut warnings: Vec<Warning> = missing.iter().map(|&what| Warning::NoCreasesFrom(what)).collect();
        warnings.push(Warning::CreasesMade { made: new.len(), tagged: found.len() - new.len() });
        self.add_tags(new, warnings);
    }
}

/// What tells the edges of a cage that stand out.
struct Standing<'a> {
    cage: &'a Cage,
    /// An angle in degrees and the normals of the faces.
    angle: Option<(f64, Vec<DVec3>)>,
    /// A kind of sets and the set of each face, [`NONE`] for one that is in none.
    sets: Vec<(FaceSetKind, Vec<u32>)>,
    uv: Option<&'a FaceVarying>,
}

impl<'a> Standing<'a> {
    /// Prepares what `desc` asks for; names in `missing` what the cage does not have.
    fn new(cage: &'a Cage, desc: &CreaseDesc, missing: &mut Vec<&'static str>) -> Self {
        let normals = || (0..cage.face_count()).into_par_iter().map(|f| normal(cage, f)).collect();
        let mut sets = Vec::new();
        for (asked, kind, name) in [
            (desc.smoothing, FaceSetKind::Smoothing, "smoothing groups"),
            (desc.materials, FaceSetKind::Material, "materials"),
        ] {
            match asked.then(|| sets_of_faces(cage, kind)) {
                Some(of_faces) if of_faces.iter().all(|&set| set == NONE) => missing.push(name),
                of_faces => sets.extend(of_faces.map(|of_faces| (kind, of_faces))),
            }
        }
        if desc.uv && cage.uv().is_none() {
            missing.push("texture coordinates");
        }
        let uv = if desc.uv { cage.uv() } else { None };
        Self { cage, angle: desc.angle.map(|degrees| (degrees, normals())), sets, uv }
    }

    /// The ends of all inner edges that stand out.
    fn edges(&self, watch: &Watch) -> Result<Vec<[u32; 2]>, Cancelled> {
        let topology = self.cage.topology();
        let first = |edge: u32| topology.edge_half_edges()[edge as usize];
        let stands_out = |edge: &u32| {
            // Once it is cancelled, the rest is skipped.
            watch.at(*edge).is_ok() && topology.twin(first(*edge)) != NONE && self.stands_out(first(*edge))
        };
        let edges = (0..topology.edge_count() as u32).into_par_iter().filter(stands_out).map(first);
        let ends = edges.map(|h| [topology.origin(h), topology.target(h)]).collect();
        watch.check().map(|()| ends)
    }

    fn stands_out(&self, h: u32) -> bool {
        let topology = self.cage.topology();
        let beside = [h, topology.twin(h)].map(|h| topology.face(h) as usize);
        let is_bent = self.angle.as_ref().is_some_and(|(most, normals)| {
            let [a, b] = beside.map(|f| normals[f]);
            // The arc tangent is exact for small and for large angles, and 0 where a face has no normal.
            a.cross(b).length().atan2(a.dot(b)).to_degrees() > *most
        });
        let is_border = |(kind, sets): &(FaceSetKind, Vec<u32>)| {
            let [a, b] = beside.map(|f| sets[f]);
            // Faces without a smoothing group are flat, also beside each other.
            a != b || (*kind == FaceSetKind::Smoothing && a == NONE)
        };
        is_bent || self.sets.iter().any(is_border) || self.uv.is_some_and(|uv| self.is_seam(uv, h))
    }

    /// Whether texture coordinates differ across an edge, at one end at least.
    fn is_seam(&self, uv: &FaceVarying, h: u32) -> bool {
        let (topology, twin) = (self.cage.topology(), self.cage.topology().twin(h));
        let at = |corner: u32| uv.values[uv.indices[corner as usize] as usize];
        at(h) != at(topology.next(twin)) || at(topology.next(h)) != at(twin)
    }
}

/// For each face the first of its sets of one kind, [`NONE`] if it is in none.
fn sets_of_faces(cage: &Cage, kind: FaceSetKind) -> Vec<u32> {
    let mut sets = vec![NONE; cage.face_count()];
    // Backwards, so that the first set is what stays.
    for (index, set) in cage.face_sets().iter().enumerate().rev().filter(|(_, set)| set.kind == kind) {
        for range in &set.faces {
            sets[range.start as usize..range.end as usize].fill(index as u32);
        }
    }
    sets
}

/// The unit normal of a face by the method of Newell, zero if it has no area.
fn normal(cage: &Cage, f: usize) -> DVec3 {
    let size = cage.bounds().half_diagonal();
    let corners = cage.face(f);
    let first = cage.positions()[corners[0] as usize];
    // In units of the cage's size squares neither overflow nor vanish.
    let corner = |v: u32| (cage.positions()[v as usize] - first) / size;
    let pairs = corners.windows(2).map(|pair| corner(pair[0]).cross(corner(pair[1])));
    let sum: DVec3 = pairs.sum();
    // Scaled first, because the squares of a small normal would vanish.
    (sum / sum.abs().max_element()).normalize_or_zero()
}

#[cfg(test)]
mod tests;
