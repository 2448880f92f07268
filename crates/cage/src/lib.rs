//! Control cages: reading OBJ, PLY, OFF, USD and glTF, repair, validation, topology.
//!
//! A [`Cage`] is valid by construction: a closed or open, oriented, manifold mesh of polygons with finite positions. Whatever a
//! file holds, reading it ends in a cage or in an error that names the file, the line or the elements at fault; nothing after
//! this crate has to check again.
//!
//! Vertices, faces and half-edges are numbered from 0. The index of a face is the index of its `f` line in the file.
#![cfg_attr(test, expect(clippy::single_range_in_vec_init, reason = "face sets are lists of ranges"))]

mod appearance;
mod bounds;
mod cage;
mod creases;
mod draft;
mod error;
mod face_sets;
mod gltf;
mod inspect;
mod limits;
mod listed;
mod obj;
mod off;
mod part;
mod ply;
mod progress;
#[cfg(test)]
mod random;
mod read;
mod reference;
mod repair;
mod rig;
mod sequence;
mod tags;
mod text;
mod topology;
mod usd;
mod warning;
mod weld;

pub use appearance::{Appearance, Displacement, Image, ImageSource, Material, Texture, UvSet, Wrap};
pub use bounds::Bounds;
pub use cage::{Cage, CageDesc, FaceSet, FaceSetKind, FaceVarying, sub_faces};
pub use creases::CreaseDesc;
pub use error::{CageError, ReadError};
pub use gltf::{AccessorError, GltfDesc, GltfError, GltfPlace, PolygonRecovery, PolygonReport, read_gltf};
pub use inspect::{Advice, Elements, Inspection, Problem, inspect};
pub use limits::{LimitError, Limits};
pub use listed::Listed;
pub use obj::{ObjError, read_obj, write_obj};
pub use off::{OffError, read_off};
pub use part::{CagePart, divide};
pub use ply::{PlyError, read_ply};
pub use progress::{ReadObserver, ReadProgress, ReadStage};
pub use read::{FileFormat, ReadDesc};
pub use repair::{RepairDesc, RepairReport, repair};
pub use rig::{
    Animation, AnimationChannel, AnimationSampler, Interpolation, Joint, MorphSet, MorphTarget, NodeProperty,
    NodeTransform, Pose, Rig, RigNode,
};
pub use sequence::{Sequence, SequenceError};
pub use tags::{BoundaryRule, Corner, Crease, CreaseMethod, TagError, Tags};
pub use topology::{EdgeFaces, FaceCorner, Fans, Ring, Topology, TopologyError};
pub use usd::{UsdError, read_usd};
pub use warning::Warning;

/// The index that means "none": the twin of a boundary half-edge, the half-edge of a vertex without faces.
pub const NONE: u32 = u32::MAX;
