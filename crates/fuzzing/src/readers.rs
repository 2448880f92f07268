//! Readers: any bytes are a cage or a message.

use std::path::{Component, Path};

use osculate_cage::{
    Cage, CageError, CreaseDesc, FileFormat, GltfDesc, GltfError, ImageSource, Limits, ReadDesc, ReadError, RepairDesc,
    TopologyError, inspect, read_obj, write_obj,
};

/// Small enough that no input takes long, large enough for every branch.
const LIMITS: Limits = Limits { file_bytes: 1 << 16, faces: 2000, memory_bytes: 4 << 20 };

/// A message longer than this is not read by anybody.
const LONGEST_MESSAGE: usize = 1000;

pub(crate) fn obj(bytes: &[u8]) {
    read(bytes, "fuzz.obj", FileFormat::Obj);
}

pub(crate) fn ply(bytes: &[u8]) {
    read(bytes, "fuzz.ply", FileFormat::Ply);
}

pub(crate) fn off(bytes: &[u8]) {
    read(bytes, "fuzz.off", FileFormat::Off);
}

pub(crate) fn gltf(bytes: &[u8]) {
    read(bytes, "no-such-folder/fuzz.gltf", FileFormat::Gltf);
}

pub(crate) fn usd(bytes: &[u8]) {
    read(bytes, "fuzz.usd", FileFormat::Usd);
}

/// Reads the bytes as they are, and once more with all that can be asked for on top.
fn read(bytes: &[u8], name: &str, format: FileFormat) {
    let path = Path::new(name);
    // What begins like another format is the matter of another target.
    if FileFormat::of(path, bytes) != Some(format) {
        return;
    }
    let plain = ReadDesc { limits: LIMITS, ..ReadDesc::default() };
    let creases = CreaseDesc { angle: Some(30.0), smoothing: true, materials: true, uv: true, sharpness: 2.5 };
    let gltf = GltfDesc { weld_tolerance: 0.01, ..GltfDesc::default() };
    let repair = RepairDesc { weld_tolerance: 0.01 };
    let helped = ReadDesc { gltf, repair: Some(repair), creases: Some(creases), ..plain.clone() };
    for desc in [plain, helped] {
        match Cage::read_bytes(bytes, path, &desc) {
            Ok(cage) => check_cage(&cage),
            Err(ReadError::Refused { error, .. }) if desc.repair.is_some() && is_repairable(&error) => {
                panic!("a repair left {error}");
            }
            Err(error) => check_error(&error, bytes, path),
        }
    }
}

/// Whether a repair can do something about it: the mesh is well formed but no manifold.
pub(crate) fn is_repairable(error: &CageError) -> bool {
    use TopologyError::{BowTie, InconsistentWinding, NonManifoldEdge, RepeatedVertex, TooFewCorners};
    let CageError::Topology(error) = error else { return false };
    matches!(error, BowTie(_) | InconsistentWinding(_) | NonManifoldEdge(_) | RepeatedVertex(_) | TooFewCorners(_))
}

/// A message is one line of readable length that starts with the file, and its line is one of the file.
fn check_error(error: &ReadError, bytes: &[u8], path: &Path) {
    let message = error.to_string();
    assert!(message.starts_with(&*path.to_string_lossy()), "{message:?} does not name the file");
    assert!(!message.contains(char::is_control), "{message:?} is not one line");
    assert!(message.len() < LONGEST_MESSAGE, "{message:?} is too long");
    if let ReadError::Obj { line, .. } | ReadError::Off { line, .. } | ReadError::Refused { line: Some(line), .. } =
        error
    {
        let lines = 1 + bytes.iter().filter(|byte| matches!(byte, b'\n' | b'\r')).count();
        assert!((1..=lines).contains(&(*line as usize)), "{message:?} names a line of {lines}");
    }
    if let ReadError::Gltf { error: GltfError::BufferFile { file, .. }, .. } = error {
        assert!(is_below(file, path.parent()), "{message:?} leaves the folder");
    }
}

/// Whether a path stays below a folder, whatever is on the disk.
fn is_below(file: &Path, folder: Option<&Path>) -> bool {
    let rest = folder.and_then(|folder| file.strip_prefix(folder).ok());
    rest.is_some_and(|rest| rest.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)))
}

/// What was read can be used: inspected, posed, and written so that it reads back as the same bits.
pub(crate) fn check_cage(cage: &Cage) {
    assert!(cage.warnings().iter().all(|warning| !warning.to_string().contains('\n')), "{:?}", cage.warnings());
    let inspection = inspect(cage);
    assert!(inspection.genus >= 0 && inspection.components > 0 && inspection.faces > 0, "{inspection:?}");
    check_round_trip(cage);
    if let Some(rig) = cage.rig() {
        for animation in 0..rig.animations.len() {
            assert_eq!(rig.positions(&rig.pose(animation, 0.5)).len(), cage.vertex_count());
        }
    }
    for image in cage.appearance().iter().flat_map(|appearance| &appearance.images) {
        if let ImageSource::File(file) = &image.source {
            assert!(is_below(file, Some(Path::new("no-such-folder"))), "{} leaves the folder", file.display());
        }
    }
}

fn check_round_trip(cage: &Cage) {
    let mut text = Vec::new();
    write_obj(cage, &mut text).expect("a vector takes everything");
    let again = read_obj(&text, "again.obj").unwrap_or_else(|error| panic!("{error}"));
    let bits = |cage: &Cage| cage.positions().iter().flat_map(|p| p.to_array()).map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(&again), bits(cage));
    assert_eq!((again.topology(), again.uv(), again.tags()), (cage.topology(), cage.uv(), cage.tags()));
}
