//! A rig at one moment.

use glam::{DAffine3, DVec3};

use super::{NodeTransform, Rig};

/// Where the nodes of a rig are and how strong its morph targets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// The transform of each node.
    pub transforms: Vec<NodeTransform>,
    /// The weights of the targets of each morph set.
    pub morph_weights: Vec<Vec<f64>>,
}

impl Rig {
    /// The pose that the file describes when nothing is played.
    #[must_use]
    pub fn rest(&self) -> Pose {
        let weights = |weights: &Vec<f32>| weights.iter().map(|&w| f64::from(w)).collect();
        Pose {
            transforms: self.nodes.iter().map(|node| node.transform).collect(),
            morph_weights: self.morph_sets.iter().map(|set| weights(&set.weights)).collect(),
        }
    }

    /// The pose of animation `animation` at `time` in seconds; what it does not move is at rest.
    ///
    /// # Panics
    /// If there is no such animation.
    #[must_use]
    pub fn pose(&self, animation: usize, time: f64) -> Pose {
        let mut pose = self.rest();
        self.animations[animation].apply(time, self, &mut pose);
        pose
    }

    /// From the space of each node to that of the scene.
    #[must_use]
    pub fn node_matrices(&self, pose: &Pose) -> Vec<DAffine3> {
        let mut matrices: Vec<DAffine3> = Vec::with_capacity(self.nodes.len());
        for (node, transform) in self.nodes.iter().zip(&pose.transforms) {
            let parent = node.parent.map_or(DAffine3::IDENTITY, |parent| matrices[parent as usize]);
            matrices.push(parent * transform.to_parent());
        }
        matrices
    }

    /// From bind positions to the scene, for each joint: what a skinning kernel needs of a pose beside the weights of its targets.
    #[must_use]
    pub fn joint_matrices(&self, pose: &Pose) -> Vec<DAffine3> {
        let nodes = self.node_matrices(pose);
        self.joints.iter().map(|joint| nodes[joint.node as usize] * joint.inverse_bind).collect()
    }

    /// The position of each vertex of the cage in a pose.
    #[must_use]
    pub fn positions(&self, pose: &Pose) -> Vec<DVec3> {
        let matrices = self.joint_matrices(pose);
        let mut morphed = self.bind_positions.clone();
        for (set, weights) in self.morph_sets.iter().zip(&pose.morph_weights) {
            for (target, &weight) in set.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
                for (&v, offset) in target.vertices.iter().zip(&target.offsets) {
                    morphed[v as usize] += weight * offset.as_dvec3();
                }
            }
        }
        let skinned = |(v, &p): (usize, &DVec3)| blend(self.influences_of(v), &matrices, p);
        morphed.iter().enumerate().map(skinned).collect()
    }
}

/// A point moved by matrices with weights. Their sum, 1 but for the rounding of 32-bit floats, is divided by: a cage far from the origin
/// would show it. One matrix moves the point without rounding of the blend.
pub(crate) fn blend(influences: impl Iterator<Item = (u32, f32)>, matrices: &[DAffine3], point: DVec3) -> DVec3 {
    let moved = influences.filter(|(_, weight)| *weight != 0.0).map(|(joint, weight)| {
        let weight = f64::from(weight);
        (weight, weight * matrices[joint as usize].transform_point3(point))
    });
    let (sum, total) = moved.fold((0.0, DVec3::ZERO), |(sum, total), (weight, part)| (sum + weight, total + part));
    if sum == 1.0 { total } else { total / sum }
}
