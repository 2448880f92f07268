//! A window in which surfaces can be looked at from all sides, compared, changed and measured: `osculate view`.
//!
//! [`run`] opens it and returns when it is closed. Everything that takes long (reading, planning, making pipelines, picking) happens on
//! a thread of its own, so the window answers meanwhile.

mod actions;
mod app;
mod builder;
mod camera;
mod census;
mod choice;
mod dialog;
mod dress;
mod error;
mod hud;
mod input;
mod keys;
mod marks;
mod models;
mod pace;
mod painter;
mod panels;
mod picking;
#[cfg(feature = "hot-reload")]
mod reload;
mod scene;
mod screenshot;
mod session;
mod settings;
mod stage;
mod state;
mod status;
mod stream;
mod theme;
mod views;

use std::path::PathBuf;

use osculate::{Evaluator, Scheme, Shade, Spacing};
use osculate_cage::ReadDesc;
use winit::event_loop::EventLoop;

use crate::app::App;
use crate::settings::Settings;
use crate::state::State;

pub use camera::{CameraPose, CameraPoseError};
pub use dress::Dress;
pub use error::ViewerError;

/// What the window is opened with.
#[derive(Clone, Debug)]
pub struct ViewerDesc {
    /// The models; the first one is shown.
    pub files: Vec<PathBuf>,
    /// How they are read.
    pub read: ReadDesc,
    /// Gives surfaces displacement and colours; `None` leaves them as they are, and the shades that need maps out of reach.
    pub dress: Option<Dress>,
    /// The device's number or a part of its name; `None` takes the best.
    pub device: Option<String>,
    /// Switches validation on; any message is an error in the end.
    pub validation: bool,
    /// Where the first model is seen from; `None` shows all of it.
    pub camera: Option<CameraPose>,
    /// Width and height of the window in points; `None` takes those of the last run.
    pub size: Option<[u32; 2]>,
    /// What the surface looks like at first, in place of what it looked like in the last run.
    pub look: LookDesc,
    /// Where settings are kept from run to run; `None` keeps nothing.
    pub settings: Option<PathBuf>,
    /// Folder in which drivers' pipelines are kept from run to run; `None` keeps nothing.
    pub pipeline_cache: Option<PathBuf>,
    /// Folder that screenshots go to.
    pub screenshots: PathBuf,
    /// For tests: the window is said to be out of date in every frame of that many.
    pub force_out_of_date: Option<u64>,
    /// For tests: the device is said to be lost in this frame.
    pub lose_device: Option<u64>,
}

impl Default for ViewerDesc {
    fn default() -> Self {
        Self {
            files: Vec::new(),
            read: ReadDesc::default(),
            dress: None,
            device: None,
            validation: false,
            camera: None,
            size: None,
            look: LookDesc::default(),
            settings: None,
            pipeline_cache: None,
            screenshots: PathBuf::from("."),
            force_out_of_date: None,
            lose_device: None,
        }
    }
}

/// What the surface looks like at first; `None` leaves it as it was in the last run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LookDesc {
    /// How the surface is put together.
    pub scheme: Option<Scheme>,
    /// Who evaluates it.
    pub evaluator: Option<Evaluator>,
    /// Segments of a patch edge, 1 to 64.
    pub level: Option<f32>,
    /// Length of segments in pixels, in place of a level.
    pub adaptive: Option<f32>,
    /// Where vertices are put on an edge.
    pub spacing: Option<Spacing>,
    /// What colours mean.
    pub shade: Option<Shade>,
    /// Whether the edges of the cage are drawn.
    pub cage: Option<bool>,
}

/// Opens the window, and returns when it is closed.
///
/// # Errors
/// If there is nowhere to open a window, no device can draw to it, the device fails, or validation has anything to say. What is wrong
/// with a file is shown in the window.
pub fn run(desc: ViewerDesc) -> Result<(), ViewerError> {
    let event_loop =
        EventLoop::with_user_event().build().map_err(|error| ViewerError::NoDisplay { reason: error.to_string() })?;
    let mut settings = desc.settings.as_deref().map(Settings::load).unwrap_or_default();
    settings.look.take(&desc.look);
    let mut state = State::new(settings, desc.files.clone(), desc.camera);
    state.dress = desc.dress.clone();
    let file = desc.settings.clone();
    let mut app = App::new(desc, event_loop.create_proxy(), state);
    let ended = event_loop.run_app(&mut app);
    let state = app.close();
    if let (Some(file), Some(state)) = (file, state)
        && let Err(error) = state.settings.save(&file)
    {
        tracing::warn!("{}: settings cannot be kept: {error}", file.display());
    }
    if let Some(failure) = app.failure.take() {
        return Err(failure);
    }
    ended.map_err(|error| ViewerError::WindowSystem { reason: error.to_string() })?;
    let messages: Vec<String> = app.logs.iter().flat_map(|log| log.all()).collect();
    messages.iter().for_each(|message| tracing::error!("{message}"));
    if messages.is_empty() { Ok(()) } else { Err(ViewerError::Validation { count: messages.len() }) }
}
