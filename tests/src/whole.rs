//! The surface of `gregory1` in f64, made from a cage by search in its topology: shares with the plan and the kernels only the matrices of vertices.

use glam::DVec3;
use osculate::{BoundaryRule, Cage};
use osculate_cage::{NONE, Topology};
use osculate_surface::bezier;
use osculate_surface::gregory::{self, Fan, Side, WholeCorner};
use osculate_surface::jet::Jet;
use osculate_surface::reference::{Boundary, Mesh};

use crate::zoo::cage;

/// Every third quad of a cage cut into two triangles.
pub fn cut_some_quads(from: &Cage) -> Cage {
    let mut faces = Vec::new();
    for (f, face) in (0..from.face_count()).map(|f| (f, from.face(f))) {
        match *face {
            [a, b, c, d] if f % 3 == 0 => faces.extend([vec![a, b, c], vec![c, d, a]]),
            _ => faces.push(face.to_vec()),
        }
    }
    cage(from.positions().to_vec(), &faces)
}

/// The control points of a face.
enum Patch {
    Quad([DVec3; 20]),
    Triangle([DVec3; 15]),
}

/// Patches of all final faces.
pub struct WholeSurface {
    topology: Topology,
    points: Vec<DVec3>,
    boundary: Boundary,
    vertices: Vec<Option<Vertex>>,
    patches: Vec<Patch>,
}

/// A vertex with the rows of its fan.
struct Vertex {
    fan: Fan,
    rows: Vec<DVec3>,
    tangents: [DVec3; 2],
}

impl WholeSurface {
    /// The surface of a cage; the boundary rule `none` leaves patches away, but changes none.
    ///
    /// # Panics
    /// If the cage is none.
    pub fn new(cage: &Cage, rule: BoundaryRule) -> Self {
        let (mut mesh, boundary) = (Mesh::from(cage), Boundary::from(rule));
        if (0..cage.face_count()).any(|f| cage.face(f).len() > 4) {
            mesh = mesh.subdivide(boundary).mesh;
        }
        let Mesh { positions, face_offsets, face_vertices } = mesh;
        let topology =
            Topology::build(positions.len(), face_offsets, face_vertices).unwrap_or_else(|error| panic!("{error}"));
        let mut surface = Self { topology, points: positions, boundary, vertices: Vec::new(), patches: Vec::new() };
        surface.vertices = (0..surface.points.len() as u32).map(|v| surface.vertex(v)).collect();
        surface.patches = (0..surface.topology.face_count() as u32).map(|face| surface.patch(face)).collect();
        surface
    }

    /// Point and derivatives of a final face; blends are not differentiated, as on the device.
    pub fn jet(&self, face: u32, [u, v]: [f64; 2]) -> Jet {
        match &self.patches[face as usize] {
            Patch::Quad(points) => bezier::patch(&gregory::bezier_grid(points, u, v), u, v),
            Patch::Triangle(points) => gregory::evaluate_triangle_frozen(points, u, v),
        }
    }

    /// The normal at a corner of a final face: where edges are flat, patches have none.
    pub fn corner_normal(&self, face: u32, corner: usize) -> DVec3 {
        let [a, b] = self.at(self.topology.face_vertices(face)[corner]).tangents;
        a.cross(b).normalize_or_zero()
    }

    fn at(&self, vertex: u32) -> &Vertex {
        self.vertices[vertex as usize].as_ref().expect("a vertex with faces")
    }

    fn vertex(&self, vertex: u32) -> Option<Vertex> {
        let topology = &self.topology;
        let ring: Vec<u32> = (topology.vertex_half_edge(vertex) != NONE).then(|| topology.ring(vertex).collect())?;
        let faces = ring.len() as u32;
        let open = topology.is_boundary_vertex(vertex);
        let fan = match (open, faces) {
            (false, valence) => Fan::Interior { valence },
            (true, 1) if self.boundary == Boundary::EdgeAndCorner => Fan::Corner,
            (true, faces) => Fan::Crease { faces },
        };
        let point = |v: u32| self.points[v as usize];
        let mut net = vec![point(vertex)];
        for &h in &ring {
            let face = topology.face_vertices(topology.face(h));
            net.push(point(topology.target(h)));
            net.push(face.iter().map(|&v| point(v)).sum::<DVec3>() / face.len() as f64);
        }
        if open {
            net.push(point(topology.origin(topology.prev(ring[ring.len() - 1]))));
        }
        let limit = fan.vertex().apply(&net);
        Some(Vertex { fan, rows: fan.matrix().apply(&net), tangents: [limit[1], limit[2]] })
    }

    fn patch(&self, face: u32) -> Patch {
        let sides: Vec<u32> = self.topology.face_half_edges(face).collect();
        let corner = |i: usize| self.corner(sides[i]);
        match sides.len() {
            3 => Patch::Triangle(gregory::triangle_points(&std::array::from_fn(corner))),
            _ => Patch::Quad(gregory::quad_points(&std::array::from_fn(corner))),
        }
    }

    /// The corner of a face where a half-edge leaves.
    fn corner(&self, h: u32) -> WholeCorner {
        let vertex = self.at(self.topology.origin(h));
        let plus = self.topology.ring(self.topology.origin(h)).position(|other| other == h).expect("in its own ring");
        let side = |i: usize| {
            let edge = vertex.fan.edge(i);
            let [position, edge_point] = [0, edge.point].map(|row| vertex.rows[row]);
            let [cross_inner, cross_end] = [edge.cross, edge.cross + 1].map(|row| vertex.rows[row]);
            Side { position, edge_point, cross_inner, cross_end }
        };
        let minus = (plus + 1) % vertex.fan.edges();
        WholeCorner { plus: side(plus), minus: side(minus), cosine: vertex.fan.cosine() }
    }
}
