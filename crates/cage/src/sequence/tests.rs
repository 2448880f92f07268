use super::*;

const FACES: &str = "f 1 2 3 4\n";

/// A square at a height, with its faces.
fn square(height: f64, faces: &str) -> String {
    format!("v 0 0 {height}\nv 1 0 {height}\nv 1 1 {height}\nv 0 1 {height}\n{faces}")
}

/// A folder with files.
fn folder(files: &[(&str, String)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    folder
}

fn open(folder: &tempfile::TempDir, name: &str) -> Result<Sequence, ReadError> {
    Sequence::open(&folder.path().join(name), &ReadDesc::default())
}

/// The message without the folder.
fn message(folder: &tempfile::TempDir, error: &ReadError) -> String {
    error.to_string().replace(&format!("{}/", folder.path().display()), "")
}

#[test]
fn numbers_are_put_in_order() {
    let file = |number: u32| (format!("walk_{number}.obj"), square(f64::from(number), FACES));
    let files = [10, 9, 11, 8].map(file);
    let files: Vec<(&str, String)> = files.iter().map(|(name, text)| (name.as_str(), text.clone())).collect();
    let folder = folder(&files);
    std::fs::write(folder.path().join("walk_x.obj"), "no frame").expect("written");
    let sequence = open(&folder, "walk_%d.obj").expect("a sequence");
    assert_eq!((sequence.frame_count(), sequence.cage().face_count()), (4, 1));
    let heights: Vec<f64> = (0..4).map(|frame| sequence.positions(frame).expect("a frame")[0].z).collect();
    assert_eq!(heights, [8.0, 9.0, 10.0, 11.0]);
    assert_eq!(sequence.times(), [8.0, 9.0, 10.0, 11.0].map(|number| number / 24.0));
    let faster = sequence.with_frames_per_second(2.0);
    assert_eq!(faster.times(), [4.0, 4.5, 5.0, 5.5]);
    // Between frames on a line, and beyond them held.
    let height = |time: f64| faster.positions_at(time).expect("positions")[2].z;
    assert_eq!([3.0, 4.0, 4.25, 5.0, 5.125, 9.0].map(height), [8.0, 8.0, 8.5, 10.0, 10.25, 11.0]);
}

#[test]
fn a_gap_is_named() {
    let folder = folder(&[("a_0001.obj", square(0.0, FACES)), ("a_0003.obj", square(0.0, FACES))]);
    let error = open(&folder, "a_####.obj").expect_err("a gap");
    assert_eq!(
        message(&folder, &error),
        "a_0002.obj: frame 2 is missing, but there are frames 1 to 3; all between them must be there"
    );
    let error = open(&folder, "b_##.obj").expect_err("nothing");
    let expected =
        "b_##.obj: there is no file like that; #### stands for numbers with at least four digits, %d for any number";
    assert_eq!(message(&folder, &error), expected);
    let error = open(&folder, "a_#_#.obj").expect_err("two places");
    assert!(message(&folder, &error).starts_with("a_#_#.obj: a pattern with several places"));
    assert!(matches!(open(&folder, "missing/a_#.obj"), Err(ReadError::Io { .. })));
}

#[test]
fn other_faces_are_named() {
    let five = square(0.0, "v 5 5 5\nf 1 2 3 4\n");
    let folder = folder(&[
        ("a_1.obj", square(0.0, "f 1 2 3\nf 1 3 4\n")),
        ("a_2.obj", square(0.0, FACES)),
        ("a_3.obj", square(0.0, "f 1 2 4\nf 2 3 4\n")),
        ("a_4.obj", five),
        ("a_5.obj", "v 0 0".into()),
    ]);
    let sequence = open(&folder, "a_#.obj").expect("a sequence");
    let refused = |frame: usize| {
        let error = sequence.positions(frame).expect_err("refused");
        message(&folder, &error)
    };
    let [a, b, c, d] = [1, 2, 3, 4].map(refused);
    assert_eq!(a, "a_2.obj: 1 faces, but the first frame (a_1.obj) has 2; all frames must have the same faces");
    assert_eq!(b, "a_3.obj: face 0 (faces count from 0) has other corners than in the first frame (a_1.obj)");
    assert_eq!(c, "a_4.obj: 5 vertices, but the first frame (a_1.obj) has 4; all frames must have the same faces");
    assert!(d.starts_with("a_5.obj:1: "), "{d}");
    assert_eq!(refused(5), "a_1.obj: there is no frame 5; the frames count from 0, and there are 5");
}

#[test]
fn vertices_are_those_of_the_cage() {
    // The first vertex is used by no face, and dropped from the cage.
    let frame = |height: f64| format!("v 9 9 9\n{}", square(height, "f 2 3 4 5\n"));
    let folder = folder(&[("a.1.obj", frame(1.0)), ("a.2.obj", frame(2.0))]);
    let sequence = open(&folder, "a.#.obj").expect("a sequence");
    let positions = sequence.positions(1).expect("a frame");
    assert_eq!((positions.len(), positions[0]), (4, DVec3::new(0.0, 0.0, 2.0)));
}

#[test]
fn coordinates_must_be_usable() {
    let folder = folder(&[("1.obj", square(0.0, FACES)), ("2.obj", square(0.0, FACES).replace("v 1 1", "v 1e300 1"))]);
    let error = open(&folder, "#.obj").expect("a sequence").positions(1).expect_err("too large");
    assert!(message(&folder, &error).starts_with("2.obj: the cage is"), "{error}");
}

#[test]
fn one_file_is_one_frame() {
    let folder = folder(&[("a.obj", square(3.0, FACES)), ("take_#.obj", square(4.0, FACES))]);
    let sequence = open(&folder, "a.obj").expect("a sequence");
    assert_eq!((sequence.frame_count(), sequence.times()), (1, &[0.0][..]));
    assert_eq!(sequence.positions_at(7.0).expect("positions"), sequence.cage().positions());
    // A file with such a name is a file.
    let named = open(&folder, "take_#.obj").expect("a sequence");
    assert_eq!(named.into_cage().positions()[0].z, 4.0);
    assert!(Sequence::is_pattern(&folder.path().join("other_#.obj")));
    assert!(!Sequence::is_pattern(&folder.path().join("take_#.obj")));
    assert!(!Sequence::is_pattern(&folder.path().join("other.obj")));
    assert!(matches!(open(&folder, "other.obj"), Err(ReadError::Io { .. })));
}

/// A square whose points and place have samples.
const SAMPLES: &str = "#usda 1.0
(timeCodesPerSecond = 10)
def Xform \"A\" {
    double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 20: (4, 0, 0) }
    uniform token[] xformOpOrder = [\"xformOp:translate\"]
    def Mesh \"M\" {
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points.timeSamples = {
            0: [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
            10: [(0, 0, 5), (1, 0, 5), (0, 1, 5)],
        }
    }
}
";

#[test]
fn samples_are_frames() {
    let folder = folder(&[("a.usda", SAMPLES.into())]);
    let sequence = open(&folder, "a.usda").expect("a sequence");
    assert_eq!(sequence.times(), [0.0, 1.0, 2.0]);
    let first = |frame: usize| sequence.positions(frame).expect("a frame")[0];
    assert_eq!([0, 1, 2].map(first), [DVec3::ZERO, DVec3::new(2.0, 0.0, 5.0), DVec3::new(4.0, 0.0, 5.0)]);
    assert_eq!(sequence.positions_at(0.5).expect("positions")[0], DVec3::new(1.0, 0.0, 2.5));
    assert_eq!(sequence.with_frames_per_second(1.0).times(), [0.0, 1.0, 2.0], "a rate of its own");
}

#[test]
fn samples_must_have_the_same_faces() {
    let fewer = SAMPLES.replace("10: [(0, 0, 5), ", "10: [(7, 7, 7), (0, 0, 5), ");
    let folder = folder(&[("a.usda", fewer)]);
    let error = open(&folder, "a.usda").expect("a sequence").positions(1).expect_err("more vertices");
    assert!(message(&folder, &error).starts_with("a.usda, 1 s: 4 vertices, but the first frame"), "{error}");
}

#[test]
fn a_file_that_changes_is_noticed() {
    let folder = folder(&[("a.usda", SAMPLES.into())]);
    let sequence = open(&folder, "a.usda").expect("a sequence");
    std::fs::write(folder.path().join("a.usda"), format!("{SAMPLES}\n# more")).expect("written");
    let error = sequence.positions(1).expect_err("changed");
    assert!(message(&folder, &error).ends_with("the file has changed since it was opened; open it again"), "{error}");
}
