//! The test harness: device, zoo of cages, reference data, image comparison.
