//! Prints the tables of docs/schemes.md: `cargo xtask schemes`. Lengths are in half diagonals of the cage's box, so that a ball through the corners of the box
//! has curvature 1.

mod cost;
mod distance;
mod jumps;

use osculate::{Cage, Device, DeviceDesc, Engine, PatchKind, Scheme, Surface, SurfaceDesc};
use osculate_subdiv::PatchList;
use osculate_tests::zoo;

/// Cages that every scheme draws: closed and bounded, valences 3 to 12.
const CAGES: [&str; 5] = ["cube", "triangles", "stars", "shell", "dragon"];

fn main() {
    let engine = Engine::new(Device::new(&DeviceDesc::default()).unwrap_or_else(|error| panic!("{error}")));
    println!("Device: {}.\n", engine.device().info().name);
    let cages = CAGES.map(|name| (name, zoo::shipped(name)));
    distances(&engine, &cages);
    continuity(&engine, &cages);
    patches(&engine, &cages);
    cost::print();
}

fn surface(engine: &Engine, cage: &Cage, scheme: Scheme) -> Surface {
    Surface::new(engine, cage, &SurfaceDesc { scheme, ..SurfaceDesc::default() })
        .unwrap_or_else(|error| panic!("{error}"))
}

/// What is measured of a cage in every scheme.
type Found<T> = Vec<(&'static str, Vec<T>)>;

fn measure<T>(engine: &Engine, cages: &[(&'static str, Cage)], of: impl Fn(&Surface, &Cage) -> T) -> Found<T> {
    let schemes = |cage| Scheme::ALL.iter().map(|&scheme| of(&surface(engine, cage, scheme), cage)).collect();
    cages.iter().map(|(name, cage)| (*name, schemes(cage))).collect()
}

/// A table with a row for each cage and a column for each scheme.
fn print_table<T>(title: &str, found: &Found<T>, cell: impl Fn(&T) -> String) {
    let heads: Vec<String> = Scheme::ALL.iter().map(|scheme| format!("`{scheme}`")).collect();
    println!("{title}\n\n| cage | {} |\n|---|{}", heads.join(" | "), "---|".repeat(heads.len()));
    for (name, row) in found {
        println!("| {name} | {} |", row.iter().map(&cell).collect::<Vec<_>>().join(" | "));
    }
    println!();
}

/// A number with two significant digits, one if it is tiny.
fn figure(x: f64) -> String {
    if x > 0.0 && x < 1e-4 {
        return format!("{x:.0e}");
    }
    let before_point = if x >= 1.0 { x.log10().floor() as usize + 1 } else { 0 };
    let zeros_after_point = if x > 0.0 && x < 1.0 { (-x.log10()).floor() as usize } else { 0 };
    format!("{x:.0$}", if before_point > 0 { 2_usize.saturating_sub(before_point) } else { zeros_after_point + 2 })
}

fn distances(engine: &Engine, cages: &[(&'static str, Cage)]) {
    let found = measure(engine, cages, distance::measure);
    let same = "Distance between points of equal parameters, in half diagonals: max (mean).";
    print_table(same, &found, |found| found.same.text());
    let nearest = "Distance to the nearest point of the same face, in half diagonals: max (mean).";
    print_table(nearest, &found, |found| found.nearest.text());
}

fn continuity(engine: &Engine, cages: &[(&'static str, Cage)]) {
    let found = measure(engine, cages, jumps::measure);
    let normal = "Angle between the normals of the two patches of an edge, in degrees: max (mean).";
    print_table(normal, &found, |found| found.normal.text());
    let curvature = "Difference of their mean curvatures, times the half diagonal: max (mean).";
    print_table(curvature, &found, |found| found.curvature.text());
}

fn patches(engine: &Engine, cages: &[(&'static str, Cage)]) {
    let found = measure(engine, cages, |surface, _| (surface.plan().lists.clone(), surface.bytes()));
    print_table("Patches; pipelines for one output and spacing.", &found, |(lists, _)| {
        format!("{}; {}", by_kind(lists), lists.len())
    });
    print_table("Kilobytes on the device.", &found, |(_, bytes)| (bytes / 1000).to_string());
}

/// `96 regular, 48 stam, 12 stam stored`
fn by_kind(lists: &[PatchList]) -> String {
    let mut counts: Vec<(String, u32)> = Vec::new();
    for list in lists {
        let stored = if matches!(list.kind, PatchKind::Stored { .. }) { " stored" } else { "" };
        let kind = format!("{}{stored}", list.kind.form().name());
        match counts.iter_mut().find(|(name, _)| *name == kind) {
            Some((_, count)) => *count += list.count,
            None => counts.push((kind, list.count)),
        }
    }
    counts.into_iter().map(|(kind, count)| format!("{count} {kind}")).collect::<Vec<_>>().join(", ")
}

/// Largest value and weighted mean of many.
#[derive(Clone, Copy, Debug, Default)]
struct Spread {
    max: f64,
    sum: f64,
    weight: f64,
}

impl Spread {
    fn add(&mut self, value: f64, weight: f64) {
        self.max = self.max.max(value);
        self.sum += weight * value;
        self.weight += weight;
    }

    fn text(&self) -> String {
        format!("{} ({})", figure(self.max), figure(self.sum / self.weight.max(f64::MIN_POSITIVE)))
    }
}
