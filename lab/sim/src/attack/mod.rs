//! Somebody at the station, or on the link, who wants the CAV to crash or to stand still.
//!
//! The attacker knows everything: the truth, the rules, the sessions. An attack is an item with a start, an
//! end and a seed; several go on at the same time.

mod empty;
pub mod means;
mod tracks;
mod trajectory;

use std::collections::VecDeque;

use mufasa::input::cycle::{Ego, Track, TrajectoryPoint};
pub use mufasa_drives::Attack as Kind;
use mufasa_link::message::{self, Frame, Message, Payload};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use self::means::{Lists, Means};
use crate::ids;
use crate::map::route::Route;
use crate::radio::{Radio, To};
use crate::snapshot::Snapshot;

/// An attack.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Attack {
    /// What it does.
    pub kind: Kind,
    /// From when on, s.
    pub from: f64,
    /// Until when, s.
    pub until: f64,
    /// For what it draws.
    pub seed: u64,
    /// How much, and to whom.
    pub means: Means,
}

impl Attack {
    /// An attack of the experiments, between two times, s.
    pub const fn new(kind: Kind, from: f64, until: f64, seed: u64) -> Self {
        Self { kind, from, until, seed, means: Means::of(kind) }
    }

    /// Whether it goes on.
    pub fn is_on(&self, t_ns: i64) -> bool {
        let t = crate::time::seconds(t_ns);
        self.from <= t && t < self.until
    }
}

/// What a station is about to send.
#[derive(Clone, Debug)]
pub struct Results {
    /// What they are of, ns.
    pub stamp_ns: i64,
    /// The result of MOT.
    pub tracks: Vec<Track>,
    /// The result of PLAN.
    pub points: Vec<TrajectoryPoint>,
}

/// Results that are kept to be replayed, one in a period, and how many come in a second.
const KEPT: usize = 100;
const PER_SECOND: f64 = 10.0;
/// Messages of a flood in each step of 10 ms.
const FLOOD: u8 = 10;

/// Who makes the attacks of a run.
#[derive(Debug)]
pub struct Attacker<'a> {
    attacks: Vec<Attack>,
    /// Another route than the CAV's, for the planner.
    elsewhere: Option<&'a Route>,
    truth: Option<Snapshot>,
    sessions: [Option<i64>; 2],
    earlier: VecDeque<Results>,
    now_ns: i64,
}

impl<'a> Attacker<'a> {
    /// Who makes these attacks.
    pub const fn new(attacks: Vec<Attack>, elsewhere: Option<&'a Route>) -> Self {
        Self {
            attacks,
            elsewhere,
            truth: None,
            sessions: [None; 2],
            earlier: VecDeque::new(),
            now_ns: 0,
        }
    }

    /// Sees everything, once in a period.
    pub fn look(&mut self, now_ns: i64, truth: &Snapshot) {
        self.now_ns = now_ns;
        self.truth = Some(truth.clone());
    }

    /// Whether some attack goes on.
    pub fn is_on(&self, t_ns: i64) -> bool {
        self.attacks.iter().any(|attack| attack.is_on(t_ns))
    }

    fn does(&self, kind: Kind) -> bool {
        self.means(kind).is_some()
    }

    /// Those of the first attack of a kind that goes on.
    fn means(&self, kind: Kind) -> Option<&Means> {
        self.attack(kind).map(|attack| &attack.means)
    }

    fn attack(&self, kind: Kind) -> Option<&Attack> {
        let mut going_on = self.attacks.iter().filter(|it| it.kind == kind);
        going_on.find(|attack| attack.is_on(self.now_ns))
    }

    /// The tracks that the planner of the station believes in.
    pub fn believed(&self, stamp_ns: i64, ego: &Ego, tracks: &[Track]) -> Vec<Track> {
        let mut tracks = tracks.to_vec();
        if let Some(attack) = self.attack(Kind::EmptyTracks) {
            empty::believed(attack, stamp_ns, ego, &mut tracks);
        }
        self.lie(stamp_ns, ego, Lists::Planner, &mut tracks);
        tracks
    }

    /// The route on which it plans, if it is another.
    pub fn route(&self) -> Option<&'a Route> {
        self.elsewhere.filter(|_| self.does(Kind::WrongMap))
    }

    /// What is made of the results before they are sent.
    pub fn results(&mut self, ego: &Ego, results: &mut Results) {
        self.earlier.push_back(results.clone());
        if self.earlier.len() > KEPT {
            self.earlier.pop_front();
        }
        let Results { stamp_ns, tracks, points } = results;
        if let Some(attack) = self.attack(Kind::EmptyTracks) {
            empty::sent(attack, ego, tracks);
        }
        self.lie(*stamp_ns, ego, Lists::Cav, tracks);
        if let Some(means) = self.means(Kind::Replay)
            && let Some(old) =
                self.earlier.get(self.earlier.len().saturating_sub(results_in(means)))
        {
            let later_ns = *stamp_ns - old.stamp_ns;
            tracks.clone_from(&old.tracks);
            *points = old.points.iter().map(|it| later(it, later_ns)).collect();
        }
        for attack in self.attacks.iter().filter(|it| it.is_on(self.now_ns)) {
            trajectory::spoil(attack, ego, points);
        }
        *stamp_ns += self.means(Kind::StampsAhead).map_or(0, |means| nanoseconds(means.late_s));
    }

    fn lie(&self, stamp_ns: i64, ego: &Ego, whose: Lists, list: &mut Vec<Track>) {
        let Some(truth) = &self.truth else { return };
        let going_on = self.attacks.iter().filter(|it| it.is_on(self.now_ns));
        for attack in going_on.filter(|it| it.means.spoils(whose)) {
            tracks::spoil(attack, truth, stamp_ns, ego, list);
        }
    }

    /// How much later results are made and sent, ns.
    pub fn delay_ns(&self) -> i64 {
        self.means(Kind::Delay).map_or(0, |means| nanoseconds(means.late_s))
    }

    /// How long the link holds back results that were made in time, ns; none: for ever.
    pub fn held_ns(&self) -> Option<i64> {
        let held_ns = self.means(Kind::HeldBack).map_or(0, |means| nanoseconds(means.late_s));
        (!self.does(Kind::Silent)).then_some(held_ns)
    }

    /// The sessions of the CAV, which the attacker reads from the link.
    pub const fn saw(&mut self, sessions: [Option<i64>; 2]) {
        self.sessions = sessions;
    }

    /// What is sent in the name of the station, in each step.
    pub fn forge(&self, now_ns: i64, frame: &Frame, radio: &mut Radio) {
        let message = |payload| Message {
            sender: ids::STATION,
            receiver: ids::CAV,
            generated_ns: now_ns,
            payload,
        };
        let mut send = |message: &Message| {
            if let Ok(bytes) = message::encode(message, frame) {
                radio.forge(now_ns, To::Vehicle, bytes);
            }
        };
        if self.attack(Kind::EmptyTracks).is_some_and(empty::is_forged)
            && let Some(session) = self.sessions[0]
        {
            send(&message(Payload::Tracks { session, stamp_ns: now_ns, tracks: Vec::new() }));
        }
        if self.does(Kind::Flood) {
            for _ in 0..FLOOD / 2 {
                send(&message(Payload::Tracks {
                    session: 1 << 40,
                    stamp_ns: now_ns,
                    tracks: Vec::new(),
                }));
            }
            for byte in 0..FLOOD / 2 {
                radio.forge(now_ns, To::Vehicle, vec![byte; 40]);
            }
        }
    }

    /// What becomes of a message behind the CAV's decoder, which this attacker owns: numbers that the
    /// formats cannot hold come in here.
    pub fn decoded(&self, message: &mut Message) {
        if !self.does(Kind::NotFinite) {
            return;
        }
        match &mut message.payload {
            Payload::Tracks { tracks, .. } => {
                for (index, track) in tracks.iter_mut().enumerate() {
                    track.vx = if index % 2 == 0 { f64::NAN } else { f64::INFINITY };
                }
            }
            Payload::Trajectory { points, .. } => {
                for point in points.iter_mut().skip(1) {
                    point.x = f64::NAN;
                }
            }
            _ => {}
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "some seconds")]
fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

/// How many results ago, at least the present one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held to 100")]
fn results_in(means: &Means) -> usize {
    ((means.late_s * PER_SECOND).round().max(1.0) as usize).min(KEPT)
}

fn later(point: &TrajectoryPoint, by_ns: i64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: point.t_ns + by_ns, ..*point }
}
