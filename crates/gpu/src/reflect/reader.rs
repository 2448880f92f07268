//! Reading of a parsed module.

use std::collections::{HashMap, HashSet};

use rspirv::{
    dr::{Instruction, Module, Operand},
    spirv::{BuiltIn, Capability, Decoration, ExecutionMode, ExecutionModel, Op, StorageClass, Word},
};

use super::{
    Extent, ReflectError, Reflection, ResourceBinding, ResourceKind, SpecConstant, Stage, VertexInput, attributes,
    image,
};

/// Deepest nesting of types that is followed; a malformed module may nest a type in itself.
const MAX_DEPTH: u32 = 32;

/// What a module may need: capabilities that every Vulkan device has, and those whose features are switched on.
const CAPABILITIES: [Capability; 7] = [
    Capability::Matrix,
    Capability::Shader,
    Capability::DerivativeControl,
    Capability::ImageQuery,
    Capability::SampledBuffer,
    Capability::Tessellation,
    // Refused with the device's name by `Device::shader`, where the device lacks it.
    Capability::TransformFeedback,
];

/// One decoration of an id or of a member of a structure.
struct Decorated {
    member: Option<u32>,
    decoration: Decoration,
    value: Option<u32>,
}

/// A module with its ids looked up.
pub(super) struct Reader<'a> {
    module: &'a Module,
    names: HashMap<Word, &'a str>,
    decorations: HashMap<Word, Vec<Decorated>>,
    globals: HashMap<Word, &'a Instruction>,
    /// Whether it may use what its author has switched on, and a descriptor set 1 of theirs.
    of_caller: bool,
}

impl<'a> Reader<'a> {
    pub(super) fn new(module: &'a Module, of_caller: bool) -> Self {
        let mut decorations: HashMap<Word, Vec<Decorated>> = HashMap::new();
        for (target, decorated) in module.annotations.iter().filter_map(decorated) {
            decorations.entry(target).or_default().push(decorated);
        }
        let names = module.debug_names.iter().filter_map(|one| match one.operands.as_slice() {
            [Operand::IdRef(id), Operand::LiteralString(name)] if one.class.opcode == Op::Name => {
                Some((*id, name.as_str()))
            }
            _ => None,
        });
        let globals = module.types_global_values.iter().filter_map(|one| Some((one.result_id?, one)));
        Self { module, names: names.collect(), decorations, globals: globals.collect(), of_caller }
    }

    pub(super) fn read(&self) -> Result<Reflection, ReflectError> {
        let [entry] = self.module.entry_points.as_slice() else {
            return Err(ReflectError::EntryPoints { count: self.module.entry_points.len() });
        };
        let (stage, entry_point) = match entry.operands.as_slice() {
            [Operand::ExecutionModel(model), _, Operand::LiteralString(name), ..] => (stage(*model)?, name.clone()),
            _ => return Err(malformed("the entry point has no name")),
        };
        if !self.of_caller {
            self.check_capabilities()?;
        }
        let resources = self.resources()?;
        if let Some(written) = resources.iter().find(|one| one.writes && stage != Stage::Compute) {
            return Err(ReflectError::Write { name: written.name.clone(), stage });
        }
        Ok(Reflection {
            stage,
            entry_point,
            resources,
            inputs: if stage == Stage::Vertex { self.inputs()? } else { Vec::new() },
            push_constant_size: self.push_constant_size()?,
            specialization: self.specialization(),
            local_size: if stage == Stage::Compute { Some(self.local_size()?) } else { None },
            output_vertices: if stage == Stage::TessellationControl { self.output_vertices() } else { None },
            capture_stride: self.capture_stride(),
            uses_caller_set: self.uses_caller_set()?,
        })
    }

    fn check_capabilities(&self) -> Result<(), ReflectError> {
        let declared = self.module.capabilities.iter().filter_map(|one| match one.operands.as_slice() {
            [Operand::Capability(capability)] => Some(capability),
            _ => None,
        });
        match declared.into_iter().find(|capability| !CAPABILITIES.contains(capability)) {
            None => Ok(()),
            Some(capability) => Err(ReflectError::Capability { capability: format!("{capability:?}") }),
        }
    }

    /// Global variables that some function refers to, with storage class and the type they point to.
    fn variables(&self) -> impl Iterator<Item = Result<(Word, StorageClass, Word), ReflectError>> + '_ {
        let functions = self.module.functions.iter().flat_map(|function| function.all_inst_iter());
        let used: HashSet<Word> = functions.flat_map(|one| &one.operands).filter_map(id).collect();
        let variables = self.module.types_global_values.iter().filter(|one| one.class.opcode == Op::Variable);
        variables.filter(move |one| one.result_id.is_some_and(|id| used.contains(&id))).map(|one| self.variable(one))
    }

    fn variable(&self, instruction: &Instruction) -> Result<(Word, StorageClass, Word), ReflectError> {
        let pointer = instruction.result_type.and_then(|id| self.globals.get(&id));
        match (instruction.result_id, instruction.operands.first(), pointer.map(|one| one.operands.as_slice())) {
            (Some(id), Some(Operand::StorageClass(class)), Some([_, Operand::IdRef(pointee)])) => {
                Ok((id, *class, *pointee))
            }
            _ => Err(malformed("a variable without a pointer type")),
        }
    }

    fn resources(&self) -> Result<Vec<ResourceBinding>, ReflectError> {
        let mut resources: Vec<ResourceBinding> = Vec::new();
        for variable in self.variables() {
            let (id, class, pointee) = variable?;
            let Some(resource) = self.resource(id, class, pointee)? else { continue };
            if let Some(other) = resources.iter().find(|other| other.binding == resource.binding) {
                let (first, second) = (other.name.clone(), resource.name);
                return Err(ReflectError::Duplicate { binding: resource.binding, first, second });
            }
            resources.push(resource);
        }
        resources.sort_by_key(|resource| resource.binding);
        Ok(resources)
    }

    /// Whether a variable is in descriptor set 1, and may be.
    fn is_of_caller(&self, id: Word) -> bool {
        self.of_caller && self.value(id, None, Decoration::DescriptorSet) == Some(1)
    }

    fn uses_caller_set(&self) -> Result<bool, ReflectError> {
        self.variables().try_fold(false, |found, variable| Ok(found || self.is_of_caller(variable?.0)))
    }

    /// The buffer or image that a variable stands for; `None` if it is no resource, or the caller's.
    fn resource(&self, id: Word, class: StorageClass, pointee: Word) -> Result<Option<ResourceBinding>, ReflectError> {
        if self.is_of_caller(id) {
            return Ok(None);
        }
        let name = self.block_name(id, pointee);
        let kind = match class {
            StorageClass::StorageBuffer => ResourceKind::StorageBuffer,
            // SPIR-V before 1.3 marks storage buffers by a decoration of the block.
            StorageClass::Uniform if self.decoration(pointee, None, Decoration::BufferBlock).is_some() => {
                ResourceKind::StorageBuffer
            }
            StorageClass::Uniform => ResourceKind::UniformBuffer,
            StorageClass::UniformConstant => match image::kind(&self.globals, pointee) {
                Ok(kind) => kind,
                Err(found) => return Err(ReflectError::Resource { name, found }),
            },
            _ => return Ok(None),
        };
        if kind.is_buffer() && self.globals.get(&pointee).is_none_or(|one| one.class.opcode != Op::TypeStruct) {
            return Err(ReflectError::Resource { name, found: "an array of buffers" });
        }
        let set = self.value(id, None, Decoration::DescriptorSet).unwrap_or(0);
        if set != 0 {
            return Err(ReflectError::Set { name, set });
        }
        let binding = self.value(id, None, Decoration::Binding);
        let binding = binding.ok_or_else(|| malformed(&format!("{name:?} has no binding number")))?;
        let writable = matches!(kind, ResourceKind::StorageBuffer | ResourceKind::StorageImage(_));
        let reads = !self.everywhere(id, pointee, Decoration::NonReadable);
        let writes = writable && !self.everywhere(id, pointee, Decoration::NonWritable);
        Ok(Some(ResourceBinding { binding, kind, reads, writes, name }))
    }

    /// Whether a variable, or every member of its block if it is one, is decorated so.
    fn everywhere(&self, variable: Word, block: Word, decoration: Decoration) -> bool {
        let block_type = self.globals.get(&block).filter(|one| one.class.opcode == Op::TypeStruct);
        let members = block_type.map_or(0, |one| one.operands.len());
        let every = |member: usize| self.decoration(block, u32::try_from(member).ok(), decoration).is_some();
        self.decoration(variable, None, decoration).is_some() || (members > 0 && (0..members).all(every))
    }

    /// The name of a resource: of the block's type, or of the variable if the block has none.
    fn block_name(&self, variable: Word, block: Word) -> String {
        let of = |id: Word| self.names.get(&id).filter(|name| !name.is_empty());
        of(block).or_else(|| of(variable)).map_or_else(|| format!("%{variable}"), |name| (*name).to_owned())
    }

    /// The attributes of a vertex shader: all that it declares, since pipelines must have them whether they are read or not.
    fn inputs(&self) -> Result<Vec<VertexInput>, ReflectError> {
        let declared = self.module.types_global_values.iter().filter(|one| one.class.opcode == Op::Variable);
        let mut inputs = Vec::new();
        for instruction in declared {
            let (id, class, pointee) = self.variable(instruction)?;
            let Some(location) = self.value(id, None, Decoration::Location).filter(|_| class == StorageClass::Input)
            else {
                continue;
            };
            let refuse = |found| ReflectError::Input { name: self.block_name(id, pointee), found };
            let input = attributes::input(&self.globals, location, pointee).map_err(refuse)?;
            if inputs.iter().any(|other: &VertexInput| other.location == location) {
                return Err(refuse("a second one at its location"));
            }
            inputs.push(input);
        }
        inputs.sort_by_key(|input| input.location);
        Ok(inputs)
    }

    fn push_constant_size(&self) -> Result<u32, ReflectError> {
        let mut size = 0;
        for variable in self.variables() {
            let (_, class, pointee) = variable?;
            if class == StorageClass::PushConstant {
                size = size.max(self.size(pointee, None, 0)?);
            }
        }
        Ok(size.next_multiple_of(4))
    }

    /// Size of a type in bytes; `member` is the structure and the index it is a member of, whose decorations give strides.
    fn size(&self, id: Word, member: Option<(Word, u32)>, depth: u32) -> Result<u32, ReflectError> {
        let instruction =
            self.globals.get(&id).filter(|_| depth < MAX_DEPTH).ok_or_else(|| malformed("a type is not defined"))?;
        let operands = instruction.operands.as_slice();
        let size = match (instruction.class.opcode, operands) {
            (Op::TypeInt | Op::TypeFloat, [Operand::LiteralBit32(bits), ..]) => Some(bits / 8),
            (Op::TypeVector, [Operand::IdRef(part), Operand::LiteralBit32(count)]) => {
                self.size(*part, None, depth + 1)?.checked_mul(*count)
            }
            (Op::TypeMatrix, [_, Operand::LiteralBit32(columns)]) => {
                let stride = member.and_then(|(block, index)| self.value(block, Some(index), Decoration::MatrixStride));
                stride.and_then(|stride| stride.checked_mul(*columns))
            }
            (Op::TypeArray, [_, Operand::IdRef(length)]) => {
                let stride = self.value(id, None, Decoration::ArrayStride);
                stride.zip(self.constant(*length)).and_then(|(stride, length)| stride.checked_mul(length))
            }
            (Op::TypeStruct, members) => Some(self.struct_size(id, members, depth)?),
            _ => None,
        };
        size.ok_or_else(|| malformed("push constants of a type without a size"))
    }

    fn struct_size(&self, block: Word, members: &[Operand], depth: u32) -> Result<u32, ReflectError> {
        let mut end = 0;
        for (member, index) in members.iter().filter_map(id).zip(0..) {
            let offset = self.value(block, Some(index), Decoration::Offset);
            let size = self.size(member, Some((block, index)), depth + 1)?;
            let member_end = offset.and_then(|offset| offset.checked_add(size));
            end = end.max(member_end.ok_or_else(|| malformed("a member of a block has no offset"))?);
        }
        Ok(end)
    }

    fn specialization(&self) -> Vec<SpecConstant> {
        let constants = self.module.types_global_values.iter().filter_map(|one| {
            let result = one.result_id?;
            let id = self.value(result, None, Decoration::SpecId)?;
            let name = self.names.get(&result).map_or_else(String::new, |name| (*name).to_owned());
            Some(SpecConstant { id, default: constant_bits(one)?, name })
        });
        let mut constants: Vec<SpecConstant> = constants.collect();
        constants.sort_by_key(|constant| constant.id);
        constants
    }

    /// The size of the work group. The built-in constant, where there is one, has precedence over the execution mode.
    fn local_size(&self) -> Result<[Extent; 3], ReflectError> {
        let is_size = |one: &&Instruction| {
            one.result_id
                .is_some_and(|id| self.value(id, None, Decoration::BuiltIn) == Some(BuiltIn::WorkgroupSize as u32))
        };
        let mut modes = self.module.execution_modes.iter().filter_map(|one| match one.operands.as_slice() {
            [_, Operand::ExecutionMode(ExecutionMode::LocalSize | ExecutionMode::LocalSizeId), sizes @ ..] => {
                Some(sizes)
            }
            _ => None,
        });
        let constant = self.module.types_global_values.iter().find(is_size).map(|one| one.operands.as_slice());
        let sizes =
            constant.or_else(|| modes.next_back()).ok_or_else(|| malformed("a compute shader without a local size"))?;
        let sizes: Vec<Extent> = sizes.iter().filter_map(|size| self.extent(size)).collect();
        sizes.try_into().map_err(|_| malformed("the local size is not three numbers"))
    }

    fn extent(&self, operand: &Operand) -> Option<Extent> {
        match operand {
            Operand::LiteralBit32(value) => Some(Extent::Fixed(*value)),
            Operand::IdRef(id) => {
                let default = self.constant(*id)?;
                let spec = self.value(*id, None, Decoration::SpecId);
                Some(spec.map_or(Extent::Fixed(default), |id| Extent::Specialized { id, default }))
            }
            _ => None,
        }
    }

    fn output_vertices(&self) -> Option<u32> {
        self.module.execution_modes.iter().find_map(|one| match one.operands.as_slice() {
            [_, Operand::ExecutionMode(ExecutionMode::OutputVertices), Operand::LiteralBit32(count)] => Some(*count),
            _ => None,
        })
    }

    fn capture_stride(&self) -> Option<u32> {
        let declared = self
            .module
            .execution_modes
            .iter()
            .any(|one| matches!(one.operands.as_slice(), [_, Operand::ExecutionMode(ExecutionMode::Xfb), ..]));
        let strides = self.decorations.values().flatten().filter(|one| one.decoration == Decoration::XfbStride);
        strides.filter_map(|one| one.value).max().filter(|_| declared)
    }

    /// The value of an integer constant, specialized or not.
    fn constant(&self, id: Word) -> Option<u32> {
        self.globals.get(&id).and_then(|one| constant_bits(one))
    }

    fn decoration(&self, id: Word, member: Option<u32>, decoration: Decoration) -> Option<&Decorated> {
        self.decorations.get(&id)?.iter().find(|one| one.member == member && one.decoration == decoration)
    }

    fn value(&self, id: Word, member: Option<u32>, decoration: Decoration) -> Option<u32> {
        self.decoration(id, member, decoration)?.value
    }
}

/// The target and content of a decoration instruction.
fn decorated(instruction: &Instruction) -> Option<(Word, Decorated)> {
    let (target, member, rest) = match (instruction.class.opcode, instruction.operands.as_slice()) {
        (Op::Decorate, [Operand::IdRef(target), rest @ ..]) => (*target, None, rest),
        (Op::MemberDecorate, [Operand::IdRef(target), Operand::LiteralBit32(member), rest @ ..]) => {
            (*target, Some(*member), rest)
        }
        _ => return None,
    };
    let [Operand::Decoration(decoration), values @ ..] = rest else { return None };
    let value = values.first().and_then(|value| match value {
        Operand::LiteralBit32(value) => Some(*value),
        Operand::BuiltIn(built_in) => Some(*built_in as u32),
        _ => None,
    });
    Some((target, Decorated { member, decoration: *decoration, value }))
}

fn id(operand: &Operand) -> Option<Word> {
    match operand {
        Operand::IdRef(id) => Some(*id),
        _ => None,
    }
}

/// The bits of a 32-bit constant.
fn constant_bits(instruction: &Instruction) -> Option<u32> {
    match (instruction.class.opcode, instruction.operands.as_slice()) {
        (Op::ConstantTrue | Op::SpecConstantTrue, _) => Some(1),
        (Op::ConstantFalse | Op::SpecConstantFalse, _) => Some(0),
        (Op::Constant | Op::SpecConstant, [Operand::LiteralBit32(bits)]) => Some(*bits),
        _ => None,
    }
}

fn stage(model: ExecutionModel) -> Result<Stage, ReflectError> {
    match model {
        ExecutionModel::Vertex => Ok(Stage::Vertex),
        ExecutionModel::TessellationControl => Ok(Stage::TessellationControl),
        ExecutionModel::TessellationEvaluation => Ok(Stage::TessellationEvaluation),
        ExecutionModel::Fragment => Ok(Stage::Fragment),
        ExecutionModel::GLCompute => Ok(Stage::Compute),
        other => Err(ReflectError::Stage { stage: format!("{other:?}") }),
    }
}

fn malformed(reason: &str) -> ReflectError {
    ReflectError::Malformed { reason: reason.to_owned() }
}
