//! Where a foot is in the course of a step.

/// How a pair of legs walks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gait {
    /// Length of the ground that passes under the foot while it stands.
    pub(super) stride: f64,
    /// How high the foot is lifted.
    pub(super) lift: f64,
    /// Pitch of the foot in radians when it leaves the ground.
    pub(super) push: f64,
    /// Pitch of the foot in radians shortly before it lands, toes up.
    pub(super) land: f64,
}

/// The share of a step for which a foot stands: three feet at a time, or nearly.
pub(super) const STANCE: f64 = 0.66;

/// A foot relative to where it stands in the middle of its stance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// Forward.
    pub(super) along: f64,
    pub(super) height: f64,
    /// About the ball of the foot in radians, positive with the heel up.
    pub(super) pitch: f64,
}

/// How far the toes reach before the ball of the foot, and the heel behind it.
const TOES: f64 = 0.11;
const HEEL: f64 = 0.30;

impl Step {
    /// The foot so high over the ground that neither toes nor heel sink into it.
    fn new(along: f64, height: f64, pitch: f64) -> Self {
        let sunk = if pitch > 0.0 { TOES * pitch.sin() } else { -HEEL * pitch.sin() };
        Self { along, height: height + sunk, pitch }
    }
}

impl Gait {
    /// The foot at a share of its step from 0 to 1, which begins when it lands. While it stands it moves back with the ground.
    pub(super) fn step(&self, phase: f64) -> Step {
        let phase = phase.rem_euclid(1.0);
        if phase < STANCE {
            let share = phase / STANCE;
            return Step::new(self.stride * (0.5 - share), 0.0, self.push * ease(0.62, 1.0, share));
        }
        let share = (phase - STANCE) / (1.0 - STANCE);
        let (rise, fall) = (ease(0.0, 0.45, share), ease(0.35, 1.0, share));
        let swing = self.push * (1.0 + 0.25 * bell(0.0, 0.5, share)) * (1.0 - ease(0.1, 0.7, share));
        Step::new(self.swing(share), self.lift * rise * (1.0 - fall), swing + self.land * bell(0.5, 1.0, share))
    }

    /// The way forward through the air: a cubic that leaves the ground and meets it again at the speed of the ground.
    fn swing(&self, share: f64) -> f64 {
        let slope = -(1.0 - STANCE) / STANCE;
        let (t, t2, t3) = (share, share * share, share * share * share);
        let rise = -2.0 * t3 + 3.0 * t2;
        let ends = (t3 - 2.0 * t2 + t) + (t3 - t2);
        self.stride * (rise - 0.5 + slope * ends)
    }
}

/// From 0 to 1 between two places, with flat ends.
fn ease(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// From 0 up to 1 and back between two places.
fn bell(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    16.0 * t * t * (1.0 - t) * (1.0 - t)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GAIT: Gait = Gait { stride: 0.3, lift: 0.1, push: 0.6, land: -0.2 };

    #[test]
    fn steps_have_no_jumps() {
        let steps: Vec<Step> = (0..=2000).map(|k| GAIT.step(f64::from(k) / 1000.0)).collect();
        for pair in steps.windows(2) {
            assert!((pair[1].along - pair[0].along).abs() < 2e-3 && (pair[1].height - pair[0].height).abs() < 2e-3);
            assert!((pair[1].pitch - pair[0].pitch).abs() < 2e-2);
        }
        // Nor has its speed, where the foot lands and leaves.
        for at in [0.0, STANCE] {
            let along = |offset: f64| GAIT.step(at + offset).along;
            assert!((along(1e-4) - 2.0 * along(0.0) + along(-1e-4)).abs() < 1e-6, "{at}");
        }
    }

    #[test]
    fn a_standing_foot_moves_with_the_ground() {
        let speed = -GAIT.stride / STANCE;
        for k in 0..=10 {
            let phase = STANCE * f64::from(k) / 10.0 * 0.999;
            let step = GAIT.step(phase);
            assert!(
                (step.along - (0.5 * GAIT.stride + speed * phase)).abs() < 1e-12 && step.height <= TOES * GAIT.push
            );
        }
    }
}
