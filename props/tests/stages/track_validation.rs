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

/// S1-08: of tracks beside their detections no assignment is computed, which would be above the default limit of work; not
/// even if one more is beyond the field of view.
#[test]
fn many_tracks_beside_their_detections_need_no_assignment() {
    let frame = Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let place = |number: u32| (10.0 + 4.0 * f64::from(number % 10), 4.0 * f64::from(number / 10));
    let beside = |number| {
        let (x, y) = place(number);
        (0.999 * x, 0.999 * y)
    };
    for (profile, beyond) in [Profile::PAPER, Profile::HARDENED]
        .into_iter()
        .flat_map(|it| [None, Some((500.0, 0.0))].map(|beyond| (it, beyond)))
    {
        let mut cycle = base::cycle(&mut Draw::new(&[]), frame, profile, Configuration::MotRemote);
        (cycle.trajectory, cycle.parameters) = (None, Parameters::default());
        let stamp_ns = cycle.now_ns;
        let items = (0..80).map(|number| detection(frame, place(number))).collect();
        cycle.detections = Some(DetectionList { stamp_ns, items });
        let tracks = (0..80).map(beside).chain(beyond).zip(1..);
        let items = tracks.map(|(at, id)| track(frame, at, id)).collect();
        cycle.tracks = Some(TrackList { stamp_ns, items });
        let [exact, strict] = reports(&cycle);
        assert!(exact.failed_stage.is_none(), "{beyond:?}");
        assert_eq!(strict.witness().map(|it| it.rule), Some(Rule::WorkLimit));
        assert!(check_impl(&cycle).expect("valid").failed_stage.is_none(), "{beyond:?}");
    }
}
