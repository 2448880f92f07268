//! Where the meshes of a scene are.

use ::gltf::scene::Transform;
use ::gltf::{Gltf, Mesh, Node};
use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::GltfError;

/// A mesh in its place.
pub(super) struct PlacedMesh<'a> {
    pub(super) node: Node<'a>,
    pub(super) mesh: Mesh<'a>,
    pub(super) to_world: DAffine3,
}

/// The meshes of the default scene, else of the first, else of all nodes, parents before children. No recursion: depth costs
/// memory, not stack, and a node that is met twice is an error, so cycles end.
pub(super) fn placed_meshes(gltf: &Gltf) -> Result<Vec<PlacedMesh<'_>>, GltfError> {
    let mut seen = vec![false; gltf.nodes().len()];
    let mut found = Vec::new();
    let mut open: Vec<(Node, DAffine3)> =
        roots(gltf).into_iter().rev().map(|node| (node, DAffine3::IDENTITY)).collect();
    while let Some((node, parent)) = open.pop() {
        if std::mem::replace(&mut seen[node.index()], true) {
            return Err(GltfError::NodeTwice(node.index()));
        }
        let to_world = parent * local(node.transform());
        let children = open.len();
        open.extend(node.children().map(|child| (child, to_world)));
        open[children..].reverse();
        if let Some(mesh) = node.mesh() {
            found.push(PlacedMesh { node, mesh, to_world });
        }
    }
    Ok(found)
}

fn roots(gltf: &Gltf) -> Vec<Node<'_>> {
    if let Some(scene) = gltf.default_scene().or_else(|| gltf.scenes().next()) {
        return scene.nodes().collect();
    }
    let mut child = vec![false; gltf.nodes().len()];
    gltf.nodes().flat_map(|node| node.children()).for_each(|node| child[node.index()] = true);
    gltf.nodes().filter(|node| !child[node.index()]).collect()
}

/// The transform of a node, composed in f64: the crate would do it in f32.
fn local(transform: Transform) -> DAffine3 {
    match transform {
        Transform::Matrix { matrix } => {
            let [x, y, z, translation] =
                matrix.map(|column| DVec3::new(column[0].into(), column[1].into(), column[2].into()));
            DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation }
        }
        Transform::Decomposed { translation, rotation, scale } => {
            let [x, y, z, w] = rotation.map(f64::from);
            // Rounded to f32 it is not quite of unit length.
            let rotation = DQuat::from_xyzw(x, y, z, w);
            let rotation = if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY };
            DAffine3::from_scale_rotation_translation(
                scale.map(f64::from).into(),
                rotation,
                translation.map(f64::from).into(),
            )
        }
    }
}
