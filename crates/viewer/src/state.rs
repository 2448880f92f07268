//! What the window knows of itself, apart from what is on the device: panels and keys change this, and the session follows.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use osculate::gpu::PresentMode;
use osculate::{Culling, Difference, Scheme, Shade, Target};
use osculate_cage::{Bounds, Cage};

use crate::camera::{CameraPose, Orbit};
use crate::census::Census;
use crate::dialog::FileDialog;
use crate::dress::Dress;
use crate::keys::Action;
use crate::models::{Models, title};
use crate::pace::Frames;
use crate::picking::Picked;
use crate::scene::{Scene, Wanted};
use crate::settings::Settings;
use crate::stage::Measured;
use crate::status::Status;

/// All that keys, mouse and panels can change, and all that panels tell.
pub(crate) struct State {
    pub(crate) settings: Settings,
    pub(crate) models: Models,
    /// The eye; none before the first model.
    pub(crate) orbit: Option<Orbit>,
    /// The camera that the first model is to be seen from.
    pub(crate) first_camera: Option<CameraPose>,
    /// Flies instead of circling.
    pub(crate) flies: bool,
    /// Adaptive factors stay as they are.
    pub(crate) frozen: bool,
    /// Where the line of the wipe is, in parts of the width.
    pub(crate) wipe: f32,
    pub(crate) playback: Playback,
    pub(crate) sculpting: Sculpting,
    pub(crate) picked: Option<Picked>,
    /// Where maps come from.
    pub(crate) dress: Option<Dress>,
    /// Shaders were read so often.
    pub(crate) shaders: u32,
    pub(crate) status: Status,
    /// The list of keys is shown.
    pub(crate) help: bool,
    pub(crate) dialog: Option<FileDialog>,
    /// What is to be done once all panels are drawn.
    pub(crate) actions: Vec<Action>,
    pub(crate) device: DeviceFacts,
    pub(crate) model: Option<ModelFacts>,
    pub(crate) figures: Figures,
}

/// The device, for people.
#[derive(Clone, Debug, Default)]
pub(crate) struct DeviceFacts {
    pub(crate) name: String,
    pub(crate) driver: String,
    pub(crate) modes: Vec<PresentMode>,
    /// Samples that a pixel may have.
    pub(crate) samples: Vec<u32>,
    pub(crate) wireframe: bool,
    /// Times of single passes mean something.
    pub(crate) times_passes: bool,
}

/// The model that is shown, for people.
#[derive(Clone, Debug)]
pub(crate) struct ModelFacts {
    pub(crate) file: PathBuf,
    pub(crate) revision: u32,
    pub(crate) cage: Arc<Cage>,
    pub(crate) surfaces: Vec<(Scheme, Arc<Census>)>,
    pub(crate) difference: Option<Difference>,
    /// Bytes on the device.
    pub(crate) bytes: u64,
    /// Name and length in seconds.
    pub(crate) animations: Vec<(String, f64)>,
}

/// What was measured.
#[derive(Clone, Debug, Default)]
pub(crate) struct Figures {
    pub(crate) frames: Frames,
    pub(crate) measured: Measured,
    /// Seconds that the host worked for the last frame.
    pub(crate) host: f64,
    /// Bytes of device memory in use.
    pub(crate) memory: u64,
    /// Width and height of the picture in pixels.
    pub(crate) size: [u32; 2],
}

/// The animation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Playback {
    pub(crate) plays: bool,
    /// Number of the animation.
    pub(crate) animation: usize,
    /// Seconds from its beginning.
    pub(crate) time: f64,
    /// Seconds of animation for one of the clock.
    pub(crate) speed: f64,
    /// The pose is that of the animation, not that of rest.
    pub(crate) is_posed: bool,
}

impl Default for Playback {
    fn default() -> Self {
        Self { plays: false, animation: 0, time: 0.0, speed: 1.0, is_posed: false }
    }
}

/// Moving vertices of the cage by hand.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sculpting {
    /// All vertices of the cage, once one was moved.
    pub(crate) points: Option<Arc<Vec<DVec3>>>,
    /// The one under the pointer.
    pub(crate) hovered: Option<usize>,
    /// The one that is being moved.
    pub(crate) dragged: Option<usize>,
    /// How often they were moved and let go.
    pub(crate) moves: u64,
    /// They are not yet where they should be on the device.
    pub(crate) is_new: bool,
}

impl State {
    /// A window that shows nothing yet.
    pub(crate) fn new(settings: Settings, files: Vec<PathBuf>, first_camera: Option<CameraPose>) -> Self {
        Self {
            settings,
            models: Models::new(files),
            orbit: None,
            first_camera,
            flies: false,
            frozen: false,
            wipe: 0.5,
            playback: Playback::default(),
            sculpting: Sculpting::default(),
            picked: None,
            dress: None,
            shaders: 0,
            status: Status::default(),
            help: false,
            dialog: None,
            actions: Vec::new(),
            device: DeviceFacts::default(),
            model: None,
            figures: Figures::default(),
        }
    }

    /// Whether a shade has something to show on the model; without a model all have.
    pub(crate) fn can_show(&self, shade: Shade) -> bool {
        self.model.as_ref().is_none_or(|model| Dress::suits(self.dress.as_ref(), &model.cage, shade))
    }

    /// The same on a device that is not open yet.
    pub(crate) fn forget_device(self) -> Self {
        Self { model: self.model, figures: Figures::default(), actions: Vec::new(), ..self }
    }

    /// What the builder is to make; none without a model.
    pub(crate) fn wanted(&self, target: Target) -> Option<Wanted> {
        let look = &self.settings.look;
        let difference = look.shows_difference();
        let compared = look.compare != crate::choice::Compare::Off && !difference;
        let second = compared.then_some(look.against);
        Some(Wanted {
            file: self.models.wanted()?.to_owned(),
            revision: self.models.revision(),
            schemes: std::iter::once(look.scheme).chain(second).collect(),
            against: difference.then_some(look.against),
            evaluator: look.evaluator,
            adaptive: look.adaptive.then_some(look.pixels),
            level: look.level,
            spacing: look.spacing,
            shade: look.shown(),
            cage: look.cage,
            culling: if look.culling { Culling::ALL } else { Culling::NONE },
            target,
            moves: if difference { self.sculpting.moves } else { 0 },
            shaders: self.shaders,
        })
    }

    /// Takes note of a scene that is shown from now on. Says whether it is another model than before.
    pub(crate) fn show(&mut self, scene: &Scene, aspect: f64) -> bool {
        let is_new = self
            .model
            .as_ref()
            .is_none_or(|model| (&model.file, model.revision) != (&scene.wanted.file, scene.wanted.revision));
        if is_new {
            let was_elsewhere = self.model.as_ref().is_none_or(|model| model.file != scene.wanted.file);
            self.playback = Playback { speed: self.playback.speed, plays: self.playback.plays, ..Playback::default() };
            self.sculpting = Sculpting::default();
            self.picked = None;
            if was_elsewhere || self.orbit.is_none() {
                let first = self.first_camera.take().map(|pose| Orbit::looking(&pose));
                self.orbit = Some(first.unwrap_or_else(|| Orbit::fit(scene.cage.bounds(), aspect)));
            }
        }
        self.model = Some(ModelFacts {
            file: scene.wanted.file.clone(),
            revision: scene.wanted.revision,
            cage: Arc::clone(&scene.cage),
            surfaces: scene.sides.iter().map(|side| (side.scheme, Arc::clone(&side.census))).collect(),
            difference: scene.difference,
            bytes: scene.bytes(),
            animations: scene.animations().map(|(name, length)| (name.to_owned(), length)).collect(),
        });
        is_new
    }

    /// The box of the model's cage.
    pub(crate) fn bounds(&self) -> Bounds {
        self.model.as_ref().map_or(Bounds::of(&[]), |model| model.cage.bounds())
    }

    /// Name of the model that is shown.
    pub(crate) fn title(&self) -> Option<String> {
        self.model.as_ref().map(|model| title(&model.file))
    }

    /// File and revision of the model that is shown.
    pub(crate) fn shown(&self) -> Option<(&Path, u32)> {
        self.model.as_ref().map(|model| (model.file.as_path(), model.revision))
    }

    /// Whether an animation is going on.
    pub(crate) fn is_playing(&self) -> bool {
        self.playback.plays && self.model.as_ref().is_some_and(|model| !model.animations.is_empty())
    }

    /// Lets the animation go on by seconds of the clock.
    pub(crate) fn advance(&mut self, seconds: f64) {
        if !self.is_playing() {
            return;
        }
        let Some(model) = &self.model else { return };
        let playback = &mut self.playback;
        playback.animation = playback.animation.min(model.animations.len() - 1);
        let length = model.animations[playback.animation].1;
        let time = playback.time + playback.speed * seconds;
        playback.time = if length > 0.0 { time.rem_euclid(length) } else { 0.0 };
        playback.is_posed = true;
        self.sculpting.points = None;
    }

    /// Where the vertices of the cage are, as far as the host knows: not while an animation moves them.
    pub(crate) fn points(&self) -> Option<&[DVec3]> {
        let model = self.model.as_ref().filter(|_| !self.playback.is_posed)?;
        Some(self.sculpting.points.as_ref().map_or(model.cage.positions(), |points| points.as_slice()))
    }

    /// Whether vertices can be moved by the mouse: they can be seen.
    pub(crate) fn can_sculpt(&self) -> bool {
        let look = &self.settings.look;
        (look.cage || look.points) && !self.flies && self.points().is_some()
    }

    /// Moves the dragged vertex along with the pointer, by pixels of a picture of that height.
    pub(crate) fn drag_vertex(&mut self, pixels: DVec2, size: DVec2) {
        let (Some(vertex), Some(orbit), Some(model)) = (self.sculpting.dragged, &self.orbit, &self.model) else {
            return;
        };
        let points = self.sculpting.points.get_or_insert_with(|| Arc::new(model.cage.positions().to_vec()));
        let Some((_, depth)) = points.get(vertex).and_then(|&point| orbit.project(point, size)) else { return };
        let [right, up, _] = orbit.basis();
        let length = orbit.pixel(depth, size.y);
        Arc::make_mut(points)[vertex] += length * (pixels.x * right - pixels.y * up);
        self.sculpting.is_new = true;
        self.picked = None;
    }

    /// Puts all vertices back.
    pub(crate) fn restore(&mut self) {
        self.playback = Playback { speed: self.playback.speed, ..Playback::default() };
        let moves = self.sculpting.moves + 1;
        self.sculpting = Sculpting { is_new: true, moves, ..Sculpting::default() };
        self.picked = None;
    }
}
