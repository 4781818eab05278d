//! What a cycle ends in (`spec/monitor.md#monitor`).

use core::marker::PhantomData;
use core::ops::Deref;

use super::time::Time;
use crate::input::cycle::{TrackList, Trajectory};
use crate::offloading::requester::Source;
use crate::report::{FailedStage, InvalidInput, Report, Witness};

/// The end of a cycle. Only the safe one holds data, and as long as it is looked at the monitor takes
/// neither event nor cycle. What has to be done comes beside it ([`Monitor::cycle`](super::Monitor::cycle)).
/// Source: `spec/monitor.md#monitor`.
#[derive(Clone, Debug, PartialEq)]
#[must_use = "an unsafe cycle has to be left for the local services"]
#[allow(clippy::large_enum_variant, reason = "no heap, and one of them a cycle")]
pub enum Decision<'m> {
    /// No stage failed. The requester has been told.
    Safe {
        /// The tracks of the station, while MOT is remote, they are current, and stage i ran: what is there
        /// was compared with what the CAV sees; an object that is not there may still exist. `None`, too,
        /// while the CAV has no current detections.
        tracks: Option<Verified<'m, TrackList<'m>>>,
        /// The trajectory that was checked, while a group is remote, it is current and, in the hardened profile, the
        /// CAV has current detections (F-49): that of the station, or in MotRemote that of the CAV's own planner. `None`
        /// in Local, where nothing is checked and the local planner is followed; and while nothing current was there to
        /// check: a message is missing, or is stamped ahead of the cycle. What is followed then is a copy of what was
        /// followed last, along which control brakes by its time: [`Verified::brake_by`], of a plan of the CAV's own tau
        /// after the last cycle in Local. An own plan that did not come out is followed at a cycle in Local alone (F-61). Where
        /// a message stays missing,
        /// the session ends as for silence, at the latest 2 dt_max and two periods after the last cycle that had
        /// something current (F-43); for missing detections it does not end.
        trajectory: Option<Verified<'m, Trajectory<'m>>>,
        /// Which stages ran, and why the others did not.
        report: Report,
        /// Whether control has to brake instead of following a plan of the CAV's own.
        brake: Option<Brake>,
    },
    /// A stage failed, remote data are invalid, or local input is. The requester has fallen back: no
    /// group is remote any more, and no data of this cycle may reach control.
    // FALL-03
    Unsafe {
        /// What failed; an error is invalid local input.
        report: Result<Report, InvalidInput>,
        /// Whether control has to brake instead of following a plan of the CAV's own.
        brake: Option<Brake>,
    },
}

/// Why control has to brake with at least `a_b` from this cycle on until one says nothing of the kind: with
/// [`supervise_local`](super::Settings::supervise_local) the monitor asks in `Local` of the CAV's own plan what it asks
/// of a station's (F-48). Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Brake {
    /// The CAV has no current plan of its own.
    NoPlan,
    /// Its plan fails. There is no witness where nothing compared it with obstacles (H-05).
    Fails {
        /// Where.
        stage: FailedStage,
        /// What was compared.
        witness: Option<Witness>,
    },
    /// The plan, or other local input, is invalid.
    Invalid(InvalidInput),
}

/// Data that were current, of the running session of their group, and in a safe cycle; they can be read
/// until the monitor's next event or cycle. What control follows should take nothing else:
///
/// ```
/// # use mufasa::{input::cycle::Trajectory, monitor::Verified};
/// fn follow(trajectory: Verified<'_, Trajectory<'_>>) -> usize {
///     trajectory.points.len()
/// }
/// ```
///
/// No other code makes one:
///
/// ```compile_fail,E0451
/// # use mufasa::{input::cycle::Trajectory, monitor::Verified};
/// # use mufasa::offloading::requester::Source;
/// fn forged(value: Trajectory<'_>) -> Verified<'_, Trajectory<'_>> {
///     let until_the_next_cycle = Default::default();
///     Verified { value, source: Source::Local, brake_by: None, until_the_next_cycle }
/// }
/// ```
///
/// ```compile_fail,E0308
/// # use mufasa::{input::cycle::Trajectory, monitor::Verified};
/// # fn follow(trajectory: Verified<'_, Trajectory<'_>>) {}
/// fn unverified(received: Trajectory<'_>) {
///     follow(received);
/// }
/// ```
///
/// Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use = "verified data are for the services that need them"]
pub struct Verified<'m, T> {
    value: T,
    source: Source,
    brake_by: Option<Time>,
    // MON-03
    until_the_next_cycle: PhantomData<&'m T>,
}

impl<T> Verified<'_, T> {
    /// Of data that a safe cycle used.
    pub(super) const fn of_safe_cycle(value: T, source: Source, brake_by: Option<Time>) -> Self {
        Self { value, source, brake_by, until_the_next_cycle: PhantomData }
    }

    /// Where they were computed. Source: `spec/1-services.md#configuration`.
    pub const fn source(&self) -> Source {
        self.source
    }
}

impl Verified<'_, Trajectory<'_>> {
    /// The time by which control has to brake along it, with at least `a_b`, unless a later cycle has given a
    /// trajectory or, in Local, there is a plan of the CAV's own: that of the cycle plus `tau`. What was examined
    /// covers no more (H-14), and a safe cycle without a trajectory has examined nothing (F-47). `None` in
    /// the paper profile, which has no `tau`. Source: `spec/monitor.md#monitor`.
    pub const fn brake_by(&self) -> Option<Time> {
        self.brake_by
    }
}

impl<T> Deref for Verified<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}
