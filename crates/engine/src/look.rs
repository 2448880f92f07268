//! How a surface is shown: frames, pipelines and draws, for pictures and for drawings that stay.

use osculate_gpu::{Bindings, Buffer, Draw};
use osculate_shaders::binding;

use crate::draw::{Division, Output, PipelineKey, Sides, runs};
use crate::frame::{CullView, FrameDesc};
use crate::grid::Layout;
use crate::pipelines::NO_KERNELS;
use crate::render::Seen;
use crate::{Camera, Culling, Engine, EngineError, Shade, Surface, Target, Tessellation};

/// Edges of triangles.
const WIRE: [f32; 4] = [0.012, 0.014, 0.020, 0.85];
/// Edges of the cage, orange.
const CAGE: [f32; 4] = [0.90, 0.27, 0.035, 1.0];
/// How much of them shines through the surface.
const CAGE_BEHIND: f32 = 0.18;

/// What is shown of a surface, in which colours, from where, and on what.
#[derive(Clone, Copy)]
pub(crate) struct Look<'a> {
    pub(crate) tessellation: &'a Tessellation,
    pub(crate) shade: Shade,
    /// Whether the edges of the cage are drawn over it.
    pub(crate) cage: bool,
    pub(crate) camera: &'a Camera,
    /// Width and height of the picture in pixels.
    pub(crate) size: [u32; 2],
    pub(crate) target: Target,
    /// Which patches are left out.
    pub(crate) culling: Culling,
    /// The view that they are left out for.
    pub(crate) culled_for: (&'a Camera, [u32; 2]),
}

impl Look<'_> {
    /// Fails if the device cannot draw the shade, or has not what is to tessellate.
    pub(crate) fn check(&self, engine: &Engine) -> Result<(), EngineError> {
        self.tessellation.check_evaluator(engine.device())?;
        let info = engine.device().info();
        if self.shade != Shade::Wireframe || info.features.wireframe {
            return Ok(());
        }
        Err(EngineError::Unsupported {
            device: info.name.clone(),
            what: "draw the edges of triangles".to_owned(),
            hint: "choose another shade".to_owned(),
        })
    }

    /// Makes all pipelines that surfaces will need.
    pub(crate) fn prepare(&self, engine: &Engine, surfaces: &[&Surface]) -> Result<(), EngineError> {
        if self.shade.is_mapped() && !surfaces.iter().all(|surface| surface.is_mapped()) {
            return Err(EngineError::NotMapped { shade: self.shade.name() });
        }
        let (target, tessellation) = (self.target, self.tessellation);
        let cage = self.cage.then_some([false, true].map(|hidden| PipelineKey::Cage { target, hidden }));
        let cage = cage.into_iter().flatten();
        if tessellation.renders_in_compute(engine.device()) {
            let kernels = surfaces.iter().flat_map(|surface| {
                surface.grid_kernels(self.output(), surface.likely_grid_layout(self.output(), tessellation))
            });
            let grids = |output| surfaces.iter().map(move |one| PipelineKey::Grid { output, mapped: one.is_mapped() });
            return engine.prepare(kernels, self.outputs().flat_map(grids).chain(cage));
        }
        let patches =
            |output| surfaces.iter().flat_map(move |surface| surface.pipelines(self.division(surface), output));
        engine.prepare(NO_KERNELS, self.outputs().flat_map(patches).chain(cage))
    }

    /// What becomes of the triangles first.
    pub(crate) fn output(&self) -> Output {
        let sides = if self.culling.back { Sides::Front } else { Sides::Both };
        Output::Fill(self.target, self.shade, sides)
    }

    /// What becomes of the triangles, in order.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = Output> + use<> {
        let target = self.target;
        let lines = (self.shade == Shade::Wireframe).then_some(Output::Lines(target));
        std::iter::once(self.output()).chain(lines)
    }

    /// The frame of a surface.
    pub(crate) fn frame<'b>(&'b self, surface: &'b Surface) -> FrameDesc<'b> {
        FrameDesc {
            space: surface.space(),
            radius: surface.radius(),
            tessellation: self.tessellation,
            view: Some((self.camera, self.size)),
            line_color: WIRE,
            // What bounds a patch does not bound what it is moved to.
            culling: self.cull_view().filter(|_| !surface.is_displaced()),
        }
    }

    /// How the tessellator divides the patches of a surface.
    fn division(&self, surface: &Surface) -> Division {
        Division { culls: self.frame(surface).culling.is_some(), ..Division::of(self.tessellation) }
    }

    fn cull_view(&self) -> Option<CullView<'_>> {
        // Lines cover pixels beside the triangles that they bound.
        let culling = Culling { small: self.culling.small && self.shade != Shade::Wireframe, ..self.culling };
        let (camera, size) = self.culled_for;
        (culling != Culling::NONE).then_some(CullView { culling, camera, size, samples: self.target.samples })
    }

    /// The frames of its cage, if that is asked for: of edges behind the surface too, then of those in sight.
    pub(crate) fn cage_frames<'b>(&'b self, surface: &'b Surface) -> impl Iterator<Item = FrameDesc<'b>> {
        let frame = move |opacity| {
            let [r, g, b, _] = CAGE;
            FrameDesc { line_color: [r, g, b, opacity], ..self.frame(surface) }
        };
        self.cage.then_some([CAGE_BEHIND, 1.0]).into_iter().flatten().map(frame)
    }

    /// The draws of all patches by the tessellator.
    pub(crate) fn patches(&self, surface: &Surface, frame: &Buffer) -> Result<Vec<Draw>, EngineError> {
        let draws: Vec<Vec<Draw>> =
            self.outputs().map(|output| self.patches_of(surface, frame, output)).collect::<Result<_, _>>()?;
        Ok(draws.into_iter().flatten().collect())
    }

    /// Those of one of the outputs.
    pub(crate) fn patches_of(
        &self,
        surface: &Surface,
        frame: &Buffer,
        output: Output,
    ) -> Result<Vec<Draw>, EngineError> {
        let bindings = surface.patch_bindings().with(binding::FRAME, frame);
        let longest = surface.patches_per_draw(self.tessellation)?;
        let division = self.division(surface);
        runs(&surface.plan().lists, longest).map(|run| surface.draw(run, &bindings, division, output)).collect()
    }

    /// The draws of the cage, given the buffers of [`Self::cage_frames`].
    pub(crate) fn cage_draws(&self, surface: &Surface, frames: &[Buffer]) -> Result<Vec<Draw>, EngineError> {
        let draw = |(hidden, frame): (bool, &Buffer)| {
            Ok(Draw {
                pipeline: surface.engine().pipeline(PipelineKey::Cage { target: self.target, hidden })?,
                bindings: Bindings::with(surface.buffers().cage_edges.clone(), binding::FRAME, frame),
                push: Vec::new(),
                vertices: (0..2 * surface.cage_edge_count()).into(),
                instances: 0..1,
                attributes: None,
                scissor: None,
            })
        };
        [true, false].into_iter().zip(frames).map(draw).collect()
    }
}

impl Shade {
    /// Whose vertices a shade takes: one that shows something of each patch needs vertices of its own.
    pub(crate) fn layout(self) -> Layout {
        // Edges of triangles show how wide those of a patch are.
        if self.seen() == Seen::Patch || self == Self::Wireframe { Layout::Own } else { Layout::Shared }
    }
}
