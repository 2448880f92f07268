//! The JSON part of a file: parsed, its references checked, and its extensions known.

use ::gltf::json::validation::{Checked, Error as Fault, Validate};
use ::gltf::json::{Root, deserialize};
use ::gltf::{Document, Gltf, Semantic};

use super::{GltfError, container};
use crate::listed::numbered;
use crate::text::excerpt;

/// Extensions that change nothing about the shape, or that are read.
const KNOWN: [&str; 7] = [
    "FB_ngon_encoding",
    "KHR_mesh_quantization",
    "KHR_lights_punctual",
    "KHR_xmp_json_ld",
    "EXT_lights_image_based",
    "EXT_texture_webp",
    "MSFT_texture_dds",
];
/// Beginnings of names of extensions that only change how a surface looks.
const KNOWN_KINDS: [&str; 2] = ["KHR_materials_", "KHR_texture_"];
/// Ways of compressing meshes, and where a mesh says that it is compressed.
const DRACO: &str = "KHR_draco_mesh_compression";
const MESHOPT: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
/// A damaged file may have a fault in every line.
const MOST_FAULTS: usize = 3;

/// A file of which every index names something.
pub(super) fn parse(bytes: &[u8]) -> Result<Gltf, GltfError> {
    let (text, blob) = container::split(bytes)?;
    // Not by the crate's `Gltf`, which takes text that begins like a binary file for one.
    let json: Root = deserialize::from_slice(text).map_err(|error| unreadable(text, &error))?;
    check_extensions(&json)?;
    check_positions(&json)?;
    validate(&json)?;
    check_channels(&json)?;
    Ok(Gltf { document: Document::from_json_without_validation(json), blob: blob.map(<[u8]>::to_vec) })
}

/// Why JSON cannot be read. Files of glTF 1.0 are quite different and would be full of faults.
fn unreadable(text: &[u8], error: &::gltf::json::Error) -> GltfError {
    let version = deserialize::from_slice(text).ok().and_then(|Versioned { asset }| asset.version);
    match version.filter(|version| version.starts_with("1.")) {
        Some(version) => GltfError::Format(format!("the file is glTF {}; export it again as glTF 2.0", cut(&version))),
        None => malformed([error.to_string()]),
    }
}

/// What every version of the format has.
#[derive(serde::Deserialize)]
struct Versioned {
    asset: Asset,
}

#[derive(serde::Deserialize)]
struct Asset {
    version: Option<String>,
}

/// A message in one line.
fn malformed(faults: impl IntoIterator<Item = String>) -> GltfError {
    const LONGEST: usize = 200;
    let lines: Vec<String> = faults
        .into_iter()
        .flat_map(|fault| fault.lines().map(|line| excerpt(line.trim(), LONGEST)).collect::<Vec<_>>())
        .filter(|line| !line.is_empty())
        .collect();
    GltfError::Format(lines.join("; "))
}

fn check_extensions(json: &Root) -> Result<(), GltfError> {
    for name in &json.extensions_required {
        if name == DRACO {
            return Err(GltfError::Compressed(DRACO));
        }
        if let Some(meshopt) = MESHOPT.iter().find(|meshopt| *meshopt == name) {
            return Err(GltfError::Compressed(meshopt));
        }
        if !KNOWN.contains(&&name[..]) && !KNOWN_KINDS.iter().any(|kind| name.starts_with(kind)) {
            return Err(GltfError::Extension(cut(name)));
        }
    }
    // Compressed meshes may come with their data a second time, not compressed; without that, accessors have no view.
    let primitives = json.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let draco = primitives.filter(|p| p.extensions.as_ref().is_some_and(|e| e.others.contains_key(DRACO)));
    let mut accessors = draco.flat_map(|p| p.attributes.values().chain(&p.indices));
    let lacks_data = |accessor: &::gltf::json::Accessor| accessor.buffer_view.is_none() && accessor.sparse.is_none();
    if accessors.any(|index| json.accessors.get(index.value()).is_some_and(lacks_data)) {
        return Err(GltfError::Compressed(DRACO));
    }
    for buffer in json.buffers.iter().filter(|buffer| buffer.uri.is_none()) {
        let extensions = buffer.extensions.iter().flat_map(|e| e.others.keys());
        for name in extensions {
            if let Some(meshopt) = MESHOPT.iter().find(|meshopt| *meshopt == name) {
                return Err(GltfError::Compressed(meshopt));
            }
        }
    }
    Ok(())
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

/// The validation of the crate leaves out where channels of animations go.
fn check_channels(json: &Root) -> Result<(), GltfError> {
    for (animation, channels) in json.animations.iter().map(|animation| &animation.channels).enumerate() {
        for (channel, target) in channels.iter().map(|channel| &channel.target).enumerate() {
            let nodes = json.nodes.len();
            let fault = if target.node.value() >= nodes {
                format!("goes to node {}, but {}", target.node.value(), numbered(nodes, "node"))
            } else if matches!(target.path, Checked::Invalid) {
                "changes something else than translation, rotation, scale or weights".into()
            } else {
                continue;
            };
            return Err(GltfError::Channel { animation, channel, fault });
        }
    }
    Ok(())
}

/// The validation of the crate, without what the reader can do without.
fn validate(json: &Root) -> Result<(), GltfError> {
    let mut faults = Vec::new();
    let mut more = 0_usize;
    json.validate(json, ::gltf::json::Path::new, &mut |path, fault| {
        let path = path();
        if is_harmless(path.as_str(), fault) {
            return;
        }
        if faults.len() < MOST_FAULTS {
            faults.push(format!("{path}: {fault}"));
        } else {
            more += 1;
        }
    });
    if faults.is_empty() {
        return Ok(());
    }
    if more > 0 {
        faults.push(format!("and {more} more"));
    }
    Err(malformed(faults))
}

fn is_harmless(path: &str, fault: Fault) -> bool {
    match fault {
        // Boxes of positions are counted anew; an accessor without a view is all zeros; a texture may have its image in an extension.
        Fault::Missing => {
            let bounds = path.ends_with(".min") || path.ends_with(".max");
            let zeros = path.starts_with("accessors[") && path.ends_with("].bufferView");
            let source = path.starts_with("textures[") && path.ends_with("].source");
            bounds || zeros || source
        }
        // Quantised positions have boxes of integers, and attributes of unknown names are not read.
        Fault::Invalid => path.ends_with(".min") || path.ends_with(".max") || path.contains("<invalid semantic name>"),
        // Checked before.
        Fault::Unsupported => path.starts_with("extensionsRequired"),
        _ => false,
    }
}

/// A name or uri for a message.
pub(super) fn cut(text: &str) -> String {
    const LONGEST: usize = 60;
    excerpt(text, LONGEST)
}
