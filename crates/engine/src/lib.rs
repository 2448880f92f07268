//! Smooth subdivision surfaces through hull and domain stages of Vulkan: the library.
