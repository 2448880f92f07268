//! Malformed and odd files, each with the complete answer it gets.
//!
//! The tables beside this file hold a case after the other:
//!
//! ```text
//! == name.obj OPTIONS        the name says the format, options how it is read
//! v 0 0 0                    what the file holds, line by line
//! -- the message             for a file that is refused
//! ++ what was read           for one that is not, with a line for each warning
//! ```
//!
//! What holds for contents is told in `content.rs`. When an answer changes, a table with the new answers is left in a side folder:
//! it has to be read, and copied by hand. The files themselves are left there too, to be tried by hand and as seeds for fuzzing.

mod answer;
mod content;
mod table;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use answer::answer;
use table::Case;

const TABLES: [&str; 10] =
    ["obj", "obj_faces", "obj_tags", "ply", "off", "gltf", "gltf_buffers", "glb", "usd", "limits_and_repairs"];

fn cases() -> Vec<(&'static str, Vec<Case>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/refusals");
    let listed: BTreeSet<String> = TABLES.iter().map(|name| format!("{name}.txt")).collect();
    let entries = folder.read_dir().expect("the folder of tables").map(|entry| entry.expect("an entry").file_name());
    let there: BTreeSet<String> =
        entries.filter_map(|name| name.into_string().ok()).filter(|name| name.ends_with(".txt")).collect();
    assert_eq!(there, listed, "tables that are there, and tables that are read");
    let read = |name| std::fs::read_to_string(folder.join(format!("{name}.txt"))).expect("a table");
    TABLES.iter().map(|&name| (name, table::parse(&read(name)))).collect()
}

#[test]
fn every_file_gets_the_answer_in_the_table() {
    let mut wrong = Vec::new();
    let side = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    for (name, cases) in cases() {
        write_files(&cases, &side.join("refusals"));
        let answers: Vec<String> = cases.iter().map(|case| answer(case, &cases)).collect();
        let differ = |(case, answer): (&Case, &String)| {
            let same = case.expected == *answer;
            (!same).then(|| format!("{}:\nis       {answer}\nshall be {}\n", case.name, case.expected))
        };
        let found: Vec<String> = cases.iter().zip(&answers).filter_map(differ).collect();
        if !found.is_empty() {
            let actual = side.join(format!("{name}.actual.txt"));
            std::fs::write(&actual, table::with_answers(&cases, &answers)).expect("written");
            wrong.push(format!("{}\nSee {}", found.join("\n"), actual.display()));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

fn write_files(cases: &[Case], folder: &Path) {
    for case in cases {
        let ending = Path::new(&case.name).extension().unwrap_or_default();
        let folder = folder.join(ending);
        std::fs::create_dir_all(&folder).expect("made");
        std::fs::write(folder.join(&case.name), content::bytes(case, cases)).expect("written");
    }
}

#[test]
fn there_are_enough_cases_of_each_kind() {
    let all: Vec<Case> = cases().into_iter().flat_map(|(_, cases)| cases).collect();
    let names: BTreeSet<&str> = all.iter().map(|case| case.name.as_str()).collect();
    assert_eq!(names.len(), all.len(), "names are unique over all tables");
    let refused = all.iter().filter(|case| case.expected.starts_with("-- ")).count();
    assert!(refused >= 100, "only {refused} files are refused");
    for (ending, least) in [(".obj", 40), (".ply", 20), (".off", 12), (".gltf", 20), (".glb", 8), (".usda", 20)] {
        let of_kind = names.iter().filter(|name| name.ends_with(ending)).count();
        assert!(of_kind >= least, "only {of_kind} files {ending}");
    }
}

/// A message says where, and is one line; whoever reads it does not have to know how the reader works.
#[test]
fn messages_have_the_form_of_a_message() {
    for (_, cases) in cases() {
        for case in cases {
            let Some(message) = case.expected.strip_prefix("-- ") else { continue };
            assert!(message.starts_with(&case.name), "{message}");
            assert!(message.len() < 400 && !message.ends_with('.') && !message.contains('\n'), "{message}");
        }
    }
}
