//! The guard without a rule: with nothing left out it is the monitor, and each is one rule of it (`rules`: of the
//! stages, on cases of each).

use mufasa::services::configuration::Groups;
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::cav::without::Without;
use mufasa_sim::map::streets::town;
use mufasa_sim::run::{Outcome, Settings, simulate};
use mufasa_sim::scenario::Scenario;

use crate::digest::Log;

fn drive(without: Option<Without>, kind: Option<Kind>, seed: u64) -> (Outcome, Log) {
    let town = town();
    let route = town.ego_routes().next().expect("a route");
    let scenario = Scenario { time_limit: 40.0, ..Scenario::draw(&town, route, 12, seed) };
    let mut settings = Settings::new(Variant::Hardened, Groups::ALL, seed);
    settings.without = without;
    settings.requester.t_wait_ns = 1_000_000_000;
    settings.attacks = kind.into_iter().map(|kind| Attack::new(kind, 5.0, 1e3, seed)).collect();
    let mut log = Log::default();
    let outcome = simulate(&town, &scenario, &settings, &mut log).expect("settings");
    (outcome, log)
}

#[test]
fn with_nothing_left_out_it_decides_as_the_monitor() {
    let mut failed = 0;
    let kinds = [Kind::TracksEmpty, Kind::FalseVelocities, Kind::Replay, Kind::Delay];
    for kind in [None].into_iter().chain(kinds.map(Some)) {
        for seed in 0..2 {
            let (monitor, ours) =
                (drive(None, kind, seed), drive(Some(Without::Nothing), kind, seed));
            assert_eq!(monitor.0, ours.0, "{kind:?} {seed}");
            assert_eq!(monitor.1.cycles, ours.1.cycles, "{kind:?} {seed}");
            failed += ours.0.stages.iter().map(|it| it[1]).sum::<u64>();
        }
    }
    assert!(failed > 10, "there were verdicts to compare: {failed}");
}

#[test]
fn h13_is_what_is_left_out() {
    let differs = |seed| {
        let kind = Some(Kind::TracksEmpty);
        let (with, without) = (drive(None, kind, seed), drive(Some(Without::H13), kind, seed));
        with.0.stages[3][1] > without.0.stages[3][1]
    };
    assert!((0..4).any(differs), "stage iv finds less without it");
}

#[test]
fn a_rule_that_finds_nothing_is_left_out_without_a_trace() {
    let (with, without) = (drive(None, None, 1), drive(Some(Without::H05), None, 1));
    assert_eq!(with.0, without.0);
    assert_eq!(with.1.cycles, without.1.cycles);
}

/// The first safe verdict comes some cycles after the first answer of the station: until then the CAV's own
/// services run with H-08.
#[test]
fn h08_is_a_rule_of_the_requester() {
    let (with, without) = (drive(None, None, 1), drive(Some(Without::H08), None, 1));
    assert_eq!(with.0.end, without.0.end);
    assert!(with.1.cycles != without.1.cycles, "the CAV's own services stop earlier without it");
}
