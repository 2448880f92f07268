//! Two bones that reach for a point: inverse kinematics in closed form.

use glam::{DMat3, DQuat, DVec3};

use super::super::super::skin::{Joint, Pose};
use super::skeleton::{find, sided};

/// A leg: three joints and the ball of the foot.
pub(super) struct Limb {
    /// Where it starts, its middle joint, and the joint of the foot.
    pub(super) joints: [usize; 3],
    /// The ball of the foot at rest, which it rolls over.
    pub(super) ball: DVec3,
}

impl Limb {
    /// The limb of those joints on a side.
    pub(super) fn new(joints: &[Joint], names: [&str; 4], side: &str) -> Self {
        let [a, b, c, ball] = names.map(|name| find(joints, &sided(name, side)));
        Self { joints: [a, b, c], ball: joints[ball].place }
    }

    /// Turns the limb's joints so that the ball of the foot comes to `ball`, the foot pitched by `pitch` and turned by `yaw` against
    /// its place at rest. What lies beyond its reach it stretches towards.
    pub(super) fn reach(&self, skeleton: &[Joint], pose: &mut Pose, ball: DVec3, pitch: f64, yaw: f64) {
        let [start, middle, end] = self.joints;
        let place = |joint: usize| skeleton[joint].place;
        let foot = DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch);
        let goal = ball + foot * (place(end) - self.ball);
        let parent = skeleton[start].parent.expect("a limb hangs from something");
        let parent_turn = pose.frame(skeleton, parent).1;
        pose.turns[start] = DQuat::IDENTITY;
        let from = pose.frame(skeleton, start).0;
        let rest = [place(middle) - place(start), place(end) - place(middle)];
        let bones = bend(goal - from, rest);
        let turns = [0, 1].map(|k| turn(rest, bones, k));
        pose.turns[start] = parent_turn.inverse() * turns[0];
        pose.turns[middle] = turns[0].inverse() * turns[1];
        pose.turns[end] = turns[1].inverse() * foot;
    }
}

/// The two bones that lead to `goal`, bent to the same side as at rest: the law of cosines.
fn bend(goal: DVec3, rest: [DVec3; 2]) -> [DVec3; 2] {
    let [a, b] = rest.map(DVec3::length);
    let reach = goal.length().clamp(1.001 * (a - b).abs(), 0.999 * (a + b));
    let along = goal.normalize();
    // The middle joint leaves the straight line in the direction that it leaves it at rest.
    let straight = (rest[0] + rest[1]).normalize();
    let out = DQuat::from_rotation_arc(straight, along) * rest[0].reject_from_normalized(straight).normalize();
    let projected = (a * a - b * b + reach * reach) / (2.0 * reach);
    let first = projected * along + (a * a - projected * projected).max(0.0).sqrt() * out;
    [first, reach * along - first]
}

/// The rotation that takes bone `k` and the hinge between both from where they rest to where they are.
fn turn(rest: [DVec3; 2], bones: [DVec3; 2], k: usize) -> DQuat {
    let frame = |bones: [DVec3; 2]| {
        let hinge = bones[0].cross(bones[1]).normalize();
        let along = bones[k].normalize();
        DMat3::from_cols(along, hinge, along.cross(hinge))
    };
    DQuat::from_mat3(&(frame(bones) * frame(rest).transpose()))
}

#[cfg(test)]
mod tests {
    use super::super::skeleton::{SIDES, joints};
    use super::*;

    #[test]
    fn the_foot_comes_to_where_it_is_sent() {
        let skeleton = joints();
        for side in SIDES {
            let limb = Limb::new(&skeleton, ["thigh", "knee", "ankle", "hind_foot"], side);
            for (step, pitch, yaw) in [(DVec3::ZERO, 0.0, 0.0), (DVec3::new(0.02, 0.06, -0.1), 0.5, 0.1)] {
                let mut pose = Pose::rest(skeleton.len());
                pose.turns[0] = DQuat::from_rotation_z(0.1);
                limb.reach(&skeleton, &mut pose, limb.ball + step, pitch, yaw);
                let found = pose.frame(&skeleton, find(&skeleton, &sided("hind_foot", side))).0;
                assert!(found.distance(limb.ball + step) < 1e-9, "{found}");
            }
        }
    }

    #[test]
    fn bones_keep_their_lengths_and_their_side() {
        let rest = [DVec3::new(0.0, -1.0, 0.2), DVec3::new(0.1, -1.0, -0.3)];
        for goal in [DVec3::new(0.3, -1.5, 0.2), DVec3::new(0.0, -9.0, 0.1)] {
            let bones = bend(goal, rest);
            for k in [0, 1] {
                assert!((bones[k].length() - rest[k].length()).abs() < 1e-9);
            }
            assert!(bones[0].cross(bones[1]).dot(rest[0].cross(rest[1])) > 0.0);
            let turned = turn(rest, bones, 1) * rest[1];
            assert!(turned.distance(bones[1]) < 1e-9);
        }
    }
}
