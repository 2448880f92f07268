//! The legend of the shades `patches` and `valence` in docs/shading.md: each swatch is a patch of its kind, drawn from straight above.

use osculate::{
    BoundaryRule, Camera, CapturedVertex, Engine, EngineError, RenderDesc, Shade, Surface, SurfaceDesc, Tessellation,
};
use osculate_cage::Cage;
use osculate_compare::Picture;

use crate::picture::draw_surfaces;
use crate::zoo;

/// A colour of the legend, and where a patch of that colour is found.
pub struct Swatch {
    /// Name of the file in docs/images.
    pub name: String,
    /// Shade that it explains.
    pub shade: Shade,
    cage: Cage,
    rule: BoundaryRule,
    boundary: bool,
    edges: u32,
}

/// Every colour of the legend.
pub fn swatches() -> Vec<Swatch> {
    let swatch = |name: &str, shade: Shade, cage: Cage, boundary, edges| {
        let name = format!("swatch-{}-{name}", shade.name());
        Swatch { name, shade, cage, rule: BoundaryRule::EdgeAndCorner, boundary, edges }
    };
    let star = |edges: u32| match edges {
        2 => zoo::pillow(),
        4 => zoo::grid(3, 3),
        _ => zoo::shipped(&format!("star{edges}")),
    };
    let mut swatches: Vec<Swatch> = [Shade::Patches, Shade::Valence]
        .into_iter()
        .flat_map(|shade| {
            [2, 3, 4, 5, 6, 7, 8, 9, 12, 32].map(|edges| swatch(&edges.to_string(), shade, star(edges), false, edges))
        })
        .collect();
    for shade in [Shade::Patches, Shade::Valence] {
        swatches.push(swatch("boundary", shade, zoo::grid(3, 3), true, 3));
        swatches.push(swatch("corner", shade, zoo::grid(3, 3), true, 2));
    }
    for faces in [3, 6, 12] {
        swatches.push(swatch(
            &format!("fan-{}", faces + 1),
            Shade::Patches,
            zoo::boundary_fan(faces),
            true,
            faces as u32 + 1,
        ));
    }
    let round = swatch("round-corner", Shade::Patches, zoo::grid(3, 3), true, 2);
    swatches.push(Swatch { rule: BoundaryRule::EdgeOnly, ..round });
    swatches
}

impl Swatch {
    /// The colour as it is drawn, in a picture of 32 by 20 pixels.
    ///
    /// # Panics
    /// If it cannot be drawn.
    pub fn draw(&self, engine: &Engine) -> Picture {
        let desc = SurfaceDesc { boundary: Some(self.rule), ..SurfaceDesc::default() };
        let surface = Surface::new(engine, &self.cage, &desc).unwrap_or_else(|error| panic!("{}: {error}", self.name));
        let desc =
            RenderDesc { shade: self.shade, camera: self.above(&surface), ..RenderDesc::fit(&self.cage, [32, 20]) };
        draw_surfaces(engine, &[&surface], &desc)
    }

    /// Close above the middle of a patch of the kind.
    fn above(&self, surface: &Surface) -> Camera {
        let middle = self.middle(surface);
        let at = surface.space().leave(middle.position.into());
        let normal = glam::Vec3::from(middle.normal).as_dvec3();
        let bounds = self.cage.bounds();
        let eye = at + 0.03 * bounds.half_diagonal() * normal;
        Camera::look_at(eye, at, normal.any_orthogonal_vector(), 0.1, bounds).unwrap_or_else(|error| panic!("{error}"))
    }

    fn middle(&self, surface: &Surface) -> CapturedVertex {
        let patches = &surface.plan().patches;
        let fits = |vertex: &&CapturedVertex| {
            let patch = &patches[vertex.patch as usize];
            vertex.uv == [0.5; 2] && patch.is_boundary() == self.boundary && patch.valence() == self.edges
        };
        let mut found = None;
        let keep = |vertices: &[CapturedVertex]| {
            found = found.or_else(|| vertices.iter().find(fits).copied());
            Ok::<(), EngineError>(())
        };
        surface.capture(&Tessellation::uniform(2.0), keep).unwrap_or_else(|error| panic!("{error}"));
        found.unwrap_or_else(|| panic!("{}: its cage has no such patch", self.name))
    }
}
