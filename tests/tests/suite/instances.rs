//! Instances with materials: what a renderer of somebody else's draws. Its own Vulkan objects are left to the example `embed` and the tests of `osculate-gpu`;
//! here draws go into passes of the library's device.

use std::f64::consts::TAU;

use glam::{DAffine3, DQuat, DVec3};
use osculate::gpu::{
    Attachments, Bindings, BufferUsage, ColorTarget, DepthTarget, Draw, Format, Image, ImageDesc, ImageUsage,
    Recording, RenderPass, Shader, ash::vk,
};
use osculate::{
    Cage, Camera, Culling, DrawPlan, Engine, EngineError, Evaluator, Factors, Instance, InstanceDesc, Material,
    MaterialDesc, RenderDesc, Scheme, Shade, Surface, SurfacePoint, Tessellation, Varying, View, render,
    shader_include,
};
use osculate_shader_compiler::{CompileDesc, compile};
use osculate_tests::{gpu, surface_of, zoo};

const SIZE: [u32; 2] = [96, 72];
const EVALUATORS: [Evaluator; 2] = [Evaluator::Tessellator, Evaluator::Compute];

/// Compiles a fragment shader that includes the library's header.
fn fragment(engine: &Engine, main: &str) -> Shader {
    let source = format!(
        "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"material.glsl\"\n\
         layout(location = 0) out vec4 color;\n{main}"
    );
    let load = |path: &str| shader_include(path).map(str::to_owned);
    let desc = CompileDesc { include_dirs: &[""], load: &load, ..CompileDesc::new("own.frag", &source) };
    engine.device().shader("own.frag", &compile(&desc).unwrap_or_else(|error| panic!("{error}"))).unwrap()
}

/// A material that draws to pictures of a format.
fn material(engine: &Engine, fragment: &Shader, format: Format, varying: Varying) -> Material {
    let colors = [format.vulkan()];
    let attachments = Attachments { colors: &colors, depth: vk::Format::D32_SFLOAT, ..Attachments::default() };
    let desc = MaterialDesc { fragment: Some(fragment), attachments, varying, ..MaterialDesc::default() };
    Material::new(engine, &desc).unwrap()
}

/// Colours as the library's shade of normals has them.
const NORMALS: &str = "
vec3 shade_decode(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045))); }
void main() { color = vec4(shade_decode(0.5 + 0.5 * shade_unit_or_zero(normal)), 1.0); }";

fn by(evaluator: Evaluator, factors: Factors) -> Tessellation {
    Tessellation { evaluator, factors, ..Tessellation::default() }
}

/// Runs the instances' passes and draws them, all texels cleared to a colour.
fn drawn(engine: &Engine, instances: &[&Instance], format: Format, clear: [f32; 4]) -> Vec<u8> {
    let image = |format, usage| {
        let usage = ImageUsage::TARGET | usage;
        engine.device().image(&ImageDesc { name: "own", size: SIZE, format, usage, ..ImageDesc::default() }).unwrap()
    };
    let (color, depth): (Image, Image) =
        (image(format, ImageUsage::COPY_SRC), image(Format::Depth32Float, ImageUsage::empty()));
    let mut recording = Recording::new();
    instances.iter().for_each(|instance| instance.record(&mut recording));
    let draws: Vec<Draw> = instances.iter().flat_map(|instance| instance.draws()).cloned().collect();
    recording.render(RenderPass {
        name: "own".to_owned(),
        color: Some(ColorTarget { image: color.clone(), clear: Some(clear), resolve: None }),
        depth: Some(DepthTarget { image: depth, clear: Some(1.0) }),
        viewport: SIZE.into(),
        area: None,
        draws,
    });
    let texels =
        engine.device().upload("texels", BufferUsage::STORAGE, &vec![0u8; color.byte_size() as usize]).unwrap();
    recording.copy_image_to_buffer(&color, &texels);
    engine.device().run(&recording).unwrap();
    engine.device().download(&texels, ..).unwrap()
}

fn cage_and_surface(engine: &Engine, name: &str) -> (Cage, Surface) {
    let cage = zoo::shipped(name);
    let surface = surface_of(engine, &cage, Scheme::default(), None).unwrap();
    (cage, surface)
}

/// A turn, a scale and a shift.
fn somewhere(scale: f64) -> DAffine3 {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7);
    DAffine3::from_scale_rotation_translation(DVec3::splat(scale), turn, DVec3::new(9.0, -4.0, 2.5))
}

/// The camera that sees a moved cage as `camera` sees it where it was.
fn carried(camera: &Camera, transform: &DAffine3, scale: f64) -> Camera {
    let point = |p| transform.transform_point3(p);
    let up = transform.transform_vector3(camera.up).normalize();
    Camera {
        eye: point(camera.eye),
        at: point(camera.at),
        up,
        near: camera.near * scale,
        far: camera.far * scale,
        ..*camera
    }
}

/// Share of pixels that differ by more than what rounding does.
fn differing(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let far = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 2);
    a.chunks(4).zip(b.chunks(4)).filter(|pair| far(*pair)).count() as f64 / (a.len() / 4) as f64
}

/// A shader of one's own shows what the library's does, where the cage stands in the file and anywhere else: matrices are rounded otherwise, so that a
/// few pixels on outlines may differ.
#[test]
fn materials_draw_what_shades_draw_wherever_the_surface_stands() {
    let gpu = gpu();
    let (cage, surface) = cage_and_surface(&gpu, "twohole");
    let shader = fragment(&gpu, NORMALS);
    let own = material(&gpu, &shader, Format::Rgba8Srgb, Varying::Nothing);
    let camera = Camera::fit(cage.bounds());
    for evaluator in EVALUATORS {
        for factors in [Factors::Uniform(4.0), Factors::Adaptive { pixels: 6.0, camera, height: SIZE[1] }] {
            let tessellation = by(evaluator, factors);
            let background = [0.0, 0.0, 0.0, 1.0];
            let fit = RenderDesc::fit(&cage, SIZE);
            let desc = RenderDesc { tessellation, shade: Shade::Normals, samples: 1, background, ..fit };
            let expected = render(&gpu, &[&surface], &desc).unwrap().rgba;
            for (world_from_own, scale) in [(DAffine3::IDENTITY, 1.0), (somewhere(1.0), 1.0), (somewhere(250.0), 250.0)]
            {
                let view = View::of(&carried(&camera, &world_from_own, scale), SIZE);
                let desc = InstanceDesc { tessellation, world_from_own, ..InstanceDesc::new(&own, view) };
                let instance = Instance::new(&surface, &desc).unwrap();
                let found = drawn(&gpu, &[&instance], Format::Rgba8Srgb, background);
                let share = differing(&found, &expected);
                assert!(share < 0.004, "{evaluator:?}, {factors:?}, scale {scale}: {share}");
            }
        }
    }
    // The measure measures: another shade is another picture.
    let lit = render(&gpu, &[&surface], &RenderDesc { samples: 1, ..RenderDesc::fit(&cage, SIZE) }).unwrap().rgba;
    let view = View::of(&camera, SIZE);
    let instance = Instance::new(&surface, &InstanceDesc::new(&own, view)).unwrap();
    assert!(differing(&drawn(&gpu, &[&instance], Format::Rgba8Srgb, [0.0; 4]), &lit) > 0.2);
}

/// Every texel holds the point of the world that it shows: the view takes it back to the texel. Under a transform that scales directions differently, too; and
/// normals stand upright on what is seen, as differences between neighbours say.
#[test]
fn world_positions_and_normals_are_those_of_the_world() {
    let gpu = gpu();
    let (cage, surface) = cage_and_surface(&gpu, "torus");
    let places = fragment(&gpu, "void main() { color = vec4(shade_world_position(), 1.0); }");
    let normals = fragment(&gpu, "void main() { color = vec4(shade_world_normal(), 1.0); }");
    let uneven = somewhere(2.0) * DAffine3::from_scale(DVec3::new(1.0, 0.6, 1.7));
    let camera = Camera { fovy: 0.4, ..carried(&Camera::fit(cage.bounds()), &uneven, 2.0) };
    let view = View::of(&camera, SIZE);
    let clip = view.clip_from_view * view.view_from_world;
    let [points, normals] = [&places, &normals].map(|shader| {
        let own = material(&gpu, shader, Format::Rgba32Float, Varying::Nothing);
        let desc = InstanceDesc {
            world_from_own: uneven,
            tessellation: Tessellation::uniform(32.0),
            ..InstanceDesc::new(&own, view)
        };
        let instance = Instance::new(&surface, &desc).unwrap();
        let bytes = drawn(&gpu, &[&instance], Format::Rgba32Float, [0.0; 4]);
        bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&bytes)
    });
    let at = |texels: &[[f32; 4]], x: u32, y: u32| {
        let [px, py, pz, covered] = texels[(y * SIZE[0] + x) as usize];
        (covered == 1.0).then(|| DVec3::new(px.into(), py.into(), pz.into()))
    };
    let (mut seen, mut upright) = (0, 0);
    for (x, y) in (1..SIZE[1] - 1).flat_map(|y| (1..SIZE[0] - 1).map(move |x| (x, y))) {
        let Some(p) = at(&points, x, y) else { continue };
        let ndc = clip.project_point3(p);
        let back = (ndc.truncate() + 1.0) * 0.5 * glam::DVec2::new(SIZE[0].into(), SIZE[1].into());
        assert!(
            (back - glam::DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)).length() < 2e-3,
            "{back} at {x}, {y}"
        );
        seen += 1;
        let neighbours = [at(&points, x - 1, y), at(&points, x + 1, y), at(&points, x, y - 1), at(&points, x, y + 1)];
        if let [Some(left), Some(right), Some(above), Some(below)] = neighbours {
            let (across, down) = (right - left, below - above);
            let normal = at(&normals, x, y).unwrap();
            assert!((normal.length() - 1.0).abs() < 1e-5);
            // Away from outlines, where neighbours are neighbours on the surface.
            let close = 6.0 * (camera.eye - p).length() / f64::from(SIZE[1]);
            if across.length() < close && down.length() < close {
                let found = across.cross(down).normalize().dot(normal).abs();
                upright += u32::from(found > 0.97);
            }
        }
    }
    assert!(seen > 400, "{seen}");
    assert!(f64::from(upright) > 0.6 * f64::from(seen), "{upright} of {seen}");
}

/// The number of the patch and what varies on it are those of the point that is seen: the surface is there. By whatever else varies, the number stays.
#[test]
fn patches_and_their_parameters_reach_the_callers_shader() {
    let gpu = gpu();
    let (cage, surface) = cage_and_surface(&gpu, "ngon");
    let surface = &surface;
    let view = View::of(&Camera::fit(cage.bounds()), SIZE);
    let picture = |evaluator, main: &str, varying| {
        let own = material(&gpu, &fragment(&gpu, main), Format::Rgba32Float, varying);
        let tessellation = by(evaluator, Factors::Uniform(24.0));
        let instance = Instance::new(surface, &InstanceDesc { tessellation, ..InstanceDesc::new(&own, view) }).unwrap();
        bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&drawn(&gpu, &[&instance], Format::Rgba32Float, [0.0; 4]))
    };
    const PARAMETERS: &str = "void main() { color = vec4(float(patch_id), measure, 1.0); }";
    let positions = "void main() { color = vec4(shade_world_position(), 1.0); }";
    for evaluator in EVALUATORS {
        let (found, points) =
            (picture(evaluator, PARAMETERS, Varying::Patch), picture(evaluator, positions, Varying::Patch));
        let seen: Vec<usize> = (0..found.len()).filter(|&at| found[at][3] == 1.0).collect();
        assert!(seen.len() > 800);
        let at = |texel: [f32; 4]| {
            let place = surface.place(texel[0] as u32, [texel[1], texel[2]].map(|x| f64::from(x).clamp(0.0, 1.0)));
            let [s, t] = place.st.map(|x| x.clamp(0.0, 1.0));
            SurfacePoint { sub_face: place.sub_face, s, t }
        };
        let samples = surface.sample(&seen.iter().map(|&one| at(found[one])).collect::<Vec<_>>()).unwrap();
        for (&one, sample) in seen.iter().zip(&samples) {
            let [x, y, z, _] = points[one].map(f64::from);
            let distance = (sample.position - DVec3::new(x, y, z)).length();
            assert!(distance < 4e-3 * cage.bounds().half_diagonal(), "{evaluator:?}: {distance} at {:?}", found[one]);
        }
        let curved = picture(evaluator, PARAMETERS, Varying::Curvature);
        assert!(curved.iter().zip(&found).filter(|(a, b)| a[0] != b[0]).count() < 20, "{evaluator:?}");
        assert!(curved.iter().zip(&found).filter(|(a, b)| a[1] != b[1]).count() > 800, "{evaluator:?}");
    }
    let alone = picture(Evaluator::Tessellator, PARAMETERS, Varying::Nothing);
    let whole = picture(Evaluator::Tessellator, PARAMETERS, Varying::Patch);
    assert!(alone.iter().zip(&whole).all(|(a, b)| a[0] == b[0]));
}

/// Bindings and push constants are each instance's own.
#[test]
fn what_callers_bind_and_push_reaches_their_shader() {
    let gpu = gpu();
    let (cage, surface) = cage_and_surface(&gpu, "cube");
    let shader = fragment(
        &gpu,
        "layout(set = 0, binding = BINDING_CALLER) uniform Own { vec4 own; };
         layout(push_constant) uniform Push { layout(offset = MATERIAL_PUSH_OFFSET) vec4 pushed; };
         void main() { color = vec4(own.xy, pushed.zw); }",
    );
    let own = material(&gpu, &shader, Format::Rgba32Float, Varying::Nothing);
    assert_eq!(own.push_size(), 16);
    let view = View::of(&Camera::fit(cage.bounds()), SIZE);
    for evaluator in EVALUATORS {
        let instance = |x: f32, pushed: f32| {
            let buffer = gpu.device().upload("own", BufferUsage::UNIFORM, &[x, 2.0 * x, 0.0, 0.0]).unwrap();
            let desc = InstanceDesc {
                bindings: Bindings::new().with(64, &buffer),
                push: bytemuck::bytes_of(&[0.0, 0.0, pushed, 1.0f32]).to_vec(),
                tessellation: by(evaluator, Factors::Uniform(2.0)),
                ..InstanceDesc::new(&own, view)
            };
            Instance::new(&surface, &desc).unwrap()
        };
        for (x, pushed) in [(0.25, 3.0), (7.0, 5.0)] {
            let mut one = instance(x, pushed);
            let found = |one: &Instance| {
                let bytes = drawn(&gpu, &[one], Format::Rgba32Float, [0.0; 4]);
                let texels = bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&bytes);
                texels[(SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize]
            };
            assert_eq!(found(&one), [x, 2.0 * x, pushed, 1.0], "{evaluator:?}");
            one.set_push(bytemuck::bytes_of(&[0.0, 0.0, -1.0, -2.0f32])).unwrap();
            assert_eq!(found(&one), [x, 2.0 * x, -1.0, -2.0], "{evaluator:?}");
            assert!(one.set_push(&[0; 4]).unwrap_err().to_string().contains("16 bytes"));
        }
    }
}

/// Patches that cover nothing are left out of the picture without a trace, wherever the instance stands; with factors and culling frozen, another view shows
/// the same triangles.
#[test]
fn culling_follows_the_placement() {
    let gpu = gpu();
    let (cage, surface) = cage_and_surface(&gpu, "twohole");
    let shader = fragment(&gpu, NORMALS);
    let own = material(&gpu, &shader, Format::Rgba8Srgb, Varying::Patch);
    let near = Camera { fovy: 0.2, ..Camera::fit(cage.bounds()) };
    let world_from_own = somewhere(3.0);
    let view = View::of(&carried(&near, &world_from_own, 3.0), SIZE);
    let make = |culling| {
        let adaptive = Factors::Adaptive { pixels: 9.0, camera: near, height: 1 };
        let tessellation = by(Evaluator::Tessellator, adaptive);
        let desc = InstanceDesc { culling, tessellation, world_from_own, ..InstanceDesc::new(&own, view) };
        Instance::new(&surface, &desc).unwrap()
    };
    let [all, mut seen] = [Culling::NONE, Culling::UNSEEN].map(make);
    let picture = |one: &Instance| drawn(&gpu, &[one], Format::Rgba8Srgb, [0.0; 4]);
    assert!(picture(&all) == picture(&seen));
    seen.freeze_factors(true);
    let wide = View::of(&carried(&Camera::fit(cage.bounds()), &world_from_own, 3.0), SIZE);
    assert_eq!(seen.place(&world_from_own, &wide).unwrap(), DrawPlan::Kept);
    let cut = picture(&seen);
    seen.freeze_factors(false);
    let _kept = seen.place(&world_from_own, &wide).unwrap();
    let whole = picture(&seen);
    let covered = |texels: &[u8]| texels.chunks(4).filter(|texel| texel[3] > 0).count();
    assert!(covered(&cut) > 0 && covered(&cut) < covered(&whole) * 9 / 10, "{} {}", covered(&cut), covered(&whole));
}

/// A twin is what a surface of the moved cage is, bit for bit, and moving it leaves the other where it was. Instances take next to nothing.
#[test]
fn twins_and_instances_share_tables() {
    let gpu = gpu();
    let (cage, surface) = cage_and_surface(&gpu, "ngon");
    let before = surface.read_vertex_records().unwrap();
    let moved: Vec<DVec3> =
        cage.positions().iter().map(|&p| p * (1.0 + 0.1 * (TAU * p.x).sin()) + DVec3::new(0.0, 0.01, 0.0)).collect();
    let twin = surface.twin(&moved).unwrap();
    let mut other = surface_of(&gpu, &cage, Scheme::default(), None).unwrap();
    other.set_points(&moved).unwrap();
    let all = |one: &Surface| {
        let edges = one.read_edge_records().unwrap();
        (one.read_points().unwrap(), one.read_vertex_records().unwrap(), edges, one.read_coefficients().unwrap())
    };
    assert!(all(&twin) == all(&other), "the same numbers");
    assert!(twin.bytes() < other.bytes() * 2 / 3, "{} of {}", twin.bytes(), other.bytes());
    let mut recording = Recording::new();
    twin.record_points(&mut recording, cage.positions()).unwrap();
    gpu.device().run(&recording).unwrap();
    assert!(all(&twin) == all(&surface) && surface.read_vertex_records().unwrap() == before);
    let wrong = twin.record_points(&mut recording, &moved[1..]).unwrap_err();
    assert!(matches!(wrong, EngineError::PointCount { .. }), "{wrong}");
    assert!(matches!(surface.twin(&vec![DVec3::NAN; moved.len()]), Err(EngineError::NotFinite { vertex: 0 })));
    let faces = surface.patch_faces();
    assert_eq!(faces.len(), surface.plan().patches.len());
    let mut found: Vec<u32> = faces;
    found.sort_unstable();
    found.dedup();
    assert_eq!(found, (0..cage.face_count() as u32).collect::<Vec<_>>(), "every face has patches");
    let shader = fragment(&gpu, NORMALS);
    let own = material(&gpu, &shader, Format::Rgba8Srgb, Varying::Nothing);
    let view = View::of(&Camera::fit(cage.bounds()), SIZE);
    let desc = InstanceDesc {
        tessellation: by(Evaluator::Tessellator, Factors::Uniform(3.0)),
        ..InstanceDesc::new(&own, view)
    };
    assert!(Instance::new(&surface, &desc).unwrap().bytes() < 1024);
}

#[test]
fn instances_that_cannot_be_drawn_are_refused() {
    let gpu = gpu();
    let (cage, surface) = cage_and_surface(&gpu, "cube");
    let shader = fragment(&gpu, NORMALS);
    let own = material(&gpu, &shader, Format::Rgba8Srgb, Varying::Nothing);
    let camera = Camera::fit(cage.bounds());
    let view = View::of(&camera, SIZE);
    let fit = InstanceDesc::new(&own, view);
    let reason = |desc: &InstanceDesc<'_>| Instance::new(&surface, desc).map(drop).unwrap_err().to_string();
    let buffer = gpu.device().upload("own", BufferUsage::UNIFORM, &[0.0f32; 4]).unwrap();
    let found = reason(&InstanceDesc { bindings: Bindings::new().with(63, &buffer), ..fit.clone() });
    assert!(found.contains("binding 63") && found.contains("64"), "{found}");
    assert!(
        reason(&InstanceDesc { push: vec![0; 4], ..fit.clone() }).contains("0 bytes of push constants, 4 were given")
    );
    let mirror = DAffine3::from_scale(DVec3::new(1.0, -1.0, 1.0));
    assert!(reason(&InstanceDesc { world_from_own: mirror, ..fit.clone() }).contains("mirrors"));
    let adaptive = by(Evaluator::Auto, Factors::Adaptive { pixels: 8.0, camera, height: SIZE[1] });
    let uneven = DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0));
    let found = reason(&InstanceDesc { world_from_own: uneven, tessellation: adaptive, ..fit.clone() });
    assert!(found.contains("all directions alike"), "{found}");
    assert!(reason(&InstanceDesc { tessellation: Tessellation::uniform(65.0), ..fit.clone() }).contains("65"));
    let mapped = material(&gpu, &shader, Format::Rgba8Srgb, Varying::Texture);
    assert!(reason(&InstanceDesc { material: &mapped, ..fit.clone() }).contains("with_maps"));
    let other = Engine::new(gpu.device().clone());
    let foreign = material(&other, &shader, Format::Rgba8Srgb, Varying::Nothing);
    assert!(matches!(
        Instance::new(&surface, &InstanceDesc { material: &foreign, ..fit }),
        Err(EngineError::NoMaterial)
    ));
    let low = fragment(&gpu, "layout(push_constant) uniform Push { vec4 pushed; }; void main() { color = pushed; }");
    let desc = MaterialDesc { fragment: Some(&low), ..MaterialDesc::default() };
    let found = Material::new(&gpu, &desc).map(drop).unwrap_err().to_string();
    assert!(found.contains("begin at byte 32"), "{found}");
}
