//! What is drawn upon the surface beside the cage's edges: vertices of the cage, normals.

use bytemuck::bytes_of;
use osculate::gpu::{Blend, Compare, DepthState, Device, Draw, GraphicsPipeline, GraphicsPipelineDesc, Topology};
use osculate::{ShaderSet, Target};
use osculate_shaders::layout::MarkPush;

use crate::error::ViewerError;
use crate::painter::shader;
use crate::picking::length_in_cage_space;
use crate::scene::Side;

/// Vertices of the cage: the orange of its edges, paler.
const POINT: [f32; 4] = [0.98, 0.55, 0.22, 1.0];
/// Diameter of dots in pixels.
const POINT_SIZE: f32 = 10.0;
/// Normals.
const NORMAL: [f32; 4] = [0.10, 0.42, 0.62, 0.9];
/// Length of normals, as a part of the half diagonal of the cage's box.
const NORMAL_LENGTH: f64 = 0.06;

/// Pipelines of marks on one kind of target.
pub(crate) struct Marks {
    point: GraphicsPipeline,
    normal: GraphicsPipeline,
    pub(crate) target: Target,
}

impl Marks {
    pub(crate) fn new(device: &Device, shaders: &ShaderSet, target: Target) -> Result<Self, ViewerError> {
        let pipeline = |name: &str, stages: [&str; 2], topology| -> Result<GraphicsPipeline, ViewerError> {
            let vertex = shader(device, shaders, stages[0])?;
            let fragment = shader(device, shaders, stages[1])?;
            Ok(device.graphics_pipeline(&GraphicsPipelineDesc {
                fragment: Some(&fragment),
                topology,
                blend: Blend::Alpha,
                depth: Some(DepthState { compare: Compare::LessOrEqual, write: false, bias: None }),
                color_format: Some(target.color),
                depth_format: Some(Target::DEPTH),
                samples: target.samples,
                ..GraphicsPipelineDesc::new(name, &vertex)
            })?)
        };
        Ok(Self {
            point: pipeline("vertices of the cage", ["view/point.vert", "view/point.frag"], Topology::Triangles)?,
            normal: pipeline("normals", ["view/normal.vert", "view/mark.frag"], Topology::Lines)?,
            target,
        })
    }

    /// Dots at all vertices of the cage; `scale` is that of the screen.
    pub(crate) fn points(&self, side: &Side, scale: f32) -> Draw {
        let count = side.surface().plan().cage_points;
        draw(&self.point, side, MarkPush { color: POINT, size: POINT_SIZE * scale }, 6 * count)
    }

    /// Normals at the corners of all patches.
    pub(crate) fn normals(&self, side: &Side, half_diagonal: f64) -> Draw {
        let count = side.surface().plan().vertex_records.count() as u32;
        let size = length_in_cage_space(side.surface().space(), NORMAL_LENGTH * half_diagonal);
        draw(&self.normal, side, MarkPush { color: NORMAL, size }, 2 * count)
    }
}

fn draw(pipeline: &GraphicsPipeline, side: &Side, push: MarkPush, vertices: u32) -> Draw {
    Draw {
        pipeline: pipeline.clone(),
        bindings: side.drawing.bindings(),
        push: bytes_of(&push).to_vec(),
        vertices: (0..vertices).into(),
        instances: 0..1,
        attributes: None,
        scissor: None,
    }
}
