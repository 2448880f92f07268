//! Pictures of an animation.

use super::Job;
use super::scene::warn_if_blank;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::input::Input;
use crate::options::{Film, Moment};
use crate::progress::Progress;
use osculate::{Animator, Engine};
use osculate_cage::Bounds;

impl Job {
    /// Draws the moments of a film one after another. An interruption leaves the pictures that are whole.
    pub(super) fn draw_film(
        &self,
        engine: &Engine,
        input: &Input,
        film: &Film,
        global: &GlobalArgs,
    ) -> Result<(), Failure> {
        let mut scene = self.scene(engine, input)?;
        let mut animators: Vec<Animator> =
            scene.surfaces().map(|surface| Animator::new(surface, &input.cage)).collect::<Result<_, _>>()?;
        let mut desc = self.desc(film.bounds(animators[0].rig()))?;
        desc.camera = desc.camera.reaching(reach(&animators[0], film)?);
        let progress = Progress::new(global.quiet, film.moments().len() as u64, "drawing frames");
        let mut was_blank = false;
        for Moment { number, seconds } in film.moments() {
            for (surface, animator) in scene.surfaces().zip(&mut animators) {
                animator.set_time(film.animation, seconds)?;
                surface.animate(animator)?;
            }
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

/// A box around the cage in all frames, those of other parts too.
fn reach(animator: &Animator, film: &Film) -> Result<Bounds, Failure> {
    let mut corners = Vec::new();
    for moment in film.all_moments() {
        let Bounds { min, max } = animator.bounds(&animator.rig().pose(film.animation, moment.seconds))?;
        corners.extend([min, max]);
    }
    Ok(Bounds::of(&corners))
}
