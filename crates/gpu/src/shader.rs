//! Shader modules.

use std::sync::Arc;

use ash::vk;

use crate::{Device, GpuError, Reflection, Stage, owned::Owned, reflect};

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
    pub fn shader(&self, name: &str, spirv: &[u32]) -> Result<Shader, GpuError> {
        let reflection = reflect(spirv).map_err(|source| GpuError::Shader { shader: name.to_owned(), source })?;
        self.check_features(name, &reflection)?;
        let info = vk::ShaderModuleCreateInfo::default().code(spirv);
        // SAFETY: the code is a whole number of words and was parsed; its validity is documented as the caller's part.
        let raw = unsafe { self.raw().create_shader_module(&info, None) }
            .map_err(|result| GpuError::from_vulkan(format!("creating shader {name:?}"), result))?;
        let raw = Owned::new(&self.shared.raw, raw, name);
        Ok(Shader { inner: Arc::new(Inner { raw, name: name.to_owned(), reflection, device: self.clone() }) })
    }

    /// Whether the device has the optional features that the shader's declarations need.
    fn check_features(&self, name: &str, reflection: &Reflection) -> Result<(), GpuError> {
        let has = self.info().features;
        let writes = reflection.buffers.iter().any(|buffer| buffer.writes);
        let what = || format!("shader {name:?}");
        match reflection.stage {
            Stage::Compute => {}
            Stage::Fragment if writes && !has.fragment_stores => {
                return Err(self.missing(what(), "fragmentStoresAndAtomics"));
            }
            Stage::Fragment => {}
            _ if writes && !has.vertex_stores => return Err(self.missing(what(), "vertexPipelineStoresAndAtomics")),
            _ => {}
        }
        if reflection.capture_stride.is_some() && !has.transform_feedback {
            return Err(self.missing(what(), "VK_EXT_transform_feedback"));
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
