//! Recording compute kernels: one thread per element, folded into two dimensions.

use bytemuck::bytes_of;
use osculate_gpu::{Bindings, ComputePass, Recording};
use osculate_shaders::constant::{GROUP_SIZE, GROUPS_X};
use osculate_shaders::layout::KernelPush;

use crate::{Engine, EngineError};

/// One kernel over `threads` threads.
pub(crate) struct Kernel<'a> {
    /// Name of the shader.
    pub(crate) shader: &'static str,
    pub(crate) bindings: &'a Bindings,
    pub(crate) push: KernelPush,
    pub(crate) threads: u32,
}

impl Kernel<'_> {
    /// Adds the dispatch; nothing if there are no threads.
    pub(crate) fn record(self, engine: &Engine, recording: &mut Recording) -> Result<(), EngineError> {
        if self.threads == 0 {
            return Ok(());
        }
        recording.compute(ComputePass {
            name: self.shader.to_owned(),
            pipeline: engine.kernel(self.shader)?,
            bindings: self.bindings.clone(),
            push: bytes_of(&self.push).to_vec(),
            groups: groups(self.threads),
        });
        Ok(())
    }
}

/// Workgroups for so many threads, at most `GROUPS_X` along x (`thread_index` in shaders/include/thread.glsl).
pub(crate) fn groups(threads: u32) -> [u32; 3] {
    fold(threads.div_ceil(GROUP_SIZE))
}

/// So many workgroups, at most `GROUPS_X` of them along x.
pub(crate) fn fold(groups: u32) -> [u32; 3] {
    [groups.min(GROUPS_X), groups.div_ceil(GROUPS_X), 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_cover_all_threads() {
        for threads in [1, 63, 64, 65, GROUP_SIZE * GROUPS_X, GROUP_SIZE * GROUPS_X + 1, 100_000_000] {
            let [x, y, z] = groups(threads);
            assert!(x <= GROUPS_X && y <= 65_535 && z == 1);
            assert!(u64::from(x) * u64::from(y) * u64::from(GROUP_SIZE) >= u64::from(threads), "{threads}");
        }
    }
}
