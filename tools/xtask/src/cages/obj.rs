//! OBJ text of a mesh.

use std::fmt::Write;

use super::mesh::Mesh;

/// Decimals of every coordinate: coarse enough that a machine's own sine cannot show, fine enough for any cage.
const DECIMALS: usize = 5;

/// The OBJ text of `mesh` under one comment line.
pub(super) fn to_obj(mesh: &Mesh, comment: &str) -> String {
    let mut text = format!("# {comment}\n");
    for p in &mesh.points {
        line(&mut text, &format!("v {} {} {}", decimal(p.x), decimal(p.y), decimal(p.z)));
    }
    for p in mesh.uv.iter().flat_map(|uv| &uv.points) {
        line(&mut text, &format!("vt {} {}", decimal(p.x), decimal(p.y)));
    }
    for (index, face) in mesh.faces.iter().enumerate() {
        text.push('f');
        for (corner, vertex) in face.iter().enumerate() {
            let _ = match &mesh.uv {
                Some(uv) => write!(text, " {}/{}", vertex + 1, uv.faces[index][corner] + 1),
                None => write!(text, " {}", vertex + 1),
            };
        }
        text.push('\n');
    }
    mesh.tags.iter().for_each(|tag| line(&mut text, tag));
    text
}

fn line(text: &mut String, content: &str) {
    text.push_str(content);
    text.push('\n');
}

/// A number with at most [`DECIMALS`] decimals and no trailing zero, never `-0`.
fn decimal(value: f64) -> String {
    let fixed = format!("{value:.DECIMALS$}");
    match fixed.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".into(),
        trimmed => trimmed.into(),
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::super::mesh::Uv;
    use super::*;

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        let cases = [(0.1, "0.1"), (-1e-9, "0"), (100.0, "100"), (-2.0, "-2"), (1.0 / 3.0, "0.33333")];
        for (value, expected) in cases {
            assert_eq!(decimal(value), expected);
        }
    }

    #[test]
    fn indices_start_at_one_and_tags_come_last() {
        let mut mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![vec![0, 1, 2]]);
        mesh.tags.push("t corner 1/1/0 0 1");
        assert_eq!(to_obj(&mesh, "a"), "# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nt corner 1/1/0 0 1\n");
        mesh.tags.clear();
        mesh.uv = Some(Uv { points: vec![DVec2::ZERO], faces: vec![vec![0, 0, 0]] });
        assert_eq!(to_obj(&mesh, "a"), "# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    }
}
