//! What can be said about a cage without drawing it.

mod advice;
mod open_tees;
mod problems;
mod shape;

use std::collections::BTreeMap;

use serde::Serialize;

pub use advice::{Advice, Elements};
pub use problems::Problem;

use crate::{Cage, NONE, PolygonReport, Topology};

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
    /// What became of the triangles of a file that has nothing else, where polygons were looked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub polygons: Option<PolygonReport>,
    /// What may surprise; empty for a healthy cage.
    pub problems: Vec<Problem>,
    /// For each problem that modelling can solve: where it is and what to do.
    pub advice: Vec<Advice>,
}

/// Counts what there is and lists what may surprise.
#[must_use]
pub fn inspect(cage: &Cage) -> Inspection {
    let topology = cage.topology();
    let vertices = 0..topology.vertex_count() as u32;
    let valence = |v: u32| topology.valence(v);
    let (problems, advice) = problems::find(cage);
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
        polygons: cage.polygon_report().cloned(),
        problems,
        advice,
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

#[cfg(test)]
mod tests;
