//! Which meshes are drawn, and where.

use glam::{DMat4, DVec3};

use super::UsdError;
use super::layer::{Layer, Prim, Specifier};
use super::transform::{self, Local};
use super::values::{Time, Values};
use crate::Warning;

/// The meshes of a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Scene {
    /// The prims of the meshes, in the order of the file.
    pub(super) meshes: Vec<u32>,
    /// The times at which points or transforms of meshes have samples, rising; empty if nothing moves.
    pub(super) times: Vec<f64>,
    /// What is passed over.
    pub(super) warnings: Vec<Warning>,
}

/// What a prim hands down to those in it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// It is drawn.
    Drawn,
    /// It is no part of the scene.
    Absent,
    /// It is not drawn, with the reason.
    Hidden(&'static str),
}

impl Scene {
    pub(super) fn new(layer: &Layer, values: &Values) -> Result<Self, UsdError> {
        if layer.metadata.has_sub_layers {
            return Err(UsdError::SubLayers);
        }
        let mut scene = Self::default();
        let mut states: Vec<State> = Vec::with_capacity(layer.prims.len());
        for (index, prim) in (0..).zip(&layer.prims) {
            let outer = prim.parent.map_or(State::Drawn, |parent| states[parent as usize]);
            let state = match outer {
                State::Drawn => state(prim, values)?,
                outer => outer,
            };
            // What is in an instancer is drawn by it alone.
            states.push(if prim.type_name == "PointInstancer" { State::Absent } else { state });
            match (state, prim.arc) {
                (State::Drawn, Some(arc)) => return Err(UsdError::Arc { prim: layer.shown(index), arc }),
                (State::Drawn, None) if prim.type_name == "Mesh" => scene.meshes.push(index),
                (State::Drawn, None) => scene.pass_over(not_read(&prim.type_name)),
                (State::Hidden(what), _) if prim.type_name == "Mesh" => scene.pass_over(Some(what)),
                _ => {}
            }
        }
        if scene.meshes.is_empty() {
            return Err(UsdError::NoMeshes);
        }
        scene.times = times(layer, values, &scene.meshes)?;
        Ok(scene)
    }

    /// Where the meshes are at a time: for each the matrix from its points to the scene with y up.
    pub(super) fn places(&self, layer: &Layer, values: &Values, time: Time) -> Result<Vec<DMat4>, UsdError> {
        // A quarter turn about x brings z up.
        let root = match layer.metadata.up_axis {
            Some(b'Z') => DMat4::from_cols_array_2d(&[
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 0.0, -1.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 0.0, 1.0],
            ]),
            _ => DMat4::IDENTITY,
        };
        let mut known: Vec<Option<DMat4>> = vec![None; layer.prims.len()];
        let mut place = |mesh: u32| {
            let mut chain = Vec::new();
            let mut next = Some(mesh);
            while let Some(index) = next.filter(|&index| known[index as usize].is_none()) {
                chain.push(index);
                next = layer.prims[index as usize].parent;
            }
            let mut matrix = next.and_then(|index| known[index as usize]).unwrap_or(root);
            for index in chain.into_iter().rev() {
                let Local { matrix: local, resets } = transform::local(layer, index, values, time)?;
                matrix = if resets { root * local } else { matrix * local };
                known[index as usize] = Some(matrix);
            }
            Ok(matrix)
        };
        self.meshes.iter().map(|&mesh| place(mesh)).collect()
    }

    /// When the first frame is.
    pub(super) fn first(&self) -> Time {
        self.times.first().map_or(Time::Default, |&time| Time::Code(time))
    }

    fn pass_over(&mut self, what: Option<&'static str>) {
        let Some(what) = what else { return };
        let known = self.warnings.iter_mut().find_map(|warning| match warning {
            Warning::NotRead { what: known, count } if *known == what => Some(count),
            _ => None,
        });
        match known {
            Some(count) => *count += 1,
            None => self.warnings.push(Warning::NotRead { what, count: 1 }),
        }
    }
}

/// Points of a mesh in the scene.
pub(super) fn placed(points: &[f64], place: &DMat4) -> impl Iterator<Item = DVec3> {
    let identity = *place == DMat4::IDENTITY;
    points.chunks_exact(3).map(move |p| {
        let point = DVec3::new(p[0], p[1], p[2]);
        // Not even the sign of a zero changes without a transform. Matrices may be projective.
        if identity { point } else { place.project_point3(point) }
    })
}

fn state(prim: &Prim, values: &Values) -> Result<State, UsdError> {
    if prim.specifier != Specifier::Def || !prim.active {
        return Ok(State::Absent);
    }
    if is_no_geometry(&prim.type_name) {
        return Ok(State::Absent);
    }
    if values.word(prim.attribute("visibility"))?.as_deref() == Some("invisible") {
        return Ok(State::Hidden("invisible mesh"));
    }
    Ok(match values.word(prim.attribute("purpose"))?.as_deref() {
        Some("guide") => State::Hidden("guide mesh"),
        Some("proxy") => State::Hidden("proxy mesh"),
        _ => State::Drawn,
    })
}

/// Prims in which there are no meshes: what is brought in from elsewhere there does not matter.
fn is_no_geometry(type_name: &str) -> bool {
    type_name.ends_with("Light")
        || type_name.ends_with("Animation")
        || matches!(type_name, "Material" | "Shader" | "NodeGraph" | "Camera" | "RenderSettings" | "PhysicsScene")
}

/// What a prim of a type is called in a warning, if it has a shape that is not read.
fn not_read(type_name: &str) -> Option<&'static str> {
    match type_name {
        "BasisCurves" | "NurbsCurves" | "HermiteCurves" => Some("set of curves"),
        "Capsule" | "Capsule_1" => Some("capsule"),
        "Cone" => Some("cone"),
        "Cube" => Some("cube prim"),
        "Cylinder" | "Cylinder_1" => Some("cylinder"),
        "NurbsPatch" => Some("NURBS patch"),
        "Plane" => Some("plane prim"),
        "PointInstancer" => Some("point instancer"),
        "Points" => Some("set of points"),
        "Skeleton" => Some("skeleton"),
        "Sphere" => Some("sphere"),
        "TetMesh" => Some("tetrahedral mesh"),
        "Volume" => Some("volume"),
        _ => None,
    }
}

/// All times of samples of points and of what moves meshes.
fn times(layer: &Layer, values: &Values, meshes: &[u32]) -> Result<Vec<f64>, UsdError> {
    let mut moving = vec![false; layer.prims.len()];
    let mut times: Vec<f64> = Vec::new();
    for &mesh in meshes {
        let points = layer.prims[mesh as usize].attribute("points");
        times.extend(points.iter().flat_map(|points| &points.samples).map(|sample| sample.time));
        let mut next = Some(mesh);
        while let Some(index) = next.filter(|&index| !moving[index as usize]) {
            moving[index as usize] = true;
            let prim = &layer.prims[index as usize];
            for name in transform::operations(prim, values)? {
                let samples = prim.attribute(&name).map(|attribute| attribute.samples.as_slice()).unwrap_or_default();
                times.extend(samples.iter().map(|sample| sample.time));
            }
            next = prim.parent;
        }
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    Ok(times)
}
