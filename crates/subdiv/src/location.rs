//! Where a patch lies on the base mesh: every final face is a base face, a child of one or a child of a child, numbered by half-edges, so its place
//! follows from its number.

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

/// The affine map from a quad's (u,v) to the (s,t) of its sub-face: `origin + u * u_axis + v * v_axis`. The axes are parallel to s and t and as long as the quad
/// is wide.
#[derive(Clone, Copy)]
struct Square {
    sub_face: SubFace,
    /// (s,t) of the quad's corner 0.
    origin: [f64; 2],
    /// (s,t) from corner 0 to corner 1.
    u_axis: [f64; 2],
    /// (s,t) from corner 0 to corner 3.
    v_axis: [f64; 2],
}

impl Square {
    /// (s,t) of (u,v).
    fn st(&self, uv: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.origin[i] + uv[0] * self.u_axis[i] + uv[1] * self.v_axis[i])
    }
}

const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// A point of a base quad or of a sub-face of any other face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Part of the base mesh.
    pub sub_face: SubFace,
    /// Coordinates in its unit square.
    pub st: [f64; 2],
    /// Derivatives of (s,t) with respect to the patch's u and v.
    pub axes: [[f64; 2]; 2],
}

/// A point of a patch, found by its place on the base mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPoint {
    /// Final face.
    pub face: u32,
    /// Coordinates in the unit square of the patch, or barycentric coordinates of corners 1 and 2 of a triangle. Opposite corner 0 of a triangle these
    /// add up to 1 in single precision, too.
    pub uv: [f64; 2],
    /// Derivatives of (u,v) with respect to s and to t.
    pub axes: [[f64; 2]; 2],
}

impl PatchPoint {
    /// Derivatives with respect to s and t from those with respect to u and v.
    pub fn derivatives<V>(&self, du: V, dv: V) -> [V; 2]
    where
        V: Copy + std::ops::Mul<f64, Output = V> + std::ops::Add<Output = V>,
    {
        self.axes.map(|[u, v]| du * u + dv * v)
    }
}

/// Maps final faces to the base mesh and back.
pub struct Locator {
    face_offsets: Vec<u32>,
    steps: u32,
    /// Whether each face of the last mesh but one stays as it is; empty if none does.
    unrefined: Vec<bool>,
}

impl Locator {
    /// For a cage refined `steps` times: 0 (quads and triangles only), 1 or 2.
    pub(crate) fn new(cage: &Cage, steps: u32) -> Self {
        Self { face_offsets: cage.face_offsets().to_vec(), steps, unrefined: Vec::new() }
    }

    /// Takes note of the faces before the last step that it leaves as they are: the patch of such a face has the face's own (u,v).
    pub(crate) fn leave(&mut self, unrefined: Vec<bool>) {
        self.unrefined = unrefined;
    }

    /// Whether the last step leaves a face as it is.
    fn is_left(&self, face: u32) -> bool {
        self.unrefined.get(face as usize).copied().unwrap_or(false)
    }

    fn corners(&self, face: u32) -> u32 {
        self.face_offsets[face as usize + 1] - self.face_offsets[face as usize]
    }

    /// The corners of a face of the cage.
    pub(crate) fn face_corners(&self, face: u32) -> std::ops::Range<u32> {
        self.face_offsets[face as usize]..self.face_offsets[face as usize + 1]
    }

    /// The face of the cage that a half-edge belongs to.
    fn face_of(&self, half_edge: u32) -> u32 {
        self.face_offsets.partition_point(|&offset| offset <= half_edge) as u32 - 1
    }

    /// The base face that a final face comes from.
    pub fn base_face(&self, face: u32) -> u32 {
        match self.steps {
            0 => face,
            steps => self.face_of(face >> (2 * (steps - 1))),
        }
    }

    /// Whether the patch of a final face is a triangle.
    fn is_triangle(&self, face: u32) -> bool {
        self.steps == 0 && self.corners(face) == 3
    }

    /// The place of a point of a final face. On a line between sub-faces of a triangle it is in the first of them.
    pub fn place(&self, face: u32, uv: [f64; 2]) -> Place {
        if self.is_triangle(face) {
            let (sub, st) = into_sub_face(uv);
            let axes = inverse(in_triangle(face, sub, st).axes);
            return Place { sub_face: SubFace { face, sub: sub as i32 }, st, axes };
        }
        let square = self.square(face);
        Place { sub_face: square.sub_face, st: square.st(uv), axes: [square.u_axis, square.v_axis] }
    }

    /// The part of a sub-face that a final quad is.
    fn square(&self, quad: u32) -> Square {
        let whole = |face, sub| Square {
            sub_face: SubFace { face, sub },
            origin: [0.0; 2],
            u_axis: [1.0, 0.0],
            v_axis: [0.0, 1.0],
        };
        if self.steps == 0 {
            return whole(quad, -1);
        }
        let first = quad >> (2 * (self.steps - 1));
        let face = self.face_of(first);
        let corner = first - self.face_offsets[face as usize];
        if self.steps == 1 && self.is_left(face) {
            return whole(face, -1);
        }
        let child =
            if self.corners(face) == 4 { child_of(&whole(face, -1), corner) } else { whole(face, corner as i32) };
        if self.steps == 2 && !self.is_left(first) { child_of(&child, quad & 3) } else { child }
    }

    /// The point of a patch at (s,t) of a sub-face; `None` if there is no such sub-face.
    pub fn find(&self, sub_face: SubFace, st: [f64; 2]) -> Option<PatchPoint> {
        let face = sub_face.face;
        if face as usize + 1 >= self.face_offsets.len() {
            return None;
        }
        let corners = self.corners(face);
        if !sub_faces(corners as usize).contains(&sub_face.sub) {
            return None;
        }
        let whole = PatchPoint { face, uv: st, axes: [[1.0, 0.0], [0.0, 1.0]] };
        if self.steps == 0 {
            return Some(if corners == 3 { in_triangle(face, sub_face.sub as usize, st) } else { whole });
        }
        let offset = self.face_offsets[face as usize];
        if self.steps == 1 && self.is_left(face) {
            return Some(PatchPoint { face: offset, ..whole });
        }
        let first = if corners == 4 {
            into_child(whole, |corner| offset + corner)
        } else {
            PatchPoint { face: offset + sub_face.sub as u32, ..whole }
        };
        Some(match self.steps {
            2 if self.is_left(first.face) => PatchPoint { face: 4 * first.face, ..first },
            2 => into_child(first, |corner| 4 * first.face + corner),
            _ => first,
        })
    }

    /// The sub-faces of a face, in order.
    pub fn sub_faces(&self, face: u32) -> impl Iterator<Item = SubFace> + use<> {
        sub_faces(self.corners(face) as usize).map(move |sub| SubFace { face, sub })
    }
}

/// The child at `corner` of a square: half as wide, its corner 0 there, its u axis along the side to the next corner.
fn child_of(square: &Square, corner: u32) -> Square {
    let at = |i: u32| square.st(CORNERS[(i & 3) as usize]);
    let (origin, next, previous) = (at(corner), at(corner + 1), at(corner + 3));
    let half = |to: [f64; 2]| [0, 1].map(|i| (to[i] - origin[i]) / 2.0);
    Square { origin, u_axis: half(next), v_axis: half(previous), ..*square }
}

/// The same point in the child of its square that holds it, which `number` gives its number.
fn into_child(point: PatchPoint, number: impl Fn(u32) -> u32) -> PatchPoint {
    let [s, t] = point.uv;
    let (corner, uv) = match (s < 0.5, t < 0.5) {
        (true, true) => (0, [2.0 * s, 2.0 * t]),
        (false, true) => (1, [2.0 * t, 2.0 * (1.0 - s)]),
        (false, false) => (2, [2.0 * (1.0 - s), 2.0 * (1.0 - t)]),
        (true, false) => (3, [2.0 * (1.0 - t), 2.0 * s]),
    };
    // The child is turned by a quarter for each corner.
    let axes = point.axes.map(|[a, b]| match corner {
        0 => [2.0 * a, 2.0 * b],
        1 => [2.0 * b, -2.0 * a],
        2 => [-2.0 * a, -2.0 * b],
        _ => [-2.0 * b, 2.0 * a],
    });
    PatchPoint { face: number(corner), uv, axes }
}

/// The point at (s,t) of sub-face `sub` of a triangle: the bilinear map of its corner, the middles of the sides there and the centroid. With b and c the
/// barycentric coordinates of the next and the previous corner, `6 b = s (3 - t)` and `6 c = t (3 - s)`.
fn in_triangle(face: u32, sub: usize, [s, t]: [f64; 2]) -> PatchPoint {
    let weights = |own: f64, next: f64, previous: f64| {
        let mut weights = [0.0; 3];
        [weights[sub], weights[(sub + 1) % 3], weights[(sub + 2) % 3]] = [own, next, previous];
        weights
    };
    let (b, c) = (s * (3.0 - t) / 6.0, t * (3.0 - s) / 6.0);
    let (by_s, by_t) = ([(3.0 - t) / 6.0, -t / 6.0], [-s / 6.0, (3.0 - s) / 6.0]);
    let axes = [by_s, by_t].map(|[b, c]| {
        let [_, u, v] = weights(-b - c, b, c);
        [u, v]
    });
    let [opposite, u, v] = weights(1.0 - b - c, b, c);
    PatchPoint { face, uv: if opposite == 0.0 { with_exact_sum(u) } else { [u, v] }, axes }
}

/// Numbers of single precision that add up to 1, the first near `u`.
fn with_exact_sum(u: f64) -> [f64; 2] {
    // The larger is a multiple of 2^-24, and so is the other then.
    if u < 0.5 {
        let [v, u] = with_exact_sum(1.0 - u);
        return [u, v];
    }
    let u = f64::from(u as f32);
    [u, 1.0 - u]
}

/// The sub-face of a triangle that holds a point with barycentric coordinates (u,v) of corners 1 and 2, and its (s,t): the inverse of [`in_triangle`].
fn into_sub_face([u, v]: [f64; 2]) -> (usize, [f64; 2]) {
    let weights = [1.0 - u - v, u, v];
    let sub = (1..3).fold(0, |best, i| if weights[i] > weights[best] { i } else { best });
    let (b, c) = (weights[(sub + 1) % 3].max(0.0), weights[(sub + 2) % 3].max(0.0));
    // s - t = 2 (b - c) makes a quadratic of 6 b = s (3 - t); of its roots the one below 1, written without cancellation.
    let gap = 2.0 * (b - c);
    let root = ((3.0 + gap) * (3.0 + gap) - 24.0 * b).max(0.0).sqrt();
    (sub, [12.0 * b / (3.0 + gap + root), 12.0 * c / (3.0 - gap + root)].map(|x| x.min(1.0)))
}

fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let determinant = a * d - b * c;
    [[d, -b], [-c, a]].map(|row| row.map(|x| x / determinant))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quad, a triangle and a pentagon.
    fn locator(steps: u32) -> Locator {
        let face_offsets = if steps == 0 { vec![0, 4, 7] } else { vec![0, 4, 7, 12] };
        Locator { face_offsets, steps, unrefined: Vec::new() }
    }

    fn places(locator: &Locator) -> Vec<(SubFace, [f64; 2])> {
        let st = |i: u32| [f64::from(i % 9) / 8.0, f64::from(i / 9) / 8.0];
        let faces = 0..locator.face_offsets.len() as u32 - 1;
        let sub_faces = faces.flat_map(|face| locator.sub_faces(face));
        sub_faces.flat_map(|sub_face| (0..81).map(move |i| (sub_face, st(i)))).collect()
    }

    #[test]
    fn places_are_found_again() {
        for steps in 0..3 {
            let locator = locator(steps);
            for (sub_face, st) in places(&locator) {
                let point = locator.find(sub_face, st).unwrap();
                let back = locator.place(point.face, point.uv);
                assert_eq!(locator.base_face(point.face), sub_face.face);
                if back.sub_face == sub_face {
                    let gap = (0..2).map(|i| (back.st[i] - st[i]).abs()).fold(0.0, f64::max);
                    assert!(gap < 2e-7, "{steps} steps: {st:?} of {sub_face:?} comes back as {back:?}");
                } else {
                    let inside = st.iter().all(|x| (0.1..0.9).contains(x));
                    assert!(!inside, "{steps} steps: {st:?} of {sub_face:?} comes back as {back:?}");
                }
            }
        }
    }

    #[test]
    fn axes_are_derivatives_and_each_others_inverses() {
        for steps in 0..3 {
            let locator = locator(steps);
            let off_lines = |st: &[f64; 2]| st.iter().all(|x| [0.125, 0.375, 0.875].contains(x));
            for (sub_face, st) in places(&locator).into_iter().filter(|(_, st)| off_lines(st)) {
                let h = 2.0_f64.powi(-20);
                let at = |s: f64, t: f64| locator.find(sub_face, [st[0] + s, st[1] + t]).unwrap();
                let (here, along) = (at(0.0, 0.0), [at(h, 0.0), at(0.0, h)]);
                let place = locator.place(here.face, here.uv);
                for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let slope = (along[i].uv[j] - here.uv[j]) / h;
                    assert!((slope - here.axes[i][j]).abs() < 1e-6, "{steps} steps: {st:?} of {sub_face:?}");
                    let product: f64 = (0..2).map(|k| here.axes[i][k] * place.axes[k][j]).sum();
                    assert!((product - f64::from(i == j)).abs() < 1e-6, "{steps} steps: {st:?} of {sub_face:?}");
                }
            }
        }
    }

    #[test]
    fn sub_faces_of_a_triangle_meet() {
        let locator = locator(0);
        let at = |sub, st| locator.find(SubFace { face: 1, sub }, st).unwrap().uv;
        for sub in 0..3 {
            let centroid = at(sub, [1.0, 1.0]);
            assert!(centroid.iter().all(|x| (x - 1.0 / 3.0).abs() < 1e-15), "{centroid:?}");
            let next = (sub + 1) % 3;
            for x in [0.0, 0.3, 1.0] {
                let (here, there) = (at(sub, [1.0, x]), at(next, [x, 1.0]));
                assert!((0..2).all(|i| (here[i] - there[i]).abs() < 1e-7), "sub-face {sub} at {x}");
            }
        }
        assert_eq!([at(0, [0.0, 0.0]), at(1, [0.0, 0.0]), at(2, [0.0, 0.0])], [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    }

    /// Shaders find the third coordinate by subtraction; that it is zero tells them that a point is on the side.
    #[test]
    fn coordinates_opposite_corner_0_sum_to_one_in_single_precision() {
        let locator = locator(0);
        for i in 0..=1000 {
            let x = f64::from(i) / 1000.0;
            for (sub, st) in [(1, [x, 0.0]), (2, [0.0, x])] {
                let [u, v] = locator.find(SubFace { face: 1, sub }, st).unwrap().uv;
                assert_eq!((1.0 - u as f32) - v as f32, 0.0, "{x} of sub-face {sub}");
                assert_eq!([u as f32, v as f32].map(f64::from), [u, v]);
            }
            let [u, v] = locator.find(SubFace { face: 1, sub: 1 }, [x, 0.0]).unwrap().uv;
            assert!((v - x / 2.0).abs() < 4e-8 && u + v == 1.0);
        }
    }
}
