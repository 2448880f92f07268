//! Faces of very many sides: a sample takes time in proportion to their number, not to its square.

use std::time::Instant;

use osculate_surface::reference::{Boundary, Reference};

use crate::cages;

#[test]
fn a_polygon_of_thousands_of_sides_is_sampled_in_seconds() {
    const SIDES: u32 = 3000;
    let mesh = cages::lone(SIDES);
    let start = Instant::now();
    let reference = Reference::new(&mesh, Boundary::EdgeOnly).unwrap();
    let centre = |sub: u32| reference.eval(0, sub as i32, 1.0, 1.0).unwrap().position;
    let first = centre(0);
    for sub in 0..SIDES {
        let difference = (centre(sub) - first).length();
        assert!(difference < 1e-12, "sub-face {sub} has its centre {difference} from that of sub-face 0");
    }
    // With a sum over the face for each of its corners this takes a minute.
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
}
