//! Vulkan for osculate: device, memory, pipelines, passes with derived barriers. The only crate with unsafe code.
