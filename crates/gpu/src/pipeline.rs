//! Compute pipelines, and what they share with graphics pipelines.

use std::{ffi::CString, sync::Arc};

use ash::vk;

use crate::{
    Device, GpuError, Shader, Stage,
    layout::{Interface, Layout, merge, stage_flags},
    owned::Owned,
};

/// A pipeline of either kind. Field order is destruction order.
pub(crate) struct Pipeline {
    pub(crate) raw: Owned<vk::Pipeline>,
    pub(crate) layout: Arc<Layout>,
    pub(crate) bind_point: vk::PipelineBindPoint,
    pub(crate) name: String,
    pub(crate) device: Device,
}

impl Pipeline {
    pub(crate) fn interface(&self) -> &Interface {
        &self.layout.interface
    }
}

/// How to make a compute pipeline.
#[derive(Clone, Copy, Debug)]
pub struct ComputePipelineDesc<'a> {
    /// Name for tools and messages.
    pub name: &'a str,
    /// The compute shader.
    pub shader: &'a Shader,
    /// Specialization constants: id and bits. Ids that the shader does not have are ignored.
    pub specialization: &'a [(u32, u32)],
}

/// A compute shader, specialized and ready to run. Clones share it.
#[derive(Clone)]
pub struct ComputePipeline {
    pub(crate) inner: Arc<Pipeline>,
    local_size: [u32; 3],
}

impl ComputePipeline {
    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Size of the work group.
    pub fn local_size(&self) -> [u32; 3] {
        self.local_size
    }

    /// Work groups for at least `invocations` invocations in one dimension; empty for none.
    pub fn groups_for(&self, invocations: u32) -> [u32; 3] {
        [invocations.div_ceil(self.local_size[0].max(1)), 1, 1]
    }
}

impl PartialEq for ComputePipeline {
    /// Whether both are the same pipeline.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.inner, &other.inner)
    }
}

impl Eq for ComputePipeline {}

impl std::fmt::Debug for ComputePipeline {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("ComputePipeline").field(&self.name()).finish()
    }
}

impl Device {
    /// Makes a compute pipeline.
    pub fn compute_pipeline(&self, desc: &ComputePipelineDesc<'_>) -> Result<ComputePipeline, GpuError> {
        self.check_stage(desc.name, desc.shader, Stage::Compute)?;
        let local_size = self.local_size(desc)?;
        let layout =
            self.layout(desc.name, merge(desc.name, &[(desc.shader.name(), desc.shader.reflection())])?, None)?;
        let stage = StageData::new(desc.shader, desc.specialization);
        let specialization = stage.specialization();
        let info = vk::ComputePipelineCreateInfo::default().stage(stage.info(&specialization)).layout(layout.raw.raw);
        let cache = self.shared.cache.read().unwrap_or_else(std::sync::PoisonError::into_inner);
        // SAFETY: module, entry point, specialization and layout fit together, being made from one reflection, and live across
        // the call.
        let made = unsafe { self.raw().create_compute_pipelines(cache.raw, &[info], None) };
        let raw = self.single(desc.name, made)?;
        let bind_point = vk::PipelineBindPoint::COMPUTE;
        let inner = Pipeline { raw, layout, bind_point, name: desc.name.to_owned(), device: self.clone() };
        Ok(ComputePipeline { inner: Arc::new(inner), local_size })
    }

    /// Work group size under the specialization, checked against the device.
    fn local_size(&self, desc: &ComputePipelineDesc<'_>) -> Result<[u32; 3], GpuError> {
        let declared = desc.shader.reflection().local_size.unwrap_or([crate::Extent::Fixed(1); 3]);
        let size = declared.map(|extent| extent.resolve(desc.specialization));
        let invocations = size.iter().fold(1u64, |product, &n| product.saturating_mul(n.into()));
        let limit = u64::from(self.info().limits.max_work_group_invocations);
        if invocations == 0 || invocations > limit {
            let what = format!("work group size of pipeline {:?}", desc.name);
            return Err(GpuError::Limit { what, value: invocations, limit });
        }
        Ok(size)
    }

    /// The one pipeline that a call has made, wrapped, or why it has not.
    pub(crate) fn single(
        &self,
        name: &str,
        made: Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>,
    ) -> Result<Owned<vk::Pipeline>, GpuError> {
        let operation = || format!("creating pipeline {name:?}");
        let raw = made.map_err(|(_, result)| GpuError::from_vulkan(operation(), result))?;
        let raw = raw.first().ok_or_else(|| GpuError::from_vulkan(operation(), vk::Result::ERROR_UNKNOWN))?;
        Ok(Owned::new(&self.shared.raw, *raw, name))
    }

    /// Fails unless the shader is for this stage and of this device.
    pub(crate) fn check_stage(&self, pipeline: &str, shader: &Shader, wanted: Stage) -> Result<(), GpuError> {
        let pipeline = pipeline.to_owned();
        if !shader.device().is(self) {
            let reason = format!("shader {:?} belongs to another device", shader.name());
            return Err(GpuError::PipelineDesc { pipeline, reason });
        }
        if shader.stage() != wanted {
            let (shader, found) = (shader.name().to_owned(), shader.stage());
            return Err(GpuError::WrongStage { pipeline, shader, wanted, found });
        }
        Ok(())
    }
}

/// What a stage's creation structure points to.
pub(crate) struct StageData<'a> {
    shader: &'a Shader,
    entry_point: CString,
    entries: Vec<vk::SpecializationMapEntry>,
    data: Vec<u8>,
}

impl<'a> StageData<'a> {
    /// Picks those constants of `specialization` that the shader has.
    pub(crate) fn new(shader: &'a Shader, specialization: &[(u32, u32)]) -> Self {
        let (mut entries, mut data) = (Vec::new(), Vec::new());
        for constant in &shader.reflection().specialization {
            if let Some((id, bits)) = specialization.iter().find(|(id, _)| *id == constant.id) {
                let offset = u32::try_from(data.len()).unwrap_or(u32::MAX);
                entries.push(vk::SpecializationMapEntry { constant_id: *id, offset, size: 4 });
                data.extend_from_slice(&bits.to_ne_bytes());
            }
        }
        // A SPIR-V string ends at its first NUL, so there is none inside.
        let entry_point = CString::new(shader.reflection().entry_point.as_str()).unwrap_or_default();
        Self { shader, entry_point, entries, data }
    }

    pub(crate) fn specialization(&self) -> vk::SpecializationInfo<'_> {
        vk::SpecializationInfo::default().map_entries(&self.entries).data(&self.data)
    }

    pub(crate) fn info<'b>(
        &'b self,
        specialization: &'b vk::SpecializationInfo<'_>,
    ) -> vk::PipelineShaderStageCreateInfo<'b> {
        vk::PipelineShaderStageCreateInfo::default()
            .stage(stage_flags(self.shader.stage()).0)
            .module(self.shader.raw())
            .name(&self.entry_point)
            .specialization_info(specialization)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DeviceDesc;
    use osculate_shader_compiler::{CompileDesc, compile};

    /// What validation calls an object is the name that tools show. It lists those that outlive their device, which only the
    /// disregard for `Owned` here makes happen.
    #[test]
    fn validation_knows_pipelines_by_name() {
        let select = std::env::var("OSCULATE_DEVICE").ok();
        let device = Device::new(&DeviceDesc { select, validation: true, ..DeviceDesc::default() }).unwrap();
        let log = device.message_log();
        let spirv = compile(&CompileDesc::new("empty.comp", "#version 460\nvoid main() {}")).unwrap();
        let shader = device.shader("empty.comp", &spirv).unwrap();
        let make = |name| {
            device.compute_pipeline(&ComputePipelineDesc { name, shader: &shader, specialization: &[] }).unwrap()
        };
        let (kept, mut forgotten) = (make("the pipeline kept"), make("the pipeline forgotten"));
        Arc::get_mut(&mut forgotten.inner).unwrap().raw.raw = vk::Pipeline::null();
        drop((kept, forgotten, shader, device));
        let messages = log.all();
        assert!(
            !messages.is_empty() && messages.iter().all(|one| one.contains("the pipeline forgotten")),
            "{messages:?}"
        );
    }
}
