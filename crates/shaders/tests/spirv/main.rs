//! What the compiled shaders must satisfy: exact arithmetic, structs laid out as on the host, and sources that reproduce them.

mod layout;
mod module;
mod precise;
mod sources;
