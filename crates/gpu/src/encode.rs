//! Passes and draws in command buffers of somebody else's.
//!
//! When those commands run is not known here. So the buffers and images that they use are *held* until the caller says that
//! they have run, by dropping an [`Encoded`]: the host cannot write held buffers, and nobody can change the layout of held images.
//! Contents that change from frame to frame are therefore part of the commands ([`Recording::write`]), so that any number of frames
//! can be under way.

use std::collections::HashMap;

use ash::vk;

use crate::{
    Device, Draw, GpuError, Image, Recording, Rect,
    barrier::{Scope, Transition, Use, derive},
    execute::Encoder,
    plan::{DrawPlan, Kept, Plan},
    query::Queries,
    recording::Pass,
    resource::ResourceId,
};

/// A descriptor set of the caller's, bound as set 1 of pipelines whose shaders declare one
/// ([`GraphicsPipelineDesc::caller_set`](crate::GraphicsPipelineDesc::caller_set)).
#[derive(Clone, Copy, Debug)]
pub struct CallerSet<'a> {
    /// The set.
    pub set: vk::DescriptorSet,
    /// Offsets of its dynamic buffers.
    pub dynamic_offsets: &'a [u32],
}

/// Draws for a rendering that the caller has begun.
#[derive(Clone, Copy, Debug)]
pub struct EncodeDraws<'a> {
    /// What is drawn, in order.
    pub draws: &'a [Draw],
    /// What clip space is mapped to. May be upside down (negative height); front faces are then those that were back faces.
    pub viewport: vk::Viewport,
    /// The texels that may change, within the rendering's area.
    pub area: Rect,
    /// What pipelines with [`GraphicsPipelineDesc::caller_set`](crate::GraphicsPipelineDesc::caller_set) get as descriptor set 1.
    pub caller_set: Option<CallerSet<'a>>,
}

/// What commands in a caller's command buffer use: kept alive, and held, until this is dropped.
///
/// To be dropped when the commands have run (the fence or the timeline of their submission says so) or never will. May be sent
/// to other threads.
#[must_use = "dropped before the commands have run, what they use is gone"]
pub struct Encoded {
    kept: Kept,
}

impl Drop for Encoded {
    fn drop(&mut self) {
        self.kept.buffers.values().for_each(|buffer| buffer.release());
        self.kept.images.values().for_each(Image::release);
    }
}

impl std::fmt::Debug for Encoded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Encoded").finish_non_exhaustive()
    }
}

impl Device {
    /// Writes the passes of a recording into a command buffer of the caller's, each behind the barriers it needs, with one at the
    /// start (reads by commands encoded earlier, if the passes write what those read) and one at the end (reads by draws and
    /// passes encoded later).
    ///
    /// Nothing is submitted, but for a change of the layout of images that are not in the one that the passes want, which is
    /// waited for: it happens when a texture is first used. What is measured is left out. The commands change the bound compute and graphics
    /// pipelines, descriptor set 0 and push constants.
    ///
    /// # Errors
    /// If the recording is wrong, or holds a capture pass, whose count of triangles nobody would read.
    ///
    /// # Safety
    /// * `commands` is of this device and a family with graphics and compute, in the recording state, primary, outside of any
    ///   rendering, and used by no other thread meanwhile.
    /// * It runs at most once for each call of this function, on the queue of this device or ordered against it by semaphores.
    ///   Command buffers that use the same resources run in the order in which they were encoded, in one sequence.
    /// * The returned value is kept until the commands have run, or is dropped when they never will.
    pub unsafe fn encode(&self, commands: vk::CommandBuffer, recording: &Recording) -> Result<Encoded, GpuError> {
        if let Some(pass) = recording.passes.iter().find(|pass| matches!(pass, Pass::Capture(_))) {
            let reason = "captures belong into recordings that the device itself submits".to_owned();
            return Err(GpuError::Pass { pass: pass.name(), reason });
        }
        let plan = Plan::new(self, recording)?;
        let uses = || plan.steps.iter().map(|step| step.uses.as_slice());
        let layouts = self.settle(&plan.kept, uses())?;
        let barriers = derive(uses(), &layouts).0;
        let encoded = Encoded { kept: plan.kept };
        let queries = Queries::none();
        // SAFETY: our caller vouches for the command buffer, and keeps `encoded`.
        let encoder = unsafe { Encoder::new(self, commands, &encoded.kept, &queries) };
        encoder.enter(stages(uses()));
        encoder.steps(&plan.steps, &barriers);
        encoder.leave(writes(uses()));
        Ok(encoded)
    }

    /// Writes draws into a rendering that the caller has begun. What they read was made by passes that [`Self::encode`] wrote
    /// earlier, or that were submitted: no barriers are needed in between.
    ///
    /// As [`Self::encode`] it submits nothing but a change of layouts of textures when they are first used. The commands change the
    /// graphics pipeline, descriptor sets 0 and 1, push constants, index buffer, vertex buffer 0, viewport and scissor.
    ///
    /// # Errors
    /// If a draw is wrong, or its pipeline declares descriptor set 1 and none is given.
    ///
    /// # Safety
    /// * As for [`Self::encode`], but that a dynamic rendering has been begun in `commands`, with attachments of the formats and
    ///   samples that the pipelines were made for, one layer, no view mask, and not for secondary command buffers.
    /// * The viewport is within the device's limits; the set of [`EncodeDraws::caller_set`] fits the layout that the pipelines were made with, with as many offsets, and is
    ///   valid until the commands have run.
    pub unsafe fn encode_draws(
        &self,
        commands: vk::CommandBuffer,
        desc: &EncodeDraws<'_>,
    ) -> Result<Encoded, GpuError> {
        let plan = DrawPlan::new(self, desc.draws, desc.caller_set.is_some())?;
        self.settle(&plan.kept, [plan.uses.as_slice()])?;
        let encoded = Encoded { kept: plan.kept };
        let queries = Queries::none();
        // SAFETY: our caller vouches for the command buffer, and keeps `encoded`.
        let encoder = unsafe { Encoder::new(self, commands, &encoded.kept, &queries) };
        encoder.draws_for_caller(&plan.draws, desc);
        Ok(encoded)
    }

    /// Brings images into the layouts in which the passes begin and end, and holds all that they use.
    fn settle<'a>(
        &self,
        kept: &Kept,
        uses: impl IntoIterator<Item = &'a [Use]>,
    ) -> Result<HashMap<ResourceId, vk::ImageLayout>, GpuError> {
        let mut queue = self.queue();
        kept.images.values().try_for_each(Image::check_acquired)?;
        let found = kept.images.iter().map(|(id, image)| (*id, image.layout())).collect();
        let layouts = derive(uses, &found).1;
        kept.images.iter().try_for_each(|(id, image)| image.check_held(layouts[id]))?;
        let moved = kept.images.iter().filter(|(id, _)| found[*id] != layouts[id]);
        let images: Vec<_> = moved.map(|(id, _)| Transition::between(*id, found[id], layouts[id])).collect();
        let arrival = self.submit_transitions(&mut queue, kept, images)?;
        for (id, image) in &kept.images {
            image.set_layout(layouts[id]);
            image.hold();
        }
        drop(queue);
        if let Some((value, commands)) = arrival {
            self.wait_for(value, "changing the layouts of textures")?;
            self.queue().idle.push(commands);
        }
        // One after the other: whoever writes to one of them meanwhile is done when its lock is free.
        kept.buffers.values().for_each(|buffer| buffer.hold());
        Ok(layouts)
    }
}

/// The stages in which passes use anything.
fn stages<'a>(uses: impl Iterator<Item = &'a [Use]>) -> vk::PipelineStageFlags2 {
    uses.flatten().fold(vk::PipelineStageFlags2::NONE, |all, one| all | one.read.stages | one.write.stages)
}

/// All that passes write.
fn writes<'a>(uses: impl Iterator<Item = &'a [Use]>) -> Scope {
    uses.flatten().fold(Scope::default(), |all, one| all.union(one.write))
}
