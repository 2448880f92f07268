//! What the final quads are: kinds of patches, and the lists that draws render.

use bytemuck::{Pod, Zeroable};
use osculate_cage::BoundaryRule;
use osculate_surface::NetKind;

use crate::nets::FinalMesh;
use crate::tables::is_corner;
use crate::{Connectivity, QuadConnectivity};

/// The valences whose nets fit the 32 points of a patch list (the report, section 4).
pub(crate) const LIST_VALENCES: std::ops::RangeInclusive<u32> = 3..=12;

/// How a patch is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PatchKind {
    /// Bicubic B-spline patch with a 16-point net; at a boundary part of the net is phantom points.
    Regular,
    /// Net of 2n+8 points about an inner vertex of this valence, 3 to 12.
    Extraordinary {
        /// Valence n.
        valence: u32,
    },
    /// Any other patch: its change of basis runs before the draw, into the coefficient buffer.
    Coefficients,
}

impl PatchKind {
    /// The number by which shaders know how to evaluate it (`KIND_*` in shaders/include/constants.glsl).
    pub const fn number(self) -> u32 {
        match self {
            Self::Regular => 0,
            Self::Extraordinary { .. } => 1,
            Self::Coefficients => 2,
        }
    }
}

/// Patches of one kind, drawn by one pipeline: `count` patches from the global number `first_patch`, their nets from `first_index` of
/// [`crate::SurfacePlan::nets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PatchList {
    /// What they are.
    pub kind: PatchKind,
    /// Global number of the first patch.
    pub first_patch: u32,
    /// Number of patches.
    pub count: u32,
    /// First index of their nets. The nets of a coefficient list differ in length; find them through the patch records.
    pub first_index: u32,
    /// First weight of their change of basis, for extraordinary lists.
    pub weights: u32,
}

/// What the shaders know of a patch (`PatchRecord` in shaders/include/records.glsl).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct PatchRecord {
    /// Vertex record of each corner.
    pub vertex: [u32; 4],
    /// Edge record of each side, times two, plus one if the patch walks the edge against the record.
    pub edge: [u32; 4],
    /// First index of the net.
    pub net: u32,
    /// First weight of the change of basis (extraordinary), or index in the coefficient buffer.
    pub basis: u32,
    /// Points of the net.
    pub net_size: u32,
    /// See [`PatchRecord::tag`].
    pub tag: u32,
}

impl PatchRecord {
    /// The kinds as the shaders number them, in bits 0 and 1 of the tag.
    pub const KIND_MASK: u32 = 3;
    /// Set in the tag if corner 0 or a side of the patch lies on the boundary.
    pub const BOUNDARY: u32 = 4;
    /// The valence of corner 0 begins at this bit of the tag (number of edges).
    pub const VALENCE_SHIFT: u32 = 8;

    pub(crate) fn make_tag(kind: PatchKind, boundary: bool, valence: u32) -> u32 {
        kind.number() | if boundary { Self::BOUNDARY } else { 0 } | valence << Self::VALENCE_SHIFT
    }

    /// Number of edges at corner 0.
    pub fn valence(&self) -> u32 {
        self.tag >> Self::VALENCE_SHIFT
    }

    /// Whether the patch touches the boundary with corner 0 or a side.
    pub fn is_boundary(&self) -> bool {
        self.tag & Self::BOUNDARY != 0
    }

    /// Whether corner 0 is irregular, so that the patch is no bicubic.
    pub fn is_extraordinary(&self) -> bool {
        self.tag & Self::KIND_MASK != 0
    }
}

/// What a final quad is, from its corner 0; isolation makes the other corners regular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct QuadClass {
    pub(crate) kind: PatchKind,
    pub(crate) net: NetKind,
    pub(crate) boundary: bool,
    /// Edges at corner 0.
    pub(crate) valence: u32,
}

pub(crate) fn classify(mesh: &FinalMesh<'_>, rule: BoundaryRule, quad: u32) -> QuadClass {
    let vertex = mesh.mesh.origin(4 * quad);
    if mesh.mesh.is_boundary_vertex(vertex) {
        classify_boundary(mesh.mesh, rule, quad)
    } else {
        classify_interior(mesh.mesh.face_valence(vertex))
    }
}

fn classify_interior(valence: u32) -> QuadClass {
    let (kind, net) = match valence {
        4 => (PatchKind::Regular, NetKind::Regular),
        n if LIST_VALENCES.contains(&n) => (PatchKind::Extraordinary { valence }, NetKind::Interior { valence }),
        _ => (PatchKind::Coefficients, NetKind::Interior { valence }),
    };
    QuadClass { kind, net, boundary: false, valence }
}

fn classify_boundary(mesh: &QuadConnectivity, rule: BoundaryRule, quad: u32) -> QuadClass {
    let vertex = mesh.origin(4 * quad);
    let faces = mesh.face_valence(vertex);
    let regular = faces == 2 || is_corner(mesh, rule, vertex);
    let (kind, net) = if regular {
        (PatchKind::Regular, NetKind::Regular)
    } else {
        let place = mesh.ring(vertex).position(|h| h == 4 * quad).unwrap_or(0) as u32;
        (PatchKind::Coefficients, NetKind::Crease { faces, quad: place })
    };
    QuadClass { kind, net, boundary: true, valence: faces + 1 }
}
