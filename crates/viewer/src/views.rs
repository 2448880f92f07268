//! Where in the picture each scheme is shown.

use osculate::gpu::Rect;

use crate::choice::Compare;

/// A part of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct View {
    /// What the camera's picture is mapped to.
    pub(crate) viewport: Rect,
    /// What of it is shown.
    pub(crate) area: Rect,
}

/// The views of a picture; two where schemes are compared, divided at `wipe` of the width where they share a viewport.
pub(crate) fn views(compare: Compare, wipe: f32, size: [u32; 2]) -> Vec<View> {
    let [width, height] = size;
    let whole = Rect::from(size);
    let columns = |from: u32, to: u32| Rect { origin: [from, 0], size: [to - from, height] };
    if width < 2 {
        return vec![View { viewport: whole, area: whole }];
    }
    match compare {
        Compare::Off => vec![View { viewport: whole, area: whole }],
        Compare::Split => {
            let half = width / 2;
            [columns(0, half), columns(width - half, width)].map(|area| View { viewport: area, area }).to_vec()
        }
        Compare::Wipe => {
            let at = ((wipe * width as f32).round() as u32).clamp(1, width - 1);
            [columns(0, at), columns(at, width)].map(|area| View { viewport: whole, area }).to_vec()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_cover_the_picture() {
        for size in [[800, 600], [801, 3], [2, 2]] {
            for (compare, count) in [(Compare::Off, 1), (Compare::Split, 2), (Compare::Wipe, 2)] {
                let views = views(compare, 0.3, size);
                assert_eq!(views.len(), count);
                for view in &views {
                    assert!(!view.area.is_empty() && view.area.fits(size) && view.viewport.fits(size), "{view:?}");
                    assert_eq!(view.area.intersection(view.viewport), view.area);
                }
                let covered: u32 = views.iter().map(|view| view.area.size[0]).sum();
                assert!(size[0] - covered <= 1, "{views:?}");
            }
        }
    }

    #[test]
    fn split_views_are_alike() {
        let views = views(Compare::Split, 0.0, [801, 600]);
        assert_eq!(views[0].viewport.size, views[1].viewport.size);
    }

    #[test]
    fn a_sliver_has_one_view() {
        assert_eq!(views(Compare::Split, 0.5, [1, 10]).len(), 1);
    }
}
