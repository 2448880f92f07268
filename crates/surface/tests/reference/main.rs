//! The exact evaluator against brute force and against what must hold for any limit surface.

mod brute_force;
mod cages;
mod large;
mod smoothness;
mod symmetry;
mod vertices;
