//! What `render` draws and writes.

use super::Job;
use crate::failure::{Failure, PLACE_HINT};
use crate::input::Input;
use crate::stdout;
use osculate::{Difference, Engine, RenderDesc, Scheme, Surface, SurfaceDesc, render, render_difference};
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
        picture.write(path).map_err(|error| Failure::usage(error).with_hint(PLACE_HINT))?;
        let bytes = std::fs::metadata(path).map_or(0, |found| found.len());
        tracing::info!("{}: {} pixels, {bytes} bytes", path.display(), picture.size());
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
    /// The surfaces on the device.
    pub(super) fn scene<'a>(&'a self, engine: &'a Engine, input: &Input) -> Result<Scene<'a>, Failure> {
        let maps = self.maps(&input.cage)?;
        let surface = |scheme| {
            let desc = SurfaceDesc { scheme, boundary: Some(input.boundary) };
            let surface = Surface::new(engine, &input.cage, &desc).map_err(|error| self.input.refuse(error))?;
            maps.apply(surface, &input.cage, &self.input.file)
        };
        let size = 2.0 * input.cage.bounds().half_diagonal();
        let against = self.against.map(surface).transpose()?;
        Ok(Scene { job: self, engine, drawn: surface(self.scheme)?, against, size })
    }

    /// Draws the cage as it is in its file.
    pub(super) fn draw_still(&self, engine: &Engine, input: &Input) -> Result<(), Failure> {
        let desc = self.desc(input.cage.bounds())?;
        let scene = self.scene(engine, input)?;
        let drawn = scene.draw(&desc)?;
        warn_if_blank(&self.output.path, &drawn.0);
        scene.write(&self.output.path, &drawn, None)
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
