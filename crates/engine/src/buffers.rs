//! A plan's tables on the device.

use bytemuck::{NoUninit, cast_slice};
use osculate_gpu::{Bindings, Buffer, BufferDesc, BufferUsage, Device, Limits, Memory, TexelFormat};
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

    fn check(&mut self, name: &str, bytes: u64, access: Access) -> Result<(), EngineError> {
        let limit = access.most_bytes(&self.device.info().limits);
        if bytes > limit {
            let (what, device) = (name.to_owned(), self.device.info().name.clone());
            return Err(EngineError::TooLarge { what, bytes, limit, device });
        }
        self.bytes += bytes;
        Ok(())
    }

    /// A table that shaders read as a storage buffer.
    pub(crate) fn table<T: NoUninit>(&mut self, name: &str, data: &[T]) -> Result<Buffer, EngineError> {
        self.upload(name, Access::Storage, data)
    }

    /// A table that shaders read as an array of vectors; of several formats, `format` is the smallest.
    fn texels<T: NoUninit>(&mut self, name: &str, data: &[T], format: TexelFormat) -> Result<Buffer, EngineError> {
        self.upload(name, Access::Texels(format), data)
    }

    fn upload<T: NoUninit>(&mut self, name: &str, access: Access, data: &[T]) -> Result<Buffer, EngineError> {
        self.check(name, size_of_val(data) as u64, access)?;
        Ok(self.device.upload(name, access.usage(), data)?)
    }

    /// Vectors that shaders compute, of `count` floats in all: they write storage buffers, and read arrays of vectors.
    fn floats(&mut self, name: &str, count: u64) -> Result<Buffer, EngineError> {
        let (size, access) = (4 * count, Access::Both(TexelFormat::Rgb32Float));
        self.check(name, size, access)?;
        let desc = BufferDesc { name, size, usage: access.usage(), memory: Memory::Device };
        Ok(self.device.buffer(&desc)?)
    }
}

/// How shaders get at a buffer.
#[derive(Clone, Copy)]
enum Access {
    Storage,
    Texels(TexelFormat),
    Both(TexelFormat),
}

impl Access {
    fn usage(self) -> BufferUsage {
        match self {
            Self::Storage => BufferUsage::STORAGE,
            Self::Texels(_) => BufferUsage::TEXELS,
            Self::Both(_) => BufferUsage::STORAGE | BufferUsage::TEXELS,
        }
    }

    /// Bytes of the largest buffer that a shader sees whole.
    fn most_bytes(self, limits: &Limits) -> u64 {
        let texels = |format: TexelFormat| limits.max_texels.saturating_mul(format.bytes());
        match self {
            Self::Storage => limits.max_storage_buffer_range,
            Self::Texels(format) => texels(format),
            Self::Both(format) => texels(format).min(limits.max_storage_buffer_range),
        }
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
        let (number, four, float) = (TexelFormat::R32Uint, TexelFormat::Rgba32Uint, TexelFormat::R32Float);
        let common = computed(&points, &vertex_records, &edge_records, &coefficients)
            .with_texels(binding::NETS, &up.texels("nets", &plan.nets, number)?, number)
            .with_texels(binding::PATCHES, &up.texels("patches", &plan.patches, four)?, four)
            .with_texels(binding::WEIGHTS, &up.texels("weights", &plan.weights, float)?, float)
            .with(binding::SPOKES, &up.table("spoke records", &spokes)?)
            .with(binding::FANS, &up.table("fans", &plan.gathers.fans)?);
        let levels = plan
            .levels
            .iter()
            .map(|tables| -> Result<LevelBuffers, EngineError> {
                let mut rows = |name: &str, spans: &[[u32; 2]], indices: &[u32]| -> Result<Bindings, EngineError> {
                    let spans = up.texels(&format!("{name} spans"), spans, TexelFormat::Rg32Uint)?;
                    let indices = up.texels(&format!("{name} indices"), indices, number)?;
                    let rows = common.clone().with_texels(binding::SPANS, &spans, TexelFormat::Rg32Uint);
                    let rows = rows.with_texels(binding::INDICES, &indices, number);
                    // Faces of four points run through the kernel of edges.
                    Ok(rows.with_texels(binding::QUADRUPLES, &indices, four))
                };
                Ok(LevelBuffers {
                    face: rows("face", &tables.face_spans, &tables.face_indices)?,
                    vertex: rows("vertex", &tables.vertex_spans, &tables.vertex_indices)?,
                    edge: common.clone().with_texels(
                        binding::QUADRUPLES,
                        &up.texels("edge indices", &tables.edge_indices, four)?,
                        four,
                    ),
                })
            })
            .collect::<Result<_, _>>()?;
        let mut sources = |name: &str, data: &[u32]| -> Result<Bindings, EngineError> {
            Ok(common.clone().with(binding::SOURCES, &up.table(name, data)?))
        };
        let (vertices, edges) = (&plan.vertex_records, &plan.edge_records);
        let (vertex_general, edge_general) = (
            sources("sources of general vertex records", cast_slice(&vertices.general))?,
            sources("sources of general edge records", cast_slice(&edges.general))?,
        );
        let (edge_gathered, patch_gathered) = (
            sources("sources of gathered edge records", cast_slice(&plan.gathers.edges))?,
            sources("sources of gathered patches", cast_slice(&plan.gathers.patches))?,
        );
        let projections = sources("sources of coefficients", cast_slice(&plan.projections))?;
        let mut read = |binding, name: &str, format, data: &[u32]| -> Result<Bindings, EngineError> {
            Ok(common.clone().with_texels(binding, &up.texels(name, data, format)?, format))
        };
        let regular = binding::REGULAR_SOURCES;
        let reflections = cast_slice(&plan.reflections);
        Ok(Self {
            vertex_regular: read(regular, "sources of regular vertex records", number, &vertices.regular)?,
            edge_regular: read(regular, "sources of regular edge records", number, &edges.regular)?,
            phantom: read(binding::QUADRUPLES, "phantom points", four, reflections)?,
            cage_edges: read(binding::INDICES, "cage edges", number, cast_slice(cage_edges))?,
            vertex_general,
            edge_general,
            edge_gathered,
            patch_gathered,
            projections,
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
        let pose = computed(&points, &vertex_records, &edge_records, &coefficients);
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

/// What shaders compute, for those that write it and for those that read it.
fn computed(points: &Buffer, vertex_records: &Buffer, edge_records: &Buffer, coefficients: &Buffer) -> Bindings {
    let all = [
        (points, binding::POINTS, binding::POINT_TEXELS),
        (vertex_records, binding::VERTEX_RECORDS, binding::VERTEX_RECORD_TEXELS),
        (edge_records, binding::EDGE_RECORDS, binding::EDGE_RECORD_TEXELS),
        (coefficients, binding::COEFFICIENTS, binding::COEFFICIENT_TEXELS),
    ];
    let both = |all: Bindings, (buffer, written, read)| {
        all.with(written, buffer).with_texels(read, buffer, TexelFormat::Rgb32Float)
    };
    all.into_iter().fold(Bindings::new(), both)
}

fn staging(device: &Device, plan: &SurfacePlan) -> Result<Buffer, EngineError> {
    let size = 12 * u64::from(plan.cage_points);
    let desc = BufferDesc { name: "cage points", size, usage: BufferUsage::STORAGE, memory: Memory::Upload };
    Ok(device.buffer(&desc)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buffers_are_as_large_as_each_access_to_them_allows() {
        let mut limits = Limits::default();
        (limits.max_storage_buffer_range, limits.max_texels) = (1000, 100);
        let most = |access: Access| access.most_bytes(&limits);
        assert_eq!(most(Access::Storage), 1000);
        assert_eq!([TexelFormat::R32Uint, TexelFormat::Rgba32Uint].map(|f| most(Access::Texels(f))), [400, 1600]);
        assert_eq!([TexelFormat::R32Float, TexelFormat::Rgb32Float].map(|f| most(Access::Both(f))), [400, 1000]);
    }
}
