//! Writing a cage as OBJ.

use std::collections::BTreeSet;
use std::io::{self, Write};

use crate::{BoundaryRule, Cage, CreaseMethod, FaceSet, FaceSetKind, Tags};

/// Writes a cage as OBJ text: vertices, uv, faces in order with their sets, tags. Numbers are in the shortest form that reads
/// back as the same bits, so reading the text gives the same cage, with two exceptions: names get a `_` where an OBJ line cannot
/// hold them, and of several objects or materials of one face the first is written.
///
/// # Errors
/// What the writer returns.
pub fn write_obj(cage: &Cage, mut out: impl Write) -> io::Result<()> {
    for p in cage.positions() {
        // Debug, unlike Display, writes large and small numbers with an exponent.
        writeln!(out, "v {:?} {:?} {:?}", p.x, p.y, p.z)?;
    }
    for uv in cage.uv().map_or(&[][..], |uv| &uv.values) {
        writeln!(out, "vt {:?} {:?}", uv.x, uv.y)?;
    }
    write_faces(cage, &mut out)?;
    write_tags(cage.tags(), &mut out)
}

fn write_faces(cage: &Cage, out: &mut impl Write) -> io::Result<()> {
    let switches = switches(cage);
    let mut next = 0;
    for f in 0..cage.face_count() {
        while let Some((_, statement)) = switches.get(next).filter(|(face, _)| *face as usize <= f) {
            writeln!(out, "{statement}")?;
            next += 1;
        }
        write!(out, "f")?;
        let first = cage.face_offsets()[f] as usize;
        for (i, &v) in cage.face(f).iter().enumerate() {
            let v = u64::from(v) + 1;
            match cage.uv() {
                Some(uv) => write!(out, " {v}/{}", u64::from(uv.indices[first + i]) + 1)?,
                None => write!(out, " {v}")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

/// The statements that begin and end face sets and the faces before which they stand, in rising order.
fn switches(cage: &Cage) -> Vec<(u32, String)> {
    let mut switches: Vec<(u32, String)> =
        FaceSetKind::ALL.iter().flat_map(|&kind| switches_of(cage.face_sets(), kind)).collect();
    switches.sort_by_key(|(face, _)| *face);
    switches
}

/// A sweep over the beginnings and ends of all ranges of one kind.
fn switches_of(sets: &[FaceSet], kind: FaceSetKind) -> Vec<(u32, String)> {
    let keyword = match kind {
        FaceSetKind::Object => "o",
        FaceSetKind::Group => "g",
        FaceSetKind::Material => "usemtl",
        FaceSetKind::Smoothing => "s",
    };
    let of_kind = sets.iter().enumerate().filter(|(_, set)| set.kind == kind);
    let ranges = of_kind.flat_map(|(index, set)| set.faces.iter().map(move |range| (index, range)));
    let mut events: Vec<(u32, usize)> =
        ranges.flat_map(|(index, range)| [(range.start, index), (range.end, index)]).collect();
    events.sort_unstable();
    // A face can be in many groups, but the format has one object and one material at a time.
    let most = if kind == FaceSetKind::Group { usize::MAX } else { 1 };
    let mut active = BTreeSet::new();
    let statement = |here: &[(u32, usize)]| {
        for &(_, index) in here {
            // Ranges of a set do not touch, so beginnings and ends alternate.
            if !active.remove(&index) {
                active.insert(index);
            }
        }
        if active.is_empty() && kind == FaceSetKind::Smoothing {
            return (here[0].0, "s off".into());
        }
        let names = active.iter().take(most).map(|&index| writable(&sets[index].name, kind));
        (here[0].0, names.fold(String::from(keyword), |statement, name| statement + " " + &name))
    };
    events.chunk_by(|a, b| a.0 == b.0).map(statement).collect()
}

/// A name that reads back as one name.
fn writable(name: &str, kind: FaceSetKind) -> String {
    let is_group = matches!(kind, FaceSetKind::Group | FaceSetKind::Smoothing);
    let mut name = name.replace(|c: char| c.is_control() || (is_group && c.is_ascii_whitespace()), "_");
    // White space at the ends would be cut, a backslash would join the next line, and a group must not look like a comment.
    if name.is_empty() || name.ends_with(['\\', ' ']) {
        name.push('_');
    }
    if name.starts_with(' ') || (is_group && name.starts_with('#')) {
        name.insert(0, '_');
    }
    name
}

fn write_tags(tags: &Tags, out: &mut impl Write) -> io::Result<()> {
    for crease in &tags.creases {
        writeln!(out, "t crease 2/1/0 {} {} {:?}", crease.vertices[0], crease.vertices[1], crease.sharpness)?;
    }
    for corner in &tags.corners {
        writeln!(out, "t corner 1/1/0 {} {:?}", corner.vertex, corner.sharpness)?;
    }
    for face in &tags.holes {
        writeln!(out, "t hole 1/0/0 {face}")?;
    }
    if let Some(rule) = tags.boundary {
        let number = match rule {
            BoundaryRule::None => 0,
            BoundaryRule::EdgeAndCorner => 1,
            BoundaryRule::EdgeOnly => 2,
        };
        writeln!(out, "t interpolateboundary 1/0/0 {number}")?;
    }
    if let Some(rule) = tags.face_varying_boundary {
        writeln!(out, "t facevaryinginterpolateboundary 1/0/0 {rule}")?;
    }
    if tags.crease_method == CreaseMethod::Chaikin {
        writeln!(out, "t creasemethod 0/0/1 chaikin")?;
    }
    if tags.smooth_triangles {
        writeln!(out, "t smoothtriangles 0/0/1 smooth")?;
    }
    Ok(())
}
