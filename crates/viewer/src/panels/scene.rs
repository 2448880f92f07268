//! Which model is shown, and from where.

use egui::{RichText, Ui};

use super::{count, line};
use crate::keys::Action;
use crate::models::title;
use crate::state::State;
use crate::theme;

pub(super) fn show(ui: &mut Ui, state: &mut State) {
    models(ui, state);
    ui.horizontal(|ui| {
        for (text, about, action) in [
            ("Open …", "O", Action::Open),
            ("Reload", "F5", Action::Reload),
            ("Fit", "F", Action::Fit),
            ("Camera", "print and copy it: Y", Action::Camera),
        ] {
            if ui.button(text).on_hover_text(about).clicked() {
                state.actions.push(action);
            }
        }
    });
    let Some(model) = &state.model else { return };
    let cage = &model.cage;
    let text = format!("{} vertices, {} faces", count(cage.vertex_count()), count(cage.face_count()));
    line(ui, "cage", |ui| drop(ui.label(text)));
    if !cage.warnings().is_empty() {
        let warnings: Vec<String> = cage.warnings().iter().map(ToString::to_string).collect();
        let text = format!("{} warnings", warnings.len());
        ui.label(RichText::new(text).color(theme::ACCENT)).on_hover_text(warnings.join("\n"));
    }
}

fn models(ui: &mut Ui, state: &mut State) {
    let names: Vec<String> = state.models.files().iter().map(|file| title(file)).collect();
    let position = state.models.position();
    ui.horizontal(|ui| {
        let several = names.len() > 1;
        if ui.add_enabled(several, egui::Button::new("◀")).on_hover_text("P").clicked() {
            state.actions.push(Action::Previous);
        }
        let chosen = names.get(position).map_or("no model", String::as_str);
        egui::ComboBox::from_id_salt("models").width(160.0).truncate().selected_text(chosen).show_ui(ui, |ui| {
            for (at, name) in names.iter().enumerate() {
                if ui.selectable_label(at == position, name).clicked() {
                    state.models.choose(at);
                }
            }
        });
        if ui.add_enabled(several, egui::Button::new("▶")).on_hover_text("N").clicked() {
            state.actions.push(Action::Next);
        }
    });
}
