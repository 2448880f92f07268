//! An open shell whose boundary has vertices of every number of faces from 1 to 5.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, dvec3};

use super::mesh::{Mesh, Welder};
use super::star::{quad, squares};

/// Sectors that meet at the centre, side by side: the centre is a boundary vertex with this many faces.
const SECTORS: usize = 5;
/// Quads along each side of a sector.
const SIDE: usize = 4;
/// Angle of the mouth between the last sector and the first.
const MOUTH: f64 = 0.9;
/// The sector that lacks the quarter beyond [`MIDDLE`]: three faces meet inside the notch.
const NOTCHED: usize = 3;
/// The sector slit from the rim to its middle: four faces meet at the end of the slit.
const SLIT: usize = 1;
/// Half the side of a sector.
const MIDDLE: usize = SIDE / 2;

/// A disc of five square sectors with a mouth, a notch and a slit.
pub(super) fn shell() -> Mesh {
    let mut welder = Welder::new();
    let mut faces = Vec::new();
    for sector in 0..SECTORS {
        for (i, j) in squares(SIDE).filter(|&(i, j)| !(sector == NOTCHED && i >= MIDDLE && j >= MIDDLE)) {
            let nodes = quad(i, j).map(|corner| Node::of(sector, i, corner));
            faces.push(nodes.map(|node| welder.index(node, || node.position())).into());
        }
    }
    Mesh::new(welder.points, faces)
}

/// The shell with the tag that rounds its boundary corners: OpenSubdiv's rule "edge only".
pub(super) fn shell_edge_only() -> Mesh {
    Mesh { tags: vec!["t interpolateboundary 1/0/0 2"], ..shell() }
}

/// The name of a vertex.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Node {
    sector: usize,
    i: usize,
    j: usize,
    /// Side of the slit: -1 and 1 on its banks, 0 elsewhere.
    bank: i8,
}

impl Node {
    /// The node at a corner of a quad in column `column` of a sector.
    fn of(sector: usize, column: usize, (i, j): (usize, usize)) -> Self {
        let on_slit = sector == SLIT && i == MIDDLE && j > MIDDLE;
        let bank = if !on_slit {
            0
        } else if column < MIDDLE {
            -1
        } else {
            1
        };
        match (i, j) {
            (0, 0) => Self { sector: 0, i, j, bank },
            (0, j) if sector + 1 < SECTORS => Self { sector: sector + 1, i: j, j: 0, bank },
            _ => Self { sector, i, j, bank },
        }
    }

    fn position(self) -> DVec3 {
        let opening = 0.2 * f64::from(self.bank) * (self.j as f64 - MIDDLE as f64);
        lift(place(self.sector, self.i as f64 + opening, self.j as f64))
    }
}

/// Plane position of (i, j) in a sector: polar, the rim slightly scalloped.
fn place(sector: usize, i: f64, j: f64) -> DVec2 {
    let (near, far) = (i.min(j), i.max(j));
    if far == 0.0 {
        return DVec2::ZERO;
    }
    let angle = 0.5 * MOUTH + (TAU - MOUTH) / SECTORS as f64 * (sector as f64 + j / (i + j));
    (1.0 + 0.25 * near / far) * far / SIDE as f64 * DVec2::from_angle(angle)
}

/// Lifts a plane position, counter-clockwise seen from above, onto a wavy dome.
fn lift(p: DVec2) -> DVec3 {
    dvec3(p.x, 0.5 - 0.4 * p.length_squared() + 0.1 * (3.0 * p.x).sin(), -p.y)
}
