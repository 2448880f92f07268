//! How much each joint moves each vertex: by place on the part first, then smoothed over the mesh where parts meet.

use std::collections::BTreeSet;

use glam::DVec3;

use super::super::super::mesh::{Mesh, corner_pairs};
use super::super::super::skin::Joint;
use super::super::half::{Half, Part};
use super::super::mirror::Source;
use super::skeleton::{SIDES, chains, find, sided};

/// Rounds of smoothing.
const ROUNDS: usize = 8;
/// Joints that may move one vertex.
const MOST: usize = 4;
/// Rows of the loft over which a vertex passes from one joint to the next, on either side of the joint.
const ROWS: f64 = 1.15;

/// The weights of all vertices of the whole, the largest first, with the sum 1.
pub(super) fn weights(half: &Half, mesh: &Mesh, sources: &[Source], joints: &[Joint]) -> Vec<Vec<(usize, f64)>> {
    let rigger = Rigger { half, joints };
    let mut table: Vec<Vec<f64>> = sources.iter().map(|&source| rigger.by_place(source)).collect();
    let softness: Vec<f64> = sources.iter().map(|&(vertex, _)| rigger.softness(vertex)).collect();
    let neighbours = neighbours(mesh);
    table = follow_trunk(&table, half, mesh, sources);
    for _ in 0..ROUNDS {
        table = smoothed(&table, &softness, &neighbours);
    }
    table = follow_trunk(&table, half, mesh, sources);
    table.iter().map(|row| strongest(row)).collect()
}

struct Rigger<'a> {
    half: &'a Half,
    joints: &'a [Joint],
}

impl Rigger<'_> {
    /// The weights of a vertex before smoothing, one for each joint.
    fn by_place(&self, (vertex, mirrored): Source) -> Vec<f64> {
        let (point, side) = (self.half.points[vertex], SIDES[usize::from(mirrored)]);
        // What lies on the plane of symmetry has no side.
        match self.half.parts[vertex] {
            // Spines get those of the loft afterwards.
            Part::Trunk | Part::Ridge => self.along_trunk(self.row(vertex)),
            Part::Head => self.chain("head", side, &[], 0.0),
            Part::Ear => {
                let along = point.distance(DVec3::new(0.36, 1.69, 0.79));
                self.chain("head", side, &[("ear1", 0.0, 0.30), ("ear2", 0.20, 0.50)], along)
            }
            Part::Wing => {
                let along = point.distance(DVec3::new(0.25, 1.05, 0.04));
                self.chain("chest", side, &[("wing1", 0.02, 0.34), ("wing2", 0.40, 0.95)], along)
            }
            Part::Foreleg => {
                let leg = [("shoulder", -0.74, -0.50), ("elbow", -0.52, -0.21), ("wrist", -0.26, -0.045)];
                self.leg("chest", side, &leg, point)
            }
            Part::HindLeg => {
                let leg = [("thigh", -0.78, -0.50), ("knee", -0.52, -0.21), ("ankle", -0.26, -0.045)];
                self.leg("hips", side, &leg, point)
            }
        }
    }

    /// Legs are weighted by height, and toes go with the foot.
    fn leg(&self, root: &str, side: &str, steps: &[(&str, f64, f64)], point: DVec3) -> Vec<f64> {
        self.chain(root, side, steps, -point.y)
    }

    /// Hands weight on from joint to joint: each takes over between two places along the way.
    fn chain(&self, root: &str, side: &str, steps: &[(&str, f64, f64)], along: f64) -> Vec<f64> {
        let mut weights = vec![0.0; self.joints.len()];
        let mut holder = find(self.joints, root);
        weights[holder] = 1.0;
        for &(name, start, end) in steps {
            let share = smoothstep(start, end, along);
            let next = find(self.joints, &sided(name, side));
            weights[next] = weights[holder] * share;
            weights[holder] *= 1.0 - share;
            holder = next;
        }
        weights
    }

    /// Weights at a row of the loft.
    fn along_trunk(&self, row: f64) -> Vec<f64> {
        let mut weights = vec![0.0; self.joints.len()];
        let hips = find(self.joints, "hips");
        weights[hips] = 1.0;
        for (chain, direction) in chains().iter().zip([-1.0, 1.0]) {
            let mut holder = hips;
            for &(name, at) in chain {
                let share = smoothstep(-ROWS, ROWS, direction * (row - at));
                let next = find(self.joints, name);
                weights[next] = weights[holder] * share;
                weights[holder] *= 1.0 - share;
                holder = next;
            }
        }
        weights
    }

    /// The row of the loft that a vertex lies on; those of the caps at nose and tail go with the ends.
    fn row(&self, vertex: usize) -> f64 {
        let rows = &self.half.sheets[0].rows;
        let last = rows.len() - 1;
        let end = if self.half.points[vertex].z > 0.0 { 0 } else { last };
        rows.iter().position(|row| row.contains(&vertex)).unwrap_or(end) as f64
    }

    /// How far smoothing moves a vertex's weights towards those around: not at all where bone is near the skin.
    fn softness(&self, vertex: usize) -> f64 {
        let point = self.half.points[vertex];
        match self.half.parts[vertex] {
            Part::Trunk if self.row(vertex) < 9.0 => 0.0,
            Part::Trunk => 0.5,
            Part::Head | Part::Ear => 0.0,
            Part::Wing => 0.3,
            Part::Ridge => 0.0,
            Part::Foreleg | Part::HindLeg => 0.5 * smoothstep(0.15, 0.45, point.y),
        }
    }
}

/// Every row moved towards the mean of its neighbours' rows.
fn smoothed(table: &[Vec<f64>], softness: &[f64], neighbours: &[BTreeSet<usize>]) -> Vec<Vec<f64>> {
    let row = |v: usize| {
        let around = &neighbours[v];
        let mean = |joint: usize| around.iter().map(|&other| table[other][joint]).sum::<f64>() / around.len() as f64;
        table[v].iter().enumerate().map(|(joint, own)| own + softness[v] * (mean(joint) - own)).collect()
    };
    (0..table.len()).map(row).collect()
}

/// Gives the spines along the back, which are stiff, the weights of the loft below them, the nearer the more.
fn follow_trunk(table: &[Vec<f64>], half: &Half, mesh: &Mesh, sources: &[Source]) -> Vec<Vec<f64>> {
    let part = |v: usize| half.parts[sources[v].0];
    let back: Vec<usize> = (0..sources.len()).filter(|&v| part(v) == Part::Trunk && mesh.points[v].x == 0.0).collect();
    let below = |v: usize| {
        let nearness = |other: usize| mesh.points[other].distance_squared(mesh.points[v]).powi(-2);
        let total: f64 = back.iter().map(|&other| nearness(other)).sum();
        let weight =
            |joint: usize| back.iter().map(|&other| nearness(other) * table[other][joint]).sum::<f64>() / total;
        (0..table[v].len()).map(weight).collect()
    };
    (0..table.len()).map(|v| if part(v) == Part::Ridge { below(v) } else { table[v].clone() }).collect()
}

/// The largest weights of a row, with the sum 1.
fn strongest(row: &[f64]) -> Vec<(usize, f64)> {
    let mut found: Vec<(usize, f64)> = row.iter().copied().enumerate().filter(|(_, weight)| *weight > 0.005).collect();
    found.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    found.truncate(MOST);
    let sum: f64 = found.iter().map(|(_, weight)| weight).sum();
    found.iter_mut().for_each(|(_, weight)| *weight /= sum);
    found
}

fn neighbours(mesh: &Mesh) -> Vec<BTreeSet<usize>> {
    let mut neighbours = vec![BTreeSet::new(); mesh.points.len()];
    for (a, b) in mesh.faces.iter().flat_map(|face| corner_pairs(face)) {
        neighbours[a].insert(b);
        neighbours[b].insert(a);
    }
    neighbours
}

fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
