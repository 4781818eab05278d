//! Events from the model's types to the implementation's; actions and states back.

use mufasa::offloading::requester as twin;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters, Sessions,
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

        /// The same in the model's type.
        pub fn parameters_from_impl(parameters: &twin::Parameters) -> Parameters {
            let twin::Parameters { $($name),* } = *parameters;
            Parameters { $($name),* }
        }
    };
}

mufasa::requester_parameters!(same_names);

same_variants! {
    /// A group in the implementation's type.
    pub fn group_to_impl(Group) -> twin::Group { Mot, Plan, }

    /// A group in the model's type.
    pub fn group_from_impl(twin::Group) -> Group { Mot, Plan, }

    fn kind_to_impl(EventKind) -> twin::EventKind {
        Offer { station, groups: groups_to_impl },
        Withdraw { station },
        Lost { station },
        Area { groups: groups_to_impl },
        Tick,
        Confirm { station, group: group_to_impl, session },
        Reject { station, group: group_to_impl, session },
        Data { station, group: group_to_impl, session, generated_ns },
        Verdict { safe, sessions: sessions_to_impl },
    }

    /// An action in the model's type.
    pub fn action_from_impl(twin::Action) -> Action {
        Request { station, group: group_from_impl, session },
        Release { station, group: group_from_impl, session },
        Activate(group: group_from_impl),
        Deactivate(group: group_from_impl),
        Drop(group: group_from_impl),
    }

    /// The state of a group in the model's type.
    pub fn state_from_impl(twin::GroupState) -> GroupState {
        Local,
        Requested { station, session, deadline_ns },
        Remote { station, session },
    }

    /// The source of a group in the model's type.
    pub fn source_from_impl(twin::Source) -> Source { Local, Remote { station }, }

    /// A configuration in the model's type.
    pub fn configuration_from_impl(mufasa::services::configuration::Configuration) -> Configuration {
        Local, MotRemote, AllRemote, PlanRemote,
    }
}

/// A set of groups in the implementation's type.
pub fn groups_to_impl(groups: Groups) -> twin::Groups {
    let Groups { mot, plan } = groups;
    twin::Groups { mot, plan }
}

fn sessions_to_impl(sessions: Sessions) -> twin::Sessions {
    let Sessions { mot, plan } = sessions;
    twin::Sessions { mot, plan }
}

/// An event in the implementation's type.
pub fn event_to_impl(event: &Event) -> twin::Event {
    let Event { t_ns, kind } = *event;
    twin::Event { t_ns, kind: kind_to_impl(kind) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_times_of_both_crates_are_the_same() {
        assert_eq!(parameters_to_impl(&Parameters::default()), twin::Parameters::default());
    }
}
