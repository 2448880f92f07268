use glam::{DVec2, DVec3};

use crate::random::Random;
use crate::{Cage, Limits, ReadDesc, read_ply};

fn read(bytes: &[u8]) -> Cage {
    read_ply(bytes, "a.ply").unwrap_or_else(|error| panic!("{error}"))
}

fn refused(bytes: &[u8]) -> String {
    let message = read_ply(bytes, "a.ply").expect_err("must be refused").to_string();
    message.strip_prefix("a.ply").expect("the file comes first").to_string()
}

const HEADER: &str = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\n\
    property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
const BODY: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

fn square() -> String {
    HEADER.to_owned() + BODY
}

#[test]
fn text() {
    let cage = read(square().as_bytes());
    assert_eq!(cage.positions()[2], DVec3::new(1.0, 1.0, 0.0));
    assert_eq!((cage.face(0), cage.uv()), (&[0, 1, 2, 3][..], None));
    assert!(cage.warnings().is_empty());
}

#[test]
fn line_ends_and_layout() {
    let plain = read(square().as_bytes());
    for variant in [
        square().replace('\n', "\r\n"),
        square().replace('\n', "\r"),
        square().trim_end().to_owned(),
        HEADER.to_owned() + &BODY.replace('\n', " "),
        square().replace("vertex_indices", "vertex_index"),
        square().replace("uchar int vertex", "uint16 int8 vertex"),
        square().replace("comment by hand", "obj_info element face 7\n\ncomment"),
    ] {
        assert_eq!(read(variant.as_bytes()), plain, "{variant:?}");
    }
}

/// A file with values of these types between others, which are to be skipped.
fn binary(big: bool, coordinate: &str, count: &str, index: &str) -> Vec<u8> {
    let endian = if big { "big" } else { "little" };
    let mut file = format!(
        "ply\nformat binary_{endian}_endian 1.0\nelement camera 1\nproperty list short double view\nelement vertex 4\n\
         property uchar red\nproperty {coordinate} x\nproperty {coordinate} z\nproperty list uchar ushort more\n\
         property {coordinate} y\nproperty float s\nproperty float t\nelement face 1\nproperty short material\n\
         property list {count} {index} vertex_indices\nproperty float quality\nelement nothing 9223372036854775807\nend_header\n"
    )
    .into_bytes();
    let mut put = |kind: &str, value: f64| {
        let mut bytes = match kind {
            "char" | "int8" => (value as i8).to_be_bytes().to_vec(),
            "uchar" | "uint8" => (value as u8).to_be_bytes().to_vec(),
            "short" => (value as i16).to_be_bytes().to_vec(),
            "ushort" => (value as u16).to_be_bytes().to_vec(),
            "int" => (value as i32).to_be_bytes().to_vec(),
            "uint" | "uint32" => (value as u32).to_be_bytes().to_vec(),
            "float" => (value as f32).to_be_bytes().to_vec(),
            _ => value.to_be_bytes().to_vec(),
        };
        if !big {
            bytes.reverse();
        }
        file.extend(bytes);
    };
    put("short", 2.0);
    put("double", 1.5);
    put("double", f64::NAN);
    for (i, [x, y]) in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-2.0, 1.0]].into_iter().enumerate() {
        put("uchar", 255.0);
        put(coordinate, x);
        put(coordinate, 7.0);
        put("uchar", i as f64);
        (0..i).for_each(|k| put("ushort", k as f64));
        put(coordinate, y);
        put("float", 0.5 * x);
        put("float", 0.25 * y);
    }
    put("short", -3.0);
    put(count, 4.0);
    [3.0, 0.0, 1.0, 2.0].into_iter().for_each(|corner| put(index, corner));
    put("float", f64::INFINITY);
    file
}

#[test]
fn binary_of_either_order_and_all_types() {
    for big in [false, true] {
        for coordinate in ["float", "double", "char", "int8", "short", "int"] {
            for (count, index) in [
                ("uchar", "int"),
                ("char", "uint"),
                ("int", "uchar"),
                ("ushort", "short"),
                ("uint32", "ushort"),
                ("short", "int8"),
            ] {
                let cage = read(&binary(big, coordinate, count, index));
                assert_eq!(cage.positions()[3], DVec3::new(-2.0, 1.0, 7.0), "{coordinate}");
                assert_eq!(cage.face(0), [3, 0, 1, 2], "{count} {index}");
                let uv = cage.uv().expect("texture coordinates");
                assert_eq!((uv.values[2], &uv.indices[..]), (DVec2::new(0.5, 0.25), &[3, 0, 1, 2][..]));
                let warnings: Vec<String> = cage.warnings().iter().map(ToString::to_string).collect();
                assert_eq!(warnings, ["1 of the element camera ignored, which is not part of a cage"]);
            }
        }
    }
}

#[test]
fn binary_values_may_look_like_line_ends() {
    // The first byte after the header is a line feed.
    let header = square().replace("ascii", "binary_little_endian").replace("float", "uchar");
    let header = &header[..header.find("end_header").expect("a header") + "end_header".len()];
    for end in ["\n", "\r\n", "\r"] {
        let mut file = header.replace('\n', end).into_bytes();
        file.extend(end.bytes());
        file.extend([10, 10, 10, 11, 10, 10, 11, 13, 10, 10, 13, 10]);
        file.extend([4, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0]);
        assert_eq!(read(&file).positions()[0], DVec3::splat(10.0), "{end:?}");
        file.extend([0; 3]);
        assert_eq!(read(&file).warnings()[0].to_string(), "3 trailing bytes ignored");
    }
}

#[test]
fn texture_coordinates_of_corners() {
    let text = square()
        .replace("element face 1", "element face 2")
        .replace("vertex_indices\n", "vertex_indices\nproperty list uchar float texcoord\n")
        .replace("4 0 1 2 3\n", "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 1 1 .5 1");
    let cage = read(text.as_bytes());
    let uv = cage.uv().expect("texture coordinates");
    assert_eq!(uv.indices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(uv.values[3], DVec2::new(0.5, 1.0));
    let some = text.replace("6 0 0 1 1 .5 1", "0");
    assert_eq!(read(some.as_bytes()).warnings()[0].to_string(), "1 face without uv, set to (0, 0)");
}

#[test]
fn faces_may_precede_vertices() {
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n\
        property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n";
    assert_eq!(read(text.as_bytes()).face(0), [0, 1, 2]);
}

#[test]
fn malformed_files() {
    let edit = |from: &str, to: &str| {
        let text = square();
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    let truncated = "it is cut short or its header announces too much";
    for (text, message) in [
        (String::new(), ": not a PLY file: its first line is not `ply`".to_owned()),
        ("plywood\n".into(), ": not a PLY file: its first line is not `ply`".into()),
        ("ply".into(), ": the header does not end: there is no line `end_header`".into()),
        (edit("end_header\n", "end_header"), ":10: \"end_header0\" is no statement of a PLY header".into()),
        (edit("end_header", "end"), ":10: \"end\" is no statement of a PLY header".into()),
        (
            edit("ascii", "utf8"),
            ":2: \"utf8\" is no format; there are ascii, binary_little_endian and binary_big_endian".into(),
        ),
        (edit("format ascii 1.0\n", ""), ":9: the header has no line `format`".into()),
        (edit("vertex 4", "vertex four"), ":4: \"four\" is not a number of elements; an element looks like `element vertex 8`".into()),
        (edit("vertex 4", "vertex -4"), ":4: \"-4\" is not a number of elements; an element looks like `element vertex 8`".into()),
        (edit("element vertex 4\n", ""), ":4: a property before the first element; properties follow the element they belong to".into()),
        (edit("element face", "element vertex"), ":8: a second element \"vertex\"; each has a name of its own".into()),
        (edit("float y", "float x"), ":6: a second property \"x\"; each has a name of its own".into()),
        (
            edit("float y", "real y"),
            ":6: \"real\" is no type; there are char, uchar, short, ushort, int, uint, float, double and int8 to float64".into(),
        ),
        (
            edit("property float y", "property float"),
            ":6: a property looks like `property float x` or `property list uchar int vertex_indices`".into(),
        ),
        (edit("list uchar", "list float"), ":9: the length of a list must be an integer".into()),
        (
            edit("float z", "float w"),
            ": there are no vertices: the header needs `element vertex` with the properties x, y and z".into(),
        ),
        (
            edit("element face", "element tristrips"),
            ": there are no faces, only points or strips: export polygons, as `element face` with a list `vertex_indices`".into(),
        ),
        (
            edit("float x", "list uchar float x"),
            ": property x of vertex is a list; it must be a number".into(),
        ),
        (
            edit("list uchar int vertex", "int vertex"),
            ": property vertex_indices of face is a single number; it must be a list".into(),
        ),
        (
            edit("uchar int", "uchar float"),
            ": property vertex_indices of face is a list of floating point numbers; it must be a list of integers".into(),
        ),
        (edit("vertex 4", "vertex 99999999999"), format!(": the file ends in vertex 5 of 99999999999; {truncated}")),
        (edit("4 0 1 2 3\n", ""), format!(": the file ends in face 0 of 1; {truncated}")),
        (edit("4 0 1 2 3\n", "4 0 1 2"), format!(": the file ends in face 0 of 1; {truncated}")),
        (edit("4 0 1 2 3", "2000000000 0 1 2 3"), format!(": the file ends in face 0 of 1; {truncated}")),
        (edit("4 0 1 2 3", "-4 0 1 2 3"), ": a list in face 0 has -4 values; the file is damaged".into()),
        (edit("1 1 0", "1 one 0"), ":13: \"one\" in vertex 2 is not a number".into()),
        (edit("4 0 1 2 3", "4 0 1.0 2 3"), ":15: \"1.0\" in face 0 is not an integer".into()),
        (edit("1 1 0", "1 inf 0"), ": vertex 2 has a coordinate that is not finite".into()),
        (edit("4 0 1 2 3", "2 0 1"), ": face 0 has 2 corners; faces have at least 3".into()),
        (edit("4 0 1 2 3", "4 0 1 2 4"), ": face 0 names vertex 4, but the vertices are 0 to 3".into()),
        (edit("4 0 1 2 3", "4 0 1 2 -1"), ": face 0 names vertex -1, but the vertices are 0 to 3".into()),
        (
            edit("4 0 1 2 3", "4 0 1 1 3"),
            ":15: repeated vertices in a face, at 1 corner: face 0 vertex 1; split the face or merge its corners (elements count from 0)".into(),
        ),
        (edit("face 1", "face 0").replace("4 0 1 2 3\n", ""), ": no faces; a cage has at least one".into()),
    ] {
        assert_eq!(refused(text.as_bytes()), message, "{text}");
    }
}

#[test]
fn cut_binary_files() {
    let whole = binary(false, "float", "uchar", "int");
    read(&whole);
    for length in 0..whole.len() {
        let message = refused(&whole[..length]);
        assert!(
            message.contains("the file ends in") || message.contains("header") || message.contains("not a PLY"),
            "{length}: {message}"
        );
    }
}

#[test]
fn limits() {
    let refused = |limits: Limits| {
        let desc = ReadDesc { limits, ..ReadDesc::default() };
        super::draft(square().as_bytes(), "a.ply", &desc).err().map(|error| error.to_string())
    };
    assert_eq!(refused(Limits::default()), None);
    let faces = refused(Limits { faces: 0, ..Limits::default() });
    assert_eq!(faces.as_deref(), Some("a.ply: more faces than the limit of 0; raise the limit or split the model"));
    assert!(
        refused(Limits { file_bytes: 100, ..Limits::default() }).is_some_and(|m| m.contains("larger than the limit"))
    );
}

#[test]
fn damaged_files_are_read_or_refused() {
    let mut random = Random::new(4);
    for whole in [square().into_bytes(), binary(true, "float", "uchar", "int"), binary(false, "short", "int", "uchar")]
    {
        for _ in 0..2000 {
            let mut bytes = whole.clone();
            for _ in 0..=random.below(4) {
                random.damage(&mut bytes, b"\0\x01\xFF 0192-.\nelist");
            }
            // A cage or an error, but an end.
            let _either = read_ply(&bytes, "damaged.ply");
        }
    }
}
