//! The pose: head turned, tail swung to the side, feet mid-step.

use glam::{DQuat, DVec3, EulerRot, dvec3};

/// Where the tail starts to swing, along z.
const TAIL_START: f64 = -0.70;
/// Height of the tail's middle there.
const TAIL_HEIGHT: f64 = 0.72;
/// Length of the tail.
const TAIL_LENGTH: f64 = 1.75;
/// Angle in radians through which the tail's direction swings.
const SWING: f64 = 2.1;
/// Angle in radians through which the tail's end twists.
const TWIST: f64 = 1.0;
/// How far the tail's end is raised.
const RAISE: f64 = 0.42;

/// Poses one point of the symmetric creature.
pub(super) fn pose(p: DVec3) -> DVec3 {
    swing_tail(turn_head(step(p)))
}

/// Moves the feet of a diagonal pair forward and the other two back.
fn step(p: DVec3) -> DVec3 {
    let low = 1.0 - smoothstep(0.0, 0.5, p.y);
    let lead = if (p.x > 0.0) == (p.z > 0.0) { 1.0 } else { -1.0 };
    p + DVec3::Z * 0.06 * lead * low
}

/// Turns, lifts and tilts the head about the neck.
fn turn_head(p: DVec3) -> DVec3 {
    let neck = dvec3(0.0, 1.10, 0.55);
    let share = smoothstep(-0.02, 0.38, (p - neck).dot(dvec3(0.0, 0.6, 0.8)));
    let turn = DQuat::from_euler(EulerRot::YXZ, 0.30 * share, -0.16 * share, -0.09 * share);
    neck + turn * (p - neck)
}

/// Bends the tail round to the right, twists it and raises its end.
fn swing_tail(p: DVec3) -> DVec3 {
    let along = (TAIL_START - p.z) / TAIL_LENGTH;
    // The wings reach back over the tail.
    if along <= 0.0 || p.y > 1.1 {
        return p;
    }
    let twist = DQuat::from_rotation_z(-TWIST * smoothstep(0.3, 1.0, along));
    let offset = twist * dvec3(p.x, p.y - TAIL_HEIGHT, 0.0);
    let (sine, cosine) = tail_angle(along).sin_cos();
    let rise = RAISE * smoothstep(0.15, 1.1, along);
    dvec3(0.0, TAIL_HEIGHT + rise + offset.y, TAIL_START) + tail_middle(along) + offset.x * dvec3(cosine, 0.0, sine)
}

/// Angle of the tail's direction at a share of its length. Its curvature grows from nothing, to join the trunk smoothly.
fn tail_angle(along: f64) -> f64 {
    0.5 * SWING * along * along * (3.0 - along)
}

/// The tail's middle from its start: the integral of its direction by the midpoint rule.
fn tail_middle(along: f64) -> DVec3 {
    let steps = 64;
    let step = along / f64::from(steps);
    let angles = (0..steps).map(|k| tail_angle(step * (f64::from(k) + 0.5)));
    angles.map(|angle| TAIL_LENGTH * step * dvec3(angle.sin(), 0.0, -angle.cos())).sum()
}

fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pose_is_continuous_where_the_tail_starts() {
        let at = |z: f64| swing_tail(dvec3(0.1, 0.8, z));
        assert!(at(TAIL_START + 1e-6).distance(at(TAIL_START - 1e-6)) < 1e-5);
    }

    #[test]
    fn the_tail_keeps_its_length() {
        let at = |k: i32| tail_middle(f64::from(k) / 200.0);
        let length: f64 = (0..200).map(|k| at(k).distance(at(k + 1))).sum();
        assert!((length - TAIL_LENGTH).abs() < 1e-3, "{length}");
    }
}
