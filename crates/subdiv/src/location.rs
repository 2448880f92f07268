//! Where a patch lies on the base mesh: every final quad is a child of a child of a base face, numbered by half-edges, so its place follows from its
//! number.

use osculate_cage::{Cage, sub_faces};

/// A base quad (`sub` = -1), or the child quad at corner `sub` of any other face. Its unit square has (0,0), (1,0), (1,1), (0,1) at the corners of the quad,
/// or at the vertex, the middle of the edge to the next vertex, the centre, and the middle of the edge to the previous vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SubFace {
    /// Face of the cage.
    pub face: u32,
    /// -1 for a quad, else the corner of the face.
    pub sub: i32,
}

/// The affine map from a patch's (u,v) to the (s,t) of its sub-face: `origin + u * u_axis + v * v_axis`. The axes are parallel to s and t and as long as the patch
/// is wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchLocation {
    /// Part of the base mesh.
    pub sub_face: SubFace,
    /// (s,t) of the patch's corner 0.
    pub origin: [f64; 2],
    /// (s,t) from corner 0 to corner 1.
    pub u_axis: [f64; 2],
    /// (s,t) from corner 0 to corner 3.
    pub v_axis: [f64; 2],
}

impl PatchLocation {
    /// (s,t) of the patch's (u,v).
    pub fn st(&self, uv: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.origin[i] + uv[0] * self.u_axis[i] + uv[1] * self.v_axis[i])
    }

    /// Derivatives with respect to s and t from those with respect to u and v.
    pub fn derivatives<V>(&self, du: V, dv: V) -> [V; 2]
    where
        V: Copy + std::ops::Mul<f64, Output = V> + std::ops::Add<Output = V>,
    {
        // The axes are orthogonal and equally long, so the inverse of the map is its transpose over the squared length.
        let squared = self.u_axis[0] * self.u_axis[0] + self.u_axis[1] * self.u_axis[1];
        [0, 1].map(|i| du * (self.u_axis[i] / squared) + dv * (self.v_axis[i] / squared))
    }
}

const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// Maps final quads to the base mesh and back.
pub struct Locator {
    face_offsets: Vec<u32>,
    steps: u32,
}

impl Locator {
    /// For a cage refined `steps` times, 1 (quads only) or 2.
    pub(crate) fn new(cage: &Cage, steps: u32) -> Self {
        Self { face_offsets: cage.face_offsets().to_vec(), steps }
    }

    fn corners(&self, face: u32) -> u32 {
        self.face_offsets[face as usize + 1] - self.face_offsets[face as usize]
    }

    /// The face of the cage that a half-edge belongs to.
    fn face_of(&self, half_edge: u32) -> u32 {
        self.face_offsets.partition_point(|&offset| offset <= half_edge) as u32 - 1
    }

    /// The base face that a final quad comes from.
    pub fn base_face(&self, quad: u32) -> u32 {
        self.face_of(quad >> (2 * (self.steps - 1)))
    }

    /// The place of a final quad.
    pub fn locate(&self, quad: u32) -> PatchLocation {
        let first = quad >> (2 * (self.steps - 1));
        let face = self.face_of(first);
        let corner = first - self.face_offsets[face as usize];
        let whole = |sub| PatchLocation {
            sub_face: SubFace { face, sub },
            origin: [0.0; 2],
            u_axis: [1.0, 0.0],
            v_axis: [0.0, 1.0],
        };
        let child = if self.corners(face) == 4 { child_of(&whole(-1), corner) } else { whole(corner as i32) };
        if self.steps == 2 { child_of(&child, quad & 3) } else { child }
    }

    /// The final quad that holds (s,t) of a sub-face, and its (u,v); `None` if there is no such sub-face.
    pub fn find(&self, sub_face: SubFace, st: [f64; 2]) -> Option<(u32, [f64; 2])> {
        let face = sub_face.face;
        if face as usize + 1 >= self.face_offsets.len() {
            return None;
        }
        let corners = self.corners(face);
        if !sub_faces(corners as usize).contains(&sub_face.sub) {
            return None;
        }
        let offset = self.face_offsets[face as usize];
        let (first, uv) = if corners == 4 {
            let (corner, uv) = into_child(st);
            (offset + corner, uv)
        } else {
            (offset + sub_face.sub as u32, st)
        };
        if self.steps == 2 {
            let (corner, uv) = into_child(uv);
            Some((4 * first + corner, uv))
        } else {
            Some((first, uv))
        }
    }

    /// The sub-faces of a face, in order.
    pub fn sub_faces(&self, face: u32) -> impl Iterator<Item = SubFace> + use<> {
        sub_faces(self.corners(face) as usize).map(move |sub| SubFace { face, sub })
    }
}

/// The child at `corner` of a square: half as wide, its corner 0 there, its u axis along the side to the next corner.
fn child_of(square: &PatchLocation, corner: u32) -> PatchLocation {
    let at = |i: u32| square.st(CORNERS[(i & 3) as usize]);
    let (origin, next, previous) = (at(corner), at(corner + 1), at(corner + 3));
    let half = |to: [f64; 2]| [0, 1].map(|i| (to[i] - origin[i]) / 2.0);
    PatchLocation { origin, u_axis: half(next), v_axis: half(previous), ..*square }
}

/// The child of the unit square that holds (s,t), and the coordinates in it.
fn into_child([s, t]: [f64; 2]) -> (u32, [f64; 2]) {
    match (s < 0.5, t < 0.5) {
        (true, true) => (0, [2.0 * s, 2.0 * t]),
        (false, true) => (1, [2.0 * t, 2.0 * (1.0 - s)]),
        (false, false) => (2, [2.0 * (1.0 - s), 2.0 * (1.0 - t)]),
        (true, false) => (3, [2.0 * (1.0 - t), 2.0 * s]),
    }
}
