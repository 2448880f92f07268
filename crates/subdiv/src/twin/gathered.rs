//! Twins of shaders/records/edge_gathered.comp and patch_gathered.comp.

use glam::Vec3;
use osculate_surface::gregory::CrossEnd;

use super::{EdgeRecord, THIRD};
use crate::{FanRecord, GatheredEdge, GatheredPatch, SurfacePlan};

/// What an edge takes from the fan of one of its ends.
struct Spoke {
    position: Vec3,
    edge_point: Vec3,
    cross_inner: Vec3,
    cross_end: Vec3,
}

fn spoke(vectors: &[Vec3], fan: &FanRecord, edge: u32) -> Spoke {
    let at = |i: u32| vectors[(fan.first + i) as usize];
    let cross = 1 + fan.edges + 2 * edge;
    Spoke { position: at(0), edge_point: at(1 + edge), cross_inner: at(cross), cross_end: at(cross + 1) }
}

/// shaders/records/edge_gathered.comp.
pub(super) fn edge(plan: &SurfacePlan, vectors: &[Vec3], source: &GatheredEdge) -> EdgeRecord {
    let fans = source.fan.map(|fan| &plan.gathers.fans[fan as usize]);
    let (a, b) = (spoke(vectors, fans[0], source.edge[0]), spoke(vectors, fans[1], source.edge[1]));
    let c = [a.position, a.edge_point, b.edge_point, b.position];
    let mut d = [a.cross_end, a.cross_inner, -b.cross_inner, -b.cross_end];
    let ends = fans.map(|fan| fan.cross_end);
    if ends[0] == CrossEnd::Opposed.number() {
        (d[1], d[2]) = (d[1] + 2.0 * (c[2] - c[1]), d[2] + (c[3] - c[2]));
    }
    if ends[1] == CrossEnd::Opposed.number() {
        (d[1], d[2]) = (d[1] + (c[0] - c[1]), d[2] + 2.0 * (c[1] - c[2]));
    }
    if ends[0] != CrossEnd::Plain.number() {
        d = [3.0 * d[1], d[1] + d[2], d[2] + d[3] * THIRD, d[3]];
    }
    if ends[1] != CrossEnd::Plain.number() {
        d = [d[0], d[1] + d[0] * THIRD, d[2] + d[1], 3.0 * d[2]];
    }
    [c[0], c[1], c[2], c[3], d[0], d[1], d[2], d[3]]
}

/// shaders/records/patch_gathered.comp: five points for each corner.
pub(super) fn control_points(plan: &SurfacePlan, vectors: &[Vec3], source: &GatheredPatch) -> Vec<Vec3> {
    let sides = source.sides as usize;
    let fan = |i: usize| &plan.gathers.fans[source.fan[i] as usize];
    let plus = |i: usize| spoke(vectors, fan(i), source.edge[i]);
    let minus = |i: usize| spoke(vectors, fan(i), (source.edge[i] + 1) % fan(i).edges);
    let degree = if sides == 3 { 0.25 } else { THIRD };
    let face_point = |own: &Spoke, other: &Spoke, own_cosine: f32, other_cosine: f32, left: f32| {
        let along =
            other_cosine * (own.position - own.edge_point) + (2.0 * own_cosine) * (other.edge_point - own.edge_point);
        own.edge_point + (along + left * own.cross_inner) * degree
    };
    let corner = |i: usize| {
        let (next, previous) = ((i + 1) % sides, (i + sides - 1) % sides);
        let (own_plus, own_minus) = (plus(i), minus(i));
        let f_plus = face_point(&own_plus, &minus(next), fan(i).cosine, fan(next).cosine, 1.0);
        let f_minus = face_point(&own_minus, &plus(previous), fan(i).cosine, fan(previous).cosine, -1.0);
        [own_plus.position, own_plus.edge_point, own_minus.edge_point, f_plus, f_minus]
    };
    (0..sides).flat_map(corner).collect()
}
