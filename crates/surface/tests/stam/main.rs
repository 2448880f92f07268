//! Stam's evaluation against refinement, against reference data from another implementation, and sides against the
//! patches that share them. Run with `--nocapture` to see the figures.

mod data;
mod exact;
mod fixtures;
#[path = "../reference_data/mod.rs"]
mod reference_data;
mod sides;
#[path = "../star/mod.rs"]
mod star;
mod twin;
