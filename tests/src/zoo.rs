//! Cages, one per hard case: those that ship with the project, and some that are better made here.

use std::path::{Path, PathBuf};

use glam::DVec3;
use osculate::Camera;
use osculate_cage::{Cage, CageDesc};

/// A cage and what to call it.
pub struct Specimen {
    /// Name for messages and goldens.
    pub name: String,
    /// The cage.
    pub cage: Cage,
}

/// The folder of shipped cages.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/cages")
}

/// A shipped cage.
///
/// # Panics
/// If it cannot be read.
pub fn shipped(name: &str) -> Cage {
    let file = folder().join(format!("{name}.obj"));
    Cage::read(&file).unwrap_or_else(|error| panic!("{error}"))
}

/// The dragon that walks.
///
/// # Panics
/// If it cannot be read.
pub fn walking_dragon() -> Cage {
    Cage::read(&folder().join("dragon_walk.glb")).unwrap_or_else(|error| panic!("{error}"))
}

/// The view that pictures of the walk are taken from.
///
/// # Panics
/// If the camera is refused.
pub fn walk_camera(cage: &Cage) -> Camera {
    let (eye, at) = (DVec3::new(4.2, 1.9, 4.4), DVec3::new(0.0, 0.99, -0.22));
    Camera::look_at(eye, at, DVec3::Y, 28f64.to_radians(), cage.bounds()).unwrap_or_else(|error| panic!("{error}"))
}

/// All cages of the zoo.
///
/// # Panics
/// If one cannot be read.
pub fn all() -> Vec<Specimen> {
    let mut names: Vec<String> = folder()
        .read_dir()
        .expect("assets/cages is there")
        .map(|entry| entry.expect("a readable entry").path())
        .filter(|file| file.extension().is_some_and(|extension| extension == "obj"))
        .map(|file| file.file_stem().expect("a file name").to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert!(names.len() > 10, "assets/cages holds only {names:?}");
    let shipped = names.into_iter().map(|name| Specimen { cage: shipped(&name), name });
    shipped.chain(made_here()).collect()
}

fn made_here() -> Vec<Specimen> {
    let specimen = |name: &str, cage: Cage| Specimen { name: name.to_owned(), cage };
    vec![
        specimen("pillow", pillow()),
        specimen("lone_quad", grid(1, 1)),
        specimen("lone_triangle", fan(3)),
        specimen("lone_heptagon", fan(7)),
        specimen("strip", grid(5, 1)),
        specimen("boundary_fan", boundary_fan(6)),
        specimen("pole_200", pole(200)),
    ]
}

/// A cage from points and faces.
///
/// # Panics
/// If they make no valid cage.
pub fn cage(positions: Vec<DVec3>, faces: &[Vec<u32>]) -> Cage {
    let mut face_offsets = vec![0];
    for face in faces {
        face_offsets.push(face_offsets[face_offsets.len() - 1] + face.len() as u32);
    }
    let desc = CageDesc { positions, face_offsets, face_vertices: faces.concat(), ..CageDesc::default() };
    Cage::new(desc).unwrap_or_else(|error| panic!("{error}"))
}

fn on_circle(i: usize, n: usize, radius: f64, height: f64) -> DVec3 {
    let angle = std::f64::consts::TAU * i as f64 / n as f64;
    DVec3::new(radius * angle.cos(), height, -radius * angle.sin())
}

/// A wavy open grid of `width` by `depth` quads.
pub fn grid(width: u32, depth: u32) -> Cage {
    let at = |x: u32, z: u32| z * (width + 1) + x;
    let points = (0..=depth).flat_map(|z| (0..=width).map(move |x| (f64::from(x), f64::from(z))));
    let positions = points.map(|(x, z)| DVec3::new(x, 0.4 * (1.3 * x + 0.5).sin() * (0.9 * z).cos(), z)).collect();
    let quads = (0..depth).flat_map(|z| (0..width).map(move |x| (x, z)));
    let faces: Vec<Vec<u32>> =
        quads.map(|(x, z)| vec![at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z)]).collect();
    cage(positions, &faces)
}

/// A grid of quads whose surface is `y = (kx x^2 + kz z^2) / 2` plus a constant, but for a rim: these are its curvatures, times the half diagonal of the
/// cage's box, where x = z = 0, which is the middle of a patch. Positive ones are hollow from above, the outside.
///
/// The B-spline of the squares of the integers is a parabola with the same second derivative.
pub fn paraboloid([kx, kz]: [f64; 2]) -> Cage {
    // The box grows with the curvature; it settles in a few rounds.
    let mut cage = paraboloid_bent([kx, kz]);
    for _ in 0..60 {
        let size = cage.bounds().half_diagonal();
        cage = paraboloid_bent([kx / size, kz / size]);
    }
    cage
}

fn paraboloid_bent([kx, kz]: [f64; 2]) -> Cage {
    const SIDE: u32 = 5;
    // The middle of a quad's first child lies a quarter of the quad from its corner.
    let coordinate = |i: u32| (f64::from(i) - f64::from(SIDE / 2) - 0.25) / f64::from(SIDE);
    let at = |x: u32, z: u32| z * (SIDE + 1) + x;
    let points = (0..=SIDE).flat_map(|z| (0..=SIDE).map(move |x| (coordinate(x), coordinate(z))));
    let positions = points.map(|(x, z)| DVec3::new(x, 0.5 * (kx * x * x + kz * z * z), z)).collect();
    let quads = (0..SIDE).flat_map(|z| (0..SIDE).map(move |x| (x, z)));
    let faces: Vec<Vec<u32>> =
        quads.map(|(x, z)| vec![at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z)]).collect();
    cage(positions, &faces)
}

/// One polygon with `n` corners, bent.
pub fn fan(n: usize) -> Cage {
    let positions = (0..n).map(|i| on_circle(i, n, 1.0, 0.2 * (i % 2) as f64)).collect();
    cage(positions, &[(0..n as u32).collect()])
}

/// Two triangles back to back share three vertices of valence 2; here with a ring of quads between, so valence 2 meets valence 3.
pub fn pillow() -> Cage {
    let ring = |height| (0..4).map(move |i| on_circle(i, 4, 1.0, height));
    // A strip of four quads around, closed above and below by two quads each that meet in a vertex of valence 2.
    let mut positions: Vec<DVec3> = ring(-0.5).chain(ring(0.5)).collect();
    positions.extend([DVec3::new(0.1, -0.9, 0.05), DVec3::new(-0.1, 0.9, 0.1)]);
    let mut faces: Vec<Vec<u32>> = (0..4).map(|i| vec![i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i]).collect();
    faces.extend([vec![0, 8, 2, 1], vec![2, 8, 0, 3], vec![4, 5, 6, 9], vec![6, 7, 4, 9]]);
    cage(positions, &faces)
}

/// The shipped star of that valence bent to a saddle: what an extraordinary vertex is hardest to judge on.
///
/// # Panics
/// If there is no such star.
pub fn saddle(valence: u32) -> Cage {
    let star = shipped(&format!("star{valence}"));
    let positions = star.positions().iter().map(|&p| DVec3::new(p.x, 0.5 * (p.x * p.x - p.z * p.z), p.z)).collect();
    let faces: Vec<Vec<u32>> = (0..star.face_count()).map(|f| star.face(f).to_vec()).collect();
    cage(positions, &faces)
}

/// A half disc of `k` quads around a boundary vertex.
pub fn boundary_fan(k: usize) -> Cage {
    let spoke = |i: usize, radius: f64| {
        let angle = std::f64::consts::PI * i as f64 / (2 * k) as f64;
        DVec3::new(radius * angle.cos(), 0.2 * (2.0 * angle).sin(), -radius * angle.sin())
    };
    let mut positions = vec![DVec3::new(0.0, 0.1, 0.0)];
    positions.extend((0..=2 * k).map(|i| spoke(i, if i % 2 == 0 { 1.0 } else { 1.3 })));
    let faces: Vec<Vec<u32>> = (0..k as u32).map(|i| vec![0, 1 + 2 * i, 2 + 2 * i, 3 + 2 * i]).collect();
    cage(positions, &faces)
}

/// A double cone of `2 n` triangles with two poles of valence `n`.
pub fn pole(n: usize) -> Cage {
    let mut positions: Vec<DVec3> = (0..n).map(|i| on_circle(i, n, 1.0, 0.05 * (i % 3) as f64)).collect();
    positions.extend([DVec3::new(0.0, 0.8, 0.0), DVec3::new(0.0, -0.8, 0.0)]);
    let n = n as u32;
    let faces: Vec<Vec<u32>> = (0..n).flat_map(|i| [vec![i, (i + 1) % n, n], vec![(i + 1) % n, i, n + 1]]).collect();
    cage(positions, &faces)
}

/// The cage scaled about the origin, then shifted.
pub fn moved(cage: &Cage, scale: f64, offset: DVec3) -> Cage {
    let positions = cage.positions().iter().map(|&p| p * scale + offset).collect();
    let faces: Vec<Vec<u32>> = (0..cage.face_count()).map(|f| cage.face(f).to_vec()).collect();
    self::cage(positions, &faces)
}

/// All OBJ files below the reference folder's models.
///
/// # Panics
/// If the folder cannot be read.
pub fn reference_cages(reference: &Path) -> Vec<PathBuf> {
    let mut folders = vec![reference.join("models")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in folder.read_dir().unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "obj") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
