//! The commands, one file each: its options as they are typed, what they mean once validated, and the work.

pub(crate) mod bench;
pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod export;
pub(crate) mod inspect;
pub(crate) mod render;
pub(crate) mod repair;
pub(crate) mod sample;
#[cfg(feature = "viewer")]
pub(crate) mod view;
