//! How the surface is put together.

use egui::{RichText, Ui};

use super::{choose, line, row};
use crate::choice::{Choice, Compare};
use crate::keys::Action;
use crate::state::State;
use crate::theme;

pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let look = &mut state.settings.look;
    line(ui, "scheme", |ui| choose(ui, "scheme", &mut look.scheme));
    ui.label(RichText::new(look.scheme.about()).small().color(theme::FAINT));
    line(ui, "evaluator", |ui| row(ui, &mut look.evaluator));
    line(ui, "compare", |ui| row(ui, &mut look.compare));
    if look.is_compared() {
        line(ui, "with", |ui| choose(ui, "against", &mut look.against));
    }
    if look.compare != Compare::Off && look.shows_difference() {
        ui.label(RichText::new("the difference is one picture").small().color(theme::FAINT));
    }
    if state.sculpting.points.is_some() && ui.button("Put vertices back").on_hover_text("Backspace").clicked() {
        state.actions.push(Action::Restore);
    }
}
