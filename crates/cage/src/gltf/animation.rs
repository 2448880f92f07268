//! Animations of nodes and of the weights of morph targets.

use std::collections::HashMap;

use ::gltf::Gltf;
use ::gltf::animation::{Channel, Interpolation as Kind, Property, Sampler};

use super::accessor::{Purpose, Vectors};
use super::buffers::Buffers;
use super::motion::Budget;
use super::scene::Scene;
use super::{AccessorError, GltfError, GltfPlace};
use crate::{Animation, AnimationChannel, AnimationSampler, Interpolation, NodeProperty, NodeTransform, Rig};

/// The animations of a file, as far as they move nodes of the scene or weights of its morph targets.
pub(super) fn read(
    gltf: &Gltf,
    scene: &Scene,
    buffers: &Buffers,
    rig: &Rig,
    budget: &mut Budget,
) -> Result<Vec<Animation>, GltfError> {
    let mut animations = Vec::new();
    for animation in gltf.animations() {
        let index = animation.index();
        let name = animation.name().map_or_else(|| format!("animation {index}"), Into::into);
        let mut reader = Reader {
            index,
            buffers,
            rig,
            budget,
            known: HashMap::new(),
            animation: Animation { name, ..Animation::default() },
        };
        for (number, channel) in animation.channels().enumerate() {
            if let Some(node) = scene.find(channel.target().node().index()) {
                reader.add(number, &channel, node)?;
            }
        }
        animations.push(reader.animation);
    }
    Ok(animations)
}

struct Reader<'a> {
    index: usize,
    buffers: &'a Buffers,
    rig: &'a Rig,
    budget: &'a mut Budget,
    /// Samplers that were read, by their index in the file and what they are read as.
    known: HashMap<(usize, Purpose), u32>,
    animation: Animation,
}

impl Reader<'_> {
    fn add(&mut self, number: usize, channel: &Channel, node: u32) -> Result<(), GltfError> {
        let (purpose, property) = match channel.target().property() {
            Property::Translation => (Purpose::Vector, NodeProperty::Translation),
            Property::Rotation => (Purpose::Rotation, NodeProperty::Rotation),
            Property::Scale => (Purpose::Vector, NodeProperty::Scale),
            Property::MorphTargetWeights => (Purpose::MorphWeight, NodeProperty::MorphWeights),
        };
        let index = self.index;
        let fault = |fault: String| GltfError::Channel { animation: index, channel: number, fault };
        let target = &self.rig.nodes[node as usize];
        let width = match property {
            NodeProperty::MorphWeights => {
                // Weights of a mesh without targets, or of none at all, move nothing.
                let Some(set) = self.rig.morph_set_of(node) else { return Ok(()) };
                self.rig.morph_sets[set].targets.len()
            }
            _ if matches!(target.transform, NodeTransform::Matrix(_)) => {
                return Err(fault(format!(
                    "moves node {}, which has a matrix; only nodes with translation, rotation and scale can be moved",
                    target.source
                )));
            }
            NodeProperty::Rotation => 4,
            _ => 3,
        };
        let sampler = channel.sampler();
        let key = (sampler.index(), purpose);
        let at = match self.known.get(&key) {
            Some(&known) => known,
            None => {
                let new = self.sampler(&sampler, purpose)?;
                self.animation.samplers.push(new);
                let at = self.animation.samplers.len() as u32 - 1;
                self.known.insert(key, at);
                at
            }
        };
        let AnimationSampler { times, values, interpolation } = &self.animation.samplers[at as usize];
        let due = times.len() * width * if *interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        if values.len() != due {
            return Err(fault(format!("has {} numbers for {} keys, but {due} are due", values.len(), times.len())));
        }
        self.animation.channels.push(AnimationChannel { sampler: at, node, property });
        Ok(())
    }

    fn sampler(&mut self, sampler: &Sampler, purpose: Purpose) -> Result<AnimationSampler, GltfError> {
        let interpolation = match sampler.interpolation() {
            Kind::Step => Interpolation::Step,
            Kind::Linear => Interpolation::Linear,
            Kind::CubicSpline => Interpolation::CubicSpline,
        };
        let values = match purpose {
            Purpose::Rotation => self.numbers::<4>(sampler, purpose)?,
            Purpose::MorphWeight => self.numbers::<1>(sampler, purpose)?,
            _ => self.numbers::<3>(sampler, purpose)?,
        };
        Ok(AnimationSampler { times: self.times(sampler)?, values, interpolation })
    }

    fn times(&mut self, sampler: &Sampler) -> Result<Vec<f32>, GltfError> {
        let times = self.numbers::<1>(sampler, Purpose::Time)?;
        let error = if times.is_empty() {
            AccessorError::Count { found: 0, due: 1 }
        } else if let Some(key) = (1..times.len()).find(|&key| times[key] <= times[key - 1]) {
            let fault = format!("is {} after {}; times must rise", times[key], times[key - 1]);
            AccessorError::Value { index: key as u32, fault }
        } else {
            return Ok(times);
        };
        Err(self.fault(sampler, Purpose::Time, error))
    }

    /// All numbers of the input or output of a sampler.
    fn numbers<const N: usize>(&mut self, sampler: &Sampler, purpose: Purpose) -> Result<Vec<f32>, GltfError> {
        let accessor = if purpose == Purpose::Time { sampler.input() } else { sampler.output() };
        let vectors =
            Vectors::<N>::new(&accessor, self.buffers, purpose).map_err(|error| self.fault(sampler, purpose, error))?;
        self.budget.take(vectors.count().saturating_mul(N))?;
        let read = || {
            let mut numbers = Vec::with_capacity(vectors.count() * N);
            for index in 0..vectors.count() as u32 {
                numbers.extend(vectors.get(index)?.map(|x| x as f32));
            }
            Ok(numbers)
        };
        read().map_err(|error| self.fault(sampler, purpose, error))
    }

    fn fault(&self, sampler: &Sampler, purpose: Purpose, error: AccessorError) -> GltfError {
        let (attribute, accessor) =
            if purpose == Purpose::Time { ("input", sampler.input()) } else { ("output", sampler.output()) };
        let place = GltfPlace::Sampler { animation: self.index, sampler: sampler.index() };
        GltfError::Accessor { place, attribute: attribute.into(), accessor: accessor.index(), error }
    }
}
