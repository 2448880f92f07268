//! Pictures of what moves.

use super::Job;
use super::scene::{Scene, warn_if_blank};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::input::Input;
use crate::options::{Film, Moment, Motion};
use crate::progress::Progress;
use osculate::{Animator, Engine};
use osculate_cage::{Bounds, Sequence};

/// What moves the surfaces of a scene.
enum Mover<'a> {
    /// A rig, on the device: an animator for each surface.
    Rig { animation: usize, animators: Vec<Animator> },
    /// Positions from files.
    Frames(&'a Sequence),
}

impl<'a> Mover<'a> {
    fn new(scene: &mut Scene<'_>, input: &Input, film: &Film, sequence: &'a Sequence) -> Result<Self, Failure> {
        let Motion::Rig(animation) = film.motion else { return Ok(Self::Frames(sequence)) };
        let animators = scene.surfaces().map(|surface| Animator::new(surface, &input.cage));
        Ok(Self::Rig { animation, animators: animators.collect::<Result<_, _>>()? })
    }

    /// Moves the surfaces to where they are at a time.
    fn show(&mut self, scene: &mut Scene<'_>, seconds: f64) -> Result<(), Failure> {
        match self {
            Self::Rig { animation, animators } => {
                for (surface, animator) in scene.surfaces().zip(animators) {
                    animator.set_time(*animation, seconds)?;
                    surface.animate(animator)?;
                }
            }
            Self::Frames(sequence) => {
                let positions = sequence.positions_at(seconds).map_err(Failure::input)?;
                for surface in scene.surfaces() {
                    surface.set_points(&positions)?;
                }
            }
        }
        Ok(())
    }

    /// The box of the cage at a time.
    fn bounds(&self, seconds: f64) -> Result<Bounds, Failure> {
        Ok(Bounds::of(&match self {
            Self::Rig { animation, animators } => {
                let rig = animators[0].rig();
                rig.positions(&rig.pose(*animation, seconds))
            }
            Self::Frames(sequence) => sequence.positions_at(seconds).map_err(Failure::input)?,
        }))
    }

    /// A box around the cage at a time, no smaller than it; found without moving a vertex where a rig moves them.
    fn reach(&self, seconds: f64) -> Result<Bounds, Failure> {
        match self {
            Self::Rig { animation, animators } => {
                Ok(animators[0].bounds(&animators[0].rig().pose(*animation, seconds))?)
            }
            Self::Frames(_) => self.bounds(seconds),
        }
    }
}

impl Job {
    /// Draws the moments of a film one after another. An interruption leaves the pictures that are whole.
    pub(super) fn draw_film(
        &self,
        engine: &Engine,
        (input, sequence): &(Input, Sequence),
        film: &Film,
        global: &GlobalArgs,
    ) -> Result<(), Failure> {
        let mut scene = self.scene(engine, input)?;
        let mut mover = Mover::new(&mut scene, input, film, sequence)?;
        let mut desc = self.desc(film.bounds(|seconds| mover.bounds(seconds))?)?;
        let stand = desc.camera;
        let progress = Progress::new(global.quiet, film.moments().len() as u64, "drawing frames");
        let mut was_blank = false;
        for Moment { number, seconds } in film.moments() {
            mover.show(&mut scene, seconds)?;
            // A picture depends on its own moment alone, and so do its depths.
            desc.camera = stand.reaching(mover.reach(seconds)?);
            let path = match (&self.numbered, number) {
                (Some(numbered), Some(number)) => numbered.of(number),
                _ => self.output.path.clone(),
            };
            let drawn = scene.draw(&desc)?;
            was_blank = was_blank || warn_if_blank(&path, &drawn.0);
            scene.write(&path, &drawn, number)?;
            progress.advance(1);
        }
        Ok(())
    }
}
