//! Texture coordinates: a primvar of pairs of numbers.

use glam::DVec2;

use super::UsdError;
use super::mesh::{Faces, Mesh, texture_attribute};

/// Values and the one of each face corner of a mesh, in the order of the file.
pub(super) struct Primvar {
    pub(super) values: Vec<DVec2>,
    pub(super) corners: Vec<u32>,
    /// True if the file tells values apart by their numbers, false if by nothing but themselves.
    pub(super) is_numbered: bool,
}

/// The texture coordinates of a mesh, if it has any.
pub(super) fn texture_coordinates(mesh: &Mesh, faces: &Faces) -> Result<Option<Primvar>, UsdError> {
    let Some(attribute) = texture_attribute(mesh.prim()) else { return Ok(None) };
    let name = &attribute.name;
    let numbers = mesh.numbers(name, 2)?;
    if numbers.is_empty() {
        return Ok(None);
    }
    let values: Vec<DVec2> = numbers.chunks_exact(2).map(|uv| DVec2::new(uv[0], uv[1])).collect();
    let index_name = format!("{name}:indices");
    let indices = match mesh.prim().attribute(&index_name) {
        Some(_) => Some(mesh.indices(&index_name, "uv", values.len())?),
        None => None,
    };
    let found = indices.as_ref().map_or(values.len(), Vec::len);
    let of_element = |element: usize| indices.as_ref().map_or(element as u32, |indices| indices[element]);
    let by = |due: usize, why| {
        let of = if indices.is_some() { &index_name } else { name };
        mesh.count(of, found, due, why)
    };
    let corners: Vec<u32> = match attribute.interpolation.as_deref() {
        Some("faceVarying") => {
            by(faces.vertices.len(), "one for each face corner")?;
            (0..faces.vertices.len()).map(of_element).collect()
        }
        Some("vertex" | "varying") => {
            by(faces.points, "one for each vertex")?;
            faces.vertices.iter().map(|&v| of_element(v as usize)).collect()
        }
        Some("uniform") => {
            by(faces.counts.len(), "one for each face")?;
            let corners = faces.counts.iter().enumerate();
            corners.flat_map(|(f, &count)| std::iter::repeat_n(of_element(f), count)).collect()
        }
        // What holds for the whole mesh tells nothing apart.
        None | Some("constant") => return Ok(None),
        Some(other) => {
            let problem = format!("interpolation {:?} is unknown", crate::text::quoted(other.as_bytes()));
            return Err(mesh.problem(name, problem));
        }
    };
    let is_numbered = indices.is_some() || attribute.interpolation.as_deref() != Some("faceVarying");
    Ok(Some(Primvar { values, corners, is_numbered }))
}
