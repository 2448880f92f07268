//! What keys and buttons do to the state; what needs window or device is left to the session.

use crate::camera::Orbit;
use crate::choice::Choice;
use crate::dialog::FileDialog;
use crate::keys::Action;
use crate::state::State;
use osculate::Shade;

/// What the session has to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Deed {
    Quit,
    FullScreen,
    Screenshot,
    WindowScreenshot,
    Camera,
    #[cfg(feature = "hot-reload")]
    Shaders,
}

impl State {
    /// Does what was asked for; what is left to do elsewhere. `aspect` is width over height of the picture.
    pub(crate) fn perform(&mut self, action: Action, aspect: f64) -> Option<Deed> {
        match action {
            Action::Quit => return self.quit_or_close(),
            Action::FullScreen => return Some(Deed::FullScreen),
            Action::Screenshot => return Some(Deed::Screenshot),
            Action::WindowScreenshot => return Some(Deed::WindowScreenshot),
            Action::Camera => return Some(Deed::Camera),
            #[cfg(feature = "hot-reload")]
            Action::Shaders => return Some(Deed::Shaders),
            Action::Help => self.help = !self.help,
            Action::Panels => self.settings.screen.panels = !self.settings.screen.panels,
            Action::Figures => self.settings.screen.figures = !self.settings.screen.figures,
            Action::Open => self.dialog = Some(FileDialog::beside(self.models.wanted())),
            Action::Next => self.models.step(1),
            Action::Previous => self.models.step(-1),
            Action::Reload => self.models.reload(),
            Action::Fit => self.fit(aspect),
            Action::Fly => self.fly(),
            Action::Freeze => self.frozen = !self.frozen,
            Action::Play => self.play(),
            Action::Restore => self.restore(),
            _ => self.change_look(action),
        }
        None
    }

    /// Closes what lies over the picture, or else ends.
    fn quit_or_close(&mut self) -> Option<Deed> {
        if self.help || self.dialog.is_some() {
            (self.help, self.dialog) = (false, None);
            return None;
        }
        Some(Deed::Quit)
    }

    fn fit(&mut self, aspect: f64) {
        let bounds = self.bounds();
        if let Some(orbit) = &mut self.orbit {
            orbit.fit_again(bounds, aspect);
        } else if self.model.is_some() {
            self.orbit = Some(Orbit::fit(bounds, aspect));
        }
    }

    fn fly(&mut self) {
        self.flies = !self.flies;
        let text = if self.flies { "flying: W A S D Q E and the mouse; G to circle again" } else { "circling" };
        self.status.note(text);
    }

    fn play(&mut self) {
        if self.model.as_ref().is_some_and(|model| model.animations.is_empty()) {
            return self.status.note("this model has no animation");
        }
        self.playback.plays = !self.playback.plays;
    }

    fn change_look(&mut self, action: Action) {
        let look = &mut self.settings.look;
        match action {
            Action::Scheme => look.scheme = look.scheme.step(1),
            Action::Evaluator => look.evaluator = look.evaluator.step(1),
            Action::Compare => look.compare = look.compare.step(1),
            Action::Level(level) => (look.level, look.adaptive) = (f32::from(level), false),
            Action::Finer if look.adaptive => look.pixels = (look.pixels / 1.25).max(1.0),
            Action::Coarser if look.adaptive => look.pixels = (look.pixels * 1.25).min(64.0),
            Action::Finer => look.step_level(1.0),
            Action::Coarser => look.step_level(-1.0),
            Action::Adaptive => look.adaptive = !look.adaptive,
            Action::Spacing => look.spacing = look.spacing.step(1),
            Action::Culling => look.culling = !look.culling,
            Action::Wireframe => look.wireframe = !look.wireframe && self.device.wireframe,
            Action::Shade => self.step_shade(1),
            Action::PreviousShade => self.step_shade(-1),
            Action::Cage => look.cage = !look.cage,
            Action::Points => look.points = !look.points,
            Action::Normals => look.normals = !look.normals,
            Action::Leaks => look.leaks = !look.leaks,
            _ => {}
        }
    }

    /// Goes on to another shade, past those that the model has no maps for.
    fn step_shade(&mut self, steps: isize) {
        let steps_on = |shade: &Shade| Some(shade.step(steps));
        let mut shades =
            std::iter::successors(Some(self.settings.look.shade), steps_on).skip(1).take(<Shade as Choice>::ALL.len());
        if let Some(shade) = shades.find(|&shade| self.can_show(shade)) {
            (self.settings.look.shade, self.settings.look.wireframe) = (shade, false);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Settings;
    use osculate::{Scheme, Shade};

    fn state() -> State {
        State::new(Settings::default(), vec!["a.obj".into(), "b.obj".into()], None)
    }

    #[test]
    fn keys_change_what_is_wanted() {
        let mut state = state();
        let target = osculate::Target::of(Shade::Lit, 4);
        let first = state.wanted(target).unwrap();
        for action in [Action::Scheme, Action::Shade, Action::Level(3), Action::Cage, Action::Next, Action::Compare] {
            let before = state.wanted(target).unwrap();
            assert_eq!(state.perform(action, 1.0), None);
            assert_ne!(state.wanted(target).unwrap(), before, "{action:?}");
        }
        let wanted = state.wanted(target).unwrap();
        assert_eq!(wanted.file.to_str(), Some("b.obj"));
        assert_eq!(wanted.schemes, [Scheme::Stam, Scheme::Stam]);
        assert!(wanted.level == 3.0 && first.level == 8.0);
        // Marks are drawn without the builder.
        for action in [Action::Points, Action::Normals, Action::Help, Action::Panels, Action::Fly] {
            state.perform(action, 1.0);
            assert_eq!(state.wanted(target).unwrap(), wanted, "{action:?}");
        }
    }

    #[test]
    fn escape_closes_before_it_quits() {
        let mut state = state();
        state.perform(Action::Help, 1.0);
        assert_eq!(state.perform(Action::Quit, 1.0), None);
        assert!(!state.help);
        assert_eq!(state.perform(Action::Quit, 1.0), Some(Deed::Quit));
    }

    #[test]
    fn a_device_that_cannot_draw_edges_is_not_asked_to() {
        let mut state = state();
        state.perform(Action::Wireframe, 1.0);
        assert!(!state.settings.look.wireframe);
        state.device.wireframe = true;
        state.perform(Action::Wireframe, 1.0);
        assert!(state.settings.look.wireframe);
    }
}
