//! Draws the interface: egui's triangles, pulled from buffers, and the picture behind them.

use std::collections::HashMap;

use bytemuck::bytes_of;
use egui::epaint::{ImageDelta, Primitive};
use egui::{ClippedPrimitive, TextureFilter, TextureId, TextureWrapMode, TexturesDelta};
use osculate::ShaderSet;
use osculate::gpu::{
    Bindings, Blend, Buffer, BufferDesc, BufferUsage, Device, Draw, Filter, Format, GpuError, GraphicsPipeline,
    GraphicsPipelineDesc, Image, ImageDesc, ImageUsage, Memory, Rect, Sampler, SamplerDesc, Shader, Vertices, Wrap,
};
use osculate_shaders::binding;
use osculate_shaders::layout::{GuiPush, PicturePush};

use crate::error::ViewerError;
use crate::theme;

/// Bytes of one of egui's vertices.
const VERTEX: u64 = size_of::<egui::epaint::Vertex>() as u64;

/// What the interface is drawn with, on one kind of target.
pub(crate) struct Painter {
    device: Device,
    gui: GraphicsPipeline,
    picture: GraphicsPipeline,
    /// Whether the target encodes colours.
    encodes: bool,
    textures: HashMap<TextureId, (Image, Sampler)>,
    samplers: HashMap<egui::TextureOptions, Sampler>,
    vertices: Buffer,
    indices: Buffer,
}

/// The shader of that name.
pub(crate) fn shader(device: &Device, shaders: &ShaderSet, name: &str) -> Result<Shader, ViewerError> {
    let words = shaders.get(name).ok_or_else(|| ViewerError::MissingShader { name: name.to_owned() })?;
    Ok(device.shader(name, words)?)
}

impl Painter {
    /// Prepares to draw to targets of this format.
    pub(crate) fn new(device: &Device, shaders: &ShaderSet, format: Format) -> Result<Self, ViewerError> {
        let pipeline = |name: &str, stages: [&str; 2], blend| -> Result<GraphicsPipeline, ViewerError> {
            let vertex = shader(device, shaders, stages[0])?;
            let fragment = shader(device, shaders, stages[1])?;
            let desc = GraphicsPipelineDesc::new(name, &vertex);
            let desc = GraphicsPipelineDesc { fragment: Some(&fragment), color_format: Some(format), blend, ..desc };
            Ok(device.graphics_pipeline(&desc)?)
        };
        Ok(Self {
            gui: pipeline("interface", ["view/gui.vert", "view/gui.frag"], Blend::Premultiplied)?,
            picture: pipeline("picture", ["view/picture.vert", "view/picture.frag"], Blend::Replace)?,
            encodes: [Format::Bgra8Srgb, Format::Rgba8Srgb].contains(&format),
            textures: HashMap::new(),
            samplers: HashMap::new(),
            vertices: buffer(device, "interface vertices", BufferUsage::STORAGE, 1 << 16)?,
            indices: buffer(device, "interface indices", BufferUsage::INDEX, 1 << 16)?,
            device: device.clone(),
        })
    }

    /// What the window is filled with first, as the target wants it.
    pub(crate) fn background(&self) -> [f32; 4] {
        let [r, g, b, _] = theme::STAGE.to_array().map(|byte| f32::from(byte) / 255.0);
        if self.encodes { theme::stage() } else { [r, g, b, 1.0] }
    }

    /// Takes over the textures of one that is given up.
    #[cfg(feature = "hot-reload")]
    pub(crate) fn take_textures(&mut self, other: &mut Self) {
        self.textures = std::mem::take(&mut other.textures);
    }

    /// Uploads what egui has drawn into its textures.
    pub(crate) fn set_textures(&mut self, delta: &TexturesDelta) -> Result<(), GpuError> {
        delta.set.iter().try_for_each(|(id, change)| self.set_texture(*id, change))
    }

    /// Lets go of textures that are no longer used, once what was drawn with them is handed over.
    pub(crate) fn free_textures(&mut self, delta: &TexturesDelta) {
        delta.free.iter().for_each(|id| drop(self.textures.remove(id)));
    }

    fn set_texture(&mut self, id: TextureId, change: &ImageDelta) -> Result<(), GpuError> {
        let egui::ImageData::Color(image) = &change.image;
        let size = image.size.map(|side| side as u32);
        let texels: Vec<[u8; 4]> = image.pixels.iter().map(egui::Color32::to_array).collect();
        if let (Some(origin), Some((texture, _))) = (change.pos, self.textures.get(&id)) {
            let rect = Rect { origin: origin.map(|one| one as u32), size };
            return self.device.write_image(texture.region(0, rect), &texels);
        }
        let usage = ImageUsage::SAMPLED;
        let desc =
            ImageDesc { name: "interface texture", size, format: Format::Rgba8Unorm, usage, ..ImageDesc::default() };
        let texture = self.device.upload_image(&desc, &texels)?;
        let sampler = self.sampler(change.options)?;
        self.textures.insert(id, (texture, sampler));
        Ok(())
    }

    fn sampler(&mut self, options: egui::TextureOptions) -> Result<Sampler, GpuError> {
        if let Some(known) = self.samplers.get(&options) {
            return Ok(known.clone());
        }
        let filter = |filter| if filter == TextureFilter::Nearest { Filter::Nearest } else { Filter::Linear };
        let wrap = match options.wrap_mode {
            TextureWrapMode::ClampToEdge => Wrap::Clamp,
            TextureWrapMode::Repeat => Wrap::Repeat,
            TextureWrapMode::MirroredRepeat => Wrap::Mirror,
        };
        let sampler = self.device.sampler(&SamplerDesc {
            name: "interface sampler",
            magnify: filter(options.magnification),
            minify: filter(options.minification),
            levels: None,
            wrap: [wrap; 2],
        })?;
        self.samplers.insert(options, sampler.clone());
        Ok(sampler)
    }

    /// The draw that shows a picture texel by texel, its upper left corner at `origin`.
    pub(crate) fn picture(&mut self, picture: &Image, origin: [u32; 2]) -> Result<Draw, GpuError> {
        let sampler = self.sampler(egui::TextureOptions::NEAREST)?;
        let push = PicturePush { origin, target_encodes: u32::from(self.encodes) };
        Ok(Draw {
            pipeline: self.picture.clone(),
            bindings: Bindings::new().with_texture(binding::TEXTURE, picture, &sampler),
            push: bytes_of(&push).to_vec(),
            vertices: (0..3).into(),
            attributes: None,
            instances: 0..1,
            scissor: Some(Rect { origin, size: picture.size() }),
        })
    }

    /// The draws of what egui has laid out, for a target of `size` pixels.
    pub(crate) fn interface(
        &mut self,
        primitives: &[ClippedPrimitive],
        pixels_per_point: f32,
        size: [u32; 2],
    ) -> Result<Vec<Draw>, GpuError> {
        let ranges = self.upload(primitives)?;
        let push =
            GuiPush { size: size.map(|side| side as f32 / pixels_per_point), target_encodes: u32::from(self.encodes) };
        let bindings = Bindings::new().with(binding::GUI_VERTICES, &self.vertices);
        let draw = |(texture, clip, range): (TextureId, egui::Rect, std::ops::Range<u32>)| {
            let scissor = scissor(clip, pixels_per_point, size);
            let (image, sampler) = self.textures.get(&texture)?;
            (!scissor.is_empty() && !range.is_empty()).then(|| Draw {
                pipeline: self.gui.clone(),
                bindings: bindings.clone().with_texture(binding::TEXTURE, image, sampler),
                push: bytes_of(&push).to_vec(),
                vertices: Vertices::Indexed { indices: self.indices.clone(), range },
                attributes: None,
                instances: 0..1,
                scissor: Some(scissor),
            })
        };
        Ok(ranges.into_iter().filter_map(draw).collect())
    }

    /// Puts all triangles into the buffers: what is drawn with which texture, where, and which indices.
    fn upload(
        &mut self,
        primitives: &[ClippedPrimitive],
    ) -> Result<Vec<(TextureId, egui::Rect, std::ops::Range<u32>)>, GpuError> {
        let (mut vertices, mut indices, mut ranges) = (Vec::new(), Vec::new(), Vec::new());
        for ClippedPrimitive { clip_rect, primitive } in primitives {
            let Primitive::Mesh(mesh) = primitive else { continue };
            let (first, begin) = (vertices.len() as u32, indices.len() as u32);
            vertices.extend_from_slice(&mesh.vertices);
            indices.extend(mesh.indices.iter().map(|index| index + first));
            ranges.push((mesh.texture_id, *clip_rect, begin..indices.len() as u32));
        }
        grow(&self.device, &mut self.vertices, vertices.len() as u64 * VERTEX)?;
        grow(&self.device, &mut self.indices, indices.len() as u64 * 4)?;
        self.vertices.write(0, &vertices)?;
        self.indices.write(0, &indices)?;
        Ok(ranges)
    }
}

fn buffer(device: &Device, name: &str, usage: BufferUsage, size: u64) -> Result<Buffer, GpuError> {
    device.buffer(&BufferDesc { name, size, usage, memory: Memory::Upload })
}

/// Makes room for so many bytes.
fn grow(device: &Device, known: &mut Buffer, size: u64) -> Result<(), GpuError> {
    if known.size() < size {
        *known = buffer(device, known.name(), known.usage(), size.next_power_of_two())?;
    }
    Ok(())
}

/// The texels of a rectangle in points, within the target.
fn scissor(clip: egui::Rect, pixels_per_point: f32, size: [u32; 2]) -> Rect {
    let texel = |points: f32, end: u32| (points * pixels_per_point).round().clamp(0.0, end as f32) as u32;
    let origin = [texel(clip.min.x, size[0]), texel(clip.min.y, size[1])];
    let end = [texel(clip.max.x, size[0]), texel(clip.max.y, size[1])];
    Rect { origin, size: [0, 1].map(|axis| end[axis].saturating_sub(origin[axis])) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clips_stay_within_the_target() {
        let clip =
            |min: [f32; 2], max: [f32; 2]| scissor(egui::Rect { min: min.into(), max: max.into() }, 1.5, [300, 150]);
        assert_eq!(clip([10.0, 20.0], [30.0, 40.0]), Rect { origin: [15, 30], size: [30, 30] });
        assert_eq!(clip([-5.0, -5.0], [f32::INFINITY, 50.0]), Rect { origin: [0, 0], size: [300, 75] });
        assert!(clip([30.0, 20.0], [10.0, 40.0]).is_empty() && clip([500.0, 0.0], [600.0, 1.0]).is_empty());
    }
}
