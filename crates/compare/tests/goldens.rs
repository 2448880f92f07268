//! The golden harness must fail in every case but one.

use osculate_compare::{GoldenError, Goldens, Limits, Picture, load};
use std::fs;
use tempfile::TempDir;

fn goldens(folder: &TempDir) -> Goldens {
    let [goldens, side] = ["goldens", "side"].map(|name| folder.path().join(name));
    Goldens { folder: goldens, side_folder: side, bless: false }
}

fn plain(colour: [u8; 3]) -> Picture {
    let [r, g, b] = colour;
    Picture::new(16, 16, [r, g, b, 255].repeat(256)).unwrap()
}

fn blessed(folder: &TempDir, name: &str, picture: &Picture) -> Goldens {
    let blessing = Goldens { bless: true, ..goldens(folder) };
    let error = blessing.check(name, picture, &Limits::SAME_DRIVER).unwrap_err();
    assert!(matches!(error, GoldenError::Blessed { .. }), "{error}");
    assert!(error.to_string().contains("blessed, run again"), "{error}");
    goldens(folder)
}

#[test]
fn a_missing_golden_fails_and_is_kept_aside() {
    let folder = TempDir::new().unwrap();
    let error = goldens(&folder).check("new", &plain([1, 2, 3]), &Limits::SAME_DRIVER).unwrap_err();
    assert!(matches!(error, GoldenError::Missing { .. }), "{error}");
    assert!(!folder.path().join("goldens").exists());
    assert_eq!(load(&folder.path().join("side/new.actual.png")).unwrap(), plain([1, 2, 3]));
}

#[test]
fn blessing_fails_that_run_and_passes_the_next() {
    let folder = TempDir::new().unwrap();
    let goldens = blessed(&folder, "cube", &plain([90, 90, 90]));
    let comparison = goldens.check("cube", &plain([90, 90, 90]), &Limits::SAME_DRIVER).unwrap();
    assert_eq!(comparison.max, 0.0);
    assert!(!folder.path().join("side").exists());
}

#[test]
fn a_blessing_replaces_a_golden_that_differs() {
    let folder = TempDir::new().unwrap();
    blessed(&folder, "cube", &plain([90, 90, 90]));
    let goldens = blessed(&folder, "cube", &plain([200, 0, 0]));
    assert!(goldens.check("cube", &plain([200, 0, 0]), &Limits::SAME_DRIVER).is_ok());
}

#[test]
fn a_difference_fails_with_figures_and_both_pictures() {
    let folder = TempDir::new().unwrap();
    let goldens = blessed(&folder, "cube", &plain([90, 90, 90]));
    let error = goldens.check("cube", &plain([200, 0, 0]), &Limits::OTHER_DEVICE).unwrap_err();
    assert!(matches!(error, GoldenError::Differs { .. }), "{error}");
    assert!(error.to_string().contains("mean 0."), "{error}");
    assert_eq!(load(&folder.path().join("side/cube.actual.png")).unwrap(), plain([200, 0, 0]));
    assert!(folder.path().join("side/cube.diff.png").exists());
}

#[test]
fn an_empty_or_damaged_golden_fails() {
    let folder = TempDir::new().unwrap();
    let goldens = blessed(&folder, "cube", &plain([90, 90, 90]));
    let path = folder.path().join("goldens/cube.png");
    let whole = fs::read(&path).unwrap();
    for damaged in [&[][..], &whole[..whole.len() / 2], b"not a picture"] {
        fs::write(&path, damaged).unwrap();
        let error = goldens.check("cube", &plain([90, 90, 90]), &Limits::SAME_DRIVER).unwrap_err();
        assert!(matches!(error, GoldenError::Unusable { .. }), "{error}");
        assert_eq!(fs::read(&path).unwrap(), damaged, "the golden must not be touched");
    }
}

#[test]
fn another_size_fails() {
    let folder = TempDir::new().unwrap();
    let goldens = blessed(&folder, "cube", &plain([90, 90, 90]));
    let wide = Picture::new(32, 8, [90, 90, 90, 255].repeat(256)).unwrap();
    let error = goldens.check("cube", &wide, &Limits::OTHER_DEVICE).unwrap_err();
    assert!(error.to_string().contains("16x16 and 32x8"), "{error}");
}

#[test]
fn a_golden_that_is_too_large_is_refused_on_both_ways() {
    let folder = TempDir::new().unwrap();
    // A linear congruential generator: bytes that do not compress.
    let noise = (0..4 * 256 * 256).scan(1_u32, |state, _| {
        *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        Some((*state >> 24) as u8)
    });
    let noise = Picture::new(256, 256, noise.collect()).unwrap();
    let blessing = Goldens { bless: true, ..goldens(&folder) };
    let error = blessing.check("noise", &noise, &Limits::SAME_DRIVER).unwrap_err();
    assert!(matches!(error, GoldenError::TooLarge { .. }), "{error}");
    assert!(!folder.path().join("goldens/noise.png").exists());

    fs::create_dir_all(folder.path().join("goldens")).unwrap();
    noise.write(&folder.path().join("goldens/noise.png")).unwrap();
    let error = goldens(&folder).check("noise", &noise, &Limits::SAME_DRIVER).unwrap_err();
    assert!(matches!(error, GoldenError::TooLarge { .. }), "{error}");
}

#[test]
fn names_stay_in_the_folder() {
    let folder = TempDir::new().unwrap();
    for name in ["", "../up", "a/b", "a.png"] {
        let error = goldens(&folder).check(name, &plain([0; 3]), &Limits::SAME_DRIVER).unwrap_err();
        assert!(matches!(error, GoldenError::BadName(_)), "{name}: {error}");
    }
}

#[test]
fn the_side_folder_lies_in_the_build_folder() {
    let side = osculate_compare::golden::side_folder();
    assert!(side.ends_with("goldens"));
    assert!(std::env::current_exe().unwrap().starts_with(side.parent().unwrap()));
}
