//! An index of the route changes no answer (`spec/3-stages.md#stage-ii-trajectory-to-map`), on
//! routes of many blocks, too; nor do indexes of detections
//! (SEEN-06, SEEN-16).

use std::collections::BTreeMap;

use crate::agreed::failed_clearly;
use mufasa::cycle::{check, check_indexed, check_with};
use mufasa::input::cycle::{self as twin, Cycle as ImplCycle, Route};
use mufasa::input::detection_index::{DetectionIndex, Slot};
use mufasa::input::indexes::Indexes;
use mufasa::input::route_index::{Block, RouteIndex};
use mufasa::report::{FailedStage, Outcome, Rule, Stage, Witness};
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Profile, TrackList,
};
use mufasa_model::report::Rule as ModelRule;
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge::with_impl;
use mufasa_props::differential::runner;
use mufasa_props::strategy::base::{self, Frame};
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::track_validation::{detection, track};
use mufasa_props::strategy::{map_validation, whole};
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
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let cycles = tape().prop_map(|tape| long_route(&mut Draw::new(&tape), profile));
        let failed = std::cell::Cell::new(0);
        let result = runner().run(&cycles, |cycle| {
            with_impl(&cycle, |cycle, scratch| {
                let stations = cycle.route.cross_sections.len();
                let mut blocks = vec![Block::default(); Block::needed(stations)];
                let plain = check(cycle, scratch);
                if let Ok(index) = RouteIndex::new(cycle.route, &mut blocks) {
                    let indexed = check_indexed(cycle, &index, scratch);
                    let parts = |report: mufasa::report::Report| {
                        (report.failed_stage, report.input, report.stages.map(without_segment))
                    };
                    assert_eq!(plain.map(parts), indexed.map(parts));
                    // That of another route is none.
                    let by = -50_f64.copysign(cycle.route.cross_sections[0].x);
                    let shift =
                        |it: &twin::CrossSection| twin::CrossSection { x: it.x + by, ..*it };
                    let moved: Vec<_> = cycle.route.cross_sections.iter().map(shift).collect();
                    let moved = Route { cross_sections: &moved, ..cycle.route };
                    let mut blocks = vec![Block::default(); Block::needed(stations)];
                    let index = RouteIndex::new(moved, &mut blocks).expect("nearer to the origin");
                    assert_eq!(check_indexed(cycle, &index, scratch), plain);
                } else {
                    assert!(plain.is_err());
                }
                let at_ii = Some(FailedStage::Stage(Stage::Ii));
                let fails = plain.is_ok_and(|it| it.failed_stage == at_ii);
                failed.set(failed.get() + u32::from(fails));
            });
            Ok(())
        });
        assert_eq!(result, Ok(()), "{profile:?}");
        assert!(failed.get() > 10, "stage ii fails in {} cases only", failed.get());
    }
}

/// A cycle with up to 40 more things around, now and in the history, of which some have moved.
fn crowded(draw: &mut Draw<'_>) -> Cycle {
    let mut cycle = whole::cycle(draw, Profile::HARDENED);
    // How much H-14 does until it finds what fails depends on the order of an index (`check_with`).
    cycle.parameters.work_limit = i64::MAX;
    let count = draw.pick(&[0_u32, 0, 5, 40]);
    let (spread, moved) = (draw.pick(&[60.0, 3.0, 300.0]), draw.pick(&[0.5, 0.0, 12.0]));
    let ego = cycle.ego.clone();
    let more = (0..count).map(|_| {
        let (a, b) = (draw.range(-spread, spread), draw.range(-spread, spread));
        Detection { x: ego.x + a, y: ego.y + b, cos: 1.0, sin: 0.0, length: 0.5, width: 0.5 }
    });
    let more: Vec<_> = more.collect();
    let lists = cycle.detections.iter_mut().chain(&mut cycle.detection_history);
    for (list, back) in lists.zip(0_u8..) {
        let shifted = more.iter().map(|it| Detection { x: it.x - moved * f64::from(back), ..*it });
        list.items.extend(shifted);
    }
    cycle
}

/// Runs a job with an index of each list of detections, if all of them are valid.
fn with_indexes<T>(
    cycle: &ImplCycle<'_>,
    job: impl FnOnce(&[DetectionIndex<'_>]) -> T,
) -> Option<T> {
    let lists: Vec<_> = cycle.detections.iter().chain(cycle.detection_history).collect();
    let mut memory: Vec<_> =
        lists.iter().map(|list| vec![Slot::default(); list.items.len()]).collect();
    let indexes = lists.iter().zip(&mut memory);
    let indexes: Result<Vec<_>, _> =
        indexes.map(|(list, slots)| DetectionIndex::new(list, slots)).collect();
    Some(job(&indexes.ok()?))
}

#[test]
fn indexes_of_detections_change_no_answer() {
    let cycles = tape().prop_map(|tape| crowded(&mut Draw::new(&tape)));
    let rules = std::cell::RefCell::new(BTreeMap::new());
    let result = runner().run(&cycles, |cycle| {
        with_impl(&cycle, |cycle, scratch| {
            let plain = check(cycle, scratch);
            let indexed = with_indexes(cycle, |all| {
                // All lists, and all but one.
                for detections in [all, all.get(1..).unwrap_or(&[])] {
                    let indexes = Indexes { route: None, detections };
                    assert_eq!(check_with(cycle, &indexes, scratch), plain);
                }
            });
            if indexed.is_none() {
                assert!(plain.is_err());
                return;
            }
            let rule = plain.ok().and_then(|report| {
                report.stages.iter().find_map(|outcome| match outcome {
                    Outcome::Failed(witness) => Some(witness.rule),
                    Outcome::Passed
                    | Outcome::Skipped(_)
                    | Outcome::NotApplicable(_)
                    | Outcome::NotScheduled => None,
                })
            });
            *rules.borrow_mut().entry(rule).or_insert(0_u32) += 1;
        });
        Ok(())
    });
    assert_eq!(result, Ok(()));
    let rules = rules.into_inner();
    println!("indexes of detections: {rules:?}");
    for rule in [None, Some(Rule::FailSafe), Some(Rule::NoAssignment)] {
        assert!(rules.get(&rule).is_some_and(|count| *count > 10), "{rules:?}");
    }
}

/// Two earlier lists of three items, of which the index has a row of three cells of 0.246 m: the first item in the
/// first cell, the others in the last. Two tracks have no detection now: one is beside the first item, the other in
/// its column, so far up.
fn close_together(up: f64) -> Cycle {
    let draw = &mut Draw::new(&[]);
    let frame = Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let mut cycle = base::cycle(draw, frame, Profile::HARDENED, Configuration::MotRemote);
    let stamp_ns = cycle.now_ns;
    let (corner, seen) = (Frame { x: 16.0, y: 16.0, ..frame }, (0.0, 40.0));
    let items = [(0.0, 0.0), (0.38, 0.12), (0.6, 0.0)].map(|place| detection(corner, place));
    let earlier =
        |ms: i64| DetectionList { stamp_ns: stamp_ns - ms * 1_000_000, items: items.to_vec() };
    cycle.detection_history = [300, 500].map(earlier).to_vec();
    cycle.detections = Some(DetectionList { stamp_ns, items: vec![detection(frame, seen)] });
    let missed = [(-0.2, -0.2), (0.11, up)].into_iter().zip(2..);
    let mut items = vec![track(frame, seen, 1)];
    items.extend(missed.map(|(place, id)| track(corner, place, id)));
    cycle.tracks = Some(TrackList { stamp_ns, items });
    cycle
}

/// SEEN-06, SEEN-07: the second track is in the first cell, and nearer to the second item than to the first. So each track
/// has an origin of its own, and is backed. Farther down they share one, and neither is.
#[test]
fn the_nearest_item_may_be_two_short_cells_away() {
    for (up, failure) in [(0.4, None), (0.2, Some(ModelRule::NoAssignment))] {
        let cycle = close_together(up);
        assert_eq!(failed_clearly(&cycle), failure, "{up}");
        with_impl(&cycle, |cycle, scratch| {
            let plain = check(cycle, scratch);
            let indexed = with_indexes(cycle, |detections| {
                check_with(cycle, &Indexes { route: None, detections }, scratch)
            });
            assert_eq!(indexed, Some(plain), "{up}");
        });
    }
}
