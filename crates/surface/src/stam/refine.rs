//! One step of subdivision of a net: the matrices that the eigenstructure diagonalises.

use crate::matrix::Matrix;
use crate::net::NetKind;

/// Grid coordinates of the outer points O0..O6.
const OUTER: [(i32, i32); 7] = [(2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2)];

/// V with its ring: the first points of a net, which refine among themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fan {
    /// Number of faces at V.
    pub(super) faces: usize,
    /// Whether the faces go all the way round; otherwise the first and the last edge are sharp.
    pub(super) closed: bool,
}

impl Fan {
    /// The fan of a net with an irregular vertex.
    ///
    /// # Panics
    /// If the net is regular or not valid.
    pub(super) fn of(kind: NetKind) -> Self {
        assert!(kind.is_valid(), "{kind:?} does not exist: see NetKind::is_valid");
        match kind {
            NetKind::Regular => panic!("a regular net is one bicubic patch: it needs no eigenbasis"),
            NetKind::Interior { valence } => Self { faces: valence as usize, closed: true },
            NetKind::Crease { faces, .. } => Self { faces: faces as usize, closed: false },
        }
    }

    /// Number of edges at V.
    pub(super) fn edges(self) -> usize {
        self.faces + usize::from(!self.closed)
    }

    /// Number of points: V, edge and face neighbours.
    pub(super) fn size(self) -> usize {
        1 + self.edges() + self.faces
    }

    /// Index of edge neighbour i, cyclic if closed.
    fn edge(self, i: usize) -> usize {
        1 + 2 * (i % self.edges())
    }

    /// The Catmull-Clark rules on the ring: `size` x `size`.
    pub(super) fn step(self) -> Matrix {
        let face_points: Vec<Vec<f64>> = (0..self.faces).map(|i| self.face_point(i)).collect();
        let mut rows = vec![self.vertex_point(&face_points)];
        for i in 0..self.edges() {
            rows.push(self.edge_point(i, &face_points));
            rows.extend(face_points.get(i).cloned());
        }
        Matrix::from_rows(&rows)
    }

    fn face_point(self, i: usize) -> Vec<f64> {
        let mut row = vec![0.0; self.size()];
        for at in [0, self.edge(i), 2 + 2 * i, self.edge(i + 1)] {
            row[at] += 0.25;
        }
        row
    }

    fn edge_point(self, i: usize, face_points: &[Vec<f64>]) -> Vec<f64> {
        let sharp = !self.closed && (i == 0 || i == self.faces);
        let weight = if sharp { 0.5 } else { 0.25 };
        let mut row = vec![0.0; self.size()];
        row[0] = weight;
        row[self.edge(i)] = weight;
        if !sharp {
            add(&mut row, 0.25, &face_points[i]);
            add(&mut row, 0.25, &face_points[(i + self.faces - 1) % self.faces]);
        }
        row
    }

    fn vertex_point(self, face_points: &[Vec<f64>]) -> Vec<f64> {
        let mut row = vec![0.0; self.size()];
        if !self.closed {
            (row[0], row[1], row[2 * self.faces + 1]) = (0.75, 0.125, 0.125);
            return row;
        }
        let n = self.faces as f64;
        row[0] = (n - 2.0) / n;
        for (i, face_point) in face_points.iter().enumerate() {
            row[self.edge(i)] += 1.0 / (n * n);
            add(&mut row, 1.0 / (n * n), face_point);
        }
        row
    }
}

fn add(row: &mut [f64], factor: f64, other: &[f64]) {
    row.iter_mut().zip(other).for_each(|(r, o)| *r += factor * o);
}

/// Grid coordinates of the outer points that the net has, in net order: they follow the ring.
pub(super) fn outer_coordinates(kind: NetKind) -> Vec<(i32, i32)> {
    let beyond = |(x, y): (i32, i32)| (y < 0 && kind.side_is_sharp(0)) || (x < 0 && kind.side_is_sharp(3));
    OUTER.into_iter().filter(|&at| !beyond(at)).collect()
}

/// The matrix A: one step of the whole net, in the order of the net, K x K.
///
/// The ring follows the rules around V, an outer point the tensor rule of the grid.
pub(super) fn step(kind: NetKind) -> Matrix {
    let (fan, size) = (Fan::of(kind), kind.net_size());
    let ring = fan.step();
    let mut rows: Vec<Vec<f64>> = (0..fan.size())
        .map(|r| {
            let mut row = ring.row(r).to_vec();
            row.resize(size, 0.0);
            row
        })
        .collect();
    rows.extend(outer_coordinates(kind).into_iter().map(|(x, y)| tensor_rule(kind, x, y)));
    Matrix::from_rows(&rows)
}

/// Weights of the refined grid point (x, y) by the rules `(1,6,1)/8` and `(1,1)/2` along each axis.
fn tensor_rule(kind: NetKind, x: i32, y: i32) -> Vec<f64> {
    let taps = |x: i32| -> Vec<(i32, f64)> {
        let half = x.div_euclid(2);
        if x % 2 == 0 {
            vec![(half - 1, 0.125), (half, 0.75), (half + 1, 0.125)]
        } else {
            vec![(half, 0.5), (half + 1, 0.5)]
        }
    };
    let mut row = vec![0.0; kind.net_size()];
    for (x, p) in taps(x) {
        for &(y, q) in &taps(y) {
            kind.grid(x, y).add_to(&mut row, p * q);
        }
    }
    row
}

/// Refined grid points as weights over the net, given the step A of the net.
///
/// Coordinates up to 2 are those of the refined net (phantoms beyond a sharp edge are reflections of refined points);
/// those at 3 lie on the regular grid.
pub(super) fn refined_points(kind: NetKind, step: &Matrix, points: impl IntoIterator<Item = (i32, i32)>) -> Matrix {
    let row = |(x, y): (i32, i32)| {
        if x.max(y) > 2 {
            return tensor_rule(kind, x, y);
        }
        let mut point = vec![0.0; kind.net_size()];
        kind.grid(x, y).add_to(&mut point, 1.0);
        let mut row = vec![0.0; kind.net_size()];
        for (r, &weight) in point.iter().enumerate().filter(|(_, w)| **w != 0.0) {
            add(&mut row, weight, step.row(r));
        }
        row
    };
    Matrix::from_rows(&points.into_iter().map(row).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_refined_point_is_an_affine_combination() {
        for kind in [NetKind::Interior { valence: 2 }, NetKind::Interior { valence: 5 }]
            .into_iter()
            .chain((1..5).flat_map(|faces| (0..faces).map(move |quad| NetKind::Crease { faces, quad })))
        {
            let a = step(kind);
            assert_eq!((a.rows(), a.cols()), (kind.net_size(), kind.net_size()));
            for r in 0..a.rows() {
                assert!((a.row(r).iter().sum::<f64>() - 1.0).abs() < 1e-15, "{kind:?} row {r}");
            }
        }
    }

    #[test]
    fn valence_four_follows_the_grid_everywhere() {
        let kind = NetKind::Interior { valence: 4 };
        let a = step(kind);
        for (x, y) in [(0, 1), (1, 0), (1, 1), (-1, 1), (1, -1)] {
            let by_ring = refined_points(kind, &a, [(x, y)]);
            let by_grid = tensor_rule(kind, x, y);
            assert!(by_ring.row(0).iter().zip(&by_grid).all(|(a, b)| (a - b).abs() < 1e-15), "({x},{y})");
        }
    }

    #[test]
    #[should_panic(expected = "needs no eigenbasis")]
    fn regular_nets_are_refused() {
        step(NetKind::Regular);
    }
}
