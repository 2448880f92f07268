//! Devices that lack what is optional: without tessellation and transform feedback the compute evaluator does all there is to do.

use std::collections::BTreeSet;

use osculate::gpu::{Features, ResourceKind, Stage, reflect};
use osculate::{
    CapturedVertex, Device, DeviceDesc, Drawing, DrawingDesc, Engine, EngineError, Evaluator, Factors, RenderDesc,
    Scheme, Surface, Tessellation, check, render,
};
use osculate_shaders::{SHADERS, constant::MATERIAL_PUSH_OFFSET};
use osculate_tests::{gpu, surface_of, zoo};

/// An engine on a device that was opened without some features, under validation; drops with a check of its messages.
struct Lesser(Engine);

impl Lesser {
    fn new(without: Features) -> Self {
        let select = std::env::var("OSCULATE_DEVICE").ok();
        Self(Engine::new(
            Device::new(&DeviceDesc { select, validation: true, without, ..DeviceDesc::default() }).unwrap(),
        ))
    }

    /// One that neither tessellates nor captures.
    fn plain() -> Self {
        let mut without = Features::default();
        (without.tessellation, without.transform_feedback) = (true, true);
        Self::new(without)
    }
}

impl Drop for Lesser {
    fn drop(&mut self) {
        let messages = self.0.device().validation_messages();
        assert!(messages.is_empty() || std::thread::panicking(), "{}", messages.join("\n"));
    }
}

fn by(evaluator: Evaluator) -> Tessellation {
    Tessellation { evaluator, factors: Factors::Uniform(5.0), ..Tessellation::default() }
}

fn captured(surface: &Surface, tessellation: &Tessellation) -> Result<Vec<CapturedVertex>, EngineError> {
    let mut all = Vec::new();
    surface.capture(tessellation, |vertices| {
        all.extend_from_slice(vertices);
        Ok::<(), EngineError>(())
    })?;
    Ok(all)
}

/// Pictures, triangles and proofs are those that the compute evaluator makes on the whole device, bit for bit.
#[test]
fn without_tessellation_the_compute_evaluator_takes_over() {
    let (gpu, lesser) = (gpu(), Lesser::plain());
    let cage = zoo::shipped("twohole");
    for scheme in [Scheme::Gregory2, Scheme::Stam] {
        let surfaces = [&*gpu, &lesser.0].map(|engine| surface_of(engine, &cage, scheme, None).unwrap());
        let desc = |evaluator| RenderDesc { tessellation: by(evaluator), ..RenderDesc::fit(&cage, [96, 72]) };
        let whole = render(&gpu, &[&surfaces[0]], &desc(Evaluator::Compute)).unwrap();
        let found = render(&lesser.0, &[&surfaces[1]], &desc(Evaluator::Auto)).unwrap();
        assert!(found == whole, "{scheme:?}");
        let triangles = captured(&surfaces[1], &by(Evaluator::Auto)).unwrap();
        assert_eq!(triangles, captured(&surfaces[0], &by(Evaluator::Compute)).unwrap(), "{scheme:?}");
        assert!(check(&surfaces[1], &by(Evaluator::Auto)).unwrap().is_watertight());
        let drawing = DrawingDesc { tessellation: by(Evaluator::Auto), ..DrawingDesc::fit(&cage, [96, 72]) };
        assert!(Drawing::new(&surfaces[1], &drawing).unwrap().grid_counts().is_some());
    }
}

#[test]
fn a_tessellator_that_is_not_there_is_refused() {
    let lesser = Lesser::plain();
    let cage = zoo::shipped("cube");
    let surface = surface_of(&lesser.0, &cage, Scheme::default(), None).unwrap();
    let tessellation = by(Evaluator::Tessellator);
    let picture = RenderDesc { tessellation, ..RenderDesc::fit(&cage, [16, 16]) };
    let drawing = DrawingDesc { tessellation, ..DrawingDesc::fit(&cage, [16, 16]) };
    let errors = [
        render(&lesser.0, &[&surface], &picture).map(drop).unwrap_err(),
        Drawing::new(&surface, &drawing).map(drop).unwrap_err(),
        captured(&surface, &tessellation).map(drop).unwrap_err(),
    ];
    for error in errors {
        assert!(matches!(error, EngineError::Unsupported { .. }), "{error}");
        assert!(error.to_string().contains("tessellationShader"), "{error}");
    }
}

/// Transform feedback alone is no reason to draw otherwise: only what hands out triangles changes.
#[test]
fn without_transform_feedback_only_captures_change() {
    let mut without = Features::default();
    without.transform_feedback = true;
    let lesser = Lesser::new(without);
    let cage = zoo::shipped("cube");
    let surface = surface_of(&lesser.0, &cage, Scheme::default(), None).unwrap();
    let drawing = DrawingDesc { tessellation: by(Evaluator::Auto), ..DrawingDesc::fit(&cage, [16, 16]) };
    assert!(Drawing::new(&surface, &drawing).unwrap().grid_counts().is_none(), "the tessellator draws");
    let [auto, compute] = [Evaluator::Auto, Evaluator::Compute].map(|one| captured(&surface, &by(one)).unwrap());
    assert_eq!(auto, compute);
    let error = captured(&surface, &by(Evaluator::Tessellator)).unwrap_err().to_string();
    assert!(error.contains("VK_EXT_transform_feedback"), "{error}");
}

/// What docs/embedding.md says that devices must have is what the shaders take.
#[test]
fn the_table_of_limits_is_true() {
    let storage = |kind: ResourceKind| kind == ResourceKind::StorageBuffer;
    // Textures and texel buffers count as one.
    let sampled = |kind: ResourceKind| matches!(kind, ResourceKind::Texture(_) | ResourceKind::TexelBuffer(_));
    let (mut of_stage, mut sampled_of_stage, mut bindings, mut push) = (0, 0, 0, 0);
    let mut graphics = BTreeSet::new();
    for shader in SHADERS {
        let found = reflect(shader.spirv).unwrap();
        of_stage = of_stage.max(found.resources.iter().filter(|one| storage(one.kind)).count());
        sampled_of_stage = sampled_of_stage.max(found.resources.iter().filter(|one| sampled(one.kind)).count());
        push = push.max(found.push_constant_size);
        if found.stage == Stage::Compute {
            bindings = bindings.max(found.resources.len());
        } else if !shader.path.starts_with("view/") {
            graphics.extend(found.resources.iter().map(|one| one.binding));
        }
    }
    // No pipeline has more than all stages together.
    bindings = bindings.max(graphics.len());
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/embedding.md")).unwrap();
    let stated = |limit: &str| {
        let line = text.lines().find(|line| line.starts_with(&format!("| `{limit}`"))).unwrap();
        let number = line.split('|').nth(2).unwrap().split(',').next().unwrap();
        number.trim().parse::<usize>().unwrap()
    };
    assert_eq!(stated("maxPerStageDescriptorStorageBuffers"), of_stage);
    assert_eq!(stated("maxPerStageDescriptorSampledImages"), sampled_of_stage);
    assert_eq!(stated("maxPushDescriptors"), bindings);
    assert_eq!(stated("maxPushConstantsSize"), push.max(MATERIAL_PUSH_OFFSET) as usize);
}
