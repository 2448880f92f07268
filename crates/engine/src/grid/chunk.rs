//! One chunk: the vertices of its patches and the triangles between them.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use osculate_subdiv::{NONE, PatchRecord, SurfacePlan};
use rayon::prelude::*;

use crate::grid::Layout;
use crate::grid::plan::{GridPlanDesc, PatchGrid};

/// A vertex on an edge record.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct EdgeSample {
    /// The edge record.
    pub(crate) edge: u32,
    /// Parameter on the record.
    pub(crate) t: f32,
}

/// A patch as the kernels see it. A rate is the number of its segments and where its parameters begin ([`crate::grid::GridRates::word`]).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub(crate) struct GridPatch {
    /// Number of the patch.
    pub(crate) patch: u32,
    /// Its first inner vertex; in [`Layout::Own`] its border lies before it.
    pub(crate) first_inner: u32,
    /// Rates of the sides.
    pub(crate) sides: [u32; 4],
    /// Rates of the inside along u and along v.
    pub(crate) inner: [u32; 2],
}

/// Vertices and triangles of consecutive patches. Vertices are numbered: those of vertex records, those of edge records, those of patches, which in
/// [`Layout::Own`] are all.
#[derive(Clone, Debug)]
pub(crate) struct Chunk {
    /// Vertex records, one vertex each.
    pub(crate) vertex_records: Vec<u32>,
    /// Vertices on edge records.
    pub(crate) edge_samples: Vec<EdgeSample>,
    /// The patches.
    pub(crate) patches: Vec<GridPatch>,
    /// Number of all vertices.
    pub(crate) vertex_count: u32,
    /// Three vertices for each triangle, patch after patch.
    pub(crate) indices: Vec<u32>,
}

/// Patches whose triangles one task writes.
const GROUP: usize = 64;

impl Chunk {
    pub(crate) fn new(desc: &GridPlanDesc<'_>, patches: Range<u32>, numbering: &mut Numbering) -> Self {
        let records = &desc.surface.patches[patches.start as usize..patches.end as usize];
        let grids: Vec<PatchGrid> = records.par_iter().map(|record| desc.grid(record)).collect();
        let shared = desc.layout == Layout::Shared;
        numbering.clear();
        if shared {
            numbering.number(desc, records);
        }
        let mut next = numbering.count();
        let mut placed = Vec::with_capacity(grids.len());
        for (patch, grid) in patches.zip(&grids) {
            let first_inner = next + if shared { 0 } else { grid.pattern.border_count() };
            next = first_inner + grid.pattern.inner_count();
            placed.push(grid.record(desc.rates, patch, first_inner));
        }
        let indices = Indices { desc, records, grids: &grids, placed: &placed, numbering }.write();
        Self {
            vertex_records: numbering.vertices.members.clone(),
            edge_samples: numbering.edge_samples(desc),
            vertex_count: next,
            patches: placed,
            indices,
        }
    }
}

/// Numbers given out to records of one sort.
struct Numbers {
    /// Number of each record, [`NONE`] if it has none.
    of: Vec<u32>,
    /// The records that have one, in order.
    members: Vec<u32>,
    next: u32,
}

impl Numbers {
    fn new(records: usize) -> Self {
        Self { of: vec![NONE; records], members: Vec::new(), next: 0 }
    }

    /// Gives a record the next `count` numbers, unless it has some.
    fn give(&mut self, record: u32, count: u32) {
        let number = &mut self.of[record as usize];
        if *number == NONE {
            *number = self.next;
            self.next += count;
            self.members.push(record);
        }
    }

    fn clear(&mut self) {
        for &record in &self.members {
            self.of[record as usize] = NONE;
        }
        self.members.clear();
        self.next = 0;
    }
}

/// Numbers of the vertices that the patches of a chunk share.
pub(crate) struct Numbering {
    vertices: Numbers,
    /// Numbers of the first vertex of each edge record, from zero.
    edges: Numbers,
}

impl Numbering {
    pub(crate) fn new(surface: &SurfacePlan) -> Self {
        Self {
            vertices: Numbers::new(surface.vertex_records.count()),
            edges: Numbers::new(surface.edge_records.count()),
        }
    }

    fn number(&mut self, desc: &GridPlanDesc<'_>, records: &[PatchRecord]) {
        for record in records {
            for &vertex in &record.vertex {
                self.vertices.give(vertex, 1);
            }
            for &edge in &record.edge {
                self.edges.give(edge / 2, desc.rates.rate(desc.rates.of_edge(edge / 2)).segments() - 1);
            }
        }
    }

    /// Number of shared vertices.
    fn count(&self) -> u32 {
        self.vertices.next + self.edges.next
    }

    fn edge_samples(&self, desc: &GridPlanDesc<'_>) -> Vec<EdgeSample> {
        let samples = |&edge: &u32| {
            let rate = desc.rates.rate(desc.rates.of_edge(edge));
            (1..rate.segments()).map(move |i| EdgeSample { edge, t: rate.parameter(i) })
        };
        self.edges.members.iter().flat_map(samples).collect()
    }

    /// Vertex `i` of `segments`, counted along a side of a patch from its first corner.
    fn on_side(&self, record: &PatchRecord, side: usize, i: u32, segments: u32) -> u32 {
        if i == 0 {
            return self.vertices.of[record.vertex[side] as usize];
        }
        let (edge, flipped) = (record.edge[side] / 2, record.edge[side] & 1 == 1);
        let along = if flipped { segments - i } else { i };
        self.vertices.next + self.edges.of[edge as usize] + along - 1
    }

    fn clear(&mut self) {
        self.vertices.clear();
        self.edges.clear();
    }
}

/// Writes the triangles of all patches.
struct Indices<'a> {
    desc: &'a GridPlanDesc<'a>,
    records: &'a [PatchRecord],
    grids: &'a [PatchGrid],
    placed: &'a [GridPatch],
    numbering: &'a Numbering,
}

impl Indices<'_> {
    fn write(&self) -> Vec<u32> {
        let length = |grids: &[PatchGrid]| grids.iter().map(|grid| 3 * grid.pattern.triangle_count() as usize).sum();
        let lengths: Vec<usize> = self.grids.par_chunks(GROUP).map(length).collect();
        let mut indices = vec![0; lengths.iter().sum()];
        let mut rest = indices.as_mut_slice();
        let mut parts = Vec::with_capacity(lengths.len());
        for length in lengths {
            let (part, others) = rest.split_at_mut(length);
            parts.push(part);
            rest = others;
        }
        parts.into_par_iter().enumerate().for_each(|(group, part)| self.write_group(group, part));
        indices
    }

    fn write_group(&self, group: usize, mut part: &mut [u32]) {
        let mut border = Vec::new();
        for i in group * GROUP..((group + 1) * GROUP).min(self.grids.len()) {
            self.list_border(i, &mut border);
            let (first_inner, border_count) = (self.placed[i].first_inner, border.len() as u32);
            self.grids[i].pattern.for_each_triangle(|triangle| {
                let (target, rest) = std::mem::take(&mut part).split_at_mut(3);
                for (index, vertex) in target.iter_mut().zip(triangle) {
                    let inner = vertex.checked_sub(border_count);
                    *index = inner.map_or_else(|| border[vertex as usize], |inner| first_inner + inner);
                }
                part = rest;
            });
        }
    }

    /// Numbers of the vertices on the border of a patch, counter-clockwise.
    fn list_border(&self, i: usize, border: &mut Vec<u32>) {
        let pattern = &self.grids[i].pattern;
        border.clear();
        if self.desc.layout == Layout::Own {
            let first_inner = self.placed[i].first_inner;
            border.extend(first_inner - pattern.border_count()..first_inner);
            return;
        }
        for (side, &segments) in pattern.sides().iter().enumerate() {
            border.extend((0..segments).map(|k| self.numbering.on_side(&self.records[i], side, k, segments)));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::{HashMap, HashSet};

    use osculate_cage::{Cage, read_obj};
    use osculate_subdiv::PlanDesc;

    use super::*;
    use crate::Spacing;
    use crate::grid::{GridPlan, GridRates, Pattern};

    fn plan(obj: &str) -> SurfacePlan {
        let cage: Cage = read_obj(obj.as_bytes(), "cage.obj").unwrap();
        SurfacePlan::build(&cage, &PlanDesc::default()).unwrap()
    }

    /// A closed cage with triangles and quads, valences 3 to 5.
    fn house() -> SurfacePlan {
        plan(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0.5 0.5 2\n\
             f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n",
        )
    }

    /// An open sheet of `n` by `n` quads.
    fn sheet(n: u32) -> SurfacePlan {
        use std::fmt::Write as _;
        let mut obj = String::new();
        for y in 0..=n {
            for x in 0..=n {
                writeln!(obj, "v {x} {y} 0").unwrap();
            }
        }
        for y in 0..n {
            for x in 1..=n {
                let a = y * (n + 1) + x;
                writeln!(obj, "f {a} {} {} {}", a + 1, a + n + 2, a + n + 1).unwrap();
            }
        }
        plan(&obj)
    }

    /// Factors that differ from edge to edge.
    fn uneven(surface: &SurfacePlan) -> Vec<f32> {
        (0..surface.edge_records.count()).map(|edge| 1.0 + (edge * 7 % 11) as f32 * 0.61).collect()
    }

    fn chunks(surface: &SurfacePlan, rates: &GridRates, layout: Layout, max_vertices: u32) -> Vec<Chunk> {
        GridPlan::new(GridPlanDesc { surface, rates, layout, max_vertices }).chunks().collect()
    }

    /// Directed edges without a partner, and those used twice.
    fn open_edges(chunk: &Chunk) -> (HashSet<(u32, u32)>, usize) {
        let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
        for t in chunk.indices.chunks_exact(3) {
            for k in 0..3 {
                *edges.entry((t[k], t[(k + 1) % 3])).or_default() += 1;
            }
        }
        let twice = edges.values().filter(|&&count| count > 1).count();
        let open = edges.keys().filter(|&&(a, b)| !edges.contains_key(&(b, a))).copied().collect();
        (open, twice)
    }

    /// Where a vertex lies: record, or edge record and parameter, or patch and (u,v).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    enum Place {
        Vertex(u32),
        Edge(u32, u32),
        Inside(u32, u32, u32),
    }

    fn parameter(rates: &GridRates, word: u32, i: u32) -> f32 {
        rates.parameters()[((word >> GridRates::OFFSET_SHIFT) + i) as usize]
    }

    fn segments(word: u32) -> u32 {
        word & ((1 << GridRates::OFFSET_SHIFT) - 1)
    }

    /// The place of each vertex of a patch as the kernels compute it from the patch alone: border and inside.
    fn own_places(surface: &SurfacePlan, rates: &GridRates, patch: &GridPatch) -> Vec<Place> {
        let record = &surface.patches[patch.patch as usize];
        let mut places = Vec::new();
        for (side, &word) in patch.sides.iter().enumerate() {
            for i in 0..segments(word) {
                let t = parameter(rates, word, i);
                let t = if record.edge[side] & 1 == 1 { 1.0 - t } else { t };
                places.push(match i {
                    0 => Place::Vertex(record.vertex[side]),
                    _ => Place::Edge(record.edge[side] / 2, t.to_bits()),
                });
            }
        }
        for j in 1..segments(patch.inner[1]) {
            for i in 1..segments(patch.inner[0]) {
                let [u, v] = [parameter(rates, patch.inner[0], i), parameter(rates, patch.inner[1], j)];
                places.push(Place::Inside(patch.patch, u.to_bits(), v.to_bits()));
            }
        }
        places
    }

    /// The place of each vertex of a shared chunk.
    fn shared_places(surface: &SurfacePlan, rates: &GridRates, chunk: &Chunk) -> Vec<Place> {
        let mut places: Vec<Place> = chunk.vertex_records.iter().map(|&vertex| Place::Vertex(vertex)).collect();
        places.extend(chunk.edge_samples.iter().map(|sample| Place::Edge(sample.edge, sample.t.to_bits())));
        for patch in &chunk.patches {
            assert_eq!(places.len() as u32, patch.first_inner);
            let border: u32 = patch.sides.iter().map(|&word| segments(word)).sum();
            places.extend(own_places(surface, rates, patch).into_iter().skip(border as usize));
        }
        places
    }

    #[test]
    fn a_closed_surface_closes_by_index() {
        let surface = house();
        for spacing in [Spacing::Equal, Spacing::Odd, Spacing::Even] {
            let factors = uneven(&surface);
            for rates in [
                GridRates::uniform(1.0, spacing),
                GridRates::uniform(4.3, spacing),
                GridRates::per_edge(&factors, spacing),
            ] {
                let chunks = chunks(&surface, &rates, Layout::Shared, u32::MAX);
                let [chunk] = chunks.as_slice() else { panic!("{} chunks", chunks.len()) };
                let (open, twice) = open_edges(chunk);
                assert_eq!((open.len(), twice), (0, 0));
                let used: HashSet<u32> = chunk.indices.iter().copied().collect();
                assert_eq!(used.len() as u32, chunk.vertex_count);
                assert!(used.iter().all(|&index| index < chunk.vertex_count));
            }
        }
    }

    /// V - E + F of the triangles is that of a sphere: nothing is joined that should not be.
    #[test]
    fn a_closed_surface_has_its_euler_number() {
        let surface = house();
        let rates = GridRates::per_edge(&uneven(&surface), Spacing::Odd);
        let chunk = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
        let faces = chunk.indices.len() as i64 / 3;
        assert_eq!(i64::from(chunk.vertex_count) - faces * 3 / 2 + faces, 2);
    }

    /// Both layouts are the same triangles between the same places, patch by patch.
    #[test]
    fn both_layouts_join_the_same_places() {
        for surface in [house(), sheet(3)] {
            for spacing in [Spacing::Equal, Spacing::Odd, Spacing::Even] {
                let rates = GridRates::per_edge(&uneven(&surface), spacing);
                let shared = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
                let own = &chunks(&surface, &rates, Layout::Own, u32::MAX)[0];
                let shared_places = shared_places(&surface, &rates, shared);
                assert_eq!(shared_places.len() as u32, shared.vertex_count);
                let distinct: HashSet<&Place> = shared_places.iter().collect();
                assert_eq!(distinct.len(), shared_places.len());
                let places: Vec<Place> =
                    own.patches.iter().flat_map(|patch| own_places(&surface, &rates, patch)).collect();
                assert_eq!(places.len() as u32, own.vertex_count);
                assert!(own.vertex_records.is_empty() && own.edge_samples.is_empty());
                let at = |indices: &[u32], places: &[Place]| -> Vec<Place> {
                    indices.iter().map(|&index| places[index as usize]).collect()
                };
                assert!(at(&shared.indices, &shared_places) == at(&own.indices, &places));
            }
        }
    }

    /// The lower side of one quad is the upper side of its neighbour, walked the other way.
    #[test]
    fn flipped_sides_walk_the_record_backwards() {
        let surface = sheet(1);
        let rates = GridRates::uniform(4.0, Spacing::Equal);
        let chunk = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
        let first_sample = chunk.vertex_records.len() as u32;
        let (mut forwards, mut backwards) = (0, 0);
        for (patch, triangles) in chunk.patches.iter().zip(chunk.indices.chunks_exact(3 * 32)) {
            let record = &surface.patches[patch.patch as usize];
            for side in 0..4 {
                let flipped = record.edge[side] & 1 == 1;
                let from = chunk.vertex_records.iter().position(|&v| v == record.vertex[side]).unwrap() as u32;
                // The segment that begins at the corner ends at the record's first or last vertex.
                let t = if flipped { 0.75 } else { 0.25 };
                let sample = EdgeSample { edge: record.edge[side] / 2, t };
                let to = first_sample + chunk.edge_samples.iter().position(|s| *s == sample).unwrap() as u32;
                let has = |t: &[u32]| (0..3).any(|k| (t[k], t[(k + 1) % 3]) == (from, to));
                assert!(triangles.chunks_exact(3).any(has), "side {side} of {record:?}");
                *if flipped { &mut backwards } else { &mut forwards } += 1;
            }
        }
        // Four patches with four inner edges: each inner edge is walked both ways.
        assert_eq!((forwards, backwards), (12, 4));
    }

    #[test]
    fn chunks_keep_to_the_limit_and_cover_all_patches() {
        let surface = sheet(6);
        let rates = GridRates::per_edge(&uneven(&surface), Spacing::Equal);
        for layout in [Layout::Shared, Layout::Own] {
            let whole: usize = chunks(&surface, &rates, layout, u32::MAX)[0].indices.len();
            let parts = chunks(&surface, &rates, layout, 300);
            assert!(parts.len() > 5, "{}", parts.len());
            assert!(parts.iter().all(|chunk| chunk.vertex_count <= 300));
            let patches: Vec<u32> = parts.iter().flat_map(|chunk| &chunk.patches).map(|patch| patch.patch).collect();
            assert!(patches.into_iter().eq(0..surface.patches.len() as u32));
            assert_eq!(parts.iter().map(|chunk| chunk.indices.len()).sum::<usize>(), whole);
            // A patch that is larger than the limit has a chunk of its own.
            assert_eq!(chunks(&surface, &rates, layout, 1).len(), surface.patches.len());
        }
    }

    #[test]
    fn the_boundary_of_an_open_surface_is_all_that_is_open() {
        let surface = sheet(3);
        let rates = GridRates::uniform(3.0, Spacing::Equal);
        let chunk = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
        let (open, twice) = open_edges(chunk);
        // Four sides of three faces, each two patches of three segments.
        assert_eq!((open.len(), twice), (4 * 3 * 2 * 3, 0));
    }

    #[test]
    fn many_patches_close() {
        let surface = sheet(130);
        assert!(surface.patches.len() > 65_536);
        let rates = GridRates::uniform(1.5, Spacing::Odd);
        let chunk = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
        assert_eq!(chunk.indices.len(), surface.patches.len() * 2 * 9 * 3);
        let (open, twice) = open_edges(chunk);
        assert_eq!((open.len(), twice), (4 * 130 * 2 * 3, 0));
    }

    #[test]
    fn the_first_vertex_of_a_triangle_is_the_patch_its_own() {
        let surface = house();
        let rates = GridRates::per_edge(&uneven(&surface), Spacing::Even);
        let chunk = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
        let desc = GridPlanDesc { surface: &surface, rates: &rates, layout: Layout::Shared, max_vertices: u32::MAX };
        let mut triangles = chunk.indices.chunks_exact(3);
        for patch in &chunk.patches {
            let pattern: Pattern = desc.grid(&surface.patches[patch.patch as usize]).pattern;
            let own = patch.first_inner..patch.first_inner + pattern.inner_count();
            for triangle in triangles.by_ref().take(pattern.triangle_count() as usize) {
                assert!(own.contains(&triangle[0]), "{triangle:?} of {patch:?}");
            }
        }
        assert!(triangles.next().is_none());
    }
}
