//! Pictures that must be refused, and the few that must pass: a comparer that accepts everything would make every
//! golden worthless.

use osculate_compare::{CompareDesc, CompareError, Comparison, Limits, Picture, compare};

const SIDE: u32 = 64;

/// A lit ball on grey: smooth shading, a silhouette and a flat background, as in the pictures this is used for.
fn ball(colour: [f32; 3]) -> Picture {
    let pixel = |index: u32| {
        let [x, y] = [index % SIDE, index / SIDE].map(|i| (i as f32 + 0.5) / SIDE as f32 * 2.4 - 1.2);
        let z2 = 1.0 - x * x - y * y;
        let lit = (0.3 * x - 0.4 * y + z2.max(0.0).sqrt()).max(0.1);
        let shade = |c: f32| {
            if z2 > 0.0 { (c * lit * 230.0) as u8 } else { 60 }
        };
        [shade(colour[0]), shade(colour[1]), shade(colour[2]), 255]
    };
    Picture::new(SIDE, SIDE, (0..SIDE * SIDE).flat_map(pixel).collect()).unwrap()
}

fn reference() -> Picture {
    ball([0.8, 0.5, 0.2])
}

/// A picture whose pixel (x, y) is made from the reference.
fn remade(pixel: impl Fn(&dyn Fn(u32, u32) -> [u8; 4], u32, u32) -> [u8; 4]) -> Picture {
    let from = reference();
    let at = |x: u32, y: u32| {
        let start = 4 * (y * SIDE + x) as usize;
        from.rgba()[start..start + 4].try_into().unwrap()
    };
    let rgba = (0..SIDE * SIDE).flat_map(|i| pixel(&at, i % SIDE, i / SIDE));
    Picture::new(SIDE, SIDE, rgba.collect()).unwrap()
}

fn compared(a: &Picture, b: &Picture) -> Comparison {
    compare(a, b, &CompareDesc::default()).unwrap()
}

/// Both orders, under the widest limits that any golden gets.
fn assert_refused(what: &str, other: &Picture) {
    for (a, b) in [(&reference(), other), (other, &reference())] {
        let comparison = compared(a, b);
        let Comparison { mean, p99, max, alpha, .. } = comparison;
        let verdict = Limits::OTHER_DEVICE.check(&comparison);
        assert!(verdict.is_err(), "{what} passed: mean {mean}, p99 {p99}, max {max}, alpha {alpha}");
    }
}

#[test]
fn equal_pictures_pass_with_zeros() {
    let comparison = compared(&reference(), &reference());
    assert_eq!((comparison.mean, comparison.p99, comparison.max, comparison.alpha), (0.0, 0.0, 0.0, 0));
    assert!(Limits::SAME_DRIVER.check(&comparison).is_ok());
    assert!(Limits { mean: 0.0, p99: 0.0 }.check(&comparison).is_ok());
}

#[test]
fn roundings_pass() {
    let rounded = remade(|at, x, y| {
        let step = u8::from((x * 7 + y * 13) % 97 == 0);
        at(x, y).map(|c| c.saturating_add(step))
    });
    assert_ne!(rounded, reference());
    assert!(Limits::SAME_DRIVER.check(&compared(&reference(), &rounded)).is_ok());
}

#[test]
fn shifted_is_refused() {
    assert_refused("one pixel to the right", &remade(|at, x, y| at(x.saturating_sub(1), y)));
    assert_refused("one pixel down", &remade(|at, x, y| at(x, y.saturating_sub(1))));
}

#[test]
fn recoloured_is_refused() {
    assert_refused("another colour", &ball([0.7, 0.6, 0.2]));
    assert_refused("a tenth darker", &ball([0.72, 0.45, 0.18]));
}

#[test]
fn swapped_is_refused() {
    let channels = remade(|at, x, y| {
        let [r, g, b, a] = at(x, y);
        [b, g, r, a]
    });
    assert_refused("red and blue swapped", &channels);
    assert_refused("left and right swapped", &remade(|at, x, y| at(SIDE - 1 - x, y)));
    assert_refused("top and bottom swapped", &remade(|at, x, y| at(x, SIDE - 1 - y)));
    assert_refused("another picture in its place", &ball([0.2, 0.5, 0.8]));
}

#[test]
fn alpha_only_is_refused() {
    let with_alpha = |alpha: u8| {
        remade(move |at, x, y| {
            let [r, g, b, _] = at(x, y);
            [r, g, b, alpha]
        })
    };
    assert_refused("half transparent", &with_alpha(128));
    assert_refused("transparent", &with_alpha(0));
    assert_eq!(compared(&reference(), &with_alpha(128)).alpha, 127);
}

#[test]
fn alpha_of_black_and_of_white_is_refused() {
    // Black over black and white over white hide alpha: one background alone would miss one of these.
    for grey in [0, 255] {
        let flat = |alpha| Picture::new(8, 8, [grey, grey, grey, alpha].repeat(64)).unwrap();
        assert!(Limits::OTHER_DEVICE.check(&compared(&flat(255), &flat(100))).is_err(), "grey {grey}");
    }
}

#[test]
fn a_small_hole_is_refused() {
    // 2 % of the pixels: next to nothing for the mean, but not for the 99th percentile.
    let hole =
        remade(|at, x, y| if (28..37).contains(&x) && (28..37).contains(&y) { [60, 60, 60, 255] } else { at(x, y) });
    assert_refused("a hole", &hole);
}

#[test]
fn wrong_size_is_an_error_that_names_both() {
    let small = Picture::new(SIDE, SIDE - 1, vec![0; 4 * (SIDE * (SIDE - 1)) as usize]).unwrap();
    let error = compare(&reference(), &small, &CompareDesc::default()).unwrap_err();
    assert!(matches!(error, CompareError::SizesDiffer { .. }));
    assert_eq!(error.to_string(), "the pictures differ in size: 64x64 and 64x63");
}

#[test]
fn the_difference_picture_shows_where() {
    let hole = remade(|at, x, y| if x < 4 && y < 4 { [0, 255, 255, 255] } else { at(x, y) });
    let picture = compared(&reference(), &hole).picture();
    let brightness = |index: usize| picture.rgba()[4 * index..4 * index + 3].iter().map(|&c| u32::from(c)).sum::<u32>();
    assert!(brightness(0) > 300, "{}", brightness(0));
    let last = (SIDE * SIDE - 1) as usize;
    assert!(brightness(last) < 30, "{}", brightness(last));
}
