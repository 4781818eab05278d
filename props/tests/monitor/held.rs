//! What came to a monitor and was accepted.

use mufasa::monitor::Accepted;
use mufasa_props::strategy::draw::Draw;

use super::plain::Received;

/// An accepted element, a copy of it, and how many unsafe cycles there were before it.
pub struct Held<T> {
    pub token: Accepted<Vec<T>>,
    pub copy: Received<T>,
    pub fallbacks: u32,
}

/// Mostly the last one.
pub fn choose<'h, T>(draw: &mut Draw<'_>, held: &'h [Held<T>]) -> Option<&'h Held<T>> {
    match draw.below(8) {
        6 => held.get(draw.below(held.len().max(1))),
        7 => None,
        _ => held.last(),
    }
}
