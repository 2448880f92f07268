//! Building a [`Topology`]: half-edges are bucketed by the lower vertex of their edge (a counting sort), buckets are sorted in
//! parallel, and every half-edge finds its twin by binary search in its bucket. Gathers only, so the parallel loops need no locks
//! and the result does not depend on the number of threads.

use std::collections::HashSet;

use rayon::prelude::*;

use super::{EdgeFaces, FaceCorner, Fans, Ring, Topology, TopologyError};
use crate::progress::{Cancelled, Watch};
use crate::{Listed, NONE};

/// Ranges of vertices below this are sorted on one thread.
const SORT_GRAIN: usize = 4096;

/// How often [`build`] looks at each half-edge, for its watch.
pub(crate) const STEPS: u64 = 6;

/// [`Topology::build`] under a watch.
pub(crate) fn build(
    vertex_count: usize,
    face_offsets: Vec<u32>,
    face_vertices: Vec<u32>,
    watch: &Watch,
) -> Result<Topology, TopologyError> {
    check_counts(vertex_count, face_vertices.len())?;
    check_offsets(&face_offsets, face_vertices.len())?;
    check_corners(vertex_count, &face_offsets, &face_vertices, watch)?;

    let mut topology = Topology {
        faces: faces_of_half_edges(&face_offsets),
        face_offsets,
        origins: face_vertices,
        twins: Vec::new(),
        edges: Vec::new(),
        edge_half_edges: Vec::new(),
        vertex_half_edges: Vec::new(),
        face_valences: Vec::new(),
    };
    topology.twins = pair(&topology, vertex_count, watch)?;
    number_edges(&mut topology, watch)?;
    find_vertex_half_edges(&mut topology, vertex_count, watch)?;
    check_fans(&topology, watch)?;
    Ok(topology)
}

/// Indices are 32 bits and the last value means "none".
pub(super) fn check_counts(vertices: usize, corners: usize) -> Result<(), TopologyError> {
    for (what, count) in [("vertices", vertices), ("face corners", corners)] {
        if count >= NONE as usize {
            return Err(TopologyError::TooMany { what, count });
        }
    }
    Ok(())
}

fn check_offsets(offsets: &[u32], corners: usize) -> Result<(), TopologyError> {
    let fault = match offsets {
        [] => Some(0),
        [first, ..] if *first != 0 => Some(0),
        [.., last] if *last as usize != corners => Some(offsets.len() - 1),
        _ => offsets.windows(2).position(|pair| pair[1] < pair[0]).map(|i| i + 1),
    };
    fault.map_or(Ok(()), |entry| Err(TopologyError::Offsets { entry, corners }))
}

/// Corners of face `f` of compressed rows.
fn row<'a>(offsets: &[u32], values: &'a [u32], f: usize) -> &'a [u32] {
    &values[offsets[f] as usize..offsets[f + 1] as usize]
}

/// Checks what cannot be repaired: counts, rows and that corners name vertices that exist.
pub(crate) fn check_rows(vertex_count: usize, offsets: &[u32], vertices: &[u32]) -> Result<(), TopologyError> {
    check_counts(vertex_count, vertices.len())?;
    check_offsets(offsets, vertices.len())?;
    check_vertices(vertex_count, offsets, vertices)
}

fn check_vertices(vertex_count: usize, offsets: &[u32], vertices: &[u32]) -> Result<(), TopologyError> {
    let missing = |f: u32| {
        let missing = row(offsets, vertices, f as usize).iter().filter(|&&v| v as usize >= vertex_count);
        missing.map(move |&vertex| FaceCorner { face: f, vertex })
    };
    let corners: Listed<FaceCorner> = (0..offsets.len() as u32 - 1).flat_map(missing).collect();
    if corners.is_empty() { Ok(()) } else { Err(TopologyError::MissingVertex { corners, vertices: vertex_count }) }
}

/// True if a vertex occurs more than once among `corners`.
pub(crate) fn repeats(corners: &[u32]) -> bool {
    !repetitions(corners).is_empty()
}

fn check_corners(vertex_count: usize, offsets: &[u32], vertices: &[u32], watch: &Watch) -> Result<(), TopologyError> {
    let faces = offsets.len() - 1;
    let face = |f: u32| row(offsets, vertices, f as usize);

    let small: Listed<u32> = (0..faces as u32).filter(|&f| face(f).len() < 3).collect();
    if !small.is_empty() {
        return Err(TopologyError::TooFewCorners(small));
    }
    check_vertices(vertex_count, offsets, vertices)?;
    let repeated: Result<Vec<Vec<FaceCorner>>, Cancelled> = (0..faces as u32)
        .into_par_iter()
        .map(|f| {
            watch.at(f)?;
            let repeated = repeated_vertices(face(f)).into_iter();
            Ok(repeated.map(|vertex| FaceCorner { face: f, vertex }).collect::<Vec<_>>())
        })
        .filter(|found| found.as_ref().map_or(true, |found| !found.is_empty()))
        .collect();
    let repeated = repeated?.concat();
    if !repeated.is_empty() {
        return Err(TopologyError::RepeatedVertex(repeated.into_iter().collect()));
    }
    Ok(())
}

/// The vertices that occur more than once among `corners`, each once.
fn repeated_vertices(corners: &[u32]) -> Vec<u32> {
    let mut repeated = repetitions(corners);
    repeated.sort_unstable();
    repeated.dedup();
    repeated
}

/// The vertices that occur more than once among `corners`, once per extra occurrence.
fn repetitions(corners: &[u32]) -> Vec<u32> {
    // Comparing all pairs needs no memory and is quickest for the faces that occur; a huge polygon is sorted.
    const PAIRWISE: usize = 16;
    if corners.len() <= PAIRWISE {
        return corners.iter().enumerate().filter(|&(i, v)| corners[..i].contains(v)).map(|(_, &v)| v).collect();
    }
    let mut sorted = corners.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect()
}

fn faces_of_half_edges(offsets: &[u32]) -> Vec<u32> {
    let mut faces = Vec::with_capacity(offsets.last().map_or(0, |&n| n as usize));
    for (f, pair) in offsets.windows(2).enumerate() {
        faces.extend(std::iter::repeat_n(f as u32, (pair[1] - pair[0]) as usize));
    }
    faces
}

/// Half-edges by the lower vertex of their edge: bucket `v` holds, sorted, `(higher vertex, half-edge)` packed into 64 bits.
struct Buckets {
    offsets: Vec<u32>,
    entries: Vec<u64>,
}

impl Buckets {
    fn new(topology: &Topology, vertex_count: usize, watch: &Watch) -> Result<Self, Cancelled> {
        let low_high = |h: u32| {
            let (a, b) = (topology.origin(h), topology.target(h));
            (a.min(b), a.max(b))
        };
        let half_edges = 0..topology.half_edge_count() as u32;
        let mut offsets = vec![0_u32; vertex_count + 1];
        for h in half_edges.clone() {
            watch.at(h)?;
            offsets[low_high(h).0 as usize + 1] += 1;
        }
        for v in 0..vertex_count {
            offsets[v + 1] += offsets[v];
        }
        let mut cursors = offsets.clone();
        let mut entries = vec![0_u64; topology.half_edge_count()];
        for h in half_edges {
            watch.at(h)?;
            let (low, high) = low_high(h);
            let cursor = &mut cursors[low as usize];
            entries[*cursor as usize] = u64::from(high) << 32 | u64::from(h);
            *cursor += 1;
        }
        sort_rows(&offsets, &mut entries, watch)?;
        Ok(Self { offsets, entries })
    }

    fn bucket(&self, low: u32) -> &[u64] {
        &self.entries[self.offsets[low as usize] as usize..self.offsets[low as usize + 1] as usize]
    }

    /// All half-edges between two vertices, in rising order.
    fn between(&self, a: u32, b: u32) -> impl ExactSizeIterator<Item = u32> + Clone {
        let (low, high) = (a.min(b), u64::from(a.max(b)));
        let bucket = self.bucket(low);
        let start = bucket.partition_point(|e| e >> 32 < high);
        let len = bucket[start..].partition_point(|e| e >> 32 == high);
        bucket[start..start + len].iter().map(|&e| e as u32)
    }
}

/// Sorts each row of `entries`, halving the range of rows until it is worth a thread.
fn sort_rows(offsets: &[u32], entries: &mut [u64], watch: &Watch) -> Result<(), Cancelled> {
    let rows = offsets.len() - 1;
    if rows <= SORT_GRAIN {
        watch.advance(entries.len() as u64)?;
        for pair in offsets.windows(2) {
            entries[(pair[0] - offsets[0]) as usize..(pair[1] - offsets[0]) as usize].sort_unstable();
        }
        return Ok(());
    }
    let middle = rows / 2;
    let (left, right) = entries.split_at_mut((offsets[middle] - offsets[0]) as usize);
    let halves =
        rayon::join(|| sort_rows(&offsets[..=middle], left, watch), || sort_rows(&offsets[middle..], right, watch));
    halves.0.and(halves.1)
}

/// The twin of every half-edge.
fn pair(topology: &Topology, vertex_count: usize, watch: &Watch) -> Result<Vec<u32>, TopologyError> {
    let buckets = Buckets::new(topology, vertex_count, watch)?;
    let twin = |h: u32| {
        watch.at(h).ok()?;
        let mut between = buckets.between(topology.origin(h), topology.target(h));
        match (between.len(), between.next(), between.next()) {
            (1, ..) => Some(NONE),
            (2, Some(a), Some(b)) if topology.origin(a) != topology.origin(b) => Some(if a == h { b } else { a }),
            _ => None,
        }
    };
    let twins: Option<Vec<u32>> = (0..topology.half_edge_count() as u32).into_par_iter().map(twin).collect();
    watch.check()?;
    twins.ok_or_else(|| diagnose_edges(topology, &buckets))
}

/// Lists the edges that [`pair`] stumbled over.
fn diagnose_edges(topology: &Topology, buckets: &Buckets) -> TopologyError {
    let (mut crowded, mut same_way) = (Listed::default(), Listed::default());
    for h in 0..topology.half_edge_count() as u32 {
        let (a, b) = (topology.origin(h), topology.target(h));
        let between = buckets.between(a, b);
        if between.clone().next() != Some(h) {
            continue; // Each edge once.
        }
        let edge =
            || EdgeFaces { vertices: [a.min(b), a.max(b)], faces: between.clone().map(|h| topology.face(h)).collect() };
        match between.len() {
            1 => {}
            2 if between.clone().all(|h| topology.origin(h) == a) => same_way.push(edge()),
            2 => {}
            _ => crowded.push(edge()),
        }
    }
    if crowded.is_empty() {
        TopologyError::InconsistentWinding(same_way)
    } else {
        TopologyError::NonManifoldEdge(crowded)
    }
}

/// Numbers edges by first occurrence; twins must be set.
pub(super) fn number_edges(topology: &mut Topology, watch: &Watch) -> Result<(), Cancelled> {
    // NONE is the highest index: a half-edge without twin is the first of its edge.
    let mut edges = Vec::with_capacity(topology.half_edge_count());
    let mut firsts = Vec::with_capacity(topology.half_edge_count() / 2 + 1);
    for (h, &twin) in (0..).zip(&topology.twins) {
        watch.at(h)?;
        if h < twin {
            edges.push(firsts.len() as u32);
            firsts.push(h);
        } else {
            edges.push(edges[twin as usize]);
        }
    }
    topology.edges = edges;
    topology.edge_half_edges = firsts;
    Ok(())
}

/// Chooses the half-edge of each vertex and counts its faces.
pub(super) fn find_vertex_half_edges(
    topology: &mut Topology,
    vertex_count: usize,
    watch: &Watch,
) -> Result<(), Cancelled> {
    let mut starts = vec![NONE; vertex_count];
    let mut valences = vec![0_u32; vertex_count];
    for h in (0..topology.half_edge_count() as u32).rev() {
        watch.at(h)?;
        let v = topology.origin(h) as usize;
        valences[v] += 1;
        let boundary_start = starts[v] != NONE && topology.twin(starts[v]) == NONE;
        if !boundary_start || topology.twin(h) == NONE {
            starts[v] = h;
        }
    }
    topology.vertex_half_edges = starts;
    topology.face_valences = valences;
    Ok(())
}

/// The ring of a vertex must meet all its faces.
fn check_fans(topology: &Topology, watch: &Watch) -> Result<(), TopologyError> {
    let is_one = |v: u32| topology.ring(v).count() == topology.face_valence(v) as usize;
    let bow_ties: Vec<u32> = (0..topology.vertex_count() as u32)
        .into_par_iter()
        // Once it is cancelled, the rest is skipped.
        .filter(|&v| watch.at(v).is_ok() && !is_one(v))
        .collect();
    watch.check()?;
    if bow_ties.is_empty() {
        return Ok(());
    }
    Err(TopologyError::BowTie(count_fans(topology, &bow_ties)))
}

/// Counts the fans at each of `vertices` (in rising order).
fn count_fans(topology: &Topology, vertices: &[u32]) -> Listed<Fans> {
    let shown = &vertices[..vertices.len().min(Listed::<Fans>::SHOWN)];
    let mut outgoing = vec![Vec::new(); shown.len()];
    for h in 0..topology.half_edge_count() as u32 {
        if let Ok(i) = shown.binary_search(&topology.origin(h)) {
            outgoing[i].push(h);
        }
    }
    let fans = |(&vertex, outgoing): (&u32, &Vec<u32>)| fans_of(topology, vertex, outgoing);
    let mut listed: Listed<Fans> = shown.iter().zip(&outgoing).map(fans).collect();
    // The rest only counts.
    vertices[shown.len()..].iter().for_each(|&vertex| listed.push(Fans { vertex, fans: 0, face: 0 }));
    listed
}

fn fans_of(topology: &Topology, vertex: u32, outgoing: &[u32]) -> Fans {
    // Open fans start where there is no twin; what they leave over are closed fans.
    let open = outgoing.iter().filter(|&&h| topology.twin(h) == NONE);
    let mut seen: HashSet<u32> = HashSet::with_capacity(outgoing.len());
    let (mut fans, mut face) = (0, 0);
    for &h in open.chain(outgoing) {
        if !seen.contains(&h) {
            seen.extend(Ring::new(topology, h));
            fans += 1;
            face = topology.face(h);
        }
    }
    Fans { vertex, fans, face }
}
