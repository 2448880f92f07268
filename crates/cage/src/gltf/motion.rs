//! What moves the points of a scene: joints of skins, nodes without a skin as joints of their own, and morph targets.

use std::collections::{HashMap, HashSet};

use ::gltf::Gltf;
use ::gltf::json::deserialize;
use ::gltf::json::extras::RawValue;
use ::gltf::mesh::{Mode, Primitive};
use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::accessor::{Purpose, Vectors};
use super::buffers::Buffers;
use super::scene::{PlacedMesh, Scene};
use super::{GltfError, GltfPlace};
use crate::{Joint, LimitError, Limits, Rig};

/// Most numbers that are kept beside positions. Accessors may be used any number of times: a small file must not ask for all memory.
const MOST_NUMBERS: usize = 1 << 26;

/// Joints of one point with their weights, the rest zero.
pub(super) type Influences = [(u32, f32); Rig::MAX_INFLUENCES];

/// Counts the numbers that a file asks for.
pub(super) struct Budget {
    taken: usize,
    limits: Limits,
}

impl Budget {
    pub(super) fn new(limits: Limits) -> Self {
        Self { taken: 0, limits }
    }

    /// Numbers have 4 bytes.
    pub(super) fn take(&mut self, numbers: usize) -> Result<(), GltfError> {
        self.taken = self.taken.saturating_add(numbers);
        if self.taken > MOST_NUMBERS {
            return Err(GltfError::TooMuch(MOST_NUMBERS));
        }
        if 4 * self.taken as u64 > self.limits.memory_bytes {
            return Err(LimitError::Memory { limit: self.limits.memory_bytes }.into());
        }
        Ok(())
    }
}

/// The joints of a scene in which something moves.
pub(super) struct Motion {
    pub(super) joints: Vec<Joint>,
    /// From bind positions to the scene at rest, for each joint.
    pub(super) at_rest: Vec<DAffine3>,
    /// First joint and number of joints of each skin that is used.
    skins: HashMap<usize, (u32, u32)>,
    /// The joint of each node that carries a mesh without a skin.
    nodes: HashMap<u32, u32>,
    /// For each node of the scene where all its movement comes from: itself or its nearest ancestor that is animated.
    movers: Vec<Option<u32>>,
}

impl Motion {
    /// The motion of a scene; none if nothing in it can move.
    pub(super) fn new(gltf: &Gltf, scene: &Scene, buffers: &Buffers) -> Result<Option<Self>, GltfError> {
        let channels = gltf.animations().flat_map(|animation| animation.channels());
        let animated: HashSet<u32> =
            channels.filter_map(|channel| scene.find(channel.target().node().index())).collect();
        let targets = |placed: &PlacedMesh| placed.mesh.primitives().any(|p| p.morph_targets().len() > 0);
        let moves = |placed: &PlacedMesh| placed.node.skin().is_some() || targets(placed);
        if animated.is_empty() && !scene.meshes.iter().any(moves) {
            return Ok(None);
        }
        let (joints, at_rest) = (Vec::new(), Vec::new());
        let movers = movers(scene, &animated);
        let mut motion = Self { joints, at_rest, skins: HashMap::new(), nodes: HashMap::new(), movers };
        for placed in &scene.meshes {
            match placed.node.skin() {
                Some(skin) if !motion.skins.contains_key(&skin.index()) => motion.add_skin(&skin, scene, buffers)?,
                _ => {}
            }
        }
        Ok(Some(motion))
    }

    fn add_joint(&mut self, joint: Joint, scene: &Scene) -> u32 {
        self.at_rest.push(scene.to_world[joint.node as usize] * joint.inverse_bind);
        self.joints.push(joint);
        self.joints.len() as u32 - 1
    }

    fn add_skin(&mut self, skin: &::gltf::Skin, scene: &Scene, buffers: &Buffers) -> Result<(), GltfError> {
        let index = skin.index();
        let matrices = match skin.inverse_bind_matrices() {
            Some(accessor) => {
                let fault = |error| GltfError::Accessor {
                    place: GltfPlace::Skin(index),
                    attribute: "inverseBindMatrices".into(),
                    accessor: accessor.index(),
                    error,
                };
                let matrices = Vectors::<16>::new(&accessor, buffers, Purpose::Matrix).map_err(fault)?;
                let count = matrices.count().min(skin.joints().len());
                Some((0..count as u32).map(|j| matrices.get(j)).collect::<Result<Vec<_>, _>>().map_err(fault)?)
            }
            None => None,
        };
        let joints = skin.joints().len();
        let found = matrices.as_ref().map_or(joints, Vec::len);
        if joints == 0 || found < joints {
            return Err(GltfError::SkinMatrices { skin: index, joints, matrices: found });
        }
        let first = self.joints.len() as u32;
        for (joint, node) in skin.joints().enumerate() {
            let node =
                scene.find(node.index()).ok_or(GltfError::SkinNode { skin: index, joint, node: node.index() })?;
            let inverse_bind = matrices.as_ref().map_or(DAffine3::IDENTITY, |matrices| affine(&matrices[joint]));
            self.add_joint(Joint { node, inverse_bind }, scene);
        }
        self.skins.insert(index, (first, joints as u32));
        Ok(())
    }

    /// First joint and number of joints of the skin of a mesh, if it has one.
    pub(super) fn skin_of(&self, placed: &PlacedMesh) -> Option<(u32, u32)> {
        self.skins.get(&placed.node.skin()?.index()).copied()
    }

    /// The joint that moves all points of a mesh without a skin.
    pub(super) fn joint_of(&mut self, placed: &PlacedMesh, scene: &Scene) -> u32 {
        match self.nodes.get(&placed.at) {
            Some(&joint) => joint,
            None => {
                let joint = self.add_joint(Joint { node: placed.at, inverse_bind: DAffine3::IDENTITY }, scene);
                self.nodes.insert(placed.at, joint);
                joint
            }
        }
    }

    /// The node that all movement of a mesh without a skin comes from.
    pub(super) fn mover(&self, placed: &PlacedMesh) -> Option<u32> {
        self.movers[placed.at as usize]
    }
}

fn movers(scene: &Scene, animated: &HashSet<u32>) -> Vec<Option<u32>> {
    let mut movers: Vec<Option<u32>> = Vec::with_capacity(scene.nodes.len());
    for (at, node) in (0..).zip(&scene.nodes) {
        let inherited = || movers[node.parent? as usize];
        let mover = if animated.contains(&at) { Some(at) } else { inherited() };
        movers.push(mover);
    }
    movers
}

/// A matrix by columns without its last row, which is 0, 0, 0, 1.
fn affine(m: &[f64; 16]) -> DAffine3 {
    let column = |k: usize| DVec3::new(m[4 * k], m[4 * k + 1], m[4 * k + 2]);
    DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) }
}

/// Offsets of the points of one mesh in one place.
pub(super) struct Morphs {
    /// The node, an index of the scene's nodes.
    pub(super) node: u32,
    pub(super) names: Vec<String>,
    /// The weight of each target at rest.
    pub(super) weights: Vec<f32>,
    /// The first point; those of a mesh follow each other.
    pub(super) first_point: u32,
    /// For each point the offset of each target.
    pub(super) offsets: Vec<Vec3>,
}

impl Morphs {
    /// The morph targets of a mesh, still without points; none if it has no targets.
    pub(super) fn new(placed: &PlacedMesh, first_point: u32, budget: &mut Budget) -> Result<Option<Self>, GltfError> {
        let PlacedMesh { node, mesh, at } = placed;
        let counts = mesh.primitives().filter(|p| has_triangles(p)).map(|p| (p.index(), p.morph_targets().len()));
        let due = counts.clone().next().map_or(0, |(_, due)| due);
        if let Some((primitive, found)) = counts.clone().find(|&(_, found)| found != due) {
            return Err(GltfError::Targets { mesh: mesh.index(), primitive, found, due });
        }
        if due == 0 {
            return Ok(None);
        }
        let names = target_names(mesh.extras().as_deref());
        // Each place of the mesh has its names and weights.
        budget.take(names.iter().map(|name| name.len() / 4).sum::<usize>() + 8 * due)?;
        let name = |target: usize| names.get(target).cloned().unwrap_or_else(|| format!("target {target}"));
        let mut weights = node.weights().or_else(|| mesh.weights()).unwrap_or_default().to_vec();
        weights.iter_mut().filter(|w| !w.is_finite()).for_each(|w| *w = 0.0);
        weights.resize(due, 0.0);
        let names = (0..due).map(name).collect();
        Ok(Some(Self { node: *at, names, weights, first_point, offsets: Vec::new() }))
    }

    /// The offsets of a point of this mesh.
    pub(super) fn of(&self, point: u32) -> &[Vec3] {
        let targets = self.weights.len();
        &self.offsets[(point - self.first_point) as usize * targets..][..targets]
    }
}

/// True for what a cage is made of: not for points and lines.
pub(super) fn has_triangles(primitive: &Primitive) -> bool {
    matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)
}

/// The names that exporters agreed to keep in `extras.targetNames` of a mesh.
fn target_names(extras: Option<&RawValue>) -> Vec<String> {
    let value: Option<::gltf::json::Value> = extras.and_then(|extras| deserialize::from_str(extras.get()).ok());
    let names = value.as_ref().and_then(|value| value.get("targetNames")?.as_array());
    names.into_iter().flatten().map(|name| name.as_str().unwrap_or_default().to_owned()).collect()
}
