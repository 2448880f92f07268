//! The control cage.

mod parts;

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

pub use parts::sub_faces;

use crate::progress::Watch;
use crate::{
    Appearance, BoundaryRule, Bounds, CageError, Crease, Listed, NONE, PolygonReport, ReadObserver, ReadStage, Rig,
    Tags, Topology, Warning, topology,
};

/// Data that belongs to the corners of faces rather than to vertices, so that it may jump at a seam.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceVarying {
    /// The distinct values, as in the file: v runs upwards in OBJ files and downwards in glTF files.
    pub values: Vec<DVec2>,
    /// The value of each face corner. Corners with the same index are joined.
    pub indices: Vec<u32>,
}

impl FaceVarying {
    /// Ends the reading of a file, in which corners without a value have the index [`NONE`]: they all get (0, 0), with a warning.
    /// No values at all are no data.
    pub(crate) fn finish(mut self, face_offsets: &[u32], warnings: &mut Vec<Warning>) -> Option<Self> {
        if self.indices.iter().all(|&i| i == NONE) {
            return None;
        }
        let lacks = |pair: &&[u32]| self.indices[pair[0] as usize..pair[1] as usize].contains(&NONE);
        let lacking = face_offsets.windows(2).filter(lacks).count();
        if lacking > 0 {
            warnings.push(Warning::MissingUv(lacking));
            let made = self.values.len() as u32;
            self.values.push(DVec2::ZERO);
            self.indices.iter_mut().filter(|i| **i == NONE).for_each(|i| *i = made);
        }
        Some(self)
    }
}

/// What a set of faces stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FaceSetKind {
    /// An object (`o`) or the node of a scene.
    Object,
    /// A group (`g`).
    Group,
    /// A material (`usemtl`).
    Material,
    /// A smoothing group (`s`): faces whose common edges are meant to look smooth.
    Smoothing,
}

impl FaceSetKind {
    /// All kinds, in rising order.
    pub const ALL: [Self; 4] = [Self::Object, Self::Group, Self::Material, Self::Smoothing];
}

/// A named set of faces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FaceSet {
    /// What the set stands for.
    pub kind: FaceSetKind,
    /// Its name.
    pub name: String,
    /// The faces, as ranges that rise and do not touch: a set costs memory for what was said, not for the faces it holds.
    pub faces: Vec<Range<u32>>,
}

/// What a cage is made from; see [`Cage::new`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CageDesc {
    /// Positions of the vertices, in the units of the file.
    pub positions: Vec<DVec3>,
    /// First corner of each face, and the number of corners at the end.
    pub face_offsets: Vec<u32>,
    /// The vertex of each face corner, counter-clockwise seen from outside.
    pub face_vertices: Vec<u32>,
    /// Texture coordinates.
    pub uv: Option<FaceVarying>,
    /// Subdivision tags.
    pub tags: Tags,
    /// Groups, objects and materials.
    pub face_sets: Vec<FaceSet>,
    /// Materials, textures and further texture coordinates.
    pub appearance: Option<Appearance>,
    /// What moves the vertices.
    pub rig: Option<Rig>,
    /// What became of the triangles of a file that has nothing else.
    pub polygons: Option<PolygonReport>,
    /// For each vertex its index in the file, if it has another one here; empty if not.
    pub source_vertices: Vec<u32>,
    /// For each face its index in the file, if it has another one here; empty if not.
    pub source_faces: Vec<u32>,
    /// What the reader has to say about the file; [`Cage::new`] adds its own.
    pub warnings: Vec<Warning>,
}

impl CageDesc {
    /// The index of vertex `v` in the file.
    pub(crate) fn source_vertex(&self, v: u32) -> u32 {
        self.source_vertices.get(v as usize).copied().unwrap_or(v)
    }

    /// The index of face `f` in the file.
    pub(crate) fn source_face(&self, f: u32) -> u32 {
        self.source_faces.get(f as usize).copied().unwrap_or(f)
    }
}

/// A control cage: an oriented manifold mesh of polygons, valid by construction.
///
/// Every edge has one face or two that run it in opposite directions, the faces at every vertex form one fan, no face repeats a
/// vertex, every vertex has a face, and all coordinates are finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Cage {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) source_vertices: Vec<u32>,
    pub(crate) source_faces: Vec<u32>,
    pub(crate) topology: Topology,
    pub(crate) uv: Option<FaceVarying>,
    pub(crate) tags: Tags,
    pub(crate) face_sets: Vec<FaceSet>,
    pub(crate) appearance: Option<Appearance>,
    pub(crate) rig: Option<Box<Rig>>,
    pub(crate) polygons: Option<PolygonReport>,
    pub(crate) warnings: Vec<Warning>,
    pub(crate) bounds: Bounds,
}

impl Cage {
    /// The largest diagonal of a cage's box: squared lengths still fit 32-bit floats, in which it is drawn.
    pub const MAX_SIZE: f64 = 1e18;

    /// Checks a description and builds its topology. Vertices that no face uses are dropped with a warning.
    ///
    /// # Errors
    /// Whatever keeps the description from being a manifold mesh with finite coordinates and tags that fit; the error names the elements.
    pub fn new(desc: CageDesc) -> Result<Self, CageError> {
        Self::observed(desc, None)
    }

    /// [`Cage::new`] under the eyes of an observer.
    pub(crate) fn observed(desc: CageDesc, observer: Option<&ReadObserver>) -> Result<Self, CageError> {
        let CageDesc {
            positions,
            mut face_offsets,
            face_vertices,
            uv,
            mut tags,
            face_sets,
            appearance,
            mut rig,
            polygons,
            source_vertices: origins,
            source_faces,
            mut warnings,
        } = desc;
        if face_offsets.is_empty() {
            face_offsets.push(0);
        }
        check_finite(&positions)?;
        let steps = face_vertices.len() as u64 * topology::STEPS;
        let watch = Watch::new(observer, ReadStage::Topology, steps)?;
        let mut topology = topology::build(positions.len(), face_offsets, face_vertices, &watch)?;
        if topology.face_count() == 0 {
            return Err(CageError::NoFaces);
        }
        tags.check(&topology)?;
        if let Some(uv) = &uv {
            check_uv(uv, topology.half_edge_count())?;
        }
        check_face_sets(&face_sets, topology.face_count())?;
        if let Some(appearance) = &appearance {
            appearance.check(topology.face_count(), topology.half_edge_count()).map_err(CageError::Appearance)?;
        }
        if let Some(rig) = &rig {
            rig.check(positions.len()).map_err(CageError::Rig)?;
        }

        check_sources("vertex", &origins, positions.len())?;
        check_sources("face", &source_faces, topology.face_count())?;

        let (positions, mut source_vertices) = drop_unused_vertices(positions, &mut topology, &mut tags, &mut warnings);
        if let Some(rig) = rig.as_mut().filter(|rig| rig.bind_positions.len() > positions.len()) {
            rig.gather_vertices(&source_vertices);
        }
        if !origins.is_empty() {
            source_vertices.iter_mut().for_each(|v| *v = origins[*v as usize]);
        }
        let bounds = Bounds::of(&positions);
        // Halves, because the difference of two finite numbers may overflow.
        let size = bounds.half_diagonal() * 2.0;
        if size > Self::MAX_SIZE {
            return Err(CageError::TooLarge { size });
        }
        warn_of_tags(&tags, &mut warnings);
        let rig = rig.map(Box::new);
        Ok(Self {
            positions,
            source_vertices,
            source_faces,
            topology,
            uv,
            tags,
            face_sets,
            appearance,
            rig,
            polygons,
            warnings,
            bounds,
        })
    }

    /// Positions of the vertices, in the units of the file.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of faces, holes included.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.topology.face_count()
    }

    /// The vertices of face `f`, counter-clockwise.
    #[must_use]
    pub fn face(&self, f: usize) -> &[u32] {
        let offsets = self.face_offsets();
        &self.face_vertices()[offsets[f] as usize..offsets[f + 1] as usize]
    }

    /// First corner of each face, and the number of corners at the end.
    #[must_use]
    pub fn face_offsets(&self) -> &[u32] {
        self.topology.face_offsets()
    }

    /// The vertex of each face corner.
    #[must_use]
    pub fn face_vertices(&self) -> &[u32] {
        self.topology.origins()
    }

    /// For each vertex its index in the file, where unused vertices count too; rising, unless a repair split vertices.
    #[must_use]
    pub fn source_vertices(&self) -> &[u32] {
        &self.source_vertices
    }

    /// The index of face `f` in the file: `f` itself, unless a repair dropped faces.
    #[must_use]
    pub fn source_face(&self, f: u32) -> u32 {
        self.source_faces.get(f as usize).copied().unwrap_or(f)
    }

    /// The face with index `source` in the file, if it is there; the inverse of [`Cage::source_face`].
    #[must_use]
    pub fn face_of_source(&self, source: u32) -> Option<u32> {
        if self.source_faces.is_empty() {
            return ((source as usize) < self.face_count()).then_some(source);
        }
        self.source_faces.binary_search(&source).ok().map(|f| f as u32)
    }

    /// The adjacency of the faces.
    #[must_use]
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The subdivision tags.
    #[must_use]
    pub fn tags(&self) -> &Tags {
        &self.tags
    }

    /// The boundary rule that the file names, if any.
    #[must_use]
    pub fn boundary_rule(&self) -> Option<BoundaryRule> {
        self.tags.boundary
    }

    /// Texture coordinates, if the file has any.
    #[must_use]
    pub fn uv(&self) -> Option<&FaceVarying> {
        self.uv.as_ref()
    }

    /// Objects, groups and materials.
    #[must_use]
    pub fn face_sets(&self) -> &[FaceSet] {
        &self.face_sets
    }

    /// Materials, textures and further texture coordinates, if the file has any.
    #[must_use]
    pub fn appearance(&self) -> Option<&Appearance> {
        self.appearance.as_ref()
    }

    /// What moves the vertices, if anything does: [`Cage::positions`] are its pose at rest.
    #[must_use]
    pub fn rig(&self) -> Option<&Rig> {
        self.rig.as_deref()
    }

    /// What became of the triangles of a file that has nothing else, where polygons were looked for.
    #[must_use]
    pub fn polygon_report(&self) -> Option<&PolygonReport> {
        self.polygons.as_ref()
    }

    /// What was ignored, dropped or made up on the way.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The box of the positions.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Adds creases to edges that exist, and what is to be said about them.
    pub(crate) fn add_tags(&mut self, creases: Vec<Crease>, warnings: Vec<Warning>) {
        self.tags.creases.extend(creases);
        self.warnings.retain(|warning| !matches!(warning, Warning::TagsNotEvaluated(_)));
        self.warnings.extend(warnings);
        warn_of_tags(&self.tags, &mut self.warnings);
    }

    /// True if every face has four corners.
    #[must_use]
    pub fn is_quads(&self) -> bool {
        self.face_offsets().windows(2).all(|pair| pair[1] - pair[0] == 4)
    }
}

fn warn_of_tags(tags: &Tags, warnings: &mut Vec<Warning>) {
    let ignored = tags.not_evaluated();
    if !ignored.is_empty() {
        warnings.push(Warning::TagsNotEvaluated(ignored));
    }
}

fn check_finite(positions: &[DVec3]) -> Result<(), CageError> {
    let bad: Listed<u32> = (0..).zip(positions).filter(|(_, p)| !p.is_finite()).map(|(v, _)| v).collect();
    if bad.is_empty() { Ok(()) } else { Err(CageError::NotFinite(bad)) }
}

pub(crate) fn check_uv(uv: &FaceVarying, corners: usize) -> Result<(), CageError> {
    if uv.indices.len() != corners {
        return Err(CageError::UvCount { indices: uv.indices.len(), corners });
    }
    let values = uv.values.len();
    if uv.indices.par_iter().any(|&i| i as usize >= values) {
        let corners =
            (0..).zip(&uv.indices).filter(|&(_, &i)| i as usize >= values).map(|(corner, _)| corner).collect();
        return Err(CageError::MissingUv { corners, values });
    }
    let bad: Listed<u32> = (0..).zip(&uv.values).filter(|(_, p)| !p.is_finite()).map(|(i, _)| i).collect();
    if bad.is_empty() { Ok(()) } else { Err(CageError::UvNotFinite(bad)) }
}

fn check_sources(noun: &'static str, sources: &[u32], count: usize) -> Result<(), CageError> {
    // Vertices may have copies, faces do not.
    let rises = noun == "vertex" || sources.is_sorted_by(|a, b| a < b);
    if sources.is_empty() || (sources.len() == count && rises) {
        return Ok(());
    }
    Err(CageError::Sources { noun, sources: sources.len(), count })
}

fn check_face_sets(sets: &[FaceSet], faces: usize) -> Result<(), CageError> {
    for set in sets {
        let mut free = 0;
        for range in &set.faces {
            if range.start < free || range.end <= range.start || range.end as usize > faces {
                return Err(CageError::FaceSet { name: set.name.clone(), range: range.clone(), faces });
            }
            free = range.end + 1;
        }
    }
    Ok(())
}

/// Drops what no face uses from positions, topology and tags; returns the positions and, for each, the index it had.
fn drop_unused_vertices(
    positions: Vec<DVec3>,
    topology: &mut Topology,
    tags: &mut Tags,
    warnings: &mut Vec<Warning>,
) -> (Vec<DVec3>, Vec<u32>) {
    let unused: Listed<u32> =
        (0..).zip(topology.vertex_half_edges()).filter(|&(_, &h)| h == NONE).map(|(v, _)| v).collect();
    let kept = topology.drop_unused_vertices();
    if unused.is_empty() {
        return (positions, kept);
    }
    let corners = tags.corners.len();
    tags.renumber_vertices(&kept);
    warnings.push(Warning::UnusedVertices { vertices: unused, corners: corners - tags.corners.len() });
    (kept.iter().map(|&v| positions[v as usize]).collect(), kept)
}

#[cfg(test)]
mod tests;
