//! The tags of a part.

use crate::{Cage, Corner, Crease, NONE, Tags, Topology};

/// Those tags of a cage that name elements of a part; `numbers` gives the faces' numbers in the part, whose topology is `part`.
pub(super) fn restricted(cage: &Cage, part: &Topology, numbers: &[u32]) -> Tags {
    let whole = cage.topology();
    let local = |h: u32| {
        let face = whole.face(h);
        let number = numbers[face as usize];
        (number != NONE).then(|| part.face_half_edges(number).start + (h - whole.face_half_edges(face).start))
    };
    let tags = cage.tags();
    let creases = tags.creases.iter().flat_map(|crease| {
        let edge = whole.find_edge(crease.vertices[0], crease.vertices[1]);
        let sides = edge.map(|e| whole.edge_half_edge(e)).into_iter().flat_map(|h| [h, whole.twin(h)]);
        let mut ends: Vec<[u32; 2]> =
            sides.filter(|&h| h != NONE).filter_map(local).map(|h| sorted([part.origin(h), part.target(h)])).collect();
        ends.dedup();
        ends.into_iter().map(|vertices| Crease { vertices, ..*crease })
    });
    let corners = tags.corners.iter().flat_map(|corner| {
        let mut vertices: Vec<u32> = whole.ring(corner.vertex).filter_map(local).map(|h| part.origin(h)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices.into_iter().map(|vertex| Corner { vertex, ..*corner })
    });
    let holes = tags.holes.iter().map(|&f| numbers[f as usize]).filter(|&f| f != NONE);
    Tags { creases: creases.collect(), corners: corners.collect(), holes: holes.collect(), ..tags.clone() }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
