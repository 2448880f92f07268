//! Welded meshes as GLB, the binary form of glTF 2.0: one mesh of one primitive with positions, normals, 32-bit indices, and texture
//! coordinates if there are any. The format has one index for all of these, so there are as many vertices at a place as texture coordinates.

use super::ply::write_floats;
use super::{Mesh, positive_zeros};
use glam::{DVec3, Vec3};
use osculate::{CageSpace, UvOrigin};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::io::{self, Write};

// Numbers that the format gives names to: component types and buffer targets are those of OpenGL.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// A centre farther away than this many sizes of the mesh becomes the node's translation. Added to the positions it
/// would cost them 6 of their 24 bits or more.
const FAR: f64 = 64.0;

/// Writes the mesh, which has at least one triangle (the format knows no empty accessors).
pub(crate) fn write(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    if mesh.triangles.is_empty() {
        return Err(io::Error::other("a GLB file cannot hold an empty mesh"));
    }
    let mesh = &*cut_at_seams(mesh);
    let (translation, positions) = place(mesh);
    let mut json = serde_json::to_vec(&document(mesh, translation, &positions))?;
    // Chunks are multiples of four bytes; text is padded with spaces.
    json.resize(json.len().next_multiple_of(4), b' ');
    let binary = binary_bytes(mesh);
    let total = 12 + 8 + json.len() + 8 + binary;
    if u32::try_from(total).is_err() {
        return Err(io::Error::other("more than the 4 GiB a GLB file can hold; lower the level or write PLY"));
    }
    out.write_all(b"glTF")?;
    write_sizes(out, [2, total])?;
    write_sizes(out, [json.len()])?;
    out.write_all(b"JSON")?;
    out.write_all(&json)?;
    write_sizes(out, [binary])?;
    out.write_all(b"BIN\0")?;
    for &vector in &positions {
        write_floats(out, positive_zeros(vector).to_array())?;
    }
    for &normal in &mesh.normals {
        write_floats(out, positive_zeros(unit(normal)).to_array())?;
    }
    mesh.triangles.iter().flatten().try_for_each(|index| out.write_all(&index.to_le_bytes()))?;
    let mut uv = mesh.uv.iter().flat_map(|uv| uv.values_from(UvOrigin::Top));
    uv.try_for_each(|uv| write_floats(out, uv))
}

/// The mesh with a vertex for each of its texture coordinates.
fn cut_at_seams(mesh: &Mesh) -> Cow<'_, Mesh> {
    let Some(uv) = &mesh.uv else { return Cow::Borrowed(mesh) };
    let of_each = |values: &[Vec3]| uv.vertices.iter().map(|&vertex| values[vertex as usize]).collect();
    Cow::Owned(Mesh {
        space: mesh.space,
        positions: of_each(&mesh.positions),
        normals: of_each(&mesh.normals),
        triangles: uv.triangles.clone(),
        uv: Some(uv.clone()),
    })
}

/// A normal as the format wants it, of length 1 even where there is none.
fn unit(normal: Vec3) -> Vec3 {
    if normal == Vec3::ZERO { Vec3::Z } else { normal }
}

/// Where the node stands and what is left of the positions.
fn place(mesh: &Mesh) -> (DVec3, Vec<Vec3>) {
    let CageSpace { centre, scale } = mesh.space;
    let size = mesh.positions.iter().map(|p| p.abs().max_element()).fold(0.0, f32::max);
    if centre.abs().max_element() * scale > FAR * f64::from(size) {
        return (centre, mesh.positions.iter().map(|&p| mesh.space.leave_vector(p).as_vec3()).collect());
    }
    (DVec3::ZERO, (0..mesh.positions.len()).map(|vertex| mesh.position(vertex).as_vec3()).collect())
}

/// Bytes of positions, normals and indices: multiples of four all.
fn bytes_before_uv(mesh: &Mesh) -> usize {
    24 * mesh.positions.len() + 12 * mesh.triangles.len()
}

fn binary_bytes(mesh: &Mesh) -> usize {
    bytes_before_uv(mesh) + mesh.uv.as_ref().map_or(0, |uv| size_of_val(uv.values.as_slice()))
}

fn write_sizes<const N: usize>(out: &mut dyn Write, sizes: [usize; N]) -> io::Result<()> {
    sizes.iter().try_for_each(|&size| out.write_all(&(size as u32).to_le_bytes()))
}

fn document(mesh: &Mesh, translation: DVec3, positions: &[Vec3]) -> Value {
    let vertices = positions.len();
    let low = positions.iter().fold(Vec3::INFINITY, |low, p| low.min(*p));
    let high = positions.iter().fold(Vec3::NEG_INFINITY, |high, p| high.max(*p));
    let mut node = json!({ "mesh": 0 });
    if translation != DVec3::ZERO {
        node["translation"] = json!(translation.to_array());
    }
    let view = |offset: usize, length: usize, target: u32| json!({ "buffer": 0, "byteOffset": offset, "byteLength": length, "target": target });
    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("osculate ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [node],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2, "mode": 4 }] }],
        "buffers": [{ "byteLength": binary_bytes(mesh) }],
        "bufferViews": [
            view(0, 12 * vertices, ARRAY_BUFFER),
            view(12 * vertices, 12 * vertices, ARRAY_BUFFER),
            view(24 * vertices, 12 * mesh.triangles.len(), ELEMENT_ARRAY_BUFFER),
        ],
        "accessors": [
            { "bufferView": 0, "componentType": FLOAT, "count": vertices, "type": "VEC3",
              "min": positive_zeros(low).to_array(), "max": positive_zeros(high).to_array() },
            { "bufferView": 1, "componentType": FLOAT, "count": vertices, "type": "VEC3" },
            { "bufferView": 2, "componentType": UNSIGNED_INT, "count": 3 * mesh.triangles.len(), "type": "SCALAR" },
        ],
    });
    if mesh.uv.is_some() {
        document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(3);
        let list =
            |document: &mut Value, key: &str, value| document[key].as_array_mut().expect("made above").push(value);
        list(&mut document, "bufferViews", view(bytes_before_uv(mesh), 8 * vertices, ARRAY_BUFFER));
        let accessor = json!({ "bufferView": 3, "componentType": FLOAT, "count": vertices, "type": "VEC2" });
        list(&mut document, "accessors", accessor);
    }
    document
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::ply::tests::floats;
    use crate::mesh::tests::{mapped_square, square};

    /// The JSON and binary chunks, with the framing checked.
    fn chunks(file: &[u8]) -> (Value, &[u8]) {
        let size = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&file[..4], size(4), size(8)), (&b"glTF"[..], 2, file.len()));
        let json = size(12);
        assert_eq!((&file[16..20], json % 4), (&b"JSON"[..], 0));
        let binary = size(20 + json);
        assert_eq!(&file[24 + json..28 + json], b"BIN\0");
        assert_eq!(28 + json + binary, file.len());
        (serde_json::from_slice(&file[20..20 + json]).unwrap(), &file[28 + json..])
    }

    fn written(mesh: &Mesh) -> Vec<u8> {
        let mut file = Vec::new();
        write(mesh, &mut file).unwrap();
        file
    }

    #[test]
    fn reads_back() {
        let file = written(&square());
        let (json, binary) = chunks(&file);
        assert_eq!(binary.len(), 4 * 24 + 2 * 12);
        assert_eq!(floats(&binary[36..48]), [10.0, 1.5, -3.0]);
        assert_eq!(floats(&binary[48..60]), [0.0, 0.0, 1.0]);
        assert_eq!(binary[96..108], [0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
        assert_eq!(json["accessors"][0]["min"], json!([10.0, 0.0, -3.0]));
        assert_eq!(json["accessors"][0]["max"], json!([11.0, 1.5, -3.0]));
        assert_eq!(json["accessors"][2]["count"], 6);
        assert_eq!(json["bufferViews"][2]["byteOffset"], 96);
        assert_eq!(json["nodes"][0].get("translation"), None);
    }

    #[test]
    fn far_away_is_the_nodes_translation() {
        let mut mesh = square();
        mesh.space.centre = DVec3::new(1e6, 0.0, 0.1);
        let file = written(&mesh);
        let (json, binary) = chunks(&file);
        assert_eq!(json["nodes"][0]["translation"], json!([1e6, 0.0, 0.1]));
        assert_eq!(floats(&binary[36..48]), [0.0, 1.5, 0.0]);
        assert_eq!(json["accessors"][0]["max"], json!([1.0, 1.5, 0.0]));
    }

    #[test]
    fn seams_part_vertices() {
        let file = written(&mapped_square());
        let (json, binary) = chunks(&file);
        assert_eq!(binary.len(), 6 * 24 + 2 * 12 + 6 * 8);
        assert_eq!(json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"], 3);
        assert_eq!((&json["accessors"][0]["count"], &json["accessors"][3]["count"]), (&json!(6), &json!(6)));
        assert_eq!(
            (&json["bufferViews"][3]["byteOffset"], &json["bufferViews"][3]["byteLength"]),
            (&json!(168), &json!(48))
        );
        // The first vertex a second time, as the second triangle has it.
        assert_eq!(floats(&binary[36..48]), [10.0, 0.0, -3.0]);
        assert_eq!(floats(&binary[168 + 16..168 + 32]), [1.0, 0.25, 0.5, 1.0]);
        assert_eq!(binary[156..168], [3, 0, 0, 0, 4, 0, 0, 0, 5, 0, 0, 0]);
    }

    #[test]
    fn bounds_are_the_very_floats() {
        let mut mesh = square();
        mesh.space = CageSpace { centre: DVec3::ZERO, scale: 1.0 };
        mesh.positions[1].x = 0.1;
        mesh.positions[2].x = 0.3;
        let file = written(&mesh);
        let max = chunks(&file).0["accessors"][0]["max"][0].as_f64().unwrap();
        assert_eq!(max as f32, 0.3_f32);
    }

    #[test]
    fn an_empty_mesh_is_an_error() {
        assert!(write(&Mesh::empty(square().space), &mut Vec::new()).is_err());
    }

    #[test]
    fn normals_have_length_1_even_where_there_are_none() {
        assert_eq!(unit(Vec3::ZERO), Vec3::Z);
        assert_eq!(unit(-Vec3::X), -Vec3::X);
    }
}
