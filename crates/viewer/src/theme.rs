//! Colours and sizes of the interface: dark, calm, with the orange of the cage for what is chosen.

use egui::{Color32, CornerRadius, FontFamily, FontId, Margin, Stroke, TextStyle, Visuals};

/// What is behind panels.
pub(crate) const PANEL: Color32 = Color32::from_rgb(24, 26, 31);
/// What is behind the surface, sRGB.
pub(crate) const STAGE: Color32 = Color32::from_rgb(38, 42, 49);
/// What is chosen.
pub(crate) const ACCENT: Color32 = Color32::from_rgb(232, 138, 66);
/// Words of less weight.
pub(crate) const FAINT: Color32 = Color32::from_rgb(138, 145, 156);
/// Words.
pub(crate) const TEXT: Color32 = Color32::from_rgb(212, 215, 220);
/// What went wrong.
pub(crate) const ERROR: Color32 = Color32::from_rgb(240, 112, 104);

/// The background of the picture, linear.
pub(crate) fn stage() -> [f32; 4] {
    egui::Rgba::from(STAGE).to_array()
}

/// The background of the leak detector, linear: that of shaders/shade/surface.frag.
pub(crate) const LEAK: [f32; 4] = [1.0, 0.0, 1.0, 1.0];

/// Gives egui its looks.
pub(crate) fn apply(context: &egui::Context) {
    context.set_theme(egui::Theme::Dark);
    context.style_mut_of(egui::Theme::Dark, |style| {
        style.visuals = visuals();
        style.spacing.item_spacing = egui::vec2(8.0, 6.0);
        style.spacing.button_padding = egui::vec2(8.0, 3.0);
        style.spacing.slider_width = 132.0;
        style.spacing.combo_width = 150.0;
        style.spacing.interact_size.y = 22.0;
        style.text_styles = [
            (TextStyle::Heading, FontId::new(15.0, FontFamily::Proportional)),
            (TextStyle::Body, FontId::new(13.0, FontFamily::Proportional)),
            (TextStyle::Button, FontId::new(13.0, FontFamily::Proportional)),
            (TextStyle::Small, FontId::new(11.0, FontFamily::Proportional)),
            (TextStyle::Monospace, FontId::new(12.0, FontFamily::Monospace)),
        ]
        .into();
    });
}

fn visuals() -> Visuals {
    let mut visuals = Visuals::dark();
    let fill = |grey: u8| Color32::from_rgb(grey, grey + 3, grey + 8);
    visuals.panel_fill = PANEL;
    visuals.window_fill = Color32::from_rgb(29, 32, 38);
    visuals.window_stroke = Stroke::new(1.0, fill(52));
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.extreme_bg_color = fill(15);
    visuals.faint_bg_color = fill(30);
    visuals.override_text_color = None;
    visuals.weak_text_color = Some(FAINT);
    visuals.hyperlink_color = ACCENT;
    visuals.error_fg_color = ERROR;
    visuals.selection.bg_fill = Color32::from_rgb(124, 72, 34);
    visuals.selection.stroke = Stroke::new(1.0, Color32::from_rgb(255, 226, 200));
    visuals.slider_trailing_fill = true;
    let widgets = &mut visuals.widgets;
    for (widget, background, text) in [
        (&mut widgets.noninteractive, fill(24), TEXT),
        (&mut widgets.inactive, fill(46), TEXT),
        (&mut widgets.hovered, fill(60), Color32::WHITE),
        (&mut widgets.active, fill(72), Color32::WHITE),
        (&mut widgets.open, fill(52), TEXT),
    ] {
        widget.bg_fill = background;
        widget.weak_bg_fill = background;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = CornerRadius::same(5);
        widget.expansion = 0.0;
    }
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, fill(44));
    visuals
}

/// The frame of what lies over the picture.
pub(crate) fn card() -> egui::Frame {
    egui::Frame::new()
        .fill(Color32::from_rgba_unmultiplied(20, 22, 27, 215))
        .corner_radius(CornerRadius::same(8))
        .inner_margin(Margin::symmetric(12, 9))
}
