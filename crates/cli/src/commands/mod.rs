//! The commands, one file each: its options as they are typed, what they mean once validated, and the work.

pub(crate) mod compare;
pub(crate) mod sample;
