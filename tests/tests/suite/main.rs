//! All cases that need more than one crate, in one program so that they link once and share a device.

mod animation;
mod culling;
mod curvature;
mod difference;
mod displacement;
mod drawing;
mod evaluators;
mod exactness;
mod fallback;
mod golden;
mod instances;
mod leaks;
mod parts;
mod pictures;
mod sampling;
mod subdivision;
mod unrefined;
mod watertight;
mod whole;
