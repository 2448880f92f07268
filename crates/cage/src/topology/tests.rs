use super::*;
use crate::Listed;

fn build(vertices: usize, faces: &[&[u32]]) -> Result<Topology, TopologyError> {
    let mut offsets = vec![0];
    let mut corners = Vec::new();
    for face in faces {
        corners.extend_from_slice(face);
        offsets.push(corners.len() as u32);
    }
    Topology::build(vertices, offsets, corners)
}

const CUBE: [&[u32]; 6] = [&[0, 1, 3, 2], &[2, 3, 5, 4], &[4, 5, 7, 6], &[6, 7, 1, 0], &[1, 7, 5, 3], &[6, 0, 2, 4]];

/// `n` by `m` quads, wrapped around in each direction on demand.
fn grid(n: u32, m: u32, wrap: [bool; 2]) -> Topology {
    let (columns, rows) = (n + u32::from(!wrap[0]), m + u32::from(!wrap[1]));
    let at = |i: u32, j: u32| (i % columns) + columns * (j % rows);
    let quads: Vec<u32> = (0..m)
        .flat_map(|j| (0..n).flat_map(move |i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]))
        .collect();
    let offsets: Vec<u32> = (0..=n * m).map(|f| 4 * f).collect();
    Topology::build((columns * rows) as usize, offsets, quads).expect("a grid is manifold")
}

/// `n` triangles around vertex 0, closed or open.
fn fan(n: u32, closed: bool) -> Topology {
    let outer = if closed { n } else { n + 1 };
    let triangles: Vec<u32> = (0..n).flat_map(|i| [0, 1 + i, 1 + (i + 1) % outer]).collect();
    let offsets: Vec<u32> = (0..=n).map(|f| 3 * f).collect();
    Topology::build(outer as usize + 1, offsets, triangles).expect("a fan is manifold")
}

/// Everything that the documentation of [`Topology`] promises.
fn check_invariants(t: &Topology) {
    let half_edges = 0..t.half_edge_count() as u32;
    let mut numbered = 0;
    for h in half_edges.clone() {
        assert_eq!(t.prev(t.next(h)), h);
        assert_eq!(t.face(t.next(h)), t.face(h));
        assert!(t.face_half_edges(t.face(h)).contains(&h));
        let (e, twin) = (t.edge(h), t.twin(h));
        if twin == NONE {
            assert_eq!(t.edge_half_edge(e), h);
        } else {
            assert_eq!(t.twin(twin), h);
            assert_eq!(t.edge(twin), e);
            assert_eq!((t.origin(twin), t.target(twin)), (t.target(h), t.origin(h)));
            assert_eq!(t.edge_half_edge(e), h.min(twin));
        }
        if t.edge_half_edge(e) == h {
            assert_eq!(e, numbered, "edges are numbered by first occurrence");
            numbered += 1;
        }
    }
    assert_eq!(numbered as usize, t.edge_count());
    for v in 0..t.vertex_count() as u32 {
        check_ring(t, v);
    }
}

fn check_ring(t: &Topology, v: u32) {
    let ring: Vec<u32> = t.ring(v).collect();
    let mut outgoing: Vec<u32> = (0..t.half_edge_count() as u32).filter(|&h| t.origin(h) == v).collect();
    assert_eq!(ring.first().copied().unwrap_or(NONE), t.vertex_half_edge(v));
    for pair in ring.windows(2) {
        assert_eq!(t.twin(t.prev(pair[0])), pair[1], "counter-clockwise");
    }
    if let (Some(&first), Some(&last)) = (ring.first(), ring.last()) {
        let after_last = t.twin(t.prev(last));
        assert_eq!(t.is_boundary_vertex(v), t.twin(first) == NONE);
        assert_eq!(after_last, if t.is_boundary_vertex(v) { NONE } else { first });
        if !t.is_boundary_vertex(v) {
            assert_eq!(Some(&first), outgoing.first(), "the lowest outgoing half-edge");
        }
    }
    let mut edges: Vec<u32> = ring.iter().flat_map(|&h| [t.edge(h), t.edge(t.prev(h))]).collect();
    edges.sort_unstable();
    edges.dedup();
    assert_eq!(edges.len(), t.valence(v) as usize);
    assert_eq!(ring.len(), t.face_valence(v) as usize);
    let mut sorted = ring;
    sorted.sort_unstable();
    outgoing.sort_unstable();
    assert_eq!(sorted, outgoing);
}

fn euler(t: &Topology) -> i64 {
    t.vertex_count() as i64 - t.edge_count() as i64 + t.face_count() as i64
}

#[test]
fn cube() {
    let t = build(8, &CUBE).expect("a cube");
    check_invariants(&t);
    assert_eq!((t.edge_count(), t.half_edge_count(), euler(&t)), (12, 24, 2));
    assert!((0..8).all(|v| t.valence(v) == 3 && !t.is_boundary_vertex(v)));
    assert_eq!(t.face_vertices(4), [1, 7, 5, 3]);
    assert_eq!(t.edges()[..5], [0, 1, 2, 3, 2]);
    assert_eq!(t.ring(3).map(|h| t.target(h)).collect::<Vec<_>>(), [2, 1, 5]);
    assert_eq!(t.find_half_edge(0, 1), Some(0));
    assert_eq!(t.find_half_edge(1, 0), Some(14));
    assert_eq!(t.find_edge(1, 0), Some(0));
    assert_eq!(t.find_edge(0, 5), None);
}

#[test]
fn grids_of_every_wrapping() {
    for (wrap, characteristic) in [([false, false], 1), ([true, false], 0), ([false, true], 0), ([true, true], 0)] {
        let t = grid(5, 4, wrap);
        check_invariants(&t);
        assert_eq!(euler(&t), characteristic, "{wrap:?}");
    }
}

#[test]
fn corners_and_sides_of_an_open_grid() {
    let t = grid(3, 3, [false, false]);
    assert_eq!((t.valence(0), t.face_valence(0)), (2, 1));
    assert_eq!((t.valence(1), t.face_valence(1)), (3, 2));
    assert_eq!((t.valence(5), t.face_valence(5)), (4, 4));
    // Vertex 1 is on the lower side: the surface is above it, so its ring starts to the right.
    assert_eq!(t.ring(1).map(|h| t.target(h)).collect::<Vec<_>>(), [2, 5]);
    assert_eq!(t.find_edge(1, 0), t.find_edge(0, 1));
    assert!(t.is_boundary_edge(t.find_edge(0, 1).expect("a side")));
    assert!(!t.is_boundary_edge(t.find_edge(1, 5).expect("an inner edge")));
}

#[test]
fn fans_of_any_size() {
    for n in [3, 4, 17, 500] {
        let closed = fan(n, true);
        check_invariants(&closed);
        assert_eq!((closed.valence(0), closed.is_boundary_vertex(0)), (n, false));
        let open = fan(n, false);
        check_invariants(&open);
        assert_eq!((open.valence(0), open.face_valence(0), open.is_boundary_vertex(0)), (n + 1, n, true));
    }
}

#[test]
fn interior_valence_two() {
    let t = build(3, &[&[0, 1, 2], &[2, 1, 0]]).expect("two triangles back to back are closed");
    check_invariants(&t);
    assert_eq!((euler(&t), t.valence(1)), (2, 2));
}

#[test]
fn one_polygon() {
    let corners: Vec<u32> = (0..100).collect();
    let t = build(100, &[&corners]).expect("a polygon");
    check_invariants(&t);
    assert_eq!((t.edge_count(), t.face_count(), euler(&t)), (100, 1, 1));
}

#[test]
fn unused_vertices_have_no_ring() {
    let mut t = build(5, &[&[1, 2, 4]]).expect("a triangle");
    check_invariants(&t);
    assert_eq!((t.vertex_half_edge(0), t.valence(0), t.is_boundary_vertex(0)), (NONE, 0, false));
    assert_eq!(t.drop_unused_vertices(), [1, 2, 4]);
    check_invariants(&t);
    assert_eq!(t.origins(), [0, 1, 2]);
}

#[test]
fn no_faces() {
    let t = build(2, &[]).expect("nothing is a mesh");
    assert_eq!((t.face_count(), t.edge_count(), t.vertex_count()), (0, 0, 2));
}

#[test]
fn parallel_sort_agrees_with_small_pieces() {
    // More vertices than one thread sorts.
    let t = grid(120, 90, [true, false]);
    assert_eq!(t.edge_count(), 120 * 90 + 120 * 91);
    for h in 0..t.half_edge_count() as u32 {
        let twin = t.twin(h);
        assert!(twin == NONE || (t.twin(twin) == h && t.origin(twin) == t.target(h)));
    }
}

fn message(result: Result<Topology, TopologyError>) -> String {
    result.expect_err("must be refused").to_string()
}

#[test]
fn malformed_offsets() {
    for (offsets, entry) in
        [(vec![], 0), (vec![1, 3], 0), (vec![0, 4, 3], 2), (vec![0, 3, 2, 3], 2), (vec![0, 3, 4], 2)]
    {
        let error = Topology::build(3, offsets.clone(), [0, 1, 2]).expect_err("malformed");
        assert_eq!(error, TopologyError::Offsets { entry, corners: 3 }, "{offsets:?}");
    }
    assert_eq!(
        message(Topology::build(3, [0, 2], [0, 1, 2])),
        "face offsets must rise from 0 to 3, the number of corners, but entry 1 does not"
    );
}

#[test]
fn too_few_corners() {
    assert_eq!(
        message(build(3, &[&[0, 1, 2], &[0, 1], &[]])),
        "2 faces with fewer than three corners: 1, 2; delete them"
    );
}

#[test]
fn missing_vertices() {
    assert_eq!(
        message(build(3, &[&[0, 1, 2], &[0, 3, 9]])),
        "2 face corners without a vertex: face 1 vertex 3, face 1 vertex 9; the vertices are 0 to 2"
    );
}

#[test]
fn repeated_vertices() {
    let mut polygon: Vec<u32> = (0..30).collect();
    polygon[20] = 5;
    assert_eq!(
        message(build(30, &[&[0, 1, 0], &polygon])),
        "repeated vertices in a face, at 2 corners: face 0 vertex 0, face 1 vertex 5; split the face or merge its corners"
    );
}

#[test]
fn non_manifold_edges() {
    let error = build(5, &[&[0, 1, 2], &[1, 0, 3], &[4, 0, 1]]).expect_err("three faces at an edge");
    assert_eq!(
        error.to_string(),
        "not manifold, 1 edge with more than two faces: 0-1 (faces 0, 1, 2); remove or separate the extra faces"
    );
    assert_eq!(error.face(), Some(2));
}

#[test]
fn many_non_manifold_edges_are_counted() {
    // Six copies of a cube: 12 edges with 12 faces each.
    let faces: Vec<&[u32]> = CUBE.iter().copied().cycle().take(36).collect();
    let Err(TopologyError::NonManifoldEdge(edges)) = build(8, &faces) else { panic!("not refused for its edges") };
    assert_eq!((edges.total(), edges.first().len()), (12, Listed::<EdgeFaces>::SHOWN));
    assert_eq!(edges.first()[0].to_string(), "0-1 (faces 0, 3, 6, 9 and 8 more)");
}

#[test]
fn inconsistent_winding() {
    let error = build(4, &[&[0, 1, 2], &[0, 1, 3]]).expect_err("both faces run 0-1");
    assert_eq!(
        error.to_string(),
        "inconsistent winding, 1 edge along which both faces run the same way: 0-1 (faces 0, 1); flip the faces that are inside out, or delete one of two equal faces"
    );
    assert_eq!(error.face(), Some(1));
}

#[test]
fn open_bow_tie() {
    let error = build(5, &[&[0, 1, 2], &[0, 3, 4]]).expect_err("two triangles touch at a point");
    assert_eq!(
        error.to_string(),
        "not manifold, 1 bow-tie vertex where separate fans of faces touch: 0 (2 fans); split these vertices"
    );
    assert_eq!(error.face(), Some(1));
}

#[test]
fn closed_bow_tie() {
    // Two tetrahedra that share vertex 0 only, and a third open fan.
    let tetrahedra: [&[u32]; 9] =
        [&[0, 1, 2], &[0, 2, 3], &[0, 3, 1], &[1, 3, 2], &[0, 4, 5], &[0, 5, 6], &[0, 6, 4], &[4, 6, 5], &[0, 7, 8]];
    let Err(TopologyError::BowTie(fans)) = build(9, &tetrahedra) else { panic!("not refused for its vertex") };
    assert_eq!(fans.total(), 1);
    assert_eq!(fans.first()[0].to_string(), "0 (3 fans)");
}

#[test]
fn large_bow_ties_are_refused_in_linear_time() {
    // Two cones that share their tip. Whatever compares each face there with all others takes a minute or more.
    const VALENCE: u32 = 400_000;
    let cone = |first: u32| (0..VALENCE).flat_map(move |i| [0, first + i, first + (i + 1) % VALENCE]);
    let corners: Vec<u32> = cone(1).chain(cone(1 + VALENCE)).collect();
    let offsets: Vec<u32> = (0..=2 * VALENCE).map(|f| 3 * f).collect();
    let start = std::time::Instant::now();
    let error = Topology::build(1 + 2 * VALENCE as usize, offsets, corners).expect_err("two fans");
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
    assert!(error.to_string().contains("0 (2 fans)"), "{error}");
}

#[test]
fn too_many_elements() {
    let error = super::build::check_counts(u32::MAX as usize, 3).expect_err("too many");
    assert_eq!(
        error.to_string(),
        "4294967295 vertices, but indices have 32 bits: at most 4294967294 can be used; split the model"
    );
    assert!(super::build::check_counts(3, usize::MAX).is_err());
    assert!(super::build::check_counts(u32::MAX as usize - 1, 3).is_ok());
}
