//! What a swapchain is made with, chosen from what the window's system offers.

use ash::vk;

use crate::{Format, ImageUsage};

/// When frames are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum PresentMode {
    /// One after the other, with the screen's refresh: nothing tears, and drawing is held to the screen's rate. Every window
    /// offers this; not every one really waits.
    #[default]
    Fifo,
    /// The latest one, with the screen's refresh: nothing tears, and drawing is not held back.
    Mailbox,
    /// At once: may tear.
    Immediate,
}

impl PresentMode {
    pub(super) const ALL: [Self; 3] = [Self::Fifo, Self::Mailbox, Self::Immediate];

    pub(super) fn raw(self) -> vk::PresentModeKHR {
        match self {
            Self::Fifo => vk::PresentModeKHR::FIFO,
            Self::Mailbox => vk::PresentModeKHR::MAILBOX,
            Self::Immediate => vk::PresentModeKHR::IMMEDIATE,
        }
    }
}

/// The wanted mode if there is one, or else the one that is always there.
pub(super) fn mode(offered: &[PresentMode], wanted: PresentMode) -> PresentMode {
    if offered.contains(&wanted) { wanted } else { PresentMode::Fifo }
}

/// The first wanted format that is offered, or else any that we know; all in the colour space of ordinary screens.
pub(super) fn format(offered: &[vk::SurfaceFormatKHR], wanted: &[Format]) -> Option<vk::SurfaceFormatKHR> {
    let ordinary = |one: &&vk::SurfaceFormatKHR| one.color_space == vk::ColorSpaceKHR::SRGB_NONLINEAR;
    let known = |one: &&vk::SurfaceFormatKHR| Format::of_window(one.format).is_some();
    let offered = || offered.iter().filter(ordinary).filter(known);
    let first = wanted.iter().find_map(|format| offered().find(|one| one.format == format.raw()));
    first.or_else(|| offered().next()).copied()
}

/// The size of the images; `None` if the window has no pixels.
pub(super) fn extent(capabilities: &vk::SurfaceCapabilitiesKHR, size: [u32; 2]) -> Option<vk::Extent2D> {
    let (least, most) = (capabilities.min_image_extent, capabilities.max_image_extent);
    // Some systems leave the size to us and say so by the largest number.
    let extent = match capabilities.current_extent {
        vk::Extent2D { width: u32::MAX, height: u32::MAX } => {
            let [width, height] = size;
            // Not `clamp`, which panics where a system contradicts itself.
            let within = |value: u32, least: u32, most: u32| value.max(least).min(most);
            vk::Extent2D {
                width: within(width, least.width, most.width),
                height: within(height, least.height, most.height),
            }
        }
        current => current,
    };
    (extent.width > 0 && extent.height > 0).then_some(extent)
}

/// One image more than the system needs, so that drawing need not wait for it.
fn image_count(capabilities: &vk::SurfaceCapabilitiesKHR) -> u32 {
    let wanted = capabilities.min_image_count.saturating_add(1);
    // Zero means that there is no limit.
    if capabilities.max_image_count == 0 { wanted } else { wanted.min(capabilities.max_image_count) }
}

/// How the window's alpha is taken: not at all, where that can be had.
fn composite_alpha(capabilities: &vk::SurfaceCapabilitiesKHR) -> vk::CompositeAlphaFlagsKHR {
    let order = [
        vk::CompositeAlphaFlagsKHR::OPAQUE,
        vk::CompositeAlphaFlagsKHR::INHERIT,
        vk::CompositeAlphaFlagsKHR::PRE_MULTIPLIED,
        vk::CompositeAlphaFlagsKHR::POST_MULTIPLIED,
    ];
    let offered = capabilities.supported_composite_alpha;
    order.into_iter().find(|one| offered.contains(*one)).unwrap_or(vk::CompositeAlphaFlagsKHR::OPAQUE)
}

/// What images of windows are used for, where the system can.
const USAGES: [(ImageUsage, vk::ImageUsageFlags); 3] = [
    (ImageUsage::TARGET, vk::ImageUsageFlags::COLOR_ATTACHMENT),
    (ImageUsage::COPY_SRC, vk::ImageUsageFlags::TRANSFER_SRC),
    (ImageUsage::COPY_DST, vk::ImageUsageFlags::TRANSFER_DST),
];

pub(super) fn image_usage(flags: vk::ImageUsageFlags) -> ImageUsage {
    USAGES.into_iter().filter(|(_, flag)| flags.contains(*flag)).map(|(usage, _)| usage).collect()
}

/// All but the surface and the old swapchain.
pub(super) fn swapchain(
    capabilities: &vk::SurfaceCapabilitiesKHR,
    extent: vk::Extent2D,
    format: vk::SurfaceFormatKHR,
    mode: PresentMode,
) -> vk::SwapchainCreateInfoKHR<'static> {
    let all = USAGES.into_iter().fold(vk::ImageUsageFlags::empty(), |all, (_, flag)| all | flag);
    vk::SwapchainCreateInfoKHR::default()
        .min_image_count(image_count(capabilities))
        .image_format(format.format)
        .image_color_space(format.color_space)
        .image_extent(extent)
        .image_array_layers(1)
        // Colour attachments are always supported.
        .image_usage((all & capabilities.supported_usage_flags) | vk::ImageUsageFlags::COLOR_ATTACHMENT)
        .image_sharing_mode(vk::SharingMode::EXCLUSIVE)
        .pre_transform(capabilities.current_transform)
        .composite_alpha(composite_alpha(capabilities))
        .present_mode(mode.raw())
        .clipped(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORDINARY: vk::ColorSpaceKHR = vk::ColorSpaceKHR::SRGB_NONLINEAR;

    fn offer(format: vk::Format, color_space: vk::ColorSpaceKHR) -> vk::SurfaceFormatKHR {
        vk::SurfaceFormatKHR { format, color_space }
    }

    #[test]
    fn formats_are_taken_by_our_preference() {
        let offered = [
            offer(vk::Format::B8G8R8A8_SRGB, vk::ColorSpaceKHR::HDR10_ST2084_EXT),
            offer(vk::Format::A2B10G10R10_UNORM_PACK32, ORDINARY),
            offer(vk::Format::B8G8R8A8_UNORM, ORDINARY),
            offer(vk::Format::R8G8B8A8_SRGB, ORDINARY),
        ];
        let chosen = |wanted: &[Format]| format(&offered, wanted).map(|one| one.format);
        assert_eq!(chosen(&[Format::Bgra8Srgb, Format::Rgba8Srgb]), Some(vk::Format::R8G8B8A8_SRGB));
        assert_eq!(chosen(&[]), Some(vk::Format::B8G8R8A8_UNORM), "the first that we know");
        assert_eq!(format(&offered[..2], &[Format::Bgra8Srgb]), None);
    }

    #[test]
    fn modes_fall_back_to_the_one_that_is_always_there() {
        let offered = [PresentMode::Fifo, PresentMode::Immediate];
        assert_eq!(mode(&offered, PresentMode::Immediate), PresentMode::Immediate);
        assert_eq!(mode(&offered, PresentMode::Mailbox), PresentMode::Fifo);
    }

    fn sizes(current: [u32; 2], least: [u32; 2], most: [u32; 2]) -> vk::SurfaceCapabilitiesKHR {
        let extent = |[width, height]: [u32; 2]| vk::Extent2D { width, height };
        vk::SurfaceCapabilitiesKHR {
            current_extent: extent(current),
            min_image_extent: extent(least),
            max_image_extent: extent(most),
            ..Default::default()
        }
    }

    #[test]
    fn the_window_knows_its_size_or_leaves_it_to_us() {
        let found = |capabilities, size| extent(&capabilities, size).map(|found| [found.width, found.height]);
        assert_eq!(found(sizes([30, 20], [30, 20], [30, 20]), [5, 5]), Some([30, 20]));
        assert_eq!(found(sizes([0, 0], [0, 0], [0, 0]), [5, 5]), None, "minimised");
        assert_eq!(found(sizes([u32::MAX; 2], [1, 1], [100, 100]), [5, 500]), Some([5, 100]));
        assert_eq!(found(sizes([u32::MAX; 2], [1, 1], [0, 0]), [5, 5]), None, "nothing fits");
    }

    #[test]
    fn one_image_is_to_spare_within_the_limit() {
        let count = |least, most| {
            let capabilities =
                vk::SurfaceCapabilitiesKHR { min_image_count: least, max_image_count: most, ..Default::default() };
            image_count(&capabilities)
        };
        assert_eq!([count(2, 0), count(2, 8), count(3, 3)], [3, 3, 3]);
    }

    #[test]
    fn the_windows_alpha_is_ignored_where_it_can_be() {
        let chosen = |offered| {
            composite_alpha(&vk::SurfaceCapabilitiesKHR { supported_composite_alpha: offered, ..Default::default() })
        };
        let (opaque, inherit) = (vk::CompositeAlphaFlagsKHR::OPAQUE, vk::CompositeAlphaFlagsKHR::INHERIT);
        assert_eq!(chosen(opaque | inherit), opaque);
        assert_eq!(chosen(inherit | vk::CompositeAlphaFlagsKHR::PRE_MULTIPLIED), inherit);
    }
}
