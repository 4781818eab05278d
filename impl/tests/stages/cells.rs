//! Stage v beside detections: occupied cells that the CAV's rectangle touches, and no detection's (H-06
//! of `spec/hardened/H-06.md`). Cells of 1 m, with the CAV's first point at the corner of
//! the cell (100, 100); its disks reach 1.104 m to the side, its rectangle 0.95 m. To the front the
//! disks reach 4.19 m, the rectangle 3.65 m.

use crate::scene::{Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track};
use mufasa::input::profile::Profile;
use mufasa::report::{Rule, Stage};
use mufasa::services::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};

const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [583_912.25, 5_361_004.5], [-1.6e7, 1.6e7]];

/// From 1 m to 2 m beside the road, 2 m to 3 m ahead.
const BESIDE: (usize, usize) = (102, 101);
const HIT_BESIDE: Option<(i64, i64)> = Some((102, 101));

/// The scene at a place with these cells occupied and without tracks, so that stage iv runs.
fn occupied(configuration: Configuration, place: [f64; 2], cells: &[(usize, usize)]) -> Scene {
    let mut scene = scene(Profile::HARDENED, configuration, place);
    cells.iter().for_each(|&cell| occupy(&mut scene, cell));
    scene.tracks = None;
    scene
}

fn occupy(scene: &mut Scene, (column, row): (usize, usize)) {
    let bit = row * 200 + column;
    scene.occupied.as_mut().expect("a grid")[bit / 8] |= 1 << (bit % 8);
}

/// The point and the cell of stage v's collision, if it has one; everything else passes.
fn collision(scene: &Scene) -> Option<(usize, (i64, i64))> {
    let (stage, witness) = scene.failure()?;
    assert_eq!((stage, witness.rule), (Stage::V, Rule::Occupied));
    witness.point.zip(witness.cell)
}

/// The cell alone.
fn hit(scene: &Scene) -> Option<(i64, i64)> {
    Some(collision(scene)?.1)
}

/// A car of 4 m by 2 m ahead on the road that drives at 7 m/s, the CAV at 5 m/s, its rear so far ahead of p:
/// the second track and the second detection, seen 300 ms and 500 ms earlier, too. Cells are occupied up to
/// 9 m ahead.
fn car_ahead(configuration: Configuration, place: [f64; 2], rear: f64, first: usize) -> Scene {
    let cells: Vec<_> = (first..109).flat_map(|column| [(column, 99), (column, 100)]).collect();
    let mut scene = occupied(configuration, place, &cells);
    let [x, y] = [place[0] + rear + 2.0, place[1]];
    let beside = detection(place[0] + 3.0, place[1] + 50.1);
    scene.tracks =
        Some(vec![track(1, beside.x, beside.y - 0.1), Track { vx: 7.0, ..track(2, x, y) }]);
    let seen = |ago_s: f64| vec![beside, detection(x - 7.0 * ago_s, y)];
    scene.detections = Some(seen(0.0));
    scene.history = vec![(300_000_000, seen(0.3)), (500_000_000, seen(0.5))];
    scene
}

/// Cells of what stands are met up to `s_stop`, 2.27 m ahead; of what drives only by stages iii and iv, and
/// H-14.
#[test]
fn the_cells_of_a_car_that_drives_ahead_do_not_collide() {
    for place in PLACES {
        let found = |configuration| hit(&car_ahead(configuration, place, 5.25, 105));
        assert_eq!([AllRemote, PlanRemote].map(found), [None; 2], "{place:?}");
        assert_eq!(found(MotRemote), Some((105, 99)), "{place:?}");
    }
}

/// Cells from 4 m to 5 m ahead; those on the car do not hide them.
#[test]
fn a_cell_behind_a_car_collides_from_a_quarter_metre_on() {
    for place in PLACES {
        for configuration in [AllRemote, PlanRemote] {
            let found = |rear| hit(&car_ahead(configuration, place, rear, 104));
            assert_eq!(found(5.25 - 2e-7), None, "{place:?} {configuration:?}");
            assert_eq!(found(5.25), None, "{place:?} {configuration:?}");
            assert_eq!(found(5.25 + 2e-7), Some((104, 99)), "{place:?} {configuration:?}");
        }
    }
}

/// Something small drives past the cell beside the road, which a CAV of 2 m touches, and the grid is 100 ms older than the
/// detections. Its track chooses of their lists where it came from: it covers what is beside where it was detected, alone.
#[test]
fn a_detection_covers_where_it_was_detected_whatever_its_track_says() {
    for place in PLACES {
        let found = |[speed, ahead]: [f64; 2]| {
            let mut scene = occupied(PlanRemote, place, &[BESIDE]);
            scene.ego.width = 2.0;
            scene.change = |cycle| cycle.grid.iter_mut().for_each(|it| it.stamp_ns -= 90_000_000);
            let [x, y] = [place[0] + ahead, place[1] + 1.5];
            let (length, width) = (0.125, 0.125);
            let at = |ago: f64| Detection { length, width, ..detection(x - speed * ago, y) };
            let seen = |ago: f64| vec![at(0.0), at(ago)];
            scene.detections = Some(vec![at(0.0)]);
            scene.history = vec![(300_000_000, seen(0.3)), (500_000_000, seen(0.5))];
            scene.tracks = Some(vec![Track { vx: speed, length, width, ..track(2, x, y) }]);
            hit(&scene)
        };
        for speed in [60.0, 30.0, -30.0] {
            let moved = 2.5 + 0.09 * speed;
            assert_eq!([2.5, moved].map(|ahead| found([speed, ahead])), [None, HIT_BESIDE]);
        }
    }
}

/// The cell beside the road, which a CAV of 2 m touches, and something that stands a little farther aside.
fn beside_the_cell(configuration: Configuration, place: [f64; 2], standing: Detection) -> Scene {
    let mut scene = occupied(configuration, place, &[BESIDE]);
    scene.ego.width = 2.0;
    scene.detections = Some(vec![detection(place[0] + 3.0, place[1] + 50.1), standing]);
    scene
}

/// 2 m wide, with its right side so far from the cell.
fn left_of_it(place: [f64; 2], away: f64) -> Detection {
    detection(place[0] + 2.5, place[1] + 3.0 + away)
}

#[test]
fn a_cell_beside_a_detection_collides_from_a_quarter_metre_on() {
    for place in PLACES {
        for configuration in [AllRemote, PlanRemote] {
            let found = |away| {
                let mut scene = beside_the_cell(configuration, place, left_of_it(place, away));
                let second = hit(&scene);
                scene.detections.iter_mut().for_each(|list| list.reverse());
                assert_eq!(hit(&scene), second, "{place:?} {configuration:?}");
                second
            };
            assert_eq!(found(0.25 - 2e-7), None, "{place:?} {configuration:?}");
            assert_eq!(found(0.25), None, "{place:?} {configuration:?}");
            assert_eq!(found(0.25 + 2e-7), HIT_BESIDE, "{place:?} {configuration:?}");
        }
    }
}
