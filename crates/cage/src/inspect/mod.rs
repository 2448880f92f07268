//! What can be said about a cage without drawing it.

use std::collections::BTreeMap;
use std::fmt;

use glam::DVec3;
use rayon::prelude::*;
use serde::{Serialize, Serializer};

use crate::weld::Welder;
use crate::{Cage, Listed, NONE, Topology, Warning};

/// Counts and problems of a cage; serializes with the field names as keys.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Inspection {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of faces, holes included.
    pub faces: usize,
    /// Faces by their number of corners.
    pub faces_by_size: BTreeMap<u32, usize>,
    /// Vertices by valence: the number of edges there, at the boundary too.
    pub valence: BTreeMap<u32, usize>,
    /// Those of them at the boundary.
    pub boundary_valence: BTreeMap<u32, usize>,
    /// Number of edges with one face.
    pub boundary_edges: usize,
    /// Number of closed curves that the boundary edges form.
    pub boundaries: usize,
    /// Number of connected parts.
    pub components: usize,
    /// Number of handles, over all parts.
    pub genus: i64,
    /// Vertices - edges + faces.
    pub euler: i64,
    /// Number of crease tags.
    pub creases: usize,
    /// Number of corner tags.
    pub corners: usize,
    /// Number of hole tags.
    pub holes: usize,
    /// What may surprise; empty for a healthy cage.
    pub problems: Vec<Problem>,
}

/// Something about a cage that is valid but may be a mistake. Serializes as its message.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// What the reader had to say.
    Warning(Warning),
    /// All vertices are at one place.
    Point,
    /// Inner vertices with two edges: the faces there lie back to back or the vertex splits an edge.
    ValenceTwo(Listed<u32>),
    /// Faces with more corners than make sense for a control cage.
    ManyCorners(Listed<u32>),
    /// Edges whose ends are at the same place.
    ZeroLength(Listed<[u32; 2]>),
    /// Faces without area.
    ZeroArea(Listed<u32>),
    /// Faces that are much longer than wide.
    Thin(Listed<u32>),
    /// Boundary vertices at the place of another boundary vertex: a seam that was probably meant to be closed.
    OpenSeam(Listed<u32>),
}

/// Polygons beyond this are listed.
const MOST_CORNERS: u32 = 8;
/// A face is thin if it is this many times longer than wide.
const THIN: f64 = 100.0;
/// Area below this part of the squared perimeter is rounding.
const NO_AREA: f64 = 1e-12;

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Warning(warning) => warning.fmt(f),
            Self::Point => f.write_str("all vertices are at the same place"),
            Self::ValenceTwo(v) => write!(f, "{} of valence 2: {v}", v.count("inner vertex")),
            Self::ManyCorners(faces) => {
                write!(f, "{} with more than {MOST_CORNERS} corners: {faces}", faces.count("face"))
            }
            Self::ZeroLength(edges) => {
                let ends: Vec<String> = edges.first().iter().map(|[a, b]| format!("{a}-{b}")).collect();
                let more = edges.total() - ends.len();
                write!(f, "{} of length zero: {}", edges.count("edge"), ends.join(", "))?;
                if more > 0 { write!(f, " and {more} more") } else { Ok(()) }
            }
            Self::ZeroArea(faces) => write!(f, "{} without area: {faces}", faces.count("face")),
            Self::Thin(faces) => write!(f, "{} more than {THIN} times longer than wide: {faces}", faces.count("face")),
            Self::OpenSeam(v) => {
                write!(f, "{} at the place of another, so a seam may be open: {v}", v.count("boundary vertex"))
            }
        }
    }
}

impl Serialize for Problem {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Counts what there is and lists what may surprise.
#[must_use]
pub fn inspect(cage: &Cage) -> Inspection {
    let topology = cage.topology();
    let vertices = 0..topology.vertex_count() as u32;
    let valence = |v: u32| topology.valence(v);
    let boundaries = boundaries(topology);
    let components = components(topology);
    let euler = topology.vertex_count() as i64 - topology.edge_count() as i64 + topology.face_count() as i64;
    Inspection {
        vertices: cage.vertex_count(),
        edges: topology.edge_count(),
        faces: cage.face_count(),
        faces_by_size: histogram((0..cage.face_count()).map(|f| cage.face(f).len() as u32)),
        valence: histogram(vertices.clone().map(valence)),
        boundary_valence: histogram(vertices.filter(|&v| topology.is_boundary_vertex(v)).map(valence)),
        boundary_edges: topology.twins().iter().filter(|&&twin| twin == NONE).count(),
        boundaries,
        components,
        // Closing every boundary with a disc gives closed orientable parts, for which V - E + F = 2 - 2 genus.
        genus: (2 * components as i64 - euler - boundaries as i64) / 2,
        euler,
        creases: cage.tags().creases.len(),
        corners: cage.tags().corners.len(),
        holes: cage.tags().holes.len(),
        problems: problems(cage),
    }
}

fn histogram(values: impl Iterator<Item = u32>) -> BTreeMap<u32, usize> {
    let mut counts = BTreeMap::new();
    values.for_each(|value| *counts.entry(value).or_default() += 1);
    counts
}

/// Number of closed curves of boundary edges: at every boundary vertex one comes in and one goes out.
fn boundaries(topology: &Topology) -> usize {
    let mut seen = vec![false; topology.vertex_count()];
    let mut loops = 0;
    for start in (0..topology.vertex_count() as u32).filter(|&v| topology.is_boundary_vertex(v)) {
        let mut v = start;
        loops += usize::from(!seen[v as usize]);
        while !std::mem::replace(&mut seen[v as usize], true) {
            v = topology.target(topology.vertex_half_edge(v));
        }
    }
    loops
}

/// Number of connected parts: union-find over vertices, joined along half-edges.
fn components(topology: &Topology) -> usize {
    let mut parents: Vec<u32> = (0..topology.vertex_count() as u32).collect();
    let mut parts = parents.len();
    for h in 0..topology.half_edge_count() as u32 {
        let a = root(&mut parents, topology.origin(h));
        let b = root(&mut parents, topology.target(h));
        if a != b {
            parents[a.max(b) as usize] = a.min(b);
            parts -= 1;
        }
    }
    parts
}

fn root(parents: &mut [u32], mut v: u32) -> u32 {
    while parents[v as usize] != v {
        // Every step halves the path for the next search.
        parents[v as usize] = parents[parents[v as usize] as usize];
        v = parents[v as usize];
    }
    v
}

fn problems(cage: &Cage) -> Vec<Problem> {
    let topology = cage.topology();
    let mut problems: Vec<Problem> = cage.warnings().iter().cloned().map(Problem::Warning).collect();
    if cage.bounds().half_diagonal() == 0.0 {
        problems.push(Problem::Point);
        return problems;
    }
    let vertices = 0..topology.vertex_count() as u32;
    let faces = 0..cage.face_count() as u32;
    let shapes: Vec<Shape> = faces.clone().into_par_iter().map(|f| Shape::of(cage, f)).collect();
    let faces_with = |is: &dyn Fn(&Shape) -> bool| {
        (0..).zip(&shapes).filter(|(_, shape)| is(shape)).map(|(f, _)| f).collect::<Listed<u32>>()
    };

    let two: Listed<u32> = vertices.filter(|&v| topology.valence(v) == 2 && !topology.is_boundary_vertex(v)).collect();
    let large: Listed<u32> = faces.filter(|&f| cage.face(f as usize).len() as u32 > MOST_CORNERS).collect();
    let points = zero_length_edges(cage);
    let flat = faces_with(&Shape::is_flat);
    let thin = faces_with(&|shape| shape.is_thin() && !shape.is_flat());
    let seam = open_seam(cage);

    let found = [
        (two.is_empty(), Problem::ValenceTwo(two)),
        (large.is_empty(), Problem::ManyCorners(large)),
        (points.is_empty(), Problem::ZeroLength(points)),
        (flat.is_empty(), Problem::ZeroArea(flat)),
        (thin.is_empty(), Problem::Thin(thin)),
        (seam.is_empty(), Problem::OpenSeam(seam)),
    ];
    problems.extend(found.into_iter().filter(|(none, _)| !none).map(|(_, problem)| problem));
    problems
}

/// Area and perimeter of a face, in units of the cage's size so that squares neither overflow nor vanish.
struct Shape {
    area: f64,
    perimeter: f64,
}

impl Shape {
    fn of(cage: &Cage, face: u32) -> Self {
        let size = cage.bounds().half_diagonal();
        let corners = cage.face(face as usize);
        let first = cage.positions()[corners[0] as usize];
        let corner = |i: usize| (cage.positions()[corners[i % corners.len()] as usize] - first) / size;
        let (mut normal, mut perimeter) = (DVec3::ZERO, 0.0);
        for i in 0..corners.len() {
            let (a, b) = (corner(i), corner(i + 1));
            normal += a.cross(b);
            perimeter += a.distance(b);
        }
        Self { area: 0.5 * normal.length(), perimeter }
    }

    fn is_flat(&self) -> bool {
        self.area <= NO_AREA * self.perimeter * self.perimeter
    }

    /// A rectangle of sides 1 and r has (half the perimeter)^2 / area = r + 2 + 1/r.
    fn is_thin(&self) -> bool {
        0.25 * self.perimeter * self.perimeter > (THIN + 2.0) * self.area
    }
}

fn zero_length_edges(cage: &Cage) -> Listed<[u32; 2]> {
    let topology = cage.topology();
    let ends = topology.edge_half_edges().iter().map(|&h| [topology.origin(h), topology.target(h)]);
    ends.filter(|ends| cage.positions()[ends[0] as usize] == cage.positions()[ends[1] as usize]).collect()
}

fn open_seam(cage: &Cage) -> Listed<u32> {
    let mut welder = Welder::default();
    let boundary = (0..cage.vertex_count() as u32).filter(|&v| cage.topology().is_boundary_vertex(v));
    boundary.filter(|&v| !welder.weld(cage.positions()[v as usize].to_array(), 0).1).collect()
}

#[cfg(test)]
mod tests;
