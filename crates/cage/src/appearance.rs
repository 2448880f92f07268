//! What a surface looks like: materials, their textures, and sets of texture coordinates beyond the first.

use std::path::PathBuf;
use std::sync::Arc;

use glam::{DAffine2, Vec4};

use crate::{FaceVarying, NONE};

/// Materials of the faces of a cage, with all that their textures need.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Appearance {
    /// The materials that faces use.
    pub materials: Vec<Material>,
    /// The material of each face, [`NONE`] for a face without one.
    pub face_materials: Vec<u32>,
    /// The images that textures use.
    pub images: Vec<Image>,
    /// Sets of texture coordinates beyond the first, which is [`Cage::uv`](crate::Cage::uv).
    pub more_uv: Vec<UvSet>,
}

/// A set of texture coordinates with a number.
#[derive(Clone, Debug, PartialEq)]
pub struct UvSet {
    /// The number that textures name; at least 1.
    pub set: u32,
    /// The coordinates.
    pub uv: FaceVarying,
}

/// What the faces of one material look like.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name, or one made from its index in the file.
    pub name: String,
    /// Linear red, green, blue and opacity, multiplied with the texture.
    pub base_color: Vec4,
    /// The colours, encoded as sRGB.
    pub base_color_texture: Option<Texture>,
    /// How the surface is moved along its normal.
    pub displacement: Option<Displacement>,
}

/// A displacement along the normal: `scale * red + offset`, in units of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacement {
    /// The heights, in the red channel, linear.
    pub texture: Texture,
    /// What a red of 1 adds.
    pub scale: f32,
    /// What is added everywhere.
    pub offset: f32,
}

/// An image with the way it is read.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The image, an index of [`Appearance::images`].
    pub image: u32,
    /// The set of texture coordinates: 0 is [`Cage::uv`](crate::Cage::uv).
    pub uv_set: u32,
    /// From texture coordinates to those of the image.
    pub transform: DAffine2,
    /// What lies beyond the image, in u and v.
    pub wrap: [Wrap; 2],
    /// True if texels are not to be blended.
    pub nearest: bool,
}

/// What lies beyond an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// Its reflection.
    MirroredRepeat,
    /// Its outermost texels.
    ClampToEdge,
}

/// An image as it is stored, not decoded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Its name, or one made from its index in the file.
    pub name: String,
    /// Where its bytes are.
    pub source: ImageSource,
}

/// Where the bytes of an image are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageSource {
    /// A file beside the model or below its folder; it may not exist.
    File(PathBuf),
    /// Bytes of the model's own file: PNG, JPEG or whatever they start with.
    Bytes(Arc<[u8]>),
}

impl Appearance {
    /// The material of face `f`, if it has one.
    #[must_use]
    pub fn material(&self, f: usize) -> Option<&Material> {
        self.materials.get(self.face_materials[f] as usize)
    }

    /// The appearance of other faces: the new face `f` looks like the old face `faces[f]`, the new corner `c` like `corners[c]`.
    pub(crate) fn gather(&self, faces: &[u32], corners: &[u32]) -> Self {
        let uv = |uv: &FaceVarying| FaceVarying {
            values: uv.values.clone(),
            indices: corners.iter().map(|&c| uv.indices[c as usize]).collect(),
        };
        Self {
            face_materials: faces.iter().map(|&f| self.face_materials[f as usize]).collect(),
            more_uv: self.more_uv.iter().map(|set| UvSet { set: set.set, uv: uv(&set.uv) }).collect(),
            ..self.clone()
        }
    }

    /// Names the first thing that does not fit a cage of that many faces and corners.
    pub(crate) fn check(&self, faces: usize, corners: usize) -> Result<(), &'static str> {
        let within = |&m: &u32| m == NONE || (m as usize) < self.materials.len();
        let textures = self.materials.iter().flat_map(|material| {
            material.base_color_texture.iter().chain(material.displacement.iter().map(|d| &d.texture))
        });
        let uv = |uv: &FaceVarying| {
            uv.indices.len() == corners
                && uv.indices.iter().all(|&i| (i as usize) < uv.values.len())
                && uv.values.iter().all(|value| value.is_finite())
        };
        for (holds, fault) in [
            (self.face_materials.len() == faces, "there must be a material index for each face"),
            (self.face_materials.iter().all(within), "faces must name materials that exist"),
            (
                textures.into_iter().all(|texture| (texture.image as usize) < self.images.len()),
                "textures must name images that exist",
            ),
            (self.more_uv.iter().all(|set| uv(&set.uv)), "uv sets must have a finite value for each face corner"),
        ] {
            if !holds {
                return Err(fault);
            }
        }
        Ok(())
    }
}
