//! Pictures of surfaces of any size: the compute evaluator holds one chunk of vertices at a time.

use osculate_gpu::{Buffer, BufferUsage, Draw, Recording};

use crate::alpha::divide_alpha_out;
use crate::draw::Output;
use crate::evaluate::{GridChunk, Grids};
use crate::frame::FrameDesc;
use crate::look::Look;
use crate::{Engine, EngineError, Picture, RenderDesc, Surface, Target, Targets};

/// What is drawn of all surfaces before the next is.
#[derive(Clone, Copy)]
pub(crate) enum Layer {
    /// The patches.
    Patches(Output),
    /// The cage, by the number of its frame: behind the surface too, then in sight.
    Cage(usize),
}

/// A picture in the making.
pub(crate) struct Canvas<'a> {
    engine: &'a Engine,
    desc: &'a RenderDesc,
    targets: Targets,
    /// Draws of the next pass.
    draws: Vec<Draw>,
    /// Whether a pass has begun the picture.
    begun: bool,
}

impl<'a> Canvas<'a> {
    /// An empty picture.
    pub(crate) fn new(engine: &'a Engine, desc: &'a RenderDesc) -> Result<Self, EngineError> {
        let targets = Targets::new(engine, desc.size, Target::of(desc.shade, desc.samples))?;
        let canvas = Self { engine, desc, targets, draws: Vec::new(), begun: false };
        canvas.look().check(engine)?;
        Ok(canvas)
    }

    fn look(&self) -> Look<'_> {
        let &RenderDesc { shade, cage, size, culling, .. } = self.desc;
        let (tessellation, camera) = (&self.desc.tessellation, &self.desc.camera);
        let target = self.targets.target();
        Look { tessellation, shade, cage, camera, size, target, culling, culled_for: (camera, size) }
    }

    /// Makes all pipelines that surfaces will need.
    pub(crate) fn prepare(&self, surfaces: &[&Surface]) -> Result<(), EngineError> {
        self.look().prepare(self.engine, surfaces)
    }

    /// Draws a surface, and its cage if that is asked for.
    pub(crate) fn add(&mut self, surface: &Surface) -> Result<(), EngineError> {
        if self.desc.tessellation.renders_in_compute(self.engine.device()) {
            self.add_grids(surface)?;
        } else {
            let frame = self.upload(self.look().frame(surface))?;
            self.draws.extend(self.look().patches(surface, &frame)?);
        }
        self.add_cage(surface)
    }

    /// What is drawn one upon the other, where surfaces are drawn one after the other.
    pub(crate) fn layers(&self) -> Vec<Layer> {
        let cage = if self.desc.cage { 0..2 } else { 0..0 };
        self.look().outputs().map(Layer::Patches).chain(cage.map(Layer::Cage)).collect()
    }

    /// Draws one layer of a surface, and waits until that is done, so that the surface may go.
    pub(crate) fn add_layer(&mut self, surface: &Surface, layer: Layer) -> Result<(), EngineError> {
        match layer {
            Layer::Patches(output) if self.desc.tessellation.renders_in_compute(self.engine.device()) => {
                return self.add_grids_of(surface, &[output]);
            }
            Layer::Patches(output) => {
                let frame = self.frame(surface)?;
                self.draws.extend(self.look().patches_of(surface, &frame, output)?);
            }
            Layer::Cage(number) => {
                let frames: Vec<Buffer> =
                    self.look().cage_frames(surface).map(|frame| self.upload(frame)).collect::<Result<_, _>>()?;
                let draws = self.look().cage_draws(surface, &frames)?;
                self.draws.extend(draws.into_iter().nth(number));
            }
        }
        self.flush(Recording::new())
    }

    /// The frame of a surface in a buffer.
    pub(crate) fn frame(&self, surface: &Surface) -> Result<Buffer, EngineError> {
        self.upload(self.look().frame(surface))
    }

    fn upload(&self, frame: FrameDesc<'_>) -> Result<Buffer, EngineError> {
        frame.upload(self.engine.device())
    }

    /// Evaluates and draws chunk after chunk, so that only one is in memory.
    fn add_grids(&mut self, surface: &Surface) -> Result<(), EngineError> {
        let outputs: Vec<Output> = self.look().outputs().collect();
        self.add_grids_of(surface, &outputs)
    }

    fn add_grids_of(&mut self, surface: &Surface, outputs: &[Output]) -> Result<(), EngineError> {
        let rates = surface.grid_rates(&self.desc.tessellation)?;
        let grids = Grids::drawn(surface, &rates, self.look().output())?;
        let frame = self.frame(surface)?;
        for chunk in grids.chunks() {
            let chunk = chunk?;
            let mut recording = Recording::new();
            grids.record(&chunk, &frame, &mut recording)?;
            self.add_chunk_of(&grids, &chunk, &frame, recording, outputs)?;
        }
        Ok(())
    }

    /// Runs what is recorded, then draws a chunk.
    pub(crate) fn add_chunk(
        &mut self,
        grids: &Grids<'_>,
        chunk: &GridChunk,
        frame: &Buffer,
        recording: Recording,
    ) -> Result<(), EngineError> {
        let outputs: Vec<Output> = self.look().outputs().collect();
        self.add_chunk_of(grids, chunk, frame, recording, &outputs)
    }

    fn add_chunk_of(
        &mut self,
        grids: &Grids<'_>,
        chunk: &GridChunk,
        frame: &Buffer,
        recording: Recording,
        outputs: &[Output],
    ) -> Result<(), EngineError> {
        let indices = self.engine.device().upload("grid indices", BufferUsage::INDEX, &chunk.indices)?;
        for &output in outputs {
            self.draws.push(grids.draw(chunk, &indices, frame, output)?);
        }
        self.flush(recording)
    }

    /// Draws the cage of a surface, if that is asked for.
    pub(crate) fn add_cage(&mut self, surface: &Surface) -> Result<(), EngineError> {
        let look = self.look();
        let frames: Vec<Buffer> =
            look.cage_frames(surface).map(|frame| self.upload(frame)).collect::<Result<_, _>>()?;
        let draws = look.cage_draws(surface, &frames)?;
        self.draws.extend(draws);
        Ok(())
    }

    /// Runs what is recorded, then the draws so far.
    fn flush(&mut self, mut recording: Recording) -> Result<(), EngineError> {
        self.record_pass(&mut recording);
        self.engine.device().run(&recording)?;
        Ok(())
    }

    fn record_pass(&mut self, recording: &mut Recording) {
        let draws = std::mem::take(&mut self.draws);
        recording.render(self.targets.pass(draws, (!self.begun).then_some(self.desc.background)));
        self.begun = true;
    }

    /// The picture.
    pub(crate) fn finish(mut self) -> Result<Picture, EngineError> {
        let mut recording = Recording::new();
        if !self.draws.is_empty() || !self.begun {
            self.record_pass(&mut recording);
        }
        let mut rgba = self.targets.read(self.engine, recording)?;
        if self.desc.background[3] < 1.0 {
            divide_alpha_out(&mut rgba, self.targets.target().color);
        }
        Ok(Picture { size: self.desc.size, rgba })
    }
}
