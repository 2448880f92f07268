//! The tables of one Catmull-Clark step (the report, section 3.1 and Figure 2).

use osculate_cage::BoundaryRule;
use rayon::prelude::*;

use crate::{Connectivity, NONE};

/// Tables that tell the three kernels of a step which points to average. All indices are positions in the one point buffer that holds the points of
/// all levels: old points from `first_old`, then the new face, edge and vertex points from `first_new`.
///
/// Edges are numbered by their first half-edge in face order (the report's Figure 2 numbers them by the edge that *enters* each corner); a row
/// starts at the target of that half-edge, as there.
pub struct RefineTables {
    /// Index of the first old point.
    pub first_old: u32,
    /// Index of the first new point, which is the first new face point.
    pub first_new: u32,
    /// F: (offset, valence) of every old face in `face_indices`.
    pub face_spans: Vec<[u32; 2]>,
    /// F: the old points of every face.
    pub face_indices: Vec<u32>,
    /// E: (old end, new face point, old end, new face point); on the boundary (end, end, end', end').
    pub edge_indices: Vec<[u32; 4]>,
    /// V: (offset, valence n) of every old vertex in `vertex_indices`; n = 1 marks a boundary vertex, n = 0 a corner that stays.
    pub vertex_spans: Vec<[u32; 2]>,
    /// V: n pairs (old neighbour, new face point) counter-clockwise; the two boundary neighbours of a boundary vertex; nothing for a corner.
    pub vertex_indices: Vec<u32>,
    /// All old faces are quads, so face points may run through the edge kernel.
    pub quads: bool,
    /// The rows of V end with the vertex itself: not all new points are there, so that it is not always as far away ([`Self::old_distance`]).
    pub old_in_rows: bool,
}

impl RefineTables {
    /// The tables of one step on `old`, whose points begin at `first_old` in the buffer and end where the new points begin.
    pub fn build(old: &impl Connectivity, rule: BoundaryRule, first_old: u32) -> Self {
        let first_new = first_old + old.vertex_count() as u32;
        let (face_spans, face_indices) = face_tables(old, first_old);
        let (vertex_spans, vertex_indices) = vertex_tables(old, rule, first_old, first_new);
        Self {
            first_old,
            first_new,
            old_in_rows: false,
            quads: face_spans.iter().all(|span| span[1] == 4),
            face_spans,
            face_indices,
            edge_indices: edge_table(old, first_old, first_new),
            vertex_spans,
            vertex_indices,
        }
    }

    /// The centroids of all faces of `old`, alone.
    pub(crate) fn centroids(old: &impl Connectivity, first_old: u32) -> Self {
        let (face_spans, face_indices) = face_tables(old, first_old);
        Self {
            first_old,
            first_new: first_old + old.vertex_count() as u32,
            old_in_rows: false,
            quads: face_spans.iter().all(|span| span[1] == 4),
            face_spans,
            face_indices,
            edge_indices: Vec::new(),
            vertex_spans: Vec::new(),
            vertex_indices: Vec::new(),
        }
    }

    /// Number of new face points, F.
    pub fn face_count(&self) -> usize {
        self.face_spans.len()
    }

    /// Number of new edge points, E.
    pub fn edge_count(&self) -> usize {
        self.edge_indices.len()
    }

    /// Number of new vertex points, V.
    pub fn vertex_count(&self) -> usize {
        self.vertex_spans.len()
    }

    /// Number of new points, F + E + V.
    pub fn new_point_count(&self) -> usize {
        self.face_count() + self.edge_count() + self.vertex_count()
    }

    /// Distance in the buffer from an old point to its new vertex point: F + E + V, as in the report.
    pub fn old_distance(&self) -> u32 {
        self.new_point_count() as u32
    }

    /// Bytes of the tables on the device.
    pub fn bytes(&self) -> usize {
        4 * (2 * self.face_spans.len()
            + self.face_indices.len()
            + 4 * self.edge_indices.len()
            + 2 * self.vertex_spans.len()
            + self.vertex_indices.len())
    }
}

fn face_tables(old: &impl Connectivity, first_old: u32) -> (Vec<[u32; 2]>, Vec<u32>) {
    let span = |f| {
        let range = old.face_half_edges(f);
        [range.start, range.end - range.start]
    };
    let spans = (0..old.face_count() as u32).into_par_iter().map(span).collect();
    let indices = (0..old.half_edge_count() as u32).into_par_iter().map(|h| first_old + old.origin(h)).collect();
    (spans, indices)
}

fn edge_table(old: &impl Connectivity, first_old: u32, first_new: u32) -> Vec<[u32; 4]> {
    let row = |e: u32| {
        let h = old.edge_half_edge(e);
        let (a, b) = (first_old + old.target(h), first_old + old.origin(h));
        match old.twin(h) {
            NONE => [a, a, b, b],
            twin => [a, first_new + old.face(h), b, first_new + old.face(twin)],
        }
    };
    (0..old.edge_count() as u32).into_par_iter().map(row).collect()
}

fn vertex_tables(
    old: &impl Connectivity,
    rule: BoundaryRule,
    first_old: u32,
    first_new: u32,
) -> (Vec<[u32; 2]>, Vec<u32>) {
    let valence = |v| match old.is_boundary_vertex(v) {
        false => old.face_valence(v),
        true => u32::from(!is_corner(old, rule, v)),
    };
    let mut spans: Vec<[u32; 2]> = (0..old.vertex_count() as u32).into_par_iter().map(|v| [0, valence(v)]).collect();
    let mut end = 0;
    for [offset, valence] in &mut spans {
        *offset = end;
        end += 2 * *valence;
    }
    let mut indices = vec![0; end as usize];
    fill_rows(&spans, &mut indices, |v, row| {
        if old.is_boundary_vertex(v) {
            let (start, end) = boundary_half_edges(old, v);
            row.copy_from_slice(&[first_old + old.target(start), first_old + old.origin(end)]);
        } else {
            for (pair, h) in row.chunks_exact_mut(2).zip(old.ring(v)) {
                pair.copy_from_slice(&[first_old + old.target(h), first_new + old.face(h)]);
            }
        }
    });
    (spans, indices)
}

/// Fills, in parallel, the rows of V that are not empty; they lie one after the other.
fn fill_rows(spans: &[[u32; 2]], mut indices: &mut [u32], fill: impl Fn(u32, &mut [u32]) + Sync) {
    const ROWS: usize = 4096;
    let mut blocks = Vec::with_capacity(spans.len().div_ceil(ROWS));
    for spans in spans.chunks(ROWS) {
        let length = spans.iter().map(|[_, valence]| 2 * *valence as usize).sum();
        let (block, rest) = indices.split_at_mut(length);
        blocks.push((spans, block));
        indices = rest;
    }
    blocks.into_par_iter().enumerate().for_each(|(i, (spans, mut block))| {
        for (v, [_, valence]) in (ROWS * i..).zip(spans).filter(|(_, [_, valence])| *valence > 0) {
            let row = block.split_off_mut(..2 * *valence as usize).unwrap_or_default();
            fill(v as u32, row);
        }
    });
}

/// Whether a boundary vertex stays where it is: it has one face and the rule keeps such corners.
pub(crate) fn is_corner(mesh: &impl Connectivity, rule: BoundaryRule, vertex: u32) -> bool {
    rule == BoundaryRule::EdgeAndCorner && mesh.twin(mesh.prev(mesh.vertex_half_edge(vertex))) == NONE
}

/// The boundary half-edges that leave and enter a boundary vertex.
fn boundary_half_edges(mesh: &impl Connectivity, vertex: u32) -> (u32, u32) {
    let start = mesh.vertex_half_edge(vertex);
    let last = mesh.ring(vertex).last().unwrap_or(start);
    (start, mesh.prev(last))
}
