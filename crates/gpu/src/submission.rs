//! Handing recordings to the GPU, and waiting for them.
//!
//! # Locks
//! Two kinds of locks are held for long. A buffer's lock is held while the host touches its content, waiting for the GPU
//! included, and by a submission that uses the buffer from before the GPU can start until its timeline value is noted: so the
//! host never misses work that is on its way. The queue's lock makes submissions one sequence. They are taken in one order:
//! first buffers, ascending by id, then the queue. The host's side takes one buffer and nothing else; the GPU needs no lock
//! to get on. Hence nobody waits in a circle, and no thread that waits for the GPU holds the queue, but for a
//! presenter that replaces its swapchain. The other locks (allocator, pipeline cache, messages) are innermost: under them no
//! buffer and no queue is locked.

use std::{collections::HashMap, sync::MutexGuard};

use ash::vk;

use crate::{
    Buffer, Device, GpuError, Image, Recording, Report,
    barrier::derive,
    device::Queue,
    execute::Encoder,
    owned::Owned,
    plan::{Kept, Plan},
    query::Queries,
    resource::ResourceId,
};

/// A command pool with its one command buffer, used by one submission at a time.
pub(crate) struct Commands {
    pool: Owned<vk::CommandPool>,
    pub(crate) buffer: vk::CommandBuffer,
}

/// Work that the GPU does. Keeps alive all it uses, and dropping it waits for its end: to have several in flight, keep them.
#[must_use = "dropping a submission waits for its end"]
pub struct Submission {
    device: Device,
    timeline_value: u64,
    queries: Queries,
    /// Empty once given back.
    commands: Option<Commands>,
    _kept: Kept,
}

impl Device {
    /// Checks a recording and hands it to the GPU. Nothing is done if the recording is wrong.
    pub fn submit(&self, recording: &Recording) -> Result<Submission, GpuError> {
        let plan = Plan::new(self, recording)?;
        let queries = Queries::new(self, recording)?;
        let (commands, timeline_value) = self.hand_over(&plan, &queries)?;
        Ok(Submission { device: self.clone(), timeline_value, queries, commands: Some(commands), _kept: plan.kept })
    }

    /// Hands a plan to the GPU; its commands, and the value that the timeline reaches when they are done.
    fn hand_over(&self, plan: &Plan<'_>, queries: &Queries) -> Result<(Commands, u64), GpuError> {
        // From here to the end the buffers and the queue are locked: the host keeps off the buffers, and layouts are read,
        // used and updated in the order of submissions.
        let mut last_uses = lock_in_order(plan.kept.buffers.values());
        let mut queue = self.queue();
        plan.kept.images.values().try_for_each(Image::check_acquired)?;
        let layouts: HashMap<ResourceId, _> =
            plan.kept.images.iter().map(|(id, image)| (*id, image.layout())).collect();
        let (barriers, layouts) = derive(plan.steps.iter().map(|step| step.uses.as_slice()), &layouts);
        plan.kept.images.iter().try_for_each(|(id, image)| image.check_held(layouts[id]))?;
        let commands = self.begin(&mut queue)?;
        // SAFETY: `begin` put the command buffer of this device into the recording state, nobody else has it, and the
        // submission that our caller makes keeps `kept` and `queries` until the commands have run.
        unsafe { Encoder::new(self, commands.buffer, &plan.kept, queries) }.encode(&plan.steps, &barriers);
        let timeline_value = self.end_and_submit(&mut queue, &commands)?;
        last_uses.iter_mut().for_each(|last_use| **last_use = timeline_value);
        plan.kept.images.iter().for_each(|(id, image)| image.set_layout(layouts[id]));
        Ok((commands, timeline_value))
    }

    /// Submits and waits: for tests and one-off work.
    pub fn run(&self, recording: &Recording) -> Result<Report, GpuError> {
        self.submit(recording)?.wait()
    }

    /// A command buffer in the recording state, to be submitted once.
    pub(crate) fn begin(&self, queue: &mut Queue) -> Result<Commands, GpuError> {
        let commands = match queue.idle.pop() {
            Some(commands) => commands,
            None => self.create_commands(queue.family)?,
        };
        self.begin_commands(commands, vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT)
    }

    /// A new command buffer in the recording state, to be submitted as often as one likes.
    pub(crate) fn begin_reusable(&self, queue: &Queue) -> Result<Commands, GpuError> {
        self.begin_commands(self.create_commands(queue.family)?, vk::CommandBufferUsageFlags::empty())
    }

    /// Puts a command buffer that is not in use into the recording state.
    fn begin_commands(&self, commands: Commands, flags: vk::CommandBufferUsageFlags) -> Result<Commands, GpuError> {
        let failed = |result| GpuError::from_vulkan("beginning a command buffer", result);
        let info = vk::CommandBufferBeginInfo::default().flags(flags);
        // SAFETY: the pool is not in use: it is new, or its submission is complete.
        unsafe {
            self.raw().reset_command_pool(commands.pool.raw, vk::CommandPoolResetFlags::empty()).map_err(failed)?;
            self.raw().begin_command_buffer(commands.buffer, &info).map_err(failed)?;
        }
        Ok(commands)
    }

    fn create_commands(&self, family: u32) -> Result<Commands, GpuError> {
        let failed = |result| GpuError::from_vulkan("creating a command buffer", result);
        let info = vk::CommandPoolCreateInfo::default()
            .flags(vk::CommandPoolCreateFlags::TRANSIENT)
            .queue_family_index(family);
        // SAFETY: the family is that of the device's queue.
        let pool = unsafe { self.raw().create_command_pool(&info, None) }.map_err(failed)?;
        let pool = Owned::new(&self.shared.raw, pool, "commands");
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool.raw).command_buffer_count(1);
        // SAFETY: the pool is new and ours.
        let buffers = unsafe { self.raw().allocate_command_buffers(&info) }.map_err(failed)?;
        let buffer = *buffers.first().ok_or_else(|| failed(vk::Result::ERROR_UNKNOWN))?;
        self.shared.raw.set_name(buffer, "commands");
        Ok(Commands { pool, buffer })
    }

    /// Ends recording and submits; the value that the timeline reaches afterwards.
    fn end_and_submit(&self, queue: &mut Queue, commands: &Commands) -> Result<u64, GpuError> {
        self.end(commands)?;
        self.enqueue(queue, &[vk::CommandBufferSubmitInfo::default().command_buffer(commands.buffer)])
    }

    /// Ends recording.
    pub(crate) fn end(&self, commands: &Commands) -> Result<(), GpuError> {
        // SAFETY: `begin` or `begin_reusable` put the buffer into the recording state, and nobody else has it.
        unsafe { self.raw().end_command_buffer(commands.buffer) }
            .map_err(|result| GpuError::from_vulkan("ending a command buffer", result))
    }

    /// Submits command buffers that are complete and not in use; the value that the timeline reaches afterwards. Callers keep
    /// what the commands use until then.
    pub(crate) fn enqueue(
        &self,
        queue: &mut Queue,
        buffers: &[vk::CommandBufferSubmitInfo<'_>],
    ) -> Result<u64, GpuError> {
        self.enqueue_and_signal(queue, buffers, None)
    }

    /// As [`Self::enqueue`]; signals a binary semaphore too, when everything so far is done. Waits for what the queue is to
    /// wait for.
    pub(crate) fn enqueue_and_signal(
        &self,
        queue: &mut Queue,
        buffers: &[vk::CommandBufferSubmitInfo<'_>],
        done: Option<vk::Semaphore>,
    ) -> Result<u64, GpuError> {
        let value = queue.submitted + 1;
        let stages = vk::PipelineStageFlags2::ALL_COMMANDS;
        let semaphore = |raw| vk::SemaphoreSubmitInfo::default().semaphore(raw).stage_mask(stages);
        let waits: Vec<_> = queue.waits.iter().copied().map(semaphore).collect();
        let timeline = semaphore(self.shared.timeline.raw).value(value);
        let signals: Vec<_> = std::iter::once(timeline).chain(done.map(semaphore)).collect();
        let info = vk::SubmitInfo2::default()
            .command_buffer_infos(buffers)
            .wait_semaphore_infos(&waits)
            .signal_semaphore_infos(&signals);
        // SAFETY: the command buffers are complete; the lock on `queue` makes the access exclusive; what the commands use stays
        // alive as our callers promise; the value is greater than all before. The presenter that put a semaphore into `waits`
        // keeps it, and its signal is on its way.
        unsafe { self.raw().queue_submit2(queue.raw, &[info], vk::Fence::null()) }
            .map_err(|result| GpuError::from_vulkan("submitting", result))?;
        queue.submitted = value;
        queue.waits.clear();
        Ok(value)
    }
}

/// Locks all buffers, each of which occurs once, in the order that all submissions keep.
fn lock_in_order<'a>(buffers: impl Iterator<Item = &'a Buffer>) -> Vec<MutexGuard<'a, u64>> {
    in_order(buffers).into_iter().map(Buffer::lock).collect()
}

/// The order in which buffers are locked.
pub(crate) fn in_order<'a>(buffers: impl Iterator<Item = &'a Buffer>) -> Vec<&'a Buffer> {
    let mut buffers: Vec<&Buffer> = buffers.collect();
    buffers.sort_unstable_by_key(|buffer| buffer.id());
    buffers
}

impl Submission {
    /// Waits for the end and reads what was measured. Fails if a capture did not fit its buffer.
    pub fn wait(mut self) -> Result<Report, GpuError> {
        self.finish()?;
        self.queries.report(&self.device)
    }

    /// Whether the GPU is done, without waiting.
    pub fn is_done(&self) -> Result<bool, GpuError> {
        // SAFETY: the timeline lives as long as the device, which self holds.
        let reached = unsafe { self.device.raw().get_semaphore_counter_value(self.device.shared.timeline.raw) }
            .map_err(|result| GpuError::from_vulkan("asking for progress", result))?;
        Ok(reached >= self.timeline_value)
    }

    /// Waits, and gives the command buffer back for others to use.
    fn finish(&mut self) -> Result<(), GpuError> {
        if self.commands.is_some() {
            self.device.wait_for(self.timeline_value, "waiting for a submission")?;
            let commands = self.commands.take();
            self.device.queue().idle.extend(commands);
        }
        Ok(())
    }
}

impl Drop for Submission {
    fn drop(&mut self) {
        // Waiting fails only if the device is lost; Vulkan then lets go of everything.
        if let Err(error) = self.finish() {
            tracing::error!("a submission ended with its device: {error}");
        }
    }
}

impl std::fmt::Debug for Submission {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Submission").field("timeline_value", &self.timeline_value).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bindings, BufferUsage, ComputePass, ComputePipelineDesc, DeviceDesc, barrier::Barriers, plan::Work};
    use osculate_shader_compiler::{CompileDesc, compile};

    const EMPTY: &str = "#version 460\nvoid main() {}";

    fn device() -> Device {
        let select = std::env::var("OSCULATE_DEVICE").ok();
        Device::new(&DeviceDesc { select, validation: true, ..DeviceDesc::default() }).unwrap()
    }

    /// What validation says of two copies, the second of which reads what the first writes, behind the given barriers.
    fn messages(barriers: impl Fn(&Plan<'_>) -> Vec<Barriers>) -> Vec<String> {
        let device = device();
        let buffers = ["a", "b", "c"].map(|name| device.upload(name, BufferUsage::empty(), &[0u32; 4]).unwrap());
        let mut recording = Recording::new();
        buffers.windows(2).for_each(|pair| recording.copy_buffer(&pair[0], 0..16, &pair[1], 0));
        let plan = Plan::new(&device, &recording).unwrap();
        let queries = Queries::new(&device, &recording).unwrap();
        let mut queue = device.queue();
        let commands = device.begin(&mut queue).unwrap();
        // SAFETY: as in `hand_over`; `plan` and `queries` live until the device is idle.
        unsafe { Encoder::new(&device, commands.buffer, &plan.kept, &queries) }.encode(&plan.steps, &barriers(&plan));
        device.end_and_submit(&mut queue, &commands).unwrap();
        drop(queue);
        device.wait_idle().unwrap();
        device.validation_messages()
    }

    /// All tests on a device would pass without validation too; this one shows that it is on, synchronization included.
    #[test]
    fn validation_reports_a_forgotten_barrier() {
        let derived = |plan: &Plan<'_>| derive(plan.steps.iter().map(|step| step.uses.as_slice()), &HashMap::new()).0;
        assert_eq!(messages(derived), [""; 0]);
        let found = messages(|plan| plan.steps.iter().map(|_| Barriers::default()).collect());
        assert!(found.iter().any(|message| message.contains("SYNC-HAZARD-READ-AFTER-WRITE")), "{found:?}");
    }

    /// The name of the pass stands in messages: here in that of a dispatch that is too large, which `plan` would not let through.
    #[test]
    fn messages_name_the_pass() {
        let device = device();
        let shader = device.shader("empty.comp", &compile(&CompileDesc::new("empty.comp", EMPTY)).unwrap()).unwrap();
        let desc = ComputePipelineDesc { name: "empty", shader: &shader, specialization: &[] };
        let pipeline = device.compute_pipeline(&desc).unwrap();
        let mut recording = Recording::new();
        for name in ["first pass", "second pass"] {
            let (name, pipeline, bindings) = (name.to_owned(), pipeline.clone(), Bindings::new());
            recording.compute(ComputePass { name, pipeline, bindings, push: vec![], groups: [1; 3] });
        }
        let mut plan = Plan::new(&device, &recording).unwrap();
        if let Work::Dispatch { groups, .. } = &mut plan.steps[1].work {
            groups[0] = u32::MAX;
        }
        let queries = Queries::new(&device, &recording).unwrap();
        let commands = device.begin(&mut device.queue()).unwrap();
        // SAFETY: as in `hand_over`, and the commands are never submitted.
        unsafe { Encoder::new(&device, commands.buffer, &plan.kept, &queries) }
            .encode(&plan.steps, &[Barriers::default(), Barriers::default()]);
        let messages = device.validation_messages();
        let [message] = messages.as_slice() else { panic!("{messages:?}") };
        assert!(message.starts_with("in \"second pass\": VUID-vkCmdDispatch-groupCountX"), "{message}");
        assert!(message.contains("name = commands"), "{message}");
    }
}
