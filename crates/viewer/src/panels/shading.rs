//! What colours mean, and what is drawn over the surface.

use egui::{RichText, Ui};

use super::{choose_among, line};
use crate::choice::Choice;
use crate::state::State;
use crate::theme;

pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let mut shade = state.settings.look.shade;
    line(ui, "shade", |ui| choose_among(ui, "shade", &mut shade, |shade| state.can_show(shade)));
    let (look, device) = (&mut state.settings.look, &state.device);
    look.shade = shade;
    ui.label(RichText::new(look.shade.about()).small().color(theme::FAINT));
    egui::Grid::new("overlays").num_columns(2).spacing([18.0, 5.0]).show(ui, |ui| {
        ui.checkbox(&mut look.cage, "cage edges").on_hover_text("H; drag a vertex to move it");
        ui.checkbox(&mut look.points, "cage vertices").on_hover_text("K; drag a vertex to move it");
        ui.end_row();
        ui.checkbox(&mut look.normals, "normals").on_hover_text("J");
        let wire = ui.add_enabled(device.wireframe, egui::Checkbox::new(&mut look.wireframe, "triangles"));
        wire.on_hover_text("W").on_disabled_hover_text("this device cannot draw edges of triangles");
        ui.end_row();
        ui.checkbox(&mut look.leaks, "leak detector").on_hover_text("L; holes of a closed surface are magenta");
        ui.end_row();
    });
    line(ui, "samples", |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for &samples in device.samples.iter().filter(|samples| [1, 2, 4, 8].contains(*samples)) {
            ui.selectable_value(&mut look.samples, samples, samples.to_string());
        }
    });
}
