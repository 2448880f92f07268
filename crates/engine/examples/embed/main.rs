//! The library in a renderer that has Vulkan objects of its own: `cargo run --release -p osculate --example embed -- --help`. docs/embedding.md walks through it.
#![allow(unsafe_code, reason = "programs with Vulkan objects of their own call Vulkan")]

#[path = "../common/mod.rs"]
mod common;
mod frames;
mod vulkan;

use std::f64::consts::TAU;
use std::process::ExitCode;

use bytemuck::{bytes_of, cast_slice};
use common::{Arguments, Result, expect_no_messages, run, write_png};
use frames::Frames;
use glam::{DAffine3, DQuat, DVec3};
use osculate::gpu::ash::vk;
use osculate::gpu::{Attachments, Bindings, BufferUsage, CallerSetLayout, Recording};
use osculate::{
    Cage, Camera, Culling, Engine, Factors, Instance, InstanceDesc, Material, MaterialDesc, Surface, SurfaceDesc,
    Tessellation, Varying, View, shader_include,
};
use osculate_shader_compiler::{CompileDesc, compile};
use vulkan::{COLOR, DEPTH, Vulkan};

const HELP: &str = "\
A renderer with an instance, a device, a queue, images and a descriptor set of its own draws several instances of one or more cages by a fragment shader of
its own, two frames under way at any time. The first cage moves; another one in its shape stands still beside it and shares its tables. Writes the last frame.

usage: embed CAGE.. [-o PICTURE.png] [--frames N] [--width W] [--height H] [--validation]
  -o PATH        where to write; default embed.png
  --frames N     frames before the picture is written; default 6
  --width W      default 640
  --height H     default 400
  --validation   fail if the validation layer has anything to say";

fn main() -> ExitCode {
    run(|| match Arguments::read(HELP, "embed.png")? {
        Some(arguments) => embed(&arguments),
        None => Ok(()),
    })
}

/// What the renderer's shader reads from its own set: lights, eye and fog (`surface.frag`).
type Lights = [[f32; 4]; 4];

const FOG: [f32; 4] = [0.045, 0.060, 0.085, 0.018];

fn embed(arguments: &Arguments) -> Result<()> {
    let size = [arguments.number("--width", 640), arguments.number("--height", 400)];
    let vulkan = Vulkan::new(arguments.validation)?;
    let eye = DVec3::new(0.6, 3.4, 7.6);
    let view = View::of(&camera(eye), size);
    let mut uniform = vulkan.host_buffer(size_of::<Lights>(), vk::BufferUsageFlags::UNIFORM_BUFFER)?;
    uniform.bytes().copy_from_slice(bytes_of(&lights(eye)));
    let scene = vulkan.scene(&uniform)?;
    let mut frames = Frames::new(&vulkan, size)?;
    {
        // SAFETY: the block ends before anything of `vulkan` goes, and this is the only thread.
        let device = unsafe { vulkan.lend()? };
        let engine = Engine::new(device.clone());
        // SAFETY: the layout outlives the material and its pipelines, and the shader agrees with it.
        let layout = unsafe { CallerSetLayout::new(scene.layout) };
        let material = material(&engine, layout)?;
        let mut stage = Stage::new(&engine, &material, arguments, &view)?;
        for number in 0..arguments.number("--frames", 6).max(1) {
            frames.draw(&vulkan, &device, scene.set, |recording| stage.advance(number, &view, recording))?;
        }
        let picture = frames.finish(&vulkan)?;
        write_png(&arguments.output, size, &picture)?;
        println!(
            "{}: {} instances of {} cages",
            arguments.output.display(),
            stage.instances.len(),
            arguments.files.len()
        );
    }
    let (pictures, buffers) = frames.take(&vulkan);
    vulkan.destroy(pictures, buffers.into_iter().chain([uniform]).collect(), scene);
    expect_no_messages(&vulkan.messages())
}

fn camera(eye: DVec3) -> Camera {
    Camera { eye, at: DVec3::new(0.25, 0.1, 0.0), up: DVec3::Y, fovy: 0.58, near: 0.5, far: 60.0 }
}

fn lights(eye: DVec3) -> Lights {
    let direction = |v: DVec3| v.normalize().as_vec3().extend(0.0).to_array();
    let (key, fill) = (DVec3::new(0.5, 0.9, 0.6), DVec3::new(-0.7, 0.5, 0.2));
    [direction(key), direction(fill), eye.as_vec3().extend(1.0).to_array(), FOG]
}

/// The renderer's shader, compiled with the library's header, for the renderer's attachments.
fn material(engine: &Engine, layout: CallerSetLayout) -> Result<Material> {
    let load = |path: &str| shader_include(path).map(str::to_owned);
    let source = include_str!("surface.frag");
    let spirv = compile(&CompileDesc { include_dirs: &[""], load: &load, ..CompileDesc::new("surface.frag", source) })?;
    // SAFETY: the shader needs no feature but what every device has.
    let fragment = unsafe { engine.device().caller_shader("surface.frag", &spirv)? };
    let desc = MaterialDesc {
        name: "painted",
        fragment: Some(&fragment),
        attachments: Attachments { colors: &[COLOR], depth: DEPTH, ..Attachments::default() },
        varying: Varying::Patch,
        caller_set: Some(layout),
        ..MaterialDesc::default()
    };
    Ok(Material::new(engine, &desc)?)
}

/// All that stands in the world.
struct Stage {
    /// The first cage, which moves: its surface, and its vertices at rest.
    moving: Surface,
    rest: Vec<DVec3>,
    instances: Vec<Standing>,
}

/// An instance and where it stands; it turns about itself.
struct Standing {
    instance: Instance,
    place: DVec3,
    scale: f64,
    turn: f64,
}

impl Stage {
    fn new(engine: &Engine, material: &Material, arguments: &Arguments, view: &View) -> Result<Self> {
        let cages: Vec<Cage> =
            arguments.files.iter().map(|file| Cage::read(file)).collect::<std::result::Result<_, _>>()?;
        let surfaces: Vec<Surface> = cages
            .iter()
            .map(|cage| Surface::new(engine, cage, &SurfaceDesc::default()))
            .collect::<std::result::Result<_, _>>()?;
        let rest = cages[0].positions().to_vec();
        // The same tables, another pose.
        let twin = surfaces[0].twin(&rest)?;
        let mut instances = Vec::new();
        for i in 0..3 * surfaces.len() + 1 {
            let kind = i % surfaces.len();
            let surface = if i == surfaces.len() { &twin } else { &surfaces[kind] };
            let paint = paint(i);
            let faces = engine.device().upload("faces", BufferUsage::STORAGE, &surface.patch_faces())?;
            let bounds = cages[kind].bounds();
            let scale = [1.5, 1.15, 1.3][i % 3] / bounds.half_diagonal();
            let adaptive = Factors::Adaptive { pixels: 7.0, camera: camera(DVec3::Z), height: view.size[1] };
            let desc = InstanceDesc {
                tessellation: Tessellation { factors: adaptive, ..Tessellation::default() },
                culling: Culling::UNSEEN,
                bindings: Bindings::new().with(64, &faces),
                push: cast_slice(&paint).to_vec(),
                ..InstanceDesc::new(material, *view)
            };
            let instance = Instance::new(surface, &desc)?;
            instances.push(Standing { instance, place: place(i), scale, turn: [0.5, 0.9, 2.6][i % 3] });
        }
        Ok(Self { moving: surfaces[0].clone(), rest, instances })
    }

    /// Moves everything to a frame, and records what that takes; what is to be drawn then.
    fn advance(&mut self, frame: u32, view: &View, recording: &mut Recording) -> Result<Vec<osculate::gpu::Draw>> {
        let time = f64::from(frame) / 24.0;
        let wave = |p: &DVec3| *p * (1.0 + 0.06 * (TAU * time + 3.0 * p.y).sin());
        self.moving.record_points(recording, &self.rest.iter().map(wave).collect::<Vec<_>>())?;
        for one in &mut self.instances {
            let middle = one.instance.surface().space().centre;
            let turn = DQuat::from_rotation_y(one.turn + time);
            let stand = DAffine3::from_scale_rotation_translation(DVec3::splat(one.scale), turn, one.place);
            // Its draws may be others from now on: they are asked for anew in each frame.
            let _plan = one.instance.place(&(stand * DAffine3::from_translation(-middle)), view)?;
            one.instance.record(recording);
        }
        Ok(self.instances.iter().flat_map(|one| one.instance.draws()).cloned().collect())
    }
}

/// Rows of three from front to back.
fn place(i: usize) -> DVec3 {
    let (row, column) = (i / 3, i % 3);
    DVec3::new(2.2 * (column as f64 - 1.0) + 0.35 * row as f64, 0.15 * row as f64, 1.3 - 2.4 * row as f64)
}

/// Two colours of an instance; the fourth number of the second says how much of it its faces wear.
fn paint(i: usize) -> [[f32; 4]; 2] {
    const PAINTS: [[[f32; 4]; 2]; 4] = [
        [[0.62, 0.20, 0.10, 1.0], [0.62, 0.12, 0.07, 0.0]],
        [[0.30, 0.50, 0.55, 1.0], [0.80, 0.72, 0.50, 1.0]],
        [[0.16, 0.28, 0.55, 1.0], [0.10, 0.16, 0.30, 0.0]],
        [[0.42, 0.52, 0.22, 1.0], [0.82, 0.78, 0.62, 1.0]],
    ];
    PAINTS[i % PAINTS.len()]
}
