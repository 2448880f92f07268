//! What `render` draws and writes.

use super::Job;
use crate::args::GlobalArgs;
use crate::failure::{Failure, PLACE_HINT};
use crate::input::Input;
use crate::progress::Progress;
use crate::stdout;
use osculate::{
    Difference, Engine, Parts, RenderDesc, Scheme, Surface, SurfaceDesc, WholeOrParts, render, render_difference,
};
use osculate_compare::Picture;
use std::fmt;
use std::path::Path;

/// What is drawn of a cage: its surface, and for the shade difference the one that it is compared with.
pub(super) struct Scene<'a> {
    job: &'a Job,
    engine: &'a Engine,
    drawn: Surface,
    against: Option<Surface>,
    /// Diagonal of the cage's box.
    size: f64,
}

/// A picture, and what the shade difference measured.
pub(super) type Drawn = (Picture, Option<Difference>);

impl Scene<'_> {
    /// All surfaces of the scene.
    pub(super) fn surfaces(&mut self) -> impl Iterator<Item = &mut Surface> {
        std::iter::once(&mut self.drawn).chain(&mut self.against)
    }

    /// Draws them as they are now.
    pub(super) fn draw(&self, desc: &RenderDesc) -> Result<Drawn, Failure> {
        let (picture, difference) = match &self.against {
            None => (render(self.engine, &[&self.drawn], desc)?, None),
            Some(against) => {
                let (picture, found) =
                    render_difference(self.engine, [&self.drawn, against], desc, self.job.look.range)?;
                (picture, Some(found))
            }
        };
        let [width, height] = picture.size;
        Ok((Picture::new(width, height, picture.rgba).map_err(Failure::device)?, difference))
    }

    /// Writes a picture, and prints what was measured.
    pub(super) fn write(&self, path: &Path, (picture, difference): &Drawn, number: Option<u32>) -> Result<(), Failure> {
        self.job.write_picture(path, picture)?;
        if let (Some(difference), Some(against)) = (*difference, self.job.against) {
            let distances = Distances { difference, schemes: [self.job.scheme, against], size: self.size };
            match number {
                Some(number) => stdout::print_line(format_args!("frame {number}: {distances}"))?,
                None => stdout::print_line(distances)?,
            }
        }
        Ok(())
    }
}

/// Says so if there is nothing to be seen.
pub(super) fn warn_if_blank(path: &Path, picture: &Picture) -> bool {
    let first = picture.pixels().next();
    let is_blank = picture.pixels().all(|pixel| Some(pixel) == first);
    if is_blank {
        tracing::warn!(
            "{}: the picture is blank: the surface is out of view, too small to be seen, or fills it evenly",
            path.display()
        );
    }
    is_blank
}

impl Job {
    fn surface_desc(&self, scheme: Scheme, input: &Input) -> SurfaceDesc {
        SurfaceDesc { scheme, boundary: Some(input.boundary), refinement: self.refine.into() }
    }

    /// The surfaces on the device.
    pub(super) fn scene<'a>(&'a self, engine: &'a Engine, input: &Input) -> Result<Scene<'a>, Failure> {
        let desc = self.surface_desc(self.scheme, input);
        let surface = Surface::new(engine, &input.cage, &desc).map_err(|error| self.input.refuse(error))?;
        self.scene_of(engine, input, surface)
    }

    /// The surfaces on the device, one of which is there, without maps.
    fn scene_of<'a>(&'a self, engine: &'a Engine, input: &Input, drawn: Surface) -> Result<Scene<'a>, Failure> {
        let maps = self.maps(&input.cage)?;
        let dressed = |surface| maps.apply(surface, &input.cage, &self.input.file);
        let surface = |scheme| {
            let desc = self.surface_desc(scheme, input);
            dressed(Surface::new(engine, &input.cage, &desc).map_err(|error| self.input.refuse(error))?)
        };
        let size = 2.0 * input.cage.bounds().half_diagonal();
        let against = self.against.map(surface).transpose()?;
        Ok(Scene { job: self, engine, drawn: dressed(drawn)?, against, size })
    }

    /// Draws the cage as it is in its file.
    pub(super) fn draw_still(&self, engine: &Engine, input: &Input, global: &GlobalArgs) -> Result<(), Failure> {
        let desc = self.desc(input.cage.bounds())?;
        let surface = self.surface_desc(self.scheme, input);
        let made = WholeOrParts::new(engine, &input.cage, &self.parts.desc(surface));
        let scene = match made.map_err(|error| self.input.refuse(error))? {
            WholeOrParts::Whole(surface) => self.scene_of(engine, input, surface)?,
            WholeOrParts::Parts(parts) => return self.draw_parts(parts, &desc, global),
        };
        let drawn = scene.draw(&desc)?;
        warn_if_blank(&self.output.path, &drawn.0);
        scene.write(&self.output.path, &drawn, None)
    }

    /// Draws a cage that is too large for the device.
    fn draw_parts(&self, mut parts: Parts<'_>, desc: &RenderDesc, global: &GlobalArgs) -> Result<(), Failure> {
        if self.against.is_some() {
            return Err(Failure::usage(format_args!(
                "{}: the shade difference is not drawn of a cage in {} parts",
                self.input.file.display(),
                parts.count()
            ))
            .with_hint("choose another shade, a smaller cage, or a --device whose shaders see more"));
        }
        let maps = self.maps(parts.cage())?;
        let progress = Progress::in_stages(global.quiet);
        let picture = parts.render(desc, |part| {
            let (number, count) = part.number();
            progress.stage("drawing parts", number as u64, count as u64);
            maps.apply(part.surface().clone(), part.cage().cage(), &self.input.file)
        })?;
        let [width, height] = picture.size;
        let picture = Picture::new(width, height, picture.rgba).map_err(Failure::device)?;
        warn_if_blank(&self.output.path, &picture);
        self.write_picture(&self.output.path, &picture)
    }

    fn write_picture(&self, path: &Path, picture: &Picture) -> Result<(), Failure> {
        picture.write(path).map_err(|error| Failure::usage(error).with_hint(PLACE_HINT))?;
        let bytes = std::fs::metadata(path).map_or(0, |found| found.len());
        tracing::info!("{}: {} pixels, {bytes} bytes", path.display(), picture.size());
        Ok(())
    }
}

/// What the colours of the shade difference stand for.
struct Distances {
    difference: Difference,
    schemes: [Scheme; 2],
    /// Diagonal of the cage's box.
    size: f64,
}

impl fmt::Display for Distances {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([from, to], Difference { largest, mean, range }) = (self.schemes, self.difference);
        let part = if self.size > 0.0 { largest / self.size } else { 0.0 };
        write!(
            out,
            "{from} to {to}: largest distance {largest:.3e} ({part:.1e} of the box's diagonal), mean {mean:.3e}; colours end at {range:.3e}"
        )
    }
}
