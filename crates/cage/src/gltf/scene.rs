//! Where the meshes of a scene are, and the nodes that place them.

use std::collections::HashMap;

use ::gltf::mesh::Mode;
use ::gltf::scene::Transform;
use ::gltf::{Gltf, Mesh, Node, Primitive, Semantic};
use glam::{DAffine3, DMat3, DVec3};

use super::GltfError;
use crate::rig::unit_quaternion;
use crate::{NodeTransform, RigNode};

/// A mesh in its place.
pub(super) struct PlacedMesh<'a> {
    pub(super) node: Node<'a>,
    pub(super) mesh: Mesh<'a>,
    /// The node as an index of [`Scene::nodes`].
    pub(super) at: u32,
}

/// The nodes of a scene, parents before children, and its meshes.
#[derive(Default)]
pub(super) struct Scene<'a> {
    pub(super) nodes: Vec<RigNode>,
    /// From the space of each node to that of the scene.
    pub(super) to_world: Vec<DAffine3>,
    pub(super) meshes: Vec<PlacedMesh<'a>>,
    /// Indices of `nodes` by those of the file.
    by_source: HashMap<usize, u32>,
}

impl<'a> Scene<'a> {
    /// The default scene, else the first, else all nodes. Where there are skins, trees of nodes outside of the scene follow without
    /// their meshes, because exporters leave joints there.
    pub(super) fn new(gltf: &'a Gltf) -> Result<Self, GltfError> {
        let mut scene = Self::default();
        let chosen = gltf.default_scene().or_else(|| gltf.scenes().next());
        match chosen {
            Some(chosen) => scene.add_trees(chosen.nodes().collect(), true)?,
            None => scene.add_trees(roots(gltf), true)?,
        }
        if gltf.skins().len() > 0 {
            let others = roots(gltf).into_iter().filter(|node| !scene.by_source.contains_key(&node.index())).collect();
            scene.add_trees(others, false)?;
        }
        Ok(scene)
    }

    /// The index in [`Scene::nodes`] of a node of the file.
    pub(super) fn find(&self, source: usize) -> Option<u32> {
        self.by_source.get(&source).copied()
    }

    /// How many triangles primitives speak of, at most; how many there are is another question.
    pub(super) fn triangles_announced(&self) -> u64 {
        let corners = |primitive: Primitive| {
            let accessor = primitive.indices().or_else(|| primitive.get(&Semantic::Positions));
            let corners = accessor.map_or(0, |accessor| accessor.count() as u64);
            if primitive.mode() == Mode::Triangles { corners / 3 } else { corners }
        };
        let announced = self.meshes.iter().flat_map(|placed| placed.mesh.primitives()).map(corners);
        announced.fold(0, u64::saturating_add)
    }

    /// No recursion: depth costs memory, not stack, and a node that is met twice is an error, so cycles end.
    fn add_trees(&mut self, roots: Vec<Node<'a>>, with_meshes: bool) -> Result<(), GltfError> {
        let mut open: Vec<(Node, Option<u32>)> = roots.into_iter().rev().map(|node| (node, None)).collect();
        while let Some((node, parent)) = open.pop() {
            let at = self.nodes.len() as u32;
            if self.by_source.insert(node.index(), at).is_some() {
                return Err(GltfError::NodeTwice(node.index()));
            }
            self.add_node(&node, parent)?;
            let children = open.len();
            open.extend(node.children().map(|child| (child, Some(at))));
            open[children..].reverse();
            if let Some(mesh) = node.mesh().filter(|_| with_meshes) {
                self.meshes.push(PlacedMesh { node, mesh, at });
            }
        }
        Ok(())
    }

    fn add_node(&mut self, node: &Node, parent: Option<u32>) -> Result<(), GltfError> {
        let source = node.index();
        let transform = local(node.transform());
        let to_parent = transform.to_parent();
        // A number beyond 32-bit floats is read as infinite.
        if !to_parent.is_finite() {
            return Err(GltfError::NodeTransform(source));
        }
        self.to_world.push(parent.map_or(DAffine3::IDENTITY, |parent| self.to_world[parent as usize]) * to_parent);
        let name = node.name().map_or_else(|| format!("node {source}"), Into::into);
        self.nodes.push(RigNode { name, source: source as u32, parent, transform });
        Ok(())
    }
}

fn roots(gltf: &Gltf) -> Vec<Node<'_>> {
    let mut child = vec![false; gltf.nodes().len()];
    gltf.nodes().flat_map(|node| node.children()).for_each(|node| child[node.index()] = true);
    gltf.nodes().filter(|node| !child[node.index()]).collect()
}

/// The transform of a node, to be composed in f64: the crate would do it in f32.
fn local(transform: Transform) -> NodeTransform {
    match transform {
        Transform::Matrix { matrix } => {
            let [x, y, z, translation] =
                matrix.map(|column| DVec3::new(column[0].into(), column[1].into(), column[2].into()));
            NodeTransform::Matrix(DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation })
        }
        Transform::Decomposed { translation, rotation, scale } => NodeTransform::Decomposed {
            translation: translation.map(f64::from).into(),
            // Rounded to f32 it is not quite of unit length.
            rotation: unit_quaternion(&rotation.map(f64::from)),
            scale: scale.map(f64::from).into(),
        },
    }
}
