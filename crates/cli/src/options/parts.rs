//! How large cages are divided.

use clap::Args;
use osculate::{PartsDesc, SurfaceDesc};

/// How much of a cage is on the device at once.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct PartsArgs {
    /// Most faces on the device at once, for cages that are too large for it or its memory: they are worked at in parts, with
    /// the same result. Default: what fits.
    #[arg(long, value_name = "FACES", value_parser = clap::value_parser!(u32).range(1..))]
    part_faces: Option<u32>,
}

impl PartsArgs {
    /// The library's description.
    pub(crate) fn desc(self, surface: SurfaceDesc) -> PartsDesc {
        PartsDesc { surface, most_faces: self.part_faces.map(|faces| faces as usize) }
    }
}
