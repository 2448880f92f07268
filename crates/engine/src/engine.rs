//! A device with the pipelines made on it so far.

use std::path::PathBuf;
use std::sync::Arc;

use osculate_gpu::Device;
use osculate_shaders::{ShaderSet, constant};

use crate::material::Materials;
use crate::pipelines::{PipelineObserver, Pipelines};

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
    /// Most patches of one draw; `None` takes what the driver draws right, and fast.
    pub patches_per_draw: Option<u32>,
    /// Most vertices that the compute evaluator makes at once; `None` takes what fits the device and a moderate buffer.
    pub grid_vertices: Option<u32>,
    /// Whether the compute evaluator gives the inside of a patch to one thread, where there is a kernel for that, rather than to a workgroup; `None` takes what
    /// suits the device. The vertices are the same.
    pub grid_lanes: Option<bool>,
    /// Folder in which the driver's memory of pipelines is kept from run to run, a file per device. What is damaged or was
    /// written by another driver is ignored, and several processes may use it at once; nothing that goes wrong with it is an
    /// error. `None` keeps nothing.
    ///
    /// Mesa's software driver has nothing to keep there; what it compiles is in a cache of its own (`MESA_SHADER_CACHE_DIR`).
    pub pipeline_cache: Option<PathBuf>,
    /// Who is told while pipelines are made.
    pub observer: Option<PipelineObserver>,
}

struct Inner {
    device: Device,
    desc: EngineDesc,
    pipelines: Pipelines,
    materials: Materials,
}

impl Drop for Inner {
    fn drop(&mut self) {
        self.pipelines.save(&self.device);
    }
}

impl Engine {
    /// An engine with the embedded shaders.
    pub fn new(device: Device) -> Self {
        Self::with(device, EngineDesc::default())
    }

    /// An engine with other shaders or limits, or with a cache of pipelines.
    pub fn with(device: Device, desc: EngineDesc) -> Self {
        let pipelines = Pipelines::new(&device, desc.pipeline_cache.clone());
        Self { inner: Arc::new(Inner { device, desc, pipelines, materials: Materials::default() }) }
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.inner.device
    }

    pub(crate) fn desc(&self) -> &EngineDesc {
        &self.inner.desc
    }

    pub(crate) fn materials(&self) -> &Materials {
        &self.inner.materials
    }

    pub(crate) fn pipelines(&self) -> &Pipelines {
        &self.inner.pipelines
    }

    /// Threads of a workgroup of the compute evaluator.
    ///
    /// llvmpipe runs a workgroup on one processor, its threads in vectors of eight. Each vector reads the patch anew, so one is best.
    pub(crate) fn grid_group(&self) -> u32 {
        if self.device().info().is_llvmpipe { 8 } else { constant::GRID_GROUP_SIZE }
    }

    /// Whether the compute evaluator gives the inside of a patch to one thread rather than to a workgroup, where there is a kernel for that.
    ///
    /// On llvmpipe threads are lanes of a vector, and nothing is gained by sharing control points among them.
    pub(crate) fn grid_lanes(&self) -> bool {
        self.desc().grid_lanes.unwrap_or(self.device().info().is_llvmpipe)
    }

    /// Most patches of one draw of `patches` in all, with so many segments along an edge.
    pub(crate) fn patches_per_draw(&self, segments: u32, patches: u32) -> u32 {
        // Nets have at most 32 points, and a draw at most 2^32 vertices.
        let any = u32::MAX / 32;
        let known = if self.device().info().is_llvmpipe { llvmpipe_patches(segments, patches) } else { any };
        self.desc().patches_per_draw.unwrap_or(known).clamp(1, any)
    }
}

/// Patches of a draw on llvmpipe, of `patches` in all, with so many segments along an edge.
///
/// It numbers the tessellated vertices of a draw with 16 bits and garbles the triangles beyond 65 535 without a word; a patch makes at most (segments + 2)^2 of
/// them. It also keeps whatever its stages make of a draw in memory until the next stage has read it: draws of some thousand vertices stay in the cache. Of fewer
/// than 16 patches a draw's own price shows, and with more than some thousand draws their commands do.
fn llvmpipe_patches(segments: u32, patches: u32) -> u32 {
    let vertices = (segments + 2) * (segments + 2);
    (2_048 / vertices).max(16).max(patches / 4_096).min(65_535 / vertices)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_on_llvmpipe_are_short_but_neither_too_many_nor_garbled() {
        assert_eq!(llvmpipe_patches(4, 200), 56);
        assert_eq!(llvmpipe_patches(16, 200), 16);
        assert_eq!(llvmpipe_patches(4, 4_000_000), 976);
        for segments in 1..=64 {
            for patches in [1, 10_000, 40_000_000] {
                assert!((1..=65_535).contains(&(llvmpipe_patches(segments, patches) * (segments + 2).pow(2))));
            }
        }
    }
}
