//! What the mouse does in the picture.

use egui::{CursorIcon, PointerButton, Rect, Response, Sense, Ui, pos2, vec2};
use glam::{DVec2, DVec3};

use crate::camera::Orbit;
use crate::choice::Compare;
use crate::picking::vertex_at;
use crate::state::State;

/// How far from a vertex the pointer may be, in points.
const REACH: f64 = 9.0;
/// Points of scrolling that make a notch of the wheel.
const NOTCH: f64 = 50.0;
/// How far one flies in a second, in parts of the distance to what is looked at.
const SPEED: f64 = 0.7;

/// What was asked for in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Asked {
    /// A click: what is there, seen from the eye in this direction.
    pub(crate) pick: Option<Click>,
    /// A key is held down that moves the eye.
    pub(crate) flies: bool,
}

/// A click.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Click {
    pub(crate) eye: DVec3,
    pub(crate) direction: DVec3,
    /// The view that it was in.
    pub(crate) side: usize,
}

/// The part of the picture that a place is in.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    /// From the upper left corner of the view, in points.
    at: DVec2,
    /// Width and height of the view.
    size: DVec2,
    side: usize,
}

/// Lets the mouse work in the picture that covers `rect`.
pub(crate) fn navigate(ui: &mut Ui, rect: Rect, state: &mut State) -> Asked {
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    wipe(ui, rect, state);
    let Some(orbit) = state.orbit else { return Asked::default() };
    let size = place(rect, rect.center(), state).size;
    hover(ui, &response, rect, state, &orbit);
    drag(ui, &response, state, size);
    scroll(ui, &response, state);
    let flies = fly(ui, state);
    let clicked = response.clicked().then(|| response.interact_pointer_pos()).flatten();
    let pick = clicked.map(|pointer| {
        let Place { at, size, side } = place(rect, pointer, state);
        Click { eye: orbit.eye(), direction: orbit.ray(at, size), side }
    });
    Asked { pick, flies }
}

/// Where a pointer is.
fn place(rect: Rect, pointer: egui::Pos2, state: &State) -> Place {
    let from_corner = pointer - rect.min;
    let whole = vec2(rect.width().max(1.0), rect.height().max(1.0));
    let compared = state.model.as_ref().is_some_and(|model| model.surfaces.len() == 2);
    let (at, size, side) = match state.settings.look.compare {
        Compare::Split if compared => {
            let half = vec2(whole.x / 2.0, whole.y);
            let right = from_corner.x >= half.x;
            (if right { from_corner - vec2(half.x, 0.0) } else { from_corner }, half, usize::from(right))
        }
        Compare::Wipe if compared => (from_corner, whole, usize::from(from_corner.x >= state.wipe * whole.x)),
        _ => (from_corner, whole, 0),
    };
    let double = |v: egui::Vec2| DVec2::new(f64::from(v.x), f64::from(v.y));
    Place { at: double(at), size: double(size), side }
}

/// The line of the wipe.
fn wipe(ui: &mut Ui, rect: Rect, state: &mut State) {
    let compared = state.model.as_ref().is_some_and(|model| model.surfaces.len() == 2);
    if state.settings.look.compare != Compare::Wipe || !compared {
        return;
    }
    let x = rect.left() + state.wipe * rect.width();
    let strip = Rect::from_x_y_ranges(x - 8.0..=x + 8.0, rect.y_range());
    let response = ui.interact(strip, ui.id().with("wipe"), Sense::drag());
    if response.hovered() || response.dragged() {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    if let Some(pointer) = response.dragged().then(|| response.interact_pointer_pos()).flatten() {
        state.wipe = ((pointer.x - rect.left()) / rect.width().max(1.0)).clamp(0.02, 0.98);
    }
}

/// Finds the vertex under the pointer, and takes hold of it when a drag begins there.
fn hover(ui: &Ui, response: &Response, rect: Rect, state: &mut State, orbit: &Orbit) {
    if !state.can_sculpt() {
        (state.sculpting.hovered, state.sculpting.dragged) = (None, None);
        return;
    }
    if state.sculpting.dragged.is_none() {
        let pointer = response.hover_pos().filter(|_| !response.dragged() || response.drag_started());
        // A drag begins where the button went down, not where the pointer is by now.
        let pointer = if response.drag_started() { ui.input(|input| input.pointer.press_origin()) } else { pointer };
        let found = pointer.zip(state.points()).and_then(|(pointer, points)| {
            let Place { at, size, .. } = place(rect, pointer, state);
            vertex_at(points, orbit, at, size, REACH)
        });
        state.sculpting.hovered = found;
    }
    if response.drag_started_by(PointerButton::Primary) {
        state.sculpting.dragged = state.sculpting.hovered;
    }
    if !response.dragged_by(PointerButton::Primary) && state.sculpting.dragged.take().is_some() {
        state.sculpting.moves += 1;
    }
    if state.sculpting.hovered.is_some() {
        ui.ctx().set_cursor_icon(CursorIcon::Grab);
    }
}

/// Circles, looks around, moves sideways, comes closer, or moves a vertex.
fn drag(ui: &Ui, response: &Response, state: &mut State, size: DVec2) {
    let pixels = DVec2::new(f64::from(response.drag_delta().x), f64::from(response.drag_delta().y));
    if pixels == DVec2::ZERO {
        return;
    }
    let part = pixels / size.y;
    let shift = ui.input(|input| input.modifiers.shift);
    if state.sculpting.dragged.is_some() {
        return state.drag_vertex(pixels, size);
    }
    let flies = state.flies;
    let Some(orbit) = &mut state.orbit else { return };
    if response.dragged_by(PointerButton::Middle) || (shift && response.dragged_by(PointerButton::Primary)) {
        orbit.pan(part);
    } else if response.dragged_by(PointerButton::Secondary) {
        orbit.dolly(-20.0 * part.y);
    } else if flies {
        orbit.look(part);
    } else {
        orbit.orbit(part);
    }
}

fn scroll(ui: &Ui, response: &Response, state: &mut State) {
    if !response.hovered() {
        return;
    }
    let notches = ui.input(|input| f64::from(input.smooth_scroll_delta.y) / NOTCH);
    let pinch = ui.input(|input| f64::from(input.zoom_delta()));
    if let Some(orbit) = &mut state.orbit {
        orbit.dolly(notches + if pinch > 0.0 { 4.0 * pinch.ln() } else { 0.0 });
    }
}

/// Moves the eye by the keys that are held; whether one is.
fn fly(ui: &Ui, state: &mut State) -> bool {
    if !state.flies || ui.ctx().wants_keyboard_input() {
        return false;
    }
    let axis = |plus: egui::Key, minus: egui::Key| {
        ui.input(|input| f64::from(u8::from(input.key_down(plus))) - f64::from(u8::from(input.key_down(minus))))
    };
    let thrust = DVec3::new(
        axis(egui::Key::D, egui::Key::A),
        axis(egui::Key::E, egui::Key::Q),
        axis(egui::Key::W, egui::Key::S),
    );
    let seconds = ui.input(|input| f64::from(input.stable_dt.min(0.1)));
    if let Some(orbit) = &mut state.orbit {
        orbit.fly(thrust, SPEED * orbit.distance * seconds);
    }
    thrust != DVec3::ZERO
}

/// The middle of the picture if there is none: what covers the window beside the panels, in whole pixels.
pub(crate) fn picture_rect(available: Rect, pixels_per_point: f32) -> (Rect, [u32; 2], [u32; 2]) {
    let texel = |points: f32| (points * pixels_per_point).round().max(0.0) as u32;
    let origin = [texel(available.min.x), texel(available.min.y)];
    let end = [texel(available.max.x), texel(available.max.y)];
    let size = [0, 1].map(|axis| end[axis].saturating_sub(origin[axis]));
    let points = |texels: [u32; 2]| pos2(texels[0] as f32, texels[1] as f32) / pixels_per_point;
    (Rect::from_min_max(points(origin), points([origin[0] + size[0], origin[1] + size[1]])), origin, size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_have_whole_pixels() {
        let available = Rect::from_min_max(pos2(285.7, 0.0), pos2(1279.6, 799.9));
        let (rect, origin, size) = picture_rect(available, 1.0);
        assert_eq!((origin, size), ([286, 0], [994, 800]));
        assert_eq!(rect, Rect::from_min_max(pos2(286.0, 0.0), pos2(1280.0, 800.0)));
        let (_, origin, size) = picture_rect(available, 1.5);
        assert_eq!((origin, size), ([429, 0], [1490, 1200]));
        assert_eq!(picture_rect(Rect::NOTHING, 1.0).2, [0, 0]);
    }
}
