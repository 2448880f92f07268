//! Surfaces that are drawn frame after frame: all that drawing them takes stays on the device.

use osculate_gpu::{Bindings, Buffer, BufferUsage, Draw, Recording};
use osculate_shaders::binding;

use crate::draw::Output;
use crate::evaluate::{GridChunk, Grids};
use crate::grid::GridRates;
use crate::look::Look;
use crate::{Camera, Culling, EngineError, Factors, Shade, Surface, Target, Tessellation};

/// How a surface is drawn frame after frame.
#[derive(Clone, Copy, Debug)]
pub struct DrawingDesc {
    /// How finely, and by whom. Adaptive factors follow the view; their camera and height are those of the first frame.
    pub tessellation: Tessellation,
    /// In which colours.
    pub shade: Shade,
    /// Whether the edges of the cage are drawn over it.
    pub cage: bool,
    /// What it is drawn to.
    pub target: Target,
    /// What is left out because nothing of it is seen.
    pub culling: Culling,
    /// Where the first frame is seen from.
    pub camera: Camera,
    /// Width and height of the first frame in pixels.
    pub size: [u32; 2],
}

/// Whether recordings with a drawing's passes and draws are still good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use = "recordings made before a new plan draw the old triangles"]
pub enum DrawPlan {
    /// They are.
    Kept,
    /// They are not: what is drawn was planned anew.
    New,
}

/// A surface at a tessellation and in a shade, resident on the device.
///
/// A frame is: [`Surface::write_points`] if the cage moved, [`Self::set_view`] if the view did, and a run of a recording with
/// [`Surface::record_update`], [`Self::record`], and a pass with [`Self::draws`]. The recording stays the same as long as
/// [`Self::set_view`] says so, so that [`Device::prepare`](crate::Device::prepare) makes it once: then a frame allocates nothing
/// and uploads points and the view.
///
/// ```no_run
/// # use osculate::{*, gpu::Recording};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let cage = Cage::read("creature.obj".as_ref())?;
/// # let engine = Engine::new(Device::new(&DeviceDesc::default())?);
/// # let surface = Surface::new(&engine, &cage, &SurfaceDesc::default())?;
/// let desc = DrawingDesc::fit(&cage, [800, 600]);
/// let drawing = Drawing::new(&surface, &desc)?;
/// let targets = Targets::new(&engine, desc.size, desc.target)?;
/// let mut recording = Recording::new();
/// surface.record_update(&mut recording)?;
/// drawing.record(&mut recording);
/// recording.render(targets.pass(drawing.draws().to_vec(), Some([0.0, 0.0, 0.0, 1.0])));
/// let mut frame = engine.device().prepare(&recording)?;
/// for moved in [cage.positions(), cage.positions()] {
///     surface.write_points(moved)?;
///     frame.run()?;
/// }
/// # Ok(())
/// # }
/// ```
pub struct Drawing {
    surface: Surface,
    desc: DrawingDesc,
    /// Uniforms of the surface.
    frame: Buffer,
    /// Uniforms of the cage's edges, if they are drawn.
    cage_frames: Vec<Buffer>,
    /// What the compute evaluator draws.
    grids: Option<ResidentGrids>,
    draws: Vec<Draw>,
    /// The view that patches are left out for.
    culled_for: (Camera, [u32; 2]),
    /// Adaptive factors and what is left out stay as they are.
    frozen: bool,
}

/// All chunks of the compute evaluator's vertices and triangles.
pub(crate) struct ResidentGrids {
    rates: GridRates,
    /// The passes that evaluate them.
    passes: Recording,
    /// Those from points to vertices, where there are shorter ones than by way of all records.
    update: Option<Recording>,
    triangles: u64,
    vertices: u64,
    bytes: u64,
}

impl DrawingDesc {
    /// The whole cage from its upper right front, lit, one sample a pixel.
    pub fn fit(cage: &crate::Cage, size: [u32; 2]) -> Self {
        Self {
            tessellation: Tessellation::default(),
            shade: Shade::Lit,
            cage: false,
            target: Target::of(Shade::Lit, 1),
            culling: Culling::NONE,
            camera: Camera::fit(cage.bounds()),
            size,
        }
    }

    fn look<'a>(&'a self, culled_for: (&'a Camera, [u32; 2])) -> Look<'a> {
        let &Self { shade, cage, size, target, culling, .. } = self;
        let (tessellation, camera) = (&self.tessellation, &self.camera);
        Look { tessellation, shade, cage, camera, size, target, culling, culled_for }
    }
}

impl Drawing {
    /// Makes pipelines, uniforms, and what the compute evaluator keeps: all vertices and triangles.
    ///
    /// # Errors
    /// If the level is out of range, the shade takes two surfaces or more than the device can do, or memory runs out.
    pub fn new(surface: &Surface, desc: &DrawingDesc) -> Result<Self, EngineError> {
        if desc.shade == Shade::Difference {
            return Err(EngineError::OneSurface);
        }
        let mut drawing = Self::empty(surface, desc)?;
        let _first = drawing.replan()?;
        Ok(drawing)
    }

    /// One with pipelines and uniforms, and no draws yet.
    pub(crate) fn empty(surface: &Surface, desc: &DrawingDesc) -> Result<Self, EngineError> {
        let (engine, look) = (surface.engine(), desc.look((&desc.camera, desc.size)));
        look.check(engine)?;
        look.prepare(engine, &[surface])?;
        let upload = |frame: crate::frame::FrameDesc<'_>| frame.upload(engine.device());
        Ok(Self {
            frame: upload(look.frame(surface))?,
            cage_frames: look.cage_frames(surface).map(upload).collect::<Result<_, _>>()?,
            surface: surface.clone(),
            desc: *desc,
            grids: None,
            draws: Vec::new(),
            culled_for: (desc.camera, desc.size),
            frozen: false,
        })
    }

    /// Adds the draw of vertices that stay as they are.
    pub(crate) fn add_chunk(&mut self, grids: &Grids<'_>, chunk: &GridChunk) -> Result<(), EngineError> {
        let indices = self.surface.engine().device().upload("grid indices", BufferUsage::INDEX, &chunk.indices)?;
        for output in self.look().outputs() {
            self.draws.push(grids.draw(chunk, &indices, &self.frame, output)?);
        }
        Ok(())
    }

    /// Adds the draws of the cage, if it is drawn.
    pub(crate) fn add_cage(&mut self) -> Result<(), EngineError> {
        let draws = self.look().cage_draws(&self.surface, &self.cage_frames)?;
        self.draws.extend(draws);
        Ok(())
    }

    /// Moves the eye: writes the uniforms, nothing else, as long as the factors are uniform or the tessellator finds them itself.
    /// Where the compute evaluator draws with adaptive factors, it asks the device for those of the surface as it is now, and
    /// plans anew if one has changed.
    ///
    /// # Errors
    /// If the device fails.
    pub fn set_view(&mut self, camera: &Camera, size: [u32; 2]) -> Result<DrawPlan, EngineError> {
        (self.desc.camera, self.desc.size) = (*camera, size);
        if !self.frozen {
            self.culled_for = (*camera, size);
            if let Factors::Adaptive { camera: from, height, .. } = &mut self.desc.tessellation.factors {
                (*from, *height) = (*camera, size[1]);
            }
        }
        self.write_frames()?;
        match &self.grids {
            Some(_) if matches!(self.desc.tessellation.factors, Factors::Adaptive { .. }) => self.replan(),
            _ => Ok(DrawPlan::Kept),
        }
    }

    /// Chooses whether adaptive factors, and the patches that are left out, stay as they are, so that one can see from elsewhere what becomes of them.
    pub fn freeze_factors(&mut self, frozen: bool) {
        self.frozen = frozen;
    }

    fn look(&self) -> Look<'_> {
        self.desc.look((&self.culled_for.0, self.culled_for.1))
    }

    fn write_frames(&self) -> Result<(), EngineError> {
        let look = self.look();
        self.frame.write(0, &[look.frame(&self.surface).block()])?;
        for (buffer, frame) in self.cage_frames.iter().zip(look.cage_frames(&self.surface)) {
            buffer.write(0, &[frame.block()])?;
        }
        Ok(())
    }

    /// Makes the draws, unless those that are there are good.
    fn replan(&mut self) -> Result<DrawPlan, EngineError> {
        let (desc, (camera, size)) = (self.desc, self.culled_for);
        let look = desc.look((&camera, size));
        let mut draws = Vec::new();
        if self.desc.tessellation.renders_in_compute(self.surface.engine().device()) {
            let rates = self.surface.grid_rates(&self.desc.tessellation)?;
            if self.grids.as_ref().is_some_and(|known| known.rates == rates) {
                return Ok(DrawPlan::Kept);
            }
            // The old ones go first: there may not be room for both.
            self.draws.clear();
            self.grids = None;
            self.grids = {
                let outputs: Vec<Output> = look.outputs().collect();
                Some(ResidentGrids::new(&self.surface, rates, &outputs, &self.frame, &mut draws)?)
            };
        } else {
            draws = look.patches(&self.surface, &self.frame)?;
        }
        draws.extend(look.cage_draws(&self.surface, &self.cage_frames)?);
        self.draws = draws;
        Ok(DrawPlan::New)
    }

    /// Adds the passes that must run before the draws when the surface has moved, or if they never ran: those of the compute
    /// evaluator. The tessellator has none.
    pub fn record(&self, recording: &mut Recording) {
        if let Some(grids) = &self.grids {
            recording.append(&grids.passes);
        }
    }

    /// Adds the passes from the points of [`Surface::write_points`] to the draws: the same as [`Surface::record_update`] and [`Self::record`], or fewer. What the draws
    /// do not look at may stay as it was, the surface's records among it: for drawings that are all that becomes of their surface. Whoever else looks at it
    /// (another drawing, a capture, a sample) takes those two.
    ///
    /// # Errors
    /// If a pipeline cannot be made.
    pub fn record_update(&self, recording: &mut Recording) -> Result<(), EngineError> {
        match self.grids.as_ref().and_then(|grids| grids.update.as_ref()) {
            Some(update) => recording.append(update),
            None => {
                self.surface.record_update(recording)?;
                self.record(recording);
            }
        }
        Ok(())
    }

    /// The draws of a frame, to be put into a pass on [`DrawingDesc::target`] and depths of [`Target::DEPTH`].
    pub fn draws(&self) -> &[Draw] {
        &self.draws
    }

    /// The buffers of the surface and the frame's uniforms, by the binding numbers of `shaders/include/bindings.glsl`: for draws of
    /// one's own in the same view.
    pub fn bindings(&self) -> Bindings {
        self.surface.patch_bindings().with(binding::FRAME, &self.frame)
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// How it is drawn now.
    pub fn desc(&self) -> &DrawingDesc {
        &self.desc
    }

    /// Triangles and vertices of the compute evaluator; `None` for the tessellator, which tells by
    /// [`PassStatistics`](osculate_gpu::PassStatistics) alone.
    pub fn grid_counts(&self) -> Option<[u64; 2]> {
        self.grids.as_ref().map(ResidentGrids::counts)
    }

    /// Bytes on the device beyond those of the surface.
    pub fn bytes(&self) -> u64 {
        let uniforms = self.cage_frames.iter().chain([&self.frame]).map(Buffer::size).sum::<u64>();
        uniforms + self.grids.as_ref().map_or(0, |grids| grids.bytes)
    }
}

impl ResidentGrids {
    /// Plans all chunks, uploads their triangles, and adds their draws: one output or more, which look at the same of them.
    pub(crate) fn new(
        surface: &Surface,
        rates: GridRates,
        outputs: &[Output],
        frame: &Buffer,
        draws: &mut Vec<Draw>,
    ) -> Result<Self, EngineError> {
        let mut passes = Recording::new();
        let (mut triangles, mut vertices, mut bytes) = (0, 0, 0);
        let grids = Grids::drawn(surface, &rates, outputs[0])?;
        let (mut chunks, mut update): (Vec<(GridChunk, Buffer)>, _) = (Vec::new(), None);
        for chunk in grids.chunks() {
            let chunk = chunk?;
            let indices = surface.engine().device().upload("grid indices", BufferUsage::INDEX, &chunk.indices)?;
            grids.record(&chunk, frame, &mut passes)?;
            update = grids.update(&chunk, frame)?;
            triangles += chunk.indices.len() as u64 / 3;
            vertices += chunk.vertex_count();
            bytes += chunk.bytes() + indices.size();
            chunks.push((chunk.without_indices(), indices));
        }
        for &output in outputs {
            for (chunk, indices) in &chunks {
                draws.push(grids.draw(chunk, indices, frame, output)?);
            }
        }
        Ok(Self { rates, passes, update, triangles, vertices, bytes })
    }

    /// How the edges are divided.
    pub(crate) fn rates(&self) -> &GridRates {
        &self.rates
    }

    /// The passes that evaluate the vertices.
    pub(crate) fn passes(&self) -> &Recording {
        &self.passes
    }

    /// Triangles and vertices.
    pub(crate) fn counts(&self) -> [u64; 2] {
        [self.triangles, self.vertices]
    }

    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }
}
