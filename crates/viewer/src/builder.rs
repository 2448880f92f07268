//! Everything that takes long, on a thread of its own: reading files, planning surfaces, making pipelines, picking.

use std::collections::HashSet;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

use glam::DVec3;
use osculate::{
    Animator, Drawing, Engine, EngineError, Evaluator, PatchKind, Recording, Scheme, Shade, Spacing, Surface,
    SurfaceDesc, Target, Targets,
};
use osculate_cage::{Cage, ReadDesc, ReadError, ReadObserver, ReadProgress, Sequence};

use crate::census::Census;
use crate::dress::Dress;
use crate::picking::{Pick, Picked};
use crate::scene::{Scene, Side, Sight, Wanted};

/// What the builder says.
pub(crate) enum News {
    /// What it is doing, and how much of it is done, if that is known.
    Progress(String, Option<f32>),
    /// What was wanted.
    Built(Box<Scene>),
    /// Why not.
    Failed { wanted: Box<Wanted>, message: String },
    /// Where a sequence has moved the vertices.
    Moved(Result<Vec<DVec3>, String>),
    /// What is at a place, if anything.
    Picked(Result<Option<Picked>, String>),
}

/// What the builder is asked.
enum Task {
    Build { number: u64, wanted: Box<Wanted>, sight: Sight, points: Option<Arc<Vec<DVec3>>>, engine: Engine },
    Pick(Box<Pick>),
}

/// The builder, as the window sees it. Its thread ends when it is dropped.
pub(crate) struct Builder {
    tasks: Option<Sender<Task>>,
    /// Number of the newest order.
    newest: Arc<AtomicU64>,
    thread: Option<JoinHandle<()>>,
}

impl Builder {
    /// Starts the thread. `tell` is called from there.
    pub(crate) fn start(
        (read, dress): (ReadDesc, Option<Dress>),
        tell: impl Fn(News) + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        let (tasks, received) = channel();
        let newest = Arc::new(AtomicU64::new(0));
        let mut workshop = Workshop {
            read,
            dress,
            tell: Arc::new(tell),
            newest: Arc::clone(&newest),
            cage: None,
            surfaces: Vec::new(),
            warm: HashSet::new(),
        };
        let thread = std::thread::Builder::new().name("builder".to_owned()).spawn(move || workshop.work(&received))?;
        Ok(Self { tasks: Some(tasks), newest, thread: Some(thread) })
    }

    /// Orders a scene; orders that are not begun are forgotten, and the reading of another file is ended. `points` are those of the
    /// cage where they were moved by hand.
    pub(crate) fn order(&self, engine: &Engine, wanted: Wanted, sight: Sight, points: Option<Arc<Vec<DVec3>>>) {
        let number = self.newest.fetch_add(1, Ordering::Relaxed) + 1;
        self.send(Task::Build { number, wanted: Box::new(wanted), sight, points, engine: engine.clone() });
    }

    /// Asks what is at a place.
    pub(crate) fn pick(&self, pick: Pick) {
        self.send(Task::Pick(Box::new(pick)));
    }

    fn send(&self, task: Task) {
        if self.tasks.as_ref().is_none_or(|tasks| tasks.send(task).is_err()) {
            tracing::error!("the thread that builds scenes has ended");
        }
    }
}

impl Drop for Builder {
    fn drop(&mut self) {
        self.newest.fetch_add(1, Ordering::Relaxed);
        self.tasks = None;
        if let Some(thread) = self.thread.take() {
            let _panicked_and_said_so = thread.join();
        }
    }
}

/// What pipelines depend on: once drawn, the driver has compiled them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Compiled {
    kinds: Vec<PatchKind>,
    evaluator: Evaluator,
    spacing: Spacing,
    target: Target,
    shade: Shade,
    cage: bool,
    mapped: bool,
    shaders: u32,
}

struct Workshop {
    read: ReadDesc,
    dress: Option<Dress>,
    tell: Arc<dyn Fn(News) + Send + Sync>,
    newest: Arc<AtomicU64>,
    cage: Option<Model>,
    /// Surfaces of that cage, and the shades that they are mapped for.
    surfaces: Vec<(Option<Shade>, Surface)>,
    warm: HashSet<Compiled>,
}

struct Model {
    file: PathBuf,
    revision: u32,
    shaders: u32,
    cage: Arc<Cage>,
    sequence: Option<Arc<Sequence>>,
}

impl Workshop {
    fn work(&mut self, tasks: &Receiver<Task>) {
        while let Ok(task) = tasks.recv() {
            match task {
                Task::Build { number, .. } if number < self.newest.load(Ordering::Relaxed) => {}
                Task::Build { number, wanted, sight, points, engine } => {
                    let result = self.build(&engine, number, &wanted, &sight, points.as_deref().map(Vec::as_slice));
                    match result {
                        Ok(scene) => (self.tell)(News::Built(Box::new(scene))),
                        Err(Stop::Superseded) => {}
                        Err(Stop::Failed(message)) => (self.tell)(News::Failed { wanted, message }),
                    }
                }
                Task::Pick(pick) => (self.tell)(News::Picked(pick.run().map_err(|error| error.to_string()))),
            }
        }
    }

    fn progress(&self, text: &str) {
        (self.tell)(News::Progress(text.to_owned(), None));
    }

    fn build(
        &mut self,
        engine: &Engine,
        number: u64,
        wanted: &Wanted,
        sight: &Sight,
        points: Option<&[DVec3]>,
    ) -> Result<Scene, Stop> {
        let cage = self.cage(number, wanted)?;
        // Who shows the scene moves the vertices; only distances are measured here, between surfaces as they are then.
        let points = points.filter(|points| points.len() == cage.vertex_count()).unwrap_or(cage.positions());
        let points = wanted.against.is_some().then_some(points);
        let desc = wanted.drawing(sight, cage.bounds());
        let sequence = self.cage.as_ref().and_then(|model| model.sequence.clone());
        let mut scene =
            Scene { wanted: wanted.clone(), cage: Arc::clone(&cage), sequence, sides: Vec::new(), difference: None };
        for &scheme in &wanted.schemes {
            let surface = self.surface(engine, (&cage, wanted), scheme, points)?;
            self.progress(&format!("preparing {scheme}"));
            let drawing = match wanted.against {
                Some(against) if scene.difference.is_none() => {
                    let against = self.surface(engine, (&cage, wanted), against, points)?;
                    let (drawing, difference) = Drawing::of_difference([&surface, &against], &desc, None)?;
                    scene.difference = Some(difference);
                    drawing
                }
                _ => Drawing::new(&surface, &desc)?,
            };
            self.warm_up(wanted, &drawing)?;
            let census = Arc::new(Census::of(surface.plan()));
            let animated = cage.rig().is_some_and(|rig| !rig.animations.is_empty());
            let animator = if animated { Some(Animator::new(&surface, &cage)?) } else { None };
            scene.sides.push(Side { scheme, drawing, animator, census });
        }
        Ok(scene)
    }

    /// The cage of a file, read if it was not.
    fn cage(&mut self, number: u64, wanted: &Wanted) -> Result<Arc<Cage>, Stop> {
        if let Some(model) = &mut self.cage
            && (&model.file, model.revision) == (&wanted.file, wanted.revision)
        {
            if model.shaders != wanted.shaders {
                model.shaders = wanted.shaders;
                self.surfaces.clear();
            }
            return Ok(Arc::clone(&model.cage));
        }
        let sequence = self.read(number, &wanted.file)?;
        let cage = Arc::new(sequence.cage().clone());
        let sequence = Some(sequence).filter(|sequence| sequence.frame_count() > 1).map(Arc::new);
        for warning in cage.warnings() {
            tracing::warn!("{}: {warning}", wanted.file.display());
        }
        let (file, revision, shaders) = (wanted.file.clone(), wanted.revision, wanted.shaders);
        self.surfaces.clear();
        self.cage = Some(Model { file, revision, shaders, cage: Arc::clone(&cage), sequence });
        Ok(cage)
    }

    fn read(&self, number: u64, file: &Path) -> Result<Sequence, Stop> {
        let (tell, newest) = (Arc::clone(&self.tell), Arc::clone(&self.newest));
        let observer = ReadObserver::new(move |ReadProgress { stage, done, total }| {
            let part = (total > 0).then(|| done as f32 / total as f32);
            tell(News::Progress(stage.name().to_owned(), part));
            if newest.load(Ordering::Relaxed) == number { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        let desc = ReadDesc { observer: Some(observer), ..self.read.clone() };
        Sequence::open(file, &desc).map_err(|error| match error {
            ReadError::Cancelled { .. } => Stop::Superseded,
            error => Stop::Failed(error.to_string()),
        })
    }

    /// The surface of a scheme, made if it was not; its cage is moved to `points`, if there are any.
    fn surface(
        &mut self,
        engine: &Engine,
        (cage, wanted): (&Cage, &Wanted),
        scheme: Scheme,
        points: Option<&[DVec3]>,
    ) -> Result<Surface, Stop> {
        let mapped_for = Some(wanted.shade).filter(|shade| shade.is_mapped());
        let fits = |(mapped, surface): &(Option<Shade>, Surface)| (*mapped, surface.scheme()) == (mapped_for, scheme);
        let at = match self.surfaces.iter().position(fits) {
            Some(at) => at,
            None => {
                self.progress(&format!("planning {scheme}"));
                let mut surface = Surface::new(engine, cage, &SurfaceDesc { scheme, ..SurfaceDesc::default() })?;
                if let Some(dress) = &self.dress {
                    surface = dress.apply(surface, cage, &wanted.file, wanted.shade).map_err(Stop::Failed)?;
                }
                self.surfaces.push((mapped_for, surface));
                self.surfaces.len() - 1
            }
        };
        let surface = &mut self.surfaces[at].1;
        if let Some(points) = points {
            surface.set_points(points)?;
        }
        Ok(surface.clone())
    }

    /// Draws once where nobody sees it: software drivers compile at the first draw.
    fn warm_up(&mut self, wanted: &Wanted, drawing: &Drawing) -> Result<(), Stop> {
        let desc = drawing.desc();
        let mut kinds: Vec<PatchKind> = drawing.surface().plan().lists.iter().map(|list| list.kind).collect();
        kinds.sort_unstable();
        let compiled = Compiled {
            kinds,
            evaluator: desc.tessellation.evaluator,
            spacing: desc.tessellation.spacing,
            target: desc.target,
            shade: desc.shade,
            cage: desc.cage,
            mapped: drawing.surface().is_mapped(),
            shaders: wanted.shaders,
        };
        if self.warm.contains(&compiled) {
            return Ok(());
        }
        let engine = drawing.surface().engine();
        let targets = Targets::new(engine, [64, 64], desc.target)?;
        let mut recording = Recording::new();
        drawing.record(&mut recording);
        recording.render(targets.pass(drawing.draws().to_vec(), Some([0.0, 0.0, 0.0, 1.0])));
        engine.device().run(&recording).map_err(EngineError::from)?;
        self.warm.insert(compiled);
        Ok(())
    }
}

/// Why a scene was not built.
enum Stop {
    /// Something else is wanted now.
    Superseded,
    /// It cannot be.
    Failed(String),
}

impl From<EngineError> for Stop {
    fn from(error: EngineError) -> Self {
        Self::Failed(error.to_string())
    }
}
