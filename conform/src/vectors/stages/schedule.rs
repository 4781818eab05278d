//! `spec/3-stages.md#schedule`

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, Local, MotRemote, PlanRemote,
};

use crate::vectors::base::{NOW, TENTH, base, lead, move_point, points_of, track, tracks, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::{Expected, fails, fails_by, safe};

const fn topic(requirement: &'static str) -> Topic {
    Topic::new("stages/schedule", requirement)
}

const LOCAL: Topic = topic("spec/3-stages.md#schedule.1");
const ORDER: Topic = topic("spec/3-stages.md#schedule.2");
const STAGE_I: Topic = topic("spec/3-stages.md#schedule.3");
const TRACKS: Topic = topic("spec/3-stages.md#schedule.4");
const TABLE: Topic = topic("spec/3-stages.md#schedule.5");
const CURRENT: Topic = topic("spec/3-stages.md#schedule.6");
const REPORT: Topic = topic("spec/3-stages.md#schedule.7");
const VERDICT: Topic = topic("spec/3-stages.md#schedule.8");
const FIRST: Topic = topic("spec/3-stages.md#schedule.9");

/// Configuration, missing inputs (j trajectory, t tracks, d detections, g grid), outcomes as
/// `Expected::stages` writes them.
type Row = (Configuration, &'static str, &'static str);

const PAPER: [Row; 19] = [
    (MotRemote, "", "PP-PP"),
    (MotRemote, "t", "TP-PP"),
    (MotRemote, "d", "DP-dP"),
    (MotRemote, "g", "PP-PG"),
    (MotRemote, "j", "PJ-jJ"),
    (MotRemote, "td", "TP-dP"),
    (MotRemote, "dg", "DP-dG"),
    (AllRemote, "", "PPPoo"),
    (AllRemote, "t", "TPtPo"),
    (AllRemote, "d", "DPPoo"),
    (AllRemote, "td", "TPtdP"),
    (AllRemote, "tdg", "TPtdg"),
    (AllRemote, "j", "PJjjj"),
    (AllRemote, "jtdg", "TJjjj"),
    (PlanRemote, "", "-PPo-"),
    (PlanRemote, "t", "-PTP-"),
    (PlanRemote, "td", "-PTd-"),
    (PlanRemote, "tdg", "-PTd-"),
    (PlanRemote, "j", "-JJj-"),
];

/// The same in the hardened profile, and whether the cycle fails with `no_obstacle_check`.
const HARDENED: [(Row, bool); 17] = [
    ((MotRemote, "", "PP-PP"), false),
    ((MotRemote, "d", "DP-dP"), false),
    ((MotRemote, "dg", "DP-dG"), true),
    ((MotRemote, "g", "PP-PG"), false),
    ((AllRemote, "", "PPPPo"), false),
    ((AllRemote, "g", "PPPPo"), false),
    ((AllRemote, "d", "DPPdP"), false),
    ((AllRemote, "dg", "DPPdg"), true),
    ((AllRemote, "t", "TPtPo"), false),
    ((AllRemote, "td", "TPtdP"), false),
    ((AllRemote, "tdg", "TPtdg"), true),
    ((AllRemote, "jtdg", "TJjjj"), false),
    ((PlanRemote, "", "-PPoo"), false),
    ((PlanRemote, "t", "-PTPo"), false),
    ((PlanRemote, "td", "-PTdP"), false),
    ((PlanRemote, "tdg", "-PTdg"), true),
    ((PlanRemote, "dg", "-PPoo"), false),
];

/// Adds its vectors.
pub fn add(book: &mut Book) {
    order(book);
    table(book);
    ages(book);
    report(book);
}

/// Removes the inputs whose letters are named.
pub fn without(mut cycle: Cycle, inputs: &str) -> Cycle {
    let gone = |letter| inputs.contains(letter);
    cycle.trajectory = cycle.trajectory.filter(|_| !gone('j'));
    cycle.tracks = cycle.tracks.filter(|_| !gone('t'));
    cycle.detections = cycle.detections.filter(|_| !gone('d'));
    cycle.grid = cycle.grid.filter(|_| !gone('g'));
    cycle
}

fn order(book: &mut Book) {
    for (name, profile) in [("paper", Profile::Paper), ("hardened", Profile::Hardened)] {
        let note = "In Local no stage runs, whatever is wrong with the data.";
        let cycle = with(base(profile, Local), |cycle| {
            move_point(cycle, 0, [0.0, 50.0]);
            cycle.tracks = Some(tracks(vec![track(1, 1.0, 0.0)]));
        });
        book.cycle(LOCAL, &format!("local-{name}"), note, &cycle, &safe().stages("-----"));
        let note = "Stage i fails; stage ii would fail, too, and v, an always stage, does not run.";
        let cycle = with(base(profile, MotRemote), |cycle| {
            cycle.tracks = Some(tracks(vec![track(1, 59.0, 0.0)]));
            move_point(cycle, 3, [3.0, 9.0]);
        });
        let expected = fails("i").stages("Fa-aa");
        book.cycle(ORDER, &format!("i-first-{name}"), note, &cycle, &expected);
        let note = "Stage ii fails; stage iii would fail, too.";
        let cycle = with(base(profile, PlanRemote), |cycle| {
            cycle.tracks = Some(tracks(vec![track(1, 1.0, 0.0)]));
            move_point(cycle, 3, [3.0, 9.0]);
        });
        let stages = if profile == Profile::Paper { "-Faa-" } else { "-Faaa" };
        book.cycle(ORDER, &format!("ii-first-{name}"), note, &cycle, &fails("ii").stages(stages));
        let note = "In MotRemote stage iii is not scheduled: a received track in the way, which \
                    stage i cannot check, is looked at by nobody.";
        let cycle = with(base(profile, MotRemote), |cycle| {
            cycle.tracks = Some(tracks(vec![track(1, 5.0, 0.0)]));
            cycle.detections = None;
        });
        let name = format!("mot-remote-without-iii-{name}");
        book.cycle(TRACKS, &name, note, &cycle, &safe().stages("DP-dP"));
    }
    let note = "Stage i runs on a received list of any age, stage iii on a current one only.";
    let old = |age| {
        with(base(Profile::Paper, AllRemote), |cycle| {
            cycle.tracks.iter_mut().for_each(|list| list.stamp_ns = NOW - age);
        })
    };
    let cycle = old(59_000_000_000);
    book.cycle(STAGE_I, "old-list", note, &cycle, &safe().stages("PPtPo"));
    let note = "Stage i fails on an old list.";
    let cycle = with(old(59_000_000_000), |cycle| {
        cycle.detections =
            Some(crate::vectors::base::detections(vec![crate::vectors::base::detection(
                60.0, 1.0,
            )]));
    });
    book.cycle(STAGE_I, "old-list-fails", note, &cycle, &fails_by("i", "mean_cost"));
    let note = "Stages ii to v need a current trajectory, stage i does not.";
    let cycle = without(base(Profile::Paper, AllRemote), "j");
    book.cycle(STAGE_I, "no-trajectory", note, &cycle, &safe().stages("PJjjj"));
    let note = "In AllRemote the received tracks are used by iii.";
    let cycle = with(base(Profile::Paper, AllRemote), |cycle| {
        cycle.tracks = Some(tracks(vec![track(1, 5.0, 0.0)]));
        cycle.detections = None;
    });
    book.cycle(TRACKS, "all-remote-iii", note, &cycle, &fails("iii").stages("DPFaa"));
}

fn table(book: &mut Book) {
    let name = |profile: &str, configuration: Configuration, missing: &str| {
        let missing = if missing.is_empty() { "nothing" } else { missing };
        format!("{profile}-{configuration:?}-without-{missing}")
    };
    let note = "Every input is harmless; missing are: j trajectory, t tracks, d detections, g \
                grid, as the id says.";
    for (configuration, missing, stages) in PAPER {
        let cycle = without(base(Profile::Paper, configuration), missing);
        let name = name("paper", configuration, missing);
        book.cycle(TABLE, &name, note, &cycle, &safe().stages(stages));
    }
    for ((configuration, missing, stages), is_unchecked) in HARDENED {
        let cycle = without(base(Profile::Hardened, configuration), missing);
        let name = name("hardened", configuration, missing);
        let expected = if is_unchecked { fails("no_obstacle_check") } else { safe() };
        book.cycle(TABLE, &name, note, &cycle, &expected.stages(stages));
    }
}

fn ages(book: &mut Book) {
    type Stamp = fn(&mut Cycle) -> Option<&mut i64>;
    let inputs: [(&str, Stamp, Expected); 4] = [
        (
            "trajectory",
            |c| c.trajectory.as_mut().map(|it| &mut it.stamp_ns),
            safe().stages("PJjjj"),
        ),
        ("tracks", |c| c.tracks.as_mut().map(|it| &mut it.stamp_ns), safe().stages("PPtPo")),
        ("detections", |c| c.detections.as_mut().map(|it| &mut it.stamp_ns), {
            safe().stages("DPPoo")
        }),
        ("grid", |c| c.grid.as_mut().map(|it| &mut it.stamp_ns), safe().stages("PPPoo")),
    ];
    let note = "0 <= now - stamp <= max_age = 100 ms, both ends included; else the input is \
                missing.";
    for (input, stamp, missing) in inputs {
        for (side, age, is_current) in [
            ("of-now", 0, true),
            ("at-max-age", TENTH, true),
            ("after-max-age", TENTH + 1, false),
            ("of-the-future", -1, false),
        ] {
            if input == "grid" && !is_current {
                continue;
            }
            let cycle = with(base(Profile::Paper, AllRemote), |cycle| {
                if let Some(stamp) = stamp(cycle) {
                    *stamp = NOW - age;
                }
            });
            let expected = if is_current { safe().stages("PPPoo") } else { missing.clone() };
            book.cycle(CURRENT, &format!("{input}-{side}"), note, &cycle, &expected);
        }
    }
    for (side, age, stages) in [
        ("of-now", 0, "PP-PP"),
        ("at-max-age", TENTH, "PP-PP"),
        ("after-max-age", TENTH + 1, "PP-PG"),
        ("of-the-future", -1, "PP-PG"),
    ] {
        let cycle = with(base(Profile::Paper, MotRemote), |cycle| {
            cycle.grid.iter_mut().for_each(|grid| grid.stamp_ns = NOW - age);
        });
        book.cycle(CURRENT, &format!("map-{side}"), note, &cycle, &safe().stages(stages));
        let close = with(base(Profile::Paper, MotRemote), |cycle| {
            cycle.lead = lead(1.0, 0.0);
            cycle.lead.iter_mut().for_each(|lead| lead.stamp_ns = NOW - age);
        });
        let expected = if stages == "PP-PP" { fails_by("iv", "gap") } else { safe() };
        book.cycle(CURRENT, &format!("lead-{side}"), note, &close, &expected);
    }
}

fn report(book: &mut Book) {
    let note = "With several reasons the first counts: after_failure before no_current_grid, \
                other_stage_ran before no_current_detections, no_current_trajectory before all \
                other inputs.";
    let cycle = with(without(base(Profile::Paper, AllRemote), "tdg"), |cycle| {
        move_point(cycle, 3, [3.0, 9.0]);
    });
    book.cycle(REPORT, "after-failure-first", note, &cycle, &fails("ii").stages("TFaaa"));
    let cycle = without(base(Profile::Paper, AllRemote), "dg");
    book.cycle(REPORT, "other-stage-first", note, &cycle, &safe().stages("DPPoo"));
    let cycle = without(base(Profile::Paper, MotRemote), "jd");
    book.cycle(REPORT, "trajectory-first", note, &cycle, &safe().stages("DJ-jJ"));
    let cycle = without(base(Profile::Paper, MotRemote), "td");
    let note = "Both inputs of stage i are missing: the tracks are named.";
    book.cycle(REPORT, "tracks-first", note, &cycle, &safe().stages("TP-dP"));
    let note = "Nothing ran at all, and nothing failed: safe.";
    let cycle = without(base(Profile::Paper, AllRemote), "jtdg");
    book.cycle(VERDICT, "nothing-ran", note, &cycle, &safe().stages("TJjjj"));
    let note = "The last of the stages fails: unsafe.";
    let cycle = with(base(Profile::Paper, MotRemote), |cycle| {
        if let Some(grid) = &mut cycle.grid {
            grid.occupied = vec![0xff; 5];
        }
    });
    book.cycle(VERDICT, "v-fails", note, &cycle, &fails("v").stages("PP-PF"));
    let note = "Of several collisions the first by point and then in list order is named: the \
                front of the CAV at point 5 reaches both cars at 9 m.";
    let cycle = with(base(Profile::Paper, PlanRemote), |cycle| {
        let cars = vec![track(8, 12.0, 0.0), track(9, 9.0, 0.0), track(7, 9.0, 0.5)];
        cycle.tracks = Some(tracks(cars));
    });
    let expected = fails_by("iii", "collision").witness("iii", "point", 5);
    let expected = expected.witness("iii", "track", 9).witness("iii", "compared", vec!["4", "5"]);
    book.cycle(FIRST, "point-then-list", note, &cycle, &expected);
    let note = "Of the points that leave the corridor the first is named.";
    let cycle = with(base(Profile::Paper, PlanRemote), |cycle| {
        points_of(cycle).iter_mut().skip(6).for_each(|point| point.y = 4.0);
    });
    let expected = fails_by("ii", "theta_map").witness("ii", "point", 6);
    book.cycle(FIRST, "first-point", note, &cycle, &expected);
    let note = "Two rules of stage ii are broken; the rule that the text names first is named, \
                although the other is broken by an earlier point.";
    let cycle = with(base(Profile::Hardened, PlanRemote), |cycle| {
        points_of(cycle).iter_mut().for_each(|point| point.t_ns += TENTH + 1);
        move_point(cycle, 20, [20.0, 9.0]);
    });
    let expected = fails_by("ii", "theta_map").witness("ii", "point", 20);
    book.cycle(FIRST, "rule-then-point", note, &cycle, &expected);
}
