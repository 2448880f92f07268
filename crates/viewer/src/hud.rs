//! What lies over the picture: figures, names of schemes, notes, the point that was picked.

use egui::{Align2, Area, Color32, FontId, Id, Pos2, Rect, RichText, Stroke, Ui, Vec2, pos2, vec2};
use glam::DVec2;

use crate::choice::Compare;
use crate::panels::count;
use crate::picking::Picked;
use crate::state::State;
use crate::theme;

/// Width of the figures in points.
const WIDTH: f32 = 232.0;
/// Distance from the edges of the picture.
const MARGIN: f32 = 14.0;

/// Shows everything over a picture that covers `rect`.
pub(crate) fn show(ui: &mut Ui, rect: Rect, state: &mut State) {
    if state.settings.screen.figures && rect.width() > WIDTH + 120.0 && state.model.is_some() {
        card(ui, "figures", rect.right_top() + vec2(-MARGIN, MARGIN), Align2::RIGHT_TOP, |ui| figures(ui, state));
    }
    names(ui, rect, state);
    if let (Some(picked), Some(_)) = (&state.picked, &state.model) {
        marker(ui, rect, state, picked);
        card(ui, "picked", rect.left_bottom() + vec2(MARGIN, -MARGIN), Align2::LEFT_BOTTOM, |ui| point(ui, picked));
    }
    if let (Some(vertex), Some(points)) = (state.sculpting.dragged.or(state.sculpting.hovered), state.points())
        && let Some(at) = points.get(vertex).and_then(|&point| on_screen(state, rect, point))
    {
        ui.painter().circle(
            at,
            7.0,
            Color32::from_rgba_unmultiplied(255, 210, 160, 60),
            Stroke::new(1.5, Color32::WHITE),
        );
    }
    notes(ui, rect, state);
    if state.model.is_none() && state.status.work.is_none() {
        let text = "drop a model here, or press O";
        ui.painter().text(rect.center(), Align2::CENTER_CENTER, text, FontId::proportional(17.0), theme::FAINT);
    }
}

fn card(ui: &Ui, id: &str, at: Pos2, pivot: Align2, add: impl FnOnce(&mut Ui)) {
    let area = Area::new(Id::new(id)).fixed_pos(at).pivot(pivot).interactable(false).order(egui::Order::Background);
    area.show(ui.ctx(), |ui| theme::card().show(ui, add));
}

/// Frame times, triangles, patches.
fn figures(ui: &mut Ui, state: &State) {
    let figures = &state.figures;
    ui.set_width(WIDTH);
    ui.spacing_mut().item_spacing.y = 3.0;
    let median = figures.frames.median();
    ui.horizontal(|ui| {
        let rate = if median > 0.0 { 1.0 / median } else { 0.0 };
        ui.label(RichText::new(format!("{:.1} ms", 1e3 * median)).size(17.0).color(Color32::WHITE));
        ui.label(RichText::new(format!("{rate:.0} / s")).color(theme::FAINT));
    });
    graph(ui, figures.frames.times());
    ui.add_space(2.0);
    let measured = &figures.measured;
    let device = measured.update + measured.surface + measured.marks;
    pair(ui, "GPU", format!("{:.2} ms", 1e3 * device));
    if state.device.times_passes {
        for (name, seconds) in [("update", measured.update), ("surface", measured.surface), ("marks", measured.marks)] {
            if seconds > 0.0 {
                pair(ui, &format!("   {name}"), format!("{:.2} ms", 1e3 * seconds));
            }
        }
    }
    pair(ui, "CPU", format!("{:.2} ms", 1e3 * figures.host));
    if let Some(triangles) = measured.triangles {
        pair(ui, "triangles", count(triangles as usize));
    }
    pair(ui, "memory", format!("{:.1} MiB", figures.memory as f64 / f64::from(1 << 20)));
    patches(ui, state);
}

/// Patches by kind, those of the first scheme.
fn patches(ui: &mut Ui, state: &State) {
    let Some((_, census)) = state.model.as_ref().and_then(|model| model.surfaces.first()) else { return };
    ui.add_space(4.0);
    pair(ui, "patches", count(census.patches));
    for kind in &census.kinds {
        let [r, g, b] = kind.color;
        let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, 15.0), egui::Sense::hover());
        ui.painter().circle_filled(rect.left_center() + vec2(5.0, 0.0), 4.0, Color32::from_rgb(r, g, b));
        let font = FontId::proportional(12.0);
        ui.painter().text(
            rect.left_center() + vec2(16.0, 0.0),
            Align2::LEFT_CENTER,
            &kind.label,
            font.clone(),
            theme::FAINT,
        );
        ui.painter().text(rect.right_center(), Align2::RIGHT_CENTER, count(kind.count), font, theme::TEXT);
    }
}

fn pair(ui: &mut Ui, about: &str, value: String) {
    let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, 16.0), egui::Sense::hover());
    let font = FontId::proportional(13.0);
    ui.painter().text(rect.left_center(), Align2::LEFT_CENTER, about, font.clone(), theme::FAINT);
    ui.painter().text(rect.right_center(), Align2::RIGHT_CENTER, value, font, theme::TEXT);
}

/// Frame times as bars, up to 33 ms or the longest; a line at 16.7 ms.
fn graph(ui: &mut Ui, times: impl ExactSizeIterator<Item = f32>) {
    let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, 40.0), egui::Sense::hover());
    let times: Vec<f32> = times.collect();
    let highest = times.iter().copied().fold(1.0 / 30.0, f32::max);
    let painter = ui.painter();
    painter.rect_filled(rect, 4.0, Color32::from_rgba_unmultiplied(255, 255, 255, 8));
    let width = WIDTH / 120.0;
    for (at, time) in times.iter().rev().enumerate() {
        let right = rect.right() - at as f32 * width;
        let top = rect.bottom() - rect.height() * (time / highest);
        let bar = Rect::from_min_max(pos2(right - width * 0.75, top), pos2(right, rect.bottom()));
        painter.rect_filled(
            bar,
            0.0,
            if *time > 1.0 / 30.0 { theme::ACCENT } else { Color32::from_rgb(104, 158, 196) },
        );
    }
    let line = rect.bottom() - rect.height() * (1.0 / 60.0 / highest);
    painter.hline(rect.x_range(), line, Stroke::new(1.0, Color32::from_rgba_unmultiplied(255, 255, 255, 36)));
}

/// Which scheme is shown where, where there are two.
fn names(ui: &Ui, rect: Rect, state: &State) {
    let look = &state.settings.look;
    let Some(model) = state.model.as_ref().filter(|model| model.surfaces.len() == 2) else { return };
    let middle = if look.compare == Compare::Wipe { rect.left() + state.wipe * rect.width() } else { rect.center().x };
    let painter = ui.painter();
    painter.vline(middle, rect.y_range(), Stroke::new(1.5, Color32::from_rgba_unmultiplied(255, 255, 255, 110)));
    let places = [
        (pos2(middle - 12.0, rect.bottom() - 16.0), Align2::RIGHT_BOTTOM),
        (pos2(middle + 12.0, rect.bottom() - 16.0), Align2::LEFT_BOTTOM),
    ];
    for ((scheme, _), (at, align)) in model.surfaces.iter().zip(places) {
        painter.text(
            at + Vec2::splat(1.0),
            align,
            scheme.name(),
            FontId::proportional(16.0),
            Color32::from_black_alpha(160),
        );
        painter.text(at, align, scheme.name(), FontId::proportional(16.0), Color32::WHITE);
    }
    if look.compare == Compare::Wipe {
        let knob = pos2(middle, rect.center().y);
        painter.circle(knob, 9.0, theme::PANEL, Stroke::new(1.5, Color32::WHITE));
        painter.text(knob, Align2::CENTER_CENTER, "↔", FontId::proportional(13.0), Color32::WHITE);
    }
}

/// What is known of the point.
fn point(ui: &mut Ui, picked: &Picked) {
    ui.spacing_mut().item_spacing.y = 3.0;
    let (at, sample) = (&picked.point, &picked.sample);
    let sub = if at.sub_face.sub < 0 { String::new() } else { format!(", corner {}", at.sub_face.sub) };
    let vector = |v: glam::DVec3| format!("{:.4}  {:.4}  {:.4}", v.x, v.y, v.z);
    let line = |ui: &mut Ui, about: &str, text: String| {
        ui.horizontal(|ui| {
            let layout = egui::Layout::left_to_right(egui::Align::Center);
            ui.allocate_ui_with_layout(vec2(66.0, 16.0), layout, |ui| {
                ui.set_min_width(66.0);
                ui.label(RichText::new(about).color(theme::FAINT));
            });
            ui.label(RichText::new(text).monospace());
        });
    };
    line(ui, "face", format!("{}{sub}   s {:.4}  t {:.4}", at.sub_face.face, at.s, at.t));
    line(ui, "position", vector(sample.position));
    line(ui, "normal", vector(sample.normal));
    if let Some([mean, gaussian]) = picked.curvature {
        line(ui, "curvature", format!("mean {mean:.4}  Gaussian {gaussian:.4}"));
    }
}

/// A ring and the normal at the point that was picked.
fn marker(ui: &Ui, rect: Rect, state: &State, picked: &Picked) {
    let length = 0.15 * state.bounds().half_diagonal();
    let tip = picked.sample.position + length * picked.sample.normal;
    let (Some(at), Some(tip)) = (on_screen(state, rect, picked.sample.position), on_screen(state, rect, tip)) else {
        return;
    };
    let painter = ui.painter().with_clip_rect(rect);
    painter.line_segment([at, tip], Stroke::new(2.0, theme::ACCENT));
    painter.circle(at, 4.5, theme::ACCENT, Stroke::new(1.5, Color32::WHITE));
}

/// Where a point of the first view is.
fn on_screen(state: &State, rect: Rect, point: glam::DVec3) -> Option<Pos2> {
    let look = &state.settings.look;
    let halves = look.compare == Compare::Split && !look.shows_difference();
    let width = if halves { rect.width() / 2.0 } else { rect.width() };
    let size = DVec2::new(f64::from(width), f64::from(rect.height()));
    let (at, _) = state.orbit.as_ref()?.project(point, size)?;
    Some(rect.min + vec2(at.x as f32, at.y as f32))
}

/// Notes, and what is being done, at the bottom.
fn notes(ui: &Ui, rect: Rect, state: &mut State) {
    let work = state.status.work.clone();
    let notes = state.status.notes(std::time::Instant::now()).to_vec();
    if work.is_none() && notes.is_empty() {
        return;
    }
    let at = pos2(rect.center().x, rect.bottom() - 44.0);
    let area = Area::new(Id::new("notes")).fixed_pos(at).pivot(Align2::CENTER_BOTTOM).order(egui::Order::Foreground);
    let shown = area.show(ui.ctx(), |ui| {
        ui.set_max_width((rect.width() - 60.0).clamp(120.0, 620.0));
        for note in &notes {
            theme::card().show(ui, |ui| {
                let color = if note.is_error { theme::ERROR } else { theme::TEXT };
                ui.label(RichText::new(&note.text).color(color));
            });
        }
        let dismissed = ui.interact(ui.min_rect(), Id::new("dismiss notes"), egui::Sense::click()).clicked();
        if let Some((text, part)) = work {
            theme::card().show(ui, |ui| {
                ui.horizontal(|ui| {
                    ui.spinner();
                    ui.label(text);
                    if let Some(part) = part {
                        ui.add(egui::ProgressBar::new(part).desired_width(120.0));
                    }
                });
            });
        }
        dismissed
    });
    if shown.inner {
        state.status.dismiss();
    }
}
