//! Lists of places from a file.

use super::Places;
use crate::failure::Failure;
use osculate::{SubFace, SurfacePoint};
use osculate_cage::{Cage, sub_faces};
use std::path::Path;

/// Reads places from a CSV file: face, sub, s, t in each line, after an optional header. Further columns are
/// ignored, so that what `sample` wrote can be read again. `drawn` says which faces have a surface.
pub(crate) fn read(path: &Path, cage: &Cage, drawn: &[bool]) -> Result<Places, Failure> {
    let refused = |line: usize, why: String| {
        Failure::input(format_args!("{}:{}: {why}", path.display(), line + 1)).with_hint(
            "each line is face,sub,s,t; sub is -1 for a quad and else a corner of the face, s and t are from 0 to 1",
        )
    };
    let text = std::fs::read_to_string(path)
        .map_err(|error| Failure::unreadable(format_args!("{}: {error}", path.display())))?;
    let mut places = Vec::new();
    for (line, text) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let text = text.trim();
        if text.is_empty() || (line == 0 && text.starts_with("face")) {
            continue;
        }
        let place = parse(text).ok_or_else(|| refused(line, format!("{text:?} is not face,sub,s,t")))?;
        let place = check(&place, cage, drawn).map_err(|why| refused(line, why))?;
        places.push(place);
    }
    Ok(Places { len: places.len() as u64, iterator: Box::new(places.into_iter()) })
}

fn parse(text: &str) -> Option<SurfacePoint> {
    let mut cells = text.split(',').map(str::trim);
    let mut next = || cells.next();
    Some(SurfacePoint {
        sub_face: SubFace { face: next()?.parse().ok()?, sub: next()?.parse().ok()? },
        s: next()?.parse().ok()?,
        t: next()?.parse().ok()?,
    })
}

/// What faces there are.
fn faces(count: usize) -> String {
    if count == 1 { "the only face is 0".into() } else { format!("the faces are 0 to {}", count - 1) }
}

/// Checks a place, whose face is numbered as in the file, and returns it with the face of the cage.
fn check(place: &SurfacePoint, cage: &Cage, drawn: &[bool]) -> Result<SurfacePoint, String> {
    let SurfacePoint { sub_face: SubFace { face, sub }, s, t } = *place;
    let Some(index) = cage.face_of_source(face) else {
        let last = cage.source_face(cage.face_count() as u32 - 1);
        let why = if face < last { "the repair dropped it".into() } else { faces(last as usize + 1) };
        return Err(format!("there is no face {face}; {why}"));
    };
    let corners = cage.face(index as usize).len();
    if !sub_faces(corners).contains(&sub) {
        let subs = if corners == 4 { "-1".to_owned() } else { format!("from 0 to {}", corners - 1) };
        return Err(format!("face {face} has {corners} corners, so sub must be {subs}, not {sub}"));
    }
    if !((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)) {
        return Err(format!("(s,t) = ({s},{t}) is not in the unit square"));
    }
    if !drawn[index as usize] {
        return Err(format!("face {face} is not part of the surface: it is a hole, or the boundary rule drops it"));
    }
    Ok(SurfacePoint { sub_face: SubFace { face: index, sub }, s, t })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use osculate_cage::CageDesc;

    fn triangle() -> Cage {
        Cage::new(CageDesc {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            face_offsets: vec![0, 3],
            face_vertices: vec![0, 1, 2],
            ..CageDesc::default()
        })
        .unwrap()
    }

    fn read_text(text: &str, drawn: bool) -> Result<Vec<SurfacePoint>, Failure> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("points.csv");
        std::fs::write(&path, text).unwrap();
        read(&path, &triangle(), &[drawn]).map(|places| places.batches().flatten().collect())
    }

    #[test]
    fn headers_blank_lines_and_further_columns_are_skipped() {
        let places = read_text("\u{feff}face,sub,s,t,px\r\n0,2,0.25,1,99\r\n\n 0, 0, 0, 0.5\n", true).unwrap();
        let place = |sub, s, t| SurfacePoint { sub_face: SubFace { face: 0, sub }, s, t };
        assert_eq!(places, [place(2, 0.25, 1.0), place(0, 0.0, 0.5)]);
    }

    #[test]
    fn errors_name_file_and_line() {
        for (wrong, part) in [
            ("0,0,x,0", "is not face"),
            ("0,0,0", "is not face"),
            ("-1,0,0,0", "is not face"),
            ("1,0,0,0", "no face 1"),
            ("0,3,0,0", "3 corners"),
            ("0,-1,0,0", "3 corners"),
            ("0,0,1.01,0", "unit square"),
            ("0,0,0,nan", "unit square"),
        ] {
            let failure = format!("{:?}", read_text(&format!("0,0,0,0\n{wrong}\n"), true).unwrap_err());
            assert!(failure.contains("points.csv:2: ") && failure.contains(part), "{wrong}: {failure}");
        }
        assert!(read_text("0,0,0,0", false).is_err());
    }
}
