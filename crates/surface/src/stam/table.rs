//! The f32 form of an eigenbasis: what storage buffers hold.

use crate::matrix::Matrix;

use super::eigen::{DOMINANT, Eigensystem};
use super::{Patch, Side};

/// An eigenbasis in f32.
///
/// `projection` is applied to nets once per frame, by the control stage or where records are written; `evaluation` is
/// read for every sample. With K modes and [`ratios_size`] R:
///
/// | float of `evaluation` | content |
/// |---|---|
/// | 0 | lambda, the dominant eigenvalue: of mode 1 |
/// | 1 | mu, the next largest magnitude: scale of modes 2.. |
/// | 2 | mu / lambda |
/// | 3 | how much of mode 3 one step adds to mode 2, usually 0 |
/// | 4 + i, i < K | eigenvalue of mode i over mu; 0 for modes 0 and 1, which are weighted otherwise |
/// | 4 + K .. 4 + R | 0 |
/// | 4 + R + 16 (K s + i) .. | patch: function of mode i on sub-patch s, Bezier point a + 4 b with a along u |
/// | 4 + R + 8 i .. | side: function of mode i, 4 Bezier points of the curve, 4 of the derivative across |
///
/// All parts begin at multiples of four floats. The function of mode 0 is the constant 1 and not to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// K.
    pub modes: usize,
    /// Points of the net.
    pub net_size: usize,
    /// K rows of `net_size` weights, as [`Patch::projection`] or [`Side::projection`].
    pub projection: Vec<f32>,
    /// See the table above.
    pub evaluation: Vec<f32>,
}

/// Floats before the ratios.
pub const HEADER: usize = 4;

/// Floats that the ratios of K modes take: K rounded up to a multiple of four.
pub fn ratios_size(modes: usize) -> usize {
    modes.next_multiple_of(4)
}

impl Table {
    /// Where in `evaluation` the function of a mode begins: 16 floats for a patch. Sub-patch as [`Patch::basis`].
    pub fn patch_function(&self, sub_patch: usize, mode: usize) -> usize {
        HEADER + ratios_size(self.modes) + 16 * (self.modes * sub_patch + mode)
    }

    /// Where in `evaluation` the function of a mode begins: 8 floats for a side.
    pub fn side_function(&self, mode: usize) -> usize {
        HEADER + ratios_size(self.modes) + 8 * mode
    }

    fn new(system: &Eigensystem, bases: &[&Matrix]) -> Self {
        let (lambda, mu) = (system.lambdas[DOMINANT], system.remainder_scale());
        let mut evaluation = vec![lambda, mu, mu / lambda, system.coupling];
        evaluation
            .extend(system.lambdas.iter().enumerate().map(|(i, lambda)| if i > DOMINANT { lambda / mu } else { 0.0 }));
        evaluation.resize(HEADER + ratios_size(system.lambdas.len()), 0.0);
        for basis in bases {
            for mode in 0..basis.cols() {
                evaluation.extend((0..basis.rows()).map(|r| basis.get(r, mode)));
            }
        }
        Self {
            modes: system.lambdas.len(),
            net_size: system.projection.cols(),
            projection: system.projection.to_f32(),
            evaluation: Matrix::from_rows(&[evaluation]).to_f32(),
        }
    }
}

impl Patch {
    /// The f32 form.
    pub fn table(&self) -> Table {
        Table::new(self.system(), &[self.basis(0), self.basis(1), self.basis(2)])
    }
}

impl Side {
    /// The f32 form.
    pub fn table(&self) -> Table {
        Table::new(self.system(), &[self.basis()])
    }
}

#[cfg(test)]
#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the tables do")]
mod tests {
    use super::*;
    use crate::net::NetKind;

    #[test]
    fn layout_is_as_documented() {
        for kind in [NetKind::Interior { valence: 5 }, NetKind::Crease { faces: 4, quad: 1 }] {
            let (patch, side) = (Patch::new(kind), Side::new(kind, 3));
            let (table, side_table) = (patch.table(), side.table());
            assert_eq!(table.evaluation.len(), table.patch_function(2, table.modes - 1) + 16);
            assert_eq!(side_table.evaluation.len(), side_table.side_function(side_table.modes - 1) + 8);
            assert_eq!(table.projection.len(), table.modes * table.net_size);
            assert_eq!(table.patch_function(0, 0) % 4, 0);
            assert_eq!(table.evaluation[0], patch.eigenvalues()[1] as f32);
            assert_eq!(table.evaluation[3], patch.coupling() as f32);
            assert_eq!(table.evaluation[table.patch_function(1, 7) + 6], patch.basis(1).get(6, 7) as f32);
            assert_eq!(side_table.evaluation[side_table.side_function(7) + 6], side.basis().get(6, 7) as f32);
            let ratios = &table.evaluation[HEADER..HEADER + table.modes];
            assert!(ratios[..2] == [0.0; 2] && ratios[2..].iter().all(|r| r.abs() <= 1.0));
            assert_eq!(ratios[2..].iter().fold(0.0_f32, |m, r| m.max(r.abs())), 1.0);
        }
    }
}
