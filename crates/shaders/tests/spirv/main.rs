//! What the compiled shaders must satisfy: exact arithmetic, and structs laid out as the host lays them out.

mod layout;
mod module;
mod precise;
