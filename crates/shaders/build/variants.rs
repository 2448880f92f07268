//! The variants that stage files are compiled in.

use osculate_shader_compiler::Stage;

/// A macro and its value.
pub(crate) type Define = (&'static str, Option<&'static str>);

/// One way to compile a file.
pub(crate) struct Variant {
    /// What is added to the file's path to name the shader: `#` and words between commas.
    pub(crate) suffix: String,
    pub(crate) defines: Vec<Define>,
}

/// A word of a suffix, empty where it goes without saying, and the macros that it stands for.
type Choice = (&'static str, &'static [Define]);

/// The tessellator's spacing, which is a layout qualifier and so no specialization constant.
const SPACINGS: &[Choice] = &[
    ("equal", &[("SPACING", Some("equal_spacing"))]),
    ("odd", &[("SPACING", Some("fractional_odd_spacing"))]),
    ("even", &[("SPACING", Some("fractional_even_spacing"))]),
];
/// What fragments look at: everything, or position and normal, or the normal alone. What a stage declares has its price on devices that keep vertices and
/// triangles in memory, used or not, so that a specialization constant is not enough.
const SEEN: &[Choice] = &[
    ("", &[("SEES_POSITION", None), ("SEES_PATCH", None)]),
    ("position", &[("SEES_POSITION", None)]),
    ("normal", &[]),
];
/// The same, or outputs go to transform feedback.
const OUTPUTS: &[Choice] = &[SEEN[0], SEEN[1], SEEN[2], ("capture", &[("CAPTURE", None)])];
/// Surfaces without and with texture coordinates, which may be displaced.
const MAPS: &[Choice] = &[("", &[]), ("mapped", &[("MAPPED", None)])];

/// Control stages that write as many vertices as the net has points, which SPIR-V wants as a literal: one variant for each net of 2n+8 points.
const NET_SIZE_STAGE: &str = "patch/stam.tesc";
const NET_SIZES: &[Choice] = &[
    ("14", &[("POINTS_OUT", Some("14"))]),
    ("18", &[("POINTS_OUT", Some("18"))]),
    ("20", &[("POINTS_OUT", Some("20"))]),
    ("22", &[("POINTS_OUT", Some("22"))]),
    ("24", &[("POINTS_OUT", Some("24"))]),
    ("26", &[("POINTS_OUT", Some("26"))]),
    ("28", &[("POINTS_OUT", Some("28"))]),
    ("30", &[("POINTS_OUT", Some("30"))]),
    ("32", &[("POINTS_OUT", Some("32"))]),
];

/// The stage that draws what the compute evaluator made, and the one that colours patches.
const GRID_STAGE: &str = "shade/grid.vert";
const SURFACE_STAGE: &str = "shade/surface.frag";

/// The folder of the kernels that evaluate patches, and those of them that know nothing of texture coordinates.
const EVALUATION_FOLDER: &str = "evaluate/";
const UNMAPPED_STAGES: [&str; 3] = ["evaluate/factors.comp", "evaluate/edges.comp", "evaluate/edges_regular.comp"];

/// The kernel of new vertex points, which finds old ones by their distance or in its table.
const VERTEX_STAGE: &str = "subdivide/vertex.comp";
const OLD_POINTS: &[Choice] = &[("", &[]), ("listed", &[("OLD_IN_ROW", None)])];

/// The variants of the file at a path: none if it is no stage.
pub(crate) fn of(path: &str) -> Vec<Variant> {
    let axes: &[&[Choice]] = match Stage::of_path(path) {
        Ok(Stage::TessellationEvaluation) => &[SPACINGS, OUTPUTS, MAPS],
        Ok(_) if path == NET_SIZE_STAGE => &[NET_SIZES],
        Ok(_) if path == GRID_STAGE => &[SEEN],
        Ok(_) if path == SURFACE_STAGE => &[SEEN, MAPS],
        Ok(_) if path == VERTEX_STAGE => &[OLD_POINTS],
        Ok(Stage::Compute) if path.starts_with(EVALUATION_FOLDER) && !UNMAPPED_STAGES.contains(&path) => &[MAPS],
        Ok(_) => &[],
        Err(_) => return Vec::new(),
    };
    axes.iter().fold(vec![Variant { suffix: String::new(), defines: Vec::new() }], |variants, choices| {
        variants.iter().flat_map(|variant| choices.iter().map(|choice| variant.with(choice))).collect()
    })
}

impl Variant {
    fn with(&self, &(word, defines): &Choice) -> Self {
        let joint = if self.suffix.is_empty() { "#" } else { "," };
        let suffix = if word.is_empty() { self.suffix.clone() } else { format!("{}{joint}{word}", self.suffix) };
        Self { suffix, defines: [&self.defines, defines].concat() }
    }
}
