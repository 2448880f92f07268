//! The eigenbasis of a patch and its evaluation in f64.

use glam::DVec3;

use crate::bezier::{bernstein, bernstein_first, bernstein_second};
use crate::bspline;
use crate::jet::Jet;
use crate::matrix::Matrix;
use crate::net::NetKind;

use super::eigen::{Eigensystem, Expansion, Split};
use super::outer::Outer;
use super::place::Place;
use super::refine::{refined_points, step};

/// Everything needed to evaluate the limit surface of one quad beside an irregular vertex V, for one shape of net.
#[derive(Clone, Debug)]
pub struct Patch {
    kind: NetKind,
    system: Eigensystem,
    bases: [Matrix; 3],
}

impl Patch {
    /// Builds the eigenstructure of nets of this kind. Costs about `(2n)^3` multiplications.
    ///
    /// # Panics
    /// If `kind` is regular (one bicubic patch) or not valid.
    pub fn new(kind: NetKind) -> Self {
        let step = step(kind);
        // Modes even or odd about the diagonal of the patch.
        let system = Eigensystem::new(kind, 1, Outer::of_net(kind, &step));
        let to_bezier = bspline::patch_to_bezier();
        let bases = [(1, 0), (1, 1), (0, 1)].map(|(x, y)| {
            let window = (0..16).map(|i| (x - 1 + i % 4, y - 1 + i / 4));
            system.basis(&to_bezier, &refined_points(kind, &step, window))
        });
        Self { kind, system, bases }
    }

    /// The nets that this is for.
    pub fn kind(&self) -> NetKind {
        self.kind
    }

    /// The eigenvalues of one step: K, one per mode. First 1, then the dominant one, then those of the two coupled
    /// modes if [`Self::coupling`] is not 0, then the rest by falling magnitude.
    pub fn eigenvalues(&self) -> &[f64] {
        &self.system.lambdas
    }

    /// How much of mode 3 one step adds to mode 2, before both are multiplied by their eigenvalue (see the
    /// [module](super)); 0 where all modes are eigenvectors.
    pub fn coupling(&self) -> f64 {
        self.system.coupling
    }

    /// V^-1, K x K: row i times a net gives the coefficient of mode i. Row 0 is the limit position and sums to 1, the
    /// others sum to 0: they are to be applied to the differences of the points to V.
    pub fn projection(&self) -> &Matrix {
        &self.system.projection
    }

    /// The functions of the modes on sub-patch 0 (u >= 1/2 > v), 1 (both >= 1/2) or 2 (v >= 1/2 > u): 16 x K, Bezier
    /// point `i + 4 j` with i along u.
    ///
    /// # Panics
    /// If `sub_patch > 2`.
    pub fn basis(&self, sub_patch: usize) -> &Matrix {
        &self.bases[sub_patch]
    }

    /// The coefficients of the modes for a net: the limit position of V, then K-1 vectors.
    ///
    /// # Panics
    /// If the net is not of this kind.
    pub fn project(&self, net: &[DVec3]) -> Vec<DVec3> {
        self.system.project(net)
    }

    /// Point and derivatives at (u, v) in the unit square, from the result of [`Self::project`].
    ///
    /// At V (largest parameter below the smallest normal number) the position is the limit position and the
    /// derivatives, which do not exist, are zero.
    ///
    /// # Panics
    /// If there are not K coefficients.
    pub fn evaluate(&self, coefficients: &[DVec3], u: f64, v: f64) -> Jet {
        let Some((place, surface)) = self.expand(coefficients, u, v) else {
            return Jet { position: coefficients[0], ..Jet::default() };
        };
        let scale = place.scale();
        let derivative = |du: usize, dv: usize| surface.whole(derivative(&surface, place, du, dv));
        Jet {
            position: surface.limit + derivative(0, 0),
            du: scale * derivative(1, 0),
            dv: scale * derivative(0, 1),
            duu: scale * (scale * derivative(2, 0)),
            duv: scale * (scale * derivative(1, 1)),
            dvv: scale * (scale * derivative(0, 2)),
        }
    }

    /// The unit normal at (u, v), precise however near V; `None` at V and where the derivatives are parallel.
    ///
    /// # Panics
    /// If there are not K coefficients.
    pub fn normal(&self, coefficients: &[DVec3], u: f64, v: f64) -> Option<DVec3> {
        let (place, surface) = self.expand(coefficients, u, v)?;
        surface.cross(derivative(&surface, place, 1, 0), derivative(&surface, place, 0, 1)).try_normalize()
    }

    fn expand(&self, coefficients: &[DVec3], u: f64, v: f64) -> Option<(Place, Expansion)> {
        let place = Place::of(u, v)?;
        Some((place, self.system.expand(&self.bases[place.sub_patch], coefficients, place.level)))
    }

    pub(super) fn system(&self) -> &Eigensystem {
        &self.system
    }
}

/// The `du`-th derivative along u and `dv`-th along v, per unit of the sub-patch.
fn derivative(surface: &Expansion, place: Place, du: usize, dv: usize) -> Split {
    let along = |order: usize, t: f64| [bernstein, bernstein_first, bernstein_second][order](t);
    let (u, v) = (along(du, place.u), along(dv, place.v));
    surface.combine(|i| u[i % 4] * v[i / 4])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stam::eigen::{CHAIN, RECEIVER};

    /// The largest |A V - V J|, and the condition of V in the maximum norm.
    fn residual_and_condition(kind: NetKind, system: &Eigensystem) -> (f64, f64) {
        let (a, vectors) = (step(kind), &system.vectors);
        let size = vectors.rows();
        let a = Matrix::from_fn(size, size, |r, c| a.get(system.points[r], system.points[c]));
        let image = a.mul(vectors);
        let expected = |r: usize, c: usize| {
            let chained = if c == CHAIN { system.coupling * vectors.get(r, RECEIVER) } else { 0.0 };
            system.lambdas[c] * (vectors.get(r, c) + chained)
        };
        let residual = (0..size * size).fold(0.0_f64, |worst, i| {
            let (r, c) = (i / size, i % size);
            worst.max((image.get(r, c) - expected(r, c)).abs())
        });
        let norm = |m: &Matrix| (0..m.rows()).map(|r| m.row(r).iter().map(|x| x.abs()).sum()).fold(0.0, f64::max);
        (residual, norm(vectors) * norm(&system.projection))
    }

    fn kinds() -> Vec<NetKind> {
        let mut kinds: Vec<_> = (2..=12).chain([20, 64]).map(|valence| NetKind::Interior { valence }).collect();
        kinds.extend((1..=8).chain([12, 20]).flat_map(|k| (0..k).map(move |j| NetKind::Crease { faces: k, quad: j })));
        kinds.push(NetKind::Crease { faces: 32, quad: 5 });
        kinds
    }

    #[test]
    fn modes_diagonalise_the_step() {
        for kind in kinds() {
            let patch = Patch::new(kind);
            let (residual, condition) = residual_and_condition(kind, patch.system());
            assert!(residual < 1e-14, "{kind:?}: residual {residual:e}");
            assert!(condition < 2e4, "{kind:?}: condition {condition:e}");
            let largest = patch.projection().as_slice().iter().fold(0.0_f64, |m, w| m.max(w.abs()));
            let bound = if kind == (NetKind::Interior { valence: 3 }) { 42.0 } else { 10.0 };
            assert!(largest < bound, "{kind:?}: largest weight {largest}");
        }
    }

    #[test]
    fn modes_are_coupled_where_the_step_is_defective() {
        for kind in kinds() {
            let (coupled, expected) = match kind {
                NetKind::Interior { valence } => (valence == 2, 0.125),
                NetKind::Crease { faces, .. } if faces % 4 == 0 => (true, 0.5),
                NetKind::Crease { faces, .. } => (faces % 2 == 1, 0.25),
                NetKind::Regular => unreachable!("not among the kinds"),
            };
            let patch = Patch::new(kind);
            assert_eq!(patch.coupling() != 0.0, coupled, "{kind:?}");
            if coupled {
                assert_eq!(patch.eigenvalues()[RECEIVER..=CHAIN], [expected; 2], "{kind:?}");
            }
        }
    }
}
