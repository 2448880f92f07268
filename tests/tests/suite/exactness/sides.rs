//! Normals on the sides of patches: what the patch's formula has there, and what the record has that is drawn.

use osculate::{Cage, Surface};
use osculate_shaders::layout::SampleRequest;
use osculate_subdiv::PatchForm;
use osculate_tests::exact::evaluate;

use super::judge::largest_coordinate;

/// Where sides are sampled.
const PARAMETERS: [f32; 4] = [0.002, 0.25, 0.6, 0.98];

/// Largest gap of normals where patches are large, and what is added for small ones: in eps times the largest coordinate over the height of the patch. Both
/// the patch and the record were rounded, so this is twice what either may be off.
const NORMAL: [f64; 2] = [1e-5, 8.0];

/// Compares patches of a form on all their sides; returns at how many points, or where they differ. Records have one writer, so patches that agree with them
/// agree with each other.
pub(super) fn compare_normals(name: &str, cage: &Cage, surface: &Surface, form: PatchForm) -> Result<usize, String> {
    let on_sides = |patch_id: u32| {
        // Opposite corner 0 of a triangle coordinates sum to 1 exactly.
        let at = move |t: f32| match form {
            PatchForm::Triangle => vec![(t, 0.0), (1.0 - t, 1.0 - (1.0 - t)), (0.0, t)],
            _ => vec![(t, 0.0), (1.0, t), (t, 1.0), (0.0, t)],
        };
        PARAMETERS.into_iter().flat_map(at).map(move |(u, v)| SampleRequest { patch_id, u, v })
    };
    let of_form = (0..).zip(&surface.plan().patches).filter(|(_, record)| record.kind().form() == form);
    let requests: Vec<SampleRequest> = of_form.flat_map(|(id, _)| on_sides(id)).collect();
    let rounding = f64::from(f32::EPSILON) * largest_coordinate(cage, surface);
    for (request, point) in requests.iter().zip(evaluate(surface, &requests)) {
        let plane = point.du.cross(point.dv);
        let height = plane.length() / point.du.length().max(point.dv.length());
        let error = (plane.normalize_or_zero() - point.normal).length();
        let allowed = NORMAL[0] + NORMAL[1] * rounding / height;
        if error > allowed {
            return Err(format!("{name}, {request:?}: normals differ by {error:e}, allowed {allowed:e}"));
        }
    }
    Ok(requests.len())
}
