//! Pipelines are made when something first needs them: in parallel, each once, and in less time when the driver remembers them
//! from an earlier run.

use std::collections::HashSet;
use std::fmt;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use osculate_gpu::{ComputePipeline, ComputePipelineDesc, Device, GraphicsPipeline, Shader};
use osculate_shaders::constant;
use rayon::prelude::*;

use crate::draw::PipelineKey;
use crate::evaluate::Measured;
use crate::memo::Memo;
use crate::{Engine, EngineError};

/// How far the making of pipelines is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PipelineProgress {
    /// Pipelines that are ready.
    pub done: usize,
    /// Pipelines that were missing when the work began.
    pub total: usize,
}

/// Who is told while several pipelines are made: with `done` from 0 to `total` in ascending order, by one thread at a time. It
/// hears of a failure no more than that `total` is never reached.
#[derive(Clone)]
pub struct PipelineObserver(Arc<dyn Fn(PipelineProgress) + Send + Sync>);

impl PipelineObserver {
    /// Calls `observe`, from any thread. It must not use the engine.
    pub fn new(observe: impl Fn(PipelineProgress) + Send + Sync + 'static) -> Self {
        Self(Arc::new(observe))
    }
}

impl fmt::Debug for PipelineObserver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("PipelineObserver")
    }
}

/// What an engine has made so far, and the file that the driver's memory of it lives in.
#[derive(Default)]
pub(crate) struct Pipelines {
    modules: Memo<String, Shader>,
    kernels: Memo<KernelKey, ComputePipeline>,
    drawing: Memo<PipelineKey, GraphicsPipeline>,
    file: Option<PathBuf>,
    /// Pipelines were made since the file was read or written.
    unsaved: AtomicBool,
}

impl Pipelines {
    /// None yet; those of the device's file in `folder` will take less time.
    pub(crate) fn new(device: &Device, folder: Option<PathBuf>) -> Self {
        let file = folder.map(|folder| folder.join(device.pipeline_cache_name()));
        if let Some(file) = &file {
            match device.load_pipeline_cache(file) {
                Ok(used) => tracing::debug!("{}: {}", file.display(), if used { "used" } else { "nothing to be used" }),
                Err(error) => tracing::debug!("{error}; pipelines are made without it"),
            }
        }
        Self { file, ..Self::default() }
    }

    /// Writes the file if there is anything new.
    pub(crate) fn save(&self, device: &Device) {
        let Some(file) = self.file.as_ref().filter(|_| self.unsaved.swap(false, Ordering::Relaxed)) else { return };
        match device.save_pipeline_cache(file) {
            Ok(written) => tracing::debug!("{}: {}", file.display(), if written { "written" } else { "nothing new" }),
            Err(error) => tracing::debug!("{error}; the next run makes its pipelines anew"),
        }
    }
}

/// A compute kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct KernelKey {
    /// Name of the shader.
    pub(crate) shader: &'static str,
    /// What the vertices that it makes, if it does, hold beside position and normal.
    pub(crate) measure: Measured,
    /// Whether it looks for halves of edges and unrefined faces.
    pub(crate) sides_by_tag: bool,
}

/// No kernels at all, for [`Engine::prepare`].
pub(crate) const NO_KERNELS: [KernelKey; 0] = [];

impl From<&'static str> for KernelKey {
    /// A kernel that knows of no shades.
    fn from(shader: &'static str) -> Self {
        Self { shader, measure: Measured::Parameters, sides_by_tag: false }
    }
}

impl KernelKey {
    /// What tools call it.
    fn name(self) -> String {
        let beside = if self.sides_by_tag { ", beside unrefined" } else { "" };
        match self.measure {
            Measured::Parameters => format!("{}{beside}", self.shader),
            measure => format!("{}, {}{beside}", self.shader, measure.name()),
        }
    }
}

/// Something that takes a driver long to make.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Need {
    Kernel(KernelKey),
    Drawing(PipelineKey),
}

impl Engine {
    /// Makes those of the pipelines that are still missing, on all threads of the machine, and tells the engine's observer.
    ///
    /// Whoever records passes calls this first with all that they will use; [`Self::kernel`] and [`Self::pipeline`] make what
    /// was left out one by one.
    pub(crate) fn prepare(
        &self,
        kernels: impl IntoIterator<Item = impl Into<KernelKey>>,
        drawing: impl IntoIterator<Item = PipelineKey>,
    ) -> Result<(), EngineError> {
        let made = self.pipelines();
        let kernels = kernels.into_iter().map(Into::into).filter(|key| !made.kernels.has(key)).map(Need::Kernel);
        let drawing = drawing.into_iter().filter(|key| !self.has_pipeline(key)).map(Need::Drawing);
        let mut seen = HashSet::new();
        let missing: Vec<Need> = kernels.chain(drawing).filter(|need| seen.insert(*need)).collect();
        if missing.is_empty() {
            return Ok(());
        }
        let total = missing.len();
        let observe = |done| self.desc().observer.iter().for_each(|one| (one.0)(PipelineProgress { done, total }));
        observe(0);
        let done = Mutex::new(0);
        let make = |need: &Need| {
            self.make(*need)?;
            let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
            *done += 1;
            observe(*done);
            Ok(())
        };
        // All are tried, so that the error is always the same one: the first in order.
        let results: Vec<Result<(), EngineError>> = missing.par_iter().with_max_len(1).map(make).collect();
        results.into_iter().collect()
    }

    fn make(&self, need: Need) -> Result<(), EngineError> {
        match need {
            Need::Kernel(key) => self.kernel(key).map(drop),
            Need::Drawing(key) => self.pipeline(key).map(drop),
        }
    }

    /// The shader module of that name.
    pub(crate) fn shader(&self, name: &str) -> Result<Shader, EngineError> {
        self.pipelines().modules.get_or_make(name.to_owned(), || {
            let missing = || EngineError::MissingShader { name: name.to_owned() };
            let words = self.desc().shaders.get(name).ok_or_else(missing)?;
            Ok(self.device().shader(name, words)?)
        })
    }

    /// The compute pipeline of that kernel.
    pub(crate) fn kernel(&self, key: impl Into<KernelKey>) -> Result<ComputePipeline, EngineError> {
        let key = key.into();
        self.pipelines().kernels.get_or_make(key, || {
            let shader = self.shader(key.shader)?;
            let mut specialization =
                vec![(constant::SPEC_SHADE, key.measure.shade()), (constant::SPEC_GRID_GROUP, self.grid_group())];
            // Else it is as the shader says: kernels that sample always look.
            specialization.extend(key.sides_by_tag.then_some((constant::SPEC_SIDES, constant::SIDES_BY_TAG)));
            let desc = ComputePipelineDesc { name: &key.name(), shader: &shader, specialization: &specialization };
            self.timed(|| Ok(self.device().compute_pipeline(&desc)?), ComputePipeline::name)
        })
    }

    /// The graphics pipeline of that key.
    pub(crate) fn pipeline(&self, key: PipelineKey) -> Result<GraphicsPipeline, EngineError> {
        let make = || self.timed(|| key.make(self), GraphicsPipeline::name);
        match key.material() {
            Some(id) => self.materials().get(id)?.pipelines.get_or_make(key, make),
            None => self.pipelines().drawing.get_or_make(key, make),
        }
    }

    fn has_pipeline(&self, key: &PipelineKey) -> bool {
        match key.material() {
            Some(id) => self.materials().get(id).is_ok_and(|material| material.pipelines.has(key)),
            None => self.pipelines().drawing.has(key),
        }
    }

    /// Makes a pipeline and says how long it took.
    fn timed<P>(
        &self,
        make: impl FnOnce() -> Result<P, EngineError>,
        name: impl FnOnce(&P) -> &str,
    ) -> Result<P, EngineError> {
        let start = Instant::now();
        let made = make()?;
        tracing::debug!("pipeline {:?}: {:.1} ms", name(&made), 1e3 * start.elapsed().as_secs_f64());
        self.pipelines().unsaved.store(true, Ordering::Relaxed);
        Ok(made)
    }

    /// The names of all pipelines made so far, sorted: what tools and validation call them.
    pub fn pipeline_names(&self) -> Vec<String> {
        let made = self.pipelines();
        let kernels = made.kernels.values().into_iter().map(|one| one.name().to_owned());
        let mut names: Vec<String> =
            kernels.chain(made.drawing.values().into_iter().map(|one| one.name().to_owned())).collect();
        names.sort_unstable();
        names
    }

    /// Saves what the driver has learnt from making pipelines in [`EngineDesc::pipeline_cache`](crate::EngineDesc::pipeline_cache),
    /// for the next run. This happens anyway when the last clone of the engine goes; programs that may be killed can call it once
    /// everything has been drawn. What goes wrong is no more than a debug message.
    pub fn save_pipelines(&self) {
        self.pipelines().save(self.device());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DeviceDesc, EngineDesc, RenderDesc, Scheme, Surface, SurfaceDesc, Target, Tessellation, render};
    use osculate_gpu::Format;
    use std::fs;
    use std::path::Path;

    const KERNELS: [&str; 3] = ["subdivide/face.comp", "subdivide/edge.comp", "subdivide/vertex.comp"];

    fn device() -> Device {
        let select = std::env::var("OSCULATE_DEVICE").ok();
        Device::new(&DeviceDesc { select, validation: true, ..DeviceDesc::default() }).unwrap()
    }

    fn overlays() -> [PipelineKey; 2] {
        let target = Target { color: Format::Rgba8Srgb, samples: 1 };
        [false, true].map(|hidden| PipelineKey::Cage { target, hidden })
    }

    fn keeping(device: &Device, folder: &Path) -> Engine {
        Engine::with(device.clone(), EngineDesc { pipeline_cache: Some(folder.to_owned()), ..EngineDesc::default() })
    }

    /// An engine, and all that its observer was told.
    fn observed() -> (Engine, Arc<Mutex<Vec<PipelineProgress>>>) {
        let told = Arc::new(Mutex::new(Vec::new()));
        let observer = Arc::clone(&told);
        let observer = PipelineObserver::new(move |progress| observer.lock().unwrap().push(progress));
        (Engine::with(device(), EngineDesc { observer: Some(observer), ..EngineDesc::default() }), told)
    }

    #[test]
    fn the_observer_hears_of_every_missing_pipeline_once() {
        let (engine, told) = observed();
        engine.prepare(KERNELS.into_iter().chain(KERNELS), overlays()).unwrap();
        let all: Vec<_> = (0..=5).map(|done| PipelineProgress { done, total: 5 }).collect();
        assert_eq!(*told.lock().unwrap(), all);
        engine.prepare(KERNELS, overlays()).unwrap();
        assert_eq!(told.lock().unwrap().len(), 6, "nothing was missing");
        assert_eq!(engine.pipeline_names().len(), 5);
        assert_eq!(engine.device().validation_messages(), [""; 0]);
    }

    #[test]
    fn threads_that_prepare_the_same_make_each_pipeline_once() {
        let engine = Engine::new(device());
        let start = std::sync::Barrier::new(4);
        let made: Vec<_> = std::thread::scope(|scope| {
            let prepare = || {
                start.wait();
                engine.prepare(KERNELS, overlays()).unwrap();
                (KERNELS.map(|name| engine.kernel(name).unwrap()), overlays().map(|key| engine.pipeline(key).unwrap()))
            };
            let threads: Vec<_> = (0..4).map(|_| scope.spawn(prepare)).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect()
        });
        assert!(made.windows(2).all(|pair| pair[0] == pair[1]), "everyone has the same pipelines");
        assert_eq!(engine.pipeline_names().len(), KERNELS.len() + overlays().len());
        assert_eq!(engine.device().validation_messages(), [""; 0]);
    }

    #[test]
    fn a_pipeline_that_cannot_be_made_is_an_error_and_the_others_are_there() {
        let (engine, told) = observed();
        let error = engine.prepare(["subdivide/edge.comp", "no/such.comp"], []).unwrap_err();
        assert!(matches!(&error, EngineError::MissingShader { name } if name == "no/such.comp"), "{error}");
        assert_eq!(told.lock().unwrap().last(), Some(&PipelineProgress { done: 1, total: 2 }));
        assert_eq!(engine.pipeline_names(), ["subdivide/edge.comp"]);
    }

    /// All patches of a cube are of one kind: with a corner of valence 3 or, not being refined, with four of them.
    #[test]
    fn pictures_and_captures_make_the_pipelines_of_patches_that_are_there() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/cages/cube.obj");
        let cage = crate::Cage::read(&file).unwrap();
        for &scheme in Scheme::ALL {
            let engine = Engine::new(device());
            let surface = Surface::new(&engine, &cage, &SurfaceDesc { scheme, ..SurfaceDesc::default() }).unwrap();
            let kernels = engine.pipeline_names();
            assert!(kernels.iter().all(|name| name.ends_with(".comp")), "{kernels:?}");
            render(&engine, &[&surface], &RenderDesc { cage: true, ..RenderDesc::fit(&cage, [8, 8]) }).unwrap();
            surface.capture(&Tessellation::uniform(1.0), |_| Ok::<(), EngineError>(())).unwrap();
            let mut drawing = engine.pipeline_names();
            drawing.retain(|name| !kernels.contains(name));
            let [list] = surface.plan().lists.as_slice() else { panic!("{scheme}: {:?}", surface.plan().lists) };
            let kind = if list.kind.is_stored() { "stored" } else { "valence 3" };
            let patches = |output| format!("{} {kind}, equal, {output}", list.kind.form().name());
            let cage = ["cage overlay".to_owned(), "cage overlay, hidden too".to_owned()];
            let mut expected = [&cage[..], &[patches("capture"), patches("fill lit Rgba8Srgb x4")]].concat();
            expected.sort_unstable();
            assert_eq!(drawing, expected, "{scheme}");
            assert_eq!(engine.device().validation_messages(), [""; 0]);
        }
    }

    #[test]
    fn the_last_clone_leaves_a_file_for_the_next_engine() {
        let (device, folder) = (device(), tempfile::tempdir().unwrap());
        let file = folder.path().join("deep/inside").join(device.pipeline_cache_name());
        let engine = keeping(&device, file.parent().unwrap());
        let clone = engine.clone();
        engine.prepare(KERNELS, []).unwrap();
        drop(engine);
        assert!(!file.exists());
        drop(clone);
        let saved = fs::read(&file).unwrap();
        drop(keeping(&device, file.parent().unwrap()));
        assert_eq!(fs::read(&file).unwrap(), saved, "who makes nothing saves nothing");
        assert!(device.load_pipeline_cache(&file).unwrap());
    }

    #[test]
    fn a_folder_that_cannot_be_used_does_no_harm() {
        let (device, file) = (device(), tempfile::NamedTempFile::new().unwrap());
        let engine = keeping(&device, file.path());
        engine.prepare(KERNELS, []).unwrap();
        engine.save_pipelines();
        assert_eq!(fs::metadata(file.path()).unwrap().len(), 0, "a file is not taken for a folder");
    }
}
