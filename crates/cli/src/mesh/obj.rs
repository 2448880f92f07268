//! Welded meshes as Wavefront OBJ. Text has no fixed precision: coordinates keep all bits however far they are from
//! the origin.

use super::Mesh;
use crate::shortest::Shortest;
use osculate::UvOrigin;
use std::io::{self, Write};

/// Writes the mesh: positions, normals, texture coordinates, triangles that share the index of the first two.
pub(crate) fn write(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    for vertex in 0..mesh.positions.len() {
        let p = mesh.position(vertex);
        writeln!(out, "v {} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))?;
    }
    for n in &mesh.normals {
        writeln!(out, "vn {} {} {}", Shortest(n.x), Shortest(n.y), Shortest(n.z))?;
    }
    for [u, v] in mesh.uv.iter().flat_map(|uv| uv.values_from(UvOrigin::Bottom)) {
        writeln!(out, "vt {} {}", Shortest(u), Shortest(v))?;
    }
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = from_one(triangle);
        match &mesh.uv {
            Some(uv) => {
                let [s, t, u] = from_one(&uv.triangles[index]);
                writeln!(out, "f {a}/{s}/{a} {b}/{t}/{b} {c}/{u}/{c}")?;
            }
            None => writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?,
        }
    }
    Ok(())
}

/// Indices as the format counts them.
fn from_one(triangle: &[u32; 3]) -> [u64; 3] {
    triangle.map(|index| u64::from(index) + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::tests::{mapped_square, square};
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
    fn corners_have_texture_coordinates_with_v_upwards() {
        let written = |mesh: &Mesh| {
            let mut file = Vec::new();
            write(mesh, &mut file).unwrap();
            String::from_utf8(file).unwrap()
        };
        let mut mesh = mapped_square();
        let text = written(&mesh);
        assert!(text.contains("vt 1 0.75\nvt 0.5 0\n") && text.contains("vt 0 1\n"), "{text}");
        assert!(text.ends_with("f 1/1/1 2/2/2 3/3/3\nf 1/4/1 3/5/3 4/6/4\n"), "{text}");
        mesh.uv.as_mut().expect("texture coordinates").origin = UvOrigin::Top;
        assert!(written(&mesh).contains("vt 1 0.25\n"));
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
