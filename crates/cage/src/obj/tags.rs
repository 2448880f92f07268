//! The `t` statements of OpenSubdiv: `t NAME INTS/FLOATS/STRINGS ARGUMENTS`, where the counts say how many arguments of each kind
//! follow. Indices count from 0, unlike those of faces.

use super::ObjError;
use super::numbers::number;
use crate::draft::SourceLines;
use crate::text::{integer, quoted};
use crate::{BoundaryRule, Corner, Crease, CreaseMethod, Tags};

/// The arguments of a tag, by kind.
struct Arguments<'a> {
    ints: &'a [&'a [u8]],
    floats: &'a [&'a [u8]],
    strings: &'a [&'a [u8]],
}

/// Adds the tag with these words (after `t`) to `tags`. Returns the name of a tag that is not known.
pub(super) fn parse<'a>(
    words: &'a [&'a [u8]],
    line: u32,
    tags: &mut Tags,
    lines: &mut SourceLines,
) -> Result<Option<&'a [u8]>, ObjError> {
    let (name, arguments) = split(words)?;
    match name {
        b"crease" => {
            tags.creases.extend(creases(&arguments)?);
            lines.creases.resize(tags.creases.len(), line);
        }
        b"corner" => {
            tags.corners.extend(corners(&arguments)?);
            lines.corners.resize(tags.corners.len(), line);
        }
        b"hole" => {
            tags.holes.extend(holes(&arguments)?);
            lines.holes.resize(tags.holes.len(), line);
        }
        b"interpolateboundary" => tags.boundary = Some(boundary(&arguments)?),
        b"facevaryinginterpolateboundary" => tags.face_varying_boundary = Some(face_varying_boundary(&arguments)?),
        b"creasemethod" => tags.crease_method = crease_method(&arguments)?,
        b"smoothtriangles" => tags.smooth_triangles = smooth_triangles(&arguments)?,
        _ => return Ok(Some(name)),
    }
    Ok(None)
}

fn split<'a>(words: &'a [&'a [u8]]) -> Result<(&'a [u8], Arguments<'a>), ObjError> {
    let [name, counts, arguments @ ..] = words else { return Err(ObjError::TagForm) };
    let counts: Option<Vec<usize>> =
        counts.split(|&b| b == b'/').map(|n| integer(n).and_then(|n| n.try_into().ok())).collect();
    let Some(&[ints, floats, strings]) = counts.as_deref() else { return Err(ObjError::TagForm) };
    let announced = ints.saturating_add(floats).saturating_add(strings);
    if announced != arguments.len() {
        return Err(ObjError::TagCount { name: quoted(name), announced, found: arguments.len() });
    }
    let (ints, rest) = arguments.split_at(ints);
    let (floats, strings) = rest.split_at(floats);
    Ok((name, Arguments { ints, floats, strings }))
}

fn index(word: &[u8]) -> Result<u32, ObjError> {
    integer(word).and_then(|i| i.try_into().ok()).ok_or_else(|| ObjError::TagIndex(quoted(word)))
}

/// Sharpness of each of `elements` elements: one for all, or one for each.
fn sharpness(floats: &[&[u8]], elements: usize, wrong: ObjError) -> Result<Vec<f32>, ObjError> {
    if floats.len() != 1 && floats.len() != elements {
        return Err(wrong);
    }
    let values: Vec<f32> = floats.iter().map(|word| number(word).map(|s| s as f32)).collect::<Result<_, _>>()?;
    Ok(if values.len() == elements { values } else { vec![values[0]; elements] })
}

fn creases(arguments: &Arguments) -> Result<Vec<Crease>, ObjError> {
    let expected = "pairs of vertices and one sharpness, or one for each pair: `t crease 2/1/0 0 1 2.5`";
    let wrong = ObjError::TagArguments { name: "crease", expected };
    let Arguments { ints, floats, strings: [] } = arguments else { return Err(wrong) };
    if ints.is_empty() || ints.len() % 2 != 0 {
        return Err(wrong);
    }
    let sharpness = sharpness(floats, ints.len() / 2, wrong)?;
    let crease =
        |(pair, sharpness): (&[&[u8]], f32)| Ok(Crease { vertices: [index(pair[0])?, index(pair[1])?], sharpness });
    ints.chunks_exact(2).zip(sharpness).map(crease).collect()
}

fn corners(arguments: &Arguments) -> Result<Vec<Corner>, ObjError> {
    let expected = "vertices and one sharpness, or one for each vertex: `t corner 1/1/0 0 2.5`";
    let wrong = ObjError::TagArguments { name: "corner", expected };
    let Arguments { ints, floats, strings: [] } = arguments else { return Err(wrong) };
    if ints.is_empty() {
        return Err(wrong);
    }
    let sharpness = sharpness(floats, ints.len(), wrong)?;
    ints.iter().zip(sharpness).map(|(vertex, sharpness)| Ok(Corner { vertex: index(vertex)?, sharpness })).collect()
}

fn holes(arguments: &Arguments) -> Result<Vec<u32>, ObjError> {
    match arguments {
        Arguments { ints: [], .. } => {
            Err(ObjError::TagArguments { name: "hole", expected: "faces: `t hole 2/0/0 3 4`" })
        }
        Arguments { ints, floats: [], strings: [] } => ints.iter().map(|face| index(face)).collect(),
        _ => Err(ObjError::TagArguments { name: "hole", expected: "faces: `t hole 2/0/0 3 4`" }),
    }
}

fn boundary(arguments: &Arguments) -> Result<BoundaryRule, ObjError> {
    match arguments {
        Arguments { ints: [b"0"], floats: [], strings: [] } => Ok(BoundaryRule::None),
        Arguments { ints: [b"1"], floats: [], strings: [] } => Ok(BoundaryRule::EdgeAndCorner),
        Arguments { ints: [b"2"], floats: [], strings: [] } => Ok(BoundaryRule::EdgeOnly),
        _ => Err(ObjError::TagArguments {
            name: "interpolateboundary",
            expected: "0 (none), 1 (edge and corner) or 2 (edge only): `t interpolateboundary 1/0/0 1`",
        }),
    }
}

fn face_varying_boundary(arguments: &Arguments) -> Result<u8, ObjError> {
    match arguments {
        Arguments { ints: [[digit @ b'0'..=b'5']], floats: [], strings: [] } => Ok(digit - b'0'),
        _ => Err(ObjError::TagArguments {
            name: "facevaryinginterpolateboundary",
            expected: "a number from 0 to 5: `t facevaryinginterpolateboundary 1/0/0 1`",
        }),
    }
}

fn crease_method(arguments: &Arguments) -> Result<CreaseMethod, ObjError> {
    match arguments {
        Arguments { ints: [], floats: [], strings: [b"normal"] } => Ok(CreaseMethod::Normal),
        Arguments { ints: [], floats: [], strings: [b"chaikin"] } => Ok(CreaseMethod::Chaikin),
        _ => Err(ObjError::TagArguments {
            name: "creasemethod",
            expected: "normal or chaikin: `t creasemethod 0/0/1 chaikin`",
        }),
    }
}

fn smooth_triangles(arguments: &Arguments) -> Result<bool, ObjError> {
    match arguments {
        Arguments { ints: [], floats: [], strings: [b"catmark"] } => Ok(false),
        Arguments { ints: [], floats: [], strings: [b"smooth"] } => Ok(true),
        _ => Err(ObjError::TagArguments {
            name: "smoothtriangles",
            expected: "catmark or smooth: `t smoothtriangles 0/0/1 smooth`",
        }),
    }
}
