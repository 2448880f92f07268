use glam::{DVec2, DVec3};

use crate::{BoundaryRule, Cage, Corner, Crease, CreaseMethod, FaceSetKind, FaceVarying, read_obj, write_obj};

fn read(text: &str) -> Cage {
    read_obj(text.as_bytes(), "test.obj").unwrap_or_else(|error| panic!("{error}"))
}

fn refused(text: &str) -> String {
    read_obj(text.as_bytes(), "test.obj").expect_err("must be refused").to_string()
}

fn warnings(text: &str) -> Vec<String> {
    read(text).warnings().iter().map(ToString::to_string).collect()
}

/// Four vertices of a square, in lines 1 to 4.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn square(rest: &str) -> String {
    format!("{SQUARE}{rest}")
}

mod vertices_and_faces {
    use super::*;

    #[test]
    fn polygons_of_any_size() {
        let cage = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 2 0\nv 2 2 0\nf 1 2 3 4\nf 4 3 5\nf 2 6 5 3\n");
        assert_eq!(cage.vertex_count(), 6);
        assert_eq!(cage.face_offsets(), [0, 4, 7, 11]);
        assert_eq!(cage.face(1), [3, 2, 4]);
        assert!(cage.warnings().is_empty());
    }

    #[test]
    fn coordinates_are_read_to_the_last_bit() {
        let cage = read("v 0.1 -1e-300 +12345678.90123456789\nv 1E2 .5 5.\nv 0 -0 3\nf 1 2 3\n");
        assert_eq!(cage.positions()[0], DVec3::new(0.1, -1e-300, 12_345_678.901_234_567));
        assert_eq!(cage.positions()[1], DVec3::new(100.0, 0.5, 5.0));
        assert!(cage.positions()[2].y.is_sign_negative());
    }

    #[test]
    fn weights_and_colours_are_passed_over() {
        let cage = read("v 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 2 3 4\nf 1 2 3\n");
        assert_eq!(cage.positions()[1], DVec3::X);
        assert!(cage.warnings().is_empty());
    }

    #[test]
    fn every_form_of_a_corner() {
        let text = |f: &str| square(&format!("vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nf {f}\n"));
        for form in ["1/1 2/2 3/3", "1/1/1 2/2/1 3/3/1", "-4/-3 -3/-2 -2/-1", "-4/-3/-1 -3/-2/-1 -2/-1/-1"] {
            let cage = read(&text(form));
            assert_eq!(cage.face(0), [0, 1, 2], "{form}");
            assert_eq!(cage.uv().map(|uv| &uv.indices[..]), Some(&[0, 1, 2][..]), "{form}");
        }
        for form in ["1 2 3", "1//1 2//1 3//1", "-4 -3 -2", "-4//-1 -3//-1 -2//-1"] {
            let cage = read(&text(form));
            assert_eq!(cage.face(0), [0, 1, 2], "{form}");
            assert_eq!(cage.uv(), None, "{form}");
        }
    }

    #[test]
    fn negative_indices_count_from_the_last_vertex_so_far() {
        let cage = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf -3 -2 -1\n");
        assert_eq!(cage.face(1), [3, 4, 5]);
    }

    #[test]
    fn faces_may_precede_their_vertices() {
        assert_eq!(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").face(0), [0, 1, 2]);
    }

    #[test]
    fn line_ends_continuations_and_a_byte_order_mark() {
        let plain = read(&square("f 1 2 3 4\n"));
        assert_eq!(read(&square("f 1 2 3 4")), plain);
        assert_eq!(read(&square("f 1 2 3 4\n").replace('\n', "\r\n")), plain);
        assert_eq!(read(&square("f 1 2 3 4\n").replace('\n', "\r")), plain);
        assert_eq!(read(&square("f 1 \\\n 2 3\\\n4\n")), plain);
        assert_eq!(read(&square("f 1 \\\r\n 2 3\\\r\n4\r\n")), plain);
        assert_eq!(read(&format!("\u{FEFF}{}", square("f 1 2 3 4\n"))), plain);
        assert_eq!(read(&square("  f\t1  2 3 4 # a face \\\n#f 1 2 3\n\n")), plain);
        assert_eq!(read(&square("fo 1 2 3 4\n")), plain);
    }

    #[test]
    fn smoothing_groups_are_sets() {
        let text =
            square("v 2 0 0\nv 2 1 0\nv 3 0 0\ns 1\nf 1 2 3 4\ns off\nf 2 5 6 3\ns 00\ns 12 # twelve\nf 5 7 6\n");
        let cage = read(&text);
        let sets: Vec<_> = cage.face_sets().iter().map(|set| (set.kind, &set.name[..], &set.faces[..])).collect();
        assert_eq!(sets, [(FaceSetKind::Smoothing, "1", &[0..1][..]), (FaceSetKind::Smoothing, "12", &[2..3][..])]);
        let mut text = Vec::new();
        write_obj(&cage, &mut text).expect("a vector takes everything");
        assert!(String::from_utf8_lossy(&text).contains("s 1\nf 1 2 3 4\ns off\nf 2 5 6 3\ns 12\nf 5 7 6\n"));
        assert_eq!(read(&String::from_utf8_lossy(&text)).face_sets(), cage.face_sets());
    }

    #[test]
    fn unused_vertices_are_dropped_with_a_warning() {
        let text = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 2 3 4\n";
        assert_eq!(warnings(text), ["2 unused vertices dropped: 0, 4"]);
        assert_eq!(read(text).source_vertices(), [1, 2, 3]);
    }

    #[test]
    fn normals_and_smoothing_are_passed_over_silently() {
        assert!(warnings(&square("mtllib a.mtl\nvn 0 0 1\ns 1\nf 1 2 3 4\ns off\n")).is_empty());
    }

    #[test]
    fn other_statements_are_ignored_with_a_warning() {
        assert_eq!(
            warnings(&square("l 1 2\np 1\nl 2 3\ncurv 0 1 1 2\nwhat is this\nf 1 2 3 4\n")),
            [
                "2 statements ignored: l (lines are not part of a cage), first in line 5",
                "1 statement ignored: p (points are not part of a cage), first in line 6",
                "1 statement ignored: curv (free-form curves and surfaces are not read), first in line 8",
                "1 statement ignored: what (unknown), first in line 9",
            ]
        );
    }

    #[test]
    fn a_flood_of_unknown_statements_stays_readable() {
        let flood: String = (0..100).map(|i| format!("x{i}\n")).collect();
        let warnings = warnings(&square(&format!("{flood}f 1 2 3 4\n")));
        assert_eq!(warnings.len(), 17);
        assert_eq!(warnings[16], "84 statements ignored: others (unknown), first in line 21");
    }
}

mod uv {
    use super::*;

    #[test]
    fn uv_are_face_varying() {
        let cage = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt .5\nvt 1 1 0\nf 1/1 2/2 3/3\nf 3/1 4/2 1/1\n");
        let expected = FaceVarying {
            values: vec![DVec2::ZERO, DVec2::new(0.5, 0.0), DVec2::ONE],
            indices: vec![0, 1, 2, 0, 1, 0],
        };
        assert_eq!(cage.uv(), Some(&expected));
    }

    #[test]
    fn missing_uv_are_made_up_with_a_warning() {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 1 1\nf 1/1 2/1 3/1\nf 3 4/1 1\n";
        let cage = read(text);
        let expected = FaceVarying { values: vec![DVec2::ONE, DVec2::ZERO], indices: vec![0, 0, 0, 1, 0, 1] };
        assert_eq!(cage.uv(), Some(&expected));
        assert_eq!(warnings(text), ["1 face without uv, set to (0, 0)"]);
    }

    #[test]
    fn uv_that_no_face_uses_are_no_uv() {
        assert_eq!(read(&square("vt 0 0\nf 1 2 3 4\n")).uv(), None);
    }
}

mod face_sets {
    use super::*;

    type Expected<'a> = (FaceSetKind, &'a str, &'a [std::ops::Range<u32>]);

    /// Six triangles of a strip with statements between them.
    fn sets(before: [&str; 6]) -> Cage {
        let mut text: String = (0..8).map(|i| format!("v {} {} 0\n", i / 2, i % 2)).collect();
        for (i, statement) in before.iter().enumerate() {
            let face = if i % 2 == 0 { [i + 1, i + 3, i + 2] } else { [i + 1, i + 2, i + 3] };
            text += &format!("{statement}\nf {} {} {}\n", face[0], face[1], face[2]);
        }
        read(&text)
    }

    fn check(before: [&str; 6], expected: &[Expected]) {
        let cage = sets(before);
        let found: Vec<Expected> =
            cage.face_sets().iter().map(|set| (set.kind, &set.name[..], &set.faces[..])).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn objects_groups_and_materials() {
        check(
            ["o my object", "g a b", "usemtl red paint", "g b", "o", "g"],
            &[
                (FaceSetKind::Object, "my object", &[0..4]),
                (FaceSetKind::Group, "a", &[1..3]),
                (FaceSetKind::Group, "b", &[1..5]),
                (FaceSetKind::Material, "red paint", &[2..6]),
            ],
        );
    }

    #[test]
    fn sets_come_and_go() {
        check(
            ["g a", "g b", "g a a", "g empty\ng a", "g", "g a"],
            &[(FaceSetKind::Group, "a", &[0..1, 2..4, 5..6]), (FaceSetKind::Group, "b", &[1..2])],
        );
    }

    #[test]
    fn names_in_other_encodings() {
        let cage = read_obj(b"v 0 0 0\nv 1 0 0\nv 0 1 0\ng caf\xe9\nf 1 2 3\n", "test.obj").expect("a cage");
        assert_eq!(cage.face_sets()[0].name, "caf\u{FFFD}");
    }
}

mod tags {
    use super::*;

    #[test]
    fn all_tags() {
        let cage = read(&square(
            "f 1 2 3\nf 3 4 1\nt crease 4/2/0 0 1 1 2 2.5 10\nt crease 4/1/0 2 0 3 0 3\nt corner 1/1/0 3 1.5\nt corner 2/2/0 0 1 2 4\n\
             t hole 2/0/0 1 0\nt interpolateboundary 1/0/0 2\nt facevaryinginterpolateboundary 1/0/0 5\nt creasemethod 0/0/1 chaikin\n\
             t smoothtriangles 0/0/1 smooth\n",
        ));
        let tags = cage.tags();
        let crease = |a, b, sharpness| Crease { vertices: [a, b], sharpness };
        assert_eq!(tags.creases, [crease(0, 1, 2.5), crease(1, 2, 10.0), crease(2, 0, 3.0), crease(3, 0, 3.0)]);
        let corner = |vertex, sharpness| Corner { vertex, sharpness };
        assert_eq!(tags.corners, [corner(3, 1.5), corner(0, 2.0), corner(1, 4.0)]);
        assert_eq!(tags.holes, [1, 0]);
        assert_eq!(tags.boundary, Some(BoundaryRule::EdgeOnly));
        assert_eq!(tags.face_varying_boundary, Some(5));
        assert_eq!(tags.crease_method, CreaseMethod::Chaikin);
        assert!(tags.smooth_triangles);
        let warnings: Vec<String> = cage.warnings().iter().map(ToString::to_string).collect();
        assert_eq!(
            warnings,
            [
                "tags not evaluated yet are ignored: 4 creases, 3 corners, creasemethod chaikin, facevaryinginterpolateboundary 5, smoothtriangles"
            ]
        );
    }

    #[test]
    fn defaults_and_the_last_word() {
        let cage = read(&square(
            "f 1 2 3 4\nt creasemethod 0/0/1 normal\nt smoothtriangles 0/0/1 catmark\nt interpolateboundary 1/0/0 0\nt interpolateboundary 1/0/0 1\n",
        ));
        assert_eq!(cage.tags().crease_method, CreaseMethod::Normal);
        assert!(!cage.tags().smooth_triangles);
        assert_eq!(cage.boundary_rule(), Some(BoundaryRule::EdgeAndCorner));
        assert!(cage.warnings().is_empty());
        assert_eq!(read(&square("f 1 2 3 4\n")).boundary_rule(), None);
        assert_eq!(
            read(&square("f 1 2 3 4\nt interpolateboundary 1/0/0 0\n")).boundary_rule(),
            Some(BoundaryRule::None)
        );
    }

    #[test]
    fn tags_may_precede_what_they_name() {
        let cage = read(&format!("t hole 1/0/0 0\nt crease 2/1/0 0 1 1\n{}", square("f 1 2 3 4\n")));
        assert_eq!(cage.tags().holes, [0]);
    }

    #[test]
    fn unknown_tags_are_ignored_with_a_warning() {
        assert_eq!(
            warnings(&square("f 1 2 3 4\nt facevaryingpropagatecorners 1/0/0 1\n")),
            ["1 statement ignored: t facevaryingpropagatecorners (unknown tag), first in line 6"]
        );
    }

    #[test]
    fn malformed_tags() {
        let line = |tag: &str| refused(&square(&format!("f 1 2 3 4\n{tag}\n")));
        let form =
            "test.obj:6: a tag looks like `t NAME INTS/FLOATS/STRINGS ARGUMENTS`, for example `t crease 2/1/0 0 1 2.5`";
        for tag in
            ["t", "t crease", "t crease 2/1 0 1 2", "t crease 2/1/0/0 0 1 2", "t crease a/b/c", "t crease -1/2/2 1 2 3"]
        {
            assert_eq!(line(tag), form, "{tag}");
        }
        assert_eq!(line("t crease 2/1/0 0 1"), "test.obj:6: tag crease announces 3 arguments but has 2");
        assert_eq!(
            line("t hole 9223372036854775807/9223372036854775807/9223372036854775807 0"),
            "test.obj:6: tag hole announces 18446744073709551615 arguments but has 1"
        );
        let crease = "test.obj:6: tag crease takes pairs of vertices and one sharpness, or one for each pair: `t crease 2/1/0 0 1 2.5`";
        for tag in [
            "t crease 0/1/0 1",
            "t crease 1/1/0 0 1",
            "t crease 2/0/0 0 1",
            "t crease 4/3/0 0 1 1 2 1 2 3",
            "t crease 2/1/1 0 1 2 x",
        ] {
            assert_eq!(line(tag), crease, "{tag}");
        }
        let corner =
            "test.obj:6: tag corner takes vertices and one sharpness, or one for each vertex: `t corner 1/1/0 0 2.5`";
        for tag in ["t corner 0/1/0 1", "t corner 1/0/0 1", "t corner 1/1/1 0 1 x", "t corner 3/2/0 0 1 2 1 1"] {
            assert_eq!(line(tag), corner, "{tag}");
        }
        for tag in ["t hole 0/0/0", "t hole 1/1/0 0 0", "t hole 0/0/1 x"] {
            assert_eq!(line(tag), "test.obj:6: tag hole takes faces: `t hole 2/0/0 3 4`", "{tag}");
        }
        for tag in ["t interpolateboundary 1/0/0 3", "t interpolateboundary 0/0/0", "t interpolateboundary 0/0/1 none"]
        {
            assert_eq!(
                line(tag),
                "test.obj:6: tag interpolateboundary takes 0 (none), 1 (edge and corner) or 2 (edge only): `t interpolateboundary 1/0/0 1`"
            );
        }
        assert_eq!(
            line("t facevaryinginterpolateboundary 1/0/0 6"),
            "test.obj:6: tag facevaryinginterpolateboundary takes a number from 0 to 5: `t facevaryinginterpolateboundary 1/0/0 1`"
        );
        assert_eq!(
            line("t creasemethod 0/0/1 sharp"),
            "test.obj:6: tag creasemethod takes normal or chaikin: `t creasemethod 0/0/1 chaikin`"
        );
        assert_eq!(
            line("t smoothtriangles 1/0/0 1"),
            "test.obj:6: tag smoothtriangles takes catmark or smooth: `t smoothtriangles 0/0/1 smooth`"
        );
        assert_eq!(line("t hole 1/0/0 -1"), "test.obj:6: \"-1\" is not an index; the indices of tags count from 0");
        assert_eq!(
            line("t corner 1/1/0 0 soft"),
            "test.obj:6: \"soft\" is not a number; numbers look like -1.5 or 2e-3"
        );
    }

    #[test]
    fn tags_that_name_what_does_not_exist() {
        let line = |tags: &str| refused(&square(&format!("f 1 2 3 4\n{tags}\n")));
        assert_eq!(
            line("t crease 2/1/0 0 1 1\n\nt crease 2/1/0 0 2 1"),
            "test.obj:8: crease 1 is between vertices 0 and 2, but no edge joins them (elements count from 0)"
        );
        assert_eq!(
            line("t corner 1/1/0 4 1"),
            "test.obj:6: corner 0 is at vertex 4, but the vertices are 0 to 3 (elements count from 0)"
        );
        assert_eq!(
            line("t hole 1/0/0 1"),
            "test.obj:6: hole 0 is face 1, but the only face is 0 (elements count from 0)"
        );
        assert_eq!(
            line("t corner 1/1/0 1 -1"),
            "test.obj:6: corner 0 has sharpness -1, but sharpness is at least 0 (elements count from 0)"
        );
        assert_eq!(
            line("t crease 2/1/0 0 1 -1"),
            "test.obj:6: crease 0 has sharpness -1, but sharpness is at least 0 (elements count from 0)"
        );
    }
}

mod refusals {
    use super::*;

    #[test]
    fn malformed_numbers() {
        assert_eq!(refused("\nv 0 0 x\n"), "test.obj:2: \"x\" is not a number; numbers look like -1.5 or 2e-3");
        assert_eq!(refused("v 0 0\n"), "test.obj:1: `v` has 2 of the 3 numbers it needs");
        assert_eq!(refused("vt\n"), "test.obj:1: `vt` has 0 of the 1 numbers it needs");
        assert_eq!(refused("v 0 nan 0\n"), "test.obj:1: \"nan\" is not finite; write a finite number");
        assert_eq!(refused("v 0 1e400 0\n"), "test.obj:1: \"1e400\" is not finite; write a finite number");
        assert_eq!(refused("vt inf 0\n"), "test.obj:1: \"inf\" is not finite; write a finite number");
    }

    #[test]
    fn malformed_faces() {
        let line = |face: &str| refused(&square(&format!("{face}\n")));
        assert_eq!(line("f 1 2"), "test.obj:5: a face with 2 corners; faces have at least 3");
        assert_eq!(line("f 1"), "test.obj:5: a face with 1 corner; faces have at least 3");
        assert_eq!(line("f 1 2 c"), "test.obj:5: \"c\" is not a face corner; corners look like 1, 1/2, 1//3 or 1/2/3");
        assert_eq!(line("f 0 1 2"), "test.obj:5: index 0 in \"0\"; indices count from 1, or from -1 backwards");
        assert_eq!(line("f 1 2 5"), "test.obj:5: vertex index 5 is out of range: 4 in the file");
        assert_eq!(line("f 1 2 -5"), "test.obj:5: vertex index -5 is out of range: 4 so far");
        assert_eq!(line("vt 0 0\nf 1/1 2/2 3/1"), "test.obj:6: uv index 2 is out of range: 1 in the file");
        assert_eq!(line("f 1 2 99999999999"), "test.obj:5: vertex index 99999999999 is out of range: 4 in the file");
        assert_eq!(
            line("f 1 2 99999999999999999999"),
            "test.obj:5: \"99999999999999999999\" is not a face corner; corners look like 1, 1/2, 1//3 or 1/2/3"
        );
    }

    #[test]
    fn the_line_of_an_index_is_that_of_its_face() {
        assert_eq!(
            refused(&square("f 1 2 3\n\nf 1 3 \\\n9\n")),
            "test.obj:7: vertex index 9 is out of range: 4 in the file"
        );
    }

    #[test]
    fn no_faces() {
        for text in ["", "\n", "# nothing", SQUARE, "\u{FEFF}"] {
            assert_eq!(refused(text), "test.obj: no faces; a cage has at least one", "{text:?}");
        }
    }

    #[test]
    fn non_manifold_edges() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 5 1 2\n";
        assert_eq!(
            refused(text),
            "test.obj:8: not manifold, 1 edge with more than two faces: 0-1 (faces 0, 1, 2); remove or separate the extra faces (elements count from 0)"
        );
    }

    #[test]
    fn inconsistent_winding() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nf 1 2 3\nf 1 2 4\n";
        assert_eq!(
            refused(text),
            "test.obj:6: inconsistent winding, 1 edge along which both faces run the same way: 0-1 (faces 0, 1); flip the faces that are inside out, or delete one of two equal faces (elements count from 0)"
        );
    }

    #[test]
    fn bow_ties() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n";
        assert_eq!(
            refused(text),
            "test.obj:7: not manifold, 1 bow-tie vertex where separate fans of faces touch: 0 (2 fans); split these vertices (elements count from 0)"
        );
    }

    #[test]
    fn repeated_vertices() {
        assert_eq!(
            refused(&square("f 1 2 3 2\n")),
            "test.obj:5: repeated vertices in a face, at 1 corner: face 0 vertex 1; split the face or merge its corners (elements count from 0)"
        );
    }

    #[test]
    fn errors_name_vertices_of_the_file() {
        // Two unused vertices come first; they must not shift the names.
        let text = "v 9 9 9\nv 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nf 3 4 5\nf 3 4 6\n";
        assert!(refused(text).contains("2-3 (faces 0, 1)"), "{}", refused(text));
    }

    #[test]
    fn too_large() {
        assert_eq!(
            refused("v 0 0 0\nv 1e200 0 0\nv 0 1 0\nf 1 2 3\n"),
            "test.obj: the cage is 1e200 across, at most 1e18 can be drawn; scale it down"
        );
    }
}

mod round_trip {
    use super::*;

    fn check(cage: &Cage) {
        let mut text = Vec::new();
        write_obj(cage, &mut text).expect("a vector takes everything");
        let again = read_obj(&text, "again.obj").unwrap_or_else(|error| panic!("{error}"));
        let bits =
            |cage: &Cage| cage.positions().iter().flat_map(|p| p.to_array()).map(f64::to_bits).collect::<Vec<_>>();
        assert_eq!(bits(&again), bits(cage));
        assert_eq!(again.topology(), cage.topology());
        assert_eq!(again.uv(), cage.uv());
        assert_eq!(again.tags(), cage.tags());
        assert_eq!(again.face_sets(), cage.face_sets());
    }

    #[test]
    fn everything_a_cage_can_hold() {
        let text = "v -0 1e-308 0.1\nv 1e17 0 3e-5\nv 0.3333333333333333 1 0\nv -7 1 123456789.123\nv 5 5 5\nvt 0.1 0.7\nvt 1e-9 -0\n\
            usemtl a\ng one two\no thing with blanks\nf 1/1 2/2 3/1\ng two\nf 4/1 3/1 2/2\ng\nf 4/2 1/1 3/1\nusemtl b # c\n\
            t crease 2/1/0 0 1 2.5\nt corner 1/1/0 3 0.1\nt hole 1/0/0 1\nt interpolateboundary 1/0/0 2\n\
            t facevaryinginterpolateboundary 1/0/0 3\nt creasemethod 0/0/1 chaikin\nt smoothtriangles 0/0/1 smooth\n";
        let cage = read(text);
        assert_eq!(cage.face_sets().len(), 4);
        check(&cage);
        for rule in [0, 1] {
            check(&read(&text.replace("interpolateboundary 1/0/0 2", &format!("interpolateboundary 1/0/0 {rule}"))));
        }
    }

    #[test]
    fn random_coordinates() {
        let mut random = crate::random::Random::new(1);
        for _ in 0..200 {
            let mut coordinate = || loop {
                let x = f64::from_bits(random.next_u64());
                if x.abs() < 1e17 {
                    return x;
                }
            };
            let text: String =
                (0..4).map(|_| format!("v {:?} {:?} {:?}\n", coordinate(), coordinate(), coordinate())).collect();
            check(&read(&format!("{text}f 1 2 3 4\n")));
        }
    }

    #[test]
    fn awkward_names() {
        let name = |name: &str, kind| crate::FaceSet { kind, name: name.into(), faces: vec![0..1] };
        let base = read(&square("f 1 2 3 4\n"));
        for (given, object, group) in [
            ("plain", "plain", "plain"),
            ("two words", "two words", "two_words"),
            ("line\nbreak", "line_break", "line_break"),
            ("ends\\", "ends\\_", "ends\\_"),
            ("", "_", "_"),
            (" x ", "_ x _", "_x_"),
            ("#1", "#1", "_#1"),
            ("\u{e9}\u{3000}", "\u{e9}\u{3000}", "\u{e9}\u{3000}"),
        ] {
            let desc = crate::CageDesc {
                positions: base.positions().to_vec(),
                face_offsets: vec![0, 4],
                face_vertices: vec![0, 1, 2, 3],
                face_sets: vec![name(given, FaceSetKind::Object), name(given, FaceSetKind::Group)],
                ..crate::CageDesc::default()
            };
            let mut text = Vec::new();
            write_obj(&Cage::new(desc).expect("a cage"), &mut text).expect("written");
            let again = read_obj(&text, "again.obj").expect("read");
            let names: Vec<&str> = again.face_sets().iter().map(|set| &set.name[..]).collect();
            assert_eq!(names, [object, group], "{given:?}");
        }
    }
}

#[test]
fn damaged_text_never_panics() {
    let text = square(
        "vt 0 0\nvt 1 1\ng a\nusemtl b\nf 1/1 2/2 3/1 4/2\nt crease 2/1/0 0 1 2\nt corner 1/1/0 1 1\nt hole 1/0/0 0\n\
        t interpolateboundary 1/0/0 1\nt creasemethod 0/0/1 chaikin\n",
    );
    let mut random = crate::random::Random::new(2);
    let mut read = 0;
    for _ in 0..20_000 {
        let mut damaged = text.clone().into_bytes();
        for _ in 0..1 + random.below(4) {
            random.damage(&mut damaged, b" \n\r\\/#-+.e0123456789fvtgl\xff\0");
        }
        read += usize::from(read_obj(&damaged, "damaged.obj").is_ok());
    }
    assert!((1000..19_000).contains(&read), "damage must hit some and spare some, but {read} of 20000 were read");
}

#[test]
fn what_is_not_text_is_refused_as_such() {
    let utf_16: Vec<u8> = "v 0 0 0\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [&b"glTF\x02\0\0\0"[..], &utf_16] {
        let error = read_obj(bytes, "test.obj").expect_err("must be refused").to_string();
        assert!(error.contains("not a text OBJ file"), "{error}");
    }
}

mod documentation {
    use super::*;

    #[test]
    fn the_documented_example_is_a_cage_with_its_tags() {
        let text = include_str!("../../../../docs/formats.md");
        let example = text.split("```").find(|block| block.starts_with("\nv -1")).expect("an example");
        let cage = read(example);
        let tags = cage.tags();
        assert_eq!((tags.creases.len(), tags.corners.len(), &tags.holes[..]), (4, 1, &[3][..]));
        let each = "t crease 8/4/0 2 3 3 5 5 4 4 2 10 8 6 4";
        assert!(text.contains(&format!("`{each}`")));
        let old = example.lines().find(|line| line.starts_with("t crease")).expect("creases");
        assert_eq!(read(&example.replace(old, each)).tags().creases[3].sharpness, 4.0);
    }
}
