//! `spec/3-stages.md#stage-v-trajectory-with-grid-map`

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::vectors::base::{base, cell, fine_grid, points_of, straight, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, from, up_to};
use crate::vectors::expected::{fails_by, safe};

const DISKS: Topic =
    Topic::new("stages/grid", "spec/3-stages.md#stage-v-trajectory-with-grid-map.1");
const MARKED: Topic =
    Topic::new("stages/grid", "spec/3-stages.md#stage-v-trajectory-with-grid-map.2");
const FREE: Topic =
    Topic::new("stages/grid", "spec/3-stages.md#stage-v-trajectory-with-grid-map.3");

/// Stage v with the fine grid, of which the cell with its corner at (x, y) is occupied. Cells are
/// 1 m; disks of the CAV are at -1.5, -0.5, 0.5, 1.5 m with r = sqrt(5)/2 = 1.118 m.
pub fn stage_v(profile: Profile, [x, y]: [usize; 2]) -> Cycle {
    with(base(profile, MotRemote), |cycle| {
        (cycle.tracks, cycle.detections) = (None, None);
        let mut grid = fine_grid();
        grid.occupied = cell(x + 12, y + 12);
        cycle.grid = Some(grid);
    })
}

fn move_aside(cycle: &mut Cycle, y: f64) {
    points_of(cycle).iter_mut().for_each(|point| point.y = y);
}

/// Adds its vectors.
pub fn add(book: &mut Book) {
    disks(book);
    marked(book);
    free(book);
}

fn disks(book: &mut Book) {
    for (name, x, y, expected) in [
        ("same-cell", 3, 0.5, fails_by("v", "occupied")),
        ("next-cell", 3, 1.5, fails_by("v", "occupied")),
        ("diagonal", 8, 1.5, safe()),
    ] {
        let note = "Of an occupied cell the four neighbours are nearer than r = 1.118 cells, the \
                    diagonal ones (1.414) are not, and the foremost disk ends in column 7.";
        let cycle = with(stage_v(Profile::Paper, [x, 0]), |cycle| move_aside(cycle, y));
        book.cycle(DISKS, name, note, &cycle, &expected);
    }
    let sides = Sides {
        name: "radius",
        note: "L/n = 6 m and W = w m: r = sqrt(9 + w^2/4) is 5 m at w = 8. The occupied cell is \
               3 and 4 cells from the cell of the foremost disk: at distance r it is marked.",
        edge: from(8.0),
        accepted: safe(),
        rejected: fails_by("v", "occupied").witness("v", "disk", 3).witness("v", "point", 0),
    };
    book.sides(DISKS, &sides, |width| {
        with(stage_v(Profile::Paper, [12, 4]), |cycle| {
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(1, 1.0));
            points_of(cycle).iter_mut().for_each(|point| (point.x, point.y) = (0.5, 0.5));
            (cycle.ego.length, cycle.ego.width) = (24.0, width);
        })
    });
    for (name, n, expected) in
        [("one-disk", 1, fails_by("v", "occupied").witness("v", "disk", 0)), ("n-disks", 4, safe())]
    {
        let note = "The same place with n = 1 disk of r = sqrt(5) m, and with n = 4 of 1.118 m.";
        let cycle = with(stage_v(Profile::Paper, [0, 2]), |cycle| {
            cycle.parameters.n = n;
            cycle.ego.speed = 0.0;
            move_aside(cycle, 0.5);
        });
        book.cycle(DISKS, name, note, &cycle, &expected);
    }
    let note = "Disks are on the rectangle, which center_offset shifts.";
    for (name, center_offset, expected) in
        [("offset", 2.0, fails_by("v", "occupied")), ("no-offset", 0.0, safe())]
    {
        let cycle = with(stage_v(Profile::Paper, [4, 0]), |cycle| {
            cycle.ego.speed = 0.0;
            cycle.ego.center_offset = center_offset;
            move_aside(cycle, 0.5);
        });
        book.cycle(DISKS, name, note, &cycle, &expected);
    }
}

fn marked(book: &mut Book) {
    let sides = Sides {
        name: "border-of-cells",
        note: "The cell above y = 1 is occupied and marks the one from 0 to 1; a disk centre at \
               y = 0, on the border, lies in it.",
        edge: from(0.0),
        accepted: safe(),
        rejected: fails_by("v", "occupied"),
    };
    book.sides(MARKED, &sides, |y| {
        with(stage_v(Profile::Paper, [3, 1]), |cycle| move_aside(cycle, y))
    });
    let sides = Sides {
        name: "horizon",
        note: "The horizon is s_b = 100 / (2 a_b); the occupied cell is reached at the point 5 m \
               along, up to a_b = 10 m/s^2.",
        edge: up_to(10.0),
        accepted: safe(),
        rejected: fails_by("v", "occupied").witness("v", "point", 5),
    };
    book.sides(MARKED, &sides, |a_b| {
        with(stage_v(Profile::Paper, [7, 0]), |cycle| {
            cycle.parameters.a_b = a_b;
            move_aside(cycle, 0.5);
        })
    });
    for (name, y, expected) in [
        ("rotated", 0.5, fails_by("v", "occupied").witness("v", "cell", vec![12, 7])),
        ("rotated-aside", 2.5, safe()),
    ] {
        let note = "Rows go north: the cell (column i, row k) covers x from 12 - k - 1 to 12 - k \
                    and y from i - 12 to i - 11.";
        let cycle = with(stage_v(Profile::Paper, [0, 0]), |cycle| {
            if let Some(grid) = &mut cycle.grid {
                (grid.x, grid.y, grid.cos, grid.sin) = (12.0, -12.0, 0.0, 1.0);
                grid.occupied = cell(12, 7);
            }
            move_aside(cycle, y);
        });
        book.cycle(MARKED, name, note, &cycle, &expected);
    }
}

fn free(book: &mut Book) {
    let clear = |cycle: &mut Cycle| {
        if let Some(grid) = &mut cycle.grid {
            grid.occupied = vec![0; 120];
        }
    };
    let note = "Every cell is unknown: free in the paper profile (I-07); without detections the \
                hardened profile takes them as occupied (H-06).";
    let cycle = with(stage_v(Profile::Paper, [0, 0]), |cycle| {
        clear(cycle);
        if let Some(grid) = &mut cycle.grid {
            grid.unknown = Some(vec![0xff; 120]);
        }
    });
    book.cycle(FREE, "unknown", note, &cycle, &safe().stages("TP-dP"));
    let note = "The trajectory is wholly outside the grid.";
    let cycle = with(stage_v(Profile::Paper, [0, 0]), |cycle| {
        clear(cycle);
        if let Some(grid) = &mut cycle.grid {
            (grid.x, grid.y) = (500.0, 500.0);
        }
    });
    book.cycle(FREE, "outside", note, &cycle, &safe().stages("TP-dP"));
    let note = "A cell both occupied and unknown is occupied.";
    let cycle = with(stage_v(Profile::Paper, [3, 0]), |cycle| {
        if let Some(grid) = &mut cycle.grid {
            grid.unknown = Some(vec![0xff; 120]);
        }
    });
    book.cycle(FREE, "occupied-and-unknown", note, &cycle, &fails_by("v", "occupied"));
    let sides = Sides {
        name: "left-of-the-grid",
        note: "The occupied cell is the leftmost of its row; a disk centre left of the grid at \
               x m is in no cell, on the border it is in the first.",
        edge: from(-12.0),
        accepted: safe(),
        rejected: fails_by("v", "occupied"),
    };
    book.sides(FREE, &sides, |x| {
        with(stage_v(Profile::Paper, [0, 0]), |cycle| {
            cycle.ego.speed = 0.0;
            cycle.parameters.n = 1;
            cycle.trajectory = Some(straight(1, 1.0));
            points_of(cycle).iter_mut().for_each(|point| (point.x, point.y) = (x, 0.5));
            if let Some(grid) = &mut cycle.grid {
                grid.occupied = cell(0, 12);
            }
        })
    });
}
