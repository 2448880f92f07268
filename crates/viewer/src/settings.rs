//! What is kept from one run to the next.

use std::io;
use std::path::Path;

use osculate::gpu::PresentMode;
use osculate::{Evaluator, Scheme, Shade, Spacing};
use serde::{Deserialize, Serialize};

use crate::LookDesc;
use crate::choice::{self, Compare};

/// Everything that the user has chosen.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Settings {
    pub(crate) look: Look,
    pub(crate) screen: Screen,
}

/// How the surface looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Look {
    #[serde(with = "choice")]
    pub(crate) scheme: Scheme,
    /// The other one, where two are compared.
    #[serde(with = "choice")]
    pub(crate) against: Scheme,
    #[serde(with = "choice")]
    pub(crate) compare: Compare,
    #[serde(with = "choice")]
    pub(crate) evaluator: Evaluator,
    /// Factors follow lengths in the picture.
    pub(crate) adaptive: bool,
    /// Uniform factor, 1 to 64.
    pub(crate) level: f32,
    /// Length of segments in pixels, for adaptive factors.
    pub(crate) pixels: f32,
    #[serde(with = "choice")]
    pub(crate) spacing: Spacing,
    #[serde(with = "choice")]
    pub(crate) shade: Shade,
    /// Edges of triangles in place of the shade.
    pub(crate) wireframe: bool,
    /// Edges of the cage.
    pub(crate) cage: bool,
    /// Vertices of the cage.
    pub(crate) points: bool,
    /// Normals of the surface.
    pub(crate) normals: bool,
    /// Colours that show holes.
    pub(crate) leaks: bool,
    /// Patches of which nothing is seen, and backs, are left out.
    pub(crate) culling: bool,
    /// Samples of a pixel.
    pub(crate) samples: u32,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            scheme: Scheme::default(),
            against: Scheme::Stam,
            compare: Compare::Off,
            evaluator: Evaluator::Tessellator,
            adaptive: false,
            level: 8.0,
            pixels: 8.0,
            spacing: Spacing::Equal,
            shade: Shade::Lit,
            wireframe: false,
            cage: false,
            points: false,
            normals: false,
            leaks: false,
            culling: false,
            samples: 4,
        }
    }
}

/// How the window looks, and how often it is drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Screen {
    pub(crate) panels: bool,
    pub(crate) figures: bool,
    #[serde(with = "choice")]
    pub(crate) mode: PresentMode,
    /// Most frames in a second; 0 for as many as there are.
    pub(crate) limit: u32,
    /// Frames are drawn though nothing changes.
    pub(crate) continuous: bool,
    /// Width and height of the window in points.
    pub(crate) size: [u32; 2],
}

impl Default for Screen {
    fn default() -> Self {
        Self { panels: true, figures: true, mode: PresentMode::Fifo, limit: 120, continuous: false, size: [1280, 800] }
    }
}

impl Settings {
    /// Those of a file; what is missing there, or cannot be understood, is as at first.
    pub(crate) fn load(file: &Path) -> Self {
        let text = match std::fs::read_to_string(file) {
            Ok(text) => text,
            Err(error) => {
                tracing::debug!("{}: {error}; settings are as at first", file.display());
                return Self::default();
            }
        };
        let settings: Self = serde_json::from_str(&text).unwrap_or_else(|error| {
            tracing::warn!("{}: {error}; settings are as at first", file.display());
            Self::default()
        });
        settings.within_limits()
    }

    /// Writes them, whole or not at all.
    pub(crate) fn save(&self, file: &Path) -> io::Result<()> {
        let folder = file.parent().unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder)?;
        let mut text = serde_json::to_string_pretty(self)?;
        text.push('\n');
        let new = file.with_extension(format!("{}.new", std::process::id()));
        std::fs::write(&new, text).and_then(|()| std::fs::rename(&new, file)).inspect_err(|_| {
            let _already_gone = std::fs::remove_file(&new);
        })
    }

    /// Numbers that a file may have wrong, brought to where they work.
    fn within_limits(mut self) -> Self {
        let (look, screen) = (&mut self.look, &mut self.screen);
        look.level = if look.level.is_nan() { 8.0 } else { look.level.clamp(1.0, 64.0) };
        look.pixels = if look.pixels.is_nan() { 8.0 } else { look.pixels.clamp(1.0, 100.0) };
        look.samples = if [1, 2, 4, 8].contains(&look.samples) { look.samples } else { 4 };
        // The next model may have no maps.
        look.shade = if look.shade.is_mapped() { Shade::Lit } else { look.shade };
        screen.limit = screen.limit.min(1000);
        screen.size = screen.size.map(|side| side.clamp(320, 16384));
        self
    }
}

impl Look {
    /// Takes over what was asked for.
    pub(crate) fn take(&mut self, desc: &LookDesc) {
        let LookDesc { scheme, evaluator, level, adaptive, spacing, shade, cage } = *desc;
        self.scheme = scheme.unwrap_or(self.scheme);
        // The tessellator is what the choice of the engine comes to.
        let chosen = evaluator.map(|one| if one == Evaluator::Compute { one } else { Evaluator::Tessellator });
        self.evaluator = chosen.unwrap_or(self.evaluator);
        self.level = level.unwrap_or(self.level);
        self.adaptive = (self.adaptive && level.is_none()) || adaptive.is_some();
        self.pixels = adaptive.unwrap_or(self.pixels);
        self.spacing = spacing.unwrap_or(self.spacing);
        if let Some(shade) = shade {
            (self.wireframe, self.leaks) = (shade == Shade::Wireframe, shade == Shade::Leaks);
            self.shade = if self.wireframe || self.leaks { self.shade } else { shade };
        }
        self.cage = cage.unwrap_or(self.cage);
    }

    /// The next level in the direction of `steps`, whole numbers up to 64.
    pub(crate) fn step_level(&mut self, steps: f32) {
        let from = if steps > 0.0 { self.level.floor() } else { self.level.ceil() };
        self.level = (from + steps).clamp(1.0, 64.0);
    }

    /// What is shown: holes come before edges of triangles, and those before the shade.
    pub(crate) fn shown(&self) -> Shade {
        match (self.leaks, self.wireframe) {
            (true, _) => Shade::Leaks,
            (_, true) => Shade::Wireframe,
            _ => self.shade,
        }
    }

    /// Whether a second scheme is needed, beside the first or to measure distances to.
    pub(crate) fn is_compared(&self) -> bool {
        self.compare != Compare::Off || self.shows_difference()
    }

    /// Whether distances between two schemes are shown.
    pub(crate) fn shows_difference(&self) -> bool {
        self.shown() == Shade::Difference
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("new folder/viewer.json");
        let mut settings = Settings::default();
        settings.look =
            Look { scheme: Scheme::Biseptic, shade: Shade::Zebra, compare: Compare::Wipe, level: 3.5, ..settings.look };
        settings.screen.mode = PresentMode::Mailbox;
        settings.save(&file).unwrap();
        assert_eq!(Settings::load(&file), settings);
        assert_eq!(std::fs::read_dir(file.parent().unwrap()).unwrap().count(), 1, "nothing else is left there");
    }

    #[test]
    fn files_that_hold_something_else_do_no_harm() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("viewer.json");
        assert_eq!(Settings::load(&file), Settings::default());
        for text in ["", "{", "[]", r#"{"look": {"scheme": "nurbs"}}"#] {
            std::fs::write(&file, text).unwrap();
            assert_eq!(Settings::load(&file), Settings::default(), "{text}");
        }
        std::fs::write(
            &file,
            r#"{"look": {"level": 1e9, "samples": 3, "shade": "uv"}, "screen": {"size": [0, 0]}, "more": 1}"#,
        )
        .unwrap();
        let settings = Settings::load(&file);
        assert_eq!((settings.look.level, settings.look.samples, settings.screen.size), (64.0, 4, [320, 320]));
        assert_eq!(settings.look.shade, Shade::Lit);
    }

    #[test]
    fn levels_go_by_whole_steps() {
        let mut look = Look { level: 3.4, ..Look::default() };
        look.step_level(1.0);
        assert_eq!(look.level, 4.0);
        look.level = 3.4;
        look.step_level(-1.0);
        assert_eq!(look.level, 3.0);
        look.level = 64.0;
        look.step_level(1.0);
        assert_eq!(look.level, 64.0);
    }
}
