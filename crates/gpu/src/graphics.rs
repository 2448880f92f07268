//! Graphics pipelines.

mod state;

use std::sync::Arc;

use ash::vk;

use crate::{
    Device, Format, GpuError, Reflection, Shader, Stage,
    format::sample_flag,
    layout::merge,
    pipeline::{Pipeline, StageData},
};

pub use state::{Blend, Compare, Cull, DepthBias, DepthState, FrontFace, PolygonMode, Topology};

/// The tessellation stages of a pipeline.
#[derive(Clone, Copy, Debug)]
pub struct Tessellation<'a> {
    /// Tessellation control shader.
    pub control: &'a Shader,
    /// Tessellation evaluation shader.
    pub evaluation: &'a Shader,
    /// Points of an input patch.
    pub patch_points: u32,
}

/// How to make a graphics pipeline. Vertices have no attributes: the vertex shader reads buffers by `gl_VertexIndex`.
#[derive(Clone, Copy, Debug)]
pub struct GraphicsPipelineDesc<'a> {
    /// Name for tools and messages.
    pub name: &'a str,
    /// Vertex shader.
    pub vertex: &'a Shader,
    /// Tessellation stages; with them, and only then, the topology is [`Topology::Patches`].
    pub tessellation: Option<Tessellation<'a>>,
    /// Fragment shader.
    pub fragment: Option<&'a Shader>,
    /// What vertices are joined to.
    pub topology: Topology,
    /// How triangles are filled.
    pub polygon_mode: PolygonMode,
    /// Which triangles are left out.
    pub cull: Cull,
    /// Which triangles face the viewer.
    pub front_face: FrontFace,
    /// How the depth target is used; `None` neither tests nor writes.
    pub depth: Option<DepthState>,
    /// How colours are combined.
    pub blend: Blend,
    /// Format of the colour target, if there is one.
    pub color_format: Option<Format>,
    /// Format of the depth target, if there is one.
    pub depth_format: Option<Format>,
    /// Samples per texel of the targets.
    pub samples: u32,
    /// Specialization constants: id and bits. Each applies to every stage that has the id.
    pub specialization: &'a [(u32, u32)],
    /// Nothing is drawn: for capture passes, which need it.
    pub rasterizer_discard: bool,
}

impl<'a> GraphicsPipelineDesc<'a> {
    /// Triangles, filled, one sample, no targets; to be completed with `..`.
    pub fn new(name: &'a str, vertex: &'a Shader) -> Self {
        Self {
            name,
            vertex,
            tessellation: None,
            fragment: None,
            topology: Topology::default(),
            polygon_mode: PolygonMode::default(),
            cull: Cull::default(),
            front_face: FrontFace::default(),
            depth: None,
            blend: Blend::default(),
            color_format: None,
            depth_format: None,
            samples: 1,
            specialization: &[],
            rasterizer_discard: false,
        }
    }

    /// All shaders with the stages they are wanted for, in the order of the pipeline.
    fn shaders(&self) -> Vec<(&'a Shader, Stage)> {
        let tessellation = self.tessellation.iter().flat_map(|one| {
            [(one.control, Stage::TessellationControl), (one.evaluation, Stage::TessellationEvaluation)]
        });
        let fragment = self.fragment.map(|shader| (shader, Stage::Fragment));
        std::iter::once((self.vertex, Stage::Vertex)).chain(tessellation).chain(fragment).collect()
    }

    /// The shader whose output transform feedback would capture.
    fn last_before_rasterizer(&self) -> &'a Shader {
        self.tessellation.map_or(self.vertex, |tessellation| tessellation.evaluation)
    }
}

/// What a draw's targets must be for a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Targets {
    pub(crate) color: Option<Format>,
    pub(crate) depth: Option<Format>,
    pub(crate) samples: u32,
    pub(crate) discard: bool,
}

/// Graphics stages, specialized and ready to draw. Clones share it.
#[derive(Clone)]
pub struct GraphicsPipeline {
    pub(crate) inner: Arc<Pipeline>,
    pub(crate) targets: Targets,
    pub(crate) blends: bool,
    capture_stride: Option<u32>,
}

impl GraphicsPipeline {
    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Bytes per vertex that a capture pass writes; `None` if the shaders declare no capture.
    pub fn capture_stride(&self) -> Option<u32> {
        self.capture_stride
    }
}

impl PartialEq for GraphicsPipeline {
    /// Whether both are the same pipeline.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.inner, &other.inner)
    }
}

impl Eq for GraphicsPipeline {}

impl std::fmt::Debug for GraphicsPipeline {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("GraphicsPipeline").field(&self.name()).finish()
    }
}

impl Device {
    /// Makes a graphics pipeline.
    pub fn graphics_pipeline(&self, desc: &GraphicsPipelineDesc<'_>) -> Result<GraphicsPipeline, GpuError> {
        self.check(desc)?;
        let shaders = desc.shaders();
        let reflections: Vec<(&str, &Reflection)> =
            shaders.iter().map(|(shader, _)| (shader.name(), shader.reflection())).collect();
        let layout = self.layout(desc.name, merge(desc.name, &reflections)?)?;
        let raw = self.create(desc, layout.raw.raw)?;
        let inner = Pipeline {
            raw,
            layout,
            bind_point: vk::PipelineBindPoint::GRAPHICS,
            name: desc.name.to_owned(),
            device: self.clone(),
        };
        Ok(GraphicsPipeline {
            inner: Arc::new(inner),
            targets: Targets {
                color: desc.color_format,
                depth: desc.depth_format,
                samples: desc.samples,
                discard: desc.rasterizer_discard,
            },
            blends: desc.blend != Blend::Replace,
            capture_stride: desc.last_before_rasterizer().reflection().capture_stride,
        })
    }

    /// Fails unless the description makes sense and the device can do it.
    fn check(&self, desc: &GraphicsPipelineDesc<'_>) -> Result<(), GpuError> {
        for (shader, stage) in desc.shaders() {
            self.check_stage(desc.name, shader, stage)?;
        }
        let refuse = |reason: String| Err(GpuError::PipelineDesc { pipeline: desc.name.to_owned(), reason });
        if desc.tessellation.is_some() != (desc.topology == Topology::Patches) {
            return refuse("tessellation stages and the patch topology go together".to_owned());
        }
        if let Some(Tessellation { patch_points, .. }) = desc.tessellation {
            let limit = self.info().limits.max_patch_vertices;
            if patch_points == 0 || patch_points > limit {
                let what = format!("points per patch of pipeline {:?}", desc.name);
                return Err(GpuError::Limit { what, value: patch_points.into(), limit: limit.into() });
            }
        }
        if desc.polygon_mode == PolygonMode::Line && !self.info().features.wireframe {
            return Err(self.missing(format!("pipeline {:?}", desc.name), "fillModeNonSolid"));
        }
        if desc.color_format.is_some_and(Format::is_depth) || desc.depth_format.is_some_and(|format| !format.is_depth())
        {
            return refuse("a depth format where a colour format belongs, or the other way round".to_owned());
        }
        if desc.depth.is_some() && desc.depth_format.is_none() {
            return refuse("it has a depth state, but no depth format".to_owned());
        }
        if !self.info().limits.sample_counts.contains(&desc.samples) {
            return refuse(format!("{} samples; the device has {:?}", desc.samples, self.info().limits.sample_counts));
        }
        Ok(())
    }

    fn create(
        &self,
        desc: &GraphicsPipelineDesc<'_>,
        layout: vk::PipelineLayout,
    ) -> Result<crate::owned::Owned<vk::Pipeline>, GpuError> {
        let data: Vec<StageData<'_>> =
            desc.shaders().iter().map(|(shader, _)| StageData::new(shader, desc.specialization)).collect();
        let specializations: Vec<_> = data.iter().map(StageData::specialization).collect();
        let stages: Vec<_> =
            data.iter().zip(&specializations).map(|(stage, constants)| stage.info(constants)).collect();

        let vertex_input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(state::topology(desc.topology));
        let patch_points = desc.tessellation.map_or(0, |tessellation| tessellation.patch_points);
        let tessellation = vk::PipelineTessellationStateCreateInfo::default().patch_control_points(patch_points);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let rasterization = state::rasterization(desc);
        let multisample = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(sample_flag(desc.samples).unwrap_or(vk::SampleCountFlags::TYPE_1));
        let depth = state::depth(desc.depth);
        let attachments: Vec<_> = desc.color_format.map(|_| state::blend(desc.blend)).into_iter().collect();
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
        let dynamic_states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic_states);
        let color_formats: Vec<_> = desc.color_format.map(Format::raw).into_iter().collect();
        let mut rendering = vk::PipelineRenderingCreateInfo::default()
            .color_attachment_formats(&color_formats)
            .depth_attachment_format(desc.depth_format.map_or(vk::Format::UNDEFINED, Format::raw));
        let mut info = vk::GraphicsPipelineCreateInfo::default()
            .stages(&stages)
            .vertex_input_state(&vertex_input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&rasterization)
            .multisample_state(&multisample)
            .depth_stencil_state(&depth)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout)
            .push_next(&mut rendering);
        if desc.tessellation.is_some() {
            info = info.tessellation_state(&tessellation);
        }
        let cache = self.shared.cache.read().unwrap_or_else(std::sync::PoisonError::into_inner);
        // SAFETY: all structures live across the call, `check` has found the description consistent and within limits, and the
        // layout was merged from the very shaders.
        let made = unsafe { self.raw().create_graphics_pipelines(cache.raw, &[info], None) };
        self.single(desc.name, made)
    }
}
