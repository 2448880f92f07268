//! glTF 2.0, as `.gltf` with its buffers or as `.glb`.
//!
//! Triangles are taken in scene placement and become polygons again ([`PolygonRecovery`]). Vertices that exporters split at seams of
//! normals and uv are welded by position, and uv are kept per corner. What moves vertices becomes a [`Rig`](crate::Rig), materials an
//! [`Appearance`](crate::Appearance). The `gltf` crate reads the JSON and checks references inside it; everything about bytes is
//! checked here, because the crate reads wrong component types silently.

mod accessor;
mod animation;
mod base64;
mod buffers;
mod container;
mod document;
mod error;
mod material;
mod motion;
mod polygons;
mod primitive;
mod scene;
mod soup;
#[cfg(test)]
mod tests;

use std::path::Path;

use ::gltf::Gltf;

pub use error::{AccessorError, GltfError, GltfPlace};
pub use polygons::{PolygonRecovery, PolygonReport};

use crate::limits::Gauge;
use crate::progress::Watch;
use crate::{Appearance, Cage, CageDesc, CageError, ReadDesc, ReadError, ReadStage, Rig, Warning, draft};
use buffers::Buffers;
use motion::{Budget, Motion};
use primitive::Context;
use scene::Scene;
use soup::{Assembled, Assembly, Soup, Weld};

/// How glTF files become cages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GltfDesc {
    /// Which signs of polygons are believed; all by default.
    pub polygons: PolygonRecovery,
    /// Vertices at most this far apart, in units of the scene, become one; by default 0, only equal ones.
    pub weld_tolerance: f64,
}

/// Reads the bytes of a glTF file, JSON or binary; `name` is the name of the file for messages, `folder` where its external buffers are.
///
/// # Errors
/// [`ReadError::Gltf`] for a malformed file, [`ReadError::Limit`] for one that is too large, [`ReadError::Refused`] for a mesh that
/// cannot be a cage.
pub fn read_gltf(bytes: &[u8], name: &str, folder: Option<&Path>, desc: &ReadDesc) -> Result<Cage, ReadError> {
    let fault = |error| match error {
        GltfError::Limit(error) => ReadError::Limit { file: name.into(), error },
        error => ReadError::Gltf { file: name.into(), error },
    };
    let refused = |error| ReadError::Refused { file: name.into(), line: None, error };
    let cage = File::read(bytes, folder, desc).map_err(fault).and_then(|file| file.build(desc).map_err(refused));
    cage.map_err(|error| error.or_cancelled(Path::new(name)))
}

/// What was read of a file.
struct File {
    soup: Soup,
    /// Materials and images; faces come later.
    appearance: Appearance,
    /// The material in `appearance` of each material of the file.
    materials: Vec<u32>,
    /// Nodes, joints and animations where something moves; vertices come later.
    rig: Option<Rig>,
}

impl File {
    fn read(bytes: &[u8], folder: Option<&Path>, desc: &ReadDesc) -> Result<Self, GltfError> {
        let mut gauge = Gauge::new(desc, bytes)?;
        let gltf = document::parse(bytes)?;
        let buffers = Buffers::load(&gltf, folder, desc)?;
        gauge.bytes(buffers.size() as u64)?;
        let scene = Scene::new(&gltf)?;
        gauge.expect_faces(desc, scene.triangles_announced())?;
        let motion = Motion::new(&gltf, &scene, &buffers)?;
        let budget = Budget::new(desc.limits);
        let mut context = Context { scene: &scene, buffers: &buffers, motion, budget, gauge };
        let mut soup = Soup::default();
        for placed in &scene.meshes {
            primitive::add_mesh(placed, &mut context, &mut soup)?;
        }
        if soup.is_empty() {
            return Err(GltfError::NoTriangles);
        }
        let Context { motion, mut budget, .. } = context;
        let (appearance, materials) = material::read(&gltf, &buffers, folder, &mut soup);
        let rig = match motion {
            Some(motion) => Some(read_rig(&gltf, &scene, &buffers, motion, &soup, &mut budget)?),
            None => None,
        };
        Ok(Self { soup, appearance, materials, rig })
    }

    /// Welds across the whole scene if that is a manifold mesh, else node by node: objects that merely touch stay apart. If polygons
    /// keep the cage from being manifold, triangles are tried. With a repair, the first attempt is repaired.
    fn build(&self, desc: &ReadDesc) -> Result<Cage, CageError> {
        let mut recovery = desc.gltf.polygons;
        loop {
            let mut has_polygons = false;
            let mut result = Err(CageError::NoFaces);
            for weld in [Weld::Scene, Weld::Nodes] {
                if weld == Weld::Nodes && self.soup.parts() == 1 {
                    break;
                }
                let assembly = Assembly { weld, tolerance: desc.gltf.weld_tolerance, recovery };
                let watch = Watch::new(desc.observer.as_ref(), ReadStage::Polygons, self.soup.steps())?;
                let mut assembled = self.soup.assemble(assembly, &watch)?;
                has_polygons |= assembled.has_polygons;
                let warnings = &mut assembled.desc.warnings;
                if weld == Weld::Nodes {
                    warnings.push(Warning::WeldedByNode(self.soup.parts()));
                }
                if recovery != desc.gltf.polygons {
                    warnings.push(Warning::PolygonsNotUsed);
                }
                result = draft::build(self.finish(assembled), desc);
                if desc.repair.is_some() || !matches!(result, Err(CageError::Topology(_))) {
                    return result;
                }
            }
            if !has_polygons {
                return result;
            }
            recovery = PolygonRecovery::NONE;
        }
    }

    /// Adds what belongs to faces and vertices.
    fn finish(&self, assembled: Assembled) -> CageDesc {
        let Assembled { mut desc, points, materials, more_uv, .. } = assembled;
        let appearance = &self.appearance;
        if !appearance.materials.is_empty() || !more_uv.is_empty() {
            let own = |m: u32| self.materials.get(m as usize).copied().unwrap_or(crate::NONE);
            let face_materials = materials.into_iter().map(own).collect();
            desc.appearance = Some(Appearance { face_materials, more_uv, ..appearance.clone() });
        }
        desc.rig = self.rig.as_ref().map(|rig| self.bind(rig.clone(), &points));
        desc
    }

    /// Gives a rig the vertices that were made from these points.
    fn bind(&self, mut rig: Rig, points: &[u32]) -> Rig {
        rig.morph_sets = self.soup.morph_sets(points);
        let influences = || points.iter().map(|&point| &self.soup.influences[point as usize]);
        let used = influences().map(|all| all.iter().filter(|(_, weight)| *weight > 0.0).count()).max();
        rig.influences = [1, 4, 8].into_iter().find(|&room| used <= Some(room)).unwrap_or(8);
        rig.joint_indices =
            influences().flat_map(|all| all[..rig.influences].iter().map(|(joint, _)| *joint)).collect();
        rig.joint_weights =
            influences().flat_map(|all| all[..rig.influences].iter().map(|(_, weight)| *weight)).collect();
        rig.bind_positions = points.iter().map(|&point| self.soup.bind[point as usize]).collect();
        rig
    }
}

/// The rig of a scene, still without vertices.
fn read_rig(
    gltf: &Gltf,
    scene: &Scene,
    buffers: &Buffers,
    motion: Motion,
    soup: &Soup,
    budget: &mut Budget,
) -> Result<Rig, GltfError> {
    let mut rig =
        Rig { nodes: scene.nodes.clone(), joints: motion.joints, morph_sets: soup.morph_sets(&[]), ..Rig::default() };
    rig.animations = animation::read(gltf, scene, buffers, &rig, budget)?;
    Ok(rig)
}
