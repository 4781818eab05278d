//! Cases that a host writes and that host and target run: the same function, the same text as answer.
#![no_std]
#![forbid(unsafe_code)]

extern crate alloc;

mod bytes;

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use mufasa::cycle::{ValidCycle, check, check_with};
use mufasa::input::cycle::{Cycle, DetectionList};
use mufasa::input::detection_index::{DetectionIndex, Slot};
use mufasa::input::indexes::Indexes;
use mufasa::input::route_index::{Block, RouteIndex};
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::monitor::Calibration;
use mufasa::report::{Outcome, Stage};

pub use bytes::Bytes;

/// What is asked of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Task {
    /// `check`, with nothing that is kept.
    Check,
    /// `check_with`, with the indexes that a vehicle keeps of its route and its earlier lists; that of the
    /// current detections is built within.
    Kept,
    /// Its first part: whether the input is valid.
    Input,
    /// One stage alone, with these indexes and that of the current detections.
    Stage(Stage),
    /// A kind of work of `Monitor::calibrate`, whatever the cycle.
    Calibrate(Calibration),
}

/// A cycle and what is asked of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case<'a> {
    /// The question.
    pub task: Task,
    /// The cycle.
    pub cycle: Cycle<'a>,
}

impl Case<'_> {
    /// The bytes of scratch that it needs, and the answer: every number of it, bit for bit. `measure` calls
    /// what it is given once.
    ///
    /// # Panics
    /// When the input is invalid and the task is not `Check`.
    pub fn answer(&self, measure: &mut dyn FnMut(&mut dyn FnMut())) -> (usize, String) {
        let Self { task, cycle } = self;
        let sizes = Sizes::for_cycle(cycle);
        let mut rows = vec![Row::EMPTY; sizes.rows];
        let mut columns = vec![Column::EMPTY; sizes.columns];
        let mut scratch = Scratch::new(&mut rows, &mut columns);
        if *task == Task::Check {
            let mut report = None;
            measure(&mut || report = Some(check(cycle, &mut scratch)));
            return (sizes.bytes(), format!("{report:?}"));
        }
        let mut blocks = vec![Block::EMPTY; Block::needed(cycle.route.cross_sections.len())];
        let route = RouteIndex::new(cycle.route, &mut blocks).expect("a valid route");
        let route = Some(&route);
        let (mut kept, mut slots) = (Vec::new(), Vec::new());
        if !cycle.detection_history.is_empty() {
            kept = cycle.detection_history.iter().map(index).collect();
            slots = vec![Slot::EMPTY; cycle.detections.map_or(0, |list| list.items.len())];
        }
        if let Task::Calibrate(work) = *task {
            let mut outcome = Outcome::NotScheduled;
            measure(&mut || outcome = work.run());
            return (0, format!("{outcome:?}"));
        }
        if let Task::Stage(stage) = *task {
            if !kept.is_empty() {
                kept.extend(cycle.detections.iter().map(index));
            }
            let indexes = Indexes { route, detections: &kept };
            let valid = ValidCycle::with(cycle, indexes, &scratch).expect("a valid cycle");
            let mut outcome = Outcome::NotScheduled;
            measure(&mut || outcome = valid.stage(stage, &mut scratch));
            return (sizes.bytes(), format!("{outcome:?}"));
        }
        let (mut problem, mut report) = (None, None);
        measure(&mut || {
            let mut all = [DetectionIndex::EMPTY; 5];
            all.iter_mut().zip(&kept).for_each(|(place, index)| *place = *index);
            if let (Some(list), false) = (&cycle.detections, slots.is_empty()) {
                all[4] = DetectionIndex::new(list, &mut slots).expect("valid detections");
            }
            let indexes = Indexes { route, detections: &all };
            match task {
                Task::Input => problem = ValidCycle::with(cycle, indexes, &scratch).err(),
                _ => report = Some(check_with(cycle, &indexes, &mut scratch)),
            }
        });
        (sizes.bytes(), format!("{problem:?} {report:?}"))
    }
}

/// The index of a list, which stays as long as the list: a bench ends soon.
fn index<'a>(list: &DetectionList<'a>) -> DetectionIndex<'a> {
    let slots = vec![Slot::EMPTY; list.items.len()].leak();
    DetectionIndex::new(list, slots).expect("valid detections")
}
