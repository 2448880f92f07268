/// Why a cage cannot become a plan.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The refined mesh has more elements than 32-bit indices can name.
    #[error("the cage is too large: {what} would number {count}, the limit is {limit}; split the cage into parts")]
    TooLarge {
        /// The kind of element.
        what: &'static str,
        /// How many there would be.
        count: u64,
        /// How many are possible.
        limit: u64,
    },
    /// Vertices or faces with very many edges ask for too much memory.
    #[error(
        "the cage has a vertex or face with {valence} edges; tables for such take {count} numbers, the limit is {limit}: spread the edges over several vertices"
    )]
    HighValence {
        /// The highest valence after the first step.
        valence: u32,
        /// Numbers needed.
        count: u64,
        /// Most numbers.
        limit: u64,
    },
    /// Faces of parts of cages would be left unrefined.
    #[error(
        "faces of a cage in parts cannot be left unrefined: take Refinement::Everywhere (--refine everywhere), or draw the cage as a whole (without --part-faces), if the device has room for it"
    )]
    UnrefinedParts,
    /// Nothing is left to draw.
    #[error(
        "no face is left to draw: all {faces} faces are holes or touch the boundary under the boundary rule `none`; use --boundary edge-and-corner"
    )]
    NothingToDraw {
        /// Faces of the cage.
        faces: usize,
    },
}
