//! A mesh of a scene, added to a cage.

use glam::DMat4;

use super::UsdError;
use super::layer::{Attribute, Layer, Prim};
use super::primvar;
use super::scene::placed;
use super::values::{Time, Values};
use crate::face_sets::FaceSets;
use crate::limits::Gauge;
use crate::weld::Welder;
use crate::{BoundaryRule, CageDesc, Corner, Crease, FaceSetKind, FaceVarying, Listed, NONE, Warning};

/// Collects meshes.
pub(super) struct Collector<'a> {
    pub(super) layer: &'a Layer,
    pub(super) values: &'a Values<'a>,
    pub(super) gauge: &'a mut Gauge,
    /// True if faces with fewer than three corners are left for a repair.
    pub(super) keep_small: bool,
    pub(super) desc: CageDesc,
    uv: FaceVarying,
    sets: FaceSets,
    /// The rules of the first mesh.
    rules: Option<Rules>,
    /// Meshes with other rules.
    other_rules: Listed<String>,
    /// Meshes that are not to be smoothed by Catmull and Clark's scheme.
    other_schemes: Listed<String>,
}

/// What a cage has only once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Rules {
    boundary: BoundaryRule,
    face_varying: Option<u8>,
    smooth_triangles: bool,
}

/// The faces of a mesh, as the file numbers them.
pub(super) struct Faces {
    pub(super) counts: Vec<usize>,
    pub(super) vertices: Vec<u32>,
    pub(super) points: usize,
    /// True if the corners of each face are to be walked backwards.
    pub(super) reversed: bool,
}

/// A mesh that is being read, for messages.
#[derive(Clone, Copy)]
pub(super) struct Mesh<'a> {
    pub(super) layer: &'a Layer,
    pub(super) values: &'a Values<'a>,
    pub(super) index: u32,
    pub(super) time: Time,
}

impl<'a> Collector<'a> {
    pub(super) fn new(layer: &'a Layer, values: &'a Values<'a>, gauge: &'a mut Gauge, keep_small: bool) -> Self {
        let desc = CageDesc { face_offsets: vec![0], ..CageDesc::default() };
        Self {
            layer,
            values,
            gauge,
            keep_small,
            desc,
            uv: FaceVarying::default(),
            sets: FaceSets::default(),
            rules: None,
            other_rules: Listed::default(),
            other_schemes: Listed::default(),
        }
    }

    /// Adds a mesh.
    pub(super) fn add(&mut self, index: u32, place: &DMat4, time: Time) -> Result<(), UsdError> {
        let mesh = Mesh { layer: self.layer, values: self.values, index, time };
        let first_vertex = self.desc.positions.len() as u32;
        let first_face = self.desc.face_offsets.len() as u32 - 1;
        let points = mesh.points()?;
        let faces = mesh.faces(points.len() / 3, place.determinant() < 0.0)?;
        self.gauge_all(&faces)?;
        self.desc.positions.extend(placed(&points, place));
        if self.desc.positions.len() >= NONE as usize {
            return Err(UsdError::TooMany("vertices"));
        }
        self.add_faces(&mesh, &faces, first_vertex)?;
        self.add_uv(&mesh, &faces)?;
        self.add_tags(&mesh, &faces, first_vertex, first_face)?;
        self.add_sets(&mesh, faces.counts.len(), first_face)
    }

    /// Ends the collection.
    pub(super) fn finish(mut self) -> CageDesc {
        let faces = self.desc.face_offsets.len() as u32 - 1;
        self.desc.face_sets = self.sets.finish(faces);
        self.desc.uv = self.uv.finish(&self.desc.face_offsets, &mut self.desc.warnings);
        if let Some(rules) = self.rules {
            self.desc.tags.boundary = Some(rules.boundary).filter(|&boundary| boundary != BoundaryRule::default());
            self.desc.tags.face_varying_boundary = rules.face_varying;
            self.desc.tags.smooth_triangles = rules.smooth_triangles;
        }
        if !self.other_rules.is_empty() {
            self.desc.warnings.push(Warning::UsdRules(self.other_rules));
        }
        if !self.other_schemes.is_empty() {
            self.desc.warnings.push(Warning::UsdSchemes(self.other_schemes));
        }
        self.desc
    }

    fn gauge_all(&mut self, faces: &Faces) -> Result<(), UsdError> {
        for _ in 0..faces.points {
            self.gauge.vertex()?;
        }
        for &corners in &faces.counts {
            self.gauge.face(corners)?;
        }
        Ok(())
    }

    fn add_faces(&mut self, mesh: &Mesh, faces: &Faces, first_vertex: u32) -> Result<(), UsdError> {
        let mut start = 0;
        for (f, &count) in faces.counts.iter().enumerate() {
            if count < 3 && !self.keep_small {
                let problem = format!("face {f} has {}; faces have at least 3", crate::listed::plural(count, "corner"));
                return Err(mesh.problem("faceVertexCounts", problem));
            }
            let corners = faces.order(start, count).map(|corner| faces.vertices[corner] + first_vertex);
            self.desc.face_vertices.extend(corners);
            start += count;
            let end = u32::try_from(self.desc.face_vertices.len()).ok().filter(|&end| end != NONE);
            self.desc.face_offsets.push(end.ok_or(UsdError::TooMany("face corners"))?);
        }
        Ok(())
    }

    fn add_uv(&mut self, mesh: &Mesh, faces: &Faces) -> Result<(), UsdError> {
        let Some(primvar) = primvar::texture_coordinates(mesh, faces)? else {
            self.uv.indices.resize(self.desc.face_vertices.len(), NONE);
            return Ok(());
        };
        let mut welder = Welder::default();
        let mut known: Vec<u32> = Vec::with_capacity(primvar.values.len());
        let first = self.uv.values.len() as u32;
        for &value in &primvar.values {
            self.gauge.uv()?;
            // Values that no index tells apart are one if they are equal, so that corners without a seam between them are joined.
            let (index, new) = if primvar.is_numbered {
                (self.uv.values.len() as u32 - first, true)
            } else {
                welder.weld(value.to_array(), 0)
            };
            if new {
                self.uv.values.push(value);
            }
            known.push(first + index);
        }
        let mut start = 0;
        for &count in &faces.counts {
            let corners = faces.order(start, count);
            self.uv.indices.extend(corners.map(|corner| known[primvar.corners[corner] as usize]));
            start += count;
        }
        Ok(())
    }

    fn add_tags(&mut self, mesh: &Mesh, faces: &Faces, first_vertex: u32, first_face: u32) -> Result<(), UsdError> {
        let creases = creases(mesh, faces.points)?;
        let corners = corners(mesh, faces.points)?;
        let holes = mesh.indices("holeIndices", "face", faces.counts.len())?;
        self.gauge.tags(creases.len() + corners.len() + holes.len())?;
        let tags = &mut self.desc.tags;
        tags.creases.extend(
            creases.into_iter().map(|crease| Crease { vertices: crease.vertices.map(|v| v + first_vertex), ..crease }),
        );
        let moved = |corner: Corner| Corner { vertex: corner.vertex + first_vertex, ..corner };
        tags.corners.extend(corners.into_iter().map(moved));
        tags.holes.extend(holes.into_iter().map(|face| face + first_face));
        let rules = rules(mesh)?;
        if *self.rules.get_or_insert(rules) != rules {
            self.other_rules.push(self.layer.shown(mesh.index));
        }
        if mesh.word("subdivisionScheme")?.is_some_and(|scheme| scheme != "catmullClark") {
            self.other_schemes.push(self.layer.shown(mesh.index));
        }
        Ok(())
    }

    /// The mesh as an object, and its materials.
    fn add_sets(&mut self, mesh: &Mesh, faces: usize, first_face: u32) -> Result<(), UsdError> {
        self.sets.switch(FaceSetKind::Object, std::iter::once(self.layer.path(mesh.index)), first_face);
        let mut names: Vec<Option<String>> = vec![mesh.material()?];
        let mut of_faces = vec![0_u32; faces];
        for subset in mesh.subsets() {
            let Some(material) = subset.material()? else { continue };
            for face in subset.indices("indices", "face", faces)? {
                of_faces[face as usize] = names.len() as u32;
            }
            names.push(Some(material));
        }
        let mut last = None;
        for (face, of_face) in (first_face..).zip(of_faces) {
            if last != Some(of_face) {
                self.sets.switch(FaceSetKind::Material, names[of_face as usize].iter().cloned(), face);
                last = Some(of_face);
            }
        }
        Ok(())
    }
}

impl Faces {
    /// The corners of a face that starts at `start`, in the order of the cage. The first one stays the first.
    pub(super) fn order(&self, start: usize, count: usize) -> impl Iterator<Item = usize> + use<> {
        let reversed = self.reversed;
        (0..count).map(move |i| start + if reversed { (count - i) % count } else { i })
    }
}

impl<'a> Mesh<'a> {
    pub(super) fn prim(&self) -> &'a Prim {
        &self.layer.prims[self.index as usize]
    }

    /// The subsets of the faces.
    fn subsets(self) -> impl Iterator<Item = Self> {
        let depth = self.prim().depth;
        let within = (self.index + 1..).zip(&self.layer.prims[self.index as usize + 1..]);
        let within = within.take_while(move |(_, prim)| prim.depth > depth);
        let subset = move |(_, prim): &(u32, &Prim)| prim.depth == depth + 1 && prim.type_name == "GeomSubset";
        within.filter(subset).map(move |(index, _)| Self { index, ..self })
    }

    /// The name of the material.
    fn material(&self) -> Result<Option<String>, UsdError> {
        let path = self.word("material:binding")?;
        Ok(path.map(|path| path.rsplit('/').next().unwrap_or_default().to_string()))
    }

    /// The coordinates of the points.
    pub(super) fn points(&self) -> Result<Vec<f64>, UsdError> {
        let missing = || UsdError::Missing { prim: self.layer.shown(self.index), attribute: "points" };
        let attribute = self.prim().attribute("points").ok_or_else(missing)?;
        let points = self.values.numbers_at(attribute, self.time, 3).map_err(|error| self.value("points", error))?;
        let points = points.ok_or_else(missing)?;
        match points.iter().position(|number| !number.is_finite()) {
            Some(bad) => Err(self.problem("points", format!("point {} is not finite", bad / 3))),
            None => Ok(points),
        }
    }

    /// The faces of a mesh with so many points.
    pub(super) fn faces(&self, points: usize, mirrored: bool) -> Result<Faces, UsdError> {
        let prim = self.prim();
        for attribute in ["faceVertexCounts", "faceVertexIndices"] {
            if prim.attribute(attribute).is_none() {
                return Err(UsdError::Missing { prim: self.layer.shown(self.index), attribute });
            }
        }
        let mut counts = Vec::new();
        for (f, count) in self.integers("faceVertexCounts")?.into_iter().enumerate() {
            let count = usize::try_from(count);
            counts.push(
                count.map_err(|_| self.problem("faceVertexCounts", format!("face {f} has less than 0 corners")))?,
            );
        }
        let vertices = self.indices("faceVertexIndices", "vertex", points)?;
        let due = counts.iter().fold(0, |sum: usize, &count| sum.saturating_add(count));
        self.count("faceVertexIndices", vertices.len(), due, "the sum of faceVertexCounts")?;
        let left = match self.word("orientation")?.as_deref() {
            None | Some("rightHanded") => false,
            Some("leftHanded") => true,
            Some(other) => return Err(self.unknown("orientation", other)),
        };
        Ok(Faces { counts, vertices, points, reversed: left != mirrored })
    }

    pub(super) fn integers(&self, name: &str) -> Result<Vec<i64>, UsdError> {
        self.values.integers_at(self.prim().attribute(name), self.time).map_err(|error| self.value(name, error))
    }

    /// Numbers, none if there is no such attribute.
    pub(super) fn numbers(&self, name: &str, size: usize) -> Result<Vec<f64>, UsdError> {
        let Some(attribute) = self.prim().attribute(name) else { return Ok(Vec::new()) };
        let numbers = self.values.numbers_at(attribute, self.time, size);
        Ok(numbers.map_err(|error| self.value(name, error))?.unwrap_or_default())
    }

    /// Indices that name one of `count` elements each.
    pub(super) fn indices(&self, name: &str, noun: &'static str, count: usize) -> Result<Vec<u32>, UsdError> {
        let checked = |(index, value): (usize, i64)| match usize::try_from(value).ok().filter(|&i| i < count) {
            Some(found) => Ok(found as u32),
            None => Err(UsdError::Index {
                prim: self.layer.shown(self.index),
                attribute: name.into(),
                index,
                value,
                noun,
                count,
            }),
        };
        self.integers(name)?.into_iter().enumerate().map(checked).collect()
    }

    pub(super) fn word(&self, name: &str) -> Result<Option<String>, UsdError> {
        self.values.word(self.prim().attribute(name)).map_err(|error| self.value(name, error))
    }

    /// Refuses other numbers of values than are due.
    pub(super) fn count(&self, name: &str, found: usize, due: usize, why: &'static str) -> Result<(), UsdError> {
        if found == due {
            return Ok(());
        }
        Err(UsdError::Count { prim: self.layer.shown(self.index), attribute: name.into(), found, due, why })
    }

    pub(super) fn problem(&self, name: &str, problem: String) -> UsdError {
        UsdError::Attribute { prim: self.layer.shown(self.index), attribute: name.into(), problem }
    }

    pub(super) fn value(&self, name: &str, error: UsdError) -> UsdError {
        self.layer.at_value(self.index, name, error)
    }

    fn unknown(&self, name: &str, word: &str) -> UsdError {
        self.problem(name, format!("{:?} is no value that it can have", crate::text::quoted(word.as_bytes())))
    }

    /// The place of a token among those that an attribute can have; `None` if nothing is said.
    fn choice<T: Copy>(&self, name: &str, choices: &[(&str, T)]) -> Result<Option<T>, UsdError> {
        let Some(word) = self.word(name)? else { return Ok(None) };
        let found = choices.iter().find(|(choice, _)| *choice == word).map(|&(_, value)| value);
        found.map(Some).ok_or_else(|| self.unknown(name, &word))
    }
}

/// Chains of vertices, each with one sharpness or one for each of its edges.
fn creases(mesh: &Mesh, vertices: usize) -> Result<Vec<Crease>, UsdError> {
    let indices = mesh.indices("creaseIndices", "vertex", vertices)?;
    let sharpness = mesh.numbers("creaseSharpnesses", 1)?;
    let mut lengths = Vec::new();
    for (i, length) in mesh.integers("creaseLengths")?.into_iter().enumerate() {
        let length = usize::try_from(length).ok().filter(|&length| length >= 2);
        lengths.push(
            length.ok_or_else(|| mesh.problem("creaseLengths", format!("crease {i} has fewer than 2 vertices")))?,
        );
    }
    let sum = lengths.iter().fold(0, |sum: usize, &length| sum.saturating_add(length));
    mesh.count("creaseIndices", indices.len(), sum, "the sum of creaseLengths")?;
    let edges = sum - lengths.len();
    let each_edge = sharpness.len() != lengths.len();
    if each_edge {
        mesh.count(
            "creaseSharpnesses",
            sharpness.len(),
            edges,
            "one for each edge unless there is one for each crease",
        )?;
    }
    let (mut start, mut creases) = (0, Vec::with_capacity(edges));
    for (i, &length) in lengths.iter().enumerate() {
        for pair in indices[start..start + length].windows(2) {
            let sharpness = sharpness[if each_edge { creases.len() } else { i }] as f32;
            creases.push(Crease { vertices: [pair[0], pair[1]], sharpness });
        }
        start += length;
    }
    Ok(creases)
}

fn corners(mesh: &Mesh, vertices: usize) -> Result<Vec<Corner>, UsdError> {
    let indices = mesh.indices("cornerIndices", "vertex", vertices)?;
    let sharpness = mesh.numbers("cornerSharpnesses", 1)?;
    mesh.count("cornerSharpnesses", sharpness.len(), indices.len(), "one for each of cornerIndices")?;
    let corner = |(vertex, sharpness): (u32, f64)| Corner { vertex, sharpness: sharpness as f32 };
    Ok(indices.into_iter().zip(sharpness).map(corner).collect())
}

fn rules(mesh: &Mesh) -> Result<Rules, UsdError> {
    let boundary = [
        ("none", BoundaryRule::None),
        ("edgeOnly", BoundaryRule::EdgeOnly),
        ("edgeAndCorner", BoundaryRule::EdgeAndCorner),
    ];
    let face_varying =
        [("none", 0), ("cornersOnly", 1), ("cornersPlus1", 2), ("cornersPlus2", 3), ("boundaries", 4), ("all", 5)];
    Ok(Rules {
        boundary: mesh.choice("interpolateBoundary", &boundary)?.unwrap_or_default(),
        face_varying: mesh.choice("faceVaryingLinearInterpolation", &face_varying)?,
        smooth_triangles: mesh
            .choice("triangleSubdivisionRule", &[("catmullClark", false), ("smooth", true)])?
            .unwrap_or_default(),
    })
}

/// The attribute of texture coordinates: `primvars:st`, else the first of its type by name.
pub(super) fn texture_attribute<'a>(prim: &'a Prim) -> Option<&'a Attribute> {
    let typed = |attribute: &&'a Attribute| {
        attribute.type_name.starts_with("texCoord2") && attribute.name.starts_with("primvars:")
    };
    let known = ["primvars:st", "primvars:UVMap"].iter().find_map(|name| prim.attribute(name));
    known.or_else(|| prim.attributes.iter().filter(typed).min_by(|a, b| a.name.cmp(&b.name)))
}
