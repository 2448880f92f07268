//! Surfaces in a renderer of somebody else's: any number of instances, drawn with materials into the caller's own rendering.

use bytemuck::Zeroable;
use glam::DAffine3;
use osculate_gpu::{Bindings, Buffer, BufferUsage, Draw, Recording};
use osculate_shaders::binding;
use osculate_shaders::constant::MATERIAL_PUSH_OFFSET;
use osculate_shaders::layout::Frame;

use crate::draw::{Division, Output, PipelineKey, runs};
use crate::drawing::ResidentGrids;
use crate::frame::{CullView, FrameDesc, columns};
use crate::pipelines::NO_KERNELS;
use crate::view::{Demands, Placement};
use crate::{Culling, DrawPlan, EngineError, Factors, Material, Surface, Tessellation, View};

/// How an instance of a surface is drawn.
#[derive(Clone, Debug)]
pub struct InstanceDesc<'a> {
    /// What colours it.
    pub material: &'a Material,
    /// How finely, and by whom. Adaptive factors follow the view: of theirs, the pixels count alone.
    pub tessellation: Tessellation,
    /// What is left out because nothing of it is seen.
    pub culling: Culling,
    /// Buffers and images of the caller's for the fragment shader, at numbers from `BINDING_CALLER` (64) on.
    pub bindings: Bindings,
    /// Push constants of the fragment shader: [`Material::push_size`] bytes.
    pub push: Vec<u8>,
    /// Where it stands: the world from the cage's own coordinates. Must not mirror; with adaptive factors it scales all directions alike.
    pub world_from_own: DAffine3,
    /// Where it is seen from.
    pub view: View,
}

impl<'a> InstanceDesc<'a> {
    /// With a material, where the file has it, at the default tessellation.
    pub fn new(material: &'a Material, view: View) -> Self {
        Self {
            material,
            tessellation: Tessellation::default(),
            culling: Culling::NONE,
            bindings: Bindings::new(),
            push: Vec::new(),
            world_from_own: DAffine3::IDENTITY,
            view,
        }
    }
}

/// A surface that stands somewhere in a world, drawn with a material. Instances of one surface share its tables and points; each has a small uniform
/// buffer of its own and, by the compute evaluator, vertices.
///
/// A frame is: [`Surface::record_points`] if the cage moved, [`Self::place`], a recording with those points, [`Surface::record_derived`] and
/// [`Self::record`], which [`Device::encode`](crate::Device::encode) writes into the caller's command buffer, and [`Self::draws`], which
/// [`Device::encode_draws`](crate::Device::encode_draws) writes into the caller's rendering. All that changes is part of the
/// commands, so that any number of frames can be under way. The example `embed` does it.
pub struct Instance {
    surface: Surface,
    material: Material,
    tessellation: Tessellation,
    culling: Culling,
    bindings: Bindings,
    push: Vec<u8>,
    placement: Placement,
    /// The placement that factors are chosen and patches are left out for.
    chosen_for: Placement,
    frozen: bool,
    frame: Buffer,
    grids: Option<ResidentGrids>,
    draws: Vec<Draw>,
}

impl Instance {
    /// Makes pipelines, uniforms, and what the compute evaluator keeps: all vertices and triangles.
    ///
    /// # Errors
    /// If the placement cannot be drawn, a number of a binding is below 64, the push constants are of another size than the shader's, the shader does not fit the attachments
    /// or takes texture coordinates that the surface has not, the level is out of range, or memory runs out.
    pub fn new(surface: &Surface, desc: &InstanceDesc<'_>) -> Result<Self, EngineError> {
        let placement = Placement { world_from_own: desc.world_from_own, view: desc.view };
        let device = surface.engine().device();
        desc.tessellation.check_evaluator(device)?;
        check_bindings(desc)?;
        let mut instance = Self {
            frame: device.upload("instance", BufferUsage::UNIFORM, &[Frame::zeroed()])?,
            surface: surface.clone(),
            material: desc.material.clone(),
            tessellation: desc.tessellation,
            culling: desc.culling,
            bindings: desc.bindings.clone(),
            push: desc.push.clone(),
            placement,
            chosen_for: placement,
            frozen: false,
            grids: None,
            draws: Vec::new(),
        };
        instance.check_material()?;
        instance.prepare()?;
        let _first = instance.place(&desc.world_from_own, &desc.view)?;
        Ok(instance)
    }

    /// Moves the instance, the eye, or both. Written to the device by [`Self::record`].
    ///
    /// Where the compute evaluator draws with adaptive factors, this asks the device for those of the surface as it is now, waits for them, and plans anew
    /// if one has changed; else it costs nothing but the matrices.
    ///
    /// # Errors
    /// If the placement cannot be drawn, or the device fails.
    pub fn place(&mut self, world_from_own: &DAffine3, view: &View) -> Result<DrawPlan, EngineError> {
        let placement = Placement { world_from_own: *world_from_own, view: *view };
        let adaptive = matches!(self.tessellation.factors, Factors::Adaptive { .. });
        placement.check(Demands { lengths: adaptive, eye: adaptive || self.culling.back })?;
        self.placement = placement;
        if !self.frozen {
            self.chosen_for = placement;
            if let Factors::Adaptive { camera, height, .. } = &mut self.tessellation.factors {
                (*camera, *height) = (placement.camera(), view.size[1]);
            }
        }
        if self.draws.is_empty() || (adaptive && self.grids.is_some()) { self.replan() } else { Ok(DrawPlan::Kept) }
    }

    /// Chooses whether adaptive factors, and the patches that are left out, stay as they are: for shadow maps and mirrors, in which a surface must have the
    /// triangles that the main view gives it.
    pub fn freeze_factors(&mut self, frozen: bool) {
        self.frozen = frozen;
    }

    /// Changes the push constants of its fragment shader.
    ///
    /// # Errors
    /// If they are of another size than the shader's.
    pub fn set_push(&mut self, push: &[u8]) -> Result<(), EngineError> {
        self.push = push.to_vec();
        self.check_material()?;
        let push = &self.push;
        self.draws.iter_mut().for_each(|draw| put_push(draw, push));
        Ok(())
    }

    /// Adds the passes that must run before the draws when the instance was placed or the surface has moved, or if they never ran: a write of uniforms, and those of
    /// the compute evaluator.
    pub fn record(&self, recording: &mut Recording) {
        recording.write(&self.frame, 0, &[self.block()]);
        if let Some(grids) = &self.grids {
            recording.append(grids.passes());
        }
    }

    /// The draws of a frame, for a rendering with the material's attachments.
    pub fn draws(&self) -> &[Draw] {
        &self.draws
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Triangles and vertices of the compute evaluator; `None` for the tessellator.
    pub fn grid_counts(&self) -> Option<[u64; 2]> {
        self.grids.as_ref().map(ResidentGrids::counts)
    }

    /// Bytes on the device beyond those of the surface.
    pub fn bytes(&self) -> u64 {
        self.frame.size() + self.grids.as_ref().map_or(0, ResidentGrids::bytes)
    }

    fn check_material(&self) -> Result<(), EngineError> {
        let refuse = |reason| Err(EngineError::Material { name: self.material.name().to_owned(), reason });
        if self.material.varying().shade().is_mapped() && !self.surface.is_mapped() {
            return refuse("it takes texture coordinates: give the surface some by Surface::with_maps".to_owned());
        }
        let (wanted, found) = (self.material.push_size(), self.push.len());
        if wanted != found {
            return refuse(format!("its shader takes {wanted} bytes of push constants, {found} were given"));
        }
        Ok(())
    }

    fn in_compute(&self) -> bool {
        self.tessellation.renders_in_compute(self.surface.engine().device())
    }

    fn output(&self) -> Output {
        Output::Material(self.material.id(), self.material.varying().shade())
    }

    fn division(&self) -> Division {
        Division { culls: self.culls(), ..Division::of(&self.tessellation) }
    }

    /// Makes all pipelines.
    fn prepare(&self) -> Result<(), EngineError> {
        let (engine, output) = (self.surface.engine(), self.output());
        if self.in_compute() {
            let kernels =
                self.surface.grid_kernels(output, self.surface.likely_grid_layout(output, &self.tessellation));
            return engine.prepare(kernels, [PipelineKey::Grid { output, mapped: self.surface.is_mapped() }]);
        }
        engine.prepare(NO_KERNELS, self.surface.pipelines(self.division(), output))
    }

    /// Makes the draws, unless those that are there are good.
    fn replan(&mut self) -> Result<DrawPlan, EngineError> {
        let mut draws = Vec::new();
        if self.in_compute() {
            let rates = self.surface.grid_rates(&self.tessellation)?;
            if self.grids.as_ref().is_some_and(|known| *known.rates() == rates) {
                return Ok(DrawPlan::Kept);
            }
            // The old ones go first: there may not be room for both.
            (self.draws, self.grids) = (Vec::new(), None);
            let outputs = [self.output()];
            self.grids = Some(ResidentGrids::new(&self.surface, rates, &outputs, &self.frame, &mut draws)?);
        } else {
            draws = self.patches()?;
        }
        self.draws = draws.into_iter().map(|draw| self.complete(draw)).collect();
        Ok(DrawPlan::New)
    }

    /// The draws of all patches by the tessellator.
    fn patches(&self) -> Result<Vec<Draw>, EngineError> {
        let bindings = self.surface.patch_bindings().with(binding::FRAME, &self.frame);
        let longest = self.surface.patches_per_draw(&self.tessellation)?;
        let draw = |run| self.surface.draw(run, &bindings, self.division(), self.output());
        runs(&self.surface.plan().lists, longest).map(draw).collect()
    }

    /// A draw with what the caller adds.
    fn complete(&self, mut draw: Draw) -> Draw {
        draw.bindings = draw.bindings.with_all(&self.bindings);
        put_push(&mut draw, &self.push);
        draw
    }

    /// Whether anything is left out. What bounds a patch does not bound what it is moved to.
    fn culls(&self) -> bool {
        self.culling != Culling::NONE && !self.surface.is_displaced()
    }

    /// The uniform block.
    fn block(&self) -> Frame {
        let (camera, chosen) = (self.placement.camera(), self.chosen_for.camera());
        let (culling, size, samples) = (self.culling, self.chosen_for.view.size, self.material.samples());
        let frame = FrameDesc {
            space: self.surface.space(),
            radius: self.surface.radius(),
            tessellation: &self.tessellation,
            view: Some((&camera, self.placement.view.size)),
            line_color: [0.0; 4],
            culling: self.culls().then_some(CullView { culling, camera: &chosen, size, samples }),
        };
        let [world, view, clip] = self.placement.matrices(self.surface.space());
        let [_, _, cull_clip] = self.chosen_for.matrices(self.surface.space());
        Frame {
            clip_from_cage: columns(clip),
            view_from_cage: columns(view),
            world_from_cage: columns(world),
            cull_clip_from_cage: columns(cull_clip),
            ..frame.block()
        }
    }
}

/// Puts the caller's push constants behind the library's.
fn put_push(draw: &mut Draw, push: &[u8]) {
    if !push.is_empty() {
        draw.push.resize(MATERIAL_PUSH_OFFSET as usize, 0);
        draw.push.extend_from_slice(push);
    }
}

fn check_bindings(desc: &InstanceDesc<'_>) -> Result<(), EngineError> {
    match desc.bindings.numbers().find(|&number| number < binding::CALLER) {
        None => Ok(()),
        Some(number) => Err(EngineError::Material {
            name: desc.material.name().to_owned(),
            reason: format!("binding {number} is the library's; those of callers begin at {}", binding::CALLER),
        }),
    }
}
