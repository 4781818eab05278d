//! Stage v beside detections: occupied cells that the CAV's rectangle touches, and no detection's (H-06
//! of `spec/hardened/H-06.md`). Cells of 1 m, with the CAV's first point at the corner of
//! the cell (100, 100); its disks reach 1.104 m to the side, its rectangle 0.95 m. To the front the
//! disks reach 4.19 m, the rectangle 3.65 m.

use crate::scene::{Scene, detection, scene, track};
use mufasa::input::cycle::{Cycle, Detection, Track};
use mufasa::input::profile::Profile;
use mufasa::report::{Outcome, Rule, Stage};
use mufasa::services::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};

const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [583_912.25, 5_361_004.5], [-1.6e7, 1.6e7]];

/// From 1 m to 2 m beside the road, 2 m to 3 m ahead.
const BESIDE: (usize, usize) = (102, 101);
const HIT_BESIDE: Option<(i64, i64)> = Some((102, 101));

/// On the road, 5 m ahead.
const AHEAD: (usize, usize) = (105, 100);

type Change = fn(&mut Cycle<'_>);

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

#[test]
fn the_side_of_the_cav_touches_the_cell() {
    for place in PLACES {
        for configuration in [AllRemote, PlanRemote] {
            let found = |width| {
                let mut scene = occupied(configuration, place, &[BESIDE]);
                scene.ego.width = width;
                hit(&scene)
            };
            assert_eq!(found(1.9), None, "{place:?} {configuration:?}");
            assert_eq!(found(2.0 - 2e-7), None, "{place:?} {configuration:?}");
            assert_eq!(found(2.0), HIT_BESIDE, "{place:?} {configuration:?}");
            assert_eq!(found(2.0 + 2e-7), HIT_BESIDE, "{place:?} {configuration:?}");
        }
    }
}

/// The front is 2.25 m farther than the offset: after 1.5 m it is there, after 1 m a disk is. That is the
/// last point within `s_b`; of the places behind the 30 points the seventh after p is at 1.75 m (H-04).
#[test]
fn the_front_of_the_cav_touches_the_cell() {
    for place in PLACES {
        let found = |configuration, center_offset| {
            let mut scene = occupied(configuration, place, &[AHEAD]);
            scene.ego.center_offset = center_offset;
            collision(&scene)
        };
        for (center_offset, point) in [(1.25, 3), (1.25 + 1e-7, 3), (1.25 - 1e-7, 37)] {
            let expected = Some((point, (105, 100)));
            assert_eq!(found(AllRemote, center_offset), expected, "{place:?} {center_offset}");
            assert_eq!(found(PlanRemote, center_offset), expected, "{place:?} {center_offset}");
            let disk = Some((2, (105, 100)));
            assert_eq!(found(MotRemote, center_offset), disk, "{place:?} {center_offset}");
        }
    }
}

/// Cells turned by 45 degrees: the first corner of (100, 100) is 2.5 m ahead and 1 m beside.
#[test]
fn a_corner_is_a_point() {
    for (width, found) in [(2.0 - 2e-7, None), (2.0 + 2e-7, Some((100, 100)))] {
        let mut scene = occupied(AllRemote, PLACES[0], &[(100, 100)]);
        scene.ego.width = width;
        scene.change = |cycle| {
            if let Some(grid) = &mut cycle.grid {
                let half = 0.5_f64.sqrt();
                (grid.cos, grid.sin) = (half, half);
                (grid.x, grid.y) = (cycle.ego.x + 2.5, cycle.ego.y + 1.0 - 200.0 * half);
            }
        };
        assert_eq!(hit(&scene), found);
    }
}

/// There the paper's stage v runs, too.
#[test]
fn in_mot_remote_the_disks_collide() {
    for place in PLACES {
        assert_eq!(hit(&occupied(MotRemote, place, &[BESIDE])), HIT_BESIDE, "{place:?}");
    }
}

/// Whether stage iv runs or stage iii replaces it, as it does on tracks.
#[test]
fn without_current_detections_the_disks_collide() {
    let mut scene = occupied(PlanRemote, PLACES[0], &[BESIDE]);
    assert_eq!(hit(&scene), None);
    scene.tracks = Some(Vec::new());
    assert!(matches!(scene.report().stages[3], Outcome::Skipped(_)));
    assert_eq!(hit(&scene), None);
    // A list that is not current is none.
    scene.tracks = None;
    scene.change = |cycle| {
        if let Some(list) = &mut cycle.detections {
            list.stamp_ns -= 200_000_000;
        }
    };
    assert_eq!(hit(&scene), HIT_BESIDE);
}

/// Stage iv runs on an empty list, too, but the grid is all that is left then.
#[test]
fn without_detections_the_disks_collide() {
    for place in PLACES {
        for configuration in [AllRemote, PlanRemote] {
            let mut scene = occupied(configuration, place, &[BESIDE]);
            assert_eq!(hit(&scene), None, "{place:?} {configuration:?}");
            scene.detections = Some(Vec::new());
            assert!(matches!(scene.report().stages[3], Outcome::Passed));
            assert_eq!(hit(&scene), HIT_BESIDE, "{place:?} {configuration:?}");
            scene.detections = Some(vec![detection(place[0] + 3.0, place[1] + 50.1)]);
            assert_eq!(hit(&scene), None, "{place:?} {configuration:?}");
        }
    }
}

/// Cells that are unknown, and places outside, however far, count only where no list of detections is
/// current; an empty one is.
#[test]
fn without_detections_only_occupied_cells_collide() {
    const UNKNOWN: &[u8] = &[255; 5000];
    for (change, rule) in [
        (
            (|cycle| cycle.grid.iter_mut().for_each(|grid| grid.unknown = Some(UNKNOWN))) as Change,
            Rule::Unknown,
        ),
        (
            (|cycle| cycle.grid.iter_mut().for_each(|grid| grid.x = cycle.ego.x)) as Change,
            Rule::Outside,
        ),
        // Farther from the border than any disk reaches (H-06.6).
        (
            (|cycle| cycle.grid.iter_mut().for_each(|grid| grid.x = cycle.ego.x + 60.0)) as Change,
            Rule::Outside,
        ),
    ] {
        for configuration in [AllRemote, PlanRemote] {
            let mut scene = occupied(configuration, PLACES[0], &[]);
            (scene.detections, scene.change) = (Some(Vec::new()), change);
            assert_eq!(scene.rule(), None, "{rule:?} {configuration:?}");
            scene.detections = None;
            assert_eq!(scene.rule(), Some(rule), "{configuration:?}");
        }
    }
}

/// Disks reach the cells beside the road at the first points; the one behind it is the witness.
#[test]
fn the_witness_is_the_first_cell_that_disk_and_rectangle_touch() {
    let scene = occupied(AllRemote, PLACES[0], &[BESIDE, (104, 98), AHEAD, (106, 100)]);
    assert_eq!(collision(&scene), Some((3, (105, 100))));
    // The rear disk reaches both, the rectangle the one in the later row, or just the other, too.
    let mut scene = occupied(AllRemote, PLACES[0], &[(99, 98), (99, 100)]);
    assert_eq!(collision(&scene), Some((0, (99, 100))));
    scene.ego.width = 2.0;
    assert_eq!(collision(&scene), Some((0, (99, 98))));
}

/// A car of 4 m by 2 m ahead on the road that drives at 5 m/s, as the CAV does, its rear so far ahead of p:
/// the second track and the second detection, seen 300 ms and 500 ms earlier, too. Cells are occupied up to
/// 9 m ahead.
fn car_ahead(configuration: Configuration, place: [f64; 2], rear: f64, first: usize) -> Scene {
    let cells: Vec<_> = (first..109).flat_map(|column| [(column, 99), (column, 100)]).collect();
    let mut scene = occupied(configuration, place, &cells);
    let [x, y] = [place[0] + rear + 2.0, place[1]];
    let beside = detection(place[0] + 3.0, place[1] + 50.1);
    scene.tracks =
        Some(vec![track(1, beside.x, beside.y - 0.1), Track { vx: 5.0, ..track(2, x, y) }]);
    let seen = |ago_s: f64| vec![beside, detection(x - 5.0 * ago_s, y)];
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

/// In `MotRemote`, and where the list is not current.
#[test]
fn elsewhere_detections_cover_no_cell() {
    for place in PLACES {
        let scene = |configuration| beside_the_cell(configuration, place, left_of_it(place, 0.125));
        assert_eq!([AllRemote, PlanRemote].map(|it| hit(&scene(it))), [None; 2], "{place:?}");
        assert_eq!(hit(&scene(MotRemote)), HIT_BESIDE, "{place:?}");
        for configuration in [AllRemote, PlanRemote] {
            let mut scene = scene(configuration);
            scene.change = |cycle| {
                if let Some(list) = &mut cycle.detections {
                    list.stamp_ns -= 200_000_000;
                }
            };
            assert_eq!(hit(&scene), HIT_BESIDE, "{place:?} {configuration:?}");
        }
    }
}

/// The corner of the cell 3 m ahead and 2 m beside, and a detection turned by 45 degrees with its rear, or
/// its right side, 1/4 m from there. Upright boxes of the two overlap by far.
#[test]
fn a_turned_detection_covers_a_corner() {
    let half = 0.5_f64.sqrt();
    for [length, width, cos, sin] in [[1.0, 2.0, half, half], [2.0, 1.0, half, -half]] {
        let found = |off: f64| {
            let out = (0.75 + off) * half;
            let there = detection(3.0 + out, 2.0 + out);
            let standing = Detection { cos, sin, length, width, ..there };
            hit(&beside_the_cell(AllRemote, PLACES[0], standing))
        };
        assert_eq!(found(-2e-7), None, "{length} {width}");
        assert_eq!(found(2e-7), HIT_BESIDE, "{length} {width}");
    }
}

/// What grows is multiplied by the direction as given: 1.25 m times 4e-7, to either side.
#[test]
fn the_direction_of_a_detection_is_used_as_given() {
    for (cos, off, found) in [
        (1.0 + 4e-7, 4.9e-7, None),
        (1.0 + 4e-7, 5.1e-7, HIT_BESIDE),
        (1.0 - 4e-7, -4.9e-7, HIT_BESIDE),
        (1.0 - 4e-7, -5.1e-7, None),
    ] {
        let standing = Detection { cos, ..left_of_it(PLACES[0], 0.25 + off) };
        assert_eq!(hit(&beside_the_cell(AllRemote, PLACES[0], standing)), found, "{cos} {off}");
    }
}

/// Of two cells beside the road each has to be covered, by whichever detection.
#[test]
fn every_cell_needs_a_detection() {
    // Grown, this one reaches to 4.75 m ahead, the next one from there on.
    let standing = left_of_it(PLACES[0], 0.125);
    let farther = Detection { length: 1.0, ..detection(5.5, 3.125) };
    let found = |detections: &[Detection]| {
        let mut scene = beside_the_cell(AllRemote, PLACES[0], standing);
        occupy(&mut scene, (105, 101));
        scene.detections = Some(detections.to_vec());
        hit(&scene)
    };
    assert_eq!(found(&[standing, farther]), None);
    assert_eq!(found(&[standing]), Some((105, 101)));
    assert_eq!(found(&[farther]), HIT_BESIDE);
}
