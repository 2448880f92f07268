//! Cages in the terms of the exact reference evaluator.

use osculate_surface::reference::{Boundary, Mesh};

use crate::{BoundaryRule, Cage};

impl From<&Cage> for Mesh {
    /// The whole cage, holes included: they shape the surface around them.
    fn from(cage: &Cage) -> Self {
        Self {
            positions: cage.positions().to_vec(),
            face_offsets: cage.face_offsets().to_vec(),
            face_vertices: cage.face_vertices().to_vec(),
        }
    }
}

impl From<BoundaryRule> for Boundary {
    /// The rule that gives every face of [`Cage::drawn_faces`] its surface. Under [`BoundaryRule::None`] these have no vertex on
    /// the boundary, so that no rule for it has a say.
    fn from(rule: BoundaryRule) -> Self {
        match rule {
            BoundaryRule::EdgeAndCorner | BoundaryRule::None => Self::EdgeAndCorner,
            BoundaryRule::EdgeOnly => Self::EdgeOnly,
        }
    }
}

#[cfg(test)]
mod tests {
    use osculate_surface::reference::Reference;

    use super::*;
    use crate::read_obj;

    /// 3 x 3 quads with a bump.
    fn sheet() -> Cage {
        let mut text = String::new();
        for v in 0..16 {
            text += &format!("v {} {} {}\n", v % 4, v / 4, v * v % 5);
        }
        for f in 0..9 {
            let v = 1 + f % 3 + 4 * (f / 3);
            text += &format!("f {} {} {} {}\n", v, v + 1, v + 5, v + 4);
        }
        read_obj(text.as_bytes(), "sheet.obj").expect("a cage")
    }

    #[test]
    fn a_corner_is_fixed_under_the_rule_that_says_so() {
        let cage = sheet();
        let mesh = Mesh::from(&cage);
        let corner = |rule: BoundaryRule| {
            let reference = Reference::new(&mesh, rule.into()).expect("a cage is a valid mesh");
            reference.eval(0, -1, 0.0, 0.0).expect("a corner of the sheet").position
        };
        assert_eq!(corner(BoundaryRule::EdgeAndCorner), cage.positions()[0]);
        assert_ne!(corner(BoundaryRule::EdgeOnly), cage.positions()[0]);
    }

    #[test]
    fn no_rule_has_a_say_in_faces_off_the_boundary() {
        let cage = sheet();
        let mesh = Mesh::from(&cage);
        let samples = |rule: Boundary| {
            let reference = Reference::new(&mesh, rule).expect("a cage is a valid mesh");
            let drawn = cage.drawn_faces(BoundaryRule::None);
            let faces = (0..cage.face_count()).filter(|&f| drawn[f]);
            faces.map(|f| reference.eval(f, -1, 0.25, 1.0).expect("a point of a face")).collect::<Vec<_>>()
        };
        assert_eq!(samples(Boundary::EdgeAndCorner).len(), 1);
        assert_eq!(samples(Boundary::EdgeAndCorner), samples(Boundary::EdgeOnly));
    }
}
