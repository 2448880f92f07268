//! From the right half to the whole: mirror image, texture coordinates.

use glam::{DVec2, dvec2};

use super::super::mesh::{Mesh, Uv, Welder};
use super::half::{Cell, Half, Sheet, reflect};
use super::pack::pack;

/// Space between charts, in units of the model.
const MARGIN: f64 = 0.03;

/// Where a vertex of the whole comes from: a vertex of the half, and whether this is its mirror image.
pub(super) type Source = (usize, bool);

/// Half and mirror image as one mesh, and where its vertices come from. A sheet on the plane of symmetry makes one chart, any other
/// sheet two.
pub(super) fn whole(half: &Half) -> (Mesh, Vec<Source>) {
    let charts = Charts::of(half);
    let (mut points, mut uv) = (Welder::new(), Welder::new());
    let (mut faces, mut uv_faces) = (Vec::new(), Vec::new());
    for left in [false, true] {
        for &cell in &half.cells {
            let mut face: Vec<usize> = half.corners(cell).map(|vertex| weld(&mut points, half, vertex, left)).into();
            let mut coordinates: Vec<usize> = grid_corners(cell)
                .map(|(row, column)| {
                    let key = charts.key(half, cell.sheet, row, column, left);
                    uv.index(key, || charts.coordinate(key))
                })
                .into();
            if left {
                // The mirror image turns the other way; corner 0 stays where it is.
                face[1..].reverse();
                coordinates[1..].reverse();
            }
            faces.push(face);
            uv_faces.push(coordinates);
        }
    }
    let place = |&(vertex, left): &Source| if left { reflect(half.points[vertex]) } else { half.points[vertex] };
    let mesh = Mesh::new(points.points.iter().map(place).collect(), faces);
    (Mesh { uv: Some(Uv { points: uv.points, faces: uv_faces }), ..mesh }, points.points)
}

fn weld(welder: &mut Welder<Source, Source>, half: &Half, vertex: usize, left: bool) -> usize {
    let source = (vertex, left && half.points[vertex].x != 0.0);
    welder.index(source, || source)
}

/// Row and column of a quad's corners, columns not wrapped: a closed sheet has a seam.
fn grid_corners(Cell { row, column, .. }: Cell) -> [(usize, usize); 4] {
    [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
}

/// Sheet, row and column of a texture coordinate, and whether it is that of the mirror image.
type Key = (usize, usize, usize, bool);

/// Where every sheet lies in the texture.
struct Charts {
    /// Flat coordinates of every sheet by row and column, in units of the model, from its own corner.
    flat: Vec<Vec<Vec<DVec2>>>,
    /// Extent of every sheet.
    extent: Vec<DVec2>,
    /// Whether a sheet and its mirror image share a chart.
    midline: Vec<bool>,
    /// Corner of every chart in the texture: of sheets, then of mirror images.
    corner: Vec<DVec2>,
    scale: f64,
}

impl Charts {
    fn of(half: &Half) -> Self {
        let flat: Vec<Vec<Vec<DVec2>>> = half.sheets.iter().map(|sheet| flatten(half, sheet)).collect();
        let midline: Vec<bool> = half.sheets.iter().map(|sheet| sheet.midline).collect();
        let reach = |rows: &Vec<Vec<DVec2>>| rows.iter().flatten().fold(DVec2::ZERO, |most, p| most.max(*p));
        let extent: Vec<DVec2> = flat.iter().map(reach).collect();
        let size = |sheet: usize| extent[sheet] * dvec2(if midline[sheet] { 2.0 } else { 1.0 }, 1.0);
        let own = (0..flat.len()).map(size);
        let mirrored = (0..flat.len()).map(|sheet| if midline[sheet] { DVec2::ZERO } else { size(sheet) });
        let (corner, side) = pack(&own.chain(mirrored).collect::<Vec<_>>(), MARGIN);
        Self { flat, extent, midline, corner, scale: 1.0 / side }
    }

    /// The one name of a coordinate: on the plane of symmetry both halves share it.
    fn key(&self, half: &Half, sheet: usize, row: usize, column: usize, left: bool) -> Key {
        let grid = &half.sheets[sheet];
        let shared = grid.midline && column == 0;
        (sheet, row, column, left && !shared)
    }

    fn coordinate(&self, (sheet, row, column, left): Key) -> DVec2 {
        let (p, extent) = (self.flat[sheet][row][column], self.extent[sheet]);
        let place = match (self.midline[sheet], left) {
            (true, false) => dvec2(extent.x + p.x, p.y),
            (true, true) => dvec2(extent.x - p.x, p.y),
            (false, false) => p,
            (false, true) => dvec2(extent.x - p.x, p.y),
        };
        let chart = if left && !self.midline[sheet] { self.flat.len() + sheet } else { sheet };
        self.scale * (self.corner[chart] + place)
    }
}

/// Lays a sheet flat: along a row by the lengths of its edges, from row to row by their mean.
fn flatten(half: &Half, sheet: &Sheet) -> Vec<Vec<DVec2>> {
    let point = |row: usize, column: usize| half.points[sheet.rows[row][column % sheet.rows[row].len()]];
    let columns = sheet.rows[0].len() + usize::from(sheet.closed);
    let lengths: Vec<Vec<f64>> = (0..sheet.rows.len())
        .map(|row| {
            let mut length = 0.0;
            let step = |column: usize| {
                length += if column == 0 { 0.0 } else { point(row, column).distance(point(row, column - 1)) };
                length
            };
            (0..columns).map(step).collect()
        })
        .collect();
    let widest = lengths.iter().map(|row| row[columns - 1]).fold(0.0, f64::max);
    let mut height = 0.0;
    (0..sheet.rows.len())
        .map(|row| {
            if row > 0 {
                let steps = (0..columns).map(|column| point(row, column).distance(point(row - 1, column)));
                height += steps.sum::<f64>() / columns as f64;
            }
            let start = if sheet.midline { 0.0 } else { 0.5 * (widest - lengths[row][columns - 1]) };
            lengths[row].iter().map(|length| dvec2(start + length, height)).collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::symmetric;
    use super::*;

    #[test]
    fn the_whole_is_its_own_mirror_image() {
        let key = |p: DVec3| [p.x, p.y, p.z].map(|x| (x * 1e9).round() as i64);
        let (mesh, _) = whole(&symmetric());
        let points: std::collections::BTreeSet<_> = mesh.points.iter().map(|p| key(*p)).collect();
        assert!(mesh.points.iter().all(|p| points.contains(&key(reflect(*p)))));
    }

    #[test]
    fn no_face_is_flipped_or_collapsed_in_the_texture() {
        let uv = whole(&symmetric()).0.uv.expect("texture coordinates");
        for face in &uv.faces {
            let [a, b, c, d] = [0, 1, 2, 3].map(|corner| uv.points[face[corner]]);
            assert!((c - a).perp_dot(d - b) > 1e-7, "{face:?}");
        }
    }
}
