//! Where prims are: UsdGeom's transform operations.
//!
//! `xformOpOrder` lists operations from the outermost to the innermost: a point goes through the last one first. The file has
//! matrices for points as rows; their numbers in order are the columns of matrices for points as columns, which are used here.

use glam::{DMat4, DQuat, DVec3, EulerRot};

use super::UsdError;
use super::layer::{Layer, Prim};
use super::values::{Time, Values};

/// The transform of a prim within its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Local {
    pub(super) matrix: DMat4,
    /// True if what the parents do does not count.
    pub(super) resets: bool,
}

/// The prefix of operations that are undone.
const INVERSE: &str = "!invert!";
/// The entry that makes a prim independent of its parents.
const RESET: &str = "!resetXformStack!";

/// The names of the operations of a prim, without the prefix of those that are undone.
pub(super) fn operations(prim: &Prim, values: &Values) -> Result<Vec<String>, UsdError> {
    let names = order(prim, values)?;
    Ok(names.into_iter().map(|name| name.strip_prefix(INVERSE).map(str::to_string).unwrap_or(name)).collect())
}

fn order(prim: &Prim, values: &Values) -> Result<Vec<String>, UsdError> {
    match prim.attribute("xformOpOrder").and_then(|order| order.default) {
        Some(value) => values.words(value),
        None => Ok(Vec::new()),
    }
}

/// The transform of a prim at a time.
pub(super) fn local(layer: &Layer, index: u32, values: &Values, time: Time) -> Result<Local, UsdError> {
    let prim = &layer.prims[index as usize];
    let mut local = Local { matrix: DMat4::IDENTITY, resets: false };
    for name in order(prim, values)? {
        if name == RESET {
            local = Local { matrix: DMat4::IDENTITY, resets: true };
            continue;
        }
        let (attribute, inverse) = match name.strip_prefix(INVERSE) {
            Some(rest) => (rest, true),
            None => (name.as_str(), false),
        };
        let matrix =
            operation(prim, attribute, values, time).map_err(|error| layer.at_value(index, attribute, error))?;
        local.matrix *= if inverse { matrix.inverse() } else { matrix };
    }
    if local.matrix.is_finite() {
        return Ok(local);
    }
    Err(UsdError::Attribute {
        prim: layer.shown(index),
        attribute: "xformOpOrder".into(),
        problem: "the transform is not finite".into(),
    })
}

/// The matrix of an operation such as `xformOp:rotateXYZ:pivot`; one without a value does nothing.
fn operation(prim: &Prim, name: &str, values: &Values, time: Time) -> Result<DMat4, UsdError> {
    let kind = name.strip_prefix("xformOp:").unwrap_or(name).split(':').next().unwrap_or_default();
    let size = match kind {
        "translate" | "scale" | "rotateXYZ" | "rotateXZY" | "rotateYXZ" | "rotateYZX" | "rotateZXY" | "rotateZYX" => 3,
        "rotateX" | "rotateY" | "rotateZ" => 1,
        "translateX" | "translateY" | "translateZ" | "scaleX" | "scaleY" | "scaleZ" => 1,
        "orient" => 4,
        "transform" => 16,
        _ => return Err(UsdError::Type("operations that are known")),
    };
    let Some(attribute) = prim.attribute(name) else { return Ok(DMat4::IDENTITY) };
    let Some(numbers) = values.numbers_at(attribute, time, size)? else { return Ok(DMat4::IDENTITY) };
    if numbers.len() != size {
        return Err(UsdError::Type("single values"));
    }
    Ok(matrix(kind, &numbers))
}

/// The matrix of an operation with as many numbers as it needs.
fn matrix(kind: &str, numbers: &[f64]) -> DMat4 {
    // Only three axes have letters.
    let axis = |letter: Option<u8>| match letter {
        Some(b'Y') => DVec3::Y,
        Some(b'Z') => DVec3::Z,
        _ => DVec3::X,
    };
    let last = axis(kind.bytes().last());
    match *numbers {
        [n] if kind.starts_with("translate") => DMat4::from_translation(last * n),
        [n] if kind.starts_with("scale") => DMat4::from_scale(DVec3::ONE + last * (n - 1.0)),
        [degrees] => DMat4::from_axis_angle(last, degrees.to_radians()),
        [x, y, z] => match kind {
            "translate" => DMat4::from_translation(DVec3::new(x, y, z)),
            "scale" => DMat4::from_scale(DVec3::new(x, y, z)),
            _ => rotation(kind, [x, y, z]),
        },
        // The real part comes first. Interpolated ones are not of unit length.
        [w, x, y, z] => DMat4::from_quat(DQuat::from_xyzw(x, y, z, w).normalize()),
        _ => <[f64; 16]>::try_from(numbers).map_or(DMat4::IDENTITY, |array| DMat4::from_cols_array(&array)),
    }
}

/// Rotations about three axes, of which the first letter is done first.
fn rotation(kind: &str, degrees: [f64; 3]) -> DMat4 {
    let [x, y, z] = degrees.map(f64::to_radians);
    // Extrinsic: about axes that stay where they are.
    let (order, [a, b, c]) = match kind {
        "rotateXZY" => (EulerRot::XZYEx, [x, z, y]),
        "rotateYXZ" => (EulerRot::YXZEx, [y, x, z]),
        "rotateYZX" => (EulerRot::YZXEx, [y, z, x]),
        "rotateZXY" => (EulerRot::ZXYEx, [z, x, y]),
        "rotateZYX" => (EulerRot::ZYXEx, [z, y, x]),
        _ => (EulerRot::XYZEx, [x, y, z]),
    };
    DMat4::from_euler(order, a, b, c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_letter_turns_first() {
        let quarter = |kind: &str| matrix(kind, &[90.0, 90.0, 0.0]).transform_vector3(DVec3::Y);
        // About x, y goes to z, and that about y to x.
        assert!(quarter("rotateXYZ").abs_diff_eq(DVec3::X, 1e-12));
        // About y, y stays, and about x goes to z.
        assert!(quarter("rotateYXZ").abs_diff_eq(DVec3::Z, 1e-12));
        for kind in ["rotateXYZ", "rotateXZY", "rotateYXZ", "rotateYZX", "rotateZXY", "rotateZYX"] {
            let whole = matrix(kind, &[10.0, 20.0, 30.0]);
            let about = |axis: u8| {
                let (name, angle) = match axis {
                    b'X' => ("rotateX", 10.0),
                    b'Y' => ("rotateY", 20.0),
                    _ => ("rotateZ", 30.0),
                };
                matrix(name, &[angle])
            };
            let letters = &kind.as_bytes()[6..];
            let expected = about(letters[2]) * about(letters[1]) * about(letters[0]);
            assert!(whole.abs_diff_eq(expected, 1e-12), "{kind}");
        }
    }

    #[test]
    fn single_axes() {
        assert_eq!(matrix("translateY", &[2.0]).transform_point3(DVec3::ONE), DVec3::new(1.0, 3.0, 1.0));
        assert_eq!(matrix("scaleZ", &[2.0]).transform_point3(DVec3::ONE), DVec3::new(1.0, 1.0, 2.0));
    }
}
