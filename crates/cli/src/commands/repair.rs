//! `repair`: a cage from a file that holds none.

use crate::args::GlobalArgs;
use crate::failure::{Failure, Verdict, WriteError};
use crate::input;
use crate::options::{Output, ReadArgs};
use clap::Args;
use osculate_cage::{ReadDesc, write_obj};
use osculate_compare::whole_file;
use std::path::PathBuf;

/// Make a manifold mesh of any polygons and write it as OBJ.
///
/// Drops degenerate and copied faces, welds seams, separates edges with more than two faces and vertices where parts touch, and
/// turns faces the way most of their part are. Tags, texture coordinates, objects, groups, materials and smoothing groups go
/// along; what was done goes to stderr. A second repair finds nothing to do. With --crease-from, the creases are written too.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct RepairArgs {
    /// The file to repair: .obj, .ply, .off, .gltf, .glb, .usd, .usda, .usdc or .usdz.
    file: PathBuf,

    /// The cage to write.
    #[arg(short, long, value_name = "FILE.obj")]
    output: PathBuf,

    #[command(flatten)]
    read: ReadArgs,
}

const EXAMPLES: &str = "\
Examples:
  osculate repair scan.ply -o cage.obj
  osculate repair loose.obj --weld 0.001 -o cage.obj
  osculate repair machine.obj --crease-from angle=40,materials -o cage.obj";

/// A repair that can be made.
pub(crate) struct Job {
    file: PathBuf,
    output: Output<()>,
    desc: ReadDesc,
}

impl RepairArgs {
    /// Checks the place of the output.
    pub(crate) fn validate(mut self) -> Result<Job, Failure> {
        self.read.repair = true;
        let output = Output::new(self.output, &[("obj", ())])?.apart_from([self.file.as_path()])?;
        Ok(Job { desc: self.read.desc()?, file: self.file, output })
    }
}

/// Reads, repairs and writes.
pub(crate) fn run(job: &Job, global: &GlobalArgs) -> Result<Verdict, Failure> {
    let cage = input::read(&job.file, &job.desc, global)?;
    input::warn(&job.file, &cage);
    let path = &job.output.path;
    let written = whole_file::write(path, |out| write_obj(&cage, out).map_err(WriteError::from));
    written.map_err(|error| error.to(path))?;
    tracing::info!("{}: {} bytes", path.display(), job.output.bytes());
    Ok(Verdict::Pass)
}
