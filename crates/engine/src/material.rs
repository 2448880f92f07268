//! Fragment shaders of a program's own (`shaders/include/material.glsl`).

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use osculate_gpu::ash::vk;
use osculate_gpu::{
    Attachments, Blend, CallerSetLayout, Cull, DepthState, FrontFace, GraphicsPipeline, GraphicsPipelineDesc, Shader,
};
use osculate_shaders::constant::MATERIAL_PUSH_OFFSET;

use crate::draw::PipelineKey;
use crate::memo::Memo;
use crate::{Engine, EngineError, Shade};

/// What a fragment shader gets at location 2 beside position, normal and the number of the patch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Varying {
    /// Parameters in the patch: (u, v) of quads; of triangles what outlines them.
    #[default]
    Patch,
    /// Texture coordinates, v downwards. For surfaces with maps ([`Surface::with_maps`](crate::Surface::with_maps)).
    Texture,
    /// Mean and Gaussian curvature, in cage space.
    Curvature,
    /// Nothing. The compute evaluator then shares vertices between patches, and tells patches apart no more: what it says of the number of the patch is
    /// that of a neighbour.
    Nothing,
}

impl Varying {
    /// A shade whose vertices hold the same.
    pub(crate) fn shade(self) -> Shade {
        match self {
            Self::Patch => Shade::Patches,
            Self::Texture => Shade::Uv,
            Self::Curvature => Shade::Curvature,
            Self::Nothing => Shade::Lit,
        }
    }
}

/// How surfaces are drawn into a rendering of the caller's.
#[derive(Clone, Copy, Debug)]
pub struct MaterialDesc<'a> {
    /// Name for tools and messages.
    pub name: &'a str,
    /// The fragment shader, from [`Device::shader`](osculate_gpu::Device::shader) or
    /// [`Device::caller_shader`](osculate_gpu::Device::caller_shader); `None` draws depths alone, as shadow maps want it. What it gets is said in
    /// `shaders/include/material.glsl` ([`shader_include`]).
    pub fragment: Option<&'a Shader>,
    /// Formats of the rendering's attachments.
    pub attachments: Attachments<'a>,
    /// Samples per pixel of the attachments.
    pub samples: u32,
    /// How the depth attachment is used; `None` neither tests nor writes.
    pub depth: Option<DepthState>,
    /// How colours are combined, in all colour attachments.
    pub blend: Blend,
    /// Which triangles are left out.
    pub cull: Cull,
    /// Which triangles show the outside, in the picture. As it is by default in a clip space whose y points down, as Vulkan's does; the other way in a
    /// viewport that is upside down.
    pub front_face: FrontFace,
    /// What comes at location 2.
    pub varying: Varying,
    /// Layout of descriptor set 1, which the caller binds by [`EncodeDraws::caller_set`](osculate_gpu::EncodeDraws::caller_set).
    pub caller_set: Option<CallerSetLayout>,
}

impl Default for MaterialDesc<'_> {
    /// Colours in `R8G8B8A8_SRGB` and depths in `D32_SFLOAT`, one sample, nearer depths pass and are written; no shader.
    fn default() -> Self {
        const COLORS: &[vk::Format] = &[vk::Format::R8G8B8A8_SRGB];
        let depth = vk::Format::D32_SFLOAT;
        Self {
            name: "material",
            fragment: None,
            attachments: Attachments { colors: COLORS, depth, stencil: vk::Format::UNDEFINED },
            samples: 1,
            depth: Some(DepthState::default()),
            blend: Blend::default(),
            cull: Cull::default(),
            front_face: FrontFace::default(),
            varying: Varying::default(),
            caller_set: None,
        }
    }
}

/// A fragment shader of a program's own, and the attachments it draws to. Clones share its pipelines, of which one is made for each kind
/// of patches when it is first needed; they go with the last clone and the last [`Instance`](crate::Instance) that is drawn with it.
#[derive(Clone)]
pub struct Material {
    inner: Arc<Inner>,
}

/// Tells materials apart, in all engines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct MaterialId(u64);

pub(crate) struct Inner {
    id: MaterialId,
    name: String,
    fragment: Option<Shader>,
    colors: Vec<vk::Format>,
    /// A description whose borrowed parts are empty: they are the fields above.
    desc: MaterialDesc<'static>,
    pub(crate) pipelines: Memo<PipelineKey, GraphicsPipeline>,
    engine: Engine,
}

/// The materials of an engine that are alive.
#[derive(Default)]
pub(crate) struct Materials(Mutex<HashMap<MaterialId, Weak<Inner>>>);

impl Materials {
    fn lock(&self) -> MutexGuard<'_, HashMap<MaterialId, Weak<Inner>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The material with that number.
    pub(crate) fn get(&self, id: MaterialId) -> Result<Arc<Inner>, EngineError> {
        self.lock().get(&id).and_then(Weak::upgrade).ok_or(EngineError::NoMaterial)
    }
}

impl Material {
    /// Takes note of a shader and of what it draws to. Pipelines are made later, and complain then if the shader does not fit.
    ///
    /// # Errors
    /// If the shader's push constants are where the library's are.
    pub fn new(engine: &Engine, desc: &MaterialDesc<'_>) -> Result<Self, EngineError> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let push = desc.fragment.map_or(0, |shader| shader.reflection().push_constant_size);
        if push > 0 && push <= MATERIAL_PUSH_OFFSET {
            let reason = format!("its push constants must begin at byte {MATERIAL_PUSH_OFFSET}");
            return Err(EngineError::Material { name: desc.name.to_owned(), reason });
        }
        let id = MaterialId(NEXT.fetch_add(1, Ordering::Relaxed));
        let attachments = Attachments { colors: &[], ..desc.attachments };
        let &MaterialDesc { samples, depth, blend, cull, front_face, varying, caller_set, .. } = desc;
        let states = MaterialDesc {
            name: "",
            fragment: None,
            attachments,
            samples,
            depth,
            blend,
            cull,
            front_face,
            varying,
            caller_set,
        };
        let inner = Arc::new(Inner {
            id,
            name: desc.name.to_owned(),
            fragment: desc.fragment.cloned(),
            colors: desc.attachments.colors.to_vec(),
            desc: states,
            pipelines: Memo::default(),
            engine: engine.clone(),
        });
        engine.materials().lock().insert(id, Arc::downgrade(&inner));
        Ok(Self { inner })
    }

    /// The name it was made with.
    pub fn name(&self) -> &str {
        &self.inner.name
    }

    /// Bytes of push constants that its shader takes.
    pub fn push_size(&self) -> usize {
        let size = self.inner.fragment.as_ref().map_or(0, |shader| shader.reflection().push_constant_size);
        size.saturating_sub(MATERIAL_PUSH_OFFSET) as usize
    }

    pub(crate) fn id(&self) -> MaterialId {
        self.inner.id
    }

    pub(crate) fn varying(&self) -> Varying {
        self.inner.desc.varying
    }

    pub(crate) fn samples(&self) -> u32 {
        self.inner.desc.samples
    }
}

impl Inner {
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    pub(crate) fn fragment(&self) -> Option<&Shader> {
        self.fragment.as_ref()
    }

    /// A pipeline's description with these attachments and states.
    pub(crate) fn complete<'a>(&'a self, pipeline: GraphicsPipelineDesc<'a>) -> GraphicsPipelineDesc<'a> {
        let &MaterialDesc { attachments, samples, depth, blend, cull, front_face, caller_set, .. } = &self.desc;
        GraphicsPipelineDesc {
            attachments: Some(Attachments { colors: &self.colors, ..attachments }),
            samples,
            depth,
            blend,
            cull,
            front_face,
            caller_set,
            ..pipeline
        }
    }
}

impl Drop for Inner {
    fn drop(&mut self) {
        self.engine.materials().lock().remove(&self.id);
    }
}

impl std::fmt::Debug for Material {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Material").field(&self.name()).finish()
    }
}

/// The text of a file in `shaders/include`, for compilers that ask for included files: `material.glsl`, and what that includes.
pub fn shader_include(name: &str) -> Option<&'static str> {
    osculate_shaders::source(&format!("include/{name}"))
}
