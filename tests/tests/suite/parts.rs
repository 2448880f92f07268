//! Cages in parts: pictures are those of the whole, no crack runs between parts, and parts that are cut wrongly are noticed.

use glam::DVec3;
use osculate::gpu::Device;
use osculate::{
    Cage, CheckReport, Displacement, Engine, EngineError, Evaluator, Factors, MapPlacement, MapsDesc, Part, Parts,
    PartsDesc, PartsProof, Refinement, RenderDesc, Scheme, Shade, Spacing, Surface, SurfaceDesc, Tessellation,
    UvOrigin, WeldReport, WholeOrParts, check, render,
};
use osculate_cage::{CageDesc, CagePart, divide};
use osculate_tests::{gpu, mapped, rules_of, schemes_in_turn, surface_of, zoo};

/// About how many parts a cage is cut into: small ones into parts of a few faces.
const PARTS: usize = 5;

fn parts<'a>(engine: &Engine, cage: &'a Cage, surface: SurfaceDesc) -> Parts<'a> {
    let most_faces = Some(cage.face_count().div_ceil(PARTS));
    Parts::new(engine, cage, &PartsDesc { surface, most_faces }).unwrap()
}

/// A report without what is for information.
fn counts(report: CheckReport) -> CheckReport {
    CheckReport { weld: WeldReport::default(), ..report }
}

#[test]
fn the_zoo_is_watertight_in_parts() {
    let gpu = gpu();
    let evaluators = [Evaluator::Tessellator, Evaluator::Compute];
    for (number, specimen) in zoo::all().iter().filter(|specimen| specimen.cage.face_count() < 300).enumerate() {
        let rules = rules_of(&specimen.cage);
        for (turn, &scheme) in schemes_in_turn(number, &specimen.cage).iter().enumerate() {
            // Each scheme meets each rule and evaluator somewhere.
            let (boundary, evaluator) = (Some(rules[(number + turn) % rules.len()]), evaluators[(number + turn) % 2]);
            let Some(whole) = surface_of(&gpu, &specimen.cage, scheme, boundary) else { continue };
            let tessellation =
                Tessellation { spacing: Spacing::Odd, evaluator, ..Tessellation::uniform([2.6, 3.0][turn % 2]) };
            let mut parts = parts(&gpu, &specimen.cage, SurfaceDesc { scheme, boundary, ..SurfaceDesc::default() });
            let report = parts.check(&tessellation).unwrap();
            let expected = check(&whole, &tessellation).unwrap();
            assert!(report.is_watertight(), "{}, {scheme}, {boundary:?}: {report:?}", specimen.name);
            assert_eq!(counts(report), counts(expected), "{}, {scheme}, {boundary:?}", specimen.name);
        }
    }
}

/// Asserts that the picture of the parts has the bits of that of the whole.
fn assert_same_picture(engine: &Engine, cage: &Cage, scheme: Scheme, desc: &RenderDesc) {
    let surface = SurfaceDesc { scheme, ..SurfaceDesc::default() };
    let whole = Surface::new(engine, cage, &surface).unwrap();
    let expected = render(engine, &[&whole], desc).unwrap();
    let mut parts = parts(engine, cage, surface);
    assert!(parts.count() > 3);
    let found = parts.render(desc, |part| Ok::<_, EngineError>(part.surface().clone())).unwrap();
    // Lines are blended over each other, parts after parts, and rounding to bytes depends on the order.
    let most = if desc.shade == Shade::Wireframe { 2 } else { 0 };
    let largest = found.rgba.iter().zip(&expected.rgba).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
    assert!(largest <= most, "{largest}: {scheme}, {:?}, cage {}, {:?}", desc.shade, desc.cage, desc.tessellation);
}

#[test]
fn pictures_of_parts_are_those_of_the_whole() {
    let gpu = gpu();
    let shades = [Shade::Lit, Shade::Patches, Shade::Curvature, Shade::Wireframe];
    let names = ["dragon", "twohole", "ngon", "triangles", "shell", "star12"];
    for (number, name) in names.into_iter().enumerate() {
        let cage = zoo::shipped(name);
        let evaluator = [Evaluator::Tessellator, Evaluator::Compute][number / 2 % 2];
        let tessellation = Tessellation { evaluator, ..Tessellation::uniform(3.0) };
        let (shade, scheme) = (shades[number % 4], Scheme::ALL[number % Scheme::ALL.len()]);
        let desc = RenderDesc { shade, tessellation, cage: number % 2 == 1, ..RenderDesc::fit(&cage, [160, 120]) };
        assert_same_picture(&gpu, &cage, scheme, &desc);
    }
}

/// Factors of edges between parts follow from records that both have.
#[test]
fn pictures_with_adaptive_factors_are_those_of_the_whole() {
    let gpu = gpu();
    let cage = zoo::shipped("dragon");
    let desc = RenderDesc::fit(&cage, [160, 120]);
    for evaluator in [Evaluator::Tessellator, Evaluator::Compute] {
        let factors = Factors::Adaptive { pixels: 4.0, camera: desc.camera, height: 120 };
        let tessellation = Tessellation { factors, spacing: Spacing::Odd, evaluator };
        assert_same_picture(&gpu, &cage, Scheme::Gregory2, &RenderDesc { tessellation, ..desc });
    }
}

/// Cuts a cage with so many rings, some parts out of another cage.
fn sabotaged(cage: &Cage, other: &Cage, rings: u8, scheme: Scheme) -> CheckReport {
    let gpu = gpu();
    let sets = divide(cage, (0..cage.face_count() as u32).collect(), PARTS);
    let mut proof = PartsProof::new(cage, None);
    for (i, own) in sets.iter().enumerate() {
        let part = CagePart::cut(if i == 0 { other } else { cage }, own, rings);
        let part = Part::new(&gpu, part, &SurfaceDesc { scheme, ..SurfaceDesc::default() }).unwrap();
        proof.add(&part, part.surface(), &Tessellation::uniform(3.0)).unwrap();
    }
    proof.finish()
}

#[test]
fn parts_with_too_few_rings_are_noticed() {
    // It has bicubic patches beside others, and which of these a face becomes depends on all that surrounds it.
    let cage = zoo::shipped("dragon");
    let sound = sabotaged(&cage, &cage, CagePart::RINGS, Scheme::Gregory1);
    assert!(sound.is_watertight(), "{sound:?}");
    let report = sabotaged(&cage, &cage, 1, Scheme::Gregory1);
    assert!(report.split_positions > 0 && report.split_normals > 0 && !report.is_watertight(), "{report:?}");
    let cage = zoo::shipped("cube");
    for &scheme in Scheme::ALL {
        let report = sabotaged(&cage, &cage, 0, scheme);
        assert!(report.open > 0, "{scheme}: {report:?}");
    }
}

/// The same cage with a vertex more, far away: the same positions, in other coordinates.
#[test]
fn parts_in_another_space_are_noticed() {
    let cage = zoo::shipped("twohole");
    let first = cage.vertex_count() as u32;
    let far = [DVec3::splat(3.0), DVec3::new(4.0, 3.1, 3.0), DVec3::new(3.0, 4.0, 3.3)];
    let desc = CageDesc {
        positions: [cage.positions(), &far].concat(),
        face_offsets: [cage.face_offsets(), &[cage.face_vertices().len() as u32 + 3]].concat(),
        face_vertices: [cage.face_vertices(), &[first, first + 1, first + 2]].concat(),
        ..CageDesc::default()
    };
    let other = Cage::new(desc).unwrap();
    // Which refines no cage of quads and triangles, so that nothing but the space differs.
    let report = sabotaged(&cage, &other, CagePart::RINGS, Scheme::Gregory1);
    assert!(report.split_positions > 0 && !report.is_watertight(), "{report:?}");
}

/// A part that is left out, and one that comes twice.
#[test]
fn missing_and_repeated_parts_are_noticed() {
    let gpu = gpu();
    let cage = zoo::shipped("cube");
    let mut parts = parts(&gpu, &cage, SurfaceDesc::default());
    for repeats in [0, 2] {
        let mut proof = PartsProof::new(&cage, None);
        parts
            .for_each(|part| {
                let times = if part.number().0 == 1 { repeats } else { 1 };
                (0..times).try_for_each(|_| proof.add(part, part.surface(), &Tessellation::uniform(1.0)))
            })
            .unwrap();
        let report = proof.finish();
        assert!(report.wrong_patches > 0, "{report:?}");
        assert!(if repeats == 0 { report.open > 0 } else { report.over_shared > 0 }, "{report:?}");
    }
}

/// A displaced surface takes texture coordinates of shared edges from one side, which may lie in another part.
#[test]
fn displaced_parts_meet() {
    let gpu = gpu();
    let (cage, map) = (mapped::torn(&zoo::shipped("twohole")), mapped::rough());
    let tessellation = Tessellation::uniform(4.0);
    let mut proof = PartsProof::new(&cage, None);
    parts(&gpu, &cage, SurfaceDesc::default())
        .for_each(|part| {
            let displacement = Displacement { map: &map, scale: 0.05, bias: 0.0, placement: MapPlacement::default() };
            let desc = MapsDesc { origin: UvOrigin::Bottom, displacement: Some(displacement), coloring: None };
            let surface = part.surface().with_maps(part.cage().cage(), &desc)?;
            proof.add(part, &surface, &tessellation)
        })
        .unwrap();
    let report = proof.finish();
    assert!(report.is_watertight(), "{report:?}");
}

/// llvmpipe lets a shader see 128 MiB of a buffer, which 768 bytes of edge records for each quad fill with 174 762 quads.
#[test]
fn a_cage_beyond_the_device_s_limit_becomes_parts() {
    let gpu = gpu();
    let device: &Device = gpu.device();
    let limit = device.info().limits.max_storage_buffer_range;
    let side = 420;
    let cage = zoo::grid(side, side);
    let expects_parts = (side * side) as u64 * 768 > limit;
    match WholeOrParts::new(&gpu, &cage, &PartsDesc::default()).unwrap() {
        WholeOrParts::Whole(surface) => assert!(!expects_parts, "{} bytes in one buffer", surface.bytes()),
        WholeOrParts::Parts(parts) => assert!(expects_parts && parts.count() < 4, "{} parts", parts.count()),
    }
    // A fourth of the records, of most faces, fits.
    let needed = SurfaceDesc { refinement: Refinement::WhereNeeded, ..SurfaceDesc::default() };
    let made = WholeOrParts::new(&gpu, &cage, &PartsDesc { surface: needed, most_faces: None }).unwrap();
    assert!(matches!(made, WholeOrParts::Whole(_)));
}
