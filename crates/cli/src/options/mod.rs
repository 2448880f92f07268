//! Values of options, each parsed into something that cannot be wrong.

mod output;
mod scheme;

pub(crate) use output::Output;
pub(crate) use scheme::SchemeName;
