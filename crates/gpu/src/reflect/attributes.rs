//! What vertex shaders read from vertex buffers.

use std::collections::HashMap;

use rspirv::{
    dr::{Instruction, Operand},
    spirv::{Op, Word},
};

use super::VertexInput;
use crate::Numbers;

/// How many inputs every Vulkan device allows (`maxVertexInputAttributes`), and one more than the largest location.
pub(super) const MAX_INPUTS: u32 = 16;

/// The input that a variable of this type stands for, or what is wrong with it.
pub(super) fn input(
    types: &HashMap<Word, &Instruction>,
    location: u32,
    declared: Word,
) -> Result<VertexInput, &'static str> {
    if location >= MAX_INPUTS {
        return Err("an input at a location above 15");
    }
    let declared = types.get(&declared).ok_or("of no type")?;
    let (number, components) = match (declared.class.opcode, declared.operands.as_slice()) {
        (Op::TypeVector, [Operand::IdRef(part), Operand::LiteralBit32(count)]) => {
            (*types.get(part).ok_or("a vector of no type")?, *count)
        }
        _ => (*declared, 1),
    };
    let numbers = match (number.class.opcode, number.operands.as_slice()) {
        (Op::TypeFloat, [Operand::LiteralBit32(32), ..]) => Numbers::Float,
        (Op::TypeInt, [Operand::LiteralBit32(32), Operand::LiteralBit32(0)]) => Numbers::Uint,
        (Op::TypeInt, [Operand::LiteralBit32(32), _]) => Numbers::Int,
        _ => return Err("an input that is neither a number of 32 bits nor a vector of them"),
    };
    Ok(VertexInput { location, numbers, components })
}
