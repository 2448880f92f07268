use glam::DVec3;

use super::*;
use crate::{CageDesc, read_obj};

fn cage(text: &str) -> Cage {
    read_obj(text.as_bytes(), "test.obj").expect("a cage")
}

fn problems(text: &str) -> Vec<String> {
    inspect(&cage(text)).problems.iter().map(ToString::to_string).collect()
}

/// `n` by `m` unit quads, wrapped around in each direction on demand, with faces left out.
fn grid(n: u32, m: u32, wrap: [bool; 2], missing: &[u32]) -> Cage {
    let (columns, rows) = (n + u32::from(!wrap[0]), m + u32::from(!wrap[1]));
    let at = |i: u32, j: u32| (i % columns) + columns * (j % rows);
    let faces = (0..n * m).filter(|f| !missing.contains(f));
    let corners: Vec<u32> = faces
        .map(|f| (f % n, f / n))
        .flat_map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect();
    let place = |v: u32| {
        // On a torus, so that no two vertices meet whatever is wrapped.
        let [u, v] = [(v % columns, n), (v / columns, m)]
            .map(|(k, of)| f64::from(k) / f64::from(of + 1) * std::f64::consts::TAU);
        DVec3::new((3.0 + v.cos()) * u.cos(), (3.0 + v.cos()) * u.sin(), v.sin())
    };
    Cage::new(CageDesc {
        positions: (0..columns * rows).map(place).collect(),
        face_offsets: (0..=corners.len() as u32).step_by(4).collect(),
        face_vertices: corners,
        ..CageDesc::default()
    })
    .expect("a cage")
}

const CUBE: &str = "v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 -1\nv 1 -1 -1\n\
    f 1 2 4 3\nf 3 4 6 5\nf 5 6 8 7\nf 7 8 2 1\nf 2 8 6 4\nf 7 1 3 5\n";

#[test]
fn cube() {
    let expected = Inspection {
        vertices: 8,
        edges: 12,
        faces: 6,
        faces_by_size: [(4, 6)].into(),
        valence: [(3, 8)].into(),
        boundary_valence: [].into(),
        boundary_edges: 0,
        boundaries: 0,
        components: 1,
        genus: 0,
        euler: 2,
        creases: 0,
        corners: 0,
        holes: 0,
        polygons: None,
        problems: vec![],
        advice: vec![],
    };
    assert_eq!(inspect(&cage(CUBE)), expected);
}

#[test]
fn json_has_the_documented_keys() {
    let json = serde_json::to_value(inspect(&cage(&format!(
        "{CUBE}t crease 2/1/0 0 1 2\nt corner 1/1/0 3 1\nt hole 1/0/0 2\n"
    ))))
    .expect("JSON");
    assert_eq!(json["vertices"], 8);
    assert_eq!(json["faces_by_size"]["4"], 6);
    assert_eq!(json["valence"]["3"], 8);
    assert_eq!([&json["creases"], &json["corners"], &json["holes"]], [1, 1, 1]);
    assert_eq!(json["problems"][0], "tags not evaluated yet are ignored: 1 crease, 1 corner");
    for key in ["faces", "boundary_edges", "components", "genus", "euler"] {
        assert!(json[key].is_number(), "{key}");
    }
}

#[test]
fn torus_and_sheets() {
    let torus = inspect(&grid(5, 4, [true, true], &[]));
    assert_eq!((torus.genus, torus.euler, torus.boundaries, torus.components), (1, 0, 0, 1));
    assert_eq!(torus.valence, [(4, 20)].into());

    let tube = inspect(&grid(5, 4, [true, false], &[]));
    assert_eq!((tube.genus, tube.euler, tube.boundaries, tube.boundary_edges), (0, 0, 2, 10));

    let sheet = inspect(&grid(3, 3, [false, false], &[]));
    assert_eq!((sheet.genus, sheet.euler, sheet.boundaries, sheet.boundary_edges), (0, 1, 1, 12));
    assert_eq!(sheet.valence, [(2, 4), (3, 8), (4, 4)].into());
    assert_eq!(sheet.boundary_valence, [(2, 4), (3, 8)].into());

    let punched = inspect(&grid(7, 7, [true, true], &[8, 24]));
    assert_eq!((punched.genus, punched.boundaries, punched.boundary_edges), (1, 2, 8));
    // An open vertex of valence 4 has three faces; it counts as one of valence 4.
    assert_eq!((punched.valence, punched.boundary_valence), ([(4, 49)].into(), [(4, 8)].into()));
}

#[test]
fn several_components() {
    let two = inspect(&cage(
        &format!("{CUBE}{}v 9 0 0\nv 10 0 0\nv 9 1 0\nf -3 -2 -1\n", CUBE.replace("f 1 2 4 3", "f 9 10 12 11"))
            .replace("f 3 4 6 5\nf 5 6 8 7\nf 7 8 2 1\nf 2 8 6 4\nf 7 1 3 5\nv 9", "v 9"),
    ));
    // A cube, a quad of the second cube and a triangle.
    assert_eq!((two.components, two.boundaries, two.genus), (3, 2, 0));
    assert_eq!(two.faces_by_size, [(3, 1), (4, 7)].into());
}

#[test]
fn inner_valence_two() {
    assert_eq!(problems("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n"), ["3 inner vertices of valence 2: 0, 1, 2"]);
}

#[test]
fn many_corners() {
    let mut text = String::new();
    for i in 0..9 {
        let angle = f64::from(i) / 9.0 * std::f64::consts::TAU;
        text += &format!("v {} {} 0\n", angle.cos(), angle.sin());
    }
    assert_eq!(problems(&format!("{text}f 1 2 3 4 5 6 7 8 9\n")), ["1 face with more than 8 corners: 0"]);
    assert_eq!(problems(&format!("{text}f 1 2 3 4 5 6 7 8\n"))[1..], [""; 0]);
}

#[test]
fn no_length_and_no_area() {
    assert_eq!(
        problems("v 0 0 0\nv 1 0 0\nv 1 0 0\nf 1 2 3\nv 0 5 0\nv 1 5 0\nv 2 5 0\nf 4 5 6\n"),
        [
            "1 edge of length zero: 1-2",
            "2 faces without area: 0, 1",
            "2 faces without neighbours: 0, 1",
            "1 boundary vertex at the place of another, so a seam may be open: 2"
        ]
    );
}

#[test]
fn many_edges_of_length_zero() {
    let mut text = String::new();
    for i in 0..6 {
        text += &format!("v {i} 0 0\nv {i} 0 0\nv {i} 1 0\nf -3 -2 -1\n");
    }
    assert!(problems(&text).contains(&"6 edges of length zero: 0-1, 3-4, 6-7, 9-10 and 2 more".into()));
}

#[test]
fn thin_faces() {
    let strip = |length: u32| format!("v 0 0 0\nv {length} 0 0\nv {length} 1 0\nv 0 1 0\nf 1 2 3 4\n");
    assert_eq!(problems(&strip(99)), [""; 0]);
    assert_eq!(problems(&strip(101)), ["1 face more than 100 times longer than wide: 0"]);
}

#[test]
fn size_does_not_matter() {
    for scale in ["e-200", "e-20", "e16"] {
        let text = format!("v 0 0 0\nv 1{scale} 0 0\nv 1{scale} 1{scale} 0\nv 0 1{scale} 0\nf 1 2 3 4\n");
        assert_eq!(problems(&text), [""; 0], "{scale}");
    }
}

#[test]
fn a_point() {
    assert_eq!(problems("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"), ["all vertices are at the same place"]);
}

#[test]
fn open_seams() {
    assert_eq!(
        problems("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 4 6 5\n"),
        [
            "2 faces without neighbours: 0, 1",
            "2 boundary vertices at the place of another, so a seam may be open: 3, 4"
        ]
    );
}

#[test]
fn warnings_are_problems() {
    assert_eq!(
        problems("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\nl 1 2\n"),
        ["1 statement ignored: l (lines are not part of a cage), first in line 6", "1 unused vertex dropped: 0"]
    );
}

/// A fan of that many triangles around vertex 0.
fn fan(triangles: u32) -> String {
    let mut text = String::from("v 0 0 0\n");
    for i in 0..triangles {
        let angle = f64::from(i) / f64::from(triangles) * std::f64::consts::TAU;
        text += &format!("v {} {} 0\n", angle.cos(), angle.sin());
    }
    for i in 0..triangles {
        text += &format!("f 1 {} {}\n", i + 2, (i + 1) % triangles + 2);
    }
    text
}

#[test]
fn poles() {
    assert_eq!(problems(&fan(8)), [""; 0]);
    assert_eq!(problems(&fan(9)), ["1 vertex with more than 8 edges: 0"]);
}

#[test]
fn edges_that_end_at_a_side() {
    // Two quads beside a pentagon with a corner in the middle of its left side.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 2 0\nv 0 2 0\nv 2 0 0\nv 2 2 0\n\
        f 1 2 3 4\nf 4 3 5 6\nf 2 7 8 5 3\n";
    assert_eq!(problems(text), ["1 inner vertex at the middle of a face's side: 2"]);
    let advice = &inspect(&cage(text)).advice;
    assert_eq!((advice[0].kind, advice[0].count, &advice[0].elements), ("t_vertex", 1, &Elements::Vertices(vec![2])));
    assert!(advice[0].hint.contains("lead the edge"));
    // A bent side is a corner.
    assert_eq!(problems(&text.replace("v 1 1 0", "v 0.8 1 0")), [""; 0]);
}

#[test]
fn sides_that_gape() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 2 0\nv 0 2 0\nv 2 0 0\nv 2 2 0\nv 1 0 0\nv 1 2 0\n\
        f 1 2 3 4\nf 4 3 5 6\nf 9 7 8 10\n";
    assert_eq!(
        problems(text),
        [
            "1 boundary vertex at the middle of a boundary edge: 2",
            "1 face without neighbours: 2",
            "2 boundary vertices at the place of another, so a seam may be open: 8, 9",
        ]
    );
}

#[test]
fn gaping_sides_are_found_among_many() {
    // Two rows of squares, the second twice as long and not joined to the first.
    let mut text = String::new();
    for i in 0..100 {
        text += &format!("v {i} 0 0\nv {} 0 0\nv {} 1 0\nv {i} 1 0\nf -4 -3 -2 -1\n", i + 1, i + 1);
        text += &format!("v {0} 1 0\nv {1} 1 0\nv {1} 2 0\nv {0} 2 0\nf -4 -3 -2 -1\n", 2 * i, 2 * i + 2);
    }
    let found = inspect(&cage(&text));
    let tees = found.advice.iter().find(|advice| advice.kind == "open_t_vertex").expect("gaping sides");
    // Every odd place on the common line below 100, where two squares of the first row meet.
    assert_eq!(tees.count, 100);
}

#[test]
fn advice_serializes_for_programs() {
    let json = serde_json::to_value(inspect(&cage("v 0 0 0\nv 1 0 0\nv 1 0 0\nf 1 2 3\n"))).expect("JSON");
    assert_eq!(json["advice"][0]["kind"], "zero_length");
    assert_eq!(json["advice"][0]["edges"], serde_json::json!([[1, 2]]));
    assert_eq!(json["advice"][0]["count"], 1);
    assert_eq!(json["advice"][0]["message"], json["problems"][0]);
    assert_eq!(json["advice"][1]["faces"], serde_json::json!([0]));
    assert!(json["advice"].as_array().expect("a list").iter().all(|advice| advice["hint"].as_str() != Some("")));
}
