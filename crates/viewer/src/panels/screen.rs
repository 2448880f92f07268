//! How the window is drawn.

use egui::{DragValue, Ui};

use super::{choose, line};
use crate::state::State;

pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let (screen, device) = (&mut state.settings.screen, &state.device);
    line(ui, "vsync", |ui| choose(ui, "mode", &mut screen.mode));
    if !device.modes.contains(&screen.mode) {
        ui.small("not offered here: frames wait for the screen");
    }
    line(ui, "limit", |ui| {
        let value = DragValue::new(&mut screen.limit).range(0..=1000).suffix(" fps");
        ui.add(value).on_hover_text("most frames in a second; 0 for no limit");
    });
    ui.checkbox(&mut screen.continuous, "draw all the time").on_hover_text("though nothing changes: for measuring");
    ui.checkbox(&mut screen.figures, "figures").on_hover_text("F3");
}
