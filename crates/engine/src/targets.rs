//! Images that surfaces are drawn into.

use osculate_gpu::{
    BufferDesc, BufferUsage, ColorTarget, DepthTarget, Draw, Format, Image, ImageDesc, ImageUsage, Memory, Recording,
    RenderPass,
};

use crate::alpha::alpha_multiplied_in;
use crate::{Engine, EngineError, Shade};

/// What is drawn to: pipelines are made for one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Target {
    /// Format of the colours.
    pub color: Format,
    /// Samples per pixel.
    pub samples: u32,
}

impl Target {
    /// Format of the depths that go with it.
    pub const DEPTH: Format = Format::Depth32Float;

    /// The target of pictures in a shade.
    pub fn of(shade: Shade, samples: u32) -> Self {
        Self { color: if shade == Shade::Peer { Format::Rgba8Unorm } else { Format::Rgba8Srgb }, samples }
    }
}

/// Colours and depths of one size, and where the average of the samples goes if there are several.
#[derive(Clone, Debug)]
pub struct Targets {
    target: Target,
    size: [u32; 2],
    color: Image,
    depth: Image,
    resolved: Option<Image>,
}

impl Targets {
    /// Makes the images of pictures of so many pixels, which can be read back.
    ///
    /// # Errors
    /// If there are no pixels, the size or the number of samples exceeds what the device can do, or memory runs out.
    pub fn new(engine: &Engine, size: [u32; 2], target: Target) -> Result<Self, EngineError> {
        check(engine, size, target.samples)?;
        let image = |name: &str, format, samples, usage| {
            engine.device().image(&ImageDesc { name, size, format, samples, usage, ..ImageDesc::default() })
        };
        let (drawn, read) = (ImageUsage::TARGET, ImageUsage::TARGET | ImageUsage::COPY_SRC);
        let Target { color, samples } = target;
        let several = samples > 1;
        Ok(Self {
            target,
            size,
            color: image("colour", color, samples, if several { drawn } else { read })?,
            depth: image("depth", Target::DEPTH, samples, drawn)?,
            resolved: if several { Some(image("resolved colour", color, 1, read)?) } else { None },
        })
    }

    /// What they are.
    pub fn target(&self) -> Target {
        self.target
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The image that holds the picture, one sample per pixel.
    pub fn result(&self) -> &Image {
        self.resolved.as_ref().unwrap_or(&self.color)
    }

    /// A pass that begins a picture before a background (linear RGBA, alpha not multiplied in), or with `None` adds to what is there.
    pub fn pass(&self, draws: Vec<Draw>, background: Option<[f32; 4]>) -> RenderPass {
        RenderPass {
            name: "picture".to_owned(),
            color: Some(ColorTarget {
                image: self.color.clone(),
                clear: background.map(alpha_multiplied_in),
                resolve: self.resolved.clone(),
            }),
            depth: Some(DepthTarget { image: self.depth.clone(), clear: background.map(|_| 1.0) }),
            viewport: self.size.into(),
            area: None,
            draws,
        }
    }

    /// Runs a recording, then reads the picture: rows from the top, four bytes a pixel in the order of the format, alpha multiplied in.
    ///
    /// # Errors
    /// If nothing was ever drawn, or the device fails.
    pub fn read(&self, engine: &Engine, mut recording: Recording) -> Result<Vec<u8>, EngineError> {
        let size = self.result().byte_size();
        let (usage, memory) = (BufferUsage::STORAGE, Memory::Readback);
        let pixels = engine.device().buffer(&BufferDesc { name: "picture", size, usage, memory })?;
        recording.copy_image_to_buffer(self.result(), &pixels);
        engine.device().run(&recording)?;
        Ok(pixels.read(0..size)?)
    }
}

fn check(engine: &Engine, [width, height]: [u32; 2], samples: u32) -> Result<(), EngineError> {
    let info = engine.device().info();
    let unsupported = |what, hint| Err(EngineError::Unsupported { device: info.name.clone(), what, hint });
    if width == 0 || height == 0 {
        let hint = "give it at least one pixel each way".to_owned();
        return unsupported(format!("draw a picture of {width}x{height} pixels"), hint);
    }
    let counts = &info.limits.sample_counts;
    if !counts.contains(&samples) {
        return unsupported(format!("draw {samples} samples per pixel"), format!("it can do {counts:?}"));
    }
    Ok(())
}
