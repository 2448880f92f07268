//! Rectangles of texels.

use ash::vk;

/// A rectangle of texels; y points down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub struct Rect {
    /// Column and row of the upper left texel.
    pub origin: [u32; 2],
    /// Width and height in texels.
    pub size: [u32; 2],
}

impl Rect {
    /// Whether it has no texels.
    pub fn is_empty(&self) -> bool {
        self.size.contains(&0)
    }

    /// Whether it lies within `0..size`.
    pub fn fits(&self, size: [u32; 2]) -> bool {
        (0..2).all(|axis| self.origin[axis].checked_add(self.size[axis]).is_some_and(|end| end <= size[axis]))
    }

    /// What it has in common with another one; empty if nothing.
    #[must_use]
    pub fn intersection(&self, other: Self) -> Self {
        let end = |rect: &Self, axis: usize| rect.origin[axis].saturating_add(rect.size[axis]);
        let origin = [0, 1].map(|axis| self.origin[axis].max(other.origin[axis]));
        let size = [0, 1].map(|axis| end(self, axis).min(end(&other, axis)).saturating_sub(origin[axis]));
        Self { origin, size }
    }

    /// The rectangle for Vulkan, which takes origins up to 2^31 - 1: those of rectangles that fit an image are.
    pub(crate) fn raw(&self) -> vk::Rect2D {
        let [x, y] = self.origin.map(|one| i32::try_from(one).unwrap_or(i32::MAX));
        let [width, height] = self.size;
        vk::Rect2D { offset: vk::Offset2D { x, y }, extent: vk::Extent2D { width, height } }
    }
}

impl From<[u32; 2]> for Rect {
    /// All of an image of this size.
    fn from(size: [u32; 2]) -> Self {
        Self { origin: [0, 0], size }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rect(origin: [u32; 2], size: [u32; 2]) -> Rect {
        Rect { origin, size }
    }

    #[test]
    fn rectangles_fit_up_to_the_last_texel() {
        assert!(rect([3, 4], [5, 6]).fits([8, 10]));
        assert!(!rect([3, 4], [5, 6]).fits([7, 10]) && !rect([3, 4], [5, 6]).fits([8, 9]));
        assert!(!rect([u32::MAX, 0], [2, 1]).fits([u32::MAX, 1]), "the end overflows");
    }

    #[test]
    fn intersections_are_common_texels() {
        let one = rect([2, 3], [10, 10]);
        assert_eq!(one.intersection([5, 50].into()), rect([2, 3], [3, 10]));
        assert_eq!(one.intersection(rect([4, 4], [1, 1])), rect([4, 4], [1, 1]));
        assert!(one.intersection(rect([12, 3], [4, 4])).is_empty(), "they only touch");
        assert!(one.intersection([1, 1].into()).is_empty(), "they are apart");
        assert_eq!(one.intersection(rect([0, 0], [u32::MAX; 2])), one);
    }
}
