//! The first step of the descent: from a mesh whose faces have any size to quads.

use glam::DVec3;

use super::neighbourhood::Neighbourhood;
use super::star::{Ring, Star, edge_point};
use super::topology::Topology;
use super::{Boundary, Mesh, MeshError};

/// A mesh, and those points of its first step that sum over many others. They are found once, so
/// that a child of a face of `n` sides takes time in proportion to `n`.
///
/// Points are held as differences from a vertex nearby: differences of input points are exact to
/// rounding, so a mesh far from the origin loses nothing.
#[derive(Debug)]
pub(super) struct FirstStep<'a> {
    mesh: &'a Mesh,
    topology: Topology,
    rule: Boundary,
    /// From the first vertex of each face to its face point.
    to_face_points: Vec<DVec3>,
    /// From each vertex to its vertex point; zero where there is no face.
    to_vertex_points: Vec<DVec3>,
}

impl<'a> FirstStep<'a> {
    /// Prepares to take the step.
    ///
    /// # Errors
    /// If the mesh is not valid.
    pub(super) fn new(mesh: &'a Mesh, rule: Boundary) -> Result<Self, MeshError> {
        let topology = Topology::new(mesh)?;
        let to_face_points = mesh.faces().map(|ring| to_centroid(mesh, ring)).collect();
        let step = Self { mesh, topology, rule, to_face_points, to_vertex_points: Vec::new() };
        Ok(Self { to_vertex_points: step.find_vertex_points(), ..step })
    }

    fn find_vertex_points(&self) -> Vec<DVec3> {
        let mut found = vec![None; self.mesh.positions.len()];
        for (half_edge, &vertex) in (0..).zip(&self.mesh.face_vertices) {
            let origin = self.mesh.positions[vertex as usize];
            found[vertex as usize].get_or_insert_with(|| self.ring(half_edge, origin).vertex_point(self.rule));
        }
        found.into_iter().map(Option::unwrap_or_default).collect()
    }

    /// The child quad at corner `corner` of face `face`, corner 0 of the child at that corner;
    /// points relative to `origin`.
    pub(super) fn child(&self, face: usize, corner: usize, origin: DVec3) -> Neighbourhood {
        let half_edges = self.half_edges_from(face, corner);
        let star = |half_edge: u32| self.ring(half_edge, origin).refine(self.rule);
        let [here, next, previous] = [0, 1, half_edges.len() - 1].map(|i| star(half_edges[i]));
        Neighbourhood::of_child(here, &next, &previous, self.face_star(face, &half_edges, origin))
    }

    /// The half-edges of a face, from the one that leaves `corner`.
    fn half_edges_from(&self, face: usize, corner: usize) -> Vec<u32> {
        let mut half_edges: Vec<u32> = (self.mesh.face_offsets[face]..self.mesh.face_offsets[face + 1]).collect();
        half_edges.rotate_left(corner);
        half_edges
    }

    /// What surrounds the vertex that `half_edge` leaves.
    fn ring(&self, half_edge: u32, origin: DVec3) -> Ring<'static> {
        let (mesh, topology) = (self.mesh, &self.topology);
        let fan = topology.fan(mesh, half_edge);
        let mut spokes: Vec<DVec3> =
            fan.outgoing.iter().map(|&h| self.point(topology.ends(mesh, h).1, origin)).collect();
        if !fan.closed {
            let last = fan.outgoing[fan.outgoing.len() - 1];
            spokes.push(self.point(topology.ends(mesh, topology.previous(mesh, last)).0, origin));
        }
        let centre = self.point(mesh.face_vertices[half_edge as usize], origin);
        let face_points = fan.outgoing.iter().map(|&h| self.face_point(topology.face(h), origin)).collect();
        Ring { centre, spokes: spokes.into(), face_points, core: fan.core }
    }

    /// The star around the face point; `half_edges` from the corner of its core.
    fn face_star(&self, face: usize, half_edges: &[u32], origin: DVec3) -> Star {
        let previous = half_edges.len() - 1;
        let from_previous = half_edges[previous..].iter().chain(&half_edges[..previous]);
        Star {
            centre: self.face_point(face, origin),
            spokes: from_previous.map(|&h| self.edge_point(h, origin)).collect(),
            diagonals: half_edges.iter().map(|&h| self.vertex_point(h, origin)).collect(),
            core: 0,
        }
    }

    fn point(&self, vertex: u32, origin: DVec3) -> DVec3 {
        self.mesh.positions[vertex as usize] - origin
    }

    fn face_point(&self, face: usize, origin: DVec3) -> DVec3 {
        self.point(self.mesh.face(face)[0], origin) + self.to_face_points[face]
    }

    /// The point on the edge of a half-edge.
    fn edge_point(&self, half_edge: u32, origin: DVec3) -> DVec3 {
        let (from, to) = self.topology.ends(self.mesh, half_edge);
        let face_point = |h: u32| self.face_point(self.topology.face(h), origin);
        let twin = self.topology.twin(half_edge);
        edge_point([from, to].map(|v| self.point(v, origin)), twin.map(|twin| [half_edge, twin].map(face_point)))
    }

    /// The point of the vertex that a half-edge leaves.
    fn vertex_point(&self, half_edge: u32, origin: DVec3) -> DVec3 {
        let vertex = self.mesh.face_vertices[half_edge as usize];
        self.point(vertex, origin) + self.to_vertex_points[vertex as usize]
    }
}

/// From the first vertex of a face to the mean of all.
fn to_centroid(mesh: &Mesh, ring: &[u32]) -> DVec3 {
    let first = mesh.positions[ring[0] as usize];
    ring.iter().map(|&vertex| mesh.positions[vertex as usize] - first).sum::<DVec3>() / ring.len() as f64
}
