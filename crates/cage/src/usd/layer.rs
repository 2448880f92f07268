//! What a file of either form holds, as far as cages need it: prims with their attributes, whose values stay in the file.
//!
//! The words are those of USD: a *layer* is a file, its *prims* are a tree, a prim has *attributes*, and an attribute has a default
//! value, *time samples*, or both.

use super::UsdError;
use super::values::Value;
use crate::LimitError;
use crate::limits::Gauge;
use crate::text::{excerpt, quoted};

/// The prims of a file and what it says about all of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    pub(super) metadata: Metadata,
    /// All prims, parents before their children, in the order of the file.
    pub(super) prims: Vec<Prim>,
}

/// What a file says about itself.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Metadata {
    /// The axis that points up: `b'Y'` or `b'Z'`; Y if nothing is said.
    pub(super) up_axis: Option<u8>,
    /// How many units of the time of samples are a second.
    pub(super) time_codes_per_second: Option<f64>,
    /// How many frames are shown in a second, which stands in for the former.
    pub(super) frames_per_second: Option<f64>,
    /// True if other files are laid over this one.
    pub(super) has_sub_layers: bool,
}

/// Whether a prim exists or only says something about others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Specifier {
    /// `def`: it exists.
    Def,
    /// `over` or `class`: it is there for others that refer to it.
    Other,
}

/// An element of the tree.
#[derive(Clone, Debug)]
pub(super) struct Prim {
    pub(super) name: String,
    /// The prim it is in, by its index.
    pub(super) parent: Option<u32>,
    /// How many prims it is in.
    pub(super) depth: u32,
    pub(super) specifier: Specifier,
    /// The type, such as `Mesh`; empty if there is none.
    pub(super) type_name: String,
    pub(super) active: bool,
    /// What brings in prims from elsewhere, by its name in messages.
    pub(super) arc: Option<&'static str>,
    /// The attributes that [`is_used`], and relationships as attributes with paths.
    pub(super) attributes: Vec<Attribute>,
}

/// A property of a prim.
#[derive(Clone, Debug, Default)]
pub(super) struct Attribute {
    pub(super) name: String,
    /// The type, such as `point3f[]`.
    pub(super) type_name: String,
    pub(super) default: Option<Value>,
    /// Values by time, in rising order.
    pub(super) samples: Vec<Sample>,
    /// What the values of a primvar belong to, such as `faceVarying`.
    pub(super) interpolation: Option<String>,
}

/// A value at a time.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub(super) time: f64,
    pub(super) value: Value,
}

/// Prims may be nested that deep; paths of all of them stay short.
const DEEPEST: u32 = 256;

/// A prim may have so many attributes that are used; they are searched one by one.
const MOST_ATTRIBUTES: usize = 1024;

impl Layer {
    /// Adds a prim, of which the parent is there.
    pub(super) fn add_prim(&mut self, prim: Prim, gauge: &mut Gauge) -> Result<u32, UsdError> {
        if prim.depth > DEEPEST {
            return Err(UsdError::TooDeep(DEEPEST));
        }
        gauge.bytes((size_of::<Prim>() + prim.name.len() + prim.type_name.len()) as u64)?;
        let index = u32::try_from(self.prims.len()).map_err(|_| LimitError::Memory { limit: u64::from(u32::MAX) })?;
        self.prims.push(prim);
        Ok(index)
    }

    /// A new prim in `parent`.
    pub(super) fn child(&self, parent: Option<u32>, specifier: Specifier, type_name: String, name: String) -> Prim {
        let depth = parent.map_or(0, |parent| self.prims[parent as usize].depth + 1);
        Prim { name, parent, depth, specifier, type_name, active: true, arc: None, attributes: Vec::new() }
    }

    /// The path of a prim, such as `/World/Cube`.
    pub(super) fn path(&self, prim: u32) -> String {
        let mut names = Vec::new();
        let mut next = Some(prim);
        while let Some(index) = next {
            let prim = &self.prims[index as usize];
            names.push(prim.name.as_str());
            next = prim.parent;
        }
        names.iter().rev().flat_map(|name| ["/", name]).collect()
    }

    /// The path of a prim for a message.
    pub(super) fn shown(&self, prim: u32) -> String {
        excerpt(&self.path(prim), 200)
    }

    /// An error in a value of an attribute, with its place.
    pub(super) fn at_value(&self, prim: u32, attribute: &str, error: UsdError) -> UsdError {
        if matches!(error, UsdError::Limit(_)) {
            return error;
        }
        UsdError::Value { prim: self.shown(prim), attribute: quoted(attribute.as_bytes()), error: Box::new(error) }
    }

    /// How many units of the time of samples are a second; 24 if nothing is said.
    pub(super) fn time_codes_per_second(&self) -> f64 {
        let Metadata { time_codes_per_second, frames_per_second, .. } = self.metadata;
        let usable = |rate: &f64| rate.is_finite() && *rate > 0.0;
        time_codes_per_second.filter(usable).or(frames_per_second.filter(usable)).unwrap_or(24.0)
    }
}

impl Prim {
    /// The attribute of a name.
    pub(super) fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|attribute| attribute.name == name)
    }

    /// The attribute of a name, which is added if it is not there: default value and samples are separate statements.
    pub(super) fn attribute_mut(&mut self, name: &str, gauge: &mut Gauge) -> Result<&mut Attribute, UsdError> {
        let index = match self.attributes.iter().position(|attribute| attribute.name == name) {
            Some(index) => index,
            None if self.attributes.len() >= MOST_ATTRIBUTES => {
                return Err(UsdError::TooManyAttributes(MOST_ATTRIBUTES));
            }
            None => {
                gauge.bytes((size_of::<Attribute>() + name.len()) as u64)?;
                self.attributes.push(Attribute { name: name.into(), ..Attribute::default() });
                self.attributes.len() - 1
            }
        };
        Ok(&mut self.attributes[index])
    }
}

/// True for the properties that a cage is made of. Others are passed over unread.
pub(super) fn is_used(property: &str) -> bool {
    const NAMES: [&str; 20] = [
        "cornerIndices",
        "cornerSharpnesses",
        "creaseIndices",
        "creaseLengths",
        "creaseSharpnesses",
        "faceVaryingLinearInterpolation",
        "faceVertexCounts",
        "faceVertexIndices",
        "familyName",
        "holeIndices",
        "indices",
        "interpolateBoundary",
        "material:binding",
        "orientation",
        "points",
        "purpose",
        "subdivisionScheme",
        "triangleSubdivisionRule",
        "visibility",
        "xformOpOrder",
    ];
    NAMES.binary_search(&property).is_ok() || property.starts_with("xformOp:") || property.starts_with("primvars:")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn used_properties_are_found() {
        for name in ["points", "cornerIndices", "xformOpOrder", "primvars:st:indices", "xformOp:translate", "indices"] {
            assert!(is_used(name), "{name}");
        }
        assert!(!is_used("extent") && !is_used("normals"));
    }
}
