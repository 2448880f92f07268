//! Statements of OBJ files that a cage has no use for.

use crate::Warning;
use crate::text::quoted;

/// Why the statement `name` is passed over; `None` if nothing is lost by that.
pub(super) fn reason(name: &[u8]) -> Option<&'static str> {
    match name {
        b"vn" | b"mg" | b"mtllib" | b"maplib" | b"usemap" | b"lod" | b"bevel" | b"c_interp" | b"d_interp"
        | b"shadow_obj" | b"trace_obj" => None,
        b"p" => Some("points are not part of a cage"),
        b"l" => Some("lines are not part of a cage"),
        b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim" | b"hole"
        | b"scrv" | b"sp" | b"end" | b"con" | b"ctech" | b"stech" => Some("free-form curves and surfaces are not read"),
        _ => Some("unknown"),
    }
}

/// The statements that were passed over, by name.
#[derive(Default)]
pub(super) struct Ignored {
    warnings: Vec<Warning>,
}

impl Ignored {
    /// A file that is no OBJ file at all has as many different statements as lines.
    const NAMES: usize = 16;

    pub(super) fn push(&mut self, word: &[u8], reason: &'static str, at: u32) {
        let word = if self.warnings.len() < Self::NAMES { quoted(word) } else { "others".into() };
        let known = self.warnings.iter_mut().find_map(|warning| match warning {
            Warning::Statement { name, statements, .. } if *name == word => Some(statements),
            _ => None,
        });
        match known {
            Some(statements) => *statements += 1,
            None => self.warnings.push(Warning::Statement { name: word, reason, statements: 1, line: at }),
        }
    }

    pub(super) fn into_warnings(self) -> Vec<Warning> {
        self.warnings
    }
}
