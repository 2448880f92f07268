//! Smooth subdivision surfaces through hull and domain stages of Vulkan: the library.
//!
//! ```no_run
//! use osculate::{Cage, Device, DeviceDesc, Engine, RenderDesc, Surface, SurfaceDesc, render};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let cage = Cage::read("creature.obj".as_ref())?;
//! let engine = Engine::new(Device::new(&DeviceDesc::default())?);
//! let surface = Surface::new(&engine, &cage, &SurfaceDesc::default())?;
//! let picture = render(&engine, &[&surface], &RenderDesc::fit(&cage, [800, 600]))?;
//! # Ok(())
//! # }
//! ```
//!
//! A [`Surface`] holds a cage's tables and points on the device; [`render()`], [`Surface::capture`], [`Surface::sample`] and [`check()`] draw it, hand out the
//! triangles that the tessellator made, evaluate single points, and prove that no shared edge is open. A [`Drawing`] is what stays of it from frame to frame.

mod alpha;
mod animate;
mod buffers;
mod camera;
mod canvas;
mod capture;
mod check;
mod culling;
mod difference;
mod draw;
mod drawing;
mod engine;
mod error;
mod evaluate;
mod frame;
mod grid;
mod kernels;
mod keys;
mod look;
mod maps;
mod memo;
mod pipelines;
mod render;
mod sample;
mod space;
mod surface;
mod targets;
mod tessellation;

pub use animate::Animator;
pub use camera::{Camera, CameraError};
pub use capture::CapturedVertex;
pub use check::{CheckReport, WeldReport, check};
pub use culling::Culling;
pub use difference::{Difference, render_difference};
pub use drawing::{DrawPlan, Drawing, DrawingDesc};
pub use engine::{Engine, EngineDesc};
pub use error::EngineError;
pub use keys::VertexKey;
pub use maps::{ColorMap, Coloring, Displacement, HeightMap, MapError, MapPlacement, MapsDesc, UvOrigin};
pub use osculate_cage::{BoundaryRule, Cage};
/// The device layer, for programs that put the library's passes and draws into recordings of their own.
pub use osculate_gpu as gpu;
pub use osculate_gpu::{Device, DeviceDesc, DeviceError, DeviceInfo, GpuError, Recording, devices};
pub use osculate_shaders::ShaderSet;
pub use osculate_subdiv::{PatchForm, PatchKind, Place, PlanError, Scheme, SubFace, SurfacePlan, UnknownScheme};
pub use pipelines::{PipelineObserver, PipelineProgress};
pub use render::{Picture, RenderDesc, Shade, render};
pub use sample::{Sample, SurfacePoint};
pub use space::CageSpace;
pub use surface::{Surface, SurfaceDesc};
pub use targets::{Target, Targets};
pub use tessellation::{Evaluator, Factors, Spacing, Tessellation};
