//! Texture coordinates, displacement and colours of a surface (`shaders/include/attributes.glsl`, `displacement.glsl`, `texture.glsl`).

mod picture;

use bytemuck::cast_slice;
use glam::{DAffine2, DVec2};
use osculate_cage::{Cage, Wrap};
use osculate_gpu::{Bindings, BufferUsage, Device, Filter, Format, Image, ImageDesc, ImageUsage, Sampler, SamplerDesc};
use osculate_shaders::layout::Mapping;
use osculate_shaders::{binding, constant};
use osculate_subdiv::UvTables;

use crate::buffers::Uploader;
use crate::{EngineError, Surface};

pub use picture::{ColorMap, HeightMap, MapError};

/// Where v of the cage's texture coordinates begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UvOrigin {
    /// At the bottom of pictures, as in OBJ files.
    #[default]
    Bottom,
    /// At the top, as in glTF files.
    Top,
}

/// How a picture lies in the plane of texture coordinates, whose v runs downwards here.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct MapPlacement {
    /// From texture coordinates to those of the picture, in which it is the unit square.
    pub transform: DAffine2,
    /// What lies beyond it, in u and v.
    pub wrap: [Wrap; 2],
}

/// A displacement along the normal: `scale * height + bias`, in the cage's units.
#[derive(Clone, Copy, Debug)]
pub struct Displacement<'a> {
    /// The heights.
    pub map: &'a HeightMap,
    /// What a height of 1 adds.
    pub scale: f64,
    /// What is added everywhere.
    pub bias: f64,
    /// Where the map lies.
    pub placement: MapPlacement,
}

/// What [`Shade::Textured`](crate::Shade::Textured) paints a surface with.
#[derive(Clone, Copy, Debug)]
pub struct Coloring<'a> {
    /// The picture; none is white.
    pub map: Option<&'a ColorMap>,
    /// Linear red, green and blue that it is multiplied with.
    pub factor: [f32; 3],
    /// Where it lies.
    pub placement: MapPlacement,
}

/// What texture coordinates are for.
#[derive(Clone, Copy, Debug, Default)]
pub struct MapsDesc<'a> {
    /// Where v begins.
    pub origin: UvOrigin,
    /// What moves points.
    pub displacement: Option<Displacement<'a>>,
    /// What paints them.
    pub coloring: Option<Coloring<'a>>,
}

/// Maps on the device.
pub(crate) struct Maps {
    uv: UvTables,
    bindings: Bindings,
    displaces: bool,
}

impl Surface {
    /// The same surface with texture coordinates, moved by heights and painted as told. Both share tables and points; what does not look
    /// at texture coordinates is as fast as ever on the one without.
    ///
    /// Points that patches share are moved by what edge records say, so that a displaced surface has no cracks, seams of the texture
    /// coordinates included. [`Surface::sample`] is of the surface before it is moved.
    ///
    /// # Errors
    /// If the cage has no texture coordinates, or the device has no room.
    ///
    /// # Panics
    /// If the cage is not the surface's.
    pub fn with_maps(&self, cage: &Cage, desc: &MapsDesc<'_>) -> Result<Self, EngineError> {
        let uv = cage.uv().ok_or(EngineError::NoUv)?;
        self.refuse_unrefined("texture coordinates (--displace, --texture)")?;
        let place = |uv: DVec2| match desc.origin {
            UvOrigin::Bottom => DVec2::new(uv.x, 1.0 - uv.y),
            UvOrigin::Top => uv,
        };
        let uv = UvTables::new(self.plan(), uv, place);
        let bindings = bindings(self, &uv, desc)?;
        let displaces = desc.displacement.is_some_and(|one| one.scale != 0.0 || one.bias != 0.0);
        Ok(self.with(Maps { uv, bindings, displaces }))
    }

    /// Whether it has texture coordinates: pipelines then are others.
    pub fn is_mapped(&self) -> bool {
        self.maps().is_some()
    }

    /// Whether its points are moved: bounds of patches do not bound it.
    pub fn is_displaced(&self) -> bool {
        self.maps().is_some_and(|maps| maps.displaces)
    }

    /// The texture coordinates at (u,v) of a patch, v downwards, if there are any.
    ///
    /// # Panics
    /// If there is no such patch.
    pub fn uv(&self, patch: u32, uv: [f32; 2]) -> Option<[f32; 2]> {
        self.maps().map(|maps| maps.uv.at(self.plan(), patch, uv))
    }

    /// All buffers and images that the stages of its patches may read.
    pub(crate) fn patch_bindings(&self) -> Bindings {
        let common = self.buffers().patches.clone();
        self.maps().map_or(common.clone(), |maps| common.with_all(&maps.bindings))
    }
}

fn bindings(surface: &Surface, uv: &UvTables, desc: &MapsDesc<'_>) -> Result<Bindings, EngineError> {
    let device = surface.engine().device();
    let mut up = Uploader::new(device);
    let flat = HeightMap::new("flat", [1, 1], vec![0.0]).map_err(EngineError::Map)?;
    let heights = upload_heights(device, desc.displacement.map_or(&flat, |one| one.map))?;
    let (colors, sampler) = upload_colors(device, desc.coloring)?;
    let mapping = mapping(surface, desc, heights.levels());
    Ok(Bindings::new()
        .with(binding::PATCH_UV, &up.table("texture coordinates of patches", &uv.patches)?)
        .with(binding::EDGE_UV, &up.table("texture coordinates of edges", &uv.edges)?)
        .with(binding::VERTEX_UV, &up.table("edges of vertices", &uv.vertices)?)
        .with(binding::MAPPING, &device.upload("mapping", BufferUsage::UNIFORM, &[mapping])?)
        .with_texture(binding::HEIGHTS, &heights, &exact(device)?)
        .with_texture(binding::COLORS, &colors, &sampler))
}

fn mapping(surface: &Surface, desc: &MapsDesc<'_>, height_levels: u32) -> Mapping {
    let height = desc.displacement.map(|one| one.placement).unwrap_or_default();
    let color = desc.coloring.map(|one| one.placement).unwrap_or_default();
    let axes = |place: MapPlacement| place.transform.matrix2.as_mat2().to_cols_array_2d();
    let origin = |place: MapPlacement| place.transform.translation.as_vec2().to_array();
    let [wrap_u, wrap_v] = height.wrap.map(wrap_constant);
    let in_space = |length: f64| (length * surface.space().scale) as f32;
    let [r, g, b] = desc.coloring.map_or([1.0; 3], |one| one.factor);
    Mapping {
        height_axes: axes(height),
        height_origin: origin(height),
        height_scale: in_space(desc.displacement.map_or(0.0, |one| one.scale)),
        height_bias: in_space(desc.displacement.map_or(0.0, |one| one.bias)),
        color_axes: axes(color),
        color_origin: origin(color),
        height_wrap: wrap_u | wrap_v << constant::WRAP_BITS,
        height_levels,
        base_color: [r, g, b, 1.0],
    }
}

fn wrap_constant(wrap: Wrap) -> u32 {
    match wrap {
        Wrap::ClampToEdge => constant::WRAP_CLAMP,
        Wrap::Repeat => constant::WRAP_REPEAT,
        Wrap::MirroredRepeat => constant::WRAP_MIRROR,
    }
}

/// All levels are made here, from the finest, so that they are the same on every device.
fn upload_heights(device: &Device, map: &HeightMap) -> Result<Image, EngineError> {
    let levels = Image::full_levels(map.size());
    let usage = ImageUsage::SAMPLED | ImageUsage::COPY_DST;
    let desc = ImageDesc {
        name: "heights",
        size: map.size(),
        format: Format::R32Float,
        levels,
        usage,
        ..ImageDesc::default()
    };
    let image = device.image(&desc)?;
    device.write_image(image.level(0), map.heights())?;
    let mut finer = None;
    for level in 1..levels {
        let coarse = finer.as_ref().unwrap_or(map).shrunk(image.level_size(level));
        device.write_image(image.level(level), coarse.heights())?;
        finer = Some(coarse);
    }
    Ok(image)
}

/// Shaders fetch single texels of heights.
fn exact(device: &Device) -> Result<Sampler, EngineError> {
    let (magnify, minify) = (Filter::Nearest, Filter::Nearest);
    Ok(device.sampler(&SamplerDesc {
        name: "heights",
        magnify,
        minify,
        levels: Some(Filter::Nearest),
        ..SamplerDesc::default()
    })?)
}

fn upload_colors(device: &Device, coloring: Option<Coloring<'_>>) -> Result<(Image, Sampler), EngineError> {
    let white = ([1, 1], [[255; 4]]);
    let map = coloring.and_then(|one| one.map);
    let (size, texels) = map.map_or((white.0, &white.1[..]), |map| (map.size(), map.rgba()));
    let desc = ImageDesc {
        name: "colours",
        size,
        format: Format::Rgba8Srgb,
        levels: Image::full_levels(size),
        usage: ImageUsage::SAMPLED,
        ..ImageDesc::default()
    };
    let wrap = coloring.map(|one| one.placement).unwrap_or_default().wrap.map(|wrap| match wrap {
        Wrap::ClampToEdge => osculate_gpu::Wrap::Clamp,
        Wrap::Repeat => osculate_gpu::Wrap::Repeat,
        Wrap::MirroredRepeat => osculate_gpu::Wrap::Mirror,
    });
    let sampler = device.sampler(&SamplerDesc { name: "colours", wrap, ..SamplerDesc::default() })?;
    Ok((device.upload_image(&desc, cast_slice::<[u8; 4], u8>(texels))?, sampler))
}
