//! The laws of a cycle's report over every configuration, both profiles, and every input missing,
//! too old, harmless or harmful (`spec/3-stages.md#schedule`).

use mufasa::cycle::check;
use mufasa::input::cycle::Cycle;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch};
use mufasa::report::{FailedStage, Report, Stage};
use mufasa::services::configuration::Configuration;

use super::{Run, Topic};
use crate::harness::scene::{Given, cycle};
use crate::law::schedule::{LAWS, hardened_accepts_nothing_that_paper_rejects};

/// What is run.
pub const TOPIC: Topic = Topic {
    name: "schedule",
    domain: "one scene; each of 5 inputs missing, too old, harmless or harmful, all configurations, both \
             profiles: 8192 cycles. Not covered: what the stages compare",
    laws: || LAWS.iter().map(|&(name, _)| name).chain([OF_BOTH]).collect(),
    run,
};

/// The law of the reports of both profiles on one cycle.
const OF_BOTH: &str = "hardened_accepts_nothing_that_paper_rejects";

/// What a cycle may end in.
const ENDS: [(&str, Option<FailedStage>); 7] = [
    ("safe", None),
    ("no obstacle check", Some(FailedStage::NoObstacleCheck)),
    ("stage i fails", Some(FailedStage::Stage(Stage::I))),
    ("stage ii fails", Some(FailedStage::Stage(Stage::Ii))),
    ("stage iii fails", Some(FailedStage::Stage(Stage::Iii))),
    ("stage iv fails", Some(FailedStage::Stage(Stage::Iv))),
    ("stage v fails", Some(FailedStage::Stage(Stage::V))),
];

/// The report on a cycle of this topic.
///
/// # Panics
/// If its input is invalid, which no input of this topic is.
pub fn report(cycle: &Cycle<'_>) -> Report {
    let (mut rows, mut columns) = ([Row::default(); 4], [Column::default(); 8]);
    check(cycle, &mut Scratch::new(&mut rows, &mut columns)).expect("the input is valid")
}

/// Visits every configuration with every choice of the inputs.
pub fn every_cycle(mut visit: impl FnMut(Configuration, [Given; 5])) {
    for configuration in Configuration::ALL {
        for code in 0..4_usize.pow(5) {
            let given = [0, 1, 2, 3, 4].map(|place| Given::ALL[code / 4_usize.pow(place) % 4]);
            visit(configuration, given);
        }
    }
}

fn run() -> Run {
    let mut run = Run::default();
    every_cycle(|configuration, given| {
        let reports = [Profile::PAPER, Profile::HARDENED].map(|profile| {
            let cycle = cycle(profile, configuration, given);
            let report = report(&cycle);
            for (name, law) in LAWS {
                run.note(name, law(&cycle, &report), || std::format!("{cycle:?}: {report:?}"));
            }
            for (what, end) in ENDS {
                run.reach(what, report.failed_stage == end);
            }
            run.cases += 1;
            report
        });
        run.note(
            OF_BOTH,
            hardened_accepts_nothing_that_paper_rejects(&reports[0], &reports[1]),
            || std::format!("{configuration:?} {given:?}"),
        );
    });
    run
}
