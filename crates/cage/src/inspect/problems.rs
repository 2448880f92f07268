//! What may be a mistake.

use std::fmt;

use glam::DVec3;
use rayon::prelude::*;
use serde::{Serialize, Serializer};

use super::shape::{Shape, THIN};
use super::{Advice, Elements, open_tees};
use crate::weld::Welder;
use crate::{Cage, Listed, NONE, Warning};

/// Something about a cage that is valid but may be a mistake. Serializes as its message.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// What the reader had to say.
    Warning(Box<Warning>),
    /// All vertices are at one place.
    Point,
    /// Inner vertices with two edges: the faces there lie back to back or the vertex splits an edge.
    ValenceTwo(Listed<u32>),
    /// Vertices with more edges than a smooth surface likes.
    Pole(Listed<u32>),
    /// Inner vertices where an edge ends at the middle of another.
    TVertex(Listed<u32>),
    /// Boundary vertices in the middle of a boundary edge: an edge there was probably meant to be split.
    OpenTVertex(Listed<u32>),
    /// Faces with more corners than make sense for a control cage.
    ManyCorners(Listed<u32>),
    /// Edges whose ends are at the same place.
    ZeroLength(Listed<[u32; 2]>),
    /// Faces without area.
    ZeroArea(Listed<u32>),
    /// Faces that are much longer than wide.
    Thin(Listed<u32>),
    /// Faces without neighbours in a cage with others.
    Loose(Listed<u32>),
    /// Boundary vertices at the place of another boundary vertex: a seam that was probably meant to be closed.
    OpenSeam(Listed<u32>),
}

/// Polygons beyond this are listed.
const MOST_CORNERS: u32 = 8;
/// Vertices with more edges are listed.
const MOST_EDGES: u32 = 8;
/// The cosine of the angle beyond which a corner is straight: 170 degrees.
const STRAIGHT: f64 = -0.984_807_753_012_208;

impl Problem {
    /// The problem in one word, for programs.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Warning(_) => "warning",
            Self::Point => "point",
            Self::ValenceTwo(_) => "valence_two",
            Self::Pole(_) => "pole",
            Self::TVertex(_) => "t_vertex",
            Self::OpenTVertex(_) => "open_t_vertex",
            Self::ManyCorners(_) => "many_corners",
            Self::ZeroLength(_) => "zero_length",
            Self::ZeroArea(_) => "zero_area",
            Self::Thin(_) => "thin",
            Self::Loose(_) => "loose",
            Self::OpenSeam(_) => "open_seam",
        }
    }

    /// What to do about it; empty for what the reader had to say, which says so itself.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Warning(_) => "",
            Self::Point => "export the model again: its coordinates are lost",
            Self::ValenceTwo(_) => "dissolve the vertices or lead an edge on through them: the surface folds there",
            Self::Pole(_) => "spread the edges over several vertices: the surface ripples around such poles",
            Self::TVertex(_) => "lead the edge that ends there on through the face beyond, so that quads meet",
            Self::OpenTVertex(_) => "split the edge at the vertex and merge them: the surface gapes there",
            Self::ManyCorners(_) => "divide the faces into quads, which say how the surface runs between the corners",
            Self::ZeroLength(_) => {
                "merge the vertices, as a repair does; if an edge is to be sharp, tag it as a crease"
            }
            Self::ZeroArea(_) => "dissolve the faces: the surface has no normal there",
            Self::Thin(_) => "cut the faces across: shape and shading suffer along their length",
            Self::Loose(_) => "merge the faces with their neighbours, as a repair does, or delete them",
            Self::OpenSeam(_) => "merge the vertices by distance, or let a repair weld them",
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Warning(warning) => warning.fmt(f),
            Self::Point => f.write_str("all vertices are at the same place"),
            Self::ValenceTwo(v) => write!(f, "{} of valence 2: {v}", v.count("inner vertex")),
            Self::Pole(v) => write!(f, "{} with more than {MOST_EDGES} edges: {v}", v.count("vertex")),
            Self::TVertex(v) => write!(f, "{} at the middle of a face's side: {v}", v.count("inner vertex")),
            Self::OpenTVertex(v) => write!(f, "{} at the middle of a boundary edge: {v}", v.count("boundary vertex")),
            Self::ManyCorners(faces) => {
                write!(f, "{} with more than {MOST_CORNERS} corners: {faces}", faces.count("face"))
            }
            Self::ZeroLength(edges) => {
                let ends = edges.map(|[a, b]| format!("{a}-{b}"));
                write!(f, "{} of length zero: {ends}", edges.count("edge"))
            }
            Self::ZeroArea(faces) => write!(f, "{} without area: {faces}", faces.count("face")),
            Self::Thin(faces) => write!(f, "{} more than {THIN} times longer than wide: {faces}", faces.count("face")),
            Self::Loose(faces) => write!(f, "{} without neighbours: {faces}", faces.count("face")),
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

/// Looks for problems, and gives advice on those that are not the reader's.
pub(super) fn find(cage: &Cage) -> (Vec<Problem>, Vec<Advice>) {
    let mut problems: Vec<Problem> = cage.warnings().iter().map(|w| Problem::Warning(Box::new(w.clone()))).collect();
    if cage.bounds().half_diagonal() == 0.0 {
        let advice = Advice::new(&Problem::Point, Elements::Vertices(Vec::new()));
        problems.push(Problem::Point);
        return (problems, vec![advice]);
    }
    let shapes: Vec<Shape> = (0..cage.face_count() as u32).into_par_iter().map(|f| Shape::of(cage, f)).collect();
    let faces_with = |is: &dyn Fn(u32, &Shape) -> bool| {
        (0..).zip(&shapes).filter(|(f, shape)| is(*f, shape)).map(|(f, _)| f).collect::<Vec<u32>>()
    };
    let topology = cage.topology();
    let vertices_with = |is: &dyn Fn(u32) -> bool| (0..cage.vertex_count() as u32).filter(|&v| is(v)).collect();
    let is_folded = |v: u32| topology.valence(v) == 2 && !topology.is_boundary_vertex(v);
    let is_large = |f: u32, _: &Shape| cage.face(f as usize).len() as u32 > MOST_CORNERS;

    let mut found = Found { problems, advice: Vec::new() };
    found.vertices(Problem::ValenceTwo, vertices_with(&is_folded));
    found.vertices(Problem::Pole, vertices_with(&|v| topology.valence(v) > MOST_EDGES));
    found.vertices(Problem::TVertex, vertices_with(&|v| is_t_vertex(cage, v)));
    found.vertices(Problem::OpenTVertex, open_tees::find(cage));
    found.faces(Problem::ManyCorners, faces_with(&is_large));
    found.edges(Problem::ZeroLength, zero_length_edges(cage));
    found.faces(Problem::ZeroArea, faces_with(&|_, shape| shape.is_flat()));
    found.faces(Problem::Thin, faces_with(&|_, shape| shape.is_thin() && !shape.is_flat()));
    found.faces(Problem::Loose, faces_with(&|f, _| is_loose(cage, f)));
    found.vertices(Problem::OpenSeam, open_seam(cage));
    (found.problems, found.advice)
}

/// Problems with elements, and the advice on them.
struct Found {
    problems: Vec<Problem>,
    advice: Vec<Advice>,
}

impl Found {
    fn vertices(&mut self, problem: fn(Listed<u32>) -> Problem, vertices: Vec<u32>) {
        self.push(problem(vertices.iter().copied().collect()), vertices.is_empty(), Elements::Vertices(vertices));
    }

    fn faces(&mut self, problem: fn(Listed<u32>) -> Problem, faces: Vec<u32>) {
        self.push(problem(faces.iter().copied().collect()), faces.is_empty(), Elements::Faces(faces));
    }

    fn edges(&mut self, problem: fn(Listed<[u32; 2]>) -> Problem, edges: Vec<[u32; 2]>) {
        self.push(problem(edges.iter().copied().collect()), edges.is_empty(), Elements::Edges(edges));
    }

    fn push(&mut self, problem: Problem, none: bool, elements: Elements) {
        if !none {
            self.advice.push(Advice::new(&problem, elements));
            self.problems.push(problem);
        }
    }
}

/// Whether an edge ends at an inner vertex in the middle of the side of a face: the other two edges go straight on.
fn is_t_vertex(cage: &Cage, v: u32) -> bool {
    let topology = cage.topology();
    if topology.valence(v) != 3 || topology.is_boundary_vertex(v) {
        return false;
    }
    let at = |v: u32| cage.positions()[v as usize];
    let is_straight = |&h: &u32| {
        let [next, before] = [topology.target(h), topology.origin(topology.prev(h))].map(|end| unit(at(end) - at(v)));
        topology.face_half_edges(topology.face(h)).len() > 4 && next.dot(before) < STRAIGHT
    };
    topology.ring(v).filter(is_straight).count() == 1
}

fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize_or_zero()
}

fn is_loose(cage: &Cage, f: u32) -> bool {
    let topology = cage.topology();
    cage.face_count() > 1 && topology.face_half_edges(f).all(|h| topology.twin(h) == NONE)
}

fn zero_length_edges(cage: &Cage) -> Vec<[u32; 2]> {
    let topology = cage.topology();
    let ends = topology.edge_half_edges().iter().map(|&h| [topology.origin(h), topology.target(h)]);
    ends.filter(|ends| cage.positions()[ends[0] as usize] == cage.positions()[ends[1] as usize]).collect()
}

fn open_seam(cage: &Cage) -> Vec<u32> {
    let mut welder = Welder::default();
    let boundary = (0..cage.vertex_count() as u32).filter(|&v| cage.topology().is_boundary_vertex(v));
    boundary.filter(|&v| !welder.weld(cage.positions()[v as usize].to_array(), 0).1).collect()
}
