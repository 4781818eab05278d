//! What a station sends, and the token of what the requester used of it
//! (`spec/monitor.md#monitor`).

use core::fmt;

use super::time::Time;

/// A message of a station with a result: tracks, or the points of a trajectory, in any holder of a
/// slice (`Vec`, an array, `&[Track]`). Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug)]
pub struct Message<L> {
    /// The station's id, >= 1.
    pub station: i64,
    /// The session that it names.
    pub session: i64,
    /// When the station made it.
    pub generated: Time,
    /// The stamp of the list: the time that tracks are valid for, or that of the trajectory. Current is
    /// what is not later than now and at most `max_age_ns` before it.
    pub stamp: Time,
    /// Tracks, or the points of a trajectory.
    pub items: L,
}

/// An element that the requester used: what it holds is out of reach until a cycle has checked it, and
/// only the monitor makes one. It is for the monitor that made it: another one takes it only if it runs a session of
/// the same station and number and its own last element was generated at the same time.
///
/// ```compile_fail,E0616
/// # use mufasa::{input::cycle::Track, monitor::Accepted};
/// fn unchecked(tracks: Accepted<Vec<Track>>) -> Vec<Track> {
///     tracks.items
/// }
/// ```
///
/// ```compile_fail,E0451
/// # use mufasa::{input::cycle::Track, monitor::{Accepted, Time}};
/// fn forged(items: Vec<Track>, now: Time) -> Accepted<Vec<Track>> {
///     Accepted { station: 1, session: 1, generated: now, stamp: now, items }
/// }
/// ```
///
/// Source: `spec/monitor.md#monitor`.
#[must_use = "an element that was accepted has to be checked in a cycle"]
pub struct Accepted<L> {
    pub(super) station: i64,
    pub(super) session: i64,
    pub(super) generated: Time,
    pub(super) stamp: Time,
    pub(super) items: L,
}

impl<L> fmt::Debug for Accepted<L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = f.debug_struct("Accepted");
        text.field("session", &self.session).field("generated", &self.generated);
        text.finish_non_exhaustive()
    }
}

/// What became of a message; what has to be done about it comes beside it. Source: `spec/monitor.md#monitor`.
#[derive(Debug)]
#[must_use = "an element that is accepted is for the next cycle"]
pub enum Arrival<L> {
    /// It is of the running session and in time: to be checked in a cycle.
    Accepted(Accepted<L>),
    /// It is of no use, and gone.
    Dropped {
        /// Why.
        why: DropReason,
    },
}

/// Why a message is of no use; of several reasons the first in this order. Source:
/// `spec/monitor.md#monitor`, `spec/2-offloading.md#quality-of-service`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DropReason {
    /// It is not of the running session of its group, or there is none.
    OtherSession,
    /// It has more tracks than the memory that was lent (`rows`) is for. It is no arrival: a station
    /// that goes on so is silent, and its session ends after `dt_max`.
    TooLong,
    /// It was generated after it arrived: the clocks cannot be trusted. The session has ended.
    FromTheFuture,
    /// Its latency is above `l_max`. The session has ended.
    Late,
    /// Its stamp is more than `max_age` ago, so that no cycle can use it. It is no arrival.
    TooOld,
    /// For more than `dt_max` no cycle has had an element of the session that was current (F-43). It is no
    /// arrival: the session ends after `dt_max`.
    Starved,
    /// The time since the last arrival is above `dt_max`. The session has ended.
    AfterSilence,
    /// It is not generated later than the last one that was used: repeated, or overtaken.
    NotNewer,
}

impl DropReason {
    /// Each of them, in this order.
    pub const ALL: [Self; 8] = [
        Self::OtherSession,
        Self::TooLong,
        Self::FromTheFuture,
        Self::Late,
        Self::TooOld,
        Self::Starved,
        Self::AfterSilence,
        Self::NotNewer,
    ];

    /// In words. Source: `spec/monitor.md#monitor`.
    pub const fn message(self) -> &'static str {
        match self {
            Self::TooLong => "more tracks than the lent memory is for",
            Self::OtherSession => "not of the running session",
            Self::FromTheFuture => "generated after it arrived",
            Self::Late => "latency above l_max",
            Self::TooOld => "stamp more than max_age ago",
            Self::Starved => "no cycle could use those before it",
            Self::AfterSilence => "more than dt_max after the last arrival",
            Self::NotNewer => "not newer than the last one used",
        }
    }
}

impl fmt::Display for DropReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message())
    }
}

/// An accepted element as a cycle sees it.
#[derive(Clone, Copy)]
pub(super) struct Element<'c, T> {
    pub(super) station: i64,
    pub(super) session: i64,
    pub(super) generated: Time,
    pub(super) stamp: Time,
    pub(super) items: &'c [T],
}

impl<T> fmt::Debug for Element<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = f.debug_struct("Element");
        text.field("session", &self.session).field("generated", &self.generated);
        text.finish_non_exhaustive()
    }
}

impl<L> Accepted<L> {
    pub(super) fn element<T>(&self) -> Element<'_, T>
    where
        L: AsRef<[T]>,
    {
        let Self { station, session, generated, stamp, ref items } = *self;
        Element { station, session, generated, stamp, items: items.as_ref() }
    }
}
