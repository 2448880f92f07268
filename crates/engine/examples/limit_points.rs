//! Points and normals of the limit surface, without graphics: `cargo run --release -p osculate --example limit_points -- --help`.

mod common;

use std::fmt::Write as _;
use std::process::ExitCode;

use common::{Arguments, Result, expect_no_messages, run};
use osculate::gpu::Features;
use osculate::{Cage, Device, DeviceDesc, Engine, Sample, Scheme, SubFace, Surface, SurfaceDesc, SurfacePoint};
use osculate_cage::sub_faces;

const HELP: &str = "\
Writes positions and normals of the limit surface of a cage on a grid over each of its faces: as a table (.csv) or as a mesh of quads (.obj).
Compute shaders do it, so that any device will do, though it had no tessellation.

usage: limit_points CAGE [-o POINTS.csv|POINTS.obj] [--grid N] [--validation]
  -o PATH        where to write; default points.csv
  --grid N       cells along the side of a face; default 4
  --validation   fail if the validation layer has anything to say";

fn main() -> ExitCode {
    run(|| match Arguments::read(HELP, "points.csv")? {
        Some(arguments) => limit_points(&arguments),
        None => Ok(()),
    })
}

fn limit_points(arguments: &Arguments) -> Result<()> {
    let cage = Cage::read(&arguments.files[0])?;
    // What graphics are made with is left off, to show that it is not needed.
    let device = Device::new(&DeviceDesc { without: Features::ALL, ..arguments.device() })?;
    let engine = Engine::new(device.clone());
    let surface = Surface::new(&engine, &cage, &SurfaceDesc { scheme: Scheme::Stam, ..SurfaceDesc::default() })?;
    let cells = arguments.number("--grid", 4).max(1);
    let points = grids(&surface, &cage, cells);
    let samples = surface.sample(&points)?;
    let text = match arguments.output.extension().and_then(|extension| extension.to_str()) {
        Some("csv") => table(&points, &samples),
        Some("obj") => mesh(&samples, cells),
        _ => return Err(format!("{}: neither .csv nor .obj", arguments.output.display()).into()),
    };
    std::fs::write(&arguments.output, text)?;
    println!("{}: {} points", arguments.output.display(), points.len());
    expect_no_messages(&device.validation_messages())
}

/// A grid over each face that is drawn; faces other than quads consist of one sub-face per corner.
fn grids(surface: &Surface, cage: &Cage, cells: u32) -> Vec<SurfacePoint> {
    let drawn = cage.drawn_faces(surface.plan().rule);
    let faces = (0..cage.face_count() as u32).filter(|&face| drawn[face as usize]);
    let parts = faces.flat_map(|face| sub_faces(cage.face(face as usize).len()).map(move |sub| SubFace { face, sub }));
    let along = |i: u32| f64::from(i) / f64::from(cells);
    let grid = (0..=cells).flat_map(move |j| (0..=cells).map(move |i| (along(i), along(j))));
    parts.flat_map(|sub_face| grid.clone().map(move |(s, t)| SurfacePoint { sub_face, s, t })).collect()
}

fn table(points: &[SurfacePoint], samples: &[Sample]) -> String {
    let mut text = "face,sub,s,t,x,y,z,nx,ny,nz\n".to_owned();
    for (point, Sample { position: p, normal: n, .. }) in points.iter().zip(samples) {
        let SurfacePoint { sub_face: SubFace { face, sub }, s, t } = point;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{face},{sub},{s},{t},{},{},{},{},{},{}", p.x, p.y, p.z, n.x, n.y, n.z);
    }
    text
}

fn mesh(samples: &[Sample], cells: u32) -> String {
    let mut text = String::new();
    for Sample { position: p, normal: n, .. } in samples {
        let _ = writeln!(text, "v {} {} {}\nvn {} {} {}", p.x, p.y, p.z, n.x, n.y, n.z);
    }
    let (cells, row) = (cells as usize, cells as usize + 1);
    for first in (1..=samples.len()).step_by(row * row) {
        for corner in (0..cells).flat_map(|j| (0..cells).map(move |i| first + j * row + i)) {
            let quad = [corner, corner + 1, corner + row + 1, corner + row];
            let [a, b, c, d] = quad.map(|at| format!("{at}//{at}"));
            let _ = writeln!(text, "f {a} {b} {c} {d}");
        }
    }
    text
}
