//! What the formulas cost, counted from the SPIR-V and from the loops of the shaders.

use osculate_shaders::shader;

/// A formula, and the stages that it is drawn with.
struct Form {
    name: &'static str,
    control: &'static str,
    evaluation: &'static str,
    /// Multiply-adds of points that make the control points of a patch.
    change: u32,
    /// The same for a vertex inside a patch.
    vertex: u32,
}

/// A bicubic patch: four rows of four points and of three differences, then one column each for the point and its derivatives.
const BICUBIC: u32 = 4 * (4 + 3) + 4 + 4 + 3;
/// A patch of bidegree 7, likewise.
const BISEPTIC: u32 = 8 * (8 + 7) + 8 + 8 + 7;
/// Four blends of two points, then a bicubic patch.
const GREGORY: u32 = 4 * 2 + BICUBIC;
/// Three blends of two points, nine points of sides raised by a degree, then 10 + 6 + 3 + 1 steps of de Casteljau's algorithm over three points.
const TRIANGLE: u32 = 3 * 2 + 9 * 2 + 20 * 3;

/// Stam's: 16 points of a sub-patch as sums over the modes, then a bicubic patch.
const fn stam(modes: u32) -> u32 {
    16 * (modes - 2) + BICUBIC
}

/// The share that one face has in the fans of its corners, matrices over a vertex, its neighbours and the centroids of its faces, and the two face points at
/// every corner.
const fn from_fans(valence: u32, corners: u32) -> u32 {
    let fan = (1 + 3 * valence) * (2 * valence + 1);
    fan * corners / valence + 4 * 2 * corners
}

const FORMS: [Form; 10] = [
    Form {
        name: "bicubic",
        control: "patch/regular.tesc",
        evaluation: "patch/regular.tese",
        // Four sums along u and one along v for a Bezier point, of two products each.
        change: 16 * 5 * 2,
        vertex: BICUBIC,
    },
    stored("gregory1, quad at valences 4", "patch/stored_gregory.tese", from_fans(4, 4), GREGORY),
    Form {
        control: "patch/stored_triangle.tesc",
        ..stored("gregory1, triangle at valences 6", "patch/stored_triangle.tese", from_fans(6, 3), TRIANGLE)
    },
    gregory("gregory2, valence 5", 18),
    gregory("gregory2, valence 12", 32),
    listed_stam("stam, valence 5", "patch/stam.tesc#18", 18),
    listed_stam("stam, valence 12", "patch/stam.tesc#32", 32),
    stored("stam, valence 20, stored", "patch/stored_stam.tese", 48 * 47, stam(48)),
    biseptic("biseptic, valence 5", 18),
    biseptic("biseptic, valence 12", 32),
];

const fn stored(name: &'static str, evaluation: &'static str, change: u32, vertex: u32) -> Form {
    Form { name, control: "patch/stored.tesc", evaluation, change, vertex }
}

const fn gregory(name: &'static str, net: u32) -> Form {
    let (control, evaluation) = ("patch/gregory.tesc", "patch/gregory.tese");
    Form { name, control, evaluation, change: 20 * net, vertex: GREGORY }
}

const fn listed_stam(name: &'static str, control: &'static str, net: u32) -> Form {
    Form { name, control, evaluation: "patch/stam.tese", change: net * (net - 1), vertex: stam(net) }
}

const fn biseptic(name: &'static str, net: u32) -> Form {
    let (control, evaluation) = ("patch/biseptic.tesc", "patch/biseptic.tese");
    Form { name, control, evaluation, change: 64 * (net - 1), vertex: BISEPTIC }
}

/// Prints the table.
pub(crate) fn print() {
    println!("Cost: multiply-adds of points, and SPIR-V instructions as compiled, loops counted once.\n");
    println!(
        "| patch | multiply-adds per patch | per vertex inside | instructions, control stage | evaluation stage |"
    );
    println!("|---|---|---|---|---|");
    for form in FORMS {
        let control = instructions(form.control);
        let evaluation = instructions(&format!("{}#equal", form.evaluation));
        println!("| {} | {} | {} | {control} | {evaluation} |", form.name, form.change, form.vertex);
    }
    println!();
}

/// SPIR-V instructions within functions, but for labels and declarations.
fn instructions(name: &str) -> usize {
    const FUNCTION: u32 = 54;
    const NO_WORK: [u32; 6] = [FUNCTION, 55, 56, 59, 248, 317];
    const HEADER_WORDS: usize = 5;
    let words = shader(name).unwrap_or_else(|| panic!("there is no shader {name}"));
    let (mut at, mut inside, mut count) = (HEADER_WORDS, false, 0);
    while at < words.len() {
        let (op, length) = (words[at] & 0xffff, (words[at] >> 16) as usize);
        inside |= op == FUNCTION;
        count += usize::from(inside && !NO_WORK.contains(&op));
        at += length.max(1);
    }
    count
}
