//! The SPIR-V of the shaders folder, and the structs and bindings shared with it.
