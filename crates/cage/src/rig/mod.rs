//! What moves the vertices of a cage: a hierarchy of nodes, joints, morph targets and animations.
//!
//! A vertex at rest is only one pose of many. The rig keeps, for every vertex of the cage, where it is before anything moves it (its
//! *bind position*), up to eight *influences* (a joint and a weight each) and the offsets that morph targets add. A vertex in a pose is
//!
//! `p = sum over influences of weight * matrix(joint) * (bind + sum over targets of weight(target) * offset)`,
//! `matrix(joint) = to_world(node of joint) * inverse_bind(joint)`,
//!
//! the linear blend skinning of the glTF 2.0 specification, section 3.7.3. A vertex without a skin is bound to a joint made for its
//! node, so that one formula, and one kernel, moves all of them. [`Rig::positions`] evaluates it in f64.

mod animation;
mod pose;

use glam::{DAffine3, DQuat, DVec3, Vec3};

pub use animation::{Animation, AnimationChannel, AnimationSampler, Interpolation, NodeProperty};
pub use pose::Pose;

pub(crate) use animation::unit_quaternion;
pub(crate) use pose::blend;

/// Where a node is relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodeTransform {
    /// A scale, then a rotation, then a translation; what animations change.
    Decomposed {
        /// The translation.
        translation: DVec3,
        /// The rotation, of unit length.
        rotation: DQuat,
        /// The scale along the node's own axes.
        scale: DVec3,
    },
    /// Any affine map; never animated.
    Matrix(DAffine3),
}

impl NodeTransform {
    /// The transform as a map from the node's space to that of its parent.
    #[must_use]
    pub fn to_parent(&self) -> DAffine3 {
        match *self {
            Self::Decomposed { translation, rotation, scale } => {
                DAffine3::from_scale_rotation_translation(scale, rotation, translation)
            }
            Self::Matrix(matrix) => matrix,
        }
    }
}

/// A node of the hierarchy.
#[derive(Clone, Debug, PartialEq)]
pub struct RigNode {
    /// Its name, or one made from its index in the file.
    pub name: String,
    /// Its index in the file.
    pub source: u32,
    /// Its parent, a lower index of [`Rig::nodes`]; none for a root.
    pub parent: Option<u32>,
    /// Where it is at rest.
    pub transform: NodeTransform,
}

/// Something that moves vertices: a node with the map from bind positions to the space of that node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// The node, an index of [`Rig::nodes`].
    pub node: u32,
    /// From the space of the bind positions to that of the node; the identity for vertices without a skin.
    pub inverse_bind: DAffine3,
}

/// Morph targets that are weighted together: those of one mesh in one place.
#[derive(Clone, Debug, PartialEq)]
pub struct MorphSet {
    /// The node whose mesh this is, an index of [`Rig::nodes`]; animations of its weights move the set.
    pub node: u32,
    /// The targets, in the order of the weights.
    pub targets: Vec<MorphTarget>,
    /// The weight of each target at rest.
    pub weights: Vec<f32>,
}

/// Offsets of some vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MorphTarget {
    /// Its name, or one made from its number.
    pub name: String,
    /// The vertices that it moves, rising.
    pub vertices: Vec<u32>,
    /// The offset of each at weight 1, in the space of the bind positions.
    pub offsets: Vec<Vec3>,
}

/// All that moves the vertices of a cage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rig {
    /// The nodes, parents before children.
    pub nodes: Vec<RigNode>,
    /// The joints.
    pub joints: Vec<Joint>,
    /// The position of each vertex of the cage before anything moves it.
    pub bind_positions: Vec<DVec3>,
    /// How many influences each vertex has room for: 1, 4 or 8.
    pub influences: usize,
    /// The joints of each vertex, `influences` of them; 0 where there are fewer.
    pub joint_indices: Vec<u32>,
    /// Their weights: at least 0, with the sum 1 for each vertex; 0 where there are fewer.
    pub joint_weights: Vec<f32>,
    /// The morph targets, in the order of their nodes, at most one set for each.
    pub morph_sets: Vec<MorphSet>,
    /// The animations.
    pub animations: Vec<Animation>,
}

impl Rig {
    /// Most joints that may move one vertex.
    pub const MAX_INFLUENCES: usize = 8;

    /// The joints of vertex `v` and their weights.
    pub fn influences_of(&self, v: usize) -> impl Iterator<Item = (u32, f32)> + '_ {
        let range = v * self.influences..(v + 1) * self.influences;
        self.joint_indices[range.clone()].iter().copied().zip(self.joint_weights[range].iter().copied())
    }

    /// The index of the morph set of a node, if it has one.
    #[must_use]
    pub fn morph_set_of(&self, node: u32) -> Option<usize> {
        self.morph_sets.binary_search_by_key(&node, |set| set.node).ok()
    }

    /// Names the first thing that does not fit a cage of that many vertices.
    pub(crate) fn check(&self, vertices: usize) -> Result<(), &'static str> {
        let whole = self.bind_positions.len() == vertices
            && self.joint_indices.len() == vertices * self.influences
            && self.joint_weights.len() == self.joint_indices.len();
        let nodes = self.nodes.len() as u64;
        let parents = (0..).zip(&self.nodes).all(|(n, node)| node.parent.is_none_or(|parent| parent < n));
        let joints = self.joints.iter().all(|joint| u64::from(joint.node) < nodes);
        let influences = self.joint_indices.iter().all(|&joint| (joint as usize) < self.joints.len());
        let morphs = self.morph_sets.iter().all(|set| {
            u64::from(set.node) < nodes
                && set.weights.len() == set.targets.len()
                && set.targets.iter().all(|target| target.fits(vertices))
        });
        let sorted = self.morph_sets.is_sorted_by(|a, b| a.node < b.node);
        let finite = self.bind_positions.iter().all(|p| p.is_finite())
            && self.joint_weights.iter().all(|&w| w.is_finite() && w >= 0.0);
        let held = self.joint_weights.chunks(self.influences.max(1)).all(|weights| weights.iter().any(|&w| w > 0.0));
        for (holds, fault) in [
            (whole, "bind positions, joints and weights must be as many as vertices"),
            (parents, "parents must come before their children"),
            (joints, "joints must name nodes that exist"),
            (influences, "vertices must name joints that exist"),
            (morphs, "morph sets must name nodes and vertices that exist, rising, with a weight for each target"),
            (sorted, "morph sets must be in the order of their nodes, one for each"),
            (finite, "bind positions and weights must be finite and weights at least 0"),
            (
                held && (self.influences > 0 || vertices == 0),
                "every vertex must have a joint with a weight greater than 0",
            ),
            (self.animations.iter().all(|animation| animation.fits(self)), "animations must name what exists"),
        ] {
            if !holds {
                return Err(fault);
            }
        }
        Ok(())
    }

    /// The rig of other vertices: the new vertex `v` moves as the old vertex `sources[v]`.
    pub(crate) fn gather_vertices(&mut self, sources: &[u32]) {
        let rows = |v: &u32| *v as usize * self.influences..(*v as usize + 1) * self.influences;
        self.joint_indices = sources.iter().flat_map(|v| self.joint_indices[rows(v)].iter().copied()).collect();
        self.joint_weights = sources.iter().flat_map(|v| self.joint_weights[rows(v)].iter().copied()).collect();
        self.bind_positions = sources.iter().map(|&v| self.bind_positions[v as usize]).collect();
        self.morph_sets.iter_mut().flat_map(|set| &mut set.targets).for_each(|target| target.gather(sources));
    }
}

impl MorphTarget {
    fn fits(&self, vertices: usize) -> bool {
        self.vertices.len() == self.offsets.len()
            && self.vertices.is_sorted_by(|a, b| a < b)
            && self.vertices.last().is_none_or(|&v| (v as usize) < vertices)
            && self.offsets.iter().all(|offset| offset.is_finite())
    }

    fn gather(&mut self, sources: &[u32]) {
        let offset = |v: &u32| Some(self.offsets[self.vertices.binary_search(v).ok()?]);
        let moved = (0..).zip(sources).filter_map(|(new, old)| Some((new, offset(old)?)));
        (self.vertices, self.offsets) = moved.unzip();
    }
}
