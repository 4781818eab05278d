//! Events from the model's types to the implementation's; actions and states back.

use mufasa::offloading::requester as twin;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters,
};
use mufasa_model::services::configuration::{Configuration, Source};

macro_rules! same_names {
    ($($(#[$doc:meta])* $name:ident: $kind:ident = $default:literal;)*) => {
        /// The parameters of a requester in the implementation's type, as that lists them; a name
        /// that only one of the two has does not compile.
        pub fn parameters_to_impl(parameters: &Parameters) -> twin::Parameters {
            let Parameters { $($name),* } = *parameters;
            twin::Parameters { $($name),* }
        }
    };
}

mufasa::requester_parameters!(same_names);

/// A group in the implementation's type.
pub fn group_to_impl(group: Group) -> twin::Group {
    match group {
        Group::Mot => twin::Group::Mot,
        Group::Plan => twin::Group::Plan,
    }
}

/// A set of groups in the implementation's type.
pub fn groups_to_impl(groups: Groups) -> twin::Groups {
    let Groups { mot, plan } = groups;
    twin::Groups { mot, plan }
}

/// An event in the implementation's type.
pub fn event_to_impl(event: &Event) -> twin::Event {
    let Event { t_ns, kind } = *event;
    let kind = match kind {
        EventKind::Offer { station, groups } => {
            twin::EventKind::Offer { station, groups: groups_to_impl(groups) }
        }
        EventKind::Withdraw { station } => twin::EventKind::Withdraw { station },
        EventKind::Lost { station } => twin::EventKind::Lost { station },
        EventKind::Area { groups } => twin::EventKind::Area { groups: groups_to_impl(groups) },
        EventKind::Tick => twin::EventKind::Tick,
        EventKind::Confirm { station, group, session } => {
            twin::EventKind::Confirm { station, group: group_to_impl(group), session }
        }
        EventKind::Reject { station, group, session } => {
            twin::EventKind::Reject { station, group: group_to_impl(group), session }
        }
        EventKind::Data { station, group, session, generated_ns } => {
            twin::EventKind::Data { station, group: group_to_impl(group), session, generated_ns }
        }
        EventKind::Verdict { safe, groups } => {
            twin::EventKind::Verdict { safe, groups: groups_to_impl(groups) }
        }
    };
    twin::Event { t_ns, kind }
}

/// An action in the model's type.
pub fn action_from_impl(action: twin::Action) -> Action {
    match action {
        twin::Action::Request { station, group, session } => {
            Action::Request { station, group: group_from_impl(group), session }
        }
        twin::Action::Release { station, group, session } => {
            Action::Release { station, group: group_from_impl(group), session }
        }
        twin::Action::Activate(group) => Action::Activate(group_from_impl(group)),
        twin::Action::Deactivate(group) => Action::Deactivate(group_from_impl(group)),
        twin::Action::Drop(group) => Action::Drop(group_from_impl(group)),
    }
}

/// The state of a group in the model's type.
pub fn state_from_impl(state: twin::GroupState) -> GroupState {
    match state {
        twin::GroupState::Local => GroupState::Local,
        twin::GroupState::Requested { station, session, deadline_ns } => {
            GroupState::Requested { station, session, deadline_ns }
        }
        twin::GroupState::Remote { station, session } => GroupState::Remote { station, session },
    }
}

/// The source of a group in the model's type.
pub fn source_from_impl(source: twin::Source) -> Source {
    match source {
        twin::Source::Local => Source::Local,
        twin::Source::Remote { station } => Source::Remote { station },
    }
}

/// A configuration in the model's type.
pub fn configuration_from_impl(
    configuration: mufasa::services::configuration::Configuration,
) -> Configuration {
    match configuration {
        mufasa::services::configuration::Configuration::Local => Configuration::Local,
        mufasa::services::configuration::Configuration::MotRemote => Configuration::MotRemote,
        mufasa::services::configuration::Configuration::AllRemote => Configuration::AllRemote,
        mufasa::services::configuration::Configuration::PlanRemote => Configuration::PlanRemote,
    }
}

fn group_from_impl(group: twin::Group) -> Group {
    match group {
        twin::Group::Mot => Group::Mot,
        twin::Group::Plan => Group::Plan,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_times_of_both_crates_are_the_same() {
        assert_eq!(parameters_to_impl(&Parameters::default()), twin::Parameters::default());
    }
}
