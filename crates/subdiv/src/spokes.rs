//! Spokes: edges between extraordinary patches that end at the extraordinary vertex. Schemes whose curves there are no cubics evaluate them from a record of
//! their own, which both patches share; the cubic record of the edge then serves for tessellation factors alone.

use bytemuck::{Pod, Zeroable};
use osculate_surface::NetKind;

use crate::projections::Projections;
use crate::weights::{Role, WeightTable};
use crate::{NONE, PatchForm};

/// The record of a spoke, walked from the extraordinary vertex outwards (`SpokeRecord` in shaders/include/spokes.glsl).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct SpokeRecord {
    /// Its first vector in the coefficient buffer; [`NONE`] for an edge that is no spoke.
    pub vectors: u32,
    /// First weight of the functions of its modes, for stam.
    pub table: u32,
    /// How many vectors it has: modes for stam, 8 Bezier points of the curve and 8 of the cross derivative for biseptic.
    pub modes: u32,
}

/// Side 0 or 3 of an extraordinary patch.
pub(crate) struct SpokeSide {
    pub(crate) kind: NetKind,
    pub(crate) form: PatchForm,
    pub(crate) side: usize,
    /// First index and size of the patch's net.
    pub(crate) net: (u32, u32),
}

/// Modes of the eigenbasis of a side ([`osculate_surface::stam::Side`]).
fn modes(side: &SpokeSide) -> u32 {
    match side.kind {
        NetKind::Interior { valence } => 2 * valence + 4,
        NetKind::Crease { faces, .. } => 2 * faces + 5 - u32::from(side.kind.side_is_sharp(side.side)),
        NetKind::Regular => unreachable!("regular patches have no spokes"),
    }
}

/// Records of the general edges; `None` is an edge that is no spoke.
pub(crate) fn spoke_records(
    sides: &[Option<SpokeSide>],
    weights: &mut WeightTable,
    projections: &mut Projections,
) -> Vec<SpokeRecord> {
    let role = |side: &SpokeSide| (side.kind, Role::Spoke(side.form, side.side));
    weights.prepare(sides.iter().flatten().map(role).collect());
    let mut record = |side: &Option<SpokeSide>| {
        let Some(side) = side else { return SpokeRecord { vectors: NONE, table: 0, modes: 0 } };
        let (kind, role) = role(side);
        let offset = weights.offset(kind, role);
        let (modes, absolute) = if side.form == PatchForm::Stam { (modes(side), 1) } else { (16, 8) };
        let table = offset + modes * side.net.1;
        SpokeRecord { vectors: projections.push(side.net, offset, modes, absolute), table, modes }
    };
    sides.iter().map(&mut record).collect()
}

#[cfg(test)]
mod tests {
    use osculate_surface::stam::Side;

    use super::*;

    #[test]
    fn sides_have_as_many_modes_as_their_eigenbases() {
        let crease = |faces, quad| NetKind::Crease { faces, quad };
        for kind in [
            NetKind::Interior { valence: 5 },
            NetKind::Interior { valence: 2 },
            crease(1, 0),
            crease(3, 0),
            crease(3, 1),
            crease(3, 2),
        ] {
            for side in [0, 3] {
                let spoke = SpokeSide { kind, form: PatchForm::Stam, side, net: (0, 0) };
                assert_eq!(modes(&spoke) as usize, Side::new(kind, side).table().modes, "{kind:?}, side {side}");
            }
        }
    }
}
