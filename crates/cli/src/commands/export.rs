//! `export`: the triangles that the device drew.

use crate::args::GlobalArgs;
use crate::device::with_engine;
use crate::failure::{Failure, Verdict, WriteError};
use crate::input::InputArgs;
use crate::mesh::soup::{Soup, SoupVertex};
use crate::mesh::{Corner, Mesh, Welder, glb, obj, ply, stl};
use crate::options::{CameraArgs, DisplaceArgs, Maps, Output, PartsArgs, SchemeName, TessellationArgs, uv_origin};
use crate::progress::Progress;
use clap::Args;
use glam::Vec3;
use osculate::{
    CageSpace, CapturedVertex, Engine, Part, Place, Scheme, SubFace, Surface, SurfaceDesc, Tessellation, UvOrigin,
    VertexKey, WholeKey, WholeOrParts,
};
use osculate_cage::{Bounds, Cage};
use osculate_compare::whole_file;
use osculate_subdiv::UvTables;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Write the triangles that the device draws: PLY, OBJ, GLB, STL.
///
/// Vertices on common edges are joined, so that a closed cage gives a closed mesh. PLY and STL (both binary) and GLB hold
/// 32-bit numbers; OBJ keeps all digits of cages far from the origin, and GLB moves its node there. OBJ and GLB hold the texture
/// coordinates of the cage; at their seams vertices of GLB are apart.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ExportArgs {
    #[command(flatten)]
    input: InputArgs,

    /// The mesh to write; the ending says the format.
    #[arg(short, long, value_name = "FILE.{ply,obj,glb,stl}")]
    output: PathBuf,

    /// How the surface is put together.
    #[arg(long, alias = "schemes", value_name = "SCHEME", default_value = "gregory2", help = SchemeName::help())]
    scheme: SchemeName,

    /// Give each triangle three vertices of its own, in the order in which the device drew them, each with its place on the
    /// cage: face, sub, s, t as in the command sample. PLY only.
    #[arg(long)]
    no_weld: bool,

    #[command(flatten)]
    tessellation: TessellationArgs,

    #[command(flatten)]
    displace: DisplaceArgs,

    #[command(flatten)]
    camera: CameraArgs,

    #[command(flatten)]
    parts: PartsArgs,
}

const EXAMPLES: &str = "\
Examples:
  osculate export cube.obj -o smooth.glb
  osculate export cube.obj --level 16 -o smooth.ply
  osculate export cube.obj --level 2.5 --spacing odd --no-weld -o triangles.ply";

/// Formats of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Ply,
    /// PLY without joined vertices.
    Soup,
    Obj,
    Glb,
    Stl,
}

/// An export that can be made.
pub(crate) struct Job {
    input: InputArgs,
    output: Output<Format>,
    scheme: Scheme,
    tessellation: TessellationArgs,
    displace: DisplaceArgs,
    camera: CameraArgs,
    parts: PartsArgs,
}

impl ExportArgs {
    /// Checks the scheme, the place and the format of the output.
    pub(crate) fn validate(self) -> Result<Job, Failure> {
        let formats = [("ply", Format::Ply), ("obj", Format::Obj), ("glb", Format::Glb), ("stl", Format::Stl)];
        let mut output = Output::new(self.output, &formats)?;
        if self.no_weld {
            output.format = match output.format {
                Format::Ply => Format::Soup,
                _ => return Err(Failure::usage("--no-weld writes PLY only").with_hint("end the output's name in .ply")),
            };
        }
        let output = output.apart_from([self.input.file.as_path()])?;
        let scheme = self.scheme.in_this_build()?;
        Ok(Job {
            input: self.input,
            output,
            scheme,
            tessellation: self.tessellation,
            displace: self.displace,
            camera: self.camera,
            parts: self.parts,
        })
    }
}

/// Draws into memory and writes the triangles.
pub(crate) fn run(job: &Job, global: &GlobalArgs) -> Result<Verdict, Failure> {
    let input = job.input.read(global)?;
    job.warn_of_coarse_numbers(input.cage.bounds());
    let tessellation = job.tessellation.tessellation(&job.camera, input.cage.bounds())?;
    let maps = job.displace.load(&input.cage)?;
    let desc = SurfaceDesc { scheme: job.scheme, boundary: Some(input.boundary), ..SurfaceDesc::default() };
    with_engine(global, |engine: &Engine| {
        let made = WholeOrParts::new(engine, &input.cage, &job.parts.desc(desc));
        let surface = made.map_err(|error| job.input.refuse(error))?;
        let progress = Progress::new(global.quiet, job.patches(&input.cage, &surface), "drawing");
        let mut drawing = Drawing { job, cage: &input.cage, surface, maps, tessellation, progress };
        let path = &job.output.path;
        drawing.export(job.output.format, path).map_err(|error| error.to(path))
    })?;
    tracing::info!("{}: {} bytes", job.output.path.display(), job.output.bytes());
    Ok(Verdict::Pass)
}

impl Job {
    /// How many patches there are, or about how many in parts: one for each corner.
    fn patches(&self, cage: &Cage, surface: &WholeOrParts<'_>) -> u64 {
        match surface {
            WholeOrParts::Whole(surface) => surface.plan().patches.len() as u64,
            WholeOrParts::Parts(_) => cage.face_vertices().len() as u64,
        }
    }

    /// Where v begins in the texture coordinates of a cage, if there are any and the format holds them.
    fn uv_origin(&self, cage: &Cage) -> Option<UvOrigin> {
        cage.uv()
            .filter(|_| matches!(self.output.format, Format::Obj | Format::Glb))
            .map(|_| uv_origin(&self.input.file))
    }

    /// Says so if numbers of the format lie so far apart where the cage is that its shape suffers.
    fn warn_of_coarse_numbers(&self, bounds: Bounds) {
        let is_32_bit = matches!(self.output.format, Format::Ply | Format::Soup | Format::Stl);
        let size = (bounds.max - bounds.min).max_element();
        let spacing = spacing(bounds.min.abs().max(bounds.max.abs()).max_element());
        if is_32_bit && spacing > COARSE * size && size > 0.0 {
            let file = self.output.path.display();
            tracing::warn!(
                "{file}: its 32-bit numbers are {spacing:.1e} apart this far from the origin, the cage is {size:.1e} large; \
                 .obj and .glb keep its shape"
            );
        }
    }
}

/// Numbers farther apart than this part of the cage's size show as steps.
const COARSE: f64 = 1e-4;

/// The distance from a number to its neighbour among 32-bit floats.
fn spacing(number: f64) -> f64 {
    let number = number as f32;
    f64::from(number.next_up()) - f64::from(number)
}

/// What a vertex is, in a surface or in all parts of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Key {
    Whole(VertexKey),
    Part(WholeKey),
}

/// A surface, or a part of one, with its texture coordinates if they are asked for.
struct Piece<'a> {
    surface: &'a Surface,
    part: Option<&'a Part>,
    uv: Option<UvTables>,
}

impl Piece<'_> {
    fn corner(&self, vertex: &CapturedVertex) -> Corner<Key> {
        let plan = self.surface.plan();
        let key = match self.part {
            None => Key::Whole(VertexKey::of(plan, vertex)),
            Some(part) => Key::Part(part.key(vertex)),
        };
        let uv = self.uv.as_ref().map_or([0.0; 2], |uv| uv.at(plan, vertex.patch, vertex.uv));
        Corner { key, position: vertex.position.into(), normal: vertex.normal.into(), uv }
    }

    fn place(&self, vertex: &CapturedVertex) -> Place {
        let uv = vertex.uv.map(f64::from);
        self.part.map_or_else(|| self.surface.place(vertex.patch, uv), |part| part.place(vertex.patch, uv))
    }
}

/// A surface about to be drawn into memory.
struct Drawing<'a> {
    job: &'a Job,
    cage: &'a Cage,
    surface: WholeOrParts<'a>,
    maps: Maps,
    tessellation: Tessellation,
    progress: Progress,
}

impl Drawing<'_> {
    fn export(&mut self, format: Format, path: &Path) -> Result<(), WriteError> {
        let writer: fn(&Mesh, &mut dyn Write) -> io::Result<()> = match format {
            Format::Soup => {
                let soup = self.soup(path)?;
                tracing::info!("{} vertices, {} triangles", soup.vertices(), soup.vertices() / 3);
                return Ok(whole_file::write(path, |out| soup.write(out))?);
            }
            Format::Ply => ply::write,
            Format::Obj => obj::write,
            Format::Glb => glb::write,
            Format::Stl => stl::write,
        };
        let mesh = self.welded()?;
        tracing::info!("{} vertices, {} triangles", mesh.positions.len(), mesh.triangles.len());
        Ok(whole_file::write(path, |out| writer(&mesh, out))?)
    }

    /// All triangles, with one vertex per key.
    fn welded(&mut self) -> Result<Mesh, WriteError> {
        let mut welder = Welder::new(CageSpace::new(self.cage.bounds()), self.job.uv_origin(self.cage));
        self.capture(|piece, triangle| {
            let joined = welder.push([0, 1, 2].map(|i| piece.corner(&triangle[i])));
            joined.ok_or_else(|| Failure::usage("more vertices than 32-bit indices can count; lower the level").into())
        })?;
        Ok(welder.finish())
    }

    /// All triangles as they come.
    fn soup(&mut self, path: &Path) -> Result<Soup, WriteError> {
        let cage = self.cage;
        let mut soup = Soup::new(CageSpace::new(cage.bounds()), path)?;
        self.capture(|piece, triangle| {
            triangle.iter().try_for_each(|vertex| Ok(soup.push(&placed(cage, piece, vertex))?))
        })?;
        Ok(soup)
    }

    /// Hands the triangles on, one by one, with the piece of the surface that they are of.
    fn capture(
        &mut self,
        mut sink: impl FnMut(&Piece<'_>, &[CapturedVertex; 3]) -> Result<(), WriteError>,
    ) -> Result<(), WriteError> {
        let Self { job, cage: whole, surface, maps, tessellation, progress } = self;
        let has_uv = job.uv_origin(whole).is_some();
        let mut capture = |surface: &Surface, cage: &Cage, part: Option<&Part>| {
            let surface = &maps.apply(surface.clone(), cage, &job.input.file)?;
            let uv = cage.uv().filter(|_| has_uv).map(|uv| UvTables::new(surface.plan(), uv, |uv| uv));
            let piece = Piece { surface, part, uv };
            surface.capture(tessellation, |vertices| {
                vertices.as_chunks::<3>().0.iter().try_for_each(|triangle| sink(&piece, triangle))?;
                let patches = vertices.chunk_by(|a, b| a.patch == b.patch).count();
                progress.advance(patches as u64);
                Ok(())
            })
        };
        match surface {
            WholeOrParts::Whole(surface) => capture(surface, whole, None),
            WholeOrParts::Parts(parts) => {
                parts.for_each(|part| capture(part.surface(), part.cage().cage(), Some(part)))
            }
        }
    }
}

fn placed(cage: &Cage, piece: &Piece<'_>, vertex: &CapturedVertex) -> SoupVertex {
    let Place { sub_face: SubFace { face, sub }, st, .. } = piece.place(vertex);
    let (position, normal) = (Vec3::from(vertex.position), Vec3::from(vertex.normal));
    SoupVertex { position, normal, face: cage.source_face(face) as i32, sub, st: st.map(|x| x as f32) }
}
