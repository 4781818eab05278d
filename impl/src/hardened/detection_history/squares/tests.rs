//! Against looking at every item.

use std::vec;
use std::vec::Vec;

use super::Squares;
use crate::input::cycle::{Detection, DetectionList};
use crate::input::detection_index::{DetectionIndex, Slot};
use crate::input::scratch::Column;
use crate::numbers::plane::same_point;
use crate::random::Random;

#[test]
fn what_is_in_a_box_is_found_once() {
    let mut random = Random::new(11);
    let (mut found, mut missed, mut beside) = (0, 0, 0);
    for case in 0..2_000 {
        let far = [0.0, 16_777_150.0][case % 2];
        let count = [0, 1, 3, 40, 200][case % 5];
        let mut number = |range: f64| random.below(1 << 20) as f64 / f64::from(1 << 20) * range;
        let items: Vec<_> = (0..count)
            .map(|_| {
                let (x, y) = (far + number(60.0), -far + number(60.0));
                Detection { x, y, cos: 1.0, sin: 0.0, length: 1.0, width: 1.0 }
            })
            .collect();
        let sides = [1e-3, 4.0, 12.0, 1000.0];
        let mut columns = vec![Column::default(); count];
        let lists = [0, 1, 2, 3].map(|list| Squares::new(&items, sides[list], list, &mut columns));
        let (size, x, y) = (number(20.0), far + number(60.0), -far + number(60.0));
        let area = [[x - size, x + size], [y - size, y + size]];
        let inside = |item: &Detection| {
            let within = |value: f64, [least, most]: [f64; 2]| least <= value && value <= most;
            within(item.x, area[0]) && within(item.y, area[1])
        };
        let mut slots = vec![Slot::default(); count];
        let list = DetectionList { stamp_ns: 0, items: &items };
        let index = DetectionIndex::new(&list, &mut slots).expect("valid");
        let kept = Squares::of((&items, Some(&index)), 1.0, 0, &mut columns);
        for squares in lists.iter().chain([&kept]) {
            let mut met = Vec::new();
            squares.for_each_in(&columns, area, |index, item| {
                assert!(same_point(item, [items[index].x, items[index].y]));
                met.push(index);
            });
            met.sort_unstable();
            assert!(met.is_sorted_by(|a, b| a < b), "an item twice: {met:?}");
            for (index, _) in items.iter().enumerate().filter(|(_, item)| inside(item)) {
                assert!(met.contains(&index), "{index} of {area:?}");
                found += 1;
            }
            missed += count - met.len();
            let mut met = Vec::new();
            let place = [x + size, y];
            let away = squares.for_each_beside(&columns, place, |index, _| met.push(index));
            let near = |item: &Detection| {
                (item.x - place[0]).hypot(item.y - place[1]) <= away && away > 0.0
            };
            for (index, _) in items.iter().enumerate().filter(|(_, item)| near(item)) {
                assert!(met.contains(&index), "{index} at {place:?}, {away}");
                beside += 1;
            }
        }
        let nothing = [[[x, x - 100.0], [y, y]], [[x, x], [y, y - 100.0]]];
        for (squares, area) in
            [(&kept, nothing[0]), (&lists[1], nothing[0]), (&lists[1], nothing[1])]
        {
            squares.for_each_in(&columns, area, |index, _| panic!("{index}"));
        }
    }
    assert!(found > 10_000 && missed > 10_000 && beside > 10_000, "{found} {missed} {beside}");
}
