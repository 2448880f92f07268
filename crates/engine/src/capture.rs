//! The triangles that the tessellator makes, by transform feedback.

use bytemuck::{Pod, Zeroable};
use osculate_gpu::{BufferDesc, BufferUsage, CapturePass, Memory, Recording};
use osculate_shaders::binding;

use crate::draw::{Output, runs};
use crate::frame::FrameDesc;
use crate::{EngineError, Shade, Surface, Tessellation};

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

/// Most bytes that a patch can fill: two triangles a cell, three vertices each.
fn patch_bytes(segments: u32) -> u64 {
    // The tessellator may add a ring of thin triangles under fractional spacing.
    let cells = u64::from(segments + 1) * u64::from(segments + 1);
    2 * cells * 3 * size_of::<CapturedVertex>() as u64
}

impl Surface {
    /// Draws the surface into memory: hands whole patches' triangles, three own vertices each, in draw order, to `sink`, chunk by chunk.
    ///
    /// # Errors
    /// If the level is out of range, the device has no transform feedback, or fails; and whatever `sink` returns.
    pub fn capture<E: From<EngineError>>(
        &self,
        tessellation: &Tessellation,
        mut sink: impl FnMut(&[CapturedVertex]) -> Result<(), E>,
    ) -> Result<(), E> {
        let segments = tessellation.max_segments()?;
        let device = self.engine().device();
        self.require_capture()?;
        self.engine().prepare([], self.pipelines(tessellation.spacing, Output::Capture))?;
        let frame = FrameDesc {
            radius: self.radius(),
            space: self.space(),
            tessellation,
            view: None,
            shade: Shade::Lit,
            line_color: [0.0; 4],
        };
        let bindings = self.buffers().patches.clone().with(binding::FRAME, &frame.upload(device)?);
        let patches = u64::from(self.plan().patches.len() as u32);
        let size = CHUNK_BYTES.min(patches * patch_bytes(segments)).max(patch_bytes(segments));
        let (usage, memory) = (BufferUsage::CAPTURE, Memory::Readback);
        let desc = BufferDesc { name: "captured triangles", size, usage, memory };
        let buffer = device.buffer(&desc).map_err(EngineError::from)?;
        let longest = self.engine().patches_per_draw(segments).min((size / patch_bytes(segments)) as u32);
        let mut runs = runs(&self.plan().lists, longest).peekable();
        while runs.peek().is_some() {
            let (mut draws, mut room) = (Vec::new(), size);
            while let Some(run) = runs.next_if(|run| u64::from(run.count) * patch_bytes(segments) <= room) {
                room -= u64::from(run.count) * patch_bytes(segments);
                draws.push(self.draw(run, &bindings, tessellation, Output::Capture)?);
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
            hint: "choose another device with --device".to_owned(),
        })
    }
}
