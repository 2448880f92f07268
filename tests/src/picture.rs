//! Pictures in tests: drawing them, and judging several against their goldens in one go.

use std::path::Path;

use glam::DVec3;
use osculate::{
    Animator, Camera, Difference, Engine, RenderDesc, Scheme, Shade, Surface, SurfaceDesc, Tessellation, render,
    render_difference,
};
use osculate_cage::Cage;
use osculate_compare::{Goldens, Limits, Picture};

use crate::zoo;

/// The picture of a cage as [`RenderDesc::fit`] has it, but for what `change` changes.
///
/// # Panics
/// If it cannot be drawn.
pub fn draw(engine: &Engine, cage: &Cage, size: [u32; 2], change: impl FnOnce(&mut RenderDesc)) -> Picture {
    draw_scheme(engine, cage, Scheme::default(), size, change)
}

/// The same in any scheme.
///
/// # Panics
/// If it cannot be drawn.
pub fn draw_scheme(
    engine: &Engine,
    cage: &Cage,
    scheme: Scheme,
    size: [u32; 2],
    change: impl FnOnce(&mut RenderDesc),
) -> Picture {
    let desc = SurfaceDesc { scheme, ..SurfaceDesc::default() };
    let surface = Surface::new(engine, cage, &desc).unwrap_or_else(|error| panic!("{error}"));
    let mut desc = RenderDesc::fit(cage, size);
    change(&mut desc);
    draw_surfaces(engine, &[&surface], &desc)
}

/// The picture of the distance between two schemes, and what it measured.
///
/// # Panics
/// If it cannot be drawn.
pub fn draw_difference(
    engine: &Engine,
    cage: &Cage,
    schemes: [Scheme; 2],
    range: Option<f64>,
    desc: &RenderDesc,
) -> (Picture, Difference) {
    let surfaces = schemes.map(|scheme| {
        Surface::new(engine, cage, &SurfaceDesc { scheme, ..SurfaceDesc::default() })
            .unwrap_or_else(|error| panic!("{error}"))
    });
    let (drawn, difference) =
        render_difference(engine, surfaces.each_ref(), desc, range).unwrap_or_else(|error| panic!("{error}"));
    (Picture::new(drawn.size[0], drawn.size[1], drawn.rgba).unwrap_or_else(|error| panic!("{error}")), difference)
}

/// Pictures of a cage as its first animation has it at some times in seconds.
///
/// # Panics
/// If they cannot be drawn.
pub fn draw_moments(
    engine: &Engine,
    cage: &Cage,
    desc: &RenderDesc,
    times: impl IntoIterator<Item = f64>,
) -> Vec<Picture> {
    let mut surface = Surface::new(engine, cage, &SurfaceDesc::default()).unwrap_or_else(|error| panic!("{error}"));
    let mut animator = Animator::new(&surface, cage).unwrap_or_else(|error| panic!("{error}"));
    let draw = |time| {
        animator.set_time(0, time).unwrap_or_else(|error| panic!("{error}"));
        surface.animate(&animator).unwrap_or_else(|error| panic!("{error}"));
        draw_surfaces(engine, &[&surface], desc)
    };
    times.into_iter().map(draw).collect()
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
    let eye = bounds.center() + distance * bounds.half_diagonal() * DVec3::from(direction).normalize();
    Camera::look_at(eye, bounds.center(), DVec3::Y, fovy.to_radians(), bounds).unwrap_or_else(|error| panic!("{error}"))
}

/// An extraordinary vertex from close by: of a shipped cage, or `fan`, `pole`, `saddle8`, `saddle12`.
///
/// # Panics
/// If it cannot be drawn.
pub fn close_up(engine: &Engine, name: &str, scheme: Scheme, shade: Shade, size: [u32; 2]) -> Picture {
    let above = [0.2, 1.0, 0.55];
    let (cage, at, from, distance) = match name {
        "fan" => (zoo::boundary_fan(6), [0.0, 0.1, -0.35], above, 1.7),
        "pole" => (zoo::shipped("uvsphere"), [0.0, 0.9, 0.0], above, 1.7),
        "dragon" => (zoo::shipped(name), [0.0, 1.5, 0.75], [0.45, 0.3, 1.0], 1.9),
        "shell" => (zoo::shipped(name), [-0.1, 0.1, 0.0], [0.8, 1.0, 1.2], 2.9),
        "triangles" => (zoo::shipped(name), [0.0; 3], [1.0, 0.75, 1.5], 3.3),
        "saddle8" => (zoo::saddle(8), [0.0; 3], above, 1.7),
        "saddle12" => (zoo::saddle(12), [0.0; 3], above, 1.7),
        _ => (zoo::shipped(name), [0.0, 0.25, 0.1], above, 1.7),
    };
    let (at, from) = (DVec3::from(at), DVec3::from(from));
    let eye = at + distance * from.normalize();
    let camera =
        Camera::look_at(eye, at, DVec3::Y, 40f64.to_radians(), cage.bounds()).unwrap_or_else(|error| panic!("{error}"));
    draw_scheme(engine, &cage, scheme, size, |desc| {
        (desc.camera, desc.shade) = (camera, shade);
        desc.tessellation = Tessellation::uniform(if cage.face_count() < 80 { 24.0 } else { 8.0 });
    })
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
