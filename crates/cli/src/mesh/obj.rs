//! Welded meshes as Wavefront OBJ. Text has no fixed precision: coordinates keep all bits however far they are from
//! the origin.

use super::Mesh;
use crate::shortest::Shortest;
use std::io::{self, Write};

/// Writes the mesh: positions, normals, triangles that share the index of both.
pub(crate) fn write(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    for vertex in 0..mesh.positions.len() {
        let p = mesh.position(vertex);
        writeln!(out, "v {} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))?;
    }
    for n in &mesh.normals {
        writeln!(out, "vn {} {} {}", Shortest(n.x), Shortest(n.y), Shortest(n.z))?;
    }
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| u64::from(vertex) + 1);
        writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::tests::square;
    use glam::{DVec3, Vec3};
    use osculate::CageSpace;

    #[test]
    fn reads_back() {
        let mut file = Vec::new();
        write(&square(), &mut file).unwrap();
        let text = String::from_utf8(file).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 4 + 4 + 2);
        assert_eq!(lines[0], "v 10 0 -3");
        assert_eq!(lines[3], "v 10 1.5 -3");
        assert_eq!(lines[4], "vn 0 0 1");
        assert_eq!(lines[9], "f 1//1 3//3 4//4");
    }

    #[test]
    fn far_away_loses_nothing() {
        let mut mesh = square();
        mesh.space = CageSpace { centre: DVec3::splat(1e9), scale: 1.0 };
        mesh.positions[0] = Vec3::splat(0.001);
        let mut file = Vec::new();
        write(&mesh, &mut file).unwrap();
        let text = String::from_utf8(file).unwrap();
        let x: f64 = text.split_whitespace().nth(1).unwrap().parse().unwrap();
        assert_eq!(x, 1e9 + f64::from(0.001_f32));
    }
}
