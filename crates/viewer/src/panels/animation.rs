//! What moves.

use egui::{ComboBox, Slider, Ui};

use super::line;
use crate::keys::Action;
use crate::state::State;

pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let Some(model) = &state.model else { return };
    let playback = &mut state.playback;
    let name = |at: usize| model.animations.get(at).map_or("", |(name, _)| name.as_str());
    ComboBox::from_id_salt("animation").selected_text(name(playback.animation)).show_ui(ui, |ui| {
        for at in 0..model.animations.len() {
            if ui.selectable_value(&mut playback.animation, at, name(at)).clicked() {
                playback.time = 0.0;
                playback.is_posed = true;
            }
        }
    });
    let length = model.animations.get(playback.animation).map_or(0.0, |(_, length)| *length);
    ui.horizontal(|ui| {
        if ui.button(if playback.plays { "⏸" } else { "▶" }).on_hover_text("M, space").clicked() {
            state.actions.push(Action::Play);
        }
        if ui.button("⏹").on_hover_text("the pose at rest").clicked() {
            state.actions.push(Action::Restore);
        }
        ui.spacing_mut().slider_width = 110.0;
        let slider = Slider::new(&mut playback.time, 0.0..=length.max(1e-3)).max_decimals(2).suffix(" s");
        playback.is_posed |= ui.add(slider).changed();
    });
    let speed = Slider::new(&mut playback.speed, 0.05..=4.0).logarithmic(true).max_decimals(2);
    line(ui, "speed", |ui| drop(ui.add(speed)));
}
