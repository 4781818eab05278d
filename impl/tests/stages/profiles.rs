//! Sets of rules: what a rule turns down alone is safe without it.

use crate::scene::{NOW_NS, Scene, detection, scene, track};
use mufasa::input::cycle::{Cycle, Lead};
use mufasa::input::profile::{HardenedRule, Profile};
use mufasa::offloading::requester::{
    Action, Event, EventKind, Group, Groups, Parameters, Requester, StationRecord,
};
use mufasa::report::{FailedStage, Rule};
use mufasa::services::configuration::Configuration::{AllRemote, MotRemote};

const MS: i64 = 1_000_000;

/// Scenes that one rule alone turns down, each with that rule and the witness.
fn turned_down() -> [(HardenedRule, Option<Rule>, Scene); 9] {
    let all = || scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
    let mot = || Scene { configuration: MotRemote, ..all() };
    let surplus = vec![track(1, 3.0, 50.0), track(2, 3.0, 30.0)];
    let unchecked = Scene { detections: None, occupied: None, ..all() };
    let close = |cycle: &mut Cycle<'_>| {
        cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 0.5, speed: 0.0 });
    };
    let unknown = |cycle: &mut Cycle<'_>| {
        cycle.grid.iter_mut().for_each(|grid| grid.unknown = Some(&[255; 5000]));
    };
    let mut late = all();
    late.points.iter_mut().for_each(|point| point.t_ns += 1000 * MS);
    let mut ahead = all();
    // 5 m ahead, in the row of the CAV.
    ahead.occupied.as_mut().expect("a grid")[(100 * 200 + 105) / 8] |= 1 << (105 % 8);
    let mut slow = all();
    (0..).zip(&mut slow.points).for_each(|(i, point)| point.t_ns = NOW_NS + i * 300 * MS);
    let seen = |ms: i64| {
        let moved = 8.0e-3 * f64::from(i32::try_from(ms).expect("small"));
        vec![detection(3.0, 50.1), detection(5.0, -6.0 - moved)]
    };
    let history = [300, 500].map(|ms| (ms * MS, seen(ms))).to_vec();
    let crossing = Scene { detections: Some(seen(0)), history, ..all() };
    [
        (HardenedRule::H01, Some(Rule::NoAssignment), Scene { tracks: Some(surplus), ..mot() }),
        (HardenedRule::H02, None, unchecked.clone()),
        (HardenedRule::H04, Some(Rule::Gap), Scene { change: close, ..all() }),
        (HardenedRule::H05, None, Scene { tracks: None, ..unchecked }),
        (
            HardenedRule::H06,
            Some(Rule::Unknown),
            Scene { detections: None, change: unknown, ..mot() },
        ),
        (HardenedRule::H07, Some(Rule::StartTime), late),
        (HardenedRule::H10, Some(Rule::Occupied), ahead),
        (HardenedRule::H11, Some(Rule::StepTime), slow),
        (HardenedRule::H14, Some(Rule::FailSafe), crossing),
    ]
}

#[test]
fn what_one_rule_turns_down_is_safe_without_it_and_unsafe_without_another() {
    for (rule, witness, scene) in turned_down() {
        for left_out in HardenedRule::ALL {
            let profile = Profile::HARDENED.without(left_out);
            let found = Scene { profile, ..scene.clone() };
            let failed = found.report().failed_stage;
            // H-02 says what counts for H-05.
            let of_another = (rule, left_out) == (HardenedRule::H02, HardenedRule::H05);
            if left_out == rule || of_another {
                assert_eq!(failed, None, "{rule:?} without {left_out:?}");
            } else if let Some(witness) = witness {
                assert_eq!(found.rule(), Some(witness), "{rule:?} without {left_out:?}");
            } else {
                assert_eq!(failed, Some(FailedStage::NoObstacleCheck));
            }
        }
        let paper = Scene { profile: Profile::PAPER, ..scene };
        assert_eq!(paper.report().failed_stage, None, "{rule:?}");
    }
}

/// CONF-02: the paper profile is one without.
#[test]
fn without_h_08_local_services_stop_at_the_confirmation() {
    let one_less =
        HardenedRule::ALL.map(|it| (Profile::HARDENED.without(it), it == HardenedRule::H08));
    for (profile, stops) in one_less.into_iter().chain([(Profile::PAPER, true)]) {
        let mut table = [StationRecord::FREE; 1];
        let requester = Requester::new(profile, Parameters::default(), &mut table);
        let mut requester = requester.expect("the defaults");
        let mut actions = Vec::new();
        for kind in [
            EventKind::Offer { station: 1, groups: Groups::from(Group::Plan) },
            EventKind::Tick,
            EventKind::Confirm { station: 1, group: Group::Plan, session: 1 },
        ] {
            actions = requester.step(&Event { t_ns: 0, kind }).expect("in order").to_vec();
            assert!(requester.is_valid());
        }
        let stopped = actions.contains(&Action::Deactivate(Group::Plan));
        assert_eq!(stopped, stops, "{profile:?}");
    }
}
