//! Shader modules.

use std::sync::Arc;

use ash::vk;

use crate::{Device, GpuError, Reflection, Stage, info::TRANSFORM_FEEDBACK, owned::Owned, reflect};

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
        let reflection = reflect(spirv).map_err(|source| GpuError::Shader { shader: name.to_owned(), source })?;
        self.check_capture(name, &reflection)?;
        let info = vk::ShaderModuleCreateInfo::default().code(spirv);
        // SAFETY: the code is a whole number of words and was parsed; its validity is documented as the caller's part.
        let raw = unsafe { self.raw().create_shader_module(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating shader {name:?}"), result))?;
        let raw = Owned::new(&self.shared.raw, raw, name);
        Ok(Shader { inner: Arc::new(Inner { raw, name: name.to_owned(), reflection, device: self.clone() }) })
    }

    /// Fails unless the device can capture what the shader declares for capture, if anything.
    fn check_capture(&self, name: &str, reflection: &Reflection) -> Result<(), GpuError> {
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
