//! What a vertex contributes to the Gregory patches and edges around it, as one matrix over the faces that meet there.
//!
//! Loop, Schaefer, Ni and Castano, *Approximating Subdivision Surfaces with Gregory Patches for Hardware Tessellation*
//! (2009), section 3, whose formulas take centroids of faces of any size.

use super::edge::CrossEnd;
use super::fan::{Corner, Weights};
use crate::matrix::Matrix;

/// A vertex of a mesh that is not refined, with the faces around it.
///
/// Its net is V, E0, c0, E1, c1, ..: the vertex, then edge neighbours and centroids of faces alternating,
/// counter-clockwise. At a boundary the ring starts and ends with an edge neighbour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Fan {
    /// Inner vertex of this valence, 2 or more: 2n+1 points.
    Interior {
        /// Number of edges, and of faces.
        valence: u32,
    },
    /// Vertex on a smooth boundary, with this many faces: 2k+2 points.
    Crease {
        /// Number of faces, one less than edges.
        faces: u32,
    },
    /// Boundary vertex with one face that stays where it is: 4 points.
    Corner,
}

/// Where [`Fan::matrix`] has what one edge needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FanEdge {
    /// Row of the edge point.
    pub point: usize,
    /// Row of the inner cross vector r, point 1 of the cross derivative. Point 0 is the next row.
    pub cross: usize,
}

impl Fan {
    /// Number of edges.
    pub const fn edges(self) -> usize {
        match self {
            Self::Interior { valence } => valence as usize,
            Self::Crease { faces } => faces as usize + 1,
            Self::Corner => 2,
        }
    }

    /// Number of points of the net.
    pub const fn net_size(self) -> usize {
        match self {
            Self::Interior { valence } => 2 * valence as usize + 1,
            Self::Crease { .. } | Self::Corner => 2 * self.edges(),
        }
    }

    /// Rows of [`Self::matrix`].
    pub const fn rows(self) -> usize {
        1 + 3 * self.edges()
    }

    /// Rows of [`Self::matrix`] that are points; the others are vectors.
    pub const fn point_rows(self) -> usize {
        1 + self.edges()
    }

    /// The rows of edge `i`.
    pub const fn edge(self, i: usize) -> FanEdge {
        FanEdge { point: 1 + i, cross: 1 + self.edges() + 2 * i }
    }

    /// The limit position, the edge point e of every edge, then two points of the cross derivative D of every edge walked
    /// outwards: point 1, then point 0 ([`Self::edge`]). D is that of [`gregory::edge`](super::edge), on whose two ends
    /// each half depends alone.
    ///
    /// # Panics
    /// If there are less than two edges, or no faces.
    pub fn matrix(self) -> Matrix {
        let corner = Corner::of_fan(self);
        let edges = || 0..self.edges() as i64;
        let points = std::iter::once(corner.position()).chain(edges().map(|i| corner.edge_point(i)));
        let vectors = edges().flat_map(|i| [corner.cross_inner(i), corner.cross_end(i)]);
        self.over_centroids(points.chain(vectors).collect())
    }

    /// Limit position and two tangents: 3 rows. Row 1 x row 2 is the outward normal.
    ///
    /// # Panics
    /// As [`Self::matrix`].
    pub fn vertex(self) -> Matrix {
        let corner = Corner::of_fan(self);
        self.over_centroids(vec![corner.position(), corner.tangent(0), corner.tangent(1)])
    }

    /// Cosine of the angle between neighbouring edges, by which faces share their cross derivatives.
    pub fn cosine(self) -> f64 {
        Corner::of_fan(self).cosine()
    }

    /// What edges have to do about their cross derivative here.
    pub fn cross_end(self) -> CrossEnd {
        Corner::of_fan(self).cross_end_kind()
    }

    /// Rows over V, E0, F0, .. of a ring of quads as rows over V, E0, c0, .. of a ring of any faces. `F = 4 c - V - E - E'`
    /// makes a quad of each; the first subdivision step knows a face by its centroid only, so limits stay exact.
    fn over_centroids(self, mut rows: Vec<Weights>) -> Matrix {
        for row in &mut rows {
            for face in (2..self.net_size()).step_by(2) {
                let next_edge = if face + 1 < self.net_size() { face + 1 } else { 1 };
                let weight = row[face];
                row[face] = 4.0 * weight;
                for neighbour in [0, face - 1, next_edge] {
                    row[neighbour] -= weight;
                }
            }
        }
        Matrix::from_rows(&rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fans() -> Vec<Fan> {
        let interior = [2, 3, 4, 5, 6, 7, 12, 65, 200].map(|valence| Fan::Interior { valence });
        let crease = [1, 2, 3, 4, 7, 64, 200].map(|faces| Fan::Crease { faces });
        interior.into_iter().chain(crease).chain([Fan::Corner]).collect()
    }

    #[test]
    fn points_sum_to_one_and_vectors_to_zero() {
        for fan in fans() {
            let matrix = fan.matrix();
            assert_eq!((matrix.rows(), matrix.cols()), (fan.rows(), fan.net_size()), "{fan:?}");
            for row in 0..matrix.rows() {
                let (sum, expected) = (matrix.row(row).iter().sum::<f64>(), f64::from(row < fan.point_rows()));
                assert!((sum - expected).abs() < 1e-12, "{fan:?}, row {row}: {sum}");
                assert!(matrix.row(row).iter().all(|w| w.abs() < 4.5), "{fan:?}, row {row}");
            }
            assert!(fan.vertex().row(0) == matrix.row(0));
        }
    }

    #[test]
    fn edges_turn_with_the_ring() {
        let fan = Fan::Interior { valence: 7 };
        let matrix = fan.matrix();
        let turned = |row: &[f64], steps: usize| -> Vec<f64> {
            (0..row.len()).map(|c| if c == 0 { row[0] } else { row[1 + (c + 13 - 2 * steps) % 14] }).collect()
        };
        for i in 1..7 {
            let (from, to) = (fan.edge(0), fan.edge(i));
            for (a, b) in [(from.point, to.point), (from.cross, to.cross), (from.cross + 1, to.cross + 1)] {
                let expected = turned(matrix.row(a), i);
                let gap = expected.iter().zip(matrix.row(b)).map(|(x, y)| (x - y).abs());
                assert!(gap.fold(0.0, f64::max) < 1e-15, "edge {i}");
            }
        }
    }

    #[test]
    fn regular_cross_vectors_are_differences_of_the_grid() {
        // Valence 4: r = (E1-E3)/3 + (F0-F3)/6 = (E1-E3)/6 + 2 (c0-c3)/3, and D(0) the bicubic derivative.
        let fan = Fan::Interior { valence: 4 };
        let matrix = fan.matrix();
        let expected = [0.0, 0.0, 4.0, 1.0, 0.0, 0.0, 0.0, -1.0, -4.0].map(|w| w / 6.0);
        let row = matrix.row(fan.edge(0).cross);
        assert!(row.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{row:?}");
    }

    #[test]
    fn flat_vertices_are_told_apart() {
        assert_eq!(Fan::Interior { valence: 2 }.cross_end(), CrossEnd::Vanishing);
        assert_eq!(Fan::Crease { faces: 1 }.cross_end(), CrossEnd::Opposed);
        for fan in [Fan::Corner, Fan::Crease { faces: 2 }, Fan::Interior { valence: 3 }] {
            assert_eq!(fan.cross_end(), CrossEnd::Plain);
        }
        assert_eq!([Fan::Corner.cosine(), Fan::Crease { faces: 1 }.cosine()], [0.0, 0.0]);
        assert!((Fan::Crease { faces: 3 }.cosine() - 0.5).abs() < 1e-15);
    }
}
