//! The panels: what is shown, how, and what is known of it.

mod animation;
mod help;
mod scene;
mod screen;
mod shading;
mod statistics;
mod surface;
mod tessellation;

use egui::{CollapsingHeader, ComboBox, RichText, Ui};

use crate::choice::Choice;
use crate::state::State;
use crate::theme;

pub(crate) use help::show as show_help;
pub(crate) use statistics::count;

/// Width of the panel in points.
const WIDTH: f32 = 286.0;

/// A section of the panel.
type Section = (&'static str, bool, fn(&mut Ui, &mut State));

/// Title, whether it is open at first, and what is in it.
const SECTIONS: [Section; 7] = [
    ("Scene", true, scene::show),
    ("Surface", true, surface::show),
    ("Tessellation", true, tessellation::show),
    ("Shading", true, shading::show),
    ("Animation", true, animation::show),
    ("Statistics", false, statistics::show),
    ("Window", false, screen::show),
];

/// Shows the panel at the left.
pub(crate) fn show(context: &egui::Context, state: &mut State) {
    if !state.settings.screen.panels {
        return;
    }
    let frame =
        egui::Frame::new().fill(theme::PANEL).inner_margin(egui::Margin { left: 14, right: 8, top: 10, bottom: 8 });
    egui::SidePanel::left("panels").exact_width(WIDTH).resizable(false).frame(frame).show(context, |ui| {
        ui.horizontal(|ui| {
            ui.label(RichText::new("osculate").size(17.0).color(theme::ACCENT));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.add_space(6.0);
                ui.label(RichText::new("F1 keys").small().color(theme::FAINT));
            });
        });
        ui.add_space(2.0);
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for (title, open, section) in SECTIONS {
                if title == "Animation" && state.model.as_ref().is_none_or(|model| model.animations.is_empty()) {
                    continue;
                }
                let header = CollapsingHeader::new(RichText::new(title).color(egui::Color32::WHITE)).default_open(open);
                header.show_unindented(ui, |ui| {
                    ui.set_width(WIDTH - 36.0);
                    section(ui, state);
                    ui.add_space(4.0);
                });
                ui.separator();
            }
        });
    });
}

/// A line: what it is about at the left, and what can be changed at the right.
fn line(ui: &mut Ui, about: &str, add: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.allocate_ui_with_layout(egui::vec2(78.0, 22.0), egui::Layout::left_to_right(egui::Align::Center), |ui| {
            ui.set_min_width(78.0);
            ui.label(RichText::new(about).color(theme::FAINT));
        });
        add(ui);
    });
}

/// A list to choose from, each with a line about it.
fn choose<T: Choice>(ui: &mut Ui, id: &str, chosen: &mut T) {
    choose_among(ui, id, chosen, |_| true);
}

/// A list in which only some can be chosen.
fn choose_among<T: Choice>(ui: &mut Ui, id: &str, chosen: &mut T, can: impl Fn(T) -> bool) {
    ComboBox::from_id_salt(id).selected_text(chosen.label()).show_ui(ui, |ui| {
        for &one in T::ALL {
            let entry = ui.add_enabled(can(one), egui::Button::selectable(*chosen == one, one.label()));
            if entry.on_hover_text(one.about()).on_disabled_hover_text("this model has no maps for it").clicked() {
                *chosen = one;
            }
        }
    });
}

/// Buttons in a row, one of which is down.
fn row<T: Choice>(ui: &mut Ui, chosen: &mut T) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for &one in T::ALL {
            ui.selectable_value(chosen, one, one.label()).on_hover_text(one.about());
        }
    });
}
