//! The memory that a monitor is lent for its life (`spec/monitor.md#monitor`).

use super::settings::MonitorError;
use crate::input::cycle::{CrossSection, Detection};
use crate::input::detection_index::Slot;
use crate::input::route_index::Block;
use crate::input::scratch::{Column, Row};
use crate::offloading::requester::StationRecord;

/// How many earlier lists of detections are kept.
// MON-13
pub(crate) const PLACES: usize = 12;

/// Slices that the monitor has for itself as long as it lives; what they hold before means nothing.
/// What does not fit into them is refused when it comes, and never cut off.
///
/// No heap is needed: of each element there is a constant, so that the memory may stand in a static or on the
/// stack. Its size is what is written down (here 81 kB: 64 tracks, 64 detections, 256 cross sections), and
/// the monitor is small beside it. No call of the monitor takes more than 48 KiB of stack, whatever its input (`scripts/stack`, for
/// two processors of vehicles).
///
/// ```
/// use std::sync::Mutex;
///
/// use mufasa::input::cycle::{CrossSection, Detection};
/// use mufasa::input::detection_index::Slot;
/// use mufasa::input::route_index::Block;
/// use mufasa::input::scratch::{Column, Row};
/// use mufasa::monitor::{Memory, Monitor, Settings};
/// use mufasa::offloading::requester::StationRecord;
///
/// const TRACKS: usize = 64;
/// const DETECTIONS: usize = 64;
/// const CROSS_SECTIONS: usize = 256;
/// // The default of `miss_budget` is 4.
/// const COLUMNS: usize = DETECTIONS + 4;
///
/// struct Lent {
///     stations: [StationRecord; 8],
///     rows: [Row; TRACKS],
///     columns: [Column; COLUMNS],
///     detections: [Detection; Memory::detections_for(DETECTIONS)],
///     slots: [Slot; Memory::slots_for(DETECTIONS)],
///     cross_sections: [CrossSection; CROSS_SECTIONS],
///     blocks: [Block; Block::needed(CROSS_SECTIONS)],
/// }
///
/// impl Lent {
///     const EMPTY: Self = Self {
///         stations: [StationRecord::FREE; 8],
///         rows: [Row::EMPTY; TRACKS],
///         columns: [Column::EMPTY; COLUMNS],
///         detections: [Detection::EMPTY; Memory::detections_for(DETECTIONS)],
///         slots: [Slot::EMPTY; Memory::slots_for(DETECTIONS)],
///         cross_sections: [CrossSection::EMPTY; CROSS_SECTIONS],
///         blocks: [Block::EMPTY; Block::needed(CROSS_SECTIONS)],
///     };
///
///     fn memory(&mut self) -> Memory<'_> {
///         let Self { stations, rows, columns, detections, slots, cross_sections, blocks } = self;
///         Memory { stations, rows, columns, detections, slots, cross_sections, blocks }
///     }
/// }
///
/// // In a static; without `std` any lock whose constructor is `const` will do.
/// static LENT: Mutex<Lent> = Mutex::new(Lent::EMPTY);
///
/// let settings = Settings::new(std::time::Duration::from_millis(50));
/// let mut lent = LENT.lock()?;
/// let monitor = Monitor::new(settings, lent.memory())?;
///
/// // On the stack.
/// let mut lent = Lent::EMPTY;
/// let other = Monitor::new(settings, lent.memory())?;
///
/// assert_eq!(size_of::<Lent>(), 80_864);
/// assert!(size_of_val(&monitor) < 2136 && size_of_val(&other) < 2136);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Source: `spec/monitor.md#monitor`.
#[derive(Debug)]
// IMPL-08
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
    /// `spec/monitor.md#monitor`.
    pub const fn detections_for(most: usize) -> usize {
        most.saturating_mul(PLACES)
    }

    /// How many slots have to be lent so that lists of at most so many can be indexed: those kept, and
    /// the current one. Source: `spec/monitor.md#monitor`.
    pub const fn slots_for(most: usize) -> usize {
        most.saturating_add(Self::detections_for(most))
    }
}

/// How many there are of what a monitor is lent first. Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lengths {
    /// Stations.
    pub stations: usize,
    /// Rows.
    pub rows: usize,
    /// Columns.
    pub columns: usize,
    /// Detections.
    pub detections: usize,
    /// Slots.
    pub slots: usize,
}

impl Lengths {
    /// The most detections of a list that can be kept; 0 in a profile that does not look back.
    ///
    /// Errors: too little memory. Source: `spec/monitor.md#monitor`.
    pub fn capacity(self, looks_back: bool) -> Result<usize, MonitorError> {
        let Self { stations, rows, columns, detections, slots } = self;
        let capacity = if looks_back { detections.wrapping_div(PLACES) } else { 0 };
        let least = if looks_back { PLACES } else { 0 };
        // MON-21
        for (field, needed, given) in [
            ("stations", 1, stations),
            ("detections", least, detections),
            ("rows", 1, rows),
            ("columns", rows, columns),
            ("slots", Memory::slots_for(capacity), slots),
        ] {
            if given < needed {
                return Err(MonitorError::Memory { field, needed, given });
            }
        }
        Ok(capacity)
    }
}
