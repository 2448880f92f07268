//! Meshes from bytes: a regular one, damaged by edits, with tags that may or may not fit.

use arbitrary::{Result, Unstructured};
use glam::{DVec2, DVec3};
use osculate_cage::{BoundaryRule, CageDesc, Corner, Crease, CreaseMethod, FaceSet, FaceSetKind, FaceVarying, Tags};

/// Most rows, columns and spokes of a mesh before edits.
const MOST: u32 = 8;
const MOST_EDITS: usize = 24;
const MOST_TAGS: usize = 6;

/// A mesh as lists, which edits may break in every way that [`Cage::new`](osculate_cage::Cage::new) and repairs have to bear.
struct Mesh {
    positions: Vec<DVec3>,
    faces: Vec<Vec<u32>>,
}

/// The mesh that the bytes describe; short input is as if it went on with zeros.
pub(crate) fn desc(bytes: &mut Unstructured<'_>) -> Result<CageDesc> {
    let mut mesh = match bytes.int_in_range(0..=2)? {
        0 => grid(bytes.int_in_range(1..=MOST)?, bytes.int_in_range(1..=MOST)?, bytes.arbitrary()?),
        1 => pole(bytes.int_in_range(3..=2 * MOST)?, bytes.int_in_range(0..=2)?),
        _ => Mesh { positions: (0..8).map(cube_corner).collect(), faces: Vec::new() },
    };
    for _ in 0..bytes.int_in_range(0..=MOST_EDITS)? {
        mesh.edit(bytes)?;
    }
    let uv = if rarely(bytes, 4)? { Some(uv(&mesh, bytes)?) } else { None };
    let (tags, face_sets) = (tags(&mesh, bytes)?, face_sets(&mesh, bytes)?);
    let offsets = mesh.faces.iter().scan(0, |end, face| {
        *end += face.len() as u32;
        Some(*end)
    });
    let face_offsets = std::iter::once(0).chain(offsets).collect();
    let face_vertices = mesh.faces.concat();
    Ok(CageDesc { positions: mesh.positions, face_offsets, face_vertices, uv, tags, face_sets, ..CageDesc::default() })
}

fn cube_corner(i: u32) -> DVec3 {
    DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1))
}

/// Quads in rows and columns, of which each direction may close: a sheet, a tube, a torus.
fn grid(rows: u32, columns: u32, closed: [bool; 2]) -> Mesh {
    let across = if closed[0] { columns } else { columns + 1 };
    let down = if closed[1] { rows } else { rows + 1 };
    let at = |row: u32, column: u32| row % down * across + column % across;
    let quad = |row, column| vec![at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)];
    let point = |i: u32| DVec3::new(f64::from(i % across), f64::from(i / across), f64::from(i * i % 5) * 0.25);
    Mesh {
        positions: (0..across * down).map(point).collect(),
        faces: (0..rows)
            .flat_map(|row| (0..columns).map(move |column| (row, column)))
            .map(|(r, c)| quad(r, c))
            .collect(),
    }
}

/// A fan of triangles; closed below by nothing, by a second fan, or by one large face.
fn pole(spokes: u32, bottom: u32) -> Mesh {
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(spokes);
    let mut positions: Vec<DVec3> = (0..spokes).map(|i| DVec3::new(angle(i).cos(), angle(i).sin(), 0.0)).collect();
    positions.extend([DVec3::Z, -DVec3::Z]);
    let mut faces: Vec<Vec<u32>> = (0..spokes).map(|i| vec![i, (i + 1) % spokes, spokes]).collect();
    match bottom {
        0 => {}
        1 => faces.extend((0..spokes).map(|i| vec![(i + 1) % spokes, i, spokes + 1])),
        _ => faces.push((0..spokes).rev().collect()),
    }
    Mesh { positions, faces }
}

impl Mesh {
    fn edit(&mut self, bytes: &mut Unstructured<'_>) -> Result<()> {
        match bytes.int_in_range(0..=7)? {
            0 => self.positions.push(point(bytes)?),
            1 => {
                let corners = bytes.int_in_range(0..=9)?;
                let face = (0..corners).map(|_| self.vertex(bytes)).collect::<Result<_>>()?;
                self.faces.push(face);
            }
            2 => {
                if let Some(face) = self.face(bytes)? {
                    self.faces.swap_remove(face);
                }
            }
            3 => {
                if let Some(face) = self.face(bytes)? {
                    self.faces[face].reverse();
                }
            }
            4 => {
                let copy = self.face(bytes)?.map(|face| self.faces[face].clone());
                self.faces.extend(copy);
            }
            5 => self.merge(bytes)?,
            6 => self.insert(bytes)?,
            _ => {
                let (v, p) = (self.vertex(bytes)?, point(bytes)?);
                if let Some(position) = self.positions.get_mut(v as usize) {
                    *position = p;
                }
            }
        }
        Ok(())
    }

    /// Any vertex; one in 64 does not exist.
    fn vertex(&self, bytes: &mut Unstructured<'_>) -> Result<u32> {
        let count = self.positions.len() as u32;
        if rarely(bytes, 64)? { bytes.arbitrary() } else { bytes.int_in_range(0..=count.saturating_sub(1)) }
    }

    fn face(&self, bytes: &mut Unstructured<'_>) -> Result<Option<usize>> {
        if self.faces.is_empty() { Ok(None) } else { bytes.choose_index(self.faces.len()).map(Some) }
    }

    /// Puts one vertex in place of another throughout.
    fn merge(&mut self, bytes: &mut Unstructured<'_>) -> Result<()> {
        let (from, to) = (self.vertex(bytes)?, self.vertex(bytes)?);
        self.faces.iter_mut().flatten().filter(|v| **v == from).for_each(|v| *v = to);
        Ok(())
    }

    /// Gives a face another corner.
    fn insert(&mut self, bytes: &mut Unstructured<'_>) -> Result<()> {
        let v = self.vertex(bytes)?;
        if let Some(face) = self.face(bytes)? {
            let at = bytes.int_in_range(0..=self.faces[face].len())?;
            self.faces[face].insert(at, v);
        }
        Ok(())
    }
}

/// True once in `n` times, and never when the bytes have come to their end.
fn rarely(bytes: &mut Unstructured<'_>, n: u8) -> Result<bool> {
    Ok(bytes.int_in_range(1..=n)? == n)
}

/// Mostly points of a coarse lattice, so that some coincide; sometimes anything a file can hold.
fn point(bytes: &mut Unstructured<'_>) -> Result<DVec3> {
    let mut coordinate = || -> Result<f64> {
        Ok(match bytes.arbitrary::<u8>()? {
            250 => 1e17,
            251 => -0.0,
            252 => 1e-300,
            253 => f64::NAN,
            254 => f64::INFINITY,
            255 => bytes.arbitrary()?,
            lattice => f64::from(lattice % 16) * 0.5 - 4.0,
        })
    };
    Ok(DVec3::new(coordinate()?, coordinate()?, coordinate()?))
}

fn uv(mesh: &Mesh, bytes: &mut Unstructured<'_>) -> Result<FaceVarying> {
    let values = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE].to_vec();
    let corners: usize = mesh.faces.iter().map(Vec::len).sum();
    let mut indices: Vec<u32> = (0..corners).map(|corner| corner as u32 % 4).collect();
    for _ in 0..bytes.int_in_range(0..=3)? {
        let (at, value) = (bytes.arbitrary::<u16>()?, bytes.int_in_range(0..=4)?);
        if let Some(index) = indices.get_mut(usize::from(at)) {
            *index = value;
        }
    }
    Ok(FaceVarying { values, indices })
}

fn tags(mesh: &Mesh, bytes: &mut Unstructured<'_>) -> Result<Tags> {
    let mut tags = Tags::default();
    for _ in 0..bytes.int_in_range(0..=MOST_TAGS)? {
        let sharpness =
            if rarely(bytes, 16)? { bytes.arbitrary()? } else { f32::from(bytes.arbitrary::<u8>()?) / 16.0 };
        match bytes.int_in_range(0..=2)? {
            // Most creases are edges.
            0 => match mesh.face(bytes)?.map(|face| &mesh.faces[face]).filter(|face| face.len() > 1) {
                Some(face) => {
                    let i = bytes.choose_index(face.len())?;
                    tags.creases.push(Crease { vertices: [face[i], face[(i + 1) % face.len()]], sharpness });
                }
                None => tags.creases.push(Crease { vertices: [mesh.vertex(bytes)?, mesh.vertex(bytes)?], sharpness }),
            },
            1 => tags.corners.push(Corner { vertex: mesh.vertex(bytes)?, sharpness }),
            _ => tags.holes.extend(mesh.face(bytes)?.map(|face| face as u32)),
        }
    }
    let rules = [None, Some(BoundaryRule::None), Some(BoundaryRule::EdgeOnly), Some(BoundaryRule::EdgeAndCorner)];
    tags.boundary = *bytes.choose(&rules)?;
    if rarely(bytes, 8)? {
        tags.face_varying_boundary = Some(bytes.int_in_range(0..=6)?);
        tags.crease_method = CreaseMethod::Chaikin;
        tags.smooth_triangles = true;
    }
    Ok(tags)
}

fn face_sets(mesh: &Mesh, bytes: &mut Unstructured<'_>) -> Result<Vec<FaceSet>> {
    let mut sets = Vec::new();
    for _ in 0..bytes.int_in_range(0..=2)? {
        let (kind, name) = (*bytes.choose(&FaceSetKind::ALL)?, bytes.arbitrary::<&str>()?.chars().take(8).collect());
        let end = mesh.faces.len() as u32 + u32::from(rarely(bytes, 16)?);
        let start = bytes.int_in_range(0..=end)?;
        sets.push(FaceSet { kind, name, faces: std::iter::once(start..end).collect() });
    }
    Ok(sets)
}
