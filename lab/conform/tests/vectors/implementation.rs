//! A trace, by the implementation and by the model. That both agree with every vector is asked in
//! `props/tests/vectors.rs`.

use mufasa::offloading::requester as twin;
use mufasa_model::offloading::requester::{Action, Event, GroupState};
use mufasa_props::bridge;
use mufasa_records::Trace;

/// Places of the implementation's station table; no trace names more stations.
const STATIONS: usize = 16;

/// State of both groups, hold and actions after an event.
pub type Step = ([GroupState; 2], Option<i64>, Vec<Action>);

/// What the implementation's requester does with a trace whose events `change` may alter or drop.
pub fn run(trace: &Trace, mut change: impl FnMut(&Event) -> Option<Event>) -> Vec<Step> {
    let mut table = [twin::StationRecord::FREE; STATIONS];
    let profile = bridge::profile_to_impl(trace.profile);
    let parameters = bridge::parameters_to_impl(&trace.parameters);
    let mut requester =
        twin::Requester::new(profile, parameters, &mut table).expect("the times are in the domain");
    let mut steps = Vec::new();
    for event in &trace.events {
        let actions = change(event).map_or_else(Vec::new, |event| {
            let found = requester.step(&bridge::event_to_impl(&event)).expect("the table has room");
            found.iter().copied().map(bridge::action_from_impl).collect()
        });
        let states = twin::Group::ALL.map(|group| bridge::state_from_impl(requester.state(group)));
        steps.push((states, requester.hold_until_ns(), actions));
    }
    steps
}

/// What the model's requester does with a trace.
pub fn exact(trace: &Trace) -> Vec<Step> {
    use mufasa_model::offloading::requester::{Group, Requester};
    let mut requester = Requester::new(trace.profile, trace.parameters);
    let step = |event| {
        let actions = requester.step(event);
        (Group::ALL.map(|group| requester.state(group)), requester.hold_until_ns(), actions)
    };
    trace.events.iter().map(step).collect()
}
