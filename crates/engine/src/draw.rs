//! Pipelines and draws of patch lists.

use std::sync::Arc;

use bytemuck::bytes_of;
use osculate_gpu::{
    Bindings, Blend, Compare, Cull, DepthBias, DepthState, Draw, GraphicsPipeline, GraphicsPipelineDesc, PolygonMode,
    Shader, Tessellation as Stages, Topology,
};
use osculate_shaders::{constant, layout::PatchPush};
use osculate_subdiv::{PatchForm, PatchKind, PatchList};

use crate::culling::overshoot;
use crate::evaluate::Measured;
use crate::grid::Layout;
use crate::material::{Inner as MaterialInner, MaterialId};
use crate::render::Seen;
use crate::{Engine, EngineError, Factors, Shade, Spacing, Surface, Target, Tessellation};

/// Which sides of triangles are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Sides {
    Both,
    /// Those that are seen of a closed surface from outside.
    Front,
}

/// What becomes of tessellated patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Output {
    /// Filled triangles in a shade.
    Fill(Target, Shade, Sides),
    /// The edges of the triangles.
    Lines(Target),
    /// Filled triangles in a material, whose vertices hold what those of the shade do.
    Material(MaterialId, Shade),
    /// Captured by transform feedback.
    Capture,
}

impl Output {
    /// Whose vertices it takes from the compute evaluator.
    pub(crate) fn layout(self) -> Layout {
        match self {
            Self::Fill(_, shade, _) | Self::Material(_, shade) => shade.layout(),
            Self::Lines(_) | Self::Capture => Layout::Own,
        }
    }

    /// What its fragments look at.
    fn seen(self) -> Seen {
        match self {
            Self::Fill(_, shade, _) => shade.seen(),
            Self::Lines(_) | Self::Material(..) | Self::Capture => Seen::Patch,
        }
    }

    /// The `SHADE_*` constant that shaders are specialized for.
    fn shade(self) -> u32 {
        match self {
            Self::Fill(_, shade, _) | Self::Material(_, shade) => shade.constant(),
            Self::Lines(_) => constant::SHADE_WIREFRAME,
            Self::Capture => constant::SHADE_NONE,
        }
    }
}

impl Output {
    /// The material of the triangles, if they have one.
    fn material(self, engine: &Engine) -> Result<Option<Arc<MaterialInner>>, EngineError> {
        match self {
            Self::Material(id, _) => engine.materials().get(id).map(Some),
            _ => Ok(None),
        }
    }
}

/// Everything that tells one graphics pipeline from another. Level and camera are uniforms, lest pipelines multiply; the shade is none, because llvmpipe
/// computes all branches for every pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum PipelineKey {
    /// Patches of a kind. `halves`: their sides may be halves of edges.
    Patches { kind: PatchKind, halves: bool, division: Division, output: Output, mapped: bool },
    /// Vertices of the compute evaluator.
    Grid { output: Output, mapped: bool },
    /// Lines of the cage overlay: those in sight, or all, behind the surface too.
    Cage { target: Target, hidden: bool },
}

/// How the tessellator divides patches, as far as shaders are made for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Division {
    pub(crate) spacing: Spacing,
    /// Whether factors differ from edge to edge.
    pub(crate) adaptive: bool,
    /// Whether patches of which nothing is seen are left out.
    pub(crate) culls: bool,
}

impl Division {
    /// That of a tessellation in which every patch is drawn.
    pub(crate) fn of(tessellation: &Tessellation) -> Self {
        let adaptive = matches!(tessellation.factors, Factors::Adaptive { .. });
        Self { spacing: tessellation.spacing, adaptive, culls: false }
    }
}

/// Shaders of a patch kind: vertex, control and evaluation stage, without the variant of the last.
fn stages(kind: PatchKind) -> [String; 3] {
    let form = kind.form();
    let name = form.name();
    if kind.is_stored() {
        let control = if form == PatchForm::Triangle { "patch/stored_triangle.tesc" } else { "patch/stored.tesc" };
        return ["patch/stored.vert".to_owned(), control.to_owned(), format!("patch/stored_{name}.tese")];
    }
    let control = match form {
        PatchForm::Stam => format!("patch/stam.tesc#{}", patch_points(kind)),
        _ => format!("patch/{name}.tesc"),
    };
    ["patch/patch.vert".to_owned(), control, format!("patch/{name}.tese")]
}

/// What their sides are: a `SIDES_*` constant.
fn sides(kind: PatchKind, halves: bool) -> u32 {
    match kind {
        PatchKind::Unrefined => constant::SIDES_UNREFINED,
        _ if halves => constant::SIDES_HALVES,
        _ => constant::SIDES_PLAIN,
    }
}

/// Points per patch that the vertex stage hands over.
fn patch_points(kind: PatchKind) -> u32 {
    kind.net_size().unwrap_or(1)
}

impl PipelineKey {
    /// The material that it is made for, if any.
    pub(crate) fn material(self) -> Option<MaterialId> {
        match self {
            Self::Patches { output: Output::Material(id, _), .. }
            | Self::Grid { output: Output::Material(id, _), .. } => Some(id),
            _ => None,
        }
    }

    pub(crate) fn make(self, engine: &Engine) -> Result<GraphicsPipeline, EngineError> {
        match self {
            Self::Patches { kind, halves, division, output, mapped } => {
                make_patches(engine, kind, halves, division, output, mapped)
            }
            Self::Grid { output, mapped } => make_grid(engine, output, mapped),
            Self::Cage { target, hidden } => make_cage(engine, target, hidden),
        }
    }
}

fn make_patches(
    engine: &Engine,
    kind: PatchKind,
    halves: bool,
    division: Division,
    output: Output,
    mapped: bool,
) -> Result<GraphicsPipeline, EngineError> {
    let outputs = if output == Output::Capture { "capture" } else { output.seen().word() };
    let [vertex, control, evaluation] = stages(kind);
    let vertex = engine.shader(&vertex)?;
    let control = engine.shader(&control)?;
    let words = [division.spacing.variant(), outputs, mapped_word(mapped)];
    let evaluation = engine.shader(&variant(&evaluation, &words))?;
    let material = output.material(engine)?;
    let fragment = fragment(engine, output, mapped)?;
    let name = patches_name(kind, halves, division, output) + mapped_name(mapped) + &material_name(&material);
    let specialization = [
        (constant::SPEC_NET_SIZE, patch_points(kind)),
        (constant::SPEC_SHADE, output.shade()),
        (constant::SPEC_ADAPTIVE, division.adaptive.into()),
        (constant::SPEC_CULLS, division.culls.into()),
        (constant::SPEC_MATERIAL, material.is_some().into()),
        (constant::SPEC_SIDES, sides(kind, halves)),
    ];
    let desc = GraphicsPipelineDesc {
        tessellation: Some(Stages { control: &control, evaluation: &evaluation, patch_points: patch_points(kind) }),
        fragment: fragment.as_ref(),
        topology: Topology::Patches,
        specialization: &specialization,
        ..GraphicsPipelineDesc::new(&name, &vertex)
    };
    Ok(engine.device().graphics_pipeline(&with_output(desc, output, material.as_deref()))?)
}

/// What tools call the pipeline of patches.
fn patches_name(kind: PatchKind, halves: bool, division: Division, output: Output) -> String {
    let form = kind.form().name();
    let patches = match kind {
        PatchKind::Unrefined => format!("{form} unrefined"),
        PatchKind::Regular if halves => format!("{form} beside unrefined"),
        PatchKind::Regular => form.to_owned(),
        PatchKind::Extraordinary { valence, .. } => format!("{form} valence {valence}"),
        PatchKind::Stored { .. } => format!("{form} stored"),
    };
    let adaptive = if division.adaptive { " adaptive" } else { "" };
    let culled = if division.culls { ", culled" } else { "" };
    format!("{patches}, {}{adaptive}, {}{culled}", division.spacing.variant(), output_name(output))
}

fn output_name(output: Output) -> String {
    let target = |Target { color, samples }| format!("{color:?} x{samples}");
    match output {
        Output::Fill(to, shade, Sides::Both) => format!("fill {} {}", shade.name(), target(to)),
        Output::Fill(to, shade, Sides::Front) => format!("fill fronts {} {}", shade.name(), target(to)),
        Output::Lines(to) => format!("lines {}", target(to)),
        Output::Material(..) => "material".to_owned(),
        Output::Capture => "capture".to_owned(),
    }
}

fn material_name(material: &Option<Arc<MaterialInner>>) -> String {
    material.as_ref().map_or_else(String::new, |material| format!(", {}", material.name()))
}

/// The name of a variant of a stage file, by those words that are not empty.
fn variant(path: &str, words: &[&str]) -> String {
    let words: Vec<&str> = words.iter().copied().filter(|word| !word.is_empty()).collect();
    if words.is_empty() { path.to_owned() } else { format!("{path}#{}", words.join(",")) }
}

fn mapped_word(mapped: bool) -> &'static str {
    if mapped { "mapped" } else { "" }
}

fn mapped_name(mapped: bool) -> &'static str {
    if mapped { ", mapped" } else { "" }
}

fn fragment(engine: &Engine, output: Output, mapped: bool) -> Result<Option<Shader>, EngineError> {
    match output {
        Output::Fill(_, shade, _) => {
            Ok(Some(engine.shader(&variant("shade/surface.frag", &[shade.seen().word(), mapped_word(mapped)]))?))
        }
        Output::Lines(_) => Ok(Some(engine.shader("shade/wire.frag")?)),
        Output::Material(id, _) => Ok(engine.materials().get(id)?.fragment().cloned()),
        Output::Capture => Ok(None),
    }
}

fn make_grid(engine: &Engine, output: Output, mapped: bool) -> Result<GraphicsPipeline, EngineError> {
    // Vertices that hold more than places are drawn whole.
    let seen = if Measured::of(output) == Measured::Nothing { output.seen() } else { Seen::Patch };
    let vertex = engine.shader(&variant("shade/grid.vert", &[seen.word()]))?;
    let material = output.material(engine)?;
    let fragment = fragment(engine, output, mapped)?;
    let name = format!("grid, {}{}{}", output_name(output), mapped_name(mapped), material_name(&material));
    let desc = GraphicsPipelineDesc {
        fragment: fragment.as_ref(),
        topology: Topology::Triangles,
        specialization: &[(constant::SPEC_SHADE, output.shade()), (constant::SPEC_MATERIAL, material.is_some().into())],
        ..GraphicsPipelineDesc::new(&name, &vertex)
    };
    Ok(engine.device().graphics_pipeline(&with_output(desc, output, material.as_deref()))?)
}

fn with_output<'a>(
    desc: GraphicsPipelineDesc<'a>,
    output: Output,
    material: Option<&'a MaterialInner>,
) -> GraphicsPipelineDesc<'a> {
    if let Some(material) = material {
        return material.complete(desc);
    }
    let drawn = |target: Target, polygon_mode, depth| GraphicsPipelineDesc {
        polygon_mode,
        depth: Some(depth),
        color_format: Some(target.color),
        depth_format: Some(Target::DEPTH),
        samples: target.samples,
        ..desc
    };
    match output {
        Output::Fill(target, _, sides) => {
            let cull = if sides == Sides::Front { Cull::Back } else { Cull::None };
            GraphicsPipelineDesc { cull, ..drawn(target, PolygonMode::Fill, DepthState::default()) }
        }
        Output::Lines(target) => {
            // A line covers pixels whose centres lie up to half a pixel beside the edge, where the triangle may be that much nearer.
            let bias = Some(DepthBias { constant: -16.0, slope: -1.0 });
            let depth = DepthState { bias, ..upon_fill() };
            GraphicsPipelineDesc { blend: Blend::Alpha, ..drawn(target, PolygonMode::Line, depth) }
        }
        Output::Capture | Output::Material(..) => GraphicsPipelineDesc { rasterizer_discard: true, ..desc },
    }
}

/// Lines blend, so the two triangles of an edge must both pass or both fail: lines leave the depth as it is.
fn upon_fill() -> DepthState {
    DepthState { compare: Compare::LessOrEqual, write: false, bias: None }
}

fn make_cage(engine: &Engine, target: Target, hidden: bool) -> Result<GraphicsPipeline, EngineError> {
    let vertex = engine.shader("shade/cage.vert")?;
    let fragment = engine.shader("shade/line.frag")?;
    let desc = GraphicsPipelineDesc {
        fragment: Some(&fragment),
        topology: Topology::Lines,
        blend: Blend::Alpha,
        depth: Some(if hidden { DepthState { compare: Compare::Always, ..upon_fill() } } else { upon_fill() }),
        color_format: Some(target.color),
        depth_format: Some(Target::DEPTH),
        samples: target.samples,
        ..GraphicsPipelineDesc::new(if hidden { "cage overlay, hidden too" } else { "cage overlay" }, &vertex)
    };
    Ok(engine.device().graphics_pipeline(&desc)?)
}

/// Consecutive patches of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run<'a> {
    pub(crate) list: &'a PatchList,
    /// First patch of the run, counted in its list.
    pub(crate) first: u32,
    pub(crate) count: u32,
}

/// All patches of a surface that are drawn, in order, in runs of at most `longest`.
pub(crate) fn runs(lists: &[PatchList], longest: u32) -> impl Iterator<Item = Run<'_>> {
    lists.iter().flat_map(move |list| {
        (0..list.drawn).step_by(longest as usize).map(move |first| Run {
            list,
            first,
            count: longest.min(list.drawn - first),
        })
    })
}

impl Surface {
    /// The pipelines that its patches need, one for each kind present.
    pub(crate) fn pipelines(&self, division: Division, output: Output) -> impl Iterator<Item = PipelineKey> {
        self.plan().lists.iter().map(move |list| self.patches_key(list.kind, division, output))
    }

    fn patches_key(&self, kind: PatchKind, division: Division, output: Output) -> PipelineKey {
        // Where a side is half an edge, the corner on the cage is regular, and so the patch.
        let halves = kind == PatchKind::Regular && self.has_unrefined();
        PipelineKey::Patches { kind, halves, division, output, mapped: self.is_mapped() }
    }

    /// Most patches of one of its draws.
    pub(crate) fn patches_per_draw(&self, tessellation: &Tessellation) -> Result<u32, EngineError> {
        let patches = self.plan().patches.len() as u32;
        Ok(self.engine().patches_per_draw(self.max_segments(tessellation)?, patches))
    }

    /// The draw of a run of patches; `bindings` are those of the surface and the frame.
    pub(crate) fn draw(
        &self,
        run: Run<'_>,
        bindings: &Bindings,
        division: Division,
        output: Output,
    ) -> Result<Draw, EngineError> {
        let list = run.list;
        let points = patch_points(list.kind);
        let push = PatchPush {
            net_offset: list.first_index,
            net_size: points,
            first_patch: list.first_patch,
            weights: list.weights,
            overshoot: overshoot(list, &self.plan().weights),
        };
        let key = self.patches_key(list.kind, division, output);
        Ok(Draw {
            pipeline: self.engine().pipeline(key)?,
            bindings: bindings.clone(),
            push: bytes_of(&push).to_vec(),
            vertices: (run.first * points..(run.first + run.count) * points).into(),
            instances: 0..1,
            attributes: None,
            scissor: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use osculate_gpu::Format;

    use super::*;

    #[test]
    fn names_tell_pipelines_of_patches_apart() {
        let plain = |spacing| Division { spacing, adaptive: false, culls: false };
        let target = Target { color: Format::Rgba8Srgb, samples: 4 };
        let stam = PatchKind::Extraordinary { form: PatchForm::Stam, valence: 7 };
        assert_eq!(
            patches_name(stam, false, plain(Spacing::Equal), Output::Fill(target, Shade::Zebra, Sides::Both)),
            "stam valence 7, equal, fill zebra Rgba8Srgb x4"
        );
        let stored = PatchKind::Stored { form: PatchForm::Gregory };
        assert_eq!(patches_name(stored, false, plain(Spacing::Odd), Output::Capture), "gregory stored, odd, capture");
        let culled = Division { adaptive: true, culls: true, ..plain(Spacing::Equal) };
        assert_eq!(
            patches_name(stored, false, culled, Output::Capture),
            "gregory stored, equal adaptive, capture, culled"
        );
        let regular = [(PatchKind::Unrefined, false), (PatchKind::Regular, true)];
        let names = regular.map(|(kind, halves)| patches_name(kind, halves, plain(Spacing::Equal), Output::Capture));
        assert_eq!(names, ["regular unrefined, equal, capture", "regular beside unrefined, equal, capture"]);
    }

    #[test]
    fn runs_cover_every_patch_once() {
        let list = |first_patch, count| PatchList {
            kind: PatchKind::Regular,
            first_patch,
            count,
            drawn: count,
            first_index: 0,
            weights: 0,
        };
        let lists = [list(0, 31), list(31, 10)];
        let runs: Vec<(u32, u32, u32)> =
            runs(&lists, 15).map(|run| (run.list.first_patch, run.first, run.count)).collect();
        assert_eq!(runs, [(0, 0, 15), (0, 15, 15), (0, 30, 1), (31, 0, 10)]);
    }
}
