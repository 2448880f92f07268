//! The dragon's skeleton, the weights of its vertices, and its walk.

mod gait;
mod limb;
mod skeleton;
mod walk;
mod weights;

use super::super::mesh::Mesh;
use super::super::skin::Skin;
use super::half::Half;
use super::mirror::Source;

/// The skin of the whole dragon.
pub(super) fn skin(half: &Half, mesh: &Mesh, sources: &[Source]) -> Skin {
    let joints = skeleton::joints();
    let weights = weights::weights(half, mesh, sources, &joints);
    let clip = walk::clip(&joints);
    Skin { joints, weights, clip }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, dvec3};

    use super::super::super::skin::Pose;
    use super::super::{mirror, symmetric};
    use super::*;

    fn whole() -> (Mesh, Skin) {
        let half = symmetric();
        let (mesh, sources) = mirror::whole(&half);
        let skin = skin(&half, &mesh, &sources);
        (mesh, skin)
    }

    /// Linear blend skinning.
    fn moved(mesh: &Mesh, skin: &Skin, pose: &Pose) -> Vec<DVec3> {
        let frames: Vec<_> = (0..skin.joints.len()).map(|joint| pose.frame(&skin.joints, joint)).collect();
        let place = |joint: usize, p: DVec3| frames[joint].0 + frames[joint].1 * (p - skin.joints[joint].place);
        let vertex = |(v, p): (usize, &DVec3)| skin.weights[v].iter().map(|&(joint, w)| w * place(joint, *p)).sum();
        mesh.points.iter().enumerate().map(vertex).collect()
    }

    #[test]
    fn every_vertex_has_few_joints_and_sides_mirror_each_other() {
        let (mesh, skin) = whole();
        let other = |joint: usize| {
            let name = &skin.joints[joint].name;
            let swapped =
                if name.ends_with("left") { name.replace("left", "right") } else { name.replace("right", "left") };
            skeleton::find(&skin.joints, &swapped)
        };
        let key = |p: DVec3| (p * 1e9).round().to_array().map(|x| x as i64);
        let at: std::collections::BTreeMap<_, _> = mesh.points.iter().enumerate().map(|(v, p)| (key(*p), v)).collect();
        for (v, weights) in skin.weights.iter().enumerate() {
            assert!((1..=4).contains(&weights.len()) && (weights.iter().map(|w| w.1).sum::<f64>() - 1.0).abs() < 1e-12);
            let image = &skin.weights[at[&key(mesh.points[v] * dvec3(-1.0, 1.0, 1.0))]];
            // Where two are nearly the same, either may come first, or be left out.
            for &(joint, weight) in weights.iter().filter(|(_, weight)| *weight > 0.1) {
                assert!(
                    image.iter().any(|&(j, w)| j == other(joint) && (w - weight).abs() < 0.05),
                    "{weights:?} {image:?}"
                );
            }
        }
    }

    #[test]
    fn no_edge_leads_from_one_joint_to_another() {
        let (mesh, skin) = whole();
        let weight = |v: usize, joint: usize| skin.weights[v].iter().find(|w| w.0 == joint).map_or(0.0, |w| w.1);
        for (a, b) in mesh.faces.iter().flat_map(|face| super::super::super::mesh::corner_pairs(face)) {
            let change: f64 = (0..skin.joints.len()).map(|joint| (weight(a, joint) - weight(b, joint)).abs()).sum();
            assert!(change < 1.6, "{change} from {} to {}", mesh.points[a], mesh.points[b]);
        }
    }

    /// Feet stand on the ground for most of a step and go back with it at one speed; no vertex comes far below.
    #[test]
    fn feet_do_not_slide_nor_sink() {
        let (mesh, skin) = whole();
        let poses = &skin.clip.poses;
        let frames: Vec<Vec<DVec3>> = poses.iter().map(|pose| moved(&mesh, &skin, pose)).collect();
        let ground = -walk::SPEED / (poses.len() - 1) as f64;
        for foot in ["wrist.left", "wrist.right", "ankle.left", "ankle.right"] {
            let joint = skeleton::find(&skin.joints, foot);
            let soles =
                (0..mesh.points.len()).filter(|&v| skin.weights[v][0] == (joint, 1.0) && mesh.points[v].y < 0.03);
            let soles: Vec<usize> = soles.collect();
            assert!(soles.len() >= 4, "{foot} has {} vertices", soles.len());
            let (mut standing, mut slid) = (0, 0.0f64);
            for (k, pair) in frames.windows(2).enumerate() {
                let height = |frame: &Vec<DVec3>| {
                    soles.iter().map(|&v| (frame[v].y - mesh.points[v].y).abs()).fold(0.0, f64::max)
                };
                if height(&pair[0]) < 2e-3 && height(&pair[1]) < 2e-3 {
                    standing += 1;
                    let step = |&v: &usize| (pair[1][v] - pair[0][v] - DVec3::Z * ground).length();
                    slid = soles.iter().map(step).fold(slid, f64::max);
                }
                assert!(frames[k].iter().all(|p| p.y > -0.035), "sinks in frame {k}");
            }
            assert!(
                standing >= 7 && slid < 2e-3,
                "{foot} stands in {standing} frames and slides by {slid} in one of them"
            );
        }
    }

    #[test]
    fn the_walk_loops_and_has_no_jumps() {
        let (mesh, skin) = whole();
        let frames: Vec<Vec<DVec3>> = skin.clip.poses.iter().map(|pose| moved(&mesh, &skin, pose)).collect();
        assert_eq!(frames.first(), frames.last());
        for pair in frames.windows(2) {
            let furthest = pair[0].iter().zip(&pair[1]).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            assert!(furthest < 0.12, "{furthest}");
        }
    }
}
