//! Limit masks: where the centre of a star ends, and the plane that touches the surface there.
//!
//! A mask is a left eigenvector of the linear map that refines a star: applied to the refined star
//! it gives its value on the star times the eigenvalue (the tests below check every mask this way).
//! The position mask has eigenvalue 1, tangent masks the largest eigenvalues below 1. Interior
//! vertices: M. Halstead, M. Kass, T. DeRose, *Efficient, fair interpolation using Catmull-Clark
//! surfaces*, SIGGRAPH 1993, appendix A. Boundary vertices: [`inward`] is derived there.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::Boundary;
use super::star::{Kind, Star};

/// The tangent plane at the centre of a star. The directions lie along the core quad's sides that
/// meet there; their lengths follow the parameter where the surface has a derivative and are a
/// convention where it has none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangents {
    /// Along the side that leaves the centre.
    pub(super) leaving: DVec3,
    /// Along the side that arrives at the centre, pointing away from it.
    pub(super) arriving: DVec3,
    /// Unit normal, zero if undefined.
    pub(super) normal: DVec3,
}

/// The unit vector along `a` x `b`, or zero where rounding decides its direction. Safe for vectors
/// of any length.
pub(super) fn unit_cross(a: DVec3, b: DVec3) -> DVec3 {
    /// Sine of the angle below which two directions computed in f64 cannot be told apart.
    const PARALLEL: f64 = 64.0 * f64::EPSILON;
    let unit = |v: DVec3| (v / v.abs().max_element()).normalize_or_zero();
    let (a, b) = (unit(a), unit(b));
    let cross = a.cross(b);
    if cross.length() > PARALLEL { cross.normalize() } else { DVec3::ZERO }
}

impl Star {
    /// The limit position of the centre.
    pub(super) fn limit_position(&self, rule: Boundary) -> DVec3 {
        match self.kind(rule) {
            Kind::Corner => self.centre,
            Kind::Crease => (4.0 * self.centre + self.spokes[0] + self.spokes[self.spokes.len() - 1]) / 6.0,
            Kind::Interior => {
                let n = self.diagonals.len() as f64;
                let (spokes, diagonals) = (self.spokes.iter().sum::<DVec3>(), self.diagonals.iter().sum::<DVec3>());
                (n * n * self.centre + 4.0 * spokes + diagonals) / (n * (n + 5.0))
            }
        }
    }

    /// The limit tangent plane at the centre.
    pub(super) fn limit_tangents(&self, rule: Boundary) -> Tangents {
        match (self.kind(rule), self.diagonals.len()) {
            (Kind::Interior, 2) => self.valence_two_tangents(),
            (Kind::Interior, n) => {
                let step = TAU / n as f64;
                fan_tangents(self.turned_sum(0.0), self.turned_sum(0.25), 0.0, step)
            }
            (Kind::Corner, _) | (Kind::Crease, 1) => self.single_quad_tangents(rule),
            (Kind::Crease, k) => {
                let step = PI / k as f64;
                let along = 0.5 * (self.spokes[0] - self.spokes[k]);
                fan_tangents(along, inward(self), self.core as f64 * step, step)
            }
        }
    }

    /// The interior tangent mask turned by `turns` from the core's first spoke: cos(angle) at the
    /// end of each spoke times 1 + c + cos(pi/n) sqrt(2(9+c)), c = cos(2 pi/n), and at each
    /// diagonal the sum of the cosines of the spokes beside it. Divided so that it is the
    /// derivative for n = 4.
    fn turned_sum(&self, turns: f64) -> DVec3 {
        let n = self.diagonals.len();
        let c = (TAU / n as f64).cos();
        let amplitude = 1.0 + c + (PI / n as f64).cos() * (2.0 * (9.0 + c)).sqrt();
        let cos = |i: usize| (TAU * (((i + n - self.core) % n) as f64 / n as f64 - turns)).cos();
        let term = |i: usize| amplitude * cos(i) * self.spokes[i] + (cos(i) + cos((i + 1) % n)) * self.diagonals[i];
        (0..n).map(term).sum::<DVec3>() / (3.0 * n as f64)
    }

    /// Valence 2 has no tangent plane in general: the difference of the spokes, that of the
    /// diagonals and a combination that is alike on both sides (and changes sign with each step)
    /// all shrink by 1/4. The two differences span the plane about which the surface wavers.
    fn valence_two_tangents(&self) -> Tangents {
        let across = 0.5 * (self.leaving() - self.arriving());
        let between = self.diagonals[self.core] - self.diagonals[(self.core + 1) % 2];
        Tangents { leaving: across, arriving: -across, normal: unit_cross(across, between) }
    }

    /// A vertex with one quad. A fixed corner has the tangents of its sides. A smoothed one touches
    /// the line through its neighbours and both parameter directions are parallel to it, but the
    /// normals nearby tend to that of the sides, since refining turns their cross product into 1/8
    /// of itself; with collinear sides the diagonal takes the place of the missing direction.
    fn single_quad_tangents(&self, rule: Boundary) -> Tangents {
        let (first, last) = (self.spokes[0] - self.centre, self.spokes[1] - self.centre);
        let along = 0.5 * (first - last);
        let sides = unit_cross(first, last);
        let normal = if sides == DVec3::ZERO { unit_cross(along, self.diagonals[0] - self.centre) } else { sides };
        match self.kind(rule) {
            Kind::Corner => Tangents { leaving: first, arriving: last, normal },
            _ => Tangents { leaving: along, arriving: -along, normal },
        }
    }
}

/// Tangents of the core quad's sides at angles `angle` and `angle + step` in the frame (`x`, `y`).
fn fan_tangents(x: DVec3, y: DVec3, angle: f64, step: f64) -> Tangents {
    let direction = |angle: f64| angle.cos() * x + angle.sin() * y;
    Tangents { leaving: direction(angle), arriving: direction(angle + step), normal: unit_cross(x, y) }
}

/// The direction in which the surface leaves the boundary at a crease star of `k` >= 2 quads, for
/// k = 2 the cross derivative.
///
/// If the centre and the boundary spokes are zero, refinement acts on the inner points as around an
/// interior vertex of valence 2k on waves that are odd about the boundary. The longest of these,
/// sin(i theta) on spoke i and a multiple of sin((i + 1/2) theta) on diagonal i with theta = pi/k,
/// has the largest eigenvalue, lambda. Its left eigenvector weighs spoke i by sin(i theta) and
/// diagonal i by g sin((i + 1/2) theta).
///
/// The weights p of the centre and q of either boundary spoke follow from their own rules,
/// centre' = (3/4, 1/8, 1/8) and spoke' = (1/2, 1/2), and from what they give to the refined inner
/// points, of total weight a from the centre and b from a boundary spoke:
/// ```text
/// lambda   = (5 + c + sqrt((1 + c)(9 + c))) / 16,  c = cos(theta)
/// g        = cos(theta/2) / (8 (lambda - 1/4))
/// a        = 3/8 cot(theta/2) + g / (4 sin(theta/2))
/// b        = sin(theta)/16 + g sin(theta/2)/4
/// lambda p = 3/4 p + q + a
/// lambda q = 1/8 p + 1/2 q + b
/// ```
fn inward(star: &Star) -> DVec3 {
    let k = star.diagonals.len();
    let theta = PI / k as f64;
    let (c, half) = (theta.cos(), 0.5 * theta);
    let lambda = (5.0 + c + ((1.0 + c) * (9.0 + c)).sqrt()) / 16.0;
    let g = half.cos() / (8.0 * (lambda - 0.25));
    let a = 0.375 / half.tan() + g / (4.0 * half.sin());
    let b = theta.sin() / 16.0 + 0.25 * g * half.sin();
    let p = (a * (lambda - 0.5) + b) / ((lambda - 1.0) * (lambda - 0.25));
    let q = (lambda - 0.75) * p - a;

    let wave = |i: f64| (i * theta).sin();
    let spokes = (1..k).map(|i| wave(i as f64) * star.spokes[i]).sum::<DVec3>();
    let diagonals = (0..k).map(|i| wave(i as f64 + 0.5) * star.diagonals[i]).sum::<DVec3>();
    let boundary = p * star.centre + q * (star.spokes[0] + star.spokes[k]);
    // For k = 2 the weight of the inner spoke is 4/6, that of the cubic B-spline at a knot.
    4.0 / (3.0 * k as f64) * (spokes + g * diagonals + boundary)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A star with points that follow no pattern.
    fn star(quads: usize, closed: bool, core: usize) -> Star {
        let point =
            |i: usize| DVec3::new((1.3 * i as f64).sin(), (2.9 * i as f64 + 0.3).cos(), (0.7 * (i * i) as f64).sin());
        let spokes = if closed { quads } else { quads + 1 };
        Star {
            centre: point(900),
            spokes: (0..spokes).map(point).collect(),
            diagonals: (1000..1000 + quads).map(point).collect(),
            core,
        }
    }

    fn assert_close(a: DVec3, b: DVec3, tolerance: f64, what: &str) {
        assert!((a - b).length() <= tolerance * (1.0 + a.length()), "{what}: {a} against {b}");
    }

    #[test]
    fn position_masks_are_kept_by_refinement() {
        for rule in [Boundary::EdgeAndCorner, Boundary::EdgeOnly] {
            for quads in [1, 2, 3, 4, 5, 7, 64, 300] {
                for closed in [true, false] {
                    if closed && quads == 1 {
                        continue;
                    }
                    let star = star(quads, closed, 0);
                    let what = format!("{quads} quads, closed {closed}, {rule:?}");
                    assert_close(star.limit_position(rule), star.refine(rule).limit_position(rule), 1e-14, &what);
                }
            }
        }
    }

    #[test]
    fn interior_tangents_shrink_by_the_subdominant_eigenvalue() {
        let rule = Boundary::EdgeOnly;
        for n in [3, 4, 5, 6, 12, 64, 300] {
            let star = star(n, true, n / 2);
            let c = (TAU / n as f64).cos();
            let lambda = (5.0 + c + ((1.0 + c) * (9.0 + c)).sqrt()) / 16.0;
            let (coarse, fine) = (star.limit_tangents(rule), star.refine(rule).limit_tangents(rule));
            assert_close(lambda * coarse.leaving, fine.leaving, 1e-13, &format!("valence {n}, leaving"));
            assert_close(lambda * coarse.arriving, fine.arriving, 1e-13, &format!("valence {n}, arriving"));
            assert_close(coarse.normal, fine.normal, 1e-10, &format!("valence {n}, normal"));
        }
    }

    #[test]
    fn boundary_tangents_are_eigenvectors() {
        let rule = Boundary::EdgeAndCorner;
        for k in [2, 3, 4, 5, 8, 12, 64] {
            let star = star(k, false, k - 1);
            let c = (PI / k as f64).cos();
            let lambda = (5.0 + c + ((1.0 + c) * (9.0 + c)).sqrt()) / 16.0;
            assert_close(lambda * inward(&star), inward(&star.refine(rule)), 1e-12, &format!("{k} quads, inward"));
            let along = -star.limit_tangents(rule).arriving;
            assert_close(
                0.5 * along,
                -star.refine(rule).limit_tangents(rule).arriving,
                1e-9,
                &format!("{k} quads, along"),
            );
        }
    }

    #[test]
    fn tangents_of_a_flat_regular_star_are_its_sides() {
        let at = |radius: f64, angle: f64| radius * DVec3::new(angle.cos(), angle.sin(), 0.0);
        let quarter = TAU / 4.0;
        for quads in [4, 2] {
            let spokes = (0..if quads == 4 { 4 } else { 3 }).map(|i| at(1.0, i as f64 * quarter)).collect();
            let diagonals = (0..quads).map(|i| at(2f64.sqrt(), (i as f64 + 0.5) * quarter)).collect();
            let star = Star { centre: DVec3::ZERO, spokes, diagonals, core: 1 };
            let tangents = star.limit_tangents(Boundary::EdgeAndCorner);
            assert_close(tangents.leaving, at(1.0, quarter), 1e-14, "leaving");
            assert_close(tangents.arriving, at(1.0, 2.0 * quarter), 1e-14, "arriving");
            assert_close(tangents.normal, DVec3::Z, 1e-14, "normal");
        }
    }

    #[test]
    fn a_smoothed_single_quad_keeps_its_normal_under_refinement() {
        let mut star = star(1, false, 0);
        let rule = Boundary::EdgeOnly;
        assert_close(star.limit_tangents(rule).normal, star.refine(rule).limit_tangents(rule).normal, 1e-13, "bent");
        star.spokes[1] = 2.0 * star.centre - star.spokes[0];
        assert!(star.limit_tangents(rule).normal.is_normalized());
        assert_close(
            star.limit_tangents(rule).normal,
            star.refine(rule).limit_tangents(rule).normal,
            1e-13,
            "straight",
        );
    }

    #[test]
    fn unit_cross_is_safe_at_any_length() {
        assert_eq!(unit_cross(1e-300 * DVec3::X, 1e300 * DVec3::Y), DVec3::Z);
        assert_eq!(unit_cross(DVec3::ZERO, DVec3::Y), DVec3::ZERO);
        assert_eq!(unit_cross(DVec3::new(1.0, 2.0, 3.0), DVec3::new(-0.1, -0.2, -0.3)), DVec3::ZERO);
    }
}
