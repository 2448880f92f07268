//! Refinement tables and patch plans of a cage.
