//! From corners back to a description, with all that belongs to its elements.

use std::collections::HashSet;

use super::fans::Fans;
use super::loops::Loops;
use super::report::RepairReport;
use crate::{CageDesc, Corner, Crease, FaceSet, FaceVarying, NONE, Tags};

/// Reports what becomes of vertices and which faces are turned over.
pub(super) fn report(desc: &CageDesc, loops: &Loops, fans: &Fans, turned: &[bool], report: &mut RepairReport) {
    report_vertices(desc, loops, fans, report);
    for f in (0..loops.face_count()).filter(|&f| turned[f]) {
        report.flipped_faces.push(desc.source_face(loops.sources[f]));
    }
}

/// Builds the repaired description.
pub(super) fn carry(desc: CageDesc, tags: Tags, loops: &Loops, fans: &Fans, turned: &[bool]) -> CageDesc {
    let order = corner_order(loops, turned);
    let place_of_vertex = places_of_vertices(loops, fans);
    let corners: Vec<u32> = order.iter().map(|&c| loops.corners[c as usize]).collect();
    let mut rig = desc.rig.clone();
    // The vertices of a place move alike, but only the first is bound where the place is.
    rig.iter_mut().for_each(|rig| rig.gather_vertices(&place_of_vertex));
    CageDesc {
        // Of vertices at one place, all are at the first: what lies near another vertex now lies there.
        positions: place_of_vertex.iter().map(|&place| desc.positions[place as usize]).collect(),
        face_offsets: loops.offsets.clone(),
        face_vertices: order.iter().map(|&c| fans.vertices[c as usize]).collect(),
        uv: desc.uv.as_ref().map(|uv| FaceVarying {
            values: uv.values.clone(),
            indices: corners.iter().map(|&c| uv.indices[c as usize]).collect(),
        }),
        appearance: desc.appearance.as_ref().map(|appearance| appearance.gather(&loops.sources, &corners)),
        rig,
        tags,
        face_sets: carry_sets(&desc.face_sets, &loops.sources),
        source_vertices: fans.sources.iter().map(|&v| desc.source_vertex(v)).collect(),
        source_faces: loops.sources.iter().map(|&f| desc.source_face(f)).collect(),
        ..desc
    }
}

/// The corners in the order in which faces visit them; a face that is turned over starts where it did.
fn corner_order(loops: &Loops, turned: &[bool]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..loops.corners.len() as u32).collect();
    for f in (0..loops.face_count() as u32).filter(|&f| turned[f as usize]) {
        order[loops.row(f)][1..].reverse();
    }
    order
}

fn places_of_vertices(loops: &Loops, fans: &Fans) -> Vec<u32> {
    let mut places = vec![0; fans.sources.len()];
    for (&v, &place) in fans.vertices.iter().zip(&loops.places) {
        places[v as usize] = place;
    }
    places
}

/// Compares the vertices with those there were.
fn report_vertices(desc: &CageDesc, loops: &Loops, fans: &Fans, report: &mut RepairReport) {
    let mut is_used = vec![false; desc.positions.len()];
    let mut found: Vec<(u32, u32)> = Vec::new();
    for (&old, &new) in loops.vertices.iter().zip(&fans.vertices) {
        is_used[old as usize] = true;
        if fans.sources[new as usize] != old {
            found.push((old, new));
        }
    }
    found.sort_unstable();
    found.dedup();
    for welded in found.chunk_by(|a, b| a.0 == b.0) {
        report.welded_vertices.push(desc.source_vertex(welded[0].0));
    }
    // Numbers beyond the first for a vertex stand behind all others.
    let mut copies = vec![0_u32; desc.positions.len()];
    fans.sources.iter().for_each(|&v| copies[v as usize] += 1);
    for (v, _) in (0..).zip(&copies).filter(|(_, copies)| **copies > 1) {
        report.split_vertices.push(desc.source_vertex(v));
    }
    for (v, _) in (0..).zip(&is_used).filter(|(_, used)| !**used) {
        report.unused_vertices.push(desc.source_vertex(v));
    }
}

fn carry_sets(sets: &[FaceSet], sources: &[u32]) -> Vec<FaceSet> {
    sets.iter().map(|set| set.gather(sources)).filter(|set| !set.faces.is_empty()).collect()
}

/// The tags of what is left of their elements.
pub(super) fn tags(desc: &CageDesc, loops: &Loops, fans: &Fans, report: &mut RepairReport) -> Tags {
    let tags = &desc.tags;
    let mut dropped = 0;
    let creases = carry_creases(desc, loops, fans, &mut dropped);
    let corners = carry_corners(desc, loops, fans, &mut dropped);
    let hole = |hole: &u32| {
        // Faces keep their order.
        let face = loops.sources.binary_search(hole).ok().map(|f| f as u32);
        dropped += usize::from(face.is_none());
        face
    };
    let holes = tags.holes.iter().filter_map(hole).collect();
    report.dropped_tags += dropped;
    Tags { creases, corners, holes, ..tags.clone() }
}

/// A crease goes to all edges that its edge became; one whose vertices are joined by no edge any more goes where others at their
/// places are. Of several creases of one edge only the first goes to more than one: a few lines must not ask for a product of
/// tags and faces.
fn carry_creases(desc: &CageDesc, loops: &Loops, fans: &Fans, dropped: &mut usize) -> Vec<Crease> {
    if desc.tags.creases.is_empty() {
        return Vec::new();
    }
    let half_edges = || 0..loops.corners.len() as u32;
    let index = |ends: &dyn Fn(u32) -> [u32; 2]| {
        let mut index: Vec<([u32; 2], u32)> = half_edges().map(|h| (ends(h), h)).collect();
        index.sort_unstable();
        index
    };
    let by_vertices = index(&|h| loops.vertex_ends(h));
    let by_places = index(&|h| loops.ends(h).0);
    let mut place_of = vec![NONE; desc.positions.len()];
    for (&v, &place) in loops.vertices.iter().zip(&loops.places) {
        place_of[v as usize] = place;
    }
    let place = |v: u32| place_of.get(v as usize).copied().unwrap_or(NONE);
    let (mut creases, mut seen) = (Vec::new(), HashSet::new());
    for crease in &desc.tags.creases {
        let [a, b] = crease.vertices;
        let mut found = half_edges_between(&by_vertices, [a, b]);
        if found.is_empty() {
            found = half_edges_between(&by_places, [a, b].map(place));
        }
        if found.first().is_some_and(|&(_, first)| !seen.insert(first)) {
            found = &found[..1];
        }
        *dropped += usize::from(found.is_empty());
        let start = |h: u32| [h, loops.next(h)].map(|c| fans.vertices[c as usize]);
        let mut edges: Vec<[u32; 2]> = found
            .iter()
            .map(|&(_, h)| {
                // In the order of the tag.
                let [u, w] = start(h);
                if loops.places[h as usize] == place(a) { [u, w] } else { [w, u] }
            })
            .collect();
        edges.sort_unstable();
        edges.dedup();
        creases.extend(edges.into_iter().map(|vertices| Crease { vertices, ..*crease }));
    }
    creases
}

fn half_edges_between(index: &[([u32; 2], u32)], [a, b]: [u32; 2]) -> &[([u32; 2], u32)] {
    let ends = [a.min(b), a.max(b)];
    let start = index.partition_point(|entry| entry.0 < ends);
    let len = index[start..].partition_point(|entry| entry.0 == ends);
    &index[start..start + len]
}

/// A corner goes to all vertices that its vertex became; of several corners of one vertex only the first goes to more than one.
fn carry_corners(desc: &CageDesc, loops: &Loops, fans: &Fans, dropped: &mut usize) -> Vec<Corner> {
    if desc.tags.corners.is_empty() {
        return Vec::new();
    }
    let mut pairs: Vec<(u32, u32)> = loops.vertices.iter().copied().zip(fans.vertices.iter().copied()).collect();
    pairs.sort_unstable();
    pairs.dedup();
    let (mut corners, mut seen) = (Vec::new(), HashSet::new());
    for corner in &desc.tags.corners {
        let start = pairs.partition_point(|pair| pair.0 < corner.vertex);
        let most = if seen.insert(corner.vertex) { usize::MAX } else { 1 };
        let found = pairs[start..].iter().take_while(|pair| pair.0 == corner.vertex).take(most);
        let before = corners.len();
        corners.extend(found.map(|&(_, vertex)| Corner { vertex, ..*corner }));
        *dropped += usize::from(corners.len() == before);
    }
    corners
}
