//! Which vertices of a rig share joints.

use osculate_cage::Rig;

/// Joints and vertices in groups: two joints that move one vertex are in one group, and so is the vertex. The bind positions of a
/// group are therefore in one space, which those of other groups need not be in: each mesh of a scene has its own.
pub(super) struct Groups {
    /// The group of each joint.
    of_joint: Vec<usize>,
    count: usize,
}

impl Groups {
    pub(super) fn of(rig: &Rig) -> Self {
        let mut parents: Vec<usize> = (0..rig.joints.len()).collect();
        for v in 0..rig.bind_positions.len() {
            let mut joints = moving(rig, v);
            let Some(first) = joints.next() else { continue };
            for joint in joints {
                let [a, b] = [first, joint].map(|joint| root(&mut parents, joint));
                parents[a.max(b)] = a.min(b);
            }
        }
        // A root is the lowest joint of its group, so it is numbered before the others.
        let (mut of_joint, mut count) = (Vec::with_capacity(parents.len()), 0);
        for joint in 0..parents.len() {
            let root = root(&mut parents, joint);
            let group = if root == joint { count } else { of_joint[root] };
            count += usize::from(root == joint);
            of_joint.push(group);
        }
        Self { of_joint, count: count.max(1) }
    }

    /// How many there are; one at least.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    pub(super) fn of_joint(&self, joint: usize) -> usize {
        self.of_joint[joint]
    }

    /// The group of a vertex; the first for one that nothing moves.
    pub(super) fn of_vertex(&self, rig: &Rig, v: usize) -> usize {
        moving(rig, v).next().map_or(0, |joint| self.of_joint[joint])
    }
}

/// The joints that move a vertex.
fn moving(rig: &Rig, v: usize) -> impl Iterator<Item = usize> + '_ {
    rig.influences_of(v).filter(|(_, weight)| *weight > 0.0).map(|(joint, _)| joint as usize)
}

/// The lowest joint of a joint's group; shortens the way there.
fn root(parents: &mut [usize], mut joint: usize) -> usize {
    while parents[joint] != joint {
        parents[joint] = parents[parents[joint]];
        joint = parents[joint];
    }
    joint
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DAffine3, DVec3};
    use osculate_cage::Joint;

    #[test]
    fn joints_that_share_a_vertex_are_one_group() {
        let pairs = [[4, 2], [1, 1], [2, 5], [3, 0]];
        let rig = Rig {
            joints: vec![Joint { node: 0, inverse_bind: DAffine3::IDENTITY }; 7],
            bind_positions: vec![DVec3::ZERO; pairs.len()],
            influences: 2,
            joint_indices: pairs.concat(),
            joint_weights: vec![0.5; 2 * pairs.len()],
            ..Rig::default()
        };
        let groups = Groups::of(&rig);
        let found: Vec<usize> = (0..7).map(|joint| groups.of_joint(joint)).collect();
        assert_eq!((found.as_slice(), groups.count()), (&[0, 1, 2, 0, 2, 2, 3][..], 4));
        assert_eq!((0..4).map(|v| groups.of_vertex(&rig, v)).collect::<Vec<_>>(), [2, 1, 2, 0]);
    }
}
