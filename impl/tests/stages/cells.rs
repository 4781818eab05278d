//! Stage v beside stage iv: occupied cells that a detection touches (H-06 of
//! `spec/3-stages.md#hardened-profile`). Cells of 1 m, with the CAV's first point at the corner of
//! the cell (100, 100); its disks reach 1.104 m to the side, its rectangle 0.95 m. To the front the
//! disks reach 4.19 m, the rectangle 3.65 m.

use crate::scene::{Scene, detection, scene};
use mufasa::input::cycle::Detection;
use mufasa::input::profile::Profile::Hardened;
use mufasa::report::{Outcome, Rule, Stage};
use mufasa::services::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};

const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [583_912.25, 5_361_004.5], [-1.6e7, 1.6e7]];

/// The scene at a place with these cells occupied and one more detection, relative to the place;
/// without tracks.
fn beside(
    configuration: Configuration,
    [x, y]: [f64; 2],
    cells: &[(usize, usize)],
    seen: Detection,
) -> Scene {
    let mut scene = scene(Hardened, configuration, [x, y]);
    let occupied = scene.occupied.as_mut().expect("a grid");
    for &(column, row) in cells {
        let bit = row * 200 + column;
        occupied[bit / 8] |= 1 << (bit % 8);
    }
    scene.tracks = None;
    scene.detections = Some(vec![
        detection(x - 30.0, y + 30.0),
        Detection { x: x + seen.x, y: y + seen.y, ..seen },
    ]);
    scene
}

/// The cell with which stage v collides, if it does; everything else passes.
fn hit(scene: &Scene) -> Option<(i64, i64)> {
    Some(collision(scene)?.1)
}

/// The point at which it collides, too.
fn collision(scene: &Scene) -> Option<(usize, (i64, i64))> {
    let (stage, witness) = scene.failure()?;
    assert_eq!((stage, witness.rule), (Stage::V, Rule::Occupied));
    witness.point.zip(witness.cell)
}

/// From 1 m to 2 m beside the road, 2 m to 3 m ahead.
const CELL: (usize, usize) = (102, 101);
const HIT: Option<(i64, i64)> = Some((102, 101));

#[test]
fn the_disks_leave_a_cell_that_a_detection_touches_to_stage_iv() {
    for place in PLACES {
        for configuration in [AllRemote, PlanRemote] {
            // 4 m by 2 m: its side at 2 m, then its front at 2 m.
            for (x, y, dx, dy) in [(2.5, 3.0, 0.0, 1.0), (0.0, 2.0, -1.0, 0.0)] {
                let at = |off: f64| detection(x + off * dx, y + off * dy);
                let found = |off| hit(&beside(configuration, place, &[CELL], at(off)));
                assert_eq!(found(0.0), None, "{place:?} {configuration:?}");
                assert_eq!(found(-1e-7), None, "{place:?} {configuration:?}");
                assert_eq!(found(1e-7), HIT, "{place:?} {configuration:?}");
            }
        }
    }
}

/// There the paper's stage v runs, too.
#[test]
fn in_mot_remote_every_cell_counts() {
    for place in PLACES {
        for y in [2.5, 3.0, 3.0 + 1e-7] {
            let scene = beside(MotRemote, place, &[CELL], detection(2.5, y));
            assert_eq!(hit(&scene), HIT, "{place:?} {y}");
        }
    }
}

/// From 1 m beside the road on is the cell, the detection from 2 m on.
#[test]
fn the_side_of_the_cav_touches_the_cell() {
    for place in PLACES {
        for configuration in [AllRemote, PlanRemote] {
            let found = |width, y| {
                let mut scene = beside(configuration, place, &[CELL], detection(2.5, y));
                scene.ego.width = width;
                hit(&scene)
            };
            for (width, expected) in [(2.0, HIT), (2.0 + 2e-7, HIT), (2.0 - 2e-7, None)] {
                assert_eq!(found(width, 3.0), expected, "{place:?} {configuration:?} {width}");
                assert_eq!(found(width, 2.5), expected, "{place:?} {configuration:?} {width}");
                assert_eq!(found(width, 3.0 + 1e-7), HIT, "{place:?} {configuration:?} {width}");
            }
        }
    }
}

/// Something that was not detected stands on the road, 5 m ahead, in a cell that the detection
/// beside the road touches.
#[test]
fn the_front_of_the_cav_touches_the_cell() {
    let ahead = (105, 100);
    for place in PLACES {
        for configuration in [AllRemote, PlanRemote] {
            let found = |center_offset, y| {
                let mut scene = beside(configuration, place, &[ahead], detection(5.5, y));
                scene.ego.center_offset = center_offset;
                collision(&scene)
            };
            let at = |point| Some((point, (105, 100)));
            // The front is 2.25 m farther: after 1.5 m it is there, after 1 m a disk is.
            for (center_offset, point) in [(1.25, 3), (1.25 + 1e-7, 3), (1.25 - 1e-7, 4)] {
                assert_eq!(found(center_offset, 2.0), at(point), "{place:?} {center_offset}");
                assert_eq!(found(center_offset, 2.0 + 1e-7), at(2), "{place:?} {center_offset}");
            }
        }
    }
}

/// The trajectory stands after 0.5 m, and its points are 0 to 7: places 1.5 m, 1.75 m, 2 m and 2.25 m ahead of its end follow.
#[test]
fn beyond_the_end_the_cav_is_where_it_is_moved_to() {
    for configuration in [AllRemote, PlanRemote] {
        let found = |length, y| {
            let seen = detection(5.5, y);
            let mut scene = beside(configuration, PLACES[0], &[(105, 100)], seen);
            scene.points.truncate(8);
            scene.points.iter_mut().skip(1).for_each(|point| point.x = 0.5);
            scene.ego.length = length;
            collision(&scene)
        };
        // The front reaches 5 m at the fourth of the places, or at the fifth.
        assert_eq!(found(4.5, 2.0), Some((11, (105, 100))));
        assert_eq!(found(4.5 - 2e-7, 2.0), Some((12, (105, 100))));
        // A disk reaches it at the second.
        assert_eq!(found(4.5, 2.0 + 1e-7), Some((9, (105, 100))));
    }
}

/// Its corner at the cell's corner, and the cell's corner in the middle of its front.
#[test]
fn a_corner_is_a_point() {
    let corner = |off: f64| detection(3.0 + off + 2.0, 2.0 + off + 1.0);
    let half = 0.5_f64.sqrt();
    let turned = |off: f64| {
        let away = (2.0 + off) * half;
        let (x, y) = (2.0 - away, 2.0 + away);
        Detection { x, y, cos: half, sin: -half, length: 4.0, width: 2.0 }
    };
    for (off, found) in [(-1e-7, None), (1e-7, HIT)] {
        assert_eq!(hit(&beside(AllRemote, PLACES[0], &[CELL], corner(off))), found);
        assert_eq!(hit(&beside(AllRemote, PLACES[0], &[CELL], turned(off))), found);
    }
}

/// In `PlanRemote` stage iii, which ran on tracks, replaces it.
#[test]
fn without_stage_iv_every_cell_counts() {
    let covering = detection(2.5, 2.5);
    let mut scene = beside(PlanRemote, PLACES[0], &[CELL], covering);
    assert_eq!(hit(&scene), None);
    scene.tracks = Some(Vec::new());
    let report = scene.report();
    assert!(matches!(report.stages[3], Outcome::Skipped(_)));
    assert_eq!(hit(&scene), HIT);
    // A list that is not current is none.
    scene.tracks = None;
    scene.change = |cycle| {
        if let Some(list) = &mut cycle.detections {
            list.stamp_ns -= 200_000_000;
        }
    };
    assert_eq!(hit(&scene), HIT);
}

#[test]
fn the_witness_is_the_first_cell_that_none_touches() {
    // The second cell begins 3 m ahead, where the detection ends, or just not.
    let cells = [CELL, (103, 101), (105, 98)];
    for (x, found) in [(1.0, (105, 98)), (1.0 - 1e-7, (103, 101))] {
        let scene = beside(AllRemote, PLACES[0], &cells, detection(x, 2.5));
        assert_eq!(hit(&scene), Some(found));
    }
}
