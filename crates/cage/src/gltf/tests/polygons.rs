//! Polygons from triangles: meshes of quads are cut as exporters cut them, and must come back.

use std::collections::BTreeSet;

use glam::DVec3;
use serde_json::json;

use super::{File, SQUARE, warnings};
use crate::random::Random;
use crate::{Cage, GltfDesc, PolygonRecovery, PolygonReport};

/// Points and polygons.
struct Mesh {
    points: Vec<[f32; 3]>,
    faces: Vec<Vec<u32>>,
}

/// A bent sheet of `n` by `n` quads.
fn sheet(n: u32) -> Mesh {
    let point = |k: u32| {
        let [x, y] = [k % (n + 1), k / (n + 1)].map(|k| k as f32 / n as f32);
        [x + 0.05 * (7.0 * y).sin(), y, 0.3 * (3.0 * x).cos() * y]
    };
    let quad = |k: u32| {
        let v = k % n + (n + 1) * (k / n);
        vec![v, v + 1, v + n + 2, v + n + 1]
    };
    Mesh { points: (0..(n + 1) * (n + 1)).map(point).collect(), faces: (0..n * n).map(quad).collect() }
}

/// A sphere of `n` by `n` / 2 faces; triangles at the poles.
fn sphere(n: u32) -> Mesh {
    let rings = n / 2;
    let mut points = vec![[0.0, 0.0, 1.0]];
    for ring in 1..rings {
        let (z, r) = (std::f32::consts::PI * ring as f32 / rings as f32).sin_cos();
        points.extend((0..n).map(|k| {
            let (y, x) = (std::f32::consts::TAU * k as f32 / n as f32).sin_cos();
            [z * x, z * y, r]
        }));
    }
    points.push([0.0, 0.0, -1.0]);
    let at = |ring: u32, k: u32| 1 + (ring - 1) * n + k % n;
    let last = points.len() as u32 - 1;
    let mut faces: Vec<Vec<u32>> = (0..n).map(|k| vec![0, at(1, k), at(1, k + 1)]).collect();
    for ring in 1..rings - 1 {
        faces.extend((0..n).map(|k| vec![at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1)]));
    }
    faces.extend((0..n).map(|k| vec![last, at(rings - 1, k + 1), at(rings - 1, k)]));
    Mesh { points, faces }
}

fn cube() -> Mesh {
    let points = (0..8_u8).map(|k| [k & 1, k >> 1 & 1, k >> 2].map(f32::from)).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Mesh { points, faces: faces.map(Vec::from).into() }
}

/// An icosahedron, subdivided: a mesh that never had quads.
fn icosphere(levels: u32) -> Mesh {
    let golden = 0.5 * (1.0 + 5.0_f32.sqrt());
    let mut points: Vec<[f32; 3]> = Vec::new();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        points.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]]);
    }
    let position = |points: &[[f32; 3]], v: u32| DVec3::from_array(points[v as usize].map(f64::from));
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in 0..12 {
            for c in 0..12 {
                let [p, q, r] = [a, b, c].map(|v| position(&points, v));
                let sides = [p.distance(q), q.distance(r), r.distance(p)];
                if a < b && a < c && sides.iter().all(|s| (s - 2.0).abs() < 1e-3) && p.dot(q.cross(r)) > 0.0 {
                    faces.push(vec![a, b, c]);
                }
            }
        }
    }
    for _ in 0..levels {
        let mut finer = Vec::new();
        for face in &faces {
            let [a, b, c] = [face[0], face[1], face[2]];
            let middles = [[a, b], [b, c], [c, a]].map(|[p, q]| {
                let middle = (position(&points, p.min(q)) + position(&points, p.max(q))).normalize() * 1.902_113;
                points.push(middle.as_vec3().to_array());
                points.len() as u32 - 1
            });
            let [d, e, f] = middles;
            finer.extend([vec![a, d, f], vec![b, e, d], vec![c, f, e], vec![d, e, f]]);
        }
        faces = finer;
    }
    Mesh { points, faces }
}

impl Mesh {
    /// Each face as a fan of triangles around its corner `start(face)`.
    fn cut(&self, mut start: impl FnMut(usize) -> usize) -> Vec<[u32; 3]> {
        let fan = |(f, face): (usize, &Vec<u32>)| {
            let mut face = face.clone();
            let corners = face.len();
            face.rotate_left(start(f) % corners);
            (2..corners).map(|k| [face[0], face[k - 1], face[k]]).collect::<Vec<_>>()
        };
        self.faces.iter().enumerate().flat_map(fan).collect()
    }

    fn file(&self, triangles: &[[u32; 3]]) -> File {
        let mut file = File::new();
        let bytes: Vec<u8> = triangles.as_flattened().iter().flat_map(|i| i.to_le_bytes()).collect();
        let (positions, indices) =
            (file.positions(&self.points), file.accessor("SCALAR", 5125, 3 * triangles.len(), &bytes));
        file.primitive(json!({"attributes": {"POSITION": positions}, "indices": indices}));
        file
    }

    /// The faces, each as the set of its corners.
    fn face_sets(&self) -> BTreeSet<Vec<[u32; 3]>> {
        let face = |face: &Vec<u32>| face.iter().map(|&v| self.points[v as usize]).collect();
        self.faces.iter().map(|f| sorted(face(f))).collect()
    }
}

fn sorted(points: Vec<[f32; 3]>) -> Vec<[u32; 3]> {
    // Adding zero turns -0 into +0.
    let mut bits: Vec<[u32; 3]> = points.iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect();
    bits.sort_unstable();
    bits
}

fn face_sets(cage: &Cage) -> BTreeSet<Vec<[u32; 3]>> {
    let point = |&v: &u32| cage.positions()[v as usize].as_vec3().to_array();
    (0..cage.face_count()).map(|f| sorted(cage.face(f).iter().map(point).collect())).collect()
}

fn report(cage: &Cage) -> &PolygonReport {
    cage.polygon_report().expect("polygons were looked for")
}

fn only(change: impl FnOnce(&mut PolygonRecovery)) -> GltfDesc {
    let mut polygons = PolygonRecovery::NONE;
    change(&mut polygons);
    GltfDesc { polygons, ..GltfDesc::default() }
}

/// The triangles in another order, each starting with another corner.
fn shuffled(mut triangles: Vec<[u32; 3]>, random: &mut Random) -> Vec<[u32; 3]> {
    for i in (1..triangles.len()).rev() {
        triangles.swap(i, random.below(i + 1));
        triangles[i].rotate_left(random.below(3));
    }
    triangles
}

#[test]
fn marked_polygons() {
    let mesh = Mesh {
        points: (0..10_u8).map(|k| [f32::from(k), f32::from(k * k), 0.0]).collect(),
        // A triangle, a hexagon, a quad, another quad.
        faces: vec![vec![9, 0, 1], vec![8, 9, 1, 2, 3, 4], vec![7, 8, 4, 5], vec![8, 7, 6, 9]],
    };
    let mut file = mesh.file(&mesh.cut(|_| 0));
    file.json["extensionsUsed"] = json!(["FB_ngon_encoding"]);
    file.json["meshes"][0]["primitives"][0]["extensions"] = json!({"FB_ngon_encoding": {}});
    let desc = GltfDesc::default();
    let cage = file.read_with(&desc);
    assert_eq!(face_sets(&cage), mesh.face_sets());
    let sizes: Vec<usize> = (0..4).map(|f| cage.face(f).len()).collect();
    assert_eq!(sizes, [3, 6, 4, 4]);
    assert_eq!((report(&cage).marked, report(&cage).marked_triangles, report(&cage).left), (3, 1, 0));
    assert!(cage.warnings().is_empty(), "{:?}", warnings(&cage));
    // Mirrored, they still face the same way.
    file.json["nodes"] = json!([{"mesh": 0, "scale": [1, 1, -1]}]);
    assert_eq!(file.read_with(&desc).face(1).len(), 6);
    assert_ne!(file.read_with(&desc).face(1), cage.face(1));
    // Two fans around one corner that do not go on from each other are two faces.
    let mut apart = mesh.file(&[[0, 1, 2], [0, 3, 1]]);
    apart.json["meshes"][0]["primitives"][0]["extensions"] = json!({"FB_ngon_encoding": {}});
    assert_eq!(apart.read_with(&desc).face_count(), 2);
}

#[test]
fn halves_in_a_row_become_quads() {
    let desc = only(|polygons| polygons.order = true);
    for mesh in [sheet(9), cube(), sphere(12)] {
        let quads = mesh.faces.iter().filter(|face| face.len() == 4).count();
        let shorter = |f: usize| {
            let face: Vec<DVec3> =
                mesh.faces[f].iter().map(|&v| DVec3::from_array(mesh.points[v as usize].map(f64::from))).collect();
            usize::from(face.len() == 4 && face[0].distance(face[2]) > face[1].distance(face[3]))
        };
        for triangles in [mesh.cut(|_| 0), mesh.cut(|_| 1), mesh.cut(|_| 3), mesh.cut(shorter)] {
            for mirrored in [1, -1] {
                let mut file = mesh.file(&triangles);
                file.json["nodes"] = json!([{"mesh": 0, "scale": [1, 1, mirrored]}]);
                let cage = file.read_with(&desc);
                assert_eq!((report(&cage).by_order, cage.face_count()), (quads, mesh.faces.len()));
            }
            assert_eq!(face_sets(&mesh.file(&triangles).read_with(&desc)), mesh.face_sets());
        }
    }
}

#[test]
fn the_order_survives_split_vertices() {
    let mesh = sheet(5);
    let points: Vec<[f32; 3]> = mesh.cut(|_| 0).as_flattened().iter().map(|&v| mesh.points[v as usize]).collect();
    let mut file = File::new();
    let positions = file.positions(&points);
    file.primitive(json!({"attributes": {"POSITION": positions}}));
    let cage = file.read_with(&only(|polygons| polygons.order = true));
    assert_eq!(face_sets(&cage), mesh.face_sets());
}

/// The grid of a tessellated patch: 4 by 4 quads in two rings of strips, with diagonals towards the middle.
#[test]
fn strips_in_rings_are_no_exporters_order() {
    let around = |side: i32| {
        let walk = [[1, 0], [0, 1], [-1, 0], [0, -1]].into_iter().flat_map(move |step| vec![step; side as usize]);
        walk.scan([-side / 2; 2], |at, [x, y]| {
            let here = *at;
            *at = [at[0] + x, at[1] + y];
            Some(here.map(|x| x as f32))
        })
    };
    let mut points = vec![[0.0; 3]; 25];
    let outer = [0, 1, 4, 5, 7, 8, 10, 11, 13, 14, 16, 17, 19, 20, 22, 23];
    let inner = [2, 3, 6, 9, 12, 15, 18, 21];
    outer.into_iter().zip(around(4)).chain(inner.into_iter().zip(around(2))).for_each(|(v, [x, y])| {
        points[v] = [x, y, 0.0];
    });
    let mut triangles: Vec<[u32; 3]> = vec![
        [0, 1, 2],
        [2, 1, 3],
        [1, 4, 3],
        [4, 5, 3],
        [3, 5, 6],
        [5, 7, 6],
        [7, 8, 6],
        [6, 8, 9],
        [8, 10, 9],
        [10, 11, 9],
        [9, 11, 12],
        [11, 13, 12],
        [13, 14, 12],
        [12, 14, 15],
        [14, 16, 15],
        [16, 17, 15],
        [15, 17, 18],
        [17, 19, 18],
        [19, 20, 18],
        [18, 20, 21],
        [20, 22, 21],
        [22, 23, 21],
        [21, 23, 2],
        [23, 0, 2],
    ];
    triangles.extend((0..8).map(|k| [inner[k] as u32, inner[(k + 1) % 8] as u32, 24]));
    let cage = Mesh { points, faces: Vec::new() }.file(&triangles).read_with(&GltfDesc::default());
    assert_eq!((cage.face_count(), cage.is_quads(), report(&cage).by_shape), (16, true, 16));
    let area = |f: usize| {
        let [a, _, c, _] = [0, 1, 2, 3].map(|k| cage.positions()[cage.face(f)[k] as usize]);
        (c - a).abs()
    };
    assert!((0..16).all(|f| area(f) == DVec3::new(1.0, 1.0, 0.0)), "unit squares");
}

#[test]
fn shuffled_halves_become_quads_by_shape() {
    let mut random = Random::new(5);
    for mesh in [sheet(12), cube(), sphere(16)] {
        for _ in 0..4 {
            let triangles = shuffled(mesh.cut(|f| f * 7 + f / 3), &mut random);
            let cage = mesh.file(&triangles).read_with(&GltfDesc::default());
            assert_eq!(face_sets(&cage), mesh.face_sets());
            let report = report(&cage);
            assert_eq!((report.by_order, report.by_shape + report.left), (0, mesh.faces.len()));
            let message = &warnings(&cage)[0];
            assert!(message.contains("by shape"), "{message}");
        }
    }
}

#[test]
fn meshes_of_triangles_stay_so() {
    let mut random = Random::new(7);
    for mesh in [icosphere(0), icosphere(1), icosphere(2), sphere(4)] {
        for triangles in [mesh.cut(|_| 0), shuffled(mesh.cut(|_| 0), &mut random)] {
            let cage = mesh.file(&triangles).read_with(&GltfDesc::default());
            assert_eq!((cage.face_count(), report(&cage).left), (triangles.len(), triangles.len()));
            let message = &warnings(&cage)[0];
            assert!(message.contains("give no larger polygons; "), "{message}");
        }
    }
}

#[test]
fn no_quad_lies_across_a_seam() {
    let mut file = File::new();
    let [a, b, c, d] = SQUARE;
    let positions = file.positions(&[a, b, c, a, c, d]);
    let uv = file.uv(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.5], [1.0, 0.5], [0.0, 1.0]]);
    file.primitive(json!({"attributes": {"POSITION": positions, "TEXCOORD_0": uv}}));
    assert_eq!(file.read_with(&GltfDesc::default()).face_count(), 2);
    file.json["meshes"][0]["primitives"][0]["attributes"] = json!({"POSITION": positions});
    assert_eq!(file.read_with(&GltfDesc::default()).face_count(), 1);
}

#[test]
fn nothing_is_recovered_when_switched_off() {
    let mesh = sheet(3);
    let cage = mesh.file(&mesh.cut(|_| 0)).read();
    assert_eq!((cage.face_count(), cage.polygon_report()), (18, None));
    let cage = mesh.file(&mesh.cut(|_| 0)).read_with(&only(|polygons| polygons.marked = true));
    assert_eq!((cage.face_count(), report(&cage).left), (18, 18));
}

#[test]
fn polygons_keep_materials_and_uv() {
    let mesh = sheet(2);
    let mut file = File::new();
    let positions = file.positions(&mesh.points);
    let uv: Vec<[f32; 2]> = mesh.points.iter().map(|p| [p[0], p[1]]).collect();
    let uv = file.uv(&uv);
    for (half, material) in [(&mesh.faces[..2], 0), (&mesh.faces[2..], 1)] {
        let part = Mesh { points: Vec::new(), faces: half.to_vec() };
        let bytes: Vec<u8> = part.cut(|_| 0).as_flattened().iter().map(|&i| i as u8).collect();
        let indices = file.indices(&bytes);
        file.primitive(json!({
            "attributes": {"POSITION": positions, "TEXCOORD_0": uv}, "indices": indices, "material": material
        }));
    }
    let cage = file.read_with(&GltfDesc::default());
    assert_eq!((cage.face_count(), cage.is_quads()), (4, true));
    let look = cage.appearance().expect("materials");
    assert_eq!(look.face_materials, [0, 0, 1, 1]);
    let uv = cage.uv().expect("uv");
    for (corner, &v) in cage.face_vertices().iter().enumerate() {
        assert_eq!(uv.values[uv.indices[corner] as usize], cage.positions()[v as usize].truncate());
    }
}

/// What part of the quads of the reference models comes back from triangles, in order and shuffled.
#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn quads_of_the_reference_models_come_back() {
    let root = std::env::var_os("OSCULATE_REFERENCE").expect("OSCULATE_REFERENCE names the folder of reference data");
    let mut random = Random::new(11);
    let mut short = Vec::new();
    for (model, least) in [
        ("paper/bigguy.obj", [1.0, 0.9]),
        ("paper/monsterfrog.obj", [1.0, 0.9]),
        // These have triangles and polygons of five and more corners, too.
        ("public-domain/spot_control_mesh.obj", [0.8, 0.7]),
        ("public-domain/blub_control_mesh.obj", [0.9, 0.7]),
        ("own/torus.obj", [1.0, 1.0]),
        ("own/twohole.obj", [1.0, 0.9]),
    ] {
        let cage = Cage::read(&std::path::Path::new(&root).join("models").join(model)).expect("a cage");
        let mesh = Mesh {
            points: cage.positions().iter().map(|p| p.as_vec3().to_array()).collect(),
            faces: (0..cage.face_count()).map(|f| cage.face(f).to_vec()).collect(),
        };
        let expected = mesh.face_sets();
        let ordered = mesh.cut(|_| 0);
        let mixed = shuffled(ordered.clone(), &mut random);
        for (triangles, least) in [ordered, mixed].into_iter().zip(least) {
            let found = mesh.file(&triangles).read_with(&GltfDesc::default());
            let right = face_sets(&found).intersection(&expected).count();
            println!("{model}: {right} of {} faces, {} found", expected.len(), found.face_count());
            short.extend(((right as f64) < least * expected.len() as f64).then_some((model, right)));
        }
    }
    assert_eq!(short, []);
}

/// A mesh that never had quads stays as it is.
#[test]
#[ignore = "needs OSCULATE_REFERENCE"]
fn the_triangles_of_the_reference_models_stay() {
    let root = std::env::var_os("OSCULATE_REFERENCE").expect("OSCULATE_REFERENCE names the folder of reference data");
    let cage = Cage::read(&std::path::Path::new(&root).join("models/mit/cat_head.obj")).expect("a cage");
    let mesh = Mesh {
        points: cage.positions().iter().map(|p| p.as_vec3().to_array()).collect(),
        faces: (0..cage.face_count()).map(|f| cage.face(f).to_vec()).collect(),
    };
    let found = mesh.file(&mesh.cut(|_| 0)).read_with(&GltfDesc::default());
    assert_eq!(report(&found).left, cage.face_count());
}
