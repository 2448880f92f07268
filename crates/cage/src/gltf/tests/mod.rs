//! Small files, made here byte by byte.

mod damage;
mod look;
mod motion;
mod polygons;
mod refused;
mod repair;

use std::path::Path;

use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use crate::{Cage, FaceSetKind, GltfDesc, PolygonRecovery, ReadDesc};
use crate::{ReadError, gltf};

/// Reads without looking for polygons, which have tests of their own.
fn triangles() -> GltfDesc {
    GltfDesc { polygons: PolygonRecovery::NONE, ..GltfDesc::default() }
}

fn read_gltf(bytes: &[u8], name: &str, folder: Option<&Path>) -> Result<Cage, ReadError> {
    gltf::read_gltf(bytes, name, folder, &ReadDesc { gltf: triangles(), ..ReadDesc::default() })
}

/// A glTF file in the making.
struct File {
    json: Value,
    bin: Vec<u8>,
}

impl File {
    fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": []}], "materials": [{"name": "paint"}, {}], "accessors": [], "bufferViews": [], "buffers": [{}]
        });
        Self { json, bin: Vec::new() }
    }

    fn push(&mut self, array: &str, value: Value) -> usize {
        let array = self.json[array].as_array_mut().expect("an array");
        array.push(value);
        array.len() - 1
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        let view = json!({"buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len()});
        self.bin.extend_from_slice(bytes);
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        self.push("bufferViews", view)
    }

    fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let mut accessor = json!({"bufferView": view, "componentType": component, "count": count, "type": kind});
        if kind == "VEC3" {
            accessor["min"] = json!([0, 0, 0]);
            accessor["max"] = json!([0, 0, 0]);
        }
        self.push("accessors", accessor)
    }

    fn positions(&mut self, points: &[[f32; 3]]) -> usize {
        self.accessor("VEC3", 5126, points.len(), &bytes(points.as_flattened()))
    }

    fn uv(&mut self, points: &[[f32; 2]]) -> usize {
        self.accessor("VEC2", 5126, points.len(), &bytes(points.as_flattened()))
    }

    fn indices(&mut self, indices: &[u8]) -> usize {
        self.accessor("SCALAR", 5121, indices.len(), indices)
    }

    fn primitive(&mut self, primitive: Value) -> &mut Self {
        self.json["meshes"][0]["primitives"].as_array_mut().expect("an array").push(primitive);
        self
    }

    fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"][0] = json!({"byteLength": self.bin.len()});
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let word = |n: usize| u32::try_from(n).expect("a small file").to_le_bytes();
        let chunks = [&word(text.len()), b"JSON", &text[..], &word(self.bin.len()), b"BIN\0", &self.bin].concat();
        [&b"glTF"[..], &word(2), &word(12 + chunks.len()), &chunks].concat()
    }

    fn read(&self) -> Cage {
        self.read_with(&triangles())
    }

    fn read_with(&self, desc: &GltfDesc) -> Cage {
        self.read_as(&ReadDesc { gltf: desc.clone(), ..ReadDesc::default() }).unwrap_or_else(|error| panic!("{error}"))
    }

    fn read_as(&self, desc: &ReadDesc) -> Result<Cage, ReadError> {
        gltf::read_gltf(&self.glb(), "test.glb", None, desc)
    }

    fn refused(&self) -> String {
        read_gltf(&self.glb(), "test.glb", None).expect_err("must be refused").to_string()
    }

    /// As JSON with this uri for the buffer.
    fn with_uri(&self, uri: &str) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"][0] = json!({"byteLength": self.bin.len(), "uri": uri});
        json.to_string().into_bytes()
    }
}

fn bytes(floats: &[f32]) -> Vec<u8> {
    floats.iter().flat_map(|x| x.to_le_bytes()).collect()
}

const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

/// Two indexed triangles.
fn square() -> File {
    let mut file = File::new();
    let (positions, indices) = (file.positions(&SQUARE), file.indices(&[0, 1, 2, 2, 3, 0]));
    file.primitive(json!({"attributes": {"POSITION": positions}, "indices": indices}));
    file
}

fn warnings(cage: &Cage) -> Vec<String> {
    cage.warnings().iter().map(ToString::to_string).collect()
}

fn faces(cage: &Cage) -> Vec<&[u32]> {
    (0..cage.face_count()).map(|f| cage.face(f)).collect()
}

#[test]
fn indexed_triangles() {
    let cage = square().read();
    assert_eq!(cage.positions(), SQUARE.map(|p| DVec3::from_array(p.map(f64::from))));
    assert_eq!(faces(&cage), [[0, 1, 2], [2, 3, 0]]);
    assert_eq!((cage.uv(), cage.warnings()), (None, &[][..]));
}

#[test]
fn triangles_without_indices_are_welded() {
    let mut file = File::new();
    let [a, b, c, d] = SQUARE;
    let positions = file.positions(&[a, b, c, c, d, [-0.0, 0.0, -0.0]]);
    file.primitive(json!({"attributes": {"POSITION": positions}}));
    assert_eq!(faces(&file.read()), [[0, 1, 2], [2, 3, 0]]);
}

#[test]
fn strips_and_fans() {
    let points: Vec<[f32; 3]> = (0..6_u8).map(|i| [f32::from(i / 2), f32::from(i % 2), 0.0]).collect();
    let mut strip = File::new();
    let positions = strip.positions(&points);
    strip.primitive(json!({"attributes": {"POSITION": positions}, "mode": 5}));
    // Vertices are numbered by first use.
    let cage = strip.read();
    let named = |cage: &Cage| -> Vec<Vec<DVec3>> {
        faces(cage).iter().map(|f| f.iter().map(|&v| cage.positions()[v as usize]).collect()).collect()
    };
    let p = |i: usize| DVec3::from_array(points[i].map(f64::from));
    assert_eq!(named(&cage), [[p(0), p(1), p(2)], [p(1), p(3), p(2)], [p(2), p(3), p(4)], [p(3), p(5), p(4)]]);

    let mut fan = File::new();
    let positions = fan.positions(&SQUARE);
    fan.primitive(json!({"attributes": {"POSITION": positions}, "mode": 6}));
    let corner = |i: usize| DVec3::from_array(SQUARE[i].map(f64::from));
    assert_eq!(named(&fan.read()), [[corner(1), corner(2), corner(0)], [corner(2), corner(3), corner(0)]]);
}

#[test]
fn every_type_of_index() {
    let indices = [0_u8, 1, 2, 2, 3, 0];
    let short: Vec<u8> = indices.iter().flat_map(|&i| u16::from(i).to_le_bytes()).collect();
    let long: Vec<u8> = indices.iter().flat_map(|&i| u32::from(i).to_le_bytes()).collect();
    for (component, bytes) in [(5121, &indices[..]), (5123, &short), (5125, &long)] {
        let mut file = File::new();
        let (positions, indices) = (file.positions(&SQUARE), file.accessor("SCALAR", component, 6, bytes));
        file.primitive(json!({"attributes": {"POSITION": positions}, "indices": indices}));
        assert_eq!(faces(&file.read()), [[0, 1, 2], [2, 3, 0]], "{component}");
    }
}

#[test]
fn uv_are_kept_per_corner() {
    let mut file = File::new();
    let [a, b, c, d] = SQUARE;
    let positions = file.positions(&[a, b, c, c, d, a]);
    let uv = file.uv(&[[0.0, 0.0], [0.5, 0.0], [0.5, 1.0], [0.75, 1.0], [0.0, 0.0], [0.5, 0.0]]);
    file.primitive(json!({"attributes": {"POSITION": positions, "TEXCOORD_0": uv}}));
    let cage = file.read();
    let uv = cage.uv().expect("uv");
    assert_eq!(uv.indices, [0, 1, 2, 3, 0, 1]);
    assert_eq!(uv.values[3], DVec2::new(0.75, 1.0));
    assert_eq!(cage.vertex_count(), 4);
}

#[test]
fn normalized_uv() {
    for (component, bytes) in [
        (5121, vec![0, 255, 51, 0, 255, 255]),
        (5123, [0_u16, 65535, 13107, 0, 65535, 65535].iter().flat_map(|x| x.to_le_bytes()).collect()),
    ] {
        let mut file = File::new();
        let positions = file.positions(&SQUARE[..3]);
        let uv = file.accessor("VEC2", component, 3, &bytes);
        file.json["accessors"][uv]["normalized"] = json!(true);
        file.primitive(json!({"attributes": {"POSITION": positions, "TEXCOORD_0": uv}}));
        assert_eq!(file.read().uv().expect("uv").values, [DVec2::Y, DVec2::new(0.2, 0.0), DVec2::ONE]);
    }
}

#[test]
fn primitives_of_a_mesh_are_welded_and_become_material_sets() {
    let mut file = File::new();
    let positions = file.positions(&SQUARE);
    let (one, two) = (file.indices(&[0, 1, 2]), file.indices(&[2, 3, 0]));
    let uv = file.uv(&[[0.0, 1.0]; 4]);
    file.primitive(json!({"attributes": {"POSITION": positions}, "indices": one, "material": 0}));
    file.primitive(json!({"attributes": {"POSITION": positions, "TEXCOORD_0": uv}, "indices": two, "material": 1}));
    let cage = file.read();
    assert_eq!((cage.vertex_count(), cage.topology().edge_count()), (4, 5));
    let sets: Vec<_> = cage.face_sets().iter().map(|set| (set.kind, &set.name[..], &set.faces[..])).collect();
    assert_eq!(
        sets,
        [
            (FaceSetKind::Object, "node 0", &[0..2][..]),
            (FaceSetKind::Material, "paint", &[0..1]),
            (FaceSetKind::Material, "material 1", &[1..2])
        ]
    );
    assert_eq!(warnings(&cage), ["1 face without uv, set to (0, 0)"]);
}

#[test]
fn nodes_are_placed() {
    let mut file = square();
    file.json["nodes"] = json!([
        {"children": [1], "translation": [10, 0, 0]},
        {"mesh": 0, "scale": [2, 3, 1], "rotation": [0, 0, std::f32::consts::FRAC_1_SQRT_2, std::f32::consts::FRAC_1_SQRT_2], "name": "inner"}
    ]);
    let cage = file.read();
    let expected = [[10.0, 0.0, 0.0], [10.0, 2.0, 0.0], [7.0, 2.0, 0.0], [7.0, 0.0, 0.0]];
    for (p, q) in cage.positions().iter().zip(expected) {
        assert!(p.distance(q.into()) < 1e-12, "{p} is not {q:?}");
    }
    assert_eq!(cage.face_sets()[0].name, "inner");

    file.json["nodes"] = json!([{"mesh": 0, "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1]}]);
    assert_eq!(file.read().positions()[2], DVec3::new(7.0, 8.0, 7.0));
}

#[test]
fn mirrored_nodes_keep_their_outside() {
    let mut file = square();
    file.json["nodes"] = json!([{"mesh": 0, "scale": [-1, 1, 1]}]);
    let cage = file.read();
    assert_eq!(faces(&cage), [[0, 2, 1], [2, 0, 3]]);
    let [a, b, c] = [0, 1, 2].map(|i| cage.positions()[cage.face(0)[i] as usize]);
    assert!((b - a).cross(c - a).z > 0.0, "the square still faces up");
}

#[test]
fn nodes_that_meet_are_welded() {
    let mut file = square();
    file.json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0]}]);
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    let cage = file.read();
    assert_eq!((cage.vertex_count(), cage.face_count(), cage.topology().edge_count()), (6, 4, 9));
    assert!(cage.warnings().is_empty());
}

#[test]
fn nodes_that_merely_touch_stay_apart() {
    let mut file = square();
    file.json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "translation": [1, 1, 0]}]);
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    let cage = file.read();
    assert_eq!((cage.vertex_count(), cage.face_count()), (8, 4));
    assert_eq!(warnings(&cage), ["2 nodes welded each by itself, because together they are not manifold"]);
}

#[test]
fn scenes() {
    let mut file = square();
    file.json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}, {"children": [1]}]);
    file.json["scenes"] = json!([{"nodes": [0]}, {"nodes": [2]}]);
    file.json["scene"] = json!(1);
    assert_eq!(file.read().positions()[0].x, 5.0);
    file.json.as_object_mut().expect("an object").remove("scene");
    assert_eq!(file.read().positions()[0].x, 0.0);
    file.json.as_object_mut().expect("an object").remove("scenes");
    assert_eq!(file.read().face_count(), 4, "all nodes");
}

#[test]
fn triangles_that_collapse_are_dropped() {
    let mut file = File::new();
    let [a, b, c, d] = SQUARE;
    let positions = file.positions(&[a, b, c, a, b, b, c, d, a]);
    file.primitive(json!({"attributes": {"POSITION": positions}}));
    file.json["nodes"][0]["name"] = json!("body");
    let cage = file.read();
    assert_eq!(faces(&cage), [[0, 1, 2], [2, 3, 0]]);
    assert_eq!(cage.face_sets()[0].faces, [0..2]);
    assert_eq!(warnings(&cage), ["1 triangle with two corners at one place dropped"]);
}

#[test]
fn what_is_not_read_is_said() {
    let mut file = square();
    let (positions, targets) = (file.positions(&SQUARE), file.positions(&SQUARE));
    file.primitive(json!({"attributes": {"POSITION": positions}, "mode": 0}));
    file.primitive(json!({"attributes": {"POSITION": positions}, "mode": 1}));
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": targets}]);
    file.json["skins"] = json!([{"joints": [0]}]);
    file.json["nodes"][0]["skin"] = json!(0);
    assert_eq!(
        warnings(&file.read()),
        ["1 skin of a primitive without joints ignored", "2 primitives of points or lines ignored"]
    );
}

#[test]
fn interleaved_and_sparse_accessors() {
    let mut file = File::new();
    let interleaved: Vec<f32> = SQUARE.iter().flat_map(|p| [p[0], p[1], p[2], 0.25, 0.75]).collect();
    let view = file.view(&bytes(&interleaved));
    file.json["bufferViews"][view]["byteStride"] = json!(20);
    let positions = file.push("accessors", json!({"bufferView": view, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}));
    let uv = file.push(
        "accessors",
        json!({"bufferView": view, "byteOffset": 12, "componentType": 5126, "count": 4, "type": "VEC2"}),
    );
    let (at, values) = (file.view(&[1, 3]), file.view(&bytes(&[2.0, 0.0, 0.0, 0.0, 3.0, 0.0])));
    file.json["accessors"][positions]["sparse"] =
        json!({"count": 2, "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": values}});
    file.primitive(json!({"attributes": {"POSITION": positions, "TEXCOORD_0": uv}, "mode": 6}));
    let cage = file.read();
    let mut points = cage.positions().to_vec();
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    assert_eq!(points, [DVec3::ZERO, DVec3::Y * 3.0, DVec3::new(1.0, 1.0, 0.0), DVec3::X * 2.0]);
    assert_eq!(cage.uv().expect("uv").values, [DVec2::new(0.25, 0.75)]);
}

#[test]
fn sparse_accessors_without_a_base_are_zero_elsewhere() {
    let mut file = File::new();
    let (at, values) = (file.view(&[1, 2]), file.view(&bytes(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0])));
    let sparse =
        json!({"count": 2, "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": values}});
    // The count says nothing about memory, so it must not cost any.
    let positions = file.push("accessors", json!({"componentType": 5126, "count": 4_000_000_000_u32, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0], "sparse": sparse}));
    let indices = file.indices(&[0, 1, 2]);
    file.primitive(json!({"attributes": {"POSITION": positions}, "indices": indices}));
    assert_eq!(file.read().positions(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
}

#[test]
fn data_uris_and_files_beside() {
    let file = square();
    let alphabet = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut coded = String::new();
    for group in file.bin.chunks(3) {
        let bits = group.iter().fold(0_u32, |bits, &b| bits << 8 | u32::from(b)) << (8 * (3 - group.len()));
        (0..=group.len()).for_each(|i| coded.push(char::from(alphabet[(bits >> (18 - 6 * i) & 63) as usize])));
    }
    for kind in ["application/octet-stream", "application/gltf-buffer", ""] {
        let text = file.with_uri(&format!("data:{kind};base64,{coded}"));
        assert_eq!(read_gltf(&text, "test.gltf", None).expect("a cage"), file.read());
    }

    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("my data.bin"), &file.bin).expect("written");
    std::fs::write(folder.path().join("model.GLTF"), file.with_uri("my%20data.bin")).expect("written");
    std::fs::write(folder.path().join("model.glb"), file.glb()).expect("written");
    let read_triangles = ReadDesc { gltf: triangles(), ..ReadDesc::default() };
    assert_eq!(Cage::read_with(&folder.path().join("model.GLTF"), &read_triangles).expect("a cage"), file.read());
    assert_eq!(Cage::read_with(&folder.path().join("model.glb"), &read_triangles).expect("a cage"), file.read());
}
