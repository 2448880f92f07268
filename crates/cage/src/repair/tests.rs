use glam::DVec3;

use crate::random::Random;
use crate::{Cage, CageDesc, FaceSetKind, ReadDesc, RepairDesc, RepairReport, Warning, inspect, obj, read_obj, repair};

fn options() -> RepairDesc {
    RepairDesc::default()
}

fn read_repaired(text: &str, options: RepairDesc) -> Cage {
    let desc = ReadDesc { repair: Some(options), ..ReadDesc::default() };
    let draft = obj::draft(text.as_bytes(), "a.obj", &desc).unwrap_or_else(|error| panic!("{error}"));
    draft.finish("a.obj", &desc).unwrap_or_else(|error| panic!("{error}"))
}

fn repaired(text: &str) -> Cage {
    read_repaired(text, options())
}

/// What was done, empty if nothing.
fn report(cage: &Cage) -> RepairReport {
    let report = cage.warnings().iter().find_map(|warning| match warning {
        Warning::Repaired(report) => Some((**report).clone()),
        _ => None,
    });
    report.unwrap_or_default()
}

fn lines(text: &str) -> Vec<String> {
    report(&repaired(text)).lines()
}

fn faces(cage: &Cage) -> Vec<Vec<u32>> {
    (0..cage.face_count()).map(|f| cage.face(f).to_vec()).collect()
}

/// A description that a repair can be given again.
fn desc_of(cage: &Cage) -> CageDesc {
    CageDesc {
        positions: cage.positions().to_vec(),
        face_offsets: cage.face_offsets().to_vec(),
        face_vertices: cage.face_vertices().to_vec(),
        uv: cage.uv().cloned(),
        tags: cage.tags().clone(),
        face_sets: cage.face_sets().to_vec(),
        ..CageDesc::default()
    }
}

const CUBE: &str = "v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 -1\nv 1 -1 -1\n";
const CUBE_FACES: [&str; 6] = ["1 2 4 3", "3 4 6 5", "5 6 8 7", "7 8 2 1", "2 8 6 4", "7 1 3 5"];

fn cube(faces: &[&str]) -> String {
    faces.iter().fold(CUBE.to_owned(), |text, face| text + "f " + face + "\n")
}

#[test]
fn a_cage_stays_as_it_is() {
    let text = cube(&CUBE_FACES) + "t crease 2/1/0 1 0 2\nt corner 1/1/0 3 1\nt hole 1/0/0 2\ng a\ns 1\nf 1 2 4\n";
    let text = text.replace("f 1 2 4\n", "");
    assert_eq!(repaired(&text), read_obj(text.as_bytes(), "a.obj").expect("a cage"));
}

#[test]
fn copies_and_degenerate_faces_go() {
    let faces = [&CUBE_FACES[..], &["2 4 3 1", "1 1 2", "1 2 1 2", "1 3 4 2"]].concat();
    let cage = repaired(&cube(&faces));
    assert_eq!(cage.face_count(), 6);
    assert_eq!(lines(&cube(&faces)), ["2 degenerate faces dropped: 7, 8", "2 copied faces dropped: 6, 9"]);
    assert_eq!(inspect(&cage).boundary_edges, 0);
}

#[test]
fn faces_with_one_or_two_corners_go_too() {
    let text = cube(&CUBE_FACES) + "f 1\nf 1 2\n";
    assert_eq!(lines(&text), ["2 degenerate faces dropped: 6, 7"]);
    assert!(read_obj(text.as_bytes(), "a.obj").is_err());
}

#[test]
fn repeated_corners_are_merged() {
    let cage = repaired(&cube(&["1 1 2 4 3 3", "3 4 6 4 6 5"]));
    assert_eq!(faces(&cage), [vec![0, 1, 3, 2], vec![2, 3, 5, 4]]);
    assert_eq!(report(&cage).shortened_faces.total(), 2);
}

#[test]
fn a_figure_of_eight_gets_vertices_of_its_own() {
    let cage = repaired("v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nf 1 2 3 1 4 5\n");
    assert_eq!(faces(&cage), [vec![0, 1, 2, 5, 3, 4]]);
    assert_eq!(cage.positions()[5], DVec3::ZERO);
    assert_eq!(report(&cage).lines(), ["1 vertex split: 0"]);
    assert_eq!(cage.source_vertices(), [0, 1, 2, 3, 4, 0]);
}

#[test]
fn two_faces_back_to_back_are_closed() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n";
    assert_eq!(lines(text), [""; 0]);
    assert_eq!(repaired(text).face_count(), 2);
}

#[test]
fn double_sided_sheets_become_single() {
    let sheet = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\nf 4 5 2 1\nf 5 6 3 2\n";
    assert_eq!(lines(sheet), ["2 copied faces dropped: 2, 3"]);
    assert_eq!(faces(&repaired(sheet)), [[0, 1, 4, 3], [1, 2, 5, 4]]);
}

#[test]
fn volumes_with_a_common_wall_stay_closed() {
    // A second cube on the right of the first; both have the wall between them.
    let text = CUBE.to_owned()
        + "v 3 -1 1\nv 3 1 1\nv 3 1 -1\nv 3 -1 -1\n"
        + &CUBE_FACES.map(|face| format!("f {face}\n")).concat()
        + "f 2 9 10 4\nf 4 10 11 6\nf 6 11 12 8\nf 8 12 9 2\nf 9 12 11 10\nf 8 2 4 6\n";
    let cage = repaired(&text);
    let found = inspect(&cage);
    assert_eq!((found.components, found.boundary_edges, found.faces), (2, 0, 12));
    assert_eq!(
        report(&cage).lines(),
        ["4 edges with more than two faces separated: 1-3, 1-7, 3-5, 5-7", "4 vertices split: 1, 3, 5, 7"]
    );
}

#[test]
fn cubes_that_share_an_edge_are_separated() {
    // The second cube is the first, turned about its edge 4-6.
    let text = CUBE.to_owned()
        + "v 3 1 1\nv 3 3 1\nv 1 3 1\nv 3 1 -1\nv 3 3 -1\nv 1 3 -1\n"
        + &CUBE_FACES.map(|face| format!("f {face}\n")).concat()
        + "f 4 9 10 11\nf 11 10 13 14\nf 14 13 12 6\nf 6 12 9 4\nf 9 12 13 10\nf 6 4 11 14\n";
    let cage = repaired(&text);
    let found = inspect(&cage);
    assert_eq!((found.components, found.boundary_edges, found.vertices), (2, 0, 16));
    assert_eq!(report(&cage).lines(), ["1 edge with more than two faces separated: 3-5", "2 vertices split: 3, 5"]);
}

#[test]
fn a_fin_is_cut_off() {
    let text =
        CUBE.to_owned() + "v 3 1 1\nv 3 1 -1\n" + &CUBE_FACES.map(|f| format!("f {f}\n")).concat() + "f 4 6 10 9\n";
    let cage = repaired(&text);
    let found = inspect(&cage);
    assert_eq!((found.components, found.boundary_edges, found.vertices), (2, 4, 12));
    assert_eq!(cage.source_vertices(), [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 3, 5]);
}

#[test]
fn bow_ties_are_split() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n";
    let cage = repaired(text);
    assert_eq!(faces(&cage), [[0, 1, 2], [5, 3, 4]]);
    assert_eq!(report(&cage).lines(), ["1 vertex split: 0"]);
}

#[test]
fn the_majority_decides_the_winding() {
    let cage = repaired(&cube(&["3 4 2 1", "3 4 6 5", "5 6 8 7", "7 8 2 1", "4 6 8 2", "7 1 3 5"]));
    assert_eq!(report(&cage).lines(), ["2 faces turned over: 0, 4"]);
    assert_eq!(cage.face(0), [2, 0, 1, 3], "a face starts where it did");
    assert_eq!(inspect(&cage).boundary_edges, 0);
}

#[test]
fn loose_faces_are_welded() {
    let loose: String = CUBE_FACES
        .iter()
        .flat_map(|face| {
            face.split(' ').map(|v| CUBE.lines().nth(v.parse::<usize>().expect("an index") - 1).expect("a line"))
        })
        .map(|line| format!("{line}\n"))
        .chain((0..6).map(|f| format!("f {} {} {} {}\n", 4 * f + 1, 4 * f + 2, 4 * f + 3, 4 * f + 4)))
        .collect();
    let cage = repaired(&loose);
    assert_eq!((cage.vertex_count(), inspect(&cage).boundary_edges), (8, 0));
    assert_eq!(report(&cage).lines(), ["16 vertices welded to another at its place: 4, 5, 8, 9 and 12 more"]);
}

#[test]
fn seams_are_welded_within_the_tolerance() {
    let text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1.001 0 0\nv 2 0 0\nv 2 1 0\nv 1 1.0005 0\nf 1 2 3 4\nf 5 6 7 8\n";
    assert_eq!(repaired(text).vertex_count(), 8);
    let cage = read_repaired(text, RepairDesc { weld_tolerance: 0.01 });
    assert_eq!(faces(&cage), [[0, 1, 2, 3], [1, 4, 5, 2]]);
    assert_eq!(cage.positions()[1], DVec3::X);
    assert_eq!(report(&cage).lines(), ["2 vertices welded to another at its place: 4, 7"]);
}

#[test]
fn closed_parts_that_touch_stay_apart() {
    let other = CUBE_FACES.map(|face| {
        let moved: Vec<String> =
            face.split(' ').map(|v| (v.parse::<u32>().expect("an index") + 8).to_string()).collect();
        moved.join(" ")
    });
    let text = CUBE.to_owned()
        + &CUBE.replace("v 1", "v 3").replace("v -1", "v 1")
        + &CUBE_FACES.map(|face| format!("f {face}\n")).concat()
        + &other.map(|face| format!("f {face}\n")).concat();
    assert_eq!(lines(&text), [""; 0]);
    assert_eq!(inspect(&repaired(&text)).components, 2);
}

#[test]
fn a_moebius_strip_is_opened_once() {
    let mut text = String::new();
    for i in 0..6 {
        let (angle, half) = (f64::from(i) * std::f64::consts::TAU / 6.0, f64::from(i) * std::f64::consts::PI / 6.0);
        for side in [-1.0, 1.0] {
            let r = 3.0 + side * half.cos();
            text += &format!("v {} {} {}\n", r * angle.cos(), r * angle.sin(), side * half.sin());
        }
    }
    for i in 0..5 {
        let v = 2 * i + 1;
        text += &format!("f {} {} {} {}\n", v, v + 2, v + 3, v + 1);
    }
    text += "f 11 2 1 12\n";
    let cage = repaired(&text);
    let found = inspect(&cage);
    assert_eq!((found.components, found.boundaries, found.faces), (1, 1, 6));
    assert_eq!(report(&cage).opened_edges.total(), 1);
    assert!(repair(desc_of(&cage), &options()).expect("a description").warnings.is_empty());
}

#[test]
fn everything_goes_along() {
    let text = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
        o left\nusemtl red\ns 1\nf 2/1 3/2 4/3 5/4\nf 2 3\no right\nusemtl blue\ns 2\nf 3/1 4/2 7/3 6/4\n\
        t crease 2/1/0 3 2 1.5\nt crease 2/1/0 0 4 3\nt corner 2/2/0 0 6 1 2\nt hole 2/0/0 1 2\n";
    let cage = repaired(text);
    assert_eq!(
        report(&cage).lines(),
        [
            "1 degenerate face dropped: 1",
            "1 face turned over: 2",
            "1 unused vertex dropped: 0",
            "3 tags without its element dropped"
        ]
    );
    assert_eq!(faces(&cage), [[0, 1, 2, 3], [1, 4, 5, 2]]);
    assert_eq!(cage.uv().map(|uv| &uv.indices[..]), Some(&[0, 1, 2, 3, 0, 3, 2, 1][..]));
    assert_eq!((cage.tags().creases.len(), cage.tags().creases[0].vertices), (1, [2, 1]));
    assert_eq!((cage.tags().corners.len(), cage.tags().corners[0].vertex), (1, 5));
    assert_eq!(cage.tags().holes, [1]);
    assert_eq!([cage.source_face(0), cage.source_face(1)], [0, 2]);
    assert_eq!([0, 1, 2, 3].map(|f| cage.face_of_source(f)), [Some(0), None, Some(1), None]);
    let sets: Vec<_> = cage.face_sets().iter().map(|set| (set.kind, &set.name[..], set.faces[0].clone())).collect();
    assert_eq!(
        sets,
        [
            (FaceSetKind::Object, "left", 0..1),
            (FaceSetKind::Object, "right", 1..2),
            (FaceSetKind::Material, "red", 0..1),
            (FaceSetKind::Material, "blue", 1..2),
            (FaceSetKind::Smoothing, "1", 0..1),
            (FaceSetKind::Smoothing, "2", 1..2),
        ]
    );
}

#[test]
fn a_crease_on_a_crowded_edge_goes_to_all_its_copies() {
    let text = CUBE.to_owned()
        + "v 3 1 1\nv 3 1 -1\n"
        + &CUBE_FACES.map(|face| format!("f {face}\n")).concat()
        + "f 4 6 10 9\nt crease 2/1/0 5 3 2\n";
    let ends: Vec<[u32; 2]> = repaired(&text).tags().creases.iter().map(|crease| crease.vertices).collect();
    assert_eq!(ends, [[5, 3], [11, 10]]);
}

#[test]
fn what_cannot_be_repaired_is_refused() {
    let desc = |face_vertices: Vec<u32>| CageDesc {
        positions: vec![DVec3::ZERO; 3],
        face_offsets: vec![0, 3],
        face_vertices,
        ..CageDesc::default()
    };
    let message = repair(desc(vec![0, 1, 3]), &options()).expect_err("no such vertex").to_string();
    assert_eq!(message, "1 face corner without a vertex: face 0 vertex 3; the vertices are 0 to 2");
    assert!(repair(desc(vec![0, 1]), &options()).is_err());
    assert!(repair(CageDesc::default(), &options()).is_ok_and(|desc| desc.face_offsets == [0]));
}

/// Polygons of random corners among few points, some of which coincide: everything that can be wrong is.
fn random_polygons(random: &mut Random) -> CageDesc {
    let vertices = 3 + random.below(10);
    let mut desc = CageDesc { face_offsets: vec![0], ..CageDesc::default() };
    for _ in 0..vertices {
        let [x, y, z] = [(); 3].map(|()| random.below(3) as f64);
        desc.positions.push(DVec3::new(x, y, z));
    }
    for _ in 0..1 + random.below(20) {
        for _ in 0..random.below(7) {
            desc.face_vertices.push(random.below(vertices) as u32);
        }
        desc.face_offsets.push(desc.face_vertices.len() as u32);
    }
    for _ in 0..random.below(4) {
        let vertices = [(); 2].map(|()| random.below(vertices) as u32);
        desc.tags.creases.push(crate::Crease { vertices, sharpness: 1.0 });
        desc.tags.corners.push(crate::Corner { vertex: vertices[0], sharpness: 2.0 });
        desc.tags.holes.push(random.below(20) as u32);
    }
    desc
}

#[test]
fn any_polygons_become_a_cage_and_stay_one() {
    let mut random = Random::new(7);
    let mut cages = 0;
    for round in 0..4000 {
        let polygons = random_polygons(&mut random);
        for weld_tolerance in [0.0, 1.2] {
            let options = RepairDesc { weld_tolerance };
            let repaired = repair(polygons.clone(), &options).expect("corners name vertices");
            if repaired.face_offsets.len() == 1 {
                continue;
            }
            let cage = Cage::new(repaired).unwrap_or_else(|error| panic!("{round}: {error}: {polygons:?}"));
            cages += 1;
            let again = repair(desc_of(&cage), &options).expect("a description");
            assert!(again.warnings.is_empty(), "{round}: {:?} of {polygons:?}", again.warnings);
            let again = CageDesc { source_vertices: vec![], source_faces: vec![], ..again };
            assert_eq!(again, desc_of(&cage), "{round}");
        }
    }
    assert!(cages > 4000, "{cages}");
}

#[test]
fn crowds_take_no_square_of_time() {
    // Triangles around one edge, and as many creases on it.
    let n = 20_000;
    let mut text = String::from("v 0 0 0\nv 0 0 1\n");
    for i in 0..n {
        let angle = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        text += &format!("v {} {} 0\nf 1 2 {}\nt crease 2/1/0 0 1 2\n", angle.cos(), angle.sin(), i + 3);
    }
    let cage = repaired(&text);
    assert_eq!((cage.face_count(), report(&cage).crowded_edges.total()), (n as usize, 1));
    // Three polygons with a common rim.
    let mut text = String::new();
    let mut rim = String::new();
    for i in 0..n {
        let angle = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        text += &format!("v {} {} 0\n", angle.cos(), angle.sin());
        rim += &format!(" {}", i + 1);
    }
    text += "v 0 0 0\nv 0 0 1\n";
    let cage = repaired(&format!("{text}f{rim}\nf{rim} {}\nf{rim} {}\n", n + 1, n + 2));
    assert_eq!(cage.face_count(), 3);
    // A polygon that visits one vertex over and over.
    let loops: String = (0..n).map(|i| format!(" {} {} {}", n + 1, i + 1, (i + 1) % n + 1)).collect();
    assert_eq!(repaired(&format!("{text}f{loops}\n")).face_count(), 1);
}
