//! Which prims are drawn, and where.

use super::*;

/// The first position of a square below prims with these transforms.
fn first(head: &str, properties: &str) -> DVec3 {
    cage(&format!("{head}\ndef Xform \"A\" {{\n{properties}\n{}\n}}", square(""))).positions()[1]
}

#[test]
fn the_last_operation_is_done_first() {
    let place = first(
        "",
        "double3 xformOp:translate = (10, 0, 0)
        float xformOp:rotateZ = 90
        float3 xformOp:scale = (3, 1, 1)
        uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateZ\", \"xformOp:scale\"]",
    );
    assert!(place.abs_diff_eq(DVec3::new(10.0, 3.0, 0.0), 1e-12), "{place}");
}

#[test]
fn operations_are_undone_by_their_inverse() {
    let place = first(
        "",
        "float3 xformOp:translate:pivot = (1, 1, 0)
        quatf xformOp:orient = (0, 0, 0, 1)
        uniform token[] xformOpOrder = [\"xformOp:translate:pivot\", \"xformOp:orient\", \"!invert!xformOp:translate:pivot\"]",
    );
    // Half a turn about the z axis through (1, 1).
    assert!(place.abs_diff_eq(DVec3::new(1.0, 2.0, 0.0), 1e-12), "{place}");
}

#[test]
fn operations_that_are_not_in_the_order_do_nothing() {
    assert_eq!(first("", "double3 xformOp:translate = (10, 0, 0)"), DVec3::X);
}

#[test]
fn matrices_have_their_translation_in_the_last_row() {
    let place = first(
        "",
        "matrix4d xformOp:transform = ( (0, 1, 0, 0), (-1, 0, 0, 0), (0, 0, 1, 0), (5, 6, 7, 1) )
        uniform token[] xformOpOrder = [\"xformOp:transform\"]",
    );
    assert_eq!(place, DVec3::new(5.0, 7.0, 7.0));
}

#[test]
fn a_prim_can_leave_its_parents() {
    let inner = "def Xform \"B\" {
        double3 xformOp:translate = (0, 0, 4)
        uniform token[] xformOpOrder = [\"!resetXformStack!\", \"xformOp:translate\"]
    ";
    let text = format!(
        "def Xform \"A\" {{
        double3 xformOp:translate = (9, 9, 9)
        uniform token[] xformOpOrder = [\"xformOp:translate\"]
        {inner} {} }} }}",
        square("")
    );
    assert_eq!(cage(&text).positions()[1], DVec3::new(1.0, 0.0, 4.0));
}

#[test]
fn z_up_becomes_y_up() {
    let lift = "double3 xformOp:translate = (0, 2, 5)\nuniform token[] xformOpOrder = [\"xformOp:translate\"]";
    assert_eq!(first("(upAxis = \"Z\")", lift), DVec3::new(1.0, 5.0, -2.0));
    assert_eq!(first("(upAxis = \"Y\")", lift), DVec3::new(1.0, 2.0, 5.0));
    assert_eq!(first("", lift), DVec3::new(1.0, 2.0, 5.0));
}

#[test]
fn a_mirror_turns_faces_over() {
    let mirror = "float3 xformOp:scale = (-1, 1, 1)\nuniform token[] xformOpOrder = [\"xformOp:scale\"]";
    assert_eq!(cage(&square(mirror)).face(0), [0, 3, 2, 1]);
    let twice = format!("{mirror}\nuniform token orientation = \"leftHanded\"");
    assert_eq!(cage(&square(&twice)).face(0), [0, 1, 2, 3]);
}

#[test]
fn what_is_not_drawn_is_passed_over() {
    let hidden = |state: &str| format!("def Scope \"H\" {{ {state}\n{} }}\n", square(""));
    let text = [
        strip(""),
        hidden("token visibility = \"invisible\""),
        hidden("uniform token purpose = \"guide\""),
        hidden("uniform token purpose = \"proxy\""),
        "def PointInstancer \"P\" { def Mesh \"M\" { } }\n".into(),
        "def \"Off\" (active = false) { def Mesh \"M\" { } }\nover \"O\" { def Mesh \"M\" { } }\nclass \"C\" { def Mesh \"M\" {} }".into(),
        "def Material \"M\" (references = @a.usda@</M>) { }\ndef Sphere \"S\" { }\ndef Sphere \"T\" { }\n".into(),
    ]
    .concat();
    let cage = cage(&text);
    assert_eq!(cage.face_count(), 2);
    let warnings: Vec<String> = cage.warnings().iter().map(ToString::to_string).collect();
    let ignored =
        ["invisible mesh", "guide mesh", "proxy mesh", "point instancer"].map(|what| format!("1 {what} ignored"));
    assert_eq!(warnings[..4], ignored);
    assert_eq!(warnings[4..], ["2 spheres ignored"]);
}

#[test]
fn purposes_for_rendering_are_drawn() {
    assert_eq!(cage(&square("uniform token purpose = \"render\"")).face_count(), 1);
}

#[test]
fn the_first_sample_is_read() {
    let moved = square("").replace("points = ", "points.timeSamples = { 2: [(0, 0, 9)], 1: ") + "}";
    let text = moved.replacen("]\n\n}", "]}\n}", 1);
    let cage = cage(text.strip_suffix('}').expect("a brace"));
    assert_eq!(cage.positions()[2], DVec3::new(1.0, 1.0, 0.0));
}
