//! Packing of rectangles into a square.

use glam::{DVec2, dvec2};

/// Corners of rectangles of the given sizes with `margin` round each, and the side of the square that holds them. They
/// stand on shelves by falling height, and those that fit are stacked on earlier ones. A rectangle of size zero takes no
/// room.
pub(super) fn pack(sizes: &[DVec2], margin: f64) -> (Vec<DVec2>, f64) {
    let area: f64 = sizes.iter().map(|size| (size.x + margin) * (size.y + margin)).sum();
    let widest = sizes.iter().fold(0.0, |most: f64, size| most.max(size.x + 2.0 * margin));
    let mut side = area.sqrt().max(widest);
    loop {
        let (corners, height) = shelves(sizes, margin, side);
        if height <= side {
            return (corners, side);
        }
        side *= 1.01;
    }
}

/// A stack of rectangles on a shelf.
struct Stack {
    /// Where the next rectangle goes.
    pen: DVec2,
    width: f64,
    /// Where the next shelf begins.
    top: f64,
}

impl Stack {
    /// Puts a rectangle on the stack if there is room.
    fn push(&mut self, size: DVec2, margin: f64) -> Option<DVec2> {
        let fits = size.x <= self.width && self.pen.y + size.y + margin <= self.top;
        fits.then(|| {
            let corner = self.pen;
            self.pen.y += size.y + margin;
            corner
        })
    }
}

/// Corners for shelves of one width, and their height in all.
fn shelves(sizes: &[DVec2], margin: f64, width: f64) -> (Vec<DVec2>, f64) {
    let mut order: Vec<usize> = (0..sizes.len()).filter(|&index| sizes[index] != DVec2::ZERO).collect();
    order.sort_by(|&a, &b| sizes[b].y.total_cmp(&sizes[a].y).then(a.cmp(&b)));
    let mut corners = vec![DVec2::ZERO; sizes.len()];
    let mut stacks: Vec<Stack> = Vec::new();
    let (mut pen, mut top) = (dvec2(width, margin), margin);
    for index in order {
        let size = sizes[index];
        if let Some(corner) = stacks.iter_mut().find_map(|stack| stack.push(size, margin)) {
            corners[index] = corner;
            continue;
        }
        if pen.x + size.x + margin > width {
            pen = dvec2(margin, top);
            top += size.y + margin;
        }
        corners[index] = pen;
        stacks.push(Stack { pen: pen + DVec2::Y * (size.y + margin), width: size.x, top });
        pen.x += size.x + margin;
    }
    (corners, top)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_keep_clear_of_each_other_and_of_the_border() {
        let sizes: Vec<DVec2> = (0..40).map(|k| dvec2(0.2 + f64::from(k % 7), 0.1 + f64::from(k % 5))).collect();
        let (corners, side) = pack(&sizes, 0.25);
        for (index, (corner, size)) in corners.iter().zip(&sizes).enumerate() {
            assert!(corner.min_element() >= 0.25 && (*corner + *size).max_element() <= side - 0.25 + 1e-9);
            for (other, extent) in corners.iter().zip(&sizes).take(index) {
                let apart = (*corner - *other - *extent).max(*other - *corner - *size).max_element();
                assert!(apart >= 0.25 - 1e-9, "{apart}");
            }
        }
    }
}
