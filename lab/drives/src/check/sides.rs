//! The two requesters behind one face, in the model's types.

use mufasa::offloading::requester as implementation;
use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{
    Action, Event, Group, GroupState, Parameters, Requester,
};
use mufasa_props::bridge;

/// A requester, the model's or the implementation's.
pub trait Side {
    /// Takes one event; `Err` is a complaint in words.
    fn step(&mut self, event: &Event) -> Result<Vec<Action>, String>;
    /// State of a group.
    fn state(&self, group: Group) -> GroupState;
    /// End of the waiting time.
    fn hold_until_ns(&self) -> Option<i64>;
}

impl Side for Requester {
    fn step(&mut self, event: &Event) -> Result<Vec<Action>, String> {
        Ok(Self::step(self, event))
    }

    fn state(&self, group: Group) -> GroupState {
        Self::state(self, group)
    }

    fn hold_until_ns(&self) -> Option<i64> {
        Self::hold_until_ns(self)
    }
}

impl Side for implementation::Requester<'_> {
    fn step(&mut self, event: &Event) -> Result<Vec<Action>, String> {
        let event = bridge::event_to_impl(event);
        let actions = Self::step(self, &event).map_err(|error| error.to_string())?;
        Ok(actions.iter().map(|action| bridge::action_from_impl(*action)).collect())
    }

    fn state(&self, group: Group) -> GroupState {
        bridge::state_from_impl(Self::state(self, bridge::group_to_impl(group)))
    }

    fn hold_until_ns(&self) -> Option<i64> {
        Self::hold_until_ns(self)
    }
}

/// Memory of the implementation's requester; the only station of a drive needs one record.
pub type Table = [implementation::StationRecord; 1];

/// The implementation's requester; `Err` is a complaint in words.
pub fn implementation<'t>(
    profile: Profile,
    parameters: &Parameters,
    table: &'t mut Table,
) -> Result<implementation::Requester<'t>, String> {
    let profile = bridge::profile_to_impl(profile);
    let parameters = bridge::parameters_to_impl(parameters);
    let requester = implementation::Requester::new(profile, parameters, table);
    requester.map_err(|error| error.to_string())
}
