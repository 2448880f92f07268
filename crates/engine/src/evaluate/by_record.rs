//! Vertices that are numbered as records are ([`Layout::ByRecord`](crate::grid::Layout::ByRecord)): a vertex record is a vertex as it stands, and the kernel that
//! makes an edge record can write its vertices at once. Nothing is read per patch but for what lies inside.

use bytemuck::bytes_of;
use osculate_gpu::{Bindings, Buffer, ComputePass, Recording, TexelFormat};
use osculate_shaders::binding;
use osculate_shaders::layout::EdgePointsPush;

use super::{BY_RECORD_BYTES, GridChunk, Grids, Measured};
use crate::draw::Output;
use crate::grid::{GridPlanDesc, GridRates, Layout};
use crate::kernels::groups;
use crate::{EngineError, Surface};

/// Vertices along edges from their records, and from the nets of regular patches.
pub(super) const EDGE_KERNELS: [&str; 2] = ["evaluate/edges.comp", "evaluate/edges_regular.comp"];

/// Whether what is drawn of a surface is no more than places that follow from cubic records, and not displaced.
pub(super) fn suits(surface: &Surface, output: Output) -> bool {
    let places = Measured::of(output) == Measured::Nothing && output.layout() == Layout::Shared;
    let cubic = surface.plan().lists.iter().all(|list| !list.kind.form().has_spokes());
    // Of a part of a cage, records that other parts draw are left out.
    let whole = surface.plan().drawn_count() == surface.plan().patches.len();
    places && cubic && whole && !surface.is_mapped()
}

/// Whether an output can be drawn so: edges are all divided alike, and all vertices fit one buffer.
pub(super) fn fits(surface: &Surface, rates: &GridRates, output: Output) -> bool {
    let desc = GridPlanDesc { surface: surface.plan(), rates, layout: Layout::ByRecord, max_vertices: u32::MAX };
    let most = surface.max_grid_vertices(BY_RECORD_BYTES, Measured::Nothing);
    suits(surface, output) && desc.count_by_record().is_some_and(|count| count <= most.into())
}

impl Grids<'_> {
    /// Adds the passes that make vertices of records: of a surface that is up to date.
    pub(super) fn record_border(&self, chunk: &GridChunk, recording: &mut Recording) -> Result<(), EngineError> {
        let records = &self.surface.buffers().vertex_records;
        recording.copy_buffer(records, 0..records.size(), &chunk.vertices, 0);
        self.record_edges(chunk, 0, recording)
    }

    /// Adds the passes between the points of [`Surface::write_points`] and the vertices, and no others: the surface's own records stay what they were. `None` if
    /// vertices are not numbered by records.
    pub(crate) fn update(&self, chunk: &GridChunk, frame: &Buffer) -> Result<Option<Recording>, EngineError> {
        if self.layout != Layout::ByRecord {
            return Ok(None);
        }
        let mut recording = Recording::new();
        self.surface.record_update_of(&mut recording, &chunk.vertices)?;
        let regular = self.surface.plan().edge_records.regular.len() as u32;
        let tables = self.surface.buffers().edge_regular.clone();
        self.record_edge_points(chunk, EDGE_KERNELS[1], &tables, 0..regular, &mut recording)?;
        self.record_edges(chunk, regular, &mut recording)?;
        self.record_patches(chunk, frame, &mut recording)?;
        Ok(Some(recording))
    }

    /// Adds the passes that make vertices of edge records from `first` on.
    fn record_edges(&self, chunk: &GridChunk, first: u32, recording: &mut Recording) -> Result<(), EngineError> {
        let edges = first..self.surface.plan().edge_record_count() as u32;
        self.record_edge_points(chunk, EDGE_KERNELS[0], &self.surface.buffers().patches, edges, recording)
    }

    fn record_edge_points(
        &self,
        chunk: &GridChunk,
        shader: &'static str,
        tables: &Bindings,
        edges: std::ops::Range<u32>,
        recording: &mut Recording,
    ) -> Result<(), EngineError> {
        for run in self.grid_plan().edge_runs().into_iter().flatten() {
            let first_record = edges.start.max(run.edges.start);
            let count = edges.end.min(run.edges.end).saturating_sub(first_record);
            if count == 0 || self.rates.rate(run.rate).segments() < 2 {
                continue;
            }
            let (first_vertex, rate) = (run.vertex_of(0), self.rates.word(run.rate));
            let push = EdgePointsPush { count, first_record, first_vertex, rate };
            recording.compute(ComputePass {
                name: shader.to_owned(),
                pipeline: self.surface.engine().kernel(shader)?,
                bindings: tables
                    .clone()
                    .with_texels(binding::GRID_PARAMETERS, &self.parameters, TexelFormat::R32Float)
                    .with(binding::GRID_VERTICES, &chunk.vertices),
                push: bytes_of(&push).to_vec(),
                groups: groups(push.count),
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use glam::DVec3;
    use osculate_gpu::{Format, Memory};

    use super::*;
    use crate::draw::Sides;
    use crate::{
        Cage, Device, DeviceDesc, Engine, EngineDesc, Refinement, Scheme, Shade, Spacing, SurfaceDesc, Target,
        Tessellation,
    };

    const OUTPUT: Output = Output::Fill(Target { color: Format::Rgba8Unorm, samples: 1 }, Shade::Lit, Sides::Both);

    fn device() -> Device {
        let select = std::env::var("OSCULATE_DEVICE").ok();
        Device::new(&DeviceDesc { select, validation: true, ..DeviceDesc::default() }).unwrap()
    }

    fn cage(name: &str) -> Cage {
        Cage::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/cages").join(name)).unwrap()
    }

    fn needed(engine: &Engine, cage: &Cage) -> Surface {
        let refinement = Refinement::WhereNeeded;
        Surface::new(engine, cage, &SurfaceDesc { refinement, ..SurfaceDesc::default() }).unwrap()
    }

    fn surface(engine: &Engine, cage: &Cage, scheme: Scheme) -> Surface {
        Surface::new(engine, cage, &SurfaceDesc { scheme, ..SurfaceDesc::default() }).unwrap()
    }

    /// The bits of the triangles' corners, chunk after chunk.
    fn triangles(chunks: &[GridChunk]) -> Vec<[u32; 6]> {
        let mut all = Vec::new();
        for chunk in chunks {
            let vertices: Vec<[u32; 6]> = chunk.vertices.read(..).unwrap();
            all.extend(chunk.indices.iter().map(|&index| vertices[index as usize]));
        }
        all
    }

    /// The triangles of a surface in a layout, by the passes of `record`.
    fn evaluated(
        surface: &Surface,
        tessellation: &Tessellation,
        layout: Layout,
        record: impl Fn(&Grids<'_>, &GridChunk, &Buffer) -> Recording,
    ) -> Vec<[u32; 6]> {
        let rates = surface.grid_rates(tessellation).unwrap();
        let grids = Grids::new(surface, &rates, OUTPUT, layout, Memory::Readback).unwrap();
        let device = surface.engine().device();
        let frame = surface.undrawn_frame(tessellation).upload(device).unwrap();
        let chunks: Vec<GridChunk> = grids.chunks().map(Result::unwrap).collect();
        for chunk in &chunks {
            device.run(&record(&grids, chunk, &frame)).unwrap();
        }
        triangles(&chunks)
    }

    fn as_recorded(grids: &Grids<'_>, chunk: &GridChunk, frame: &Buffer) -> Recording {
        let mut recording = Recording::new();
        grids.record(chunk, frame, &mut recording).unwrap();
        recording
    }

    /// Both ways to vertices that are numbered by records give the bits of those that patches number, also once the cage has moved.
    #[test]
    fn vertices_have_the_bits_of_those_that_patches_number() {
        let engine = Engine::new(device());
        for (name, scheme) in [
            ("dragon.obj", Scheme::Gregory2),
            ("triangles.obj", Scheme::Gregory2),
            ("triangles.obj", Scheme::Gregory1),
            ("shell.obj", Scheme::Gregory2),
            ("shell.obj", Scheme::Gregory1),
            ("torus.obj", Scheme::Stam),
        ] {
            let cage = cage(name);
            bits_are_those_that_patches_number(
                &format!("{name}, {scheme}"),
                &cage,
                surface(&engine, &cage, scheme),
                Spacing::Odd,
            );
        }
        let cage = cage("dragon.obj");
        bits_are_those_that_patches_number("where needed", &cage, needed(&engine, &cage), Spacing::Equal);
        assert_eq!(engine.device().validation_messages(), [""; 0]);
    }

    fn bits_are_those_that_patches_number(name: &str, cage: &Cage, mut surface: Surface, spacing: Spacing) {
        assert!(suits(&surface, OUTPUT), "{name}");
        for tessellation in [1.0, 2.0, 3.3].map(|level| Tessellation { spacing, ..Tessellation::uniform(level) }) {
            surface.set_points(cage.positions()).unwrap();
            let shared = evaluated(&surface, &tessellation, Layout::Shared, as_recorded);
            let by_record = evaluated(&surface, &tessellation, Layout::ByRecord, as_recorded);
            assert!(shared == by_record, "{name}, {tessellation:?}");
            let moved: Vec<DVec3> =
                cage.positions().iter().map(|p| *p + 0.1 * DVec3::new(p.y.sin(), p.z.cos(), p.x)).collect();
            surface.write_points(&moved).unwrap();
            let updated = evaluated(&surface, &tessellation, Layout::ByRecord, |grids, chunk, frame| {
                grids.update(chunk, frame).unwrap().unwrap()
            });
            surface.set_points(&moved).unwrap();
            let shared = evaluated(&surface, &tessellation, Layout::Shared, as_recorded);
            assert!(shared == updated, "{name}, {tessellation:?}, moved");
            assert!(shared != by_record, "it has moved");
        }
    }

    #[test]
    fn it_is_for_one_chunk_of_edges_that_are_divided_alike() {
        let engine = Engine::new(device());
        let cage = cage("dragon.obj");
        let surface = surface(&engine, &cage, Scheme::Gregory2);
        let uniform = GridRates::uniform(4.0, Spacing::Equal);
        assert!(fits(&surface, &uniform, OUTPUT));
        let rates = GridRates::per_edge(&vec![4.0; surface.plan().edge_record_count()], Spacing::Equal);
        assert!(!fits(&surface, &rates, OUTPUT));
        let curvature = Output::Fill(Target { color: Format::Rgba8Unorm, samples: 1 }, Shade::Curvature, Sides::Both);
        assert!(!fits(&surface, &uniform, curvature));
        let desc = EngineDesc { grid_vertices: Some(1000), ..EngineDesc::default() };
        let small = self::surface(&Engine::with(engine.device().clone(), desc), &cage, Scheme::Gregory2);
        assert!(!fits(&small, &uniform, OUTPUT));
        let stam = self::surface(&engine, &cage, Scheme::Stam);
        assert!(!fits(&stam, &uniform, OUTPUT));
    }
}
