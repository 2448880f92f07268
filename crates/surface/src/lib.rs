//! The mathematics of the surfaces: bases, limit masks, Gregory patches and the exact f64 reference evaluator.
