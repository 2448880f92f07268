//! Barriers, derived from what passes read and write.
//!
//! One pure function, [`derive`], turns the uses of every pass into the barriers before it. Buffers are tracked as wholes:
//! passes that write disjoint parts of one buffer are ordered all the same. Terms are those of the Vulkan specification,
//! chapter "Synchronization and Cache Control". A submission begins with everything before it complete and visible, since each
//! ends with a full barrier.

use std::collections::HashMap;

use ash::vk;

use crate::resource::ResourceId;

/// Pipeline stages and what they do to memory: one half of a dependency.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Scope {
    pub(crate) stages: vk::PipelineStageFlags2,
    pub(crate) access: vk::AccessFlags2,
}

impl Scope {
    /// `access` by `stages`; nothing if there are no stages.
    pub(crate) fn new(stages: vk::PipelineStageFlags2, access: vk::AccessFlags2) -> Self {
        if stages.is_empty() { Self::default() } else { Self { stages, access } }
    }

    fn is_empty(self) -> bool {
        self.stages.is_empty()
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self { stages: self.stages | other.stages, access: self.access | other.access }
    }

    fn contains(self, other: Self) -> bool {
        self.stages.contains(other.stages) && self.access.contains(other.access)
    }
}

/// What one pass does with one resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Use {
    pub(crate) resource: ResourceId,
    pub(crate) read: Scope,
    pub(crate) write: Scope,
    /// The layout an image must be in; `None` for buffers.
    pub(crate) layout: Option<vk::ImageLayout>,
}

impl Use {
    fn scope(&self) -> Scope {
        self.read.union(self.write)
    }
}

/// The uses of one pass, at most one per resource.
#[derive(Debug, Default)]
pub(crate) struct Uses {
    uses: Vec<Use>,
    positions: HashMap<ResourceId, usize>,
}

impl Uses {
    /// Adds to what the pass does with a resource.
    pub(crate) fn add(&mut self, new: Use) {
        let position = *self.positions.entry(new.resource).or_insert(self.uses.len());
        match self.uses.get_mut(position) {
            Some(known) => {
                known.read = known.read.union(new.read);
                known.write = known.write.union(new.write);
            }
            None => self.uses.push(new),
        }
    }

    pub(crate) fn contains(&self, resource: ResourceId) -> bool {
        self.positions.contains_key(&resource)
    }

    /// The layout in which the pass has an image that it uses.
    pub(crate) fn layout(&self, resource: ResourceId) -> Option<vk::ImageLayout> {
        self.positions.get(&resource).and_then(|&position| self.uses[position].layout)
    }

    pub(crate) fn as_slice(&self) -> &[Use] {
        &self.uses
    }
}

/// What must happen between a pass and those before it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Barriers {
    /// One dependency for all memory: source and destination.
    pub(crate) memory: Option<(Scope, Scope)>,
    /// Changes of image layouts.
    pub(crate) images: Vec<Transition>,
}

impl Barriers {
    pub(crate) fn is_empty(&self) -> bool {
        self.memory.is_none() && self.images.is_empty()
    }
}

/// A change of an image's layout, with its dependency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Transition {
    pub(crate) image: ResourceId,
    pub(crate) source: Scope,
    pub(crate) destination: Scope,
    pub(crate) from: vk::ImageLayout,
    pub(crate) to: vk::ImageLayout,
}

impl Transition {
    /// A change between submissions: after all before, and before all after.
    pub(crate) fn between(image: ResourceId, from: vk::ImageLayout, to: vk::ImageLayout) -> Self {
        let source = Scope::new(vk::PipelineStageFlags2::ALL_COMMANDS, vk::AccessFlags2::MEMORY_WRITE);
        let access = vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE;
        Self { image, source, destination: Scope::new(vk::PipelineStageFlags2::ALL_COMMANDS, access), from, to }
    }
}

/// What has happened to a resource so far.
#[derive(Clone, Debug, Default)]
struct State {
    /// The last write.
    write: Scope,
    /// Scopes to which that write is visible by earlier barriers.
    visible: Vec<Scope>,
    /// Stages that have read since that write.
    reads: vk::PipelineStageFlags2,
    layout: vk::ImageLayout,
}

impl State {
    /// Before the first pass. The full barrier at the end of the last submission has ordered all memory; a layout change must
    /// still name stages to be chained to it.
    fn initial(layout: Option<vk::ImageLayout>) -> Self {
        match layout {
            Some(layout) => Self { layout, reads: vk::PipelineStageFlags2::ALL_COMMANDS, ..Self::default() },
            None => Self::default(),
        }
    }

    /// Whether the last write, if any, is visible to `scope`.
    fn sees(&self, scope: Scope) -> bool {
        self.write.is_empty() || self.visible.iter().any(|seen| seen.contains(scope))
    }

    /// What a conflicting use must wait for.
    fn source(&self) -> Scope {
        Scope { stages: self.write.stages | self.reads, access: self.write.access }
    }

    /// The source of a memory dependency that `next` needs, if it needs any.
    fn hazard(&self, next: &Use) -> Option<Scope> {
        let raw_or_waw = !self.sees(next.scope());
        let war = !next.write.is_empty() && !self.reads.is_empty();
        match (raw_or_waw, war) {
            (false, false) => None,
            (true, false) => Some(self.write),
            (_, true) => Some(self.source()),
        }
    }

    /// Takes note of a layout change: a write that is visible to its destination.
    fn transition(&mut self, to: vk::ImageLayout, destination: Scope) {
        *self = Self {
            write: Scope { stages: destination.stages, access: vk::AccessFlags2::NONE },
            visible: vec![destination],
            reads: vk::PipelineStageFlags2::NONE,
            layout: to,
        };
    }

    /// Takes note of a memory dependency between any two passes.
    fn depend(&mut self, source: Scope, destination: Scope) {
        if !self.write.is_empty() && source.contains(self.write) && !self.sees(destination) {
            self.visible.push(destination);
        }
    }

    /// Takes note of a use, its barriers being in place.
    fn touch(&mut self, next: &Use) {
        if next.write.is_empty() {
            self.reads |= next.read.stages;
        } else {
            self.write = next.write;
            self.visible.clear();
            self.reads = next.read.stages;
        }
    }
}

/// The barriers before each pass, and the layouts in which the passes leave the images.
///
/// `layouts` holds the layouts of images before the first pass.
pub(crate) fn derive<'a>(
    passes: impl IntoIterator<Item = &'a [Use]>,
    layouts: &HashMap<ResourceId, vk::ImageLayout>,
) -> (Vec<Barriers>, HashMap<ResourceId, vk::ImageLayout>) {
    let mut states: HashMap<ResourceId, State> = HashMap::new();
    let barriers = passes.into_iter().map(|uses| before(uses, layouts, &mut states)).collect();
    let images = states.into_iter().filter(|(resource, _)| layouts.contains_key(resource));
    (barriers, images.map(|(resource, state)| (resource, state.layout)).collect())
}

/// The barriers before one pass; brings the states up to its end.
fn before(
    uses: &[Use],
    layouts: &HashMap<ResourceId, vk::ImageLayout>,
    states: &mut HashMap<ResourceId, State>,
) -> Barriers {
    let mut barriers = Barriers::default();
    for next in uses {
        let state = states.entry(next.resource).or_insert_with(|| State::initial(layouts.get(&next.resource).copied()));
        if let Some(to) = next.layout.filter(|layout| *layout != state.layout) {
            let (source, destination) = (state.source(), next.scope());
            barriers.images.push(Transition { image: next.resource, source, destination, from: state.layout, to });
            state.transition(to, destination);
        } else if let Some(source) = state.hazard(next) {
            let (known_source, known_destination) = barriers.memory.unwrap_or_default();
            barriers.memory = Some((known_source.union(source), known_destination.union(next.scope())));
        }
    }
    if let Some((source, destination)) = barriers.memory {
        states.values_mut().for_each(|state| state.depend(source, destination));
    }
    for next in uses {
        states.entry(next.resource).and_modify(|state| state.touch(next));
    }
    barriers
}

#[cfg(test)]
mod tests {
    use super::*;

    const COMPUTE: vk::PipelineStageFlags2 = vk::PipelineStageFlags2::COMPUTE_SHADER;
    const VERTEX: vk::PipelineStageFlags2 = vk::PipelineStageFlags2::VERTEX_SHADER;
    const COPY: vk::PipelineStageFlags2 = vk::PipelineStageFlags2::COPY;
    const OUTPUT: vk::PipelineStageFlags2 = vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT;
    const READ: vk::AccessFlags2 = vk::AccessFlags2::SHADER_STORAGE_READ;
    const WRITE: vk::AccessFlags2 = vk::AccessFlags2::SHADER_STORAGE_WRITE;

    fn read(number: u64, stages: vk::PipelineStageFlags2) -> Use {
        Use { resource: ResourceId::of(number), read: Scope::new(stages, READ), write: Scope::default(), layout: None }
    }

    fn write(number: u64, stages: vk::PipelineStageFlags2) -> Use {
        Use { resource: ResourceId::of(number), read: Scope::default(), write: Scope::new(stages, WRITE), layout: None }
    }

    fn target(number: u64) -> Use {
        Use {
            resource: ResourceId::of(number),
            read: Scope::default(),
            write: Scope::new(OUTPUT, vk::AccessFlags2::COLOR_ATTACHMENT_WRITE),
            layout: Some(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL),
        }
    }

    fn copied(number: u64) -> Use {
        Use {
            resource: ResourceId::of(number),
            read: Scope::new(COPY, vk::AccessFlags2::TRANSFER_READ),
            write: Scope::default(),
            layout: Some(vk::ImageLayout::TRANSFER_SRC_OPTIMAL),
        }
    }

    /// The memory dependencies before each pass, buffers only.
    fn memory(passes: &[Vec<Use>]) -> Vec<Option<(Scope, Scope)>> {
        let (barriers, _) = derive(passes.iter().map(Vec::as_slice), &HashMap::new());
        assert!(barriers.iter().all(|one| one.images.is_empty()));
        barriers.into_iter().map(|one| one.memory).collect()
    }

    #[test]
    fn independent_passes_have_no_barrier() {
        assert_eq!(memory(&[vec![write(0, COMPUTE)], vec![write(1, COMPUTE)], vec![]]), [None, None, None]);
    }

    #[test]
    fn reads_need_no_barrier_between_them() {
        assert_eq!(memory(&[vec![read(0, COMPUTE)], vec![read(0, VERTEX)]]), [None, None]);
    }

    #[test]
    fn a_read_waits_for_the_write_and_sees_it() {
        let found = memory(&[vec![write(0, COMPUTE)], vec![read(0, VERTEX)]]);
        assert_eq!(found, [None, Some((Scope::new(COMPUTE, WRITE), Scope::new(VERTEX, READ)))]);
    }

    #[test]
    fn a_second_read_of_the_same_kind_is_already_served() {
        let found = memory(&[vec![write(0, COMPUTE)], vec![read(0, VERTEX)], vec![read(0, VERTEX)]]);
        assert_eq!(found[2], None);
    }

    #[test]
    fn a_second_read_of_another_kind_is_not() {
        let found = memory(&[vec![write(0, COMPUTE)], vec![read(0, VERTEX)], vec![read(0, COMPUTE)]]);
        assert_eq!(found[2], Some((Scope::new(COMPUTE, WRITE), Scope::new(COMPUTE, READ))));
    }

    #[test]
    fn a_write_waits_for_a_write() {
        let found = memory(&[vec![write(0, COMPUTE)], vec![write(0, COMPUTE)]]);
        assert_eq!(found[1], Some((Scope::new(COMPUTE, WRITE), Scope::new(COMPUTE, WRITE))));
    }

    #[test]
    fn a_write_waits_for_reads_without_flushing_them() {
        let found = memory(&[vec![read(0, VERTEX)], vec![read(0, COPY)], vec![write(0, COMPUTE)]]);
        assert_eq!(
            found[2],
            Some((Scope { stages: VERTEX | COPY, access: vk::AccessFlags2::NONE }, Scope::new(COMPUTE, WRITE)))
        );
    }

    #[test]
    fn a_pass_that_reads_and_writes_is_ordered_against_itself() {
        let both = Use { read: Scope::new(COMPUTE, READ), ..write(0, COMPUTE) };
        let found = memory(&[vec![both], vec![both]]);
        let scope = Scope::new(COMPUTE, READ | WRITE);
        assert_eq!(found, [None, Some((Scope::new(COMPUTE, WRITE), scope))]);
    }

    #[test]
    fn one_barrier_serves_all_writes_that_it_covers() {
        let passes = [vec![write(0, COMPUTE), write(1, COMPUTE)], vec![read(0, VERTEX)], vec![read(1, VERTEX)]];
        assert_eq!(memory(&passes)[2], None);
    }

    #[test]
    fn a_write_after_the_barrier_is_not_covered_by_it() {
        let passes = [
            vec![write(0, COMPUTE), write(1, COMPUTE)],
            vec![read(0, VERTEX)],
            vec![write(1, COMPUTE)],
            vec![read(1, VERTEX)],
        ];
        assert!(memory(&passes)[3].is_some());
    }

    #[test]
    fn hazards_of_one_pass_are_joined() {
        let passes = [vec![write(0, COMPUTE), write(1, COPY)], vec![read(0, VERTEX), read(1, COMPUTE)]];
        let source = Scope::new(COMPUTE | COPY, WRITE);
        assert_eq!(memory(&passes)[1], Some((source, Scope::new(VERTEX | COMPUTE, READ))));
    }

    #[test]
    fn uses_of_one_resource_in_a_pass_are_united() {
        let mut uses = Uses::default();
        uses.add(read(0, VERTEX));
        uses.add(write(0, COMPUTE));
        uses.add(read(1, VERTEX));
        let both = Use { read: Scope::new(VERTEX, READ), ..write(0, COMPUTE) };
        assert_eq!(uses.as_slice(), [both, read(1, VERTEX)]);
        assert!(uses.contains(ResourceId::of(1)) && !uses.contains(ResourceId::of(2)));
    }

    #[test]
    fn images_change_layout_once_and_keep_it() {
        let image = ResourceId::of(7);
        let layouts = HashMap::from([(image, vk::ImageLayout::UNDEFINED)]);
        let passes = [vec![target(7)], vec![target(7)], vec![copied(7)]];
        let (barriers, last) = derive(passes.iter().map(Vec::as_slice), &layouts);
        let first = barriers[0].images[0];
        assert_eq!((first.from, first.to), (vk::ImageLayout::UNDEFINED, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL));
        assert_eq!(first.source.stages, vk::PipelineStageFlags2::ALL_COMMANDS);
        assert!(barriers[1].images.is_empty() && barriers[1].memory.is_some(), "write after write");
        let third = barriers[2].images[0];
        assert_eq!(third.source, Scope::new(OUTPUT, vk::AccessFlags2::COLOR_ATTACHMENT_WRITE));
        assert_eq!(third.destination, Scope::new(COPY, vk::AccessFlags2::TRANSFER_READ));
        assert_eq!(last[&image], vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
    }

    #[test]
    fn a_layout_kept_from_an_earlier_submission_needs_no_change() {
        let layouts = HashMap::from([(ResourceId::of(7), vk::ImageLayout::TRANSFER_SRC_OPTIMAL)]);
        let (barriers, _) = derive([[copied(7)].as_slice()], &layouts);
        assert_eq!(barriers, [Barriers::default()]);
    }

    #[test]
    fn a_write_after_a_read_in_another_layout_waits_for_the_read() {
        let layouts = HashMap::from([(ResourceId::of(7), vk::ImageLayout::TRANSFER_SRC_OPTIMAL)]);
        let passes = [vec![copied(7)], vec![target(7)]];
        let (barriers, _) = derive(passes.iter().map(Vec::as_slice), &layouts);
        assert!(barriers[1].images[0].source.stages.contains(COPY));
    }
}
