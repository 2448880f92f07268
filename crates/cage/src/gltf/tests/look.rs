//! Quantised data, compression, welding within a tolerance, materials.

use glam::{DVec2, DVec3, Vec4};
use serde_json::{Value, json};

use super::{File, SQUARE, square, triangles, warnings};
use crate::{CreaseDesc, GltfDesc, ImageSource, Limits, NONE, ReadDesc, RepairDesc, Wrap};

fn shorts(numbers: &[i16]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

#[test]
fn quantised_positions_and_uv() {
    let mut file = File::new();
    let positions = file.accessor("VEC3", 5122, 3, &shorts(&[0, 0, 0, 0, 200, 0, 0, 0, 100, -300, 0, 0]));
    let view = file.json["accessors"][positions]["bufferView"].as_u64().expect("a view") as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(8);
    let uv = file.accessor("VEC2", 5120, 3, &[0, 127, 129, 128, 64, 0]);
    file.json["accessors"][uv]["normalized"] = json!(true);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    file.json["nodes"] = json!([{"mesh": 0, "scale": [0.5, 0.5, 0.5]}]);
    file.primitive(json!({"attributes": {"POSITION": positions, "TEXCOORD_0": uv}}));
    let cage = file.read();
    assert_eq!(cage.positions(), [DVec3::ZERO, DVec3::X * 100.0, DVec3::new(50.0, -150.0, 0.0)]);
    let values = &cage.uv().expect("uv").values;
    assert_eq!(values[..], [DVec2::Y, DVec2::new(-1.0, -1.0), DVec2::new(64.0 / 127.0, 0.0)]);
    file.json["accessors"][positions]["normalized"] = json!(true);
    assert_eq!(file.read().positions()[1].x, 0.5 * 200.0 / 32767.0);
}

#[test]
fn compression_is_refused_by_name() {
    let refused = |change: &dyn Fn(&mut Value)| {
        let mut file = square();
        change(&mut file.json);
        file.refused()
    };
    let message = |name| {
        format!(
            "test.glb: the meshes are compressed with {name}, which is not read; export them again without compression"
        )
    };
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"] {
        assert_eq!(refused(&|file| file["extensionsRequired"] = json!([name])), message(name));
    }
    let draco = |file: &mut Value| {
        file["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_draco_mesh_compression": {"bufferView": 0}});
        file["accessors"][0].as_object_mut().expect("an object").remove("bufferView");
    };
    assert_eq!(refused(&draco), message("KHR_draco_mesh_compression"));
    let meshopt = |file: &mut Value| {
        let buffers = file["buffers"].as_array_mut().expect("buffers");
        buffers.push(json!({"byteLength": 9, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}));
    };
    assert_eq!(refused(&meshopt), message("EXT_meshopt_compression"));
    // Data that are there a second time, not compressed, are read.
    let mut file = square();
    file.json["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_draco_mesh_compression": {"bufferView": 0}});
    assert_eq!(file.read().face_count(), 2);
    assert_eq!(
        refused(&|file| file["extensionsRequired"] = json!(["KHR_texture_transform", "ACME_voxels"])),
        "test.glb: the file requires the extension ACME_voxels, which is not read; export it again without that extension"
    );
}

#[test]
fn near_vertices_are_welded_on_request() {
    let mut file = File::new();
    let [a, b, c, d] = SQUARE;
    let positions = file.positions(&[a, b, c, [1e-4, 0.0, 0.0], [1.0, 1.0, -1e-4], d]);
    file.primitive(json!({"attributes": {"POSITION": positions}}));
    assert_eq!(file.read().vertex_count(), 6);
    let cage = file.read_with(&GltfDesc { weld_tolerance: 1e-3, ..triangles() });
    assert_eq!((cage.vertex_count(), cage.topology().edge_count()), (4, 5));
    assert_eq!(file.read_with(&GltfDesc { weld_tolerance: 1e-3, ..GltfDesc::default() }).face_count(), 1);
}

#[test]
fn accessors_without_data_are_zero_and_boxes_are_not_needed() {
    let mut file = square();
    file.json["accessors"][0].as_object_mut().expect("an object").retain(|key, _| key != "min" && key != "max");
    file.json["meshes"][0]["primitives"][0]["attributes"]["UNKNOWN"] = json!(0);
    let zeros = file.push("accessors", json!({"componentType": 5126, "count": 4, "type": "VEC2"}));
    file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(zeros);
    assert_eq!(file.read().uv().expect("uv").values, [DVec2::ZERO]);
}

#[test]
fn sparse_indices_must_rise() {
    for (at, position) in [([2_u8, 1], 1), ([1, 1], 1), ([1, 4], 1), ([9, 1], 0)] {
        let mut file = square();
        let (at, values) = (file.view(&at), file.view(&[0; 24]));
        file.json["accessors"][0]["sparse"] =
            json!({"count": 2, "indices": {"bufferView": at, "componentType": 5121}, "values": {"bufferView": values}});
        assert_eq!(
            file.refused(),
            format!(
                "test.glb: mesh 0 primitive 0, POSITION: accessor 0 has sparse indices that do not rise below 4, \
                 first the one of number {position}"
            )
        );
    }
}

#[test]
fn materials_and_textures() {
    let mut file = square();
    let uv = file.uv(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let second = file.uv(&[[0.25, 0.5]; 4]);
    let image = file.view(b"\x89PNG and so on");
    let primitive = &mut file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = json!(uv);
    primitive["attributes"]["TEXCOORD_1"] = json!(second);
    primitive["material"] = json!(1);
    file.json["images"] =
        json!([{"bufferView": image, "mimeType": "image/png"}, {"uri": "bumps.png", "name": "bumps"}]);
    file.json["samplers"] = json!([{"wrapS": 33071, "magFilter": 9728}]);
    file.json["textures"] = json!([{"source": 0, "sampler": 0}, {"source": 1}, {}]);
    let transform = json!({"KHR_texture_transform": {"offset": [1, 2], "rotation": std::f64::consts::FRAC_PI_2, "scale": [3, 4], "texCoord": 1}});
    file.json["materials"][1] = json!({
        "name": "skin",
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1], "baseColorTexture": {"index": 0, "extensions": transform}},
        "extensions": {"KHR_materials_displacement": {
            "displacementGeometryTexture": {"index": 1, "texCoord": 1}, "displacementGeometryFactor": 0.1
        }}
    });
    let folder = tempfile::tempdir().expect("a folder");
    let read = |file: &File| super::read_gltf(&file.glb(), "test.glb", Some(folder.path())).expect("a cage");
    let cage = read(&file);
    let look = cage.appearance().expect("materials");
    assert_eq!(look.face_materials, [0, 0]);
    assert_eq!(look.more_uv[0].set, 1);
    assert_eq!(look.more_uv[0].uv.values, [DVec2::new(0.25, 0.5)]);
    let skin = look.material(1).expect("a material");
    assert_eq!((&skin.name[..], skin.base_color), ("skin", Vec4::new(0.5, 0.25, 1.0, 1.0)));
    let colour = skin.base_color_texture.as_ref().expect("a texture");
    assert_eq!((colour.uv_set, colour.wrap, colour.nearest), (1, [Wrap::ClampToEdge, Wrap::Repeat], true));
    let placed = colour.transform.transform_point2(DVec2::new(1.0, 0.0));
    assert!(placed.distance(DVec2::new(1.0, -1.0)) < 1e-12, "turned counter-clockwise, which is up: {placed}");
    assert_eq!(look.images[0].source, ImageSource::Bytes(b"\x89PNG and so on"[..].into()));
    let bumps = skin.displacement.as_ref().expect("displacement");
    assert_eq!((bumps.scale, bumps.offset, bumps.texture.uv_set), (0.1, 0.0, 1));
    assert_eq!(look.images[bumps.texture.image as usize].source, ImageSource::File(folder.path().join("bumps.png")));
    assert!(cage.warnings().is_empty());

    // The same in extras; and images that are not to be had.
    file.json["materials"][1] = json!({"extras": {"displacementGeometryTexture": 1, "displacementGeometryOffset": -2}, "pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}});
    file.json["images"][1]["uri"] = json!("bumps.png");
    let cage = read(&file);
    let material = &cage.appearance().expect("materials").materials[0];
    assert_eq!(material.displacement.as_ref().map(|d| (d.scale, d.offset)), Some((1.0, -2.0)));
    assert_eq!(material.base_color_texture, None);
    assert_eq!(warnings(&cage), ["1 texture of an image that cannot be read ignored"]);
    file.json["images"][1]["uri"] = json!("../bumps.png");
    assert_eq!(warnings(&read(&file)), ["2 textures of an image that cannot be read ignored"]);
}

#[test]
fn faces_without_a_material_have_none() {
    let mut file = square();
    let (positions, indices) =
        (file.positions(&[[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]]), file.indices(&[0, 1, 2]));
    file.primitive(json!({"attributes": {"POSITION": positions}, "indices": indices, "material": 0}));
    let cage = file.read();
    assert_eq!(cage.appearance().expect("materials").face_materials, [NONE, NONE, 0]);
    assert_eq!(cage.appearance().expect("materials").material(0), None);
}

#[test]
fn repairs_and_creases_keep_what_belongs_to_faces_and_vertices() {
    let mut file = File::new();
    let [a, b, c, d] = SQUARE;
    let positions = file.positions(&[a, b, c, d, [0.0, 0.0, 1.0]]);
    let lift = file.positions(&[[0.0; 3], [0.0; 3], [0.0; 3], [0.0, 0.0, 2.0], [0.0; 3]]);
    let uv = file.uv(&[[0.5, 0.5]; 5]);
    let second = file.uv(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]]);
    // The second triangle is there twice.
    let indices = file.indices(&[0, 1, 2, 2, 3, 0, 2, 3, 0, 1, 0, 4]);
    file.primitive(json!({
        "attributes": {"POSITION": positions, "TEXCOORD_0": uv, "TEXCOORD_1": second},
        "indices": indices, "targets": [{"POSITION": lift}], "material": 0
    }));
    assert!(file.refused().contains("with more than two faces"), "{}", file.refused());
    let desc = ReadDesc {
        gltf: triangles(),
        repair: Some(RepairDesc::default()),
        creases: Some(CreaseDesc { angle: Some(60.0), ..CreaseDesc::default() }),
        ..ReadDesc::default()
    };
    let cage = file.read_as(&desc).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((cage.face_count(), cage.vertex_count(), cage.tags().creases.len()), (3, 5, 1));
    let look = cage.appearance().expect("materials");
    assert_eq!(look.face_materials, [0; 3]);
    assert_eq!(look.more_uv[0].uv.indices.len(), 9);
    let target = &cage.rig().expect("a rig").morph_sets[0].targets[0];
    let raised: Vec<DVec3> = target.vertices.iter().map(|&v| cage.positions()[v as usize]).collect();
    assert_eq!(raised, [DVec3::Y]);
}

#[test]
fn limits_are_kept() {
    let with = |limits: Limits| {
        let desc = ReadDesc { limits, ..ReadDesc::default() };
        square().read_as(&desc).map(|cage| cage.face_count()).map_err(|error| error.to_string())
    };
    let message = |text: &str| Err(format!("test.glb: {text}"));
    assert_eq!(with(Limits::default()), Ok(1));
    assert_eq!(
        with(Limits { faces: 1, ..Limits::default() }),
        message("more faces than the limit of 1; raise the limit or split the model")
    );
    let memory_bytes = square().glb().len() as u64 + 200;
    assert_eq!(
        with(Limits { memory_bytes, ..Limits::default() }),
        message(&format!(
            "the cage would take more memory than the limit of {memory_bytes} bytes; raise the limit or split the model"
        ))
    );
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("large.bin"), [0; 5000]).expect("written");
    let desc = ReadDesc { limits: Limits { file_bytes: 4000, ..Limits::default() }, ..ReadDesc::default() };
    let error = crate::read_gltf(&square().with_uri("large.bin"), "test.gltf", Some(folder.path()), &desc);
    assert_eq!(
        error.expect_err("too large").to_string(),
        "test.gltf: the file is larger than the limit of 4000 bytes; raise the limit if it is to be trusted"
    );
}
