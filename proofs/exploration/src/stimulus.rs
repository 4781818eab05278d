//! What can happen to a requester, and the session that a message names.

use mufasa_model::offloading::requester::{EventKind, Group, Groups, Sessions};

/// What can happen to a requester.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stimulus {
    /// A tick of the clock, of which the requester hears nothing.
    TimePasses,
    /// The event `tick`.
    Tick,
    /// The event `offer`.
    Offer(u8, Groups),
    /// The event `withdraw`.
    Withdraw(u8),
    /// The event `lost`.
    Lost(u8),
    /// The event `area`.
    Area(Groups),
    /// The event `verdict`.
    Verdict {
        /// How the cycle was judged.
        safe: bool,
        /// The groups whose remote data it used.
        groups: Groups,
        /// Whether they came from the current sessions of these groups, else from others.
        current: bool,
    },
    /// The event `confirm`.
    Confirm(Named),
    /// The event `reject`.
    Reject(Named),
    /// The event `data`, with an element generated this many ticks ago (-1: in the future).
    Data(Named, i8),
}

impl Stimulus {
    /// The event at a time in ns. `number`: of the session that a message names, if there is such
    /// a one. `None`: it is no event, or cannot come now.
    pub fn event(self, now: i64, number: impl Fn(Named) -> Option<i64>) -> Option<EventKind> {
        let names = |named: Named| Some((i64::from(named.station), named.group, number(named)?));
        Some(match self {
            Self::TimePasses => return None,
            Self::Tick => EventKind::Tick,
            Self::Offer(station, groups) => EventKind::Offer { station: station.into(), groups },
            Self::Withdraw(station) => EventKind::Withdraw { station: station.into() },
            Self::Lost(station) => EventKind::Lost { station: station.into() },
            Self::Area(groups) => EventKind::Area { groups },
            Self::Verdict { safe, groups, current } => {
                let session = |group: Group| {
                    let named = Named { station: 0, group, current };
                    groups.contains(group).then(|| number(named)).flatten()
                };
                let sessions = Sessions { mot: session(Group::Mot), plan: session(Group::Plan) };
                EventKind::Verdict { safe, sessions }
            }
            Self::Confirm(named) => {
                let (station, group, session) = names(named)?;
                EventKind::Confirm { station, group, session }
            }
            Self::Reject(named) => {
                let (station, group, session) = names(named)?;
                EventKind::Reject { station, group, session }
            }
            Self::Data(named, age) => {
                let (station, group, session) = names(named)?;
                let generated_ns = now - i64::from(age);
                EventKind::Data { station, group, session, generated_ns }
            }
        })
    }
}

/// The session that a message names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Named {
    /// The station from which it comes.
    pub station: u8,
    /// Of which group.
    pub group: Group,
    /// Whether the number is that of the group's requested or running session.
    pub current: bool,
}
