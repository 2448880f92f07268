//! Shader modules.

use std::sync::Arc;

use ash::vk;

use crate::{
    Device, GpuError, ReflectError, Reflection, Stage,
    info::{TESSELLATION, TRANSFORM_FEEDBACK},
    owned::Owned,
    reflect,
    reflect::reflect_of_caller,
};

/// A compiled shader with one entry point. Clones share it.
#[derive(Clone)]
pub struct Shader {
    inner: Arc<Inner>,
}

struct Inner {
    raw: Owned<vk::ShaderModule>,
    name: String,
    reflection: Reflection,
    device: Device,
}

impl Device {
    /// Makes a shader from SPIR-V.
    ///
    /// The module must be valid SPIR-V, as a compiler makes it: it is reflected, but not validated, and drivers trust it as they
    /// trust their own code. Do not pass modules from untrusted sources.
    ///
    /// Fails if the module needs what is never switched on: only compute shaders write buffers, and SPIR-V's capabilities beyond
    /// `Shader`, `DerivativeControl`, `Tessellation` and `TransformFeedback` (64-bit numbers, `gl_PrimitiveID` in
    /// fragment shaders, clip distances, subgroups and so on) are refused.
    pub fn shader(&self, name: &str, spirv: &[u32]) -> Result<Shader, GpuError> {
        self.reflected_shader(name, spirv, reflect(spirv))
    }

    /// Makes a shader that may need any capability of SPIR-V, and have a descriptor set 1: for pipelines with
    /// [`GraphicsPipelineDesc::caller_set`](crate::GraphicsPipelineDesc::caller_set).
    ///
    /// # Safety
    /// The device was created with the features and extensions that the module needs; `DeviceDesc` switches on none but those of
    /// [`Features`](crate::Features). Invalid accesses of what set 1 holds are the author's business.
    pub unsafe fn caller_shader(&self, name: &str, spirv: &[u32]) -> Result<Shader, GpuError> {
        self.reflected_shader(name, spirv, reflect_of_caller(spirv))
    }

    fn reflected_shader(
        &self,
        name: &str,
        spirv: &[u32],
        reflection: Result<Reflection, ReflectError>,
    ) -> Result<Shader, GpuError> {
        let reflection = reflection.map_err(|source| GpuError::Shader { shader: name.to_owned(), source })?;
        self.check_features(name, &reflection)?;
        let info = vk::ShaderModuleCreateInfo::default().code(spirv);
        // SAFETY: the code is a whole number of words and was parsed; its validity is documented as the caller's part.
        let raw = unsafe { self.raw().create_shader_module(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating shader {name:?}"), result))?;
        let raw = Owned::new(&self.shared.raw, raw, name);
        Ok(Shader { inner: Arc::new(Inner { raw, name: name.to_owned(), reflection, device: self.clone() }) })
    }

    /// Fails unless the device has the shader's stage, and can capture what it declares for capture, if anything.
    fn check_features(&self, name: &str, reflection: &Reflection) -> Result<(), GpuError> {
        let tessellates = matches!(reflection.stage, Stage::TessellationControl | Stage::TessellationEvaluation);
        if tessellates && !self.info().features.tessellation {
            return Err(self.missing(format!("shader {name:?}"), TESSELLATION));
        }
        let Some(stride) = reflection.capture_stride else { return Ok(()) };
        if !self.info().features.transform_feedback {
            return Err(self.missing(format!("shader {name:?}"), TRANSFORM_FEEDBACK));
        }
        let limit = self.info().limits.max_capture_stride;
        if stride > limit {
            let what = format!("bytes per vertex that shader {name:?} captures");
            return Err(GpuError::Limit { what, value: stride.into(), limit: limit.into() });
        }
        Ok(())
    }
}

impl Shader {
    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// The stage it is for.
    pub fn stage(&self) -> Stage {
        self.inner.reflection.stage
    }

    /// What it declares.
    pub fn reflection(&self) -> &Reflection {
        &self.inner.reflection
    }

    pub(crate) fn raw(&self) -> vk::ShaderModule {
        self.inner.raw.raw
    }

    pub(crate) fn device(&self) -> &Device {
        &self.inner.device
    }
}

impl std::fmt::Debug for Shader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Shader").field("name", &self.name()).field("stage", &self.stage()).finish()
    }
}
