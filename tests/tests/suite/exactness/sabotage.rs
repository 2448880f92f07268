//! Mistakes that leave no crack, for records are shared, but a surface in the wrong place: the comparisons of this folder notice them.

use osculate::{BoundaryRule, Cage, Engine, Evaluator, Scheme, Tessellation};
use osculate_shaders::layout::SampleRequest;
use osculate_subdiv::{PatchForm, twin};
use osculate_tests::exact::{captured, evaluate};
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::{Gpu, gpu, gpu_with_shaders, surface_of, zoo};

use super::biseptic::{biseptic_surface, difference_from_twin};
use super::sides::compare_normals;
use super::stam::exactness;

/// Closed cages, whose patches are all in lists but for the last, which has valence 2 as well.
fn closed() -> [(&'static str, Cage); 3] {
    [("twohole", zoo::shipped("twohole")), ("dragon", zoo::shipped("dragon")), ("pillow", zoo::pillow())]
}

/// Cages all of whose extraordinary patches are stored ones: a boundary, valence 2, valence 32.
fn stored() -> [(&'static str, Cage); 3] {
    [("shell", zoo::shipped("shell")), ("star32", zoo::shipped("star32")), ("fan", zoo::boundary_fan(6))]
}

fn with(path: &'static str, from: &'static str, to: &'static str) -> Gpu {
    gpu_with_shaders(mutated(&[Mutation { path, from, to }]))
}

/// A spoke's neighbour in the array: another curve, but the same for both patches.
fn with_wrong_spokes() -> Gpu {
    with("include/spokes.glsl", "- first_spoke_edge];", "- first_spoke_edge ^ 1u];")
}

/// The cubic record that every edge has.
fn with_cubic_spokes() -> Gpu {
    with("include/spokes.glsl", "return side == 0u || side == 3u;", "return false;")
}

fn is_exact(engine: &Engine, name: &str, cage: &Cage) -> bool {
    exactness(engine, name, cage, (Scheme::Stam, BoundaryRule::EdgeAndCorner), (6, &|_| true)).is_ok()
}

#[test]
fn another_record_on_spokes_of_exact_patches_is_noticed() {
    for gpu in [with_wrong_spokes(), with_cubic_spokes()] {
        for (name, cage) in closed().into_iter().chain(stored()) {
            assert!(!is_exact(&gpu, name, &cage), "{name}");
        }
    }
}

#[test]
fn another_record_on_spokes_of_biseptic_patches_is_noticed() {
    for gpu in [with_wrong_spokes(), with_cubic_spokes()] {
        for (name, cage) in closed() {
            let surface = biseptic_surface(&gpu, &cage);
            assert!(compare_normals(name, &cage, &surface, PatchForm::Biseptic).is_err(), "{name}");
        }
    }
}

/// Vectors of records and patches that are read from the wrong place, or weighed for the wrong level.
#[test]
fn wrong_vectors_of_exact_patches_are_noticed() {
    let form = "include/forms/stam.glsl";
    let mutations = [
        (
            form,
            "place.level, stored_vector(spoke.vectors + mode), coupled)",
            "place.level, stored_vector(spoke.vectors + mode - 1u), coupled)",
        ),
        (
            form,
            "vec3 dominant = stored_vector(spoke.vectors + 1u);",
            "vec3 dominant = stored_vector(spoke.vectors + 2u);",
        ),
        (form, "place.level, control(mode), coupled)", "place.level, control(mode - 1u), coupled)"),
        (form, "16u * modes * place.sub_patch;", "16u * modes * (2u - place.sub_patch);"),
        ("include/bases/stam.glsl", "return mode == 0u ? limit : r;", "return mode <= 1u ? limit : r;"),
    ];
    for (path, from, to) in mutations {
        let gpu = with(path, from, to);
        for (name, cage) in closed() {
            assert!(!is_exact(&gpu, name, &cage), "{name}, {from}");
        }
    }
}

/// At valence 2 and at boundaries two modes are coupled.
#[test]
fn lost_coupling_of_modes_is_noticed() {
    let gpu = with("include/forms/stam.glsl", "if (mode == 2u) {", "if (mode == 2u && false) {");
    for (name, cage) in [("pillow", zoo::pillow()), ("shell", zoo::shipped("shell"))] {
        assert!(!is_exact(&gpu, name, &cage), "{name}");
    }
}

#[test]
fn wrong_control_points_of_biseptic_patches_are_noticed() {
    let mutations = [
        (
            "include/forms/biseptic.glsl",
            "        row[j] = combine8(bu, p);\n        slope[j] = combine8_differences(qu, p);\n    }\n    precise",
            "        row[j] = combine8(bu, p);\n        slope[j] = combine8_differences(qu, p);\n    }\n    row[7] = row[6];\n    precise",
        ),
        ("sample/biseptic.comp", "return net_point_at(0u);", "return net_point_at(1u);"),
        ("include/bases/biseptic.glsl", "basis + point * net_size", "basis + (point ^ 1u) * net_size"),
    ];
    for (path, from, to) in mutations {
        let gpu = with(path, from, to);
        for name in ["twohole", "dragon"] {
            let difference = difference_from_twin(&biseptic_surface(&gpu, &zoo::shipped(name)));
            assert!(difference > 1e-4, "{name}, {path}: {difference:e}");
        }
    }
}

/// Largest distance between points as they are drawn and as they are sampled.
fn drawn_from_sampled(engine: &Engine, cage: &Cage, scheme: Scheme) -> f64 {
    let surface = surface_of(engine, cage, scheme, None).unwrap();
    let by_tessellator = Tessellation { evaluator: Evaluator::Tessellator, ..Tessellation::uniform(2.0) };
    let vertices = captured(&surface, &by_tessellator);
    let requests: Vec<SampleRequest> =
        vertices.iter().map(|v| SampleRequest { patch_id: v.patch, u: v.uv[0], v: v.uv[1] }).collect();
    let drawn = vertices.iter().map(|vertex| glam::Vec3::from(vertex.position).as_dvec3());
    let pairs = drawn.zip(evaluate(&surface, &requests));
    pairs.map(|(drawn, sampled)| (drawn - sampled.position).length()).fold(0.0, f64::max)
}

/// Stages that draw against the kernels that sample, which read control points on other ways.
#[test]
fn control_points_lost_between_stages_are_noticed() {
    let off = "stored_vector(patch_basis(patch_id).net + (i ^ 1u))";
    let read = "stored_vector(patch_basis(patch_id).net + i)";
    let mutations = [
        (Scheme::Stam, "patch/stored_stam.tese", read, off, stored()),
        (Scheme::Gregory2, "patch/stored_gregory.tese", read, off, stored()),
        (Scheme::Stam, "patch/stam.tese", "return control_point[i];", "return control_point[i ^ 1u];", closed()),
        (Scheme::Biseptic, "patch/biseptic.tese", "(i & 1u) == 0u ?", "(i & 1u) == 1u ?", closed()),
        (Scheme::Biseptic, "patch/biseptic.tesc", "origin = net_point_at(0u);", "origin = net_point_at(2u);", closed()),
    ];
    for (scheme, path, from, to, cages) in mutations {
        let (sound, gpu) = (gpu(), with(path, from, to));
        for (name, cage) in cages {
            let [before, after] = [&sound, &gpu].map(|engine| drawn_from_sampled(engine, &cage, scheme));
            assert!(before < 1e-6 && after > 1e-4, "{name}, {path}: {before:e}, {after:e}");
        }
    }
}

/// Whether the device's coefficients are those of the twin.
fn coefficients_agree(engine: &Engine, cage: &Cage) -> bool {
    let surface = surface_of(engine, cage, Scheme::Stam, None).unwrap();
    let points: Vec<glam::Vec3> = surface.read_points().unwrap().into_iter().map(glam::Vec3::from).collect();
    let twin = twin::coefficients(surface.plan(), &points);
    let device = surface.read_coefficients().unwrap();
    // Devices may contract products and sums, llvmpipe does not.
    let allowed = if engine.device().info().is_llvmpipe { 0.0 } else { 1e-6 };
    let same = |(a, b): (&[f32; 3], &glam::Vec3)| (glam::Vec3::from(*a) - b).length() <= allowed;
    device.len() == twin.len() && device.iter().zip(&twin).all(same)
}

#[test]
fn changes_of_the_coefficient_kernel_are_noticed() {
    let kernel = "records/coefficients.comp";
    let mut mutations = vec![
        (kernel, "row < source.absolute_rows ?", "row <= source.absolute_rows ?"),
        (kernel, "uint row = vector - source.first;", "uint row = vector - source.first ^ 1u;"),
        (kernel, "sources[middle].first <= vector", "sources[middle].first < vector"),
        (
            kernel,
            "row < source.absolute_rows ? point : difference;",
            "(row < source.absolute_rows ? point : difference).xzz;",
        ),
    ];
    let llvmpipe = gpu().device().info().is_llvmpipe;
    if llvmpipe {
        // Only bits tell that sums are not compensated.
        mutations.push(("include/bases/net.glsl", "lost = (next - sum) - term;", "lost = vec3(0.0);"));
    }
    for (path, from, to) in mutations {
        let gpu = with(path, from, to);
        for (name, cage) in closed().into_iter().chain(stored()) {
            assert!(coefficients_agree(&self::gpu(), &cage), "{name}");
            assert!(!coefficients_agree(&gpu, &cage), "{name}, {from}");
        }
    }
}
