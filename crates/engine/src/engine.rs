//! A device with the pipelines made on it so far.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use osculate_gpu::{ComputePipeline, ComputePipelineDesc, Device, GraphicsPipeline, Shader};
use osculate_shaders::ShaderSet;

use crate::EngineError;
use crate::draw::PipelineKey;

/// A device, the shaders, and the pipelines made so far: each is made when a cage first needs it. Clones share them.
#[derive(Clone)]
pub struct Engine {
    inner: Arc<Inner>,
}

/// What an engine can be made with.
#[derive(Clone, Debug, Default)]
pub struct EngineDesc {
    /// The shaders: others than the embedded ones for reloading them, and for tests of changed ones.
    pub shaders: ShaderSet,
    /// Most patches of one draw; `None` takes what the driver is known to draw right.
    pub patches_per_draw: Option<u32>,
}

struct Inner {
    device: Device,
    desc: EngineDesc,
    modules: Mutex<HashMap<String, Shader>>,
    kernels: Mutex<HashMap<&'static str, ComputePipeline>>,
    pipelines: Mutex<HashMap<PipelineKey, GraphicsPipeline>>,
}

/// The value of `key`, made and kept if it is not there yet.
fn get_or_make<K: std::hash::Hash + Eq, V: Clone>(
    map: &Mutex<HashMap<K, V>>,
    key: K,
    make: impl FnOnce() -> Result<V, EngineError>,
) -> Result<V, EngineError> {
    if let Some(value) = map.lock().unwrap_or_else(PoisonError::into_inner).get(&key) {
        return Ok(value.clone());
    }
    let value = make()?;
    map.lock().unwrap_or_else(PoisonError::into_inner).insert(key, value.clone());
    Ok(value)
}

impl Engine {
    /// An engine with the embedded shaders.
    pub fn new(device: Device) -> Self {
        Self::with(device, EngineDesc::default())
    }

    /// An engine with other shaders or limits.
    pub fn with(device: Device, desc: EngineDesc) -> Self {
        let inner =
            Inner { device, desc, modules: Mutex::default(), kernels: Mutex::default(), pipelines: Mutex::default() };
        Self { inner: Arc::new(inner) }
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.inner.device
    }

    /// Most patches of one draw with so many segments along an edge.
    ///
    /// llvmpipe numbers the tessellated vertices of a draw with 16 bits and garbles the triangles beyond 65 535 without a word; a patch makes at most
    /// (segments + 2)^2 of them.
    pub(crate) fn patches_per_draw(&self, segments: u32) -> u32 {
        // Nets have at most 32 points, and a draw at most 2^32 vertices.
        let any = u32::MAX / 32;
        let known = if self.device().info().is_llvmpipe { 65_535 / ((segments + 2) * (segments + 2)) } else { any };
        self.inner.desc.patches_per_draw.unwrap_or(known).clamp(1, any)
    }

    /// The shader module of that name.
    pub(crate) fn shader(&self, name: &str) -> Result<Shader, EngineError> {
        get_or_make(&self.inner.modules, name.to_owned(), || {
            let missing = || EngineError::MissingShader { name: name.to_owned() };
            let words = self.inner.desc.shaders.get(name).ok_or_else(missing)?;
            Ok(self.inner.device.shader(name, words)?)
        })
    }

    /// The compute pipeline of that shader.
    pub(crate) fn kernel(&self, name: &'static str) -> Result<ComputePipeline, EngineError> {
        get_or_make(&self.inner.kernels, name, || {
            let shader = self.shader(name)?;
            let desc = ComputePipelineDesc { name, shader: &shader, specialization: &[] };
            Ok(self.inner.device.compute_pipeline(&desc)?)
        })
    }

    /// The graphics pipeline of that key.
    pub(crate) fn pipeline(&self, key: PipelineKey) -> Result<GraphicsPipeline, EngineError> {
        get_or_make(&self.inner.pipelines, key, || key.make(self))
    }
}
