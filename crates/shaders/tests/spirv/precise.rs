//! Shared edges agree bit for bit only if the compiler may not reassociate or contract the arithmetic, so every floating-point
//! operation of the geometry stages must carry `NoContraction`, which is what GLSL's `precise` becomes.

use crate::module::SpirvModule;
use osculate_shader_compiler::{CompileDesc, compile};
use osculate_shaders::SHADERS;
use rspirv::dr::{Function, Instruction, Operand};
use rspirv::spirv::{Decoration, GlslStd450Op, Op};
use std::collections::HashSet;

/// Functions whose results are colours, and those that decide whether a patch can be seen at all, with room for roundings. Tessellation factors are not
/// exempt: the two patches of an edge compute them in different pipelines.
const EXEMPT_PREFIXES: [&str; 2] = ["shade_", "cull_"];

/// Folder and extension of the stages that compute geometry.
const GEOMETRY: [(&str, &str); 6] = [
    ("animate/", ".comp"),
    ("patch/", ".tesc"),
    ("patch/", ".tese"),
    ("sample/", ".comp"),
    ("records/", ".comp"),
    ("subdivide/", ".comp"),
];

#[test]
fn geometry_is_precise() {
    let mut faults = Vec::new();
    for (folder, extension) in GEOMETRY {
        let mut checked = 0;
        for shader in
            SHADERS.iter().filter(|shader| shader.path.starts_with(folder) && shader.path.ends_with(extension))
        {
            checked += 1;
            let found = contractible(shader.spirv);
            faults.extend(found.into_iter().map(|fault| format!("{}: {fault}", shader.name)));
        }
        assert!(checked > 0, "no shader matches {folder}*{extension}");
    }
    assert!(faults.is_empty(), "arithmetic without `precise`:\n{}", faults.join("\n"));
}

#[test]
fn the_check_finds_each_kind_of_operation() {
    let cases = [
        ("a + b", "FAdd"),
        ("a - b", "FSub"),
        ("a * b", "FMul"),
        ("a / b", "FDiv"),
        ("-a", "FNegate"),
        ("a * b.x", "VectorTimesScalar"),
        ("mat3(a, b, a) * b", "MatrixTimesVector"),
    ];
    for (expression, operation) in cases {
        assert_eq!(faults_of("bend", "", expression), [format!("{operation} in bend()")], "{expression}");
        assert_eq!(faults_of("bend", "precise", expression), NONE, "{expression}");
        assert_eq!(faults_of("shade_bend", "", expression), NONE, "{expression}");
    }
}

/// glslang 12 does not mark built-in functions even in a `precise` expression, so geometry has to write them out.
#[test]
fn built_in_functions_are_faults_even_when_precise() {
    let cases = [
        ("vec3(dot(a, b))", "Dot"),
        ("vec3(length(a))", "Length"),
        ("cross(a, b)", "Cross"),
        ("normalize(a)", "Normalize"),
        ("mix(a, b, a)", "FMix"),
        ("fma(a, b, a)", "Fma"),
    ];
    for (expression, operation) in cases {
        assert_eq!(faults_of("bend", "", expression), [format!("{operation} in bend()")], "{expression}");
    }
}

#[test]
fn integer_arithmetic_and_exact_functions_are_no_faults() {
    for expression in ["vec3(gl_GlobalInvocationID + uvec3(1))", "max(a, b)", "sqrt(a)", "abs(a)", "a.zyx"] {
        assert_eq!(faults_of("bend", "", expression), NONE, "{expression}");
    }
}

const NONE: [&str; 0] = [];

/// What the check finds in a kernel that stores `name(a, b)`, whose result is `expression` in a variable with that qualifier.
fn faults_of(name: &str, qualifier: &str, expression: &str) -> Vec<String> {
    let source = format!(
        "#version 460\nlayout(local_size_x = 1) in;\nlayout(binding = 0) buffer B {{ vec3 x[]; }};\n\
         vec3 {name}(vec3 a, vec3 b) {{ {qualifier} vec3 r = {expression}; return r; }}\n\
         void main() {{ x[0] = {name}(x[1], x[2]); }}\n"
    );
    contractible(&compile(&CompileDesc::new("case.comp", &source)).unwrap())
}

/// Operations that the driver may contract or reassociate, with the function that holds each.
fn contractible(spirv: &[u32]) -> Vec<String> {
    let module = SpirvModule::load(spirv);
    let exact: HashSet<u32> = module.decorated(Decoration::NoContraction).collect();
    let mut faults = Vec::new();
    for function in &module.functions {
        let name = function_name(&module, function);
        if EXEMPT_PREFIXES.iter().any(|prefix| name.starts_with(prefix)) {
            continue;
        }
        for instruction in function.blocks.iter().flat_map(|block| &block.instructions) {
            let Some(operation) = arithmetic(instruction) else {
                continue;
            };
            if instruction.result_id.is_none_or(|id| !exact.contains(&id)) {
                faults.push(format!("{operation} in {name}()"));
            }
        }
    }
    faults
}

/// Name of a function without the parameter types that glslang appends.
fn function_name<'a>(module: &'a SpirvModule, function: &Function) -> &'a str {
    let id = function.def.as_ref().and_then(|def| def.result_id);
    let name = id.and_then(|id| module.name(id)).unwrap_or("?");
    name.split_once('(').map_or(name, |(name, _)| name)
}

/// Name of the operation if its result depends on the order or fusing of floating-point steps.
fn arithmetic(instruction: &Instruction) -> Option<String> {
    let op = instruction.class.opcode;
    match op {
        Op::FAdd
        | Op::FSub
        | Op::FMul
        | Op::FDiv
        | Op::FNegate
        | Op::VectorTimesScalar
        | Op::MatrixTimesScalar
        | Op::VectorTimesMatrix
        | Op::MatrixTimesVector
        | Op::MatrixTimesMatrix
        | Op::OuterProduct
        | Op::Dot => Some(format!("{op:?}")),
        Op::ExtInst => match instruction.operands.get(1) {
            Some(Operand::LiteralExtInstInteger(number)) => composite_function(*number),
            _ => None,
        },
        _ => None,
    }
}

/// Name of an extended instruction that drivers expand into several arithmetic steps.
fn composite_function(number: u32) -> Option<String> {
    let op = GlslStd450Op::from_u32(number)?;
    matches!(
        op,
        GlslStd450Op::Cross
            | GlslStd450Op::Determinant
            | GlslStd450Op::Distance
            | GlslStd450Op::FaceForward
            | GlslStd450Op::Fma
            | GlslStd450Op::FMix
            | GlslStd450Op::Length
            | GlslStd450Op::MatrixInverse
            | GlslStd450Op::Normalize
            | GlslStd450Op::Reflect
            | GlslStd450Op::Refract
            | GlslStd450Op::SmoothStep
    )
    .then(|| format!("{op:?}"))
}
