//! Times the reading of a square grid of quads, and how long it goes on without a sign of life:
//! `cargo run --release -p osculate-cage --example measure -- 1000`.

use std::error::Error;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use osculate_cage::{Cage, CreaseDesc, ReadDesc, ReadObserver, ReadStage, RepairDesc, Topology, inspect, read_obj};

fn main() -> Result<(), Box<dyn Error>> {
    let side: u32 = std::env::args().nth(1).map_or(Ok(1000), |side| side.parse())?;
    let file = tempfile::Builder::new().suffix(".obj").tempfile()?;
    std::fs::write(file.path(), grid(side)?)?;
    println!(
        "{side} x {side} quads, {} MB, {} threads",
        file.as_file().metadata()?.len() >> 20,
        rayon::current_num_threads()
    );

    let cage = timed("file to cage, all", || Cage::read(file.path()))?;
    let text = std::fs::read(file.path())?;
    timed("text to cage", || read_obj(&text, "grid.obj"))?;
    let (offsets, vertices) = (cage.face_offsets().to_vec(), cage.face_vertices().to_vec());
    timed("topology alone", || Topology::build(cage.vertex_count(), offsets, vertices))?;
    timed("inspection", || inspect(&cage));
    drop((cage, text));

    let silence = Arc::new(Mutex::new(Silence::new()));
    let desc = ReadDesc {
        repair: Some(RepairDesc::default()),
        creases: Some(CreaseDesc { angle: Some(30.0), ..CreaseDesc::default() }),
        observer: Some(listener(&silence)),
        ..ReadDesc::default()
    };
    timed("repaired, observed", || Cage::read_with(file.path(), &desc))?;
    let Silence { longest, stage, .. } = *silence.lock().unwrap_or_else(PoisonError::into_inner);
    println!("longest silence    {:7.1} ms ({stage:?})", longest.as_secs_f64() * 1e3);
    Ok(())
}

/// How long an observer waits for its next call, which is when it can end the reading.
struct Silence {
    last: Instant,
    longest: Duration,
    stage: ReadStage,
}

impl Silence {
    fn new() -> Self {
        Self { last: Instant::now(), longest: Duration::ZERO, stage: ReadStage::Fetch }
    }

    fn end(&mut self, stage: ReadStage) {
        let waited = self.last.elapsed();
        if waited > self.longest {
            (self.longest, self.stage) = (waited, stage);
        }
        self.last = Instant::now();
    }
}

fn listener(silence: &Arc<Mutex<Silence>>) -> ReadObserver {
    let silence = silence.clone();
    ReadObserver::new(move |progress| {
        silence.lock().unwrap_or_else(PoisonError::into_inner).end(progress.stage);
        ControlFlow::Continue(())
    })
}

fn grid(side: u32) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    for j in 0..=side {
        for i in 0..=side {
            let [x, y] = [i, j].map(|k| f64::from(k) / f64::from(side));
            writeln!(text, "v {x} {y} {}", 0.1 * (9.0 * x).sin() * (7.0 * y).cos())?;
        }
    }
    for j in 0..side {
        for i in 0..side {
            let v = i + 1 + (side + 1) * j;
            writeln!(text, "f {v} {} {} {}", v + 1, v + side + 2, v + side + 1)?;
        }
    }
    Ok(text)
}

fn timed<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    println!("{what:18} {:7.1} ms", start.elapsed().as_secs_f64() * 1e3);
    result
}
