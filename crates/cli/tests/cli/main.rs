//! The command from outside: what it prints, writes and exits with.

mod animation;
mod bench;
mod check;
mod claims;
mod command_line;
mod compare;
mod device;
mod export;
mod gltf;
mod inspect;
mod maps;
mod parts;
mod render;
mod repair;
mod sample;
mod support;
#[cfg(feature = "viewer")]
mod view;
mod whole;
