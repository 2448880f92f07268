//! How far two schemes are apart on the same cage, as a heat map.

use glam::Vec3;
use osculate_gpu::{BufferUsage, Recording};
use osculate_shaders::constant::SAMPLE_FLOATS;
use osculate_shaders::layout::SampleRequest;
use rayon::prelude::*;

use crate::canvas::Canvas;
use crate::evaluate::{GridChunk, Grids};
use crate::grid::Layout;
use crate::{
    CapturedVertex, Drawing, DrawingDesc, Engine, EngineError, Evaluator, Picture, RenderDesc, Shade, Surface,
    SurfacePoint, Tessellation,
};

/// What [`render_difference`] measured, in the cage's own length: distances between two surfaces at the same places on the cage, those of the vertices drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The largest distance.
    pub largest: f64,
    /// The mean over all vertices.
    pub mean: f64,
    /// The distance at which the colours end.
    pub range: f64,
}

/// Draws `surface` in colours of the distance to `against`, another surface of the same cage, at the same place: face, sub-face, s, t. The colours end at
/// `range`, in the cage's own length; `None` takes the largest distance. Vertices come from the compute evaluator, whatever the tessellation says.
///
/// # Errors
/// If `against` lacks a face that `surface` has, or as [`crate::render()`].
pub fn render_difference(
    engine: &Engine,
    [surface, against]: [&Surface; 2],
    desc: &RenderDesc,
    range: Option<f64>,
) -> Result<(Picture, Difference), EngineError> {
    let desc = RenderDesc { shade: Shade::Difference, ..*desc };
    let comparison = Comparison { surface, against, tessellation: &desc.tessellation };
    let mut canvas = Canvas::new(engine, &desc)?;
    let frame = canvas.frame(surface)?;
    let difference =
        comparison.show(range, |grids, chunk| canvas.add_chunk(grids, &chunk, &frame, Recording::new()))?;
    canvas.add_cage(surface)?;
    Ok((canvas.finish()?, difference))
}

impl Drawing {
    /// The same as [`render_difference`] shows, for frames: distances between the surfaces as they are now, which do not follow when
    /// either moves.
    ///
    /// # Errors
    /// If `against` lacks a face that `surface` has, or as [`Self::new`].
    pub fn of_difference(
        [surface, against]: [&Surface; 2],
        desc: &DrawingDesc,
        range: Option<f64>,
    ) -> Result<(Self, Difference), EngineError> {
        let tessellation = Tessellation { evaluator: Evaluator::Compute, ..desc.tessellation };
        let mut drawing = Self::empty(surface, &DrawingDesc { shade: Shade::Difference, tessellation, ..*desc })?;
        let comparison = Comparison { surface, against, tessellation: &tessellation };
        let difference = comparison.show(range, |grids, chunk| drawing.add_chunk(grids, &chunk))?;
        drawing.add_cage()?;
        Ok((drawing, difference))
    }
}

/// Distances found so far.
#[derive(Default)]
struct Distances {
    largest: f64,
    sum: f64,
    count: usize,
}

impl Distances {
    fn add(&mut self, distances: &[f64]) {
        self.largest = distances.iter().copied().fold(self.largest, f64::max);
        self.sum += distances.iter().sum::<f64>();
        self.count += distances.len();
    }

    fn mean(&self) -> f64 {
        self.sum / self.count.max(1) as f64
    }
}

/// Two surfaces of a cage.
struct Comparison<'a> {
    surface: &'a Surface,
    against: &'a Surface,
    tessellation: &'a Tessellation,
}

impl Comparison<'_> {
    fn measure(&self) -> Result<Distances, EngineError> {
        let mut distances = Distances::default();
        self.for_each_chunk(|_, _, _, of_vertices| {
            distances.add(of_vertices);
            Ok(())
        })?;
        Ok(distances)
    }

    /// Hands on the chunks of the first surface, their vertices with distances in place of (u,v), as parts of `range`.
    fn show(
        &self,
        range: Option<f64>,
        mut draw: impl FnMut(&Grids<'_>, GridChunk) -> Result<(), EngineError>,
    ) -> Result<Difference, EngineError> {
        let range = match range {
            Some(range) => range,
            None => self.measure()?.largest,
        };
        let mut distances = Distances::default();
        self.for_each_chunk(|grids, chunk, vertices, of_vertices| {
            distances.add(of_vertices);
            for (vertex, distance) in vertices.iter_mut().zip(of_vertices) {
                // The same surface twice has no largest distance.
                vertex.uv = [if range > 0.0 { (distance / range) as f32 } else { 0.0 }, 0.0];
            }
            let device = self.surface.engine().device();
            let usage = BufferUsage::STORAGE | BufferUsage::VERTEX;
            draw(grids, chunk.with_vertices(device.upload("measured vertices", usage, vertices)?))
        })?;
        Ok(Difference { largest: distances.largest, mean: distances.mean(), range })
    }

    /// Evaluates the grids of the first surface: hands on the vertices of each chunk with their distances to the second.
    fn for_each_chunk(
        &self,
        mut visit: impl FnMut(&Grids<'_>, &GridChunk, &mut [CapturedVertex], &[f64]) -> Result<(), EngineError>,
    ) -> Result<(), EngineError> {
        let rates = self.surface.grid_rates(self.tessellation)?;
        let grids = Grids::read(self.surface, &rates, Layout::Own)?;
        let frame = self.surface.undrawn_frame(self.tessellation).upload(self.surface.engine().device())?;
        for chunk in grids.chunks() {
            let chunk = chunk?;
            let mut vertices = grids.run(&chunk, &frame)?;
            let distances = self.distances(&vertices)?;
            visit(&grids, &chunk, &mut vertices, &distances)?;
        }
        Ok(())
    }

    fn distances(&self, vertices: &[CapturedVertex]) -> Result<Vec<f64>, EngineError> {
        let requests: Vec<SampleRequest> =
            vertices.par_iter().map(|vertex| self.request(vertex)).collect::<Result<_, _>>()?;
        let samples = self.against.evaluate(&requests)?;
        let distance = |(vertex, sample): (&CapturedVertex, &[f32])| {
            let here = self.surface.space().leave(Vec3::from(vertex.position));
            here.distance(self.against.space().leave(Vec3::from_slice(sample)))
        };
        Ok(vertices.par_iter().zip(samples.par_chunks_exact(SAMPLE_FLOATS as usize)).map(distance).collect())
    }

    /// The point of the second surface at the place of a vertex of the first.
    fn request(&self, vertex: &CapturedVertex) -> Result<SampleRequest, EngineError> {
        let place = self.surface.place(vertex.patch, vertex.uv.map(f64::from));
        // Roundings must not lead out of the face.
        let [s, t] = place.st.map(|x| x.clamp(0.0, 1.0));
        self.against.request(&SurfacePoint { sub_face: place.sub_face, s, t })
    }
}
