//! From a cage to everything the device needs to know about its connectivity.

use std::collections::BTreeSet;

use osculate_cage::{BoundaryRule, Cage, CagePart};
use rayon::prelude::*;

use crate::gather::PatchNets;
use crate::lists::PatchOrder;
use crate::needed::NeededPoints;
use crate::nets::FinalMesh;
use crate::part::FaceSizes;
use crate::patches::{LIST_VALENCES, Tag};
use crate::records::{RecordSources, assign};
use crate::unrefined::unrefined_faces;
use crate::weights::WeightTable;
use crate::whole;
use crate::{
    Connectivity, Gathers, Locator, PatchForm, PatchKind, PatchList, PatchRecord, PlanError, ProjectionSource,
    QuadConnectivity, RefineTables, Refinement, Scheme, SpokeRecord,
};

/// How to plan a cage.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlanDesc {
    /// Boundary rule; `None` takes that of the file's tags, else edge-and-corner.
    pub boundary: Option<BoundaryRule>,
    /// Scheme of the patches at extraordinary vertices.
    pub scheme: Scheme,
    /// Which faces are refined.
    pub refinement: Refinement,
}

impl PlanDesc {
    /// Whether a plan may leave faces unrefined that are refined under [`Refinement::Everywhere`]: never under [`Scheme::Gregory1`].
    pub fn may_leave_faces(&self) -> bool {
        self.refinement == Refinement::WhereNeeded && self.scheme != Scheme::Gregory1
    }
}

/// The plan of a cage: tables of its refinement steps, patches of the final mesh, sources of records.
pub struct SurfacePlan {
    /// Boundary rule in force.
    pub rule: BoundaryRule,
    /// Scheme.
    pub scheme: Scheme,
    /// Refinement steps: see [`Self::steps`].
    pub(crate) steps: u32,
    /// Points of the cage.
    pub cage_points: u32,
    /// Tables of the refinement steps; under [`Scheme::Gregory1`] then, if need be, tables of the final faces' centroids alone.
    pub levels: Vec<RefineTables>,
    /// Points in the buffer: of all levels, then phantom points.
    pub point_count: u32,
    /// Index of the first phantom point.
    pub first_phantom: u32,
    /// Phantom points: indices (a, b, c, d) stand for 2 (2a - b) - (2c - d).
    pub reflections: Vec<[u32; 4]>,
    /// Patches by kind: unrefined faces, regular, extraordinary by valence, stored. Empty lists are left out.
    pub lists: Vec<PatchList>,
    /// Nets of all patches, in list order.
    pub nets: Vec<u32>,
    /// What the shaders know of each patch.
    pub patches: Vec<PatchRecord>,
    /// Final quad of each patch; of an unrefined face the one at its first corner.
    pub quads: Vec<u32>,
    /// Patch of each final quad, [`crate::NONE`] if it is not drawn. The four children that an unrefined face would have name the same patch.
    pub patch_of_quad: Vec<u32>,
    /// Matrices of changes of basis and records, and functions of eigenbases.
    pub weights: Vec<f32>,
    /// Sources of vertex records.
    pub vertex_records: RecordSources,
    /// Sources of edge records.
    pub edge_records: RecordSources,
    /// A spoke record for each general edge record.
    pub spokes: Vec<SpokeRecord>,
    /// Sources of the coefficient buffer: control points of stored patches, then vectors of spokes.
    pub projections: Vec<ProjectionSource>,
    /// Vectors in the coefficient buffer.
    pub vector_count: u32,
    /// What is gathered from vectors in the coefficient buffer: under [`Scheme::Gregory1`] edge records and control points.
    pub gathers: Gathers,
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
        let drawn = cage.drawn_faces(rule);
        let quads_and_triangles = (0..cage.face_count()).all(|f| matches!(cage.face(f).len(), 3 | 4));
        Self::build_drawn(cage, (rule, desc), FaceSizes { quads: cage.is_quads(), quads_and_triangles }, &drawn)
    }

    /// Plans a part of a cage, of which its own faces are drawn. Everything that is computed for them, on the borders to other parts too, is what it is in a plan
    /// of the whole cage, bit for bit.
    ///
    /// # Errors
    /// As [`Self::build`], and if the rest of the cage, which it must agree with, may be refined otherwise: [`Refinement::WhereNeeded`].
    pub fn build_part(part: &CagePart, desc: &PlanDesc) -> Result<Self, PlanError> {
        if desc.may_leave_faces() {
            return Err(PlanError::UnrefinedParts);
        }
        let cage = part.cage();
        let rule = desc.boundary.or(cage.boundary_rule()).unwrap_or_default();
        let mut drawn = cage.drawn_faces(rule);
        (0..).zip(&mut drawn).for_each(|(f, drawn)| *drawn &= part.ring(f) <= 1);
        let sizes = FaceSizes { quads: part.is_of_quads(), quads_and_triangles: part.is_of_quads_and_triangles() };
        let mut plan = Self::build_drawn(cage, (rule, desc), sizes, &drawn)?;
        // Quads among other faces run through the kernel of those.
        plan.levels.iter_mut().take(1).for_each(|level| level.quads &= sizes.quads);
        plan.set_apart(part);
        if plan.drawn_count() == 0 {
            return Err(PlanError::NothingToDraw { faces: cage.face_count() });
        }
        Ok(plan)
    }

    /// Plans those faces of a cage that are to be drawn; `sizes` are those of the cage that it is a part of.
    fn build_drawn(
        cage: &Cage,
        (rule, desc): (BoundaryRule, &PlanDesc),
        sizes: FaceSizes,
        drawn: &[bool],
    ) -> Result<Self, PlanError> {
        if !drawn.contains(&true) {
            return Err(PlanError::NothingToDraw { faces: cage.face_count() });
        }
        if desc.scheme == Scheme::Gregory1 {
            return whole::build(cage, rule, u32::from(!sizes.quads_and_triangles), drawn);
        }
        let steps = if sizes.quads { 1 } else { 2 };
        check_size(cage, steps)?;
        let (base, locator) = (cage.topology(), Locator::new(cage, steps));
        let tables = RefineTables::build(base, rule, 0);
        if steps == 1 {
            return Self::finish(base, vec![tables], (rule, desc), locator, |quad| drawn[base.face(quad) as usize]);
        }
        let mesh = QuadConnectivity::refine(base);
        let second = RefineTables::build(&mesh, rule, tables.first_new);
        let levels = vec![tables, second];
        Self::finish(&mesh, levels, (rule, desc), locator, |quad| drawn[base.face(quad / 4) as usize])
    }

    /// Plans the patches of the mesh after one step on `mesh`, the last of `levels`.
    fn finish<M: Connectivity>(
        mesh: &M,
        mut levels: Vec<RefineTables>,
        (rule, desc): (BoundaryRule, &PlanDesc),
        mut locator: Locator,
        is_drawn: impl Fn(u32) -> bool + Sync,
    ) -> Result<Self, PlanError> {
        let (vertices, scheme) = (mesh.vertex_count() as u32, desc.scheme);
        let tags: Vec<Tag> = (0..vertices).into_par_iter().map(|v| Tag::of_vertex(mesh, rule, scheme, v)).collect();
        check_nets(&tags, scheme)?;
        let cage_points = levels.first().map_or(0, |level| level.vertex_count() as u32);
        let (first_old, first_point) = levels.last().map_or((0, 0), |level| (level.first_old, level.first_new));
        let unrefined = match desc.refinement {
            Refinement::Everywhere => Vec::new(),
            Refinement::WhereNeeded => unrefined_faces(mesh, &is_drawn),
        };
        let needed = leave_points(mesh, &unrefined, &is_drawn, &mut levels);
        let mesh = FinalMesh { old: mesh, first_point, first_old, tags, needed };
        let order = PatchOrder::new(&mesh, is_drawn, &unrefined);
        locator.leave(unrefined);
        let mut weights = WeightTable::default();
        let nets = PatchNets::gather(&mesh, &order, &mut weights);
        let mut projections = nets.projections.clone();
        let records = assign(&mesh, &order, &nets, &mut weights, &mut projections);
        let first_phantom = first_point + mesh.point_count() as u32;
        Ok(Self {
            rule,
            scheme,
            steps: levels.len() as u32,
            cage_points,
            levels,
            point_count: first_phantom + nets.phantoms.reflections.len() as u32,
            first_phantom,
            reflections: nets.phantoms.reflections,
            lists: nets.lists,
            nets: nets.nets,
            patches: records.patches,
            quads: order.quads,
            patch_of_quad: order.patch_of_quad,
            weights: weights.weights,
            vertex_records: records.vertices,
            edge_records: records.edges,
            spokes: records.spokes,
            projections: projections.sources,
            vector_count: projections.count,
            gathers: Gathers::default(),
            boundary_edges: records.boundary_edges,
            locator,
        })
    }

    /// Number of refinement steps, the same for the whole cage. One for cages of quads, else two; that isolates extraordinary vertices: at most corner 0 of a
    /// final quad is one. Under [`Scheme::Gregory1`] none for cages of quads and triangles, else one.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// How many patches are faces that are left unrefined: none under [`Refinement::Everywhere`].
    pub fn unrefined_count(&self) -> u32 {
        self.lists.first().filter(|list| list.kind == PatchKind::Unrefined).map_or(0, |list| list.count)
    }

    /// How many edge records are those of unrefined faces, which come first.
    pub fn whole_edge_count(&self) -> u32 {
        let unrefined = 4 * self.unrefined_count();
        self.edge_records.regular.partition_point(|&slot| slot < unrefined) as u32
    }

    /// Number of edge records: of regular nets, of other nets, gathered.
    pub fn edge_record_count(&self) -> usize {
        self.edge_records.count() + self.gathers.edges.len()
    }

    /// Number of vertex records.
    pub fn vertex_record_count(&self) -> usize {
        self.vertex_records.count()
    }

    /// Number of vectors at the start of the coefficient buffer that come from projections; control points that are gathered from them follow.
    pub fn projected_count(&self) -> u32 {
        self.gathers.patches.first().map_or(self.vector_count, |patch| patch.first)
    }

    /// Whether the surface is irregular at a corner of a patch: it has no derivatives there in general, only a tangent plane.
    pub fn is_irregular_corner(&self, patch: u32, corner: usize) -> bool {
        let record = &self.patches[patch as usize];
        if self.scheme != Scheme::Gregory1 {
            return corner == 0 && record.is_extraordinary();
        }
        let gathered = self.gathers.patches.binary_search_by_key(&record.net, |source| source.first);
        let source = gathered.ok().filter(|_| record.kind().is_stored()).map(|i| &self.gathers.patches[i]);
        source.is_some_and(|source| self.gathers.irregular[source.fan[corner] as usize])
    }

    /// Number of the first edge record that does not come from a regular net: the one of the first spoke record.
    pub fn first_general_edge(&self) -> u32 {
        self.edge_records.regular.len() as u32
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
            + size_of_val(self.spokes.as_slice())
            + size_of_val(self.projections.as_slice())
            + self.gathers.bytes()
    }
}

/// Takes the points that no patch is made of out of the last of `levels`, a step on `mesh`, if it leaves faces unrefined; returns the others.
fn leave_points<M: Connectivity>(
    mesh: &M,
    unrefined: &[bool],
    is_drawn: impl Fn(u32) -> bool + Sync,
    levels: &mut [RefineTables],
) -> Option<NeededPoints> {
    let last = levels.last_mut().filter(|_| unrefined.contains(&true))?;
    let needed = NeededPoints::new(mesh, |quad| is_drawn(quad) && !unrefined[mesh.face(quad) as usize]);
    *last = needed.tables(last);
    Some(needed)
}

/// Refuses cages whose final mesh could overflow 32-bit numbers: half-edges grow by four per step, and every final quad has four slots for records.
fn check_size(cage: &Cage, steps: u32) -> Result<(), PlanError> {
    let final_quads = (cage.topology().half_edge_count() as u64) << (2 * (steps - 1));
    let limit = u64::from(u32::MAX) / 24;
    if final_quads > limit {
        return Err(PlanError::TooLarge { what: "patches", count: final_quads, limit });
    }
    Ok(())
}

/// Refuses cages whose nets could overflow 32-bit numbers, and those with vertices of so high a valence that their nets, which grow with its square, or
/// their changes of basis, of which a boundary vertex has one per face, would fill the memory of most machines.
fn check_nets(tags: &[Tag], scheme: Scheme) -> Result<(), PlanError> {
    let points = |valence: u32| u64::from(valence) * u64::from(2 * valence + 8);
    let (count, limit) = (tags.par_iter().map(|tag| points(tag.valence())).sum(), u32::MAX.into());
    if count > limit {
        return Err(PlanError::TooLarge { what: "points of nets", count, limit });
    }
    let high = |tag: &&Tag| !LIST_VALENCES.contains(&tag.valence());
    let points = tags.par_iter().filter(high).map(|tag| points(tag.valence())).sum::<u64>();
    let kinds: BTreeSet<(bool, u32)> = tags.iter().filter(high).map(|tag| (tag.is_boundary(), tag.valence())).collect();
    let weights = kinds.into_iter().map(|(boundary, valence)| weights_at(scheme, boundary, valence)).sum::<u64>();
    if points.max(weights) > HIGH_VALENCE_LIMIT {
        let valence = tags.iter().map(|tag| tag.valence()).max().unwrap_or(0);
        return Err(PlanError::HighValence { valence, count: points.max(weights), limit: HIGH_VALENCE_LIMIT });
    }
    Ok(())
}

/// About how many weights the patches at a vertex take: every quad of a boundary vertex has its own, those of an inner vertex share theirs.
fn weights_at(scheme: Scheme, boundary: bool, valence: u32) -> u64 {
    let (quads, net) = (if boundary { u64::from(valence) } else { 1 }, u64::from(2 * valence + 8));
    let form = if boundary { scheme.boundary_form() } else { scheme.interior_form(valence) };
    let rows = match form {
        // A square matrix and 48 floats a mode; a side has a matrix nearly as large, and 8 floats a mode.
        PatchForm::Stam => 2 * net + 56,
        _ => 20,
    };
    quads * net * (rows + RECORD_ROWS)
}

/// Rows of the matrices of records: two edges, a vertex.
const RECORD_ROWS: u64 = 2 * 8 + 3;

/// Most numbers that vertices of high valence may ask for: half a gibibyte of nets or of weights.
const HIGH_VALENCE_LIMIT: u64 = 1 << 27;
