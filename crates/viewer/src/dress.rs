//! Displacement and colours of what is shown: where they come from is the caller's business.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use osculate::{Shade, Surface};
use osculate_cage::Cage;

/// Gives a surface the maps that it is to be shown with: displacement in any shade, texture coordinates and colours where the shade
/// takes them. Called on the builder's thread, once for each surface that is made.
#[derive(Clone)]
pub struct Dress {
    dress: Arc<DressFn>,
    has_colors: bool,
}

/// The surface of a cage of a file, for a shade; or else what is wrong.
type DressFn = dyn Fn(Surface, &Cage, &Path, Shade) -> Result<Surface, String> + Send + Sync;

impl Dress {
    /// One that asks `dress`, which has colours for models without, or not.
    pub fn new(
        has_colors: bool,
        dress: impl Fn(Surface, &Cage, &Path, Shade) -> Result<Surface, String> + Send + Sync + 'static,
    ) -> Self {
        Self { dress: Arc::new(dress), has_colors }
    }

    pub(crate) fn apply(&self, surface: Surface, cage: &Cage, file: &Path, shade: Shade) -> Result<Surface, String> {
        (self.dress)(surface, cage, file, shade)
    }

    /// Whether a cage has what a shade shows.
    pub(crate) fn suits(dress: Option<&Self>, cage: &Cage, shade: Shade) -> bool {
        let has_colors = || cage.appearance().is_some() || dress.is_some_and(|dress| dress.has_colors);
        let has_maps = || dress.is_some() && cage.uv().is_some();
        match shade {
            Shade::Textured => has_maps() && has_colors(),
            shade => !shade.is_mapped() || has_maps(),
        }
    }
}

impl fmt::Debug for Dress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Dress")
    }
}
