//! The triangles of a primitive.

use std::collections::HashMap;

use ::gltf::mesh::Mode;
use ::gltf::{Accessor, Primitive, Semantic};
use glam::{DVec2, DVec3};

use super::accessor::{Indices, Vectors};
use super::buffers::Buffers;
use super::scene::PlacedMesh;
use super::soup::{Run, Soup};
use super::{AccessorError, GltfError};

/// Adds the triangles of a mesh to the soup.
pub(super) fn add_mesh(placed: &PlacedMesh, buffers: &Buffers, soup: &mut Soup) -> Result<(), GltfError> {
    let PlacedMesh { node, mesh, .. } = placed;
    soup.begin_part();
    if node.skin().is_some() {
        soup.ignore("skin");
    }
    if mesh.primitives().any(|primitive| primitive.morph_targets().len() > 0) {
        soup.ignore("set of morph targets");
    }
    for primitive in mesh.primitives() {
        Reader { placed, primitive, buffers }.add_to(soup)?;
    }
    Ok(())
}

struct Reader<'a> {
    placed: &'a PlacedMesh<'a>,
    primitive: Primitive<'a>,
    buffers: &'a Buffers,
}

/// What a primitive reads, each with the accessor it comes from.
struct Attributes<'a> {
    positions: (Accessor<'a>, Vectors<'a, 3>),
    uv: Option<(Accessor<'a>, Vectors<'a, 2>)>,
    indices: Option<(Accessor<'a>, Indices<'a>)>,
}

impl<'a> Reader<'a> {
    fn add_to(&self, soup: &mut Soup) -> Result<(), GltfError> {
        let mode = self.primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            soup.ignore("primitive of points or lines");
            return Ok(());
        }
        let attributes = self.attributes()?;
        let triangles = self.triangle_count(&attributes)?;
        soup.reserve(triangles)?;
        soup.begin_run(self.run());

        let flipped = self.placed.to_world.matrix3.determinant() < 0.0;
        let mut points = HashMap::new();
        for i in 0..triangles as u32 {
            let mut triangle = [0; 3];
            for (point, corner) in triangle.iter_mut().zip(triangle_corners(mode, i)) {
                let vertex = self.vertex(&attributes, corner)?;
                *point = match points.get(&vertex) {
                    Some(&known) => known,
                    None => self.push_point(&attributes, vertex, soup)?,
                };
                points.insert(vertex, *point);
            }
            if flipped {
                triangle.swap(1, 2);
            }
            soup.push_triangle(triangle);
        }
        Ok(())
    }

    fn attributes(&self) -> Result<Attributes<'a>, GltfError> {
        let positions = self
            .primitive
            .get(&Semantic::Positions)
            .ok_or(GltfError::NoPositions { mesh: self.placed.mesh.index(), primitive: self.primitive.index() })?;
        Ok(Attributes {
            positions: self.open("POSITION", positions, Vectors::positions)?,
            uv: self
                .primitive
                .get(&Semantic::TexCoords(0))
                .map(|uv| self.open("TEXCOORD_0", uv, Vectors::uv))
                .transpose()?,
            indices: self.primitive.indices().map(|indices| self.open("indices", indices, Indices::new)).transpose()?,
        })
    }

    fn open<T>(
        &self,
        attribute: &'static str,
        accessor: Accessor<'a>,
        new: impl FnOnce(&Accessor<'a>, &'a Buffers) -> Result<T, AccessorError>,
    ) -> Result<(Accessor<'a>, T), GltfError> {
        let elements = new(&accessor, self.buffers).map_err(|error| self.fault(attribute, &accessor, error))?;
        Ok((accessor, elements))
    }

    /// Says where an accessor is used.
    fn fault(&self, attribute: &'static str, accessor: &Accessor, error: AccessorError) -> GltfError {
        let (mesh, primitive) = (self.placed.mesh.index(), self.primitive.index());
        GltfError::Accessor { mesh, primitive, attribute, accessor: accessor.index(), error }
    }

    fn triangle_count(&self, attributes: &Attributes) -> Result<usize, GltfError> {
        let corners =
            attributes.indices.as_ref().map_or(attributes.positions.1.count(), |(_, indices)| indices.count());
        match self.primitive.mode() {
            Mode::Triangles if !corners.is_multiple_of(3) => {
                let (mesh, primitive) = (self.placed.mesh.index(), self.primitive.index());
                Err(GltfError::Triangles { mesh, primitive, corners })
            }
            Mode::Triangles => Ok(corners / 3),
            _ => Ok(corners.saturating_sub(2)),
        }
    }

    /// The vertex of a corner, through the indices if there are any.
    fn vertex(&self, attributes: &Attributes, corner: u32) -> Result<u32, GltfError> {
        match &attributes.indices {
            Some((accessor, indices)) => indices.get(corner).map_err(|error| self.fault("indices", accessor, error)),
            None => Ok(corner),
        }
    }

    fn push_point(&self, attributes: &Attributes, vertex: u32, soup: &mut Soup) -> Result<u32, GltfError> {
        let (accessor, positions) = &attributes.positions;
        let position = positions.get(vertex).map_err(|error| self.fault("POSITION", accessor, error))?;
        let uv = match &attributes.uv {
            Some((accessor, uv)) => Some(uv.get(vertex).map_err(|error| self.fault("TEXCOORD_0", accessor, error))?),
            None => None,
        };
        let position = self.placed.to_world.transform_point3(DVec3::from_array(position));
        Ok(soup.push_point(position, uv.map(DVec2::from_array)))
    }

    fn run(&self) -> Run {
        let named =
            |name: Option<&str>, kind: &str, index: usize| name.map_or_else(|| format!("{kind} {index}"), Into::into);
        let material = self.primitive.material();
        Run {
            node: named(self.placed.node.name(), "node", self.placed.node.index()),
            material: material.index().map(|index| named(material.name(), "material", index)),
        }
    }
}

/// The corners of triangle `i`, by the formulas of the glTF 2.0 specification, section 3.7.2.1.
fn triangle_corners(mode: Mode, i: u32) -> [u32; 3] {
    match mode {
        Mode::TriangleStrip => [i, i + 1 + i % 2, i + 2 - i % 2],
        Mode::TriangleFan => [i + 1, i + 2, 0],
        _ => [3 * i, 3 * i + 1, 3 * i + 2],
    }
}
