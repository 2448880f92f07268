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
    /// JPEG or OpenEXR file. SCALE and BIAS are short for the next two options.
    #[arg(long, value_name = "MAP[:SCALE[:BIAS]]", value_parser = spec)]
    displace: Option<Spec>,

    /// How far a height of 1 (white) moves the surface, in the cage's units. Default: 2 % of the diagonal of the cage's box.
    #[arg(long, value_name = "LENGTH", requires = "displace", allow_negative_numbers = true, value_parser = number)]
    displace_scale: Option<f64>,

    /// How far the surface is moved everywhere, in the cage's units. Default: 0.
    #[arg(long, value_name = "LENGTH", requires = "displace", allow_negative_numbers = true, value_parser = number)]
    displace_bias: Option<f64>,
}

/// A map with the numbers after its name.
#[derive(Clone, Debug, PartialEq)]
struct Spec {
    map: PathBuf,
    numbers: Vec<f64>,
}

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
    /// Heights, scale and bias.
    heights: Option<(HeightMap, f64, f64)>,
    colors: Option<Colors>,
    /// Whether texture coordinates are needed without either.
    plain: bool,
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
        let default = DEFAULT_SCALE * 2.0 * cage.bounds().half_diagonal();
        let scale = self.displace_scale.or(numbers.first().copied()).unwrap_or(default);
        let bias = self.displace_bias.or(numbers.get(1).copied()).unwrap_or(0.0);
        let heights = HeightMap::read(map).map_err(unreadable)?;
        Ok(Maps { heights: Some((heights, scale, bias)), ..Maps::default() })
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
        let displacement = self.heights.as_ref().map(|(map, scale, bias)| Displacement {
            map,
            scale: *scale,
            bias: *bias,
            placement: MapPlacement::default(),
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

/// The colours of the material that has most faces; a surface shows one.
fn colors_of(appearance: &Appearance) -> Result<Colors, Failure> {
    let faces = |m: usize| appearance.face_materials.iter().filter(|&&material| material as usize == m).count();
    let order = |&m: &usize| (appearance.materials[m].base_color_texture.is_some(), faces(m), usize::MAX - m);
    let Some(most) = (0..appearance.materials.len()).max_by_key(order) else {
        return Err(Failure::usage("the model has no materials to be shown").with_hint("name a picture by --texture"));
    };
    if appearance.materials.len() > 1 {
        let (name, others) = (&appearance.materials[most].name, appearance.materials.len() - 1);
        tracing::warn!("all faces are shown in the material {name:?}; the model has {others} more");
    }
    let Material { base_color, base_color_texture, .. } = &appearance.materials[most];
    let factor = base_color.truncate().to_array();
    let Some(Texture { image, uv_set, transform, wrap, .. }) = base_color_texture else {
        return Ok(Colors { map: None, factor, placement: MapPlacement::default() });
    };
    if *uv_set != 0 {
        tracing::warn!("the texture is for the texture coordinates {uv_set}; it is shown with the first ones");
    }
    let image = &appearance.images[*image as usize];
    let map = match &image.source {
        ImageSource::File(path) => ColorMap::read(path),
        ImageSource::Bytes(bytes) => ColorMap::decode(&image.name, bytes),
    };
    let placement = MapPlacement { transform: *transform, wrap: *wrap };
    Ok(Colors { map: Some(map.map_err(unreadable)?), factor, placement })
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
