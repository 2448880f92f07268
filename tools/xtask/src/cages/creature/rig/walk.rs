//! The walk: four beats to a step, left hind, left fore, right hind, right fore. Legs reach for their feet; the trunk sways over them, and neck,
//! tail, ears and wings follow a little later.

use std::f64::consts::TAU;

use glam::{DQuat, EulerRot, dvec3};

use super::super::super::skin::{Clip, Joint, Pose};
use super::gait::Gait;
use super::limb::Limb;
use super::skeleton::{SIDES, find, sided};

/// Length of a step of all four legs.
const SECONDS: f64 = 1.0;
/// Poses of a step.
const POSES: usize = 24;
/// How far the trunk is let down, so that legs can reach out.
const CROUCH: f64 = 0.035;

const FORELEGS: Gait = Gait { stride: 0.30, lift: 0.070, push: 0.34, land: -0.22 };
const HIND_LEGS: Gait = Gait { stride: 0.30, lift: 0.065, push: 0.50, land: -0.20 };

/// How far the ground passes during a step.
#[cfg(test)]
pub(super) const SPEED: f64 = FORELEGS.stride / super::gait::STANCE;

/// The step of each leg begins at this share of the whole: hind and fore, left and right.
const BEGINS: [[f64; 2]; 2] = [[0.0, 0.5], [0.25, 0.75]];

/// The walk on the spot.
pub(super) fn clip(joints: &[Joint]) -> Clip {
    let poses = (0..=POSES).map(|k| pose(joints, (k % POSES) as f64 / POSES as f64)).collect();
    Clip { name: "walk", seconds: SECONDS, poses }
}

/// The pose at a share of the step.
fn pose(joints: &[Joint], phase: f64) -> Pose {
    let mut pose = Pose::rest(joints.len());
    trunk(joints, &mut pose, phase);
    tail(joints, &mut pose, phase);
    for (side, name) in SIDES.iter().enumerate() {
        let mirror = if side == 0 { 1.0 } else { -1.0 };
        ear(joints, &mut pose, phase, name, mirror);
        wing(joints, &mut pose, phase, name, mirror);
        let legs = [
            (["thigh", "knee", "ankle", "hind_foot"], HIND_LEGS),
            (["shoulder", "elbow", "wrist", "forefoot"], FORELEGS),
        ];
        for (pair, (joint_names, gait)) in legs.into_iter().enumerate() {
            let limb = Limb::new(joints, joint_names, name);
            let step = gait.step(phase - BEGINS[pair][side]);
            // Feet are set nearer to the middle line than they hang at rest.
            let inward = -0.035 * mirror;
            let ball = limb.ball + dvec3(inward, step.height, step.along);
            limb.reach(joints, &mut pose, ball, step.pitch, 0.05 * mirror);
        }
    }
    pose
}

/// A wave of so many swings to a step, highest at `peak`, a share of the step.
fn wave(phase: f64, swings: f64, peak: f64) -> f64 {
    (TAU * swings * (phase - peak)).cos()
}

/// Pitch down, yaw to the left and roll to the right in radians, as a rotation.
fn turn(pitch: f64, yaw: f64, roll: f64) -> DQuat {
    DQuat::from_euler(EulerRot::YXZ, yaw, pitch, roll)
}

/// Hips, back, neck and head.
fn trunk(joints: &[Joint], pose: &mut Pose, phase: f64) {
    // The left hind leg stands from 0 to 0.66, the right one from 0.5 to 1.16: the hips hang to the side of the leg in the air.
    let over_left = wave(phase, 1.0, 0.30);
    let mut set = |name: &str, turn: DQuat| pose.turns[find(joints, name)] = turn;
    // The hip of the leg that reaches forward goes with it, and the shoulders turn the other way.
    let yaw_hips = -0.085 * wave(phase, 1.0, 0.02);
    let yaw_chest = 0.085 * wave(phase, 1.0, 0.27 + 0.5);
    set("hips", turn(0.022 * wave(phase, 2.0, 0.10), yaw_hips, 0.055 * over_left));
    set("back", turn(-0.015 * wave(phase, 2.0, 0.15), -0.6 * yaw_hips - 0.4 * yaw_chest, -0.045 * over_left));
    set(
        "chest",
        turn(-0.020 * wave(phase, 2.0, 0.20), -0.4 * yaw_hips - 0.6 * yaw_chest, -0.045 * wave(phase, 1.0, 0.40)),
    );
    set("neck1", turn(0.040 * wave(phase, 2.0, 0.28), 0.5 * yaw_chest, 0.02 * over_left));
    set("neck2", turn(0.045 * wave(phase, 2.0, 0.34) - 0.02, 0.5 * yaw_chest, 0.0));
    set("head", turn(-0.070 * wave(phase, 2.0, 0.36) - 0.06, 0.3 * yaw_chest, 0.045 * wave(phase, 1.0, 0.5)));
    let bob = 0.026 * wave(phase, 2.0, 0.32);
    pose.shift = dvec3(0.022 * over_left, bob - CROUCH, 0.008 * wave(phase, 2.0, 0.05));
}

/// A wave that runs down the tail, growing towards its end.
fn tail(joints: &[Joint], pose: &mut Pose, phase: f64) {
    for (k, lift) in LIFT.into_iter().enumerate() {
        let (share, name) = (k as f64 / (LIFT.len() - 1) as f64, format!("tail{}", k + 1));
        let late = 0.12 * k as f64;
        let yaw = (0.07 + 0.10 * share) * wave(phase, 1.0, 0.10 + late);
        let pitch = 0.02 * (1.0 + share) * wave(phase, 2.0, 0.2 + late) + lift;
        pose.turns[find(joints, &name)] = turn(pitch, yaw, 0.0);
    }
}

/// How the tail is carried: up from the root, then level.
const LIFT: [f64; 6] = [0.10, 0.16, 0.14, 0.04, -0.06, -0.10];

fn ear(joints: &[Joint], pose: &mut Pose, phase: f64, side: &str, mirror: f64) {
    let flap = 0.10 * wave(phase, 2.0, 0.50);
    let sway = 0.05 * wave(phase, 1.0, 0.35);
    pose.turns[find(joints, &sided("ear1", side))] = turn(0.0, 0.06 * mirror, 0.6 * flap * mirror + sway);
    pose.turns[find(joints, &sided("ear2", side))] =
        turn(0.0, 0.10 * mirror * wave(phase, 2.0, 0.58), flap * mirror + sway);
}

fn wing(joints: &[Joint], pose: &mut Pose, phase: f64, side: &str, mirror: f64) {
    let beat = 0.055 * wave(phase, 2.0, 0.45);
    let late = 0.085 * wave(phase, 2.0, 0.56);
    pose.turns[find(joints, &sided("wing1", side))] = turn(0.0, 0.0, (beat - 0.03) * mirror);
    pose.turns[find(joints, &sided("wing2", side))] = turn(0.0, -0.3 * late * mirror, late * mirror);
}
