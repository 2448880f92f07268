//! Graphics pipelines.

mod state;

use std::sync::Arc;

use ash::vk;

use crate::{
    Device, Format, GpuError, Reflection, Shader, Stage,
    format::sample_flag,
    info::TESSELLATION,
    layout::{CallerSetLayout, merge},
    pipeline::{Pipeline, StageData},
};

pub use state::{Blend, Compare, Cull, DepthBias, DepthState, FrontFace, PolygonMode, Topology};

/// The tessellation stages of a pipeline; they need [`Features::tessellation`](crate::Features::tessellation).
#[derive(Clone, Copy, Debug)]
pub struct Tessellation<'a> {
    /// Tessellation control shader.
    pub control: &'a Shader,
    /// Tessellation evaluation shader.
    pub evaluation: &'a Shader,
    /// Points of an input patch.
    pub patch_points: u32,
}

/// How to make a graphics pipeline. What the vertex shader declares as inputs comes from the buffer of [`Draw::attributes`](crate::Draw::attributes); it may as
/// well read storage buffers by `gl_VertexIndex`.
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
    /// Attachments of a rendering that a caller begins, in place of `color_format` and `depth_format`. If they are what targets here can be, passes can draw with the pipeline too.
    pub attachments: Option<Attachments<'a>>,
    /// Layout of the caller's descriptor set 1. Shaders that use it come from [`Device::caller_shader`].
    pub caller_set: Option<CallerSetLayout>,
}

/// Formats of the attachments of a rendering that a caller begins: any number, in Vulkan's own terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Attachments<'a> {
    /// Colour attachments, in order; `UNDEFINED` for those that are left out.
    pub colors: &'a [vk::Format],
    /// Depth attachment; `UNDEFINED` if there is none.
    pub depth: vk::Format,
    /// Stencil attachment; `UNDEFINED` if there is none. It is neither tested nor written.
    pub stencil: vk::Format,
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
            attachments: None,
            caller_set: None,
        }
    }

    fn targets(&self) -> Targets {
        let (samples, discard) = (self.samples, self.rasterizer_discard);
        let own = Targets { color: self.color_format, depth: self.depth_format, samples, discard, of_caller: false };
        match &self.attachments {
            Some(attachments) => {
                let formats = attachments.as_targets();
                let (color, depth) = formats.unwrap_or_default();
                Targets { color, depth, of_caller: formats.is_none(), ..own }
            }
            None => own,
        }
    }

    /// Whether there is a depth attachment.
    fn has_depth(&self) -> bool {
        match self.attachments {
            Some(attachments) => attachments.depth != vk::Format::UNDEFINED,
            None => self.depth_format.is_some(),
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
    /// They are [`Attachments`] of a kind that no pass here has.
    pub(crate) of_caller: bool,
}

/// Graphics stages, specialized and ready to draw. Clones share it.
#[derive(Clone)]
pub struct GraphicsPipeline {
    pub(crate) inner: Arc<Pipeline>,
    pub(crate) targets: Targets,
    pub(crate) blends: bool,
    /// Bytes of a vertex in a draw's vertex buffer; 0 if it takes none.
    pub(crate) vertex_stride: u32,
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
        let layout = self.layout(desc.name, merge(desc.name, &reflections)?, desc.caller_set)?;
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
            targets: desc.targets(),
            blends: desc.blend != Blend::Replace,
            vertex_stride: desc.vertex.reflection().vertex_stride(),
            capture_stride: desc.last_before_rasterizer().reflection().capture_stride,
        })
    }

    /// Fails unless the description makes sense and the device can do it.
    fn check(&self, desc: &GraphicsPipelineDesc<'_>) -> Result<(), GpuError> {
        if desc.tessellation.is_some() && !self.info().features.tessellation {
            return Err(self.missing(format!("pipeline {:?}", desc.name), TESSELLATION));
        }
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
        if desc.depth.is_some() && !desc.has_depth() {
            return refuse("it has a depth state, but no depth format".to_owned());
        }
        if !self.info().limits.sample_counts.contains(&desc.samples) {
            return refuse(format!("{} samples; the device has {:?}", desc.samples, self.info().limits.sample_counts));
        }
        if desc.caller_set.is_none() && desc.shaders().iter().any(|(shader, _)| shader.reflection().uses_caller_set) {
            return refuse("a shader uses descriptor set 1, and no layout was given for it".to_owned());
        }
        if let Some(attachments) = &desc.attachments {
            attachments.check(self, desc.blend != Blend::Replace).map_or(Ok(()), refuse)?;
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

        let reflection = desc.vertex.reflection();
        let (vertex_bindings, attributes) = (state::vertex_bindings(reflection), state::attributes(reflection));
        let vertex_input = vk::PipelineVertexInputStateCreateInfo::default()
            .vertex_binding_descriptions(&vertex_bindings)
            .vertex_attribute_descriptions(&attributes);
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(state::topology(desc.topology));
        let patch_points = desc.tessellation.map_or(0, |tessellation| tessellation.patch_points);
        let tessellation = vk::PipelineTessellationStateCreateInfo::default().patch_control_points(patch_points);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let rasterization = state::rasterization(desc);
        let multisample = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(sample_flag(desc.samples).unwrap_or(vk::SampleCountFlags::TYPE_1));
        let depth = state::depth(desc.depth);
        let color_formats: Vec<_> = match &desc.attachments {
            Some(attachments) => attachments.colors.to_vec(),
            None => desc.color_format.map(Format::raw).into_iter().collect(),
        };
        let attachments = vec![state::blend(desc.blend); color_formats.len()];
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
        let dynamic_states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic_states);
        let depth_format = desc.depth_format.map_or(vk::Format::UNDEFINED, Format::raw);
        let mut rendering = vk::PipelineRenderingCreateInfo::default()
            .color_attachment_formats(&color_formats)
            .depth_attachment_format(desc.attachments.map_or(depth_format, |attachments| attachments.depth))
            .stencil_attachment_format(
                desc.attachments.map_or(vk::Format::UNDEFINED, |attachments| attachments.stencil),
            );
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

impl Attachments<'_> {
    /// The same as a colour and a depth target of a pass, if they are no more than that.
    fn as_targets(&self) -> Option<(Option<Format>, Option<Format>)> {
        let known = |format| match format {
            vk::Format::UNDEFINED => Some(None),
            format => Format::of(format).map(Some),
        };
        let color = match self.colors {
            [] => None,
            [color] => known(*color)?,
            _ => return None,
        };
        (self.stencil == vk::Format::UNDEFINED).then_some((color, known(self.depth)?))
    }

    /// What is wrong with them on a device, if anything.
    fn check(&self, device: &Device, blends: bool) -> Option<String> {
        let color = vk::FormatFeatureFlags::COLOR_ATTACHMENT;
        let color = if blends { color | vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND } else { color };
        let depth = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT;
        // Vulkan guarantees as many.
        if self.colors.len() > 4 {
            return Some(format!("{} colour attachments; at most 4 are supported", self.colors.len()));
        }
        let all = self.colors.iter().map(|&format| (format, color)).chain([(self.depth, depth), (self.stencil, depth)]);
        let wrong = |&(format, wanted): &(vk::Format, vk::FormatFeatureFlags)| {
            format != vk::Format::UNDEFINED && !device.raw_format_features(format).contains(wanted)
        };
        let (format, _) = all.into_iter().find(wrong)?;
        Some(format!("the device cannot have {format:?} as the attachment that it is wanted for"))
    }
}
