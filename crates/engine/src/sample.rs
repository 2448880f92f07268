//! Points of the surface on request, evaluated on the device by the includes of the evaluation stages.

use std::collections::BTreeSet;

use glam::{DVec3, Vec3};
use osculate_gpu::{BufferDesc, BufferUsage, Memory, Recording};
use osculate_shaders::binding;
use osculate_shaders::constant::SAMPLE_FLOATS;
use osculate_shaders::layout::{KernelPush, SampleRequest};
use osculate_subdiv::{NONE, PatchForm, PatchPoint, SubFace};

use crate::kernels::Kernel;
use crate::keys::corner_of;
use crate::{EngineError, Surface};

/// A point of the surface: (s,t) of a base quad, or of a sub-face of any other face.
///
#[doc = include_str!("../doc/surface_point.svg")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where on the cage.
    pub sub_face: SubFace,
    /// First coordinate, 0 to 1.
    pub s: f64,
    /// Second coordinate, 0 to 1.
    pub t: f64,
}

/// The surface at a point, in the cage's own coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Position.
    pub position: DVec3,
    /// Derivative with respect to s.
    pub du: DVec3,
    /// Derivative with respect to t.
    pub dv: DVec3,
    /// Unit normal; zero where there is none.
    pub normal: DVec3,
    /// The point is a corner at an irregular vertex: `du` and `dv` are the patch's, not limits.
    pub irregular: bool,
}

/// A point of a patch, and how it is asked for.
struct Found {
    request: SampleRequest,
    point: PatchPoint,
}

/// Requests sent at once.
const CHUNK: usize = 1 << 20;

/// Floats of a sample.
const SAMPLE: usize = SAMPLE_FLOATS as usize;

/// The sampling kernel of a form.
fn kernel(form: PatchForm) -> &'static str {
    match form {
        PatchForm::Bicubic => "sample/bicubic.comp",
        PatchForm::Gregory => "sample/gregory.comp",
        PatchForm::Stam => "sample/stam.comp",
        PatchForm::Biseptic => "sample/biseptic.comp",
        PatchForm::Triangle => "sample/triangle.comp",
    }
}

impl Surface {
    /// Evaluates points.
    ///
    /// # Errors
    /// If a point does not exist (no such face, outside the unit square, in a face that is not drawn), or the device fails.
    pub fn sample(&self, points: &[SurfacePoint]) -> Result<Vec<Sample>, EngineError> {
        let found = points.iter().map(|point| self.find(point)).collect::<Result<Vec<_>, _>>()?;
        let mut samples = Vec::with_capacity(points.len());
        for chunk in found.chunks(CHUNK) {
            let requests: Vec<SampleRequest> = chunk.iter().map(|found| found.request).collect();
            let values = self.evaluate(&requests)?;
            samples.extend(chunk.iter().zip(values.chunks_exact(SAMPLE)).map(|(found, v)| self.finish(found, v)));
        }
        Ok(samples)
    }

    /// Patch and parameters of a point.
    fn find(&self, point: &SurfacePoint) -> Result<Found, EngineError> {
        let &SurfacePoint { sub_face: SubFace { face, sub }, s, t } = point;
        let error = |reason| EngineError::NoSuchPoint { face, sub, s, t, reason };
        if !((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)) {
            return Err(error("s and t go from 0 to 1"));
        }
        let found = self.plan().locator.find(point.sub_face, [s, t]);
        let point = found.ok_or_else(|| error("the cage has no such face or sub-face; quads have sub -1"))?;
        match self.plan().patch_of_quad[point.face as usize] {
            NONE => Err(error("the face is not drawn: it is a hole, or at the boundary under the rule none")),
            patch_id => {
                let [u, v] = point.uv.map(|x| x as f32);
                Ok(Found { request: SampleRequest { patch_id, u, v }, point })
            }
        }
    }

    /// How a point is asked for.
    pub(crate) fn request(&self, point: &SurfacePoint) -> Result<SampleRequest, EngineError> {
        Ok(self.find(point)?.request)
    }

    /// Raw output of the sampling kernels: position, du, dv, normal of each request, in cage space.
    ///
    /// # Errors
    /// If the device fails.
    pub fn evaluate(&self, requests: &[SampleRequest]) -> Result<Vec<f32>, EngineError> {
        let mut values = vec![0.0; requests.len() * SAMPLE];
        let form = |request: &SampleRequest| self.plan().patches[request.patch_id as usize].kind().form();
        let forms: BTreeSet<PatchForm> = requests.iter().map(form).collect();
        self.engine().prepare(forms.iter().map(|&form| kernel(form)), [])?;
        for kind in forms {
            let (at, of_form): (Vec<usize>, Vec<SampleRequest>) =
                requests.iter().copied().enumerate().filter(|(_, request)| form(request) == kind).unzip();
            let found = self.evaluate_form(kind, &of_form)?;
            for (at, sample) in at.into_iter().zip(found.chunks_exact(SAMPLE)) {
                values[at * SAMPLE..][..SAMPLE].copy_from_slice(sample);
            }
        }
        Ok(values)
    }

    /// The same for patches of one form.
    fn evaluate_form(&self, form: PatchForm, requests: &[SampleRequest]) -> Result<Vec<f32>, EngineError> {
        let device = self.engine().device();
        let size = (requests.len() * SAMPLE * 4) as u64;
        let (usage, memory) = (BufferUsage::STORAGE, Memory::Readback);
        let output = device.buffer(&BufferDesc { name: "samples", size, usage, memory })?;
        let bindings = self
            .buffers()
            .patches
            .clone()
            .with(binding::REQUESTS, &device.upload("sample requests", BufferUsage::STORAGE, requests)?)
            .with(binding::SAMPLES, &output);
        let count = requests.len() as u32;
        let mut recording = Recording::new();
        let push = KernelPush { count, first: 0, old_distance: 0 };
        Kernel { shader: kernel(form), bindings: &bindings, push, threads: count }
            .record(self.engine(), &mut recording)?;
        device.run(&recording)?;
        Ok(output.read(0..size)?)
    }

    fn finish(&self, Found { request, point }: &Found, values: &[f32]) -> Sample {
        let vector = |i: usize| Vec3::from_slice(&values[3 * i..]);
        let (du, dv) = (self.space().leave_vector(vector(1)), self.space().leave_vector(vector(2)));
        let [du, dv] = point.derivatives(du, dv);
        let corner = corner_of(&self.plan().patches[request.patch_id as usize], [request.u, request.v]);
        Sample {
            position: self.space().leave(vector(0)),
            du,
            dv,
            normal: vector(3).as_dvec3(),
            irregular: corner.is_some_and(|corner| self.plan().is_irregular_corner(request.patch_id, corner)),
        }
    }
}
