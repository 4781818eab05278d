//! F-30 and F-31 on a drive: a car crosses in front of the CAV, and the remote says that it stands,
//! leaves it out, or tells of it as it is.

use std::f64::consts::FRAC_PI_2;

use mufasa_drives::{Attack, Drive, Injection, Options, Tail};
use mufasa_model::input::cycle::Profile;
use mufasa_model::report::Rule;

use super::files::{Scratch, inject, judged, one, own, vehicle};

/// The small scenario with car 50, which comes from the left at 10 m/s and is in the CAV's lane,
/// 30 m ahead of its first place, after 2 s.
fn drive(profile: Profile) -> Drive {
    let scenario = std::fs::read_to_string(own("readers/small-2020a.xml")).unwrap();
    let (front, _) = scenario.split_once("</commonRoad>").unwrap();
    let places = (0..=20).map(|step| [30.0, 18.25 - f64::from(step), -FRAC_PI_2]);
    let car = vehicle(50, "car", 10.0, places);
    let folder = Scratch::new();
    let scenario = folder.write("crossing.xml", format!("{front}{car}</commonRoad>"));
    let solution = own("readers/small.KS2.solution.xml");
    let options = Options { profile, tail: Tail::Keep, ..Options::default() };
    one(&[scenario, solution], &options).unwrap()
}

/// The first cycle that fails under the attack, and the rule. The CAV goes on as it was recorded,
/// and the bumpers touch after 1.7 s.
fn found(profile: Profile, attack: Attack) -> Option<(usize, Rule)> {
    let injection = Injection { attack, from_s: 0.6, to_s: f64::INFINITY };
    let attacked = inject(&drive(profile), &injection).unwrap();
    let (checked, all) = judged(attacked);
    assert_eq!(checked.disagreements(), 0);
    all.iter().enumerate().skip(6).find_map(|(i, judged)| {
        let report = judged.model.as_ref().expect("local input is valid");
        report.witness().map(|witness| (i, witness.rule))
    })
}

#[test]
fn a_crossing_car_that_is_said_to_stand_or_left_out_is_seen_to_move() {
    for attack in [Attack::CrossingStands, Attack::MissingTrack] {
        let failed = found(Profile::HARDENED, attack);
        let (cycle, rule) = failed.unwrap_or_else(|| panic!("{attack:?} is not found"));
        // 10 m/s stop in 7.7 m: the car is found at least 0.7 s before the collision.
        assert_eq!((rule, cycle <= 10), (Rule::FailSafe, true), "{attack:?} at {cycle}");
    }
}

#[test]
fn in_the_papers_profile_it_is_driven_into() {
    let failed = found(Profile::PAPER, Attack::MissingTrack);
    assert_eq!(failed, None);
    // What stands is met when it is on the path: half a second before the collision at most.
    let failed = found(Profile::PAPER, Attack::CrossingStands);
    assert!(failed.is_none_or(|(cycle, _)| cycle >= 15), "{failed:?}");
}
