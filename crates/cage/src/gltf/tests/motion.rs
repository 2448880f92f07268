//! Skins, morph targets and animations.

use glam::{DAffine3, DVec3, Vec3};
use serde_json::{Value, json};

use super::{File, SQUARE, bytes, square, warnings};
use crate::{Cage, Interpolation, NodeProperty, NodeTransform, Rig};

fn rig(cage: &Cage) -> &Rig {
    cage.rig().expect("a rig")
}

fn close(found: &[DVec3], expected: &[[f64; 3]]) {
    assert_eq!(found.len(), expected.len());
    for (p, q) in found.iter().zip(expected) {
        assert!(p.distance((*q).into()) < 1e-6, "{p} is not {q:?}");
    }
}

/// A square whose right side hangs on a joint that stands at x = 1.
fn skinned() -> File {
    let mut file = square();
    let joints = file.accessor("VEC4", 5121, 4, &[0, 0, 0, 0, 1, 0, 0, 0, 1, 9, 0, 0, 0, 0, 0, 0]);
    let weights = file.accessor("VEC4", 5126, 4, &bytes(&[1.0, 0.0, 0.0, 0.0].repeat(4)));
    let matrix = |x: f32| {
        let mut m = [0.0; 16];
        [0, 5, 10, 15].into_iter().for_each(|k| m[k] = 1.0);
        m[12] = x;
        m
    };
    let inverse = file.accessor("MAT4", 5126, 2, &bytes(&[matrix(0.0), matrix(-1.0)].concat()));
    let attributes = &mut file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    file.json["skins"] = json!([{"joints": [1, 2], "inverseBindMatrices": inverse}]);
    // The transform of the mesh's own node means nothing.
    file.json["nodes"] = json!([
        {"mesh": 0, "skin": 0, "translation": [50, 0, 0], "scale": [-1, 1, 1]},
        {"name": "hip", "children": [2]},
        {"name": "knee", "translation": [1, 0, 0]}
    ]);
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    file
}

fn animate(file: &mut File, node: usize, path: &str, interpolation: &str, times: &[f32], kind: &str, values: &[f32]) {
    let input = file.accessor("SCALAR", 5126, times.len(), &bytes(times));
    let width = match kind {
        "SCALAR" => 1,
        "VEC3" => 3,
        _ => 4,
    };
    let output = file.accessor(kind, 5126, values.len() / width, &bytes(values));
    file.json["animations"] = json!([{
        "name": "walk",
        "samplers": [{"input": input, "output": output, "interpolation": interpolation}],
        "channels": [{"sampler": 0, "target": {"node": node, "path": path}}]
    }]);
}

#[test]
fn still_scenes_have_no_rig() {
    assert!(square().read().rig().is_none());
}

#[test]
fn skins_bend() {
    let mut file = skinned();
    let h = std::f32::consts::FRAC_1_SQRT_2;
    animate(&mut file, 2, "rotation", "LINEAR", &[1.0, 3.0], "VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, h, h]);
    let cage = file.read();
    close(cage.positions(), &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(cage.face(0), [0, 1, 2], "a mirrored node of a skin turns nothing inside out");
    let rig = rig(&cage);
    assert_eq!((rig.influences, rig.joints.len(), rig.animations.len()), (1, 2, 1));
    assert_eq!(rig.joint_indices, [0, 1, 1, 0]);
    assert_eq!(rig.joint_weights, [1.0; 4]);
    let parents: Vec<_> = rig.nodes.iter().map(|node| (&node.name[..], node.parent)).collect();
    assert_eq!(parents, [("node 0", None), ("hip", None), ("knee", Some(1))]);
    assert_eq!(rig.joints[1].node, 2);
    assert_eq!(rig.joints[1].inverse_bind, DAffine3::from_translation(-DVec3::X));
    assert_eq!(rig.positions(&rig.rest()), cage.positions());
    assert_eq!((&rig.animations[0].name[..], rig.animations[0].duration()), ("walk", 3.0));
    // Before its first key an animation stands still; at the end the right side has turned by 90 degrees around (1, 0).
    close(&rig.positions(&rig.pose(0, 0.0)), &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    close(&rig.positions(&rig.pose(0, 9.0)), &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    close(&rig.positions(&rig.pose(0, 2.0))[2..3], &[[1.0 - half, half, 0.0]]);
}

#[test]
fn eight_joints_and_weights_of_any_sum() {
    let mut file = skinned();
    let joints = file.accessor("VEC4", 5121, 4, &[0, 1, 0, 0].repeat(4));
    let first = file.accessor("VEC4", 5121, 4, &[51, 102, 0, 0].repeat(4));
    file.json["accessors"][first]["normalized"] = json!(true);
    let second = file.accessor("VEC4", 5126, 4, &bytes(&[0.1, 0.1, 0.1, 0.0].repeat(4)));
    let attributes = &mut file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = json!(first);
    attributes["JOINTS_0"] = json!(joints);
    attributes["JOINTS_1"] = json!(joints);
    attributes["WEIGHTS_1"] = json!(second);
    let cage = file.read();
    let rig = rig(&cage);
    assert_eq!(rig.influences, 8);
    for v in 0..4 {
        let weights: Vec<(u32, f32)> = rig.influences_of(v).collect();
        assert!((weights.iter().map(|(_, w)| w).sum::<f32>() - 1.0).abs() < 1e-6);
        assert_eq!(weights[0].0, 1, "the heaviest first");
        assert_eq!(weights[5..], [(0, 0.0); 3]);
    }
    // Without any weight the first joint takes it all.
    let nothing = file.accessor("VEC4", 5126, 4, &bytes(&[0.0; 16]));
    file.json["meshes"][0]["primitives"][0]["attributes"] =
        json!({"POSITION": 0, "JOINTS_0": joints, "WEIGHTS_0": nothing});
    assert_eq!(file.read().rig().expect("a rig").joint_weights, [1.0; 4]);
}

#[test]
fn morph_targets() {
    let mut file = square();
    let lift = file.positions(&[[0.0; 3], [0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, 2.0]]);
    let grow = file.positions(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": lift}, {"POSITION": grow}, {}]);
    file.json["meshes"][0]["weights"] = json!([0.5, 0, 0]);
    file.json["meshes"][0]["extras"] = json!({"targetNames": ["lift", "grow"]});
    animate(&mut file, 0, "weights", "STEP", &[0.0, 1.0], "SCALAR", &[0.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
    let cage = file.read();
    close(cage.positions(), &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.5], [0.0, 1.0, 1.0]]);
    let rig = rig(&cage);
    let [set] = &rig.morph_sets[..] else { panic!("one set") };
    assert_eq!(set.weights, [0.5, 0.0, 0.0]);
    let names: Vec<&str> = set.targets.iter().map(|target| &target.name[..]).collect();
    assert_eq!(names, ["lift", "grow", "target 2"]);
    assert_eq!(set.targets[0].vertices, [2, 3]);
    assert_eq!(set.targets[0].offsets, [Vec3::Z, Vec3::Z * 2.0]);
    assert_eq!(rig.bind_positions[3], DVec3::Y);
    close(&rig.positions(&rig.pose(0, 0.5)), &[[-1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    close(&rig.positions(&rig.pose(0, 1.0))[2..], &[[1.0, 1.0, 1.0], [0.0, 1.0, 2.0]]);
}

#[test]
fn nodes_without_a_skin_move_rigidly() {
    let mut file = square();
    file.json["nodes"] =
        json!([{"children": [1], "translation": [5, 0, 0]}, {"mesh": 0}, {"mesh": 0, "translation": [6, 0, 0]}]);
    file.json["scenes"] = json!([{"nodes": [0, 2]}]);
    let tangents = [[0.0; 3], [0.0, 0.0, 0.0], [0.0; 3], [0.0; 3], [4.0, 0.0, 0.0], [0.0; 3]].concat();
    animate(&mut file, 0, "translation", "CUBICSPLINE", &[0.0, 2.0], "VEC3", &tangents);
    let cage = file.read();
    // The squares touch at rest but do not move together.
    assert_eq!(cage.vertex_count(), 8);
    assert!(warnings(&cage).contains(&"2 vertices at the place of another that moves differently, not welded".into()));
    let rig = rig(&cage);
    let sampler = &rig.animations[0].samplers[0];
    assert_eq!((sampler.interpolation, sampler.width()), (Interpolation::CubicSpline, 3));
    assert_eq!(rig.animations[0].channels[0].property, NodeProperty::Translation);
    let moved = rig.positions(&rig.pose(0, 1.0));
    assert_eq!(moved[0], DVec3::new(2.0, 0.0, 0.0), "half-way along a smooth curve");
    assert_eq!(moved[4..], cage.positions()[4..]);
    assert!(matches!(rig.nodes[0].transform, NodeTransform::Decomposed { .. }));
    // Two nodes below the one that moves are welded.
    file.json["nodes"] = json!([{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0]}]);
    file.json["scenes"] = json!([{"nodes": [0]}]);
    assert_eq!(file.read().vertex_count(), 6);
}

#[test]
fn lips_are_not_sewn_together() {
    let mut file = File::new();
    let [a, b, c, d] = SQUARE;
    let positions = file.positions(&[a, b, c, a, c, d]);
    let offsets = file.positions(&[[0.0; 3], [0.0; 3], [0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    file.primitive(json!({"attributes": {"POSITION": positions}, "targets": [{"POSITION": offsets}]}));
    let cage = file.read();
    assert_eq!((cage.vertex_count(), cage.topology().edge_count()), (6, 6));
    assert_eq!(warnings(&cage), ["2 vertices at the place of another that moves differently, not welded"]);
}

#[test]
fn wrong_rigs() {
    let with = |change: &dyn Fn(&mut File)| {
        let mut file = skinned();
        animate(&mut file, 2, "translation", "LINEAR", &[0.0, 1.0], "VEC3", &[0.0; 6]);
        change(&mut file);
        file.refused().strip_prefix("test.glb: ").expect("the file comes first").to_owned()
    };
    let json = |path: &'static str, value: Value| {
        move |file: &mut File| *file.json.pointer_mut(path).expect("a place") = value.clone()
    };
    let skin = "mesh 0 primitive 0, JOINTS_0: accessor 2 has the element";
    assert_eq!(with(&|f| f.bin[60] = 7), format!("{skin} 1, which names joint 7 of a skin with 2 joints"));
    assert_eq!(
        with(&|f| f.bin[76..80].copy_from_slice(&(-0.5_f32).to_le_bytes())),
        "mesh 0 primitive 0, WEIGHTS_0: accessor 3 has the element 0, which has the weight -0.5; weights are at least 0"
    );
    assert_eq!(
        with(&json("/accessors/2/componentType", json!(5126))),
        "mesh 0 primitive 0, JOINTS_0: accessor 2 holds VEC4 of F32, but VEC4 of U8 or U16 is due"
    );
    assert_eq!(
        with(&json("/accessors/4/type", json!("VEC4"))),
        "skin 0, inverseBindMatrices: accessor 4 holds VEC4 of F32, but MAT4 of F32 is due"
    );
    assert_eq!(
        with(&json("/accessors/4/count", json!(1))),
        "skin 0 has 2 joints and 1 inverse bind matrices; it needs a matrix for each joint"
    );
    assert_eq!(
        with(&json("/nodes/1", json!({"children": [2, 1]}))),
        "node 1 is reached twice; the nodes of a scene must form a tree"
    );
    assert_eq!(
        with(&json("/nodes/2", json!({"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}))),
        "animation 0 channel 0 moves node 2, which has a matrix; only nodes with translation, rotation and scale can be moved"
    );
    assert_eq!(
        with(&json("/nodes/2/translation", json!([1e39, 0, 0]))),
        "node 2 has a transform with infinite numbers"
    );
    assert_eq!(
        with(&json("/accessors/6/count", json!(1))),
        "animation 0 channel 0 has 3 numbers for 2 keys, but 6 are due"
    );
    assert_eq!(
        with(&json("/animations/0/channels/0/target/node", json!(9))),
        "animation 0 channel 0 goes to node 9, but the nodes are 0 to 2"
    );
    assert_eq!(
        with(&json("/animations/0/channels/0/target/path", json!("colour"))),
        "animation 0 channel 0 changes something else than translation, rotation, scale or weights"
    );
    assert_eq!(
        with(&json("/accessors/5/count", json!(0))),
        "animation 0 sampler 0, input: accessor 5 has 0 elements, but 1 are due"
    );
    assert_eq!(
        with(&json("/animations/0/channels/0/target/path", json!("rotation"))),
        "animation 0 sampler 0, output: accessor 6 holds VEC3 of F32, but VEC4 of F32 or of normalized integers of 8 or 16 bits is due"
    );
    assert_eq!(
        with(&|f| {
            f.json["scenes"] = json!([{"nodes": [0]}]);
            f.json["nodes"][2] = json!({"children": [1]});
        }),
        "skin 0 joint 0 is node 1, which is in no tree of nodes"
    );
}
