//! Reading of the types of images.

use std::collections::HashMap;

use rspirv::{
    dr::{Instruction, Operand},
    spirv::{Dim, ImageFormat, Op, Word},
};

use super::ResourceKind;
use crate::{Format, Numbers};

/// The kind of resource that a variable of this type is, or what it is instead.
pub(super) fn kind(types: &HashMap<Word, &Instruction>, id: Word) -> Result<ResourceKind, &'static str> {
    let declared = types.get(&id).ok_or("of no type")?;
    match (declared.class.opcode, declared.operands.as_slice()) {
        (Op::TypeSampledImage, [Operand::IdRef(image)]) => match types.get(image) {
            Some(image) => texture(types, image),
            None => Err("of no type"),
        },
        (Op::TypeImage, _) => storage_image(declared),
        (Op::TypeSampler, _) => Err("a sampler without an image"),
        (Op::TypeArray | Op::TypeRuntimeArray, _) => Err("an array of images or samplers"),
        _ => Err("neither buffer nor image"),
    }
}

fn texture(types: &HashMap<Word, &Instruction>, image: &Instruction) -> Result<ResourceKind, &'static str> {
    let (number, depth, arrayed, samples) = match image.operands.as_slice() {
        [Operand::IdRef(number), Operand::Dim(Dim::DimBuffer), ..] => {
            return numbers(types, *number).map(ResourceKind::TexelBuffer);
        }
        [Operand::IdRef(number), Operand::Dim(Dim::Dim2D), depth, arrayed, samples, ..] => {
            (number, depth, arrayed, samples)
        }
        _ => return Err("an image that is not two-dimensional"),
    };
    check_plain(arrayed, samples)?;
    if *depth == Operand::LiteralBit32(1) {
        return Err("a sampler that compares depths");
    }
    numbers(types, *number).map(ResourceKind::Texture)
}

fn storage_image(image: &Instruction) -> Result<ResourceKind, &'static str> {
    let [_, Operand::Dim(Dim::Dim2D), _, arrayed, samples, sampled, Operand::ImageFormat(format), ..] =
        image.operands.as_slice()
    else {
        return Err("an image that is not two-dimensional");
    };
    check_plain(arrayed, samples)?;
    if *sampled != Operand::LiteralBit32(2) {
        return Err("an image without its sampler");
    }
    let format = match format {
        ImageFormat::Rgba8 => Format::Rgba8Unorm,
        ImageFormat::Rgba16f => Format::Rgba16Float,
        ImageFormat::Rgba32f => Format::Rgba32Float,
        ImageFormat::R32f => Format::R32Float,
        ImageFormat::R32ui => Format::R32Uint,
        _ => return Err("a storage image of a format other than rgba8, rgba16f, rgba32f, r32f and r32ui"),
    };
    Ok(ResourceKind::StorageImage(format))
}

/// Fails for layers and for several samples.
fn check_plain(arrayed: &Operand, samples: &Operand) -> Result<(), &'static str> {
    match (arrayed, samples) {
        (Operand::LiteralBit32(0), Operand::LiteralBit32(0)) => Ok(()),
        (Operand::LiteralBit32(0), _) => Err("an image of several samples"),
        _ => Err("an image with layers"),
    }
}

fn numbers(types: &HashMap<Word, &Instruction>, id: Word) -> Result<Numbers, &'static str> {
    let number = types.get(&id).ok_or("an image of no numbers")?;
    match (number.class.opcode, number.operands.as_slice()) {
        (Op::TypeFloat, _) => Ok(Numbers::Float),
        (Op::TypeInt, [_, Operand::LiteralBit32(0)]) => Ok(Numbers::Uint),
        (Op::TypeInt, _) => Ok(Numbers::Int),
        _ => Err("an image of no numbers"),
    }
}
