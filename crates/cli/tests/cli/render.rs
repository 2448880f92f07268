//! `osculate render`.

use crate::support::{CAGE, osculate};
use osculate_compare::{Picture, load};
use std::fs;
use tempfile::{TempDir, tempdir};

fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("cage.obj"), CAGE).unwrap();
    folder
}

fn render(folder: &TempDir, more: &[&str]) -> Picture {
    let fixed = ["render", "cage.obj", "-o", "out.png", "--size", "64x48"];
    let ran = osculate(folder.path(), &[&fixed[..], more].concat()).exits(0);
    assert_eq!((ran.stdout.as_str(), ran.stderr.as_str()), ("", ""));
    load(&folder.path().join("out.png")).unwrap()
}

fn pixel(picture: &Picture, x: usize, y: usize) -> [u8; 4] {
    picture.pixels().nth(y * picture.size().width as usize + x).unwrap()
}

#[test]
fn the_surface_is_in_the_middle_of_a_picture_of_that_size() {
    let picture = render(&folder(), &[]);
    assert_eq!(picture.size().to_string(), "64x48");
    assert_ne!(pixel(&picture, 32, 24), pixel(&picture, 0, 0));
    assert_eq!(pixel(&picture, 0, 0), pixel(&picture, 63, 0));
}

/// Triangles may be put together differently, which shows in few pixels.
#[test]
fn evaluators_give_the_same_picture() {
    let folder = folder();
    let [tessellator, compute] = ["tessellator", "compute"].map(|name| render(&folder, &["--evaluator", name]));
    let near = |(a, b): &([u8; 4], [u8; 4])| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 8);
    let same = tessellator.pixels().zip(compute.pixels()).filter(near).count();
    assert!(same >= 64 * 48 * 98 / 100, "only {same} pixels are alike");
    assert_ne!(pixel(&compute, 32, 24), pixel(&compute, 0, 0));
}

#[test]
fn every_shade_gives_another_picture() {
    let folder = folder();
    let shades = ["lit", "normals", "patches", "valence", "wireframe", "zebra", "curvature", "peer"];
    // Few triangles: where they are hardly wider than a pixel, the wireframe fades away.
    let render = |more: &[&str]| render(&folder, &[&["--level", "2"], more].concat());
    let pictures = shades.map(|shade| render(&["--shade", shade]));
    for (i, picture) in pictures.iter().enumerate() {
        assert!(!pictures[..i].contains(picture), "{} is as one before", shades[i]);
    }
    assert_ne!(render(&["--cage"]), pictures[0]);
    assert_ne!(render(&["--samples", "1"]), pictures[0]);
}

#[test]
fn backgrounds_are_the_colours_that_were_asked_for() {
    let folder = folder();
    for shade in ["lit", "peer"] {
        let corner = |colour| pixel(&render(&folder, &["--shade", shade, "--background", colour]), 0, 0);
        assert_eq!(corner("#4080c0"), [0x40, 0x80, 0xc0, 255], "{shade}");
        assert_eq!(corner("transparent"), [0; 4], "{shade}");
    }
    assert_eq!(pixel(&render(&folder, &["--shade", "peer"]), 0, 0), [26, 26, 26, 255]);
}

#[test]
fn the_camera_looks_where_it_is_told() {
    let folder = folder();
    let middle = |camera| pixel(&render(&folder, &["--camera", camera, "--background", "white"]), 32, 24);
    assert_eq!(middle("-1,0.5,5:3,0.5,0:0,1,0:45"), [255; 4]);
    assert_ne!(middle("-1,0.5,5:1,0.5,0:0,1,0:45"), [255; 4]);
    let fit = render(&folder, &["--fit"]);
    assert_eq!(fit, render(&folder, &[]));
}

#[test]
fn pictures_repeat_bit_for_bit() {
    let folder = folder();
    let arguments = ["--adaptive", "5", "--spacing", "odd"];
    assert_eq!(render(&folder, &arguments), render(&folder, &arguments));
}

#[test]
fn distances_between_schemes_are_drawn_and_printed() {
    let folder = folder();
    let draw = |more: &[&str]| {
        let fixed = ["render", "cage.obj", "-o", "out.png", "--size", "64x48", "--level", "4", "--shade", "difference"];
        let ran = osculate(folder.path(), &[&fixed[..], more].concat()).exits(0);
        assert_eq!(ran.stderr, "");
        (ran.stdout, load(&folder.path().join("out.png")).unwrap())
    };
    let (line, picture) = draw(&[]);
    assert!(line.starts_with("gregory2 to stam: largest distance ") && line.lines().count() == 1, "{line}");
    let (near, same) = draw(&["--scheme", "stam", "--against", "stam", "--range", "0.5"]);
    assert!(near.starts_with("stam to stam: ") && near.contains("colours end at 5.000e-1"), "{near}");
    assert!(picture != same, "nothing is coloured");
    let fails = |more: &[&str], part| {
        osculate(folder.path(), &[&["render", "cage.obj", "-o", "no.png"], more].concat()).fails(2, part);
    };
    fails(&["--against", "stam"], "--against is for the shade difference alone");
    fails(&["--range", "1"], "--range is for the shade difference alone");
    fails(&["--shade", "difference", "--range", "0"], "greater than 0");
    fails(&["--shade", "difference", "--against", "table"], "table");
}

#[test]
fn what_cannot_be_drawn_exits_before_or_after_reading() {
    let folder = folder();
    let run = |more: &[&str]| osculate(folder.path(), &[&["render", "cage.obj"], more].concat());
    run(&[]).fails(2, "--output");
    run(&["-o", "out.jpg"]).fails(2, "out.jpg");
    run(&["-o", "no/out.png"]).fails(2, "no/out.png");
    run(&["-o", "out.png", "--size", "0x9"]).fails(2, "--size");
    run(&["-o", "out.png", "--level", "65"]).fails(2, "--level");
    run(&["-o", "out.png", "--level", "0.5"]).fails(2, "1 to 64");
    run(&["-o", "out.png", "--shade", "matte"]).fails(2, "possible values: lit");
    run(&["-o", "out.png", "--samples", "3"]).fails(2, "--samples");
    run(&["-o", "out.png", "--size", "-1x5"]).fails(2, "each from 1 to 16384");
    run(&["-o", "out.png", "--adaptive", "-1"]).fails(2, "greater than 0");
    run(&["-o", "-"]).fails(2, "cannot write to stdout");
    run(&["-o", "out.png", "--camera", "1,2,3:1,2,3:0,1,0:45"]).fails(2, "two different points");
    run(&["-o", "out.png", "--camera", "1,2,3:0,0,0:0,1,0:45", "--fit"]).fails(2, "--fit");
    run(&["-o", "out.png", "--scheme", "table"]).fails(2, "it has gregory1");
    run(&["-o", "out.png", "--boundary", "none"]).fails(3, "cage.obj: no face is left");
    assert!(!folder.path().join("out.png").exists());
}

#[test]
fn blank_pictures_are_pointed_out() {
    let folder = folder();
    let away = ["render", "cage.obj", "-o", "out.png", "--size", "64x48", "--camera", "0,0,5:9,0,5:0,1,0:45"];
    let ran = osculate(folder.path(), &away).exits(0);
    assert!(ran.stderr.starts_with("warning: out.png: the picture is blank"), "{}", ran.stderr);
    assert_eq!(ran.stderr.lines().count(), 1, "{}", ran.stderr);
}
