use super::*;
use crate::random::Random;
use crate::{NONE, read_obj};

/// A sheet of squares, its faces in a random order, with texture coordinates and tags.
fn sheet(side: usize, seed: u64) -> Cage {
    let mut random = Random::new(seed);
    let mut faces: Vec<usize> = (0..side * side).collect();
    (1..faces.len()).rev().for_each(|i| faces.swap(i, random.below(i + 1)));
    let mut text = String::new();
    for v in 0..(side + 1) * (side + 1) {
        text += &format!("v {} {} 0\nvt {} {}\n", v % (side + 1), v / (side + 1), v % (side + 1), v / (side + 1));
    }
    for f in faces {
        let v = 1 + f % side + (side + 1) * (f / side);
        text += "f";
        [v, v + 1, v + side + 2, v + side + 1].iter().for_each(|v| text += &format!(" {v}/{v}"));
        text += "\n";
    }
    text += "t hole 1/0/0 3\nt crease 2/1/0 0 1 3.5\nt corner 1/1/0 0 5\n";
    read_obj(text.as_bytes(), "sheet.obj").expect("a cage")
}

/// Whether two faces share a vertex.
fn touch(cage: &Cage, a: u32, b: u32) -> bool {
    cage.face(a as usize).iter().any(|v| cage.face(b as usize).contains(v))
}

#[test]
fn every_face_is_in_one_set_and_sets_are_even() {
    let cage = sheet(13, 1);
    for count in [1, 2, 3, 7, 50, 169, 1000] {
        let sets = divide(&cage, (0..169).collect(), count);
        assert_eq!(sets.len(), count.min(169));
        let sizes: Vec<usize> = sets.iter().map(Vec::len).collect();
        assert!(sizes.iter().max().unwrap() - sizes.iter().min().unwrap() <= 1 + usize::from(count > 2), "{sizes:?}");
        let mut all = sets.concat();
        assert!(sets.iter().all(|set| set.is_sorted()));
        all.sort_unstable();
        assert!(all.into_iter().eq(0..169), "{count}");
    }
    assert_eq!(divide(&cage, Vec::new(), 3), [[0u32; 0]]);
}

/// A quarter of a sheet is a square, though the faces are shuffled: its first ring has 4 faces a side at most.
#[test]
fn sets_are_compact() {
    let cage = sheet(32, 2);
    for own in divide(&cage, (0..1024).collect(), 4) {
        let part = CagePart::cut(&cage, &own, 1);
        assert_eq!(own.len(), 256);
        assert!(part.faces().len() - own.len() <= 2 * 17, "{}", part.faces().len());
    }
}

#[test]
fn rings_are_the_faces_that_touch_those_before() {
    let cage = sheet(9, 3);
    for rings in 0..4 {
        let own = [40, 3];
        let part = CagePart::cut(&cage, &own, rings);
        assert!(part.faces().is_sorted_by(|a, b| a < b));
        let ring_of = |f: u32| part.faces().binary_search(&f).ok().map(|i| part.ring(i as u32));
        for f in 0..81 {
            let near = |r: u8| (0..81).any(|g| ring_of(g) == Some(r) && touch(&cage, f, g));
            let expected = if own.contains(&f) { Some(0) } else { (1..=rings).find(|&r| near(r - 1)) };
            assert_eq!(ring_of(f), expected, "face {f}, {rings} rings");
        }
    }
}

#[test]
fn a_part_has_the_same_faces_in_the_same_order_as_the_whole() {
    let cage = sheet(9, 4);
    for own in divide(&cage, (0..81).collect(), 6) {
        let part = CagePart::cut(&cage, &own, CagePart::RINGS);
        let (topology, whole) = (part.cage().topology(), cage.topology());
        assert_eq!(part.cage().bounds(), cage.bounds());
        for (f, &of_whole) in (0..).zip(part.faces()) {
            assert_eq!(part.cage().source_face(f), of_whole);
            assert_eq!(part.is_own(f), own.contains(&of_whole));
            for (h, of_whole) in topology.face_half_edges(f).zip(whole.face_half_edges(of_whole)) {
                assert_eq!(part.whole_half_edge(h), of_whole);
                assert_eq!(part.vertices()[topology.origin(h) as usize], whole.origin(of_whole));
                let (uv, whole_uv) = (part.cage().uv().unwrap(), cage.uv().unwrap());
                assert_eq!(
                    uv.values[uv.indices[h as usize] as usize],
                    whole_uv.values[whole_uv.indices[of_whole as usize] as usize]
                );
                let twin = topology.twin(h);
                let whole_twin = whole.twin(of_whole);
                if part.ring(f) < CagePart::RINGS {
                    assert_eq!(twin == NONE, whole_twin == NONE, "the whole ring is there");
                }
                assert!(twin == NONE || part.whole_half_edge(twin) == whole_twin);
            }
        }
        let of = |v: u32| part.cage().positions()[v as usize] == cage.positions()[part.vertices()[v as usize] as usize];
        assert!((0..part.cage().vertex_count() as u32).all(of));
    }
}

/// A topology built from scratch has the same numbers.
#[test]
fn topologies_of_parts_are_what_building_makes() {
    let cage = sheet(9, 5);
    for own in [vec![0], vec![0, 40, 77], divide(&cage, (0..81).collect(), 2).remove(0)] {
        let part = CagePart::cut(&cage, &own, 1);
        let topology = part.cage().topology();
        let built =
            Topology::build(topology.vertex_count(), topology.face_offsets().to_vec(), topology.origins().to_vec());
        assert_eq!(built.as_ref(), Ok(topology), "{own:?}");
    }
}

/// Two faces that share nothing but a vertex, which becomes two.
#[test]
fn vertices_between_fans_are_split() {
    let cage = sheet(2, 6);
    let touching = |f: u32| (0..4).find(|&g| g != f && shared(&cage, f, g) == 1).unwrap();
    let part = CagePart::cut(&cage, &[0, touching(0)], 0);
    assert_eq!(part.cage().vertex_count(), 8);
    let centre = |&&v: &&u32| cage.topology().valence(v) == 4;
    assert_eq!(part.vertices().iter().filter(centre).count(), 2);
}

fn shared(cage: &Cage, a: u32, b: u32) -> usize {
    cage.face(a as usize).iter().filter(|v| cage.face(b as usize).contains(v)).count()
}

#[test]
fn tags_are_those_of_the_elements_that_are_there() {
    let cage = sheet(9, 7);
    let [a, b] = cage.tags().creases[0].vertices;
    let mut creases = 0;
    for own in divide(&cage, (0..81).collect(), 5) {
        let part = CagePart::cut(&cage, &own, CagePart::RINGS);
        let tags = part.cage().tags();
        let whole = |v: u32| part.vertices()[v as usize];
        assert!(tags.creases.iter().all(|crease| {
            let mut ends = crease.vertices.map(whole);
            ends.sort_unstable();
            ends == [a.min(b), a.max(b)] && crease.sharpness == 3.5
        }));
        creases += tags.creases.len();
        assert_eq!(tags.corners.len(), part.vertices().iter().filter(|&&v| v == cage.tags().corners[0].vertex).count());
        assert!(tags.holes.iter().all(|&f| part.faces()[f as usize] == 3));
        assert_eq!(tags.holes.len(), usize::from(part.faces().contains(&3)));
        // What the tags name exists.
        assert_eq!(tags.check(part.cage().topology()), Ok(()));
    }
    assert!(creases > 0);
}
