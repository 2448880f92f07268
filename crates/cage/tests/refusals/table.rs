//! The tables: cases with their answers.

/// A file with the answer it gets.
pub(crate) struct Case {
    /// Comments and blank lines before it.
    preface: String,
    /// The name of the file.
    pub(crate) name: String,
    /// How it is read, and what its contents are made from.
    pub(crate) options: Vec<String>,
    /// The lines of its contents.
    pub(crate) lines: Vec<String>,
    /// The answer, with its mark: `-- ` or `++ `.
    pub(crate) expected: String,
}

/// The cases of a table.
///
/// # Panics
/// If a line is nothing that a table has, or a case has no answer.
pub(crate) fn parse(text: &str) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let mut preface = String::new();
    let mut open = false;
    for line in text.lines() {
        if let Some(head) = line.strip_prefix("== ") {
            assert!(!open, "the case before {head:?} has no answer");
            let mut words = head.split_whitespace().map(str::to_owned);
            let name = words.next().expect("a name");
            let preface = std::mem::take(&mut preface);
            cases.push(Case { preface, name, options: words.collect(), lines: Vec::new(), expected: String::new() });
            open = true;
        } else if line.starts_with("-- ") || line.starts_with("++ ") {
            let case = cases.last_mut().expect("a case before its answer");
            let more = if case.expected.is_empty() { "" } else { "\n" };
            case.expected += &format!("{more}{line}");
            open = false;
        } else if open {
            cases.last_mut().expect("an open case").lines.push(line.into());
        } else {
            assert!(line.is_empty() || line.starts_with('#'), "{line:?} belongs to no case");
            preface += &format!("{line}\n");
        }
    }
    assert!(!open && preface.is_empty(), "the table ends within a case, or with a comment");
    cases
}

/// The table with other answers.
pub(crate) fn with_answers(cases: &[Case], answers: &[String]) -> String {
    let case = |(case, answer): (&Case, &String)| {
        let head: Vec<&str> = std::iter::once(&case.name).chain(&case.options).map(String::as_str).collect();
        let lines: String = case.lines.iter().map(|line| format!("{line}\n")).collect();
        format!("{}== {}\n{lines}{answer}\n", case.preface, head.join(" "))
    };
    cases.iter().zip(answers).map(case).collect()
}

#[test]
fn a_table_can_be_written_back() {
    let text = "# About.\n\n== a.obj repair\nv 0 0 0\n\nf 1\n-- a.obj:1: no\n\n== b.obj\n++ read\n++ warning: odd\n";
    let cases = parse(text);
    assert_eq!(cases[0].lines, ["v 0 0 0", "", "f 1"]);
    assert_eq!(cases[1].expected, "++ read\n++ warning: odd");
    let same: Vec<String> = cases.iter().map(|case| case.expected.clone()).collect();
    assert_eq!(with_answers(&cases, &same), text);
}

#[test]
#[should_panic(expected = "has no answer")]
fn a_case_without_an_answer_is_a_mistake() {
    parse("== a.obj\nv 0 0 0\n== b.obj\n-- b.obj: no\n");
}
