//! How many patches of each kind a surface has, in the colours of the shade `patches`.

use std::collections::BTreeMap;

use osculate::{PatchForm, SurfacePlan};

/// Most lines of a list; rarer kinds are put together.
const LINES: usize = 7;

/// Patches of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Kind {
    pub(crate) label: String,
    /// sRGB.
    pub(crate) color: [u8; 3],
    pub(crate) count: usize,
}

/// The patches of a surface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Census {
    pub(crate) kinds: Vec<Kind>,
    pub(crate) patches: usize,
    /// Refinement steps before there are patches.
    pub(crate) steps: u32,
    /// Bytes of the plan in memory.
    pub(crate) bytes: usize,
}

impl Census {
    /// Counts the patches of a plan.
    pub(crate) fn of(plan: &SurfacePlan) -> Self {
        let mut counts: BTreeMap<Sort, usize> = BTreeMap::new();
        for patch in &plan.patches {
            let sort = Sort { form: patch.kind().form(), boundary: patch.is_boundary(), valence: patch.valence() };
            *counts.entry(sort.known()).or_default() += 1;
        }
        let kinds = counts.into_iter().map(|(sort, count)| Kind { label: sort.label(), color: sort.color(), count });
        Self {
            kinds: shortened(kinds.collect()),
            patches: plan.patches.len(),
            steps: plan.steps(),
            bytes: plan.bytes(),
        }
    }
}

/// The most frequent kinds in order, and one line for the others.
fn shortened(mut kinds: Vec<Kind>) -> Vec<Kind> {
    kinds.sort_by_key(|kind| std::cmp::Reverse(kind.count));
    if kinds.len() > LINES {
        let others = kinds.split_off(LINES - 1);
        let label = format!("{} more kinds", others.len());
        kinds.push(Kind { label, color: [150, 150, 150], count: others.iter().map(|kind| kind.count).sum() });
    }
    kinds
}

/// What tells patches apart.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Sort {
    form: PatchForm,
    boundary: bool,
    valence: u32,
}

impl Sort {
    /// Regular inner patches are all alike.
    fn known(self) -> Self {
        if self.form == PatchForm::Bicubic && !self.boundary { Self { valence: 4, ..self } } else { self }
    }

    fn label(self) -> String {
        match (self.form, self.boundary) {
            (PatchForm::Bicubic, false) => "regular".to_owned(),
            (PatchForm::Bicubic, true) if self.valence == 2 => "regular, corner".to_owned(),
            (PatchForm::Bicubic, true) => "regular, boundary".to_owned(),
            (form, true) => format!("{}, boundary, {} edges", form.name(), self.valence),
            (form, false) => format!("{}, valence {}", form.name(), self.valence),
        }
    }

    /// The colour of shaders/include/palette.glsl, `shade_patch_color`.
    fn color(self) -> [u8; 3] {
        if self.form == PatchForm::Bicubic {
            return match (self.boundary, self.valence) {
                (false, _) => [0xe4, 0xe1, 0xda],
                (true, 2) => [0x3f, 0x74, 0xb5],
                (true, _) => [0x8f, 0xb8, 0xda],
            };
        }
        let more = ((f64::from(self.valence) - 5.0) / 8.0).clamp(0.0, 1.0).sqrt();
        match (self.boundary, self.valence) {
            (true, ..4) => [0x56, 0xb8, 0x70],
            (true, _) => mix([0xc9, 0x8b, 0xd8], [0x5a, 0x2a, 0x82], more),
            (false, 2) => [0xb9, 0xd6, 0x3a],
            (false, ..4) => [0xf9, 0xe3, 0x6a],
            (false, _) if more < 0.5 => mix([0xf6, 0xb5, 0x3c], [0xe2, 0x62, 0x2a], 2.0 * more),
            (false, _) => mix([0xe2, 0x62, 0x2a], [0x7d, 0x14, 0x20], 2.0 * more - 1.0),
        }
    }
}

/// Between two sRGB colours, as light mixes.
fn mix(from: [u8; 3], to: [u8; 3], part: f64) -> [u8; 3] {
    let light = |byte: u8| (f64::from(byte) / 255.0).powf(2.2);
    [0, 1, 2].map(|i| {
        let mixed = light(from[i]) + part * (light(to[i]) - light(from[i]));
        (255.0 * mixed.powf(1.0 / 2.2)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(label: &str, count: usize) -> Kind {
        Kind { label: label.to_owned(), color: [0; 3], count }
    }

    #[test]
    fn rare_kinds_share_a_line() {
        let kinds: Vec<Kind> = (1..=9).map(|count| kind("any", count)).collect();
        let short = shortened(kinds);
        assert_eq!(short.len(), LINES);
        assert_eq!(short.iter().map(|kind| kind.count).sum::<usize>(), 45);
        assert_eq!((short[0].count, short[LINES - 1].label.as_str()), (9, "3 more kinds"));
        assert_eq!(shortened(vec![kind("b", 1), kind("a", 2)]), [kind("a", 2), kind("b", 1)]);
    }

    #[test]
    fn colours_go_from_one_to_the_other() {
        let (a, b) = ([0, 10, 255], [200, 10, 0]);
        assert_eq!((mix(a, b, 0.0), mix(a, b, 1.0)), (a, b));
    }
}
