//! Plans of parts of cages.
//!
//! A part is planned like a cage of which the own faces and the first ring are drawn and the faces beyond are holes: so each record has the owner that it has
//! in the whole cage, be it a patch of another part, and is computed from the same points in the same order. Then the patches of the first ring, which other
//! parts draw, move to the end of their lists, where no draw reaches them. Records, points and weights keep their numbers.

use std::ops::Range;

use osculate_cage::CagePart;

use crate::{MatrixSource, PatchList, SurfacePlan};

/// What decides about the refinement steps of a cage, and must be the same for all its parts.
#[derive(Clone, Copy)]
pub(crate) struct FaceSizes {
    pub(crate) quads: bool,
    pub(crate) quads_and_triangles: bool,
}

impl SurfacePlan {
    /// Moves patches that another part draws to the ends of their lists.
    pub(crate) fn set_apart(&mut self, part: &CagePart) {
        let own: Vec<bool> = self.quads.iter().map(|&quad| part.is_own(self.locator.base_face(quad))).collect();
        let moved = Moved::new(&mut self.lists, &own);
        self.patches = moved.gathered(&self.patches);
        self.quads = moved.gathered(&self.quads);
        for (patch, &quad) in (0..).zip(&self.quads) {
            self.patch_of_quad[quad as usize] = patch;
        }
        self.nets = moved.moved_nets(&self.lists, &self.nets);
        let net = |net: &mut u32| *net = moved.net(&self.lists, *net);
        for (list, patches) in self.lists.iter().map(|list| (list, list.patches())) {
            if !list.kind.is_stored() {
                self.patches[patches].iter_mut().for_each(|patch| net(&mut patch.net));
            }
        }
        for records in [&mut self.vertex_records, &mut self.edge_records] {
            records.regular.iter_mut().for_each(|slot| *slot = 4 * moved.to[(*slot / 4) as usize] + *slot % 4);
            records.general.iter_mut().for_each(|MatrixSource { net: first, .. }| net(first));
        }
        self.projections.iter_mut().for_each(|source| net(&mut source.net));
    }

    /// The patches that are drawn, in runs: all, but in a part of a cage the patches of its other faces.
    pub fn drawn(&self) -> impl Iterator<Item = Range<u32>> {
        let mut lists = self.lists.iter().peekable();
        std::iter::from_fn(move || {
            let first = lists.next()?;
            let mut run = first.drawn_patches();
            let mut ends_whole = first.drawn == first.count;
            while ends_whole && lists.peek().is_some() {
                let list = lists.next()?;
                (run.end, ends_whole) = (list.drawn_patches().end, list.drawn == list.count);
            }
            Some(run)
        })
        .filter(|run| !run.is_empty())
    }

    /// How many patches are drawn.
    pub fn drawn_count(&self) -> usize {
        self.lists.iter().map(|list| list.drawn as usize).sum()
    }

    /// Whether a patch is drawn, rather than being there for what it shares with patches that are.
    pub fn is_drawn(&self, patch: u32) -> bool {
        let list = self.lists.partition_point(|list| list.first_patch <= patch).checked_sub(1);
        list.is_some_and(|list| self.lists[list].drawn_patches().contains(&patch))
    }
}

impl SurfacePlan {
    /// The final face of a patch, by its number among those of the whole cage that the plan is of a part of.
    ///
    /// # Panics
    /// If there is no such patch.
    pub fn whole_face(&self, part: &CagePart, patch: u32) -> u64 {
        whole_quad(part, self.steps(), self.quads[patch as usize])
    }
}

/// Where patches go.
struct Moved {
    /// The new number of each patch.
    to: Vec<u32>,
    /// The old number of each patch.
    from: Vec<u32>,
}

impl Moved {
    /// Own patches first in each list, and then the others, both in order; tells the lists.
    fn new(lists: &mut [PatchList], own: &[bool]) -> Self {
        let mut from = Vec::with_capacity(own.len());
        for list in lists {
            let patches = || list.patches().map(|patch| patch as u32);
            from.extend(patches().filter(|&patch| own[patch as usize]));
            let drawn = from.len() as u32 - list.first_patch;
            from.extend(patches().filter(|&patch| !own[patch as usize]));
            list.drawn = drawn;
        }
        let mut to = vec![0; from.len()];
        (0..).zip(&from).for_each(|(new, &old)| to[old as usize] = new);
        Self { to, from }
    }

    fn gathered<T: Copy>(&self, of_patches: &[T]) -> Vec<T> {
        self.from.iter().map(|&old| of_patches[old as usize]).collect()
    }

    /// Nets that the vertex stage finds by the number of their patch.
    fn moved_nets(&self, lists: &[PatchList], nets: &[u32]) -> Vec<u32> {
        let mut all = nets.to_vec();
        for (list, size) in lists.iter().filter_map(|list| Some((list, list.kind.net_size()?))) {
            let first = |patch: u32| (list.first_index + size * (patch - list.first_patch)) as usize;
            for patch in list.patches().map(|patch| patch as u32) {
                let old = first(self.from[patch as usize]);
                all[first(patch)..][..size as usize].copy_from_slice(&nets[old..][..size as usize]);
            }
        }
        all
    }

    /// First index of the net that had that one.
    fn net(&self, lists: &[PatchList], net: u32) -> u32 {
        let holds = |list: &&PatchList| {
            let size = list.kind.net_size().unwrap_or(0);
            (list.first_index..list.first_index + size * list.count).contains(&net)
        };
        let Some(list) = lists.iter().find(holds) else { return net };
        let size = list.kind.net_size().unwrap_or(1);
        let patch = list.first_patch + (net - list.first_index) / size;
        list.first_index + size * (self.to[patch as usize] - list.first_patch)
    }
}

/// The number in the whole cage of a final face of a part: they are numbered by half-edges.
fn whole_quad(part: &CagePart, steps: u32, quad: u32) -> u64 {
    match steps {
        0 => u64::from(part.faces()[quad as usize]),
        1 => u64::from(part.whole_half_edge(quad)),
        _ => 4 * u64::from(part.whole_half_edge(quad / 4)) + u64::from(quad % 4),
    }
}

/// What records of a part are called in the whole cage.
///
/// Two records of two parts have the same name if and only if both are that of the same vertex or edge: the name is that of the first corner or side of all
/// patches that have it.
pub struct WholeNames {
    /// Of each vertex record.
    pub vertices: Vec<u64>,
    /// Of each edge record.
    pub edges: Vec<u64>,
    /// Whether patches of other parts have each edge record too.
    pub shared_edges: Vec<bool>,
    /// Whether patches of other parts have each vertex record too.
    pub shared_vertices: Vec<bool>,
}

impl WholeNames {
    /// The names of the records of a part's plan.
    pub fn new(plan: &SurfacePlan, part: &CagePart) -> Self {
        let (vertices, edges) = (plan.vertex_record_count(), plan.edge_record_count());
        let mut names = Self {
            vertices: vec![u64::MAX; vertices],
            edges: vec![u64::MAX; edges],
            shared_edges: vec![false; edges],
            shared_vertices: vec![false; vertices],
        };
        for list in &plan.lists {
            for patch in list.patches() {
                let is_drawn = list.drawn_patches().contains(&(patch as u32));
                let first = 4 * whole_quad(part, plan.steps(), plan.quads[patch]);
                let record = &plan.patches[patch];
                for (slot, k) in (first..).zip(0..record.sides()) {
                    let (vertex, edge) = (record.vertex[k] as usize, (record.edge[k] / 2) as usize);
                    names.vertices[vertex] = names.vertices[vertex].min(slot);
                    names.edges[edge] = names.edges[edge].min(slot);
                    names.shared_vertices[vertex] |= !is_drawn;
                    names.shared_edges[edge] |= !is_drawn;
                }
            }
        }
        names
    }
}

impl PatchList {
    /// Global numbers of the patches that are drawn.
    pub fn drawn_patches(&self) -> Range<u32> {
        self.first_patch..self.first_patch + self.drawn
    }
}
