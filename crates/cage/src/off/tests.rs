use glam::{DVec2, DVec3};

use crate::{Cage, Limits, ReadDesc, read_off};

fn read(text: &str) -> Cage {
    read_off(text.as_bytes(), "a.off").unwrap_or_else(|error| panic!("{error}"))
}

fn refused(text: &str) -> String {
    let message = read_off(text.as_bytes(), "a.off").expect_err("must be refused").to_string();
    message.strip_prefix("a.off").expect("the file comes first").to_string()
}

const SQUARE: &str = "OFF\n4 1 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

#[test]
fn the_plain_form() {
    let cage = read(SQUARE);
    assert_eq!(cage.positions()[2], DVec3::new(1.0, 1.0, 0.0));
    assert_eq!((cage.face(0), cage.uv()), (&[0, 1, 2, 3][..], None));
    assert!(cage.warnings().is_empty());
}

#[test]
fn forms_of_the_header() {
    let plain = read(SQUARE);
    for header in ["OFF 4 1 4", "OFF\n4 1", "4 1 4", "4 1", "# a\n\nOFF # b\n # c\n4 1 0 # d", "\u{FEFF}OFF\r\n4 1 4\r"]
    {
        assert_eq!(read(&SQUARE.replacen("OFF\n4 1 4", header, 1)), plain, "{header:?}");
    }
}

#[test]
fn colours_normals_and_comments_are_stepped_over() {
    let text =
        "CNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255 # red\n\n1 0 0 0 0 1 0 0 0\n0 1 0 0 0 1 .1 .2 .3 1\n3 0 1 2 255 0 0\n";
    let cage = read(text);
    assert_eq!((cage.vertex_count(), cage.face(0), cage.uv()), (3, &[0, 1, 2][..], None));
    assert!(cage.warnings().is_empty());
}

#[test]
fn texture_coordinates_come_last() {
    for (keyword, between) in [("ST", ""), ("STN", " 0 0 1"), ("STC", " 1 0 0"), ("STCN", " 0 0 1 255 0 0 255")] {
        let text =
            format!("{keyword}OFF\n3 1 0\n0 0 0{between} .5 0\n1 0 0{between} 1 0\n0 1 0{between} 0 .25\n3 2 0 1\n");
        let cage = read(&text);
        let uv = cage.uv().expect("texture coordinates");
        assert_eq!(uv.values[2], DVec2::new(0.0, 0.25), "{keyword}");
        assert_eq!(uv.indices, [2, 0, 1], "{keyword}");
    }
}

#[test]
fn what_comes_after_the_last_face_is_counted() {
    let warnings: Vec<String> =
        read(&format!("{SQUARE}1 2 3\n4\n")).warnings().iter().map(ToString::to_string).collect();
    assert_eq!(warnings, ["2 trailing lines ignored"]);
}

#[test]
fn malformed_files() {
    let square = |from: &str, to: &str| SQUARE.replacen(from, to, 1);
    for (text, message) in [
        (String::new(), ":1: not an OFF file: it starts with neither `OFF` nor the numbers of vertices and faces"),
        ("hello\n".into(), ":1: not an OFF file: it starts with neither `OFF` nor the numbers of vertices and faces"),
        ("1 2 3 4\n".into(), ":1: not an OFF file: it starts with neither `OFF` nor the numbers of vertices and faces"),
        (
            square("OFF", "4OFF"),
            ":1: OFF with other than three coordinates is not read; export it as OFF in text with three coordinates, or as PLY or OBJ",
        ),
        (
            "OFF BINARY\n\0\0\0\u{4}".into(),
            ":1: binary OFF is not read; export it as OFF in text with three coordinates, or as PLY or OBJ",
        ),
        ("OFF\n".into(), ":1: the numbers of vertices and faces are missing; after `OFF` comes a line like `8 6 12`"),
        (
            square("4 1 4", "4"),
            ":2: the numbers of vertices and faces are missing; after `OFF` comes a line like `8 6 12`",
        ),
        (
            square("4 1 4", "-4 1"),
            ":2: the numbers of vertices and faces are missing; after `OFF` comes a line like `8 6 12`",
        ),
        (square("4 1 4", "4 2 4"), ":7: the file ends after 1 of 2 faces; it is cut short or its counts are wrong"),
        (square("4 1 4", "9 1 4"), ":7: the file ends after 5 of 9 vertices; it is cut short or its counts are wrong"),
        (
            "OFF\n99999999999999 1 0\n0 0 0\n".into(),
            ":3: the file ends after 1 of 99999999999999 vertices; it is cut short or its counts are wrong",
        ),
        (square("1 1 0", "1 1"), ":5: a vertex with 2 of the 3 numbers it needs"),
        (square("1 1 0", "1 1 x"), ":5: \"x\" is not a number; numbers look like -1.5 or 2e-3"),
        (square("1 1 0", "1 1 nan"), ":5: \"nan\" is not finite; coordinates are finite numbers"),
        (square("OFF", "STOFF"), ":3: a vertex with 3 of the 5 numbers it needs"),
        (
            square("4 0 1 2 3", "x 0 1 2 3"),
            ":7: \"x\" is not the number of corners of a face; a face looks like `4 0 1 2 3`",
        ),
        (
            square("4 0 1 2 3", "-4 0 1 2 3"),
            ":7: \"-4\" is not the number of corners of a face; a face looks like `4 0 1 2 3`",
        ),
        (square("4 0 1 2 3", "5 0 1 2 3"), ":7: a face announces 5 corners but has 4"),
        (square("4 0 1 2 3", "9999999999999999 0"), ":7: a face announces 9999999999999999 corners but has 1"),
        (square("4 0 1 2 3", "2 0 1"), ":7: a face with 2 corners; faces have at least 3"),
        (square("4 0 1 2 3", "4 0 1 2 4"), ":7: \"4\" is not a vertex; the vertices are 0 to 3"),
        (square("4 0 1 2 3", "4 0 1 2 -1"), ":7: \"-1\" is not a vertex; the vertices are 0 to 3"),
        (
            square("4 0 1 2 3", "4 0 1 1 3"),
            ":7: repeated vertices in a face, at 1 corner: face 0 vertex 1; split the face or merge its corners (elements count from 0)",
        ),
        (square("4 1 4", "4 0 4").replace("4 0 1 2 3\n", ""), ": no faces; a cage has at least one"),
    ] {
        let found = refused(&text);
        assert!(found.starts_with(message), "{text:?}\n{found}\n{message}");
    }
}

#[test]
fn limits() {
    let refused = |limits: Limits| {
        let desc = ReadDesc { limits, ..ReadDesc::default() };
        super::draft(SQUARE.as_bytes(), "a.off", &desc).err().map(|error| error.to_string())
    };
    assert_eq!(refused(Limits::default()), None);
    let faces = refused(Limits { faces: 0, ..Limits::default() });
    assert_eq!(faces.as_deref(), Some("a.off:7: more faces than the limit of 0; raise the limit or split the model"));
    let memory = refused(Limits { memory_bytes: 100, ..Limits::default() });
    assert!(memory.is_some_and(|message| message.contains("more memory than the limit of 100 bytes")));
}
