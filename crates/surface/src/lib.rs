//! The mathematics of the surfaces: bases, limit masks, Gregory patches and the exact f64 reference evaluator.
//!
//! Everything the GPU computes from a patch's control points is a [`Matrix`] times the points of its net; [`net`] says
//! which nets there are, [`gregory`] generates the matrices of the Gregory schemes, [`stam`] those of the exact surface and
//! [`biseptic`] those of curvature-continuous patches.

mod angle;
pub mod bezier;
pub mod biseptic;
pub mod bspline;
pub mod gregory;
pub mod jet;
pub mod masks;
pub mod matrix;
pub mod net;
pub mod reference;
pub mod stam;

pub use matrix::Matrix;
pub use net::NetKind;
