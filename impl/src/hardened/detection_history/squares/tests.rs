//! Against looking at every item.

use std::vec;
use std::vec::Vec;

use super::{Links, Squares};
use crate::input::cycle::Detection;
use crate::input::scratch::Column;
use crate::random::Random;

#[test]
fn what_is_in_a_box_is_found_once() {
    let mut random = Random::new(11);
    let (mut found, mut missed) = (0, 0);
    for case in 0..2_000 {
        let far = [0.0, 16_777_200.0][case % 2];
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
        let lists = Links::ALL
            .map(|links| Squares::new(&items, sides[links as usize], links, &mut columns));
        let (size, x, y) = (number(20.0), far + number(60.0), -far + number(60.0));
        let area = [[x - size, x + size], [y - size, y + size]];
        let inside = |item: &Detection| {
            let within = |value: f64, [least, most]: [f64; 2]| least <= value && value <= most;
            within(item.x, area[0]) && within(item.y, area[1])
        };
        for squares in &lists {
            let mut met = Vec::new();
            squares.for_each_in(&columns, area, |index, item| {
                assert_eq!(item, &items[index]);
                met.push(index);
            });
            met.sort_unstable();
            assert!(met.is_sorted_by(|a, b| a < b), "an item twice: {met:?}");
            for (index, _) in items.iter().enumerate().filter(|(_, item)| inside(item)) {
                assert!(met.contains(&index), "{index} of {area:?}");
                found += 1;
            }
            missed += count - met.len();
        }
        let nothing = [[x, x - 100.0], [y, y]];
        lists[1].for_each_in(&columns, nothing, |index, _| panic!("{index}"));
    }
    assert!(found > 10_000 && missed > 10_000, "{found} {missed}");
}
