//! The device that a command runs on.

use crate::args::GlobalArgs;
use crate::cache;
use crate::failure::{Failure, Verdict};
use crate::progress::Progress;
use crate::stdout;
use osculate::{
    Device, DeviceDesc, DeviceError, DeviceInfo, Engine, EngineDesc, EngineError, GpuError, PipelineObserver,
    PipelineProgress, PlanError, devices,
};
use std::sync::{Mutex, PoisonError};

/// Opens the device that was asked for, hands it to `work`, and fails if validation had anything to say.
pub(crate) fn with_engine<T>(
    global: &GlobalArgs,
    work: impl FnOnce(&Engine) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let desc = DeviceDesc {
        select: global.device.clone(),
        validation: global.validation,
        application: "osculate".to_owned(),
        ..DeviceDesc::default()
    };
    let device = Device::new(&desc)?;
    let info = device.info();
    tracing::info!("device {}: {}, {} {}", info.index, info.name, info.driver_name, info.driver_info);
    let observer = Some(show_pipelines(global.quiet));
    let engine =
        Engine::with(device, EngineDesc { pipeline_cache: cache::folder(), observer, ..EngineDesc::default() });
    let result = work(&engine);
    engine.save_pipelines();
    for message in engine.device().validation_messages() {
        tracing::error!("{message}");
    }
    let count = engine.device().validation_messages().len();
    let done = result?;
    if count > 0 {
        return Err(Failure::device(format_args!("validation had {count} messages; they stand above")));
    }
    Ok(done)
}

/// A bar for drivers that take long to make pipelines.
fn show_pipelines(quiet: bool) -> PipelineObserver {
    let shown = Mutex::new(None);
    PipelineObserver::new(move |PipelineProgress { done, total }| {
        let mut shown = shown.lock().unwrap_or_else(PoisonError::into_inner);
        match done {
            0 => *shown = Some(Progress::new(quiet, total as u64, "making pipelines")),
            _ => shown.iter().for_each(|progress| progress.advance(1)),
        }
        if done == total {
            *shown = None;
        }
    })
}

/// Prints a line per device.
pub(crate) fn list() -> Result<Verdict, Failure> {
    let devices = devices()?;
    if devices.is_empty() {
        return Err(DeviceError::NoDevice.into());
    }
    let width = devices.iter().map(|device| device.name.chars().count()).max().unwrap_or_default();
    for device in &devices {
        stdout::print_line(line(device, width))?;
    }
    Ok(Verdict::Pass)
}

/// Index, name, kind, driver, and what keeps the device from being used.
fn line(device: &DeviceInfo, name_width: usize) -> String {
    let DeviceInfo { index, name, kind, driver_name, driver_info, api_version, missing, .. } = device;
    // A kind formats without regard to a width.
    let kind = kind.to_string();
    let usable = if missing.is_empty() { String::new() } else { format!("  (unusable: lacks {})", missing.join(", ")) };
    format!("{index:>2}  {name:name_width$}  {kind:10}  {driver_name} {driver_info}, Vulkan {api_version}{usable}")
}

impl From<DeviceError> for Failure {
    fn from(error: DeviceError) -> Self {
        let failure = Self::device(&error);
        match error {
            DeviceError::NoMatch { .. } | DeviceError::MissingFeature { .. } => {
                failure.with_hint("--list-devices shows the devices of this machine")
            }
            DeviceError::NoValidationLayer => failure.with_hint("leave --validation away, or install the layer"),
            DeviceError::NoLoader { .. } | DeviceError::NoDevice => {
                failure.with_hint("sample --evaluator reference and inspect work without a device")
            }
            _ => failure.with_hint("update the driver, or choose another --device"),
        }
    }
}

impl From<EngineError> for Failure {
    fn from(error: EngineError) -> Self {
        match error {
            EngineError::Plan(PlanError::NothingToDraw { .. } | PlanError::TooLarge { .. }) => Self::input(error),
            EngineError::Pose { .. } => Self::input(error).with_hint("correct the animation, or take another --time"),
            EngineError::Level { .. } => Self::usage(error).with_hint("--level takes numbers from 1 to 64"),
            EngineError::Unrefined { .. } | EngineError::Plan(PlanError::UnrefinedParts) => {
                Self::usage(error).with_hint("leave --refine needed away")
            }
            EngineError::Unsupported { .. } => {
                Self::device(error).with_hint("ask for less, or for another --device; --list-devices shows them")
            }
            EngineError::Gpu(GpuError::Limit { .. } | GpuError::OutOfMemory { .. }) => Self::device(error)
                .with_hint("ask for less (--size, --samples, --level, a smaller cage) or for another --device"),
            _ => Self::device(error)
                .with_hint("another --device or a newer driver may do it; -v says which device is used"),
        }
    }
}
