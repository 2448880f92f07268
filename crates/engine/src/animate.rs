//! Cages that a rig moves, on the device: "only the vertices of the coarsest control mesh need be transferred and skinned" (the
//! report, section 1). The host computes a matrix for each joint; `animate/skin.comp` moves the vertices, and everything else follows
//! from them.

mod groups;
mod reach;
mod tables;

use glam::{DAffine3, DMat3};
use osculate_cage::{Bounds, Cage, Pose, Rig};
use osculate_gpu::{Bindings, Buffer, BufferDesc, BufferUsage, Memory, Recording};
use osculate_shaders::binding;
use osculate_shaders::layout::KernelPush;

use crate::kernels::Kernel;
use crate::{CageSpace, Engine, EngineError, Surface};
use reach::Reach;
use tables::SkinTables;

/// The rows of a joint's matrix, from its bind frame to cage space.
type JointRows = [[f32; 4]; 3];

/// Moves the cage of one surface by its rig: the host computes joint matrices, the device moves vertices.
///
/// ```no_run
/// # fn play(engine: &osculate::Engine, cage: &osculate::Cage) -> Result<(), osculate::EngineError> {
/// use osculate::{Animator, Recording, Surface, SurfaceDesc};
///
/// let surface = Surface::new(engine, cage, &SurfaceDesc::default())?;
/// let mut animator = Animator::new(&surface, cage)?;
/// animator.set_time(0, 0.5)?;
/// let mut recording = Recording::new();
/// animator.record(&mut recording)?;
/// surface.record_derived(&mut recording)?;
/// engine.device().submit(&recording)?.wait()?;
/// # Ok(())
/// # }
/// ```
pub struct Animator {
    engine: Engine,
    rig: Rig,
    /// The frames of the joints' vertices.
    frames: Vec<CageSpace>,
    reach: Reach,
    space: CageSpace,
    joints: PerPose,
    morph_weights: PerPose,
    bindings: Bindings,
}

/// A table that changes with the pose: where the host writes it, and where the kernel reads it.
struct PerPose {
    staging: Buffer,
    table: Buffer,
}

impl PerPose {
    fn new(engine: &Engine, name: &str, size: u64) -> Result<Self, EngineError> {
        let buffer = |memory| engine.device().buffer(&BufferDesc { name, size, usage: BufferUsage::STORAGE, memory });
        Ok(Self { staging: buffer(Memory::Upload)?, table: buffer(Memory::Device)? })
    }

    fn record(&self, recording: &mut Recording) {
        if self.staging.size() > 0 {
            recording.copy_buffer(&self.staging, 0..self.staging.size(), &self.table, 0);
        }
    }
}

impl Animator {
    /// Uploads what the rig of `cage` moves its vertices by, and sets the pose at rest. The surface must be one of that cage.
    ///
    /// # Errors
    /// If the cage has no rig or another number of vertices than the surface's, or the device fails.
    pub fn new(surface: &Surface, cage: &Cage) -> Result<Self, EngineError> {
        let rig = cage.rig().ok_or(EngineError::NoRig)?.clone();
        let expected = surface.plan().cage_points as usize;
        if rig.bind_positions.len() != expected {
            return Err(EngineError::PointCount { expected, found: rig.bind_positions.len() });
        }
        let tables = SkinTables::new(&rig);
        let engine = surface.engine().clone();
        let targets = rig.morph_sets.iter().map(|set| set.targets.len()).sum::<usize>();
        let joints = PerPose::new(&engine, "joints", (rig.joints.len() * size_of::<JointRows>()) as u64)?;
        let morph_weights = PerPose::new(&engine, "morph weights", (targets * size_of::<f32>()) as u64)?;
        let mut uploader = crate::buffers::Uploader::new(engine.device());
        let bindings = Bindings::new()
            .with(binding::POINTS, &surface.buffers().points)
            .with(binding::SKIN_VERTICES, &uploader.table("skinned vertices", &tables.vertices)?)
            .with(binding::SKIN_INFLUENCES, &uploader.table("influences of joints", &tables.influences)?)
            .with(binding::MORPH_OFFSETS, &uploader.table("morph offsets", &tables.offsets)?)
            .with(binding::JOINTS, &joints.table)
            .with(binding::MORPH_WEIGHTS, &morph_weights.table);
        let (reach, rest) = (Reach::new(&rig), rig.rest());
        let space = *surface.space();
        let mut animator = Self { engine, rig, frames: tables.frames, reach, space, joints, morph_weights, bindings };
        animator.set_pose(&rest)?;
        Ok(animator)
    }

    /// The rig.
    pub fn rig(&self) -> &Rig {
        &self.rig
    }

    /// Sets the pose of an animation at a time in seconds, once work that still reads the last pose is done.
    ///
    /// # Errors
    /// If there is no such animation, or the pose cannot be computed with.
    pub fn set_time(&mut self, animation: usize, seconds: f64) -> Result<(), EngineError> {
        let count = self.rig.animations.len();
        if animation >= count {
            return Err(EngineError::NoSuchAnimation { animation, count });
        }
        self.set_pose(&self.rig.pose(animation, seconds))
    }

    /// Sets the pose that [`Self::record`] moves vertices to, once work that still reads the last one is done.
    ///
    /// # Errors
    /// If the pose is not one of this rig, or its matrices are beyond the range of 32-bit floats.
    pub fn set_pose(&mut self, pose: &Pose) -> Result<(), EngineError> {
        self.check(pose)?;
        let weights: Vec<f32> = pose.morph_weights.iter().flatten().map(|&weight| weight as f32).collect();
        if let Some(target) = weights.iter().position(|weight| !weight.is_finite()) {
            return Err(EngineError::Pose { reason: format!("the weight of morph target {target} is not finite") });
        }
        let matrices = self.rig.joint_matrices(pose);
        let rows: Vec<JointRows> =
            matrices.iter().zip(&self.frames).map(|(matrix, frame)| rows(matrix, frame, &self.space)).collect();
        if let Some(joint) = rows.iter().position(|rows| !rows.as_flattened().iter().all(|x| x.is_finite())) {
            let name = &self.rig.nodes[self.rig.joints[joint].node as usize].name;
            return Err(EngineError::Pose { reason: format!("the matrix of joint {name:?} is not finite") });
        }
        self.joints.staging.write(0, &rows)?;
        self.morph_weights.staging.write(0, &weights)?;
        Ok(())
    }

    /// Adds the pass that moves the cage's vertices on the device. What follows from them is [`Surface::record_derived`].
    ///
    /// # Errors
    /// If the pipeline cannot be made.
    pub fn record(&self, recording: &mut Recording) -> Result<(), EngineError> {
        self.joints.record(recording);
        self.morph_weights.record(recording);
        let count = self.rig.bind_positions.len() as u32;
        let push = KernelPush { count, first: 0, old_distance: 0 };
        Kernel { shader: "animate/skin.comp", bindings: &self.bindings, push, threads: count }
            .record(&self.engine, recording)
    }

    /// A box around the cage in a pose, in the units of the file: all vertices lie in it, and it may be larger than need be. It takes
    /// as long as the rig has joints, however many vertices there are.
    ///
    /// # Errors
    /// If the pose is not one of this rig.
    pub fn bounds(&self, pose: &Pose) -> Result<Bounds, EngineError> {
        self.check(pose)?;
        Ok(self.reach.bounds(&self.rig.joint_matrices(pose), pose))
    }

    /// Whether the pose has as many transforms and weights as the rig has nodes and targets.
    fn check(&self, pose: &Pose) -> Result<(), EngineError> {
        let weights = pose.morph_weights.iter().map(Vec::len);
        if pose.transforms.len() == self.rig.nodes.len()
            && weights.eq(self.rig.morph_sets.iter().map(|set| set.targets.len()))
        {
            return Ok(());
        }
        Err(EngineError::Pose { reason: "it has other numbers of nodes or morph targets than the rig".to_owned() })
    }
}

impl Surface {
    /// Moves the cage to the pose that `animator` was set to, and recomputes everything that follows.
    ///
    /// # Errors
    /// If a pipeline cannot be made, or the device fails.
    pub fn animate(&mut self, animator: &Animator) -> Result<(), EngineError> {
        let mut recording = Recording::new();
        animator.record(&mut recording)?;
        self.record_derived(&mut recording)?;
        self.engine().device().submit(&recording)?.wait()?;
        Ok(())
    }
}

/// A joint's matrix between the spaces that the kernel computes in. Both are near the vertices, so what is large cancels here, in f64.
fn rows(matrix: &DAffine3, frame: &CageSpace, space: &CageSpace) -> JointRows {
    let linear = DMat3::from_cols_array(&matrix.matrix3.to_cols_array().map(|x| x * (space.scale / frame.scale)));
    let translation = space.enter_exactly(matrix.transform_point3(frame.centre));
    [0, 1, 2].map(|row| linear.row(row).extend(translation[row]).as_vec4().to_array())
}
