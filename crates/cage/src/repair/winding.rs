//! Which faces have to be turned over.

/// Faces in parts, each face with or against the winding of its part: a union-find with parities.
pub(super) struct Winding {
    parents: Vec<u32>,
    /// Whether a face runs against its parent.
    against: Vec<bool>,
    sizes: Vec<u32>,
}

impl Winding {
    pub(super) fn new(faces: usize) -> Self {
        Self { parents: (0..faces as u32).collect(), against: vec![false; faces], sizes: vec![1; faces] }
    }

    /// The representative of a face's part, and whether the face runs against it. Parts are merged by size, so paths are short.
    fn find(&self, face: u32) -> (u32, bool) {
        let (mut f, mut against) = (face, false);
        while self.parents[f as usize] != f {
            against ^= self.against[f as usize];
            f = self.parents[f as usize];
        }
        (f, against)
    }

    /// Demands that two faces run against each other, or alike; false if that contradicts what was demanded before.
    pub(super) fn relate(&mut self, a: u32, b: u32, against: bool) -> bool {
        let ((a, a_against), (b, b_against)) = (self.find(a), self.find(b));
        let against = a_against ^ b_against ^ against;
        if a == b {
            return !against;
        }
        let (root, child) = if self.sizes[a as usize] >= self.sizes[b as usize] { (a, b) } else { (b, a) };
        self.parents[child as usize] = root;
        self.against[child as usize] = against;
        self.sizes[root as usize] += self.sizes[child as usize];
        true
    }

    /// The faces to turn over: in each part the fewer, and where both are as many, those that run against the first face.
    pub(super) fn minority(&self) -> Vec<bool> {
        let found: Vec<(u32, bool)> = (0..self.parents.len() as u32).map(|f| self.find(f)).collect();
        let mut against = vec![0_u32; found.len()];
        let mut first = vec![None; found.len()];
        for &(root, is_against) in &found {
            against[root as usize] += u32::from(is_against);
            first[root as usize].get_or_insert(is_against);
        }
        let turns = |&(root, is_against): &(u32, bool)| {
            let (size, against) = (self.sizes[root as usize], against[root as usize]);
            let kept = match (2 * u64::from(against)).cmp(&u64::from(size)) {
                std::cmp::Ordering::Less => false,
                std::cmp::Ordering::Greater => true,
                std::cmp::Ordering::Equal => first[root as usize].unwrap_or(false),
            };
            is_against != kept
        };
        found.iter().map(turns).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_majority_of_each_part_stays() {
        let mut winding = Winding::new(6);
        assert!(winding.relate(0, 1, true));
        assert!(winding.relate(1, 2, false));
        assert!(winding.relate(4, 5, true));
        assert!(winding.relate(0, 2, true), "follows from the others");
        assert!(!winding.relate(0, 2, false), "contradicts the others");
        assert_eq!(winding.minority(), [true, false, false, false, false, true]);
    }
}
