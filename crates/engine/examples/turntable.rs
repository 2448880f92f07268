//! Pictures of a surface from all around, without a window: `cargo run --release -p osculate --example turntable -- --help`.

mod common;

use std::f64::consts::TAU;
use std::process::ExitCode;

use common::{Arguments, Result, expect_no_messages, frame_path, run, write_png};
use glam::DQuat;
use osculate::{
    Cage, Camera, Device, DrawPlan, Drawing, DrawingDesc, Engine, Recording, Surface, SurfaceDesc, Target, Targets,
};

const HELP: &str = "\
Draws a surface from all around, a picture for each of several steps of a turn. All that drawing takes stays on the device: a frame writes a view and runs
commands that were checked and encoded once.

usage: turntable CAGE [-o FRAME_%04d.png] [--frames N] [--width W] [--height H] [--samples N] [--validation]
  -o PATTERN     where to write; default turntable_%04d.png
  --frames N     steps of the turn; default 36
  --width W      default 640
  --height H     default 480
  --samples N    samples per pixel; default 4
  --validation   fail if the validation layer has anything to say";

fn main() -> ExitCode {
    run(|| match Arguments::read(HELP, "turntable_%04d.png")? {
        Some(arguments) => turntable(&arguments),
        None => Ok(()),
    })
}

fn turntable(arguments: &Arguments) -> Result<()> {
    let cage = Cage::read(&arguments.files[0])?;
    let device = Device::new(&arguments.device())?;
    let engine = Engine::new(device.clone());
    let surface = Surface::new(&engine, &cage, &SurfaceDesc::default())?;
    let fit = DrawingDesc::fit(&cage, [arguments.number("--width", 640), arguments.number("--height", 480)]);
    let target = Target { samples: arguments.number("--samples", 4), ..fit.target };
    let mut drawing = Drawing::new(&surface, &DrawingDesc { target, ..fit })?;
    let targets = Targets::new(&engine, fit.size, target)?;
    let mut frame = device.prepare(&record(&drawing, &targets))?;
    let count = arguments.number("--frames", 36);
    for number in 0..count {
        let camera = turned(&fit.camera, f64::from(number) / f64::from(count));
        if drawing.set_view(&camera, fit.size)? == DrawPlan::New {
            frame = device.prepare(&record(&drawing, &targets))?;
        }
        frame.run()?;
        let picture = targets.read(&engine, Recording::new())?;
        write_png(&frame_path(&arguments.output, number)?, fit.size, &picture)?;
    }
    println!("{count} pictures");
    expect_no_messages(&device.validation_messages())
}

/// What runs for each frame; the surface does not move.
fn record(drawing: &Drawing, targets: &Targets) -> Recording {
    let mut recording = Recording::new();
    drawing.record(&mut recording);
    recording.render(targets.pass(drawing.draws().to_vec(), Some([0.03, 0.037, 0.048, 1.0])));
    recording
}

/// A camera, part of a turn on about the axis that points up.
fn turned(camera: &Camera, turn: f64) -> Camera {
    let sight = DQuat::from_axis_angle(camera.up, turn * TAU) * (camera.eye - camera.at);
    Camera { eye: camera.at + sight, ..*camera }
}
