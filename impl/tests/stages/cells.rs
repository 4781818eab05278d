//! Stage v beside stage iv: occupied cells that a detection touches (H-06 of
//! `spec/3-stages.md#hardened-profile`). Cells of 1 m, with the CAV's first point at the corner of
//! the cell (100, 100); its disks reach 1.104 m to the side, its rectangle 0.95 m.

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
    let (stage, witness) = scene.failure()?;
    assert_eq!((stage, witness.rule), (Stage::V, Rule::Occupied));
    witness.cell
}

/// From 1 m to 2 m beside the road, 2 m to 3 m ahead.
const CELL: (usize, usize) = (102, 101);
const HIT: Option<(i64, i64)> = Some((102, 101));

#[test]
fn a_cell_that_a_detection_touches_is_left_to_stage_iv() {
    for place in PLACES {
        for configuration in [MotRemote, AllRemote, PlanRemote] {
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
        assert_eq!(hit(&beside(MotRemote, PLACES[0], &[CELL], corner(off))), found);
        assert_eq!(hit(&beside(MotRemote, PLACES[0], &[CELL], turned(off))), found);
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
        let scene = beside(MotRemote, PLACES[0], &cells, detection(x, 2.5));
        assert_eq!(hit(&scene), Some(found));
    }
}
