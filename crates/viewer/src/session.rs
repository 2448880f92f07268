//! A window on a device: everything that is there while it is open, and what happens to it between frames.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::ViewportId;
use glam::DVec3;
use osculate::gpu::{Format, Presenter, PresenterDesc, Submission, WindowSystem};
use osculate::{Device, DeviceDesc, Engine, EngineDesc, PipelineObserver, PipelineProgress, ShaderSet};
use winit::event::WindowEvent;
use winit::event_loop::EventLoopProxy;
use winit::window::Window;

use crate::actions::Deed;
use crate::app::Wake;
use crate::builder::{Builder, News};
use crate::error::ViewerError;
use crate::marks::Marks;
use crate::pace::Pace;
use crate::painter::Painter;
use crate::scene::{Scene, Wanted};
use crate::stage::{Shown, Stage};
use crate::state::{DeviceFacts, State};
use crate::stream::Stream;
use crate::{ViewerDesc, theme};

mod frame;

/// How long to wait for the device before looking again.
const PATIENCE: Duration = Duration::from_millis(2);

/// Tells sessions apart, of which there are several where a device was lost.
pub(crate) type SessionId = u64;

/// A window and what is drawn to it. Field order is destruction order: what draws goes before what it draws with.
pub(crate) struct Session {
    pub(crate) id: SessionId,
    pub(crate) state: State,
    builder: Builder,
    #[cfg(feature = "hot-reload")]
    watcher: crate::reload::Watcher,
    /// The last frame, on its way.
    in_flight: Option<Submission>,
    stage: Option<Stage>,
    scene: Option<Scene>,
    marks: Option<Marks>,
    /// Reads the frames of the scene's sequence, and the positions that came from there.
    stream: Option<Stream>,
    streamed: Option<Vec<DVec3>>,
    painter: Painter,
    presenter: Presenter,
    shaders: ShaderSet,
    engine: Engine,
    #[cfg(feature = "hot-reload")]
    engine_desc: EngineDesc,
    input: egui_winit::State,
    egui: egui::Context,
    pace: Pace,
    wake: EventLoopProxy<Wake>,
    /// What is to be done in the next frame.
    postponed: Vec<Deed>,
    /// When a frame is wanted.
    next: Option<Instant>,
    /// What the builder was asked for last.
    ordered: Option<Wanted>,
    /// The picture is not what it should be: vertices moved, or the eye, or what is drawn.
    vertices_moved: bool,
    shown: Option<(Shown, [u32; 2], Option<crate::camera::Orbit>)>,
    last_frame: Instant,
    frames: u64,
    screenshots: PathBuf,
    /// For tests: the window is said to be out of date in every frame of that many.
    force_out_of_date: Option<u64>,
    /// For tests: the device is said to be lost in this frame.
    lose_device: Option<u64>,
    pub(crate) window: Arc<Window>,
    pub(crate) is_done: bool,
}

/// Where the picture is in the window.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Layout {
    origin: [u32; 2],
    size: [u32; 2],
}

impl Layout {
    fn aspect(&self) -> f64 {
        f64::from(self.size[0].max(1)) / f64::from(self.size[1].max(1))
    }
}

impl Session {
    /// Opens the device for a window.
    pub(crate) fn open(
        desc: &ViewerDesc,
        window: Arc<Window>,
        (id, wake): (SessionId, &EventLoopProxy<Wake>),
        mut state: State,
    ) -> Result<Self, ViewerError> {
        let device = Device::new(&DeviceDesc {
            select: desc.device.clone(),
            validation: desc.validation,
            application: "osculate".to_owned(),
            windows: Some(WindowSystem::of(&*window)?),
            ..DeviceDesc::default()
        })?;
        let formats = [Format::Bgra8Unorm, Format::Rgba8Unorm, Format::Bgra8Srgb, Format::Rgba8Srgb];
        let mode = state.settings.screen.mode;
        let presenter = device.presenter(
            Arc::clone(&window),
            &PresenterDesc { size: window.inner_size().into(), formats: &formats, mode, ..PresenterDesc::default() },
        )?;
        state.device = facts(&device, &presenter);
        let shaders = ShaderSet::embedded();
        let engine_desc = engine_desc(shaders.clone(), desc, (id, wake));
        let engine = Engine::with(device, engine_desc.clone());
        let egui = egui::Context::default();
        theme::apply(&egui);
        let input = egui_winit::State::new(egui.clone(), ViewportId::ROOT, &*window, None, None, Some(4096));
        let to_window = wake.clone();
        let builder = Builder::start((desc.read.clone(), desc.dress.clone()), move |news| {
            // The window may be gone already.
            let _closed = to_window.send_event(Wake::News(id, Box::new(news)));
        });
        Ok(Self {
            id,
            state,
            builder: builder.map_err(ViewerError::Thread)?,
            #[cfg(feature = "hot-reload")]
            watcher: watcher(wake).map_err(ViewerError::Thread)?,
            in_flight: None,
            stage: None,
            scene: None,
            marks: None,
            stream: None,
            streamed: None,
            wake: wake.clone(),
            painter: Painter::new(engine.device(), &shaders, presenter.format())?,
            presenter,
            shaders,
            engine,
            #[cfg(feature = "hot-reload")]
            engine_desc,
            input,
            egui,
            pace: Pace::default(),
            postponed: Vec::new(),
            next: Some(Instant::now()),
            ordered: None,
            vertices_moved: false,
            shown: None,
            last_frame: Instant::now(),
            frames: 0,
            screenshots: desc.screenshots.clone(),
            force_out_of_date: desc.force_out_of_date,
            lose_device: desc.lose_device,
            window,
            is_done: false,
        })
    }

    /// The device.
    pub(crate) fn device(&self) -> &Device {
        self.engine.device()
    }

    /// Keeps what drivers have made for the next run.
    pub(crate) fn save_pipelines(&self) {
        self.engine.save_pipelines();
    }

    /// When the next frame is due; none if nothing changes.
    pub(crate) fn due(&self, now: Instant) -> Option<Instant> {
        self.next.map(|next| self.pace.wait(now).map_or(next, |wait| wait.max(next)))
    }

    fn wants_frame(&mut self, at: Instant) {
        self.next = Some(self.next.map_or(at, |next| next.min(at)));
    }

    /// Takes note of what happened to the window.
    pub(crate) fn on_event(&mut self, event: &WindowEvent) {
        match event {
            WindowEvent::Resized(size) => self.presenter.resize((*size).into()),
            WindowEvent::DroppedFile(file) => self.state.models.open(file.clone()),
            WindowEvent::KeyboardInput { event, .. }
                if event.state.is_pressed() && !event.repeat && self.on_key(&event.logical_key) =>
            {
                return self.wants_frame(Instant::now());
            }
            _ => {}
        }
        if self.input.on_window_event(&self.window, event).repaint || matches!(event, WindowEvent::DroppedFile(_)) {
            self.wants_frame(Instant::now());
        }
    }

    /// Does what a key says, unless it is typed into a field; whether it did.
    fn on_key(&mut self, key: &winit::keyboard::Key) -> bool {
        let modifiers = self.input.egui_input().modifiers;
        if self.egui.wants_keyboard_input() || modifiers.ctrl || modifiers.alt {
            return false;
        }
        let moves = "wasdqe";
        let is_move = matches!(key, winit::keyboard::Key::Character(text) if moves.contains(&text.to_lowercase()));
        if self.state.flies && is_move {
            return false;
        }
        let action = crate::keys::action(key, modifiers.shift);
        self.state.actions.extend(action);
        action.is_some()
    }

    /// Takes what the builder says.
    pub(crate) fn on_news(&mut self, news: News) -> Result<(), ViewerError> {
        match news {
            News::Progress(text, part) => self.state.status.work = Some((text, part)),
            News::Built(scene) => self.install(*scene)?,
            News::Failed { wanted, message } => {
                self.state.status.work = None;
                self.state.status.error(message);
                self.go_back(&wanted);
            }
            News::Moved(Ok(positions)) => self.streamed = Some(positions),
            News::Moved(Err(message)) => {
                self.state.playback.plays = false;
                self.state.status.error(message);
            }
            News::Picked(Ok(picked)) => {
                self.state.status.work = None;
                if let Some(picked) = &picked {
                    let at = &picked.point;
                    tracing::info!("face {} sub {} s {:.4} t {:.4}", at.sub_face.face, at.sub_face.sub, at.s, at.t);
                }
                self.state.picked = picked;
            }
            News::Picked(Err(message)) => {
                self.state.status.work = None;
                self.state.status.error(message);
            }
        }
        self.wants_frame(Instant::now());
        Ok(())
    }

    /// Draws with other shaders from now on, or tells what is wrong with them: then what is there stays.
    #[cfg(feature = "hot-reload")]
    pub(crate) fn on_shaders(&mut self, shaders: Result<ShaderSet, String>) {
        let replaced = shaders.and_then(|shaders| self.replace_shaders(shaders).map_err(|error| error.to_string()));
        match replaced {
            Ok(()) => self.state.status.note("shaders were read again"),
            Err(message) => self.state.status.error(message),
        }
        self.wants_frame(Instant::now());
    }

    #[cfg(feature = "hot-reload")]
    fn replace_shaders(&mut self, shaders: ShaderSet) -> Result<(), ViewerError> {
        let device = self.engine.device().clone();
        let mut painter = Painter::new(&device, &shaders, self.presenter.format())?;
        let marks = self.marks.as_ref().map(|marks| Marks::new(&device, &shaders, marks.target)).transpose()?;
        painter.take_textures(&mut self.painter);
        (self.painter, self.marks) = (painter, marks);
        // The builder makes the rest with the new engine; what is shown stays until that is done.
        self.engine = Engine::with(device, EngineDesc { shaders: shaders.clone(), ..self.engine_desc.clone() });
        self.shaders = shaders;
        self.state.shaders += 1;
        Ok(())
    }

    /// Goes back to what is shown, since what was wanted cannot be.
    fn go_back(&mut self, failed: &Wanted) {
        let Some(scene) = &self.scene else { return };
        if failed.same_model(&scene.wanted) && failed.revision == scene.wanted.revision {
            let (look, wanted) = (&mut self.state.settings.look, &scene.wanted);
            (look.scheme, look.evaluator, look.spacing) = (wanted.schemes[0], wanted.evaluator, wanted.spacing);
            (look.level, look.adaptive) = (wanted.level, wanted.adaptive.is_some());
            look.wireframe = wanted.shade == osculate::Shade::Wireframe;
            look.leaks = wanted.shade == osculate::Shade::Leaks;
            if !look.wireframe && !look.leaks {
                look.shade = wanted.shade;
            }
            look.compare = if wanted.schemes.len() == 2 { look.compare } else { crate::choice::Compare::Off };
        }
        let shown = self.state.shown().map(|(file, revision)| (file.to_owned(), revision));
        self.state.models.go_back(shown.as_ref().map(|(file, revision)| (file.as_path(), *revision)));
    }

    /// Has the frames of a scene's sequence read, if it has any.
    fn follow(&mut self, scene: &Scene) -> Result<(), ViewerError> {
        self.streamed = None;
        let Some(sequence) = &scene.sequence else {
            self.stream = None;
            return Ok(());
        };
        if let Some(stream) = self.stream.as_mut().filter(|stream| stream.is_of(sequence)) {
            stream.forget();
            return Ok(());
        }
        let (id, wake) = (self.id, self.wake.clone());
        let stream = Stream::start(sequence, move |positions| {
            let _closed = wake.send_event(Wake::News(id, Box::new(News::Moved(positions))));
        });
        self.stream = Some(stream.map_err(ViewerError::Thread)?);
        Ok(())
    }

    /// Shows a scene from now on.
    fn install(&mut self, scene: Scene) -> Result<(), ViewerError> {
        if self.ordered.as_ref() == Some(&scene.wanted) {
            self.state.status.work = None;
        }
        let [width, height] = self.state.figures.size.map(|side| f64::from(side.max(1)));
        let aspect = width / height;
        let is_new = self.state.show(&scene, aspect);
        let file = scene.wanted.file.display();
        let schemes: Vec<&str> = scene.sides.iter().map(|side| side.scheme.name()).collect();
        let wanted = &scene.wanted;
        let (schemes, shade) = (schemes.join(" and "), wanted.shade.name());
        match wanted.adaptive {
            Some(pixels) => tracing::info!("{file}: {schemes}, {shade}, segments of {pixels} pixels"),
            None => tracing::info!("{file}: {schemes}, {shade}, level {}", wanted.level),
        }
        if is_new {
            self.window.set_title(&format!("{} · osculate", self.state.title().unwrap_or_default()));
        }
        if let Some(stage) = &mut self.stage {
            stage.forget();
        }
        if self.marks.as_ref().is_none_or(|marks| marks.target != scene.wanted.target) {
            self.marks = Some(Marks::new(self.engine.device(), &self.shaders, scene.wanted.target)?);
        }
        self.follow(&scene)?;
        self.scene = Some(scene);
        self.state.sculpting.is_new = true;
        self.shown = None;
        Ok(())
    }
}

/// What compiles changed shaders.
#[cfg(feature = "hot-reload")]
fn watcher(wake: &EventLoopProxy<Wake>) -> std::io::Result<crate::reload::Watcher> {
    let wake = wake.clone();
    crate::reload::Watcher::start(move |shaders| {
        let _closed = wake.send_event(Wake::Shaders(Box::new(shaders)));
    })
}

fn facts(device: &Device, presenter: &Presenter) -> DeviceFacts {
    let info = device.info();
    DeviceFacts {
        name: info.name.clone(),
        driver: format!("{} {}", info.driver_name, info.driver_info),
        modes: presenter.modes().to_vec(),
        samples: info.limits.sample_counts.clone(),
        wireframe: info.features.wireframe,
        times_passes: !info.is_llvmpipe,
    }
}

/// An engine that tells the window when pipelines take long.
fn engine_desc(shaders: ShaderSet, desc: &ViewerDesc, (id, wake): (SessionId, &EventLoopProxy<Wake>)) -> EngineDesc {
    let wake = wake.clone();
    let observer = PipelineObserver::new(move |PipelineProgress { done, total }| {
        let news = News::Progress("making pipelines".to_owned(), Some(done as f32 / total.max(1) as f32));
        let _closed = wake.send_event(Wake::News(id, Box::new(news)));
    });
    let pipeline_cache = desc.pipeline_cache.clone();
    EngineDesc { shaders, pipeline_cache, observer: Some(observer), ..EngineDesc::default() }
}
