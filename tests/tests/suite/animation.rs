//! Vertices that the device moves, against the rig's own positions in f64.

use glam::{DVec3, Vec3};
use osculate::{Animator, Cage, Engine, EngineError, Recording, Surface, SurfaceDesc};
use osculate_cage::{NodeTransform, Pose};
use osculate_tests::mutation::{Mutation, mutated};
use osculate_tests::rigged::{DURATION, INTERPOLATIONS, RigDesc, rigged};
use osculate_tests::{gpu, gpu_with_shaders, zoo};

/// What the GPU may differ from f64, as a share of how far vertices lie from the middle of the cage at rest: a few units in the last
/// place of a 32-bit float for the products of a matrix, the sum over joints, and the sum over targets.
const BOUND: f64 = 4e-7;

/// Before the first key, at keys, between them, at the end and after it.
const TIMES: [f32; 6] = [-1.0, 0.0, 0.1 * DURATION, 0.3 * DURATION, 0.9 * DURATION, 2.0 * DURATION];

fn surface_and_animator(engine: &Engine, cage: &Cage) -> (Surface, Animator) {
    let surface = Surface::new(engine, cage, &SurfaceDesc::default()).unwrap();
    let animator = Animator::new(&surface, cage).unwrap();
    (surface, animator)
}

/// The cage's points on the device, in cage space.
fn points(surface: &Surface) -> Vec<Vec3> {
    let points = surface.read_points().unwrap();
    points[..surface.plan().cage_points as usize].iter().map(|&p| p.into()).collect()
}

/// The largest distance between the points on the device and `expected`, as a share of the farthest of these from the middle.
fn error(surface: &Surface, expected: &[DVec3]) -> f64 {
    let expected: Vec<DVec3> = expected.iter().map(|&p| surface.space().enter_exactly(p)).collect();
    let found = points(surface);
    assert_eq!(found.len(), expected.len());
    let farthest = expected.iter().map(|p| p.length()).fold(0.0, f64::max);
    found.iter().zip(&expected).map(|(p, q)| p.as_dvec3().distance(*q)).fold(0.0, f64::max) / farthest
}

#[test]
fn skins_of_every_kind_follow_the_reference() {
    let kinds = [
        ("one joint", RigDesc { joints: 1, influences: 1, ..RigDesc::default() }),
        ("four influences", RigDesc { joints: 20, ..RigDesc::default() }),
        ("eight influences of 300 joints", RigDesc { joints: 300, influences: 8, ..RigDesc::default() }),
        ("three skins", RigDesc { skins: 3, joints: 100, influences: 8, ..RigDesc::default() }),
        ("morph targets", RigDesc { targets: 5, ..RigDesc::default() }),
        ("far away", RigDesc { skins: 2, joints: 5, targets: 2, distance: 1e5, ..RigDesc::default() }),
    ];
    let gpu = gpu();
    for (name, desc) in kinds {
        let cage = rigged(&zoo::shipped("uvsphere"), &desc);
        let (mut surface, mut animator) = surface_and_animator(&gpu, &cage);
        surface.animate(&animator).unwrap();
        let at_rest = error(&surface, cage.positions());
        assert!(at_rest < BOUND, "{name} at rest: {at_rest:e}");
        for (animation, how) in INTERPOLATIONS.iter().enumerate() {
            for time in TIMES {
                animator.set_time(animation, time.into()).unwrap();
                surface.animate(&animator).unwrap();
                let pose = animator.rig().pose(animation, time.into());
                let found = error(&surface, &animator.rig().positions(&pose));
                assert!(found < BOUND, "{name}, {how:?} at {time}: {found:e}");
            }
        }
    }
}

/// All that follows from the points is that of points which the host moved.
#[test]
fn the_surface_follows_its_points() {
    let gpu = gpu();
    let cage = rigged(&zoo::shipped("torus"), &RigDesc { joints: 9, influences: 8, targets: 3, ..RigDesc::default() });
    let (mut surface, mut animator) = surface_and_animator(&gpu, &cage);
    animator.set_time(1, 0.7).unwrap();
    surface.animate(&animator).unwrap();
    let moved = [surface.read_points(), surface.read_vertex_records(), surface.read_edge_records()].map(Result::unwrap);
    let positions: Vec<DVec3> = points(&surface).into_iter().map(|p| surface.space().leave(p)).collect();
    surface.set_points(cage.positions()).unwrap();
    assert_ne!(moved[1], surface.read_vertex_records().unwrap());
    surface.set_points(&positions).unwrap();
    assert_eq!(
        moved,
        [surface.read_points(), surface.read_vertex_records(), surface.read_edge_records()].map(Result::unwrap)
    );
}

/// A frame is the same whatever was drawn before, in one recording or in several, by whichever animator.
#[test]
fn frames_are_deterministic() {
    let gpu = gpu();
    let cage =
        rigged(&zoo::shipped("dragon"), &RigDesc { joints: 300, influences: 8, targets: 2, ..RigDesc::default() });
    let (mut surface, mut animator) = surface_and_animator(&gpu, &cage);
    let times = [0.0, 0.4, 1.3, 0.4, 0.0, 1.3];
    let frames: Vec<_> = times
        .iter()
        .map(|&time| {
            animator.set_time(2, time).unwrap();
            surface.animate(&animator).unwrap();
            surface.read_vertex_records().unwrap()
        })
        .collect();
    assert_ne!(frames[0], frames[1]);
    assert_eq!((&frames[1], &frames[0], &frames[2]), (&frames[3], &frames[4], &frames[5]));
    let (other, mut animator) = surface_and_animator(&gpu, &cage);
    animator.set_time(2, 0.4).unwrap();
    let mut recording = Recording::new();
    for _ in 0..2 {
        animator.record(&mut recording).unwrap();
        other.record_derived(&mut recording).unwrap();
    }
    gpu.device().submit(&recording).unwrap().wait().unwrap();
    assert_eq!(other.read_vertex_records().unwrap(), frames[1]);
}

#[test]
fn the_box_of_a_pose_holds_its_vertices() {
    let gpu = gpu();
    let cage = rigged(&zoo::shipped("torus"), &RigDesc { skins: 2, joints: 6, targets: 3, ..RigDesc::default() });
    let (_, animator) = surface_and_animator(&gpu, &cage);
    for animation in 0..INTERPOLATIONS.len() {
        for time in TIMES {
            let mut pose = animator.rig().pose(animation, time.into());
            pose.morph_weights.iter_mut().flatten().for_each(|weight| *weight = 1.5 - 3.0 * *weight);
            let bounds = animator.bounds(&pose).unwrap();
            let slack = 1e-9 * bounds.half_diagonal();
            for p in animator.rig().positions(&pose) {
                assert!(p.cmpge(bounds.min - slack).all() && p.cmple(bounds.max + slack).all(), "{p} in {bounds:?}");
            }
            assert!(bounds.half_diagonal() < 8.0 * cage.bounds().half_diagonal(), "{bounds:?} is of use");
        }
    }
}

#[test]
fn changed_kernels_are_noticed() {
    let mutations = [
        (
            "p = p + morph_weights[morph.morph_target] * morph.offset;",
            "p = p + 1.00001 * morph_weights[morph.morph_target] * morph.offset;",
        ),
        ("uint row = 3u * joint;", "uint row = 3u * (joint & 255u);"),
        ("i < vertex.influence_end", "i < min(vertex.influence_end, vertex.first_influence + 7u)"),
    ];
    for (from, to) in mutations {
        let gpu = gpu_with_shaders(mutated(&[Mutation { path: "animate/skin.comp", from, to }]));
        let cage = rigged(
            &zoo::shipped("uvsphere"),
            &RigDesc { joints: 300, influences: 8, targets: 2, ..RigDesc::default() },
        );
        let (mut surface, mut animator) = surface_and_animator(&gpu, &cage);
        animator.set_time(1, 0.7).unwrap();
        surface.animate(&animator).unwrap();
        let found = error(&surface, &animator.rig().positions(&animator.rig().pose(1, 0.7)));
        assert!(found > BOUND, "{to}: {found:e}");
    }
}

#[test]
fn what_cannot_be_animated_is_refused() {
    let gpu = gpu();
    let plain = zoo::shipped("torus");
    let surface = Surface::new(&gpu, &plain, &SurfaceDesc::default()).unwrap();
    assert!(matches!(Animator::new(&surface, &plain), Err(EngineError::NoRig)));
    let cube = rigged(&zoo::shipped("cube"), &RigDesc::default());
    let found = Animator::new(&surface, &cube).err();
    assert!(matches!(found, Some(EngineError::PointCount { expected: 96, found: 8 })), "{found:?}");

    let (_, mut animator) = surface_and_animator(&gpu, &rigged(&plain, &RigDesc { targets: 1, ..RigDesc::default() }));
    assert!(matches!(animator.set_time(3, 0.0), Err(EngineError::NoSuchAnimation { animation: 3, count: 3 })));
    let refused =
        |pose: &Pose, animator: &mut Animator| matches!(animator.set_pose(pose), Err(EngineError::Pose { .. }));
    let rest = animator.rig().rest();
    assert!(refused(&Pose::default(), &mut animator));
    let mut weightless = rest.clone();
    weightless.morph_weights.clear();
    assert!(refused(&weightless, &mut animator) && animator.bounds(&weightless).is_err());
    let mut endless = rest.clone();
    endless.morph_weights[0][0] = f64::NAN;
    assert!(refused(&endless, &mut animator));
    let mut huge = rest.clone();
    if let NodeTransform::Decomposed { scale, .. } = &mut huge.transforms[0] {
        *scale = DVec3::splat(1e60);
    }
    assert!(refused(&huge, &mut animator));
    animator.set_pose(&rest).unwrap();
}
