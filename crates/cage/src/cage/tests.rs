use super::*;
use crate::{Corner, Crease, TagError};

/// A unit square, to be changed by each test.
fn square() -> CageDesc {
    CageDesc {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y],
        face_offsets: vec![0, 4],
        face_vertices: vec![0, 1, 2, 3],
        ..CageDesc::default()
    }
}

fn refused(change: impl FnOnce(&mut CageDesc)) -> String {
    let mut desc = square();
    change(&mut desc);
    Cage::new(desc).expect_err("must be refused").to_string()
}

#[test]
fn accessors() {
    let cage = Cage::new(square()).expect("a cage");
    assert_eq!((cage.vertex_count(), cage.face_count(), cage.is_quads()), (4, 1, true));
    assert_eq!(cage.face(0), [0, 1, 2, 3]);
    assert_eq!(cage.face_offsets(), [0, 4]);
    assert_eq!(cage.face_vertices(), [0, 1, 2, 3]);
    assert_eq!(cage.source_vertices(), [0, 1, 2, 3]);
    assert_eq!(cage.bounds().max, DVec3::new(1.0, 1.0, 0.0));
    assert_eq!((cage.boundary_rule(), cage.uv(), cage.warnings()), (None, None, &[][..]));
}

#[test]
fn triangles_are_not_quads() {
    let cage =
        Cage::new(CageDesc { face_offsets: vec![0, 3], face_vertices: vec![0, 1, 2], ..square() }).expect("a cage");
    assert!(!cage.is_quads());
}

#[test]
fn nothing_is_refused() {
    assert_eq!(Cage::new(CageDesc::default()).expect_err("empty").to_string(), "no faces; a cage has at least one");
}

#[test]
fn coordinates() {
    assert_eq!(refused(|d| d.positions[2].y = f64::NAN), "1 vertex with coordinates that are not finite: 2");
    assert_eq!(
        refused(|d| d.positions.extend([DVec3::INFINITY; 9])),
        "9 vertices with coordinates that are not finite: 4, 5, 6, 7 and 5 more"
    );
    assert_eq!(
        refused(|d| d.positions[1].x = 1e300),
        "the cage is 1e300 across, at most 1e18 can be drawn; scale it down"
    );
    assert!(refused(|d| (d.positions[1].x, d.positions[0].x) = (f64::MAX, f64::MIN)).contains("across"));
}

#[test]
fn far_away_is_fine() {
    let mut desc = square();
    desc.positions.iter_mut().for_each(|p| p.z += 1e300);
    assert!(Cage::new(desc).is_ok());
}

#[test]
fn topology_is_checked() {
    assert_eq!(
        refused(|d| d.face_vertices[3] = 7),
        "1 face corner without a vertex: face 0 vertex 7; the vertices are 0 to 3"
    );
}

#[test]
fn unused_vertices_are_dropped() {
    let desc = CageDesc {
        positions: vec![DVec3::INFINITY.signum() * 5.0, DVec3::ZERO, DVec3::X, DVec3::NEG_ONE, DVec3::Y],
        face_offsets: vec![0, 3],
        face_vertices: vec![1, 2, 4],
        uv: Some(FaceVarying { values: vec![DVec2::ZERO, DVec2::ONE], indices: vec![0, 1, 0] }),
        tags: Tags {
            creases: vec![Crease { vertices: [4, 2], sharpness: 1.0 }],
            corners: vec![Corner { vertex: 0, sharpness: 2.0 }, Corner { vertex: 4, sharpness: 3.0 }],
            ..Tags::default()
        },
        ..CageDesc::default()
    };
    let cage = Cage::new(desc).expect("a cage");
    assert_eq!(cage.positions(), [DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(cage.face(0), [0, 1, 2]);
    assert_eq!(cage.source_vertices(), [1, 2, 4]);
    assert_eq!(cage.tags().creases, [Crease { vertices: [2, 1], sharpness: 1.0 }]);
    assert_eq!(cage.tags().corners, [Corner { vertex: 2, sharpness: 3.0 }]);
    assert_eq!(cage.bounds(), Bounds::of(cage.positions()));
    let warnings: Vec<String> = cage.warnings().iter().map(ToString::to_string).collect();
    assert_eq!(
        warnings,
        [
            "2 unused vertices dropped: 0, 3 (and 1 corner tag there)",
            "tags not evaluated yet are ignored: 1 crease, 1 corner"
        ]
    );
}

#[test]
fn evaluated_tags_give_no_warning() {
    let tags = Tags { holes: vec![0], boundary: Some(BoundaryRule::EdgeOnly), ..Tags::default() };
    let cage = Cage::new(CageDesc { tags, ..square() }).expect("a cage");
    assert_eq!(cage.boundary_rule(), Some(BoundaryRule::EdgeOnly));
    assert!(cage.warnings().is_empty());
}

#[test]
fn tags_that_do_not_fit() {
    let crease = |vertices, sharpness| move |d: &mut CageDesc| d.tags.creases.push(Crease { vertices, sharpness });
    let corner = |vertex, sharpness| move |d: &mut CageDesc| d.tags.corners.push(Corner { vertex, sharpness });
    assert_eq!(refused(crease([0, 2], 1.0)), "crease 0 is between vertices 0 and 2, but no edge joins them");
    assert_eq!(refused(crease([0, 9], 1.0)), "crease 0 is between vertices 0 and 9, but no edge joins them");
    assert_eq!(refused(crease([0, 1], -1.0)), "crease 0 has sharpness -1, but sharpness is at least 0");
    assert_eq!(refused(crease([0, 1], f32::NAN)), "crease 0 has sharpness NaN, but sharpness is at least 0");
    assert_eq!(refused(corner(4, 1.0)), "corner 0 is at vertex 4, but the vertices are 0 to 3");
    assert_eq!(refused(corner(0, -2.5)), "corner 0 has sharpness -2.5, but sharpness is at least 0");
    assert_eq!(refused(|d| d.tags.holes.extend([0, 1])), "hole 1 is face 1, but the only face is 0");
    assert_eq!(
        refused(|d| d.tags.face_varying_boundary = Some(6)),
        "the face-varying boundary rule is 6, but the rules are 0 to 5"
    );
    let mut desc = square();
    crease([3, 0], f32::INFINITY)(&mut desc);
    assert!(Cage::new(desc).is_ok(), "either direction and infinite sharpness");
    assert_eq!(TagError::FaceVaryingBoundary(6), TagError::FaceVaryingBoundary(6));
}

#[test]
fn uv_that_do_not_fit() {
    let uv =
        |values: Vec<DVec2>, indices: Vec<u32>| move |d: &mut CageDesc| d.uv = Some(FaceVarying { values, indices });
    assert_eq!(
        refused(uv(vec![DVec2::ZERO], vec![0; 3])),
        "3 uv indices for 4 face corners; there must be one for each"
    );
    assert_eq!(
        refused(uv(vec![DVec2::ZERO], vec![0, 1, 0, 2])),
        "2 face corners with a missing uv: 1, 3; the only uv is 0"
    );
    assert_eq!(refused(uv(vec![DVec2::NAN], vec![0; 4])), "1 uv not finite: 0");
}

#[test]
fn face_sets_that_do_not_fit() {
    let set = |faces: Vec<Range<u32>>| {
        move |d: &mut CageDesc| d.face_sets.push(FaceSet { kind: FaceSetKind::Group, name: "body".into(), faces })
    };
    let message =
        |range| format!("face set \"body\" has the range {range}; ranges must rise without touching within 0..1");
    assert_eq!(refused(set(vec![0..2])), message("0..2"));
    assert_eq!(refused(set(vec![0..0])), message("0..0"));
    assert_eq!(refused(set(vec![0..1, 0..1])), message("0..1"));
}
