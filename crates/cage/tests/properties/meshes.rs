//! Random meshes.

use glam::{DVec2, DVec3};
use osculate_cage::{
    BoundaryRule, Cage, CageDesc, Corner, Crease, CreaseMethod, FaceSet, FaceSetKind, FaceVarying, RepairDesc, Tags,
    repair,
};
use proptest::collection::vec;
use proptest::prelude::*;

/// Mostly points of a small lattice, so that some coincide, and any number that a cage may have.
fn coordinate() -> impl Strategy<Value = f64> {
    let any_size = any::<f64>().prop_filter("of a size that can be drawn", |x| x.abs() < 1e17);
    prop_oneof![4 => (-2..=2_i32).prop_map(f64::from), 1 => any_size]
}

fn position() -> impl Strategy<Value = DVec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(DVec3::from_array)
}

/// Polygons of any vertices: mostly no manifold mesh.
pub(crate) fn soup() -> impl Strategy<Value = CageDesc> {
    (3..12_usize, 1..7_usize).prop_flat_map(|(vertices, faces)| {
        let corner = 0..vertices as u32;
        (vec(position(), vertices), vec(vec(corner, 3..6), faces), any::<bool>()).prop_map(
            |(positions, faces, has_uv)| {
                let offsets = faces.iter().scan(0, |end, face| {
                    *end += face.len() as u32;
                    Some(*end)
                });
                let face_offsets: Vec<u32> = std::iter::once(0).chain(offsets).collect();
                let face_vertices = faces.concat();
                let uv = has_uv.then(|| uv(face_vertices.len()));
                CageDesc { positions, face_offsets, face_vertices, uv, ..CageDesc::default() }
            },
        )
    })
}

fn uv(corners: usize) -> FaceVarying {
    let values = vec![DVec2::new(0.1, -0.0), DVec2::new(1e-9, 0.7), DVec2::ONE];
    FaceVarying { values, indices: (0..corners as u32).map(|corner| corner * corner % 3).collect() }
}

/// Cages that a repair made.
pub(crate) fn repaired() -> impl Strategy<Value = Cage> {
    soup().prop_filter_map("all faces are degenerate", |desc| {
        let desc = repair(desc, &RepairDesc::default()).ok()?;
        Cage::new(CageDesc { source_vertices: Vec::new(), source_faces: Vec::new(), warnings: Vec::new(), ..desc }).ok()
    })
}

/// Cages with tags and sets of faces.
pub(crate) fn decorated() -> impl Strategy<Value = Cage> {
    let sharpness = prop_oneof![Just(10.0_f32), 0.0..20.0_f32];
    let tags = (vec((any::<prop::sample::Index>(), sharpness), 0..6), any::<[bool; 2]>(), 0..4_u8, 0..6_u8);
    (repaired(), tags, vec(("[a-zé#][a-z0-9_.]{0,6}", any::<prop::sample::Index>()), 0..3)).prop_map(
        |(cage, (sharp, [chaikin, smooth_triangles], rule, face_varying), names)| {
            let mut tags = Tags { smooth_triangles, ..Tags::default() };
            for (i, (index, sharpness)) in sharp.iter().enumerate() {
                let h = index.index(cage.face_vertices().len()) as u32;
                let vertices = [cage.topology().origin(h), cage.topology().target(h)];
                match i % 3 {
                    0 => tags.creases.push(Crease { vertices, sharpness: *sharpness }),
                    1 => tags.corners.push(Corner { vertex: vertices[0], sharpness: *sharpness }),
                    _ => tags.holes.push(cage.topology().face(h)),
                }
            }
            let rules =
                [None, Some(BoundaryRule::None), Some(BoundaryRule::EdgeOnly), Some(BoundaryRule::EdgeAndCorner)];
            tags.boundary = rules[usize::from(rule)];
            tags.face_varying_boundary = (face_varying > 0).then_some(face_varying);
            tags.crease_method = if chaikin { CreaseMethod::Chaikin } else { CreaseMethod::Normal };
            let face_sets = face_sets(&names, cage.face_count());
            Cage::new(CageDesc { tags, face_sets, ..desc_of(&cage) }).expect("tags that fit")
        },
    )
}

fn desc_of(cage: &Cage) -> CageDesc {
    CageDesc {
        positions: cage.positions().to_vec(),
        face_offsets: cage.face_offsets().to_vec(),
        face_vertices: cage.face_vertices().to_vec(),
        uv: cage.uv().cloned(),
        ..CageDesc::default()
    }
}

/// A material for the first faces and one for the others, in the order in which a file names them.
fn face_sets(names: &[(String, prop::sample::Index)], faces: usize) -> Vec<FaceSet> {
    let kinds = [FaceSetKind::Object, FaceSetKind::Material, FaceSetKind::Smoothing];
    let set = |(kind, (name, end)): (FaceSetKind, &(String, prop::sample::Index))| FaceSet {
        kind,
        // The name of a group of its own: `off` and `0` end one.
        name: format!("{name}1"),
        faces: std::iter::once(0..end.index(faces) as u32 + 1).collect(),
    };
    let named = |name: &str| !name.starts_with('#');
    kinds.into_iter().zip(names).filter(|(_, (name, _))| named(name)).map(set).collect()
}
