//! Draws the scene into a picture, which the window then shows: drawn again only when something in it has changed.

use osculate::gpu::{
    ColorTarget, DepthTarget, Device, Draw, GpuError, Image, ImageDesc, ImageUsage, Measure, Prepared, RenderPass,
    Report,
};
use osculate::{EngineError, Recording, Shade, Target};

use crate::marks::Marks;
use crate::scene::{Scene, Side};
use crate::views::View;

/// Images of one size, and the recordings that fill them.
pub(crate) struct Stage {
    device: Device,
    target: Target,
    /// All samples, if a pixel has several.
    color: Option<Image>,
    depth: Image,
    picture: Image,
    /// Drawing alone, and with all that follows when vertices have moved.
    prepared: [Option<Ready>; 2],
    /// The one that ran last and was not read yet.
    unread: Option<bool>,
}

/// A recording that can run again.
struct Ready {
    shown: Shown,
    run: Prepared,
    sections: Vec<Section>,
    /// How often each triangle is drawn.
    layers: u64,
}

/// What a recording shows; another one has other passes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shown {
    pub(crate) views: Vec<View>,
    pub(crate) points: bool,
    pub(crate) normals: bool,
    /// Linear.
    pub(crate) background: [f32; 4],
    /// An animation moves the cage.
    pub(crate) by_rig: bool,
    /// Pixels of a point.
    pub(crate) scale: f32,
}

/// What a pass is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Section {
    Update,
    Surface,
    Marks,
}

/// What the device measured while it drew a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Measured {
    /// Seconds of refinement and evaluation before the draws.
    pub(crate) update: f64,
    /// Seconds of drawing surfaces.
    pub(crate) surface: f64,
    /// Seconds of drawing the cage and marks.
    pub(crate) marks: f64,
    /// Triangles of the surfaces; none where the device cannot count.
    pub(crate) triangles: Option<u64>,
}

impl Stage {
    /// Makes the images.
    pub(crate) fn new(device: &Device, size: [u32; 2], target: Target) -> Result<Self, GpuError> {
        let image = |name: &str, format, samples, usage| {
            device.image(&ImageDesc { name, size, format, samples, usage, ..ImageDesc::default() })
        };
        let several = target.samples > 1;
        let shown = ImageUsage::TARGET | ImageUsage::SAMPLED | ImageUsage::COPY_SRC;
        Ok(Self {
            device: device.clone(),
            target,
            color: if several {
                Some(image("samples", target.color, target.samples, ImageUsage::TARGET)?)
            } else {
                None
            },
            depth: image("depth", Target::DEPTH, target.samples, ImageUsage::TARGET)?,
            picture: image("picture", target.color, 1, shown)?,
            prepared: [None, None],
            unread: None,
        })
    }

    pub(crate) fn target(&self) -> Target {
        self.target
    }

    /// The picture, one sample per pixel.
    pub(crate) fn picture(&self) -> &Image {
        &self.picture
    }

    /// Forgets recordings: what they draw has changed.
    pub(crate) fn forget(&mut self) {
        self.prepared = [None, None];
        self.unread = None;
    }

    /// Starts drawing; with `update`, moved vertices are followed first.
    pub(crate) fn draw(
        &mut self,
        scene: &Scene,
        marks: &Marks,
        shown: &Shown,
        update: bool,
    ) -> Result<(), EngineError> {
        let known = self.prepared[usize::from(update)].as_ref().is_some_and(|ready| ready.shown == *shown);
        if !known {
            let ready = self.prepare(scene, marks, shown, update)?;
            self.prepared[usize::from(update)] = Some(ready);
        }
        if let Some(ready) = &mut self.prepared[usize::from(update)] {
            ready.run.submit()?;
            self.unread = Some(update);
        }
        Ok(())
    }

    /// What was measured in the last picture, once; waits until it is drawn.
    pub(crate) fn measured(&mut self) -> Result<Option<Measured>, GpuError> {
        let Some(update) = self.unread.take() else { return Ok(None) };
        let Some(ready) = &mut self.prepared[usize::from(update)] else { return Ok(None) };
        let report = ready.run.wait()?;
        Ok(Some(ready.measured(&report)))
    }

    fn prepare(&self, scene: &Scene, marks: &Marks, shown: &Shown, update: bool) -> Result<Ready, EngineError> {
        let (mut recording, mut sections) = (Recording::new(), Vec::new());
        if update {
            scene.record_update(&mut recording, shown.by_rig)?;
            sections.resize(recording.len(), Section::Update);
        }
        for (side, view) in scene.sides.iter().zip(&shown.views) {
            let (surface, mut over) = split(side);
            recording.render(self.pass("surface", view, surface, Some(shown.background)));
            sections.push(Section::Surface);
            if shown.normals {
                over.push(marks.normals(side, scene.cage.bounds().half_diagonal()));
            }
            if shown.points {
                over.push(marks.points(side, shown.scale));
            }
            if !over.is_empty() {
                recording.render(self.pass("marks", view, over, None));
                sections.push(Section::Marks);
            }
        }
        recording.measure(Measure { timings: true, statistics: true });
        let wire = scene.wanted.shade == Shade::Wireframe;
        Ok(Ready {
            shown: shown.clone(),
            run: self.device.prepare(&recording)?,
            sections,
            layers: if wire { 2 } else { 1 },
        })
    }

    fn pass(&self, name: &str, view: &View, draws: Vec<Draw>, clear: Option<[f32; 4]>) -> RenderPass {
        let (image, resolve) = match &self.color {
            Some(samples) => (samples.clone(), Some(self.picture.clone())),
            None => (self.picture.clone(), None),
        };
        RenderPass {
            name: name.to_owned(),
            color: Some(ColorTarget { image, clear, resolve }),
            depth: Some(DepthTarget { image: self.depth.clone(), clear: clear.map(|_| 1.0) }),
            viewport: view.viewport,
            area: Some(view.area),
            draws,
        }
    }
}

/// Draws of a surface, and those of its cage, which come last.
fn split(side: &Side) -> (Vec<Draw>, Vec<Draw>) {
    let draws = side.drawing.draws();
    let cage = if side.drawing.desc().cage { 2 } else { 0 };
    let (surface, cage) = draws.split_at(draws.len().saturating_sub(cage));
    (surface.to_vec(), cage.to_vec())
}

impl Ready {
    fn measured(&self, report: &Report) -> Measured {
        let mut measured = Measured::default();
        for ((_, nanoseconds), section) in report.timings.iter().zip(&self.sections) {
            let seconds = *nanoseconds as f64 * 1e-9;
            match section {
                Section::Update => measured.update += seconds,
                Section::Surface => measured.surface += seconds,
                Section::Marks => measured.marks += seconds,
            }
        }
        let drawn = self.sections.iter().filter(|section| **section != Section::Update);
        for ((_, counts), _) in report.statistics.iter().zip(drawn).filter(|(_, section)| **section == Section::Surface)
        {
            *measured.triangles.get_or_insert(0) += counts.clipping_invocations / self.layers;
        }
        measured
    }
}
