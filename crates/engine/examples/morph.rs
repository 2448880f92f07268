//! A cage that changes its shape: `cargo run --release -p osculate --example morph -- --help`.

mod common;

use std::f64::consts::TAU;
use std::process::ExitCode;

use common::{Arguments, Result, expect_no_messages, frame_path, run, write_png};
use glam::DVec3;
use osculate::gpu::Prepared;
use osculate::{
    Animator, Cage, Device, Drawing, DrawingDesc, Engine, Recording, Surface, SurfaceDesc, Target, Targets,
};

const HELP: &str = "\
Draws a surface whose cage goes to another shape and back. Only the cage's vertices move, a few kilobytes; the surface follows on the device.
A glTF file with morph targets goes to each of them in turn, and the device moves its vertices. Other cages go to the positions of a second file with as many
vertices or, without one, become round, and the host moves them.

usage: morph CAGE [TARGET] [-o FRAME_%04d.png] [--frames N] [--width W] [--height H] [--samples N] [--validation]
  -o PATTERN     where to write; default morph_%04d.png
  --frames N     pictures of one way there and back; default 24
  --width W      default 640
  --height H     default 480
  --samples N    samples per pixel; default 4
  --validation   fail if the validation layer has anything to say";

fn main() -> ExitCode {
    run(|| match Arguments::read(HELP, "morph_%04d.png")? {
        Some(arguments) => morph(&arguments),
        None => Ok(()),
    })
}

/// Who moves the vertices.
enum Shape {
    /// The device, by the weights of morph targets.
    Targets(Box<Animator>),
    /// The host, between two sets of positions.
    Positions { from: Vec<DVec3>, to: Vec<DVec3> },
}

fn morph(arguments: &Arguments) -> Result<()> {
    let cage = Cage::read(&arguments.files[0])?;
    let device = Device::new(&arguments.device())?;
    let engine = Engine::new(device.clone());
    let surface = Surface::new(&engine, &cage, &SurfaceDesc::default())?;
    let mut shape = Shape::new(&surface, &cage, arguments)?;
    let fit = DrawingDesc::fit(&cage, [arguments.number("--width", 640), arguments.number("--height", 480)]);
    let target = Target { samples: arguments.number("--samples", 4), ..fit.target };
    let drawing = Drawing::new(&surface, &DrawingDesc { target, ..fit })?;
    let targets = Targets::new(&engine, fit.size, target)?;
    let mut frame = prepare(&device, &surface, &shape, &drawing, &targets)?;
    let count = arguments.number("--frames", 24);
    for number in 0..count {
        shape.set(&surface, f64::from(number) / f64::from(count))?;
        frame.run()?;
        let picture = targets.read(&engine, Recording::new())?;
        write_png(&frame_path(&arguments.output, number)?, fit.size, &picture)?;
    }
    println!("{count} pictures");
    expect_no_messages(&device.validation_messages())
}

/// A frame, checked and encoded once: move the vertices, bring the surface up to date, draw it.
fn prepare(
    device: &Device,
    surface: &Surface,
    shape: &Shape,
    drawing: &Drawing,
    targets: &Targets,
) -> Result<Prepared> {
    let mut recording = Recording::new();
    match shape {
        Shape::Targets(animator) => {
            animator.record(&mut recording)?;
            surface.record_derived(&mut recording)?;
        }
        Shape::Positions { .. } => surface.record_update(&mut recording)?,
    }
    drawing.record(&mut recording);
    recording.render(targets.pass(drawing.draws().to_vec(), Some([0.03, 0.037, 0.048, 1.0])));
    Ok(device.prepare(&recording)?)
}

impl Shape {
    fn new(surface: &Surface, cage: &Cage, arguments: &Arguments) -> Result<Self> {
        if cage.rig().is_some_and(|rig| rig.morph_sets.iter().any(|set| !set.targets.is_empty())) {
            return Ok(Self::Targets(Box::new(Animator::new(surface, cage)?)));
        }
        let from = cage.positions().to_vec();
        let to = match arguments.files.get(1) {
            Some(file) => Cage::read(file)?.positions().to_vec(),
            None => round(cage),
        };
        if from.len() != to.len() {
            return Err(format!("the cage has {} vertices, its target {}", from.len(), to.len()).into());
        }
        Ok(Self::Positions { from, to })
    }

    /// Sets the shape at a part of the way there and back.
    fn set(&mut self, surface: &Surface, part: f64) -> Result<()> {
        match self {
            Self::Targets(animator) => {
                let mut pose = animator.rig().rest();
                let count: usize = pose.morph_weights.iter().map(Vec::len).sum();
                let weights = pose.morph_weights.iter_mut().flatten();
                weights.enumerate().for_each(|(i, weight)| *weight = bump(part * count as f64 - i as f64));
                animator.set_pose(&pose)?;
            }
            Self::Positions { from, to } => {
                let points: Vec<DVec3> = from.iter().zip(to).map(|(a, b)| a.lerp(*b, bump(part))).collect();
                surface.write_points(&points)?;
            }
        }
        Ok(())
    }
}

/// From 0 to 1 and back, as time goes from 0 to 1; else 0.
fn bump(time: f64) -> f64 {
    if (0.0..1.0).contains(&time) { 0.5 - 0.5 * (TAU * time).cos() } else { 0.0 }
}

/// The vertices on a sphere about the middle of the cage.
fn round(cage: &Cage) -> Vec<DVec3> {
    let (middle, radius) = (cage.bounds().center(), 0.8 * cage.bounds().half_diagonal());
    cage.positions().iter().map(|p| middle + radius * (*p - middle).normalize_or_zero()).collect()
}
