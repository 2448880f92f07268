//! A small dragon: the cage of the project's pictures.
//!
//! Only its right half is built: a loft from nose to tail, out of which tubes grow where quads have been cut away. The half
//! is faired, mirrored and posed.

use super::mesh::Mesh;
use super::skin::Skin;

mod body;
mod eyeball;
mod face;
mod fair;
mod half;
mod limbs;
mod mirror;
mod pack;
mod pose;
mod ridge;
mod rig;
mod spline;
mod tube;
mod wings;

use half::Half;

/// The dragon: closed, all quads, its eyes components of their own.
pub(super) fn dragon() -> Mesh {
    let (mut mesh, _) = mirror::whole(&symmetric());
    mesh.points.iter_mut().for_each(|point| *point = pose::pose(*point));
    mesh
}

/// The same dragon on four straight legs, with a skeleton and a walk.
pub(super) fn walking_dragon() -> (Mesh, Skin) {
    let half = symmetric();
    let (mesh, sources) = mirror::whole(&half);
    let skin = rig::skin(&half, &mesh, &sources);
    (mesh, skin)
}

/// The right half before the pose.
fn symmetric() -> Half {
    let mut half = Half::default();
    let trunk = body::body(&mut half);
    limbs::legs(&mut half, trunk);
    wings::wing(&mut half, trunk);
    ridge::ridge(&mut half, trunk);
    face::face(&mut half, trunk);
    fair::fair(&mut half);
    half
}
