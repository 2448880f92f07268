//! The keys.

use egui::{Align2, Grid, RichText, Ui};

use crate::keys::{GROUPS, MOUSE};
use crate::theme;

/// Shows the window with all keys while `open`.
pub(crate) fn show(context: &egui::Context, open: &mut bool) {
    let window = egui::Window::new("Keys").open(open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(context, |ui| {
        ui.horizontal_top(|ui| {
            for part in [&[0usize, 1, 5][..], &[2, 3], &[4]] {
                ui.vertical(|ui| part.iter().for_each(|&group| show_group(ui, group)));
                ui.add_space(18.0);
            }
        });
    });
}

/// A group of keys; the one after the last is the mouse.
fn show_group(ui: &mut Ui, group: usize) {
    let Some(group) = GROUPS.get(group) else {
        return table(ui, "Mouse", MOUSE.iter().map(|(key, help)| ((*key).to_owned(), *help)));
    };
    let bindings = group.bindings.iter().filter(|binding| !binding.help.is_empty());
    table(ui, group.title, bindings.map(|binding| (binding.label(), binding.help)));
}

fn table<'a>(ui: &mut Ui, title: &str, lines: impl Iterator<Item = (String, &'a str)>) {
    ui.label(RichText::new(title).color(theme::ACCENT));
    Grid::new(title).num_columns(2).spacing([14.0, 3.0]).show(ui, |ui| {
        for (key, help) in lines {
            ui.label(RichText::new(key).monospace().color(egui::Color32::WHITE));
            ui.label(help);
            ui.end_row();
        }
    });
    ui.add_space(10.0);
}
