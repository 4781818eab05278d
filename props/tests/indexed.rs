//! An index of the route changes no answer (`spec/3-stages.md#stage-ii-trajectory-to-map`), on
//! routes of many blocks, too.

use mufasa::input::route_index::{Block, RouteIndex};
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{FailedStage, Outcome, Stage, Witness};
use mufasa::stages::{check, check_indexed};
use mufasa_model::input::cycle::{CrossSection, Cycle, Profile};
use mufasa_props::bridge::to_impl;
use mufasa_props::differential::runner;
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::map_validation;
use proptest::strategy::Strategy;

/// The witness without the segment: of two that are equally near either may be named.
fn without_segment(outcome: Outcome) -> Outcome {
    match outcome {
        Outcome::Failed(witness) => Outcome::Failed(Witness { segment: None, ..witness }),
        other @ (Outcome::Passed
        | Outcome::Skipped(_)
        | Outcome::NotApplicable(_)
        | Outcome::NotScheduled) => other,
    }
}

/// A cycle whose route goes on for up to 700 cross sections, away and back beside itself.
fn long_route(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = map_validation::cycle(draw, profile);
    let count = draw.pick(&[0_u32, 3, 40, 300, 700]);
    let Some(last) = cycle.route.cross_sections.last().cloned() else { return cycle };
    for i in 1..=count {
        let far = f64::from(i.min(count - i)) + 1.0;
        let shift = |[x, y]: [f64; 2]| [x + far, y + 0.01 * f64::from(i)];
        let [x, y] = shift([last.x, last.y]);
        let (left, right) = (shift(last.left), shift(last.right));
        cycle.route.cross_sections.push(CrossSection { x, y, left, right });
    }
    cycle
}

#[test]
fn an_index_changes_no_answer() {
    for profile in [Profile::Paper, Profile::Hardened] {
        let cycles = tape().prop_map(|tape| long_route(&mut Draw::new(&tape), profile));
        let failed = std::cell::Cell::new(0);
        let result = runner().run(&cycles, |cycle| {
            let owned = to_impl(&cycle);
            let history = owned.history();
            let cycle = owned.borrow(&history);
            let sizes = Sizes::for_cycle(&cycle);
            let mut rows = vec![Row::default(); sizes.rows];
            let mut columns = vec![Column::default(); sizes.columns];
            let mut blocks =
                vec![Block::default(); Block::needed(cycle.route.cross_sections.len())];
            let mut scratch = Scratch::new(&mut rows, &mut columns);
            let plain = check(&cycle, &mut scratch);
            if let Ok(index) = RouteIndex::new(cycle.route, &mut blocks) {
                let indexed = check_indexed(&cycle, &index, &mut scratch);
                let parts = |report: mufasa::report::Report| {
                    (report.failed_stage, report.input, report.stages.map(without_segment))
                };
                assert_eq!(plain.map(parts), indexed.map(parts));
            } else {
                assert!(plain.is_err());
            }
            let at_ii = Some(FailedStage::Stage(Stage::Ii));
            failed.set(failed.get() + u32::from(plain.is_ok_and(|it| it.failed_stage == at_ii)));
            Ok(())
        });
        assert_eq!(result, Ok(()), "{profile:?}");
        assert!(failed.get() > 10, "stage ii fails in {} cases only", failed.get());
    }
}
