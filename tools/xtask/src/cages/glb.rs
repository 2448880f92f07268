//! Binary glTF of a mesh with a skin: a polygon is a fan of triangles, marked by the extension `FB_ngon_encoding`.

use glam::{DMat4, DQuat, DVec2, DVec3};
use serde_json::{Value, json};

use super::mesh::{Mesh, Welder};
use super::skin::{Clip, Joint, Skin};

/// Numbers are rounded to this, coarse enough that a machine's own sine cannot show.
const GRAIN: f64 = 1e-5;
/// Room for joints of a vertex.
const ROOM: usize = 4;
/// Component types and buffer targets of the format.
const U8: u32 = 5121;
const U16: u32 = 5123;
const F32: u32 = 5126;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// The file.
pub(super) fn to_glb(mesh: &Mesh, skin: &Skin, comment: &str) -> Vec<u8> {
    let mut file = File::default();
    let corners = Corners::of(mesh);
    let points: Vec<DVec3> = corners.vertices.iter().map(|&(v, _)| rounded(mesh.points[v])).collect();
    let attributes = json!({
        "POSITION": file.positions(&points),
        "TEXCOORD_0": file.floats("VEC2", VERTICES, corners.coordinates(mesh).flat_map(|uv| [uv.x, 1.0 - uv.y])),
        "JOINTS_0": file.joints(corners.vertices.iter().map(|&(v, _)| &skin.weights[v][..])),
        "WEIGHTS_0": file.weights(corners.vertices.iter().map(|&(v, _)| &skin.weights[v][..])),
    });
    let indices = file.indices(&corners.triangles());
    let inverse = |joint: &Joint| DMat4::from_translation(-rounded(joint.place)).to_cols_array();
    let matrices = file.floats("MAT4", 0, skin.joints.iter().flat_map(inverse));
    let animation = file.animation(&skin.joints, &skin.clip);
    // The mesh's own node stands beside the skeleton: what places a skinned mesh is its joints.
    let mut nodes: Vec<Value> = (0..skin.joints.len()).map(|joint| node(&skin.joints, joint)).collect();
    nodes.push(json!({"name": "body", "mesh": 0, "skin": 0}));
    let document = json!({
        "asset": {"version": "2.0", "generator": "cargo xtask cages", "extras": {"comment": comment}},
        "extensionsUsed": ["FB_ngon_encoding"],
        "scene": 0,
        "scenes": [{"nodes": [0, skin.joints.len()]}],
        "nodes": nodes,
        "meshes": [{"primitives": [{
            "attributes": attributes,
            "indices": indices,
            "extensions": {"FB_ngon_encoding": {}},
        }]}],
        "skins": [{"joints": (0..skin.joints.len()).collect::<Vec<_>>(), "skeleton": 0, "inverseBindMatrices": matrices}],
        "animations": [animation],
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{"byteLength": file.bytes.len()}],
    });
    container(document.to_string().into_bytes(), file.bytes)
}

fn node(joints: &[Joint], joint: usize) -> Value {
    let children: Vec<usize> = (0..joints.len()).filter(|&other| joints[other].parent == Some(joint)).collect();
    let parent = joints[joint].parent.map_or(DVec3::ZERO, |parent| rounded(joints[parent].place));
    let step = (rounded(joints[joint].place) - parent).as_vec3().to_array();
    let mut node = json!({"name": joints[joint].name, "translation": step});
    if !children.is_empty() {
        node["children"] = json!(children);
    }
    node
}

/// Header and two chunks, each filled up to whole words.
fn container(mut json: Vec<u8>, mut binary: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let mut file = Vec::with_capacity(length);
    file.extend(b"glTF");
    file.extend([2, length as u32].map(u32::to_le_bytes).as_flattened());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

/// The corners of the faces, with one vertex of the file for each pair of a vertex and a texture coordinate.
struct Corners {
    vertices: Vec<(usize, Option<usize>)>,
    faces: Vec<Vec<usize>>,
}

impl Corners {
    fn of(mesh: &Mesh) -> Self {
        let mut welder = Welder::new();
        let mut faces = Vec::with_capacity(mesh.faces.len());
        for (f, face) in mesh.faces.iter().enumerate() {
            let coordinate = |corner: usize| mesh.uv.as_ref().map(|uv| uv.faces[f][corner]);
            let keys = face.iter().enumerate().map(|(corner, &vertex)| (vertex, coordinate(corner)));
            faces.push(keys.map(|key| welder.index(key, || key)).collect());
        }
        Self { vertices: welder.points, faces }
    }

    fn coordinates<'a>(&'a self, mesh: &'a Mesh) -> impl Iterator<Item = DVec2> + 'a {
        self.vertices.iter().map(|&(_, uv)| match (&mesh.uv, uv) {
            (Some(found), Some(uv)) => found.points[uv],
            _ => DVec2::ZERO,
        })
    }

    /// Fans: all triangles of a polygon start at one vertex, and those of the next polygon at another.
    fn triangles(&self) -> Vec<usize> {
        let (mut triangles, mut last) = (Vec::new(), usize::MAX);
        for face in &self.faces {
            let first = usize::from(face[0] == last);
            let at = |k: usize| face[(first + k) % face.len()];
            for k in 1..face.len() - 1 {
                triangles.extend([at(0), at(k), at(k + 1)]);
            }
            last = at(0);
        }
        triangles
    }
}

/// Accessors and the bytes behind them.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl File {
    /// Adds an accessor of so many elements; returns its index.
    fn accessor(&mut self, bytes: &[u8], kind: &str, component: u32, count: usize, target: u32) -> usize {
        let mut view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        if target != 0 {
            view["target"] = json!(target);
        }
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.accessors.push(json!({
            "bufferView": self.views.len(), "componentType": component, "count": count, "type": kind
        }));
        self.views.push(view);
        self.accessors.len() - 1
    }

    fn floats(&mut self, kind: &str, target: u32, values: impl Iterator<Item = f64>) -> usize {
        let values: Vec<f32> = values.map(grained).collect();
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(&bytes, kind, F32, values.len() / width, target)
    }

    /// Positions, with the box that the format asks for.
    fn positions(&mut self, points: &[DVec3]) -> usize {
        let accessor = self.floats("VEC3", VERTICES, points.iter().flat_map(|p| p.to_array()));
        let fold = |pick: fn(DVec3, DVec3) -> DVec3| points.iter().copied().reduce(pick).unwrap_or_default();
        self.bounds(accessor, &fold(DVec3::min).to_array(), &fold(DVec3::max).to_array());
        accessor
    }

    fn bounds(&mut self, accessor: usize, min: &[f64], max: &[f64]) {
        let floats = |values: &[f64]| values.iter().map(|&value| grained(value)).collect::<Vec<f32>>();
        self.accessors[accessor]["min"] = json!(floats(min));
        self.accessors[accessor]["max"] = json!(floats(max));
    }

    fn joints<'a>(&mut self, rows: impl ExactSizeIterator<Item = &'a [(usize, f64)]>) -> usize {
        let count = rows.len();
        let bytes: Vec<u8> =
            rows.flat_map(|row| (0..ROOM).map(|k| row.get(k).map_or(0, |&(joint, _)| joint as u8))).collect();
        self.accessor(&bytes, "VEC4", U8, count, VERTICES)
    }

    /// Weights in 255ths: what rounding takes away or adds goes to the largest.
    fn weights<'a>(&mut self, rows: impl ExactSizeIterator<Item = &'a [(usize, f64)]>) -> usize {
        let count = rows.len();
        let share = |row: &[(usize, f64)]| {
            let mut shares: [i32; ROOM] =
                std::array::from_fn(|k| row.get(k).map_or(0, |&(_, weight)| (255.0 * weight).round() as i32));
            shares[0] += 255 - shares.iter().sum::<i32>();
            shares.map(|share| share as u8)
        };
        let bytes: Vec<u8> = rows.flat_map(share).collect();
        let accessor = self.accessor(&bytes, "VEC4", U8, count, VERTICES);
        self.accessors[accessor]["normalized"] = json!(true);
        accessor
    }

    fn indices(&mut self, indices: &[usize]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|&index| (index as u16).to_le_bytes()).collect();
        self.accessor(&bytes, "SCALAR", U16, indices.len(), INDICES)
    }

    /// A channel of rotations for each joint that turns, and one of translations for the root.
    fn animation(&mut self, joints: &[Joint], clip: &Clip) -> Value {
        let last = clip.poses.len() - 1;
        let times: Vec<f64> = (0..=last).map(|k| clip.seconds * k as f64 / last as f64).collect();
        let input = self.floats("SCALAR", 0, times.iter().copied());
        self.bounds(input, &[0.0], &[clip.seconds]);
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        let mut add = |output: usize, node: usize, path: &str| {
            channels.push(json!({"sampler": samplers.len(), "target": {"node": node, "path": path}}));
            samplers.push(json!({"input": input, "output": output, "interpolation": "LINEAR"}));
        };
        let root = rounded(joints[0].place);
        add(
            self.floats("VEC3", 0, clip.poses.iter().flat_map(|pose| (root + pose.shift).to_array())),
            0,
            "translation",
        );
        for joint in 0..joints.len() {
            let turns: Vec<DQuat> = clip.poses.iter().map(|pose| pose.turns[joint]).collect();
            if turns.iter().any(|turn| turn.angle_between(DQuat::IDENTITY) > 1e-6) {
                add(self.floats("VEC4", 0, turns.iter().flat_map(upper)), joint, "rotation");
            }
        }
        json!({"name": clip.name, "samplers": samplers, "channels": channels})
    }
}

/// A rotation as the one of its two quaternions that a small turn has.
fn upper(turn: &DQuat) -> [f64; 4] {
    if turn.w < 0.0 { (-*turn).to_array() } else { turn.to_array() }
}

fn grained(value: f64) -> f32 {
    // Adding zero turns -0 into 0.
    ((value / GRAIN).round() * GRAIN + 0.0) as f32
}

fn rounded(p: DVec3) -> DVec3 {
    (p / GRAIN).round() * GRAIN
}
