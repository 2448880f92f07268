//! Mean and Gaussian curvature as the evaluation stages measure them, read from captured vertices whose normal a changed shader replaces by the curvature.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};
use osculate::{
    BoundaryRule, Cage, CapturedVertex, Engine, EngineError, Place, Scheme, Surface, SurfaceDesc, Tessellation,
};
use osculate_surface::jet::{Curvature, Jet};
use osculate_surface::reference::{Boundary, Mesh, Reference};
use osculate_tests::formula::{self, Formula};
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::{Gpu, gpu_with_shaders, zoo};

/// A device whose captured vertices carry (mean, Gaussian) curvature, in cage space, in place of the first two numbers of the normal.
fn curvature_gpu() -> Gpu {
    gpu_with_shaders(mutated(&[Mutation {
        path: "include/evaluation_stage.glsl",
        from: "out_normal = point.normal;",
        to: "out_normal = vec3(shade_curvature(patch_id, uv), 0.0);",
    }]))
}

fn surface(engine: &Engine, cage: &Cage, scheme: Scheme) -> Surface {
    Surface::new(engine, cage, &SurfaceDesc { scheme, ..SurfaceDesc::default() }).unwrap()
}

fn captured(surface: &Surface, level: f32) -> Vec<CapturedVertex> {
    let mut all = Vec::new();
    surface
        .capture(&Tessellation::uniform(level), |vertices| {
            all.extend_from_slice(vertices);
            Ok::<(), EngineError>(())
        })
        .unwrap();
    all
}

fn measured(vertex: &CapturedVertex) -> Curvature {
    Curvature { mean: f64::from(vertex.normal[0]), gaussian: f64::from(vertex.normal[1]) }
}

/// What rounding to f32 may make of second derivatives that belong to a curvature `exact` on a patch of that size, in cage space, where lengths are about one:
/// control points are off by about an ulp, hence curvature by that over the square of the patch's narrower side.
fn assert_close(name: &str, found: Curvature, exact: Curvature, side: f64) {
    let [a, b] = exact.principal().map(f64::abs);
    let bent = a.max(b);
    let allowed = 2e-3 * bent + 1e-6 / (side * side);
    let (mean, gaussian) = ((found.mean - exact.mean).abs(), (found.gaussian - exact.gaussian).abs());
    assert!(mean < allowed, "{name}: mean {} for {}, allowed {allowed:e}", found.mean, exact.mean);
    let allowed = 2.0 * allowed * (bent + allowed);
    assert!(gaussian < allowed, "{name}: Gaussian {} for {}, allowed {allowed:e}", found.gaussian, exact.gaussian);
}

/// A dome, a bowl, a saddle and a trough of known curvature. The normal points upwards, so what bulges upwards has negative mean curvature.
#[test]
fn curvature_at_the_top_of_paraboloids() {
    let gpu = curvature_gpu();
    for curvatures in [[-1.0, -1.0], [3.0, 3.0], [2.0, -5.0], [0.0, 4.0], [-20.0, -6.0], [0.0, 0.0]] {
        let cage = zoo::paraboloid(curvatures);
        let surface = surface(&gpu, &cage, Scheme::Gregory2);
        let vertices = captured(&surface, 2.0);
        let at = surface.space().enter(DVec3::ZERO);
        let top = |vertex: &&CapturedVertex| {
            let [x, _, z] = vertex.position;
            vertex.uv == [0.5; 2] && (x - at.x).abs() < 1e-5 && (z - at.z).abs() < 1e-5
        };
        let found = measured(vertices.iter().find(top).expect("a vertex at the top"));
        // In cage space lengths are multiplied by the scale; the radius is the half diagonal there.
        let radius = cage.bounds().half_diagonal() * surface.space().scale;
        let [a, b] = curvatures.map(|k| k / radius);
        assert_close(
            &format!("{curvatures:?}"),
            found,
            Curvature { mean: (a + b) / 2.0, gaussian: a * b },
            0.1 * surface.space().scale,
        );
    }
}

/// The shorter derivative, shorter still where the two are not at right angles.
fn narrower_side(du: DVec3, dv: DVec3) -> f64 {
    du.cross(dv).length() / du.length().max(dv.length()).max(1e-30)
}

/// Every form against the second derivatives of the same patch in f64.
#[test]
fn curvature_is_that_of_the_generators() {
    let gpu = curvature_gpu();
    let names = ["star3", "star8", "star12", "shell", "twohole", "triangles"];
    for (name, &scheme) in names.iter().flat_map(|name| Scheme::ALL.iter().map(move |scheme| (name, scheme))) {
        let surface = surface(&gpu, &zoo::shipped(name), scheme);
        let formulas = formula::patches(&surface);
        let mut compared = 0;
        for vertex in captured(&surface, 5.0) {
            let [u, v] = vertex.uv.map(f64::from);
            let patch = &formulas[vertex.patch as usize];
            // At corners a Gregory patch has no one curvature.
            let blended = matches!(patch, Formula::Gregory(_) | Formula::Triangle(_));
            if blended && [u, v].iter().all(|&x| x == 0.0 || x == 1.0) {
                continue;
            }
            let jet = patch.frozen_jet(u, v);
            let Some(curvature) = jet.curvature() else { continue };
            let side = narrower_side(jet.du, jet.dv);
            assert_close(&format!("{name}, {scheme}, {:?}", vertex), measured(&vertex), curvature, side);
            compared += 1;
        }
        assert!(compared > 1000, "{name}, {scheme}: only {compared} vertices compared");
    }
}

/// Stam patches against differences of the derivatives of the reference, with which they share no code; boundaries and valences beyond 12 too.
#[test]
fn curvature_of_exact_patches_is_that_of_the_reference() {
    let gpu = curvature_gpu();
    let mut compared = 0;
    let cages = ["star5", "star12", "star32", "shell", "twohole", "ngon"].map(|name| (name, zoo::shipped(name)));
    for (name, cage) in cages.into_iter().chain([("fan", zoo::boundary_fan(6)), ("pillow", zoo::pillow())]) {
        let surface = surface(&gpu, &cage, Scheme::Stam);
        let mesh = Mesh::from(&cage);
        let reference = Reference::new(&mesh, Boundary::from(BoundaryRule::EdgeAndCorner)).unwrap();
        let scale = surface.space().scale;
        for vertex in captured(&surface, 4.0) {
            let Some(jet) = reference_jet(&reference, &surface, &vertex) else { continue };
            let Some(Curvature { mean, gaussian }) = jet.curvature() else { continue };
            let exact = Curvature { mean: mean / scale, gaussian: gaussian / (scale * scale) };
            let side = scale * narrower_side(jet.du, jet.dv);
            assert_close(&format!("{name}, {vertex:?}"), measured(&vertex), exact, side);
            compared += 1;
        }
    }
    assert!(compared > 9_000, "only {compared} vertices compared");
}

/// The jet over the patch's unit square by central differences; none on its sides, nor where Stam's sub-patches meet, whose third derivatives jump.
fn reference_jet(reference: &Reference<'_>, surface: &Surface, vertex: &CapturedVertex) -> Option<Jet> {
    const STEP: f64 = 1e-4;
    let [u, v] = vertex.uv.map(f64::from);
    if [u, v].iter().any(|&x| x == 0.0 || x == 1.0 || x == 0.5 || x == 0.25) {
        return None;
    }
    let at = |du: f64, dv: f64| {
        let Place { sub_face, st: [s, t], axes } = surface.place(vertex.patch, [u + du * STEP, v + dv * STEP]);
        let sample = reference.eval(sub_face.face as usize, sub_face.sub, s, t).unwrap();
        let along = |axis: [f64; 2]| sample.du * axis[0] + sample.dv * axis[1];
        (sample.position, axes.map(along))
    };
    let slope = |(_, before): (DVec3, [DVec3; 2]), (_, after): (DVec3, [DVec3; 2])| {
        [0, 1].map(|i| (after[i] - before[i]) / (2.0 * STEP))
    };
    let (position, [du, dv]) = at(0.0, 0.0);
    let ([duu, duv], [_, dvv]) = (slope(at(-1.0, 0.0), at(1.0, 0.0)), slope(at(0.0, -1.0), at(0.0, 1.0)));
    Some(Jet { position, du, dv, duu, duv, dvv })
}

/// The Gaussian curvature of a closed surface adds up to 2 pi times its Euler characteristic (Gauss and Bonnet), whatever its shape.
#[test]
fn total_curvature_tells_the_genus() {
    let gpu = curvature_gpu();
    for (name, euler) in [("cube", 2.0), ("torus", 0.0), ("twohole", -2.0), ("triangles", 2.0)] {
        let cage = zoo::shipped(name);
        for scheme in [Scheme::Stam, Scheme::Biseptic] {
            let surface = surface(&gpu, &cage, scheme);
            let total: f64 = captured(&surface, 16.0).as_chunks::<3>().0.iter().map(total_of_triangle).sum();
            let error = (total / TAU - euler).abs();
            assert!(error < 0.04, "{name}, {scheme}: {} for {euler}", total / TAU);
        }
    }
}

fn total_of_triangle(corners: &[CapturedVertex; 3]) -> f64 {
    let [a, b, c] = corners.map(|vertex| Vec3::from(vertex.position).as_dvec3());
    let mean = corners.iter().map(|vertex| measured(vertex).gaussian).sum::<f64>() / 3.0;
    mean * 0.5 * (b - a).cross(c - a).length()
}
