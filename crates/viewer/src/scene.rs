//! What is shown: a cage with its surfaces, ready to be drawn.

use std::path::PathBuf;
use std::sync::Arc;

use glam::DVec3;
use osculate::{
    Animator, Culling, Difference, Drawing, DrawingDesc, EngineError, Evaluator, Factors, Recording, Scheme, Shade,
    Spacing, Surface, Target, Tessellation,
};
use osculate_cage::{Bounds, Cage, Sequence};

use crate::camera::Orbit;
use crate::census::Census;

/// What is wanted of the builder. Two that are equal have equal scenes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// The model.
    pub(crate) file: PathBuf,
    /// How often it was read again.
    pub(crate) revision: u32,
    /// The schemes that are drawn.
    pub(crate) schemes: Vec<Scheme>,
    /// The scheme that distances are measured to, if they are shown.
    pub(crate) against: Option<Scheme>,
    pub(crate) evaluator: Evaluator,
    /// Length of segments in pixels, or else the level.
    pub(crate) adaptive: Option<f32>,
    pub(crate) level: f32,
    pub(crate) spacing: Spacing,
    pub(crate) shade: Shade,
    pub(crate) cage: bool,
    pub(crate) culling: Culling,
    pub(crate) target: Target,
    /// How often the cage was moved by hand, where that must be measured anew.
    pub(crate) moves: u64,
    /// How often shaders were read again.
    pub(crate) shaders: u32,
}

/// Where a scene is seen from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight {
    /// None for a model that was not seen yet.
    pub(crate) orbit: Option<Orbit>,
    /// Width and height of one view in pixels.
    pub(crate) size: [u32; 2],
}

/// A model and its surfaces.
pub(crate) struct Scene {
    pub(crate) wanted: Wanted,
    pub(crate) cage: Arc<Cage>,
    /// The frames, of a model that has several.
    pub(crate) sequence: Option<Arc<Sequence>>,
    pub(crate) sides: Vec<Side>,
    /// The distances that are shown.
    pub(crate) difference: Option<Difference>,
}

/// A surface of the scene.
pub(crate) struct Side {
    pub(crate) scheme: Scheme,
    pub(crate) drawing: Drawing,
    /// What plays the file's animations.
    pub(crate) animator: Option<Animator>,
    pub(crate) census: Arc<Census>,
}

impl Wanted {
    /// How a surface is drawn.
    pub(crate) fn drawing(&self, sight: &Sight, bounds: Bounds) -> DrawingDesc {
        let [width, height] = sight.size.map(|side| side.max(1));
        let aspect = f64::from(width) / f64::from(height);
        let first = Orbit::fit(bounds, aspect);
        let camera = sight.orbit.unwrap_or(first).camera(bounds).or_else(|_| first.camera(bounds));
        let camera = camera.unwrap_or_else(|_| osculate::Camera::fit(bounds));
        let factors = match self.adaptive {
            Some(pixels) => Factors::Adaptive { pixels, camera, height },
            None => Factors::Uniform(self.level),
        };
        DrawingDesc {
            tessellation: Tessellation { factors, spacing: self.spacing, evaluator: self.evaluator },
            shade: self.shade,
            cage: self.cage,
            culling: self.culling,
            target: self.target,
            camera,
            size: [width, height],
        }
    }

    /// Whether what is on screen can stay where it is: the same model, drawn in another way.
    pub(crate) fn same_model(&self, other: &Self) -> bool {
        self.file == other.file
    }
}

impl Scene {
    /// Records the passes that follow when vertices have moved; `by_rig` if an animation moves them, else they were written.
    pub(crate) fn record_update(&self, recording: &mut Recording, by_rig: bool) -> Result<(), EngineError> {
        for side in &self.sides {
            match &side.animator {
                Some(animator) if by_rig => {
                    animator.record(recording)?;
                    side.surface().record_derived(recording)?;
                }
                _ => side.surface().record_update(recording)?,
            }
            side.drawing.record(recording);
        }
        Ok(())
    }

    /// Moves the vertices of the cage; they are used when the passes of [`Self::record_update`] run.
    pub(crate) fn write_points(&self, points: &[DVec3]) -> Result<(), EngineError> {
        self.sides.iter().try_for_each(|side| side.surface().write_points(points))
    }

    /// Sets the pose of an animation at a time in seconds.
    pub(crate) fn set_time(&mut self, animation: usize, seconds: f64) -> Result<(), EngineError> {
        let mut animators = self.sides.iter_mut().filter_map(|side| side.animator.as_mut());
        animators.try_for_each(|animator| animator.set_time(animation, seconds))
    }

    /// Bytes on the device.
    pub(crate) fn bytes(&self) -> u64 {
        self.sides.iter().map(|side| side.drawing.bytes() + side.surface().bytes()).sum()
    }

    /// Name and length in seconds of every animation; of a sequence its frames.
    pub(crate) fn animations(&self) -> impl Iterator<Item = (&str, f64)> {
        let length = |times: &[f64]| times.last().unwrap_or(&0.0) - times.first().unwrap_or(&0.0);
        let frames = self.sequence.iter().map(move |sequence| ("frames", length(sequence.times())));
        let rig = self.sides.first().and_then(|side| side.animator.as_ref()).map(Animator::rig);
        rig.into_iter().flat_map(|rig| &rig.animations).map(|one| (one.name.as_str(), one.duration())).chain(frames)
    }
}

impl Side {
    pub(crate) fn surface(&self) -> &Surface {
        self.drawing.surface()
    }
}
