//! Patches as grids of points, for the compute evaluator: where the vertices lie, which of them neighbours share, and how triangles join them.
//!
//! [`Rate`] divides one edge, [`Pattern`] joins the vertices of one patch, [`GridRates`] holds the rates of all edges, and [`GridPlan`] cuts a surface into
//! [`Chunk`]s that fit a buffer. All of it is numbers of vertices; where they lie in space is up to the kernels of shaders/evaluate.

mod chunk;
mod pattern;
mod plan;
mod rate;
mod rates;

pub(crate) use chunk::Chunk;
pub(crate) use pattern::Pattern;
pub(crate) use plan::{GridPlan, GridPlanDesc, Layout};
pub(crate) use rate::Rate;
pub(crate) use rates::GridRates;
