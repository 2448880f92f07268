//! The tables of the report's pyramid (Figure 2), entry by entry.
//!
//! The figure numbers edges by the edge that enters each corner, in face order; ours go by the edge that leaves it. Rows of the E table begin at the
//! same end, so the tables agree up to that permutation. Rings of the V table are cyclic; the figure begins a row at the last-numbered edge.

use osculate_cage::{BoundaryRule, Cage};
use osculate_subdiv::{RefineTables, SurfacePlan};

mod common;

const FACE_SPANS: [[u32; 2]; 5] = [[0, 3], [3, 3], [6, 3], [9, 3], [12, 4]];
const FACE_INDICES: [u32; 16] = [0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 4, 3, 2, 1];
const EDGES: [[u32; 4]; 8] =
    [[0, 5, 2, 6], [1, 5, 0, 8], [2, 5, 1, 9], [0, 6, 3, 7], [3, 6, 2, 9], [0, 7, 4, 8], [4, 7, 3, 9], [1, 8, 4, 9]];
const VERTEX_SPANS: [[u32; 2]; 5] = [[0, 4], [8, 3], [14, 3], [20, 3], [26, 3]];
const VERTEX_ROWS: [&[u32]; 5] =
    [&[4, 8, 1, 5, 2, 6, 3, 7], &[4, 9, 2, 5, 0, 8], &[3, 6, 0, 5, 1, 9], &[4, 7, 0, 6, 2, 9], &[1, 8, 0, 7, 3, 9]];

fn pyramid() -> Cage {
    common::cage(5, &[&[0, 1, 2], &[0, 2, 3], &[0, 3, 4], &[0, 4, 1], &[4, 3, 2, 1]])
}

fn tables() -> RefineTables {
    RefineTables::build(pyramid().topology(), BoundaryRule::EdgeAndCorner, 0)
}

#[test]
fn the_buffer_holds_old_and_new_points() {
    let tables = tables();
    assert_eq!((tables.first_old, tables.first_new, tables.old_distance()), (0, 5, 18));
    assert_eq!((tables.face_count(), tables.edge_count(), tables.vertex_count()), (5, 8, 5));
    // Two steps, because the pyramid has triangles; the first table of the plan is this one.
    let plan = SurfacePlan::build(&pyramid(), &Default::default()).unwrap();
    assert_eq!(plan.steps(), 2);
    assert_eq!(plan.levels[0].edge_indices, tables.edge_indices);
    assert_eq!(plan.levels[1].first_old, 5);
    assert_eq!(plan.levels[1].first_new, 23);
}

#[test]
fn face_tables_are_those_of_the_figure() {
    let tables = tables();
    assert_eq!(tables.face_spans, FACE_SPANS);
    assert_eq!(tables.face_indices, FACE_INDICES);
}

#[test]
fn edge_table_is_that_of_the_figure_in_our_order_of_edges() {
    let mut ours = tables().edge_indices;
    let mut figure = EDGES;
    ours.sort_unstable();
    figure.sort_unstable();
    assert_eq!(ours, figure);
}

#[test]
fn vertex_tables_are_those_of_the_figure_up_to_where_a_ring_begins() {
    let tables = tables();
    assert_eq!(tables.vertex_spans, VERTEX_SPANS);
    for (&[offset, valence], figure) in tables.vertex_spans.iter().zip(VERTEX_ROWS) {
        let row = &tables.vertex_indices[offset as usize..(offset + 2 * valence) as usize];
        let turn =
            row.iter().step_by(2).position(|&v| v == figure[0]).expect("the figure's first neighbour is in the ring");
        let turned: Vec<u32> = row[2 * turn..].iter().chain(&row[..2 * turn]).copied().collect();
        assert_eq!(turned, figure);
    }
}

#[test]
fn boundary_rows_follow_the_report() {
    // A quad with a triangle on the edge 1-2: vertices 0 and 3 have one face, 1 and 2 have two, 4 has one.
    let cage = common::cage(5, &[&[0, 1, 2, 3], &[1, 4, 2]]);
    let tables = RefineTables::build(cage.topology(), BoundaryRule::EdgeAndCorner, 0);
    assert!(!tables.quads);
    // Boundary edges hold both ends twice; the one inner edge holds ends and face points.
    let inner: Vec<_> = tables.edge_indices.iter().filter(|row| row[0] != row[1]).collect();
    assert_eq!(inner, [&[2, 5, 1, 6]]);
    assert!(tables.edge_indices.iter().filter(|row| row[0] == row[1]).all(|row| row[2] == row[3] && row[0] != row[2]));
    // Corners n = 0, boundary vertices n = 1 with their two neighbours on the boundary.
    let valences: Vec<u32> = tables.vertex_spans.iter().map(|span| span[1]).collect();
    assert_eq!(valences, [0, 1, 1, 0, 0]);
    let neighbours = |v: usize| {
        let at = tables.vertex_spans[v][0] as usize;
        let mut pair = [tables.vertex_indices[at], tables.vertex_indices[at + 1]];
        pair.sort_unstable();
        pair
    };
    assert_eq!((neighbours(1), neighbours(2)), ([0, 4], [3, 4]));
    // Under edge-only, one-face vertices are boundary vertices too.
    let tables = RefineTables::build(cage.topology(), BoundaryRule::EdgeOnly, 0);
    assert!(tables.vertex_spans.iter().all(|span| span[1] == 1));
}
