//! A plan's tables on the device.

use bytemuck::{NoUninit, cast_slice};
use osculate_gpu::{Bindings, Buffer, BufferDesc, BufferUsage, Device, Memory};
use osculate_shaders::{binding, constant};
use osculate_subdiv::SurfacePlan;

use crate::EngineError;

/// Tables of one refinement level.
pub(crate) struct LevelBuffers {
    /// Spans and indices of faces.
    pub(crate) face: Bindings,
    /// The face table as quadruples for the edge kernel, and the edge table.
    pub(crate) edge: Bindings,
    /// Spans and indices of vertices.
    pub(crate) vertex: Bindings,
}

/// All buffers of a surface. Each kernel takes the bindings that fit it; all of them hold the common buffers.
pub(crate) struct SurfaceBuffers {
    /// Where the host writes the cage's points.
    pub(crate) staging: Buffer,
    pub(crate) points: Buffer,
    pub(crate) vertex_records: Buffer,
    pub(crate) edge_records: Buffer,
    pub(crate) coefficients: Buffer,
    pub(crate) levels: Vec<LevelBuffers>,
    pub(crate) phantom: Bindings,
    pub(crate) vertex_regular: Bindings,
    pub(crate) vertex_general: Bindings,
    pub(crate) edge_regular: Bindings,
    pub(crate) edge_general: Bindings,
    pub(crate) edge_gathered: Bindings,
    pub(crate) patch_gathered: Bindings,
    pub(crate) projections: Bindings,
    /// What the patch stages and the sampling kernel read.
    pub(crate) patches: Bindings,
    /// Edges of the cage, for the overlay.
    pub(crate) cage_edges: Bindings,
    /// Bytes of all of them.
    pub(crate) bytes: u64,
}

/// Makes buffers, and refuses those that a shader could not see whole.
pub(crate) struct Uploader<'a> {
    device: &'a Device,
    bytes: u64,
}

impl<'a> Uploader<'a> {
    /// Has uploaded nothing yet.
    pub(crate) fn new(device: &'a Device) -> Self {
        Self { device, bytes: 0 }
    }

    fn check(&mut self, name: &str, bytes: u64) -> Result<(), EngineError> {
        let limit = self.device.info().limits.max_storage_buffer_range;
        if bytes > limit {
            let (what, device) = (name.to_owned(), self.device.info().name.clone());
            return Err(EngineError::TooLarge { what, bytes, limit, device });
        }
        self.bytes += bytes;
        Ok(())
    }

    pub(crate) fn table<T: NoUninit>(&mut self, name: &str, data: &[T]) -> Result<Buffer, EngineError> {
        self.check(name, size_of_val(data) as u64)?;
        Ok(self.device.upload(name, BufferUsage::STORAGE, data)?)
    }

    fn floats(&mut self, name: &str, count: u64) -> Result<Buffer, EngineError> {
        self.check(name, 4 * count)?;
        let desc = BufferDesc { name, size: 4 * count, usage: BufferUsage::STORAGE, memory: Memory::Device };
        Ok(self.device.buffer(&desc)?)
    }
}

impl SurfaceBuffers {
    pub(crate) fn new(device: &Device, plan: &SurfacePlan, cage_edges: &[[u32; 2]]) -> Result<Self, EngineError> {
        let mut up = Uploader::new(device);
        let points = up.floats("points", u64::from(plan.point_count) * 3)?;
        let vertex_records = up.floats(
            "vertex records",
            (plan.vertex_records.count() as u64) * u64::from(constant::VERTEX_RECORD_FLOATS),
        )?;
        let edge_records =
            up.floats("edge records", (plan.edge_record_count() as u64) * u64::from(constant::EDGE_RECORD_FLOATS))?;
        let coefficients = up.floats("coefficients", u64::from(plan.vector_count) * 3)?;
        let spokes: Vec<u32> =
            std::iter::once(plan.first_general_edge()).chain(cast_slice(&plan.spokes).iter().copied()).collect();
        let common = Bindings::new()
            .with(binding::POINTS, &points)
            .with(binding::NETS, &up.table("nets", &plan.nets)?)
            .with(binding::PATCHES, &up.table("patches", &plan.patches)?)
            .with(binding::WEIGHTS, &up.table("weights", &plan.weights)?)
            .with(binding::VERTEX_RECORDS, &vertex_records)
            .with(binding::EDGE_RECORDS, &edge_records)
            .with(binding::COEFFICIENTS, &coefficients)
            .with(binding::SPOKES, &up.table("spoke records", &spokes)?)
            .with(binding::FANS, &up.table("fans", &plan.gathers.fans)?);
        let levels = plan
            .levels
            .iter()
            .map(|tables| -> Result<LevelBuffers, EngineError> {
                let face_indices = up.table("face indices", &tables.face_indices)?;
                let spans = |bindings: Bindings, buffer: &Buffer| bindings.with(binding::SPANS, buffer);
                let indices = |buffer: &Buffer| common.clone().with(binding::INDICES, buffer);
                Ok(LevelBuffers {
                    face: spans(indices(&face_indices), &up.table("face spans", &tables.face_spans)?),
                    edge: indices(&up.table("edge indices", cast_slice::<_, u32>(&tables.edge_indices))?),
                    vertex: spans(
                        indices(&up.table("vertex indices", &tables.vertex_indices)?),
                        &up.table("vertex spans", &tables.vertex_spans)?,
                    ),
                })
            })
            .collect::<Result<_, _>>()?;
        let mut sources = |name: &str, data: &[u32]| -> Result<Bindings, EngineError> {
            Ok(common.clone().with(binding::SOURCES, &up.table(name, data)?))
        };
        let (vertices, edges) = (&plan.vertex_records, &plan.edge_records);
        Ok(Self {
            vertex_regular: sources("sources of regular vertex records", &vertices.regular)?,
            vertex_general: sources("sources of general vertex records", cast_slice(&vertices.general))?,
            edge_regular: sources("sources of regular edge records", &edges.regular)?,
            edge_general: sources("sources of general edge records", cast_slice(&edges.general))?,
            edge_gathered: sources("sources of gathered edge records", cast_slice(&plan.gathers.edges))?,
            patch_gathered: sources("sources of gathered patches", cast_slice(&plan.gathers.patches))?,
            projections: sources("sources of coefficients", cast_slice(&plan.projections))?,
            phantom: common.clone().with(binding::INDICES, &up.table("phantom points", &plan.reflections)?),
            cage_edges: common.clone().with(binding::INDICES, &up.table("cage edges", cage_edges)?),
            staging: staging(device, plan)?,
            points,
            vertex_records,
            edge_records,
            coefficients,
            levels,
            patches: common,
            bytes: up.bytes,
        })
    }
}

impl SurfaceBuffers {
    /// The same tables around points, records and coefficients of another surface, of which nothing is computed yet.
    pub(crate) fn twin(&self, device: &Device) -> Result<Self, EngineError> {
        let mut up = Uploader::new(device);
        let mut like = |buffer: &Buffer| up.floats(buffer.name(), buffer.size() / 4);
        let (points, vertex_records) = (like(&self.points)?, like(&self.vertex_records)?);
        let (edge_records, coefficients) = (like(&self.edge_records)?, like(&self.coefficients)?);
        let pose = Bindings::new()
            .with(binding::POINTS, &points)
            .with(binding::VERTEX_RECORDS, &vertex_records)
            .with(binding::EDGE_RECORDS, &edge_records)
            .with(binding::COEFFICIENTS, &coefficients);
        let posed = |tables: &Bindings| tables.clone().with_all(&pose);
        let level = |level: &LevelBuffers| LevelBuffers {
            face: posed(&level.face),
            edge: posed(&level.edge),
            vertex: posed(&level.vertex),
        };
        let (size, usage, memory) = (self.staging.size(), BufferUsage::STORAGE, Memory::Upload);
        Ok(Self {
            staging: device.buffer(&BufferDesc { name: self.staging.name(), size, usage, memory })?,
            levels: self.levels.iter().map(level).collect(),
            phantom: posed(&self.phantom),
            vertex_regular: posed(&self.vertex_regular),
            vertex_general: posed(&self.vertex_general),
            edge_regular: posed(&self.edge_regular),
            edge_general: posed(&self.edge_general),
            edge_gathered: posed(&self.edge_gathered),
            patch_gathered: posed(&self.patch_gathered),
            projections: posed(&self.projections),
            patches: posed(&self.patches),
            cage_edges: posed(&self.cage_edges),
            points,
            vertex_records,
            edge_records,
            coefficients,
            bytes: up.bytes,
        })
    }
}

fn staging(device: &Device, plan: &SurfacePlan) -> Result<Buffer, EngineError> {
    let size = 12 * u64::from(plan.cage_points);
    let desc = BufferDesc { name: "cage points", size, usage: BufferUsage::STORAGE, memory: Memory::Upload };
    Ok(device.buffer(&desc)?)
}
