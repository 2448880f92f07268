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
//! What a frame is made of:
//!
#![doc = include_str!("../doc/frame.svg")]
//!
//! # From a file to pictures and points
//! * A [`Cage`] is read from OBJ, PLY, OFF, USD or glTF, or built by [`osculate_cage`].
//! * An [`Engine`] is a device with the pipelines made on it so far. A [`Surface`] holds a cage's tables and points there, in one of the [`Scheme`]s, refined
//!   everywhere or where it must be ([`Refinement`]); its points are moved by [`Surface::set_points`] or by an [`Animator`], and it is painted and displaced by [`Surface::with_maps`].
//! * [`render()`] makes a picture, [`Surface::capture`] hands out triangles, [`Surface::sample`] evaluates single points, and [`check()`] proves that no shared
//!   edge is open. [`Tessellation`] says how finely, and whether the tessellator or compute kernels do it ([`Evaluator`]).
//! * A cage too large for the device's buffers is drawn and proved in [`Parts`], one of which is on the device at a time: [`WholeOrParts`] decides.
//! * A [`Drawing`] is what stays of a surface from frame to frame in programs that let the library submit.
//!
//! # In a renderer of one's own
//! [`Device::from_raw`] takes a program's own Vulkan device. A [`Material`] is the program's fragment shader with the attachments of its rendering, an
//! [`Instance`] a surface that stands somewhere in its world, under a [`View`] by its matrices. [`Device::encode`] and [`Device::encode_draws`] write into its
//! command buffers. The file docs/embedding.md of the repository walks through it, says what a device must have and what becomes of a program on a lesser
//! one; `crates/engine/examples` has whole programs.

#![forbid(unsafe_code)]

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
mod instance;
mod kernels;
mod keys;
mod look;
mod maps;
mod material;
mod memo;
mod parts;
mod pipelines;
mod render;
mod sample;
mod space;
mod surface;
mod targets;
mod tessellation;
mod unrefined;
mod view;

pub use animate::Animator;
pub use camera::{Camera, CameraError};
pub use capture::CapturedVertex;
pub use check::{CheckReport, WeldReport, check};
pub use culling::Culling;
pub use difference::{Difference, render_difference};
pub use drawing::{DrawPlan, Drawing, DrawingDesc};
pub use engine::{Engine, EngineDesc};
pub use error::EngineError;
pub use instance::{Instance, InstanceDesc};
pub use keys::VertexKey;
pub use maps::{ColorMap, Coloring, Displacement, HeightMap, MapError, MapPlacement, MapsDesc, UvOrigin};
pub use material::{Material, MaterialDesc, Varying, shader_include};
pub use osculate_cage::{BoundaryRule, Cage};
/// The device layer, for programs that put the library's passes and draws into recordings of their own.
pub use osculate_gpu as gpu;
pub use osculate_gpu::{Device, DeviceDesc, DeviceError, DeviceInfo, GpuError, Recording, devices};
pub use osculate_shaders::ShaderSet;
pub use osculate_subdiv::{
    PatchForm, PatchKind, Place, PlanError, Refinement, Scheme, SubFace, SurfacePlan, UnknownScheme,
};
pub use parts::{Part, Parts, PartsDesc, PartsProof, WholeKey, WholeOrParts};
pub use pipelines::{PipelineObserver, PipelineProgress};
pub use render::{Picture, RenderDesc, Shade, render};
pub use sample::{Sample, SurfacePoint};
pub use space::CageSpace;
pub use surface::{Surface, SurfaceDesc};
pub use targets::{Target, Targets};
pub use tessellation::{Evaluator, Factors, Spacing, Tessellation};
pub use view::View;
