//! Reading names and decorations of a SPIR-V module.

use rspirv::dr::{Module, Operand};
use rspirv::spirv::Decoration;
use std::ops::Deref;

/// A parsed module.
pub(crate) struct SpirvModule(Module);

impl Deref for SpirvModule {
    type Target = Module;

    fn deref(&self) -> &Module {
        &self.0
    }
}

impl SpirvModule {
    /// Parses words that come from our own compiler.
    pub(crate) fn load(words: &[u32]) -> Self {
        Self(rspirv::dr::load_words(words).expect("the shader compiler writes valid SPIR-V"))
    }

    /// The name that the source gives to an id.
    pub(crate) fn name(&self, id: u32) -> Option<&str> {
        self.debug_names.iter().find_map(|instruction| match instruction.operands.as_slice() {
            [Operand::IdRef(target), Operand::LiteralString(name)] if *target == id => Some(name.as_str()),
            _ => None,
        })
    }

    /// Ids with a decoration that has no further operand of interest.
    pub(crate) fn decorated(&self, wanted: Decoration) -> impl Iterator<Item = u32> + '_ {
        self.annotations.iter().filter_map(move |instruction| match instruction.operands.as_slice() {
            [Operand::IdRef(id), Operand::Decoration(decoration), ..] if *decoration == wanted => Some(*id),
            _ => None,
        })
    }
}
