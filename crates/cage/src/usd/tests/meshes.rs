//! What a mesh becomes.

use glam::DVec2;

use super::*;
use crate::{BoundaryRule, Corner, Crease, FaceSetKind, Warning};

#[test]
fn points_and_faces() {
    let cage = cage(&square(""));
    assert_eq!(cage.positions()[2], DVec3::new(1.0, 1.0, 0.0));
    assert_eq!(cage.face(0), [0, 1, 2, 3]);
    assert_eq!((cage.uv(), cage.boundary_rule(), cage.warnings()), (None, None, &[][..]));
    assert_eq!(cage.face_sets()[0].name, "/Square");
}

#[test]
fn left_handed_faces_turn_round_their_first_corner() {
    let uv = "texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = \"faceVarying\")";
    let cage = cage(&square(&format!("uniform token orientation = \"leftHanded\"\n{uv}")));
    assert_eq!(cage.face(0), [0, 3, 2, 1]);
    let uv = cage.uv().expect("uv");
    let corners: Vec<DVec2> = uv.indices.iter().map(|&i| uv.values[i as usize]).collect();
    assert_eq!(corners, [DVec2::ZERO, DVec2::Y, DVec2::ONE, DVec2::X]);
}

#[test]
fn creases_are_chains_with_one_sharpness_or_one_for_each_edge() {
    let tags = |sharpness: &str| {
        let text = strip(&format!(
            "int[] creaseIndices = [0, 1, 2, 5, 4]
            int[] creaseLengths = [3, 2]
            float[] creaseSharpnesses = {sharpness}
            int[] cornerIndices = [3]
            float[] cornerSharpnesses = [2.5]
            int[] holeIndices = [1]"
        ));
        cage(&text).tags().clone()
    };
    let crease = |a, b, sharpness| Crease { vertices: [a, b], sharpness };
    let found = tags("[1, 10]");
    assert_eq!(found.creases, [crease(0, 1, 1.0), crease(1, 2, 1.0), crease(5, 4, 10.0)]);
    assert_eq!(tags("[1, 2, 3]").creases, [crease(0, 1, 1.0), crease(1, 2, 2.0), crease(5, 4, 3.0)]);
    assert_eq!((found.corners, found.holes), (vec![Corner { vertex: 3, sharpness: 2.5 }], vec![1]));
}

#[test]
fn rules() {
    let tags = |properties: &str| cage(&square(properties)).tags().clone();
    assert_eq!(tags("uniform token interpolateBoundary = \"none\"").boundary, Some(BoundaryRule::None));
    assert_eq!(tags("token interpolateBoundary = \"edgeOnly\"").boundary, Some(BoundaryRule::EdgeOnly));
    let seams = ["none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all"];
    for (number, name) in (0..).zip(seams) {
        let rule = format!("token faceVaryingLinearInterpolation = \"{name}\"");
        assert_eq!(tags(&rule).face_varying_boundary, Some(number));
    }
    assert!(tags("token triangleSubdivisionRule = \"smooth\"").smooth_triangles);
}

#[test]
fn the_rules_of_the_first_mesh_hold() {
    let other = square("token interpolateBoundary = \"edgeOnly\"").replace("Square", "Other");
    let cage = cage(&(strip("token subdivisionScheme = \"bilinear\"") + &other));
    assert_eq!((cage.face_count(), cage.boundary_rule()), (3, None));
    let warnings: Vec<String> = cage.warnings().iter().map(Warning::to_string).collect();
    assert_eq!(
        warnings,
        [
            "1 mesh with other rules (interpolateBoundary, faceVaryingLinearInterpolation, triangleSubdivisionRule) \
             than the first, which hold for all: /Other",
            "1 mesh with another subdivisionScheme than catmullClark, smoothed all the same: /Strip",
        ]
    );
}

/// The texture coordinates of each corner of a strip, and how many values there are.
fn corners(primvar: &str) -> (Vec<f64>, usize) {
    let cage = cage(&strip(primvar));
    let uv = cage.uv().expect("uv");
    (uv.indices.iter().map(|&i| uv.values[i as usize].x).collect(), uv.values.len())
}

#[test]
fn texture_coordinates_of_all_interpolations() {
    let vertex = "float2[] primvars:st = [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (4, 0)] (interpolation = \"vertex\")";
    assert_eq!(corners(vertex), (vec![0.0, 1.0, 4.0, 3.0, 1.0, 2.0, 4.0, 4.0], 6));
    let uniform = "texCoord2d[] primvars:map = [(5, 0), (6, 0)] (interpolation = \"uniform\")";
    assert_eq!(corners(uniform).0, [5.0, 5.0, 5.0, 5.0, 6.0, 6.0, 6.0, 6.0]);
    let indexed = "texCoord2f[] primvars:st = [(0, 0), (1, 0)] (interpolation = \"faceVarying\")
        int[] primvars:st:indices = [0, 1, 0, 1, 1, 1, 1, 1]";
    assert_eq!(corners(indexed), (vec![0.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0], 2));
}

#[test]
fn equal_values_of_corners_are_joined() {
    let values = "[(0, 0), (1, 0), (1, 1), (0, 1), (1, 0), (2, 0), (2, 1), (1, 1)]";
    let primvar = format!("texCoord2f[] primvars:st = {values} (interpolation = \"faceVarying\")");
    assert_eq!(corners(&primvar), (vec![0.0, 1.0, 1.0, 0.0, 1.0, 2.0, 2.0, 1.0], 6));
}

#[test]
fn a_mesh_without_texture_coordinates_among_others() {
    let uv = "texCoord2f[] primvars:st = [(7, 7)] (interpolation = \"faceVarying\")
        int[] primvars:st:indices = [0, 0, 0, 0]";
    let cage = cage(&(square(uv) + &strip("")));
    assert_eq!(cage.uv().expect("uv").values, [DVec2::splat(7.0), DVec2::ZERO]);
    assert_eq!(cage.warnings(), [Warning::MissingUv(2)]);
}

#[test]
fn materials_of_meshes_and_subsets() {
    let cage = cage(&strip(
        "rel material:binding = </Looks/Skin>
        def GeomSubset \"last\" { int[] indices = [1]  rel material:binding = </Looks/Shell> }
        def GeomSubset \"unbound\" { int[] indices = [0] }",
    ));
    let sets: Vec<_> = cage.face_sets().iter().map(|set| (set.kind, set.name.as_str(), set.faces.clone())).collect();
    assert_eq!(
        sets,
        [
            (FaceSetKind::Object, "/Strip", vec![0..2]),
            (FaceSetKind::Material, "Skin", vec![0..1]),
            (FaceSetKind::Material, "Shell", vec![1..2]),
        ]
    );
}

#[test]
fn meshes_that_touch_stay_apart() {
    let cage = cage(&(square("") + &square("").replace("Square", "Second")));
    assert_eq!((cage.vertex_count(), cage.face_count(), cage.face(1)), (8, 2, &[4, 5, 6, 7][..]));
}
