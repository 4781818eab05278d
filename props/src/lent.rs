//! Memory for a monitor, on the heap, for programs that have one.

use mufasa::input::cycle::{CrossSection, Detection};
use mufasa::input::detection_index::Slot;
use mufasa::input::route_index::Block;
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::monitor::Memory;
use mufasa::offloading::requester::StationRecord;

/// What a monitor is lent.
#[derive(Debug)]
pub struct Lent {
    /// Of the requester.
    pub stations: Vec<StationRecord>,
    /// Of the scratch.
    pub rows: Vec<Row>,
    /// Of the scratch.
    pub columns: Vec<Column>,
    /// The lists of the history.
    pub detections: Vec<Detection>,
    /// Their indexes.
    pub slots: Vec<Slot>,
    /// The route.
    pub cross_sections: Vec<CrossSection>,
    /// Its index.
    pub blocks: Vec<Block>,
}

impl Lent {
    /// Enough for so many stations, detections of a list and cross sections of a route, and for all
    /// tracks of the domain.
    pub fn new(stations: usize, detections: usize, cross_sections: usize) -> Self {
        Self {
            stations: vec![StationRecord::FREE; stations],
            rows: vec![Row::default(); Sizes::MAX.rows],
            columns: vec![Column::default(); Sizes::MAX.columns],
            detections: vec![Detection::default(); Memory::detections_for(detections)],
            slots: vec![Slot::default(); Memory::slots_for(detections)],
            cross_sections: vec![CrossSection::default(); cross_sections],
            blocks: vec![Block::default(); Block::needed(cross_sections)],
        }
    }

    /// To be lent for the life of a monitor.
    pub fn memory(&mut self) -> Memory<'_> {
        let Self { stations, rows, columns, detections, slots, cross_sections, blocks } = self;
        Memory { stations, rows, columns, detections, slots, cross_sections, blocks }
    }
}
