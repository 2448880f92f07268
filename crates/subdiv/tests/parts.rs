//! Parts of cages: what is computed of them is what it is in the whole cage, bit for bit.

use std::collections::HashMap;

use glam::Vec3;
use osculate_cage::{BoundaryRule, Cage, CagePart, divide};
use osculate_subdiv::{PatchRecord, PlanDesc, PlanError, Scheme, SurfacePlan, WholeNames, twin};

mod common;

/// A plan with what its twins compute.
struct Computed {
    plan: SurfacePlan,
    names: WholeNames,
    part: CagePart,
    points: Vec<Vec3>,
    vertices: Vec<twin::VertexRecord>,
    edges: Vec<twin::EdgeRecord>,
    coefficients: Vec<Vec3>,
}

impl Computed {
    fn new(part: CagePart, desc: &PlanDesc) -> Result<Self, PlanError> {
        let cage = part.cage();
        let plan = SurfacePlan::build_part(&part, desc)?;
        let (centre, scale) = (cage.bounds().center(), cage.bounds().half_diagonal());
        let start: Vec<Vec3> = cage.positions().iter().map(|&p| ((p - centre) / scale).as_vec3()).collect();
        let points = twin::points(&plan, &start);
        Ok(Self {
            names: WholeNames::new(&plan, &part),
            vertices: twin::vertex_records(&plan, &points),
            edges: twin::edge_records(&plan, &points),
            coefficients: twin::coefficients(&plan, &points),
            points,
            plan,
            part,
        })
    }

    /// Face and place in it of a patch, in the whole cage.
    fn place(&self, patch: u32) -> (u32, u32) {
        let quad = self.plan.quads[patch as usize];
        let face = self.plan.locator.base_face(quad);
        let first = match self.plan.steps() {
            0 => face,
            steps => self.part.cage().face_offsets()[face as usize] << (2 * (steps - 1)),
        };
        (self.part.faces()[face as usize], quad - first)
    }

    /// Everything that a patch is made of, by bits.
    fn bits(&self, patch: u32) -> Vec<u32> {
        let PatchRecord { vertex, edge, net, basis, net_size, tag } = self.plan.patches[patch as usize];
        let record = &self.plan.patches[patch as usize];
        let mut bits = vec![net_size, tag];
        let mut add = |p: &Vec3| bits.extend(p.to_array().map(f32::to_bits));
        for k in 0..record.sides() {
            self.vertices[vertex[k] as usize].iter().for_each(&mut add);
            self.edges[(edge[k] / 2) as usize].iter().for_each(&mut add);
        }
        let is_stored = record.kind().is_stored();
        if is_stored {
            let size = if record.kind().form().name() == "stam" { net_size } else { record.sides() as u32 * 5 };
            self.coefficients[net as usize..][..size as usize].iter().for_each(&mut add);
        } else {
            let net = &self.plan.nets[net as usize..][..net_size as usize];
            net.iter().for_each(|&point| add(&self.points[point as usize]));
        }
        bits.extend(edge.map(|edge| edge & 1));
        let has_basis = record.is_extraordinary() && !is_stored;
        bits.extend(self.plan.weights.get(basis as usize).filter(|_| has_basis).map(|weight| weight.to_bits()));
        bits
    }
}

/// The plan of all faces, then those of parts of them.
fn computed(cage: &Cage, desc: &PlanDesc, rings: u8, count: usize) -> Option<(Computed, Vec<Computed>)> {
    let all: Vec<u32> = (0..cage.face_count() as u32).collect();
    let computed = |own: &[u32]| match Computed::new(CagePart::cut(cage, own, rings), desc) {
        Ok(computed) => Some(computed),
        Err(PlanError::NothingToDraw { .. }) => None,
        Err(error) => panic!("{error}"),
    };
    let whole = computed(&all)?;
    Some((whole, divide(cage, all, count).iter().filter_map(|own| computed(own)).collect()))
}

/// How many patches and records of parts are not those of the whole; panics if a patch is drawn twice or never.
fn differences(whole: &Computed, parts: &[Computed]) -> usize {
    let patches = |of: &Computed| -> Vec<u32> { of.plan.drawn().flatten().collect() };
    let expected: HashMap<(u32, u32), u32> = patches(whole).into_iter().map(|p| (whole.place(p), p)).collect();
    assert_eq!(expected.len(), whole.plan.patches.len());
    let by_name = |names: &[u64]| names.iter().enumerate().map(|(i, &name)| (name, i)).collect::<HashMap<u64, usize>>();
    let (vertices, edges) = (by_name(&whole.names.vertices), by_name(&whole.names.edges));
    assert_eq!((vertices.len(), edges.len()), (whole.vertices.len(), whole.edges.len()), "names are unique");
    let (mut drawn, mut wrong) = (0, 0);
    for part in parts {
        for patch in patches(part) {
            let of_whole = expected[&part.place(patch)];
            let (here, there) = (&part.plan.patches[patch as usize], &whole.plan.patches[of_whole as usize]);
            let is_right = |k: usize| {
                let (here, there) = ([here.vertex[k], here.edge[k] / 2], [there.vertex[k], there.edge[k] / 2]);
                let vertex = vertices.get(&part.names.vertices[here[0] as usize]);
                let edge = edges.get(&part.names.edges[here[1] as usize]);
                let boundary = [(part, here[1]), (whole, there[1])].map(|(of, e)| of.plan.boundary_edges[e as usize]);
                (vertex, edge) == (Some(&(there[0] as usize)), Some(&(there[1] as usize))) && boundary[0] == boundary[1]
            };
            let same = part.bits(patch) == whole.bits(of_whole);
            wrong += usize::from(!(same && (0..here.sides()).all(is_right)));
            drawn += 1;
        }
    }
    assert_eq!(drawn, expected.len(), "every patch is drawn by one part");
    wrong
}

/// Cages of all kinds; of the large ones a few parts, of the others many small ones.
fn cages() -> Vec<(String, Cage, usize)> {
    let mut cages = common::zoo();
    cages.retain(|(name, _)| !["star7", "star8", "star9", "star10", "star11"].contains(&name.as_str()));
    // A quad beside triangles and a pentagon, in parts some of which are quads alone.
    let fans: &[&[u32]] = &[&[0, 1, 2, 3], &[3, 2, 4, 5], &[5, 4, 6, 7], &[7, 6, 8], &[8, 6, 9, 10, 11]];
    cages.push(("quads, then others".to_owned(), common::cage(12, fans)));
    let count = |cage: &Cage| if cage.face_count() > 300 { 3 } else { cage.face_count().div_ceil(7).min(9) };
    cages
        .into_iter()
        .map(|(name, cage)| (name, count(&cage), cage))
        .map(|(name, count, cage)| (name, cage, count))
        .collect()
}

#[test]
fn parts_are_the_whole_bit_for_bit() {
    for (name, cage, count) in cages() {
        let is_open = cage.topology().edge_half_edges().iter().any(|&h| cage.topology().twin(h) == u32::MAX);
        let rules = [BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None];
        for &rule in if is_open { &rules[..] } else { &rules[..1] } {
            for &scheme in Scheme::ALL {
                let desc = PlanDesc { boundary: Some(rule), scheme, ..PlanDesc::default() };
                let Some((whole, parts)) = computed(&cage, &desc, CagePart::RINGS, count) else { continue };
                assert_eq!(differences(&whole, &parts), 0, "{name}, {scheme}, {rule:?}");
            }
        }
    }
}

/// A plan without parts has the patches of the one part that is everything.
#[test]
fn one_part_is_the_plan_of_the_cage() {
    for (name, cage, _) in cages().into_iter().take(6) {
        for &scheme in Scheme::ALL {
            let desc = PlanDesc { scheme, ..PlanDesc::default() };
            let all: Vec<u32> = (0..cage.face_count() as u32).collect();
            let part = SurfacePlan::build_part(&CagePart::cut(&cage, &all, 0), &desc).unwrap();
            let plan = SurfacePlan::build(&cage, &desc).unwrap();
            assert!(part.drawn().eq(std::iter::once(0..plan.patches.len() as u32)), "{name}");
            assert!(
                part.drawn().eq(plan.drawn()) && part.lists == plan.lists && part.patches == plan.patches,
                "{name}"
            );
            assert!(part.nets.len() == plan.nets.len() && part.weights == plan.weights, "{name}");
        }
    }
}

/// Too few rings: what neighbours own is then computed from what looks like a boundary, or by another patch. A cage that is refined first needs one, as it
/// happens; one that is not needs two.
#[test]
fn a_ring_less_is_noticed() {
    let (_, cage, count) = cages().into_iter().find(|(name, ..)| name == "twohole").unwrap();
    for &scheme in Scheme::ALL {
        let desc = PlanDesc { scheme, ..PlanDesc::default() };
        let (whole, parts) = computed(&cage, &desc, CagePart::RINGS, count).unwrap();
        assert_eq!(differences(&whole, &parts), 0, "{scheme}");
        let rings = if scheme == Scheme::Gregory1 { 1 } else { 0 };
        let (_, parts) = computed(&cage, &desc, rings, count).unwrap();
        assert!(differences(&whole, &parts) > 0, "{scheme}");
    }
}

#[test]
fn the_first_ring_is_there_and_not_drawn() {
    let (_, cage, _) = cages().into_iter().find(|(name, ..)| name == "grid").unwrap();
    let part = CagePart::cut(&cage, &[0], CagePart::RINGS);
    let plan = SurfacePlan::build_part(&part, &PlanDesc::default()).unwrap();
    let kept = (0..part.cage().face_count() as u32).filter(|&f| part.ring(f) == 1).count();
    assert_eq!((plan.drawn_count(), plan.patches.len()), (4, 4 + 4 * kept));
    let drawn: Vec<u32> = plan.drawn().flatten().collect();
    for patch in 0..plan.patches.len() as u32 {
        assert_eq!(plan.is_drawn(patch), drawn.contains(&patch));
        assert_eq!(plan.is_drawn(patch), part.is_own(plan.locator.base_face(plan.quads[patch as usize])));
        assert_eq!(plan.patch_of_quad[plan.quads[patch as usize] as usize], patch);
    }
    assert!(!plan.is_drawn(plan.patches.len() as u32));
}
