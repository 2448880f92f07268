//! Pictures in tests: drawing them, and judging several against their goldens in one go.

use std::path::Path;

use osculate::{Camera, Engine, RenderDesc, Surface, SurfaceDesc, render};
use osculate_cage::Cage;
use osculate_compare::{Goldens, Limits, Picture};

/// The picture of a cage as [`RenderDesc::fit`] has it, but for what `change` changes.
///
/// # Panics
/// If it cannot be drawn.
pub fn draw(engine: &Engine, cage: &Cage, size: [u32; 2], change: impl FnOnce(&mut RenderDesc)) -> Picture {
    let surface = Surface::new(engine, cage, &SurfaceDesc::default()).unwrap_or_else(|error| panic!("{error}"));
    let mut desc = RenderDesc::fit(cage, size);
    change(&mut desc);
    draw_surfaces(engine, &[&surface], &desc)
}

/// The picture of surfaces.
///
/// # Panics
/// If it cannot be drawn.
pub fn draw_surfaces(engine: &Engine, surfaces: &[&Surface], desc: &RenderDesc) -> Picture {
    let drawn = render(engine, surfaces, desc).unwrap_or_else(|error| panic!("{error}"));
    Picture::new(drawn.size[0], drawn.size[1], drawn.rgba).unwrap_or_else(|error| panic!("{error}"))
}

/// A camera that looks at the middle of a cage from `direction`, `distance` half diagonals away, with a field of view of `fovy` degrees.
///
/// # Panics
/// If there is no such camera.
pub fn camera(cage: &Cage, direction: [f64; 3], distance: f64, fovy: f64) -> Camera {
    let bounds = cage.bounds();
    let eye = bounds.center() + distance * bounds.half_diagonal() * glam::DVec3::from(direction).normalize();
    Camera::look_at(eye, bounds.center(), glam::DVec3::Y, fovy.to_radians(), bounds)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Pictures to be judged against `tests/goldens`; all are, before one that fails ends the test.
pub struct Gallery {
    goldens: Goldens,
    limits: Limits,
    failures: Vec<String>,
}

impl Gallery {
    /// The goldens, with the limits for the device that draws.
    pub fn new(engine: &Engine) -> Self {
        Self {
            goldens: Goldens::new(Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens")),
            limits: Limits::for_device(engine.device().info().is_llvmpipe),
            failures: Vec::new(),
        }
    }

    /// The goldens, with the limits for devices other than theirs, whatever draws.
    pub fn of_another_device() -> Self {
        Self {
            goldens: Goldens::new(Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens")),
            limits: Limits::OTHER_DEVICE,
            failures: Vec::new(),
        }
    }

    /// Judges one picture.
    pub fn check(&mut self, name: &str, picture: &Picture) {
        if let Err(error) = self.goldens.check(name, picture, &self.limits) {
            self.failures.push(error.to_string());
        }
    }

    /// Ends the judging.
    ///
    /// # Panics
    /// If a picture was not its golden.
    pub fn finish(self) {
        assert!(self.failures.is_empty(), "{}", self.failures.join("\n"));
    }
}
