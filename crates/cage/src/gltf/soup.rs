//! Triangles in scene placement before they are welded into a cage.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Vec3};

use super::GltfError;
use super::motion::{Influences, Morphs};
use super::polygons::{self, Faces, Points, PolygonRecovery};
use crate::face_sets::FaceSets;
use crate::progress::{Cancelled, Watch};
use crate::weld::{NearWelder, Welder};
use crate::{CageDesc, FaceSetKind, FaceVarying, MorphSet, MorphTarget, NONE, UvSet, Warning};

/// Nodes may repeat a mesh any number of times: a small file must not ask for all memory.
const MAX_CORNERS: usize = 1 << 26;
/// Sets of texture coordinates that are read.
pub(super) const MAX_UV_SETS: u32 = 8;

/// Which vertices at one position become one.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Weld {
    /// All of them.
    Scene,
    /// Those of the same node.
    Nodes,
}

/// How a soup becomes a cage.
#[derive(Clone, Copy)]
pub(super) struct Assembly {
    pub(super) weld: Weld,
    /// Points at most this far apart become one.
    pub(super) tolerance: f64,
    pub(super) recovery: PolygonRecovery,
}

/// A vertex of a primitive.
pub(super) struct Point {
    /// Where it is at rest.
    pub(super) position: DVec3,
    /// Where it is before anything moves it.
    pub(super) bind: DVec3,
    pub(super) uv: [Option<DVec2>; MAX_UV_SETS as usize],
    /// What moves it, in a scene in which something moves.
    pub(super) influences: Option<Influences>,
    /// True if that is a skin, not a node.
    pub(super) skinned: bool,
}

/// Where a run of triangles comes from.
pub(super) struct Run {
    pub(super) node: String,
    pub(super) material_name: Option<String>,
    pub(super) material: Option<usize>,
    /// True if the transform of the node turns triangles inside out.
    pub(super) flipped: bool,
    /// True if the polygons among the triangles are marked.
    pub(super) marked: bool,
}

#[derive(Default)]
pub(super) struct Soup {
    positions: Vec<DVec3>,
    pub(super) bind: Vec<DVec3>,
    /// Sets of texture coordinates, each as long as the last point that has some.
    uv: Vec<Vec<Option<DVec2>>>,
    /// What moves each point; empty in a scene in which nothing moves.
    pub(super) influences: Vec<Influences>,
    skinned: Vec<bool>,
    /// The placed mesh of each point, from 0.
    point_parts: Vec<u32>,
    parts: Vec<Part>,
    triangles: Vec<[u32; 3]>,
    /// Runs and the triangle they start with.
    runs: Vec<(usize, Run)>,
    ignored: Vec<(&'static str, usize)>,
}

/// A mesh in its place.
struct Part {
    /// The node whose animation moves points that have no skin.
    mover: Option<u32>,
    morphs: Option<Morphs>,
}

/// A soup as a cage, and where its parts come from.
pub(super) struct Assembled {
    pub(super) desc: CageDesc,
    /// For each vertex a point that was welded into it.
    pub(super) points: Vec<u32>,
    /// For each face the material of the file, [`NONE`] for none.
    pub(super) materials: Vec<u32>,
    /// Sets of texture coordinates beyond the first.
    pub(super) more_uv: Vec<UvSet>,
    /// True if polygons were made that are not triangles.
    pub(super) has_polygons: bool,
}

impl Soup {
    pub(super) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// How many placed meshes there are.
    pub(super) fn parts(&self) -> usize {
        self.parts.len()
    }

    pub(super) fn point_count(&self) -> u32 {
        self.positions.len() as u32
    }

    /// What follows belongs to another node.
    pub(super) fn begin_part(&mut self, mover: Option<u32>) {
        self.parts.push(Part { mover, morphs: None });
    }

    /// Ends the part that was begun last, with the morph targets of its points.
    pub(super) fn end_part(&mut self, morphs: Option<Morphs>) {
        if let Some(part) = self.parts.last_mut() {
            part.morphs = morphs;
        }
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

    pub(super) fn push_point(&mut self, point: &Point) -> u32 {
        let index = self.point_count();
        for (set, uv) in point.uv.iter().enumerate().filter(|(_, uv)| uv.is_some()) {
            self.uv.resize_with(self.uv.len().max(set + 1), Vec::new);
            self.uv[set].resize(index as usize, None);
            self.uv[set].push(*uv);
        }
        self.positions.push(point.position);
        self.point_parts.push(self.parts.len() as u32 - 1);
        if let Some(influences) = point.influences {
            self.bind.push(point.bind);
            self.influences.push(influences);
            self.skinned.push(point.skinned);
        }
        index
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

    /// The materials of the file that triangles have, with repetitions.
    pub(super) fn materials(&self) -> Vec<usize> {
        self.runs.iter().filter_map(|(_, run)| run.material).collect()
    }

    /// The morph targets of a cage whose vertices were made from these points.
    pub(super) fn morph_sets(&self, points: &[u32]) -> Vec<MorphSet> {
        let empty = |name: &String| MorphTarget { name: name.clone(), ..MorphTarget::default() };
        let set = |morphs: &Morphs| MorphSet {
            node: morphs.node,
            targets: morphs.names.iter().map(empty).collect(),
            weights: morphs.weights.clone(),
        };
        let mut sets: Vec<Option<MorphSet>> = self.parts.iter().map(|part| part.morphs.as_ref().map(set)).collect();
        for (vertex, &point) in (0..).zip(points) {
            let part = self.point_parts[point as usize] as usize;
            let (Some(set), Some(morphs)) = (&mut sets[part], &self.parts[part].morphs) else { continue };
            for (target, &offset) in set.targets.iter_mut().zip(morphs.of(point)).filter(|(_, o)| **o != Vec3::ZERO) {
                target.vertices.push(vertex);
                target.offsets.push(offset);
            }
        }
        sets.into_iter().flatten().collect()
    }

    /// How many elements [`Soup::assemble`] looks at, about.
    pub(super) fn steps(&self) -> u64 {
        (self.positions.len() + polygons::STEPS * self.triangles.len()) as u64
    }

    /// Welds the points, makes polygons of triangles, and drops those without area, as exporters make them at poles and between strips.
    pub(super) fn assemble(&self, assembly: Assembly, watch: &Watch) -> Result<Assembled, Cancelled> {
        let Welded { positions, vertices, points, apart } = self.weld_points(assembly, watch)?;
        let uv: &[_] = self.uv.first().map_or(&[], |uv| uv);
        let seen = Points { vertices: &vertices, positions: &positions, uv };
        let mut faces = Faces::new();
        let (mut sets, mut materials) = (FaceSets::default(), Vec::new());
        for (i, (start, run)) in self.runs.iter().enumerate() {
            let end = self.runs.get(i + 1).map_or(self.triangles.len(), |(next, _)| *next);
            sets.switch(FaceSetKind::Object, std::iter::once(run.node.clone()), faces.count());
            sets.switch(FaceSetKind::Material, run.material_name.iter().cloned(), faces.count());
            let triangles = &self.triangles[*start..end];
            let run_of = polygons::Run { triangles, marked: run.marked, flipped: run.flipped };
            polygons::recover(&run_of, &seen, assembly.recovery, watch, &mut faces)?;
            materials.resize(faces.count() as usize, run.material.map_or(NONE, |m| m as u32));
        }

        let mut warnings: Vec<Warning> =
            self.ignored.iter().map(|&(what, count)| Warning::NotRead { what, count }).collect();
        if faces.dropped > 0 {
            warnings.push(Warning::DegenerateTriangles(faces.dropped));
        }
        if apart > 0 {
            warnings.push(Warning::MoveApart(apart));
        }
        let has_polygons = faces.offsets.windows(2).any(|row| row[1] - row[0] > 3);
        if assembly.recovery != PolygonRecovery::NONE && !faces.report.is_certain() {
            warnings.push(Warning::Polygons(faces.report.clone()));
        }
        let further = |set: usize| Some(UvSet { set: set as u32, uv: self.corner_uv(set, &faces, &mut Vec::new())? });
        let more_uv = (1..self.uv.len()).filter_map(further).collect();
        let first_uv = self.corner_uv(0, &faces, &mut warnings);
        let desc = CageDesc {
            positions,
            uv: first_uv,
            face_vertices: faces.points.iter().map(|&point| vertices[point as usize]).collect(),
            face_sets: sets.finish(faces.count()),
            polygons: (assembly.recovery != PolygonRecovery::NONE).then_some(faces.report),
            face_offsets: faces.offsets,
            warnings,
            ..CageDesc::default()
        };
        watch.look()?;
        Ok(Assembled { desc, points, materials, more_uv, has_polygons })
    }

    fn weld_points(&self, assembly: Assembly, watch: &Watch) -> Result<Welded, Cancelled> {
        let groups = self.groups(assembly.weld, watch)?;
        let mut exact = Welder::default();
        let mut near = NearWelder::new(assembly.tolerance, &self.positions);
        let mut welded = Welded::default();
        for (point, p) in (0..).zip(&self.positions) {
            watch.at(point)?;
            let group = groups.get(point as usize).copied().unwrap_or(0);
            let (vertex, new) = match &mut near {
                Some(near) => near.weld(*p, group),
                None => exact.weld(p.to_array(), group),
            };
            if new {
                welded.positions.push(*p);
                welded.points.push(point);
            }
            welded.vertices.push(vertex);
        }
        if !self.influences.is_empty() && assembly.weld == Weld::Scene {
            let mut places = Welder::default();
            welded.apart = welded.positions.iter().filter(|p| !places.weld(p.to_array(), 0).1).count();
        }
        Ok(welded)
    }

    /// Points of different groups are never welded: those of different nodes if these are to stay apart, and those that do not move
    /// together, like the lips of a closed mouth.
    fn groups(&self, weld: Weld, watch: &Watch) -> Result<Vec<u32>, Cancelled> {
        if self.influences.is_empty() && weld == Weld::Scene {
            return Ok(Vec::new());
        }
        let mut known: HashMap<Vec<u32>, u32> = HashMap::new();
        let mut group = |point: u32| {
            watch.at(point)?;
            let mut key = self.movement(point);
            if weld == Weld::Nodes {
                key.push(self.point_parts[point as usize]);
            }
            let next = known.len() as u32;
            Ok(*known.entry(key).or_insert(next))
        };
        (0..self.point_count()).map(&mut group).collect()
    }

    /// Words that are equal for points that move together.
    fn movement(&self, point: u32) -> Vec<u32> {
        let Some(influences) = self.influences.get(point as usize) else { return Vec::new() };
        let part = self.point_parts[point as usize];
        let Part { mover, morphs } = &self.parts[part as usize];
        let mut words = if self.skinned[point as usize] {
            influences.iter().flat_map(|&(joint, weight)| [joint, weight.to_bits()]).collect()
        } else {
            // Several nodes may hang on the one that moves.
            vec![mover.map_or(0, |node| node + 1)]
        };
        let offsets = morphs.as_ref().map_or(&[][..], |morphs| morphs.of(point));
        if offsets.iter().any(|&offset| offset != Vec3::ZERO) {
            words.push(part);
            // Adding zero turns -0 into +0.
            words.extend(offsets.iter().flat_map(|offset| (*offset + 0.0).to_array()).map(f32::to_bits));
        }
        words
    }

    fn corner_uv(&self, set: usize, faces: &Faces, warnings: &mut Vec<Warning>) -> Option<FaceVarying> {
        let values = self.uv.get(set)?;
        let mut welder = Welder::default();
        let mut uv = FaceVarying::default();
        let index = |point: &u32| {
            let Some(value) = values.get(*point as usize).copied().flatten() else { return NONE };
            let (index, new) = welder.weld(value.to_array(), 0);
            if new {
                uv.values.push(value);
            }
            index
        };
        uv.indices = faces.points.iter().map(index).collect();
        uv.finish(&faces.offsets, warnings)
    }
}

/// Points as vertices.
#[derive(Default)]
struct Welded {
    positions: Vec<DVec3>,
    /// The vertex of each point.
    vertices: Vec<u32>,
    /// The first point of each vertex.
    points: Vec<u32>,
    /// Vertices at the place of another that moves differently.
    apart: usize,
}
