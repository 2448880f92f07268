//! Numbers about the model, the surface and the device.

use egui::{Grid, RichText, Ui};

use crate::state::State;
use crate::theme;

pub(super) fn show(ui: &mut Ui, state: &mut State) {
    Grid::new("statistics").num_columns(2).spacing([12.0, 3.0]).show(ui, |ui| {
        if let Some(model) = &state.model {
            let topology = model.cage.topology();
            pair(ui, "edges", count(topology.edge_half_edges().len()));
            for (scheme, census) in &model.surfaces {
                pair(ui, scheme.name(), format!("{} patches, {} steps", count(census.patches), census.steps));
            }
            pair(ui, "on the device", bytes(model.bytes));
        }
        let figures = &state.figures;
        pair(ui, "device memory", bytes(figures.memory));
        pair(ui, "picture", format!("{} × {}", figures.size[0], figures.size[1]));
        pair(ui, "device", state.device.name.clone());
        pair(ui, "driver", state.device.driver.clone());
    });
    if let Some(difference) = state.model.as_ref().and_then(|model| model.difference) {
        ui.label(format!("largest distance {:.3e}, mean {:.3e}", difference.largest, difference.mean));
    }
}

fn pair(ui: &mut Ui, about: &str, value: String) {
    ui.label(RichText::new(about).color(theme::FAINT));
    ui.add(egui::Label::new(value).truncate());
    ui.end_row();
}

/// A number with thin spaces between thousands.
pub(crate) fn count(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// A number of bytes, in binary units.
pub(crate) fn bytes(number: u64) -> String {
    let units = ["B", "KiB", "MiB", "GiB", "TiB"];
    let power = (number.max(1).ilog2() / 10).min(4);
    let value = number as f64 / 1024f64.powi(power as i32);
    if power == 0 { format!("{number} B") } else { format!("{value:.1} {}", units[power as usize]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!([0, 999, 1000, 1234567].map(count), ["0", "999", "1\u{2009}000", "1\u{2009}234\u{2009}567"]);
        assert_eq!(
            [0, 1023, 1024, 5 << 19, u64::MAX].map(bytes),
            ["0 B", "1023 B", "1.0 KiB", "2.5 MiB", "16777216.0 TiB"]
        );
    }
}
