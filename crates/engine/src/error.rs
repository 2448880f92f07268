//! What can go wrong when a surface is made or drawn.

use osculate_gpu::GpuError;
use osculate_subdiv::PlanError;

/// Why the engine could not do what it was asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// The cage cannot be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The device failed or refused.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A table of the cage is larger than a shader can see on this device.
    #[error(
        "the cage's {what} take {bytes} bytes; device {device:?} lets a shader see at most {limit}: draw it in parts, or use a smaller cage or another device"
    )]
    TooLarge {
        /// The table.
        what: String,
        /// Its size.
        bytes: u64,
        /// The device's limit.
        limit: u64,
        /// Name of the device.
        device: String,
    },
    /// A shader is missing from the set.
    #[error("the shader set has no shader named {name:?}")]
    MissingShader {
        /// Its name.
        name: String,
    },
    /// New points do not fit the cage.
    #[error("the cage has {expected} points, {found} were given")]
    PointCount {
        /// Points of the cage.
        expected: usize,
        /// Points given.
        found: usize,
    },
    /// A new point is not a number or infinite.
    #[error("the new point of vertex {vertex} is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A cage that nothing moves was to be animated.
    #[error("the cage has no rig: nothing in its file moves vertices")]
    NoRig,
    /// An animation that was asked for is not there.
    #[error("there is no animation {animation}: the rig has {count}, counted from 0")]
    NoSuchAnimation {
        /// The one asked for.
        animation: usize,
        /// How many there are.
        count: usize,
    },
    /// A pose cannot be computed with.
    #[error("the pose does not work: {reason}")]
    Pose {
        /// What is wrong with it.
        reason: String,
    },
    /// Something takes texture coordinates, and the cage has none.
    #[error(
        "the cage has no texture coordinates: textures and displacements need them; unwrap the model where it was made"
    )]
    NoUv,
    /// A shade shows texture coordinates, and the surface was made without.
    #[error("the shade {shade} shows texture coordinates: give the surface some by Surface::with_maps")]
    NotMapped {
        /// Name of the shade.
        shade: &'static str,
    },
    /// A picture cannot be used.
    #[error(transparent)]
    Map(#[from] crate::MapError),
    /// A point that was asked for is not on the surface.
    #[error("there is no point (face {face}, sub {sub}, s {s}, t {t}): {reason}")]
    NoSuchPoint {
        /// Face of the cage.
        face: u32,
        /// Sub-face.
        sub: i32,
        /// First coordinate.
        s: f64,
        /// Second coordinate.
        t: f64,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A tessellation factor is out of range.
    #[error("tessellation level {level} is not in 1..64")]
    Level {
        /// The level asked for.
        level: f32,
    },
    /// A surface of which faces are left unrefined was asked for what only others can do.
    #[error(
        "faces of the surface are left unrefined, which does not go with {what}: take Refinement::Everywhere (--refine everywhere) for that"
    )]
    Unrefined {
        /// What it does not go with.
        what: &'static str,
    },
    /// A material does not go with what it is given.
    #[error("material {name:?}: {reason}")]
    Material {
        /// Its name.
        name: String,
        /// What is wrong.
        reason: String,
    },
    /// A material of another engine.
    #[error("the material belongs to another engine")]
    NoMaterial,
    /// A surface cannot be drawn where it stands, or not as it is asked for.
    #[error("the instance cannot be drawn: {reason}")]
    Placement {
        /// Why not, and what to do.
        reason: String,
    },
    /// A shade that compares two surfaces was asked for with one.
    #[error("the shade difference compares two surfaces: draw it with render_difference")]
    OneSurface,
    /// Something was asked for that the device cannot do.
    #[error("device {device:?} cannot {what}: {hint}")]
    Unsupported {
        /// Name of the device.
        device: String,
        /// What it cannot do.
        what: String,
        /// What to do instead.
        hint: String,
    },
}
