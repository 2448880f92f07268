//! Reflection of compiled shaders; needs no device.

use osculate_gpu::{Extent, Format, Numbers, ReflectError, Reflection, ResourceKind, Stage, reflect};

use crate::harness::spirv;

fn reflected(name: &str, source: &str) -> Reflection {
    reflect(&spirv(name, source)).unwrap()
}

fn refused(name: &str, source: &str) -> ReflectError {
    reflect(&spirv(name, source)).unwrap_err()
}

#[test]
fn buffers_have_kind_access_and_name() {
    let found = reflected(
        "all.comp",
        "layout(binding = 5) buffer Both { float both[]; };
         layout(binding = 1) readonly buffer In { vec4 a; float b[]; } input_block;
         layout(binding = 2) writeonly buffer Out { float result[]; };
         layout(binding = 3) buffer Half { readonly float kept; float changed; };
         layout(binding = 0) uniform Camera { mat4 matrix; };
         layout(binding = 9) buffer Unused { float unused[]; };
         void main() { result[0] = input_block.b[0] + matrix[0][0] + kept; both[1] += 1.0; changed = 0.0; }",
    );
    assert_eq!((found.stage, found.entry_point.as_str()), (Stage::Compute, "main"));
    let buffers: Vec<_> =
        found.resources.iter().map(|one| (one.binding, one.kind, one.reads, one.writes, one.name.as_str())).collect();
    assert_eq!(
        buffers,
        [
            (0, ResourceKind::UniformBuffer, true, false, "Camera"),
            (1, ResourceKind::StorageBuffer, true, false, "In"),
            (2, ResourceKind::StorageBuffer, false, true, "Out"),
            (3, ResourceKind::StorageBuffer, true, true, "Half"),
            (5, ResourceKind::StorageBuffer, true, true, "Both"),
        ]
    );
    assert_eq!((found.push_constant_size, found.local_size), (0, Some([Extent::Fixed(1); 3])));
}

#[test]
fn images_have_kind_access_and_name() {
    let found = reflected(
        "images.comp",
        "layout(binding = 0) uniform sampler2D colors;
         layout(binding = 1) uniform usampler2D numbers;
         layout(binding = 2, rgba32f) uniform readonly image2D before;
         layout(binding = 3, rgba16f) uniform writeonly image2D after;
         layout(binding = 4, r32f) uniform image2D both;
         layout(binding = 5) uniform sampler2D unused;
         void main() {
             ivec2 at = ivec2(texelFetch(numbers, ivec2(0), 0).xy) + textureSize(colors, 0);
             imageStore(after, at, texture(colors, vec2(0.5)) + imageLoad(before, at) + imageLoad(both, at));
             imageStore(both, at, vec4(1.0));
         }",
    );
    let images: Vec<_> =
        found.resources.iter().map(|one| (one.binding, one.kind, one.reads, one.writes, one.name.as_str())).collect();
    assert_eq!(
        images,
        [
            (0, ResourceKind::Texture(Numbers::Float), true, false, "colors"),
            (1, ResourceKind::Texture(Numbers::Uint), true, false, "numbers"),
            (2, ResourceKind::StorageImage(Format::Rgba32Float), true, false, "before"),
            (3, ResourceKind::StorageImage(Format::Rgba16Float), false, true, "after"),
            (4, ResourceKind::StorageImage(Format::R32Float), true, true, "both"),
        ]
    );
}

#[test]
fn push_constants_are_measured() {
    let size = |block: &str| {
        let source = format!(
            "struct Pair {{ vec3 a; float b; }};
             layout(push_constant) uniform Push {{ {block} uint last; }};
             layout(binding = 0) buffer Out {{ uint result; }};
             void main() {{ result = last; }}"
        );
        reflected("push.comp", &source).push_constant_size
    };
    assert_eq!(size(""), 4);
    assert_eq!(size("vec3 v;"), 16);
    assert_eq!(size("mat4 m;"), 68);
    assert_eq!(size("mat3x4 m; float f[3];"), 48 + 12 + 4);
    assert_eq!(size("Pair p[2]; vec2 v;"), 32 + 8 + 4);
    assert_eq!(size("layout(offset = 96)"), 100);
}

#[test]
fn specialization_constants_have_their_defaults() {
    let found = reflected(
        "constants.comp",
        "layout(local_size_x = 8, local_size_y_id = 7) in;
         layout(constant_id = 2) const int N = -3;
         layout(constant_id = 1) const float F = 1.5;
         layout(constant_id = 4) const bool B = true;
         layout(binding = 0) buffer Out { float result; };
         void main() { if (B) result = F * float(N); }",
    );
    let constants: Vec<_> = found.specialization.iter().map(|one| (one.id, one.default, one.name.as_str())).collect();
    assert_eq!(constants[..3], [(1, 1.5f32.to_bits(), "F"), (2, -3i32 as u32, "N"), (4, 1, "B")]);
    assert_eq!((constants[3].0, constants.len()), (7, 4));
    let size = found.local_size.unwrap();
    assert_eq!(size.map(|extent| extent.resolve(&[])), [8, 1, 1]);
    assert_eq!(size.map(|extent| extent.resolve(&[(7, 4)])), [8, 4, 1]);
}

#[test]
fn tessellation_and_capture_are_seen() {
    let control = reflected(
        "p.tesc",
        "layout(vertices = 20) out;
         void main() { gl_TessLevelOuter[0] = 1.0; gl_out[gl_InvocationID].gl_Position = vec4(0.0); }",
    );
    assert_eq!((control.stage, control.output_vertices), (Stage::TessellationControl, Some(20)));
    let evaluation = reflected(
        "p.tese",
        "layout(quads) in;
         layout(location = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 24) out vec3 p;
         void main() { p = gl_TessCoord; }",
    );
    assert_eq!((evaluation.stage, evaluation.capture_stride), (Stage::TessellationEvaluation, Some(24)));
    assert_eq!(reflected("v.vert", "void main() { gl_Position = vec4(0.0); }").capture_stride, None);
}

#[test]
fn what_is_not_supported_is_named() {
    let set = refused("s.comp", "layout(set = 2, binding = 0) buffer Far { float far; }; void main() { far = 0.0; }");
    assert_eq!(set, ReflectError::Set { name: "Far".to_owned(), set: 2 });
    let lookups = [
        ("sampler3D t", "texture(t, vec3(0.0))", "not two-dimensional"),
        ("samplerCube t", "texture(t, vec3(0.0))", "not two-dimensional"),
        ("sampler2DArray t", "texture(t, vec3(0.0))", "with layers"),
        ("sampler2DMS t", "texelFetch(t, ivec2(0), 0)", "several samples"),
        ("sampler2DShadow t", "vec4(texture(t, vec3(0.0)))", "compares depths"),
        ("sampler2D t[2]", "texture(t[1], vec2(0.0))", "an array of images"),
        ("texture2D t", "texelFetch(t, ivec2(0), 0)", "without its sampler"),
    ];
    for (declared, call, part) in lookups {
        let source = format!(
            "#extension GL_EXT_samplerless_texture_functions : enable
             layout(binding = 0) uniform {declared}; layout(location = 0) out vec4 c; void main() {{ c = {call}; }}"
        );
        let error = refused("s.frag", &source).to_string();
        assert!(error.contains("\"t\"") && error.contains(part), "{declared}: {error}");
    }
    let format =
        "layout(binding = 0, rgba8_snorm) uniform image2D t; void main() { imageStore(t, ivec2(0), vec4(0.0)); }";
    assert!(refused("s.comp", format).to_string().contains("a format other than"));
    let array = "layout(binding = 0) buffer Many { float x; } many[3]; void main() { many[1].x = 0.0; }";
    assert!(refused("a.comp", array).to_string().contains("an array of buffers"));
    let twice = "layout(binding = 0) buffer A { float a; }; layout(binding = 0) buffer B { float b; };
         void main() { a = 0.0; b = 0.0; }";
    assert!(matches!(refused("t.comp", twice), ReflectError::Duplicate { binding: 0, .. }));
    assert_eq!(reflect(&geometry()).unwrap_err(), ReflectError::Stage { stage: "Geometry".to_owned() });
}

/// A vertex shader that calls itself a geometry shader.
fn geometry() -> Vec<u32> {
    const ENTRY_POINT: u32 = 15;
    const GEOMETRY: u32 = 3;
    let mut words = spirv("v.vert", "void main() {}");
    let mut position = 5;
    while words[position] & 0xffff != ENTRY_POINT {
        position += (words[position] >> 16) as usize;
    }
    words[position + 1] = GEOMETRY;
    words
}

#[test]
fn what_is_no_module_is_refused() {
    assert!(matches!(reflect(&[]), Err(ReflectError::Parse { .. })));
    assert!(matches!(reflect(&[0x0723_0203, 0]), Err(ReflectError::Parse { .. })));
    let words = spirv("nothing.comp", "void main() {}");
    assert_eq!(reflect(&words[..5]).unwrap_err(), ReflectError::EntryPoints { count: 0 });
}

/// No truncation and no single wrong word may panic; what it yields does not matter.
#[test]
fn damaged_modules_do_not_panic() {
    let source = "layout(local_size_x_id = 0) in;
         layout(push_constant) uniform Push { mat4 m[2]; };
         layout(binding = 0) readonly buffer In { float a[]; };
         void main() { float x = a[0] * m[0][0][0]; }";
    let words = spirv("whole.comp", source);
    for position in 0..words.len() {
        let _ = reflect(&words[..position]);
        for value in [0, 1, 7, u32::MAX, words[position] ^ 1, words[position].wrapping_add(0x1_0000)] {
            let mut damaged = words.clone();
            damaged[position] = value;
            let _ = reflect(&damaged);
        }
    }
}

#[test]
fn attributes_have_numbers_and_a_stride() {
    let found = reflected(
        "attributes.vert",
        "layout(location = 3) in uint id; layout(location = 0) in vec3 position; layout(location = 1) in ivec2 unused;
         layout(location = 7) out float result;
         void main() { gl_Position = vec4(position, float(id)); result = 1.0; }",
    );
    let inputs: Vec<_> = found.inputs.iter().map(|one| (one.location, one.numbers, one.components)).collect();
    assert_eq!(inputs, [(0, Numbers::Float, 3), (1, Numbers::Int, 2), (3, Numbers::Uint, 1)]);
    assert_eq!(found.vertex_stride(), 24, "what is not read has its place too");
    let fragment =
        "layout(location = 0) in vec3 normal; layout(location = 0) out vec4 c; void main() { c = vec4(normal, 1); }";
    let fragment = reflected("plain.frag", fragment);
    assert_eq!((fragment.inputs.len(), fragment.vertex_stride()), (0, 0), "inputs of other stages are no attributes");
}

#[test]
fn attributes_of_other_kinds_are_refused() {
    let two = "layout(location = 2) in vec3 narrow; layout(location = 2, component = 3) in float odd;";
    for (declared, point, part) in [
        ("layout(location = 0) in mat3 odd;", "vec4(odd[0], 1.0)", "32 bits"),
        ("layout(location = 0) in float odd[2];", "vec4(odd[0])", "32 bits"),
        ("layout(location = 16) in vec3 odd;", "vec4(odd, 1.0)", "above 15"),
        (two, "vec4(narrow, odd)", "a second one"),
    ] {
        let error = refused("attributes.vert", &format!("{declared} void main() {{ gl_Position = {point}; }}"));
        let (kind, text) = (matches!(error, ReflectError::Input { .. }), error.to_string());
        assert!(kind && text.contains("odd") && text.contains(part), "{declared}: {text}");
    }
}
