//! One step of Catmull-Clark subdivision of a whole mesh, by sums over its faces and edges. It
//! shares no code with the descent of the evaluator, which refines one ring at a time, so that each
//! can check the other.

use std::collections::HashMap;

use glam::DVec3;

use super::{Boundary, Mesh};

/// A mesh after one step of subdivision, and where its points came from. All faces are quads; child
/// `c` of a face is (vertex point, edge point to the next vertex, face point, edge point to the
/// previous vertex), and children are numbered by the parent's corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined {
    /// The refined mesh. Its points are the face points, then the edge points in the order in which
    /// the faces first meet the edges, then the vertex points.
    pub mesh: Mesh,
    edge_points: HashMap<(u32, u32), u32>,
    first_vertex_point: u32,
}

impl Refined {
    /// The new point inside face `face` of the coarse mesh.
    pub fn face_point(&self, face: u32) -> u32 {
        face
    }

    /// The new point on the edge between vertices `a` and `b` of the coarse mesh, in either order;
    /// `None` if they share no edge.
    pub fn edge_point(&self, a: u32, b: u32) -> Option<u32> {
        self.edge_points.get(&undirected(a, b)).copied()
    }

    /// The new point that vertex `vertex` of the coarse mesh moves to.
    pub fn vertex_point(&self, vertex: u32) -> u32 {
        self.first_vertex_point + vertex
    }
}

impl Mesh {
    /// One step of Catmull-Clark subdivision of the whole mesh.
    ///
    /// # Panics
    /// If the mesh is not valid, with the message of [`Mesh::validate`].
    pub fn subdivide(&self, rule: Boundary) -> Refined {
        if let Err(error) = self.validate() {
            panic!("cannot subdivide: {error}");
        }
        let edges = Edges::new(self);
        let face_points: Vec<DVec3> = self.faces().map(|ring| centroid(self, ring)).collect();
        let edge_points: Vec<DVec3> = edges.list.iter().map(|edge| edge.point(self, &face_points)).collect();
        let vertex_points = vertex_points(self, rule, &edges.list, &face_points);

        let first_edge_point = self.face_count() as u32;
        let first_vertex_point = first_edge_point + edges.list.len() as u32;
        let edge_index: HashMap<_, _> =
            edges.index.into_iter().map(|(ends, edge)| (ends, first_edge_point + edge)).collect();
        let faces = children(self, &edge_index, first_vertex_point);
        let mesh = Mesh::from_faces([face_points, edge_points, vertex_points].concat(), faces);
        Refined { mesh, edge_points: edge_index, first_vertex_point }
    }
}

fn undirected(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// The corners of a ring with the one before and the one after each: (previous, vertex, next).
fn corners(ring: &[u32]) -> impl Iterator<Item = (u32, u32, u32)> {
    let n = ring.len();
    (0..n).map(move |corner| (ring[(corner + n - 1) % n], ring[corner], ring[(corner + 1) % n]))
}

fn children(mesh: &Mesh, edge_points: &HashMap<(u32, u32), u32>, first_vertex_point: u32) -> Vec<[u32; 4]> {
    let mut quads = Vec::with_capacity(mesh.face_vertices.len());
    for (face_point, ring) in (0..).zip(mesh.faces()) {
        for (previous, vertex, next) in corners(ring) {
            quads.push([
                first_vertex_point + vertex,
                edge_points[&undirected(vertex, next)],
                face_point,
                edge_points[&undirected(previous, vertex)],
            ]);
        }
    }
    quads
}

fn centroid(mesh: &Mesh, ring: &[u32]) -> DVec3 {
    ring.iter().map(|&vertex| mesh.positions[vertex as usize]).sum::<DVec3>() / ring.len() as f64
}

/// An edge, the face that met it first and the face across it.
struct Edge {
    ends: (u32, u32),
    face: usize,
    across: Option<usize>,
}

impl Edge {
    /// The edge point: the mean of both ends and both face points, on the boundary the midpoint.
    fn point(&self, mesh: &Mesh, face_points: &[DVec3]) -> DVec3 {
        let ends = mesh.positions[self.ends.0 as usize] + mesh.positions[self.ends.1 as usize];
        match self.across {
            Some(across) => 0.25 * (ends + face_points[self.face] + face_points[across]),
            None => 0.5 * ends,
        }
    }
}

/// All edges in the order in which the faces first meet them.
struct Edges {
    list: Vec<Edge>,
    index: HashMap<(u32, u32), u32>,
}

impl Edges {
    fn new(mesh: &Mesh) -> Self {
        let mut edges = Self { list: Vec::new(), index: HashMap::new() };
        for (face, ring) in mesh.faces().enumerate() {
            for (_, vertex, next) in corners(ring) {
                edges.meet(undirected(vertex, next), face);
            }
        }
        edges
    }

    fn meet(&mut self, ends: (u32, u32), face: usize) {
        match self.index.get(&ends) {
            Some(&known) => self.list[known as usize].across = Some(face),
            None => {
                self.index.insert(ends, self.list.len() as u32);
                self.list.push(Edge { ends, face, across: None });
            }
        }
    }
}

/// What the rule of a vertex needs to know of its surroundings.
#[derive(Clone, Default)]
struct Surroundings {
    faces: usize,
    face_points: DVec3,
    neighbours: DVec3,
    boundary_edges: usize,
    boundary_neighbours: DVec3,
}

impl Surroundings {
    /// The vertex point: weights (n-2)/n, 1/n^2, 1/n^2 of the vertex, its n neighbours and its n
    /// face points; on the boundary 6:1:1 along the boundary.
    fn vertex_point(&self, vertex: DVec3, rule: Boundary) -> DVec3 {
        if self.faces == 0 || (self.faces == 1 && rule == Boundary::EdgeAndCorner) {
            return vertex;
        }
        if self.boundary_edges > 0 {
            return (6.0 * vertex + self.boundary_neighbours) / 8.0;
        }
        let n = self.faces as f64;
        (n - 2.0) / n * vertex + (self.neighbours + self.face_points) / (n * n)
    }
}

fn vertex_points(mesh: &Mesh, rule: Boundary, edges: &[Edge], face_points: &[DVec3]) -> Vec<DVec3> {
    let mut surroundings = vec![Surroundings::default(); mesh.positions.len()];
    for (ring, &face_point) in mesh.faces().zip(face_points) {
        for &vertex in ring {
            surroundings[vertex as usize].faces += 1;
            surroundings[vertex as usize].face_points += face_point;
        }
    }
    for edge in edges {
        for (vertex, other) in [edge.ends, (edge.ends.1, edge.ends.0)] {
            let (around, other) = (&mut surroundings[vertex as usize], mesh.positions[other as usize]);
            around.neighbours += other;
            if edge.across.is_none() {
                around.boundary_edges += 1;
                around.boundary_neighbours += other;
            }
        }
    }
    mesh.positions.iter().zip(&surroundings).map(|(&vertex, around)| around.vertex_point(vertex, rule)).collect()
}
