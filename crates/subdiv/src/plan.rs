//! From a cage to everything the device needs to know about its connectivity.

use osculate_cage::{BoundaryRule, Cage};
use rayon::prelude::*;

use crate::nets::{FinalMesh, Phantoms};
use crate::patches::{QuadClass, classify};
use crate::records::{PatchNet, RecordSources, assign};
use crate::weights::{Role, WeightTable};
use crate::{
    Connectivity, Locator, MatrixSource, NONE, PatchKind, PatchList, PatchRecord, PlanError, QuadConnectivity,
    RefineTables,
};

/// How to plan a cage.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlanDesc {
    /// Boundary rule; `None` takes that of the file's tags, else edge-and-corner.
    pub boundary: Option<BoundaryRule>,
}

/// The plan of a cage: tables of its refinement steps, patches of the final mesh, sources of records.
pub struct SurfacePlan {
    /// Boundary rule in force.
    pub rule: BoundaryRule,
    /// Tables of the steps: one for cages of quads, else two. That isolates extraordinary vertices: at most corner 0 of a final quad is one.
    pub levels: Vec<RefineTables>,
    /// Points in the buffer: of all levels, then phantom points.
    pub point_count: u32,
    /// Index of the first phantom point.
    pub first_phantom: u32,
    /// Phantom points: indices (a, b, c, d) stand for 2 (2a - b) - (2c - d).
    pub reflections: Vec<[u32; 4]>,
    /// Patches by kind: regular, extraordinary by valence, coefficients. Empty lists are left out.
    pub lists: Vec<PatchList>,
    /// Nets of all patches, in list order.
    pub nets: Vec<u32>,
    /// What the shaders know of each patch.
    pub patches: Vec<PatchRecord>,
    /// Final quad of each patch.
    pub quads: Vec<u32>,
    /// Patch of each final quad, [`NONE`] if it is not drawn.
    pub patch_of_quad: Vec<u32>,
    /// Matrices of changes of basis and records.
    pub weights: Vec<f32>,
    /// Sources of vertex records.
    pub vertex_records: RecordSources,
    /// Sources of edge records.
    pub edge_records: RecordSources,
    /// Sources of the coefficient list's Gregory points.
    pub coefficients: Vec<MatrixSource>,
    /// Whether each edge record belongs to one drawn patch only: the boundary of what is drawn.
    pub boundary_edges: Vec<bool>,
    /// From final quads to base faces and back.
    pub locator: Locator,
}

impl SurfacePlan {
    /// Plans a cage.
    ///
    /// # Errors
    /// If the refined mesh is too large for 32-bit indices, or no face is left to draw.
    pub fn build(cage: &Cage, desc: &PlanDesc) -> Result<Self, PlanError> {
        let rule = desc.boundary.or(cage.boundary_rule()).unwrap_or_default();
        let steps = if cage.is_quads() { 1 } else { 2 };
        check_size(cage, steps)?;
        let base = cage.topology();
        let mut levels = vec![RefineTables::build(base, rule, 0)];
        let mut mesh = QuadConnectivity::refine(base);
        for _ in 1..steps {
            let first = levels.last().map_or(0, |level| level.first_new);
            levels.push(RefineTables::build(&mesh, rule, first));
            mesh = QuadConnectivity::refine(&mesh);
        }
        let first_point = levels.last().map_or(0, |level| level.first_new);
        let locator = Locator::new(cage, steps);
        let drawn = drawn_faces(cage, rule);
        if !drawn.contains(&true) {
            return Err(PlanError::NothingToDraw { faces: cage.face_count() });
        }
        let final_mesh = FinalMesh { mesh: &mesh, first_point };
        Ok(Patches::gather(&final_mesh, rule, |quad| drawn[locator.base_face(quad) as usize])
            .finish(&mesh, rule, levels, locator))
    }

    /// Number of refinement steps.
    pub fn steps(&self) -> u32 {
        self.levels.len() as u32
    }

    /// Number of coefficient patches.
    pub fn coefficient_count(&self) -> usize {
        self.coefficients.len()
    }

    /// The list a patch is in.
    pub fn list_of(&self, patch: u32) -> Option<&PatchList> {
        self.lists.iter().find(|list| (list.first_patch..list.first_patch + list.count).contains(&patch))
    }

    /// Bytes of the plan's tables on the device.
    pub fn bytes(&self) -> usize {
        let tables: usize = self.levels.iter().map(RefineTables::bytes).sum();
        let sources = |records: &RecordSources| 4 * records.regular.len() + size_of_val(records.general.as_slice());
        tables
            + size_of_val(self.reflections.as_slice())
            + size_of_val(self.nets.as_slice())
            + size_of_val(self.patches.as_slice())
            + size_of_val(self.weights.as_slice())
            + sources(&self.vertex_records)
            + sources(&self.edge_records)
            + size_of_val(self.coefficients.as_slice())
    }
}

/// Faces that are drawn: not holes, and under the rule `none` not at the boundary.
fn drawn_faces(cage: &Cage, rule: BoundaryRule) -> Vec<bool> {
    let mut drawn = vec![true; cage.face_count()];
    for &hole in &cage.tags().holes {
        drawn[hole as usize] = false;
    }
    if rule == BoundaryRule::None {
        for (face, drawn) in drawn.iter_mut().enumerate() {
            *drawn &= !cage.face(face).iter().any(|&v| cage.topology().is_boundary_vertex(v));
        }
    }
    drawn
}

/// Refuses cages whose final mesh could overflow 32-bit numbers: half-edges grow by four per step, nets take about 16 indices a quad.
fn check_size(cage: &Cage, steps: u32) -> Result<(), PlanError> {
    let final_quads = (cage.topology().half_edge_count() as u64) << (2 * (steps - 1));
    let limit = u64::from(u32::MAX) / 24;
    if final_quads > limit {
        return Err(PlanError::TooLarge { what: "patches", count: final_quads, limit });
    }
    Ok(())
}

/// Patches in list order, before records are assigned.
struct Patches {
    lists: Vec<PatchList>,
    nets: Vec<u32>,
    patches: Vec<PatchRecord>,
    sources: Vec<PatchNet>,
    phantoms: Phantoms,
    weights: WeightTable,
    coefficients: Vec<MatrixSource>,
    patch_of_quad: Vec<u32>,
    first_phantom: u32,
}

impl Patches {
    fn gather(mesh: &FinalMesh<'_>, rule: BoundaryRule, is_drawn: impl Fn(u32) -> bool + Sync) -> Self {
        let quads = mesh.mesh.face_count() as u32;
        let classes: Vec<Option<QuadClass>> =
            (0..quads).into_par_iter().map(|quad| is_drawn(quad).then(|| classify(mesh, rule, quad))).collect();
        let first_phantom = mesh.first_point + mesh.mesh.vertex_count() as u32;
        let mut patches = Self {
            lists: Vec::new(),
            nets: Vec::new(),
            patches: Vec::new(),
            sources: Vec::new(),
            phantoms: Phantoms::new(first_phantom),
            weights: WeightTable::default(),
            coefficients: Vec::new(),
            patch_of_quad: vec![NONE; quads as usize],
            first_phantom,
        };
        let mut kinds: Vec<PatchKind> = classes.iter().flatten().map(|class| class.kind).collect();
        kinds.par_sort_unstable();
        kinds.dedup();
        for kind in kinds {
            let members = (0..quads).filter_map(|quad| {
                classes[quad as usize].filter(|class| class.kind == kind).map(|class| (quad, class))
            });
            patches.add_list(mesh, kind, &members.collect::<Vec<_>>());
        }
        patches
    }

    fn add_list(&mut self, mesh: &FinalMesh<'_>, kind: PatchKind, members: &[(u32, QuadClass)]) {
        let (first_patch, first_index) = (self.patches.len() as u32, self.nets.len() as u32);
        let weights = match kind {
            PatchKind::Extraordinary { valence } => {
                self.weights.offset(osculate_surface::NetKind::Interior { valence }, Role::Gregory)
            }
            _ => 0,
        };
        self.lists.push(PatchList { kind, first_patch, count: members.len() as u32, first_index, weights });
        if kind == PatchKind::Regular {
            self.gather_regular(mesh, members);
        }
        for (i, &(quad, class)) in members.iter().enumerate() {
            let net = match kind {
                PatchKind::Regular => first_index + 16 * i as u32,
                _ => self.gather_irregular(mesh, quad, class),
            };
            let net_size = class.net.net_size() as u32;
            let basis = match kind {
                PatchKind::Coefficients => self.add_coefficients(class, net, net_size),
                _ => weights,
            };
            self.patch_of_quad[quad as usize] = self.patches.len() as u32;
            let tag = PatchRecord::make_tag(kind, class.boundary, class.valence);
            self.patches.push(PatchRecord { net, basis, net_size, tag, ..PatchRecord::default() });
            self.sources.push(PatchNet { quad, net: class.net });
        }
    }

    /// Nets of the regular list: inner ones in parallel, those at the boundary one by one because they share phantom points.
    fn gather_regular(&mut self, mesh: &FinalMesh<'_>, members: &[(u32, QuadClass)]) {
        let inner: Vec<[u32; 16]> = members
            .par_iter()
            .with_min_len(1024)
            .map(|&(quad, class)| if class.boundary { [NONE; 16] } else { mesh.regular_net(quad) })
            .collect();
        for (net, &(quad, class)) in inner.iter().zip(members) {
            self.nets.extend(if class.boundary { mesh.boundary_net(quad, &mut self.phantoms) } else { *net });
        }
    }

    fn gather_irregular(&mut self, mesh: &FinalMesh<'_>, quad: u32, class: QuadClass) -> u32 {
        let first = self.nets.len() as u32;
        if class.boundary {
            self.nets.extend(mesh.sector_net(quad));
        } else {
            self.nets.extend(mesh.interior_net(quad));
        }
        first
    }

    fn add_coefficients(&mut self, class: QuadClass, net: u32, columns: u32) -> u32 {
        let weights = self.weights.offset(class.net, Role::Gregory);
        self.coefficients.push(MatrixSource { net, weights, columns });
        (self.coefficients.len() - 1) as u32
    }

    fn finish(
        mut self,
        mesh: &QuadConnectivity,
        rule: BoundaryRule,
        levels: Vec<RefineTables>,
        locator: Locator,
    ) -> SurfacePlan {
        let (vertex_records, edge_records) = assign(mesh, &self.sources, &mut self.patches, &mut self.weights);
        let boundary_edges = boundary_edges(&self.patches, edge_records.count());
        SurfacePlan {
            rule,
            levels,
            point_count: self.first_phantom + self.phantoms.reflections.len() as u32,
            first_phantom: self.first_phantom,
            reflections: self.phantoms.reflections,
            lists: self.lists,
            nets: self.nets,
            patches: self.patches,
            quads: self.sources.iter().map(|source| source.quad).collect(),
            patch_of_quad: self.patch_of_quad,
            weights: self.weights.weights,
            vertex_records,
            edge_records,
            coefficients: self.coefficients,
            boundary_edges,
            locator,
        }
    }
}

/// Whether each edge record belongs to one drawn patch only.
fn boundary_edges(patches: &[PatchRecord], count: usize) -> Vec<bool> {
    let mut uses = vec![0u8; count];
    for edge in patches.iter().flat_map(|patch| patch.edge) {
        uses[(edge / 2) as usize] += 1;
    }
    uses.into_iter().map(|n| n == 1).collect()
}
