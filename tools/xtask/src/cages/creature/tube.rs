//! Tubes that grow out of a rim: legs, horns, ears, toes, eyelids.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use super::half::{Half, Sheet, SheetId};

/// One ring of a tube.
#[derive(Clone, Copy)]
pub(super) struct Ring {
    pub(super) center: DVec3,
    pub(super) radius: f64,
    /// The ring's offsets are scaled by `squash.1` along the unit direction `squash.0`.
    pub(super) squash: (DVec3, f64),
}

impl Ring {
    /// A circular ring.
    pub(super) fn round(center: DVec3, radius: f64) -> Self {
        Self { center, radius, squash: (DVec3::Y, 1.0) }
    }

    /// The ring scaled along a direction.
    pub(super) fn squashed(self, direction: DVec3, scale: f64) -> Self {
        Self { squash: (direction.normalize(), scale), ..self }
    }

    fn point(&self, offset: DVec3) -> DVec3 {
        let (direction, scale) = self.squash;
        self.center + offset + (scale - 1.0) * offset.dot(direction) * direction
    }
}

/// Which way rings are turned about the tube's axis.
#[derive(Clone, Copy)]
pub(super) enum Turn {
    /// As the rim has it.
    Free,
    /// The middle of a side points this way.
    Side(DVec3),
    /// A vertex points this way.
    Vertex(DVec3),
}

/// How a tube leaves its rim.
pub(super) struct TubeDesc {
    /// Direction in which the tube leaves the rim.
    pub(super) root: DVec3,
    /// Softness of the new vertices: of the first ring, and of all others.
    pub(super) softness: [f64; 2],
    /// Turns the last ring, and the others gradually.
    pub(super) turn: Turn,
}

/// Grows a tube from a closed rim through `rings`; the sheet's row 0 is the rim.
pub(super) fn tube(half: &mut Half, rim: &[usize], rings: &[Ring], desc: &TubeDesc) -> SheetId {
    let origin = half.middle(rim);
    let count = rim.len();
    let mut axis = desc.root.normalize();
    let mut spoke = first_spoke(half, rim, origin, axis);
    let mut frames = Vec::new();
    for (index, ring) in rings.iter().enumerate() {
        let before = if index == 0 { origin } else { rings[index - 1].center };
        let after = rings.get(index + 1).map_or(ring.center, |next| next.center);
        let next = (after - before).normalize();
        spoke = DQuat::from_rotation_arc(axis, next) * spoke;
        axis = next;
        frames.push((axis, spoke));
    }
    let turn = desc.turn.angle(frames[frames.len() - 1], count);
    let mut rows = vec![rim.to_vec()];
    for (index, (ring, (axis, spoke))) in rings.iter().zip(frames).enumerate() {
        let share = turn * (index + 1) as f64 / rings.len() as f64;
        let offset = |k: usize| DQuat::from_axis_angle(axis, share + TAU * k as f64 / count as f64) * spoke;
        let points: Vec<DVec3> = (0..count).map(|k| ring.point(ring.radius * offset(k))).collect();
        rows.push(half.add(points, desc.softness[usize::from(index > 0)]));
    }
    half.add_sheet(Sheet { rows, closed: true, midline: false })
}

/// Unit direction of vertex 0 of evenly spread spokes that fit the rim best.
pub(super) fn first_spoke(half: &Half, rim: &[usize], origin: DVec3, axis: DVec3) -> DVec3 {
    let unturned = |(k, &vertex): (usize, &usize)| {
        let offset = (half.points[vertex] - origin).reject_from_normalized(axis);
        DQuat::from_axis_angle(axis, -TAU * k as f64 / rim.len() as f64) * offset.normalize()
    };
    rim.iter().enumerate().map(unturned).sum::<DVec3>().normalize()
}

impl Turn {
    /// The smallest angle about the axis that does it, for a ring of `count` vertices of which one lies on the spoke.
    fn angle(self, (axis, spoke): (DVec3, DVec3), count: usize) -> f64 {
        let step = TAU / count as f64;
        let (front, shift) = match self {
            Self::Free => return 0.0,
            Self::Side(front) => (front, 0.5 * step),
            Self::Vertex(front) => (front, 0.0),
        };
        let front = front.reject_from_normalized(axis);
        let angle = spoke.cross(front).dot(axis).atan2(spoke.dot(front));
        let past = (angle - shift).rem_euclid(step);
        if past > 0.5 * step { past - step } else { past }
    }
}
