//! Recordings that run again and again: checked and encoded once.

use std::{collections::HashMap, sync::MutexGuard};

use ash::vk;

use crate::{
    Buffer, Device, GpuError, Image, Recording, Report,
    barrier::{Barriers, Transition, derive},
    device::Queue,
    execute::Encoder,
    plan::{Kept, Plan, Work},
    query::Queries,
    resource::ResourceId,
    submission::{Commands, in_order},
};

/// How much a recording asks of the GPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Workload {
    /// Passes.
    pub passes: u64,
    /// Dispatches of compute pipelines.
    pub dispatches: u64,
    /// Draws of graphics pipelines, captured ones among them.
    pub draws: u64,
    /// Barriers, each for any number of buffers and images; the one at the end among them.
    pub barriers: u64,
    /// Bytes copied from buffer to buffer.
    pub bytes_copied: u64,
}

impl Workload {
    fn new(plan: &Plan<'_>, barriers: &[Barriers]) -> Self {
        let between = barriers.iter().filter(|barriers| !barriers.is_empty()).count() as u64;
        let mut load = Self { passes: plan.steps.len() as u64, barriers: between + 1, ..Self::default() };
        for step in &plan.steps {
            match &step.work {
                Work::Dispatch { .. } => load.dispatches += 1,
                Work::Render { draws, .. } | Work::Capture { draws, .. } => load.draws += draws.len() as u64,
                Work::CopyBuffer { region, .. } => load.bytes_copied += region.size,
                _ => {}
            }
        }
        load
    }
}

/// A recording that is ready to run any number of times, one after the other: nothing is checked, planned or allocated on the
/// device when it does. Keeps alive all it uses; dropping it waits for the end of its last run.
pub struct Prepared {
    device: Device,
    queries: Queries,
    commands: Commands,
    /// Layout of each image before and after a run.
    layouts: HashMap<ResourceId, vk::ImageLayout>,
    kept: Kept,
    /// The buffers of `kept` in the order in which they are locked.
    buffers: Vec<Buffer>,
    workload: Workload,
    /// Value of the timeline after the last run; 0 before the first.
    timeline_value: u64,
    /// Commands that brought images into their layouts before the last run.
    arrival: Option<Commands>,
}

impl Device {
    /// Checks and encodes a recording. Nothing runs yet.
    pub fn prepare(&self, recording: &Recording) -> Result<Prepared, GpuError> {
        let plan = Plan::new(self, recording)?;
        let queries = Queries::new(self, recording)?;
        let uses = || plan.steps.iter().map(|step| step.uses.as_slice());
        // Every run finds the images as the run before left them; `submit` sees to the first one.
        let found = plan.kept.images.iter().map(|(id, image)| (*id, image.layout())).collect();
        let layouts = derive(uses(), &found).1;
        let barriers = derive(uses(), &layouts).0;
        let commands = self.begin_reusable(&self.queue())?;
        // SAFETY: the command buffer is of this device, new, and in the recording state; `Prepared` keeps `kept` and `queries`
        // until its last run is over.
        unsafe { Encoder::new(self, commands.buffer, &plan.kept, &queries) }.encode(&plan.steps, &barriers);
        self.end(&commands)?;
        Ok(Prepared {
            device: self.clone(),
            queries,
            commands,
            layouts,
            buffers: in_order(plan.kept.buffers.values()).into_iter().cloned().collect(),
            workload: Workload::new(&plan, &barriers),
            kept: plan.kept,
            timeline_value: 0,
            arrival: None,
        })
    }
}

impl Device {
    /// Commands that change layouts between submissions, if there is anything to change.
    fn transitions(
        &self,
        queue: &mut Queue,
        kept: &Kept,
        images: Vec<Transition>,
    ) -> Result<Option<Commands>, GpuError> {
        if images.is_empty() {
            return Ok(None);
        }
        let (commands, queries) = (self.begin(queue)?, Queries::none());
        // SAFETY: the command buffer is of this device and in the recording state; the queue is locked, so that nobody else has
        // it; our callers keep `kept` until it has run.
        unsafe { Encoder::new(self, commands.buffer, kept, &queries) }.barriers(&Barriers { memory: None, images });
        self.end(&commands)?;
        Ok(Some(commands))
    }

    /// Submits changes of layouts, if there are any; the value that the timeline reaches then, and the commands.
    pub(crate) fn submit_transitions(
        &self,
        queue: &mut Queue,
        kept: &Kept,
        images: Vec<Transition>,
    ) -> Result<Option<(u64, Commands)>, GpuError> {
        let Some(commands) = self.transitions(queue, kept, images)? else { return Ok(None) };
        let value = self.enqueue(queue, &[vk::CommandBufferSubmitInfo::default().command_buffer(commands.buffer)])?;
        Ok(Some((value, commands)))
    }
}

impl Prepared {
    /// Hands the work to the GPU; waits first if the last run is still going on.
    pub fn submit(&mut self) -> Result<(), GpuError> {
        self.finish()?;
        // As in `Device::submit`: from here on buffers and queue are locked.
        let mut last_uses: Vec<MutexGuard<'_, u64>> = self.buffers.iter().map(Buffer::lock).collect();
        let mut queue = self.device.queue();
        self.arrival = self.arrive(&mut queue)?;
        let info = |commands: &Commands| vk::CommandBufferSubmitInfo::default().command_buffer(commands.buffer);
        self.timeline_value = match &self.arrival {
            Some(arrival) => self.device.enqueue(&mut queue, &[info(arrival), info(&self.commands)])?,
            None => self.device.enqueue(&mut queue, &[info(&self.commands)])?,
        };
        last_uses.iter_mut().for_each(|last_use| **last_use = self.timeline_value);
        self.kept.images.iter().for_each(|(id, image)| image.set_layout(self.layouts[id]));
        Ok(())
    }

    /// Waits for the end of the last run and reads what was measured. Fails if a capture did not fit its buffer; an empty
    /// report if it never ran.
    pub fn wait(&mut self) -> Result<Report, GpuError> {
        self.finish()?;
        if self.timeline_value == 0 { Ok(Report::default()) } else { self.queries.report(&self.device) }
    }

    /// Runs and waits.
    pub fn run(&mut self) -> Result<Report, GpuError> {
        self.submit()?;
        self.wait()
    }

    /// How much each run asks of the GPU.
    pub fn workload(&self) -> Workload {
        self.workload
    }

    /// Commands that bring images into the layouts in which a run finds them, where others have left them in other ones.
    fn arrive(&self, queue: &mut Queue) -> Result<Option<Commands>, GpuError> {
        self.kept.images.values().try_for_each(Image::check_acquired)?;
        self.kept.images.iter().try_for_each(|(id, image)| image.check_held(self.layouts[id]))?;
        let moved = self.kept.images.iter().filter(|(id, image)| image.layout() != self.layouts[id]);
        let images: Vec<Transition> =
            moved.map(|(id, image)| Transition::between(*id, image.layout(), self.layouts[id])).collect();
        self.device.transitions(queue, &self.kept, images)
    }

    /// Waits, and gives spare commands back for others to use.
    fn finish(&mut self) -> Result<(), GpuError> {
        self.device.wait_for(self.timeline_value, "waiting for a prepared recording")?;
        if let Some(arrival) = self.arrival.take() {
            self.device.queue().idle.push(arrival);
        }
        Ok(())
    }
}

impl Drop for Prepared {
    fn drop(&mut self) {
        // Waiting fails only if the device is lost; Vulkan then lets go of everything.
        if let Err(error) = self.finish() {
            tracing::error!("a prepared recording ended with its device: {error}");
        }
    }
}

impl std::fmt::Debug for Prepared {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Prepared").field("workload", &self.workload).finish_non_exhaustive()
    }
}
