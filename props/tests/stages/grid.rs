//! Stage v of the implementation against the exact model
//! (`spec/3-stages.md#stage-v-trajectory-with-grid-map`, H-04, H-06): DOM-04, I-07,
//! H-14.27.

use std::collections::BTreeMap;
use std::fmt::Debug;

use crate::agreed::failed_clearly;
use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Ego, Grid, Profile};
use mufasa_model::report::{FailedStage, Outcome, Reading, Report, Rule, Stage};
use mufasa_model::services::configuration::Configuration;
use mufasa_props::differential::{agree, near_threshold, runner};
use mufasa_props::strategy::base::{self, Frame};
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::grid;
use proptest::strategy::{Strategy, ValueTree};

#[test]
fn paper() {
    agree("stage v", Profile::PAPER, grid::cycle, near_threshold).assert_aimed(&["v", "safe"]);
}

#[test]
fn hardened() {
    agree("stage v", Profile::HARDENED, grid::cycle, near_threshold).assert_aimed(&["v", "safe"]);
}

#[test]
fn the_witness_beside_stage_iv() {
    agree("witness beside iv", Profile::HARDENED, grid::beside_iv, near_threshold)
        .assert_aimed(&["v", "safe"]);
}

/// The CAV is beside its plan, and narrower by as much as H-14.27 makes it wider: where it is now it decides as before.
#[test]
fn beside_the_plan() {
    let beside = |draw: &mut Draw<'_>, profile| {
        let mut cycle = grid::cycle(draw, profile);
        let aside = draw.pick(&[0.3, -0.2, 0.1, -1e-3]);
        cycle.ego.width -= 2.0 * f64::abs(aside);
        let (x, y) = (-aside * cycle.ego.sin, aside * cycle.ego.cos);
        for point in cycle.trajectory.iter_mut().flat_map(|it| &mut it.points) {
            (point.x, point.y) = (point.x + x, point.y + y);
        }
        cycle
    };
    agree("stage v beside the plan", Profile::HARDENED, beside, near_threshold)
        .assert_aimed(&["v", "safe"]);
}

/// What is drawn beside stage iv: a disk reaches an occupied cell, and the CAV's rectangle touches
/// it or does not, within 1e-5 m; in each configuration, with stage iv and without.
#[test]
fn rectangles_touch_and_miss_cells_that_a_disk_reaches() {
    let seen = counted("stage iv ran, rectangle touches", |cycle| {
        let rectangle = only_rectangle(cycle);
        let is_near = collides(&exact(&only_disks(cycle))) && near_threshold(&rectangle);
        let ran_iv = || matches!(exact(cycle).stages[3], Outcome::Passed);
        is_near.then(|| (ran_iv(), collides(&exact(&rectangle))))
    });
    assert!(seen.len() == 12 && seen.values().all(|count| *count >= 10), "{seen:?}");
}

/// What is drawn beside stage iv: a detection covers the occupied cell, or does not, and 1e-5 m more or less
/// of it makes the difference; in each configuration.
#[test]
fn detections_cover_and_miss_cells_that_the_rectangle_touches() {
    let seen = counted("collides", |cycle| {
        let [more, less] = [2e-5, -2e-5].map(|by| collides(&exact(&grown(cycle, by))));
        (!more && less).then(|| collides(&exact(cycle)))
    });
    assert!(seen.len() == 6 && seen.values().all(|count| *count >= 5), "{seen:?}");
}

/// Of 4000 cases beside stage iv how many are of a kind, by configuration.
fn counted<K: Ord + Debug>(
    title: &str,
    kind: impl Fn(&Cycle) -> Option<K>,
) -> BTreeMap<(String, K), u64> {
    let mut seen = BTreeMap::new();
    let mut runner = runner();
    for _ in 0..4000 {
        let tape = tape().new_tree(&mut runner).expect("a tape is always drawn").current();
        let cycle = grid::beside_iv(&mut Draw::new(&tape), Profile::HARDENED);
        if let Some(kind) = kind(&cycle) {
            *seen.entry((format!("{:?}", cycle.configuration), kind)).or_insert(0) += 1;
        }
    }
    println!("(configuration, ({title})): {seen:?} of 4000");
    seen
}

/// The same with longer and wider detections.
fn grown(cycle: &Cycle, by: f64) -> Cycle {
    let mut cycle = cycle.clone();
    for item in cycle.detections.iter_mut().flat_map(|list| &mut list.items) {
        (item.length, item.width) = ((item.length + by).max(0.01), (item.width + by).max(0.01));
    }
    cycle
}

/// The same without stage iv: disks alone decide.
fn only_disks(cycle: &Cycle) -> Cycle {
    Cycle { detections: None, tracks: None, ..cycle.clone() }
}

/// The same with stage iv, which finds nothing, where the rectangle counts, too.
fn only_rectangle(cycle: &Cycle) -> Cycle {
    let Ego { x, y, cos, sin, .. } = cycle.ego;
    let far = Detection { x: x - 30.0 * cos, y: y - 30.0 * sin, cos, sin, length: 1.0, width: 1.0 };
    let detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: vec![far] });
    let configuration = Configuration::PlanRemote;
    Cycle { configuration, detections, tracks: None, ..cycle.clone() }
}

fn exact(cycle: &Cycle) -> Report {
    check(cycle, Reading::Exact).expect("the generator draws valid cycles")
}

/// Whether stage v fails at an occupied cell.
fn collides(report: &Report) -> bool {
    let [.., v] = &report.stages;
    report.failed_stage == Some(FailedStage::Stage(Stage::V))
        && matches!(v, Outcome::Failed(witness) if witness.rule == Rule::Occupied)
}

/// The CAV has one disk, whose centre is so many cells beyond the border of a grid that is occupied everywhere.
fn at_a_border(beyond: f64, side: usize) -> Cycle {
    const CELLS: i64 = 8;
    let (middle, after) = (4.5, 8.0 + beyond);
    let places = [(after, middle), (-beyond, middle), (middle, after), (middle, -beyond)];
    let (x, y) = places[side];
    let frame = Frame { x, y, cos: 1.0, sin: 0.0 };
    let configuration = Configuration::MotRemote;
    let mut cycle = base::cycle(&mut Draw::new(&[]), frame, Profile::PAPER, configuration);
    cycle.ego = Ego { speed: 0.0, length: 2.0, width: 2.0, center_offset: 0.0, ..cycle.ego };
    cycle.parameters.n = 1;
    cycle.grid = Some(Grid {
        stamp_ns: cycle.now_ns,
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        resolution: 1.0,
        width: CELLS,
        height: CELLS,
        occupied: vec![0xff; 8],
        unknown: None,
    });
    cycle
}

/// S5-03, S5-05, S5-06: no cell is marked outside of the array, whatever is near; its border belongs to it.
#[test]
fn nothing_is_marked_beyond_a_border_of_the_grid() {
    let marked = Some(Rule::Occupied);
    for side in 0..4 {
        for (beyond, rule) in [(-0.5, marked), (0.0, marked), (0.5, None)] {
            assert_eq!(failed_clearly(&at_a_border(beyond, side)), rule, "{side} {beyond}");
        }
    }
}
