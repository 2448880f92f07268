//! What adaptive factors cost and save: triangles and frame times against uniform levels at the same error of the picture (docs/measurements.md).
//!
//! ```sh
//! cargo run --release -p osculate --example measure_adaptive -- assets/cages/twohole.obj assets/cages/dragon.obj
//! cargo run --release -p osculate --example measure_adaptive -- --far 16 assets/cages/dragon.obj        # going away to 16 times the distance
//! ```
//! A path is a turn about the cage that comes to half the distance and back (`Camera::orbit`); `--near` and `--far` multiply the distances of the first and the
//! last view, and those between by powers. The error of a tessellation is the root of the mean squared
//! difference, over all pixels of all views and red, green and blue, to the pictures at level 64; 1 is from black to white. Silhouettes are part of it.
//! For each pixel size the uniform level with the same error is found between those that were drawn, on straight lines in logarithms.
//!
//! `--finest L` leaves out levels above L. `--views N`, `--size N` and `--runs N` set the views of the path, the pixels of a side, and how often each frame is timed.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use osculate::gpu::{Measure, Recording};
use osculate::{
    Cage, Camera, Culling, Device, DeviceDesc, Drawing, DrawingDesc, Engine, Factors, Shade, Surface, SurfaceDesc,
    Target, Targets, Tessellation,
};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

const LEVELS: [f32; 10] = [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0];
const PIXELS: [f32; 8] = [32.0, 24.0, 16.0, 12.0, 8.0, 6.0, 4.0, 3.0];
const REFERENCE: f32 = 64.0;

fn main() -> ExitCode {
    match Options::parse(std::env::args().skip(1)).and_then(|options| measure(&options)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

struct Options {
    views: u32,
    size: u32,
    runs: usize,
    /// What the distances of the first and the last view are multiplied with.
    near: f64,
    far: f64,
    finest: f32,
    cages: Vec<String>,
}

impl Options {
    fn parse(mut args: impl Iterator<Item = String>) -> Result<Self> {
        let mut options =
            Self { views: 6, size: 512, runs: 7, near: 1.0, far: 1.0, finest: f32::INFINITY, cages: Vec::new() };
        while let Some(arg) = args.next() {
            let mut number = || args.next().ok_or_else(|| format!("{arg} needs a number"));
            match arg.as_str() {
                "--views" => options.views = number()?.parse::<u32>()?.max(1),
                "--size" => options.size = number()?.parse()?,
                "--runs" => options.runs = number()?.parse::<usize>()?.max(1),
                "--finest" => options.finest = number()?.parse()?,
                "--near" => options.near = number()?.parse()?,
                "--far" => options.far = number()?.parse()?,
                flag if flag.starts_with('-') => return Err(format!("unknown option {flag}").into()),
                _ => options.cages.push(arg),
            }
        }
        if options.cages.is_empty() { Err("no cage given".into()) } else { Ok(options) }
    }
}

fn measure(options: &Options) -> Result<()> {
    let desc = DeviceDesc { application: "measure_adaptive".to_owned(), ..DeviceDesc::default() };
    let engine = Engine::new(Device::new(&desc)?);
    println!("device: {}", engine.device().info().name);
    options.cages.iter().try_for_each(|name| {
        let path = CameraPath::new(&engine, Path::new(name), options)?;
        println!("\n{name}, {} quads or other faces", path.faces);
        path.compare(options.finest)
    })
}

/// A surface and the views that it is seen in.
struct CameraPath {
    surface: Surface,
    faces: usize,
    views: Vec<Camera>,
    targets: Targets,
    runs: usize,
    /// A picture for each view.
    reference: Vec<Vec<u8>>,
}

/// What a tessellation gives and costs, in the mean of all views.
#[derive(Clone, Copy)]
struct Cost {
    error: f64,
    triangles: f64,
    milliseconds: f64,
}

impl CameraPath {
    fn new(engine: &Engine, file: &Path, options: &Options) -> Result<Self> {
        let cage = Cage::read(file)?;
        let last = f64::from(options.views.max(2) - 1);
        let distance = |i: usize| options.near * (options.far / options.near).powf(i as f64 / last);
        let moved = |(i, view): (usize, Camera)| {
            Camera { eye: view.at + distance(i) * (view.eye - view.at), ..view }.reaching(cage.bounds())
        };
        let orbit = Camera::fit(cage.bounds()).orbit(options.views, cage.bounds());
        let mut path = Self {
            surface: Surface::new(engine, &cage, &SurfaceDesc::default())?,
            faces: cage.face_count(),
            views: orbit.into_iter().enumerate().map(moved).collect(),
            targets: Targets::new(engine, [options.size; 2], Target::of(Shade::Lit, 4))?,
            runs: options.runs,
            reference: Vec::new(),
        };
        let fine = path.drawing(Factors::Uniform(REFERENCE))?;
        path.reference = path.pictures(fine)?;
        Ok(path)
    }

    fn adaptive(&self, pixels: f32) -> Factors {
        Factors::Adaptive { pixels, camera: self.views[0], height: self.targets.size()[1] }
    }

    fn drawing(&self, factors: Factors) -> Result<Drawing> {
        let desc = DrawingDesc {
            tessellation: Tessellation { factors, ..Tessellation::default() },
            shade: Shade::Lit,
            cage: false,
            target: self.targets.target(),
            culling: Culling::NONE,
            camera: self.views[0],
            size: self.targets.size(),
        };
        Ok(Drawing::new(&self.surface, &desc)?)
    }

    fn recording(&self, drawing: &Drawing, measure: Measure) -> Recording {
        let mut recording = Recording::new();
        recording.measure(measure);
        recording.render(self.targets.pass(drawing.draws().to_vec(), Some([0.0, 0.0, 0.0, 1.0])));
        recording
    }

    fn pictures(&self, mut drawing: Drawing) -> Result<Vec<Vec<u8>>> {
        let picture = |view: &Camera| -> Result<Vec<u8>> {
            let _plan = drawing.set_view(view, self.targets.size())?;
            Ok(self.targets.read(self.surface.engine(), self.recording(&drawing, Measure::default()))?)
        };
        self.views.iter().map(picture).collect()
    }

    fn cost(&self, factors: Factors) -> Result<Cost> {
        let device = self.surface.engine().device();
        let mut drawing = self.drawing(factors)?;
        let (mut triangles, mut milliseconds) = (0, 0.0);
        for view in &self.views {
            let _plan = drawing.set_view(view, self.targets.size())?;
            let counted = device.run(&self.recording(&drawing, Measure { statistics: true, timings: false }))?;
            triangles +=
                counted.statistics.first().ok_or("the device does not count triangles")?.1.clipping_invocations;
            let mut frame = device.prepare(&self.recording(&drawing, Measure::default()))?;
            let mut times = Vec::new();
            for _ in 0..self.runs {
                let start = Instant::now();
                frame.run()?;
                times.push(start.elapsed().as_secs_f64() * 1e3);
            }
            times.sort_by(f64::total_cmp);
            milliseconds += times[times.len() / 2];
        }
        let views = self.views.len() as f64;
        let error = difference(&self.reference, &self.pictures(drawing)?);
        Ok(Cost { error, triangles: triangles as f64 / views, milliseconds: milliseconds / views })
    }

    /// Prints a line for each level, then one for each pixel size, with the uniform level of the same error, until that is finer than all.
    fn compare(&self, finest: f32) -> Result<()> {
        println!("{:>8} {:>9} {:>10} {:>8}", "level", "error", "triangles", "ms");
        let mut uniform = Vec::new();
        for level in LEVELS.into_iter().filter(|&level| level <= finest) {
            let cost = self.cost(Factors::Uniform(level))?;
            println!("{level:>8} {cost}");
            uniform.push((f64::from(level), cost));
        }
        println!("{:>8} {:>9} {:>10} {:>8}   the same by a uniform level", "pixels", "error", "triangles", "ms");
        for pixels in PIXELS {
            let cost = self.cost(self.adaptive(pixels))?;
            let Some((level, equal)) = at_error(&uniform, cost.error) else {
                println!("{pixels:>8} {cost}   beyond the levels");
                if uniform.last().is_some_and(|(_, fine)| cost.error < fine.error) { break } else { continue }
            };
            let (less, faster) = (equal.triangles / cost.triangles, equal.milliseconds / cost.milliseconds);
            println!(
                "{pixels:>8} {cost}   level {level:.1}: {:.0} triangles, {:.2} ms; adaptive has {less:.2} times fewer, is {faster:.2} times as fast",
                equal.triangles, equal.milliseconds
            );
        }
        Ok(())
    }
}

impl std::fmt::Display for Cost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:9.6} {:10.0} {:8.2}", self.error, self.triangles, self.milliseconds)
    }
}

/// The root of the mean squared difference of red, green and blue.
fn difference(a: &[Vec<u8>], b: &[Vec<u8>]) -> f64 {
    let colors = |pictures: &[Vec<u8>]| -> Vec<[u8; 4]> {
        pictures.iter().flat_map(|p| p.as_chunks::<4>().0.to_vec()).collect()
    };
    let (a, b) = (colors(a), colors(b));
    let square = |(a, b): (&[u8; 4], &[u8; 4])| (0..3).map(|i| f64::from(a[i].abs_diff(b[i])).powi(2)).sum::<f64>();
    (a.iter().zip(&b).map(square).sum::<f64>() / (3 * a.len()) as f64).sqrt() / 255.0
}

/// The level with an error, and what it costs; `None` if it is not between two that were drawn.
fn at_error(uniform: &[(f64, Cost)], error: f64) -> Option<(f64, Cost)> {
    let between = |pair: &&[(f64, Cost)]| pair[0].1.error >= error && error >= pair[1].1.error && error > 0.0;
    let pair = uniform.windows(2).find(between)?;
    let ((level, coarse), (finer_level, fine)) = (pair[0], pair[1]);
    let t =
        if coarse.error > fine.error { (coarse.error / error).ln() / (coarse.error / fine.error).ln() } else { 0.0 };
    let mix = |a: f64, b: f64| (a.ln() + t * (b.ln() - a.ln())).exp();
    let cost = Cost {
        error,
        triangles: mix(coarse.triangles, fine.triangles),
        milliseconds: mix(coarse.milliseconds, fine.milliseconds),
    };
    Some((mix(level, finer_level), cost))
}
