//! The parts of a cage that its surface consists of: faces, and sub-faces where a face is not a quad.

use std::ops::Range;

use super::Cage;
use crate::BoundaryRule;

impl Cage {
    /// For each face whether it is part of the surface under `rule`: holes are not, and under [`BoundaryRule::None`] neither are
    /// faces with a vertex on the boundary.
    ///
    /// The faces that are left out still shape the surface of their neighbours.
    #[must_use]
    pub fn drawn_faces(&self, rule: BoundaryRule) -> Vec<bool> {
        let at_boundary = |f: usize| self.face(f).iter().any(|&v| self.topology.is_boundary_vertex(v));
        let dropped = |f: usize| rule == BoundaryRule::None && at_boundary(f);
        let mut drawn: Vec<bool> = (0..self.face_count()).map(|f| !dropped(f)).collect();
        self.tags.holes.iter().for_each(|&hole| drawn[hole as usize] = false);
        drawn
    }
}

/// The numbers of the sub-faces of a face with that many corners: -1 alone for a quad, which is parametrized as a whole, else one per
/// corner, which stands for the child quad there.
#[must_use]
pub fn sub_faces(corners: usize) -> Range<i32> {
    if corners == 4 { -1..0 } else { 0..corners as i32 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_obj;

    /// 3 x 3 squares, numbered row by row, as quads or cut in two triangles each.
    fn sheet(triangles: bool, tags: &str) -> Cage {
        let mut text = String::new();
        for v in 0..16 {
            text += &format!("v {} {} 0\n", v % 4, v / 4);
        }
        for square in 0..9 {
            let v = 1 + square % 3 + 4 * (square / 3);
            let [a, b, c, d] = [v, v + 1, v + 5, v + 4];
            text += &if triangles { format!("f {a} {b} {c}\nf {a} {c} {d}\n") } else { format!("f {a} {b} {c} {d}\n") };
        }
        read_obj((text + tags).as_bytes(), "sheet.obj").expect("a cage")
    }

    /// Indices of the faces that are drawn.
    fn drawn(cage: &Cage, rule: BoundaryRule) -> Vec<usize> {
        let drawn = cage.drawn_faces(rule);
        assert_eq!(drawn.len(), cage.face_count());
        (0..drawn.len()).filter(|&f| drawn[f]).collect()
    }

    #[test]
    fn all_faces_but_holes_are_drawn() {
        for rule in [BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly] {
            assert_eq!(drawn(&sheet(false, ""), rule), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
            assert_eq!(drawn(&sheet(false, "t hole 2/0/0 0 4\n"), rule), [1, 2, 3, 5, 6, 7, 8]);
        }
    }

    #[test]
    fn the_rule_none_drops_faces_that_touch_the_boundary() {
        assert_eq!(drawn(&sheet(false, ""), BoundaryRule::None), [4]);
        assert_eq!(drawn(&sheet(false, "t hole 1/0/0 4\n"), BoundaryRule::None), [0; 0]);
        // A hole is no boundary: the topology has its face.
        assert_eq!(drawn(&sheet(false, "t hole 1/0/0 0\n"), BoundaryRule::None), [4]);
    }

    #[test]
    fn one_vertex_on_the_boundary_is_enough() {
        let cage = sheet(true, "");
        // The second triangle of the second square has a vertex on the boundary, but no edge.
        let on_boundary = |&v: &u32| cage.topology().is_boundary_vertex(v);
        assert_eq!(cage.face(3).iter().filter(|v| on_boundary(v)).count(), 1);
        assert_eq!(drawn(&cage, BoundaryRule::None), [8, 9]);
    }

    #[test]
    fn quads_are_whole_and_other_faces_have_a_part_per_corner() {
        assert_eq!([3, 4, 5].map(sub_faces), [0..3, -1..0, 0..5]);
    }
}
