//! Draws the pictures of README.md and docs: `cargo xtask pictures`.

use std::path::{Path, PathBuf};

use glam::DVec3;
use osculate::{Cage, Camera, Device, DeviceDesc, Engine, Factors, RenderDesc, Scheme, Shade, Tessellation};
use osculate_compare::Picture;
use osculate_tests::{legend, moving, picture, zoo};

fn main() {
    let engine = Engine::new(Device::new(&DeviceDesc::default()).unwrap_or_else(|error| panic!("{error}")));
    // One kind of pictures alone: `cargo xtask pictures --walk`.
    if std::env::args().any(|argument| argument == "--walk") {
        return walk(&engine);
    }
    walk(&engine);
    for &shade in Shade::ALL {
        write(&format!("shade-{}", shade.name()), &dragon(&engine, [288, 240], |desc| show(desc, shade)));
    }
    write("shade-difference", &difference(&engine));
    write("cage", &dragon(&engine, [288, 240], |desc| desc.cage = true));
    for (&scheme, shade) in Scheme::ALL.iter().flat_map(|scheme| SCHEME_SHADES.map(|shade| (scheme, shade))) {
        let close = picture::close_up(&engine, "saddle8", scheme, shade, [280, 280]);
        write(&format!("scheme-{scheme}-{}", shade.name()), &close);
    }
    for swatch in legend::swatches() {
        write(&swatch.name, &swatch.draw(&engine));
    }
}

/// What docs/schemes.md shows of each scheme.
const SCHEME_SHADES: [Shade; 3] = [Shade::Zebra, Shade::Reflection, Shade::Gaussian];

/// What the command line of docs/shading.md shows in that shade.
fn show(desc: &mut RenderDesc, shade: Shade) {
    desc.shade = shade;
    match shade {
        Shade::Wireframe => desc.tessellation = Tessellation::uniform(1.0),
        Shade::Factors => {
            let factors = Factors::Adaptive { pixels: 2.0, camera: desc.camera, height: desc.size[1] };
            desc.tessellation = Tessellation { factors, ..desc.tessellation };
        }
        Shade::Peer => (desc.samples, desc.background) = (1, [0.1, 0.1, 0.1, 1.0]),
        _ => {}
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/images")
}

fn write(name: &str, picture: &Picture) {
    picture.write(&folder().join(format!("{name}.png"))).unwrap_or_else(|error| panic!("{error}"));
    println!("docs/images/{name}.png");
}

/// The dragon as docs/shading.md has it: `--camera 2.57,2.02,3.28:0.13,1.06,-0.22:0,1,0:40`.
fn dragon(engine: &Engine, size: [u32; 2], change: impl FnOnce(&mut RenderDesc)) -> Picture {
    let cage = zoo::shipped("dragon");
    picture::draw(engine, &cage, size, |desc| {
        desc.camera = dragon_camera(&cage);
        change(desc);
    })
}

fn dragon_camera(cage: &Cage) -> Camera {
    let (eye, at) = (DVec3::new(2.57, 2.02, 3.28), DVec3::new(0.13, 1.06, -0.22));
    Camera::look_at(eye, at, DVec3::Y, 40f64.to_radians(), cage.bounds()).unwrap_or_else(|error| panic!("{error}"))
}

/// How far the dragon under gregory2 is from its limit surface.
fn difference(engine: &Engine) -> Picture {
    let cage = zoo::shipped("dragon");
    let desc = RenderDesc { camera: dragon_camera(&cage), ..RenderDesc::fit(&cage, [288, 240]) };
    picture::draw_difference(engine, &cage, [Scheme::Gregory2, Scheme::Stam], None, &desc).0
}

/// Two pictures of one size side by side.
fn beside(left: &Picture, right: &Picture) -> Picture {
    let (size, row) = (left.size(), 4 * left.size().width as usize);
    let rows = left.rgba().chunks(row).zip(right.rgba().chunks(row));
    let rgba = rows.flat_map(|(left, right)| [left, right].concat()).collect();
    Picture::new(2 * size.width, size.height, rgba).unwrap_or_else(|error| panic!("{error}"))
}

/// The walk: the cage over the surface beside the surface alone, at twice the size and halved, which smooths outlines further.
fn walk(engine: &Engine) {
    let cage = zoo::walking_dragon();
    let [left, right] = [true, false].map(|lines| {
        let desc = RenderDesc { camera: zoo::walk_camera(&cage), cage: lines, ..RenderDesc::fit(&cage, WALK_SIZE) };
        picture::draw_moments(engine, &cage, &desc, (0..WALK_FRAMES).map(|k| f64::from(k) / f64::from(WALK_FRAMES)))
    });
    let frames: Vec<Picture> = left.iter().zip(&right).map(|(left, right)| halved(&beside(left, right))).collect();
    moving::write(&folder().join("walk.png"), &frames, WALK_FRAMES);
    println!("docs/images/walk.png");
}

/// Frames of the walk, which takes a second, and twice the size of one of the two pictures of each.
const WALK_FRAMES: u16 = 24;
const WALK_SIZE: [u32; 2] = [640, 532];

/// The picture at half its size: each pixel is the mean of four, in linear light.
fn halved(picture: &Picture) -> Picture {
    let size = picture.size();
    let (width, pixels) = (size.width as usize, picture.rgba().as_chunks::<4>().0);
    let linear = |byte: u8| (f64::from(byte) / 255.0).powf(2.2);
    let mean = |first: usize, c: usize| {
        let sum: f64 = [first, first + 1, first + width, first + width + 1].iter().map(|&i| linear(pixels[i][c])).sum();
        ((sum / 4.0).powf(1.0 / 2.2) * 255.0).round() as u8
    };
    let firsts = (0..size.height as usize / 2).flat_map(|y| (0..width / 2).map(move |x| 2 * y * width + 2 * x));
    let rgba = firsts.flat_map(|first| std::array::from_fn::<u8, 4, _>(|c| mean(first, c))).collect();
    Picture::new(size.width / 2, size.height / 2, rgba).unwrap_or_else(|error| panic!("{error}"))
}
