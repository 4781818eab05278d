//! Every bound of the exploration, each with its reason.
//!
//! A [`World`] is one setting of the one system in `system.rs`. No bound limits how long anything
//! goes on: times are kept relative to now, so runs are endless and only their durations count.

use mufasa_model::offloading::requester::{Group, Groups, Parameters};

/// Most requesters of a world. Two are enough for one to disturb the other.
pub const REQUESTERS: usize = 2;
/// Most stations of a world. With three there is one that is neither asked nor in use.
pub const STATIONS: usize = 3;
/// Most messages in flight in a world.
pub const IN_FLIGHT: usize = 4;

const MOT: Groups = Groups { mot: true, plan: false };
const PLAN: Groups = Groups { mot: false, plan: true };
const ALL: Groups = Groups::ALL;
const NONE: Groups = Groups::NONE;

/// How much is explored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// All of it within the time of CI: 5 minutes and 8 GB for both profiles and both engines.
    Small,
    /// For a night.
    Large,
}

impl Bounds {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Small => "small",
            Self::Large => "large",
        }
    }

    /// The worlds of this size.
    pub fn worlds(self) -> &'static [World] {
        match self {
            Self::Small => SMALL,
            Self::Large => LARGE,
        }
    }
}

/// Durations in ticks of the clock. A tick is the grain of time: what happens between two ticks
/// happens at the same time, in any order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ticks {
    /// Waiting time after a safety issue.
    pub t_wait: i64,
    /// Time in which a request is to be confirmed.
    pub request_timeout: i64,
    /// Largest latency.
    pub l_max: i64,
    /// Largest inter-arrival time.
    pub dt_max: i64,
    /// Lease of every station.
    pub lease: i64,
}

/// The smallest times with every case: before, at and beyond each limit. A wait of 2 ticks has a
/// middle, so that what happens within it is not what happens at its ends.
const SHORT: Ticks = Ticks { t_wait: 2, request_timeout: 1, l_max: 1, dt_max: 1, lease: 2 };

/// No two are equal, and the lease outlives a wait, so that a session left at a safety issue still
/// runs when offloading is possible again.
const LONG: Ticks = Ticks { t_wait: 5, request_timeout: 4, l_max: 2, dt_max: 3, lease: 6 };

/// The order of the defaults: the wait outlives everything else.
const LONG_WAIT: Ticks = Ticks { t_wait: 4, request_timeout: 2, l_max: 1, dt_max: 1, lease: 3 };

/// A station of a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StationBounds {
    /// The offers that it may make, at any time.
    pub offers: &'static [Groups],
    /// Sessions that it runs at the same time.
    pub capacity: usize,
}

/// One setting of the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct World {
    /// Its name.
    pub name: &'static str,
    /// What it is for, and why its bounds suffice for that.
    pub why: &'static str,
    /// Number of CAVs, 1 to [`REQUESTERS`].
    pub requesters: usize,
    /// The stations 1, 2, ..., at most [`STATIONS`].
    pub stations: &'static [StationBounds],
    /// The areas that a CAV may enter.
    pub areas: &'static [Groups],
    /// Different messages in flight; each may be delivered any number of times. A message that
    /// finds no place is lost. With 0 everything sent is lost, and what arrives is forged.
    pub in_flight: usize,
    /// Durations.
    pub ticks: Ticks,
    /// Whether a violation of quality of service starts a hold (I-09).
    pub qos_hold: bool,
    /// Whether somebody forges confirmations, rejections and data of every station, and of one
    /// that never offered anything.
    pub attacker: bool,
}

impl World {
    /// The parameters of every requester; a tick is 1 ns.
    pub fn parameters(&self) -> Parameters {
        Parameters {
            t_wait_ns: self.ticks.t_wait,
            request_timeout_ns: self.ticks.request_timeout,
            l_max_ns: self.ticks.l_max,
            dt_max_ns: self.ticks.dt_max,
            qos_hold: self.qos_hold,
        }
    }

    /// The groups that some station may offer.
    pub fn groups(&self) -> impl Iterator<Item = Group> + use<> {
        let offers = self.stations.iter().flat_map(|station| station.offers);
        let all = offers.fold(NONE, |all, offer| Groups {
            mot: all.mot || offer.mot,
            plan: all.plan || offer.plan,
        });
        Group::ALL.into_iter().filter(move |group| all.contains(*group))
    }

    /// Whether every station can run every group of every CAV at once, so that none has to wait
    /// for the place of another.
    pub fn has_room_for_all(&self) -> bool {
        let needed = self.requesters * self.groups().count();
        self.stations.iter().all(|station| station.capacity >= needed)
    }

    /// Whether messages travel at all.
    pub fn has_network(&self) -> bool {
        self.in_flight > 0
    }
}

/// A station that runs one group for one CAV.
const ONE_GROUP: StationBounds = StationBounds { offers: &[MOT], capacity: 1 };

/// A station that offers anything, in a world in which nothing is delivered to it.
const ANY_OFFER: StationBounds = StationBounds { offers: &[ALL, MOT, PLAN], capacity: 0 };

/// Where nothing else is said: one CAV and one station for one group, two messages in flight, and an attacker.
const BASE: World = World {
    name: "",
    why: "",
    requesters: 1,
    stations: &[ONE_GROUP],
    areas: &[],
    in_flight: 2,
    ticks: SHORT,
    qos_hold: false,
    attacker: true,
};

/// A CAV to which every message that anybody could send comes at any time: no network, every area.
const ANYTHING: World = World {
    stations: &[ANY_OFFER; 2],
    areas: &[ALL, MOT, PLAN, NONE],
    in_flight: 0,
    ticks: LONG,
    ..BASE
};

const SMALL: &[World] = &[
    World {
        name: "anything",
        why: "every message that anybody could send arrives at any time, so no network can do \
              worse to a CAV; two stations are enough to be offloaded to two at once, and to be \
              asked in turn",
        ..ANYTHING
    },
    World {
        name: "qos-hold",
        why: "the same with a hold after each violation, which the other group outlives; one \
              station is enough, because a hold does not depend on who is asked",
        stations: &[ANY_OFFER],
        qos_hold: true,
        ..ANYTHING
    },
    World {
        name: "link",
        why: "one station runs both groups over a bad network; two messages in flight are enough \
              for one to overtake the other, and are what one tick can send",
        stations: &[StationBounds { offers: &[ALL], capacity: 2 }],
        ..BASE
    },
    World {
        name: "choice",
        why: "two stations compete for one group, so that an old session on one meets a new one \
              on the other, and a station that never confirms could starve the one that does; \
              two messages in flight are a question and an answer",
        stations: &[ONE_GROUP; 2],
        ..BASE
    },
    World {
        name: "fleet",
        why: "two CAVs compete for one place on one station; more would only wait; two messages \
              in flight, so that each CAV has one",
        requesters: 2,
        ..BASE
    },
    World {
        name: "shared",
        why: "two CAVs on one station with a place for each, so that what one does could reach \
              the session of the other; without an attacker, because nobody forges what a \
              station receives",
        requesters: 2,
        stations: &[StationBounds { capacity: 2, ..ONE_GROUP }],
        attacker: false,
        ..BASE
    },
    World {
        name: "honest",
        why: "one station, one group and no attacker, so that what is found needs none and can \
              be drawn as it comes about",
        attacker: false,
        ..BASE
    },
    World {
        name: "roam",
        why: "areas, changing offers and holds after violations over a bad network, and a wait \
              that outlives every lease; one station and one group, because what moves them is \
              the world and not each other",
        stations: &[StationBounds { offers: &[MOT, NONE], capacity: 1 }],
        areas: &[MOT, NONE],
        ticks: LONG_WAIT,
        qos_hold: true,
        ..BASE
    },
];

const LARGE: &[World] = &[
    World {
        name: "anything-3",
        why: "the small world `anything` with a third station, which is neither asked nor in use \
              while two are; shorter times, because three stations multiply the rest",
        stations: &[ANY_OFFER; 3],
        ticks: SHORT,
        ..ANYTHING
    },
    World {
        name: "qos-hold-2",
        why: "the small world `qos-hold` with a second station, to which a group could escape \
              from a hold",
        qos_hold: true,
        ..ANYTHING
    },
    World {
        name: "link-4",
        why: "one group with four messages in flight, so that one can be overtaken three times \
              and generations of sessions meet",
        in_flight: 4,
        ..BASE
    },
    World {
        name: "link-long",
        why: "one group with times of which no two are equal, and a bad network",
        ticks: LONG,
        ..BASE
    },
    World {
        name: "choice-3",
        why: "the small world `choice` with three stations",
        stations: &[ONE_GROUP; 3],
        ..BASE
    },
    World {
        name: "shared-3",
        why: "the small world `shared` with three messages in flight",
        requesters: 2,
        stations: &[StationBounds { capacity: 2, ..ONE_GROUP }],
        in_flight: 3,
        attacker: false,
        ..BASE
    },
];
