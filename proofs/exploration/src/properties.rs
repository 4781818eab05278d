//! The properties, each a sentence of `spec/2-offloading.md`, and the sights that show that they
//! are not empty.

use std::fmt;
use std::marker::PhantomData;

use mufasa_model::input::profile::{HardenedRule, Profile};

/// A property that holds in every reachable state or in every endless run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// `spec/2-offloading.md#properties-of-the-whole-protocol.1`
    OneSource,
    /// `spec/2-offloading.md#properties-of-the-whole-protocol.2`
    NoRemoteResultBeforeHoldUntil,
    /// `spec/2-offloading.md#fallback.3`
    AskedOnceAllowed,
    /// `spec/2-offloading.md#properties-of-the-whole-protocol.3`
    EnvAndTplTogether,
    /// `spec/2-offloading.md#properties-of-the-whole-protocol.4`
    OffloadingReachedAgain,
    /// `spec/2-offloading.md#properties-of-the-whole-protocol.5`
    LeftSessionWithinLease,
    /// The same as an end that always comes, once nothing is heard any more.
    LeftSessionEnds,
    /// `spec/2-offloading.md#properties-of-the-whole-protocol.6`; F-12 when it fails.
    NoStopBeforeSafeCycle,
    /// `spec/2-offloading.md#properties-of-the-whole-protocol.7`
    EndedSessionChangesNothing,
    /// `spec/2-offloading.md#provider.1`
    NoMoreThanCapacity,
    /// `spec/2-offloading.md#provider.3`
    OthersKeepTheirSessions,
    /// What `is_valid` of the parts says of every reachable state.
    PartsValid,
}

/// A state or step that a property speaks of and that has to be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// MOT on one station and PLAN on another, the local services of both stopped.
    TwoStationsAtOnce,
    /// A safety issue while one group is remote and the other requested.
    FallbackRemoteAndRequested,
    /// A safety issue while the local services of a group are stopped.
    FallbackFromRemote,
    /// A result arrives while a safety issue bars it.
    ResultDuringWait,
    /// A wait ends while a station offers something.
    WaitEnds,
    /// A violation of quality of service while a hold runs.
    ViolationDuringHold,
    /// A confirmation arrives at its deadline or later, before a tick could tell.
    ConfirmedAfterTimeout,
    /// A station's confirmation arrives when the requester has left the session.
    ConfirmedAfterLeaving,
    /// A release is lost while its session runs.
    ReleaseLost,
    /// A session that the requester has left ends with the lease.
    LeftSessionLapses,
    /// A station hears an old message of a session that the requester has left.
    LeftSessionKept,
    /// The local services compute beside a running session (H-08).
    RemoteBesideLocal,
    /// Local services stop at a safe verdict.
    StoppedAtSafeVerdict,
    /// Local services stop at a confirmation.
    StoppedAtConfirmation,
    /// A message of an ended session reaches a CAV with a later one.
    EndedMeetsLaterAtCav,
    /// A message of an ended session reaches a station with a later one.
    EndedMeetsLaterAtStation,
    /// A station replaces a session by a later one of the same requester.
    LaterReplaces,
    /// A station that is full rejects a requester because of another.
    FullBecauseOfAnother,
    /// A station crashes while it runs a session that the CAV is in.
    CrashWhileRemote,
    /// A station that runs sessions of two requesters hears one of them.
    TwoServedAtOnce,
}

impl Property {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::OneSource,
        Self::NoRemoteResultBeforeHoldUntil,
        Self::AskedOnceAllowed,
        Self::EnvAndTplTogether,
        Self::OffloadingReachedAgain,
        Self::LeftSessionWithinLease,
        Self::LeftSessionEnds,
        Self::NoStopBeforeSafeCycle,
        Self::EndedSessionChangesNothing,
        Self::NoMoreThanCapacity,
        Self::OthersKeepTheirSessions,
        Self::PartsValid,
    ];

    /// Its sentence.
    pub fn name(self) -> &'static str {
        match self {
            Self::OneSource => "each_group_has_exactly_one_source",
            Self::NoRemoteResultBeforeHoldUntil => "no_remote_result_before_hold_until",
            Self::AskedOnceAllowed => "stations_are_asked_at_hold_until",
            Self::EnvAndTplTogether => "env_and_tpl_have_the_same_source",
            Self::OffloadingReachedAgain => "offloading_is_reached_again",
            Self::LeftSessionWithinLease => "a_left_session_is_not_held_beyond_the_lease",
            Self::LeftSessionEnds => "a_left_session_ends",
            Self::NoStopBeforeSafeCycle => "local_services_stop_only_after_a_safe_cycle",
            Self::EndedSessionChangesNothing => "an_ended_session_changes_no_later_one",
            Self::NoMoreThanCapacity => "no_station_runs_more_than_its_capacity",
            Self::OthersKeepTheirSessions => "no_requester_changes_anothers_session",
            Self::PartsValid => "requester_and_provider_stay_valid",
        }
    }

    /// What it claims.
    pub fn statement(self) -> &'static str {
        match self {
            Self::OneSource => {
                "At every time each group has exactly one source: a station while it is remote and its \
                 local services are stopped, else the CAV."
            }
            Self::NoRemoteResultBeforeHoldUntil => {
                "After a safety issue no result of a station is used before `hold_until`."
            }
            Self::AskedOnceAllowed => {
                "A group that is local, in the area and offered is asked for at every tick at `hold_until` or \
                 later."
            }
            Self::EnvAndTplTogether => "ENV and TPL never have different sources.",
            Self::OffloadingReachedAgain => {
                "From every reachable state: if offers and areas stay, some station confirms, no fault \
                 occurs and the hold ends, every offered group becomes remote."
            }
            Self::LeftSessionWithinLease => {
                "A session that its requester has left ends within the lease, counted from the last \
                 message of it that the station hears."
            }
            Self::LeftSessionEnds => {
                "A session that its requester has left ends, once nothing of it is heard any more."
            }
            Self::NoStopBeforeSafeCycle => {
                "Local services are not stopped while no result of the running session was in a safe \
                 cycle (H-08)."
            }
            Self::EndedSessionChangesNothing => {
                "A message of an ended session changes no later one, at the CAV or at a station."
            }
            Self::NoMoreThanCapacity => "No station runs more sessions than its capacity.",
            Self::OthersKeepTheirSessions => {
                "What one requester does changes no session of another."
            }
            Self::PartsValid => {
                "Every reachable state of requester and provider is valid, and model and \
                 implementation of the requester agree in every step."
            }
        }
    }

    /// The heading of its requirement.
    pub fn requirement(self) -> &'static str {
        match self {
            Self::NoMoreThanCapacity | Self::OthersKeepTheirSessions => {
                "spec/2-offloading.md#provider"
            }
            Self::AskedOnceAllowed => "spec/2-offloading.md#fallback",
            Self::PartsValid => "spec/2-offloading.md#requester",
            _ => "spec/2-offloading.md#properties-of-the-whole-protocol",
        }
    }

    /// Whether it speaks of every state (always), or of what every endless run comes to.
    pub fn is_safety(self) -> bool {
        !matches!(self, Self::OffloadingReachedAgain | Self::LeftSessionEnds)
    }

    /// Whether the profile claims it. Break before make is what the paper describes (F-12).
    pub fn is_claimed(self, profile: Profile) -> bool {
        self != Self::NoStopBeforeSafeCycle || profile.has(HardenedRule::H08)
    }

    /// The sights that show that it is not empty.
    pub fn companions(self) -> &'static [Sight] {
        match self {
            Self::OneSource => &[
                Sight::TwoStationsAtOnce,
                Sight::FallbackRemoteAndRequested,
                Sight::CrashWhileRemote,
            ],
            Self::NoRemoteResultBeforeHoldUntil => {
                &[Sight::FallbackFromRemote, Sight::ResultDuringWait, Sight::ViolationDuringHold]
            }
            Self::AskedOnceAllowed => &[Sight::FallbackFromRemote, Sight::WaitEnds],
            Self::EnvAndTplTogether => &[Sight::TwoStationsAtOnce],
            Self::OffloadingReachedAgain => &[Sight::FallbackFromRemote],
            Self::LeftSessionWithinLease | Self::LeftSessionEnds => {
                &[Sight::ReleaseLost, Sight::LeftSessionLapses, Sight::LeftSessionKept]
            }
            Self::NoStopBeforeSafeCycle => &[
                Sight::RemoteBesideLocal,
                Sight::StoppedAtSafeVerdict,
                Sight::StoppedAtConfirmation,
            ],
            Self::EndedSessionChangesNothing => &[
                Sight::EndedMeetsLaterAtCav,
                Sight::EndedMeetsLaterAtStation,
                Sight::ConfirmedAfterTimeout,
                Sight::ConfirmedAfterLeaving,
            ],
            Self::NoMoreThanCapacity => &[Sight::FullBecauseOfAnother, Sight::LaterReplaces],
            Self::OthersKeepTheirSessions => &[Sight::TwoServedAtOnce, Sight::FullBecauseOfAnother],
            Self::PartsValid => &[],
        }
    }
}

impl Sight {
    /// All of them.
    pub const ALL: [Self; 20] = [
        Self::TwoStationsAtOnce,
        Self::FallbackRemoteAndRequested,
        Self::FallbackFromRemote,
        Self::ResultDuringWait,
        Self::WaitEnds,
        Self::ViolationDuringHold,
        Self::ConfirmedAfterTimeout,
        Self::ConfirmedAfterLeaving,
        Self::ReleaseLost,
        Self::LeftSessionLapses,
        Self::LeftSessionKept,
        Self::RemoteBesideLocal,
        Self::StoppedAtSafeVerdict,
        Self::StoppedAtConfirmation,
        Self::EndedMeetsLaterAtCav,
        Self::EndedMeetsLaterAtStation,
        Self::LaterReplaces,
        Self::FullBecauseOfAnother,
        Self::CrashWhileRemote,
        Self::TwoServedAtOnce,
    ];

    /// Its words.
    pub fn name(self) -> &'static str {
        match self {
            Self::TwoStationsAtOnce => "offloaded to two stations at once",
            Self::FallbackRemoteAndRequested => "fallback, one group remote, the other requested",
            Self::FallbackFromRemote => "fallback from remote services",
            Self::ResultDuringWait => "result during the waiting time",
            Self::WaitEnds => "wait ends while a station offers",
            Self::ViolationDuringHold => "violation during a hold",
            Self::ConfirmedAfterTimeout => "confirmation after the time-out",
            Self::ConfirmedAfterLeaving => "confirmation of a session that was left",
            Self::ReleaseLost => "release lost while its session runs",
            Self::LeftSessionLapses => "left session ended by the lease",
            Self::LeftSessionKept => "left session kept by an old message",
            Self::RemoteBesideLocal => "local services beside remote ones",
            Self::StoppedAtSafeVerdict => "local services stopped at a safe verdict",
            Self::StoppedAtConfirmation => "local services stopped at a confirmation",
            Self::EndedMeetsLaterAtCav => "message of an ended session at a CAV with a later one",
            Self::EndedMeetsLaterAtStation => {
                "message of an ended session at a station with a later one"
            }
            Self::LaterReplaces => "later session replaces an older one",
            Self::FullBecauseOfAnother => "rejected because of another requester",
            Self::CrashWhileRemote => "station crashes while in use",
            Self::TwoServedAtOnce => "two requesters served at once",
        }
    }

    /// Whether it can be seen in the profile: one stops local services at the confirmation, the
    /// other at a safe verdict.
    pub fn is_expected(self, profile: Profile) -> bool {
        match self {
            Self::RemoteBesideLocal | Self::StoppedAtSafeVerdict => profile == Profile::HARDENED,
            Self::StoppedAtConfirmation => profile == Profile::PAPER,
            _ => true,
        }
    }
}

/// A set of properties or of sights.
#[derive(PartialEq, Eq)]
pub struct Set<T>(u32, PhantomData<T>);

/// What has a bit in a [`Set`].
pub trait Member: Copy {
    /// Its bit, below 32.
    fn bit(self) -> u32;
}

impl Member for Property {
    fn bit(self) -> u32 {
        self as u32
    }
}

impl Member for Sight {
    fn bit(self) -> u32 {
        self as u32
    }
}

impl<T: Member> Set<T> {
    /// None.
    pub const EMPTY: Self = Self(0, PhantomData);

    /// Adds a member.
    pub fn insert(&mut self, member: T) {
        self.0 |= 1 << member.bit();
    }

    /// Adds a member when the condition holds.
    pub fn note(&mut self, member: T, condition: bool) {
        if condition {
            self.insert(member);
        }
    }

    /// Whether it is in.
    pub fn contains(self, member: T) -> bool {
        self.0 >> member.bit() & 1 == 1
    }

    /// Whether nothing is in.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Those of this set that are not in the other.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0, PhantomData)
    }

    /// Adds all of another set.
    pub fn extend(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

impl<T> Clone for Set<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Set<T> {}

impl<T: Member> Default for Set<T> {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl<T> fmt::Debug for Set<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:b}", self.0)
    }
}
