//! Shared by the integration tests: a star-shaped mesh around one vertex and its Catmull-Clark limit, found by nothing
//! but refinement.

#![allow(dead_code, reason = "each test binary uses a part of it")]

use glam::DVec3;
use osculate_surface::NetKind;
use osculate_surface::{bspline, gregory};

/// Rings of vertices around the centre.
const RINGS: i64 = 3;

/// A vertex V with `sectors` quads around it, three rings deep: regular but for V.
///
/// Sector i is a grid: its point (a, b) lies a steps along spoke i and b steps along spoke i+1. An open star has spokes
/// 0..=sectors and a boundary along the first and last.
#[derive(Clone)]
pub(crate) struct Star {
    sectors: i64,
    open: bool,
    /// Whether the points of all quads are known, not of one quad alone.
    whole: bool,
    centre: DVec3,
    /// Points (a, b) with 1 <= a <= 3, 0 <= b <= 3 of each sector; the last sector of an open star has b = 0 only.
    points: Vec<[[DVec3; 4]; 3]>,
}

impl Star {
    /// A star whose points are `place(sector, a, b)`, the centre being `place(0, 0, 0)`.
    pub(crate) fn new(kind: NetKind, mut place: impl FnMut(i64, i64, i64) -> DVec3) -> Self {
        let (sectors, open) = match kind {
            NetKind::Interior { valence } => (i64::from(valence), false),
            NetKind::Crease { faces, .. } => (i64::from(faces), true),
            NetKind::Regular => (4, false),
        };
        let centre = place(0, 0, 0);
        let grids = sectors + i64::from(open);
        let points = (0..grids)
            .map(|i| {
                std::array::from_fn(|a| {
                    std::array::from_fn(|b| {
                        if i == sectors && b > 0 { DVec3::ZERO } else { place(i, a as i64 + 1, b as i64) }
                    })
                })
            })
            .collect();
        Self { sectors, open, whole: true, centre, points }
    }

    /// A star over a circle (open: a half-plane, or a quarter for one face) with height `z(x, y)` and every coordinate
    /// moved by up to `jitter`.
    pub(crate) fn over_plane(kind: NetKind, z: impl Fn(f64, f64) -> f64, jitter: f64, seed: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(2).wrapping_add(1));
        let step = match kind {
            NetKind::Interior { valence } => std::f64::consts::TAU / f64::from(valence),
            NetKind::Crease { faces: 1, .. } | NetKind::Regular => std::f64::consts::FRAC_PI_2,
            NetKind::Crease { faces, .. } => std::f64::consts::PI / f64::from(faces),
        };
        Self::new(kind, |i, a, b| {
            let spoke = |i: i64, r: i64| DVec3::new((i as f64 * step).cos(), (i as f64 * step).sin(), 0.0) * r as f64;
            // The diagonals at the radius of a regular net, so that narrow sectors do not bulge.
            let (along, skew) = (spoke(i, a) + spoke(i + 1, b), (a.min(b) as f64) * 2.0_f64.sqrt());
            let middle = spoke(i, 1) + spoke(i + 1, 1);
            let flat = along + middle.normalize_or_zero() * (skew - a.min(b) as f64 * middle.length());
            let mut noise = || (random.next() - 0.5) * 2.0 * jitter;
            flat + DVec3::new(noise(), noise(), noise() + z(flat.x, flat.y))
        })
    }

    /// The star that holds the points of one net; points the net does not name are zero.
    pub(crate) fn from_net(kind: NetKind, net: &[DVec3]) -> Self {
        let mut star = Self::new(kind, |_, _, _| DVec3::ZERO);
        star.whole = false;
        for (at, &p) in net_order(kind).iter().zip(net) {
            *star.slot(at.0, at.1, at.2) = p;
        }
        star
    }

    /// The net of quad `i` of the star, in the order of `kind`.
    pub(crate) fn net(&self, kind: NetKind, i: i64) -> Vec<DVec3> {
        match kind {
            NetKind::Interior { .. } => net_order(kind).iter().map(|&(s, a, b)| self.at(s + i, a, b)).collect(),
            NetKind::Crease { .. } => net_order(kind).iter().map(|&(s, a, b)| self.at(s, a, b)).collect(),
            NetKind::Regular => self.regular_net(i, 0, 0),
        }
    }

    /// The 16-point net of the quad with lower corner (a, b) of sector i, with reflected points beyond the boundary.
    pub(crate) fn regular_net(&self, i: i64, a: i64, b: i64) -> Vec<DVec3> {
        (-1..=2).flat_map(|y| (-1..=2).map(move |x| (x, y))).map(|(x, y)| self.at(i, a + x, b + y)).collect()
    }

    /// Point (a, b) of sector i; negative coordinates reach into the neighbouring sectors or beyond the boundary.
    pub(crate) fn at(&self, i: i64, a: i64, b: i64) -> DVec3 {
        if b < 0 && self.open && i == 0 {
            return 2.0 * self.at(i, a, 0) - self.at(i, a, -b);
        }
        if a < 0 && self.open && i + 1 == self.sectors {
            return 2.0 * self.at(i, 0, b) - self.at(i, -a, b);
        }
        match self.canonical(i, a, b) {
            None => self.centre,
            Some((i, a, b)) => self.points[i][a][b],
        }
    }

    fn slot(&mut self, i: i64, a: i64, b: i64) -> &mut DVec3 {
        match self.canonical(i, a, b) {
            None => &mut self.centre,
            Some((i, a, b)) => &mut self.points[i][a][b],
        }
    }

    /// Where point (a, b) of sector i is stored: `None` for the centre.
    fn canonical(&self, i: i64, a: i64, b: i64) -> Option<(usize, usize, usize)> {
        let (i, a, b) = match (a, b) {
            (0, 0) => return None,
            (_, b) if b < 0 => return self.canonical(i - 1, -b, a),
            (a, b) if a < 0 => return self.canonical(i + 1, b, -a),
            (0, b) => (i + 1, b, 0),
            inside => (i, inside.0, inside.1),
        };
        let i = if self.open { i } else { i.rem_euclid(self.sectors) };
        assert!((1..=RINGS).contains(&a) && b <= RINGS && i >= 0, "no point ({a}, {b}) in sector {i}");
        Some((i as usize, a as usize - 1, b as usize))
    }

    /// One Catmull-Clark step, keeping three rings.
    pub(crate) fn refined(&self) -> Self {
        let kind = if self.open {
            NetKind::Crease { faces: self.sectors as u32, quad: 0 }
        } else {
            NetKind::Interior { valence: self.sectors as u32 }
        };
        Self::new(kind, |i, a, b| if (a, b) == (0, 0) { self.refined_centre() } else { self.refined_point(i, a, b) })
    }

    fn refined_centre(&self) -> DVec3 {
        let n = self.sectors as f64;
        if self.open {
            return (self.at(0, 1, 0) + 6.0 * self.centre + self.at(self.sectors, 1, 0)) / 8.0;
        }
        let (edges, faces) = (0..self.sectors).fold((DVec3::ZERO, DVec3::ZERO), |(e, f), i| {
            let corners = self.centre + self.at(i, 1, 0) + self.at(i, 1, 1) + self.at(i + 1, 1, 0);
            (e + self.at(i, 1, 0), f + corners / 4.0)
        });
        ((n - 2.0) * self.centre + (edges + faces) / n) / n
    }

    /// The refined grid point (a, b) of sector i by the face, edge and vertex rules of a regular grid.
    fn refined_point(&self, i: i64, a: i64, b: i64) -> DVec3 {
        // The sector of a boundary spoke beyond the last quad is seen from that quad.
        let (i, a, b) = if self.open && i == self.sectors { (i - 1, b, a) } else { (i, a, b) };
        let taps = |x: i64, sharp: bool| -> Vec<(i64, f64)> {
            if x == 0 && sharp {
                vec![(0, 1.0)] // points of the boundary refine among themselves
            } else if x % 2 == 0 {
                vec![(x / 2 - 1, 0.125), (x / 2, 0.75), (x / 2 + 1, 0.125)]
            } else {
                vec![(x / 2, 0.5), (x / 2 + 1, 0.5)]
            }
        };
        let mut sum = DVec3::ZERO;
        for (x, p) in taps(a, self.open && i + 1 == self.sectors) {
            for (y, q) in taps(b, self.open && i == 0) {
                sum += p * q * self.at(i, x, y);
            }
        }
        sum
    }

    /// Limit position and derivatives of quad i at (u, v) other than (0, 0).
    pub(crate) fn limit(&self, i: i64, u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
        let (mut star, mut scale, mut u, mut v) = (self.clone(), 1.0, u, v);
        assert!(u.max(v) > 0.0, "V itself has no derivatives");
        while u.max(v) < 1.0 {
            (star, scale, u, v) = (star.refined(), 2.0 * scale, 2.0 * u, 2.0 * v);
        }
        let (a, b) = (u.floor().min(1.0), v.floor().min(1.0));
        let net = star.regular_net(i, a as i64, b as i64);
        let (p, du, dv) = regular_limit(&net, u - a, v - b);
        (p, du * scale, dv * scale)
    }

    /// The limit position of V.
    pub(crate) fn limit_centre(&self) -> DVec3 {
        let mut star = self.clone();
        for _ in 0..60 {
            star = star.refined();
        }
        star.centre
    }

    /// The star moved by `-origin` and scaled.
    pub(crate) fn normalized(&self, origin: DVec3, scale: f64) -> Self {
        let mut out = self.clone();
        out.centre = (out.centre - origin) * scale;
        for p in out.points.iter_mut().flatten().flatten() {
            *p = (*p - origin) * scale;
        }
        out
    }

    /// The limit surface about quad i at (u, v), which may reach into the quads beside it.
    pub(crate) fn limit_across(&self, i: i64, u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
        let (first, last) = (self.open && i == 0, self.open && i + 1 == self.sectors);
        match (u < 0.0, v < 0.0) {
            (true, _) if !last => {
                let (p, a, b) = self.limit_across(i + 1, v, -u);
                (p, -b, a)
            }
            (_, true) if !first => {
                let (p, a, b) = self.limit_across(i - 1, -v, u);
                (p, b, -a)
            }
            _ => self.limit(i, u.clamp(0.0, 1.0), v.clamp(if u > 1e-9 { 0.0 } else { 1e-9 }, 1.0)),
        }
    }

    /// The largest distance of the Gregory patch of quad i to the limit surface on a grid of samples.
    pub(crate) fn patch_distance(&self, kind: NetKind, i: i64, samples: u32) -> f64 {
        let points = gregory::gregory2(kind).apply(&self.net(kind, i)).try_into().expect("20 rows");
        let mut worst = 0.0_f64;
        for (a, b) in (0..=samples).flat_map(|a| (0..=samples).map(move |b| (a, b))).filter(|&at| at != (0, 0)) {
            let (u, v) = (f64::from(a) / f64::from(samples), f64::from(b) / f64::from(samples));
            let point = gregory::evaluate(&points, u, v).position;
            worst = worst.max(self.distance(point, i, u, v));
        }
        worst
    }

    /// Distance of `point` to the limit surface, searched from (u, v) of quad i by Gauss-Newton steps: along the normal
    /// of the foot, which is searched across spokes (where their quads are known) but not beyond the outer sides.
    pub(crate) fn distance(&self, point: DVec3, i: i64, u: f64, v: f64) -> f64 {
        let (mut u, mut v) = (u, v);
        let lowest = if self.whole { -1.0 } else { 0.0 };
        let mut best = f64::INFINITY;
        for _ in 0..12 {
            let (p, du, dv) = self.limit_across(i, u, v);
            let gap = point - p;
            best = best.min(gap.length());
            let (e, f, g) = (du.dot(du), du.dot(dv), dv.dot(dv));
            let det = e * g - f * f;
            if det <= 1e-12 * e * g {
                break;
            }
            let (x, y) = (gap.dot(du), gap.dot(dv));
            let (su, sv) = ((g * x - f * y) / det, (e * y - f * x) / det);
            let limit = 0.25 * (u.abs().max(v.abs())).max(0.02);
            let shrink = (limit / su.abs().max(sv.abs())).min(1.0);
            (u, v) = ((u + shrink * su).clamp(lowest, 1.0), (v + shrink * sv).clamp(lowest, 1.0));
            if u < 0.0 && v < 0.0 {
                (u, v) = (u.max(0.0), v.max(0.0));
            }
        }
        best
    }
}

/// Position and derivatives of the bicubic B-spline patch of a 16-point net.
pub(crate) fn regular_limit(net: &[DVec3], u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
    let (bu, bv) = (bspline::weights(u), bspline::weights(v));
    let (du, dv) = (bspline::derivative_weights(u), bspline::derivative_weights(v));
    let sum = |x: [f64; 4], y: [f64; 4]| net.iter().enumerate().map(|(k, &p)| x[k % 4] * y[k / 4] * p).sum();
    (sum(bu, bv), sum(du, bv), sum(bu, dv))
}

/// The (sector, a, b) of each net point, for quad 0 (interior) or the quad of the kind (crease).
fn net_order(kind: NetKind) -> Vec<(i64, i64, i64)> {
    let (j, spokes, faces) = match kind {
        NetKind::Interior { valence } => (0, i64::from(valence), i64::from(valence)),
        NetKind::Crease { faces, quad } => (i64::from(quad), i64::from(faces) + 1, i64::from(faces)),
        NetKind::Regular => panic!("a regular net has no ring order"),
    };
    let mut order = vec![(0, 0, 0)];
    for i in 0..spokes {
        order.push((i, 1, 0));
        if i < faces {
            order.push((i, 1, 1));
        }
    }
    let outer = [(2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2)];
    let open = matches!(kind, NetKind::Crease { .. });
    let beyond = |o: usize| open && (o == 0 && j == 0 || o == 6 && j + 1 == faces);
    order.extend(outer.iter().enumerate().filter(|&(o, _)| !beyond(o)).map(|(_, &(a, b))| (j, a, b)));
    order
}

/// All quads of a star of this shape with their net kinds.
pub(crate) fn quads(kind: NetKind) -> Vec<(i64, NetKind)> {
    match kind {
        NetKind::Interior { valence } => (0..i64::from(valence)).map(|i| (i, kind)).collect(),
        NetKind::Crease { faces, .. } => {
            (0..faces).map(|quad| (i64::from(quad), NetKind::Crease { faces, quad })).collect()
        }
        NetKind::Regular => (0..4).map(|i| (i, kind)).collect(),
    }
}

/// A small linear congruential generator (Knuth's MMIX constants): reproducible without a dependency.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// The next number in 0..1.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Angle between two directions in degrees.
pub(crate) fn degrees(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

/// The largest distance of the Gregory patches of a star to its limit surface on a grid of samples.
pub(crate) fn worst_distance(kind: NetKind, star: &Star, samples: u32) -> f64 {
    quads(kind).iter().map(|&(i, kind)| star.patch_distance(kind, i, samples)).fold(0.0, f64::max)
}
