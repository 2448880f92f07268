//! Polygon meshes for tests of patches that need no refinement: connectivity by search, fans, patches, and random meshes.

use std::cell::OnceCell;
use std::collections::{HashMap, HashSet};

use glam::DVec3;
use osculate_surface::gregory::{self, CrossEnd, Fan, Side, WholeCorner};
use osculate_surface::jet::Jet;
use osculate_surface::reference::Mesh;

use crate::star::Random;

/// A manifold polygon mesh.
#[derive(Clone)]
pub(crate) struct Polygons {
    pub(crate) points: Vec<DVec3>,
    pub(crate) faces: Vec<Vec<u32>>,
    /// Face of each directed edge.
    face_of: HashMap<(u32, u32), usize>,
    /// Whether boundary vertices with one face stay.
    keeps_corners: bool,
    /// Every vertex that a face uses, on first use.
    vertices: OnceCell<HashMap<u32, Vertex>>,
}

/// A vertex, its neighbours in order, and the rows of its fan.
#[derive(Clone)]
pub(crate) struct Vertex {
    pub(crate) fan: Fan,
    pub(crate) neighbours: Vec<u32>,
    pub(crate) net: Vec<DVec3>,
    rows: Vec<DVec3>,
}

impl Vertex {
    /// What the edge to `neighbour` takes from here.
    pub(crate) fn side(&self, neighbour: u32) -> Side {
        let i = self.neighbours.iter().position(|&v| v == neighbour).expect("a neighbour");
        let edge = self.fan.edge(i);
        Side {
            position: self.rows[0],
            edge_point: self.rows[edge.point],
            cross_inner: self.rows[edge.cross],
            cross_end: self.rows[edge.cross + 1],
        }
    }

    pub(crate) fn end(&self) -> CrossEnd {
        self.fan.cross_end()
    }
}

/// The patch of a face.
pub(crate) enum Patch {
    Quad([DVec3; 20]),
    Triangle([DVec3; 15]),
}

impl Patch {
    /// Point and derivatives at `t` along side `side`.
    pub(crate) fn on_side(&self, side: usize, t: f64) -> Jet {
        match self {
            Self::Quad(points) => {
                let (u, v) = [(t, 0.0), (1.0, t), (1.0 - t, 1.0), (0.0, 1.0 - t)][side];
                gregory::evaluate(points, u, v)
            }
            Self::Triangle(points) => {
                let (u, v) = [(t, 0.0), (1.0 - t, t), (0.0, 1.0 - t)][side];
                gregory::evaluate_triangle(points, u, v)
            }
        }
    }
}

impl Polygons {
    pub(crate) fn new(points: Vec<DVec3>, faces: Vec<Vec<u32>>) -> Self {
        let mut face_of = HashMap::new();
        for (f, face) in faces.iter().enumerate() {
            for (a, b) in sides(face) {
                assert!(face_of.insert((a, b), f).is_none(), "two faces run from {a} to {b}");
            }
        }
        Self { points, faces, face_of, keeps_corners: true, vertices: OnceCell::new() }
    }

    /// The same mesh with smooth corners.
    pub(crate) fn with_smooth_corners(mut self) -> Self {
        self.keeps_corners = false;
        self.vertices = OnceCell::new();
        self
    }

    /// Directed edges with their faces' side numbers: (a, b, face, side).
    pub(crate) fn half_edges(&self) -> Vec<(u32, u32, usize, usize)> {
        let of_face = |(f, face): (usize, &Vec<u32>)| {
            sides(face).into_iter().enumerate().map(move |(k, (a, b))| (a, b, f, k)).collect::<Vec<_>>()
        };
        self.faces.iter().enumerate().flat_map(of_face).collect()
    }

    /// The face and side that run from `a` to `b`.
    pub(crate) fn find(&self, a: u32, b: u32) -> Option<(usize, usize)> {
        let face = *self.face_of.get(&(a, b))?;
        Some((face, sides(&self.faces[face]).iter().position(|&side| side == (a, b)).expect("its own side")))
    }

    pub(crate) fn vertex(&self, v: u32) -> &Vertex {
        let used = || self.faces.iter().flatten().collect::<HashSet<_>>();
        &self.vertices.get_or_init(|| used().into_iter().map(|&v| (v, self.make_vertex(v))).collect())[&v]
    }

    fn make_vertex(&self, v: u32) -> Vertex {
        let (neighbours, faces) = self.ring(v);
        let fan = match (neighbours.len() == faces.len(), faces.len() as u32) {
            (true, valence) => Fan::Interior { valence },
            (false, 1) if self.keeps_corners => Fan::Corner,
            (false, faces) => Fan::Crease { faces },
        };
        let mut net = vec![self.points[v as usize]];
        for (i, &neighbour) in neighbours.iter().enumerate() {
            net.push(self.points[neighbour as usize]);
            net.extend(faces.get(i).map(|&face| self.centroid(face)));
        }
        let rows = fan.matrix().apply(&net);
        Vertex { fan, neighbours, net, rows }
    }

    /// Neighbours and faces around a vertex, counter-clockwise; from the boundary if it has one.
    fn ring(&self, v: u32) -> (Vec<u32>, Vec<usize>) {
        let outgoing: Vec<u32> = self.half_edges().iter().filter(|&&(a, ..)| a == v).map(|&(_, b, ..)| b).collect();
        let first = outgoing.iter().copied().find(|&b| !self.face_of.contains_key(&(b, v))).unwrap_or(outgoing[0]);
        let (mut neighbours, mut faces, mut at) = (vec![first], Vec::new(), first);
        while let Some(&face) = self.face_of.get(&(v, at)) {
            faces.push(face);
            let ring = &self.faces[face];
            let corner = ring.iter().position(|&x| x == v).expect("a face of v");
            at = ring[(corner + ring.len() - 1) % ring.len()];
            if at == first {
                break;
            }
            neighbours.push(at);
        }
        assert_eq!(faces.len(), outgoing.len(), "vertex {v} has two fans");
        (neighbours, faces)
    }

    fn centroid(&self, face: usize) -> DVec3 {
        let ring = &self.faces[face];
        ring.iter().map(|&v| self.points[v as usize]).sum::<DVec3>() / ring.len() as f64
    }

    /// The patch of each face.
    pub(crate) fn patches(&self) -> Vec<Patch> {
        self.faces.iter().map(|face| self.patch(face)).collect()
    }

    fn patch(&self, face: &[u32]) -> Patch {
        let n = face.len();
        let corner = |i: usize| {
            let vertex = self.vertex(face[i]);
            let (plus, minus) = (vertex.side(face[(i + 1) % n]), vertex.side(face[(i + n - 1) % n]));
            WholeCorner { plus, minus, cosine: vertex.fan.cosine() }
        };
        match n {
            3 => Patch::Triangle(gregory::triangle_points(&std::array::from_fn(corner))),
            4 => Patch::Quad(gregory::quad_points(&std::array::from_fn(corner))),
            _ => panic!("a face with {n} sides"),
        }
    }

    /// The record of the edge from `a` to `b`.
    pub(crate) fn edge_record(&self, a: u32, b: u32) -> ([DVec3; 4], [DVec3; 4]) {
        let (from, to) = (self.vertex(a), self.vertex(b));
        gregory::edge_record((&from.side(b), from.end()), (&to.side(a), to.end()))
    }

    /// The mesh as the reference evaluator takes it.
    pub(crate) fn reference(&self) -> Mesh {
        let mut offsets = vec![0];
        offsets.extend(self.faces.iter().scan(0, |end, face| {
            *end += face.len() as u32;
            Some(*end)
        }));
        Mesh { positions: self.points.clone(), face_offsets: offsets, face_vertices: self.faces.concat() }
    }
}

fn sides(face: &[u32]) -> Vec<(u32, u32)> {
    (0..face.len()).map(|i| (face[i], face[(i + 1) % face.len()])).collect()
}

/// A bumpy sphere of triangles with valences 3 to about 9: an octahedron split twice, then edges flipped at random.
pub(crate) fn random_triangles(seed: u64) -> Polygons {
    let mut random = Random(2 * seed + 1);
    let mut points = vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
    let mut faces: Vec<[u32; 3]> =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    for _ in 0..2 {
        faces = split(&mut points, &faces);
    }
    for point in &mut points {
        let jitter = DVec3::new(random.next(), random.next(), random.next()) - 0.5;
        *point = (*point + 0.15 * jitter).normalize() * (0.9 + 0.2 * random.next());
    }
    for _ in 0..150 {
        flip(&mut faces, &mut random);
    }
    Polygons::new(points, faces.iter().map(|face| face.to_vec()).collect())
}

/// Each triangle in four, new points on the unit sphere.
fn split(points: &mut Vec<DVec3>, faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = HashMap::new();
    let mut out = Vec::new();
    for &[a, b, c] in faces {
        let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(x, y)| {
            *middles.entry((x.min(y), x.max(y))).or_insert_with(|| {
                points.push((points[x as usize] + points[y as usize]).normalize());
                points.len() as u32 - 1
            })
        });
        out.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    out
}

/// Flips a random edge, unless that makes a double edge or leaves a vertex with less than three.
fn flip(faces: &mut [[u32; 3]], random: &mut Random) {
    let (f, k) = ((random.next() * faces.len() as f64) as usize, (random.next() * 3.0) as usize);
    let [a, b, c] = [0, 1, 2].map(|i| faces[f][(k + i) % 3]);
    let valence = |v: u32| faces.iter().filter(|face| face.contains(&v)).count();
    let twin = |&g: &usize| (0..3).any(|i| (faces[g][i], faces[g][(i + 1) % 3]) == (b, a));
    let g = (0..faces.len()).find(twin).expect("a closed mesh");
    let d = *faces[g].iter().find(|&&v| v != a && v != b).expect("a third vertex");
    let joined = faces.iter().any(|face| face.contains(&c) && face.contains(&d));
    if !joined && valence(a) > 3 && valence(b) > 3 {
        (faces[f], faces[g]) = ([c, a, d], [d, b, c]);
    }
}

/// The mesh with many of its triangles merged in pairs to quads, every vertex keeping three faces.
pub(crate) fn merge_pairs(mesh: &Polygons, seed: u64) -> Polygons {
    let mut random = Random(2 * seed + 1);
    let mut valence = vec![0; mesh.points.len()];
    mesh.faces.iter().flatten().for_each(|&v| valence[v as usize] += 1);
    let (mut gone, mut quads) = (HashSet::new(), Vec::new());
    for (a, b, f, _) in mesh.half_edges() {
        let Some((g, _)) = mesh.find(b, a) else { continue };
        let too_few = valence[a as usize].min(valence[b as usize]) <= 3;
        if random.next() > 0.5 || too_few || gone.contains(&f) || gone.contains(&g) {
            continue;
        }
        let apex = |face: usize| *mesh.faces[face].iter().find(|&&v| v != a && v != b).expect("a third vertex");
        quads.push(vec![a, apex(g), b, apex(f)]);
        gone.extend([f, g]);
        [a, b].into_iter().for_each(|v| valence[v as usize] -= 1);
    }
    let triangles = mesh.faces.iter().enumerate().filter(|(f, _)| !gone.contains(f)).map(|(_, face)| face.clone());
    Polygons::new(mesh.points.clone(), triangles.chain(quads).collect())
}

/// The faces below a height, without those that meet others in one vertex only.
pub(crate) fn cut(mesh: &Polygons, height: f64) -> Polygons {
    let mut faces: Vec<Vec<u32>> =
        (0..mesh.faces.len()).filter(|&f| mesh.centroid(f).z < height).map(|f| mesh.faces[f].clone()).collect();
    loop {
        let open = Polygons::new(mesh.points.clone(), faces.clone());
        let starts =
            |v: u32| open.half_edges().iter().filter(|&&(a, b, ..)| a == v && open.find(b, a).is_none()).count();
        match (0..mesh.points.len() as u32).find(|&v| starts(v) > 1) {
            None => return open,
            Some(v) => {
                let worst = faces.iter().position(|face| face.contains(&v)).expect("a face");
                faces.remove(worst);
            }
        }
    }
}
