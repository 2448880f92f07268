//! Eigenvectors of Catmull-Clark subdivision around a vertex, one Fourier mode at a time, on all points of a net.
//!
//! A ring with `E_j = e exp(i w (j - 1/2))` and `F_j = f exp(i w j)`, `w = 2 pi k / n`, keeps that form under
//! subdivision and around the vertex. Angles are counted from the bisector of the patch, whose reflection then is
//! complex conjugation. A value z is held as the real number Re z + Im z (Hartley's transform): the surface of such a
//! patch is a real one, of which the part symmetric in u and v is Re and the antisymmetric part is Im.

use crate::angle::turn;

/// An eigenvector of one Fourier mode: factor per subdivision step and amplitudes of V, the E and the F.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eigenvector {
    pub(super) lambda: f64,
    pub(super) vertex: f64,
    pub(super) edge: f64,
    pub(super) face: f64,
}

/// The Fourier mode `k` of a vertex of valence `n`, k <= n/2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mode {
    pub(super) n: i64,
    pub(super) k: i64,
}

impl Mode {
    /// The modes of a valence: 0 to n/2. The others are their conjugates.
    pub(super) fn all(valence: u32) -> impl Iterator<Item = Self> {
        let n = i64::from(valence);
        (0..=n / 2).map(move |k| Self { n, k })
    }

    /// How many modes this one stands for: itself and its conjugate.
    pub(super) fn multiplicity(self) -> f64 {
        if self.k == 0 || 2 * self.k == self.n { 1.0 } else { 2.0 }
    }

    /// `(cos, sin)` of the phase after a number of half sectors.
    pub(super) fn phase(self, half_sectors: i64) -> (f64, f64) {
        turn(self.k * half_sectors, 2 * self.n)
    }

    /// The eigenvectors, that of the largest eigenvalue first: three for the mode of equal sectors, two for the others.
    ///
    /// With `h = cos(pi k / n)` a step maps (e, f) by the rows `((1 + h^2)/4, h/8)` and `(h/2, 1/4)`.
    pub(super) fn eigenvectors(self) -> Vec<Eigenvector> {
        if self.k == 0 {
            return self.equal_sectors();
        }
        let h = self.phase(1).0;
        let root = (4.0 + h * h).sqrt();
        let of = |signed: f64| Eigenvector {
            lambda: (2.0 + h * h + h * signed) / 8.0,
            vertex: 0.0,
            edge: 1.0,
            face: signed - h,
        };
        vec![of(root), of(-root)]
    }

    /// The constant, and two whose eigenvalues have the sum `(3n-7)/(4n)` and the product `(n-3)/(16n)`.
    fn equal_sectors(self) -> Vec<Eigenvector> {
        let n = self.n as f64;
        let (half_sum, product) = ((3.0 * n - 7.0) / (8.0 * n), (n - 3.0) / (16.0 * n));
        let larger = half_sum + (half_sum * half_sum - product).sqrt();
        let of = |lambda: f64| Eigenvector {
            lambda,
            vertex: (16.0 * lambda - 12.0) * lambda + 1.0,
            edge: 6.0 * lambda - 1.0,
            face: 4.0 * lambda + 1.0,
        };
        [1.0, larger, product / larger].map(of).to_vec()
    }

    /// The points of patch 0's net: 2n+8 values V, E0, F0, .., O0..O6, the O such that a step multiplies them by lambda
    /// as well.
    pub(super) fn net(self, at: Eigenvector) -> Vec<f64> {
        let sum = |(re, im): (f64, f64), (cos, sin): (f64, f64)| re * (cos + sin) + im * (cos - sin);
        let mut net = vec![at.vertex];
        for j in 0..self.n {
            net.push(sum((at.edge, 0.0), self.phase(2 * j - 1)));
            net.push(sum((at.face, 0.0), self.phase(2 * j)));
        }
        let Outer { beyond_edge, beside, beyond_face } = self.outer(at);
        let mirrored = (beside.0, -beside.1);
        net.extend([
            sum(mirrored, self.phase(-1)),
            sum((beyond_edge, 0.0), self.phase(-1)),
            sum(beside, self.phase(-1)),
            beyond_face,
            sum(mirrored, self.phase(1)),
            sum((beyond_edge, 0.0), self.phase(1)),
            sum(beside, self.phase(1)),
        ]);
        net
    }

    /// The second ring from `lambda x = (regular subdivision rules of x and the first ring)`.
    ///
    /// Of mode n/4 one eigenvalue is 1/8, which is one of the second ring itself: multiples of its eigenvector may be
    /// added, and the shortest second ring is taken. The choice shows at n = 8 alone: at n = 4 every net has the
    /// bicubic as its fairest surface, and modes beyond the second have the columns of O themselves as the fairest
    /// surface of such an eigenvector.
    fn outer(self, at: Eigenvector) -> Outer {
        let Eigenvector { lambda, vertex, edge, face } = at;
        let (c1, c2) = (self.phase(1).0, self.phase(2).0);
        // O1 is a vertex point: lambda O1 = 9/16 E0 + 3/32 (V + F0 + F(-1) + O1) + 1/64 (E1 + E(-1) + O2 + O0).
        let first_ring = 0.5625 * edge + 0.09375 * (vertex + 2.0 * face * c1) + edge * c2 / 32.0;
        let gap = (lambda - 0.125) * (lambda - 1.0 / 32.0);
        if gap.abs() < RESONANCE {
            return self.outer_beyond(at, 0.0).shortest(c1);
        }
        self.outer_beyond(at, ((lambda - 0.0625) * first_ring + self.beside_from_ring(at).0 / 32.0) / gap)
    }

    /// What the first ring and V add to O2, an edge point: `lambda O2 = 3/8 (E0 + F0) + 1/16 (V + E1 + O1 + O2)`,
    /// angles counted from spoke 0.
    fn beside_from_ring(self, Eigenvector { vertex, edge, face, .. }: Eigenvector) -> (f64, f64) {
        let ((c1, s1), (c2, s2)) = (self.phase(1), self.phase(2));
        (0.375 * (edge + face * c1) + (vertex + edge * c2) / 16.0, 0.375 * face * s1 + edge * s2 / 16.0)
    }

    /// The second ring with this amplitude of O1.
    fn outer_beyond(self, at: Eigenvector, beyond_edge: f64) -> Outer {
        let Eigenvector { lambda, vertex, edge, face } = at;
        let (c1, s1) = self.phase(1);
        let known = self.beside_from_ring(at);
        // Equal sectors of valence 4 have the eigenvalue 1/16: again the fairest surface is the bicubic, whatever O2
        // is.
        let over = |x: f64| if (lambda - 0.0625).abs() < RESONANCE { 0.0 } else { x / (lambda - 0.0625) };
        let beside = (over(known.0 + beyond_edge / 16.0), over(known.1));
        // O3 is a vertex point: lambda O3 = 9/16 F0 + 3/32 (E0 + E1 + O2 + O4) + 1/64 (V + O1 + O5 + O3), from the
        // bisector.
        let around = edge * c1 + (beside.0 * c1 + beside.1 * s1);
        let corners = vertex + 2.0 * beyond_edge * c1;
        let beyond_face = (0.5625 * face + 0.1875 * around + corners / 64.0) / (lambda - 1.0 / 64.0);
        Outer { beyond_edge, beside, beyond_face }
    }
}

/// Difference under which an eigenvalue counts as one of the second ring; all others are further than 1e-3 away.
const RESONANCE: f64 = 1e-9;

/// Amplitudes of the second ring: O1 and O2 with angles counted from spoke 0, O3 from the bisector.
struct Outer {
    beyond_edge: f64,
    beside: (f64, f64),
    beyond_face: f64,
}

impl Outer {
    /// The one of least length over O1, O2, O4 and O3 among those that differ by multiples of the second ring's
    /// own eigenvector for 1/8: amplitudes 1, 1, 1 and 2 cos of half a sector.
    fn shortest(self, cos: f64) -> Self {
        let far = 2.0 * cos;
        let along = self.beyond_edge + 2.0 * self.beside.0 + far * self.beyond_face;
        let excess = along / (3.0 + far * far);
        Self {
            beyond_edge: self.beyond_edge - excess,
            beside: (self.beside.0 - excess, self.beside.1),
            beyond_face: self.beyond_face - far * excess,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::NetKind;

    /// The value of grid point (x, y) after one step of regular subdivision.
    fn refined(kind: NetKind, net: &[f64], x: i32, y: i32) -> f64 {
        let taps = |x: i32| -> Vec<(i32, f64)> {
            let half = x.div_euclid(2);
            match x.rem_euclid(2) {
                0 => vec![(half - 1, 0.125), (half, 0.75), (half + 1, 0.125)],
                _ => vec![(half, 0.5), (half + 1, 0.5)],
            }
        };
        let mut row = vec![0.0; net.len()];
        for (a, p) in taps(x) {
            for &(b, q) in &taps(y) {
                kind.grid(a, b).add_to(&mut row, p * q);
            }
        }
        row.iter().zip(net).map(|(w, v)| w * v).sum()
    }

    #[test]
    fn subdivision_multiplies_eigenvectors() {
        for valence in (3..=14).filter(|&n| n != 4) {
            let kind = NetKind::Interior { valence };
            for mode in Mode::all(valence) {
                for at in mode.eigenvectors() {
                    let net = mode.net(at);
                    let size = net.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                    let grid = [(1, 0), (1, 1), (0, 1), (2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2)];
                    for (x, y) in grid {
                        let mut row = vec![0.0; net.len()];
                        kind.grid(x, y).add_to(&mut row, at.lambda);
                        let expected: f64 = row.iter().zip(&net).map(|(w, v)| w * v).sum();
                        let gap = (refined(kind, &net, x, y) - expected).abs();
                        assert!(gap < 1e-14 * size, "{mode:?} {at:?} ({x},{y}): {gap:e}");
                    }
                    assert!((refined_vertex(valence, &net) - at.lambda * net[0]).abs() < 1e-14 * size);
                }
            }
        }
    }

    fn refined_vertex(valence: u32, net: &[f64]) -> f64 {
        let n = valence as usize;
        let mean = |first: usize| (0..n).map(|j| net[first + 2 * j]).sum::<f64>() / n as f64;
        let (edge, face) = (mean(1), (net[0] + 2.0 * mean(1) + mean(2)) / 4.0);
        ((valence as f64 - 2.0) * net[0] + edge + face) / n as f64
    }
}
