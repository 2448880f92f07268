//! Cages with rigs made for tests: any number of joints, skins in spaces of their own, morph targets, animations of every kind.

use glam::{DAffine3, DQuat, DVec3};
use osculate_cage::{
    Animation, AnimationChannel, AnimationSampler, Cage, CageDesc, Interpolation, Joint, MorphSet, MorphTarget,
    NodeProperty, NodeTransform, Rig, RigNode,
};

/// How to rig a cage.
#[derive(Clone, Copy, Debug)]
pub struct RigDesc {
    /// Skins: the vertices are dealt out to them in runs, and each has bind positions in a space of its own.
    pub skins: usize,
    /// Joints of each skin.
    pub joints: usize,
    /// Joints that move each vertex.
    pub influences: usize,
    /// Morph targets in a set; every second one moves every seventh vertex only.
    pub targets: usize,
    /// How far from the origin the cage and the bind spaces lie, in sizes of the cage.
    pub distance: f64,
}

impl Default for RigDesc {
    fn default() -> Self {
        Self { skins: 1, joints: 3, influences: 4, targets: 0, distance: 0.0 }
    }
}

/// The time of the last key of the animations of [`rigged`] in seconds.
pub const DURATION: f32 = 2.0;

/// All ways from key to key: an animation of [`rigged`] each, in this order.
pub const INTERPOLATIONS: [Interpolation; 3] = [Interpolation::Step, Interpolation::Linear, Interpolation::CubicSpline];

/// The same cage with a rig and animations. The same arguments give the same rig.
///
/// # Panics
/// If the rig does not fit.
pub fn rigged(cage: &Cage, desc: &RigDesc) -> Cage {
    let mut maker = Maker { random: Random(7), size: cage.bounds().half_diagonal(), desc: *desc, rig: Rig::default() };
    maker.rig.influences = if desc.influences > 4 { 8 } else { desc.influences };
    let origin = desc.distance * maker.size * DVec3::new(1.0, -0.5, 0.25);
    let spaces: Vec<DAffine3> = (0..desc.skins).map(|skin| maker.skin(skin, origin)).collect();
    for (v, &position) in cage.positions().iter().enumerate() {
        let skin = v * desc.skins / cage.vertex_count();
        maker.vertex(skin, spaces[skin].inverse().transform_point3(position + origin));
    }
    maker.targets();
    for how in INTERPOLATIONS {
        maker.animation(how);
    }
    Cage::new(CageDesc {
        positions: maker.rig.positions(&maker.rig.rest()),
        face_offsets: cage.face_offsets().to_vec(),
        face_vertices: cage.face_vertices().to_vec(),
        rig: Some(maker.rig),
        ..CageDesc::default()
    })
    .unwrap_or_else(|error| panic!("{error}"))
}

struct Maker {
    random: Random,
    size: f64,
    desc: RigDesc,
    rig: Rig,
}

impl Maker {
    /// Adds the joints of a skin as a tree, and returns the map from its bind space to the scene: that of all its joints at rest.
    fn skin(&mut self, skin: usize, origin: DVec3) -> DAffine3 {
        let first = self.rig.nodes.len() as u32;
        for joint in 0..self.desc.joints as u32 {
            let parent = (joint > 0).then(|| first + self.random.below(joint as usize) as u32);
            let step = 0.1 * self.size * self.random.vector();
            let translation = if joint == 0 { origin + step } else { step };
            let transform =
                NodeTransform::Decomposed { translation, rotation: self.random.turn(0.3), scale: DVec3::ONE };
            let name = format!("skin {skin} joint {joint}");
            self.rig.nodes.push(RigNode { name, source: first + joint, parent, transform });
        }
        let away = self.desc.distance * self.size * self.random.vector();
        let scale = DVec3::splat(1.0 + skin as f64);
        let turn = DQuat::from_rotation_y(0.7 * skin as f64);
        let to_scene = DAffine3::from_translation(origin)
            * DAffine3::from_scale_rotation_translation(scale, turn, DVec3::ZERO)
            * DAffine3::from_translation(away);
        let matrices = self.rig.node_matrices(&self.rig.rest());
        let joints = first..self.rig.nodes.len() as u32;
        self.rig
            .joints
            .extend(joints.map(|node| Joint { node, inverse_bind: matrices[node as usize].inverse() * to_scene }));
        to_scene
    }

    fn vertex(&mut self, skin: usize, bind: DVec3) {
        let (used, room) = (self.desc.influences, self.rig.influences);
        let mut weights: Vec<f32> = (0..used).map(|_| 0.05 + self.random.unit() as f32).collect();
        let sum: f32 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        weights.resize(room, 0.0);
        let first = skin * self.desc.joints;
        let mut joints: Vec<u32> = (0..used).map(|_| (first + self.random.below(self.desc.joints)) as u32).collect();
        joints.resize(room, 0);
        self.rig.bind_positions.push(bind);
        self.rig.joint_indices.extend(joints);
        self.rig.joint_weights.extend(weights);
    }

    /// Two sets of morph targets, at the first node and at the last, if there are to be any.
    fn targets(&mut self) {
        for node in [0, self.rig.nodes.len() as u32 - 1].into_iter().take(self.desc.targets) {
            let targets = (0..self.desc.targets).map(|number| self.target(number)).collect();
            let weights = (0..self.desc.targets).map(|_| self.random.unit() as f32).collect();
            self.rig.morph_sets.push(MorphSet { node, targets, weights });
        }
    }

    fn target(&mut self, number: usize) -> MorphTarget {
        let count = self.rig.bind_positions.len() as u32;
        let vertices: Vec<u32> = (0..count).step_by(if number % 2 == 1 { 7 } else { 1 }).collect();
        let offsets = vertices.iter().map(|_| (0.1 * self.size * self.random.vector()).as_vec3()).collect();
        MorphTarget { name: format!("target {number}"), vertices, offsets }
    }

    /// An animation of all rotations, of some translations and scales, and of all weights.
    fn animation(&mut self, how: Interpolation) {
        let mut animation = Animation { name: format!("{how:?}"), ..Animation::default() };
        for node in 0..self.rig.nodes.len() {
            let NodeTransform::Decomposed { translation, .. } = self.rig.nodes[node].transform else { continue };
            animate(
                &mut animation,
                node,
                NodeProperty::Rotation,
                self.keys(how, |random| random.turn(0.4).to_array().to_vec()),
            );
            if node % 3 == 0 {
                let step = 0.05 * self.size;
                let value = |random: &mut Random| (translation + step * random.vector()).to_array().to_vec();
                animate(&mut animation, node, NodeProperty::Translation, self.keys(how, value));
            }
            if node % 5 == 0 {
                let value = |random: &mut Random| (DVec3::ONE + 0.2 * random.vector()).to_array().to_vec();
                animate(&mut animation, node, NodeProperty::Scale, self.keys(how, value));
            }
        }
        for set in 0..self.rig.morph_sets.len() {
            let (node, count) = (self.rig.morph_sets[set].node as usize, self.desc.targets);
            let value = |random: &mut Random| (0..count).map(|_| random.unit()).collect();
            animate(&mut animation, node, NodeProperty::MorphWeights, self.keys(how, value));
        }
        self.rig.animations.push(animation);
    }

    /// Four keys; a spline has the difference of two values for each tangent.
    fn keys(&mut self, how: Interpolation, value: impl Fn(&mut Random) -> Vec<f64>) -> AnimationSampler {
        let times = vec![0.0, 0.3 * DURATION, 0.55 * DURATION, DURATION];
        let mut values = Vec::new();
        for _ in &times {
            let [a, b, c] = std::array::from_fn(|_| value(&mut self.random));
            let tangent: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
            let parts = if how == Interpolation::CubicSpline { vec![tangent.clone(), c, tangent] } else { vec![c] };
            values.extend(parts.into_iter().flatten().map(|x| x as f32));
        }
        AnimationSampler { times, values, interpolation: how }
    }
}

fn animate(animation: &mut Animation, node: usize, property: NodeProperty, sampler: AnimationSampler) {
    animation.channels.push(AnimationChannel { sampler: animation.samplers.len() as u32, node: node as u32, property });
    animation.samplers.push(sampler);
}

/// Numbers without a pattern (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014: SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// Each coordinate from -1 to 1.
    fn vector(&mut self) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| 2.0 * self.unit() - 1.0))
    }

    /// A rotation by at most so many radians about any axis.
    fn turn(&mut self, most: f64) -> DQuat {
        let axis = self.vector().try_normalize().unwrap_or(DVec3::X);
        DQuat::from_axis_angle(axis, most * (2.0 * self.unit() - 1.0))
    }
}
