//! Files that are refused, and what is said of them.

use super::*;

#[test]
fn buffers_that_cannot_be_had() {
    let file = square();
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("short.bin"), [0; 10]).expect("written");
    let refused = |uri: &str, folder: Option<&Path>| {
        read_gltf(&file.with_uri(uri), "test.gltf", folder).expect_err("must be refused").to_string()
    };
    let place = "; only base64 `data:` and relative paths inside the folder of the file are read";
    for uri in ["../a.bin", "/a.bin", "http://host/a.bin", "data:text/plain,abc", "data:;base64"] {
        assert_eq!(refused(uri, Some(folder.path())), format!("test.gltf: buffer 0 is at {uri:?}{place}"));
    }
    assert_eq!(refused("a.bin", None), format!("test.gltf: buffer 0 is at \"a.bin\"{place}"));
    assert!(refused(&format!("data:{}", "x".repeat(1000)), None).len() < 250);
    assert_eq!(refused("data:;base64,A", None), "test.gltf: buffer 0 has malformed base64 data");
    assert_eq!(refused("data:;base64,AAAA", None), "test.gltf: buffer 0 has 3 of the 56 bytes it announces");
    assert_eq!(refused("short.bin", Some(folder.path())), "test.gltf: buffer 0 has 10 of the 56 bytes it announces");
    let missing = refused("missing.bin", Some(folder.path()));
    assert!(missing.starts_with("test.gltf: buffer 0: ") && missing.contains("missing.bin: No such file"), "{missing}");

    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/dev/zero", folder.path().join("endless.bin")).expect("linked");
        let endless = refused("endless.bin", Some(folder.path()));
        assert!(endless.ends_with("endless.bin: not a regular file"), "{endless}");
    }

    let mut json = file.json.clone();
    json["buffers"][0] = json!({"byteLength": 56});
    let error = read_gltf(json.to_string().as_bytes(), "test.gltf", None).expect_err("no binary part");
    assert_eq!(error.to_string(), "test.gltf: buffer 0 has no uri, and the file has no binary part for it");
}

#[test]
fn only_the_first_buffer_is_the_binary_part() {
    let mut file = square();
    file.push("buffers", json!({"byteLength": 56}));
    assert_eq!(file.refused(), "test.glb: buffer 1 has no uri, and the file has no binary part for it");
}

#[test]
fn not_gltf() {
    let refused = |bytes: &[u8]| read_gltf(bytes, "test.glb", None).expect_err("must be refused").to_string();
    assert!(refused(b"").starts_with("test.glb: not readable as glTF 2.0: "));
    assert!(refused(b"solid stl").starts_with("test.glb: not readable as glTF 2.0: "));
    assert!(refused(b"{\"asset\": {\"version\": \"2.0\"}").starts_with("test.glb: not readable as glTF 2.0: "));
    for length in 0..30 {
        let mut bytes = square().glb();
        bytes.truncate(length);
        assert!(refused(&bytes).starts_with("test.glb: not readable as glTF 2.0: "), "{length}");
    }
    let mut short = square().glb();
    short[8..12].copy_from_slice(&3_u32.to_le_bytes());
    assert_eq!(
        refused(&short),
        "test.glb: not readable as glTF 2.0: the header of the binary file announces 3 bytes, which is too few"
    );
    let mut file = square();
    file.json["nodes"] = json!([{"mesh": 7}]);
    assert!(!file.refused().contains('\n'));
}

#[test]
fn scenes_without_triangles() {
    let mut file = square();
    file.json["nodes"] = json!([{}]);
    assert_eq!(
        file.refused(),
        "test.glb: no triangles in the scene; export meshes, not points, lines or an empty scene"
    );
    let mut lines = File::new();
    let positions = lines.positions(&SQUARE);
    lines.primitive(json!({"attributes": {"POSITION": positions}, "mode": 1}));
    assert_eq!(
        lines.refused(),
        "test.glb: no triangles in the scene; export meshes, not points, lines or an empty scene"
    );
}

#[test]
fn triangles_that_all_collapse_leave_no_faces() {
    let mut file = File::new();
    let positions = file.positions(&[[1.0; 3]; 3]);
    file.primitive(json!({"attributes": {"POSITION": positions}}));
    assert_eq!(file.refused(), "test.glb: no faces; a cage has at least one");
}

#[test]
fn nodes_must_be_a_tree() {
    let mut file = square();
    file.json["nodes"] = json!([{"mesh": 0, "children": [1]}, {"children": [0]}]);
    assert_eq!(file.refused(), "test.glb: node 0 is reached twice; the nodes of a scene must form a tree");
    file.json["nodes"] = json!([{"children": [1, 2]}, {"children": [2]}, {"mesh": 0}]);
    assert_eq!(file.refused(), "test.glb: node 2 is reached twice; the nodes of a scene must form a tree");
}

#[test]
fn deep_trees_do_not_exhaust_the_stack() {
    let mut file = square();
    let depth = 100_000;
    let mut nodes: Vec<Value> = (1..depth).map(|child| json!({"children": [child]})).collect();
    nodes.push(json!({"mesh": 0}));
    file.json["nodes"] = json!(nodes);
    assert_eq!(file.read().face_count(), 2);
}

#[test]
fn wrong_accessors() {
    let with = |change: &dyn Fn(&mut File)| {
        let mut file = square();
        let uv = file.uv(&[[0.0, 0.0]; 4]);
        file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uv);
        change(&mut file);
        file.refused()
    };
    let at = "test.glb: mesh 0 primitive 0, ";
    assert_eq!(
        with(&|f| f.json["accessors"][0]["componentType"] = json!(5123)),
        format!(
            "{at}POSITION: accessor 0 holds VEC3 of U16, which the file may do only if it lists \
             KHR_mesh_quantization in extensionsRequired"
        )
    );
    assert_eq!(
        with(&|f| f.json["accessors"][0]["type"] = json!("VEC4")),
        format!("{at}POSITION: accessor 0 holds VEC4 of F32, but VEC3 of F32 is due")
    );
    assert_eq!(
        with(&|f| f.json["accessors"][2]["componentType"] = json!(5121)),
        format!("{at}TEXCOORD_0: accessor 2 holds VEC2 of U8, but VEC2 of F32 or of normalized U8 or U16 is due")
    );
    assert_eq!(
        with(&|f| f.json["accessors"][1]["normalized"] = json!(true)),
        format!("{at}indices: accessor 1 holds SCALAR of normalized U8, but SCALAR of U8, U16 or U32 is due")
    );
    assert_eq!(
        with(&|f| f.json["accessors"][1]["componentType"] = json!(5126)),
        format!("{at}indices: accessor 1 holds SCALAR of F32, but SCALAR of U8, U16 or U32 is due")
    );
    assert_eq!(
        with(&|f| f.json["accessors"][0]["count"] = json!(5)),
        format!("{at}POSITION: accessor 0 needs 60 bytes of a view with 48")
    );
    assert_eq!(
        with(&|f| f.json["accessors"][0]["byteOffset"] = json!(2)),
        format!("{at}POSITION: accessor 0 needs 50 bytes of a view with 48")
    );
    assert_eq!(
        with(&|f| {
            f.json["accessors"][0]["count"] = json!(3);
            f.json["accessors"][0]["byteOffset"] = json!(2);
        }),
        format!(
            "{at}POSITION: accessor 0 starts at byte 2 of its buffer with a stride of 12; both must be multiples of 4"
        )
    );
    assert_eq!(
        with(&|f| f.json["accessors"][0]["byteOffset"] = json!(4)),
        format!("{at}POSITION: accessor 0 needs 52 bytes of a view with 48")
    );
    assert_eq!(
        with(&|f| f.json["accessors"][0]["count"] = json!(u64::MAX)),
        format!("{at}POSITION: accessor 0 needs 18446744073709551615 bytes of a view with 48")
    );
    assert_eq!(
        with(&|f| f.json["bufferViews"][0]["byteLength"] = json!(1000)),
        format!("{at}POSITION: accessor 0 uses view 0, which leaves its buffer")
    );
    assert_eq!(
        with(&|f| f.json["bufferViews"][0]["byteOffset"] = json!(u64::MAX)),
        format!("{at}POSITION: accessor 0 uses view 0, which leaves its buffer")
    );
    assert_eq!(
        with(&|f| f.json["bufferViews"][0]["byteStride"] = json!(8)),
        format!("{at}POSITION: accessor 0 has elements of 12 bytes at a stride of 8")
    );
    assert_eq!(with(&|f| f.bin[48] = 4), format!("{at}POSITION: accessor 0 has 4 elements, but element 4 is used"));
    assert_eq!(
        with(&|f| f.json["accessors"][2]["count"] = json!(3)),
        format!("{at}TEXCOORD_0: accessor 2 has 3 elements, but element 3 is used")
    );
    assert_eq!(
        with(&|f| f.json["accessors"][1]["count"] = json!(5)),
        "test.glb: mesh 0 primitive 0 has 5 corners, which are no whole triangles"
    );
    assert_eq!(
        with(&|f| f.json["meshes"][0]["primitives"][0]["attributes"] = json!({"TEXCOORD_0": 2})),
        "test.glb: mesh 0 primitive 0 has no accessor for POSITION"
    );
}

#[test]
fn messages_of_the_parser_are_one_line() {
    let mut file = square();
    file.json["accessors"][0].as_object_mut().expect("an object").remove("min");
    file.json["accessors"][0]["bufferView"] = json!(9);
    assert_eq!(file.refused(), "test.glb: not readable as glTF 2.0: accessors[0].bufferView: Index out of bounds");
    file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(7);
    assert_eq!(file.refused(), "test.glb: mesh 0 primitive 0 has no accessor for POSITION");
}

#[test]
fn bombs_are_refused() {
    let mut file = File::new();
    let (at, values) = (file.view(&[1]), file.view(&bytes(&[1.0, 0.0, 0.0])));
    let sparse =
        json!({"count": 1, "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": values}});
    let positions = file.push("accessors", json!({"componentType": 5126, "count": 3_000_000_000_u32, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0], "sparse": sparse}));
    file.primitive(json!({"attributes": {"POSITION": positions}}));
    assert_eq!(file.refused(), "test.glb: more than 67108864 triangle corners in the scene; that is no control cage");
}

#[test]
fn refused_meshes_name_their_elements() {
    let mut file = File::new();
    let (positions, indices) = (file.positions(&SQUARE), file.indices(&[0, 1, 2, 0, 1, 3]));
    file.primitive(json!({"attributes": {"POSITION": positions}, "indices": indices}));
    assert_eq!(
        file.refused(),
        "test.glb: inconsistent winding, 1 edge along which both faces run the same way: 0-1 (faces 0, 1); flip the faces that are inside out, or delete one of two equal faces (elements count from 0)"
    );
    let mut nan = File::new();
    let positions = nan.positions(&[[0.0; 3], [f32::NAN; 3], [1.0; 3]]);
    nan.primitive(json!({"attributes": {"POSITION": positions}}));
    assert_eq!(
        nan.refused(),
        "test.glb: mesh 0 primitive 0, POSITION: accessor 0 has the element 1, which is infinite or not a number"
    );
}
