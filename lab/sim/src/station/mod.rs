//! The station (MEC server): the provider, sensors beside the road, and the services.

mod sensors;

use std::collections::BTreeMap;

use mufasa::input::cycle::{
    CrossSection, Detection, DetectionList, Ego, Track, TrackList, TrajectoryPoint,
};
use mufasa::services::configuration::{Configuration, Group};
use mufasa_link::message::{self, Frame, Message, Payload};
use mufasa_link::station::{asked, configuration, replied};
use mufasa_model::offloading::provider::{
    DEFAULT_LEASE_NS, Provider, ProviderEvent, ProviderEventKind,
};
use mufasa_props::bridge;

use crate::attack::{Attacker, Results};
use crate::cav::DECIDES_NS;
use crate::cav::asking::{Asking, Known};
use crate::ids;
use crate::map::Town;
use crate::map::route::Route;
use crate::planner::{Road, plan, slower};
use crate::pose::Point;
use crate::radio::{Radio, To};
use crate::services::detectors::Observer;
use crate::services::mot::Tracker;
use crate::services::tpl;
use crate::settings::Settings;
use crate::snapshot::Snapshot;
use crate::time::seconds;

/// How long its services compute, ns.
const COMPUTES_NS: i64 = 4_000_000;
/// How often it says what it offers, ns.
const OFFERS_NS: i64 = 500_000_000;
/// Detections of the CAV and of a sensor nearer than this are of one object, m.
const MERGE_M: f64 = 1.5;
/// A track that the CAV detected within this time is one that it sees, ns: one miss is no absence.
const SEEN_NS: i64 = 100_000_000;

/// The station.
#[derive(Debug)]
pub struct Station<'a> {
    town: &'a Town,
    route: &'a Route,
    frame: Frame,
    settings: &'a Settings,
    provider: Provider,
    observer: Observer,
    tracker: Tracker,
    /// When the CAV saw each track last, by id, ns.
    seen_by_cav: BTreeMap<i64, i64>,
    /// What its own sensors saw in this period, with its time, ns.
    seen: Option<(i64, Vec<Detection>)>,
    /// Distance of the farthest detection of the CAV, m.
    reach: f64,
    /// What it asks before it sends, if it asks.
    asking: Option<Asking<'a>>,
    /// The CAV's own tracks, which it sends while its MOT is not remote.
    of_cav: Option<(i64, Vec<Track>)>,
    /// Detections that came before the own tracks of their time.
    waiting: Option<(i64, Ego, Vec<Detection>)>,
    signals: Vec<f64>,
    near_s: Option<f64>,
    offered_ns: Option<i64>,
    /// How often MOT, and ENV with TPL, ran.
    pub executions: [u64; 2],
}

impl<'a> Station<'a> {
    /// A station along a route, whose cross sections are given.
    pub fn new(
        (town, route): (&'a Town, &'a Route),
        frame: Frame,
        settings: &'a Settings,
        cross_sections: &[CrossSection],
    ) -> Self {
        Self {
            town,
            route,
            frame,
            settings,
            provider: Provider::new(4, DEFAULT_LEASE_NS),
            observer: Observer {
                seed: [settings.seed, 3],
                detectors: sensors::beside(route, settings.errors),
                merge_radius: MERGE_M,
            },
            tracker: Tracker::default(),
            seen_by_cav: BTreeMap::new(),
            seen: None,
            reach: 0.0,
            asking: Asking::new(settings, cross_sections),
            of_cav: None,
            waiting: None,
            signals: Vec::new(),
            near_s: None,
            offered_ns: None,
            executions: [0; 2],
        }
    }

    /// Its sensors look, and it says what it offers when that is due.
    pub fn sense(&mut self, now_ns: i64, truth: &Snapshot, radio: &mut Radio) {
        let objects = truth.seen();
        let cycle = truth.time_ns.unsigned_abs();
        let observation = self.observer.observe(&objects, truth.ego.rear, cycle);
        self.seen = Some((now_ns, observation.detections));
        self.signals = truth.closed_signals();
        self.near_s = Some(truth.ego.s);
        self.happens(now_ns, ProviderEventKind::Tick, radio);
        if self.offered_ns.is_none_or(|last_ns| now_ns - last_ns >= OFFERS_NS) {
            self.offered_ns = Some(now_ns);
            self.send(now_ns, 0, Payload::Offer { groups: self.settings.offers }, radio);
        }
    }

    /// Takes a message.
    pub fn take(&mut self, now_ns: i64, bytes: &[u8], attacker: &mut Attacker, radio: &mut Radio) {
        let Ok(message) = message::decode(bytes, &self.frame) else { return };
        let Message { sender: requester, receiver, payload, .. } = message;
        if receiver != ids::STATION {
            return;
        }
        match payload {
            Payload::Request { .. } | Payload::Release { .. } | Payload::Alive { .. } => {
                if let Some(kind) = asked(requester, &payload) {
                    self.happens(now_ns, kind, radio);
                }
            }
            Payload::Detections { stamp_ns, ego, detections } => {
                if self.waits(requester, stamp_ns) {
                    self.waiting = Some((stamp_ns, ego, detections));
                    return;
                }
                self.compute(now_ns, requester, stamp_ns, &ego, &detections, attacker, radio);
            }
            Payload::Tracks { stamp_ns, tracks, .. } => {
                self.of_cav = Some((stamp_ns, tracks));
                let waiting = self.waiting.take().filter(|it| it.0 == stamp_ns);
                if let Some((_, ego, detections)) = waiting {
                    self.compute(now_ns, requester, stamp_ns, &ego, &detections, attacker, radio);
                }
            }
            Payload::State { .. }
            | Payload::Offer { .. }
            | Payload::Withdraw
            | Payload::Confirm { .. }
            | Payload::Reject { .. }
            | Payload::Trajectory { .. } => {}
        }
    }

    /// Computes for the CAV, as far as it has sessions, and what the attacker makes of it is sent.
    #[expect(clippy::too_many_arguments, reason = "a message and what it is answered with")]
    fn compute(
        &mut self,
        now_ns: i64,
        requester: i64,
        stamp_ns: i64,
        ego: &Ego,
        detections: &[Detection],
        attacker: &mut Attacker,
        radio: &mut Radio,
    ) {
        let sessions = self.sessions(requester);
        if sessions == [None, None] {
            return;
        }
        self.reach = reach(ego, detections);
        let tracks = self.track(stamp_ns, detections.to_vec());
        self.note(stamp_ns, detections, &tracks);
        if let Some(asking) = &mut self.asking {
            asking.see(stamp_ns, detections);
        }
        let known = Known {
            configuration: configuration(sessions),
            now_ns: stamp_ns + DECIDES_NS,
            ego: driven_on(ego, DECIDES_NS),
            detections: DetectionList { stamp_ns, items: detections },
            lead: None,
            grid: None,
        };
        let all = self.with_those_of_cav(&known, &tracks);
        let sent = match &mut self.asking {
            Some(asking) if sessions[0].is_some() => asking.tracks(&known, (stamp_ns, tracks)),
            Some(_) => None,
            None => {
                let seen = tracks.into_iter().filter(|it| self.can_be_checked(stamp_ns, ego, it));
                Some(seen.collect())
            }
        };
        let plans = sessions[1].is_some();
        let points = plans.then(|| self.plan(&known, ego, &all, sent.as_deref(), attacker));
        // Where not even an empty list passes there is nothing to send.
        let sessions = [sessions[0].filter(|_| sent.is_some()), sessions[1]];
        let tracks = sent.unwrap_or_default();
        let mut results = Results { stamp_ns, tracks, points: points.unwrap_or_default() };
        attacker.results(ego, &mut results);
        let done_ns = now_ns + COMPUTES_NS + attacker.delay_ns();
        let held_ns = attacker.held_ns();
        let Results { stamp_ns, tracks, points } = results;
        attacker.saw(sessions);
        if let Some(session) = sessions[0] {
            let payload = Payload::Tracks { session, stamp_ns, tracks };
            self.send_held(done_ns, held_ns, (requester, payload), radio);
        }
        if let Some(session) = sessions[1].filter(|_| !points.is_empty()) {
            let payload = Payload::Trajectory { session, stamp_ns, points };
            self.send_held(done_ns, held_ns, (requester, payload), radio);
        }
    }

    /// MOT, on the detections of the CAV and on those of the station's own sensors of the same time.
    fn track(&mut self, stamp_ns: i64, mut detections: Vec<Detection>) -> Vec<Track> {
        self.executions[0] += 1;
        if let Some((_, seen)) = self.seen.as_ref().filter(|(seen_ns, _)| *seen_ns == stamp_ns) {
            let at = |it: &Detection| Point::new(it.x, it.y);
            for own in seen {
                if detections.iter().all(|it| at(it).distance(at(own)) > MERGE_M) {
                    detections.push(*own);
                }
            }
        }
        self.tracker.update(stamp_ns, &detections);
        self.tracker.tracks(stamp_ns)
    }

    /// Takes down which tracks the CAV sees now.
    fn note(&mut self, stamp_ns: i64, detections: &[Detection], tracks: &[Track]) {
        for track in tracks {
            let at = Point::new(track.x, track.y);
            if detections.iter().any(|it| at.distance(Point::new(it.x, it.y)) < MERGE_M) {
                self.seen_by_cav.insert(track.id, stamp_ns);
            }
        }
        self.seen_by_cav.retain(|id, _| tracks.iter().any(|it| it.id == *id));
    }

    /// Whether the CAV saw the track just now, or it is beyond what it sees: stage i fails for an object
    /// that is hidden from the CAV, so that such a one is for the station's planner alone.
    fn can_be_checked(&self, stamp_ns: i64, ego: &Ego, track: &Track) -> bool {
        let seen_ns = self.seen_by_cav.get(&track.id);
        let is_seen = seen_ns.is_some_and(|seen_ns| stamp_ns - seen_ns <= SEEN_NS);
        is_seen || distance(ego, track.x, track.y) > self.reach + MERGE_M
    }

    /// The tracks, and in `PlanRemote` those of the CAV that the station does not have.
    fn with_those_of_cav(&self, known: &Known<'_>, tracks: &[Track]) -> Vec<Track> {
        let mut all = tracks.to_vec();
        if let Some(own) = self.of_cav(known) {
            let at = |it: &Track| Point::new(it.x, it.y);
            let is_new = |it: &&Track| tracks.iter().all(|own| at(own).distance(at(it)) > MERGE_M);
            all.extend(own.items.iter().filter(is_new));
        }
        all
    }

    /// The CAV's own tracks of this moment, which stage iii compares with in `PlanRemote`.
    fn of_cav(&self, known: &Known<'_>) -> Option<TrackList<'_>> {
        let (stamp_ns, items) = self.of_cav.as_ref()?;
        let is_used = known.configuration == Configuration::PlanRemote;
        let is_of_now = *stamp_ns == known.detections.stamp_ns;
        (is_used && is_of_now).then_some(TrackList { stamp_ns: *stamp_ns, items })
    }

    /// Whether the CAV's own tracks of a moment, which it asks with, are still under way.
    fn waits(&self, requester: i64, stamp_ns: i64) -> bool {
        let is_here = self.of_cav.as_ref().is_some_and(|(own_ns, _)| *own_ns == stamp_ns);
        let configuration = configuration(self.sessions(requester));
        self.asking.is_some() && configuration == Configuration::PlanRemote && !is_here
    }

    /// The sessions of a vehicle, by group.
    fn sessions(&self, requester: i64) -> [Option<i64>; 2] {
        let session = |group| self.provider.session(requester, bridge::group_from_impl(group));
        Group::ALL.map(session)
    }

    /// ENV and TPL. With a station that asks: the first plan that passes beside the tracks that are sent, or none;
    /// an attacker who feeds or owns the planner asks nobody.
    fn plan(
        &mut self,
        known: &Known<'_>,
        ego: &Ego,
        tracks: &[Track],
        sent: Option<&[Track]>,
        attacker: &Attacker<'_>,
    ) -> Vec<TrajectoryPoint> {
        self.executions[1] += 1;
        let stamp_ns = known.detections.stamp_ns;
        let believed = attacker.believed(stamp_ns, ego, tracks);
        let elsewhere = attacker.route();
        let is_honest = elsewhere.is_none() && believed == tracks;
        let list = TrackList { stamp_ns, items: &believed };
        let (near_s, signals) = match elsewhere {
            None => (self.near_s, &*self.signals),
            Some(_) => (None, &[][..]),
        };
        let route = elsewhere.unwrap_or(self.route);
        let road = Road { town: self.town, route, near_s, signals };
        let plan = plan(stamp_ns, ego, &road, &list);
        let mut asking = self.asking.take();
        let first = match asking.as_mut().filter(|_| is_honest) {
            Some(asking) => {
                let sent = sent.map(|items| TrackList { stamp_ns, items });
                let all = [plan].into_iter().chain(slower(stamp_ns, ego, &road, &list));
                asking.first(known, sent.or(self.of_cav(known)), stamp_ns, all).unwrap_or_default()
            }
            None => plan,
        };
        self.asking = asking;
        first
    }

    fn happens(&mut self, t_ns: i64, kind: ProviderEventKind, radio: &mut Radio) {
        if let Some(reply) = self.provider.step(&ProviderEvent { t_ns, kind }) {
            let (requester, payload) = replied(reply);
            self.send(t_ns, requester, payload, radio);
        }
    }

    fn send(&self, now_ns: i64, vehicle: i64, payload: Payload, radio: &mut Radio) {
        self.send_held(now_ns, Some(0), (vehicle, payload), radio);
    }

    /// Sends what is held back on the link for so long, ns; none: for ever.
    fn send_held(
        &self,
        now_ns: i64,
        held_ns: Option<i64>,
        (vehicle, payload): (i64, Payload),
        radio: &mut Radio,
    ) {
        let message =
            Message { sender: ids::STATION, receiver: vehicle, generated_ns: now_ns, payload };
        // What the formats cannot hold is not sent: the link is silent then.
        if let Ok(bytes) = message::encode(&message, &self.frame) {
            radio.hold(now_ns, held_ns, To::Vehicle, bytes);
        }
    }
}

/// The CAV so much later, ns, if it speeds up all the time: what it is to pass then is farther.
fn driven_on(ego: &Ego, later_ns: i64) -> Ego {
    let (dt, acceleration) = (seconds(later_ns), tpl::settings::ACCELERATION);
    let way = (ego.speed + 0.5 * acceleration * dt) * dt;
    let Ego { x, y, cos, sin, speed, .. } = *ego;
    Ego { x: x + way * cos, y: y + way * sin, speed: speed + acceleration * dt, ..*ego }
}

fn distance(ego: &Ego, x: f64, y: f64) -> f64 {
    Point::new(ego.x, ego.y).distance(Point::new(x, y))
}

/// Distance of the farthest detection, m.
fn reach(ego: &Ego, detections: &[Detection]) -> f64 {
    detections.iter().map(|it| distance(ego, it.x, it.y)).fold(0.0, f64::max)
}
