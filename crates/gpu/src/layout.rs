//! Pipeline layouts: the union of what the stages of a pipeline declare.

use std::sync::Arc;

use ash::vk;

use crate::{Device, GpuError, Limits, Reflection, ResourceKind, Stage, owned::Owned};

/// A buffer or image that some stages of a pipeline use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LayoutBinding {
    pub(crate) binding: u32,
    pub(crate) kind: ResourceKind,
    pub(crate) stages: vk::ShaderStageFlags,
    /// Pipeline stages that may read it.
    pub(crate) reads: vk::PipelineStageFlags2,
    /// Pipeline stages that may write it.
    pub(crate) writes: vk::PipelineStageFlags2,
    /// The first shader that declares it, and its name there; for messages.
    pub(crate) shader: String,
    pub(crate) name: String,
}

/// Kinds of resources whose numbers are limited, in the order of [`Limits::pipeline`] and [`Limits::stage`].
const KINDS: [&str; 4] = ["storage buffers", "uniform buffers", "sampled images", "storage images"];

/// What a pipeline binds, ascending by binding, and the bytes of its push constants.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Interface {
    pub(crate) bindings: Vec<LayoutBinding>,
    pub(crate) push_size: u32,
    pub(crate) push_stages: vk::ShaderStageFlags,
}

impl Interface {
    /// Fails if the pipeline takes more of anything than a device with these limits has.
    fn check(&self, pipeline: &str, limits: &Limits) -> Result<(), GpuError> {
        match self.demands(limits).into_iter().find(|(_, value, limit)| *value > u64::from(*limit)) {
            None => Ok(()),
            Some((what, value, limit)) => {
                Err(GpuError::Limit { what: format!("{what} of pipeline {pipeline:?}"), value, limit: limit.into() })
            }
        }
    }

    /// All that is limited: what it is, how much of it the pipeline takes, and the limit. Chapter "Limits" of the Vulkan
    /// specification; descriptor sets are one here, so that its limits are the pipeline's.
    fn demands(&self, limits: &Limits) -> Vec<(String, u64, u32)> {
        let all = self.counts(vk::ShaderStageFlags::ALL);
        let mut demands = vec![
            ("bytes of push constants".to_owned(), u64::from(self.push_size), limits.max_push_constants),
            ("buffers and images".to_owned(), all.iter().sum(), limits.max_push_descriptors),
        ];
        demands.extend(
            KINDS.into_iter().zip(all).zip(limits.pipeline()).map(|((kind, n), limit)| (kind.to_owned(), n, limit)),
        );
        for stage in Stage::ALL {
            let counts = self.counts(stage_flags(stage).0);
            let one_kind = |((kind, n), limit)| (format!("{kind} in the {stage} stage"), n, limit);
            demands.extend(KINDS.into_iter().zip(counts).zip(limits.stage()).map(one_kind));
            // Whether there is a colour target is not known here; one resource less harms nobody.
            let resources = counts.iter().sum::<u64>() + u64::from(stage == Stage::Fragment);
            demands.push((format!("resources in the {stage} stage"), resources, limits.max_stage_resources));
        }
        demands
    }

    /// How many resources of each of [`KINDS`] these stages use.
    fn counts(&self, stages: vk::ShaderStageFlags) -> [u64; 4] {
        let position = |kind| match kind {
            ResourceKind::StorageBuffer => 0,
            ResourceKind::UniformBuffer => 1,
            // Vulkan counts these among the sampled images.
            ResourceKind::Texture(_) | ResourceKind::TexelBuffer(_) => 2,
            ResourceKind::StorageImage(_) => 3,
        };
        let mut counts = [0; 4];
        let used = self.bindings.iter().filter(|one| one.stages.intersects(stages));
        used.for_each(|one| counts[position(one.kind)] += 1);
        counts
    }
}

/// Merges what the stages of a pipeline declare.
pub(crate) fn merge(pipeline: &str, shaders: &[(&str, &Reflection)]) -> Result<Interface, GpuError> {
    let mut interface = Interface::default();
    for (shader, reflection) in shaders {
        let (flag, stage) = stage_flags(reflection.stage);
        if reflection.push_constant_size > 0 {
            interface.push_size = interface.push_size.max(reflection.push_constant_size);
            interface.push_stages |= flag;
        }
        for resource in &reflection.resources {
            let reads = if resource.reads { stage } else { vk::PipelineStageFlags2::NONE };
            let writes = if resource.writes { stage } else { vk::PipelineStageFlags2::NONE };
            match interface.bindings.iter_mut().find(|known| known.binding == resource.binding) {
                Some(known) if known.kind == resource.kind => {
                    known.stages |= flag;
                    known.reads |= reads;
                    known.writes |= writes;
                }
                Some(known) => {
                    return Err(GpuError::BindingConflict {
                        pipeline: pipeline.to_owned(),
                        binding: resource.binding,
                        first: known.shader.clone(),
                        first_kind: known.kind,
                        second: (*shader).to_owned(),
                        second_kind: resource.kind,
                    });
                }
                None => interface.bindings.push(LayoutBinding {
                    binding: resource.binding,
                    kind: resource.kind,
                    stages: flag,
                    reads,
                    writes,
                    shader: (*shader).to_owned(),
                    name: resource.name.clone(),
                }),
            }
        }
    }
    interface.bindings.sort_by_key(|binding| binding.binding);
    Ok(interface)
}

/// Vulkan's two flags for a stage: as part of a pipeline, and as a point in the GPU's work.
pub(crate) fn stage_flags(stage: Stage) -> (vk::ShaderStageFlags, vk::PipelineStageFlags2) {
    match stage {
        Stage::Vertex => (vk::ShaderStageFlags::VERTEX, vk::PipelineStageFlags2::VERTEX_SHADER),
        Stage::TessellationControl => {
            (vk::ShaderStageFlags::TESSELLATION_CONTROL, vk::PipelineStageFlags2::TESSELLATION_CONTROL_SHADER)
        }
        Stage::TessellationEvaluation => {
            (vk::ShaderStageFlags::TESSELLATION_EVALUATION, vk::PipelineStageFlags2::TESSELLATION_EVALUATION_SHADER)
        }
        Stage::Fragment => (vk::ShaderStageFlags::FRAGMENT, vk::PipelineStageFlags2::FRAGMENT_SHADER),
        Stage::Compute => (vk::ShaderStageFlags::COMPUTE, vk::PipelineStageFlags2::COMPUTE_SHADER),
    }
}

/// The layout of a descriptor set of the caller's, which is set 1 of a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CallerSetLayout(vk::DescriptorSetLayout);

impl CallerSetLayout {
    /// Takes note of a layout; it stays the caller's.
    ///
    /// # Safety
    /// The layout is of the device that pipelines are made on with it, is not one of push descriptors, and lives as long as they do. Shaders that use set
    /// 1 agree with it, and pipelines stay within the device's limits with what it holds.
    pub unsafe fn new(layout: vk::DescriptorSetLayout) -> Self {
        Self(layout)
    }
}

/// A pipeline layout with the layout of its one set of pushed descriptors. Field order is destruction order.
pub(crate) struct Layout {
    pub(crate) raw: Owned<vk::PipelineLayout>,
    _set: Owned<vk::DescriptorSetLayout>,
    pub(crate) interface: Interface,
    /// Descriptor set 1 is the caller's.
    pub(crate) has_caller_set: bool,
}

impl Device {
    pub(crate) fn layout(
        &self,
        name: &str,
        interface: Interface,
        caller_set: Option<CallerSetLayout>,
    ) -> Result<Arc<Layout>, GpuError> {
        interface.check(name, &self.info().limits)?;
        let set = self.set_layout(name, &interface)?;
        let sets: Vec<_> = std::iter::once(set.raw).chain(caller_set.map(|layout| layout.0)).collect();
        let push = [vk::PushConstantRange::default().stage_flags(interface.push_stages).size(interface.push_size)];
        let mut info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
        if interface.push_size > 0 {
            info = info.push_constant_ranges(&push);
        }
        // SAFETY: the set layout is alive, and so is the caller's, by the promise of `CallerSetLayout::new`; push constants and resources of every stage are within the limits.
        let raw = unsafe { self.raw().create_pipeline_layout(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating the layout of {name:?}"), result))?;
        let has_caller_set = caller_set.is_some();
        Ok(Arc::new(Layout { raw: Owned::new(&self.shared.raw, raw, name), _set: set, interface, has_caller_set }))
    }

    fn set_layout(&self, name: &str, interface: &Interface) -> Result<Owned<vk::DescriptorSetLayout>, GpuError> {
        let bindings: Vec<_> = interface.bindings.iter().map(set_binding).collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default()
            .flags(vk::DescriptorSetLayoutCreateFlags::PUSH_DESCRIPTOR_KHR)
            .bindings(&bindings);
        // SAFETY: binding numbers are distinct, and their count is within the limits of a set, a stage and push descriptors.
        let raw = unsafe { self.raw().create_descriptor_set_layout(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating the bindings of {name:?}"), result))?;
        Ok(Owned::new(&self.shared.raw, raw, name))
    }
}

fn set_binding(binding: &LayoutBinding) -> vk::DescriptorSetLayoutBinding<'static> {
    vk::DescriptorSetLayoutBinding::default()
        .binding(binding.binding)
        .descriptor_type(descriptor_type(binding.kind))
        .descriptor_count(1)
        .stage_flags(binding.stages)
}

pub(crate) fn descriptor_type(kind: ResourceKind) -> vk::DescriptorType {
    match kind {
        ResourceKind::StorageBuffer => vk::DescriptorType::STORAGE_BUFFER,
        ResourceKind::UniformBuffer => vk::DescriptorType::UNIFORM_BUFFER,
        ResourceKind::Texture(_) => vk::DescriptorType::COMBINED_IMAGE_SAMPLER,
        ResourceKind::StorageImage(_) => vk::DescriptorType::STORAGE_IMAGE,
        ResourceKind::TexelBuffer(_) => vk::DescriptorType::UNIFORM_TEXEL_BUFFER,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Numbers, ResourceBinding};

    fn shader(stage: Stage, push_constant_size: u32, resources: &[(u32, ResourceKind, bool, bool)]) -> Reflection {
        let resource = |&(binding, kind, reads, writes)| ResourceBinding {
            binding,
            kind,
            reads,
            writes,
            name: format!("b{binding}"),
        };
        Reflection {
            stage,
            entry_point: "main".to_owned(),
            resources: resources.iter().map(resource).collect(),
            inputs: Vec::new(),
            push_constant_size,
            specialization: Vec::new(),
            local_size: None,
            output_vertices: None,
            capture_stride: None,
            uses_caller_set: false,
        }
    }

    #[test]
    fn bindings_of_all_stages_are_united() {
        let vertex = shader(Stage::Vertex, 16, &[(3, ResourceKind::StorageBuffer, true, false)]);
        let fragment = shader(
            Stage::Fragment,
            32,
            &[(0, ResourceKind::UniformBuffer, true, false), (3, ResourceKind::StorageBuffer, true, true)],
        );
        let interface = merge("p", &[("v", &vertex), ("f", &fragment)]).unwrap();
        assert_eq!(interface.bindings.iter().map(|one| one.binding).collect::<Vec<_>>(), [0, 3]);
        let shared = &interface.bindings[1];
        assert_eq!(shared.stages, vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT);
        assert_eq!(shared.reads, vk::PipelineStageFlags2::VERTEX_SHADER | vk::PipelineStageFlags2::FRAGMENT_SHADER);
        assert_eq!(shared.writes, vk::PipelineStageFlags2::FRAGMENT_SHADER);
        assert_eq!((interface.push_size, interface.push_stages), (32, shared.stages));
    }

    #[test]
    fn stages_without_push_constants_are_left_out_of_the_range() {
        let vertex = shader(Stage::Vertex, 0, &[]);
        let fragment = shader(Stage::Fragment, 4, &[]);
        let interface = merge("p", &[("v", &vertex), ("f", &fragment)]).unwrap();
        assert_eq!(interface.push_stages, vk::ShaderStageFlags::FRAGMENT);
    }

    #[test]
    fn a_binding_of_two_kinds_is_refused_with_both_shaders() {
        let vertex = shader(Stage::Vertex, 0, &[(1, ResourceKind::StorageBuffer, true, false)]);
        let fragment = shader(Stage::Fragment, 0, &[(1, ResourceKind::UniformBuffer, true, false)]);
        let error = merge("p", &[("v", &vertex), ("f", &fragment)]).unwrap_err().to_string();
        assert!(error.contains("\"v\"") && error.contains("\"f\"") && error.contains("binding 1"), "{error}");
    }

    /// Limits that nothing here exceeds.
    fn roomy() -> Limits {
        Limits {
            max_push_constants: 128,
            max_push_descriptors: 32,
            max_pipeline_storage_buffers: 32,
            max_pipeline_uniform_buffers: 32,
            max_pipeline_sampled_images: 32,
            max_pipeline_storage_images: 32,
            max_stage_storage_buffers: 32,
            max_stage_uniform_buffers: 32,
            max_stage_sampled_images: 32,
            max_stage_storage_images: 32,
            max_stage_resources: 32,
            ..Limits::default()
        }
    }

    /// The vertex stage has 3 storage buffers and 1 uniform buffer, the fragment stage 2 and 2, of which they share one each, and
    /// 2 textures and 1 storage image: with the colour target 8 resources in the fragment stage.
    #[test]
    fn every_limit_counts_and_is_named() {
        use ResourceKind::{StorageBuffer as Storage, UniformBuffer as Uniform};
        let (texture, image) =
            (ResourceKind::Texture(Numbers::Float), ResourceKind::StorageImage(crate::Format::R32Float));
        let read = |(binding, kind)| (binding, kind, true, false);
        let vertex = shader(Stage::Vertex, 8, &[(0, Storage), (1, Storage), (2, Storage), (3, Uniform)].map(read));
        let fragment = [(0, Storage), (4, Storage), (3, Uniform), (5, Uniform), (6, texture), (7, texture), (8, image)];
        let fragment = shader(Stage::Fragment, 16, &fragment.map(read));
        let interface = merge("p", &[("v", &vertex), ("f", &fragment)]).unwrap();
        type Field = fn(&mut Limits) -> &mut u32;
        let cases: [(&str, u32, Field); 11] = [
            ("bytes of push constants of pipeline \"p\"", 16, |limits| &mut limits.max_push_constants),
            ("buffers and images of pipeline \"p\"", 9, |limits| &mut limits.max_push_descriptors),
            ("storage buffers of pipeline \"p\"", 4, |limits| &mut limits.max_pipeline_storage_buffers),
            ("uniform buffers of pipeline \"p\"", 2, |limits| &mut limits.max_pipeline_uniform_buffers),
            ("storage buffers in the vertex stage of pipeline \"p\"", 3, |limits| {
                &mut limits.max_stage_storage_buffers
            }),
            ("uniform buffers in the fragment stage of pipeline \"p\"", 2, |limits| {
                &mut limits.max_stage_uniform_buffers
            }),
            ("sampled images of pipeline \"p\"", 2, |limits| &mut limits.max_pipeline_sampled_images),
            ("storage images of pipeline \"p\"", 1, |limits| &mut limits.max_pipeline_storage_images),
            ("sampled images in the fragment stage of pipeline \"p\"", 2, |limits| {
                &mut limits.max_stage_sampled_images
            }),
            ("storage images in the fragment stage of pipeline \"p\"", 1, |limits| {
                &mut limits.max_stage_storage_images
            }),
            ("resources in the fragment stage of pipeline \"p\"", 8, |limits| &mut limits.max_stage_resources),
        ];
        for (expected, used, field) in cases {
            let mut limits = roomy();
            *field(&mut limits) = used;
            interface.check("p", &limits).unwrap();
            *field(&mut limits) = used - 1;
            match interface.check("p", &limits).unwrap_err() {
                GpuError::Limit { what, value, limit } => {
                    assert_eq!((what.as_str(), value, limit), (expected, used.into(), u64::from(used) - 1));
                }
                error => panic!("{error}"),
            }
        }
    }
}
