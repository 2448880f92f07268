//! What the final quads are: kinds of patches, and the lists that draws render.

use bytemuck::{Pod, Zeroable};
use osculate_cage::BoundaryRule;

use crate::Connectivity;
use crate::tables::is_corner;

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

    /// Points of the nets of this kind; those of coefficient patches differ.
    pub(crate) fn net_size(self) -> Option<u32> {
        match self {
            Self::Regular => Some(16),
            Self::Extraordinary { valence } => Some(2 * valence + 8),
            Self::Coefficients => None,
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

impl PatchList {
    /// Their global numbers.
    pub(crate) fn patches(&self) -> std::ops::Range<usize> {
        self.first_patch as usize..(self.first_patch + self.count) as usize
    }
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

    /// Number of edges at corner 0.
    pub fn valence(&self) -> u32 {
        Tag(self.tag).valence()
    }

    /// Whether the patch touches the boundary with corner 0 or a side.
    pub fn is_boundary(&self) -> bool {
        Tag(self.tag).is_boundary()
    }

    /// Whether corner 0 is irregular, so that the patch is no bicubic.
    pub fn is_extraordinary(&self) -> bool {
        Tag(self.tag).kind() != PatchKind::Regular
    }
}

/// What a final quad is, from its corner 0; isolation makes the other corners regular. The bits are those of [`PatchRecord::tag`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tag(pub(crate) u32);

impl Tag {
    fn new(kind: PatchKind, boundary: bool, valence: u32) -> Self {
        Self(kind.number() | if boundary { PatchRecord::BOUNDARY } else { 0 } | valence << PatchRecord::VALENCE_SHIFT)
    }

    /// What a vertex of the last mesh but one makes of the final quads about its vertex point, which has as many faces.
    pub(crate) fn of_vertex(mesh: &impl Connectivity, rule: BoundaryRule, vertex: u32) -> Self {
        let faces = mesh.face_valence(vertex);
        if mesh.is_boundary_vertex(vertex) {
            let regular = faces == 2 || is_corner(mesh, rule, vertex);
            Self::new(if regular { PatchKind::Regular } else { PatchKind::Coefficients }, true, faces + 1)
        } else {
            Self::new(interior_kind(faces), false, faces)
        }
    }

    pub(crate) fn kind(self) -> PatchKind {
        match self.0 & PatchRecord::KIND_MASK {
            0 => PatchKind::Regular,
            1 => PatchKind::Extraordinary { valence: self.valence() },
            _ => PatchKind::Coefficients,
        }
    }

    pub(crate) fn is_boundary(self) -> bool {
        self.0 & PatchRecord::BOUNDARY != 0
    }

    /// Number of edges at corner 0.
    pub(crate) fn valence(self) -> u32 {
        self.0 >> PatchRecord::VALENCE_SHIFT
    }
}

fn interior_kind(valence: u32) -> PatchKind {
    match valence {
        4 => PatchKind::Regular,
        n if LIST_VALENCES.contains(&n) => PatchKind::Extraordinary { valence },
        _ => PatchKind::Coefficients,
    }
}
