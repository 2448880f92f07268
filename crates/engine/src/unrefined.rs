//! What surfaces are asked for of which faces are left unrefined ([`Refinement::WhereNeeded`](crate::Refinement::WhereNeeded)).

use crate::{EngineError, Factors, Spacing, Surface, Tessellation};

/// Most segments of refined patches beside unrefined faces, which have twice as many.
const MOST_SEGMENTS: u32 = 32;

impl Surface {
    /// Whether faces are left unrefined: only by [`Refinement::WhereNeeded`](crate::Refinement::WhereNeeded), and only if the cage has such faces.
    pub fn has_unrefined(&self) -> bool {
        self.plan().unrefined_count() > 0
    }

    /// Most segments that a side of a patch can get.
    ///
    /// # Errors
    /// If the level is out of range, or unrefined faces cannot be divided so.
    pub(crate) fn max_segments(&self, tessellation: &Tessellation) -> Result<u32, EngineError> {
        let segments = tessellation.max_segments()?;
        if !self.has_unrefined() {
            return Ok(segments);
        }
        if matches!(tessellation.factors, Factors::Adaptive { .. }) {
            return Err(EngineError::Unrefined { what: "adaptive factors (--adaptive)" });
        }
        if tessellation.spacing != Spacing::Equal {
            return Err(EngineError::Unrefined { what: "odd and even spacing (--spacing)" });
        }
        if segments > MOST_SEGMENTS {
            return Err(EngineError::Unrefined {
                what: "levels above 32 (--level), since their edges have twice as many segments",
            });
        }
        Ok(2 * segments)
    }

    /// Fails if faces are left unrefined: `what` cannot cope with that.
    pub(crate) fn refuse_unrefined(&self, what: &'static str) -> Result<(), EngineError> {
        if self.has_unrefined() { Err(EngineError::Unrefined { what }) } else { Ok(()) }
    }
}
