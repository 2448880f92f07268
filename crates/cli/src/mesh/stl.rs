//! Meshes as binary STL: for each triangle its plane's normal and three points, nothing shared.

use super::Mesh;
use super::ply::write_floats;
use glam::DVec3;
use std::io::{self, Write};

/// Writes the triangles.
pub(crate) fn write(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    let Ok(count) = u32::try_from(mesh.triangles.len()) else {
        return Err(io::Error::other("more triangles than an STL file can count; lower the level or write PLY"));
    };
    // A header must not begin with "solid", which is how text files do.
    let mut header = [b' '; 80];
    let title = b"binary STL, triangles of a subdivision surface";
    header[..title.len()].copy_from_slice(title);
    out.write_all(&header)?;
    out.write_all(&count.to_le_bytes())?;
    mesh.triangles.iter().try_for_each(|triangle| write_triangle(out, triangle.map(|v| mesh.position(v as usize))))
}

fn write_triangle(out: &mut dyn Write, points: [DVec3; 3]) -> io::Result<()> {
    let [a, b, c] = points;
    let normal = (b - a).cross(c - a).normalize_or_zero() + DVec3::ZERO;
    for vector in [normal, a, b, c] {
        write_floats(out, vector.as_vec3().to_array())?;
    }
    out.write_all(&[0; 2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::ply::tests::floats;
    use crate::mesh::tests::square;

    #[test]
    fn reads_back() {
        let mut mesh = square();
        mesh.triangles.push([0, 0, 1]);
        let mut file = Vec::new();
        write(&mesh, &mut file).unwrap();
        assert_eq!(file.len(), 84 + 3 * 50);
        assert!(!file.starts_with(b"solid"));
        assert_eq!(file[80..84], [3, 0, 0, 0]);
        let second = floats(&file[134..182]);
        assert_eq!(second, [0.0, 0.0, 1.0, 10.0, 0.0, -3.0, 11.0, 1.0, -3.0, 10.0, 1.5, -3.0]);
        assert_eq!(floats(&file[184..196]), [0.0; 3], "a triangle without area has no normal");
    }
}
