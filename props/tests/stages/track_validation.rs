//! Stage i of the implementation against the exact model
//! (`spec/3-stages.md#stage-i-track-validation`, H-01): H-01.3, H-01.5 (too many columns alone), SEEN-04.

use crate::agreed::reports;
use mufasa_model::input::cycle::{Cycle, DetectionList, Profile, Track, TrackList};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::report::{FailedStage, Rule, Stage};
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge::check_impl;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::base::{self, Frame};
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::track_validation::{self, detection, track};

#[test]
fn paper() {
    agree("stage i", Profile::PAPER, track_validation::cycle, near_threshold)
        .assert_aimed(&["i", "safe"]);
}

#[test]
fn hardened() {
    agree("stage i", Profile::HARDENED, track_validation::cycle, near_threshold)
        .assert_aimed(&["i", "safe"]);
}

/// S1-08: with limits that many assignments exceed.
#[test]
fn limited() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let tally = agree("stage i, limited", profile, limited_cycle, near_threshold);
        assert!(10 * tally.undecided > tally.cases, "the limit decides: {tally}");
        tally.assert_aimed(&["i", "safe"]);
    }
}

fn limited_cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = track_validation::cycle(draw, profile);
    cycle.parameters.work_limit = draw.pick(&[0, 1, 2, 8, 27, 64, 125]);
    cycle
}

/// The last place of coordinates from 2^23 m to 2^24 m.
const LAST: f64 = 1.0 / 536_870_912.0;

/// A track that was at its detection, and has moved away by 1 m and 0.4 times the last place of its coordinates since
/// its list.
fn moved() -> Cycle {
    let frame = Frame { x: 16_776_916.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let configuration = Configuration::MotRemote;
    let mut cycle = base::cycle(&mut Draw::new(&[]), frame, Profile::HARDENED, configuration);
    cycle.trajectory = None;
    let (stamp_ns, seen) = (cycle.now_ns, (20.0, 10.0));
    let items = vec![detection(frame, seen), detection(frame, (60.0, 10.0))];
    cycle.detections = Some(DetectionList { stamp_ns, items });
    let items = vec![Track { vx: 16.0 * (1.0 + 0.4 * LAST), ..track(frame, seen, 1) }];
    cycle.tracks = Some(TrackList { stamp_ns: stamp_ns - 62_500_000, items });
    (cycle.parameters.theta_tr, cycle.parameters.theta_track_max) = (3.0, 3.0);
    cycle
}

/// IMPL-01, IMPL-02: where it is now is no double, and the nearest one is 1 m away. A limit between the two distances is
/// not kept.
#[test]
fn the_place_of_a_track_is_not_rounded_towards_its_detection() {
    let limits: [fn(&mut Parameters) -> &mut f64; 2] =
        [|it| &mut it.theta_tr, |it| &mut it.theta_track_max];
    let at_i = Some(FailedStage::Stage(Stage::I));
    for limit in limits {
        for (more, failed) in [(0.2 * LAST, at_i), (1e-5, None)] {
            let mut cycle = moved();
            *limit(&mut cycle.parameters) = 1.0 + more;
            for report in reports(&cycle) {
                assert_eq!(report.failed_stage, failed, "{more}");
            }
        }
    }
}

/// The profiles, hardened without and with detections of before.
const PROFILES: [(Profile, &[i64]); 3] = [
    (Profile::PAPER, &[]),
    (Profile::HARDENED, &[]),
    (Profile::HARDENED, &[400_000_000, 500_000_000, 600_000_000]),
];

/// Detections that were always there, and tracks, in m ahead and to the left of the CAV.
fn standing(
    (profile, ages): (Profile, &[i64]),
    seen: &[(f64, f64)],
    tracked: impl Iterator<Item = (f64, f64)>,
) -> Cycle {
    let frame = Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let mut cycle = base::cycle(&mut Draw::new(&[]), frame, profile, Configuration::MotRemote);
    (cycle.trajectory, cycle.parameters) = (None, Parameters::default());
    let stamp_ns = cycle.now_ns;
    let items: Vec<_> = seen.iter().map(|&at| detection(frame, at)).collect();
    let list = |age| DetectionList { stamp_ns: stamp_ns - age, items: items.clone() };
    cycle.detections = Some(list(0));
    cycle.detection_history = ages.iter().map(|&age| list(age)).collect();
    let items = tracked.zip(1..).map(|(at, id)| track(frame, at, id)).collect();
    cycle.tracks = Some(TrackList { stamp_ns, items });
    cycle
}

/// S1-08: for tracks at their detections, or beside them, no assignment is computed. It would be above the default limit of work. One
/// more track beyond the field of view changes nothing, nor one exactly as far as the farthest detection, nor a pair above the limit of the mean.
#[test]
fn many_tracks_beside_their_detections_need_no_assignment() {
    let seen: Vec<_> = (0..100)
        .map(|number| (10.0 + 4.0 * f64::from(number % 10), 4.0 * f64::from(number / 10)))
        .collect();
    for profile in PROFILES {
        for (share, off, beyond) in [
            (0.999, 0.0, None),
            (0.999, 0.0, Some((500.0, 0.0))),
            (1.0, 0.0, None),
            (1.0, 0.5, None),
        ] {
            let mut tracked: Vec<_> = seen.iter().map(|(x, y)| (share * x, share * y)).collect();
            tracked[0].0 -= off;
            let cycle = standing(profile, &seen, tracked.into_iter().chain(beyond));
            let [exact, strict] = reports(&cycle);
            assert!(exact.failed_stage.is_none(), "{share} {off} {beyond:?}");
            assert_eq!(strict.witness().map(|it| it.rule), Some(Rule::WorkLimit));
            assert!(
                check_impl(&cycle).expect("valid").failed_stage.is_none(),
                "{share} {off} {beyond:?}"
            );
        }
    }
}

/// S1-03, S1-06: a track as far as the farthest detection counts, one that is farther by a last place does not. In two cases the mean
/// is below the threshold only with that track, in two only without it.
#[test]
fn a_track_as_far_as_the_farthest_detection_counts() {
    let at_i = Some(FailedStage::Stage(Stage::I));
    let next = 4.0 * (1.0 + f64::EPSILON);
    // The distance of the first track to its detection, the place of the second, whether the mean is too great.
    let cases = [
        (1.4, (4.0, 3.0), None),
        (1.4, (next, 3.0), at_i),
        (1.1, (3.0, 4.0), at_i),
        (1.1, (3.0, next), None),
    ];
    for profile in PROFILES {
        for (away, second, failed) in cases {
            let tracked = [(1.0, -away), second];
            let mut cycle = standing(profile, &[(1.0, 0.0), (4.0, 3.0)], tracked.into_iter());
            (cycle.parameters.theta_tr, cycle.parameters.theta_track_max) = (1.2, 2.0);
            cycle.parameters.miss_budget = 0;
            let [exact, _] = reports(&cycle);
            assert_eq!(exact.failed_stage, failed, "{away} {second:?}");
            assert_eq!(check_impl(&cycle).expect("valid").failed_stage, exact.failed_stage);
        }
    }
}
