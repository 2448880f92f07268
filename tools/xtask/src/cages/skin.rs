//! What moves a mesh: joints, weights, and a clip that plays.

use glam::{DQuat, DVec3};

/// A joint. Where it rests it is not turned, so its place says all.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    /// An earlier joint; none for the root.
    pub(super) parent: Option<usize>,
    /// Where it is at rest, in the space of the mesh.
    pub(super) place: DVec3,
}

/// Joints with the vertices that follow them.
#[derive(Clone, Debug)]
pub(super) struct Skin {
    /// Parents before children.
    pub(super) joints: Vec<Joint>,
    /// For each vertex its joints with weights of sum 1, the largest first.
    pub(super) weights: Vec<Vec<(usize, f64)>>,
    pub(super) clip: Clip,
}

/// Poses one after another, evenly in time; the last is the first again if the clip loops.
#[derive(Clone, Debug)]
pub(super) struct Clip {
    pub(super) name: &'static str,
    pub(super) seconds: f64,
    pub(super) poses: Vec<Pose>,
}

/// How joints are turned, each relative to its parent, and how far the root has moved.
#[derive(Clone, Debug)]
pub(super) struct Pose {
    pub(super) turns: Vec<DQuat>,
    pub(super) shift: DVec3,
}

impl Joint {
    /// Its place relative to its parent.
    pub(super) fn step(&self, joints: &[Self]) -> DVec3 {
        self.place - self.parent.map_or(DVec3::ZERO, |parent| joints[parent].place)
    }
}

impl Pose {
    /// The pose at rest.
    pub(super) fn rest(joints: usize) -> Self {
        Self { turns: vec![DQuat::IDENTITY; joints], shift: DVec3::ZERO }
    }

    /// Where a joint is and how it is turned.
    pub(super) fn frame(&self, joints: &[Joint], joint: usize) -> (DVec3, DQuat) {
        match joints[joint].parent {
            None => (joints[joint].place + self.shift, self.turns[joint]),
            Some(parent) => {
                let (place, turn) = self.frame(joints, parent);
                (place + turn * joints[joint].step(joints), turn * self.turns[joint])
            }
        }
    }
}
