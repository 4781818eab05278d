//! The requester of the implementation against the model's, event by event: actions, states,
//! holds, sources, configurations (`spec/2-offloading.md`).

use std::cell::RefCell;

use mufasa_model::offloading::requester::{Action, Group, GroupState, Requester};
use mufasa_props::differential::runner;
use mufasa_props::refine::{Difference, Pair};
use mufasa_props::strategy::draw::{Draw, long_tape};
use mufasa_props::strategy::requester::{Trace, trace};
use proptest::strategy::Strategy;
use proptest::test_runner::TestCaseError;

/// What the traces reached, so that a property of nothing is seen.
#[derive(Default, Debug)]
struct Seen {
    traces: u64,
    near: u64,
    remote: u64,
    deactivated: u64,
    dropped: u64,
    released: u64,
    held: u64,
}

impl Seen {
    fn count(&mut self, model: &Requester, actions: &[Action]) {
        for action in actions {
            match action {
                Action::Release { .. } => self.released += 1,
                Action::Deactivate(_) => self.deactivated += 1,
                Action::Drop(_) => self.dropped += 1,
                Action::Request { .. } | Action::Activate(_) => {}
            }
        }
        let state = |group: &Group| matches!(model.state(*group), GroupState::Remote { .. });
        self.remote += u64::from(Group::ALL.iter().any(state));
        self.held += u64::from(model.hold_until_ns().is_some());
    }
}

/// REQ-04, REQ-25.
#[test]
fn every_event_has_the_same_actions_and_leads_to_the_same_state() {
    let seen = RefCell::new(Seen::default());
    let traces = long_tape().prop_map(|tape| trace(&mut Draw::new(&tape)));
    let result = runner().run(&traces, |trace| {
        let mut seen = seen.borrow_mut();
        seen.traces += 1;
        seen.near += u64::from(trace.near > 0);
        follow(&trace, &mut seen).map_err(TestCaseError::fail)
    });
    let seen = seen.into_inner();
    println!("requester: {seen:?}");
    if let Err(error) = result {
        panic!("{error}");
    }
    assert!(2 * seen.near >= seen.traces, "too few traces near a border: {seen:?}");
    for count in [seen.remote, seen.deactivated, seen.dropped, seen.released, seen.held] {
        assert!(10 * count >= seen.traces, "something hardly occurs: {seen:?}");
    }
}

fn follow(trace: &Trace, seen: &mut Seen) -> Result<(), String> {
    let told = |difference: Box<Difference>| difference.to_string();
    let mut pair = Pair::new(trace.profile, trace.parameters).map_err(told)?;
    for event in &trace.events {
        let actions = pair.step(event).map_err(told)?;
        if !pair.is_valid() {
            return Err(format!("after {event:?} a state is not valid: {pair:?}"));
        }
        seen.count(pair.model(), &actions);
    }
    Ok(())
}
