//! The memory that a vehicle lends to its monitor.

use mufasa_props::lent::Lent;

use crate::play::Played;

/// Most stations that are remembered.
pub const STATIONS_MAX: usize = 16;

/// Enough for every cycle of a drive.
pub fn lent(played: &Played) -> Lent {
    let cycles = || (0..played.count()).filter_map(|index| played.cycle(index));
    let most = cycles().filter_map(|it| it.detections.as_ref()).map(|it| it.items.len()).max();
    let longest = cycles().map(|it| it.route.cross_sections.len()).max();
    Lent::new(STATIONS_MAX, most.unwrap_or(0).max(1), longest.unwrap_or(0))
}
