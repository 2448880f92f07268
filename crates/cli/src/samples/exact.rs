//! Samples of the exact limit surface, in double precision and without a device.

use super::{Found, Place};
use crate::failure::Failure;
use osculate_cage::{BoundaryRule, Cage};
use osculate_surface::reference::{Boundary, Mesh, Reference};
use rayon::prelude::*;

/// The cage in the form that the reference evaluator takes.
pub(crate) fn mesh(cage: &Cage) -> Mesh {
    Mesh {
        positions: cage.positions().to_vec(),
        face_offsets: cage.face_offsets().to_vec(),
        face_vertices: cage.face_vertices().to_vec(),
    }
}

/// The exact limit surface of a cage.
pub(crate) struct Exact<'a>(Reference<'a>);

impl<'a> Exact<'a> {
    /// Prepares to evaluate.
    pub(crate) fn new(mesh: &'a Mesh, boundary: BoundaryRule) -> Result<Self, Failure> {
        let rule = match boundary {
            BoundaryRule::EdgeAndCorner => Boundary::EdgeAndCorner,
            // Without faces at the boundary there is no surface that would depend on a rule.
            BoundaryRule::EdgeOnly | BoundaryRule::None => Boundary::EdgeOnly,
        };
        Reference::new(mesh, rule).map(Self).map_err(Failure::input)
    }

    /// Evaluates places, in parallel.
    pub(crate) fn evaluate(&self, places: &[Place]) -> Result<Vec<Found>, Failure> {
        places.par_iter().map(|place| self.find(place)).collect()
    }

    fn find(&self, place: &Place) -> Result<Found, Failure> {
        let &Place { face, sub, s, t } = place;
        let sample = self.0.eval(face as usize, sub, s, t).map_err(Failure::input)?;
        Ok(Found {
            position: sample.position,
            ds: sample.du,
            dt: sample.dv,
            normal: sample.normal,
            irregular: sample.irregular,
        })
    }
}
