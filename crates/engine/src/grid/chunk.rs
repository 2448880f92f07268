//! One chunk: the vertices of its patches and the triangles between them.

use std::collections::HashMap;
use std::ops::Range;

use osculate_shaders::layout::GridPatch;
use osculate_subdiv::{NONE, PatchRecord, SurfacePlan};
use rayon::prelude::*;

use crate::grid::Layout;
use crate::grid::plan::{EdgeRun, GridPlanDesc, PatchGrid};

/// Vertices and triangles of consecutive patches.
///
/// A patch numbers the vertices at its corners, along its sides, and inside, in this order; in [`Layout::Shared`] it numbers only those that no patch before
/// it has numbered, and it is the one that evaluates them. In [`Layout::ByRecord`] it numbers those inside alone.
#[derive(Clone, Debug)]
pub(crate) struct Chunk {
    /// The patches as the kernels see them.
    pub(crate) patches: Vec<GridPatch>,
    /// Number of vertices.
    pub(crate) vertex_count: u32,
    /// Three vertices for each triangle, patch after patch.
    pub(crate) indices: Vec<u32>,
    /// Whether any patch has vertices inside.
    pub(crate) has_inside: bool,
}

/// Patches whose triangles one task writes.
const GROUP: usize = 64;

impl Chunk {
    pub(crate) fn new(desc: &GridPlanDesc<'_>, patches: Range<u32>, numbering: &mut Numbering) -> Self {
        let records = &desc.surface.patches[patches.start as usize..patches.end as usize];
        let grids: Vec<PatchGrid> = records.par_iter().map(|record| desc.grid(record)).collect();
        numbering.begin(desc);
        let numbered = patches.zip(records.iter().zip(&grids));
        let patches: Vec<GridPatch> =
            numbered.map(|(patch, (record, grid))| numbering.number(desc, patch, record, grid)).collect();
        let has_inside = grids.iter().any(|grid| grid.pattern.inner_count() > 0);
        Self { vertex_count: numbering.next, indices: write_indices(records, &grids, &patches), has_inside, patches }
    }

    /// Global ids of its patches.
    pub(crate) fn patch_range(&self) -> Range<u32> {
        let first = self.patches.first().map_or(0, |patch| patch.patch_id);
        first..first + self.patches.len() as u32
    }
}

/// Numbers of the vertices that the patches of a chunk share.
pub(crate) struct Numbering {
    next: u32,
    /// Vertex of each vertex record, [`NONE`] if it has none yet.
    of_vertex: Vec<u32>,
    /// First vertex of each edge record; they lie in the record's direction.
    of_edge: Vec<u32>,
    /// Vertex at the middle of the edge of an unrefined face that is in no patch of the chunk, by edge record.
    of_middle: HashMap<u32, u32>,
    /// Runs of edges, if vertices are numbered by records.
    runs: Option<[EdgeRun; 2]>,
    /// The records that have vertices.
    vertices: Vec<u32>,
    edges: Vec<u32>,
}

impl Numbering {
    pub(crate) fn new(surface: &SurfacePlan) -> Self {
        Self {
            next: 0,
            of_vertex: vec![NONE; surface.vertex_records.count()],
            of_edge: vec![NONE; surface.edge_record_count()],
            of_middle: HashMap::new(),
            runs: None,
            vertices: Vec::new(),
            edges: Vec::new(),
        }
    }

    /// Forgets the last chunk.
    fn begin(&mut self, desc: &GridPlanDesc<'_>) {
        self.runs = if desc.layout == Layout::ByRecord { desc.edge_runs() } else { None };
        self.next = self.runs.as_ref().map_or(0, |[_, last]| last.end() as u32);
        self.of_middle.clear();
        self.vertices.drain(..).for_each(|record| self.of_vertex[record as usize] = NONE);
        self.edges.drain(..).for_each(|record| self.of_edge[record as usize] = NONE);
    }

    fn take(&mut self, count: u32) -> u32 {
        let first = self.next;
        self.next += count;
        first
    }

    /// Numbers the vertices of the next patch.
    fn number(&mut self, desc: &GridPlanDesc<'_>, patch: u32, record: &PatchRecord, grid: &PatchGrid) -> GridPatch {
        let mut numbered = grid.record(patch);
        if let Some(runs) = &self.runs {
            let first = |edge: u32| runs[usize::from(!runs[0].edges.contains(&edge))].vertex_of(edge);
            for (k, &segments) in grid.pattern.sides().iter().enumerate() {
                let half = Half { side: k, segments };
                let side = first(record.edge[k] / 2);
                numbered.side_vertex[k] = if record.is_half(k) { half.first_in(side) } else { side };
                numbered.corner_vertex[k] = match record.half_to(k) {
                    Some(side) => half.middle_in(first(record.edge[side] / 2)),
                    None => record.vertex[k],
                };
            }
        } else {
            self.number_border(desc.layout == Layout::Shared, record, grid, &mut numbered);
        }
        numbered.first_inner = self.take(grid.pattern.inner_count());
        numbered
    }

    /// Numbers the vertices on the border of the next patch that are its own or, if they are shared, that no other has numbered.
    fn number_border(&mut self, shared: bool, record: &PatchRecord, grid: &PatchGrid, numbered: &mut GridPatch) {
        for (k, &segments) in grid.pattern.sides().iter().enumerate() {
            let half = Half { side: k, segments };
            let corner = match record.half_to(k) {
                _ if !shared => NONE,
                Some(side) => self.middle(record.edge[side] / 2, half),
                None => self.of_vertex[record.vertex[k] as usize],
            };
            numbered.corner_vertex[k] = corner;
            if corner == NONE {
                numbered.owned |= 1 << k;
                numbered.corner_vertex[k] = self.take(1);
                self.keep_corner(record, k, numbered.corner_vertex[k]);
            }
            let edge = record.edge[k] / 2;
            let side = match self.of_edge[edge as usize] {
                first if shared && first != NONE && record.is_half(k) => half.first_in(first),
                first if shared => first,
                _ => NONE,
            };
            numbered.side_vertex[k] = side;
            if side == NONE {
                numbered.owned |= 16 << k;
                numbered.side_vertex[k] = self.take(segments - 1);
                // No other patch has that half, unless it has all of the edge, and then it comes before.
                if !record.is_half(k) {
                    self.of_edge[edge as usize] = numbered.side_vertex[k];
                    self.edges.push(edge);
                }
            }
        }
    }

    /// The vertex at the middle of an edge of which some patch has a half, [`NONE`] if it has none yet.
    fn middle(&self, edge: u32, half: Half) -> u32 {
        match self.of_edge[edge as usize] {
            NONE => self.of_middle.get(&edge).copied().unwrap_or(NONE),
            first => half.middle_in(first),
        }
    }

    /// Remembers the vertex at a corner.
    fn keep_corner(&mut self, record: &PatchRecord, corner: usize, vertex: u32) {
        if let Some(side) = record.half_to(corner) {
            self.of_middle.insert(record.edge[side] / 2, vertex);
        } else {
            self.of_vertex[record.vertex[corner] as usize] = vertex;
            self.vertices.push(record.vertex[corner]);
        }
    }
}

/// A side that is half the edge of an unrefined face, which has all vertices of the edge in the record's direction. That is the face's, so the side is walked
/// against it.
#[derive(Clone, Copy)]
struct Half {
    side: usize,
    /// Segments of the half.
    segments: u32,
}

impl Half {
    /// The first vertex along the half, in the record's direction, of those of the edge from number `first` on.
    fn first_in(self, first: u32) -> u32 {
        if self.side == 0 { first + self.segments } else { first }
    }

    /// The vertex at the middle of the edge.
    fn middle_in(self, first: u32) -> u32 {
        first + self.segments - 1
    }
}

/// Lists the vertices on the border of a patch, counter-clockwise from corner 0.
fn list_border(record: &PatchRecord, grid: &PatchGrid, patch: &GridPatch, border: &mut Vec<u32>) {
    border.clear();
    for (k, &segments) in grid.pattern.sides().iter().enumerate() {
        let first = patch.side_vertex[k];
        border.push(patch.corner_vertex[k]);
        if record.edge[k] & 1 == 0 {
            border.extend(first..first + segments - 1);
        } else {
            border.extend((first..first + segments - 1).rev());
        }
    }
}

/// The triangles of all patches.
fn write_indices(records: &[PatchRecord], grids: &[PatchGrid], patches: &[GridPatch]) -> Vec<u32> {
    let length = |grids: &[PatchGrid]| grids.iter().map(|grid| 3 * grid.pattern.triangle_count() as usize).sum();
    let lengths: Vec<usize> = grids.par_chunks(GROUP).map(length).collect();
    let mut indices = vec![0; lengths.iter().sum()];
    let mut rest = indices.as_mut_slice();
    let mut parts = Vec::with_capacity(lengths.len());
    for length in lengths {
        let (part, others) = rest.split_at_mut(length);
        parts.push(part);
        rest = others;
    }
    let groups = records.par_chunks(GROUP).zip(grids.par_chunks(GROUP)).zip(patches.par_chunks(GROUP));
    groups.zip(parts).for_each(|(((records, grids), patches), part)| write_group(records, grids, patches, part));
    indices
}

fn write_group(records: &[PatchRecord], grids: &[PatchGrid], patches: &[GridPatch], part: &mut [u32]) {
    let mut triangles = part.as_chunks_mut::<3>().0.iter_mut();
    let mut border = Vec::new();
    for ((record, grid), patch) in records.iter().zip(grids).zip(patches) {
        list_border(record, grid, patch, &mut border);
        let vertex = |local: u32| match border.get(local as usize) {
            Some(&vertex) => vertex,
            None => patch.first_inner + local - border.len() as u32,
        };
        grid.pattern.for_each_triangle(|triangle| {
            if let Some(target) = triangles.next() {
                *target = triangle.map(vertex);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use osculate_cage::{Cage, read_obj};
    use osculate_subdiv::{PlanDesc, Scheme};

    use super::*;
    use crate::Spacing;
    use crate::grid::{GridPlan, GridRates, Pattern};

    fn plan(obj: &str, scheme: Scheme) -> SurfacePlan {
        let cage: Cage = read_obj(obj.as_bytes(), "cage.obj").unwrap();
        SurfacePlan::build(&cage, &PlanDesc { scheme, ..PlanDesc::default() }).unwrap()
    }

    /// A closed cage with triangles and quads, valences 3 to 5: refined to quad patches, and as it is.
    fn houses() -> [SurfacePlan; 2] {
        [Scheme::Gregory2, Scheme::Gregory1].map(house)
    }

    fn house(scheme: Scheme) -> SurfacePlan {
        plan(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0.5 0.5 2\n\
             f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n",
            scheme,
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
        plan(&obj, Scheme::Gregory2)
    }

    /// Factors that differ from edge to edge.
    fn uneven(surface: &SurfacePlan) -> Vec<f32> {
        (0..surface.edge_record_count()).map(|edge| 1.0 + (edge * 7 % 11) as f32 * 0.61).collect()
    }

    fn chunks(surface: &SurfacePlan, rates: &GridRates, layout: Layout, max_vertices: u32) -> Vec<Chunk> {
        GridPlan::new(GridPlanDesc { surface, rates, layout, max_vertices }).into_chunks().collect()
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

    /// Number and place of each vertex that a patch evaluates, as the kernels find them (shaders/include/grid_stage.glsl).
    fn evaluated(surface: &SurfacePlan, rates: &GridRates, patch: &GridPatch) -> Vec<(u32, Place)> {
        let record = &surface.patches[patch.patch_id as usize];
        let mut places = Vec::new();
        for k in 0..record.sides() {
            if patch.owned >> k & 1 == 1 {
                places.push((patch.corner_vertex[k], Place::Vertex(record.vertex[k])));
            }
            if patch.owned >> (4 + k) & 1 == 1 {
                let word = patch.side_rate[k];
                places.extend((1..segments(word)).map(|i| {
                    let t = parameter(rates, word, i);
                    (patch.side_vertex[k] + i - 1, Place::Edge(record.edge[k] / 2, t.to_bits()))
                }));
            }
        }
        let [nu, nv] = patch.inner_rate.map(segments);
        if record.sides() == 3 {
            let inner = (1..nu).flat_map(|j| (1..nu - j).map(move |i| Place::Inside(patch.patch_id, i, j)));
            places.extend((patch.first_inner..).zip(inner));
            return places;
        }
        for j in 1..nv {
            for i in 1..nu {
                let [u, v] = [parameter(rates, patch.inner_rate[0], i), parameter(rates, patch.inner_rate[1], j)];
                let vertex = patch.first_inner + (j - 1) * (nu - 1) + i - 1;
                places.push((vertex, Place::Inside(patch.patch_id, u.to_bits(), v.to_bits())));
            }
        }
        places
    }

    /// The place of each vertex of a chunk; each has one writer.
    fn places(surface: &SurfacePlan, rates: &GridRates, chunk: &Chunk) -> Vec<Place> {
        let mut places = vec![None; chunk.vertex_count as usize];
        for patch in &chunk.patches {
            for (vertex, place) in evaluated(surface, rates, patch) {
                assert_eq!(places[vertex as usize].replace(place), None, "vertex {vertex} has two writers");
            }
        }
        places.into_iter().map(|place| place.expect("every vertex has a writer")).collect()
    }

    #[test]
    fn a_closed_surface_closes_by_index() {
        for surface in houses() {
            for spacing in [Spacing::Equal, Spacing::Odd, Spacing::Even] {
                for rates in [
                    GridRates::uniform(1.0, spacing),
                    GridRates::uniform(4.3, spacing),
                    GridRates::per_edge(&uneven(&surface), spacing),
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
    }

    /// V - E + F of the triangles is that of a sphere: nothing is joined that should not be.
    #[test]
    fn a_closed_surface_has_its_euler_number() {
        for surface in houses() {
            let rates = GridRates::per_edge(&uneven(&surface), Spacing::Odd);
            let chunk = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
            let faces = chunk.indices.len() as i64 / 3;
            assert_eq!(i64::from(chunk.vertex_count) - faces * 3 / 2 + faces, 2);
        }
    }

    /// Both layouts are the same triangles between the same places, patch by patch.
    #[test]
    fn both_layouts_join_the_same_places() {
        for surface in houses().into_iter().chain([sheet(3)]) {
            for spacing in [Spacing::Equal, Spacing::Odd, Spacing::Even] {
                let rates = GridRates::per_edge(&uneven(&surface), spacing);
                let shared = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
                let own = &chunks(&surface, &rates, Layout::Own, u32::MAX)[0];
                let shared_places = places(&surface, &rates, shared);
                let distinct: HashSet<&Place> = shared_places.iter().collect();
                assert_eq!(distinct.len(), shared_places.len());
                let own_places = places(&surface, &rates, own);
                let at = |indices: &[u32], places: &[Place]| -> Vec<Place> {
                    indices.iter().map(|&index| places[index as usize]).collect()
                };
                assert!(at(&shared.indices, &shared_places) == at(&own.indices, &own_places));
            }
        }
    }

    /// Where two patches meet, one of them walks the record backwards.
    #[test]
    fn flipped_sides_walk_the_record_backwards() {
        let surface = sheet(1);
        let rates = GridRates::uniform(4.0, Spacing::Equal);
        let chunk = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
        let places = places(&surface, &rates, chunk);
        let (mut forwards, mut backwards) = (0, 0);
        for (patch, triangles) in chunk.patches.iter().zip(chunk.indices.chunks_exact(3 * 32)) {
            let record = &surface.patches[patch.patch_id as usize];
            for side in 0..4 {
                let flipped = record.edge[side] & 1 == 1;
                let from = Place::Vertex(record.vertex[side]);
                let t: f32 = if flipped { 0.75 } else { 0.25 };
                let to = Place::Edge(record.edge[side] / 2, t.to_bits());
                let at = |vertex: u32| places[vertex as usize];
                let has = |t: &[u32]| (0..3).any(|k| (at(t[k]), at(t[(k + 1) % 3])) == (from, to));
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
            let patches: Vec<u32> = parts.iter().flat_map(|chunk| &chunk.patches).map(|patch| patch.patch_id).collect();
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
        for surface in houses() {
            let rates = GridRates::per_edge(&uneven(&surface), Spacing::Even);
            let desc =
                GridPlanDesc { surface: &surface, rates: &rates, layout: Layout::Shared, max_vertices: u32::MAX };
            let chunk = &chunks(&surface, &rates, Layout::Shared, u32::MAX)[0];
            let mut triangles = chunk.indices.chunks_exact(3);
            for patch in &chunk.patches {
                let pattern: Pattern = desc.grid(&surface.patches[patch.patch_id as usize]).pattern;
                let own = patch.first_inner..patch.first_inner + pattern.inner_count();
                for triangle in triangles.by_ref().take(pattern.triangle_count() as usize) {
                    assert!(own.contains(&triangle[0]), "{triangle:?} of {patch:?}");
                }
            }
            assert!(triangles.next().is_none());
        }
    }
}
