//! The memory that a monitor is lent: what does not fit is refused, never cut (`spec/monitor.md#monitor`).

use mufasa::input::cycle::{CrossSection, Route};
use mufasa::input::route_index::Block;
use mufasa::parts::monitor::{Lengths, set_route};

use super::items::position;
#[cfg(not(kani))]
use crate::kani;

/// Memory is taken exactly when it has a place for a station and a track, as many columns as rows, and in a profile that
/// looks back twelve lists of at least one detection, and the slots of these and of one more. What is said to fit then
/// does [MON-21].
///
/// Domain: all lengths of 28 bits, more than 32 address, both kinds of profile. Not covered: that the lists are where they
/// are looked for.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(6))]
pub fn verify_too_little_memory_is_refused() {
    let given = Lengths {
        stations: length(),
        rows: length(),
        columns: length(),
        detections: length(),
        slots: length(),
    };
    let looks_back = kani::any();
    let wide = |length: usize| length as u64;
    let found = given.capacity(looks_back);
    let has_places = given.stations > 0 && given.rows > 0 && given.columns >= given.rows;
    if let Ok(capacity) = found {
        let most = wide(capacity);
        assert!(has_places && (looks_back == (capacity > 0)));
        assert!(!looks_back || 12 * most <= wide(given.detections));
        assert!(!looks_back || 12 * most + 12 > wide(given.detections));
        assert!(13 * most <= wide(given.slots));
    } else {
        // 13 slots for each twelfth of the detections.
        let is_short = looks_back
            && (given.detections < 12
                || 12 * wide(given.slots) < 13 * (wide(given.detections) - 11));
        let needs = looks_back && wide(given.slots) < 13 * (wide(given.detections) / 12);
        assert!(!has_places || is_short || needs);
    }
    kani::cover!(found.is_ok() && looks_back, "enough");
    kani::cover!(found.is_ok() && !looks_back && given.slots == 0, "enough for the paper");
    kani::cover!(found.is_err() && has_places, "too little for detections");
}

/// A route that does not fit is refused, and the monitor has the one before, whole [MON-18].
///
/// Domain: a route of two cross sections in two places, another one of three, any numbers of 64 bits. Not covered: other
/// numbers of them.
pub fn verify_a_route_that_does_not_fit_is_refused() {
    let (first, second) = ([any_place(), any_place()], [any_place(), any_place(), any_place()]);
    let (mut places, mut blocks) = (first, [Block::EMPTY; 2]);
    let (was_closed, closed) = (kani::any(), kani::any());
    let mut is_closed = was_closed;
    let route = Route { closed, cross_sections: &second };
    let (is_taken, count) = set_route(&mut places, &mut blocks, &mut is_closed, &route);
    assert!(!is_taken && count == 2 && is_closed == was_closed);
    assert!(is_copy(places[0], first[0]) && is_copy(places[1], first[1]));
    kani::cover!(closed != was_closed, "another one");
}

/// A route whose index does not fit is refused, and the monitor has the one before, whole [MON-18].
///
/// Domain: routes of two cross sections, two places, a block less than needed, any numbers of 64 bits. Not covered: other
/// numbers of them.
pub fn verify_a_route_whose_index_does_not_fit_is_refused() {
    let (first, second) = ([any_place(), any_place()], [any_place(), any_place()]);
    let (mut places, mut blocks) = (first, [Block::EMPTY; 1]);
    let (was_closed, closed) = (kani::any(), kani::any());
    let mut is_closed = was_closed;
    let route = Route { closed, cross_sections: &second };
    let (is_taken, count) = set_route(&mut places, &mut blocks, &mut is_closed, &route);
    assert!(!is_taken && count == 2 && is_closed == was_closed);
    assert!(is_copy(places[0], first[0]) && is_copy(places[1], first[1]));
    kani::cover!(closed != was_closed, "another one");
}

/// A route that is taken is kept whole; one that is not, because it is invalid, changes nothing [MON-18].
///
/// Domain: routes of two cross sections, memory for them, any numbers of 64 bits. Not covered: other numbers of them; what
/// is in the index.
pub fn verify_a_route_is_kept_whole() {
    let (first, second) = ([any_place(), any_place()], [any_place(), any_place()]);
    let (mut places, mut blocks) = (first, [Block::EMPTY; 2]);
    let (was_closed, closed) = (kani::any(), kani::any());
    let mut is_closed = was_closed;
    let route = Route { closed, cross_sections: &second };
    let (is_taken, count) = set_route(&mut places, &mut blocks, &mut is_closed, &route);
    let expected = if is_taken { (second, closed) } else { (first, was_closed) };
    assert!(count == 2 && is_closed == expected.1);
    assert!(is_copy(places[0], expected.0[0]) && is_copy(places[1], expected.0[1]));
    kani::cover!(is_taken, "taken");
    kani::cover!(!is_taken, "invalid");
}

/// Bit by bit, so that any number is compared.
fn is_copy(kept: CrossSection, given: CrossSection) -> bool {
    let same = |one: f64, other: f64| one.to_bits() == other.to_bits();
    same(kept.x, given.x)
        && same(kept.y, given.y)
        && same(kept.left[0], given.left[0])
        && same(kept.left[1], given.left[1])
        && same(kept.right[0], given.right[0])
        && same(kept.right[1], given.right[1])
}

fn any_place() -> CrossSection {
    CrossSection {
        x: position(),
        y: position(),
        left: [position(), position()],
        right: [position(), position()],
    }
}

/// More of anything that is lent than an address of 32 bits reaches.
const MOST: u64 = (1 << 28) - 1;

fn length() -> usize {
    let value: u64 = kani::any();
    usize::try_from(value & MOST).unwrap_or(0)
}
