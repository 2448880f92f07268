//! Perceptual comparison of pictures by FLIP, for golden images and for users.
//!
//! Two pictures are compared with FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild,
//! *FLIP: A Difference Evaluator for Alternating Images*, HPG 2020), which answers per pixel how visible a
//! difference is to someone who flips between the two: 0 is equal, 1 the largest difference there is.
//!
//! ```
//! use osculate_compare::{CompareDesc, Limits, Picture, compare};
//!
//! let grey = Picture::new(2, 2, vec![128; 16])?;
//! let comparison = compare(&grey, &grey, &CompareDesc::default())?;
//! assert!(Limits::for_device(true).check(&comparison).is_ok());
//! # Ok::<(), osculate_compare::CompareError>(())
//! ```
//!
//! * [`picture`]: the RGBA8 pictures, read and written as PNG.
//! * [`flip`]: the comparison itself.
//! * [`limits`]: what counts as the same picture, per class of device.
//! * [`golden`]: pictures kept beside the tests, and what happens when they are missing or differ.
//! * [`whole_file`]: files that appear whole or not at all.

pub mod flip;
pub mod golden;
pub mod limits;
pub mod picture;
pub mod whole_file;

pub use flip::{CompareDesc, Comparison, compare};
pub use golden::{GoldenError, Goldens};
pub use limits::{Excess, Limits};
pub use picture::{CompareError, Picture, load};
