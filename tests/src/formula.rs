//! Patches in f64 from the points and coefficients that the device has: what its formulas would give without rounding.

use std::collections::HashMap;
use std::rc::Rc;

use glam::{DVec3, Vec3};
use osculate::Surface;
use osculate_subdiv::{PatchForm, PatchKind, PatchRecord};
use osculate_surface::jet::Jet;
use osculate_surface::{NetKind, bezier, biseptic, bspline, gregory, stam};

/// A patch, in cage space: its formula and what that is applied to.
pub enum Formula {
    /// Bezier points.
    Bicubic([DVec3; 16]),
    /// Gregory points.
    Gregory([DVec3; 20]),
    /// Eigenbasis and coefficients.
    Stam(Rc<stam::Patch>, Vec<DVec3>),
    /// Bezier points.
    Biseptic(Box<[DVec3; 64]>),
    /// Points of a quartic Gregory triangle.
    Triangle([DVec3; 15]),
}

impl Formula {
    /// Point and derivatives at (u,v); at an irregular vertex of the exact surface the derivatives, which do not exist, are zero.
    pub fn jet(&self, u: f64, v: f64) -> Jet {
        match self {
            Self::Gregory(points) => gregory::evaluate(points, u, v),
            Self::Triangle(points) => gregory::evaluate_triangle(points, u, v),
            _ => self.frozen_jet(u, v),
        }
    }

    /// The same with the blend of Gregory patches held fixed, as shaders differentiate it.
    pub fn frozen_jet(&self, u: f64, v: f64) -> Jet {
        match self {
            Self::Bicubic(points) => bezier::patch(points, u, v),
            Self::Gregory(points) => bezier::patch(&gregory::bezier_grid(points, u, v), u, v),
            Self::Stam(patch, coefficients) => patch.evaluate(coefficients, u, v),
            Self::Biseptic(points) => biseptic::evaluate(points, u, v),
            Self::Triangle(points) => gregory::evaluate_triangle_frozen(points, u, v),
        }
    }
}

/// All patches of a surface, in order.
///
/// # Panics
/// If the device fails.
pub fn patches(surface: &Surface) -> Vec<Formula> {
    let vectors = |read: Vec<[f32; 3]>| read.into_iter().map(|p| Vec3::from(p).as_dvec3()).collect();
    let mut reader = Reader {
        surface,
        points: vectors(surface.read_points().expect("points can be read")),
        stored: vectors(surface.read_coefficients().expect("coefficients can be read")),
        eigenbases: HashMap::new(),
    };
    surface.plan().patches.iter().map(|record| reader.patch(record)).collect()
}

struct Reader<'a> {
    surface: &'a Surface,
    points: Vec<DVec3>,
    stored: Vec<DVec3>,
    /// By the first weight of their table.
    eigenbases: HashMap<u32, Rc<stam::Patch>>,
}

fn array<const N: usize>(points: Vec<DVec3>) -> [DVec3; N] {
    points.try_into().expect("as many rows as points")
}

impl Reader<'_> {
    fn patch(&mut self, record: &PatchRecord) -> Formula {
        let interior = NetKind::Interior { valence: record.valence() };
        match record.kind() {
            PatchKind::Unrefined | PatchKind::Regular => {
                Formula::Bicubic(array(bspline::patch_to_bezier().apply(&self.net(record))))
            }
            PatchKind::Extraordinary { form: PatchForm::Gregory, .. } => {
                Formula::Gregory(array(gregory::gregory2(interior).apply(&self.net(record))))
            }
            PatchKind::Extraordinary { form: PatchForm::Stam, .. } => {
                let patch = self.eigenbasis(record);
                let coefficients = patch.project(&self.net(record));
                Formula::Stam(patch, coefficients)
            }
            PatchKind::Extraordinary { form: PatchForm::Biseptic, valence } => {
                Formula::Biseptic(Box::new(array(biseptic::patch(valence).apply(&self.net(record)))))
            }
            PatchKind::Stored { form: PatchForm::Triangle } => Formula::Triangle(array(self.stored(record, 15))),
            PatchKind::Stored { form: PatchForm::Gregory } => Formula::Gregory(array(self.stored(record, 20))),
            PatchKind::Stored { form: PatchForm::Stam } => {
                Formula::Stam(self.eigenbasis(record), self.stored(record, record.net_size))
            }
            kind => panic!("patches are not made as {kind:?}"),
        }
    }

    fn net(&self, record: &PatchRecord) -> Vec<DVec3> {
        let net = &self.surface.plan().nets[record.net as usize..][..record.net_size as usize];
        net.iter().map(|&i| self.points[i as usize]).collect()
    }

    fn stored(&self, record: &PatchRecord, count: u32) -> Vec<DVec3> {
        self.stored[record.net as usize..][..count as usize].to_vec()
    }

    fn eigenbasis(&mut self, record: &PatchRecord) -> Rc<stam::Patch> {
        let weights = &self.surface.plan().weights[record.basis as usize..];
        self.eigenbases.entry(record.basis).or_insert_with(|| Rc::new(find_eigenbasis(record, weights))).clone()
    }
}

/// A record does not say which of the faces at a boundary vertex it is: its weights do.
fn find_eigenbasis(record: &PatchRecord, weights: &[f32]) -> stam::Patch {
    if !record.is_boundary() {
        return stam::Patch::new(NetKind::Interior { valence: record.valence() });
    }
    let faces = record.valence() - 1;
    let candidates = (0..faces).map(|quad| NetKind::Crease { faces, quad });
    let mut found = candidates.filter(|kind| kind.net_size() == record.net_size as usize).map(stam::Patch::new);
    found.find(|patch| weights.starts_with(&patch.table().projection)).expect("the weights of a face at the vertex")
}
