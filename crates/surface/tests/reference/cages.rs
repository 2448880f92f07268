//! Small cages, one per hard case, with coordinates that follow no symmetry so that mixed-up points
//! show.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use osculate_surface::reference::{Boundary, Mesh};

/// A cage, the rule for its boundary, and a name for messages.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) mesh: Mesh,
    pub(crate) rule: Boundary,
}

/// Moves every vertex a little, each differently.
fn shaken(mut mesh: Mesh) -> Mesh {
    for (i, point) in mesh.positions.iter_mut().enumerate() {
        let i = i as f64;
        *point += 0.15 * DVec3::new((1.7 * i + 0.4).sin(), (2.3 * i + 1.1).cos(), (3.1 * i + 0.2).sin());
    }
    mesh
}

fn cube_points() -> Vec<DVec3> {
    let corner = |x, y, z| DVec3::new(x, y, z);
    [(-1.0, 1.0), (1.0, -1.0)]
        .into_iter()
        .flat_map(|(z, _)| [corner(-1.0, -1.0, z), corner(1.0, -1.0, z), corner(1.0, 1.0, z), corner(-1.0, 1.0, z)])
        .collect()
}

/// Six quads around eight vertices of valence 3. Not shaken: tests know its symmetry.
pub(crate) fn cube() -> Mesh {
    let faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
    Mesh::from_faces(cube_points(), faces)
}

/// A quad and four triangles.
pub(crate) fn pyramid() -> Mesh {
    let mut points = cube_points();
    points.truncate(4);
    points.push(DVec3::new(0.0, 0.0, 1.0));
    let faces: [&[u32]; 5] = [&[3, 2, 1, 0], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]];
    shaken(Mesh::from_faces(points, faces))
}

/// A cube whose top is cut in two along a path with a vertex of valence 2, and one of whose sides
/// is a pentagon beside a triangle.
pub(crate) fn polygons() -> Mesh {
    let mut points = cube_points();
    points.extend([DVec3::new(0.1, -0.1, 1.2), DVec3::new(0.2, -1.1, 0.0)]);
    let faces: [&[u32]; 8] = [
        &[3, 2, 1, 0],
        &[4, 5, 6, 8],
        &[4, 8, 6, 7],
        &[0, 1, 9],
        &[1, 5, 4, 0, 9],
        &[1, 2, 6, 5],
        &[2, 3, 7, 6],
        &[3, 0, 4, 7],
    ];
    shaken(Mesh::from_faces(points, faces))
}

/// Two quads glued along all four edges: every vertex has valence 2. Its surface is folded flat at
/// the rim and has no normals there.
pub(crate) fn pillow() -> Mesh {
    let points = cube_points().into_iter().take(4).collect();
    shaken(Mesh::from_faces(points, [[0, 1, 2, 3], [3, 2, 1, 0]]))
}

/// `columns` x `rows` quads.
pub(crate) fn grid(columns: u32, rows: u32) -> Mesh {
    let points = (0..=rows).flat_map(|y| (0..=columns).map(move |x| DVec3::new(f64::from(x), f64::from(y), 0.0)));
    let vertex = |x, y| x + y * (columns + 1);
    let quad = |x, y| [vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)];
    shaken(Mesh::from_faces(points.collect(), (0..rows).flat_map(|y| (0..columns).map(move |x| quad(x, y)))))
}

/// One face of `sides` vertices.
pub(crate) fn lone(sides: u32) -> Mesh {
    let at = |i: u32| TAU * f64::from(i) / f64::from(sides);
    let points = (0..sides).map(|i| DVec3::new(at(i).cos(), at(i).sin(), 0.0)).collect();
    shaken(Mesh::from_faces(points, [(0..sides).collect::<Vec<_>>()]))
}

/// A disc of `n` triangles around vertex 0.
pub(crate) fn fan(n: u32) -> Mesh {
    let at = |i: u32| TAU * f64::from(i) / f64::from(n);
    let rim = (0..n).map(|i| 3.0 * DVec3::new(at(i).cos(), at(i).sin(), 0.0));
    let points = [DVec3::Z].into_iter().chain(rim).collect();
    shaken(Mesh::from_faces(points, (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n])))
}

/// `k` quads around vertex 0 on the boundary, which runs along the x axis there.
pub(crate) fn half_star(k: u32) -> Mesh {
    let step = PI / f64::from(k);
    let at = |radius: f64, angle: f64| radius * DVec3::new(angle.cos(), angle.sin(), 0.1 * angle);
    let spokes = (0..=k).map(|i| at(1.0, f64::from(i) * step));
    let diagonals = (0..k).map(|i| at(1.5, (f64::from(i) + 0.5) * step));
    let points = [DVec3::ZERO].into_iter().chain(spokes).chain(diagonals).collect();
    shaken(Mesh::from_faces(points, (0..k).map(|i| [0, 1 + i, 2 + k + i, 2 + i])))
}

/// `k` triangles and pentagons by turns around vertex 0 on the boundary.
pub(crate) fn half_star_of_polygons(k: u32) -> Mesh {
    let mut mesh = half_star(k);
    let mut faces: Vec<Vec<u32>> = mesh.faces().map(<[u32]>::to_vec).collect();
    for (i, face) in faces.iter_mut().enumerate() {
        if i % 2 == 0 {
            face.remove(2);
        } else {
            let ends = mesh.positions[face[2] as usize] + mesh.positions[face[3] as usize];
            face.insert(3, mesh.positions.len() as u32);
            mesh.positions.push(0.6 * ends);
        }
    }
    Mesh::from_faces(mesh.positions, faces)
}

/// Every cage under every rule that makes a difference to it.
pub(crate) fn all() -> Vec<Case> {
    let closed = [("cube", cube()), ("pyramid", pyramid()), ("polygons", polygons())];
    let mut open = vec![
        ("grid".to_owned(), grid(4, 3)),
        ("strip".to_owned(), grid(1, 3)),
        ("fan 5".to_owned(), fan(5)),
        ("fan 64".to_owned(), fan(64)),
    ];
    open.extend((3..=6).map(|sides| (format!("lone {sides}"), lone(sides))));
    open.extend((1..=5).chain([12]).map(|k| (format!("half star {k}"), half_star(k))));
    open.extend((2..=5).map(|k| (format!("half star of polygons {k}"), half_star_of_polygons(k))));

    let closed = closed.into_iter().map(|(name, mesh)| Case { name: name.to_owned(), mesh, rule: Boundary::EdgeOnly });
    let rules = [Boundary::EdgeOnly, Boundary::EdgeAndCorner];
    let case =
        |(name, mesh): &(String, Mesh), rule| Case { name: format!("{name} {rule:?}"), mesh: mesh.clone(), rule };
    closed.chain(open.iter().flat_map(|cage| rules.map(|rule| case(cage, rule)))).collect()
}

/// The sub-faces of a face: -1 for a quad, the corners of any other face.
pub(crate) fn sub_faces(sides: usize) -> std::ops::Range<i32> {
    if sides == 4 { -1..0 } else { 0..sides as i32 }
}
