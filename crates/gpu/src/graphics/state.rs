//! The fixed-function states of a graphics pipeline.

use ash::vk;

use super::GraphicsPipelineDesc;
use crate::{Numbers, Reflection, VertexInput};

/// What vertices are joined to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Topology {
    /// Separate points.
    Points,
    /// Separate lines, two vertices each.
    Lines,
    /// Connected lines.
    LineStrip,
    /// Separate triangles, three vertices each.
    #[default]
    Triangles,
    /// Connected triangles.
    TriangleStrip,
    /// Patches for tessellation.
    Patches,
}

/// How triangles are filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum PolygonMode {
    /// Their whole area.
    #[default]
    Fill,
    /// Their edges only; needs [`Features::wireframe`](crate::Features::wireframe).
    Line,
}

/// Which triangles are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// Those facing away.
    Back,
    /// Those facing the viewer.
    Front,
}

/// Which triangles face the viewer, as seen in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum FrontFace {
    /// Those whose vertices run counter-clockwise in the picture.
    #[default]
    CounterClockwise,
    /// Those whose vertices run clockwise in the picture.
    Clockwise,
}

/// Which depths pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Compare {
    /// Smaller ones.
    #[default]
    Less,
    /// Smaller or equal ones.
    LessOrEqual,
    /// Greater ones, for a reversed depth range.
    Greater,
    /// Greater or equal ones, for a reversed depth range.
    GreaterOrEqual,
    /// All.
    Always,
}

/// Added to depths, to draw lines upon faces.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct DepthBias {
    /// In units of the smallest difference of depths.
    pub constant: f32,
    /// Times the slope of the triangle.
    pub slope: f32,
}

/// How the depth target is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthState {
    /// Depths that pass are written.
    pub write: bool,
    /// Which depths pass.
    pub compare: Compare,
    /// Added to depths.
    pub bias: Option<DepthBias>,
}

impl Default for DepthState {
    fn default() -> Self {
        Self { write: true, compare: Compare::Less, bias: None }
    }
}

/// How colours are combined with those of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Blend {
    /// They replace them.
    #[default]
    Replace,
    /// They are laid over them by their alpha, which is not yet multiplied in.
    Alpha,
    /// They are laid over them by their alpha, which is multiplied in already.
    Premultiplied,
}

pub(super) fn topology(topology: Topology) -> vk::PrimitiveTopology {
    match topology {
        Topology::Points => vk::PrimitiveTopology::POINT_LIST,
        Topology::Lines => vk::PrimitiveTopology::LINE_LIST,
        Topology::LineStrip => vk::PrimitiveTopology::LINE_STRIP,
        Topology::Triangles => vk::PrimitiveTopology::TRIANGLE_LIST,
        Topology::TriangleStrip => vk::PrimitiveTopology::TRIANGLE_STRIP,
        Topology::Patches => vk::PrimitiveTopology::PATCH_LIST,
    }
}

pub(super) fn rasterization(desc: &GraphicsPipelineDesc<'_>) -> vk::PipelineRasterizationStateCreateInfo<'static> {
    let polygon_mode = match desc.polygon_mode {
        PolygonMode::Fill => vk::PolygonMode::FILL,
        PolygonMode::Line => vk::PolygonMode::LINE,
    };
    let cull = match desc.cull {
        Cull::None => vk::CullModeFlags::NONE,
        Cull::Back => vk::CullModeFlags::BACK,
        Cull::Front => vk::CullModeFlags::FRONT,
    };
    let front = match desc.front_face {
        FrontFace::CounterClockwise => vk::FrontFace::COUNTER_CLOCKWISE,
        FrontFace::Clockwise => vk::FrontFace::CLOCKWISE,
    };
    let bias = desc.depth.and_then(|depth| depth.bias);
    let DepthBias { constant, slope } = bias.unwrap_or_default();
    vk::PipelineRasterizationStateCreateInfo::default()
        .rasterizer_discard_enable(desc.rasterizer_discard)
        .polygon_mode(polygon_mode)
        .cull_mode(cull)
        .front_face(front)
        .depth_bias_enable(bias.is_some())
        .depth_bias_constant_factor(constant)
        .depth_bias_slope_factor(slope)
        .line_width(1.0)
}

pub(super) fn depth(state: Option<DepthState>) -> vk::PipelineDepthStencilStateCreateInfo<'static> {
    let Some(state) = state else { return vk::PipelineDepthStencilStateCreateInfo::default() };
    let compare = match state.compare {
        Compare::Less => vk::CompareOp::LESS,
        Compare::LessOrEqual => vk::CompareOp::LESS_OR_EQUAL,
        Compare::Greater => vk::CompareOp::GREATER,
        Compare::GreaterOrEqual => vk::CompareOp::GREATER_OR_EQUAL,
        Compare::Always => vk::CompareOp::ALWAYS,
    };
    vk::PipelineDepthStencilStateCreateInfo::default()
        .depth_test_enable(true)
        .depth_write_enable(state.write)
        .depth_compare_op(compare)
}

pub(super) fn blend(blend: Blend) -> vk::PipelineColorBlendAttachmentState {
    let state = vk::PipelineColorBlendAttachmentState::default().color_write_mask(vk::ColorComponentFlags::RGBA);
    let over = |source| {
        state
            .blend_enable(true)
            .src_color_blend_factor(source)
            .dst_color_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
            .color_blend_op(vk::BlendOp::ADD)
            .src_alpha_blend_factor(vk::BlendFactor::ONE)
            .dst_alpha_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
            .alpha_blend_op(vk::BlendOp::ADD)
    };
    match blend {
        Blend::Replace => state,
        Blend::Alpha => over(vk::BlendFactor::SRC_ALPHA),
        Blend::Premultiplied => over(vk::BlendFactor::ONE),
    }
}

/// The one vertex buffer, if there are attributes.
pub(super) fn vertex_bindings(vertex: &Reflection) -> Vec<vk::VertexInputBindingDescription> {
    let stride = vertex.vertex_stride();
    let binding = vk::VertexInputBindingDescription::default().stride(stride).input_rate(vk::VertexInputRate::VERTEX);
    if stride > 0 { vec![binding] } else { Vec::new() }
}

/// Where the attributes lie in a vertex: in order of their locations, without gaps.
pub(super) fn attributes(vertex: &Reflection) -> Vec<vk::VertexInputAttributeDescription> {
    let offsets = vertex.inputs.iter().scan(0, |end, input| {
        let offset = *end;
        *end += 4 * input.components;
        Some(offset)
    });
    let attribute = |(input, offset): (&VertexInput, u32)| {
        let format = attribute_format(input.numbers, input.components);
        vk::VertexInputAttributeDescription::default().location(input.location).format(format).offset(offset)
    };
    vertex.inputs.iter().zip(offsets).map(attribute).collect()
}

/// Every Vulkan device reads attributes of these formats.
fn attribute_format(numbers: Numbers, components: u32) -> vk::Format {
    use vk::Format as F;
    let formats = match numbers {
        Numbers::Float => [F::R32_SFLOAT, F::R32G32_SFLOAT, F::R32G32B32_SFLOAT, F::R32G32B32A32_SFLOAT],
        Numbers::Uint => [F::R32_UINT, F::R32G32_UINT, F::R32G32B32_UINT, F::R32G32B32A32_UINT],
        Numbers::Int => [F::R32_SINT, F::R32G32_SINT, F::R32G32B32_SINT, F::R32G32B32A32_SINT],
    };
    formats[components.clamp(1, 4) as usize - 1]
}
