//! Triangles in scene placement before they are welded into a cage.

use glam::{DVec2, DVec3};

use super::GltfError;
use crate::face_sets::FaceSets;
use crate::weld::Welder;
use crate::{CageDesc, FaceSetKind, FaceVarying, NONE, Warning};

/// Nodes may repeat a mesh any number of times: a small file must not ask for all memory.
const MAX_CORNERS: usize = 1 << 26;

/// Which vertices at one position become one.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Weld {
    /// All of them.
    Scene,
    /// Those of the same node.
    Nodes,
}

/// Where a run of triangles comes from.
pub(super) struct Run {
    pub(super) node: String,
    pub(super) material: Option<String>,
}

#[derive(Default)]
pub(super) struct Soup {
    positions: Vec<DVec3>,
    uv: Vec<Option<DVec2>>,
    /// The node, counted by placed meshes, of each point.
    point_parts: Vec<u32>,
    parts: u32,
    triangles: Vec<[u32; 3]>,
    /// Runs and the triangle they start with.
    runs: Vec<(usize, Run)>,
    ignored: Vec<(&'static str, usize)>,
}

impl Soup {
    pub(super) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// How many placed meshes there are.
    pub(super) fn parts(&self) -> usize {
        self.parts as usize
    }

    /// What follows belongs to another node.
    pub(super) fn begin_part(&mut self) {
        self.parts += 1;
    }

    /// What follows has this origin.
    pub(super) fn begin_run(&mut self, run: Run) {
        self.runs.push((self.triangles.len(), run));
    }

    /// Refuses scenes that are too large, before work is done for them.
    pub(super) fn reserve(&mut self, triangles: usize) -> Result<(), GltfError> {
        let corners = self.triangles.len().saturating_add(triangles).saturating_mul(3);
        if corners > MAX_CORNERS { Err(GltfError::TooMany(MAX_CORNERS)) } else { Ok(()) }
    }

    pub(super) fn push_point(&mut self, position: DVec3, uv: Option<DVec2>) -> u32 {
        self.positions.push(position);
        self.uv.push(uv);
        self.point_parts.push(self.parts);
        self.positions.len() as u32 - 1
    }

    pub(super) fn push_triangle(&mut self, points: [u32; 3]) {
        self.triangles.push(points);
    }

    /// Counts something that is not read.
    pub(super) fn ignore(&mut self, what: &'static str) {
        match self.ignored.iter_mut().find(|(known, _)| *known == what) {
            Some((_, count)) => *count += 1,
            None => self.ignored.push((what, 1)),
        }
    }

    /// Welds the points and drops the triangles that thereby lose a corner, as exporters make them at poles and between strips.
    pub(super) fn assemble(&self, weld: Weld) -> CageDesc {
        let (positions, vertices) = self.weld_points(weld);
        let is_whole = |&[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|point| vertices[point as usize]);
            a != b && b != c && c != a
        };
        let whole: Vec<bool> = self.triangles.iter().map(is_whole).collect();
        let corners: Vec<u32> =
            self.triangles.iter().zip(&whole).filter(|&(_, &whole)| whole).flat_map(|(t, _)| *t).collect();
        let face_offsets: Vec<u32> = (0..=corners.len() as u32).step_by(3).collect();

        let mut warnings: Vec<Warning> =
            self.ignored.iter().map(|&(what, count)| Warning::NotRead { what, count }).collect();
        let dropped = whole.iter().filter(|&&whole| !whole).count();
        if dropped > 0 {
            warnings.push(Warning::DegenerateTriangles(dropped));
        }
        CageDesc {
            positions,
            uv: self.corner_uv(&corners, &face_offsets, &mut warnings),
            face_vertices: corners.iter().map(|&point| vertices[point as usize]).collect(),
            face_offsets,
            face_sets: self.face_sets(&whole).finish((corners.len() / 3) as u32),
            warnings,
            ..CageDesc::default()
        }
    }

    fn weld_points(&self, weld: Weld) -> (Vec<DVec3>, Vec<u32>) {
        let mut welder = Welder::default();
        let mut positions = Vec::new();
        let vertex = |(p, &part): (&DVec3, &u32)| {
            let part = if weld == Weld::Nodes { part } else { 0 };
            let (vertex, new) = welder.weld(p.to_array(), part);
            if new {
                positions.push(*p);
            }
            vertex
        };
        let vertices = self.positions.iter().zip(&self.point_parts).map(vertex).collect();
        (positions, vertices)
    }

    fn corner_uv(&self, corners: &[u32], face_offsets: &[u32], warnings: &mut Vec<Warning>) -> Option<FaceVarying> {
        let mut welder = Welder::default();
        let mut uv = FaceVarying::default();
        let index = |point: &u32| {
            let Some(value) = self.uv[*point as usize] else { return NONE };
            let (index, new) = welder.weld(value.to_array(), 0);
            if new {
                uv.values.push(value);
            }
            index
        };
        uv.indices = corners.iter().map(index).collect();
        uv.finish(face_offsets, warnings)
    }

    fn face_sets(&self, whole: &[bool]) -> FaceSets {
        let mut sets = FaceSets::default();
        let (mut face, mut counted) = (0, 0);
        for (start, run) in &self.runs {
            face += whole[counted..*start].iter().filter(|&&whole| whole).count() as u32;
            counted = *start;
            sets.switch(FaceSetKind::Object, std::iter::once(run.node.clone()), face);
            sets.switch(FaceSetKind::Material, run.material.iter().cloned(), face);
        }
        sets
    }
}
