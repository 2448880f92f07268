//! The right half of the creature while it grows: quads in named sheets, cut and extended until the half is mirrored.
//!
//! A sheet is a grid of vertices, `rows` by `columns`; its quads are (r,c), (r,c+1), (r+1,c+1), (r+1,c), counter-clockwise
//! seen from outside. Every face belongs to a sheet, and every sheet is one chart of the texture.

use std::ops::Range;

use glam::{DVec3, dvec3};

/// Index of a sheet.
pub(super) type SheetId = usize;

/// What a vertex belongs to: which joints may move it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Part {
    /// The loft from nose to tail.
    #[default]
    Trunk,
    /// Eyes, nostrils and horns.
    Head,
    Ear,
    Foreleg,
    HindLeg,
    Wing,
    /// The spines along the back.
    Ridge,
}

/// A grid of vertices.
pub(super) struct Sheet {
    /// Vertices by row and column.
    pub(super) rows: Vec<Vec<usize>>,
    /// Whether the last column is followed by the first.
    pub(super) closed: bool,
    /// Whether column 0 lies on the plane of symmetry, so that the sheet goes on in its mirror image.
    pub(super) midline: bool,
}

/// A quad at row and column of a sheet.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    pub(super) sheet: SheetId,
    pub(super) row: usize,
    pub(super) column: usize,
}

/// The right half of a symmetric quad mesh.
#[derive(Default)]
pub(super) struct Half {
    pub(super) points: Vec<DVec3>,
    /// How far fairing moves each vertex towards the middle of its neighbours, from 0 (fixed) to 1.
    pub(super) softness: Vec<f64>,
    /// The part of each vertex.
    pub(super) parts: Vec<Part>,
    /// The part that grows: that of new vertices.
    pub(super) growing: Part,
    pub(super) sheets: Vec<Sheet>,
    pub(super) cells: Vec<Cell>,
}

impl Half {
    /// Adds vertices of one softness.
    pub(super) fn add(&mut self, points: impl IntoIterator<Item = DVec3>, softness: f64) -> Vec<usize> {
        let first = self.points.len();
        self.points.extend(points);
        self.softness.resize(self.points.len(), softness);
        self.parts.resize(self.points.len(), self.growing);
        (first..self.points.len()).collect()
    }

    /// Adds a sheet with all its quads.
    pub(super) fn add_sheet(&mut self, sheet: Sheet) -> SheetId {
        let id = self.sheets.len();
        let columns = sheet.rows[0].len() - usize::from(!sheet.closed);
        for row in 0..sheet.rows.len() - 1 {
            self.cells.extend((0..columns).map(|column| Cell { sheet: id, row, column }));
        }
        self.sheets.push(sheet);
        id
    }

    /// The four vertices of a quad, counter-clockwise seen from outside.
    pub(super) fn corners(&self, cell: Cell) -> [usize; 4] {
        let sheet = &self.sheets[cell.sheet];
        let next = (cell.column + 1) % sheet.rows[cell.row].len();
        let (low, high) = (&sheet.rows[cell.row], &sheet.rows[cell.row + 1]);
        [low[cell.column], low[next], high[next], high[cell.column]]
    }

    /// Removes the quads of a sheet in a rectangle and returns the rim, counter-clockwise seen from outside. From column
    /// 0 of a midline sheet the rim is a path that starts and ends on the plane of symmetry.
    pub(super) fn cut(&mut self, sheet: SheetId, rows: Range<usize>, columns: Range<usize>) -> Vec<usize> {
        let inside = |cell: &Cell| cell.sheet == sheet && rows.contains(&cell.row) && columns.contains(&cell.column);
        self.cells.retain(|cell| !inside(cell));
        let grid = &self.sheets[sheet].rows;
        let width = grid[rows.start].len();
        let at = |row: usize, column: usize| grid[row][column % width];
        let mut rim: Vec<usize> = columns.clone().map(|column| at(rows.start, column)).collect();
        rim.extend(rows.clone().map(|row| at(row, columns.end)));
        rim.extend((columns.start + 1..=columns.end).rev().map(|column| at(rows.end, column)));
        if self.sheets[sheet].midline && columns.start == 0 {
            rim.push(at(rows.end, 0));
        } else {
            rim.extend((rows.start + 1..=rows.end).rev().map(|row| at(row, columns.start)));
        }
        rim
    }

    /// Closes a rim with a grid `across` quads wide and `along` quads long, raised by `dome` at its middle. The rim runs
    /// first across; a rim on the plane of symmetry starts there, and `across` counts the quads of the right half.
    pub(super) fn cap(&mut self, rim: &[usize], across: usize, along: usize, dome: DVec3) -> SheetId {
        let closed = rim.len() == 2 * (across + along);
        assert!(closed || rim.len() == 2 * across + along + 1, "a rim of {} vertices", rim.len());
        let at = |column: usize, row: usize| match (column, row) {
            (column, 0) => Some(rim[column]),
            (column, row) if column == across => Some(rim[across + row]),
            (column, row) if row == along => Some(rim[2 * across + along - column]),
            (0, row) if closed => Some(rim[2 * (across + along) - row]),
            _ => None,
        };
        let mut rows = Vec::new();
        for row in 0..=along {
            let mut vertices = Vec::new();
            for column in 0..=across {
                vertices.push(at(column, row).unwrap_or_else(|| {
                    let point = self.coons(&at, [across, along], [column, row], closed, dome);
                    self.add([point], 0.5)[0]
                }));
            }
            rows.push(vertices);
        }
        // A sheet's quads turn from columns to rows, as the rim does.
        self.add_sheet(Sheet { rows, closed: false, midline: !closed })
    }

    /// A point inside a cap: Coons' bilinearly blended patch of the rim, which an open rim continues by reflection.
    fn coons(
        &self,
        at: &dyn Fn(usize, usize) -> Option<usize>,
        [across, along]: [usize; 2],
        [column, row]: [usize; 2],
        closed: bool,
        dome: DVec3,
    ) -> DVec3 {
        let rim = |column: usize, row: usize| self.points[at(column, row).expect("a vertex of the rim")];
        let t = row as f64 / along as f64;
        let (s, left) = if closed {
            (column as f64 / across as f64, [rim(0, 0), rim(0, row), rim(0, along)])
        } else {
            let s = 0.5 + 0.5 * column as f64 / across as f64;
            (s, [rim(across, 0), rim(across, row), rim(across, along)].map(reflect))
        };
        let right = [rim(across, 0), rim(across, row), rim(across, along)];
        let ruled = left[1].lerp(right[1], s) + rim(column, 0).lerp(rim(column, along), t);
        let corners = left[0].lerp(right[0], s).lerp(left[2].lerp(right[2], s), t);
        ruled - corners + 16.0 * s * (1.0 - s) * t * (1.0 - t) * dome
    }

    /// Makes vertices at least as soft as this.
    pub(super) fn soften(&mut self, vertices: &[usize], softness: f64) {
        vertices.iter().for_each(|&vertex| self.softness[vertex] = self.softness[vertex].max(softness));
    }

    /// Middle of some vertices.
    pub(super) fn middle(&self, vertices: &[usize]) -> DVec3 {
        vertices.iter().map(|&vertex| self.points[vertex]).sum::<DVec3>() / vertices.len() as f64
    }
}

/// Mirror image in the plane of symmetry.
pub(super) fn reflect(p: DVec3) -> DVec3 {
    dvec3(-p.x, p.y, p.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flat sheet in the plane y = 0, its outside above, with column 0 at x = 0.
    fn flat(midline: bool) -> (Half, SheetId) {
        let mut half = Half::default();
        let mut row = |z: i32| half.add((0..4).map(|x| dvec3(f64::from(x), 0.0, f64::from(-z))), 0.0);
        let rows = (0..4).map(&mut row).collect();
        let sheet = half.add_sheet(Sheet { rows, closed: false, midline });
        (half, sheet)
    }

    fn upward(half: &Half, cell: Cell) -> f64 {
        let [a, b, c, d] = half.corners(cell).map(|vertex| half.points[vertex]);
        (c - a).cross(d - b).y
    }

    #[test]
    fn a_cap_fills_what_was_cut() {
        for (midline, columns) in [(false, 1..3), (true, 0..2)] {
            let (mut half, sheet) = flat(midline);
            let rim = half.cut(sheet, 1..3, columns.clone());
            assert_eq!(rim.len(), if midline { 7 } else { 8 });
            assert_eq!(half.cells.len(), 5);
            let cap = half.cap(&rim, 2, 2, DVec3::ZERO);
            assert_eq!(half.cells.len(), 9);
            let added: Vec<Cell> = half.cells.iter().copied().filter(|cell| cell.sheet == cap).collect();
            assert!(added.iter().all(|cell| (upward(&half, *cell) - 2.0).abs() < 1e-12), "midline {midline}");
        }
    }
}
