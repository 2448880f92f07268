//! How finely the surface is cut.

use egui::{Slider, Ui};

use super::{line, row};
use crate::state::State;

pub(super) fn show(ui: &mut Ui, state: &mut State) {
    let look = &mut state.settings.look;
    line(ui, "factors", |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.selectable_value(&mut look.adaptive, false, "uniform").on_hover_text("the same level for all edges");
        ui.selectable_value(&mut look.adaptive, true, "by length")
            .on_hover_text("segments of equal length in the picture");
    });
    if look.adaptive {
        let slider = Slider::new(&mut look.pixels, 1.0..=64.0).logarithmic(true).max_decimals(1);
        line(ui, "pixels", |ui| drop(ui.add(slider)));
        line(ui, "", |ui| {
            drop(ui.checkbox(&mut state.frozen, "freeze").on_hover_text("keep factors while the camera moves"))
        });
    } else {
        let slider = Slider::new(&mut look.level, 1.0..=64.0).logarithmic(true).max_decimals(1);
        line(ui, "level", |ui| drop(ui.add(slider)));
    }
    line(ui, "spacing", |ui| row(ui, &mut look.spacing));
    let about = "patches of which nothing is seen are left out, and backs; by the tessellator alone: B";
    line(ui, "", |ui| drop(ui.checkbox(&mut look.culling, "cull").on_hover_text(about)));
}
