//! The experiments: the same with any number of threads, and what the paper's figure says of this loop.

use std::collections::BTreeSet;

use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::attacks::ATTACKS;
use mufasa_sim::experiment::availability::AVAILABILITY;
use mufasa_sim::experiment::axes::{Detectors, Factor, LeftOut};
use mufasa_sim::experiment::combinations;
use mufasa_sim::experiment::failures::FAILURES;
use mufasa_sim::experiment::falsify::genome::KINDS;
use mufasa_sim::experiment::left_out::LEFT_OUT;
use mufasa_sim::experiment::made::{Campaign, Experiment, Made};
use mufasa_sim::experiment::readings::READINGS;
use mufasa_sim::experiment::row::Row;
use mufasa_sim::experiment::select::{Options, Select};
use mufasa_sim::experiment::stages::STAGES;
use mufasa_sim::experiment::watch::{By, First, Watch};
use mufasa_sim::map::streets::town;
use mufasa_sim::run::Cycle;
use serde::Serialize;

/// Fewer scenarios than of the real ones: this is compiled without all optimisation.
const SMALL: Options = Options::town(2, 15, 0);

/// Those of its runs whose ids begin so.
fn made(experiment: &Experiment, options: Options, only: Option<&str>) -> Made {
    let (town, select) = (town(), Select::only(only));
    let campaign = Campaign { town: &town, options, select: &select, done: &|_| () };
    experiment.make(&campaign).expect("the town can be")
}

/// As JSON, made by so many threads.
fn json<T: Serialize + Send>(threads: usize, make: impl Fn() -> T + Send + Sync) -> String {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    serde_json::to_string_pretty(&pool.install(make)).expect("it is JSON")
}

fn row(of: &Made, attack: Option<Kind>, variant: Variant) -> &Row {
    let is_it = |row: &&Row| (row.attack, row.variant) == (attack, variant);
    of.rows.iter().find(is_it).expect("there is a row")
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    for (experiment, only, runs) in
        [(&FAILURES, "failures/hardened/ghost-tracks", 4), (&STAGES, "stages/paper", 2)]
    {
        let make = || made(experiment, Options::town(2, 8, 3), Some(only));
        assert_eq!(json(1, make), json(4, make));
        assert_eq!(make().runs.len(), runs, "{only}");
    }
}

#[test]
fn a_run_is_repeated_alone_by_its_id() {
    let make = |only| made(&FAILURES, Options::town(2, 8, 3), Some(only));
    let all = make("failures/sofof/empty-tracks");
    let alone = make("failures/sofof/empty-tracks/1/1");
    assert_eq!(alone.runs, [all.runs[3].clone()]);
    assert_eq!(make("failures/sofof/tracks").runs, [], "no part of a part");
}

#[test]
fn the_stages_save_what_quality_of_service_alone_loses() {
    let made = made(&FAILURES, SMALL, None);
    let runs = 4;
    for variant in Variant::ALL {
        let control = row(&made, None, variant);
        assert_eq!((control.runs, control.failures), (runs, 0), "{control:?}");
    }
    for kind in Kind::PAPER {
        for variant in [Variant::Paper, Variant::Hardened] {
            let checked = row(&made, Some(kind), variant);
            assert_eq!((checked.runs, checked.failures), (runs, 0), "{checked:?}");
        }
    }
    for kind in [Kind::WrongMap, Kind::EmptyTracks] {
        let sofof = row(&made, Some(kind), Variant::Sofof);
        assert!(2 * sofof.failures > runs, "{sofof:?}");
    }
    let rows = made.rows.iter().map(|row| row.runs).sum::<usize>();
    assert_eq!((rows, made.rows.len()), (made.runs.len(), 12));
}

fn collided(only: &str) -> (usize, usize) {
    let made = made(&READINGS, SMALL, Some(only));
    (made.rows.iter().map(|row| row.collided).sum(), made.runs.len())
}

/// The reading of `failures`, and those that contradict the paper (F-14).
#[test]
fn empty_lists_within_the_station_alone_are_found_and_those_for_both_are_not() {
    assert_eq!(collided("readings/sofof/planner+interleaved+list"), (4, 4));
    assert_eq!(collided("readings/paper/planner+interleaved+list"), (0, 4));
    assert_eq!(collided("readings/paper/both+interleaved+list"), (4, 4));
    // Were an empty list none, stage iv would run, and a list with one far track would do.
    assert_eq!(collided("readings/paper/both+interleaved+none"), (0, 4));
    assert_eq!(collided("readings/paper/both+farthest+none"), (4, 4));
    assert_eq!(collided("readings/hardened/both+farthest+list"), (0, 4));
}

/// The rows of these runs.
fn rows(only: &str) -> Vec<Row> {
    made(&LEFT_OUT, SMALL, Some(only)).rows
}

#[test]
fn without_a_grid_stage_v_never_runs_and_a_blind_detector_is_blind_for_some() {
    let with = rows("left-out/hardened/blind+nothing+none+both");
    let without = rows("left-out/hardened/blind+grid+none+both");
    assert_eq!((with.len(), without.len(), with[0].runs), (1, 1, 4));
    assert!(with[0].executions > 100, "{with:?}");
    assert_eq!((without[0].executions, without[0].detections), (0, 0), "{without:?}");
    let noisy = rows("left-out/hardened/noisy+nothing+none+both");
    assert!((noisy[0].share_plan - with[0].share_plan).abs() > 1e-9, "{noisy:?} {with:?}");
}

/// Without H-10 stage iii takes the place of v in `AllRemote`.
#[test]
fn a_rule_that_is_left_out_is_not_asked() {
    let with = rows("left-out/hardened/noisy+nothing+none+both");
    let without = rows("left-out/hardened/noisy+H-10+none+both");
    assert!(with[0].executions > 100, "{with:?}");
    assert!(without[0].executions < with[0].executions / 2, "{without:?}");
    let names: Vec<String> =
        LeftOut::all(Variant::Hardened, Detectors::Noisy).into_iter().map(String::from).collect();
    let read = |name: &String| LeftOut::try_from(name.clone()).map(String::from);
    assert!(names.iter().all(|name| read(name).as_ref() == Ok(name)), "{names:?}");
}

#[test]
fn every_stage_runs_and_the_hardened_profile_arrives() {
    let made = made(&STAGES, Options::town(2, 30, 0), None);
    let vehicles: Vec<usize> = made.runs.iter().map(|run| run.vehicles).collect();
    assert_eq!(vehicles, [15, 30, 15, 30]);
    assert!(made.rows.iter().all(|row| row.executions > 0), "{:?}", made.rows);
    for variant in [Variant::Paper, Variant::Hardened] {
        let of = made.rows.iter().filter(|row| row.variant == variant);
        assert!(of.map(|row| row.detections).sum::<u64>() > 0, "{:?}", made.rows);
    }
    let hardened = made.runs.iter().filter(|run| run.variant == Variant::Hardened);
    assert!(hardened.clone().all(|run| !run.end.is_failure()), "{:?}", made.runs);
}

#[test]
fn ids_differ_and_every_combination_is_there() {
    let town = town();
    let size = Options::town(2, 15, 0);
    let all = [&FAILURES, &STAGES, &ATTACKS, &AVAILABILITY, &READINGS, &LEFT_OUT];
    let jobs = all.iter().flat_map(|it| it.jobs(&town, size));
    let mut ids: Vec<String> = jobs.map(|it| it.id).collect();
    let (all, kinds) = (ids.len(), Kind::IN_THE_LOOP.len());
    let of_left_out = (4 * 2 * 3 + 2 * (2 * 4 + 10)) * (7 + 1) * 3 * 4;
    let others = 2 * 2 + (kinds + 1) * 3 * 3 * 4 + 23 * 2 * 4;
    assert_eq!(all, 4 * 3 * 4 + others + 9 * (3 + 1) * 4 + of_left_out);
    assert!(ids.contains(&String::from("failures/paper/empty-tracks/0/1")));
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), all);
}

#[test]
fn the_default_of_each_setting_is_among_its_values() {
    for factor in Factor::ALL {
        let (default, values) = (factor.of_default(), factor.values());
        assert!(values.iter().any(|it| (it - default).abs() < 1e-12), "{factor:?}: {default}");
    }
}

/// Ids of runs are named in findings: what they draw stays.
#[test]
fn combinations_draw_the_kinds_that_they_had() {
    let attacks = (0..40).flat_map(|seed| combinations::attacks(seed, 0));
    let drawn: BTreeSet<Kind> = attacks.map(|it| it.kind).collect();
    let left_out = [Kind::Flood, Kind::Slow, Kind::StampsAhead, Kind::Silent, Kind::HeldBack];
    let kept = Kind::IN_THE_LOOP.into_iter().filter(|kind| !left_out.contains(kind));
    assert_eq!(drawn, kept.collect());
    // Those of `combinations/hardened/plan/0/76` with `--seed 1000` (F-45).
    let first = combinations::attacks(1076, 0);
    let kinds: Vec<&str> = first.iter().take(4).map(|it| it.kind.name()).collect();
    assert_eq!(kinds, ["ends-early", "swerve", "swerve", "exchanged-pasts"]);
}

#[test]
fn the_seed_of_a_scenario_does_not_depend_on_variant_or_attack() {
    let jobs = FAILURES.jobs(&town(), SMALL);
    for (route, scenario) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let of = jobs.iter().filter(|job| (job.route, job.scenario) == (route, scenario));
        assert!(of.clone().all(|job| job.settings.seed == scenario), "{route} {scenario}");
        assert_eq!(of.count(), 12);
    }
}

#[test]
fn the_watch_counts_from_the_attack_on_while_something_is_remote() {
    let cycle = |t: f64, remote: u8, failed: u8| Cycle {
        t,
        s: 10.0 * t,
        speed: 10.0,
        nearest: None,
        remote,
        failed,
        attacked: true,
        off_road: false,
    };
    let mut watch = Watch::new(5.0, &[]);
    // Before the time: a fallback, but not the first detection.
    watch.see(&cycle(4.0, 1, 1));
    // Late data: both groups were remote and are no longer, after a safe cycle.
    watch.see(&cycle(5.0, 3, 0));
    watch.see(&cycle(5.1, 3, 0));
    watch.see(&cycle(5.2, 0, 0));
    watch.see(&cycle(6.0, 2, 0));
    watch.see(&cycle(6.1, 2, 3));
    watch.see(&cycle(6.2, 0, 0));
    watch.see(&cycle(7.0, 2, 5));
    assert_eq!((watch.fallbacks, watch.lost), (3, 2));
    let first = watch.first.expect("there is one");
    assert_eq!((first.by, first.cycles), (By::Iii, 4));
    // From 50 to 51 m and from 60 to 61 m; the way between was driven by the CAV alone.
    assert!((first.metres - 2.0).abs() < 1e-9, "{:?}", First { ..first });
}

#[test]
fn attacks_are_combined_at_random_and_again_the_same() {
    let all: Vec<_> = (0..20).map(|seed| combinations::attacks(seed, 0)).collect();
    let at_once = |attacks: &[Attack], t_ns| attacks.iter().filter(|it| it.is_on(t_ns)).count();
    let times = || (0..1200_i64).map(|tenth| tenth * 100_000_000);
    let counts: Vec<usize> =
        all.iter().flat_map(|attacks| times().map(|t_ns| at_once(attacks, t_ns))).collect();
    let share =
        |is_it: fn(&&usize) -> bool| counts.iter().filter(is_it).count() * 100 / counts.len();
    let [none, several, more] = [share(|it| **it == 0), share(|it| **it > 1), share(|it| **it > 2)];
    assert!(none > 15 && several > 25 && more > 5, "{none} {several} {more} of 100");
    for &kind in &KINDS[..combinations::DRAWN] {
        assert!(all.iter().flatten().any(|it| it.kind == kind), "{kind:?}");
    }
    assert_eq!(combinations::attacks(3, 0), all[3]);
    assert!(combinations::attacks(3, 1) != all[3] && all[2] != all[3], "others elsewhere");
}
