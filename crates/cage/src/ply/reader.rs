//! From elements to a cage.

use glam::{DVec2, DVec3};

use super::PlyError;
use super::header::{self, Element, Kind, Scalar};
use super::source::{At, Source};
use crate::draft::{Draft, SourceLines};
use crate::limits::Gauge;
use crate::weld::Welder;
use crate::{CageDesc, FaceVarying, NONE, ReadDesc, Warning};

/// Names of the pairs of texture coordinates of a vertex.
const UV: [[&str; 2]; 4] = [["s", "t"], ["u", "v"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];

pub(super) fn parse(bytes: &[u8], desc: &ReadDesc) -> Result<Draft, PlyError> {
    let gauge = Gauge::new(desc, bytes)?;
    let header = header::parse(bytes)?;
    let mut source = Source::new(bytes, &header);
    let mut reader = Reader::new(gauge, desc.repair.is_some());
    for element in &header.elements {
        // Rows of nothing take no time, however many there are.
        if element.properties.is_empty() {
            continue;
        }
        if element.count > source.room(element) {
            let index = source.room(element);
            return Err(PlyError::Truncated { element: element.name(), index, count: element.count });
        }
        match &element.name[..] {
            b"vertex" => reader.vertices(element, &mut source)?,
            b"face" => reader.faces(element, &mut source)?,
            _ => reader.others(element, &mut source)?,
        }
    }
    reader.finish(source.left())
}

struct Reader {
    desc: CageDesc,
    has_vertices: bool,
    has_faces: bool,
    /// One per vertex, if vertices have texture coordinates.
    vertex_uv: Vec<DVec2>,
    /// Those of face corners.
    corner_uv: FaceVarying,
    welder: Welder<2>,
    lines: SourceLines,
    gauge: Gauge,
    keep_small: bool,
}

/// Where a row keeps what is wanted of a vertex.
struct VertexRow {
    xyz: [usize; 3],
    uv: Option<[usize; 2]>,
}

impl VertexRow {
    fn of(element: &Element) -> Result<Option<Self>, PlyError> {
        let pair = |names: &[&str; 2]| Some([element.find(&names[..1])?, element.find(&names[1..])?]);
        let [Some(x), Some(y), Some(z)] = ["x", "y", "z"].map(|name| element.find(&[name])) else { return Ok(None) };
        let row = Self { xyz: [x, y, z], uv: UV.iter().find_map(pair) };
        for property in row.xyz.iter().chain(row.uv.iter().flatten()).map(|&i| &element.properties[i]) {
            if let Kind::List { .. } = property.kind {
                let property = String::from_utf8_lossy(&property.name).into_owned();
                return Err(PlyError::Type { element: "vertex", property, found: "a list", expected: "a number" });
            }
        }
        Ok(Some(row))
    }

    /// The place of property `i` among x, y, z, u, v.
    fn slot(&self, i: usize) -> Option<usize> {
        let wanted = self.xyz.iter().chain(self.uv.iter().flatten());
        wanted.enumerate().find(|&(_, &property)| property == i).map(|(slot, _)| slot)
    }
}

impl Reader {
    fn new(gauge: Gauge, keep_small: bool) -> Self {
        Self {
            desc: CageDesc { face_offsets: vec![0], ..CageDesc::default() },
            has_vertices: false,
            has_faces: false,
            vertex_uv: Vec::new(),
            corner_uv: FaceVarying::default(),
            welder: Welder::default(),
            lines: SourceLines::default(),
            gauge,
            keep_small,
        }
    }

    fn vertices(&mut self, element: &Element, source: &mut Source<'_>) -> Result<(), PlyError> {
        let Some(row) = VertexRow::of(element)? else { return self.others(element, source) };
        self.has_vertices = true;
        if element.count >= u64::from(NONE) {
            return Err(PlyError::TooMany("vertices"));
        }
        let slots: Vec<Option<usize>> = (0..element.properties.len()).map(|i| row.slot(i)).collect();
        for index in 0..element.count {
            let at = At { element, index };
            self.gauge.left(source.left_bytes())?;
            self.gauge.vertex()?;
            let mut values = [0.0; 5];
            for (property, slot) in element.properties.iter().zip(&slots) {
                match (property.kind, slot) {
                    (Kind::Scalar(scalar), &Some(slot)) => values[slot] = source.number(scalar, at)?,
                    (kind, _) => source.skip(kind, at, &mut self.gauge)?,
                }
            }
            if !values.iter().all(|value| value.is_finite()) {
                return Err(PlyError::NotFinite { element: "vertex", index });
            }
            let [x, y, z, u, v] = values;
            self.desc.positions.push(DVec3::new(x, y, z));
            if row.uv.is_some() {
                self.gauge.uv()?;
                self.vertex_uv.push(DVec2::new(u, v));
            }
        }
        Ok(())
    }

    fn faces(&mut self, element: &Element, source: &mut Source<'_>) -> Result<(), PlyError> {
        let corners = list(element, &["vertex_indices", "vertex_index"])?;
        let Some((corners, index_type)) = corners else { return self.others(element, source) };
        self.has_faces = true;
        if !index_type.is_integer() {
            let property = element.properties[corners].name.clone();
            let property = String::from_utf8_lossy(&property).into_owned();
            let (found, expected) = ("a list of floating point numbers", "a list of integers");
            return Err(PlyError::Type { element: "face", property, found, expected });
        }
        let texcoord = list(element, &["texcoord"])?.map(|(property, _)| property);
        let mut coordinates = Vec::new();
        for index in 0..element.count {
            let at = At { element, index };
            self.gauge.left(source.left_bytes())?;
            if source.is_text() {
                self.lines.faces.push(source.line());
            }
            coordinates.clear();
            for (i, property) in element.properties.iter().enumerate() {
                match property.kind {
                    Kind::List { count, value } if i == corners => self.corners(count, value, at, source)?,
                    Kind::List { count, value } if Some(i) == texcoord => {
                        for _ in 0..source.length(count, value, at)? {
                            self.gauge.part()?;
                            coordinates.push(source.number(value, at)?);
                        }
                    }
                    kind => source.skip(kind, at, &mut self.gauge)?,
                }
            }
            self.texture_corners(&coordinates, index)?;
        }
        Ok(())
    }

    fn corners(&mut self, count: Scalar, value: Scalar, at: At<'_>, source: &mut Source<'_>) -> Result<(), PlyError> {
        let length = source.length(count, value, at)?;
        self.gauge.face(length)?;
        if length < 3 && !self.keep_small {
            return Err(PlyError::TooFewCorners { face: at.index, corners: length });
        }
        for _ in 0..length {
            self.gauge.part()?;
            let index = source.integer(value, at)?;
            // How many vertices there are may be known later only.
            let vertex = u32::try_from(index).ok().filter(|&v| v != NONE);
            let wrong = || PlyError::Index { face: at.index, index, vertices: self.desc.positions.len() };
            self.desc.face_vertices.push(vertex.ok_or_else(wrong)?);
        }
        let end = u32::try_from(self.desc.face_vertices.len()).ok().filter(|&end| end != NONE);
        self.desc.face_offsets.push(end.ok_or(PlyError::TooMany("face corners"))?);
        Ok(())
    }

    /// Gives the corners of the last face their texture coordinates: two numbers for each, or none at all.
    fn texture_corners(&mut self, coordinates: &[f64], face: u64) -> Result<(), PlyError> {
        let corners = self.desc.face_vertices.len() - self.corner_uv.indices.len();
        if coordinates.is_empty() {
            self.corner_uv.indices.extend(std::iter::repeat_n(NONE, corners));
            return Ok(());
        }
        if coordinates.len() != 2 * corners {
            return Err(PlyError::Texcoords { face, found: coordinates.len(), corners });
        }
        for pair in coordinates.chunks_exact(2) {
            if !pair.iter().all(|x| x.is_finite()) {
                return Err(PlyError::NotFinite { element: "face", index: face });
            }
            let (index, new) = self.welder.weld([pair[0], pair[1]], 0);
            if new {
                self.gauge.uv()?;
                self.corner_uv.values.push(DVec2::new(pair[0], pair[1]));
            }
            self.corner_uv.indices.push(index);
        }
        Ok(())
    }

    /// Steps over an element that means nothing to a cage.
    fn others(&mut self, element: &Element, source: &mut Source<'_>) -> Result<(), PlyError> {
        for index in 0..element.count {
            self.gauge.left(source.left_bytes())?;
            for property in &element.properties {
                source.skip(property.kind, At { element, index }, &mut self.gauge)?;
            }
        }
        if element.count > 0 {
            self.desc.warnings.push(Warning::Element { name: element.name(), count: element.count });
        }
        Ok(())
    }

    fn finish(mut self, left: (&'static str, usize)) -> Result<Draft, PlyError> {
        if !self.has_vertices {
            return Err(PlyError::NoVertices);
        }
        if !self.has_faces {
            return Err(PlyError::NoFaces);
        }
        self.check_indices()?;
        if let (what, count @ 1..) = left {
            self.desc.warnings.push(Warning::NotRead { what, count });
        }
        let Self { mut desc, vertex_uv, corner_uv, lines, .. } = self;
        desc.uv = corner_uv.finish(&desc.face_offsets, &mut desc.warnings);
        if desc.uv.is_none() && !vertex_uv.is_empty() {
            desc.uv = Some(FaceVarying { values: vertex_uv, indices: desc.face_vertices.clone() });
        }
        Ok(Draft { desc, lines })
    }

    fn check_indices(&self) -> Result<(), PlyError> {
        let vertices = self.desc.positions.len();
        let Some(corner) = self.desc.face_vertices.iter().position(|&v| v as usize >= vertices) else { return Ok(()) };
        let face = self.desc.face_offsets.partition_point(|&offset| offset as usize <= corner) - 1;
        Err(PlyError::Index { face: face as u64, index: i64::from(self.desc.face_vertices[corner]), vertices })
    }
}

/// The property with one of these names, which must be a list, and the type of its values.
fn list(element: &Element, names: &[&str]) -> Result<Option<(usize, Scalar)>, PlyError> {
    let Some(index) = element.find(names) else { return Ok(None) };
    let property = &element.properties[index];
    match property.kind {
        Kind::List { value, .. } => Ok(Some((index, value))),
        Kind::Scalar(_) => {
            let property = String::from_utf8_lossy(&property.name).into_owned();
            Err(PlyError::Type { element: "face", property, found: "a single number", expected: "a list" })
        }
    }
}
