//! Queries: what the GPU measures while a recording runs.

use ash::vk;

use crate::{Device, GpuError, Recording, owned::Owned, recording::Pass};

/// All pipeline statistics but compute invocations: that one crashes Mesa's llvmpipe in a graphics pass.
const STATISTICS: vk::QueryPipelineStatisticFlags = vk::QueryPipelineStatisticFlags::from_raw(0x3ff);

/// Counts of a render or capture pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct PassStatistics {
    /// Vertices (or patch points) that went in.
    pub input_vertices: u64,
    /// Primitives (or patches) that went in.
    pub input_primitives: u64,
    /// Runs of the vertex shader.
    pub vertex_invocations: u64,
    /// Patches that the tessellation control shader ran on.
    pub control_patches: u64,
    /// Runs of the tessellation evaluation shader.
    pub evaluation_invocations: u64,
    /// Primitives that reached clipping.
    pub clipping_invocations: u64,
    /// Primitives that clipping let through.
    pub clipping_primitives: u64,
    /// Runs of the fragment shader.
    pub fragment_invocations: u64,
}

impl PassStatistics {
    /// From Vulkan's order of the counters in [`STATISTICS`].
    fn new(counters: [u64; 10]) -> Self {
        let [input_vertices, input_primitives, vertex_invocations, _, _, clipping_invocations, clipping_primitives, ..] =
            counters;
        let [.., fragment_invocations, control_patches, evaluation_invocations] = counters;
        Self {
            input_vertices,
            input_primitives,
            vertex_invocations,
            control_patches,
            evaluation_invocations,
            clipping_invocations,
            clipping_primitives,
            fragment_invocations,
        }
    }
}

/// What became of a submission.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Report {
    /// Name and GPU time in nanoseconds of every pass, in order; empty unless measured.
    pub timings: Vec<(String, u64)>,
    /// Name and counts of every render and capture pass, in order; empty unless measured.
    pub statistics: Vec<(String, PassStatistics)>,
    /// Name of every capture pass, and the primitives it wrote, in order.
    pub captures: Vec<(String, u64)>,
}

/// The queries of one submission: for each kind a pool and the passes that have a query in it, ascending.
pub(crate) struct Queries {
    names: Vec<String>,
    timestamps: Option<Owned<vk::QueryPool>>,
    statistics: Option<Pool>,
    captures: Option<Pool>,
}

struct Pool {
    raw: Owned<vk::QueryPool>,
    passes: Vec<u32>,
}

impl Pool {
    fn query(&self, pass: u32) -> Option<(vk::QueryPool, u32)> {
        let query = self.passes.binary_search(&pass).ok()?;
        Some((self.raw.raw, query as u32))
    }
}

impl Queries {
    /// Makes the pools that a recording needs.
    pub(crate) fn new(device: &Device, recording: &Recording) -> Result<Self, GpuError> {
        let which = |wanted: fn(&Pass) -> bool| -> Vec<u32> {
            (0..).zip(&recording.passes).filter(|(_, pass)| wanted(pass)).map(|(index, _)| index).collect()
        };
        let info = device.info();
        let (mut timestamps, mut statistics) = (None, None);
        if recording.measure.timings && info.limits.timestamp_period > 0.0 {
            timestamps = Some(create(device, vk::QueryType::TIMESTAMP, recording.len() + 1, "timings")?);
        }
        if recording.measure.statistics && info.features.pipeline_statistics {
            let passes = which(|pass| matches!(pass, Pass::Render(_) | Pass::Capture(_)));
            statistics = pool(device, vk::QueryType::PIPELINE_STATISTICS, passes, "statistics")?;
        }
        let passes = which(|pass| matches!(pass, Pass::Capture(_)));
        let captures = pool(device, vk::QueryType::TRANSFORM_FEEDBACK_STREAM_EXT, passes, "captures")?;
        Ok(Self { names: recording.passes.iter().map(Pass::name).collect(), timestamps, statistics, captures })
    }

    /// None at all.
    pub(crate) fn none() -> Self {
        Self { names: Vec::new(), timestamps: None, statistics: None, captures: None }
    }

    /// Every pool with its number of queries.
    pub(crate) fn pools(&self) -> impl Iterator<Item = (vk::QueryPool, u32)> + '_ {
        let timestamps = self.timestamps.iter().map(|pool| (pool.raw, self.names.len() as u32 + 1));
        let others = self.statistics.iter().chain(&self.captures).map(|pool| (pool.raw.raw, pool.passes.len() as u32));
        timestamps.chain(others)
    }

    pub(crate) fn timestamps(&self) -> Option<vk::QueryPool> {
        self.timestamps.as_ref().map(|pool| pool.raw)
    }

    pub(crate) fn statistics(&self, pass: u32) -> Option<(vk::QueryPool, u32)> {
        self.statistics.as_ref()?.query(pass)
    }

    pub(crate) fn capture(&self, pass: u32) -> Option<(vk::QueryPool, u32)> {
        self.captures.as_ref()?.query(pass)
    }

    /// Reads all results; the submission must be complete.
    pub(crate) fn report(&self, device: &Device) -> Result<Report, GpuError> {
        let mut report = Report::default();
        if let Some(pool) = &self.timestamps {
            let ticks = results::<u64>(device, pool.raw, self.names.len() + 1)?;
            report.timings = self.names.iter().cloned().zip(intervals(&ticks, device)).collect();
        }
        if let Some(pool) = &self.statistics {
            let counters = results::<[u64; 10]>(device, pool.raw.raw, pool.passes.len())?;
            report.statistics = self.named(pool).zip(counters.into_iter().map(PassStatistics::new)).collect();
        }
        if let Some(pool) = &self.captures {
            let counts = results::<[u64; 2]>(device, pool.raw.raw, pool.passes.len())?;
            for (pass, [written, needed]) in self.named(pool).zip(counts) {
                if written < needed {
                    return Err(GpuError::CaptureOverflow { pass, needed, written });
                }
                report.captures.push((pass, written));
            }
        }
        Ok(report)
    }

    /// The names of the passes with a query in the pool.
    fn named<'a>(&'a self, pool: &'a Pool) -> impl Iterator<Item = String> + 'a {
        pool.passes.iter().map(|&pass| self.names[pass as usize].clone())
    }
}

/// Nanoseconds between successive times, which wrap at the queue's number of valid bits.
fn intervals(ticks: &[u64], device: &Device) -> Vec<u64> {
    let (mask, period) = (device.shared.timestamp_mask, f64::from(device.info().limits.timestamp_period));
    ticks.windows(2).map(|pair| ((pair[1].wrapping_sub(pair[0]) & mask) as f64 * period) as u64).collect()
}

fn pool(device: &Device, kind: vk::QueryType, passes: Vec<u32>, name: &str) -> Result<Option<Pool>, GpuError> {
    if passes.is_empty() {
        return Ok(None);
    }
    Ok(Some(Pool { raw: create(device, kind, passes.len(), name)?, passes }))
}

fn create(device: &Device, kind: vk::QueryType, count: usize, name: &str) -> Result<Owned<vk::QueryPool>, GpuError> {
    let mut info = vk::QueryPoolCreateInfo::default().query_type(kind).query_count(count as u32);
    if kind == vk::QueryType::PIPELINE_STATISTICS {
        info = info.pipeline_statistics(STATISTICS);
    }
    // SAFETY: the count is not zero, and callers ask only for kinds whose feature is switched on.
    let raw = unsafe { device.raw().create_query_pool(&info, None) }
        .map_err(|result| GpuError::from_vulkan(format!("creating queries for {name}"), result))?;
    Ok(Owned::new(&device.shared.raw, raw, name))
}

fn results<T: Copy + Default>(device: &Device, pool: vk::QueryPool, count: usize) -> Result<Vec<T>, GpuError> {
    let mut data = vec![T::default(); count];
    let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
    // SAFETY: the pool has so many queries, all written by the completed submission, and `T` is as many 64-bit numbers as each
    // of them yields.
    unsafe { device.raw().get_query_pool_results(pool, 0, &mut data, flags) }
        .map_err(|result| GpuError::from_vulkan("reading queries", result))?;
    Ok(data)
}
