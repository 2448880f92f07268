//! The exact limit surface in f64: what every other evaluation of a cage is judged by.
//!
//! A point is found by subdividing the neighbourhood of its face, always towards the child that
//! holds the point, until that child is a regular bicubic B-spline patch; at a vertex that no such
//! patch reaches, limit masks answer. The descent works on plain averages of points, with no change
//! of basis, so that it shares nothing with the patch schemes it judges.
//!
//! * Rules: E. Catmull, J. Clark, *Recursively generated B-spline surfaces on arbitrary topological
//!   meshes*, Computer-Aided Design 10(6), 1978.
//! * Masks at interior vertices: M. Halstead, M. Kass, T. DeRose, *Efficient, fair interpolation
//!   using Catmull-Clark surfaces*, SIGGRAPH 1993, appendix A.
//!
//! | file | idea |
//! |---|---|
//! | `mesh` | the input mesh and its checks |
//! | `subdivide` | one step of subdivision of a whole mesh; the descent does not use it, tests compare the two |
//! | `topology` | half-edges: who is across an edge, which corners surround a vertex |
//! | `star` | one vertex and its ring of quads: refinement |
//! | `limit` | limit masks of a star: position, tangents, normal |
//! | `neighbourhood` | one quad and all quads that touch it: children, the regular 4 x 4 grid |
//! | `bicubic` | the uniform bicubic B-spline |
//! | `first_step` | from faces of any size to quads |
//! | `evaluator` | [`Reference`]: the descent |
//!
//! # Sampling convention
//! A quad face has `sub = -1` and (s,t) = (0,0), (1,0), (1,1), (0,1) at its vertices 0 to 3. A face
//! of any other size `n` has `sub` in `0..n`, the Catmull-Clark child quad at its vertex `sub`:
//! (0,0) is that vertex, (1,0) the midpoint of the edge to the next vertex, (1,1) the centre of the
//! face, (0,1) the midpoint of the edge to the previous vertex.

mod bicubic;
mod evaluator;
mod first_step;
mod limit;
mod mesh;
mod neighbourhood;
mod star;
mod subdivide;
mod topology;

pub use evaluator::{EvalError, Reference, Sample};
pub use mesh::{Mesh, MeshError};
pub use subdivide::Refined;

/// What happens to the surface at the boundary of the cage. Boundary edges are always refined to
/// their midpoints and boundary vertices by weights 1:6:1, which makes the boundary a uniform cubic
/// B-spline curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Boundary {
    /// A boundary vertex with only one face is a corner: it stays fixed, and the surface passes
    /// through it.
    #[default]
    EdgeAndCorner,
    /// Boundary vertices with only one face are smoothed like all others.
    EdgeOnly,
}
