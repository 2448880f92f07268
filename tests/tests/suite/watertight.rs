//! No cracks: proof by record keys over the zoo, and proof that the proof can fail.

use osculate::{
    BoundaryRule, CheckReport, Engine, EngineError, Factors, PlanError, Scheme, Spacing, Surface, SurfaceDesc,
    Tessellation, check,
};
use osculate_tests::{gpu, zoo};

fn checked(
    engine: &Engine,
    cage: &osculate::Cage,
    rule: BoundaryRule,
    tessellation: &Tessellation,
) -> Option<CheckReport> {
    let surface = match Surface::new(engine, cage, &SurfaceDesc { scheme: Scheme::Gregory2, boundary: Some(rule) }) {
        Err(EngineError::Plan(PlanError::NothingToDraw { .. })) => return None,
        other => other.unwrap(),
    };
    Some(check(&surface, tessellation).unwrap())
}

#[test]
fn the_zoo_is_watertight_at_integer_and_fractional_levels() {
    let gpu = gpu();
    let levels = [(1.0, Spacing::Equal), (5.0, Spacing::Equal), (3.3, Spacing::Odd), (4.7, Spacing::Even)];
    for specimen in zoo::all() {
        for rule in [BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None] {
            for (level, spacing) in levels {
                let tessellation = Tessellation { factors: Factors::Uniform(level), spacing };
                if let Some(report) = checked(&gpu, &specimen.cage, rule, &tessellation) {
                    assert!(
                        report.is_watertight(),
                        "{}, {rule:?}, level {level} {spacing:?}: {report:?}",
                        specimen.name
                    );
                    assert!(report.triangles > 0);
                }
            }
        }
    }
}
