//! The folder in which drivers' pipelines are kept from one run to the next.

use etcetera::{BaseStrategy, choose_base_strategy};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The variable that names another folder or switches the cache off.
const VARIABLE: &str = "OSCULATE_CACHE";

/// The folder: that of `OSCULATE_CACHE`, none if that is empty or `off`, else the user's cache folder.
pub(crate) fn folder() -> Option<PathBuf> {
    let user = || choose_base_strategy().ok().map(|strategy| strategy.cache_dir());
    chosen(std::env::var_os(VARIABLE), user)
}

fn chosen(variable: Option<OsString>, user: impl FnOnce() -> Option<PathBuf>) -> Option<PathBuf> {
    match variable {
        None => user().map(|folder| folder.join("osculate")),
        Some(value) if value.is_empty() || value.eq_ignore_ascii_case("off") => None,
        Some(value) => Some(Path::new(&value).to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(variable: Option<&str>) -> Option<PathBuf> {
        chosen(variable.map(OsString::from), || Some("/home/me/.cache".into()))
    }

    #[test]
    fn the_variable_comes_before_the_users_folder() {
        assert_eq!(with(None), Some("/home/me/.cache/osculate".into()));
        assert_eq!(with(Some("elsewhere")), Some("elsewhere".into()));
        assert_eq!(chosen(None, || None), None, "a user without a home keeps nothing");
    }

    #[test]
    fn the_cache_can_be_switched_off() {
        assert_eq!([with(Some("")), with(Some("off")), with(Some("OFF"))], [None, None, None]);
    }
}
