//! Repair of meshes that move and have materials.

use glam::{DVec2, DVec3, Vec3};
use serde_json::json;

use super::{File, bytes, triangles, warnings};
use crate::{Cage, ReadDesc, RepairDesc, Rig};

/// The corners of [`dirty`].
const POINTS: [[f32; 3]; 6] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0], [2.0, 0.0, 0.0]];

/// The part of a vertex of [`dirty`] that hangs on the second joint; each is another.
fn bend(v: u32) -> f32 {
    0.125 * v as f32
}

/// A square of two triangles with a copy of the first and a fin on its diagonal, and a triangle of another material that is inside
/// out. Two joints, a morph target, two sets of texture coordinates; every vertex moves in its own way.
fn dirty() -> File {
    let mut file = File::new();
    let vertices = || 0..POINTS.len() as u32;
    let positions = file.positions(&POINTS);
    let uv: Vec<[f32; 2]> = vertices().map(|v| [v as f32, 0.0]).collect();
    let more: Vec<[f32; 2]> = vertices().map(|v| [0.0, v as f32]).collect();
    let weights: Vec<f32> = vertices().flat_map(|v| [1.0 - bend(v), bend(v), 0.0, 0.0]).collect();
    let joints = file.accessor("VEC4", 5121, POINTS.len(), &[0, 1, 0, 0].repeat(POINTS.len()));
    let weights = file.accessor("VEC4", 5126, POINTS.len(), &bytes(&weights));
    let offsets: Vec<[f32; 3]> = vertices().map(|v| [0.0, 0.0, v as f32]).collect();
    let (uv, more, offsets) = (file.uv(&uv), file.uv(&more), file.positions(&offsets));
    for (material, corners) in [(0, &[0_u8, 1, 2, 2, 3, 0, 0, 1, 2, 0, 2, 4][..]), (1, &[1, 2, 5])] {
        let indices = file.indices(corners);
        file.primitive(json!({
            "attributes": {
                "POSITION": positions, "TEXCOORD_0": uv, "TEXCOORD_1": more, "JOINTS_0": joints, "WEIGHTS_0": weights
            },
            "targets": [{"POSITION": offsets}], "indices": indices, "material": material
        }));
    }
    file.json["skins"] = json!([{"joints": [1, 2]}]);
    file.json["nodes"] = json!([{"mesh": 0, "skin": 0, "weights": [0.5]}, {"children": [2]}, {}]);
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    file
}

fn repaired(file: &File, weld_tolerance: f64) -> Cage {
    let desc = ReadDesc { gltf: triangles(), repair: Some(RepairDesc { weld_tolerance }), ..ReadDesc::default() };
    file.read_as(&desc).unwrap_or_else(|error| panic!("{error}"))
}

fn rig(cage: &Cage) -> &Rig {
    cage.rig().expect("a rig")
}

/// The offset of a vertex under the first morph target.
fn offset(rig: &Rig, v: u32) -> Vec3 {
    let target = &rig.morph_sets[0].targets[0];
    target.vertices.binary_search(&v).map_or(Vec3::ZERO, |at| target.offsets[at])
}

fn assert_rests_where_it_is(cage: &Cage) {
    let rig = rig(cage);
    assert_eq!(rig.positions(&rig.rest()), cage.positions());
}

#[test]
fn vertices_keep_what_moves_them() {
    assert!(dirty().read_as(&ReadDesc { gltf: triangles(), ..ReadDesc::default() }).is_err());
    let cage = repaired(&dirty(), 0.0);
    assert_eq!(
        warnings(&cage),
        ["repaired: 1 copied face dropped: 2; 1 face turned over: 4; 1 edge with more than two faces separated: 0-2; \
             2 vertices split: 0, 2"]
    );
    assert_eq!(cage.source_vertices(), [0, 1, 2, 3, 4, 5, 0, 2]);
    let rig = rig(&cage);
    assert_eq!((rig.bind_positions.len(), rig.joint_indices.len(), rig.morph_sets.len()), (8, 8 * rig.influences, 1));
    for (v, &source) in (0..).zip(cage.source_vertices()) {
        let of_joint = |joint| rig.influences_of(v as usize).filter(|(j, _)| *j == joint).map(|(_, w)| w).sum::<f32>();
        assert_eq!([of_joint(0), of_joint(1)], [1.0 - bend(source), bend(source)], "vertex {v}");
        assert_eq!(offset(rig, v), Vec3::Z * source as f32, "vertex {v}");
        let bind = DVec3::from_array(POINTS[source as usize].map(f64::from));
        assert_eq!(rig.bind_positions[v as usize], bind, "vertex {v}");
        assert_eq!(cage.positions()[v as usize], bind + DVec3::Z * 0.5 * f64::from(source), "vertex {v}");
    }
    assert_rests_where_it_is(&cage);
}

#[test]
fn faces_keep_how_they_look() {
    let cage = repaired(&dirty(), 0.0);
    let appearance = cage.appearance().expect("materials");
    let names: Vec<&str> = (0..4).map(|f| &appearance.material(f).expect("a material").name[..]).collect();
    assert_eq!(names, ["paint", "paint", "paint", "material 1"]);
    let [more] = &appearance.more_uv[..] else { panic!("one further set") };
    let uv = cage.uv().expect("uv");
    for (corner, &v) in cage.face_vertices().iter().enumerate() {
        let source = f64::from(cage.source_vertices()[v as usize]);
        assert_eq!(uv.values[uv.indices[corner] as usize], DVec2::new(source, 0.0), "corner {corner}");
        assert_eq!(more.uv.values[more.uv.indices[corner] as usize], DVec2::new(0.0, source), "corner {corner}");
    }
}

/// Two triangles with a gap between them; the right one has a weight on the second joint. A further corner is used by `corners`.
fn gap(gap: f32, weight: f32, corners: &[u8]) -> File {
    let mut file = File::new();
    let x = 1.0 + gap;
    let left = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    let right = [[x, 0.0, 0.0], [2.0, 1.0, 0.0], [x, 1.0, 0.0], [2.0, 0.0, 0.0]];
    let positions = file.positions(&[&left[..], &right].concat());
    let joints = file.accessor("VEC4", 5121, 7, &[0, 1, 0, 0].repeat(7));
    let weights = [[1.0, 0.0, 0.0, 0.0].repeat(3), [1.0 - weight, weight, 0.0, 0.0].repeat(4)].concat();
    let (weights, indices) = (file.accessor("VEC4", 5126, 7, &bytes(&weights)), file.indices(corners));
    let attributes = json!({"POSITION": positions, "JOINTS_0": joints, "WEIGHTS_0": weights});
    file.primitive(json!({"attributes": attributes, "indices": indices}));
    file.json["skins"] = json!([{"joints": [1, 2]}]);
    file.json["nodes"] = json!([{"mesh": 0, "skin": 0}, {"children": [2]}, {}]);
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    file
}

#[test]
fn welded_vertices_rest_where_they_are() {
    let side_by_side = gap(0.01, 0.0, &[0, 1, 2, 3, 4, 5]);
    let cage = repaired(&side_by_side, 0.1);
    assert_eq!((cage.vertex_count(), cage.topology().edge_count()), (4, 5));
    assert_rests_where_it_is(&cage);
    assert_eq!(repaired(&side_by_side, 0.001).vertex_count(), 6);
    // Triangles that nearly touch in one vertex go to one place but keep a vertex each. Something else is to be repaired too.
    let cage = repaired(&gap(0.01, 0.0, &[0, 1, 2, 0, 1, 2, 3, 6, 4]), 0.1);
    assert_eq!((cage.vertex_count(), cage.positions()[3]), (6, DVec3::X));
    assert_rests_where_it_is(&cage);
}

#[test]
fn what_moves_apart_is_not_welded() {
    for width in [0.0, 0.01] {
        let cage = repaired(&gap(width, 0.5, &[0, 1, 2, 3, 4, 5]), 0.1);
        assert_eq!(cage.vertex_count(), 6, "{width}");
        assert_rests_where_it_is(&cage);
    }
}
