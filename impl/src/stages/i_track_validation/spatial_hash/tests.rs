use std::vec;
use std::vec::Vec;

use super::ColumnsByCell;
use crate::input::scratch::{Column, NONE};
use crate::random::Random;

fn members(columns: &[Column], list: usize) -> Vec<usize> {
    let index = |at: u16| (at != NONE).then(|| usize::from(at));
    core::iter::successors(index(columns[list].near.head), |&at| index(columns[at].near.next))
        .collect()
}

/// Every column is met once, and none nearer than the bounds said until then.
#[test]
fn lists_come_by_distance() {
    let mut random = Random::new(11);
    let mut tight = 0;
    for case in 0..2_000 {
        let count = 1 + random.below(40) as usize;
        let scale = [1e-9, 1.0, 1e4, 3e7][case % 4];
        let mut place =
            || [(); 2].map(|()| (random.below(1000) as f64 / 999.0 - 0.5) * scale + 1.0 / 3.0);
        let mut places: Vec<_> = (0..count).map(|_| place()).collect();
        let (q, spare) = (place(), random.below(3) as usize);
        if case % 5 == 0 {
            let first = places[0];
            places.fill(first);
        }
        let mut columns = vec![Column::default(); count + spare];
        let cells = ColumnsByCell::new(&mut columns, |index| places.get(index).copied());
        let (mut met, mut before) = (Vec::new(), 0.0);
        for (bound, lists) in cells.around(q) {
            for (list, index) in lists.flat_map(|list| {
                members(&columns, list).into_iter().map(move |index| (list, index))
            }) {
                met.push(index);
                if let Some(at) = places.get(index) {
                    let apart = (at[0] - q[0]).hypot(at[1] - q[1]);
                    assert!(apart >= bound && bound >= before, "{places:?} {q:?} {bound}");
                    tight += usize::from(apart < 2.0 * bound);
                } else {
                    assert_eq!(list, 0);
                }
            }
            before = f64::max(before, bound);
        }
        met.sort_unstable();
        assert_eq!(met, (0..count + spare).collect::<Vec<_>>());
    }
    assert!(tight > 1_000, "the bounds say something: {tight}");
}
