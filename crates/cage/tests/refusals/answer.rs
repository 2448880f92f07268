//! What reading the file of a case says.

use std::path::Path;

use osculate_cage::{Cage, CreaseDesc, GltfDesc, Limits, PolygonRecovery, ReadDesc, RepairDesc};

use crate::content;
use crate::table::Case;

/// The answer with its mark: the message, or what was read and the warnings.
pub(crate) fn answer(case: &Case, all: &[Case]) -> String {
    match Cage::read_bytes(&content::bytes(case, all), Path::new(&case.name), &desc(&case.options)) {
        Err(error) => format!("-- {error}"),
        Ok(cage) => {
            let warnings = cage.warnings().iter().map(|warning| format!("\n++ warning: {warning}"));
            format!("++ {}{}", summary(&cage), warnings.collect::<String>())
        }
    }
}

/// How a case is read: as by default, but glTF without looking for polygons, unless options say otherwise.
fn desc(options: &[String]) -> ReadDesc {
    let gltf = GltfDesc { polygons: PolygonRecovery::NONE, ..GltfDesc::default() };
    let mut desc = ReadDesc { gltf, ..ReadDesc::default() };
    for option in options {
        let (key, value) = option.split_once('=').unwrap_or((option, ""));
        let number = || value.parse().unwrap_or_else(|_| panic!("{option:?} needs a number"));
        match key {
            "from" | "glb" => {}
            "polygons" => desc.gltf.polygons = PolygonRecovery::default(),
            "gltf-weld" => desc.gltf.weld_tolerance = value.parse().expect("a distance"),
            "repair" => desc.repair = Some(RepairDesc { weld_tolerance: value.parse().unwrap_or(0.0) }),
            "crease-angle" => {
                desc.creases = Some(CreaseDesc { angle: value.parse().ok(), ..CreaseDesc::default() });
            }
            "max-file-size" => desc.limits = Limits { file_bytes: number(), ..desc.limits },
            "max-faces" => desc.limits = Limits { faces: number(), ..desc.limits },
            "max-memory" => desc.limits = Limits { memory_bytes: number(), ..desc.limits },
            _ => panic!("no option {option:?}"),
        }
    }
    desc
}

fn summary(cage: &Cage) -> String {
    let sizes: Vec<String> = (0..cage.face_count()).map(|f| cage.face(f).len().to_string()).collect();
    let mut summary = format!("{} vertices, faces of {} corners", cage.vertex_count(), sizes.join(" "));
    let tags = cage.tags();
    let sets = cage.face_sets().iter().map(|set| format!("{:?} {:?}", set.kind, set.name)).collect::<Vec<_>>();
    for (count, what) in [
        (cage.uv().map_or(0, |uv| uv.values.len()), "uv"),
        (tags.creases.len(), "creases"),
        (tags.corners.len(), "corners"),
        (tags.holes.len(), "holes"),
    ] {
        if count > 0 {
            summary += &format!(", {count} {what}");
        }
    }
    if sets.is_empty() { summary } else { format!("{summary}, sets {}", sets.join(", ")) }
}
