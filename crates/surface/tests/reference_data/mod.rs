//! Reading the reference data of the schemes, for tests marked `#[ignore = "needs OSCULATE_REFERENCE"]`.
#![allow(dead_code, reason = "each test file uses some of these")]

use std::path::PathBuf;

use glam::DVec3;
use serde_json::Value;

/// A file of the folder that `OSCULATE_REFERENCE` names.
pub(crate) fn reference(name: &str) -> Value {
    let folder = std::env::var_os("OSCULATE_REFERENCE").expect("OSCULATE_REFERENCE names the folder of reference data");
    let path = PathBuf::from(folder).join("math").join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("array").iter().map(|x| x.as_f64().expect("number")).collect()
}

pub(crate) fn rows(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().expect("array").iter().map(numbers).collect()
}

pub(crate) fn point(value: &Value) -> DVec3 {
    DVec3::from_slice(&numbers(value))
}

pub(crate) fn net(value: &Value) -> Vec<DVec3> {
    value.as_array().expect("array").iter().map(point).collect()
}
