//! Times the reading of a square grid of quads: `cargo run --release -p osculate-cage --example measure -- 1000`.

use std::error::Error;
use std::fmt::Write as _;
use std::time::Instant;

use osculate_cage::{Cage, Topology, inspect, read_obj};

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
    Ok(())
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
