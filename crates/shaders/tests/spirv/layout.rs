//! Every struct shared with the shaders has the same bytes on both sides: offsets of the Rust fields are compared with the offset
//! decorations that the GLSL compiler computed.

use crate::module::SpirvModule;
use osculate_shader_compiler::{CompileDesc, compile};
use osculate_shaders::layout::{LAYOUTS, StructLayout};
use osculate_shaders::{SHADERS, constant};
use osculate_subdiv::{PatchForm, PatchRecord};
use osculate_surface::gregory::CrossEnd;
use rspirv::dr::{Instruction, Operand};
use rspirv::spirv::{Decoration, Op};
use std::collections::{BTreeMap, BTreeSet};
use std::mem::offset_of;

/// Fields of a struct of the plan, which knows nothing of shaders.
macro_rules! plan_struct {
    ($type:ident { $($field:ident),* }) => {
        StructLayout {
            name: stringify!($type),
            fields: &[$((stringify!($field), offset_of!(osculate_subdiv::$type, $field)),)*],
            size: size_of::<osculate_subdiv::$type>(),
        }
    };
}

const PLAN_LAYOUTS: [StructLayout; 6] = [
    plan_struct!(MatrixSource { net, weights, columns }),
    plan_struct!(ProjectionSource { net, weights, columns, absolute_rows, first }),
    plan_struct!(SpokeRecord { vectors, table, modes }),
    plan_struct!(FanRecord { first, edges, cross_end, cosine }),
    plan_struct!(GatheredEdge { fan, edge }),
    plan_struct!(GatheredPatch { fan, edge, first, sides }),
];

/// Every struct that host and shaders share.
fn shared() -> impl Iterator<Item = &'static StructLayout> {
    LAYOUTS.iter().chain(&PLAN_LAYOUTS)
}

/// A struct or block as a shader sees it.
#[derive(Debug, Clone, PartialEq, Eq)]
struct DeviceStruct {
    /// Name and byte offset of each member.
    members: Vec<(String, u32)>,
    /// Byte stride of the arrays of it.
    strides: BTreeSet<u32>,
}

#[test]
fn shared_structs_agree_with_the_shaders() {
    let mut used = BTreeSet::new();
    let mut faults = Vec::new();
    for shader in SHADERS {
        let module = SpirvModule::load(shader.spirv);
        for (name, device) in structs_in_memory(&module) {
            let Some(host) = shared().find(|layout| layout.name == name) else {
                continue;
            };
            used.insert(host.name);
            faults.extend(
                differences(host, &device).into_iter().map(|fault| format!("{}: {name}: {fault}", shader.name)),
            );
        }
    }
    faults.extend(shared().filter(|layout| !used.contains(layout.name)).map(|layout| {
        format!("no shader has a struct or block {}; is it still shared, and named alike on both sides?", layout.name)
    }));
    assert!(faults.is_empty(), "host and device disagree:\n{}", faults.join("\n"));
}

#[test]
fn shared_structs_have_distinct_names() {
    let names: BTreeSet<&str> = shared().map(|layout| layout.name).collect();
    assert_eq!(names.len(), shared().count());
}

/// Shaders read them as an array of vectors of four numbers (`patch_vertex`, `patch_edge`, `patch_basis` in shaders/include/records.glsl).
#[test]
fn records_of_patches_are_three_vectors_of_four_numbers() {
    use osculate_subdiv::PatchRecord as R;
    let offsets = [
        offset_of!(R, vertex),
        offset_of!(R, edge),
        offset_of!(R, net),
        offset_of!(R, basis),
        offset_of!(R, net_size),
        offset_of!(R, tag),
        size_of::<R>(),
    ];
    assert_eq!(offsets, [0, 16, 32, 36, 40, 44, 48]);
}

#[test]
fn tags_of_patches_have_the_same_bits_on_both_sides() {
    let forms = [
        (PatchForm::Bicubic, constant::FORM_BICUBIC),
        (PatchForm::Gregory, constant::FORM_GREGORY),
        (PatchForm::Stam, constant::FORM_STAM),
        (PatchForm::Biseptic, constant::FORM_BISEPTIC),
        (PatchForm::Triangle, constant::FORM_TRIANGLE),
    ];
    assert!(forms.iter().all(|(form, number)| form.number() == *number));
    assert_eq!(PatchRecord::FORM_MASK, constant::FORM_MASK);
    assert_eq!(PatchRecord::STORED, constant::TAG_STORED);
    assert_eq!(PatchRecord::BOUNDARY, constant::TAG_BOUNDARY);
    assert_eq!(PatchRecord::VALENCE_SHIFT, constant::TAG_VALENCE_SHIFT);
}

#[test]
fn ends_of_edges_have_the_same_numbers_on_both_sides() {
    let ends = [
        (CrossEnd::Plain, constant::CROSS_END_PLAIN),
        (CrossEnd::Vanishing, constant::CROSS_END_VANISHING),
        (CrossEnd::Opposed, constant::CROSS_END_OPPOSED),
    ];
    assert!(ends.iter().all(|(end, number)| end.number() == *number));
}

const PARTICLE: StructLayout =
    StructLayout { name: "Particle", fields: &[("place", 0), ("mass", 12), ("tint", 16), ("padding0", 28)], size: 32 };

#[test]
fn a_matching_struct_has_no_differences() {
    let device = particle("vec3 place; float mass; vec3 tint;");
    assert_eq!(differences(&PARTICLE, &device), Vec::<String>::new());
}

#[test]
fn each_way_to_drift_is_found() {
    let cases = [
        ("moved", "float mass; vec3 place; vec3 tint;", "mass is at byte 12 on the host, 0 in the shader"),
        ("renamed", "vec3 place; float weight; vec3 tint;", "the host has no field weight"),
        ("removed", "vec3 place; float mass;", "the shader has no member tint"),
        (
            "longer",
            "vec3 place; float mass; vec3 tint; float a; float b;",
            "arrays of it have stride 32 on the host, 48",
        ),
    ];
    for (what, members, expected) in cases {
        let faults = differences(&PARTICLE, &particle(members));
        assert!(faults.iter().any(|fault| fault.contains(expected)), "{what}: {faults:?}");
    }
}

/// `struct Particle` with those members, as a storage buffer lays it out.
fn particle(members: &str) -> DeviceStruct {
    let source = format!(
        "#version 460\nlayout(local_size_x = 1) in;\nstruct Particle {{ {members} }};\n\
         layout(std430, binding = 0) buffer B {{ Particle p[]; }};\nvoid main() {{ p[0] = p[1]; }}\n"
    );
    let spirv = compile(&CompileDesc::new("case.comp", &source)).unwrap();
    structs_in_memory(&SpirvModule::load(&spirv)).remove("Particle").expect("the buffer holds particles")
}

/// What differs between a struct's two declarations.
fn differences(host: &StructLayout, device: &DeviceStruct) -> Vec<String> {
    let mut found = Vec::new();
    for (member, offset) in &device.members {
        match host.fields.iter().find(|(field, _)| field == member) {
            None => found.push(format!("the host has no field {member}")),
            Some(&(_, at)) if at != *offset as usize => {
                found.push(format!("{member} is at byte {at} on the host, {offset} in the shader"));
            }
            Some(_) => {}
        }
    }
    for (field, _) in host.fields.iter().filter(|(field, _)| !field.starts_with("padding")) {
        if !device.members.iter().any(|(member, _)| member == field) {
            found.push(format!("the shader has no member {field}"));
        }
    }
    for stride in device.strides.iter().filter(|stride| **stride as usize != host.size) {
        found.push(format!("arrays of it have stride {} on the host, {stride} in the shader", host.size));
    }
    found
}

/// Structs and blocks with a memory layout, by name. glslang declares a struct once more, without offsets, for local variables.
fn structs_in_memory(module: &SpirvModule) -> BTreeMap<String, DeviceStruct> {
    let structs = module.types_global_values.iter().filter(|instruction| instruction.class.opcode == Op::TypeStruct);
    let laid_out = structs.filter_map(|instruction| {
        let id = instruction.result_id?;
        let members = members(module, id);
        let name = module.name(id)?.to_owned();
        (!members.is_empty()).then(|| (name, DeviceStruct { members, strides: array_strides(module, id) }))
    });
    laid_out.collect()
}

/// Names and offsets of a struct's members, in order; empty if it has no layout.
fn members(module: &SpirvModule, id: u32) -> Vec<(String, u32)> {
    let mut found: Vec<_> = module.annotations.iter().filter_map(|annotation| member_offset(annotation, id)).collect();
    found.sort_unstable();
    found.iter().filter_map(|&(at, offset)| Some((member_name(module, id, at)?.to_owned(), offset))).collect()
}

fn member_offset(annotation: &Instruction, id: u32) -> Option<(u32, u32)> {
    match annotation.operands.as_slice() {
        [
            Operand::IdRef(target),
            Operand::LiteralBit32(member),
            Operand::Decoration(Decoration::Offset),
            Operand::LiteralBit32(offset),
        ] if *target == id => Some((*member, *offset)),
        _ => None,
    }
}

fn member_name(module: &SpirvModule, id: u32, at: u32) -> Option<&str> {
    module.debug_names.iter().find_map(|instruction| match instruction.operands.as_slice() {
        [Operand::IdRef(target), Operand::LiteralBit32(member), Operand::LiteralString(name)]
            if (*target, *member) == (id, at) =>
        {
            Some(name.as_str())
        }
        _ => None,
    })
}

/// Strides of the array types whose element is the struct.
fn array_strides(module: &SpirvModule, element: u32) -> BTreeSet<u32> {
    let arrays = module.types_global_values.iter().filter(|instruction| {
        matches!(instruction.class.opcode, Op::TypeArray | Op::TypeRuntimeArray)
            && instruction.operands.first() == Some(&Operand::IdRef(element))
    });
    arrays.filter_map(|array| array_stride(module, array.result_id?)).collect()
}

fn array_stride(module: &SpirvModule, array: u32) -> Option<u32> {
    module.annotations.iter().find_map(|annotation| match annotation.operands.as_slice() {
        [Operand::IdRef(target), Operand::Decoration(Decoration::ArrayStride), Operand::LiteralBit32(stride)]
            if *target == array =>
        {
            Some(*stride)
        }
        _ => None,
    })
}
