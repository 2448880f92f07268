//! The command line as a whole; each command's own options are in its file under `commands`.

#[cfg(feature = "viewer")]
use crate::commands::view;
use crate::commands::{bench, check, compare, export, inspect, render, repair, sample};
use clap::{ArgAction, Args, Parser, Subcommand};

/// Catmull-Clark surfaces through Vulkan's tessellation stages, from the command line.
///
/// Reads a control cage (OBJ, PLY, OFF, glTF, USD), puts its Catmull-Clark surface through tessellation shaders and gives you a
/// picture, triangles, points, or the proof that the surface has no cracks, without a window; view opens one.
#[derive(Parser, Debug)]
#[command(name = "osculate", version, after_help = EXAMPLES, subcommand_value_name = "COMMAND")]
pub(crate) struct Cli {
    /// Options of every command.
    #[command(flatten)]
    pub(crate) global: GlobalArgs,

    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

/// Options of every command.
#[derive(Args, Debug)]
#[command(next_help_heading = "Common options")]
pub(crate) struct GlobalArgs {
    /// List the Vulkan devices of this machine (index, name, kind, driver) and do nothing else.
    #[arg(long, global = true)]
    pub(crate) list_devices: bool,

    /// Device to use: an index from --list-devices or a part of a name. Default: the best one.
    #[arg(long, global = true, value_name = "N|NAME", env = "OSCULATE_DEVICE", allow_negative_numbers = true)]
    pub(crate) device: Option<String>,

    /// Switch on Vulkan's validation layers, synchronization included; any message is an error.
    #[arg(long, global = true)]
    pub(crate) validation: bool,

    /// Print errors only: no warnings, no progress.
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,

    /// Say more on stderr; twice for details.
    #[arg(short, long, global = true, action = ArgAction::Count, conflicts_with = "quiet")]
    pub(crate) verbose: u8,
}

/// What to do. The help of each command is the documentation of its arguments.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Render(render::RenderArgs),
    Sample(sample::SampleArgs),
    Export(export::ExportArgs),
    Check(check::CheckArgs),
    Inspect(inspect::InspectArgs),
    Repair(repair::RepairArgs),
    Bench(bench::BenchArgs),
    Compare(compare::CompareArgs),
    #[cfg(feature = "viewer")]
    View(view::ViewArgs),
}

const EXAMPLES: &str = "\
Examples:
  osculate view assets/cages/*.obj
  osculate render assets/cages/torus.obj -o torus.png
  osculate inspect assets/cages/torus.obj
  osculate check assets/cages/torus.obj --levels 1,5,8
  osculate export assets/cages/torus.obj --level 16 -o torus.glb

Drivers' pipelines are kept in the user's cache folder, so that the next run starts faster; OSCULATE_CACHE names another
folder, or off.

Exit codes: 0 done, 1 a check or comparison failed, 2 usage, 3 bad input file, 4 no usable device.";
