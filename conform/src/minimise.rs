//! Records made smaller and rounder while they still show what they showed.

mod cycle;
mod numbers;
mod pair;

use super::question::{Damaged, Question};
use mufasa_model::offloading::requester::Parameters;
use mufasa_model::services::orchestrator::Task;
use mufasa_records::Trace;

/// The smallest record found; `shows` says whether one still shows the class.
pub fn question(question: &Question, shows: &mut dyn FnMut(&Question) -> bool) -> Question {
    match question {
        Question::Cycle(cycle) => {
            let mut cycle = Case {
                value: cycle.as_ref().clone(),
                shows: &mut |it| shows(&Question::Cycle(Box::new(it.clone()))),
            };
            cycle.until_stable(cycle::smaller);
            Question::Cycle(Box::new(cycle.value))
        }
        Question::Offloading(trace) => {
            let mut trace = Case {
                value: trace.clone(),
                shows: &mut |it| shows(&Question::Offloading(it.clone())),
            };
            trace.until_stable(smaller_trace);
            Question::Offloading(trace.value)
        }
        Question::Composition(task) => {
            let mut task = Case {
                value: task.clone(),
                shows: &mut |it| shows(&Question::Composition(it.clone())),
            };
            task.until_stable(smaller_task);
            Question::Composition(task.value)
        }
        Question::Line(Damaged { record, damage, at }) => {
            let damaged = |record: Question| {
                let record = Box::new(record);
                Question::Line(Damaged { record, damage: *damage, at: *at })
            };
            let smallest = self::question(record, &mut |it| shows(&damaged(it.clone())));
            damaged(smallest)
        }
    }
}

/// A record that shows the class.
struct Case<'a, T> {
    value: T,
    shows: &'a mut dyn FnMut(&T) -> bool,
}

impl<T: Clone + PartialEq> Case<'_, T> {
    /// Makes a change if the record then still shows the class.
    fn change(&mut self, change: impl FnOnce(&mut T)) -> bool {
        let mut changed = self.value.clone();
        change(&mut changed);
        // NaN is unlike itself: such a record is tried again, which costs but does no harm.
        if changed != self.value && (self.shows)(&changed) {
            self.value = changed;
            return true;
        }
        false
    }

    /// Removes as many items of a list as possible, in chunks, from the end.
    fn thin<I>(&mut self, list: impl Fn(&mut T) -> Option<&mut Vec<I>>) {
        let length = |value: &mut T| list(value).map_or(0, |items| items.len());
        let mut size = length(&mut self.value);
        while size > 0 {
            let mut end = length(&mut self.value);
            while end > 0 {
                let start = end.saturating_sub(size);
                self.change(|value| {
                    if let Some(items) = list(value) {
                        items.drain(start..end.min(items.len()));
                    }
                });
                end = start;
            }
            size /= 2;
        }
    }

    /// Goes over the record until nothing changes any more, at most a few times.
    fn until_stable(&mut self, pass: fn(&mut Self)) {
        for _ in 0..4 {
            let before = self.value.clone();
            pass(self);
            if self.value == before {
                return;
            }
        }
    }
}

fn smaller_trace(case: &mut Case<'_, Trace>) {
    case.thin(|trace| Some(&mut trace.events));
    let usual = Parameters::default();
    case.change(|trace| trace.parameters = usual);
    case.change(|trace| trace.parameters.t_wait_ns = usual.t_wait_ns);
    case.change(|trace| trace.parameters.request_timeout_ns = usual.request_timeout_ns);
    case.change(|trace| trace.parameters.l_max_ns = usual.l_max_ns);
    case.change(|trace| trace.parameters.dt_max_ns = usual.dt_max_ns);
    case.change(|trace| trace.parameters.qos_hold = usual.qos_hold);
    // All times at once, then one by one: 0, or the time of the event before.
    case.change(|trace| trace.events.iter_mut().for_each(|event| event.t_ns = 0));
    for index in 0..case.value.events.len() {
        let before = index.checked_sub(1).map_or(0, |i| case.value.events[i].t_ns);
        let _ = case.change(|trace| trace.events[index].t_ns = 0)
            || case.change(|trace| trace.events[index].t_ns = before)
            || case.change(|trace| trace.events[index].t_ns = before.saturating_add(1));
    }
}

fn smaller_task(case: &mut Case<'_, Task>) {
    case.thin(|task| Some(&mut task.same_station));
    case.thin(|task| Some(&mut task.local_only));
    case.thin(|task| Some(&mut task.services));
    for index in 0..case.value.same_station.len() {
        case.thin(|task| task.same_station.get_mut(index));
    }
    for index in 0..case.value.services.len() {
        case.thin(|task| task.services.get_mut(index).map(|it| &mut it.requires));
        case.thin(|task| task.services.get_mut(index).map(|it| &mut it.guarantees));
        case.change(|task| task.services[index].station = 0);
    }
}

#[cfg(test)]
mod tests {
    use mufasa_model::input::cycle::Profile;

    use super::super::class::Kind;
    use super::super::generate::Generator;
    use super::*;

    fn first(kind: Kind, wanted: impl Fn(&Question) -> bool) -> Question {
        let generator = Generator { seed: 5, profile: Profile::Paper, kinds: vec![kind] };
        let mut cases = (0..2000).map(|case| generator.question(case));
        cases.find(|it| wanted(it)).expect("a case among 2000")
    }

    #[test]
    fn of_a_cycle_only_what_is_needed_stays() {
        fn has_pair(question: &Question) -> bool {
            let Question::Cycle(cycle) = question else { return false };
            let tracks = cycle.tracks.as_ref().map_or(0, |list| list.items.len());
            let seen = cycle.detections.as_ref().map_or(0, |list| list.items.len());
            tracks >= 2 && seen >= 1
        }
        let found = question(&first(Kind::Cycle, has_pair), &mut |it| has_pair(it));
        assert!(has_pair(&found));
        assert_eq!(found.objects(), 3);
        let Question::Cycle(cycle) = &found else { panic!() };
        assert!(cycle.trajectory.is_none() && cycle.grid.is_none() && cycle.lead.is_none());
        assert_eq!((cycle.ego.x.to_bits(), cycle.ego.cos.to_bits()), (0, 1.0_f64.to_bits()));
    }

    #[test]
    fn of_a_grid_one_cell_stays() {
        fn marked(question: &Question) -> bool {
            let Question::Cycle(cycle) = question else { return false };
            cycle.grid.as_ref().is_some_and(|grid| grid.occupied.iter().any(|byte| *byte != 0))
        }
        let found = question(&first(Kind::Cycle, marked), &mut |it| marked(it));
        let Question::Cycle(cycle) = &found else { panic!() };
        let grid = cycle.grid.as_ref().expect("a grid");
        assert_eq!((grid.width, grid.height, grid.occupied.as_slice()), (1, 1, &[1][..]));
    }

    #[test]
    fn of_a_trace_and_a_task_only_what_is_needed_stays() {
        let confirms = |it: &Question| it.line("x").contains("\"confirm\"");
        let found = question(&first(Kind::Offloading, confirms), &mut |it| confirms(it));
        assert_eq!(found.objects(), 1);
        let tracks = |it: &Question| it.line("x").contains("\"tracks\"");
        let found = question(&first(Kind::Composition, tracks), &mut |it| tracks(it));
        assert_eq!(found.objects(), 1);
    }
}
