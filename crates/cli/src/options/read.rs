//! How files become cages.

use crate::failure::Failure;
use clap::{Args, ValueEnum};
use osculate_cage::{CreaseDesc, GltfDesc, Limits, PolygonRecovery, ReadDesc, RepairDesc};
use std::str::FromStr;

/// Options of all commands that read a cage.
#[derive(Args, Debug)]
#[command(next_help_heading = "Reading")]
pub(crate) struct ReadArgs {
    /// Make a manifold mesh of what is none: drop degenerate and copied faces, weld seams, separate edges with more than two
    /// faces and vertices where parts touch, turn faces the way most of their part are. What was done goes to stderr.
    #[arg(long)]
    pub(crate) repair: bool,

    /// With --repair: boundary vertices at most this far apart may be welded, in units of the file.
    #[arg(long, value_name = "DISTANCE", default_value_t = 0.0, hide_default_value = true)]
    weld: f64,

    /// Tag edges as creases: where faces enclose more than an angle (angle=30), between smoothing groups (smoothing), between
    /// materials (materials), at seams of texture coordinates (uv); several with commas. Edges that have a tag keep it.
    #[arg(long, value_name = "SOURCE,..", value_delimiter = ',')]
    crease_from: Vec<CreaseSource>,

    /// Sharpness of the creases that --crease-from makes; from 10 on they are infinitely sharp.
    #[arg(long, value_name = "S", default_value_t = 10.0, hide_default_value = true)]
    crease_sharpness: f32,

    /// glTF: which signs of polygons among triangles to believe: the mark FB_ngon_encoding (marked), halves of quads in a row
    /// (order), neighbours that make good quads (shape); none keeps all triangles. Default: marked,order,shape.
    #[arg(long, value_name = "SIGN,..", value_delimiter = ',')]
    gltf_polygons: Vec<PolygonSign>,

    /// glTF: weld vertices at most this far apart, in units of the scene. Default: 0, only those at one place.
    #[arg(long, value_name = "DISTANCE", default_value_t = 0.0, hide_default_value = true)]
    gltf_weld: f64,

    /// Refuse files that are larger; with k, M or G at the end for powers of 1024 bytes. Default: 4G.
    #[arg(long, value_name = "BYTES")]
    max_file_size: Option<Bytes>,

    /// Refuse files with more faces. Default: 100 million.
    #[arg(long, value_name = "N")]
    max_faces: Option<u64>,

    /// Refuse cages that take more memory to read. Default: 16G.
    #[arg(long, value_name = "BYTES")]
    max_memory: Option<Bytes>,
}

/// What makes an edge a crease.
#[derive(Clone, Copy, Debug, PartialEq)]
enum CreaseSource {
    Angle(f64),
    Smoothing,
    Materials,
    Uv,
}

impl FromStr for CreaseSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "smoothing" | "groups" => Ok(Self::Smoothing),
            "materials" => Ok(Self::Materials),
            "uv" => Ok(Self::Uv),
            _ => {
                let degrees = text.strip_prefix("angle=").and_then(|degrees| degrees.parse::<f64>().ok());
                let degrees = degrees.filter(|degrees| (0.0..=180.0).contains(degrees));
                let wrong = "sources are angle=DEGREES (0 to 180), smoothing, materials and uv";
                degrees.map(Self::Angle).ok_or_else(|| wrong.to_owned())
            }
        }
    }
}

/// What tells which triangles of a glTF file were one polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum PolygonSign {
    /// The extension FB_ngon_encoding.
    Marked,
    /// The halves of a quad stand one after the other.
    Order,
    /// Two neighbours make a good quad.
    Shape,
    /// Nothing does.
    None,
}

/// A number of bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bytes(u64);

impl FromStr for Bytes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let units = [("k", 10), ("K", 10), ("M", 20), ("G", 30), ("T", 40), ("", 0)];
        let parse = |&(unit, power): &(&str, u32)| {
            let number: u64 = text.strip_suffix(unit)?.parse().ok()?;
            number.checked_mul(1 << power).map(Self)
        };
        units.iter().find_map(parse).ok_or_else(|| "sizes look like 500000, 64k, 100M or 2G".to_owned())
    }
}

impl ReadArgs {
    /// What the library is told.
    pub(crate) fn desc(&self) -> Result<ReadDesc, Failure> {
        let repair = self.repair.then_some(RepairDesc { weld_tolerance: self.weld });
        for (option, distance) in [("--weld", self.weld), ("--gltf-weld", self.gltf_weld)] {
            if !(distance >= 0.0 && distance.is_finite()) {
                return Err(Failure::usage(format_args!("{option} {distance} is no distance"))
                    .with_hint("distances are at least 0"));
            }
        }
        if self.weld > 0.0 && !self.repair {
            return Err(Failure::usage("--weld is part of the repair").with_hint("add --repair"));
        }
        if self.crease_sharpness.is_nan() || self.crease_sharpness < 0.0 {
            return Err(Failure::usage(format_args!("--crease-sharpness {} is no sharpness", self.crease_sharpness))
                .with_hint("sharpness is at least 0; from 10 on creases are infinitely sharp"));
        }
        let default = Limits::default();
        let limits = Limits {
            file_bytes: self.max_file_size.map_or(default.file_bytes, |bytes| bytes.0),
            faces: self.max_faces.unwrap_or(default.faces),
            memory_bytes: self.max_memory.map_or(default.memory_bytes, |bytes| bytes.0),
        };
        let gltf = GltfDesc { polygons: self.polygons()?, weld_tolerance: self.gltf_weld };
        Ok(ReadDesc { gltf, repair, creases: self.creases(), limits, observer: None })
    }

    fn polygons(&self) -> Result<PolygonRecovery, Failure> {
        let signs = &self.gltf_polygons;
        if signs.is_empty() {
            return Ok(PolygonRecovery::default());
        }
        if signs.contains(&PolygonSign::None) && signs.len() > 1 {
            return Err(Failure::usage("--gltf-polygons none goes with no other sign").with_hint("leave out none"));
        }
        let has = |sign| signs.contains(&sign);
        let [marked, order, shape] = [PolygonSign::Marked, PolygonSign::Order, PolygonSign::Shape].map(has);
        Ok(PolygonRecovery { marked, order, shape })
    }

    fn creases(&self) -> Option<CreaseDesc> {
        let mut desc = CreaseDesc { sharpness: self.crease_sharpness, ..CreaseDesc::default() };
        for source in &self.crease_from {
            match *source {
                CreaseSource::Angle(degrees) => desc.angle = Some(degrees),
                CreaseSource::Smoothing => desc.smoothing = true,
                CreaseSource::Materials => desc.materials = true,
                CreaseSource::Uv => desc.uv = true,
            }
        }
        (!self.crease_from.is_empty()).then_some(desc)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_of_creases() {
        assert_eq!("angle=30.5".parse(), Ok(CreaseSource::Angle(30.5)));
        assert_eq!("groups".parse(), Ok(CreaseSource::Smoothing));
        for wrong in ["angle", "angle=", "angle=x", "angle=-1", "angle=181", "angle=nan", "edges", ""] {
            assert!(wrong.parse::<CreaseSource>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn sizes() {
        for (text, bytes) in [("7", 7), ("64k", 64 << 10), ("64K", 64 << 10), ("3M", 3 << 20), ("2G", 2 << 30)] {
            assert_eq!(text.parse(), Ok(Bytes(bytes)), "{text}");
        }
        for wrong in ["", "k", "-1", "1.5G", "1GB", "99999999999T"] {
            assert!(wrong.parse::<Bytes>().is_err(), "{wrong}");
        }
    }
}
