//! Fans: one for each vertex that a stored patch has as a corner.

use std::collections::{BTreeMap, BTreeSet};

use osculate_surface::gregory::Fan;
use rayon::prelude::*;

use super::FanRecord;
use super::faces::WholeMesh;
use crate::projections::Projections;
use crate::{Connectivity, MatrixSource, NONE, PlanError};

/// The fans with their nets and matrices.
pub(super) struct Fans {
    /// The fan of each vertex, [`NONE`] if none is needed.
    of_vertex: Vec<u32>,
    /// What each fan is.
    pub(super) kinds: Vec<Fan>,
    pub(super) records: Vec<FanRecord>,
    /// Limit position and tangents of each fan's vertex.
    pub(super) vertices: Vec<MatrixSource>,
    /// The number of each half-edge in the fan of its origin.
    places: Vec<u32>,
    /// Nets of the fans, to follow those of regular patches.
    pub(super) nets: Vec<u32>,
    pub(super) weights: Vec<f32>,
}

/// What all fans of a kind share.
#[derive(Clone, Copy)]
struct Shape {
    /// First weight of the matrix of vectors.
    vectors: u32,
    /// First weight of the matrix of the vertex record.
    vertex: u32,
    cross_end: u32,
    cosine: f32,
}

/// Most weights of all kinds of fans together: half a gibibyte.
const WEIGHT_LIMIT: u64 = 1 << 27;

impl Fans {
    /// Makes the fans, and adds their vectors to `projections`.
    pub(super) fn gather<M: Connectivity>(
        whole: &WholeMesh<'_, M>,
        projections: &mut Projections,
    ) -> Result<Self, PlanError> {
        let vertices = corners_of_stored_patches(whole);
        let kinds: Vec<Fan> = vertices.par_iter().map(|&v| whole.fan(v)).collect();
        let (weights, shapes) = shapes(&kinds)?;
        let mut fans = Self {
            of_vertex: vec![NONE; whole.mesh.vertex_count()],
            kinds,
            records: Vec::with_capacity(vertices.len()),
            vertices: Vec::with_capacity(vertices.len()),
            places: vec![0; whole.mesh.half_edge_count()],
            nets: Vec::new(),
            weights,
        };
        for (i, &vertex) in vertices.iter().enumerate() {
            let (kind, net) = (fans.kinds[i], (whole.nets.len() + fans.nets.len()) as u32);
            let (columns, shape) = (kind.net_size() as u32, shapes[&kind]);
            let first = projections.push((net, columns), shape.vectors, kind.rows() as u32, kind.point_rows() as u32);
            let Shape { cross_end, cosine, .. } = shape;
            fans.of_vertex[vertex as usize] = i as u32;
            fans.records.push(FanRecord { first, edges: kind.edges() as u32, cross_end, cosine });
            fans.vertices.push(MatrixSource { net, weights: shape.vertex, columns });
            fans.add_net(whole, vertex);
        }
        Ok(fans)
    }

    /// The vertex, then the other end of each edge and the centroid of the face after it.
    fn add_net<M: Connectivity>(&mut self, whole: &WholeMesh<'_, M>, vertex: u32) {
        let mesh = whole.mesh;
        self.nets.push(whole.point(vertex));
        let mut last = NONE;
        for (place, h) in mesh.ring(vertex).enumerate() {
            self.places[h as usize] = place as u32;
            self.nets.extend([whole.point(mesh.target(h)), whole.centroid(mesh.face(h))]);
            last = mesh.prev(h);
        }
        if mesh.is_boundary_vertex(vertex) {
            self.nets.push(whole.point(mesh.origin(last)));
        }
    }

    /// The fan of a vertex, which must be a corner of a stored patch.
    pub(super) fn of(&self, vertex: u32) -> u32 {
        self.of_vertex[vertex as usize]
    }

    /// The number of a half-edge in the fan of its origin.
    pub(super) fn place(&self, h: u32) -> u32 {
        self.places[h as usize]
    }

    /// The number of a half-edge in the fan of its target: that of its twin, or of the last edge at the boundary.
    pub(super) fn place_at_target(&self, mesh: &impl Connectivity, h: u32) -> u32 {
        match mesh.twin(h) {
            NONE => self.records[self.of(mesh.target(h)) as usize].edges - 1,
            twin => self.place(twin),
        }
    }

    /// Whether the surface is irregular at each fan's vertex.
    pub(super) fn irregular(&self) -> Vec<bool> {
        let regular = [Fan::Interior { valence: 4 }, Fan::Crease { faces: 2 }, Fan::Corner];
        self.kinds.iter().map(|kind| !regular.contains(kind)).collect()
    }
}

fn corners_of_stored_patches<M: Connectivity>(whole: &WholeMesh<'_, M>) -> Vec<u32> {
    let mut needed = vec![false; whole.mesh.vertex_count()];
    for (patch, _) in whole.stored() {
        whole.sides(patch).for_each(|h| needed[whole.mesh.origin(h) as usize] = true);
    }
    (0..needed.len() as u32).filter(|&v| needed[v as usize]).collect()
}

/// Matrices of all kinds that occur, one after the other, and what else their fans share.
fn shapes(kinds: &[Fan]) -> Result<(Vec<f32>, BTreeMap<Fan, Shape>), PlanError> {
    let distinct: Vec<Fan> = kinds.iter().copied().collect::<BTreeSet<_>>().into_iter().collect();
    let count = distinct.iter().map(|kind| (kind.rows() as u64 + 3) * kind.net_size() as u64).sum();
    if count > WEIGHT_LIMIT {
        let valence = distinct.iter().map(|kind| kind.edges() as u32).max().unwrap_or(0);
        return Err(PlanError::HighValence { valence, count, limit: WEIGHT_LIMIT });
    }
    let blocks: Vec<_> = distinct.par_iter().map(|kind| (kind.matrix().to_f32(), kind.vertex().to_f32())).collect();
    let (mut weights, mut shapes) = (Vec::new(), BTreeMap::new());
    for (kind, (vectors, vertex)) in distinct.into_iter().zip(blocks) {
        let first = weights.len() as u32;
        let (cross_end, cosine) = (kind.cross_end().number(), kind.cosine() as f32);
        shapes.insert(kind, Shape { vectors: first, vertex: first + vectors.len() as u32, cross_end, cosine });
        weights.extend(vectors.into_iter().chain(vertex));
    }
    Ok((weights, shapes))
}
