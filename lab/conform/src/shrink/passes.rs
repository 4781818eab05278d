//! All passes that make a record small, until nothing changes any more.

use std::time::Instant;

use crate::cases::question::{Damaged, Question};
use crate::shrink::record::Case;
use crate::shrink::{cycle, sequence};

/// The smallest record found until then; `shows` says whether one still shows the class.
pub fn smallest(
    question: &Question,
    until: Instant,
    shows: &mut dyn FnMut(&Question) -> bool,
) -> Question {
    if let Question::Line(Damaged { record, damage, at }) = question {
        let damaged = |record: Question| {
            let record = Box::new(record);
            Question::Line(Damaged { record, damage: *damage, at: *at })
        };
        return damaged(smallest(record, until, &mut |it| shows(&damaged(it.clone()))));
    }
    let Some(value) = question.record() else { return question.clone() };
    let mut case = Case { value, question: question.clone(), shows, until };
    // At most a few times, until nothing changes any more.
    for _ in 0..4 {
        let before = case.value.clone();
        if matches!(case.question, Question::Monitor(_)) {
            sequence::shorter(&mut case);
        }
        case.keys();
        case.lists();
        match case.question {
            Question::Cycle(_) => cycle::smaller(&mut case),
            Question::Monitor(_) => sequence::rounder(&mut case),
            _ => {}
        }
        case.simple();
        if case.value == before {
            break;
        }
    }
    case.question
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use mufasa_model::cycle::check;
    use mufasa_model::input::cycle::Profile;
    use mufasa_model::monitor::messages::EventKind;
    use mufasa_model::report::{FailedStage, Reading, Stage};

    use super::smallest as smallest_until;
    use super::*;
    use crate::cases::generate::Generator;
    use crate::judge::class::Kind;
    use mufasa_records::monitor_answer::answers;

    fn smallest(question: &Question, shows: &mut dyn FnMut(&Question) -> bool) -> Question {
        smallest_until(question, Instant::now() + Duration::from_mins(10), shows)
    }

    /// A list of thousands of what cannot be left out is given up in time.
    #[test]
    fn nothing_is_tried_when_the_time_is_over() {
        let large = first(Kind::Cycle, |it| it.objects() > 1);
        let now = Instant::now();
        assert_eq!(smallest_until(&large, now, &mut |_| true).line("x"), large.line("x"));
    }

    fn first(kind: Kind, wanted: impl Fn(&Question) -> bool) -> Question {
        let generator = Generator { seed: 5, profile: Profile::PAPER, kinds: vec![kind] };
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
        let found = smallest(&first(Kind::Cycle, has_pair), &mut |it| has_pair(it));
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
        let found = smallest(&first(Kind::Cycle, marked), &mut |it| marked(it));
        let Question::Cycle(cycle) = &found else { panic!() };
        let grid = cycle.grid.as_ref().expect("a grid");
        assert_eq!((grid.width, grid.height, grid.occupied.as_slice()), (1, 1, &[1][..]));
    }

    #[test]
    fn of_a_trace_and_a_task_only_what_is_needed_stays() {
        let confirms = |it: &Question| it.line("x").contains("\"confirm\"");
        let found = smallest(&first(Kind::Offloading, confirms), &mut |it| confirms(it));
        assert_eq!(found.objects(), 1);
        let tracks = |it: &Question| it.line("x").contains("\"tracks\"");
        let found = smallest(&first(Kind::Composition, tracks), &mut |it| tracks(it));
        assert_eq!(found.objects(), 1);
    }

    /// The monitor is started later, cycles measure less, and all of an event is at its time.
    #[test]
    fn of_a_sequence_only_what_is_needed_stays() {
        fn comes_out(question: &Question) -> bool {
            let Question::Monitor(sequence) = question else { return false };
            let answers = answers(sequence, Reading::Exact).unwrap_or_default();
            answers.iter().any(|it| it.decision.as_ref().is_some_and(|it| it.tracks.is_some()))
        }
        let is_late = |it: &Question| it.line("x").contains("\"session\": 9") && comes_out(it);
        let found = smallest(&first(Kind::Monitor, is_late), &mut |it| comes_out(it));
        let Question::Monitor(sequence) = &found else { panic!() };
        // An offer, a tick that asks, its confirmation, tracks, and the cycle.
        assert_eq!(sequence.events.len(), 5, "{}", found.line("x"));
        assert!(found.line("x").contains("\"session\": 1"), "{}", found.line("x"));
        let EventKind::Cycle { measured } = &sequence.events[4].kind else { panic!() };
        assert!(measured.grid.is_none() && measured.trajectory.is_none());
    }

    /// Whether stage i fails exactly, but not with a margin of a micrometre.
    fn is_at_the_mean(question: &Question) -> bool {
        let Question::Cycle(cycle) = question else { return false };
        let mut cycle = cycle.clone();
        cycle.parameters.delta = 1e-6;
        let fails = |reading| {
            check(&cycle, reading)
                .is_ok_and(|report| report.failed_stage == Some(FailedStage::Stage(Stage::I)))
        };
        fails(Reading::Exact) && !fails(Reading::Lax)
    }

    #[test]
    fn at_the_threshold_of_stage_i_a_pair_is_enough() {
        let kinds = vec![Kind::Cycle];
        let generator = Generator { seed: 8, profile: Profile::HARDENED, kinds };
        let cases = (0..2000).map(|case| generator.question(case));
        let mut found = cases.filter(|it| it.objects() > 5 && is_at_the_mean(it));
        for _ in 0..10 {
            let large = found.next().expect("ten cases among 2000");
            let small = smallest(&large, &mut |it| is_at_the_mean(it));
            assert!(is_at_the_mean(&small) && small.objects() <= 2, "{}", small.line("x"));
        }
    }
}
