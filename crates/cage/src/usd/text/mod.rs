//! The text form (`.usda`): "USDA" in the *USD Core Specification*, section 16.2.

mod lexer;
mod parser;
mod value;

pub(super) use parser::parse;
pub(super) use value::{numbers, words};
