//! Which element of a group a cycle uses, and why one is dropped (`spec/monitor.md`, what a cycle uses).

use super::messages::{Dropped, Verified};
use crate::offloading::quality_of_service::{is_violation, latency_ns};
use crate::offloading::requester::{Parameters, Session};

/// An element that the requester used.
#[derive(Clone, Debug, PartialEq)]
pub struct Element<T> {
    /// From whom.
    pub station: i64,
    /// In which session.
    pub session: i64,
    /// The list or trajectory.
    pub content: T,
}

/// What an element that arrives says of itself.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// When it arrives, ns.
    pub t_ns: i64,
    /// From whom.
    pub station: i64,
    /// In which session.
    pub session: i64,
    /// When it was generated, ns.
    pub generated_ns: i64,
}

/// Whether data are current in a cycle (SCHED-12).
pub fn is_current(now_ns: i64, stamp_ns: i64, max_age_ns: i64) -> bool {
    let age = i128::from(now_ns) - i128::from(stamp_ns);
    (0..=i128::from(max_age_ns)).contains(&age)
}

/// The last element of the running session. [MON-07] [MON-08]
pub fn of_session<T>(last: Option<&Element<T>>, running: Option<Session>) -> Option<&Element<T>> {
    let session = running?.number;
    last.filter(|element| element.session == session)
}

impl<T> Element<T> {
    /// The element as it comes out.
    pub fn verified(&self, stamp_ns: i64) -> Verified {
        Verified { stamp_ns, remote: Some((self.station, self.session)) }
    }
}

impl Arrival {
    /// An element that arrives at this time.
    pub fn new(t_ns: i64, station: i64, session: i64, generated_ns: i64) -> Self {
        Self { t_ns, station, session, generated_ns }
    }

    /// The element, with its content.
    pub fn element<T>(self, content: T) -> Element<T> {
        Element { station: self.station, session: self.session, content }
    }

    /// Whether the element is of the running session.
    pub fn is_of(self, running: Option<Session>) -> bool {
        running.is_some_and(|it| (it.station, it.number) == (self.station, self.session))
    }

    /// Why the monitor drops an element of the running session before the requester hears of it, so that
    /// it does not count as an arrival. The times are `l_max` and `max_age`. [MON-20] [MON-30] [MON-32]
    pub fn unheard(
        self,
        stamp_ns: i64,
        fits: bool,
        starved: bool,
        [l_max_ns, max_age_ns]: [i64; 2],
    ) -> Option<Dropped> {
        let latency = latency_ns(self.t_ns, self.generated_ns);
        let is_in_time = (0..=i128::from(l_max_ns)).contains(&latency);
        let age = i128::from(self.t_ns) - i128::from(stamp_ns);
        if !fits {
            Some(Dropped::DoesNotFit)
        } else if is_in_time && age > i128::from(max_age_ns) {
            Some(Dropped::Stale)
        } else if is_in_time && starved {
            Some(Dropped::Starved)
        } else {
            None
        }
    }

    /// Why the requester drops the element, in its state before it hears of it. [MON-09]
    pub fn dropped(self, running: Option<Session>, parameters: &Parameters) -> Option<Dropped> {
        let Some(running) = running.filter(|_| self.is_of(running)) else {
            return Some(Dropped::OtherSession);
        };
        if is_violation(parameters, self.t_ns, running.last_arrival_ns, self.generated_ns) {
            return Some(Dropped::Late);
        }
        match self.generated_ns.cmp(&running.last_used_generated_ns?) {
            std::cmp::Ordering::Less => Some(Dropped::Older),
            std::cmp::Ordering::Equal => Some(Dropped::Repeated),
            std::cmp::Ordering::Greater => None,
        }
    }
}
