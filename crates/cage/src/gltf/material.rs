//! Materials, as far as a surface needs them: base colour and displacement with their textures.
//!
//! glTF has no ratified displacement. Read is what was proposed for `KHR_materials_displacement` (glTF issue 948) and what early
//! exporters write: `displacementGeometryTexture` (a texture reference or the index of a texture), `displacementGeometryFactor` and
//! `displacementGeometryOffset`, in that extension of a material or in its `extras`.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use ::gltf::Gltf;
use ::gltf::json::texture::{Info, MagFilter, WrappingMode};
use ::gltf::json::validation::Checked;
use ::gltf::json::{self, Root, Value, deserialize};
use glam::{DAffine2, DMat2, DVec2, Vec4};

use super::buffers::{Buffers, from_data_uri, inside};
use super::soup::Soup;
use crate::{Appearance, Displacement, Image, ImageSource, Material, NONE, Texture, Wrap};

/// The materials that triangles of the soup have, and for each material of the file its index among them.
pub(super) fn read(gltf: &Gltf, buffers: &Buffers, folder: Option<&Path>, soup: &mut Soup) -> (Appearance, Vec<u32>) {
    let json = gltf.as_json();
    let mut indices = vec![NONE; json.materials.len()];
    let (appearance, left) = (Appearance::default(), buffers.size());
    let mut reader = Reader { json, buffers, folder, appearance, images: HashMap::new(), left, lost: 0 };
    for material in soup.materials() {
        if indices[material] == NONE {
            indices[material] = reader.appearance.materials.len() as u32;
            let material = reader.material(material);
            reader.appearance.materials.push(material);
        }
    }
    (0..reader.lost).for_each(|_| soup.ignore("texture of an image that cannot be read"));
    (reader.appearance, indices)
}

struct Reader<'a> {
    json: &'a Root,
    buffers: &'a Buffers,
    /// Where images beside the file are.
    folder: Option<&'a Path>,
    appearance: Appearance,
    /// Images that were looked for, by their index in the file.
    images: HashMap<usize, Option<u32>>,
    /// Bytes that images may still copy: any number of them may be the same part of a buffer.
    left: usize,
    /// Textures without an image.
    lost: usize,
}

/// A texture as a material refers to it.
struct Reference<'a> {
    texture: usize,
    uv_set: u32,
    transform: Option<&'a Value>,
}

impl Reader<'_> {
    fn material(&mut self, index: usize) -> Material {
        let material = &self.json.materials[index];
        let pbr = &material.pbr_metallic_roughness;
        Material {
            name: material.name.clone().unwrap_or_else(|| format!("material {index}")),
            base_color: Vec4::from_array(pbr.base_color_factor.0),
            base_color_texture: pbr.base_color_texture.as_ref().and_then(|info| self.texture(&reference(info))),
            displacement: self.displacement(material),
        }
    }

    fn displacement(&mut self, material: &json::Material) -> Option<Displacement> {
        let extension = material.extensions.as_ref().and_then(|e| e.others.get("KHR_materials_displacement")).cloned();
        let extras = || deserialize::from_str::<Value>(material.extras.as_ref()?.get()).ok();
        let value = extension.or_else(extras)?;
        let info = value.get("displacementGeometryTexture")?;
        let number = |object: &Value, key: &str| object.get(key).and_then(Value::as_u64);
        let reference = Reference {
            texture: number(info, "index").or(info.as_u64())? as usize,
            uv_set: number(info, "texCoord").unwrap_or(0) as u32,
            transform: info.get("extensions").and_then(|e| e.get("KHR_texture_transform")),
        };
        let factor = |key: &str, default: f32| {
            value.get(key).and_then(Value::as_f64).map(|x| x as f32).filter(|x| x.is_finite()).unwrap_or(default)
        };
        let (scale, offset) = (factor("displacementGeometryFactor", 1.0), factor("displacementGeometryOffset", 0.0));
        Some(Displacement { texture: self.texture(&reference)?, scale, offset })
    }

    fn texture(&mut self, reference: &Reference) -> Option<Texture> {
        let texture = self.json.textures.get(reference.texture);
        let image = texture.and_then(|texture| self.image(image_of(texture)?));
        let (Some(texture), Some(image)) = (texture, image) else {
            self.lost += 1;
            return None;
        };
        let sampler = texture.sampler.as_ref().and_then(|index| self.json.samplers.get(index.value()));
        let (transform, uv_set) = reference.transform.map_or((DAffine2::IDENTITY, None), transform);
        Some(Texture {
            image,
            uv_set: uv_set.unwrap_or(reference.uv_set),
            transform,
            wrap: sampler.map_or([Wrap::Repeat; 2], |sampler| [sampler.wrap_s, sampler.wrap_t].map(wrap)),
            nearest: sampler.is_some_and(|s| s.mag_filter == Some(Checked::Valid(MagFilter::Nearest))),
        })
    }

    fn image(&mut self, index: usize) -> Option<u32> {
        if let Some(&known) = self.images.get(&index) {
            return known;
        }
        let source = self.source(self.json.images.get(index)?);
        let image = source.map(|source| {
            let name = self.json.images[index].name.clone().unwrap_or_else(|| format!("image {index}"));
            self.appearance.images.push(Image { name, source });
            self.appearance.images.len() as u32 - 1
        });
        self.images.insert(index, image);
        image
    }

    fn source(&mut self, image: &json::Image) -> Option<ImageSource> {
        let bytes: Arc<[u8]> = match (&image.uri, &image.buffer_view) {
            (Some(uri), _) => match uri.strip_prefix("data:") {
                Some(data) => from_data_uri(data).ok()?.into(),
                None => return Some(ImageSource::File(inside(self.folder?, uri)?)),
            },
            (None, Some(view)) => {
                let view = self.json.buffer_views.get(view.value())?;
                let start = usize::try_from(view.byte_offset.unwrap_or_default().0).ok()?;
                let length = usize::try_from(view.byte_length.0).ok()?;
                let bytes = self.buffers.get(view.buffer.value()).get(start..start.checked_add(length)?)?;
                self.left = self.left.checked_sub(length)?;
                bytes.into()
            }
            (None, None) => return None,
        };
        Some(ImageSource::Bytes(bytes))
    }
}

fn reference(info: &Info) -> Reference<'_> {
    let extensions = info.extensions.as_ref();
    Reference {
        texture: info.index.value(),
        uv_set: info.tex_coord,
        transform: extensions.and_then(|extensions| extensions.others.get("KHR_texture_transform")),
    }
}

/// The image of a texture: its own, else that of an extension for other kinds of images.
fn image_of(texture: &json::Texture) -> Option<usize> {
    let own = texture.source.value();
    if own != u32::MAX as usize {
        return Some(own);
    }
    let extensions = &texture.extensions.as_ref()?.others;
    let mut sources = extensions.values().filter_map(|extension| extension.get("source")?.as_u64());
    sources.next().map(|source| source as usize)
}

/// The transform of `KHR_texture_transform`, and the set of texture coordinates if it names one: scaled, then turned
/// counter-clockwise as seen with v running downwards, then moved.
fn transform(value: &Value) -> (DAffine2, Option<u32>) {
    let pair = |key: &str, default: DVec2| {
        let numbers = value.get(key).and_then(Value::as_array).map(|array| array.iter().map(Value::as_f64));
        let numbers: Option<Vec<f64>> = numbers.and_then(Iterator::collect);
        match numbers.as_deref() {
            Some(&[x, y]) => DVec2::new(x, y),
            _ => default,
        }
    };
    let angle = value.get("rotation").and_then(Value::as_f64).unwrap_or(0.0);
    let set = value.get("texCoord").and_then(Value::as_u64).map(|set| set as u32);
    let turned = DMat2::from_cols(DVec2::new(angle.cos(), -angle.sin()), DVec2::new(angle.sin(), angle.cos()));
    let matrix2 = turned * DMat2::from_diagonal(pair("scale", DVec2::ONE));
    (DAffine2 { matrix2, translation: pair("offset", DVec2::ZERO) }, set)
}

fn wrap(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::ClampToEdge,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::MirroredRepeat,
        _ => Wrap::Repeat,
    }
}
