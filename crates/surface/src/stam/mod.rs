//! Exact evaluation of the limit surface beside an irregular vertex, in the eigenbasis of subdivision.
//!
//! J. Stam, *Exact Evaluation of Catmull-Clark Subdivision Surfaces at Arbitrary Parameter Values* (1998), on the net of
//! C. Loop, *Hardware Subdivision and Tessellation of Catmull-Clark Surfaces*, MSR-TR-2010-163, section 4.2; boundaries and
//! creases in the spirit of D. Zorin and D. Kristjansson, *Evaluation of Piecewise Smooth Subdivision Surfaces* (2002).
//! Symbols kept: A (one step on the net), V, Lambda (J here, where A is defective), phi (eigenbasis functions).
//!
//! # Derivation
//! One step of subdivision turns the net C of a patch into the net `A C` of its quarter at V, and into three regular
//! sub-patches. A point at (u, v) lies in a sub-patch of level m, after `m` steps and one more, so with `A = V J V^-1`
//! and coefficients `p = V^-1 C`
//! ```text
//! S(u, v) = sum_i phi_{s,i}(a, b) (J^m p)_i        (a, b) in the unit square of sub-patch s
//! ```
//! where `phi_{s,i}` is the bicubic whose B-spline points are column i of V subdivided once. See [`Patch`].
//!
//! **V is built, not found.** A has many equal eigenvalues, and some kinds of net make it defective; a general solver
//! returns vectors that are useless to invert. A is block triangular: the ring of V refines into itself and its modes
//! are Fourier waves (`ring`), the outer points add seven fixed vectors at most (`outer`), and a ring mode is continued
//! to the outer points by solving in the latter. V^-1 is then an ordinary inverse; `A V = V J` holds to 1e-15 and
//! the entries of V^-1 stay below 10 (42 at valence 3).
//!
//! **One coupled pair.** J is diagonal but for at most one 2 x 2 Jordan block, `A v3 = lambda (v3 + kappa v2)`: in
//! sectors of k faces with k odd (lambda = 1/4) or a multiple of 4 (1/2), and at interior valence 2, where the wave of
//! eigenvalue 1/8 meets that of the outer points. Then `(J^m p)_2 = lambda^m (p2 + m kappa p3)`; kappa is
//! [`Patch::coupling`]. Differs from Stam §3, which treats closed rings of three faces or more, where A diagonalises.
//!
//! **Near V.** With lambda the dominant eigenvalue (mode 1) and mu the next, the sum is kept as
//! ```text
//! S = p0 + lambda^m phi_1 p1 + mu^m R,        R = sum_{i >= 2} (lambda_i / mu)^m phi_i q_i,  q2 = p2 + m kappa p3
//! S_u x S_v ~ p1 x (phi_1u R_v - phi_1v R_u) + (mu/lambda)^m R_u x R_v
//! ```
//! where the second line is the cross product over `4^(m+1) (lambda mu)^m`. All weights are at most 1, so nothing
//! overflows at any depth, and the product of p1 with itself, which would be all rounding error where `mu/lambda` is
//! small, is left out.
//!
//! **V subtracted.** Points enter as differences to the net's first point, and rows of V^-1 but the first sum to zero:
//! a net far from the origin loses no more than half an ulp of its coordinates.
//!
//! # Sides
//! A point on a side that leaves V comes from a [`Side`], which both patches of an edge share, not from either patch;
//! the sides beyond have the cubic records of [`crate::gregory::edge`], and V the record of [`crate::gregory::vertex`].
//!
//! # On the device
//! [`Table`] holds all this in f32 and [`twin`] evaluates from it, operation by operation.

mod eigen;
mod outer;
mod patch;
mod place;
mod refine;
mod ring;
mod side;
mod table;
pub mod twin;

pub use patch::Patch;
pub use side::{Side, SidePoint};
pub use table::{HEADER, Table, ratios_size};
