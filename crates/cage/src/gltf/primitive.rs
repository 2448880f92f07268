//! The triangles of a primitive.

use std::collections::HashMap;

use ::gltf::mesh::Mode;
use ::gltf::{Accessor, Primitive, Semantic};
use glam::{DVec2, DVec3, Vec3};

use super::accessor::{Indices, Joints, Purpose, Vectors};
use super::buffers::Buffers;
use super::motion::{Budget, Influences, Morphs, Motion, has_triangles};
use super::scene::{PlacedMesh, Scene};
use super::soup::{MAX_UV_SETS, Point, Run, Soup};
use super::{AccessorError, GltfError, GltfPlace};
use crate::limits::Gauge;
use crate::rig::blend;

/// What a primitive costs beside its vertices, in numbers.
const COST: usize = 64;
/// Names are kept for each primitive, so long ones are cut to that many characters.
const LONGEST_NAME: usize = 250;

/// What all primitives of a file share.
pub(super) struct Context<'a> {
    pub(super) scene: &'a Scene<'a>,
    pub(super) buffers: &'a Buffers,
    pub(super) motion: Option<Motion>,
    pub(super) budget: Budget,
    pub(super) gauge: Gauge,
}

/// Adds the triangles of a mesh to the soup.
pub(super) fn add_mesh(placed: &PlacedMesh, context: &mut Context, soup: &mut Soup) -> Result<(), GltfError> {
    let mover = context.motion.as_ref().and_then(|motion| motion.mover(placed));
    soup.begin_part(mover);
    if placed.node.extension_value("EXT_mesh_gpu_instancing").is_some() {
        soup.ignore("set of instances");
    }
    let mut morphs = match context.motion {
        Some(_) => Morphs::new(placed, soup.point_count(), &mut context.budget)?,
        None => None,
    };
    for primitive in placed.mesh.primitives() {
        // Nodes may repeat a mesh of primitives without triangles.
        context.budget.take(COST)?;
        Reader { placed, primitive, buffers: context.buffers }.add_to(soup, context, morphs.as_mut())?;
    }
    soup.end_part(morphs);
    Ok(())
}

struct Reader<'a> {
    placed: &'a PlacedMesh<'a>,
    primitive: Primitive<'a>,
    buffers: &'a Buffers,
}

/// An accessor that was opened for reading.
struct Opened<'a, T> {
    attribute: String,
    accessor: Accessor<'a>,
    elements: T,
}

/// What a primitive reads.
struct Attributes<'a> {
    positions: Opened<'a, Vectors<'a, 3>>,
    uv: Vec<Option<Opened<'a, Vectors<'a, 2>>>>,
    indices: Option<Opened<'a, Indices<'a>>>,
    /// Four joints and their weights each.
    influences: Vec<(Opened<'a, Joints<'a>>, Opened<'a, Vectors<'a, 4>>)>,
    morphs: Vec<Option<Opened<'a, Vectors<'a, 3>>>>,
}

impl<'a> Reader<'a> {
    fn add_to(&self, soup: &mut Soup, context: &mut Context, mut morphs: Option<&mut Morphs>) -> Result<(), GltfError> {
        let mode = self.primitive.mode();
        if !has_triangles(&self.primitive) {
            soup.ignore("primitive of points or lines");
            return Ok(());
        }
        let attributes = self.attributes(soup, context.motion.is_some())?;
        let triangles = self.triangle_count(&attributes)?;
        soup.reserve(triangles)?;
        let joint = match &mut context.motion {
            Some(motion) if attributes.influences.is_empty() => Some(motion.joint_of(self.placed, context.scene)),
            _ => None,
        };
        let to_world = context.scene.to_world[self.placed.at as usize];
        // The transform of a skin's node moves nothing.
        let flipped = attributes.influences.is_empty() && to_world.matrix3.determinant() < 0.0;
        soup.begin_run(self.run(mode, flipped, attributes.indices.is_some()));

        let mut points = HashMap::new();
        for i in 0..triangles as u32 {
            let mut triangle = [0; 3];
            for (point, corner) in triangle.iter_mut().zip(triangle_corners(mode, i)) {
                let vertex = match &attributes.indices {
                    Some(indices) => self.read(indices, |elements| elements.get(corner))?,
                    None => corner,
                };
                *point = match points.get(&vertex) {
                    Some(&known) => known,
                    None => {
                        context.budget.take(attributes.numbers())?;
                        context.gauge.vertex()?;
                        let new = self.point(&attributes, vertex, joint, context, morphs.as_deref_mut())?;
                        soup.push_point(&new)
                    }
                };
                points.insert(vertex, *point);
            }
            context.gauge.face(3)?;
            context.gauge.faces_done()?;
            soup.push_triangle(triangle);
        }
        Ok(())
    }

    fn attributes(&self, soup: &mut Soup, moves: bool) -> Result<Attributes<'a>, GltfError> {
        let get = |semantic: Semantic| self.primitive.get(&semantic);
        let positions = get(Semantic::Positions)
            .ok_or(GltfError::NoPositions { mesh: self.placed.mesh.index(), primitive: self.primitive.index() })?;
        let uv = |set: u32| {
            get(Semantic::TexCoords(set))
                .map(|uv| self.open_vectors(format!("TEXCOORD_{set}"), uv, Purpose::Uv))
                .transpose()
        };
        if get(Semantic::TexCoords(MAX_UV_SETS)).is_some() {
            soup.ignore("set of uv beyond the eighth");
        }
        let mut attributes = Attributes {
            positions: self.open_vectors("POSITION".into(), positions, Purpose::Position)?,
            uv: (0..MAX_UV_SETS).map(uv).collect::<Result<_, _>>()?,
            indices: self
                .primitive
                .indices()
                .map(|indices| self.open("indices".into(), indices, Indices::new))
                .transpose()?,
            influences: Vec::new(),
            morphs: Vec::new(),
        };
        while let Some(None) = attributes.uv.last() {
            attributes.uv.pop();
        }
        if moves {
            self.add_motion(&mut attributes, soup)?;
        }
        Ok(attributes)
    }

    /// Opens joints, weights and morph targets.
    fn add_motion(&self, attributes: &mut Attributes<'a>, soup: &mut Soup) -> Result<(), GltfError> {
        if self.placed.node.skin().is_some() {
            let pair = |set: u32| {
                Some((self.primitive.get(&Semantic::Joints(set))?, self.primitive.get(&Semantic::Weights(set))?))
            };
            for (set, (joints, weights)) in (0..2).map_while(|set| Some((set, pair(set)?))) {
                attributes.influences.push((
                    self.open(format!("JOINTS_{set}"), joints, Joints::new)?,
                    self.open_vectors(format!("WEIGHTS_{set}"), weights, Purpose::JointWeights)?,
                ));
            }
            if pair(2).is_some() {
                soup.ignore("set of joints beyond the eighth joint of each vertex");
            }
            if attributes.influences.is_empty() {
                soup.ignore("skin of a primitive without joints");
            }
        }
        for (target, morph) in self.primitive.morph_targets().enumerate() {
            let open = |offsets| self.open_vectors(format!("target {target} POSITION"), offsets, Purpose::MorphOffset);
            attributes.morphs.push(morph.positions().map(open).transpose()?);
        }
        Ok(())
    }

    fn open<T>(
        &self,
        attribute: String,
        accessor: Accessor<'a>,
        new: impl FnOnce(&Accessor<'a>, &'a Buffers) -> Result<T, AccessorError>,
    ) -> Result<Opened<'a, T>, GltfError> {
        match new(&accessor, self.buffers) {
            Ok(elements) => Ok(Opened { attribute, accessor, elements }),
            Err(error) => Err(self.fault(&attribute, &accessor, error)),
        }
    }

    fn open_vectors<const N: usize>(
        &self,
        attribute: String,
        accessor: Accessor<'a>,
        purpose: Purpose,
    ) -> Result<Opened<'a, Vectors<'a, N>>, GltfError> {
        self.open(attribute, accessor, |accessor, buffers| Vectors::new(accessor, buffers, purpose))
    }

    fn read<T, R>(
        &self,
        opened: &Opened<'a, T>,
        get: impl FnOnce(&T) -> Result<R, AccessorError>,
    ) -> Result<R, GltfError> {
        get(&opened.elements).map_err(|error| self.fault(&opened.attribute, &opened.accessor, error))
    }

    /// Says where an accessor is used.
    fn fault(&self, attribute: &str, accessor: &Accessor, error: AccessorError) -> GltfError {
        let (mesh, primitive) = (self.placed.mesh.index(), self.primitive.index());
        let place = GltfPlace::Primitive { mesh, primitive };
        GltfError::Accessor { place, attribute: attribute.into(), accessor: accessor.index(), error }
    }

    fn triangle_count(&self, attributes: &Attributes) -> Result<usize, GltfError> {
        let corners = match &attributes.indices {
            Some(indices) => indices.elements.count(),
            None => attributes.positions.elements.count(),
        };
        match self.primitive.mode() {
            Mode::Triangles if !corners.is_multiple_of(3) => {
                let (mesh, primitive) = (self.placed.mesh.index(), self.primitive.index());
                Err(GltfError::Triangles { mesh, primitive, corners })
            }
            Mode::Triangles => Ok(corners / 3),
            _ => Ok(corners.saturating_sub(2)),
        }
    }

    fn point(
        &self,
        attributes: &Attributes<'a>,
        vertex: u32,
        joint: Option<u32>,
        context: &Context,
        morphs: Option<&mut Morphs>,
    ) -> Result<Point, GltfError> {
        let bind = DVec3::from_array(self.read(&attributes.positions, |positions| positions.get(vertex))?);
        let mut uv = [None; MAX_UV_SETS as usize];
        for (uv, opened) in uv.iter_mut().zip(&attributes.uv) {
            if let Some(opened) = opened {
                *uv = Some(DVec2::from_array(self.read(opened, |elements| elements.get(vertex))?));
            }
        }
        let Some(motion) = &context.motion else {
            let position = context.scene.to_world[self.placed.at as usize].transform_point3(bind);
            return Ok(Point { position, bind, uv, influences: None, skinned: false });
        };
        let mut morphed = bind;
        if let Some(morphs) = morphs {
            for (opened, &weight) in attributes.morphs.iter().zip(&morphs.weights) {
                let offset = match opened {
                    Some(opened) => DVec3::from_array(self.read(opened, |elements| elements.get(vertex))?),
                    None => DVec3::ZERO,
                };
                let offset: Vec3 = offset.as_vec3();
                morphs.offsets.push(offset);
                morphed += f64::from(weight) * offset.as_dvec3();
            }
        }
        let influences = match joint {
            Some(joint) => rigid(joint),
            None => self.influences(attributes, vertex, motion.skin_of(self.placed))?,
        };
        let position = blend(influences.into_iter(), &motion.at_rest, morphed);
        Ok(Point { position, bind, uv, influences: Some(influences), skinned: joint.is_none() })
    }

    /// The joints of a vertex; weights are scaled to the sum 1.
    fn influences(
        &self,
        attributes: &Attributes<'a>,
        vertex: u32,
        skin: Option<(u32, u32)>,
    ) -> Result<Influences, GltfError> {
        let (first, count) = skin.unwrap_or_default();
        let mut found = [(0, 0.0); 8];
        for (set, (joints, weights)) in attributes.influences.iter().enumerate() {
            let names = self.read(joints, |joints| joints.get(vertex))?;
            let values = self.read(weights, |weights| weights.get(vertex))?;
            for (k, (joint, weight)) in names.into_iter().zip(values).enumerate() {
                if weight < 0.0 {
                    let fault = format!("has the weight {weight}; weights are at least 0");
                    let error = AccessorError::Value { index: vertex, fault };
                    return Err(self.fault(&weights.attribute, &weights.accessor, error));
                }
                // What a joint without weight is called does not matter.
                if weight > 0.0 && joint >= count {
                    let fault = format!("names joint {joint} of a skin with {count} joints");
                    let error = AccessorError::Value { index: vertex, fault };
                    return Err(self.fault(&joints.attribute, &joints.accessor, error));
                }
                found[4 * set + k] = (joint, weight);
            }
        }
        let sum: f64 = found.iter().map(|(_, weight)| weight).sum();
        // Without weights the first joint takes it all, as in other readers.
        if sum <= 0.0 {
            return Ok(rigid(first));
        }
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        Ok(found.map(|(joint, weight)| if weight > 0.0 { (first + joint, (weight / sum) as f32) } else { (0, 0.0) }))
    }

    fn run(&self, mode: Mode, flipped: bool, indexed: bool) -> Run {
        let material = self.primitive.material();
        let named = |name: Option<&str>, kind: &str, index: usize| match name {
            Some(name) => name.chars().take(LONGEST_NAME).collect(),
            None => format!("{kind} {index}"),
        };
        let marked = self.primitive.extension_value("FB_ngon_encoding").is_some();
        Run {
            node: named(self.placed.node.name(), "node", self.placed.node.index()),
            material_name: material.index().map(|index| named(material.name(), "material", index)),
            material: material.index(),
            flipped,
            // The mark is about corners with the same index.
            marked: marked && indexed && mode == Mode::Triangles,
        }
    }
}

impl Attributes<'_> {
    /// How many numbers are kept of a vertex, about.
    fn numbers(&self) -> usize {
        2 * self.uv.len() + 8 * self.influences.len() + 3 * self.morphs.len()
    }
}

fn rigid(joint: u32) -> Influences {
    let mut influences = [(0, 0.0); 8];
    influences[0] = (joint, 1.0);
    influences
}

/// The corners of triangle `i`, by the formulas of the glTF 2.0 specification, section 3.7.2.1.
fn triangle_corners(mode: Mode, i: u32) -> [u32; 3] {
    match mode {
        Mode::TriangleStrip => [i, i + 1 + i % 2, i + 2 - i % 2],
        Mode::TriangleFan => [i + 1, i + 2, 0],
        _ => [3 * i, 3 * i + 1, 3 * i + 2],
    }
}
