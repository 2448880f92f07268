//! What the generators promise of a mesh, found by counting: it refuses what no shipped cage may be.

use std::collections::BTreeMap;

use anyhow::{bail, ensure};

use super::mesh::{Mesh, corner_pairs};

/// Counts of a sound mesh: manifold, consistently wound, no degenerate face, no unused vertex.
pub(super) struct Survey {
    /// Number of vertices.
    pub(super) vertices: usize,
    /// Faces by number of corners.
    pub(super) face_sizes: BTreeMap<usize, usize>,
    /// Interior vertices by valence.
    pub(super) interior_valences: BTreeMap<usize, usize>,
    /// Boundary vertices by number of faces.
    pub(super) boundary_faces: BTreeMap<usize, usize>,
    /// Euler characteristic.
    pub(super) characteristic: isize,
    /// Enclosed volume; positive when a closed mesh is wound outward.
    pub(super) volume: f64,
}

impl Survey {
    /// Counts `mesh`, or says what is wrong with it.
    pub(super) fn of(mesh: &Mesh) -> anyhow::Result<Self> {
        check_faces(mesh)?;
        check_uv(mesh)?;
        let edges = directed_edges(mesh)?;
        let mut survey = Self {
            vertices: mesh.points.len(),
            face_sizes: BTreeMap::new(),
            interior_valences: BTreeMap::new(),
            boundary_faces: BTreeMap::new(),
            characteristic: 0,
            volume: volume(mesh),
        };
        mesh.faces.iter().for_each(|face| *survey.face_sizes.entry(face.len()).or_default() += 1);
        survey.count_vertices(mesh, &edges)?;
        ensure!(!survey.is_closed() || survey.volume > 0.0, "the mesh is inside out");
        let boundary = edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a))).count();
        let edge_count = (edges.len() + boundary) / 2;
        survey.characteristic = mesh.points.len() as isize - edge_count as isize + mesh.faces.len() as isize;
        Ok(survey)
    }

    /// Whether no edge lies on a boundary.
    pub(super) fn is_closed(&self) -> bool {
        self.boundary_faces.is_empty()
    }

    /// Number of faces.
    pub(super) fn faces(&self) -> usize {
        self.face_sizes.values().sum()
    }

    fn count_vertices(&mut self, mesh: &Mesh, edges: &Edges) -> anyhow::Result<()> {
        let mut faces_at = vec![0; mesh.points.len()];
        mesh.faces.iter().flatten().for_each(|&vertex| faces_at[vertex] += 1);
        let mut start = vec![None; mesh.points.len()];
        for &(a, b) in edges.keys() {
            // The ring starts at the outgoing edge without a twin; any edge will do for an interior vertex.
            if start[a].is_none() || !edges.contains_key(&(b, a)) {
                start[a] = Some(b);
            }
        }
        for vertex in 0..mesh.points.len() {
            let Some(first) = start[vertex] else { bail!("vertex {vertex} belongs to no face") };
            let (steps, closed) = walk_ring(mesh, edges, vertex, first);
            ensure!(steps == faces_at[vertex], "vertex {vertex} joins several fans of faces");
            let counts = if closed { &mut self.interior_valences } else { &mut self.boundary_faces };
            *counts.entry(steps).or_default() += 1;
        }
        Ok(())
    }
}

/// Face and corner of every directed edge.
type Edges = BTreeMap<(usize, usize), (usize, usize)>;

/// Walks counter-clockwise round `vertex` from its edge to `first`: faces passed, and whether the walk came round.
fn walk_ring(mesh: &Mesh, edges: &Edges, vertex: usize, first: usize) -> (usize, bool) {
    let mut next = first;
    let mut steps = 0;
    while let Some(&(face, corner)) = edges.get(&(vertex, next)) {
        let face = &mesh.faces[face];
        next = face[(corner + face.len() - 1) % face.len()];
        steps += 1;
        if next == first {
            return (steps, true);
        }
    }
    (steps, false)
}

fn check_faces(mesh: &Mesh) -> anyhow::Result<()> {
    ensure!(mesh.points.iter().all(|point| point.is_finite()), "a coordinate is not finite");
    for (index, face) in mesh.faces.iter().enumerate() {
        ensure!(face.len() >= 3, "face {index} has {} corners", face.len());
        ensure!(face.iter().all(|&vertex| vertex < mesh.points.len()), "face {index} names no vertex");
        let sides = corner_pairs(face).map(|(a, b)| mesh.points[a].distance(mesh.points[b]));
        let longest = sides.clone().fold(0.0, f64::max);
        ensure!(sides.fold(f64::MAX, f64::min) > 0.01 * longest, "face {index} has a collapsed side");
        let area = 0.5 * mesh.face_normal(index).length();
        ensure!(area > 0.01 * longest * longest, "face {index} is degenerate");
    }
    Ok(())
}

fn check_uv(mesh: &Mesh) -> anyhow::Result<()> {
    let Some(uv) = &mesh.uv else { return Ok(()) };
    ensure!(uv.faces.len() == mesh.faces.len(), "texture coordinates for {} faces", uv.faces.len());
    for (index, (corners, face)) in uv.faces.iter().zip(&mesh.faces).enumerate() {
        ensure!(corners.len() == face.len(), "texture coordinates of face {index} do not fit it");
        ensure!(corners.iter().all(|&corner| corner < uv.points.len()), "face {index} names no coordinate");
    }
    let in_square = |p: &glam::DVec2| p.min_element() >= 0.0 && p.max_element() <= 1.0;
    ensure!(uv.points.iter().all(in_square), "a texture coordinate lies outside the unit square");
    Ok(())
}

fn directed_edges(mesh: &Mesh) -> anyhow::Result<Edges> {
    let mut edges = Edges::new();
    for (index, face) in mesh.faces.iter().enumerate() {
        for (corner, edge) in corner_pairs(face).enumerate() {
            let earlier = edges.insert(edge, (index, corner));
            ensure!(earlier.is_none(), "edge {edge:?} is run twice in one direction, again by face {index}");
        }
    }
    Ok(edges)
}

/// Volume of the cone from the origin over the faces: the enclosed volume of a closed mesh.
fn volume(mesh: &Mesh) -> f64 {
    let fans = mesh.faces.iter().flat_map(|face| (1..face.len() - 1).map(move |k| [face[0], face[k], face[k + 1]]));
    fans.map(|[a, b, c]| mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6.0).sum()
}

#[cfg(test)]
mod tests {
    use super::super::primitives::cube;
    use super::*;

    fn refusal(change: impl FnOnce(&mut Mesh)) -> String {
        let mut mesh = cube();
        change(&mut mesh);
        Survey::of(&mesh).err().expect("a refusal").to_string()
    }

    #[test]
    fn counts_a_cube() {
        let survey = Survey::of(&cube()).unwrap();
        assert_eq!(survey.vertices, 8);
        assert_eq!(survey.face_sizes, [(4, 6)].into());
        assert_eq!(survey.interior_valences, [(3, 8)].into());
        assert_eq!(survey.characteristic, 2);
        assert!((survey.volume - 8.0).abs() < 1e-12 && survey.is_closed());
    }

    #[test]
    fn refuses_what_no_cage_may_be() {
        assert!(refusal(|mesh| mesh.faces[0].reverse()).contains("twice"));
        assert!(refusal(|mesh| mesh.faces.iter_mut().for_each(|face| face.reverse())).contains("inside out"));
        assert!(refusal(|mesh| mesh.points[0] = mesh.points[1]).contains("collapsed"));
        assert!(refusal(|mesh| mesh.points.push(glam::DVec3::ZERO)).contains("no face"));
        assert!(refusal(|mesh| mesh.faces[0] = vec![0, 2]).contains("corners"));
        assert!(refusal(|mesh| mesh.points[0].x = f64::NAN).contains("finite"));
    }

    #[test]
    fn refuses_two_fans_at_a_vertex() {
        let mut mesh = cube();
        let other = cube();
        let first = mesh.points.len();
        mesh.points.extend(other.points.iter().map(|p| *p + 4.0));
        let merged = |vertex: usize| if vertex == 0 { 7 } else { first + vertex };
        mesh.faces.extend(other.faces.iter().map(|face| face.iter().map(|&v| merged(v)).collect()));
        mesh.points.swap_remove(first);
        let last = mesh.points.len();
        mesh.faces.iter_mut().flatten().filter(|v| **v == last).for_each(|v| *v = first);
        assert!(Survey::of(&mesh).err().expect("a refusal").to_string().contains("fans"));
    }
}
