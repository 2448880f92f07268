//! The pose: head turned, tail swung to the side, feet mid-step.

use glam::{DQuat, DVec3, dvec3};

/// Where the tail starts to swing, along z, and its height.
const TAIL: (f64, f64) = (-0.70, 0.72);
/// Length of the tail, the angles through which it swings and twists, and how far its end is raised.
const SWING: (f64, f64, f64, f64) = (1.75, 2.1, 1.0, 0.42);

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

/// Turns and tilts the head about the neck.
fn turn_head(p: DVec3) -> DVec3 {
    let neck = dvec3(0.0, 1.10, 0.55);
    let share = smoothstep(-0.02, 0.38, (p - neck).dot(dvec3(0.0, 0.6, 0.8)));
    let turn = DQuat::from_rotation_y(0.30 * share) * DQuat::from_rotation_z(-0.09 * share);
    neck + turn * (p - neck)
}

/// Bends the tail round to the right, twists it and raises its end.
fn swing_tail(p: DVec3) -> DVec3 {
    let ((start, height), (length, swing, twist, raise)) = (TAIL, SWING);
    let along = (start - p.z) / length;
    if along <= 0.0 || p.y > 1.1 {
        return p;
    }
    // Curvature grows from nothing, so that the bend joins the trunk smoothly: angle t^2 / 2 per unit of swing at the end 1.
    let twisted = DQuat::from_rotation_z(-twist * smoothstep(0.3, 1.0, along)) * dvec3(p.x, p.y - height, 0.0);
    let angle = |t: f64| 0.5 * swing * t * t * (3.0 - t);
    let steps = 64;
    let middle: DVec3 = (0..steps)
        .map(|k| angle(along * (f64::from(k) + 0.5) / f64::from(steps)))
        .map(|angle| dvec3(angle.sin(), 0.0, -angle.cos()) * along * length / f64::from(steps))
        .sum();
    let across = dvec3(angle(along).cos(), 0.0, angle(along).sin());
    let rise = raise * smoothstep(0.15, 1.1, along);
    dvec3(0.0, height + rise + twisted.y, start) + middle + twisted.x * across
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
        assert!(at(TAIL.0 + 1e-6).distance(at(TAIL.0 - 1e-6)) < 1e-5);
    }

    #[test]
    fn the_tail_keeps_its_length() {
        let at = |z: f64| swing_tail(dvec3(0.0, TAIL.1, z)).with_y(0.0);
        let steps = 200;
        let z = |k: i32| TAIL.0 - SWING.0 * f64::from(k) / f64::from(steps);
        let length: f64 = (0..steps).map(|k| at(z(k)).distance(at(z(k + 1)))).sum();
        assert!((length - SWING.0).abs() < 1e-3, "{length}");
    }
}
