//! What callers rely on: places of errors, the search for includes, and `precise` reaching the SPIR-V.

use super::*;

const HEAD: &str = "#version 460\nlayout(local_size_x = 64) in;\nlayout(binding = 0) buffer B { float x[]; };\n";

fn files<'a>(files: &'a [(&'a str, &'a str)]) -> impl Fn(&str) -> Option<String> + 'a {
    |path| files.iter().find(|(name, _)| *name == path).map(|(_, text)| (*text).to_owned())
}

fn compile_with(name: &str, source: &str, library: &[(&str, &str)]) -> Result<Vec<u32>, CompileError> {
    let load = files(library);
    compile(&CompileDesc { include_dirs: &["", "include"], load: &load, ..CompileDesc::new(name, source) })
}

fn first_diagnostic(result: Result<Vec<u32>, CompileError>) -> Diagnostic {
    match result {
        Err(CompileError::Rejected(diagnostics)) => diagnostics[0].clone(),
        other => panic!("expected the compiler to reject the source, got {other:?}"),
    }
}

/// Opcode and operands of every instruction.
fn instructions(spirv: &[u32]) -> Vec<(u32, &[u32])> {
    let mut found = Vec::new();
    let mut rest = &spirv[5..];
    while let Some(&head) = rest.first() {
        let (this, next) = rest.split_at((head >> 16) as usize);
        found.push((head & 0xffff, &this[1..]));
        rest = next;
    }
    found
}

fn count_no_contraction(spirv: &[u32]) -> usize {
    const OP_DECORATE: u32 = 71;
    const NO_CONTRACTION: u32 = 42;
    instructions(spirv).iter().filter(|(op, args)| *op == OP_DECORATE && args[1] == NO_CONTRACTION).count()
}

#[test]
fn compiles_every_stage_to_spirv_1_5() {
    let empty = "#version 460\nvoid main() {}\n";
    let control = "#version 460\nlayout(vertices = 1) out;\nvoid main() {}\n";
    let evaluation = "#version 460\nlayout(quads) in;\nvoid main() {}\n";
    for (name, source) in
        [("a.vert", empty), ("a.tesc", control), ("a.tese", evaluation), ("a.frag", empty), ("a.comp", empty)]
    {
        let spirv = compile(&CompileDesc::new(name, source)).unwrap();
        assert_eq!(spirv[..2], [0x0723_0203, 0x0001_0500], "{name}");
    }
}

#[test]
fn error_names_file_and_line() {
    let source = format!("{HEAD}void main() {{\n  x[0] = missing;\n}}\n");
    let found = first_diagnostic(compile_with("a/b.comp", &source, &[]));
    assert_eq!((found.file.as_str(), found.line), ("a/b.comp", Some(5)));
    assert!(found.message.contains("missing"), "{found}");
}

#[test]
fn error_inside_an_include_names_the_include() {
    let source = format!("{HEAD}#include \"f.glsl\"\nvoid main() {{ x[0] = f(); }}\n");
    let library = [("include/f.glsl", "// one\n// two\nfloat f() { return wrong; }\n")];
    let found = first_diagnostic(compile_with("a/b.comp", &source, &library));
    assert_eq!((found.file.as_str(), found.line), ("include/f.glsl", Some(3)));
}

#[test]
fn error_after_an_include_keeps_its_own_line() {
    let source = format!("{HEAD}#include \"f.glsl\"\nvoid main() {{\n  x[0] = wrong;\n}}\n");
    let library = [("include/f.glsl", "float f() {\n  return 1.0;\n}\n")];
    let found = first_diagnostic(compile_with("a/b.comp", &source, &library));
    assert_eq!((found.file.as_str(), found.line), ("a/b.comp", Some(6)));
}

#[test]
fn missing_include_is_reported_where_it_is_asked_for() {
    let source = format!("{HEAD}#include \"none.glsl\"\nvoid main() {{}}\n");
    let found = first_diagnostic(compile_with("a/b.comp", &source, &[]));
    assert_eq!((found.file.as_str(), found.line), ("a/b.comp", Some(4)));
    for path in ["a/none.glsl", "none.glsl", "include/none.glsl"] {
        assert!(found.message.contains(path), "{found}");
    }
}

#[test]
fn endless_include_is_refused() {
    let library = [("include/a.glsl", "#include \"b.glsl\"\n"), ("include/b.glsl", "#include \"a.glsl\"\n")];
    let source = format!("{HEAD}#include \"a.glsl\"\nvoid main() {{}}\n");
    let found = first_diagnostic(compile_with("a.comp", &source, &library));
    assert!(found.message.contains("include itself"), "{found}");
}

#[test]
fn guarded_include_may_come_twice() {
    let library = [("include/f.glsl", "#ifndef F\n#define F\nfloat f() { return 1.0; }\n#endif\n")];
    let source = format!("{HEAD}#include \"f.glsl\"\n#include <f.glsl>\nvoid main() {{ x[0] = f(); }}\n");
    assert!(compile_with("a.comp", &source, &library).is_ok());
}

#[test]
fn quoted_include_prefers_the_own_folder() {
    let library = [("a/f.glsl", "float f() { return 1.0; }\n"), ("include/f.glsl", "syntax error\n")];
    let source = |line: &str| format!("{HEAD}{line}\nvoid main() {{ x[0] = f(); }}\n");
    assert!(compile_with("a/b.comp", &source("#include \"f.glsl\""), &library).is_ok());
    let found = first_diagnostic(compile_with("a/b.comp", &source("#include <f.glsl>"), &library));
    assert_eq!(found.file, "include/f.glsl");
}

#[test]
fn include_cannot_leave_the_root() {
    let load = |_: &str| Some("float f() { return 1.0; }\n".to_owned());
    let source = format!("{HEAD}#include \"../f.glsl\"\nvoid main() {{}}\n");
    let found = first_diagnostic(compile(&CompileDesc { load: &load, ..CompileDesc::new("b.comp", &source) }));
    assert!(found.message.contains("no such file"), "{found}");
}

#[test]
fn lists_includes_of_includes_once() {
    let library =
        [("include/f.glsl", "#include \"g.glsl\"\n"), ("include/g.glsl", "\n"), ("include/unused.glsl", "\n")];
    let source = format!("{HEAD}#include \"g.glsl\"\n#include \"f.glsl\"\nvoid main() {{}}\n");
    let load = files(&library);
    let desc = CompileDesc { include_dirs: &["include"], load: &load, ..CompileDesc::new("a.comp", &source) };
    assert_eq!(list_includes(&desc).unwrap(), ["include/f.glsl", "include/g.glsl"]);
}

#[test]
fn macros_reach_the_source() {
    let source = format!("{HEAD}#ifndef ON\n#error off\n#endif\nvoid main() {{ x[0] = VALUE; }}\n");
    let defines = [("ON", None), ("VALUE", Some("2.0"))];
    let desc = CompileDesc::new("a.comp", &source);
    assert!(compile(&CompileDesc { defines: &defines, ..desc }).is_ok());
    assert_eq!(first_diagnostic(compile(&desc)).line, Some(5));
}

#[test]
fn precise_keeps_order_and_is_marked() {
    let body = |qualifier: &str| {
        format!("{HEAD}void main() {{ {qualifier} float y = (x[1] + x[2]) - x[1] * x[3]; x[0] = y; }}\n")
    };
    let precise = compile_with("a.comp", &body("precise"), &[]).unwrap();
    assert_eq!(count_no_contraction(&precise), 3);
    assert_eq!(count_no_contraction(&compile_with("a.comp", &body(""), &[]).unwrap()), 0);
}

#[test]
fn nothing_is_optimised_away() {
    const OP_FADD: u32 = 129;
    const OP_NAME: u32 = 5;
    let source = format!("{HEAD}void main() {{ float unused = x[1] + x[2]; }}\n");
    let spirv = compile_with("a.comp", &source, &[]).unwrap();
    for op in [OP_FADD, OP_NAME] {
        assert!(instructions(&spirv).iter().any(|(found, _)| *found == op), "opcode {op} is gone");
    }
}

#[test]
fn debug_info_embeds_the_source() {
    const OP_LINE: u32 = 8;
    let source = format!("{HEAD}void main() {{ x[0] = 1.0; }}\n");
    let desc = CompileDesc::new("a.comp", &source);
    for debug_info in [false, true] {
        let spirv = compile(&CompileDesc { debug_info, ..desc }).unwrap();
        assert_eq!(instructions(&spirv).iter().any(|(op, _)| *op == OP_LINE), debug_info);
    }
}

#[test]
fn bad_names_and_text_are_errors() {
    let unknown = compile(&CompileDesc::new("a.glsl", HEAD)).unwrap_err();
    assert!(matches!(unknown, CompileError::UnknownStage { .. }), "{unknown}");
    let nul = first_diagnostic(compile(&CompileDesc::new("a.comp", "#version 460\n\0")));
    assert_eq!(nul.line, Some(2));
    let nul = compile_with("a.comp", &format!("{HEAD}#include \"f.glsl\"\n"), &[("f.glsl", "\0")]);
    assert!(first_diagnostic(nul).message.contains("NUL"));
}

#[test]
fn a_warning_is_an_error() {
    let source = "#version 460\n#extension GL_no_such_thing : warn\nvoid main() {}\n";
    let found = first_diagnostic(compile_with("a.vert", source, &[]));
    assert_eq!(found.line, Some(2));
}
