//! The station: the provider, with stand-in services that replay a drive.
//!
//! As the vehicle it has no clock and waits for nothing.

mod asking;
mod replay;

use std::collections::BTreeMap;
use std::time::Duration;

use mufasa::input::cycle::{Detection, Ego, Track};
use mufasa::monitor::Settings;
use mufasa::services::configuration::{Configuration, Group, Groups};
use mufasa_model::offloading::provider::{Provider, ProviderEvent, ProviderEventKind, Reply};
use mufasa_props::bridge;
use schemars::JsonSchema;
use serde::Serialize;

use self::asking::{Asking, Told};
use self::replay::Replay;
use crate::message::{self, EncodeError, Frame, Message, Payload};
use crate::play::Played;
use crate::traffic::Traffic;
use crate::transport::{Address, Health, Transport};

/// Sessions that it runs at the same time.
const CAPACITY: usize = 8;

/// How long it waits for a sign of life, ns. `spec/2-offloading.md`
const LEASE_NS: i64 = mufasa_model::offloading::provider::DEFAULT_LEASE_NS;

/// How often it says what it offers, ns.
const OFFERED_EVERY_NS: i64 = 500_000_000;

/// Messages that are taken in one step at most.
const AT_ONCE: usize = 64;

/// A station that offers both groups.
#[derive(Debug)]
pub struct Station<'a, T> {
    id: i64,
    played: &'a Played,
    frame: Frame,
    transport: &'a mut T,
    provider: Provider,
    /// Where in the drive each vehicle with a session is.
    replays: BTreeMap<i64, Replay>,
    /// What it asks before it sends, if it asks.
    asking: Option<Asking<'a>>,
    /// The own tracks of each vehicle that sent some.
    own_tracks: BTreeMap<i64, (i64, Vec<Track>)>,
    offered_ns: Option<i64>,
    summary: StationSummary,
}

/// What a station did.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct StationSummary {
    /// Most sessions at a time.
    pub sessions: usize,
    /// What went to and fro.
    #[serde(flatten)]
    pub traffic: Traffic,
}

impl<'a, T: Transport> Station<'a, T> {
    /// A station without sessions. `id`: its station id, 1 to 4294967295.
    ///
    /// Errors: a drive too far from the origin of its frame.
    pub fn new(id: i64, played: &'a Played, transport: &'a mut T) -> Result<Self, EncodeError> {
        Ok(Self {
            id,
            played,
            frame: played.frame()?,
            transport,
            provider: Provider::new(CAPACITY, LEASE_NS),
            replays: BTreeMap::new(),
            asking: None,
            own_tracks: BTreeMap::new(),
            offered_ns: None,
            summary: StationSummary::default(),
        })
    }

    /// The same; before it sends what the clean drive has it asks the stages, by the vehicle's settings.
    pub fn asking(mut self, clean: &'a Played, settings: &Settings) -> Self {
        self.asking = Some(Asking::new(clean, settings.stages));
        self
    }

    /// Takes what has arrived, and does what is due. Returns when something is due next, ns.
    pub fn step(&mut self, now_ns: i64) -> i64 {
        for _ in 0..AT_ONCE {
            let Some(bytes) = self.transport.receive(now_ns) else { break };
            self.take(now_ns, &bytes);
        }
        self.happens(now_ns, ProviderEventKind::Tick);
        let is_due = |last_ns: i64| now_ns.saturating_sub(last_ns) >= OFFERED_EVERY_NS;
        if self.offered_ns.is_none_or(is_due) {
            self.offered_ns = Some(now_ns);
            self.send(now_ns, 0, Payload::Offer { groups: Groups::ALL });
        }
        self.offered_ns.unwrap_or(now_ns).saturating_add(OFFERED_EVERY_NS)
    }

    /// Waits until something arrives, at most so long.
    pub fn wait(&mut self, at_most: Duration) {
        self.transport.wait(at_most);
    }

    /// How its transport does.
    pub fn health(&self) -> Health {
        self.transport.health()
    }

    /// Withdraws what it offers. Returns what it did.
    pub fn end(mut self, now_ns: i64) -> StationSummary {
        self.send(now_ns, 0, Payload::Withdraw);
        self.summary()
    }

    /// What it did so far.
    pub fn summary(&self) -> StationSummary {
        let mut summary = self.summary.clone();
        summary.traffic.health(self.transport.health());
        summary
    }

    /// Takes a message; whatever it is, nothing worse happens than that it is counted.
    fn take(&mut self, now_ns: i64, bytes: &[u8]) {
        let message = match message::decode(bytes, &self.frame) {
            Ok(message) => message,
            Err(error) => return self.summary.traffic.malformed(&error),
        };
        let Message { sender: requester, receiver, generated_ns: _, payload } = message;
        if receiver != self.id {
            return self.summary.traffic.dropped("for another");
        }
        self.summary.traffic.received(&payload);
        match payload {
            Payload::Request { .. } | Payload::Release { .. } | Payload::Alive { .. } => {
                if let Some(kind) = asked(requester, &payload) {
                    self.happens(now_ns, kind);
                }
            }
            Payload::State { stamp_ns, ego } => {
                if !self.has_session(requester) {
                    return self.summary.traffic.dropped("without a session");
                }
                let replay = self.replays.entry(requester).or_default();
                if !replay.locate(self.played, stamp_ns, &ego) {
                    return self.summary.traffic.dropped("off the drive");
                }
                let asks = self.asking.as_ref().and_then(|it| replay.cycle(it.clean, stamp_ns));
                if asks.is_some_and(|cycle| cycle.detections.is_some()) {
                    // It is asked about when the detections come.
                    return;
                }
                let trajectory = replay.trajectory(self.played, stamp_ns);
                if let (Some(session), Some((stamp_ns, points))) =
                    (self.session(requester, Group::Plan), trajectory)
                {
                    self.send(now_ns, requester, Payload::Trajectory { session, stamp_ns, points });
                }
            }
            Payload::Detections { stamp_ns, ego, detections } => {
                self.answer(now_ns, requester, (stamp_ns, ego), &detections);
            }
            Payload::Tracks { stamp_ns, tracks, .. } if self.has_session(requester) => {
                self.own_tracks.insert(requester, (stamp_ns, tracks));
            }
            Payload::Offer { .. }
            | Payload::Withdraw
            | Payload::Confirm { .. }
            | Payload::Reject { .. }
            | Payload::Tracks { .. }
            | Payload::Trajectory { .. } => self.summary.traffic.dropped("of a station"),
        }
    }

    /// Tracks, and the trajectory if it was not sent yet: what the drive has, and passes where it is asked for.
    fn answer(
        &mut self,
        now_ns: i64,
        requester: i64,
        (stamp_ns, ego): (i64, Ego),
        detections: &[Detection],
    ) {
        let Some(replay) = self.replays.get(&requester) else { return };
        let [mot, plan] = Group::ALL.map(|group| self.session(requester, group));
        let mut tracks = replay.tracks(self.played, stamp_ns).filter(|_| mot.is_some());
        let mut trajectory = None;
        if let Some(asking) = &mut self.asking {
            let configuration = configuration([mot, plan]);
            if configuration == Configuration::Local {
                return;
            }
            let Some(cycle) = replay.cycle(asking.clean, stamp_ns) else { return };
            let told = Told { cycle, configuration, ego, stamp_ns, detections };
            if tracks.is_some() && tracks == replay.tracks(asking.clean, stamp_ns) {
                tracks = tracks.and_then(|tracks| asking.tracks(&told, tracks));
            }
            trajectory = replay.trajectory(self.played, stamp_ns).filter(|_| plan.is_some());
            if trajectory.is_some() && trajectory == replay.trajectory(asking.clean, stamp_ns) {
                let beside = tracks.as_ref().or_else(|| self.own_tracks.get(&requester));
                trajectory = trajectory.and_then(|it| asking.trajectory(&told, beside, it));
            }
        }
        if let (Some(session), Some((stamp_ns, tracks))) = (mot, tracks) {
            self.send(now_ns, requester, Payload::Tracks { session, stamp_ns, tracks });
        }
        if let (Some(session), Some((stamp_ns, points))) = (plan, trajectory) {
            self.send(now_ns, requester, Payload::Trajectory { session, stamp_ns, points });
        }
    }

    /// Tells the provider, and the requester what it says.
    fn happens(&mut self, t_ns: i64, kind: ProviderEventKind) {
        if let Some(reply) = self.provider.step(&ProviderEvent { t_ns, kind }) {
            let (requester, payload) = replied(reply);
            self.send(t_ns, requester, payload);
        }
        self.summary.sessions = self.summary.sessions.max(self.provider.load());
        // Of who has no session nothing is remembered.
        let provider = &self.provider;
        self.replays.retain(|requester, _| has_session(provider, *requester));
        self.own_tracks.retain(|requester, _| has_session(provider, *requester));
    }

    fn has_session(&self, requester: i64) -> bool {
        has_session(&self.provider, requester)
    }

    fn session(&self, requester: i64, group: Group) -> Option<i64> {
        self.provider.session(requester, bridge::group_from_impl(group))
    }

    fn send(&mut self, now_ns: i64, vehicle: i64, payload: Payload) {
        let message = Message { sender: self.id, receiver: vehicle, generated_ns: now_ns, payload };
        match message::encode(&message, &self.frame) {
            Ok(bytes) => {
                self.summary.traffic.sent(&message.payload);
                self.transport.send(now_ns, Address::Vehicle(vehicle), bytes);
            }
            Err(error) => self.summary.traffic.unsent(&message.payload, &error),
        }
    }
}

/// What a vehicle asks of a provider, if it does.
pub fn asked(requester: i64, payload: &Payload) -> Option<ProviderEventKind> {
    let of = bridge::group_from_impl;
    Some(match *payload {
        Payload::Request { group, session } => {
            ProviderEventKind::Request { requester, group: of(group), session }
        }
        Payload::Release { group, session } => {
            ProviderEventKind::Release { requester, group: of(group), session }
        }
        Payload::Alive { group, session } => {
            ProviderEventKind::Heard { requester, group: of(group), session }
        }
        _ => return None,
    })
}

/// What a provider says, and to whom.
pub fn replied(reply: Reply) -> (i64, Payload) {
    match reply {
        Reply::Confirm { requester, group, session } => {
            (requester, Payload::Confirm { group: bridge::group_to_impl(group), session })
        }
        Reply::Reject { requester, group, session } => {
            (requester, Payload::Reject { group: bridge::group_to_impl(group), session })
        }
    }
}

/// In which a vehicle will use what it gets in these sessions, by group.
pub const fn configuration(sessions: [Option<i64>; 2]) -> Configuration {
    match sessions {
        [Some(_), Some(_)] => Configuration::AllRemote,
        [Some(_), None] => Configuration::MotRemote,
        [None, Some(_)] => Configuration::PlanRemote,
        [None, None] => Configuration::Local,
    }
}

fn has_session(provider: &Provider, requester: i64) -> bool {
    let groups = Group::ALL.map(bridge::group_from_impl);
    groups.into_iter().any(|group| provider.session(requester, group).is_some())
}
