//! The search for collisions: that it finds what is there, by what it looks for, and the same each time.

use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

use mufasa_sim::attack::means::{Lists, Means};
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::axes::Offered;
use mufasa_sim::experiment::falsify::cma::{Cma, anywhere};
use mufasa_sim::experiment::falsify::danger::{Danger, FREE_S};
use mufasa_sim::experiment::falsify::found::{Case, Found};
use mufasa_sim::experiment::falsify::genome::{Clean, GENES, KINDS, decode};
use mufasa_sim::experiment::falsify::shrink::shrunk;
use mufasa_sim::experiment::falsify::{Caller, Falsified, Options, Progress, experiment};
use mufasa_sim::map::id::MapId;
use mufasa_sim::map::streets::town;
use mufasa_sim::run::End;
use mufasa_sim::vehicle::TAU_S;

/// Looks for much time left instead of little.
struct Backwards;

impl Caller for Backwards {
    fn worth(&self, time_left_s: f64) -> f64 {
        -time_left_s
    }
}

/// Interrupts after so many runs.
struct Interrupts(AtomicU64);

impl Caller for Interrupts {
    fn tell(&self, progress: Progress) {
        if progress == Progress::Run {
            let _ = self.0.try_update(Relaxed, Relaxed, |left| left.checked_sub(1));
        }
    }

    fn is_interrupted(&self) -> bool {
        self.0.load(Relaxed) == 0
    }
}

/// Empty lists in the paper's profile (F-14): the random points of one round, and one generation.
fn known_hole() -> Options {
    let kinds = vec![Kind::EmptyTracks];
    let (runs, rounds) = (Some(96), None);
    Options {
        variant: Variant::Paper,
        kinds,
        runs,
        rounds,
        vehicles: 15,
        seed: 1,
        map: MapId::Town,
    }
}

fn found(made: &Falsified) -> [u64; 2] {
    [made.collided_at_random, made.collided - made.collided_at_random]
}

#[test]
fn a_known_hole_is_found_and_not_by_a_search_for_the_opposite() {
    let town = town();
    let in_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| experiment(&town, known_hole(), &()).expect("the town can be"))
    };
    let made = in_threads(4);
    let [random, guided] = found(&made);
    assert!(guided >= 3, "{random} {guided}");
    assert_eq!((made.runs, made.clean_collided), (96, 0));
    let Some(Found { case, t_s, with, .. }) = made.found.first() else { panic!("none is kept") };
    assert_eq!(case.attacks.len(), 1, "one is enough: {case:?}");
    // What is kept is made again, and does not happen without the attack.
    let again = case.collision(&town).expect("it can be").expect("a collision");
    assert_eq!((again.t_s, again.with), (*t_s, *with));
    let clean = Case { attacks: Vec::new(), ..case.clone() };
    assert_eq!(clean.collision(&town).expect("it can be"), None);

    let other = experiment(&town, known_hole(), &Backwards).expect("the town can be");
    assert_eq!(found(&other), [random, 0]);

    // The same bytes with another number of threads.
    let json = |it: &Falsified| serde_json::to_string(it).expect("it is JSON");
    assert_eq!(json(&in_threads(1)), json(&made));
}

/// Neither in the random points nor among the generations is another run begun, or anything shrunk.
#[test]
fn an_interrupt_ends_the_search_and_leaves_what_was_found() {
    let town = town();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(4).build().expect("threads");
    for runs in [50, 70] {
        let caller = Interrupts(AtomicU64::new(runs));
        let made = pool.install(|| experiment(&town, known_hole(), &caller)).expect("it can be");
        assert!(made.interrupted && (runs..runs + 4).contains(&made.runs), "{runs} {}", made.runs);
        assert!(made.collided > 0 && !made.found.is_empty(), "{runs}");
        assert_eq!((made.shrinking_runs, made.rounds), (0, 1), "{runs}");
        assert_eq!(u64::try_from(made.tries.len()).expect("few"), made.runs);
        for found in &made.found {
            assert_eq!(found.case.collision(&town).expect("it can be").as_ref(), Some(found));
        }
    }
}

fn case(variant: Variant, offered: Offered, attacks: Vec<Attack>) -> Case {
    Case {
        variant,
        tau_s: TAU_S,
        drives_on: false,
        offered,
        route: 0,
        scenario: 0,
        vehicles: 15,
        attacks,
        map: MapId::Town,
    }
}

#[test]
fn what_is_found_is_shrunk_to_what_matters() {
    let town = town();
    let attack = |kind, means| Attack { kind, from: 3.0, until: 100.0, seed: 0, means };
    let moved = Means { speed_mps: 0.001, ..Means::of(Kind::Drift) };
    let attacks =
        vec![attack(Kind::Drift, moved), attack(Kind::MissingTrack, Means::of(Kind::MissingTrack))];
    let case = case(Variant::Sofof, Offered::Both, attacks);
    let found = case.collision(&town).expect("it can be").expect("a collision");
    let (small, runs) = shrunk(&town, &found, &()).expect("it can be");
    assert!(runs > 3);
    let [attack] = &small.case.attacks[..] else { panic!("{small:?}") };
    assert_eq!(attack.kind, Kind::MissingTrack);
    assert!(attack.until - attack.from < 30.0, "{attack:?}");
    let text = serde_json::to_string(&small).expect("it is JSON");
    assert_eq!(serde_json::from_str::<Found>(&text).expect("it is one"), small);
}

#[test]
fn every_point_is_an_attack_and_every_kind_has_a_point() {
    let clean = Clean {
        remote: (0..400).map(|it| 0.1 * f64::from(it)).collect(),
        near: vec![4, 7],
        seed: 3,
    };
    let mut seen = std::collections::BTreeSet::new();
    let mut targets = std::collections::BTreeSet::new();
    for index in 0..400 {
        // Beyond the cube, too.
        let genes = anywhere([0, index]).map(|gene| 3.0 * gene - 1.0);
        let (offered, attacks) = decode(&genes, &KINDS, &clean);
        assert!((1..=2).contains(&attacks.len()));
        for Attack { kind, from, until, means, .. } in attacks {
            assert!((0.0..40.0).contains(&from) && (0.29..60.1).contains(&(until - from)));
            assert!(means.late_s >= 0.0 && means.factor.abs() <= 1.5);
            targets.insert(means.target);
            seen.insert((offered, kind, means.lists));
        }
    }
    assert_eq!(targets.into_iter().collect::<Vec<_>>(), [None, Some(4), Some(7)]);
    for kind in KINDS {
        assert!(seen.iter().any(|it| it.1 == kind), "{}", kind.name());
    }
    assert!(Offered::ALL.iter().all(|offered| seen.iter().any(|it| it.0 == *offered)));
    for lists in [Lists::Both, Lists::Cav, Lists::Planner] {
        assert!(seen.iter().any(|it| it.2 == lists), "{lists:?}");
    }
    // A point of the cube and its mirror images are one.
    let genes = anywhere([0, 1]);
    let mirrored = genes.map(|gene| 2.0 - gene);
    assert_eq!(decode(&genes, &KINDS, &clean).0, decode(&mirrored, &KINDS, &clean).0);
}

#[test]
fn cma_goes_to_the_least() {
    // An ellipsoid, a hundred times as steep in one gene as in another.
    let least = |genes: &[f64; GENES]| -> f64 {
        let steep = |index: usize| if index.is_multiple_of(2) { 100.0 } else { 1.0 };
        genes.iter().enumerate().map(|(i, gene)| steep(i) * (gene - 0.3) * (gene - 0.3)).sum()
    };
    let mut cma = Cma::new([0.8; GENES], 12, [5, 6]);
    let start = least(&cma.mean());
    for _ in 0..400 {
        let mut points = cma.ask(12);
        points.sort_by(|a, b| least(a).total_cmp(&least(b)));
        cma.tell(&points);
    }
    let end = least(&cma.mean());
    assert!(start > 100.0 && end < 1e-4, "{start} {end}");
}

#[test]
fn a_run_that_collides_had_little_time_left_and_a_clean_one_much() {
    let town = town();
    let mut case = case(Variant::Sofof, Offered::Both, Vec::new());
    let time_left = |case: &Case| {
        let mut danger = Danger::default();
        let outcome = case.run(&town, &mut danger).expect("it can be");
        (outcome.end, danger.least_time_left(&town.routes[case.ego_route(&town)], 0.0))
    };
    let (end, clean) = time_left(&case);
    assert_eq!(end, End::Arrived);
    assert!((1.0..=FREE_S).contains(&clean), "{clean}");
    case.attacks.push(Attack::new(Kind::EmptyTracks, 5.0, 1e3, 0));
    let (end, attacked) = time_left(&case);
    assert_eq!(end, End::Collided);
    assert!(attacked < 0.3, "{attacked}");
}

/// A group that is remote and has nothing current is of no use: the last use is before that.
#[test]
fn a_cycle_in_which_nothing_is_current_is_no_use() {
    let town = town();
    let attacks = vec![Attack::new(Kind::StampsAhead, 5.0, 1e3, 0)];
    let case = case(Variant::Hardened, Offered::Plan, attacks);
    let mut danger = Danger::default();
    case.run(&town, &mut danger).expect("it can be");
    let last = danger.last_use().expect("one before the attack").t_s;
    let idle = danger.remote_times().into_iter().filter(|t| *t > last).count();
    assert!((4.9..5.2).contains(&last) && idle > 3, "{last} {idle}");
}

/// The collisions that are kept with the project. When something about a run changes, `UPDATE_FOUND=1` writes
/// when they occur now; one that no longer does fails all the same.
#[test]
fn what_was_found_still_collides_and_only_under_attack() {
    let town = town();
    let mut count = 0;
    for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/found")).expect("a folder")
    {
        let file = entry.expect("an entry").path();
        let text = std::fs::read_to_string(&file).expect("it can be read");
        let found: Found = serde_json::from_str(&text).expect("it is a collision");
        let again = found.case.collision(&town).expect("it can be");
        if let (true, Some(again)) = (std::env::var_os("UPDATE_FOUND").is_some(), &again) {
            let text = serde_json::to_string_pretty(again).expect("it is JSON") + "\n";
            std::fs::write(&file, text).expect("it can be written");
            continue;
        }
        assert_eq!(again.as_ref(), Some(&found), "{}", file.display());
        let is_after = file.file_stem().is_some_and(|it| it.to_string_lossy().ends_with("-after"));
        assert_eq!(found.is_after(), is_after, "{}", file.display());
        let clean = Case { attacks: Vec::new(), ..found.case.clone() };
        assert_eq!(clean.collision(&town).expect("it can be"), None, "{}", file.display());
        // Nor with the time that the CAV takes, or with control that brakes when it has to.
        let whole = Case { tau_s: TAU_S, drives_on: false, ..found.case.clone() };
        if whole != found.case {
            assert_eq!(whole.collision(&town).expect("it can be"), None, "{}", file.display());
        }
        count += 1;
    }
    assert!(count > 0 || std::env::var_os("UPDATE_FOUND").is_some());
}
