//! Samples of the exact limit surface, in double precision and without a device.

use crate::failure::Failure;
use osculate::{Sample, SubFace, SurfacePoint};
use osculate_cage::BoundaryRule;
use osculate_surface::reference::{Mesh, Reference};
use rayon::prelude::*;

/// The exact limit surface of a cage.
pub(crate) struct Exact<'a>(Reference<'a>);

impl<'a> Exact<'a> {
    /// Prepares to evaluate.
    pub(crate) fn new(mesh: &'a Mesh, boundary: BoundaryRule) -> Result<Self, Failure> {
        Reference::new(mesh, boundary.into()).map(Self).map_err(Failure::input)
    }

    /// Evaluates places, in parallel.
    pub(crate) fn evaluate(&self, places: &[SurfacePoint]) -> Result<Vec<Sample>, Failure> {
        places.par_iter().map(|place| self.find(place)).collect()
    }

    fn find(&self, place: &SurfacePoint) -> Result<Sample, Failure> {
        let &SurfacePoint { sub_face: SubFace { face, sub }, s, t } = place;
        let sample = self.0.eval(face as usize, sub, s, t).map_err(Failure::input)?;
        Ok(Sample {
            position: sample.position,
            du: sample.du,
            dv: sample.dv,
            normal: sample.normal,
            irregular: sample.irregular,
        })
    }
}
