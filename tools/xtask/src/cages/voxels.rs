//! Cages bounded by the sides of unit cells.

use glam::{DVec3, IVec3, ivec3};

use super::mesh::{Mesh, Welder};

/// A slab of 5 x 3 cells with two square holes.
pub(super) fn two_holes() -> Mesh {
    let holes = [(1, 1), (3, 1)];
    let columns = (0..5).flat_map(|x| (0..3).map(move |y| (x, y))).filter(|cell| !holes.contains(cell));
    let mut mesh = boundary(&columns.map(|(x, y)| ivec3(x, y, 0)).collect::<Vec<_>>());
    for point in &mut mesh.points {
        *point = 0.5 * (*point - DVec3::new(2.5, 1.5, 0.5));
    }
    mesh
}

/// The outer sides of a set of unit cells, welded.
fn boundary(cells: &[IVec3]) -> Mesh {
    let mut welder = Welder::new();
    let mut faces = Vec::new();
    for &cell in cells {
        for (outward, corners) in sides() {
            if !cells.contains(&(cell + outward)) {
                let nodes = corners.map(|corner| cell + corner);
                faces.push(nodes.map(|node| welder.index(node.to_array(), || node.as_dvec3())).into());
            }
        }
    }
    Mesh::new(welder.points, faces)
}

/// The six sides of the unit cell: outward direction and corners, counter-clockwise seen from outside.
fn sides() -> [(IVec3, [IVec3; 4]); 6] {
    let axes = [IVec3::X, IVec3::Y, IVec3::Z];
    std::array::from_fn(|side| {
        let axis = side / 2;
        let (u, v) = (axes[(axis + 1) % 3], axes[(axis + 2) % 3]);
        match side % 2 {
            0 => (axes[axis], [axes[axis], axes[axis] + u, axes[axis] + u + v, axes[axis] + v]),
            _ => (-axes[axis], [IVec3::ZERO, v, u + v, u]),
        }
    })
}
