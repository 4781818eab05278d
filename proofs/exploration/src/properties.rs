//! The properties, each a sentence of `spec/2-offloading.md`, and the sights that show that they
//! are not empty.

use enumset::{EnumSet, EnumSetType};
use mufasa_model::input::profile::{HardenedRule, Profile};

/// An enum whose members have names.
macro_rules! named {
    ($(#[$of:meta])* $Kind:ident { $($(#[$doc:meta])* $member:ident = $name:literal,)* }) => {
        $(#[$of])*
        #[derive(Debug, EnumSetType)]
        pub enum $Kind { $($(#[$doc])* $member,)* }

        impl $Kind {
            /// All of them.
            pub const ALL: EnumSet<Self> = EnumSet::all();

            /// Its name, in words.
            pub fn name(self) -> &'static str {
                match self { $(Self::$member => $name,)* }
            }
        }
    };
}

pub(crate) use named;

named! {
    /// A property that holds in every reachable state or in every endless run.
    Property {
        /// PROTO-01
        OneSource = "each_group_has_exactly_one_source",
        /// PROTO-02
        NoRemoteResultBeforeHoldUntil = "no_remote_result_before_hold_until",
        /// FALL-05
        AskedOnceAllowed = "stations_are_asked_at_hold_until",
        /// PROTO-03
        EnvAndTplTogether = "env_and_tpl_have_the_same_source",
        /// PROTO-04
        OffloadingReachedAgain = "offloading_is_reached_again",
        /// PROTO-05
        LeftSessionWithinLease = "a_left_session_is_not_held_beyond_the_lease",
        /// The same as an end that always comes, once nothing is heard any more.
        LeftSessionEnds = "a_left_session_ends",
        /// PROTO-08; F-12 when it fails.
        NoStopBeforeSafeCycle = "local_services_stop_only_after_a_safe_cycle",
        /// PROTO-11
        EndedSessionChangesNothing = "an_ended_session_changes_no_later_one",
        /// PROV-01
        NoMoreThanCapacity = "no_station_runs_more_than_its_capacity",
        /// PROV-08
        OthersKeepTheirSessions = "no_requester_changes_anothers_session",
        /// What `is_valid` of the parts says of every reachable state.
        PartsValid = "requester_and_provider_stay_valid",
    }
}

named! {
    /// A state or step that a property speaks of and that has to be reached.
    Sight {
        /// MOT on one station and PLAN on another, the local services of both stopped.
        TwoStationsAtOnce = "offloaded to two stations at once",
        /// A safety issue while one group is remote and the other requested.
        FallbackRemoteAndRequested = "fallback, one group remote, the other requested",
        /// A safety issue while the local services of a group are stopped.
        FallbackFromRemote = "fallback from remote services",
        /// A result arrives while a safety issue bars it.
        ResultDuringWait = "result during the waiting time",
        /// A wait ends while a station offers something.
        WaitEnds = "wait ends while a station offers",
        /// A violation of quality of service while a hold runs.
        ViolationDuringHold = "violation during a hold",
        /// A confirmation arrives at its deadline or later, before a tick could tell.
        ConfirmedAfterTimeout = "confirmation after the time-out",
        /// A station's confirmation arrives when the requester has left the session.
        ConfirmedAfterLeaving = "confirmation of a session that was left",
        /// A release is lost while its session runs.
        ReleaseLost = "release lost while its session runs",
        /// A session that the requester has left ends with the lease.
        LeftSessionLapses = "left session ended by the lease",
        /// A station hears an old message of a session that the requester has left.
        LeftSessionKept = "left session kept by an old message",
        /// The local services compute beside a running session (H-08).
        RemoteBesideLocal = "local services beside remote ones",
        /// Local services stop at a safe verdict.
        StoppedAtSafeVerdict = "local services stopped at a safe verdict",
        /// Local services stop at a confirmation.
        StoppedAtConfirmation = "local services stopped at a confirmation",
        /// A message of an ended session reaches a CAV with a later one.
        EndedMeetsLaterAtCav = "message of an ended session at a CAV with a later one",
        /// A message of an ended session reaches a station with a later one.
        EndedMeetsLaterAtStation = "message of an ended session at a station with a later one",
        /// A station replaces a session by a later one of the same requester.
        LaterReplaces = "later session replaces an older one",
        /// A station that is full rejects a requester because of another.
        FullBecauseOfAnother = "rejected because of another requester",
        /// A station crashes while it runs a session that the CAV is in.
        CrashWhileRemote = "station crashes while in use",
        /// A station that runs sessions of two requesters hears one of them.
        TwoServedAtOnce = "two requesters served at once",
    }
}

impl Property {
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
