//! The test harness: device, zoo of cages, reference data.
//!
//! Tests that draw take [`gpu()`], whose guard fails the test if validation said anything. Tests that compare with data from elsewhere take
//! [`reference_folder`] and are ignored by default.

pub mod exact;
pub mod formula;
pub mod legend;
pub mod mapped;
pub mod moving;
pub mod mutation;
pub mod picture;
pub mod rigged;
pub mod stars;
pub mod whole;
pub mod zoo;

use std::path::PathBuf;
use std::sync::OnceLock;

use osculate::{
    BoundaryRule, Cage, Device, DeviceDesc, Engine, EngineDesc, EngineError, PlanError, Scheme, ShaderSet, Spacing,
    Surface, SurfaceDesc,
};
use osculate_cage::NONE;

/// The engine that tests share, so that pipelines are compiled once; checks validation when dropped.
pub struct Gpu {
    engine: Engine,
}

/// The device under validation (core and synchronization): that of `OSCULATE_DEVICE`, else the best of this machine.
///
/// # Panics
/// If there is no device: a machine without a GPU needs a software one (Mesa's lavapipe), which tools/setup.sh installs.
pub fn gpu() -> Gpu {
    static ENGINE: OnceLock<Engine> = OnceLock::new();
    Gpu { engine: ENGINE.get_or_init(|| Engine::new(device())).clone() }
}

/// An engine of its own on the shared device, with changed shaders.
pub fn gpu_with_shaders(shaders: ShaderSet) -> Gpu {
    gpu_with(EngineDesc { shaders, ..EngineDesc::default() })
}

/// An engine of its own on the shared device.
pub fn gpu_with(desc: EngineDesc) -> Gpu {
    Gpu { engine: Engine::with(gpu().engine.device().clone(), desc) }
}

/// The surface of a cage under a boundary rule, or none if the rule leaves nothing to draw.
///
/// # Panics
/// If it cannot be made.
pub fn surface(engine: &Engine, cage: &Cage, boundary: Option<BoundaryRule>) -> Option<Surface> {
    surface_of(engine, cage, Scheme::default(), boundary)
}

/// The same in any scheme.
///
/// # Panics
/// If it cannot be made.
pub fn surface_of(engine: &Engine, cage: &Cage, scheme: Scheme, boundary: Option<BoundaryRule>) -> Option<Surface> {
    match Surface::new(engine, cage, &SurfaceDesc { scheme, boundary, ..SurfaceDesc::default() }) {
        Ok(surface) => Some(surface),
        Err(EngineError::Plan(PlanError::NothingToDraw { .. })) => None,
        Err(error) => panic!("{error}"),
    }
}

/// The schemes that the cage of a number in a long row is tested with: all, or for a large one another one for each number. What is
/// drawn of large cages is of the kinds that small ones have.
pub fn schemes_in_turn(number: usize, cage: &Cage) -> &'static [Scheme] {
    let one = number % Scheme::ALL.len();
    if cage.face_count() > 500 { &Scheme::ALL[one..=one] } else { Scheme::ALL }
}

/// All boundary rules.
pub const RULES: [BoundaryRule; 3] = [BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None];

/// The boundary rules under which a cage's surfaces differ: one if it has no boundary.
pub fn rules_of(cage: &Cage) -> &'static [BoundaryRule] {
    let topology = cage.topology();
    let is_open = topology.edge_half_edges().iter().any(|&h| topology.twin(h) == NONE);
    if is_open { &RULES } else { &RULES[..1] }
}

/// Whether a surface has so many patches that tests with every scheme are better off with lower levels: its patches are of the same kinds as those of smaller ones.
pub fn is_large(surface: &Surface) -> bool {
    surface.plan().patches.len() > 3_000
}

/// Levels that exercise every spacing; fewer and lower ones for large surfaces.
pub fn levels_of(surface: &Surface) -> &'static [(f32, Spacing)] {
    match is_large(surface) {
        false => &[(1.0, Spacing::Equal), (5.0, Spacing::Equal), (3.3, Spacing::Odd), (4.7, Spacing::Even)],
        true => &[(2.0, Spacing::Equal), (2.6, Spacing::Odd)],
    }
}

fn device() -> Device {
    let desc = DeviceDesc {
        select: std::env::var("OSCULATE_DEVICE").ok(),
        validation: true,
        application: "osculate-tests".to_owned(),
        ..DeviceDesc::default()
    };
    match Device::new(&desc) {
        Ok(device) => device,
        Err(error) => panic!(
            "GPU tests need a Vulkan device and the validation layers (run tools/test.sh, which sets both up): {error}"
        ),
    }
}

impl std::ops::Deref for Gpu {
    type Target = Engine;

    fn deref(&self) -> &Engine {
        &self.engine
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        let messages = self.engine.device().validation_messages();
        if !messages.is_empty() && !std::thread::panicking() {
            panic!("validation said:\n{}", messages.join("\n"));
        }
    }
}

/// The folder of reference data from elsewhere, for tests marked `#[ignore = "needs OSCULATE_REFERENCE"]`.
///
/// # Panics
/// If the variable `OSCULATE_REFERENCE` is not set.
pub fn reference_folder() -> PathBuf {
    std::env::var_os("OSCULATE_REFERENCE").expect("OSCULATE_REFERENCE names the folder of reference data").into()
}
