//! A quad and everything that decides its limit surface: the quads that touch it, held as the stars
//! of its four corners.

use glam::DVec3;

use super::Boundary;
use super::bicubic::Grid;
use super::star::Star;

/// The stars of the corners of a quad, each with the quad as its core. Corner 0 is at (s,t) =
/// (0,0), 1 at (1,0), 2 at (1,1), 3 at (0,1). Points shared by several stars are held in each of
/// them, which spares all bookkeeping of indices.
#[derive(Clone, Debug)]
pub(super) struct Neighbourhood {
    pub(super) stars: [Star; 4],
}

impl Neighbourhood {
    /// A child quad of a face, from the refined stars around the corner of the face that it is at,
    /// the next corner, the previous corner, and the face point. Its corners are: the vertex point,
    /// the edge point to the next corner, the face point, the edge point to the previous corner.
    pub(super) fn of_child(here: Star, next: &Star, previous: &Star, face: Star) -> Self {
        let (leaving, arriving) = (leaving_edge_star(&here, next), arriving_edge_star(&here, previous));
        Self { stars: [here, leaving, face, arriving] }
    }

    /// The child at corner `corner` of this quad, turned so that its (s,t) run as those of the
    /// quad.
    pub(super) fn child(&self, corner: usize, rule: Boundary) -> Self {
        let mut refined = self.stars.each_ref().map(|star| star.refine(rule));
        refined.rotate_left(corner);
        let face = face_star(&refined);
        let [here, next, _, previous] = refined;
        Self::of_child(here, &next, &previous, face).turned(corner)
    }

    /// The same quad with its corner 0 named `corner`.
    pub(super) fn turned(mut self, corner: usize) -> Self {
        self.stars.rotate_right(corner);
        self
    }

    /// The first corner at an irregular vertex. One step after the first all quads have at most
    /// one.
    pub(super) fn irregular_corner(&self, rule: Boundary) -> Option<usize> {
        self.stars.iter().position(|star| !star.is_regular(rule))
    }

    /// Moves all points by `-origin`.
    pub(super) fn subtract(&mut self, origin: DVec3) {
        for star in &mut self.stars {
            star.subtract(origin);
        }
    }

    /// The bicubic control grid of the quad if all its corners are regular. Beyond a boundary it
    /// holds reflected points, 2a - b, with which the tensor rules of uniform cubic splines
    /// reproduce the rules of the boundary: 1:6:1 leaves (6 a + b + (2a - b))/8 = a of the column
    /// across the boundary.
    pub(super) fn regular_grid(&self, rule: Boundary) -> Option<Grid> {
        if self.irregular_corner(rule).is_some() {
            return None;
        }
        let mut grid = PartialGrid::default();
        for (corner, star) in self.stars.iter().enumerate() {
            grid.add(corner, star);
        }
        grid.reflected()
    }
}

/// The star around the edge point of the side that leaves corner `here` towards corner `next`.
fn leaving_edge_star(here: &Star, next: &Star) -> Star {
    let (centre, face_point) = (here.leaving(), here.diagonals[here.core]);
    match (here.diagonal(-1), here.spoke(-1), next.spoke(2)) {
        (Some(across), Some(beside_here), Some(beside_next)) => Star {
            centre,
            spokes: vec![face_point, here.centre, across, next.centre],
            diagonals: vec![here.arriving(), beside_here, beside_next, next.leaving()],
            core: 0,
        },
        _ => Star {
            centre,
            spokes: vec![next.centre, face_point, here.centre],
            diagonals: vec![next.leaving(), here.arriving()],
            core: 1,
        },
    }
}

/// The star around the edge point of the side that arrives at corner `here` from corner `previous`.
fn arriving_edge_star(here: &Star, previous: &Star) -> Star {
    let (centre, face_point) = (here.arriving(), here.diagonals[here.core]);
    match (here.diagonal(1), here.spoke(2), previous.spoke(-1)) {
        (Some(across), Some(beside_here), Some(beside_previous)) => Star {
            centre,
            spokes: vec![here.centre, face_point, previous.centre, across],
            diagonals: vec![here.leaving(), previous.arriving(), beside_previous, beside_here],
            core: 0,
        },
        _ => Star {
            centre,
            spokes: vec![here.centre, face_point, previous.centre],
            diagonals: vec![here.leaving(), previous.arriving()],
            core: 0,
        },
    }
}

/// The star around the face point of a quad, its core the child at the first corner.
fn face_star(refined: &[Star; 4]) -> Star {
    let [here, next, opposite, previous] = refined;
    Star {
        centre: here.diagonals[here.core],
        spokes: [previous, here, next, opposite].map(Star::leaving).to_vec(),
        diagonals: refined.each_ref().map(|star| star.centre).to_vec(),
        core: 0,
    }
}

/// A 4 x 4 grid that lacks the points beyond a boundary.
#[derive(Default)]
struct PartialGrid([[Option<DVec3>; 4]; 4]);

impl PartialGrid {
    /// Enters a star of valence four (or its part inside the boundary): the grid runs on straight
    /// through its centre.
    fn add(&mut self, corner: usize, star: &Star) {
        /// Around a star, from the first spoke of the core: each spoke, then the diagonal after it.
        const STEPS: [(i32, i32); 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];
        const CORNERS: [(i32, i32); 4] = [(1, 1), (2, 1), (2, 2), (1, 2)];
        let (x, y) = CORNERS[corner];
        self.0[y as usize][x as usize] = Some(star.centre);
        for number in -2..4 {
            for (point, step) in [(star.spoke(number), 2 * number), (star.diagonal(number), 2 * number + 1)] {
                // A quarter turn per corner is two places in the list.
                let (dx, dy) = STEPS[(step + 2 * corner as i32).rem_euclid(8) as usize];
                if let Some(point) = point {
                    self.0[(y + dy) as usize][(x + dx) as usize] = Some(point);
                }
            }
        }
    }

    /// Completes the grid with reflected points: rows first, then across them, so that a corner is
    /// reflected twice.
    fn reflected(self) -> Option<Grid> {
        let [below, first, second, above] = self.0.map(reflected_row);
        let (first, second) = (first?, second?);
        let beyond = |a: [DVec3; 4], b: [DVec3; 4]| std::array::from_fn(|x| 2.0 * a[x] - b[x]);
        Some(Grid([below.unwrap_or(beyond(first, second)), first, second, above.unwrap_or(beyond(second, first))]))
    }
}

/// A row with its missing ends reflected; `None` if all of it is beyond the boundary.
fn reflected_row([before, first, second, after]: [Option<DVec3>; 4]) -> Option<[DVec3; 4]> {
    let (first, second) = (first?, second?);
    Some([before.unwrap_or(2.0 * first - second), first, second, after.unwrap_or(2.0 * second - first)])
}
