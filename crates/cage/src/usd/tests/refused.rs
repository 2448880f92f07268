//! Files that are refused, with their messages.

use super::*;
use crate::LimitError;

#[test]
fn malformed_text() {
    for (text, expected) in [
        ("def", ":2: expected the name of a prim, not the end of the file"),
        ("def Mesh \"A\"", ":2: expected `{`, not the end of the file"),
        ("def Mesh \"A\" {\n\n", ":4: the file ends within /A"),
        ("5", ":2: expected a prim, such as `def Mesh \"Cube\"`, not `5`"),
        ("def \"A\" {\n int = 5 }", ":3: expected the name of an attribute, not `=`"),
        ("def \"A\" {\n int a = }", ":3: expected a value, not `}`"),
        ("def \"A\" { int a.timeSamples = [] }", ":2: expected `{`, not `[`"),
        ("def \"A\" { int a.timeSamples = { x : 1 } }", ":2: expected the time of a sample, not `x`"),
        ("def \"A\" { int a.timeSamples = { 1: 1 2: 2 } }", ":2: expected `,` or `}`, not `2`"),
        ("def \"A\" (\n kind \"b\") { }", ":3: expected `=`, not the text \"b\""),
        ("(\n upAxis = \"Y\"", ":3: expected a key or `)`, not the end of the file"),
    ] {
        assert_eq!(message(text), expected, "{text}");
    }
}

#[test]
fn values_that_are_none_name_their_line() {
    let text = square("").replace("(1, 1, 0)", "(1, one, 0)");
    assert_eq!(message(&text), ":5: /Square.points: expected a number, not `one`");
}

#[test]
fn meshes_that_are_none() {
    let replaced = |from: &str, to: &str| message(&square("").replace(from, to));
    let changed = |attribute: &str| message(&square(attribute));
    for (found, expected) in [
        (
            replaced("points", "points2"),
            "/Square has no points; a mesh needs points, faceVertexCounts and faceVertexIndices",
        ),
        (replaced("[4]", "[3]"), "/Square.faceVertexIndices has 4 values, but 3 are due, the sum of faceVertexCounts"),
        (replaced("[4]", "[-4]"), "/Square.faceVertexCounts: face 0 has less than 0 corners"),
        (replaced("[4]", "[2, 2]"), "/Square.faceVertexCounts: face 0 has 2 corners; faces have at least 3"),
        (replaced("[4]", "[4.5]"), "/Square.faceVertexCounts: a value of another type where integers are due"),
        (replaced("2, 3]", "2, 4]"), "/Square.faceVertexIndices[3] is 4, but the vertices are 0 to 3"),
        (replaced("(1, 1, 0)", "(1, inf, 0)"), "/Square.points: point 2 is not finite"),
        (changed("token orientation = \"none\""), "/Square.orientation: \"none\" is no value that it can have"),
        (
            changed("int[] creaseIndices = [0, 1] int[] creaseLengths = [3] float[] creaseSharpnesses = [1]"),
            "/Square.creaseIndices has 2 values, but 3 are due, the sum of creaseLengths",
        ),
        (changed("int[] creaseLengths = [1]"), "/Square.creaseLengths: crease 0 has fewer than 2 vertices"),
        (
            changed("int[] creaseIndices = [0, 1, 2] int[] creaseLengths = [3]"),
            "/Square.creaseSharpnesses has 0 values, but 2 are due, one for each edge unless there is one for each crease",
        ),
        (changed("int[] cornerIndices = [4]"), "/Square.cornerIndices[0] is 4, but the vertices are 0 to 3"),
        (
            changed("int[] cornerIndices = [1]"),
            "/Square.cornerSharpnesses has 0 values, but 1 are due, one for each of cornerIndices",
        ),
        (changed("int[] holeIndices = [1]"), "/Square.holeIndices[0] is 1, but the only face is 0"),
        (
            changed("texCoord2f[] primvars:st = [(0, 0)] (interpolation = \"vertex\")"),
            "/Square.primvars:st has 1 values, but 4 are due, one for each vertex",
        ),
        (
            changed("texCoord2f[] primvars:st = [(0, 0)] (interpolation = \"best\")"),
            "/Square.primvars:st: interpolation \"best\" is unknown",
        ),
        (
            changed("float3 xformOp:shear = (1, 2, 3) uniform token[] xformOpOrder = [\"xformOp:shear\"]"),
            "/Square.xformOp:shear: a value of another type where operations that are known are due",
        ),
    ] {
        assert_eq!(found, expected);
    }
}

#[test]
fn tags_without_an_edge_are_refused_as_in_other_formats() {
    let tags = "int[] creaseIndices = [0, 2] int[] creaseLengths = [2] float[] creaseSharpnesses = [1]";
    assert_eq!(
        message(&square(tags)),
        "crease 0 is between vertices 0 and 2, but no edge joins them (elements count from 0)"
    );
}

#[test]
fn what_needs_other_files_is_named() {
    for (metadata, arc) in [
        ("references = @a.usda@</A>", "references"),
        ("prepend references = [@a.usda@ (offset = 1; scale = 2), </B>]", "references"),
        ("payload = @a.usda@", "a payload"),
        ("inherits = </B>", "inherits"),
        ("append specializes = </B>", "specializes"),
        ("prepend variantSets = \"look\"", "variants"),
    ] {
        let expected =
            format!("/A has {arc}, which are not followed; flatten the file: usdcat --flatten FILE -o flat.usda");
        assert_eq!(message(&format!("def Xform \"A\" (\n{metadata}\n) {{ }}\n{}", square(""))), expected);
    }
    for nothing in ["references = None", "references = []", "delete inherits = </B>", "kind = \"component\""] {
        cage(&format!("def Xform \"A\" ({nothing}) {{ }}\n{}", square("")));
    }
    let variants = "def \"A\" { variantSet \"v\" = { \"one\" { def Mesh \"M\" { } } } }";
    assert!(message(&format!("{variants}\n{}", square(""))).starts_with("/A has variants"));
    assert!(message(&format!("(subLayers = [@a.usda@])\n{}", square(""))).starts_with("the file has sub-layers"));
}

#[test]
fn scenes_without_meshes() {
    assert_eq!(message("def Xform \"A\" { }"), "no mesh that is drawn; a cage is made of prims of the type Mesh");
    let empty = "def Mesh \"A\" { int[] faceVertexCounts = [] int[] faceVertexIndices = [] point3f[] points = [] }";
    assert_eq!(message(empty), "no faces; a cage has at least one");
}

#[test]
fn forms_that_are_not_read() {
    let message = |bytes: &[u8]| read_usd(bytes, "a", &ReadDesc::default()).expect_err("refused").to_string();
    assert_eq!(
        message(b"o cube\n"),
        "a: not a USD file: it starts with none of `#usda`, `PXR-USDC` and the mark of a zip file"
    );
    assert_eq!(
        message(b"PXR-USDC\0\x03\0\0\0\0\0\0\0\0\0\0\0\0\0\0"),
        "a: version 0.3.0 of the binary form is not read; write the file as text: usdcat FILE -o text.usda"
    );
    let zip = |flags: u8, method: u8| [b"PK\x03\x04\x14\0", &[flags, 0, method, 0][..], &[0; 20]].concat();
    assert!(message(&zip(0, 8)).contains("its first file is compressed"));
    assert!(message(&zip(8, 0)).contains("the size of its first file is not in front of it"));
    assert!(message(&zip(1, 0)).contains("it is encrypted"));
    assert!(message(&zip(0, 0)).contains("not a USD file"));
    assert!(message(b"PK\x03\x04").contains("it is cut short"));
}

#[test]
fn depth_is_bounded() {
    let text = "def \"A\" {".repeat(300) + &"}".repeat(300);
    assert_eq!(message(&text), "prims are nested more than 256 levels deep");
    let many: String = (0..2000).map(|i| format!("int primvars:p{i} = 0\n")).collect();
    assert_eq!(message(&square(&many)), "a prim with more than 1024 attributes");
    // Brackets in a value need no stack.
    let deep = format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000));
    assert_eq!(cage(&square(&format!("int[] other = {deep}"))).face_count(), 1);
}

#[test]
fn limits_hold() {
    let limited = |limits: Limits| {
        let desc = ReadDesc { limits, ..ReadDesc::default() };
        let text = format!("#usda 1.0\n{}", strip(""));
        let error = read_usd(text.as_bytes(), "a", &desc).expect_err("refused");
        error.limit().cloned()
    };
    assert_eq!(limited(Limits { faces: 1, ..Limits::default() }), Some(LimitError::Faces { limit: 1 }));
    assert_eq!(limited(Limits { file_bytes: 10, ..Limits::default() }), Some(LimitError::FileBytes { limit: 10 }));
    assert!(matches!(limited(Limits { memory_bytes: 700, ..Limits::default() }), Some(LimitError::Memory { .. })));
}

#[test]
fn a_repair_takes_what_is_no_manifold() {
    let text = format!("#usda 1.0\n{}", square("").replace("[4]", "[2, 2]"));
    let desc = ReadDesc { repair: Some(RepairDesc::default()), ..ReadDesc::default() };
    let message = read_usd(text.as_bytes(), "a", &desc).expect_err("no faces are left").to_string();
    assert!(message.starts_with("a: no faces"), "{message}");
}
