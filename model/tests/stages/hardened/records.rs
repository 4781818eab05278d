//! F-30 and F-31: a car at (15, -10) m crosses at 7.5 m/s before a CAV that drives along y = 0 at 10 m/s.
//! The remote side leaves it out, or says that it stands. The CAV's own history shows the crossing.

use mufasa_model::input::cycle::{Cycle, Detection, Profile, Track, TrackList};
use mufasa_model::report::{FailedStage, Outcome, Rule, Stage};
use mufasa_model::services::configuration::Configuration::{self, AllRemote, MotRemote};

use crate::base::*;

/// A true car that stands aside, tracked and seen all along; the first is 60 m ahead.
fn other(i: i32) -> [f64; 2] {
    if i == 0 { [60.0, 0.0] } else { [10.0 * f64::from(i) - 60.0, 20.0] }
}

/// The CAV of `spec/5-interfaces.md` and the crossing car, `nearer` m nearer along x and y; of the
/// remote list only the `others` are true.
fn crossing(configuration: Configuration, nearer: [f64; 2], others: i32) -> Cycle {
    let mut cycle = base(Profile::Hardened, configuration);
    (cycle.ego.length, cycle.ego.width, cycle.ego.center_offset) = (4.8, 1.9, 1.4);
    let [x, y] = [15.0 - nearer[0], -10.0 + nearer[1]];
    let standing: Vec<[f64; 2]> = (0..others).map(other).collect();
    let turned = |d: Detection| Detection { cos: 0.0, sin: 1.0, ..d };
    let mut seen = vec![turned(detection(x, y))];
    seen.extend(standing.iter().map(|[x, y]| detection(*x, *y)));
    cycle.detections = detections(seen);
    cycle.tracks = tracks((1..).zip(&standing).map(|(id, [x, y])| track(id, *x, *y)).collect());
    let mut objects = vec![[x, y, 0.0, 7.5]];
    objects.extend(standing.iter().map(|[x, y]| [*x, *y, 0.0, 0.0]));
    cycle.detection_history = history(&objects);
    cycle
        .detection_history
        .iter_mut()
        .for_each(|list| (list.items[0].cos, list.items[0].sin) = (0.0, 1.0));
    cycle
}

/// The remote side says that the car stands where it was `millis` ms ago, in a list of that age.
fn said_to_stand(cycle: &mut Cycle, id: i64, millis: i32) {
    let Detection { x, y, .. } = cycle.detections.as_ref().expect("set").items[0];
    let back = 7.5 * f64::from(millis) / 1000.0;
    let standing = Track { cos: 0.0, sin: 1.0, ..track(id, x, y - back) };
    let TrackList { stamp_ns, items } = cycle.tracks.as_mut().expect("set");
    *stamp_ns -= i64::from(millis) * 1_000_000;
    items.push(standing);
}

type Change = fn(&mut Cycle);

/// The four records: what the remote list says of the crossing car.
const RECORDS: [(&str, i32, Change); 4] = [
    ("left out", 1, |_| ()),
    ("said to stand, under a new id", 1, |c| said_to_stand(c, 99, 0)),
    ("said to stand 7.5 cm off, in a list 10 ms old", 1, |c| said_to_stand(c, 99, 10)),
    ("said to stand 0.56 m off in a list 75 ms old, twelve true tracks beside it", 13, |c| {
        said_to_stand(c, 99, 75);
    }),
];

#[test]
fn a_crossing_car_that_the_remote_side_hides_is_seen() {
    for (name, others, change) in RECORDS {
        for configuration in [MotRemote, AllRemote] {
            for nearer in [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0], [0.0, 2.0], [1.4, 1.4]] {
                let mut cycle = crossing(configuration, nearer, others);
                change(&mut cycle);
                let name = format!("{name}, {configuration:?}, {nearer:?}");
                assert_eq!(rule(&cycle, Stage::Iv), Some(Rule::CollisionMoving), "{name}");
                let Outcome::Failed(witness) = outcome(&cycle, Stage::Iv) else { panic!("{name}") };
                assert_eq!((witness.detection, witness.item), (Some(0), Some(0)), "{name}");
                assert_eq!(witness.age_ns, Some(500_000_000), "{name}");
            }
        }
    }
}

/// Without the history, and in the paper profile, all of them are accepted.
#[test]
fn it_is_the_history_that_shows_it() {
    for (name, others, change) in RECORDS {
        for configuration in [MotRemote, AllRemote] {
            let mut cycle = crossing(configuration, [0.0, 0.0], others);
            change(&mut cycle);
            cycle.detection_history.clear();
            assert_eq!(failed(&cycle), None, "{name}, {configuration:?}");
            cycle.profile = Profile::Paper;
            assert_eq!(failed(&cycle), None, "{name}, {configuration:?}");
        }
    }
}

/// The same cars told truly: AllRemote stage iii finds the collision, MotRemote H-13 finds it.
#[test]
fn the_truth_is_rejected_too() {
    for (configuration, stage) in [(AllRemote, Stage::Iii), (MotRemote, Stage::Iv)] {
        let mut cycle = crossing(configuration, [0.0, 0.0], 1);
        said_to_stand(&mut cycle, 99, 0);
        cycle.tracks.as_mut().expect("set").items[1].vy = 7.5;
        assert_eq!(failed(&cycle), Some(FailedStage::Stage(stage)));
    }
}

/// A car that crosses behind the CAV, or far ahead of where it can stop, is no reason to reject.
#[test]
fn a_car_that_crosses_elsewhere_is_accepted() {
    for nearer in [[-10.0, 0.0], [25.0, 0.0]] {
        for configuration in [MotRemote, AllRemote] {
            let cycle = crossing(configuration, nearer, 1);
            assert_eq!(failed(&cycle), None, "{configuration:?}, {nearer:?}");
        }
    }
}
