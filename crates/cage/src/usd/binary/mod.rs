//! The binary form (`.usdc`), called "crate": "USDC" in the *USD Core Specification*, section 16.3, versions 0.4 to 0.12.
//!
//! A table of contents names sections: tokens (all texts), paths (a tree of names), specs (prims and properties), and for each spec a set
//! of fields. A field has a name and a [`ValueRep`], 64 bits that hold a small value or say where the value lies. Nothing is believed
//! before the bytes are there; a decoder makes at most 1020 integers of a byte.

mod coding;
mod cursor;
mod document;
mod value;

pub(super) use document::{Tables, parse};
pub(super) use value::{ValueRep, numbers, words};

use super::UsdError;

/// The first bytes of a file.
pub(super) const MAGIC: &[u8] = b"PXR-USDC";

/// The error that something is not as it must be.
fn damaged(what: impl Into<String>) -> UsdError {
    UsdError::Crate(what.into())
}
