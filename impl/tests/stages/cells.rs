//! Stage v beside detections: occupied cells that the CAV's rectangle touches (H-06 of
//! `spec/3-stages.md#hardened-profile`). Cells of 1 m, with the CAV's first point at the corner of
//! the cell (100, 100); its disks reach 1.104 m to the side, its rectangle 0.95 m. To the front the
//! disks reach 4.19 m, the rectangle 3.65 m.

use crate::scene::{Scene, detection, scene};
use mufasa::input::cycle::Cycle;
use mufasa::input::profile::Profile::Hardened;
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
    let mut scene = scene(Hardened, configuration, place);
    let occupied = scene.occupied.as_mut().expect("a grid");
    for &(column, row) in cells {
        let bit = row * 200 + column;
        occupied[bit / 8] |= 1 << (bit % 8);
    }
    scene.tracks = None;
    scene
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

/// What is unknown or outside counts only where no list of detections is current; an empty one is.
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
