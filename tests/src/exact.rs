//! Points of patches on the device beside the exact limit surface.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};
use osculate::{CapturedVertex, EngineError, Place, Surface, Tessellation};
use osculate_shaders::constant::SAMPLE_FLOATS;
use osculate_shaders::layout::SampleRequest;
use osculate_subdiv::{PatchKind, PatchRecord};
use osculate_surface::reference::Reference;

/// A point of a patch and its derivatives over the patch, in cage space.
#[derive(Clone, Copy, Debug)]
pub struct PatchPoint {
    /// Position.
    pub position: DVec3,
    /// Derivative along u: on a side, that of the patch's own formula.
    pub du: DVec3,
    /// Derivative along v.
    pub dv: DVec3,
    /// Unit normal; zero where there is none.
    pub normal: DVec3,
}

/// A point as the device has it and as it should be.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Patch and parameters.
    pub request: SampleRequest,
    /// From the sampling kernels, the includes of the evaluation stages.
    pub device: PatchPoint,
    /// From the reference evaluator.
    pub exact: PatchPoint,
    /// The point is at a vertex where the exact surface has no derivatives.
    pub irregular: bool,
}

/// Points of patches, from the device.
///
/// # Panics
/// If the device fails.
pub fn evaluate(surface: &Surface, requests: &[SampleRequest]) -> Vec<PatchPoint> {
    let values = surface.evaluate(requests).unwrap_or_else(|error| panic!("{error}"));
    let vector = |v: &[f32], i: usize| Vec3::from_slice(&v[3 * i..]).as_dvec3();
    let point =
        |v: &[f32]| PatchPoint { position: vector(v, 0), du: vector(v, 1), dv: vector(v, 2), normal: vector(v, 3) };
    values.chunks_exact(SAMPLE_FLOATS as usize).map(point).collect()
}

/// The same points of the exact surface beside them.
///
/// # Panics
/// If the device fails, or the reference is of another cage.
pub fn compare(surface: &Surface, exact: &Reference<'_>, requests: &[SampleRequest]) -> Vec<Pair> {
    let pair = |(&request, device): (&SampleRequest, PatchPoint)| {
        let Place { sub_face, st: [s, t], axes } =
            surface.place(request.patch_id, [request.u.into(), request.v.into()]);
        let at = exact.eval(sub_face.face as usize, sub_face.sub, s, t).unwrap_or_else(|error| panic!("{error}"));
        let along = |axis: [f64; 2]| (at.du * axis[0] + at.dv * axis[1]) * surface.space().scale;
        let exact = PatchPoint {
            position: surface.space().enter_exactly(at.position),
            du: along(axes[0]),
            dv: along(axes[1]),
            normal: at.normal,
        };
        Pair { request, device, exact, irregular: at.irregular }
    };
    requests.iter().zip(evaluate(surface, requests)).map(pair).collect()
}

/// At most `limit` patches of every kind and valence, spread evenly over those there are.
pub fn some_patches(surface: &Surface, limit: usize, wanted: impl Fn(&PatchRecord) -> bool) -> Vec<u32> {
    let mut classes: BTreeMap<(PatchKind, bool, u32), Vec<u32>> = BTreeMap::new();
    for (id, record) in (0..).zip(&surface.plan().patches).filter(|(_, record)| wanted(record)) {
        classes.entry((record.kind(), record.is_boundary(), record.valence())).or_default().push(id);
    }
    let spread = |ids: Vec<u32>| {
        let count = ids.len().min(limit);
        (0..count).map(move |i| ids[i * ids.len() / count]).collect::<Vec<u32>>()
    };
    classes.into_values().flat_map(spread).collect()
}

/// All pairs of parameters, in every patch.
pub fn requests(patches: &[u32], parameters: &[f32]) -> Vec<SampleRequest> {
    let grid = || parameters.iter().flat_map(|&v| parameters.iter().map(move |&u| (u, v)));
    patches.iter().flat_map(|&patch_id| grid().map(move |(u, v)| SampleRequest { patch_id, u, v })).collect()
}

/// The vertices of a surface's triangles, one at each place of each patch. That those at one place have equal bits is for [`osculate::check`] to say.
///
/// # Panics
/// If the device fails.
pub fn captured(surface: &Surface, tessellation: &Tessellation) -> Vec<CapturedVertex> {
    let place = |vertex: &CapturedVertex| vertex.uv.map(f32::to_bits);
    let mut all = Vec::new();
    let keep = |vertices: &[CapturedVertex]| {
        for patch in vertices.chunk_by(|a, b| a.patch == b.patch) {
            let mut patch = patch.to_vec();
            patch.sort_unstable_by_key(place);
            patch.dedup_by_key(|vertex| place(vertex));
            all.extend(patch);
        }
        Ok::<(), EngineError>(())
    };
    surface.capture(tessellation, keep).unwrap_or_else(|error| panic!("{error}"));
    all
}
