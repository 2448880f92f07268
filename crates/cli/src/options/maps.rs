//! Displacement and colours: pictures that the surface is mapped with.

use crate::failure::Failure;
use clap::Args;
use osculate::{
    Cage, ColorMap, Coloring, Displacement, EngineError, HeightMap, MapError, MapPlacement, MapsDesc, Shade, Surface,
    UvOrigin,
};
use osculate_cage::{Appearance, ImageSource, Material, Texture};
use std::path::{Path, PathBuf};

/// Options of commands that can move the surface.
#[derive(Args, Debug)]
#[command(next_help_heading = "Displacement")]
pub(crate) struct DisplaceArgs {
    /// Move the surface along its normal by a map of heights in the plane of texture coordinates: the red channel of a PNG,
    /// JPEG or OpenEXR file. The word `material` stands for the displacement of the model's own material, which glTF files may have.
    /// SCALE and BIAS are short for the next two options.
    #[arg(long, value_name = "MAP[:SCALE[:BIAS]]", value_parser = spec)]
    displace: Option<Spec>,

    /// How far a height of 1 (white) moves the surface, in the cage's units. Default: that of the material, else 2 % of the
    /// diagonal of the cage's box.
    #[arg(long, value_name = "LENGTH", requires = "displace", allow_negative_numbers = true, value_parser = number)]
    displace_scale: Option<f64>,

    /// How far the surface is moved everywhere, in the cage's units. Default: that of the material, else 0.
    #[arg(long, value_name = "LENGTH", requires = "displace", allow_negative_numbers = true, value_parser = number)]
    displace_bias: Option<f64>,
}

/// A map with the numbers after its name.
#[derive(Clone, Debug, PartialEq)]
struct Spec {
    map: PathBuf,
    numbers: Vec<f64>,
}

/// In the place of a map, the displacement of the model's material.
const OF_MATERIAL: &str = "material";

/// How far a height of 1 moves by default, as a part of the box's diagonal.
const DEFAULT_SCALE: f64 = 0.02;

fn number(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(|| "expected a number".into())
}

/// What looks like a number after a colon is one; names may hold other colons.
fn spec(text: &str) -> Result<Spec, String> {
    let (mut map, mut numbers) = (text, Vec::new());
    while let Some((name, tail)) = map.rsplit_once(':')
        && let Ok(found) = number(tail)
        && numbers.len() < 2
        && !name.is_empty()
    {
        numbers.insert(0, found);
        map = name;
    }
    if map.is_empty() { Err("expected a file".into()) } else { Ok(Spec { map: map.into(), numbers }) }
}

/// Pictures in memory.
#[derive(Default)]
pub(crate) struct Maps {
    heights: Option<Heights>,
    colors: Option<Colors>,
    /// Whether texture coordinates are needed without either.
    plain: bool,
}

/// Heights, how far they move, and how they lie.
struct Heights {
    map: HeightMap,
    scale: f64,
    bias: f64,
    placement: MapPlacement,
}

/// Colours, and how they lie.
struct Colors {
    map: Option<ColorMap>,
    factor: [f32; 3],
    placement: MapPlacement,
}

impl DisplaceArgs {
    /// Reads the map of heights, if there is one.
    pub(crate) fn load(&self, cage: &Cage) -> Result<Maps, Failure> {
        let Some(Spec { map, numbers }) = &self.displace else { return Ok(Maps::default()) };
        let heights = if map == Path::new(OF_MATERIAL) {
            heights_of(cage.appearance())?
        } else {
            let scale = DEFAULT_SCALE * 2.0 * cage.bounds().half_diagonal();
            let map = HeightMap::read(map).map_err(unreadable)?;
            Heights { map, scale, bias: 0.0, placement: MapPlacement::default() }
        };
        let scale = self.displace_scale.or(numbers.first().copied()).unwrap_or(heights.scale);
        let bias = self.displace_bias.or(numbers.get(1).copied()).unwrap_or(heights.bias);
        Ok(Maps { heights: Some(Heights { scale, bias, ..heights }), ..Maps::default() })
    }
}

impl Maps {
    /// With what a shade needs: colours those of a picture, if there is one.
    pub(crate) fn for_shade(self, shade: Shade, texture: Option<&Path>, cage: &Cage) -> Result<Self, Failure> {
        match shade {
            Shade::Textured => self.colored(texture, cage),
            Shade::Uv => Ok(Self { plain: true, ..self }),
            _ => Ok(self),
        }
    }

    /// With colours: those of a picture, or of the cage's own materials.
    fn colored(self, texture: Option<&Path>, cage: &Cage) -> Result<Self, Failure> {
        let colors = match (texture, cage.appearance()) {
            (Some(file), _) => {
                let map = Some(ColorMap::read(file).map_err(unreadable)?);
                Colors { map, factor: [1.0; 3], placement: MapPlacement::default() }
            }
            (None, Some(appearance)) => colors_of(appearance)?,
            (None, None) => {
                return Err(
                    Failure::usage("the model has no materials to be shown").with_hint("name a picture by --texture")
                );
            }
        };
        Ok(Self { colors: Some(colors), ..self })
    }

    /// The surface with all this.
    pub(crate) fn apply(&self, surface: Surface, cage: &Cage, file: &Path) -> Result<Surface, Failure> {
        if self.heights.is_none() && self.colors.is_none() && !self.plain {
            return Ok(surface);
        }
        let displacement = self.heights.as_ref().map(|heights| Displacement {
            map: &heights.map,
            scale: heights.scale,
            bias: heights.bias,
            placement: heights.placement,
        });
        let coloring = self.colors.as_ref().map(|colors| Coloring {
            map: colors.map.as_ref(),
            factor: colors.factor,
            placement: colors.placement,
        });
        let desc = MapsDesc { origin: uv_origin(file), displacement, coloring };
        surface.with_maps(cage, &desc).map_err(|error| match error {
            EngineError::NoUv => Failure::input(format_args!("{}: {error}", file.display())),
            other => other.into(),
        })
    }
}

/// v runs downwards in glTF files alone.
pub(crate) fn uv_origin(file: &Path) -> UvOrigin {
    let extension = file.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if ["glb", "gltf"].iter().any(|name| extension.eq_ignore_ascii_case(name)) {
        UvOrigin::Top
    } else {
        UvOrigin::Bottom
    }
}

fn unreadable(error: MapError) -> Failure {
    Failure::unreadable(error)
}

/// The material that has most faces, of those that have what is looked for if there are any; a surface shows one.
fn main_material(appearance: &Appearance, has: impl Fn(&Material) -> bool) -> Option<&Material> {
    let faces = |m: usize| appearance.face_materials.iter().filter(|&&material| material as usize == m).count();
    let order = |&m: &usize| (has(&appearance.materials[m]), faces(m), usize::MAX - m);
    (0..appearance.materials.len()).max_by_key(order).map(|m| &appearance.materials[m])
}

/// Says so where a model has materials that are not shown.
fn warn_of_others(appearance: &Appearance, Material { name, .. }: &Material) {
    let others = appearance.materials.len() - 1;
    if others > 0 {
        tracing::warn!("all faces are shown in the material {name:?}; the model has {others} more");
    }
}

/// The colours of a model's material.
fn colors_of(appearance: &Appearance) -> Result<Colors, Failure> {
    let Some(material) = main_material(appearance, |material| material.base_color_texture.is_some()) else {
        return Err(Failure::usage("the model has no materials to be shown").with_hint("name a picture by --texture"));
    };
    warn_of_others(appearance, material);
    let Material { base_color, base_color_texture, .. } = material;
    let factor = base_color.truncate().to_array();
    let Some(texture) = base_color_texture else {
        return Ok(Colors { map: None, factor, placement: MapPlacement::default() });
    };
    let map = picture_of(appearance, texture, ColorMap::read, ColorMap::decode)?;
    Ok(Colors { map: Some(map), factor, placement: placement_of(texture) })
}

/// The heights of a model's material.
fn heights_of(appearance: Option<&Appearance>) -> Result<Heights, Failure> {
    let material =
        appearance.and_then(|appearance| main_material(appearance, |material| material.displacement.is_some()));
    let found = appearance.zip(material.and_then(|material| Some((material, material.displacement.as_ref()?))));
    let Some((appearance, (material, displacement))) = found else {
        return Err(Failure::usage("the model's materials have no displacement")
            .with_hint("name a map of heights: --displace MAP"));
    };
    warn_of_others(appearance, material);
    let map = picture_of(appearance, &displacement.texture, HeightMap::read, HeightMap::decode)?;
    let (scale, bias) = (displacement.scale.into(), displacement.offset.into());
    Ok(Heights { map, scale, bias, placement: placement_of(&displacement.texture) })
}

/// The picture of a texture, from its file or from the bytes in the model.
fn picture_of<T>(
    appearance: &Appearance,
    texture: &Texture,
    read: impl Fn(&Path) -> Result<T, MapError>,
    decode: impl Fn(&str, &[u8]) -> Result<T, MapError>,
) -> Result<T, Failure> {
    if texture.uv_set != 0 {
        tracing::warn!(
            "the texture is for the texture coordinates {}; it is shown with the first ones",
            texture.uv_set
        );
    }
    let image = &appearance.images[texture.image as usize];
    let picture = match &image.source {
        ImageSource::File(path) => read(path),
        ImageSource::Bytes(bytes) => decode(&image.name, bytes),
    };
    picture.map_err(unreadable)
}

fn placement_of(texture: &Texture) -> MapPlacement {
    MapPlacement { transform: texture.transform, wrap: texture.wrap }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_the_name_of_the_map() {
        let of = |text| spec(text).map(|Spec { map, numbers }| (map.display().to_string(), numbers));
        assert_eq!(of("a.png"), Ok(("a.png".to_owned(), vec![])));
        assert_eq!(of("a.png:0.5"), Ok(("a.png".to_owned(), vec![0.5])));
        assert_eq!(of("a:b.png:-0.5:1e-2"), Ok(("a:b.png".to_owned(), vec![-0.5, 0.01])));
        assert_eq!(of("a.png:inf"), Ok(("a.png:inf".to_owned(), vec![])));
        assert!(spec("").is_err());
    }

    #[test]
    fn v_begins_where_the_format_says() {
        assert_eq!(uv_origin("a/b.GLB".as_ref()), UvOrigin::Top);
        assert_eq!(uv_origin("b.obj".as_ref()), UvOrigin::Bottom);
    }
}
