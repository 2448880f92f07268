//! The table of the shipped cages.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::Asset;
use super::survey::Survey;

const HEAD: &str = "# Cages

Control cages made for this project, for tests and pictures. All of them, and this table, are written by
`cargo xtask cages`; `cargo xtask cages --check` fails if a file differs from what its generator writes. Valences are
those of interior vertices; \"boundary\" lists the numbers of faces that occur at boundary vertices.

| file | vertices | faces | valence | boundary | exercises |
|---|---|---|---|---|---|
";

/// The README of the folder.
pub(super) fn text(rows: &[(&Asset, Survey)]) -> String {
    let mut text = HEAD.to_string();
    for (asset, survey) in rows {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} |",
            asset.file_name(),
            survey.vertices,
            sizes(survey),
            keys(&survey.interior_valences),
            keys(&survey.boundary_faces),
            asset.exercises
        );
    }
    text
}

/// Faces in all, and by size where there is more than one.
fn sizes(survey: &Survey) -> String {
    let name = |size: usize| match size {
        3 => "triangles".to_string(),
        4 => "quads".to_string(),
        n => format!("{n}-gons"),
    };
    let parts: Vec<String> = survey.face_sizes.iter().map(|(&size, count)| format!("{count} {}", name(size))).collect();
    match parts.as_slice() {
        [only] => only.clone(),
        _ => format!("{} ({})", survey.faces(), parts.join(", ")),
    }
}

/// The keys in order, runs of three and more as ranges.
fn keys(counts: &BTreeMap<usize, usize>) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &key in counts.keys() {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == key => *last = key,
            _ => runs.push((key, key)),
        }
    }
    let run = |&(first, last): &(usize, usize)| match last - first {
        0 => first.to_string(),
        1 => format!("{first}, {last}"),
        _ => format!("{first} to {last}"),
    };
    runs.iter().map(run).collect::<Vec<_>>().join(", ")
}
