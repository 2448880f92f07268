//! The distance between two schemes as a heat map.

use osculate::{BoundaryRule, EngineDesc, EngineError, RenderDesc, Scheme, Shade, SurfaceDesc, Tessellation, render};
use osculate::{Cage, Difference, Surface, SurfacePoint};
use osculate_compare::Picture;
use osculate_tests::picture::{Gallery, camera, draw_difference};
use osculate_tests::{gpu, gpu_with, zoo};

fn desc(cage: &Cage) -> RenderDesc {
    RenderDesc {
        camera: camera(cage, [0.7, 0.5, 1.5], 2.3, 45.0),
        tessellation: Tessellation::uniform(4.0),
        ..RenderDesc::fit(cage, [192, 192])
    }
}

fn difference(cage: &Cage, schemes: [Scheme; 2], range: Option<f64>) -> (Picture, Difference) {
    draw_difference(&gpu(), cage, schemes, range, &desc(cage))
}

#[test]
fn a_scheme_has_no_distance_to_itself() {
    for name in ["twohole", "triangles", "shell"] {
        let cage = zoo::shipped(name);
        for &scheme in Scheme::ALL {
            let (_, found) = difference(&cage, [scheme; 2], None);
            let rounding = 1e-6 * cage.bounds().half_diagonal();
            assert!(found.largest < rounding, "{name}, {scheme}: {found:?}");
        }
    }
}

/// Two surfaces of the reference data's kind: the distance that vertices are coloured by is that of the samples at their places.
#[test]
fn distances_are_those_of_samples() {
    let gpu = gpu();
    let cage = zoo::shipped("twohole");
    for schemes in [[Scheme::Gregory2, Scheme::Stam], [Scheme::Gregory1, Scheme::Biseptic]] {
        let (_, found) = difference(&cage, schemes, None);
        let surfaces =
            schemes.map(|scheme| Surface::new(&gpu, &cage, &SurfaceDesc { scheme, ..SurfaceDesc::default() }).unwrap());
        // All vertices of that level in either scheme: patches are whole or half or quarter faces.
        let n = 4 << surfaces[0].plan().steps();
        let mut points = Vec::new();
        for face in 0..cage.face_count() as u32 {
            for sub_face in surfaces[0].plan().locator.sub_faces(face) {
                let at = |i: u32| f64::from(i) / f64::from(n);
                points.extend((0..=n).flat_map(|j| {
                    (0..=n).map(move |i| SurfacePoint { sub_face, s: f64::from(i) / f64::from(n), t: at(j) })
                }));
            }
        }
        let [a, b] = surfaces.each_ref().map(|surface| surface.sample(&points).unwrap());
        let largest = a.iter().zip(&b).map(|(a, b)| a.position.distance(b.position)).fold(0.0, f64::max);
        assert!(largest > 1e-4, "{schemes:?}: {largest}");
        assert!((found.largest - largest).abs() < 1e-5 * largest.max(0.1), "{schemes:?}: {found:?}, {largest}");
        assert!(found.mean > 0.0 && found.mean < found.largest, "{found:?}");
        assert_eq!(found.range, found.largest);
    }
}

/// Patches that are bicubic in both schemes are the same; a range much larger than all distances leaves one colour, a smaller one is reached by more of the
/// surface.
#[test]
fn colours_follow_the_range() {
    let cage = zoo::shipped("twohole");
    let dark = |picture: &Picture| picture.pixels().filter(|p| p[0] < 120 && p[1] < 60 && p[2] > p[1]).count();
    let schemes = [Scheme::Gregory2, Scheme::Stam];
    let (plain, found) = difference(&cage, schemes, Some(1e6));
    assert_eq!(found.range, 1e6);
    let colourful = |picture: &Picture| picture.pixels().filter(|p| p[0].abs_diff(p[2]) > 60).count();
    assert_eq!(colourful(&plain), 0);
    let counts = [1.0, 0.5, 0.1].map(|part| {
        let (picture, _) = difference(&cage, schemes, Some(part * found.largest));
        (colourful(&picture), dark(&picture))
    });
    assert!(counts.is_sorted_by(|a, b| a.0 < b.0 && a.1 < b.1), "{counts:?}");
    assert!(counts[0].0 > 100, "{counts:?}");
}

#[test]
fn the_heat_map_is_the_golden() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    let cage = zoo::shipped("twohole");
    let (picture, _) = difference(&cage, [Scheme::Gregory2, Scheme::Stam], None);
    gallery.check("shade_difference", &picture);
    gallery.finish();
}

#[test]
fn chunks_do_not_show() {
    let small = gpu_with(EngineDesc { grid_vertices: Some(700), ..EngineDesc::default() });
    let cage = zoo::shipped("twohole");
    let desc = RenderDesc { cage: true, ..desc(&cage) };
    let draw = |engine| draw_difference(engine, &cage, [Scheme::Gregory2, Scheme::Stam], None, &desc);
    let ((whole, found), (parts, found_in_parts)) = (draw(&gpu()), draw(&small));
    assert!(whole.rgba() == parts.rgba());
    assert_eq!((found.largest, found.range), (found_in_parts.largest, found_in_parts.range));
    assert!((found.mean - found_in_parts.mean).abs() < 1e-12, "{found:?}, {found_in_parts:?}");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let gpu = gpu();
    let cage = zoo::shipped("shell");
    let surface = |boundary| Surface::new(&gpu, &cage, &SurfaceDesc { boundary, ..SurfaceDesc::default() }).unwrap();
    let (all, fewer) = (surface(Some(BoundaryRule::EdgeAndCorner)), surface(Some(BoundaryRule::None)));
    let refused = osculate::render_difference(&gpu, [&all, &fewer], &desc(&cage), None).unwrap_err();
    assert!(matches!(refused, EngineError::NoSuchPoint { .. }), "{refused}");
    let alone = RenderDesc { shade: Shade::Difference, ..desc(&cage) };
    assert!(matches!(render(&gpu, &[&all], &alone), Err(EngineError::OneSurface)));
}
