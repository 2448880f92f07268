//! What the final quads are: kinds of patches, and the lists that draws render.

use bytemuck::{Pod, Zeroable};
use osculate_cage::BoundaryRule;

use crate::tables::is_corner;
use crate::{Connectivity, Scheme};

/// The valences whose nets fit the 32 points of a patch list (the report, section 4).
pub(crate) const LIST_VALENCES: std::ops::RangeInclusive<u32> = 3..=12;

/// The formula that a patch is evaluated by (`shaders/include/forms`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PatchForm {
    /// Bicubic Bezier patch: 16 points.
    Bicubic,
    /// Rational bicubic Gregory patch: 20 points.
    Gregory,
    /// Eigenbasis of subdivision: as many vectors as the net has points.
    Stam,
    /// Bezier patch of bidegree 7: 64 points.
    Biseptic,
    /// Quartic Gregory triangle: 15 points.
    Triangle,
}

impl PatchForm {
    /// The number by which shaders know it (`FORM_*` in shaders/include/constants.glsl).
    pub const fn number(self) -> u32 {
        match self {
            Self::Bicubic => 0,
            Self::Gregory => 1,
            Self::Stam => 2,
            Self::Biseptic => 3,
            Self::Triangle => 4,
        }
    }

    /// The name in results: that of the scheme that it belongs to, without the number of steps.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bicubic => "regular",
            Self::Gregory => "gregory",
            Self::Stam => "stam",
            Self::Biseptic => "biseptic",
            Self::Triangle => "triangle",
        }
    }

    const fn from_number(number: u32) -> Self {
        match number {
            1 => Self::Gregory,
            2 => Self::Stam,
            3 => Self::Biseptic,
            4 => Self::Triangle,
            _ => Self::Bicubic,
        }
    }

    /// Whether the sides that leave an extraordinary vertex have a record of their own beside the cubic one of all edges.
    pub const fn has_spokes(self) -> bool {
        matches!(self, Self::Stam | Self::Biseptic)
    }
}

/// How the control points of a patch come about, and what it is evaluated by: one pipeline each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PatchKind {
    /// Face of the last mesh but one that is left as it is: bicubic B-spline patch with a 16-point net.
    Unrefined,
    /// Bicubic B-spline patch with a 16-point net; at a boundary part of the net is phantom points.
    Regular,
    /// Net of 2n+8 points about an inner vertex of this valence, 3 to 12; the control stage changes the basis.
    Extraordinary {
        /// Formula.
        form: PatchForm,
        /// Valence n.
        valence: u32,
    },
    /// Any other patch: its change of basis runs before the draw, into the coefficient buffer.
    Stored {
        /// Formula.
        form: PatchForm,
    },
}

impl PatchKind {
    /// Formula.
    pub const fn form(self) -> PatchForm {
        match self {
            Self::Unrefined | Self::Regular => PatchForm::Bicubic,
            Self::Extraordinary { form, .. } | Self::Stored { form } => form,
        }
    }

    /// Whether control points come from the coefficient buffer.
    pub const fn is_stored(self) -> bool {
        matches!(self, Self::Stored { .. })
    }

    /// Points of the nets of this kind; those of stored patches differ.
    pub fn net_size(self) -> Option<u32> {
        match self {
            Self::Unrefined | Self::Regular => Some(16),
            Self::Extraordinary { valence, .. } => Some(2 * valence + 8),
            Self::Stored { .. } => None,
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
    /// Number of those that are drawn, which come first: all, but in a part of a cage those of its own faces.
    pub drawn: u32,
    /// First index of their nets. The nets of a stored list differ in length.
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

/// What the shaders know of a patch (`patches` in shaders/include/records.glsl).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct PatchRecord {
    /// Vertex record of each corner; [`crate::NONE`] for the end of a half of an edge record ([`Self::is_half`]) that is the middle of the edge.
    pub vertex: [u32; 4],
    /// Edge record of each side, times two, plus one if the patch walks the edge against the record.
    pub edge: [u32; 4],
    /// First index of the net; of a stored patch the first of its vectors in the coefficient buffer.
    pub net: u32,
    /// First weight of the change of basis; 0 where there is none that shaders read.
    pub basis: u32,
    /// Points of the net.
    pub net_size: u32,
    /// See [`PatchRecord::tag`].
    pub tag: u32,
}

impl PatchRecord {
    /// The formula as the shaders number it, in bits 0 to 2 of the tag.
    pub const FORM_MASK: u32 = 7;
    /// Set in the tag if control points come from the coefficient buffer.
    pub const STORED: u32 = 8;
    /// Set in the tag if corner 0 or a side of the patch lies on the boundary.
    pub const BOUNDARY: u32 = 16;
    /// Set in the tag if side 0 is the first half of an edge record: [`Self::is_half`].
    pub const HALF_0: u32 = 32;
    /// Set in the tag if side 3 is the second half of an edge record.
    pub const HALF_3: u32 = 64;
    /// Set in the tag of a patch that is an unrefined face.
    pub const UNREFINED: u32 = 128;
    /// The valence of corner 0 begins at this bit of the tag (number of edges).
    pub const VALENCE_SHIFT: u32 = 8;

    /// The tag of a patch of a kind; `valence` is that of corner 0, or of the most irregular corner where several may be.
    pub(crate) fn tag_of(kind: PatchKind, boundary: bool, valence: u32) -> u32 {
        Tag::new(kind, boundary, valence).0
    }

    /// Number of corners, and of sides: the entries of `vertex` and `edge` that are in use.
    pub fn sides(&self) -> usize {
        if self.kind().form() == PatchForm::Triangle { 3 } else { 4 }
    }

    /// Number of edges at corner 0.
    pub fn valence(&self) -> u32 {
        Tag(self.tag).valence()
    }

    /// Whether the patch touches the boundary with corner 0 or a side.
    pub fn is_boundary(&self) -> bool {
        Tag(self.tag).is_boundary()
    }

    /// Its formula, and where its control points come from.
    pub fn kind(&self) -> PatchKind {
        Tag(self.tag).kind()
    }

    /// Whether corner 0 is irregular, so that the patch is no bicubic.
    pub fn is_extraordinary(&self) -> bool {
        self.kind().form() != PatchForm::Bicubic
    }

    /// Whether the patch is a face that is left unrefined.
    pub fn is_unrefined(&self) -> bool {
        self.kind() == PatchKind::Unrefined
    }

    /// Whether a side is half an edge of an unrefined face, and so half the edge record that its number stands for. Walked from its first corner to the next,
    /// side 0 is the first half and side 3 the second: one end of either is corner 0, the other the middle of the edge.
    pub fn is_half(&self, side: usize) -> bool {
        match side {
            0 => self.tag & Self::HALF_0 != 0,
            3 => self.tag & Self::HALF_3 != 0,
            _ => false,
        }
    }

    /// The half side that ends at a corner which is the middle of an edge, if the corner is one.
    pub fn half_to(&self, corner: usize) -> Option<usize> {
        match corner {
            1 if self.is_half(0) => Some(0),
            3 if self.is_half(3) => Some(3),
            _ => None,
        }
    }
}

/// What a final quad is, from its corner 0; isolation makes the other corners regular. The bits are those of [`PatchRecord::tag`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tag(pub(crate) u32);

impl Tag {
    fn new(kind: PatchKind, boundary: bool, valence: u32) -> Self {
        let flag = |set: bool, bit: u32| if set { bit } else { 0 };
        let bits = flag(kind.is_stored(), PatchRecord::STORED) | flag(boundary, PatchRecord::BOUNDARY);
        let bits = bits | flag(kind == PatchKind::Unrefined, PatchRecord::UNREFINED);
        Self(kind.form().number() | bits | valence << PatchRecord::VALENCE_SHIFT)
    }

    /// What a vertex of the last mesh but one makes of the final quads about its vertex point, which has as many faces.
    pub(crate) fn of_vertex(mesh: &impl Connectivity, rule: BoundaryRule, scheme: Scheme, vertex: u32) -> Self {
        let faces = mesh.face_valence(vertex);
        if mesh.is_boundary_vertex(vertex) {
            let regular = faces == 2 || is_corner(mesh, rule, vertex);
            let stored = PatchKind::Stored { form: scheme.boundary_form() };
            Self::new(if regular { PatchKind::Regular } else { stored }, true, faces + 1)
        } else {
            Self::new(interior_kind(scheme, faces), false, faces)
        }
    }

    pub(crate) fn kind(self) -> PatchKind {
        let form = PatchForm::from_number(self.0 & PatchRecord::FORM_MASK);
        match form {
            _ if self.0 & PatchRecord::STORED != 0 => PatchKind::Stored { form },
            PatchForm::Bicubic if self.0 & PatchRecord::UNREFINED != 0 => PatchKind::Unrefined,
            PatchForm::Bicubic => PatchKind::Regular,
            _ => PatchKind::Extraordinary { form, valence: self.valence() },
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

fn interior_kind(scheme: Scheme, valence: u32) -> PatchKind {
    let form = scheme.interior_form(valence);
    match valence {
        4 => PatchKind::Regular,
        n if LIST_VALENCES.contains(&n) => PatchKind::Extraordinary { form, valence },
        _ => PatchKind::Stored { form },
    }
}
