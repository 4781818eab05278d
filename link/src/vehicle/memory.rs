//! The memory that a vehicle lends to its monitor.

use mufasa::input::cycle::{CrossSection, Detection};
use mufasa::input::detection_index::Slot;
use mufasa::input::route_index::Block;
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::monitor::Memory;
use mufasa::offloading::requester::StationRecord;

use crate::play::Played;

/// Most stations that are remembered.
pub const STATIONS_MAX: usize = 16;

/// All that the monitor of a drive needs.
#[derive(Debug)]
pub struct Lent {
    stations: Vec<StationRecord>,
    rows: Vec<Row>,
    columns: Vec<Column>,
    detections: Vec<Detection>,
    slots: Vec<Slot>,
    cross_sections: Vec<CrossSection>,
    blocks: Vec<Block>,
}

impl Lent {
    /// Enough for every cycle of a drive.
    pub fn new(played: &Played) -> Self {
        let cycles = || (0..played.count()).filter_map(|index| played.cycle(index));
        let most = cycles().filter_map(|it| it.detections.as_ref()).map(|it| it.items.len()).max();
        let most = most.unwrap_or(0).max(1);
        let longest = cycles().map(|it| it.route.cross_sections.len()).max().unwrap_or(0);
        Self {
            stations: vec![StationRecord::FREE; STATIONS_MAX],
            rows: vec![Row::default(); Sizes::MAX.rows],
            columns: vec![Column::default(); Sizes::MAX.columns],
            detections: vec![Detection::default(); Memory::detections_for(most)],
            slots: vec![Slot::default(); Memory::slots_for(most)],
            cross_sections: vec![CrossSection::default(); longest],
            blocks: vec![Block::default(); Block::needed(longest)],
        }
    }

    /// To be lent for the life of a monitor.
    pub fn memory(&mut self) -> Memory<'_> {
        let Self { stations, rows, columns, detections, slots, cross_sections, blocks } = self;
        Memory { stations, rows, columns, detections, slots, cross_sections, blocks }
    }
}
