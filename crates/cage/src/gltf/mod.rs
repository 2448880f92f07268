//! glTF 2.0, as `.gltf` with its buffers or as `.glb`.
//!
//! Triangles are taken as they are, in scene placement. Vertices that exporters split at seams of normals and uv are welded again
//! by exact position, and uv are kept per corner. The `gltf` crate reads the JSON and checks references inside it; everything
//! about bytes is checked here, because the crate reads wrong component types silently.

mod accessor;
mod base64;
mod buffers;
mod error;
mod primitive;
mod scene;
mod soup;
#[cfg(test)]
mod tests;

use std::path::Path;

use ::gltf::json::Root;
use ::gltf::json::validation::Checked;
use ::gltf::{Document, Gltf, Semantic};

pub use error::{AccessorError, GltfError};

use crate::{Cage, CageError, ReadError, Warning};
use buffers::Buffers;
use soup::{Soup, Weld};

/// Reads the bytes of a glTF file, JSON or binary; `name` is the name of the file for messages, `folder` where its external buffers are.
///
/// # Errors
/// [`ReadError::Gltf`] for a malformed file, [`ReadError::Refused`] for a mesh that cannot be a cage.
pub fn read_gltf(bytes: &[u8], name: &str, folder: Option<&Path>) -> Result<Cage, ReadError> {
    let soup = read_soup(bytes, folder).map_err(|error| ReadError::Gltf { file: name.into(), error })?;
    build(&soup).map_err(|error| ReadError::Refused { file: name.into(), line: None, error })
}

fn read_soup(bytes: &[u8], folder: Option<&Path>) -> Result<Soup, GltfError> {
    let gltf = parse(bytes)?;
    let buffers = Buffers::load(&gltf, folder)?;
    let mut soup = Soup::default();
    for placed in scene::placed_meshes(&gltf)? {
        primitive::add_mesh(&placed, &buffers, &mut soup)?;
    }
    if soup.is_empty() { Err(GltfError::NoTriangles) } else { Ok(soup) }
}

fn parse(bytes: &[u8]) -> Result<Gltf, GltfError> {
    // The crate subtracts the size of the header from the length without a check.
    if let Some(header) = bytes.strip_prefix(b"glTF") {
        let length = header.get(4..8).map(|l| u32::from_le_bytes([l[0], l[1], l[2], l[3]]));
        if length.is_none_or(|length| length < 20) {
            return Err(GltfError::Format("the header of the binary file is cut short".into()));
        }
    }
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(malformed)?;
    let json = document.into_json();
    check_positions(&json)?;
    Ok(Gltf { document: Document::from_json(json).map_err(malformed)?, blob })
}

/// A message of the crate in one line.
fn malformed(error: ::gltf::Error) -> GltfError {
    let lines = error.to_string();
    GltfError::Format(
        lines.split(['\n', ';']).map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join("; "),
    )
}

/// The validation of the crate looks up the positions of a primitive without a check.
fn check_positions(root: &Root) -> Result<(), GltfError> {
    for (mesh, primitives) in root.meshes.iter().map(|mesh| &mesh.primitives).enumerate() {
        for (primitive, attributes) in primitives.iter().map(|primitive| &primitive.attributes).enumerate() {
            let accessor = attributes.get(&Checked::Valid(Semantic::Positions));
            if accessor.is_none_or(|accessor| accessor.value() >= root.accessors.len()) {
                return Err(GltfError::NoPositions { mesh, primitive });
            }
        }
    }
    Ok(())
}

/// Welds across the whole scene if that is a manifold mesh, else node by node: objects that merely touch stay apart.
fn build(soup: &Soup) -> Result<Cage, CageError> {
    match Cage::new(soup.assemble(Weld::Scene)) {
        Err(CageError::Topology(_)) if soup.parts() > 1 => {
            let mut desc = soup.assemble(Weld::Nodes);
            desc.warnings.push(Warning::WeldedByNode(soup.parts()));
            Cage::new(desc)
        }
        result => result,
    }
}
