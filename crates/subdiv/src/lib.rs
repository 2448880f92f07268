//! Refinement tables and patch plans of a cage: everything that depends on connectivity alone, computed once on the host.
//!
//! [`SurfacePlan::build`] takes a cage through one or two Catmull-Clark steps (only their connectivity; points move on the device), then classifies
//! the final quads into patches whose nets the shaders evaluate. The scheme of tables is that of Loop, *Hardware Subdivision and Tessellation of
//! Catmull-Clark Surfaces*, MSR-TR-2010-163, section 3.1 ("the report"). Conventions of nets, sides and corners: ARCHITECTURE.md.

mod connectivity;
mod error;
mod gather;
mod lists;
mod location;
mod needed;
mod nets;
mod part;
mod patches;
mod plan;
mod projections;
mod rank;
mod records;
mod scheme;
mod spokes;
mod tables;
pub mod twin;
mod unrefined;
mod uv;
mod weights;
mod whole;

pub use connectivity::{Connectivity, QuadConnectivity};
pub use error::PlanError;
pub use location::{Locator, PatchPoint, Place, SubFace};
pub use part::WholeNames;
pub use patches::{PatchForm, PatchKind, PatchList, PatchRecord};
pub use plan::{PlanDesc, SurfacePlan};
pub use projections::ProjectionSource;
pub use records::MatrixSource;
pub use scheme::{Scheme, UnknownScheme};
pub use spokes::SpokeRecord;
pub use tables::RefineTables;
pub use unrefined::Refinement;
pub use uv::{EdgeUv, UvTables};
pub use whole::{FanRecord, GatheredEdge, GatheredPatch, Gathers};

/// "No such element": a missing twin, a face without patch.
pub const NONE: u32 = u32::MAX;
