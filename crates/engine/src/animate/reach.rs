//! Where a pose may put vertices, found without moving any.

use glam::{DAffine3, DVec3};
use osculate_cage::{Bounds, Pose, Rig};

/// Boxes of what joints and targets move.
pub(super) struct Reach {
    /// The box of the bind positions that each joint moves, if it moves any.
    joints: Vec<Option<Bounds>>,
    /// For each set the box of the offsets of each target, and of zero.
    targets: Vec<Vec<Bounds>>,
}

impl Reach {
    pub(super) fn new(rig: &Rig) -> Self {
        let mut joints: Vec<Option<Bounds>> = vec![None; rig.joints.len()];
        for (v, &point) in rig.bind_positions.iter().enumerate() {
            for (joint, _) in rig.influences_of(v).filter(|(_, weight)| *weight > 0.0) {
                let found = &mut joints[joint as usize];
                *found = Some(join(*found, Bounds { min: point, max: point }));
            }
        }
        let of_target = |offsets: &[glam::Vec3]| {
            let zero = Bounds { min: DVec3::ZERO, max: DVec3::ZERO };
            offsets.iter().map(|offset| offset.as_dvec3()).fold(zero, |b, p| join(Some(b), Bounds { min: p, max: p }))
        };
        let targets = rig.morph_sets.iter().map(|set| set.targets.iter().map(|target| of_target(&target.offsets)));
        Self { joints, targets: targets.map(Iterator::collect).collect() }
    }

    /// A box around all vertices: a vertex is a weighted mean of where its joints would put it, and none puts it outside of the
    /// moved box of its bind positions, widened by what the targets add.
    pub(super) fn bounds(&self, matrices: &[DAffine3], pose: &Pose) -> Bounds {
        let morphs = self.morphs(pose);
        let moved = self.joints.iter().zip(matrices).filter_map(|(found, matrix)| {
            let found = (*found)?;
            Some(transformed(matrix, Bounds { min: found.min + morphs.min, max: found.max + morphs.max }))
        });
        moved.fold(None, |all, moved| Some(join(all, moved))).unwrap_or(Bounds::of(&[]))
    }

    /// The box of the sums of offsets.
    fn morphs(&self, pose: &Pose) -> Bounds {
        let weighted =
            self.targets.iter().zip(&pose.morph_weights).flat_map(|(boxes, weights)| boxes.iter().zip(weights));
        weighted.fold(Bounds { min: DVec3::ZERO, max: DVec3::ZERO }, |sum, (found, &weight)| {
            let [a, b] = [found.min, found.max].map(|corner| weight * corner);
            Bounds { min: sum.min + a.min(b), max: sum.max + a.max(b) }
        })
    }
}

fn join(a: Option<Bounds>, b: Bounds) -> Bounds {
    a.map_or(b, |a| Bounds { min: a.min.min(b.min), max: a.max.max(b.max) })
}

/// The box of a moved box: its middle moves, and its half sides add up by their absolute shares.
fn transformed(matrix: &DAffine3, found: Bounds) -> Bounds {
    let half = found.max * 0.5 - found.min * 0.5;
    let m = matrix.matrix3;
    let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
    let middle = matrix.transform_point3(found.center());
    Bounds { min: middle - reach, max: middle + reach }
}
