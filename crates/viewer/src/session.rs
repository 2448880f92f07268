//! A window on a device: everything that is there while it is open, and what a frame is.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{CentralPanel, FullOutput, ViewportId};
use osculate::gpu::Submission;
use osculate::gpu::{
    Acquired, ColorTarget, Format, Frame, GpuError, Image, Presented, Presenter, PresenterDesc, RenderPass,
    WindowSystem,
};
use osculate::{
    Device, DeviceDesc, DrawPlan, Engine, EngineDesc, EngineError, PipelineObserver, PipelineProgress, Recording,
    ShaderSet, Target,
};
use winit::event::WindowEvent;
use winit::event_loop::EventLoopProxy;
use winit::window::{Fullscreen, Window};

use crate::actions::Deed;
use crate::app::Wake;
use crate::builder::{Builder, News};
use crate::error::ViewerError;
use crate::input::{Asked, navigate, picture_rect};
use crate::marks::Marks;
use crate::pace::Pace;
use crate::painter::Painter;
use crate::picking::Pick;
use crate::scene::{Scene, Sight, Wanted};
use crate::stage::{Shown, Stage};
use crate::state::{DeviceFacts, State};
use crate::views::{View, views};
use crate::{ViewerDesc, hud, panels, screenshot, theme};

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
    painter: Painter,
    presenter: Presenter,
    shaders: ShaderSet,
    engine: Engine,
    #[cfg(feature = "hot-reload")]
    engine_desc: EngineDesc,
    input: egui_winit::State,
    egui: egui::Context,
    pace: Pace,
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
        let builder = Builder::start(desc.read.clone(), move |news| {
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
            WindowEvent::KeyboardInput { event, .. } if event.state.is_pressed() && !event.repeat => {
                if self.on_key(&event.logical_key) {
                    return self.wants_frame(Instant::now());
                }
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
        tracing::info!("{file}: {}, {}, level {}", schemes.join(" and "), wanted.shade.name(), wanted.level);
        if is_new {
            self.window.set_title(&format!("{} · osculate", self.state.title().unwrap_or_default()));
        }
        if let Some(stage) = &mut self.stage {
            stage.forget();
        }
        if self.marks.as_ref().is_none_or(|marks| marks.target != scene.wanted.target) {
            self.marks = Some(Marks::new(self.engine.device(), &self.shaders, scene.wanted.target)?);
        }
        self.scene = Some(scene);
        self.state.sculpting.is_new = true;
        self.shown = None;
        Ok(())
    }

    /// Draws a frame, unless the last one is still on its way.
    pub(crate) fn frame(&mut self) -> Result<(), ViewerError> {
        let now = Instant::now();
        if let Some(submission) = &self.in_flight
            && !submission.is_done()?
        {
            self.next = Some(now + PATIENCE);
            return Ok(());
        }
        self.next = None;
        let gone = self.in_flight.take();
        drop(gone);
        self.fail_on_purpose()?;
        let frame = match self.presenter.acquire()? {
            Acquired::Frame(frame) => frame,
            Acquired::OutOfDate => {
                tracing::debug!("the window is out of date");
                self.presenter.resize(self.window.inner_size().into());
                self.wants_frame(now);
                return Ok(());
            }
            Acquired::Hidden => return Ok(()),
            Acquired::Timeout => {
                self.wants_frame(now + Duration::from_millis(100));
                return Ok(());
            }
        };
        self.pace.begin(now, self.state.settings.screen.limit);
        self.draw(frame, now)
    }

    /// What tests ask for.
    fn fail_on_purpose(&mut self) -> Result<(), ViewerError> {
        self.frames += 1;
        if self.force_out_of_date.is_some_and(|every| self.frames.is_multiple_of(every)) {
            self.presenter.force_out_of_date();
        }
        if self.lose_device.take_if(|at| self.frames >= *at).is_some() {
            return Err(GpuError::DeviceLost { during: "a test".to_owned() }.into());
        }
        Ok(())
    }

    fn draw(&mut self, frame: Frame, now: Instant) -> Result<(), ViewerError> {
        let seconds = now.saturating_duration_since(self.last_frame).as_secs_f64().min(0.25);
        self.last_frame = now;
        self.measure()?;
        self.state.advance(seconds);
        let (output, layout, asked) = self.lay_out();
        self.presenter.set_mode(self.state.settings.screen.mode);
        let deeds = self.perform(&layout);
        self.order(&layout);
        if let Some(click) = asked.pick {
            self.pick(click);
        }
        self.draw_scene(&layout)?;
        self.show(frame, output, &layout, now, &deeds)?;
        for deed in deeds {
            self.carry_out(deed)?;
        }
        if self.state.is_playing() || asked.flies || self.state.settings.screen.continuous {
            self.wants_frame(now);
        }
        if let Some(change) = self.state.status.next_change() {
            self.wants_frame(change + Duration::from_millis(1));
        }
        let work = now.elapsed().as_secs_f64();
        self.state.figures.host = work;
        let device = &self.state.figures.measured;
        let work = work.max(device.update + device.surface + device.marks);
        let goes_on = self.next.is_some_and(|next| next <= now + Duration::from_millis(20));
        self.state.figures.frames.add(now, work as f32, goes_on);
        Ok(())
    }

    /// Reads what was measured in the last picture.
    fn measure(&mut self) -> Result<(), ViewerError> {
        if let Some(measured) = self.stage.as_mut().map(Stage::measured).transpose()?.flatten() {
            self.state.figures.measured = measured;
        }
        self.state.figures.memory = self.engine.device().memory_use().live_bytes;
        Ok(())
    }

    /// Lets egui lay everything out.
    fn lay_out(&mut self) -> (FullOutput, Layout, Asked) {
        let raw = self.input.take_egui_input(&self.window);
        let (state, context) = (&mut self.state, self.egui.clone());
        let (mut layout, mut asked) = (Layout::default(), Asked::default());
        let output = context.run(raw, |context| {
            panels::show(context, state);
            CentralPanel::default().frame(egui::Frame::NONE).show(context, |ui| {
                let (rect, origin, size) = picture_rect(ui.max_rect(), context.pixels_per_point());
                layout = Layout { origin, size };
                asked = navigate(ui, rect, state);
                hud::show(ui, rect, state);
            });
            panels::show_help(context, &mut state.help);
            if let Some(chosen) = state.dialog.as_mut().and_then(|dialog| dialog.show(context)) {
                state.dialog = None;
                chosen.into_iter().for_each(|file| state.models.open(file));
            }
        });
        self.state.figures.size = layout.size;
        (output, layout, asked)
    }

    /// Does what keys and buttons asked for; what is left to be done once the frame is drawn.
    fn perform(&mut self, layout: &Layout) -> Vec<Deed> {
        let actions = std::mem::take(&mut self.state.actions);
        if !actions.is_empty() {
            // What changed is laid out in the next frame.
            self.wants_frame(Instant::now());
        }
        let mut due = std::mem::take(&mut self.postponed);
        for deed in actions.into_iter().filter_map(|action| self.state.perform(action, layout.aspect())) {
            // Screenshots show what keys before them have changed.
            let later = matches!(deed, Deed::Screenshot | Deed::WindowScreenshot);
            if later { self.postponed.push(deed) } else { due.push(deed) }
        }
        due
    }

    /// The images that pictures are made of.
    fn target(&self) -> Target {
        let samples = self.state.settings.look.samples;
        let has = self.state.device.samples.contains(&samples);
        Target { color: Format::Rgba8Srgb, samples: if has { samples } else { 1 } }
    }

    /// Asks the builder for what is wanted, if that has changed.
    fn order(&mut self, layout: &Layout) {
        let Some(wanted) = self.state.wanted(self.target()) else { return };
        if self.ordered.as_ref() == Some(&wanted) {
            return;
        }
        let seen = self.state.shown().is_some_and(|(file, _)| file == wanted.file);
        let orbit = self.state.orbit.filter(|_| seen);
        let sight = Sight { orbit, size: layout.size };
        let points = self.state.sculpting.points.clone().filter(|_| seen);
        self.builder.order(&self.engine, wanted.clone(), sight, points);
        self.ordered = Some(wanted);
    }

    fn pick(&mut self, click: crate::input::Click) {
        let Some(scene) = &self.scene else { return };
        let Some(side) = scene.sides.get(click.side).or(scene.sides.first()) else { return };
        self.builder.pick(Pick { surface: side.surface().clone(), eye: click.eye, direction: click.direction });
    }

    /// Draws the scene into its picture, if that has changed.
    fn draw_scene(&mut self, layout: &Layout) -> Result<(), ViewerError> {
        if layout.size.contains(&0) || self.scene.is_none() {
            return Ok(());
        }
        self.fit_stage(layout)?;
        self.move_vertices()?;
        let shown = self.shown(layout);
        let replanned = self.set_view(&shown)?;
        let (Some(scene), Some(stage), Some(marks)) = (&self.scene, &mut self.stage, &self.marks) else {
            return Ok(());
        };
        if replanned {
            stage.forget();
        }
        let now_shown = (shown, layout.size, self.state.orbit);
        let update = self.vertices_moved || replanned;
        if update || self.shown.as_ref() != Some(&now_shown) || self.state.settings.screen.continuous {
            stage.draw(scene, marks, &now_shown.0, update)?;
            self.vertices_moved = false;
            self.shown = Some(now_shown);
        }
        Ok(())
    }

    /// Makes images of the picture's size.
    fn fit_stage(&mut self, layout: &Layout) -> Result<(), ViewerError> {
        let target = self.scene.as_ref().map_or(self.target(), |scene| scene.wanted.target);
        let fits = |stage: &Stage| stage.picture().size() == layout.size && stage.target() == target;
        if !self.stage.as_ref().is_some_and(fits) {
            self.stage = None;
            self.stage = Some(Stage::new(self.engine.device(), layout.size, target)?);
            self.shown = None;
        }
        Ok(())
    }

    /// Puts vertices where the animation or the mouse has moved them.
    fn move_vertices(&mut self) -> Result<(), EngineError> {
        let Some(scene) = &mut self.scene else { return Ok(()) };
        let (playback, sculpting) = (&self.state.playback, &mut self.state.sculpting);
        if playback.is_posed {
            scene.set_time(playback.animation, playback.time)?;
            self.vertices_moved = true;
        } else if std::mem::take(&mut sculpting.is_new) {
            let rest = scene.cage.positions();
            scene.write_points(sculpting.points.as_ref().map_or(rest, |points| points.as_slice()))?;
            self.vertices_moved = true;
        }
        Ok(())
    }

    fn shown(&self, layout: &Layout) -> Shown {
        let look = &self.state.settings.look;
        let sides = self.scene.as_ref().map_or(0, |scene| scene.sides.len());
        let mut views: Vec<View> = views(look.compare, self.state.wipe, layout.size);
        if sides < views.len() {
            views = crate::views::views(crate::choice::Compare::Off, 0.5, layout.size);
        }
        Shown {
            views,
            points: look.points,
            normals: look.normals,
            background: if look.leaks { theme::LEAK } else { theme::stage() },
            by_rig: self.state.playback.is_posed,
            scale: self.egui.pixels_per_point(),
        }
    }

    /// Looks from where the eye is; whether something was planned anew.
    fn set_view(&mut self, shown: &Shown) -> Result<bool, EngineError> {
        let bounds = self.state.bounds();
        let bounds = self.state.sculpting.points.as_ref().map_or(bounds, |points| osculate_cage::Bounds::of(points));
        let (Some(scene), Some(orbit)) = (&mut self.scene, &self.state.orbit) else { return Ok(false) };
        let Ok(camera) = orbit.camera(bounds) else { return Ok(false) };
        // Animations may leave the box of the pose at rest.
        let camera = osculate::Camera { far: 2.0 * camera.far, near: 0.5 * camera.near, ..camera };
        let mut replanned = false;
        for (side, view) in scene.sides.iter_mut().zip(&shown.views) {
            side.drawing.freeze_factors(self.state.frozen);
            replanned |= side.drawing.set_view(&camera, view.viewport.size)? == DrawPlan::New;
        }
        Ok(replanned)
    }

    /// Draws picture and interface to the window.
    fn show(
        &mut self,
        frame: Frame,
        output: FullOutput,
        layout: &Layout,
        now: Instant,
        deeds: &[Deed],
    ) -> Result<(), ViewerError> {
        let FullOutput { platform_output, textures_delta, shapes, pixels_per_point, viewport_output } = output;
        self.input.handle_platform_output(&self.window, platform_output);
        if let Some(viewport) = viewport_output.get(&ViewportId::ROOT)
            && viewport.repaint_delay < Duration::from_secs(3600)
        {
            self.wants_frame(now + viewport.repaint_delay);
        }
        self.painter.set_textures(&textures_delta)?;
        let primitives = self.egui.tessellate(shapes, pixels_per_point);
        let mut draws = Vec::new();
        if let Some(stage) = self.stage.as_ref().filter(|_| self.shown.is_some()) {
            draws.push(self.painter.picture(stage.picture(), layout.origin)?);
        }
        draws.extend(self.painter.interface(&primitives, pixels_per_point, frame.size())?);
        let mut recording = Recording::new();
        recording.render(window_pass(frame.image(), draws, self.painter.background()));
        let submission = self.engine.device().submit(&recording)?;
        if deeds.contains(&Deed::WindowScreenshot) {
            self.write_screenshot(frame.image());
        }
        if self.presenter.present(frame)? == Presented::OutOfDate {
            tracing::debug!("the window is out of date");
            self.presenter.resize(self.window.inner_size().into());
            self.wants_frame(now);
        }
        self.in_flight = Some(submission);
        self.painter.free_textures(&textures_delta);
        Ok(())
    }

    /// Does what needs window or device.
    fn carry_out(&mut self, deed: Deed) -> Result<(), ViewerError> {
        match deed {
            Deed::Quit => self.is_done = true,
            Deed::FullScreen => {
                let full = self.window.fullscreen().is_none().then_some(Fullscreen::Borderless(None));
                self.window.set_fullscreen(full);
            }
            Deed::Screenshot => match self.stage.as_ref().filter(|_| self.shown.is_some()) {
                Some(stage) => self.write_screenshot(&stage.picture().clone()),
                None => self.state.status.error("there is no picture yet"),
            },
            // It was taken before the frame was shown.
            Deed::WindowScreenshot => {}
            Deed::Camera => self.print_camera(),
            #[cfg(feature = "hot-reload")]
            Deed::Shaders => self.watcher.compile(),
        }
        Ok(())
    }

    fn write_screenshot(&mut self, image: &Image) {
        let model = self.state.title().unwrap_or_else(|| "osculate".to_owned());
        let read = screenshot::read(self.engine.device(), image).map_err(|error| error.to_string());
        match read.and_then(|rgba| screenshot::write(&self.screenshots, &model, image.size(), &rgba)) {
            Ok(file) => self.state.status.note(format!("written: {}", file.display())),
            Err(message) => self.state.status.error(message),
        }
        self.wants_frame(Instant::now());
    }

    fn print_camera(&mut self) {
        let Some(orbit) = &self.state.orbit else { return };
        let text = format!("--camera {}", orbit.pose());
        // Whoever started the program may have closed its output.
        let _nobody_listens = std::io::Write::write_all(&mut std::io::stdout(), format!("{text}\n").as_bytes());
        self.egui.copy_text(text.clone());
        self.state.status.note(text);
        self.wants_frame(Instant::now());
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

/// The pass that fills the window.
fn window_pass(image: &Image, draws: Vec<osculate::gpu::Draw>, background: [f32; 4]) -> RenderPass {
    RenderPass {
        name: "window".to_owned(),
        color: Some(ColorTarget { image: image.clone(), clear: Some(background), resolve: None }),
        depth: None,
        viewport: image.size().into(),
        area: None,
        draws,
    }
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
