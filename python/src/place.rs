//! A monitor together with the memory that it is lent. `self_cell` keeps the two in one value, which
//! Rust alone cannot say: it is small, widely used, and leaves this package without `unsafe`.

use mufasa::input::cycle::{CrossSection, Detection};
use mufasa::input::detection_index::Slot;
use mufasa::input::route_index::Block;
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::monitor::{Memory, Monitor, MonitorError, Settings};
use mufasa::offloading::requester::StationRecord;
use self_cell::{MutBorrow, self_cell};

/// The most detections of a list, and cross sections of a route (`spec/4-arithmetic.md#domain`): the
/// memory is enough for all of the domain, 2.5 MB.
const DETECTIONS: usize = 2048;
const CROSS_SECTIONS: usize = 8192;

/// What the monitor is lent.
pub struct Lent {
    stations: Vec<StationRecord>,
    rows: Vec<Row>,
    columns: Vec<Column>,
    detections: Vec<Detection>,
    slots: Vec<Slot>,
    cross_sections: Vec<CrossSection>,
    blocks: Vec<Block>,
}

self_cell!(
    /// A monitor in memory of its own.
    pub struct Place {
        owner: MutBorrow<Lent>,

        #[not_covariant]
        dependent: Monitor,
    }
);

impl Place {
    /// Everything local, no offers, no route. Errors: as of `Monitor::new`.
    pub fn with(settings: Settings, most_stations: usize) -> Result<Self, MonitorError> {
        let lent = Lent {
            stations: vec![StationRecord::FREE; most_stations],
            rows: vec![Row::default(); Sizes::MAX.rows],
            columns: vec![Column::default(); Sizes::MAX.columns],
            detections: vec![Detection::default(); Memory::detections_for(DETECTIONS)],
            slots: vec![Slot::default(); Memory::slots_for(DETECTIONS)],
            cross_sections: vec![CrossSection::default(); CROSS_SECTIONS],
            blocks: vec![Block::default(); Block::needed(CROSS_SECTIONS)],
        };
        Self::try_new(MutBorrow::new(lent), |lent| {
            let Lent { stations, rows, columns, detections, slots, cross_sections, blocks } =
                lent.borrow_mut();
            let memory =
                Memory { stations, rows, columns, detections, slots, cross_sections, blocks };
            Monitor::new(settings, memory)
        })
    }
}
