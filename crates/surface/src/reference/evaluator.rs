//! The descent to a sample of the limit surface.

use glam::DVec3;

use super::first_step::FirstStep;
use super::limit::unit_cross;
use super::neighbourhood::Neighbourhood;
use super::{Boundary, Mesh, MeshError};

/// Steps after which a sample that has come no nearer to a regular patch is taken to lie on the
/// irregular vertex: its distance from it in (s,t) is then at most 2^-128, far below what f64 can
/// tell apart in position.
const MAX_STEPS: usize = 128;

/// A point of the limit surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The point, in the units of the mesh.
    pub position: DVec3,
    /// Derivative along s over the unit square of the quad (of the sub-face, for other faces).
    pub du: DVec3,
    /// Derivative along t.
    pub dv: DVec3,
    /// Unit normal, towards the side from which the faces are counter-clockwise; zero where `du` x
    /// `dv` vanishes and no limit of normals replaces it.
    pub normal: DVec3,
    /// Whether the sample is at an irregular vertex of the surface: an interior vertex of valence
    /// other than 4, or a boundary vertex of a number of faces other than 2, but for a fixed corner
    /// of one face. The centre of a face that is not a quad is such a vertex. The surface has no
    /// derivatives there (one face under [`Boundary::EdgeOnly`] excepted): `du` and `dv` span its
    /// tangent plane, along the sides of the quad where these have distinct directions, and their
    /// lengths are a convention.
    pub irregular: bool,
}

/// Why there is no sample.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EvalError {
    /// No such face.
    #[error("face {face} does not exist; the mesh has {faces} faces")]
    FaceOutOfRange {
        /// The face asked for.
        face: usize,
        /// Number of faces.
        faces: usize,
    },
    /// The sub-face does not fit the face.
    #[error(
        "face {face} with {sides} sides has no sub-face {sub}; quads take -1, other faces 0 to one less than their number of sides"
    )]
    NoSuchSubFace {
        /// The face.
        face: usize,
        /// Its number of vertices.
        sides: usize,
        /// The sub-face asked for.
        sub: i32,
    },
    /// The parameters are outside the unit square.
    #[error("parameters ({s}, {t}) are outside the unit square")]
    OutsideUnitSquare {
        /// First parameter.
        s: f64,
        /// Second parameter.
        t: f64,
    },
}

/// Evaluates the limit surface of a mesh. Holds the mesh's half-edges and a point per face and
/// vertex, and keeps nothing between samples, so it can be shared by threads; a sample costs a few
/// microseconds at low valence, in proportion to the size of the neighbourhood and to the logarithm
/// of the distance from an irregular vertex.
#[derive(Debug)]
pub struct Reference<'a> {
    mesh: &'a Mesh,
    first_step: FirstStep<'a>,
    rule: Boundary,
}

/// Where in the unit square of a neighbourhood the sample lies. Halving and doubling are exact in
/// floating point.
#[derive(Clone, Copy, Debug)]
struct Place {
    s: f64,
    t: f64,
}

impl Place {
    /// The corner of the quarter that holds the place, and the place within that quarter.
    fn quarter(self) -> (usize, Self) {
        let half = |x: f64| if x > 0.5 { (true, 2.0 * x - 1.0) } else { (false, 2.0 * x) };
        let ((right, s), (upper, t)) = (half(self.s), half(self.t));
        (corner(right, upper), Self { s, t })
    }

    /// The corner that the place is exactly at.
    fn at_corner(self) -> Option<usize> {
        let end = |x: f64| [0.0, 1.0].contains(&x).then_some(x == 1.0);
        Some(corner(end(self.s)?, end(self.t)?))
    }
}

fn corner(right: bool, upper: bool) -> usize {
    match (right, upper) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    }
}

impl<'a> Reference<'a> {
    /// Prepares to evaluate the surface of `mesh`.
    ///
    /// # Errors
    /// If the mesh is not valid.
    pub fn new(mesh: &'a Mesh, rule: Boundary) -> Result<Self, MeshError> {
        Ok(Self { mesh, first_step: FirstStep::new(mesh, rule)?, rule })
    }

    /// The limit surface of face `face`, sub-face `sub`, at (s,t) in its unit square; see the
    /// [sampling convention](super#sampling-convention).
    ///
    /// # Errors
    /// If the face or sub-face does not exist, or (s,t) is outside the unit square.
    pub fn eval(&self, face: usize, sub: i32, s: f64, t: f64) -> Result<Sample, EvalError> {
        let child = self.sub_face(face, sub)?;
        if !((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)) {
            return Err(EvalError::OutsideUnitSquare { s, t });
        }
        let origin = self.mesh.positions[self.mesh.face(face)[0] as usize];
        let quad = |corner| self.first_step.child(face, corner, origin);
        let place = Place { s, t };
        let descent = match child {
            Some(child) => Descent { quad: quad(child), place, origin, scale: 1.0 },
            None => {
                let (corner, place) = place.quarter();
                Descent { quad: quad(corner).turned(corner), place, origin, scale: 2.0 }
            }
        };
        Ok(descent.run(self.rule))
    }

    /// The child that `sub` names, `None` for the whole of a quad.
    fn sub_face(&self, face: usize, sub: i32) -> Result<Option<usize>, EvalError> {
        let faces = self.mesh.face_count();
        if face >= faces {
            return Err(EvalError::FaceOutOfRange { face, faces });
        }
        let sides = self.mesh.face(face).len();
        match usize::try_from(sub) {
            Err(_) if sides == 4 && sub == -1 => Ok(None),
            Ok(child) if sides != 4 && child < sides => Ok(Some(child)),
            _ => Err(EvalError::NoSuchSubFace { face, sides, sub }),
        }
    }
}

/// A quad on the way down, and the sample's place in it.
struct Descent {
    quad: Neighbourhood,
    place: Place,
    /// Where the zero of the quad's points is.
    origin: DVec3,
    /// How many times longer a derivative over the sample's unit square is than one over the
    /// quad's.
    scale: f64,
}

impl Descent {
    fn run(mut self, rule: Boundary) -> Sample {
        for _ in 0..MAX_STEPS {
            if let Some(sample) = self.regular_sample(rule) {
                return sample;
            }
            let at = self.place.at_corner();
            if let Some(corner) = at.filter(|&corner| !self.quad.stars[corner].is_regular(rule)) {
                return self.vertex_sample(corner, rule);
            }
            self.step(rule);
        }
        self.vertex_sample(self.quad.irregular_corner(rule).unwrap_or_default(), rule)
    }

    fn step(&mut self, rule: Boundary) {
        self.recentre(rule);
        let (corner, place) = self.place.quarter();
        self.quad = self.quad.child(corner, rule);
        self.place = place;
        self.scale *= 2.0;
    }

    /// Puts the zero at the limit of the irregular vertex. The quad shrinks towards that point, and
    /// rounding errors, which are relative to the distance from zero, shrink with it: directions
    /// stay accurate at any depth.
    fn recentre(&mut self, rule: Boundary) {
        if let Some(corner) = self.quad.irregular_corner(rule) {
            let limit = self.quad.stars[corner].limit_position(rule);
            self.quad.subtract(limit);
            self.origin += limit;
        }
    }

    fn regular_sample(&self, rule: Boundary) -> Option<Sample> {
        let jet = self.quad.regular_grid(rule)?.eval(self.place.s, self.place.t);
        Some(Sample {
            position: self.origin + jet.position,
            du: self.scale * jet.ds,
            dv: self.scale * jet.dt,
            normal: unit_cross(jet.ds, jet.dt),
            irregular: false,
        })
    }

    fn vertex_sample(&self, corner: usize, rule: Boundary) -> Sample {
        let star = &self.quad.stars[corner];
        let tangents = star.limit_tangents(rule);
        let (leaving, arriving) = (self.scale * tangents.leaving, self.scale * tangents.arriving);
        // Side k leaves corner k: along s, t, -s, -t.
        let (du, dv) = match corner {
            0 => (leaving, arriving),
            1 => (-arriving, leaving),
            2 => (-leaving, -arriving),
            _ => (arriving, -leaving),
        };
        Sample { position: self.origin + star.limit_position(rule), du, dv, normal: tangents.normal, irregular: true }
    }
}
