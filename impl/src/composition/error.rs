//! What a composition can be refused for (`spec/1-services.md#composition`).

use core::fmt;

use super::{Link, Switch};

/// The first rule that a composition breaks, with what breaks it. Rules are checked in this
/// order, except that too little scratch is seen first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompositionError<'a> {
    /// The scratch memory is too small for the members; lend at least `needed` numbers.
    ScratchTooSmall {
        /// How many numbers are needed.
        needed: usize,
    },
    /// The goal is no service of the set.
    UnknownGoal {
        /// The id.
        goal: &'a str,
    },
    /// A member is no service of the set.
    UnknownMember {
        /// The id.
        member: &'a str,
    },
    /// A member is listed twice.
    RepeatedMember {
        /// The id.
        member: &'a str,
    },
    /// The goal is not among the members.
    GoalIsNoMember {
        /// The id.
        goal: &'a str,
    },
    /// An end of a link is not among the members.
    LinkOfNoMember {
        /// The link.
        link: Link<'a>,
    },
    /// The provider of a link does not guarantee its interface.
    NotGuaranteed {
        /// The link.
        link: Link<'a>,
    },
    /// The consumer of a link does not require its interface.
    NotRequired {
        /// The link.
        link: Link<'a>,
    },
    /// Two links are chosen for one requirement.
    ProvidedTwice {
        /// The service that requires.
        service: &'a str,
        /// The interface.
        requirement: &'a str,
    },
    /// Not closed: no link is chosen for a requirement.
    NotClosed {
        /// The service that requires.
        service: &'a str,
        /// The interface.
        requirement: &'a str,
    },
    /// Not minimal: a member that is not the goal provides no link.
    NotMinimal {
        /// The id.
        member: &'a str,
    },
    /// Two members of one `same_station` list run on different stations.
    SameStation {
        /// The first member of the list, in the order of the members.
        member: &'a str,
        /// The first one that runs elsewhere.
        other: &'a str,
    },
    /// A member of `local_only` does not run on station 0.
    LocalOnly {
        /// The id.
        member: &'a str,
    },
    /// The chosen links go round in a cycle.
    Cyclic {
        /// The first member that is in a cycle or gets something from one.
        member: &'a str,
    },
    /// The stations of a link differ, and it is not among the switches.
    MissingSwitch {
        /// The link.
        link: Link<'a>,
    },
    /// A switch is listed twice.
    RepeatedSwitch {
        /// The switch.
        switch: Switch<'a>,
    },
    /// A switch that no chosen link makes.
    NoSwitch {
        /// The switch.
        switch: Switch<'a>,
    },
    /// The composition is called distributed without a switch, or not although there is one.
    Distributed {
        /// What it is called.
        named: bool,
    },
}

impl fmt::Display for CompositionError<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::ScratchTooSmall { needed } => write!(f, "scratch for {needed} members is needed"),
            Self::UnknownGoal { goal } => write!(f, "goal `{goal}` is no service of the set"),
            Self::UnknownMember { member } => {
                write!(f, "member `{member}` is no service of the set")
            }
            Self::RepeatedMember { member } => write!(f, "member `{member}` is listed twice"),
            Self::GoalIsNoMember { goal } => write!(f, "goal `{goal}` is not among the members"),
            Self::LinkOfNoMember { link } => write!(f, "{link}: both ends must be members"),
            Self::NotGuaranteed { link } => write!(f, "{link}: the provider does not guarantee it"),
            Self::NotRequired { link } => write!(f, "{link}: the consumer does not require it"),
            Self::ProvidedTwice { service, requirement } => {
                write!(f, "`{requirement}` of `{service}` must have exactly one link, not two")
            }
            Self::NotClosed { service, requirement } => {
                write!(f, "not closed: no link for `{requirement}` of `{service}`")
            }
            Self::NotMinimal { member } => {
                write!(f, "not minimal: `{member}` is not the goal and provides nothing")
            }
            Self::SameStation { member, other } => {
                write!(f, "`{member}` and `{other}` must run on the same station")
            }
            Self::LocalOnly { member } => write!(f, "`{member}` must run on station 0"),
            Self::Cyclic { member } => write!(f, "the links into `{member}` come from a cycle"),
            Self::MissingSwitch { link } => write!(f, "{link}: is a device switch, not named"),
            Self::RepeatedSwitch { switch } => write!(f, "{switch}: is named twice"),
            Self::NoSwitch { switch } => write!(f, "{switch}: no chosen link switches so"),
            Self::Distributed { named: true } => f.write_str("distributed without a device switch"),
            Self::Distributed { named: false } => {
                f.write_str("a device switch makes the composition distributed")
            }
        }
    }
}

impl core::error::Error for CompositionError<'_> {}

impl fmt::Display for Link<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "link `{}` from `{}` to `{}`", self.interface, self.provider, self.consumer)
    }
}

impl fmt::Display for Switch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "switch from `{}` to `{}`", self.provider, self.consumer)
    }
}
