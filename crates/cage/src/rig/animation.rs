//! Animations: values of nodes over time.

use glam::{DQuat, DVec3};

use super::{NodeTransform, Pose, Rig};

/// What an animation changes of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NodeProperty {
    /// The translation, three values.
    Translation,
    /// The rotation, a quaternion x, y, z, w.
    Rotation,
    /// The scale, three values.
    Scale,
    /// The weights of the morph targets of the node's mesh, one value for each.
    MorphWeights,
}

/// What a sampler does between two keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// Keeps the value of the earlier key.
    Step,
    /// Goes straight from value to value; rotations along the shorter arc.
    #[default]
    Linear,
    /// A cubic Hermite spline; for each key: in-tangent, value, out-tangent, tangents per second.
    CubicSpline,
}

/// Values at rising times.
#[derive(Clone, Debug, PartialEq)]
pub struct AnimationSampler {
    /// The times of the keys in seconds, rising, at least one.
    pub times: Vec<f32>,
    /// The values of all keys, each as long as the property that they go to; three of them per key for a cubic spline.
    pub values: Vec<f32>,
    /// What happens between keys.
    pub interpolation: Interpolation,
}

/// What a sampler's values go to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnimationChannel {
    /// The sampler, an index of [`Animation::samplers`].
    pub sampler: u32,
    /// The node, an index of [`Rig::nodes`].
    pub node: u32,
    /// What of it.
    pub property: NodeProperty,
}

/// A named set of channels that play together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// Its name, or one made from its index in the file.
    pub name: String,
    /// The values.
    pub samplers: Vec<AnimationSampler>,
    /// Where they go.
    pub channels: Vec<AnimationChannel>,
}

impl AnimationSampler {
    /// How many numbers one value has.
    #[must_use]
    pub fn width(&self) -> usize {
        self.values.len() / (self.times.len().max(1) * self.parts())
    }

    /// Values per key.
    fn parts(&self) -> usize {
        if self.interpolation == Interpolation::CubicSpline { 3 } else { 1 }
    }

    /// The value at `time` in seconds, that of the first or last key outside of their times; quaternions are not of unit length yet.
    #[must_use]
    pub fn at(&self, time: f64, quaternion: bool) -> Vec<f64> {
        let next = self.times.partition_point(|&t| f64::from(t) <= time);
        if next == 0 || next == self.times.len() {
            return self.key(next.saturating_sub(1));
        }
        let [t0, t1] = [next - 1, next].map(|key| f64::from(self.times[key]));
        let x = (time - t0) / (t1 - t0);
        let [a, b] = [self.key(next - 1), self.key(next)];
        match self.interpolation {
            Interpolation::Step => a,
            Interpolation::Linear if quaternion => slerp(&a, &b, x),
            Interpolation::Linear => a.iter().zip(&b).map(|(a, b)| a + (b - a) * x).collect(),
            Interpolation::CubicSpline => self.spline(next - 1, t1 - t0, x),
        }
    }

    fn key(&self, key: usize) -> Vec<f64> {
        // The value of a cubic spline is the second of three.
        self.part(key * self.parts() + self.parts() / 2)
    }

    fn part(&self, part: usize) -> Vec<f64> {
        self.values[part * self.width()..][..self.width()].iter().map(|&x| f64::from(x)).collect()
    }

    /// The cubic Hermite spline of the glTF 2.0 specification, appendix C.5, after `key`.
    fn spline(&self, key: usize, duration: f64, x: f64) -> Vec<f64> {
        let [p0, m0, m1, p1] = [1, 2, 3, 4].map(|part| self.part(3 * key + part));
        let (x2, x3) = (x * x, x * x * x);
        let [h0, h1, h2, h3] = [2.0 * x3 - 3.0 * x2 + 1.0, x3 - 2.0 * x2 + x, x3 - x2, -2.0 * x3 + 3.0 * x2];
        (0..p0.len()).map(|i| h0 * p0[i] + h1 * duration * m0[i] + h2 * duration * m1[i] + h3 * p1[i]).collect()
    }
}

fn slerp(a: &[f64], b: &[f64], x: f64) -> Vec<f64> {
    let [a, b] = [a, b].map(unit_quaternion);
    a.slerp(b, x).to_array().to_vec()
}

/// A quaternion of unit length; the identity if there is no direction.
pub(crate) fn unit_quaternion(values: &[f64]) -> DQuat {
    let [x, y, z, w] = *values else { return DQuat::IDENTITY };
    let quaternion = DQuat::from_xyzw(x, y, z, w);
    let length = quaternion.length();
    if length > 0.0 && length.is_finite() { quaternion * (1.0 / length) } else { DQuat::IDENTITY }
}

impl Animation {
    /// The time of the last key in seconds.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.samplers.iter().filter_map(|sampler| sampler.times.last()).fold(0.0, |end, &t| f64::from(t).max(end))
    }

    /// Changes `pose` to what it is at `time` in seconds.
    pub(super) fn apply(&self, time: f64, rig: &Rig, pose: &mut Pose) {
        for &AnimationChannel { sampler, node, property } in &self.channels {
            let value = self.samplers[sampler as usize].at(time, property == NodeProperty::Rotation);
            if property == NodeProperty::MorphWeights {
                if let Some(set) = rig.morph_set_of(node) {
                    pose.morph_weights[set] = value;
                }
            } else if let NodeTransform::Decomposed { translation, rotation, scale } =
                &mut pose.transforms[node as usize]
            {
                match property {
                    NodeProperty::Translation => *translation = DVec3::from_slice(&value),
                    NodeProperty::Scale => *scale = DVec3::from_slice(&value),
                    _ => *rotation = unit_quaternion(&value),
                }
            }
        }
    }

    /// True if all channels go to what exists, with values as long as they must be.
    pub(super) fn fits(&self, rig: &Rig) -> bool {
        let samplers = self.samplers.iter().all(|sampler| {
            !sampler.times.is_empty()
                && sampler.times.is_sorted_by(|a, b| a < b)
                && sampler.values.len() == sampler.width() * sampler.parts() * sampler.times.len()
        });
        samplers && self.channels.iter().all(|channel| self.channel_fits(channel, rig))
    }

    fn channel_fits(&self, channel: &AnimationChannel, rig: &Rig) -> bool {
        let Some(sampler) = self.samplers.get(channel.sampler as usize) else { return false };
        let Some(node) = rig.nodes.get(channel.node as usize) else { return false };
        let decomposed = matches!(node.transform, NodeTransform::Decomposed { .. });
        match channel.property {
            NodeProperty::Translation | NodeProperty::Scale => sampler.width() == 3 && decomposed,
            NodeProperty::Rotation => sampler.width() == 4 && decomposed,
            NodeProperty::MorphWeights => {
                let set = rig.morph_set_of(channel.node).map(|set| &rig.morph_sets[set]);
                set.is_none_or(|set| set.targets.len() == sampler.width())
            }
        }
    }
}
