//! The demo drive, clean and under every attack, as the exact model judges it.

use std::str::FromStr;

use mufasa_drives::{Attack, Drive, InjectError, Injection, Options, ParseInjectionError, Sensor};
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::numbers::reading::Reading;
use mufasa_model::report::{FailedStage, Report, Rule, Stage};
use mufasa_model::services::configuration::Configuration;

use super::files::{crossed, demo, inject};

/// What failed first, and at which cycle; behind it nothing is judged.
fn first_failure(drive: &Drive) -> Option<(usize, FailedStage)> {
    drive
        .cycles
        .iter()
        .enumerate()
        .find_map(|(i, made)| report(&made.cycle).failed_stage.map(|stage| (i, stage)))
}

fn report(cycle: &Cycle) -> Report {
    mufasa_model::cycle::check(cycle, Reading::Exact).expect("local input is valid")
}

fn options(profile: Profile) -> Options {
    Options { profile, ..Options::default() }
}

#[test]
fn the_demo_is_clean_in_both_profiles() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let drive = demo(&options(profile));
        assert!(drive.cycles.len() > 150);
        assert_eq!(first_failure(&drive), None, "{profile:?}");
        // It is not clean for want of anything to see.
        let leads = drive.cycles.iter().filter(|c| c.cycle.lead.is_some()).count();
        assert_eq!(leads, drive.cycles.len());
        assert!(drive.cycles.iter().all(|c| c.cycle.tracks.as_ref().unwrap().items.len() >= 5));
    }
}

#[test]
fn every_attack_on_the_demo_is_found_where_it_should_be() {
    use FailedStage::Stage as At;
    let cases = [
        (Attack::WrongMap, Some(At(Stage::Ii)), Some(At(Stage::Ii))),
        // F-14: with tracks received, were it none, the paper's profile looks no further.
        (Attack::EmptyTracks, None, Some(At(Stage::Iv))),
        // F-13, F-15: stage iii meets a lead that shrank or runs ahead; H-14 needs no alarm while the CAV can stop.
        (Attack::FalseSizes, Some(At(Stage::Iii)), Some(At(Stage::Iii))),
        (Attack::FalseVelocities, Some(At(Stage::Iii)), Some(At(Stage::Iv))),
        (Attack::GhostTracks, Some(At(Stage::I)), Some(At(Stage::I))),
        // The route begins 8 m behind the first position, where going back leaves it.
        (Attack::Backwards, Some(At(Stage::Ii)), Some(At(Stage::Ii))),
        // F-16.
        (Attack::Frozen, None, Some(At(Stage::Ii))),
        // F-66: in H-14 times decide nothing (F-22).
        (Attack::TooFast, None, Some(At(Stage::Ii))),
        // Late data are not used, which is safe; but places of 0.3 s ago tell nothing of now.
        (Attack::Late, None, Some(At(Stage::I))),
        // F-31, F-30, F-34: the lead is left out, or said to be where it is not.
        (Attack::MissingTrack, None, Some(At(Stage::Iv))),
        (Attack::ExchangedPasts, Some(At(Stage::Iii)), Some(At(Stage::Iv))),
        (Attack::TakenPast, Some(At(Stage::Iii)), Some(At(Stage::Iv))),
        (Attack::VelocityBias, Some(At(Stage::Iii)), Some(At(Stage::Iii))),
        (Attack::BlindDetectors, None, Some(At(Stage::V))),
        (Attack::PastGhost, Some(At(Stage::I)), Some(At(Stage::I))),
        // F-35.
        (Attack::Slide, None, Some(At(Stage::Ii))),
    ];
    // Nothing crosses; see `crossing.rs`.
    assert_eq!(cases.len() + 1, Attack::ON_DRIVES.len());
    let [paper, hardened] = [Profile::PAPER, Profile::HARDENED].map(|p| demo(&options(p)));
    for (attack, in_paper, in_hardened) in cases {
        let injection = Injection { attack, from_s: 2.0, to_s: f64::INFINITY };
        for (clean, expected) in [(&paper, in_paper), (&hardened, in_hardened)] {
            let attacked = inject(clean, &injection).unwrap();
            let found = first_failure(&attacked);
            assert_eq!(
                found.map(|f| f.1),
                expected,
                "{attack:?} {:?}",
                clean.cycles[0].cycle.profile
            );
            assert!(found.is_none_or(|f| f.0 >= 20), "{attack:?} found before it began: {found:?}");
            assert_eq!(attacked.cycles[..20], clean.cycles[..20]);
        }
    }
}

/// F-13 as an accident: in the paper's profile nothing is found before the bumpers touch.
#[test]
fn false_velocities_are_found_at_the_impact_or_in_time() {
    let injection = "false-velocities@2..".parse::<Injection>().unwrap();
    let attacked = inject(&demo(&options(Profile::PAPER)), &injection).unwrap();
    let (found, _) = first_failure(&attacked).unwrap();
    let lead = attacked.cycles[found].cycle.lead.as_ref().unwrap();
    assert!(lead.gap <= 0.0, "{lead:?}");
    let attacked = inject(&demo(&options(Profile::HARDENED)), &injection).unwrap();
    let (found, _) = first_failure(&attacked).unwrap();
    let lead = attacked.cycles[found].cycle.lead.as_ref().unwrap();
    let speed = attacked.cycles[found].cycle.ego.speed;
    assert!(lead.gap > speed * speed / 16.0, "it can still stop: {lead:?}");
}

/// Where the CAV drives what it is sent, its own sensor of the lead keeps its range.
#[test]
fn the_range_of_the_lead_holds_under_attack() {
    let sensor = Sensor { lead_range_m: 15.0, ..Sensor::default() };
    let drive = demo(&Options { sensor, ..options(Profile::PAPER) });
    let injection = "empty-tracks@2..".parse::<Injection>().unwrap();
    let attacked = inject(&drive, &injection).unwrap();
    let gaps =
        |d: &Drive| d.cycles.iter().filter_map(|c| Some(c.cycle.lead.as_ref()?.gap)).collect();
    let (clean, attacked): (Vec<f64>, Vec<f64>) = (gaps(&drive), gaps(&attacked));
    assert!(clean.len() < drive.cycles.len(), "the lead is farther now and then");
    assert!(!attacked.is_empty() && attacked.iter().chain(&clean).all(|gap| *gap <= 15.0));
    let none = Sensor { lead_range_m: 0.0, ..Sensor::default() };
    let drive = inject(&demo(&Options { sensor: none, ..options(Profile::PAPER) }), &injection);
    assert!(drive.unwrap().cycles.iter().all(|c| c.cycle.lead.is_none()));
}

/// F-14 as an accident: the CAV drives what is planned from empty lists. The hardened monitor
/// stops it while the lead is still ahead; in the paper's profile it drives into it.
#[test]
fn empty_tracks_end_in_a_collision_unless_they_are_found() {
    let injection = "empty-tracks@2..".parse::<Injection>().unwrap();
    let attacked = inject(&demo(&options(Profile::HARDENED)), &injection).unwrap();
    let gap = |i: usize| attacked.cycles[i].cycle.lead.as_ref().map(|l| l.gap);
    let (found, _) = first_failure(&attacked).unwrap();
    let rule = report(&attacked.cycles[found].cycle).witness().map(|it| it.rule);
    assert_eq!(rule, Some(Rule::Gap));
    let speed = attacked.cycles[found].cycle.ego.speed;
    assert!(gap(found).unwrap() > speed * speed / 16.0, "it can still stop");
    let crash = (found..attacked.cycles.len()).find(|i| gap(*i) == Some(0.0));
    assert!(crash.is_some(), "without the monitor it would hit the lead");
    assert_eq!(first_failure(&inject(&demo(&options(Profile::PAPER)), &injection).unwrap()), None);
}

#[test]
fn an_injection_changes_what_is_received_in_its_time_and_nothing_else() {
    let clean = crossed(demo(&Options::default()));
    for attack in Attack::ON_DRIVES {
        let attacked = inject(&clean, &Injection { attack, from_s: 3.0, to_s: 4.0 }).unwrap();
        for (i, (a, c)) in attacked.cycles.iter().zip(&clean.cycles).enumerate() {
            // A frozen trajectory is the true one the first time.
            let changed = (30..=40).contains(&i) && !(attack == Attack::Frozen && i == 30);
            assert_eq!(a != c, changed, "{attack:?} at {i}");
            let (a, c) = (&a.cycle, &c.cycle);
            assert_eq!((&a.route, &a.grid), (&c.route, &c.grid));
            // The one attack that needs a defect of the CAV.
            let seen = attack == Attack::BlindDetectors && changed;
            assert_eq!(a.detections != c.detections, seen, "{attack:?} at {i}");
            assert!(seen || a.detection_history == c.detection_history, "{attack:?} at {i}");
        }
        let ends = attacked.cycles.len();
        assert!(ends == clean.cycles.len() || ends == 41, "{attack:?} ends at {ends}");
    }
}

#[test]
fn injections_are_written_as_they_are_read() {
    for text in ["wrong-map@2..3.5", "ghost-tracks@0..", "late@1..1.5"] {
        assert_eq!(Injection::from_str(text).unwrap().to_string(), text);
    }
    assert_eq!(Injection::from_str("frozen").unwrap().to_string(), "frozen@0..");
    for attack in Attack::ON_DRIVES {
        assert_eq!(attack.name().parse(), Ok(attack));
    }
    for text in ["", "wrongmap", "late@1", "late@-1..2", "late@a..b", "late@nan..", "late@2..x"] {
        assert!(Injection::from_str(text).is_err(), "{text}");
    }
    for text in ["wrong-map@3..2", "wrong-map@2..2", "late@..0", "late@inf.."] {
        let error = Injection::from_str(text).unwrap_err();
        assert!(matches!(error, ParseInjectionError::EmptySpan { .. }), "{text}: {error}");
    }
}

#[test]
fn an_injection_that_changes_nothing_is_an_error_of_the_drive() {
    let drive = demo(&Options::default());
    let refused = |drive: &Drive, text: &str| inject(drive, &text.parse().unwrap()).unwrap_err();
    let late = refused(&drive, "ghost-tracks@90..100");
    assert!(matches!(late, InjectError::Outside { .. }), "{late}");
    // The first of the frozen trajectories is the true one.
    let same = refused(&drive, "frozen@2..2.05");
    assert!(matches!(same, InjectError::Unchanged { .. }), "{same}");
    let mut bare = drive.clone();
    for cycle in &mut bare.cycles {
        cycle.cycle.tracks = None;
    }
    for attack in ["empty-tracks", "ghost-tracks", "false-sizes", "missing-track", "past-ghost"] {
        let absent = refused(&bare, attack);
        assert!(matches!(absent, InjectError::Unchanged { .. }), "{absent}");
    }
    let error = late.of(&drive.clone().into());
    assert_eq!((error.file.to_str(), &error.message), (Some(&*drive.source), &late.to_string()));
}

/// Only what is received is changed, or what is made from it: the trajectory of a local planner
/// that believes the received tracks.
#[test]
fn attacks_change_remote_data_only() {
    use Attack::{Backwards, Frozen, GhostTracks, Late, PastGhost, Slide, TooFast, WrongMap};
    for configuration in [
        Configuration::Local,
        Configuration::MotRemote,
        Configuration::PlanRemote,
        Configuration::AllRemote,
    ] {
        let clean = crossed(demo(&Options { configuration, ..Options::default() }));
        let remote = configuration.remote();
        for attack in Attack::ON_DRIVES {
            let [on_tracks, on_trajectory] = match attack {
                WrongMap | Backwards | Frozen | TooFast | Slide => [false, remote.plan],
                GhostTracks | PastGhost => [remote.mot, false],
                Late => [remote.mot, remote.plan],
                // Those that the CAV is shown driving after.
                _ => [remote.mot; 2],
            };
            let injection = Injection { attack, from_s: 3.0, to_s: 4.0 };
            let attacked = match inject(&clean, &injection) {
                Ok(attacked) => attacked,
                Err(error) => {
                    let local = InjectError::Local { injection, configuration };
                    assert_eq!((error, on_tracks || on_trajectory), (local, false));
                    continue;
                }
            };
            let [a, c] = [&attacked, &clean].map(|drive| &drive.cycles[35].cycle);
            assert_eq!(a.tracks != c.tracks, on_tracks, "{attack:?} {configuration:?}");
            assert_eq!(a.trajectory != c.trajectory, on_trajectory, "{attack:?} {configuration:?}");
        }
    }
}

/// The way that is driven under attack is the recorded one, whatever the reference path does: it is
/// not the injector that leaves the lane.
#[test]
fn under_attack_the_cav_stays_where_it_drove() {
    let mut clean = demo(&options(Profile::PAPER));
    for cycle in &mut clean.cycles {
        // Of few cross sections: the reference path cuts the curve.
        let sections = &mut cycle.cycle.route.cross_sections;
        let last = sections.len() - 1;
        let mut index = 0..=last;
        sections.retain(|_| index.next().is_some_and(|i| i % 12 == 0 || i == last));
    }
    let way: Vec<(f64, f64)> =
        clean.cycles.iter().map(|it| (it.cycle.ego.x, it.cycle.ego.y)).collect();
    for attack in ["empty-tracks@2..8", "false-sizes@2..8", "missing-track@2..8"] {
        let attacked = inject(&clean, &attack.parse().unwrap()).unwrap();
        assert!(attacked.cycles.len() > 70, "{attack}: {:?}", attacked.notes);
        for it in &attacked.cycles[20..] {
            let ego = &it.cycle.ego;
            let aside = way.iter().map(|(x, y)| (ego.x - x).hypot(ego.y - y));
            let aside = aside.fold(f64::INFINITY, f64::min);
            assert!(aside < 0.7, "{attack}: {aside} m off in {}", it.id);
        }
    }
}
