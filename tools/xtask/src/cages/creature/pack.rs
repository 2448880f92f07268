//! Packing of rectangles into a square.

use glam::{DVec2, dvec2};

/// Corners of rectangles of the given sizes, laid on shelves by falling height with `margin` round each, and the side of
/// the square that holds them. A rectangle of size zero takes no room.
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

/// Corners for shelves of one width, and their height in all.
fn shelves(sizes: &[DVec2], margin: f64, width: f64) -> (Vec<DVec2>, f64) {
    let mut order: Vec<usize> = (0..sizes.len()).filter(|&index| sizes[index] != DVec2::ZERO).collect();
    order.sort_by(|&a, &b| sizes[b].y.total_cmp(&sizes[a].y).then(a.cmp(&b)));
    let mut corners = vec![DVec2::ZERO; sizes.len()];
    let (mut pen, mut shelf) = (dvec2(margin, margin), 0.0);
    for index in order {
        if pen.x + sizes[index].x + margin > width {
            pen = dvec2(margin, pen.y + shelf + margin);
            shelf = 0.0;
        }
        corners[index] = pen;
        pen.x += sizes[index].x + margin;
        shelf = f64::max(shelf, sizes[index].y);
    }
    (corners, pen.y + shelf + margin)
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
