//! Runs of every kind, each pinned by a number of all that the CAV saw, believed, planned and did. What a detector, a
//! tracker, a planner, control, an attack, the link or the traffic does otherwise is another number of some run.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::Decided;
use mufasa_sim::experiment::attacks::ATTACKS;
use mufasa_sim::experiment::availability::AVAILABILITY;
use mufasa_sim::experiment::combinations::COMBINATIONS;
use mufasa_sim::experiment::job::Job;
use mufasa_sim::experiment::left_out::LEFT_OUT;
use mufasa_sim::experiment::readings::READINGS;
use mufasa_sim::experiment::select::Options;
use mufasa_sim::experiment::stages::STAGES;
use mufasa_sim::map::Town;
use mufasa_sim::map::id::Sum;
use mufasa_sim::map::streets::town;
use mufasa_sim::run::{Cycle, Watcher, simulate};
use mufasa_sim::scenario::Scenario;
use mufasa_sim::snapshot::Snapshot;
use rayon::prelude::*;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pinned.txt");
/// How long each run is, s: attacks begin after 5.
const UNTIL: f64 = 25.0;

/// The number of a run.
struct Number(Sum);

impl Watcher for Number {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        // `attacked` says that there is an attack, not what it does.
        let cycle = Cycle { attacked: false, ..*cycle };
        let sensed = cav.sensed().expect("it is decided after it was measured");
        let text = format!(
            "{cycle:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
            truth.ego.rectangle,
            truth.objects,
            sensed.detections,
            sensed.lead.map(|it| (it.gap, it.speed)),
            cav.tracks(),
            cav.points(),
            cav.services().executions,
            (cav.counts.malformed, cav.counts.dropped, cav.counts.ended, decided.code()),
        );
        let grid = sensed.grid.borrow(true);
        let unknown = grid.unknown.unwrap_or_default();
        self.0 = self.0.with(text.as_bytes()).with(grid.occupied).with(unknown);
    }
}

fn number(town: &Town, job: &Job) -> String {
    let route = town.ego_routes().nth(job.route).expect("one of the ego's");
    let drawn = Scenario::draw(town, route, job.vehicles, job.settings.seed);
    let mut number = Number(Sum::START);
    let scenario = Scenario { time_limit: UNTIL, ..drawn };
    simulate(town, &scenario, &job.settings, &mut number).expect("settings");
    format!("{:016x}", number.0.value())
}

/// Each line of the file is the id of a run and its number; `UPDATE_PINNED=1` writes the numbers of now.
#[test]
fn every_run_is_the_one_that_it_was() {
    let town = town();
    let size = Options::town(2, 15, 0);
    let all = [ATTACKS, AVAILABILITY, COMBINATIONS, LEFT_OUT, READINGS, STAGES];
    let jobs = all.iter().flat_map(|it| it.jobs(&town, size));
    let jobs: BTreeMap<String, Job> = jobs.map(|it| (it.id.clone(), it)).collect();
    let text = std::fs::read_to_string(FILE).expect("the file");
    let ids: Vec<&str> = text.lines().filter_map(|line| line.split(' ').next()).collect();
    let numbers: Vec<String> = ids.par_iter().map(|id| number(&town, &jobs[*id])).collect();
    let mut now = String::new();
    for (id, number) in ids.iter().zip(&numbers) {
        writeln!(now, "{id} {number}").expect("a text takes everything");
    }
    if std::env::var_os("UPDATE_PINNED").is_some() {
        std::fs::write(FILE, &now).expect("it can be written");
    } else {
        assert_eq!(now, text);
    }
    // Each attack does something in some of its runs.
    let numbers: BTreeMap<&str, String> = ids.into_iter().zip(numbers).collect();
    for kind in Kind::IN_THE_LOOP {
        let differs = |(id, number): (&&str, &String)| {
            let clean = id.replace(&format!("/{}/both/", kind.name()), "/none/both/");
            clean != **id && numbers[clean.as_str()] != *number
        };
        assert!(numbers.iter().any(differs), "{}: nothing happens", kind.name());
    }
}
