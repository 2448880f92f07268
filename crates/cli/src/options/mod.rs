//! Values of options, each parsed into something that cannot be wrong.

mod animation;
mod camera;
mod colour;
mod cull;
mod level;
mod maps;
mod numbered;
mod output;
mod parts;
mod read;
mod refine;
mod scheme;
mod size;
mod tessellation;

pub(crate) use animation::{AnimationArgs, Film, Moment, Motion};
pub(crate) use camera::CameraArgs;
pub(crate) use colour::Colour;
pub(crate) use cull::CullArg;
pub(crate) use level::{Level, Pixels};
pub(crate) use maps::{DisplaceArgs, Maps, uv_origin};
pub(crate) use numbered::NumberedPath;
pub(crate) use output::{Output, check_apart, check_place};
pub(crate) use parts::PartsArgs;
pub(crate) use read::ReadArgs;
pub(crate) use refine::RefineArg;
pub(crate) use scheme::{SchemeChoice, SchemeName};
pub(crate) use size::Size;
pub(crate) use tessellation::{DrawEvaluator, SpacingArg, TessellationArgs};
