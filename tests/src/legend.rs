//! The legends in docs/shading.md: each swatch is a patch of its kind, or a place of its curvature, drawn from straight above.

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
    place: Place,
    tessellation: Tessellation,
}

/// Where on its cage a swatch is.
enum Place {
    /// In the middle of a patch, at the boundary or not, with so many edges at its corner.
    Patch { boundary: bool, edges: u32 },
    /// In the middle of the patch that faces straight upwards.
    Top,
}

/// Every colour of the legend.
pub fn swatches() -> Vec<Swatch> {
    let swatch = |name: &str, shade: Shade, cage: Cage, boundary, edges| {
        let name = format!("swatch-{}-{name}", shade.name());
        let (rule, place) = (BoundaryRule::EdgeAndCorner, Place::Patch { boundary, edges });
        Swatch { name, shade, cage, rule, place, tessellation: Tessellation::default() }
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
    swatches.extend(CURVATURES.iter().map(|&(name, shade, curvatures)| Swatch {
        name: format!("swatch-{}-{name}", shade.name()),
        shade,
        cage: zoo::paraboloid(curvatures),
        rule: BoundaryRule::EdgeAndCorner,
        place: Place::Top,
        tessellation: Tessellation::default(),
    }));
    swatches.extend([1, 2, 4, 8, 16, 32, 64].map(|level| Swatch {
        tessellation: Tessellation::uniform(level as f32),
        ..swatch(&level.to_string(), Shade::Factors, zoo::grid(3, 3), false, 4)
    }));
    swatches
}

/// The swatches of curvature: name, shade, the two principal curvatures times the half diagonal of the cage's box, positive where hollow.
const CURVATURES: [(&str, Shade, [f64; 2]); 14] = [
    ("hollow-20", Shade::Curvature, [20.0; 2]),
    ("hollow-5", Shade::Curvature, [5.0; 2]),
    ("hollow-1", Shade::Curvature, [1.0; 2]),
    ("flat", Shade::Curvature, [4.0, -4.0]),
    ("bulging-1", Shade::Curvature, [-1.0; 2]),
    ("bulging-5", Shade::Curvature, [-5.0; 2]),
    ("bulging-20", Shade::Curvature, [-20.0; 2]),
    ("saddle-20", Shade::Gaussian, [20.0, -20.0]),
    ("saddle-5", Shade::Gaussian, [5.0, -5.0]),
    ("saddle-1", Shade::Gaussian, [1.0, -1.0]),
    ("flat", Shade::Gaussian, [5.0, 0.0]),
    ("dome-1", Shade::Gaussian, [-1.0; 2]),
    ("dome-5", Shade::Gaussian, [-5.0; 2]),
    ("dome-20", Shade::Gaussian, [-20.0; 2]),
];

impl Swatch {
    /// The colour as it is drawn, in a picture of 32 by 20 pixels.
    ///
    /// # Panics
    /// If it cannot be drawn.
    pub fn draw(&self, engine: &Engine) -> Picture {
        let desc = SurfaceDesc { boundary: Some(self.rule), ..SurfaceDesc::default() };
        let surface = Surface::new(engine, &self.cage, &desc).unwrap_or_else(|error| panic!("{}: {error}", self.name));
        let camera = self.above(&surface);
        let fit = RenderDesc::fit(&self.cage, [32, 20]);
        let desc = RenderDesc { shade: self.shade, tessellation: self.tessellation, camera, ..fit };
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
            let wanted = match self.place {
                Place::Patch { boundary, edges } => patch.is_boundary() == boundary && patch.valence() == edges,
                Place::Top => vertex.normal[1] > 1.0 - 1e-6,
            };
            vertex.uv == [0.5; 2] && wanted
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
