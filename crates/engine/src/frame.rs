//! The uniform block of a frame.

use glam::DMat4;
use osculate_gpu::{Buffer, BufferDesc, BufferUsage, Device, Memory};
use osculate_shaders::constant;
use osculate_shaders::layout::Frame;

use crate::culling::sample_places;
use crate::{CageSpace, Camera, Culling, EngineError, Factors, Tessellation};

/// What a frame shows, before it becomes a uniform block.
pub(crate) struct FrameDesc<'a> {
    pub(crate) space: &'a CageSpace,
    /// Half diagonal of the cage's box in cage space.
    pub(crate) radius: f32,
    pub(crate) tessellation: &'a Tessellation,
    /// Camera and size of the picture in pixels; none when nothing is drawn.
    pub(crate) view: Option<(&'a Camera, [u32; 2])>,
    pub(crate) line_color: [f32; 4],
    /// Which patches are left out, and the view that they are left out for.
    pub(crate) culling: Option<CullView<'a>>,
}

/// A view that patches are left out for.
#[derive(Clone, Copy)]
pub(crate) struct CullView<'a> {
    pub(crate) culling: Culling,
    pub(crate) camera: &'a Camera,
    /// Width and height of its picture in pixels.
    pub(crate) size: [u32; 2],
    /// Samples per pixel.
    pub(crate) samples: u32,
}

pub(crate) fn columns(m: DMat4) -> [[f32; 4]; 4] {
    m.as_mat4().to_cols_array_2d()
}

impl FrameDesc<'_> {
    /// The block as the shaders see it.
    pub(crate) fn block(&self) -> Frame {
        let (clip, view) = match self.view {
            Some((camera, size)) => (self.clip(camera, size), camera.view(self.space)),
            None => (DMat4::IDENTITY, DMat4::IDENTITY),
        };
        let mut frame = Frame {
            clip_from_cage: columns(clip),
            view_from_cage: columns(view),
            eye: self.view.map_or([0.0; 4], |(camera, _)| self.eye(camera)),
            factor_eye: [0.0; 4],
            level: 1.0,
            segments_per_length: 0.0,
            factor_mode: constant::FACTORS_UNIFORM,
            radius: self.radius,
            near: 0.0,
            padding: 0,
            viewport: self.view.map_or([1.0; 2], |(_, size)| size.map(|pixels| pixels as f32)),
            line_color: self.line_color,
            cull_clip_from_cage: columns(DMat4::IDENTITY),
            cull_eye: [0.0; 4],
            cull_viewport: [1.0; 2],
            cull_samples: 1.0,
            cull: 0,
            world_from_cage: columns(self.space.leaving()),
        };
        if let Some(CullView { culling, camera, size, samples }) = self.culling {
            frame.cull_clip_from_cage = columns(self.clip(camera, size));
            frame.cull_eye = self.eye(camera);
            frame.cull_viewport = size.map(|pixels| pixels as f32);
            frame.cull_samples = sample_places(samples);
            frame.cull = culling.bits();
        }
        match &self.tessellation.factors {
            Factors::Uniform(level) => frame.level = *level,
            Factors::Adaptive { pixels, camera, height } => {
                frame.factor_mode = constant::FACTORS_ADAPTIVE;
                frame.segments_per_length = (camera.pixels_per_length(*height) / f64::from(*pixels)) as f32;
                frame.near = (camera.near * self.space.scale) as f32;
                frame.factor_eye = self.eye(camera);
            }
        }
        frame
    }

    fn clip(&self, camera: &Camera, [width, height]: [u32; 2]) -> DMat4 {
        camera.clip(self.space, f64::from(width) / f64::from(height))
    }

    fn eye(&self, camera: &Camera) -> [f32; 4] {
        self.space.enter(camera.eye).extend(1.0).to_array()
    }

    /// The block in a buffer.
    pub(crate) fn upload(&self, device: &Device) -> Result<Buffer, EngineError> {
        let size = size_of::<Frame>() as u64;
        let desc = BufferDesc { name: "frame", size, usage: BufferUsage::UNIFORM, memory: Memory::Upload };
        let buffer = device.buffer(&desc)?;
        buffer.write(0, &[self.block()])?;
        Ok(buffer)
    }
}
