//! The requester of the implementation against the model's, event by event: actions, states,
//! holds, sources, configurations (`spec/2-offloading.md`).

use std::cell::RefCell;

use mufasa::offloading::requester as implementation;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Parameters, Requester,
};
use mufasa_props::bridge;
use mufasa_props::differential::runner;
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
    let mut model = Requester::new(trace.profile, trace.parameters);
    let mut table = [implementation::StationRecord::FREE; 8];
    let profile = bridge::profile_to_impl(trace.profile);
    let parameters = bridge::parameters_to_impl(&trace.parameters);
    let mut twin = implementation::Requester::new(profile, parameters, &mut table)
        .map_err(|error| error.to_string())?;
    for (index, event) in trace.events.iter().enumerate() {
        let expected = model.step(event);
        let found = twin.step(&bridge::event_to_impl(event)).map_err(|error| error.to_string())?;
        let found: Vec<Action> = found.iter().copied().map(bridge::action_from_impl).collect();
        let told = |what: &str, expected: &dyn std::fmt::Debug, found: &dyn std::fmt::Debug| {
            format!("event {index}: {what} should be {expected:?}, is {found:?}")
        };
        if found != expected {
            return Err(told("actions", &expected, &found));
        }
        for group in Group::ALL {
            let twin_group = bridge::group_to_impl(group);
            let state = bridge::state_from_impl(twin.state(twin_group));
            if state != model.state(group) {
                return Err(told("state", &model.state(group), &state));
            }
            let source = bridge::source_from_impl(twin.source(twin_group));
            if source != model.source(group) {
                return Err(told("source", &model.source(group), &source));
            }
        }
        if twin.hold_until_ns() != model.hold_until_ns() {
            return Err(told("hold", &model.hold_until_ns(), &twin.hold_until_ns()));
        }
        let configuration = bridge::configuration_from_impl(twin.configuration());
        if configuration != model.configuration() {
            return Err(told("configuration", &model.configuration(), &configuration));
        }
        let dropped: u64 = implementation::Group::ALL.iter().map(|g| twin.dropped(*g)).sum();
        if dropped != model.foreign_data() {
            return Err(told("count of dropped data", &model.foreign_data(), &dropped));
        }
        if !twin.is_valid() || !model.is_valid() {
            return Err(told("validity", &model.is_valid(), &twin.is_valid()));
        }
        seen.count(&model, &expected);
    }
    Ok(())
}

/// A full table is an error that names the station and leaves the state as it was; the model,
/// which has room for all, goes on.
#[test]
fn a_full_table_is_an_error_and_changes_nothing() {
    let mut table = [implementation::StationRecord::FREE; 1];
    let parameters = bridge::parameters_to_impl(&Parameters::default());
    let profile = mufasa::input::profile::Profile::Hardened;
    let mut twin = implementation::Requester::new(profile, parameters, &mut table)
        .expect("the defaults are in the domain");
    let groups = mufasa_model::offloading::requester::Groups::ALL;
    let offer = |station| Event { t_ns: 0, kind: EventKind::Offer { station, groups } };
    assert!(twin.step(&bridge::event_to_impl(&offer(1))).is_ok());
    let error = twin.step(&bridge::event_to_impl(&offer(2))).expect_err("there is one place");
    assert_eq!(error, implementation::RequesterError::TableFull { station: 2, capacity: 1 });
    let tick = bridge::event_to_impl(&Event { t_ns: 1, kind: EventKind::Tick });
    let asked = twin.step(&tick).expect("a tick names no station");
    assert!(
        asked
            .iter()
            .all(|action| matches!(action, implementation::Action::Request { station: 1, .. }))
    );
}
