//! The implementation as it is timed: validation of the input and each stage alone, and whole
//! cycles. As with the peers, the route is indexed outside the measured time, and so are the earlier
//! lists of detections, each in the cycle in which it was current: that of the current ones is built
//! within the time of validation and of whole cycles, where there is a history.

use std::hint::black_box;

use mufasa::cycle::{ValidCycle, check_with};
use mufasa::input::cycle::{Cycle, DetectionList};
use mufasa::input::detection_index::{DetectionIndex, Slot};
use mufasa::input::indexes::Indexes;
use mufasa::input::route_index::{Block, RouteIndex};
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{Outcome, Report, Stage};

/// A cycle with its scratch memory and the index of its route.
pub struct Contestant<'a> {
    cycle: &'a Cycle<'a>,
    /// Kept from earlier cycles.
    indexes: Indexes<'a, 'a>,
    /// For the index of the current detections; none where none is kept.
    slots: Vec<Slot>,
    /// With all indexes.
    valid: ValidCycle<'a, 'a>,
    rows: Vec<Row>,
    columns: Vec<Column>,
}

impl<'a> Contestant<'a> {
    /// With an index of the route and of the detections, which are never freed: a bench ends soon.
    ///
    /// # Panics
    /// When the input is invalid.
    pub fn new(cycle: &'a Cycle<'a>) -> Self {
        let blocks = vec![Block::default(); Block::needed(cycle.route.cross_sections.len())].leak();
        let route = RouteIndex::new(cycle.route, blocks).expect("the workloads are valid input");
        let index = |list: &DetectionList<'a>| {
            let slots = vec![Slot::default(); list.items.len()].leak();
            DetectionIndex::new(list, slots).expect("the workloads are valid input")
        };
        let current = cycle.detections.iter().filter(|_| !cycle.detection_history.is_empty());
        let count = current.clone().map(|list| list.items.len()).sum();
        let lists = cycle.detection_history.iter().chain(current);
        let detections: &[_] = lists.map(index).collect::<Vec<_>>().leak();
        let route = Some(&*Box::leak(Box::new(route)));
        let earlier = detections.get(..cycle.detection_history.len()).unwrap_or(&[]);
        let kept = Indexes { route, detections: earlier };
        Self { indexes: kept, ..Self::with(cycle, Indexes { route, detections }, count) }
    }

    /// With nothing that is kept between cycles, or the index of the route alone.
    ///
    /// # Panics
    /// When the input is invalid.
    pub fn with_index(cycle: &'a Cycle<'a>, index: Option<&'a RouteIndex<'a>>) -> Self {
        Self::with(cycle, Indexes { route: index, detections: &[] }, 0)
    }

    /// With as much scratch as the cycle needs.
    fn with(cycle: &'a Cycle<'a>, indexes: Indexes<'a, 'a>, slots: usize) -> Self {
        let Sizes { rows, columns } = Sizes::for_cycle(cycle);
        let (mut rows, mut columns) =
            (vec![Row::default(); rows], vec![Column::default(); columns]);
        let scratch = Scratch::new(&mut rows, &mut columns);
        let valid = ValidCycle::with(cycle, indexes, &scratch);
        let valid = valid.expect("the workloads are valid input");
        Self { cycle, indexes, slots: vec![Slot::default(); slots], valid, rows, columns }
    }

    /// The report on the cycle as a vehicle asks for it.
    ///
    /// # Panics
    /// Never: the input is valid.
    pub fn check(&mut self) -> Report {
        let mut scratch = Scratch::new(&mut self.rows, &mut self.columns);
        let cycle = black_box(self.cycle);
        let detections = with_current(cycle, self.indexes.detections, &mut self.slots);
        let indexes = Indexes { route: self.indexes.route, detections: &detections };
        check_with(cycle, &indexes, &mut scratch).expect("valid input")
    }

    /// Whether the input is valid.
    ///
    /// # Panics
    /// Never: the input is valid.
    pub fn validate(&mut self) -> bool {
        let scratch = Scratch::new(&mut self.rows, &mut self.columns);
        let cycle = black_box(self.cycle);
        let detections = with_current(cycle, self.indexes.detections, &mut self.slots);
        let indexes = Indexes { route: self.indexes.route, detections: &detections };
        ValidCycle::with(cycle, indexes, &scratch).is_ok()
    }

    /// One stage, the input having been checked before; whether it passes.
    pub fn stage(&mut self, stage: Stage) -> bool {
        self.outcome(stage) == Outcome::Passed
    }

    /// A stage, or the checks of the input.
    ///
    /// # Panics
    /// Never: the input is valid.
    pub fn part(&mut self, stage: Option<Stage>) -> bool {
        if let Some(stage) = stage { self.stage(stage) } else { self.validate() }
    }

    /// The same, and why it fails.
    pub fn outcome(&mut self, stage: Stage) -> Outcome {
        let mut scratch = Scratch::new(&mut self.rows, &mut self.columns);
        black_box(&self.valid).stage(stage, &mut scratch)
    }

    /// Validation and then all five stages, more than any configuration runs in one cycle; ends
    /// at the first that fails.
    pub fn all_stages(&mut self) -> bool {
        self.validate() && Stage::ALL.into_iter().all(|stage| self.stage(stage))
    }
}

/// The indexes that are kept, and that of the current detections, if there is memory for it.
fn with_current<'s>(
    cycle: &Cycle<'s>,
    kept: &[DetectionIndex<'s>],
    slots: &'s mut [Slot],
) -> [DetectionIndex<'s>; 5] {
    let mut indexes = [DetectionIndex::EMPTY; 5];
    let [current, earlier @ ..] = &mut indexes;
    earlier.iter_mut().zip(kept).for_each(|(place, index)| *place = *index);
    if let Some(list) = cycle.detections.filter(|_| !slots.is_empty()) {
        *current = DetectionIndex::new(&list, slots).expect("valid input");
    }
    indexes
}
