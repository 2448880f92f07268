//! Welded meshes as PLY, binary, little-endian, with float coordinates.

use super::{Mesh, positive_zeros};
use std::io::{self, Write};

/// Writes the mesh: positions, normals, triangles.
pub(crate) fn write(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\n\
         property float nx\nproperty float ny\nproperty float nz\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len(),
    )?;
    for (vertex, &normal) in mesh.normals.iter().enumerate() {
        write_floats(out, mesh.position(vertex).as_vec3().to_array())?;
        write_floats(out, positive_zeros(normal).to_array())?;
    }
    mesh.triangles.iter().try_for_each(|&triangle| write_triangle(out, triangle))
}

/// Numbers, little-endian.
pub(super) fn write_floats<const N: usize>(out: &mut dyn Write, values: [f32; N]) -> io::Result<()> {
    values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
}

/// An element of `list uchar uint`: the count 3, then the indices.
pub(super) fn write_triangle(out: &mut dyn Write, triangle: [u32; 3]) -> io::Result<()> {
    out.write_all(&[3])?;
    triangle.iter().try_for_each(|index| out.write_all(&index.to_le_bytes()))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::mesh::tests::square;

    /// Splits a file into the lines of its header and the bytes after it.
    pub(in crate::mesh) fn split(file: &[u8]) -> (Vec<&str>, &[u8]) {
        let mark = b"end_header\n";
        let end = file.windows(mark.len()).position(|w| w == mark).unwrap() + mark.len();
        (std::str::from_utf8(&file[..end]).unwrap().lines().collect(), &file[end..])
    }

    pub(in crate::mesh) fn floats(bytes: &[u8]) -> Vec<f32> {
        bytes.as_chunks::<4>().0.iter().map(|&b| f32::from_le_bytes(b)).collect()
    }

    #[test]
    fn reads_back() {
        let mut file = Vec::new();
        write(&square(), &mut file).unwrap();
        let (header, body) = split(&file);
        assert_eq!(header[1], "format binary_little_endian 1.0");
        assert!(header.contains(&"element vertex 4") && header.contains(&"element face 2"));
        assert!(!file.contains(&b'\r'));
        assert_eq!(body.len(), 4 * 24 + 2 * 13);
        assert_eq!(floats(&body[24..48]), [11.0, 0.0, -3.0, 0.0, 0.0, 1.0]);
        assert_eq!(floats(&body[72..96]), [10.0, 1.5, -3.0, 0.0, 0.0, 1.0]);
        assert!(floats(&body[..96]).iter().all(|x| x.to_bits() != (-0.0_f32).to_bits()));
        assert_eq!(body[96 + 13], 3);
        let indices: Vec<u32> = body[96 + 14..].as_chunks::<4>().0.iter().map(|&b| u32::from_le_bytes(b)).collect();
        assert_eq!(indices, [0, 2, 3]);
    }
}
