//! Gregory patches of meshes that are not refined: against the bicubic, the limit, their neighbours, and the patches of refined meshes.

mod polygons;
mod star;

use glam::DVec3;
use osculate_surface::gregory::{self, CrossEnd, Fan};
use osculate_surface::reference::{Boundary, Reference};
use osculate_surface::{NetKind, bezier};
use polygons::{Patch, Polygons, cut, merge_pairs, random_triangles};
use star::{Random, Star};

/// Closed and open meshes of triangles, of both, and of quads with irregular corners side by side.
fn meshes() -> Vec<(String, Polygons)> {
    let mut meshes = Vec::new();
    for seed in 0..3 {
        let triangles = random_triangles(seed);
        let mixed = merge_pairs(&triangles, seed);
        let open = cut(&mixed, 0.35);
        meshes.push((format!("open mixed with smooth corners {seed}"), open.clone().with_smooth_corners()));
        meshes.push((format!("quads {seed}"), quads_of(&mixed)));
        meshes.push((format!("open quads {seed}"), quads_of(&open)));
        meshes.push((format!("open triangles {seed}"), cut(&triangles, 0.2)));
        meshes.push((format!("open mixed {seed}"), open));
        meshes.push((format!("mixed {seed}"), mixed));
        meshes.push((format!("triangles {seed}"), triangles));
    }
    meshes.push(("strip".to_owned(), strip(7)));
    meshes.push(("strip with smooth corners".to_owned(), strip(7).with_smooth_corners()));
    meshes.push(("wheel of 64 triangles".to_owned(), wheel(64)));
    meshes.push(("ear".to_owned(), ear()));
    meshes
}

/// One subdivision step, as a mesh of quads.
fn quads_of(mesh: &Polygons) -> Polygons {
    let refined = mesh.reference().subdivide(Boundary::EdgeAndCorner).mesh;
    let faces = refined.face_vertices.chunks(4).map(<[u32]>::to_vec).collect();
    Polygons::new(refined.positions, faces)
}

/// A zigzag of triangles between two boundaries: one, two and three faces at its vertices.
fn strip(triangles: u32) -> Polygons {
    let mut random = Random(5);
    let at = |i: u32| DVec3::new(f64::from(i), f64::from(i % 2) * 1.6, 0.4 * random.next());
    let points = (0..triangles + 2).map(at).collect();
    let face = |i: u32| if i.is_multiple_of(2) { vec![i, i + 2, i + 1] } else { vec![i, i + 1, i + 2] };
    Polygons::new(points, (0..triangles).map(face).collect())
}

/// Triangles about a vertex of high valence, closed by a second one below.
fn wheel(valence: u32) -> Polygons {
    let mut points = vec![DVec3::new(0.0, 0.0, 0.5), DVec3::new(0.1, 0.0, -0.6)];
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(valence);
    points.extend((0..valence).map(|i| DVec3::new(angle(i).cos(), angle(i).sin(), 0.1 * (3.0 * angle(i)).sin())));
    let rim = |i: u32| 2 + i % valence;
    let faces = (0..valence).flat_map(|i| [vec![0, rim(i), rim(i + 1)], vec![1, rim(i + 1), rim(i)]]).collect();
    Polygons::new(points, faces)
}

/// A cube one of whose sides consists of two quads that meet in an inner vertex of valence 2.
fn ear() -> Polygons {
    let mut random = Random(9);
    let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
    let mut points: Vec<DVec3> =
        (0..8).map(|i| corner(i) + 0.3 * DVec3::new(random.next(), random.next(), random.next())).collect();
    points.push(DVec3::new(0.5, 0.6, 1.4));
    let [x, y, z] = [[0, 4, 6, 2], [0, 1, 5, 4], [0, 2, 3, 1]];
    let far = [[1, 3, 7, 5], [2, 6, 7, 3]];
    // The side 4, 5, 7, 6 is cut from 5 to 6 by vertex 8.
    let faces = [x, y, z].into_iter().chain(far).chain([[4, 5, 8, 6], [5, 7, 6, 8]]);
    Polygons::new(points, faces.map(Vec::from).collect())
}

fn unit_gap(a: DVec3, b: DVec3) -> f64 {
    (a.normalize() - b.normalize()).length()
}

/// Where to look along an edge: at flat ends patches have no normal of their own.
fn parameters(ends: [CrossEnd; 2]) -> Vec<f64> {
    let inner = [0.0625, 0.2, 0.5, 0.7, 0.9375];
    let first = (ends[0] == CrossEnd::Plain).then_some(0.0);
    let last = (ends[1] == CrossEnd::Plain).then_some(1.0);
    first.into_iter().chain(inner).chain(last).collect()
}

/// Both patches of an edge, and the patch at a boundary, have the points and normals of the edge's record.
#[test]
fn patches_agree_with_the_records_of_their_edges() {
    for (name, mesh) in meshes() {
        let patches = mesh.patches();
        let scale = mesh.points.iter().map(|p| p.length()).fold(0.0, f64::max);
        for (a, b, face, side) in mesh.half_edges() {
            let (curve, cross) = mesh.edge_record(a, b);
            for t in parameters([a, b].map(|v| mesh.vertex(v).end())) {
                let (on_curve, tangent) = bezier::curve(&curve, t);
                let normal = tangent.cross(bezier::curve(&cross, t).0);
                let across = mesh.find(b, a).map(|(face, side)| patches[face].on_side(side, 1.0 - t));
                for jet in [Some(patches[face].on_side(side, t)), across].into_iter().flatten() {
                    let gap = (jet.position - on_curve).length();
                    assert!(gap < 1e-14 * scale, "{name}: edge {a}-{b} at {t}: points {gap:e} apart");
                    let gap = unit_gap(jet.du.cross(jet.dv), normal);
                    assert!(gap < 1e-12, "{name}: edge {a}-{b} at {t}: normals {gap:e} apart");
                }
            }
        }
    }
}

/// Seen from its other end an inner edge has the same record: the curve reversed, the cross derivative reversed and negated.
#[test]
fn records_can_be_walked_from_both_ends() {
    for (name, mesh) in meshes() {
        for (a, b, ..) in mesh.half_edges().into_iter().filter(|&(a, b, ..)| mesh.find(b, a).is_some()) {
            let ((c, d), (c_back, d_back)) = (mesh.edge_record(a, b), mesh.edge_record(b, a));
            for i in 0..4 {
                assert_eq!((c[i], d[i]), (c_back[3 - i], -d_back[3 - i]), "{name}: edge {a}-{b}");
            }
        }
    }
}

#[test]
fn corners_and_their_normals_are_those_of_the_limit() {
    for (name, mesh) in meshes() {
        let source = mesh.reference();
        let smooth = name.contains("smooth");
        let rule = if smooth { Boundary::EdgeOnly } else { Boundary::EdgeAndCorner };
        let reference = Reference::new(&source, rule).expect("a valid mesh");
        for (a, _, face, corner) in mesh.half_edges() {
            let on_quad = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)][corner];
            let (sub, (s, t)) = if mesh.faces[face].len() == 4 { (-1, on_quad) } else { (corner as i32, (0.0, 0.0)) };
            let exact = reference.eval(face, sub, s, t).expect("a corner");
            let vertex = mesh.vertex(a);
            let rows = vertex.fan.vertex().apply(&vertex.net);
            let gap = (rows[0] - exact.position).length();
            assert!(gap < 1e-13, "{name}: vertex {a}, {:?}: {gap:e}", vertex.fan);
            if vertex.fan != (Fan::Interior { valence: 2 }) {
                let gap = unit_gap(rows[1].cross(rows[2]), exact.normal);
                assert!(gap < 1e-11, "{name}: normal at vertex {a}, {:?}: {gap:e}", vertex.fan);
            }
        }
    }
}

#[test]
fn patches_have_the_normals_of_their_vertices() {
    for (name, mesh) in meshes() {
        let patches = mesh.patches();
        for (a, _, face, side) in mesh.half_edges() {
            let vertex = mesh.vertex(a);
            if vertex.end() == CrossEnd::Plain {
                let rows = vertex.fan.vertex().apply(&vertex.net);
                let jet = patches[face].on_side(side, 0.0);
                let gap = unit_gap(jet.du.cross(jet.dv), rows[1].cross(rows[2]));
                assert!(gap < 1e-12, "{name}: vertex {a} of face {face}: {gap:e}");
            }
        }
    }
}

/// A grid of quads with its points and, for an open one, points reflected beyond the boundary.
fn grid(size: i32, closed: bool) -> (Polygons, impl Fn(i32, i32) -> DVec3) {
    let mut random = Random(3);
    let point = |k: i32| DVec3::new(f64::from(k % size), f64::from(k / size), 2.0 * random.next());
    let points: Vec<DVec3> = (0..size * size).map(point).collect();
    let index = move |x: i32, y: i32| (x.rem_euclid(size) + size * y.rem_euclid(size)) as u32;
    let faces = if closed { size } else { size - 1 };
    let quad = |k: i32| {
        let (x, y) = (k % faces, k / faces);
        vec![index(x, y), index(x + 1, y), index(x + 1, y + 1), index(x, y + 1)]
    };
    let mesh = Polygons::new(points.clone(), (0..faces * faces).map(quad).collect());
    let at = move |x: i32, y: i32| {
        let inside = |x: i32, y: i32| points[index(x, y) as usize];
        let along = |at: i32| match at {
            _ if closed => [(at, 1.0), (at, 0.0)],
            -1 => [(0, 2.0), (1, -1.0)],
            at if at == size => [(size - 1, 2.0), (size - 2, -1.0)],
            at => [(at, 1.0), (at, 0.0)],
        };
        along(x).iter().flat_map(|&(x, p)| along(y).map(|(y, q)| p * q * inside(x, y))).sum()
    };
    (mesh, at)
}

/// Closed regular nets and open ones with reflected points: the bicubic B-spline, with its records.
#[test]
fn regular_grids_are_bicubic() {
    for closed in [true, false] {
        let (mesh, at) = grid(5, closed);
        for (patch, (face, ring)) in mesh.patches().iter().zip(mesh.faces.iter().enumerate()) {
            let width = if closed { 5 } else { 4 };
            let (x, y) = (face as i32 % width, face as i32 / width);
            let net: Vec<DVec3> =
                (-1..=2).flat_map(|j| (-1..=2).map(move |i| (i, j))).map(|(i, j)| at(x + i, y + j)).collect();
            let Patch::Quad(points) = patch else { panic!("a grid of quads") };
            let expected = gregory::gregory2(NetKind::Regular).apply(&net);
            let gap = points.iter().zip(expected).map(|(a, b)| (*a - b).length()).fold(0.0, f64::max);
            assert!(gap < 1e-14, "closed {closed}, face {face}: {gap:e}");
            for side in 0..4 {
                let (curve, cross) = mesh.edge_record(ring[side], ring[(side + 1) % 4]);
                let expected = gregory::edge(NetKind::Regular, side).apply(&net);
                let gap = curve.iter().chain(&cross).zip(expected).map(|(a, b)| (*a - b).length()).fold(0.0, f64::max);
                assert!(gap < 1e-14, "closed {closed}, face {face}, side {side}: {gap:e}");
            }
        }
    }
}

/// A vertex of any kind among regular ones: the same patches and records as from the one matrix of each patch.
#[test]
fn isolated_vertices_have_the_patches_of_refined_meshes() {
    let interior = [2, 3, 4, 5, 7, 12, 40].map(|valence| NetKind::Interior { valence });
    let crease = (1..=7).map(|faces| NetKind::Crease { faces, quad: 0 });
    for kind in interior.into_iter().chain(crease) {
        let star = Star::over_plane(kind, |x, y| 0.2 * (x * x - y * y) + 0.1 * x, 0.1, 21);
        let (mesh, sectors) = mesh_of(&star, kind);
        let mesh = mesh.with_smooth_corners();
        let patches = mesh.patches();
        for i in 0..sectors {
            let kind = match kind {
                NetKind::Crease { faces, .. } => NetKind::Crease { faces, quad: i as u32 },
                other => other,
            };
            let net = star.net(kind, i);
            let face = i as usize * 9;
            let Patch::Quad(points) = &patches[face] else { panic!("a star of quads") };
            let expected = gregory::gregory2(kind).apply(&net);
            let gap = points.iter().zip(expected).map(|(a, b)| (*a - b).length()).fold(0.0, f64::max);
            assert!(gap < 1e-13, "{kind:?}, sector {i}: {gap:e}");
            let ring = &mesh.faces[face];
            for side in 0..4 {
                let (curve, cross) = mesh.edge_record(ring[side], ring[(side + 1) % 4]);
                let expected = gregory::edge(kind, side).apply(&net);
                let gap = curve.iter().chain(&cross).zip(expected).map(|(a, b)| (*a - b).length()).fold(0.0, f64::max);
                assert!(gap < 1e-13, "{kind:?}, sector {i}, side {side}: {gap:e}");
            }
        }
    }
}

/// The quads of a star, nine in each sector, first the one at the centre.
fn mesh_of(star: &Star, kind: NetKind) -> (Polygons, i64) {
    let (sectors, open) = match kind {
        NetKind::Interior { valence } => (i64::from(valence), false),
        NetKind::Crease { faces, .. } => (i64::from(faces), true),
        NetKind::Regular => (4, false),
    };
    let index = |i: i64, a: i64, b: i64| match (a, b) {
        (0, 0) => 0,
        (0, b) => 1 + 12 * ((i + 1) % if open { sectors + 1 } else { sectors }) + 4 * (b - 1),
        (a, b) => 1 + 12 * i + 4 * (a - 1) + b,
    };
    let spokes = if open { sectors + 1 } else { sectors };
    let mut points = vec![star.at(0, 0, 0)];
    for (i, a, b) in (0..spokes).flat_map(|i| (1..4).flat_map(move |a| (0..4).map(move |b| (i, a, b)))) {
        // The last spoke of an open star has no sector of its own.
        points.push(if i < sectors || b == 0 { star_point(star, i, a, b, sectors) } else { DVec3::ZERO });
    }
    let quad = |i: i64, a: i64, b: i64| {
        [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)].map(|(a, b)| index(i, a, b) as u32).to_vec()
    };
    let faces = (0..sectors).flat_map(|i| (0..3).flat_map(move |a| (0..3).map(move |b| quad(i, a, b))));
    (Polygons::new(points, faces.collect()), sectors)
}

/// Point (a, b) of sector i; the last spoke of an open star is seen from the sector before it.
fn star_point(star: &Star, i: i64, a: i64, b: i64, sectors: i64) -> DVec3 {
    if i == sectors { star.at(i - 1, 0, a) } else { star.at(i, a, b) }
}
