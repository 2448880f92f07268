//! The triangles that the device makes: those of the tessellator by transform feedback, those of the compute evaluator from its buffers.

use bytemuck::{Pod, Zeroable};
use osculate_gpu::{BufferDesc, BufferUsage, CapturePass, Memory, Recording};
use osculate_shaders::binding;

use crate::draw::{Division, Output, runs};
use crate::grid::Layout;
use crate::pipelines::NO_KERNELS;
use crate::{EngineError, Evaluator, Surface, Tessellation};

/// A vertex of a captured triangle, as the evaluation stage wrote it (shaders/include/evaluation_stage.glsl).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct CapturedVertex {
    /// Position in cage space.
    pub position: [f32; 3],
    /// Unit normal, or zero where there is none.
    pub normal: [f32; 3],
    /// Parameters in the patch.
    pub uv: [f32; 2],
    /// Number of the patch.
    pub patch: u32,
}

/// Most bytes captured at once: a big export is gigabytes.
const CHUNK_BYTES: u64 = 64 << 20;

/// About how many vertices are handed out at once where they need not be captured.
const PART_VERTICES: usize = 1 << 20;

/// Most bytes that a patch can fill: two triangles a cell, three vertices each.
fn patch_bytes(segments: u32) -> u64 {
    // The tessellator may add a ring of thin triangles under fractional spacing.
    let cells = u64::from(segments + 1) * u64::from(segments + 1);
    2 * cells * 3 * size_of::<CapturedVertex>() as u64
}

/// Hands the triangles of whole patches to `sink`, three vertices each; every patch has its own vertices.
pub(crate) fn hand_out<E>(
    indices: &[u32],
    vertices: &[CapturedVertex],
    mut sink: impl FnMut(&[CapturedVertex]) -> Result<(), E>,
) -> Result<(), E> {
    let vertex = |&index: &u32| vertices[index as usize];
    let mut part: Vec<CapturedVertex> = Vec::new();
    for patch in indices.chunk_by(|a, b| vertex(a).patch == vertex(b).patch) {
        part.extend(patch.iter().map(vertex));
        if part.len() >= PART_VERTICES {
            sink(&part)?;
            part.clear();
        }
    }
    if part.is_empty() { Ok(()) } else { sink(&part) }
}

impl Surface {
    /// Cuts the surface into triangles in memory: hands whole patches' triangles, three own vertices each, in draw order, to `sink`, chunk by chunk.
    ///
    /// # Errors
    /// If the level is out of range, the tessellator is asked for and the device has no transform feedback, or it fails; and whatever `sink` returns.
    pub fn capture<E: From<EngineError>>(
        &self,
        tessellation: &Tessellation,
        mut sink: impl FnMut(&[CapturedVertex]) -> Result<(), E>,
    ) -> Result<(), E> {
        if !self.captures_in_compute(tessellation) {
            return self.capture_tessellator(tessellation, sink);
        }
        self.evaluate_grids(tessellation, Layout::Own, |chunk, vertices| hand_out(&chunk.indices, vertices, &mut sink))
    }

    /// Whether compute kernels hand out the triangles.
    pub(crate) fn captures_in_compute(&self, tessellation: &Tessellation) -> bool {
        match tessellation.evaluator {
            Evaluator::Auto => {
                let has = self.engine().device().info().features;
                !(has.transform_feedback && has.tessellation)
            }
            Evaluator::Tessellator => false,
            Evaluator::Compute => true,
        }
    }

    fn capture_tessellator<E: From<EngineError>>(
        &self,
        tessellation: &Tessellation,
        mut sink: impl FnMut(&[CapturedVertex]) -> Result<(), E>,
    ) -> Result<(), E> {
        let segments = self.max_segments(tessellation)?;
        let device = self.engine().device();
        tessellation.check_evaluator(device)?;
        self.require_capture()?;
        let division = Division::of(tessellation);
        self.engine().prepare(NO_KERNELS, self.pipelines(division, Output::Capture))?;
        let frame = self.undrawn_frame(tessellation);
        let bindings = self.patch_bindings().with(binding::FRAME, &frame.upload(device)?);
        let patches = u64::from(self.plan().patches.len() as u32);
        let size = CHUNK_BYTES.min(patches * patch_bytes(segments)).max(patch_bytes(segments));
        let (usage, memory) = (BufferUsage::CAPTURE, Memory::Readback);
        let desc = BufferDesc { name: "captured triangles", size, usage, memory };
        let buffer = device.buffer(&desc).map_err(EngineError::from)?;
        let longest = self.patches_per_draw(tessellation)?.min((size / patch_bytes(segments)) as u32);
        let mut runs = runs(&self.plan().lists, longest).peekable();
        while runs.peek().is_some() {
            let (mut draws, mut room) = (Vec::new(), size);
            while let Some(run) = runs.next_if(|run| u64::from(run.count) * patch_bytes(segments) <= room) {
                room -= u64::from(run.count) * patch_bytes(segments);
                draws.push(self.draw(run, &bindings, division, Output::Capture)?);
            }
            let mut recording = Recording::new();
            recording.capture(CapturePass { name: "capture".to_owned(), buffer: buffer.clone(), offset: 0, draws });
            let report = device.run(&recording).map_err(EngineError::from)?;
            let bytes =
                report.captures.first().map_or(0, |&(_, triangles)| triangles) * 3 * size_of::<CapturedVertex>() as u64;
            sink(&buffer.read::<CapturedVertex>(0..bytes).map_err(EngineError::from)?)?;
        }
        Ok(())
    }

    fn require_capture(&self) -> Result<(), EngineError> {
        let info = self.engine().device().info();
        if info.features.transform_feedback {
            return Ok(());
        }
        Err(EngineError::Unsupported {
            device: info.name.clone(),
            what: "hand out the tessellator's triangles: it has no VK_EXT_transform_feedback".to_owned(),
            hint: "choose the compute evaluator, or another device".to_owned(),
        })
    }
}
