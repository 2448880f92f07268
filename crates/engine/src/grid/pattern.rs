//! How triangles join the vertices of one patch.
//!
//! The inner vertices are a grid; a strip of triangles joins the border of that grid to each side of the patch, whatever number of segments the side has.
//! Vertices are numbered along the border first, counter-clockwise from corner 0, then through the inner grid, u before v.

/// Segments of the sides of a patch, counter-clockwise from that between corners 0 and 1, and of its inside.
///
/// All triangles are counter-clockwise in (u,v). Those that have an inner vertex begin with one, so that flat attributes come from the patch itself where
/// vertices of the border are shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Pattern {
    /// (u,v) in the unit square.
    Quad {
        /// Segments of each side.
        sides: [u32; 4],
        /// Segments inside along u and along v: 2 or more, or both 1 for two triangles without inner vertices.
        inner: [u32; 2],
    },
    /// (u,v) in the triangle (0,0), (1,0), (0,1).
    Triangle {
        /// Segments of each side.
        sides: [u32; 3],
        /// Segments inside: 3 or more, or 1 for one triangle without inner vertices.
        inner: u32,
    },
}

impl Pattern {
    /// Pattern of a quad patch. Where there are more than two triangles, there is an inner vertex: an inside of one segment becomes one of two.
    pub(crate) fn quad(sides: [u32; 4], inner: [u32; 2]) -> Self {
        let plain = sides == [1; 4] && inner == [1; 2];
        Self::Quad { sides, inner: if plain { inner } else { inner.map(|n| n.max(2)) } }
    }

    /// Pattern of a triangle patch. Where there are more triangles than one, there is an inner vertex, which takes three segments inside.
    pub(crate) fn triangle(sides: [u32; 3], inner: u32) -> Self {
        let plain = sides == [1; 3] && inner == 1;
        Self::Triangle { sides, inner: if plain { 1 } else { inner.max(3) } }
    }

    /// Segments of the sides.
    pub(crate) fn sides(&self) -> &[u32] {
        match self {
            Self::Quad { sides, .. } => sides,
            Self::Triangle { sides, .. } => sides,
        }
    }

    /// Segments inside, along u and along v.
    pub(crate) fn inner_segments(&self) -> [u32; 2] {
        match *self {
            Self::Quad { inner, .. } => inner,
            Self::Triangle { inner, .. } => [inner; 2],
        }
    }

    /// Vertices on the border: one per segment.
    pub(crate) fn border_count(&self) -> u32 {
        self.sides().iter().sum()
    }

    /// Vertices inside.
    pub(crate) fn inner_count(&self) -> u32 {
        match *self {
            Self::Quad { inner: [u, v], .. } => (u - 1) * (v - 1),
            Self::Triangle { inner: 1, .. } => 0,
            Self::Triangle { inner: n, .. } => (n - 1) * (n - 2) / 2,
        }
    }

    /// All vertices.
    pub(crate) fn vertex_count(&self) -> u32 {
        self.border_count() + self.inner_count()
    }

    /// Number of triangles.
    pub(crate) fn triangle_count(&self) -> u32 {
        match *self {
            Self::Quad { inner: [1, 1], .. } => 2,
            Self::Quad { inner: [u, v], .. } => 2 * (u - 2) * (v - 2) + self.border_count() + 2 * (u - 2) + 2 * (v - 2),
            Self::Triangle { inner: 1, .. } => 1,
            Self::Triangle { inner: n, .. } => (n - 3) * (n - 3) + self.border_count() + 3 * (n - 3),
        }
    }

    /// Calls `emit` with the vertices of each triangle.
    pub(crate) fn for_each_triangle(&self, mut emit: impl FnMut([u32; 3])) {
        match *self {
            Self::Quad { inner: [1, 1], .. } => {
                emit([0, 1, 2]);
                emit([0, 2, 3]);
            }
            Self::Triangle { inner: 1, .. } => emit([0, 1, 2]),
            Self::Quad { sides, inner } => {
                let grid = QuadGrid { first: self.border_count(), inner };
                grid.for_each_triangle(&mut emit);
                self.stitch(&sides, |side| inner[side % 2], |side, i| grid.border(side, i), &mut emit);
            }
            Self::Triangle { sides, inner } => {
                let grid = TriangleGrid { first: self.border_count(), rows: inner - 3 };
                grid.for_each_triangle(&mut emit);
                self.stitch(&sides, |_| inner, |side, i| grid.border(side, i), &mut emit);
            }
        }
    }

    /// The strips between the sides and the border of the inner grid. `inner_vertex(side, i)` is vertex i of that border, counted along the side.
    fn stitch(
        &self,
        sides: &[u32],
        inner_segments: impl Fn(usize) -> u32,
        inner_vertex: impl Fn(usize, u32) -> u32,
        emit: &mut impl FnMut([u32; 3]),
    ) {
        let border = self.border_count();
        // A quad's inner border is shorter than its side by a segment at each end, a triangle's by one more between them.
        let missing = if sides.len() == 4 { 2 } else { 3 };
        let mut first = 0;
        for (side, &segments) in sides.iter().enumerate() {
            let strip = Strip { outer: segments, inner: inner_segments(side) - missing };
            strip.for_each_triangle(|corner| match corner {
                Step::Outer(i, j) => {
                    emit([inner_vertex(side, j), first + i, (first + i + 1) % border]);
                }
                Step::Inner(i, j) => emit([inner_vertex(side, j), (first + i) % border, inner_vertex(side, j + 1)]),
            });
            first += segments;
        }
    }
}

/// A strip of triangles between a side of `outer` segments and the border of the inner grid, of `inner` segments, which begins and ends half way in.
struct Strip {
    outer: u32,
    inner: u32,
}

/// A triangle of a strip between vertices i of the side and j of the inner border.
enum Step {
    /// On the side's segment from i to i + 1.
    Outer(u32, u32),
    /// On the inner segment from j to j + 1.
    Inner(u32, u32),
}

impl Strip {
    /// Walks both borders, each time along the segment whose middle comes first. Inner vertex j stands at (j + 1) / (inner + 2) of the side.
    fn for_each_triangle(&self, mut emit: impl FnMut(Step)) {
        let (mut i, mut j) = (0, 0);
        while i < self.outer || j < self.inner {
            let (outer_middle, inner_middle) = ((2 * i + 1) * (self.inner + 2), (2 * j + 3) * self.outer);
            // Ties are broken so that both halves are mirror images.
            let outer_first = outer_middle < inner_middle || (outer_middle == inner_middle && 2 * i + 1 < self.outer);
            if i < self.outer && (j == self.inner || outer_first) {
                emit(Step::Outer(i, j));
                i += 1;
            } else {
                emit(Step::Inner(i, j));
                j += 1;
            }
        }
    }
}

/// The inner vertices of a quad patch, from number `first`: `inner[0] - 1` along u, `inner[1] - 1` along v.
struct QuadGrid {
    first: u32,
    inner: [u32; 2],
}

impl QuadGrid {
    fn vertex(&self, i: u32, j: u32) -> u32 {
        self.first + j * (self.inner[0] - 1) + i
    }

    /// Vertex `i` of the grid's border along a side.
    fn border(&self, side: usize, i: u32) -> u32 {
        let [last_u, last_v] = self.inner.map(|n| n - 2);
        match side {
            0 => self.vertex(i, 0),
            1 => self.vertex(last_u, i),
            2 => self.vertex(last_u - i, last_v),
            _ => self.vertex(0, last_v - i),
        }
    }

    fn for_each_triangle(&self, emit: &mut impl FnMut([u32; 3])) {
        let [width, height] = self.inner.map(|n| n - 2);
        for j in 0..height {
            for i in 0..width {
                let [a, b] = [self.vertex(i, j), self.vertex(i, j + 1)];
                emit([a, a + 1, b + 1]);
                emit([a, b + 1, b]);
            }
        }
    }
}

/// The inner vertices of a triangle patch, from number `first`: `rows + 1` in the first row, along u, one less in each further one.
struct TriangleGrid {
    first: u32,
    rows: u32,
}

impl TriangleGrid {
    /// Vertex i of row j.
    fn vertex(&self, i: u32, j: u32) -> u32 {
        // Rows before j hold rows + 1, rows, .. vertices.
        self.first + j * (2 * self.rows + 3 - j) / 2 + i
    }

    /// Vertex `i` of the grid's border along a side.
    fn border(&self, side: usize, i: u32) -> u32 {
        match side {
            0 => self.vertex(i, 0),
            1 => self.vertex(self.rows - i, i),
            _ => self.vertex(0, self.rows - i),
        }
    }

    fn for_each_triangle(&self, emit: &mut impl FnMut([u32; 3])) {
        for j in 0..self.rows {
            for i in 0..self.rows - j {
                let (a, b) = (self.vertex(i, j), self.vertex(i, j + 1));
                emit([a, a + 1, b]);
                if i + 1 < self.rows - j {
                    emit([a + 1, b + 1, b]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;

    /// All combinations of `N` numbers from 1 to `most`.
    fn combinations<const N: usize>(most: u32) -> impl Iterator<Item = [u32; N]> {
        (0..most.pow(N as u32)).map(move |mut code| {
            [(); N].map(|()| {
                let digit = code % most;
                code /= most;
                digit + 1
            })
        })
    }

    fn triangles(pattern: &Pattern) -> Vec<[u32; 3]> {
        let mut all = Vec::new();
        pattern.for_each_triangle(|triangle| all.push(triangle));
        all
    }

    /// (u,v) of every vertex, equally spaced, straight from the definition.
    fn places(pattern: &Pattern) -> Vec<[f64; 2]> {
        let corners: &[[f64; 2]] = match pattern {
            Pattern::Quad { .. } => &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            Pattern::Triangle { .. } => &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        };
        let mut places = Vec::new();
        for (side, &n) in pattern.sides().iter().enumerate() {
            let (a, b) = (corners[side], corners[(side + 1) % corners.len()]);
            let at = |i: u32, k: usize| a[k] + (b[k] - a[k]) * f64::from(i) / f64::from(n);
            places.extend((0..n).map(|i| [at(i, 0), at(i, 1)]));
        }
        let part = |i: u32, n: u32| f64::from(i) / f64::from(n);
        match *pattern {
            Pattern::Quad { inner: [m, n], .. } => {
                places.extend((1..n).flat_map(|j| (1..m).map(move |i| [part(i, m), part(j, n)])));
            }
            Pattern::Triangle { inner: n, .. } => {
                places.extend((1..n).flat_map(|j| (1..n - j).map(move |i| [part(i, n), part(j, n)])));
            }
        }
        places
    }

    /// Everything that is promised of a pattern.
    fn check(pattern: &Pattern) {
        let (triangles, places) = (triangles(pattern), places(pattern));
        assert_eq!(places.len() as u32, pattern.vertex_count(), "{pattern:?}");
        assert_eq!(triangles.len() as u32, pattern.triangle_count(), "{pattern:?}");
        let (border, mut edges, mut area) = (pattern.border_count(), HashMap::new(), 0.0);
        for triangle in &triangles {
            let [a, b, c] = triangle.map(|vertex| places[vertex as usize]);
            let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            assert!(twice > 1e-9, "{pattern:?}: {triangle:?} is clockwise or degenerate");
            area += 0.5 * twice;
            let has_inner = triangle.iter().any(|&vertex| vertex >= border);
            assert!(triangle[0] >= border || !has_inner, "{pattern:?}: {triangle:?} begins on the border");
            for k in 0..3 {
                *edges.entry((triangle[k], triangle[(k + 1) % 3])).or_insert(0) += 1;
            }
        }
        for (&(a, b), &count) in &edges {
            assert_eq!(count, 1, "{pattern:?}: edge {a} {b} is used twice");
            let on_border = a < border && b == (a + 1) % border;
            assert_eq!(edges.contains_key(&(b, a)), !on_border, "{pattern:?}: edge {a} {b}");
        }
        for a in 0..border {
            assert!(edges.contains_key(&(a, (a + 1) % border)), "{pattern:?}: border edge {a} is open");
        }
        let expected = if matches!(pattern, Pattern::Quad { .. }) { 1.0 } else { 0.5 };
        assert!((area - expected).abs() < 1e-9, "{pattern:?}: triangles cover {area}");
    }

    #[test]
    fn quads_are_closed_and_counter_clockwise() {
        for [a, b, c, d] in combinations(6) {
            for inner in combinations::<2>(6) {
                check(&Pattern::quad([a, b, c, d], inner));
            }
        }
    }

    #[test]
    fn triangles_are_closed_and_counter_clockwise() {
        for sides in combinations(8) {
            for inner in 1..=8 {
                check(&Pattern::triangle(sides, inner));
            }
        }
    }

    #[test]
    fn large_patterns_are_closed_too() {
        check(&Pattern::quad([64; 4], [64; 2]));
        check(&Pattern::quad([1, 64, 33, 7], [64, 2]));
        check(&Pattern::triangle([64; 3], 64));
        check(&Pattern::triangle([1, 64, 17], 5));
    }

    #[test]
    fn equal_sides_give_two_triangles_a_cell() {
        for n in 1..=64 {
            let pattern = Pattern::quad([n; 4], [n; 2]);
            assert_eq!(pattern.triangle_count(), 2 * n * n);
            assert_eq!(pattern.vertex_count(), (n + 1) * (n + 1));
        }
    }

    #[test]
    fn the_plainest_patches_have_no_inner_vertices() {
        assert_eq!(triangles(&Pattern::quad([1; 4], [1; 2])), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(triangles(&Pattern::triangle([1; 3], 1)), [[0, 1, 2]]);
        assert_eq!(Pattern::quad([1, 2, 1, 1], [1, 1]).inner_count(), 1);
        assert_eq!(Pattern::triangle([1, 2, 1], 1).inner_count(), 1);
    }

    #[test]
    fn strips_are_mirror_images_of_themselves() {
        for [outer, inner] in combinations(12) {
            let (mut steps, mut mirrored) = (Vec::new(), Vec::new());
            Strip { outer, inner }.for_each_triangle(|step| match step {
                Step::Outer(i, j) => {
                    steps.push((true, i, j));
                    mirrored.push((true, outer - 1 - i, inner - j));
                }
                Step::Inner(i, j) => {
                    steps.push((false, i, j));
                    mirrored.push((false, outer - i, inner - 1 - j));
                }
            });
            mirrored.reverse();
            // The two triangles in the very middle may lean either way.
            let different = steps.iter().filter(|step| !mirrored.contains(step)).count();
            assert!(different <= 2, "{outer} {inner}: {steps:?}");
        }
    }
}
