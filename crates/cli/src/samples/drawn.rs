//! Samples of the surface as the device draws it.

use super::{Found, Place};
use crate::failure::Failure;
use osculate::{SubFace, Surface, SurfacePoint};

/// Evaluates places on the device.
pub(crate) fn evaluate(surface: &Surface, places: &[Place]) -> Result<Vec<Found>, Failure> {
    let point = |&Place { face, sub, s, t }: &Place| SurfacePoint { sub_face: SubFace { face, sub }, s, t };
    let samples = surface.sample(&places.iter().map(point).collect::<Vec<_>>())?;
    let found = samples.into_iter().map(|sample| Found {
        position: sample.position,
        ds: sample.du,
        dt: sample.dv,
        normal: sample.normal,
        irregular: sample.irregular,
    });
    Ok(found.collect())
}
