//! What a frame is: lay out, order, draw the scene into its picture, show picture and interface, and do what was asked for.

use std::time::{Duration, Instant};

use egui::{CentralPanel, FullOutput, ViewportId};
use osculate::gpu::{Acquired, ColorTarget, Draw, Format, Frame, GpuError, Image, Presented, RenderPass};
use osculate::{DrawPlan, EngineError, Recording, Target};
use winit::window::Fullscreen;

use super::{Layout, PATIENCE, Session};
use crate::actions::Deed;
use crate::choice::Compare;
use crate::error::ViewerError;
use crate::input::{Asked, Click, navigate, picture_rect};
use crate::picking::Pick;
use crate::scene::Sight;
use crate::stage::{Shown, Stage};
use crate::stream::Stream;
use crate::views::{View, views};
use crate::{hud, panels, screenshot, theme};

impl Session {
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

    fn pick(&mut self, click: Click) {
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
        if !playback.is_posed {
            self.streamed = None;
            self.stream.iter_mut().for_each(Stream::forget);
        }
        if playback.is_posed
            && let Some(stream) = &mut self.stream
        {
            stream.ask(playback.time);
            if let Some(positions) = self.streamed.take() {
                scene.write_points(&positions)?;
                self.vertices_moved = true;
            }
        } else if playback.is_posed {
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
        let views_of = |compare| -> Vec<View> { views(compare, self.state.wipe, layout.size) };
        let mut views = views_of(look.compare);
        if sides < views.len() {
            views = views_of(Compare::Off);
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

/// The pass that fills the window.
fn window_pass(image: &Image, draws: Vec<Draw>, background: [f32; 4]) -> RenderPass {
    RenderPass {
        name: "window".to_owned(),
        color: Some(ColorTarget { image: image.clone(), clear: Some(background), resolve: None }),
        depth: None,
        viewport: image.size().into(),
        area: None,
        draws,
    }
}
