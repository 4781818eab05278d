//! Loops take no more passes than their steps (`spec/4-arithmetic.md#steps`).

use mufasa::input::cycle::Detection;
use mufasa::parts::steps::{assignment, looks};

use super::any::below;
#[cfg(not(kani))]
use crate::kani;

/// Assigning two rows to three columns asks for at most 2 * 2 * 3 costs, the work of that assignment, and gives each
/// row a column where both can have one.
///
/// Domain: costs of 0 to 2, or none. Not covered: more rows and columns, other costs.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(8))]
pub fn verify_an_assignment_asks_for_no_more_costs_than_its_work() {
    let cost = || Some(i64::from(below(4))).filter(|&cost| cost < 3);
    let row = || [cost(), cost(), cost()];
    let costs = [row(), row()];
    let (assigned, asked) = assignment(costs);
    assert!(asked <= 2 * 2 * 3);
    let can = |row: usize, column: usize| costs[row][column].is_some();
    let both = (0..3).any(|one| (0..3).any(|other| one != other && can(0, one) && can(1, other)));
    assert!((assigned == 2) == both);
    kani::cover!(asked == 2 * 3, "each cost once");
    kani::cover!(asked > 2 * 3, "a row gives up its column");
    kani::cover!(assigned == 1, "one row has none");
}

/// A search for what is in a box looks at each item at most once, and at each one that is in the box.
///
/// Domain: three detections at whole metres, 0 to 3 along and 0 to 1 across, boxes with corners there, by the index
/// and by squares. Not covered: other places, more items.
pub fn verify_a_search_looks_at_each_item_at_most_once() {
    let metre = |limit: u8| f64::from(below(limit));
    let range = |limit: u8| [metre(limit), metre(limit)];
    let places = [(); 3].map(|()| [metre(4), metre(2)]);
    let items =
        places.map(|[x, y]| Detection { x, y, cos: 1.0, sin: 0.0, length: 1.0, width: 1.0 });
    let (area, by_index) = ([range(4), range(2)], kani::any());
    let looks = looks(&items, area, by_index).expect("they are valid");
    let is_within = |[x, y]: [f64; 2]| {
        let [[left, right], [bottom, top]] = area;
        left <= x && x <= right && bottom <= y && y <= top
    };
    assert!((0..3).all(|at| looks[at] <= 1 && (looks[at] == 1 || !is_within(places[at]))));
    kani::cover!(looks == [1; 3] && by_index, "all, by the index");
    kani::cover!(looks == [0; 3] && !by_index, "none, by squares");
    kani::cover!(looks[0] == 1 && looks[1] == 0, "one and not the other");
}
