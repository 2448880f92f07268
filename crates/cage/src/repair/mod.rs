//! Repair: from any polygons to a manifold mesh.
//!
//! The faces are cleaned first, then half-edges at one place are joined in pairs, and only then vertices are made: one for each
//! fan of faces that pairs hold together. Welding, the splitting of edges with more than two faces and that of bow-ties are thus
//! one step: what is joined gets a common vertex, what is not gets its own. A mesh that is a cage already stays as it is, except
//! for boundaries that meet.
//!
//! Joining edges rather than vertices is the idea of Guéziec, Taubin, Lazarus and Horn, "Cutting and stitching: converting sets of
//! polygons to manifold surfaces", IEEE TVCG 7 (2001).

mod carry;
mod copies;
mod fans;
mod loops;
mod pairs;
mod places;
mod report;
#[cfg(test)]
mod tests;
mod winding;

pub use report::RepairReport;

use carry::carry;
use loops::Loops;
use pairs::Pairs;
use places::places;

use crate::progress::{Cancelled, Watch};
use crate::topology::check_rows;
use crate::{CageDesc, CageError, ReadObserver, ReadStage, Warning};

/// How a mesh is repaired.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RepairDesc {
    /// Boundary vertices at most this far apart, in units of the file, may be welded; by default 0, only those at one place.
    pub weld_tolerance: f64,
}

/// One that repairs and one that finds nothing more to do; what is fine is done after half of it.
const USUAL_PASSES: u64 = 2;
/// Joining may uncover more to join, but hardly ever twice.
const PASSES: usize = 8;

/// Makes a manifold mesh of polygons: drops faces that are degenerate or copies of others, joins boundaries that meet, separates
/// what touches only along an edge with more than two faces or in a vertex, makes the winding of each part consistent, which the
/// majority of its faces decides, and drops vertices without faces. Tags, uv and sets go along. What was done is a
/// [`Warning::Repaired`] of the result, whose elements remember their numbers in the file.
///
/// A second repair finds nothing to do.
///
/// # Errors
/// Faces that name vertices that do not exist, and data that does not have one value per face corner.
pub fn repair(desc: CageDesc, options: &RepairDesc) -> Result<CageDesc, CageError> {
    observed(desc, options, None)
}

/// [`repair`] under the eyes of an observer.
pub(crate) fn observed(
    mut desc: CageDesc,
    options: &RepairDesc,
    observer: Option<&ReadObserver>,
) -> Result<CageDesc, CageError> {
    if desc.face_offsets.is_empty() {
        desc.face_offsets.push(0);
    }
    check_rows(desc.positions.len(), &desc.face_offsets, &desc.face_vertices)?;
    if let Some(uv) = &desc.uv {
        crate::cage::check_uv(uv, desc.face_vertices.len())?;
    }
    if let Some(appearance) = &desc.appearance {
        appearance.check(desc.face_offsets.len() - 1, desc.face_vertices.len()).map_err(CageError::Appearance)?;
    }
    if let Some(rig) = &desc.rig {
        rig.check(desc.positions.len()).map_err(CageError::Rig)?;
    }
    let watch = Watch::new(observer, ReadStage::Repair, USUAL_PASSES * steps(&desc))?;
    let mut done = RepairReport::default();
    for _ in 0..PASSES {
        let (repaired, report) = pass(desc, options, &watch)?;
        desc = repaired;
        let finished = report.is_empty();
        done.add(report);
        if finished {
            break;
        }
    }
    if !done.is_empty() {
        desc.warnings.push(Warning::Repaired(Box::new(done)));
    }
    Ok(desc)
}

/// How many elements a pass looks at.
fn steps(desc: &CageDesc) -> u64 {
    let (vertices, faces, corners) = (desc.positions.len(), desc.face_offsets.len(), desc.face_vertices.len());
    (vertices + 2 * faces + 3 * corners) as u64
}

fn pass(desc: CageDesc, options: &RepairDesc, watch: &Watch) -> Result<(CageDesc, RepairReport), Cancelled> {
    let mut report = RepairReport::default();
    let places = places(&desc, options.weld_tolerance, watch)?;
    let mut loops = Loops::clean(&desc, &places, watch, &mut report)?;
    copies::drop_copies(&mut loops, watch, &mut report)?;
    let mut pairs = Pairs::default();
    let flipped = pairs.join(&desc, &loops, watch, &mut report)?;
    let fans = fans::make(&loops, &mut pairs, watch)?;
    let tags = carry::tags(&desc, &loops, &fans, &mut report);
    watch.look()?;
    carry::report(&desc, &loops, &fans, &flipped, &mut report);
    // Nothing to do leaves everything as it was, to the last number.
    let desc = if report.is_empty() { desc } else { carry(desc, tags, &loops, &fans, &flipped) };
    Ok((desc, report))
}
