//! Plans of cages whose irregular vertices are not isolated: every quad and every triangle becomes one patch, whatever meets at its corners (the report,
//! section 4.4; Loop, Schaefer, Ni and Castano, *Approximating Subdivision Surfaces with Gregory Patches for Hardware Tessellation*, 2009).
//!
//! Each vertex that needs it is given a fan of vectors, a matrix times the vertex, its neighbours and the centroids of its faces. Edge records and control
//! points are gathered from those of their ends and corners. Quads among quads with four edges at every corner stay bicubic patches with 16 points.

mod faces;
mod fans;
mod records;

use bytemuck::{Pod, Zeroable};
use osculate_cage::{BoundaryRule, Cage};

use crate::projections::Projections;
use crate::{Connectivity, Locator, PatchForm, PlanError, QuadConnectivity, RefineTables, Scheme, SurfacePlan};
use faces::WholeMesh;
use fans::Fans;

/// The vectors of a vertex in the coefficient buffer (`FanRecord` in shaders/include/fans.glsl): limit position, edge points, then for each edge two points of
/// the cross derivative ([`osculate_surface::gregory::Fan::matrix`]).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FanRecord {
    /// First vector.
    pub first: u32,
    /// Number of edges.
    pub edges: u32,
    /// What edges do about their cross derivative here ([`osculate_surface::gregory::CrossEnd::number`]).
    pub cross_end: u32,
    /// Cosine of the angle between neighbouring edges.
    pub cosine: f32,
}

/// What an edge record is gathered from (`GatheredEdge` in shaders/records/edge_gathered.comp): the fans of its ends, and its number in either.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct GatheredEdge {
    /// Fans of start and end.
    pub fan: [u32; 2],
    /// Number of the edge in these fans.
    pub edge: [u32; 2],
}

/// What the control points of a patch are gathered from (`GatheredPatch` in shaders/records/patch_gathered.comp).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct GatheredPatch {
    /// Fan of each corner; [`crate::NONE`] for the fourth of a triangle.
    pub fan: [u32; 4],
    /// Number of the side from each corner to the next in the corner's fan.
    pub edge: [u32; 4],
    /// First vector of the control points.
    pub first: u32,
    /// 3 or 4.
    pub sides: u32,
}

/// Sources of what is gathered from fans: edge records after those of regular nets, and control points after the vectors of the fans.
#[derive(Clone, Debug, Default)]
pub struct Gathers {
    /// The fans.
    pub fans: Vec<FanRecord>,
    /// Edge records.
    pub edges: Vec<GatheredEdge>,
    /// Stored patches, in order.
    pub patches: Vec<GatheredPatch>,
    /// Whether the surface is irregular at the vertex of each fan.
    pub irregular: Vec<bool>,
}

impl Gathers {
    /// Bytes on the device.
    pub fn bytes(&self) -> usize {
        size_of_val(self.fans.as_slice()) + size_of_val(self.edges.as_slice()) + size_of_val(self.patches.as_slice())
    }
}

/// Control points of a patch of that form.
pub(crate) const fn control_points(form: PatchForm) -> u32 {
    if matches!(form, PatchForm::Triangle) { 15 } else { 20 }
}

/// Plans a cage, of which `drawn` says which faces are: after no steps if it is of quads and triangles, else after one, which makes quads of all faces.
///
/// # Errors
/// If the mesh is too large for 32-bit indices, or fans would fill the memory.
pub(crate) fn build(cage: &Cage, rule: BoundaryRule, steps: u32, drawn: &[bool]) -> Result<SurfacePlan, PlanError> {
    let base = cage.topology();
    check_size(base.half_edge_count() as u64 * if steps == 0 { 1 } else { 4 })?;
    if steps == 0 {
        return finish(cage, rule, base, Vec::new(), |face| drawn[face as usize]);
    }
    let mesh = QuadConnectivity::refine(base);
    let tables = RefineTables::build(base, rule, 0);
    finish(cage, rule, &mesh, vec![tables], |quad| drawn[base.face(quad) as usize])
}

/// Refuses meshes whose slots for records or whose vectors could overflow 32-bit numbers: a half-edge has up to 3 vectors in a fan and 5 in a patch.
fn check_size(half_edges: u64) -> Result<(), PlanError> {
    let limit = u64::from(u32::MAX) / 24;
    if half_edges > limit {
        return Err(PlanError::TooLarge { what: "corners of patches", count: half_edges, limit });
    }
    Ok(())
}

/// Plans the patches of the mesh after `levels`.
fn finish<M: Connectivity>(
    cage: &Cage,
    rule: BoundaryRule,
    mesh: &M,
    mut levels: Vec<RefineTables>,
    is_drawn: impl Fn(u32) -> bool + Sync,
) -> Result<SurfacePlan, PlanError> {
    let steps = levels.len() as u32;
    let first_point = levels.last().map_or(0, |level| level.first_new);
    let whole = WholeMesh::new(mesh, first_point, rule, is_drawn);
    let mut projections = Projections::default();
    let fans = Fans::gather(&whole, &mut projections)?;
    let records = records::assign(&whole, &fans, projections.count);
    let mut first_phantom = whole.first_centroid();
    if !fans.records.is_empty() {
        levels.push(RefineTables::centroids(mesh, first_point));
        first_phantom += mesh.face_count() as u32;
    }
    Ok(SurfacePlan {
        rule,
        scheme: Scheme::Gregory1,
        steps,
        cage_points: cage.vertex_count() as u32,
        levels,
        point_count: first_phantom,
        first_phantom,
        reflections: Vec::new(),
        lists: whole.lists,
        nets: [whole.nets, fans.nets].concat(),
        patches: records.patches,
        quads: whole.faces,
        patch_of_quad: whole.patch_of_face,
        weights: fans.weights,
        vertex_records: records.vertices,
        edge_records: records.edges,
        spokes: Vec::new(),
        projections: projections.sources,
        vector_count: records.vector_count,
        gathers: records.gathers,
        boundary_edges: records.boundary_edges,
        locator: Locator::new(cage, steps),
    })
}
