//! Triangles as they were captured, each with three vertices of its own, as PLY.
//!
//! The header of a PLY file counts its vertices, which are known only at the end. Vertices are therefore spooled, in
//! the form in which they will be written, to a temporary file beside the output; memory stays the same however
//! many there are.

use super::ply::{write_floats, write_triangle};
use super::{object_space, positive_zeros};
use glam::Vec3;
use osculate::CageSpace;
use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;

/// A captured vertex with its place on the cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SoupVertex {
    /// Position in cage space.
    pub(crate) position: Vec3,
    /// Unit normal, or zero.
    pub(crate) normal: Vec3,
    /// Face of the cage, from 0.
    pub(crate) face: i32,
    /// -1 for a quad, else the corner of the face.
    pub(crate) sub: i32,
    /// Place on the unit square of the face or sub-face.
    pub(crate) st: [f32; 2],
}

/// Vertices in the order of capture, three per triangle.
pub(crate) struct Soup {
    space: CageSpace,
    spool: BufWriter<File>,
    vertices: u64,
}

impl Soup {
    /// Bytes of a vertex: eight floats and two ints.
    const VERTEX_BYTES: u64 = 40;

    /// An empty soup with positions in `space`, spooled to a nameless file in the folder of `output`.
    pub(crate) fn new(space: CageSpace, output: &Path) -> io::Result<Self> {
        let folder = match output.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        Ok(Self { space, spool: BufWriter::new(tempfile::tempfile_in(folder)?), vertices: 0 })
    }

    /// How many vertices there are so far.
    pub(crate) fn vertices(&self) -> u64 {
        self.vertices
    }

    /// Adds a vertex.
    pub(crate) fn push(&mut self, vertex: &SoupVertex) -> io::Result<()> {
        let out = &mut self.spool;
        write_floats(out, object_space(&self.space, vertex.position).as_vec3().to_array())?;
        write_floats(out, positive_zeros(vertex.normal).to_array())?;
        out.write_all(&vertex.face.to_le_bytes())?;
        out.write_all(&vertex.sub.to_le_bytes())?;
        write_floats(out, vertex.st.map(|x| x + 0.0))?;
        self.vertices += 1;
        Ok(())
    }

    /// Writes header, vertices and triangles.
    pub(crate) fn write(self, out: &mut dyn Write) -> io::Result<()> {
        let Ok(vertices) = u32::try_from(self.vertices) else {
            return Err(io::Error::other("more vertices than 32-bit indices can count; lower the level"));
        };
        write!(
            out,
            "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n\
             property float x\nproperty float y\nproperty float z\n\
             property float nx\nproperty float ny\nproperty float nz\n\
             property int face\nproperty int sub\nproperty float s\nproperty float t\n\
             element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
            vertices / 3,
        )?;
        let mut spool = self.spool.into_inner().map_err(io::IntoInnerError::into_error)?;
        spool.rewind()?;
        let copied = io::copy(&mut spool, out)?;
        debug_assert_eq!(copied, self.vertices * Self::VERTEX_BYTES);
        (0..vertices / 3).try_for_each(|i| write_triangle(out, [3 * i, 3 * i + 1, 3 * i + 2]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::ply::tests::{floats, split};
    use glam::DVec3;

    #[test]
    fn reads_back() {
        let folder = tempfile::tempdir().unwrap();
        let space = CageSpace { centre: DVec3::new(1.0, 2.0, -0.0), scale: 1.0 };
        let mut soup = Soup::new(space, &folder.path().join("a.ply")).unwrap();
        for i in 0..6_u8 {
            let st = [f32::from(i) / 8.0, -0.0];
            let position = Vec3::new(f32::from(i), 0.0, -0.0);
            soup.push(&SoupVertex { position, normal: -Vec3::Z, face: 7, sub: i32::from(i) - 1, st }).unwrap();
        }
        let mut file = Vec::new();
        soup.write(&mut file).unwrap();
        let (header, body) = split(&file);
        let expected = "ply|format binary_little_endian 1.0|element vertex 6|property float x|property float y|property float z|\
            property float nx|property float ny|property float nz|property int face|property int sub|property float s|property float t|\
            element face 2|property list uchar uint vertex_indices|end_header";
        assert_eq!(header.join("|"), expected);
        assert_eq!(body.len(), 6 * 40 + 2 * 13);
        let fourth = &body[120..160];
        assert_eq!(floats(&fourth[..24]), [4.0, 2.0, 0.0, 0.0, 0.0, -1.0]);
        assert_eq!(fourth[24..32], [7, 0, 0, 0, 2, 0, 0, 0]);
        assert_eq!(floats(&fourth[32..]), [0.375, 0.0]);
        for vertex in body[..240].chunks(40) {
            let all = [floats(&vertex[..24]), floats(&vertex[32..])].concat();
            assert!(all.iter().all(|x| x.to_bits() != (-0.0_f32).to_bits()), "{all:?}");
        }
        assert_eq!(body[240..253], [3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
        assert_eq!(body[253..266], [3, 3, 0, 0, 0, 4, 0, 0, 0, 5, 0, 0, 0]);
    }

    #[test]
    fn the_spool_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let soup = Soup::new(CageSpace { centre: DVec3::ZERO, scale: 1.0 }, &folder.path().join("a.ply")).unwrap();
        soup.write(&mut Vec::new()).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
