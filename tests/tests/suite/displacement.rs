//! Displaced surfaces: no cracks along seams, normals of what is drawn, pictures.

use std::collections::HashMap;

use glam::Vec3;
use osculate::{
    Cage, Camera, CapturedVertex, EngineError, Evaluator, Factors, RenderDesc, Scheme, Shade, Spacing, Surface,
    Tessellation, check, render,
};
use osculate_tests::mapped::{displaced, from_above, heights, painted, rough, scales, torn};
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::picture::{Gallery, camera, draw_surfaces};
use osculate_tests::{exact, gpu, gpu_with_shaders, surface_of, zoo};

const EVALUATORS: [Evaluator; 2] = [Evaluator::Tessellator, Evaluator::Compute];

fn cages() -> Vec<(&'static str, Cage)> {
    let shipped = ["ngon", "shell", "triangles"].map(|name| (name, zoo::shipped(name)));
    shipped.into_iter().chain([("boundary fan", zoo::boundary_fan(6))]).collect()
}

fn adaptive(cage: &Cage) -> Tessellation {
    let factors = Factors::Adaptive { pixels: 8.0, camera: Camera::fit(cage.bounds()), height: 256 };
    Tessellation { factors, spacing: Spacing::Odd, ..Tessellation::default() }
}

#[test]
fn every_edge_may_be_a_seam() {
    let gpu = gpu();
    let map = rough();
    for (number, (name, cage)) in cages().into_iter().enumerate() {
        let cage = torn(&cage);
        for (turn, &scheme) in Scheme::ALL.iter().enumerate() {
            let size = cage.bounds().half_diagonal();
            let surface = displaced(&gpu, &cage, scheme, &map, 0.2 * size, -0.05 * size);
            let compute = Tessellation { evaluator: Evaluator::Compute, ..Tessellation::uniform(3.0) };
            let tessellator = Tessellation { evaluator: Evaluator::Tessellator, ..compute };
            let tessellations = [
                tessellator,
                compute,
                Tessellation { factors: Factors::Uniform(2.7), spacing: Spacing::Even, ..compute },
                Tessellation { evaluator: Evaluator::Tessellator, ..adaptive(&cage) },
                Tessellation { evaluator: Evaluator::Compute, ..adaptive(&cage) },
            ];
            // Two of them for each, in turn.
            for tessellation in tessellations.iter().cycle().skip(number + 2 * turn).take(2) {
                let report = check(&surface, tessellation).unwrap();
                assert!(report.is_watertight(), "{name}, {scheme}, {tessellation:?}: {report:?}");
                assert_eq!((report.split_positions, report.weld.open), (0, 0), "{name}, {scheme}: {report:?}");
            }
        }
    }
}

/// The mistake that others make: each patch moves its border by its own side of a seam.
#[test]
fn borders_moved_by_the_patches_own_coordinates_are_noticed() {
    let gpu = gpu_with_shaders(mutated(&[Mutation {
        path: "include/displacement.glsl",
        from: "return displaced_on_edge(base, edge >> 1u, edge_parameter(side, edge & 1u, uv));",
        to: "return displaced(base, Chart(inner.du, inner.dv, patch_uv_at(id, uv), vec2(0.0), vec2(0.0)), 1.0);",
    }]));
    let cage = torn(&zoo::shipped("cube"));
    let surface = displaced(&gpu, &cage, Scheme::Gregory2, &rough(), 0.2, 0.0);
    let report =
        check(&surface, &Tessellation { evaluator: Evaluator::Tessellator, ..Tessellation::uniform(4.0) }).unwrap();
    assert!(report.split_positions > 0 && report.open > 0, "{report:?}");
}

/// And a level of the map that depends on the patch.
#[test]
fn borders_looked_up_in_the_patches_own_level_are_noticed() {
    let gpu = gpu_with_shaders(mutated(&[Mutation {
        path: "include/displacement.glsl",
        from: "return displaced_on_edge(base, edge >> 1u, edge_parameter(side, edge & 1u, uv));",
        to: "base = displaced_on_edge(base, edge >> 1u, edge_parameter(side, edge & 1u, uv)); base.position *= 1.0 + 1e-6 * texels_inside(id, vec2(0.5)); return base;",
    }]));
    let cage = torn(&zoo::shipped("cube"));
    let surface = displaced(&gpu, &cage, Scheme::Gregory2, &rough(), 0.2, 0.0);
    let report =
        check(&surface, &Tessellation { evaluator: Evaluator::Tessellator, ..Tessellation::uniform(4.0) }).unwrap();
    assert!(report.open > 0, "{report:?}");
}

fn level(level: f32) -> Tessellation {
    Tessellation { evaluator: Evaluator::Compute, ..Tessellation::uniform(level) }
}

#[test]
fn a_flat_map_moves_along_the_normal_and_leaves_it() {
    let gpu = gpu();
    let cage = torn(&zoo::shipped("star5"));
    let plain = surface_of(&gpu, &cage, Scheme::Gregory2, None).unwrap();
    let moved = displaced(&gpu, &cage, Scheme::Gregory2, &heights(4, |_, _| 0.5), 0.4, -0.1);
    let by = 0.1 * plain.space().scale as f32;
    let (from, to) = (exact::captured(&plain, &level(4.0)), exact::captured(&moved, &level(4.0)));
    assert_eq!(from.len(), to.len());
    for (from, to) in from.iter().zip(&to) {
        assert_eq!((from.patch, from.uv), (to.patch, to.uv));
        let expected = Vec3::from(from.position) + by * Vec3::from(from.normal);
        assert!((Vec3::from(to.position) - expected).length() < 1e-5, "{from:?}, {to:?}");
        assert!((Vec3::from(to.normal) - Vec3::from(from.normal)).length() < 1e-5, "{from:?}, {to:?}");
    }
}

#[test]
fn without_heights_no_bit_changes() {
    let gpu = gpu();
    let cage = torn(&zoo::shipped("cube"));
    let plain = surface_of(&gpu, &cage, Scheme::Stam, None).unwrap();
    let mapped = plain.with_maps(&cage, &osculate::MapsDesc::default()).unwrap();
    for evaluator in EVALUATORS {
        let tessellation = Tessellation { evaluator, ..Tessellation::uniform(3.0) };
        assert!(exact::captured(&plain, &tessellation) == exact::captured(&mapped, &tessellation));
    }
}

/// The direction across the differences of positions over a patch, of second order at its border too.
fn differences(grid: &HashMap<[i32; 2], CapturedVertex>, at: [i32; 2], n: i32) -> Vec3 {
    let along = |axis: usize| {
        let place = |i: i32| {
            let mut place = at;
            place[axis] = i;
            Vec3::from(grid[&place].position)
        };
        match at[axis] {
            0 => 4.0 * place(1) - place(2) - 3.0 * place(0),
            i if i == n => 3.0 * place(n) + place(n - 2) - 4.0 * place(n - 1),
            i => place(i + 1) - place(i - 1),
        }
    };
    along(0).cross(along(1)).normalize()
}

/// The vertices of each patch by their place in its grid.
fn grids(vertices: &[CapturedVertex], n: i32) -> impl Iterator<Item = HashMap<[i32; 2], CapturedVertex>> {
    let place = move |vertex: &CapturedVertex| vertex.uv.map(|x| (x * n as f32).round() as i32);
    let patches = vertices.chunk_by(|a, b| a.patch == b.patch);
    patches.map(move |patch| patch.iter().map(|vertex| (place(vertex), *vertex)).collect())
}

/// The largest angle between a normal and the direction across differences.
fn worst_normal(vertices: &[CapturedVertex], n: i32) -> f32 {
    let of_patch = |grid: HashMap<[i32; 2], CapturedVertex>| {
        grid.iter()
            .map(|(&at, vertex)| differences(&grid, at, n).angle_between(vertex.normal.into()))
            .fold(0.0, f32::max)
    };
    grids(vertices, n).map(of_patch).fold(0.0, f32::max)
}

/// The largest curvature of a section: the angle between the normals of neighbours by their distance.
fn sharpest(vertices: &[CapturedVertex], n: i32) -> f32 {
    let between = |a: &CapturedVertex, b: &CapturedVertex| {
        let distance = Vec3::from(a.position).distance(b.position.into());
        if distance > 0.0 { Vec3::from(a.normal).angle_between(b.normal.into()) / distance } else { 0.0 }
    };
    let of_patch = |grid: HashMap<[i32; 2], CapturedVertex>| {
        let neighbours = |&[x, y]: &[i32; 2]| [[x + 1, y], [x, y + 1], [x + 1, y + 1]];
        let around = |(at, a): (&[i32; 2], &CapturedVertex)| {
            neighbours(at).iter().filter_map(|to| Some(between(a, grid.get(to)?))).fold(0.0, f32::max)
        };
        grid.iter().map(around).fold(0.0, f32::max)
    };
    grids(vertices, n).map(of_patch).fold(0.0, f32::max)
}

/// What the height times the curvature would add is left out: that tangents along a principal direction of curvature k become 1 - k h times as long. With it,
/// the normal's parts along both directions would be divided by that, and its part along the old normal would stay. A symmetric matrix with eigenvalues from a
/// to b turns no vector by more than asin((b - a) / (b + a)) (H. Wielandt's angle); here that is asin(k h) at most (docs/displacement.md).
#[test]
fn normals_of_curved_surfaces_are_off_by_no_more_than_is_said() {
    let gpu = gpu();
    let cage = from_above(&zoo::grid(4, 4));
    let map = heights(64, |u, v| 0.5 + 0.5 * (9.0 * u).sin() * (11.0 * v).cos());
    let n = 32;
    let plain = surface_of(&gpu, &cage, Scheme::Gregory2, None).unwrap();
    let curvature = sharpest(&exact::captured(&plain, &level(n as f32)), n);
    for scale in [0.25, -0.25] {
        let surface = displaced(&gpu, &cage, Scheme::Gregory2, &map, scale, 0.0);
        let worst = worst_normal(&exact::captured(&surface, &level(n as f32)), n);
        let kh = curvature * (scale.abs() * plain.space().scale) as f32;
        let bound = kh.asin();
        assert!(kh < 0.5 && worst < bound + 0.01, "{scale}: normals are off by {worst}, at most {bound} is said");
        assert!(worst > 0.1 * bound, "{scale}: a map this flat shows nothing: {worst} of {bound}");
    }
}

/// Normals are those of the triangles in the limit, up to what the height times the curvature adds: inside, on edges and at vertices.
#[test]
fn normals_are_those_of_the_displaced_surface() {
    let gpu = gpu();
    let cage = from_above(&zoo::grid(4, 4));
    let map = heights(64, |u, v| (9.0 * u).sin() * (11.0 * v).cos());
    for (scheme, n) in [(Scheme::Gregory2, 32), (Scheme::Gregory1, 64)] {
        let surface = displaced(&gpu, &cage, scheme, &map, 0.08, 0.0);
        let flat = surface_of(&gpu, &cage, scheme, None).unwrap();
        let plain = exact::captured(&flat, &level(n as f32));
        let vertices = exact::captured(&surface, &level(n as f32));
        let worst = worst_normal(&vertices, n);
        let mut bent = 0f32;
        for (from, to) in plain.iter().zip(&vertices) {
            bent = bent.max(Vec3::from(from.normal).angle_between(to.normal.into()));
        }
        assert!(bent > 0.15, "{scheme}: the map bends normals by {bent} only");
        assert!(worst < 0.12 * bent, "{scheme}: normals are off by {worst}, the map bends them by {bent}");
    }
}

/// A fine tessellation sees the finest level, a coarse one means.
#[test]
fn coarse_tessellations_see_means_of_the_map() {
    let gpu = gpu();
    let cage = from_above(&zoo::grid(1, 1));
    // Two texels a wave: what single texels say to a coarse grid is anything from 0 to 1.
    let map = heights(256, |u, _| f64::from((u * 256.0) as u32 % 2));
    let surface = displaced(&gpu, &cage, Scheme::Gregory2, &map, 1.0, 0.0);
    let plain = surface_of(&gpu, &cage, Scheme::Gregory2, None).unwrap();
    let (from, to) = (exact::captured(&plain, &level(4.0)), exact::captured(&surface, &level(4.0)));
    for (from, to) in from.iter().zip(&to) {
        let height = (Vec3::from(to.position) - Vec3::from(from.position)).length() / surface.space().scale as f32;
        assert!((height - 0.5).abs() < 1e-3, "{height} at {:?}", to.uv);
    }
}

#[test]
fn what_needs_texture_coordinates_says_so() {
    let gpu = gpu();
    let cage = zoo::shipped("cube");
    let surface = surface_of(&gpu, &cage, Scheme::Gregory2, None).unwrap();
    let desc = RenderDesc { shade: Shade::Uv, ..RenderDesc::fit(&cage, [8, 8]) };
    assert!(matches!(render(&gpu, &[&surface], &desc), Err(EngineError::NotMapped { shade: "uv" })));
    assert!(matches!(surface.with_maps(&cage, &osculate::MapsDesc::default()), Err(EngineError::NoUv)));
}

fn portrait(gpu: &osculate::Engine, surface: &Surface, cage: &Cage, shade: Shade) -> osculate_compare::Picture {
    let desc = RenderDesc {
        shade,
        camera: camera(cage, [0.9, 0.5, 1.2], 1.8, 45.0),
        tessellation: Tessellation::uniform(16.0),
        ..RenderDesc::fit(cage, [192, 192])
    };
    draw_surfaces(gpu, &[surface], &desc)
}

#[test]
fn pictures_are_their_goldens() {
    let gpu = gpu();
    let mut gallery = Gallery::new(&gpu);
    let dragon = zoo::shipped("dragon");
    let map = scales(1024, 90.0);
    let surface = painted(&gpu, &dragon, &map, 0.035, [[38, 60, 44], [176, 190, 120]]);
    for shade in [Shade::Textured, Shade::Uv] {
        gallery.check(&format!("displaced_dragon_{}", shade.name()), &portrait(&gpu, &surface, &dragon, shade));
    }
    gallery.finish();
}
