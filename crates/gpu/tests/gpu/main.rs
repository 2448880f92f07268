//! Tests on a real device, with core and synchronization validation: any message fails them.
//!
//! They need a Vulkan device and the validation layers. `OSCULATE_DEVICE` chooses among devices, by number or part of a name.

mod capture;
mod compute;
mod device;
mod embed;
mod harness;
mod prepared;
mod present;
mod reflection;
mod refusals;
mod render;
mod texels;
mod textures;
mod threads;
mod timing;
mod xvfb;
