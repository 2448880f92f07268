//! Polygons by the extension `FB_ngon_encoding`: a polygon is a fan of triangles in a row that start with the same corner, and
//! polygons in a row start with different corners.

use super::{FaceSource, Faces, Points};

/// Adds the polygons of triangles that are marked.
pub(super) fn add(triangles: &[[u32; 3]], points: &Points, faces: &mut Faces) {
    let mut start = 0;
    while start < triangles.len() {
        let len = 1 + triangles[start..].windows(2).take_while(|pair| continues(pair[0], pair[1])).count();
        let fan = &triangles[start..start + len];
        let polygon = without_repetitions(polygon(fan), points);
        if polygon.len() < 3 {
            faces.dropped += 1;
        } else {
            faces.report.triangles += len;
            faces.push(&polygon, FaceSource::Marked);
        }
        start += len;
    }
}

/// Triangles that start with the same corner but do not go on around it are two polygons, whatever the extension says.
fn continues(a: [u32; 3], b: [u32; 3]) -> bool {
    a[0] == b[0] && a[2] == b[1]
}

fn polygon(fan: &[[u32; 3]]) -> Vec<u32> {
    fan[0][..2].iter().copied().chain(fan.iter().map(|triangle| triangle[2])).collect()
}

/// Drops corners at the place of the corner before them.
fn without_repetitions(mut polygon: Vec<u32>, points: &Points) -> Vec<u32> {
    polygon.dedup_by_key(|point| points.vertex(*point));
    while polygon.len() > 1 && points.vertex(polygon[0]) == points.vertex(polygon[polygon.len() - 1]) {
        polygon.pop();
    }
    polygon
}
