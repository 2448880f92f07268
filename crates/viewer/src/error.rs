//! Why there is no window, or none any more.

use osculate::EngineError;
use osculate::gpu::{DeviceError, GpuError};

/// Why the viewer could not start, or ended before its time. What is wrong with a file is shown in the window and is no error here.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ViewerError {
    /// There is nowhere to open a window.
    #[error("no window can be opened here: {reason}")]
    NoDisplay {
        /// What the window system says.
        reason: String,
    },
    /// The window system ended the program.
    #[error("the window system failed: {reason}")]
    WindowSystem {
        /// What it says.
        reason: String,
    },
    /// No device can draw to the window.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The engine failed.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// A shader is missing from the set.
    #[error("the shader set has no shader named {name:?}")]
    MissingShader {
        /// Its name.
        name: String,
    },
    /// The thread that builds scenes cannot be started.
    #[error("the system starts no more threads: {0}")]
    Thread(std::io::Error),
    /// Validation was asked for and had something to say.
    #[error("validation had {count} messages; they stand above")]
    Validation {
        /// How many.
        count: usize,
    },
}
