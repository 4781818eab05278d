//! The memory that a monitor is lent for its life (`spec/5-interfaces.md#monitor`).

use crate::input::cycle::{CrossSection, Detection};
use crate::input::detection_index::Slot;
use crate::input::route_index::Block;
use crate::input::scratch::{Column, Row};
use crate::offloading::requester::StationRecord;

/// How many earlier lists of detections are kept.
pub(super) const PLACES: usize = 12;

/// Slices that the monitor has for itself as long as it lives; what they hold before means nothing.
/// What does not fit into them is refused when it comes, and never cut off. Source:
/// `spec/5-interfaces.md#monitor`.
#[derive(Debug)]
pub struct Memory<'a> {
    /// A place for each station that ever offers something; at least one.
    pub stations: &'a mut [StationRecord],
    /// As many as tracks are received at most: `scratch::Sizes::MAX.rows` for all of the domain.
    pub rows: &'a mut [Row],
    /// `miss_budget` more than there are detections, at least as many as tracks:
    /// `scratch::Sizes::MAX.columns` for all of the domain.
    pub columns: &'a mut [Column],
    /// `Memory::detections_for` the most detections of a list; none in the paper profile.
    pub detections: &'a mut [Detection],
    /// `Memory::slots_for` the most detections of a list; none in the paper profile.
    pub slots: &'a mut [Slot],
    /// As many as the longest route has.
    pub cross_sections: &'a mut [CrossSection],
    /// `Block::needed` of that.
    pub blocks: &'a mut [Block],
}

impl Memory<'_> {
    /// How many detections have to be lent so that lists of at most so many can be kept. Source:
    /// `spec/5-interfaces.md#monitor`.
    pub const fn detections_for(most: usize) -> usize {
        most.saturating_mul(PLACES)
    }

    /// How many slots have to be lent so that lists of at most so many can be indexed: those kept, and
    /// the current one. Source: `spec/5-interfaces.md#monitor`.
    pub const fn slots_for(most: usize) -> usize {
        most.saturating_add(Self::detections_for(most))
    }
}
