//! The proof that a tessellated surface has no cracks.
//!
//! Points are compared by key, not by place: vertices with the same record (and parameter, on an edge) must have the same bits in position and normal, and
//! the triangles must close over those keys. Inside a patch the triangles must close over (u,v). Only what lies on the border of patches is kept, so the
//! memory needed grows with edges, not with triangles.

mod shared;

use std::collections::HashMap;
use std::ops::AddAssign;

use osculate_subdiv::{SurfacePlan, WholeNames};

use crate::capture::hand_out;
use crate::evaluate::Grids;
use crate::grid::Layout;
use crate::keys::{common_side, edge_parameter};
use crate::parts::Seams;
use crate::{CapturedVertex, EngineError, Surface, Tessellation, VertexKey, WholeKey};

use shared::{Mesh, compare};

/// What [`check`] found. A watertight surface has zero in all but `triangles` and `degenerate`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CheckReport {
    /// Triangles drawn.
    pub triangles: u64,
    /// Triangle edges without a partner that are not on the boundary of the surface, plus `split_positions`: a crack either way.
    pub open: u64,
    /// Triangle edges that more than two triangles share, or two with the same direction.
    pub over_shared: u64,
    /// Vertices whose position differs from that of the first vertex of their key.
    pub split_positions: u64,
    /// Vertices whose normal differs from that of the first vertex of their key.
    pub split_normals: u64,
    /// Triangles that run clockwise in their patch.
    pub inverted: u64,
    /// Triangles without area in their patch: no error.
    pub degenerate: u64,
    /// Patches that were not drawn, drawn twice, or are none of the surface's: a defect of the driver.
    pub wrong_patches: u64,
    /// The same question asked of positions alone.
    pub weld: WeldReport,
}

/// Edges between patches after welding vertices of equal position bits. Records that happen to lie at one place are welded, too, so a surface that touches
/// itself may show shared edges here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WeldReport {
    /// Edges on the border of patches without a partner that are not on the boundary of the surface.
    pub open: u64,
    /// Edges on the border of patches that more than two triangles share.
    pub over_shared: u64,
}

impl CheckReport {
    /// Whether the surface has no cracks and no wrong triangles.
    pub fn is_watertight(&self) -> bool {
        self.open == 0
            && self.over_shared == 0
            && self.split_normals == 0
            && self.inverted == 0
            && self.wrong_patches == 0
    }
}

/// Cuts a surface into triangles in memory and looks for cracks. The shared vertices of the compute evaluator must close by index, too.
///
/// # Errors
/// As [`Surface::capture`].
pub fn check(surface: &Surface, tessellation: &Tessellation) -> Result<CheckReport, EngineError> {
    let mut proof = Proof::new(surface.plan());
    proof.add_surface(surface, tessellation)?;
    Ok(proof.finish(surface.boundary_edge_count()))
}

/// Bits of a position or a normal.
pub(crate) type Bits = [u32; 3];

fn bits(v: [f32; 3]) -> Bits {
    v.map(f32::to_bits)
}

/// A directed triangle edge on the border of a patch: edge record and the bits of the parameter at either end.
type BorderEdge = (u32, u32, u32);

/// The proof of one surface.
pub(crate) struct Proof<'a> {
    plan: &'a SurfacePlan,
    report: CheckReport,
    /// First position and normal seen of each shared key.
    shared: HashMap<VertexKey, (Bits, Bits)>,
    border: HashMap<BorderEdge, u32>,
    /// Directed edges between positions, and whether the edge lies on the boundary of the surface.
    welded: HashMap<(Bits, Bits), (u32, bool)>,
    /// Whether nothing more is to come of each patch.
    drawn: Vec<bool>,
}

impl<'a> Proof<'a> {
    pub(crate) fn new(plan: &'a SurfacePlan) -> Self {
        let mut drawn = vec![true; plan.patches.len()];
        plan.drawn().for_each(|run| drawn[run.start as usize..run.end as usize].fill(false));
        Self {
            plan,
            report: CheckReport::default(),
            shared: HashMap::new(),
            border: HashMap::new(),
            welded: HashMap::new(),
            drawn,
        }
    }

    /// Takes all triangles of a surface.
    pub(crate) fn add_surface(&mut self, surface: &Surface, tessellation: &Tessellation) -> Result<(), EngineError> {
        if surface.captures_in_compute(tessellation) {
            return self.add_grids(surface, tessellation);
        }
        surface.capture(tessellation, |vertices| {
            self.add(vertices);
            Ok(())
        })
    }

    /// Takes the grids of the compute evaluator in both layouts.
    fn add_grids(&mut self, surface: &Surface, tessellation: &Tessellation) -> Result<(), EngineError> {
        let rates = surface.grid_rates(tessellation)?;
        let frame = surface.undrawn_frame(tessellation).upload(surface.engine().device())?;
        let grids = |layout| Grids::read(surface, &rates, layout);
        let (own_grids, shared_grids) = (grids(Layout::Own)?, grids(Layout::Shared)?);
        for (own, shared) in own_grids.chunks().zip(shared_grids.chunks()) {
            let (own, shared) = (own?, shared?);
            let own_vertices = own_grids.run(&own, &frame)?;
            hand_out(&own.indices, &own_vertices, |vertices| {
                self.add(vertices);
                Ok::<(), EngineError>(())
            })?;
            let own_mesh = Mesh { vertices: &own_vertices, indices: &own.indices };
            let shared_vertices = shared_grids.run(&shared, &frame)?;
            let shared_mesh = Mesh { vertices: &shared_vertices, indices: &shared.indices };
            compare(self.plan, own.patches.clone(), &own_mesh, &shared_mesh, &mut self.report);
        }
        Ok(())
    }

    /// Takes whole patches.
    fn add(&mut self, vertices: &[CapturedVertex]) {
        for patch in vertices.chunk_by(|a, b| a.patch == b.patch) {
            let drawn = self.drawn.get_mut(patch[0].patch as usize);
            let first_time = drawn.is_some_and(|drawn| !std::mem::replace(drawn, true));
            if first_time && patch.len() % 3 == 0 {
                self.add_patch(patch);
            } else {
                self.report.wrong_patches += 1;
            }
        }
    }

    fn add_patch(&mut self, vertices: &[CapturedVertex]) {
        let mut local: HashMap<[u32; 2], u32> = HashMap::new();
        let mut points: Vec<&CapturedVertex> = Vec::new();
        let mut edges = Vec::with_capacity(vertices.len());
        for triangle in vertices.chunks_exact(3) {
            self.report.triangles += 1;
            let area = parameter_area(triangle);
            if area == 0.0 {
                self.report.degenerate += 1;
            } else if area < 0.0 {
                self.report.inverted += 1;
            }
            let ids = [0, 1, 2].map(|i| {
                let vertex = &triangle[i];
                let id = *local.entry(vertex.uv.map(f32::to_bits)).or_insert_with(|| {
                    points.push(vertex);
                    (points.len() - 1) as u32
                });
                self.compare(points[id as usize], vertex);
                id
            });
            // A triangle with a repeated vertex (fractional spacing makes some) covers nothing and bounds nothing.
            if ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0] {
                edges.extend([(ids[0], ids[1]), (ids[1], ids[2]), (ids[2], ids[0])]);
            }
        }
        for point in &points {
            self.add_shared(point);
        }
        self.close_patch(&points, edges);
    }

    /// Two vertices of one patch at the same (u,v).
    fn compare(&mut self, first: &CapturedVertex, again: &CapturedVertex) {
        self.report.split_positions += u64::from(bits(first.position) != bits(again.position));
        self.report.split_normals += u64::from(bits(first.normal) != bits(again.normal));
    }

    fn add_shared(&mut self, vertex: &CapturedVertex) {
        let key = VertexKey::of(self.plan, vertex);
        if matches!(key, VertexKey::Inside(..)) {
            return;
        }
        let (position, normal) = (bits(vertex.position), bits(vertex.normal));
        let first = *self.shared.entry(key).or_insert((position, normal));
        self.report.split_positions += u64::from(first.0 != position);
        self.report.split_normals += u64::from(first.1 != normal);
    }

    /// Pairs the directed edges of a patch's triangles; those left over must lie on its sides.
    fn close_patch(&mut self, points: &[&CapturedVertex], mut edges: Vec<(u32, u32)>) {
        edges.sort_unstable();
        for run in edges.chunk_by(|a, b| a == b) {
            self.report.over_shared += (run.len() - 1) as u64;
            let (a, b) = run[0];
            if edges.binary_search(&(b, a)).is_err() {
                self.add_border(points[a as usize], points[b as usize]);
            }
        }
    }

    fn add_border(&mut self, a: &CapturedVertex, b: &CapturedVertex) {
        let record = &self.plan.patches[a.patch as usize];
        let Some(side) = common_side(record, &[a.uv, b.uv]) else {
            self.report.open += 1;
            return;
        };
        let edge = record.edge[side] / 2;
        let t = |vertex: &CapturedVertex| edge_parameter(record, side, vertex.uv).to_bits();
        *self.border.entry((edge, t(a), t(b))).or_default() += 1;
        let boundary = self.plan.boundary_edges[edge as usize];
        let welded = self.welded.entry((bits(a.position), bits(b.position))).or_insert((0, boundary));
        welded.0 += 1;
        welded.1 |= boundary;
    }

    /// `boundary` is the number of boundary edges that the cage says there are: the plan must not call an edge boundary because its two patches do not
    /// find each other.
    fn finish(self, boundary: usize) -> CheckReport {
        self.end(boundary, None)
    }

    /// The same for a part of a cage, whose records have `names`: what it shares with other parts is compared with what is known of them, and left to be closed
    /// when all parts are there.
    pub(crate) fn finish_part(self, boundary: usize, names: &WholeNames, seams: &mut Seams) -> CheckReport {
        self.end(boundary, Some((names, seams)))
    }

    fn end(mut self, boundary: usize, mut seams: Option<(&WholeNames, &mut Seams)>) -> CheckReport {
        self.report.open += self.drawn_boundary_edges().abs_diff(boundary) as u64;
        self.report.wrong_patches += self.drawn.iter().filter(|&&drawn| !drawn).count() as u64;
        for (&(edge, a, b), &count) in &self.border {
            self.report.over_shared += u64::from(count - 1);
            let closed = self.border.contains_key(&(edge, b, a)) || self.plan.boundary_edges[edge as usize];
            match &mut seams {
                Some((names, seams)) if !closed && names.shared_edges[edge as usize] => {
                    *seams.border.entry((names.edges[edge as usize], a, b)).or_default() += 1;
                }
                _ => self.report.open += u64::from(!closed),
            }
        }
        for (&(a, b), &(count, boundary)) in &self.welded {
            // An edge shorter than the spacing of floats welds to a point.
            if a == b {
                continue;
            }
            let closed = boundary || self.welded.contains_key(&(b, a));
            self.report.weld.over_shared += u64::from(count > 1);
            match &mut seams {
                Some((_, seams)) if !closed => *seams.welded.entry((a, b)).or_default() += 1,
                _ => self.report.weld.open += u64::from(!closed),
            }
        }
        if let Some((names, seams)) = seams {
            self.meet(names, seams);
        }
        self.report.open += self.report.split_positions;
        self.report
    }

    /// Compares vertices that other parts have too with theirs.
    fn meet(&mut self, names: &WholeNames, seams: &mut Seams) {
        for (&key, &(position, normal)) in &self.shared {
            let name = match key {
                VertexKey::Vertex(v) if names.shared_vertices[v as usize] => {
                    WholeKey::Vertex(names.vertices[v as usize])
                }
                VertexKey::Edge(e, t) if names.shared_edges[e as usize] => WholeKey::Edge(names.edges[e as usize], t),
                _ => continue,
            };
            let first = *seams.shared.entry(name).or_insert((position, normal));
            self.report.split_positions += u64::from(first.0 != position);
            self.report.split_normals += u64::from(first.1 != normal);
        }
    }

    /// Edge records on the boundary that patches to be drawn have.
    fn drawn_boundary_edges(&self) -> usize {
        let mut boundary = self.plan.boundary_edges.clone();
        let records = self.plan.drawn().flat_map(|run| &self.plan.patches[run.start as usize..run.end as usize]);
        let edges = records.flat_map(|record| record.edge.into_iter().take(record.sides()));
        edges.filter(|edge| std::mem::take(&mut boundary[(edge / 2) as usize])).count()
    }
}

impl AddAssign for CheckReport {
    /// The report of two surfaces.
    fn add_assign(&mut self, other: Self) {
        self.triangles += other.triangles;
        self.open += other.open;
        self.over_shared += other.over_shared;
        self.split_positions += other.split_positions;
        self.split_normals += other.split_normals;
        self.inverted += other.inverted;
        self.degenerate += other.degenerate;
        self.wrong_patches += other.wrong_patches;
        self.weld.open += other.weld.open;
        self.weld.over_shared += other.weld.over_shared;
    }
}

/// Twice the signed area of a triangle in (u,v), in f64: the products of f32 differences are exact enough to tell its sign.
fn parameter_area(triangle: &[CapturedVertex]) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| triangle[i].uv.map(f64::from));
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use osculate_cage::read_obj;
    use osculate_subdiv::PlanDesc;

    use super::*;

    /// An open sheet of one quad: eight patch edges on its boundary.
    fn sheet() -> SurfacePlan {
        let cage = read_obj(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "sheet.obj").unwrap();
        SurfacePlan::build(&cage, &PlanDesc::default()).unwrap()
    }

    #[test]
    fn patches_that_are_not_drawn_are_counted() {
        let report = Proof::new(&sheet()).finish(8);
        assert_eq!((report.wrong_patches, report.open), (4, 0));
        assert!(!report.is_watertight());
    }

    #[test]
    fn a_boundary_that_the_cage_lacks_is_open() {
        assert_eq!(Proof::new(&sheet()).finish(6).open, 2);
    }

    #[test]
    fn patches_that_do_not_exist_are_counted() {
        let plan = sheet();
        let mut proof = Proof::new(&plan);
        proof.add(&[CapturedVertex { patch: 99, ..CapturedVertex::default() }; 3]);
        assert_eq!(proof.finish(8).wrong_patches, 5);
    }
}
