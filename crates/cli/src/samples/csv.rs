//! Rows of `sample`.

use crate::shortest::Shortest;
use osculate::{Sample, SubFace, SurfacePoint};
use std::io::{self, Write};

/// Names of the columns.
pub(crate) const HEADER: &str = "face,sub,s,t,px,py,pz,dux,duy,duz,dvx,dvy,dvz,nx,ny,nz,ev";

/// Writes a row. Numbers have the fewest digits that read back as the same number.
pub(crate) fn write_row(out: &mut dyn Write, place: &SurfacePoint, found: &Sample) -> io::Result<()> {
    let SurfacePoint { sub_face: SubFace { face, sub }, s, t } = place;
    write!(out, "{face},{sub},{},{}", Shortest(*s), Shortest(*t))?;
    for vector in [found.position, found.du, found.dv, found.normal] {
        write!(out, ",{},{},{}", Shortest(vector.x), Shortest(vector.y), Shortest(vector.z))?;
    }
    writeln!(out, ",{}", u8::from(found.irregular))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn rows_have_the_columns_of_the_header_and_read_back() {
        let place = SurfacePoint { sub_face: SubFace { face: 3, sub: -1 }, s: 0.1, t: 1.0 };
        let found = Sample {
            position: DVec3::new(1.0 / 3.0, -2.5e-12, 1e6),
            du: DVec3::X,
            dv: DVec3::splat(0.1 + 0.2),
            normal: DVec3::ZERO,
            irregular: true,
        };
        let mut row = Vec::new();
        write_row(&mut row, &place, &found).unwrap();
        let row = String::from_utf8(row).unwrap();
        assert!(row.starts_with("3,-1,0.1,1,0.3333333333333333,-2.5e-12,1e6,1,0,0,"), "{row}");
        assert!(row.ends_with(",0,0,0,1\n"), "{row}");
        let cells: Vec<f64> = row.trim_end().split(',').map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(cells.len(), HEADER.split(',').count());
        assert_eq!(cells[4..7], found.position.to_array());
        assert_eq!(cells[10], 0.1 + 0.2);
    }
}
