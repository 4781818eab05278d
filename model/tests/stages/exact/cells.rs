//! Cells of the dilated grid: every pair of cells compared, in integers.

use mufasa_model::input::cycle::{Grid, Profile};
use mufasa_model::report::Stage;
use mufasa_model::services::configuration::Configuration::MotRemote;

use super::Draw;
use crate::base::{NOW, base, passes};

/// Cells of a side.
const SIDE: i32 = 24;

/// Whether the cell of the array is marked: its centre is at most r from that of an occupied one,
/// where `square` is (2 r)^2 in cells.
fn is_marked(occupied: &[(i32, i32)], (column, row): (i32, i32), square: i32) -> bool {
    let inside = (0..SIDE).contains(&column) && (0..SIDE).contains(&row);
    let near =
        |(i, k): &(i32, i32)| 4 * ((i - column) * (i - column) + (k - row) * (k - row)) <= square;
    inside && occupied.iter().any(near)
}

/// The cells that hold a centre at `half` cells' halves: two where it is on a border.
fn cells(half: i32) -> std::ops::RangeInclusive<i32> {
    (half - 1).div_euclid(2)..=half.div_euclid(2)
}

/// The CAV stands; a cell is a quarter of a metre. One disk covers a CAV of L by W cells; two have
/// their centres L/4 before and behind the middle. Radii such as of 6 by 8 cells are whole, so that
/// cells lie exactly on them.
#[test]
fn cells_are_marked_as_all_pairs_of_integers_say() {
    let mut draw = Draw::new(10);
    let (mut seen, mut on) = ([0; 2], 0);
    for _ in 0..1500 {
        let [l, w] = [(6, 8), (8, 6), (12, 5), (8, 4), (4, 3), (16, 6)]
            [usize::try_from(draw.between(0, 5)).expect("an index")]
        .into();
        let n = if l % 4 == 0 { draw.between(1, 2) } else { 1 };
        // Halves of cells from the corner of the grid.
        let centre = [0; 2].map(|_| draw.between(-4, 2 * SIDE + 4));
        let count = draw.between(1, 3);
        let mut cell = || (draw.between(0, SIDE - 1), draw.between(0, SIDE - 1));
        let occupied: Vec<(i32, i32)> = (0..count).map(|_| cell()).collect();
        // (2 r)^2 = (L/n)^2 + W^2
        let square = (l / n) * (l / n) + w * w;
        let disks = if n == 1 { vec![0] } else { vec![-l / 2, l / 2] };
        let hit = |square: i32| {
            disks.iter().any(|ahead| {
                cells(centre[0] + ahead).any(|column| {
                    cells(centre[1]).any(|row| is_marked(&occupied, (column, row), square))
                })
            })
        };
        let mut cycle = base(Profile::PAPER, MotRemote);
        let metres = |halves: i32| f64::from(halves) / 8.0;
        (cycle.ego.speed, cycle.parameters.n) = (0.0, n.into());
        (cycle.ego.length, cycle.ego.width) = (metres(2 * l), metres(2 * w));
        (cycle.detections, cycle.tracks) = (None, None);
        let mut bitmap = vec![0_u8; usize::try_from(SIDE * SIDE / 8).expect("a size")];
        for (i, k) in &occupied {
            let bit = usize::try_from(k * SIDE + i).expect("in the grid");
            bitmap[bit / 8] |= 1 << (bit % 8);
        }
        cycle.grid = Some(Grid {
            stamp_ns: NOW,
            x: -metres(centre[0]),
            y: -metres(centre[1]),
            cos: 1.0,
            sin: 0.0,
            resolution: 0.25,
            width: SIDE.into(),
            height: SIDE.into(),
            occupied: bitmap,
            unknown: None,
        });
        assert_eq!(passes(&cycle, Stage::V), !hit(square), "{cycle:?}");
        seen[usize::from(hit(square))] += 1;
        on += u32::from(hit(square) && !hit(square - 1));
    }
    assert!(seen.iter().all(|count| *count > 150) && on > 10, "{seen:?}, {on} on the radius");
}
