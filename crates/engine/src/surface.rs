//! A cage on the device: its tables, its points, and the passes that bring them up to date.

use std::sync::Arc;

use glam::DVec3;
use osculate_cage::{BoundaryRule, Cage};
use osculate_gpu::{Bindings, Buffer, Recording};
use osculate_shaders::binding;
use osculate_shaders::constant::EDGE_RECORD_POINTS;
use osculate_shaders::layout::KernelPush;
use osculate_subdiv::{Place, PlanDesc, SurfacePlan};

use crate::buffers::SurfaceBuffers;
use crate::kernels::Kernel;
use crate::maps::Maps;
use crate::{CageSpace, Engine, EngineError, Refinement, Scheme};

/// How to make a surface of a cage.
#[derive(Clone, Copy, Debug, Default)]
pub struct SurfaceDesc {
    /// Scheme of the patches at extraordinary vertices.
    pub scheme: Scheme,
    /// Boundary rule; `None` takes that of the file's tags, else edge-and-corner.
    pub boundary: Option<BoundaryRule>,
    /// Which faces are refined. Where some are left as they are, frames have fewer patches, but factors must be uniform, at most 32, and equally spaced; there are no
    /// maps and no parts of cages. What asks for more fails with [`EngineError::Unrefined`].
    ///
    /// ```no_run
    /// # use osculate::{Cage, Engine, Refinement, Surface, SurfaceDesc};
    /// # fn example(engine: &Engine, cage: &Cage) -> Result<(), osculate::EngineError> {
    /// let desc = SurfaceDesc { refinement: Refinement::WhereNeeded, ..SurfaceDesc::default() };
    /// let surface = Surface::new(engine, cage, &desc)?;
    /// let whole_faces = surface.plan().unrefined_count();
    /// # Ok(()) }
    /// ```
    pub refinement: Refinement,
}

impl SurfaceDesc {
    /// How to plan its cage.
    pub(crate) fn plan(&self) -> PlanDesc {
        let Self { scheme, boundary, refinement } = *self;
        PlanDesc { boundary, scheme, refinement }
    }
}

/// A cage on the device, ready to be drawn. Clones share its tables and points, and so they move together.
#[derive(Clone)]
pub struct Surface {
    engine: Engine,
    plan: Arc<SurfacePlan>,
    space: CageSpace,
    /// Half diagonal of the cage's box in cage space.
    radius: f32,
    buffers: Arc<SurfaceBuffers>,
    cage_edge_count: u32,
    boundary_edge_count: usize,
    /// Texture coordinates, and what they are for.
    maps: Option<Arc<Maps>>,
}

impl Surface {
    /// Builds the tables of a cage, uploads them, and computes all points and records.
    ///
    /// # Errors
    /// If the cage is too large for 32-bit indices or for the device, no face is left to draw, or the device fails.
    pub fn new(engine: &Engine, cage: &Cage, desc: &SurfaceDesc) -> Result<Self, EngineError> {
        let plan = SurfacePlan::build(cage, &desc.plan())?;
        if desc.refinement != Refinement::Everywhere {
            tracing::info!("{} of {} patches are unrefined faces", plan.unrefined_count(), plan.patches.len());
        }
        Self::from_plan(engine, cage, plan, |_| true)
    }

    /// The surface of a plan of a cage, of which only some faces are its own: what it draws of the cage's edges, each once, and where it may end, is what these
    /// have.
    pub(crate) fn from_plan(
        engine: &Engine,
        cage: &Cage,
        plan: SurfacePlan,
        is_own: impl Fn(u32) -> bool,
    ) -> Result<Self, EngineError> {
        let topology = cage.topology();
        let own = topology.edge_half_edges().iter().filter(|&&h| is_own(topology.face(h)));
        let edges: Vec<[u32; 2]> = own.map(|&h| [topology.origin(h), topology.target(h)]).collect();
        let boundary_edge_count = boundary_edges(cage, plan.rule, is_own) << plan.steps();
        let mut surface = Self {
            buffers: Arc::new(SurfaceBuffers::new(engine.device(), &plan, &edges)?),
            engine: engine.clone(),
            plan: Arc::new(plan),
            radius: (cage.bounds().half_diagonal() * CageSpace::new(cage.bounds()).scale) as f32,
            space: CageSpace::new(cage.bounds()),
            cage_edge_count: edges.len() as u32,
            boundary_edge_count,
            maps: None,
        };
        surface.set_points(cage.positions())?;
        Ok(surface)
    }

    /// The same tables and points with maps.
    pub(crate) fn with(&self, maps: Maps) -> Self {
        Self { maps: Some(Arc::new(maps)), ..self.clone() }
    }

    /// Moves the cage: uploads its points and recomputes everything that follows from them. The space that the device computes in stays that of
    /// the first points.
    ///
    /// # Errors
    /// If there are not as many points as the cage has, one of them is not finite, or the device fails.
    pub fn set_points(&mut self, points: &[DVec3]) -> Result<(), EngineError> {
        self.write_points(points)?;
        let mut recording = Recording::new();
        self.record_update(&mut recording)?;
        self.engine.device().submit(&recording)?.wait()?;
        Ok(())
    }

    /// Puts new points where [`Self::record_update`] takes them from, once work that still reads the last ones is done.
    ///
    /// # Errors
    /// If there are not as many points as the cage has, or one of them is not finite.
    pub fn write_points(&self, points: &[DVec3]) -> Result<(), EngineError> {
        self.check_points(points)?;
        // Piece by piece, so that moving a cage allocates nothing.
        let mut piece = [[0.0f32; 3]; 1024];
        for (first, points) in (0..).step_by(size_of_val(&piece)).zip(points.chunks(piece.len())) {
            piece.iter_mut().zip(points).for_each(|(to, &p)| *to = self.space.enter(p).to_array());
            self.buffers.staging.write(first, &piece[..points.len()])?;
        }
        Ok(())
    }

    /// Another surface with the same tables: the same cage in another pose. Points, records and coefficients are its own, and so it moves by itself; the space that
    /// the device computes in, and maps, are those of this one.
    ///
    /// # Errors
    /// If there are not as many points as the cage has, one of them is not finite, or the device fails.
    pub fn twin(&self, points: &[DVec3]) -> Result<Self, EngineError> {
        let buffers = Arc::new(self.buffers.twin(self.engine.device())?);
        let mut twin = Self { buffers, ..self.clone() };
        twin.set_points(points)?;
        Ok(twin)
    }

    /// Adds a write of new points and the passes that bring the surface up to date with them. The points become a part of the recording, so that nothing
    /// waits, however many frames are under way: the way for recordings that are encoded into a caller's commands.
    ///
    /// # Errors
    /// If there are not as many points as the cage has, one of them is not finite, or a pipeline cannot be made.
    pub fn record_points(&self, recording: &mut Recording, points: &[DVec3]) -> Result<(), EngineError> {
        self.check_points(points)?;
        let points: Vec<[f32; 3]> = points.iter().map(|&p| self.space.enter(p).to_array()).collect();
        recording.write(&self.buffers.points, 0, &points);
        self.record_derived(recording)
    }

    /// The face of the cage on which each patch lies: for materials that differ from face to face, by the number of the patch that fragment shaders get.
    pub fn patch_faces(&self) -> Vec<u32> {
        let middle = [1.0 / 3.0; 2];
        (0..self.plan.patches.len() as u32).map(|patch| self.place(patch, middle).sub_face.face).collect()
    }

    /// Fails unless there are as many points as the cage has, all of them finite.
    fn check_points(&self, points: &[DVec3]) -> Result<(), EngineError> {
        let expected = (self.buffers.staging.size() / 12) as usize;
        if points.len() != expected {
            return Err(EngineError::PointCount { expected, found: points.len() });
        }
        match points.iter().position(|p| !p.is_finite()) {
            Some(vertex) => Err(EngineError::NotFinite { vertex }),
            None => Ok(()),
        }
    }

    /// Adds the passes that bring the surface up to date with the points of [`Self::write_points`].
    ///
    /// # Errors
    /// If a pipeline cannot be made.
    pub fn record_update(&self, recording: &mut Recording) -> Result<(), EngineError> {
        let buffers = &self.buffers;
        recording.copy_buffer(&buffers.staging, 0..buffers.staging.size(), &buffers.points, 0);
        self.record_derived(recording)
    }

    /// Adds the passes that compute refined points, phantom points, records and coefficients from the cage's points on the device,
    /// whoever put them there: [`Self::record_update`], or [`crate::Animator::record`].
    ///
    /// # Errors
    /// If a pipeline cannot be made.
    pub fn record_derived(&self, recording: &mut Recording) -> Result<(), EngineError> {
        self.record_passes(recording, [&self.buffers.vertex_regular, &self.buffers.vertex_general], true)
    }

    /// The same as [`Self::record_update`] for a drawing whose vertices are numbered by records, and which is all that wants them: vertex records go to its vertices,
    /// and those of regular edges are not made.
    pub(crate) fn record_update_of(&self, recording: &mut Recording, vertices: &Buffer) -> Result<(), EngineError> {
        let buffers = &self.buffers;
        recording.copy_buffer(&buffers.staging, 0..buffers.staging.size(), &buffers.points, 0);
        let [regular, general] = [&buffers.vertex_regular, &buffers.vertex_general]
            .map(|tables| tables.clone().with(binding::VERTEX_RECORDS, vertices));
        self.record_passes(recording, [&regular, &general], false)
    }

    /// Adds the passes of refined points, phantom points, records and coefficients: vertex records by these bindings, those of regular edges if they are wanted.
    fn record_passes(
        &self,
        recording: &mut Recording,
        vertex_tables: [&Bindings; 2],
        regular_edges: bool,
    ) -> Result<(), EngineError> {
        let plan = &self.plan;
        let mut kernels: Vec<Kernel<'_>> = (0..plan.levels.len()).flat_map(|level| self.level_kernels(level)).collect();
        kernels.extend(self.record_kernels(vertex_tables, regular_edges));
        kernels.retain(|kernel| kernel.threads > 0);
        self.engine.prepare(kernels.iter().map(|kernel| kernel.shader), [])?;
        kernels.into_iter().try_for_each(|kernel| kernel.record(&self.engine, recording))
    }

    /// The three kernels of a refinement step. Faces run through their own kernel or, all being quads, through that of edges.
    fn level_kernels(&self, level: usize) -> [Kernel<'_>; 3] {
        let (tables, buffers) = (&self.plan.levels[level], &self.buffers.levels[level]);
        let (faces, edges, vertices) =
            (tables.face_count() as u32, tables.edge_count() as u32, tables.vertex_count() as u32);
        let face_shader = if tables.quads { "subdivide/edge.comp" } else { "subdivide/face.comp" };
        let vertex_shader = if tables.old_in_rows { "subdivide/vertex.comp#listed" } else { "subdivide/vertex.comp" };
        let first_edge = tables.first_new + faces;
        [
            (face_shader, &buffers.face, faces, tables.first_new),
            ("subdivide/edge.comp", &buffers.edge, edges, first_edge),
            (vertex_shader, &buffers.vertex, vertices, first_edge + edges),
        ]
        .map(|(shader, bindings, count, first)| {
            let push = KernelPush { count, first, old_distance: tables.old_distance() };
            Kernel { shader, bindings, push, threads: count }
        })
    }

    /// The kernels of what is made from the points of the last level.
    fn record_kernels<'a>(&'a self, vertex_tables: [&'a Bindings; 2], regular_edges: bool) -> [Kernel<'a>; 8] {
        let (plan, buffers) = (&self.plan, &self.buffers);
        let (vertices, edges) = (&plan.vertex_records, &plan.edge_records);
        let regular_count = if regular_edges { edges.regular.len() } else { 0 };
        let per_element = |shader, bindings, count: usize, first: u32| (shader, bindings, count as u32, first, 1);
        [
            per_element("records/phantom.comp", &buffers.phantom, plan.reflections.len(), plan.first_phantom),
            per_element("records/vertex_regular.comp", vertex_tables[0], vertices.regular.len(), 0),
            per_element(
                "records/vertex_general.comp",
                vertex_tables[1],
                vertices.general.len(),
                vertices.regular.len() as u32,
            ),
            per_element("records/edge_regular.comp", &buffers.edge_regular, regular_count, 0),
            // One thread for each control point.
            (
                "records/edge_general.comp",
                &buffers.edge_general,
                edges.general.len() as u32,
                edges.regular.len() as u32,
                EDGE_RECORD_POINTS,
            ),
            per_element("records/coefficients.comp", &buffers.projections, plan.projected_count() as usize, 0),
            per_element(
                "records/edge_gathered.comp",
                &buffers.edge_gathered,
                plan.gathers.edges.len(),
                edges.count() as u32,
            ),
            // One thread for each corner.
            ("records/patch_gathered.comp", &buffers.patch_gathered, plan.gathers.patches.len() as u32, 0, 4),
        ]
        .map(|(shader, bindings, count, first, threads_each)| {
            let push = KernelPush { count, first, old_distance: 0 };
            Kernel { shader, bindings, push, threads: count * threads_each }
        })
    }

    /// The engine it lives on.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    /// Its tables and patches.
    pub fn plan(&self) -> &SurfacePlan {
        &self.plan
    }

    /// Its scheme.
    pub fn scheme(&self) -> Scheme {
        self.plan.scheme
    }

    /// The coordinates that the device computes in.
    pub fn space(&self) -> &CageSpace {
        &self.space
    }

    /// Bytes of its tables, points and records on the device.
    pub fn bytes(&self) -> u64 {
        self.buffers.bytes
    }

    /// Where a point of a patch lies on the cage.
    ///
    /// # Panics
    /// If there is no such patch.
    pub fn place(&self, patch: u32, uv: [f64; 2]) -> Place {
        self.plan.locator.place(self.plan.quads[patch as usize], uv)
    }

    /// All points on the device, in cage space: the cage's, those of each level, phantom points. For tests and tools.
    ///
    /// # Errors
    /// If the device fails.
    pub fn read_points(&self) -> Result<Vec<[f32; 3]>, EngineError> {
        Ok(self.engine.device().download(&self.buffers.points, ..)?)
    }

    /// All vertex records: position and normal of each, in cage space. For tests and tools.
    ///
    /// # Errors
    /// If the device fails.
    pub fn read_vertex_records(&self) -> Result<Vec<[f32; 3]>, EngineError> {
        Ok(self.engine.device().download(&self.buffers.vertex_records, ..)?)
    }

    /// All edge records: eight control points of each, in cage space. For tests and tools.
    ///
    /// # Errors
    /// If the device fails.
    pub fn read_edge_records(&self) -> Result<Vec<[f32; 3]>, EngineError> {
        Ok(self.engine.device().download(&self.buffers.edge_records, ..)?)
    }

    /// All vectors in the coefficient buffer, in cage space. For tests and tools.
    ///
    /// # Errors
    /// If the device fails.
    pub fn read_coefficients(&self) -> Result<Vec<[f32; 3]>, EngineError> {
        Ok(self.engine.device().download(&self.buffers.coefficients, ..)?)
    }

    pub(crate) fn maps(&self) -> Option<&Maps> {
        self.maps.as_deref()
    }

    pub(crate) fn buffers(&self) -> &SurfaceBuffers {
        &self.buffers
    }

    pub(crate) fn radius(&self) -> f32 {
        self.radius
    }

    /// Patch edges on the boundary of what is drawn, as the cage has them: each step halves its edges.
    pub(crate) fn boundary_edge_count(&self) -> usize {
        self.boundary_edge_count
    }

    pub(crate) fn cage_edge_count(&self) -> u32 {
        self.cage_edge_count
    }
}

/// Edges of the cage with a drawn face on one side only, which is an own one.
fn boundary_edges(cage: &Cage, rule: BoundaryRule, is_own: impl Fn(u32) -> bool) -> usize {
    let (topology, drawn) = (cage.topology(), cage.drawn_faces(rule));
    let is_drawn = |h: u32| h != osculate_cage::NONE && drawn[topology.face(h) as usize];
    let ends_at = |h: u32, other: u32| is_drawn(h) && is_own(topology.face(h)) && !is_drawn(other);
    let ends = |&&h: &&u32| ends_at(h, topology.twin(h)) || ends_at(topology.twin(h), h);
    topology.edge_half_edges().iter().filter(ends).count()
}
