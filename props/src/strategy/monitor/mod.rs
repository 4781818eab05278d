//! Sequences of events and cycles for a monitor, which aim at every time that its rules compare.
//!
//! A [`Script`] reads a tape and the answers so far: so it meets deadlines, holds and sessions as they come.

mod scene;
mod settings;
mod times;

pub use self::scene::route;

use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::Monitor;
use mufasa_model::monitor::messages::{Answer, Event, EventKind};
use mufasa_model::monitor::settings::Settings;
use mufasa_model::offloading::requester::GroupState;
use mufasa_model::report::Reading;
use mufasa_model::services::configuration::{Group, Groups};

use self::scene::Scene;
use self::settings::{accepted, at_a_bound};
use self::times::{MS, Times};
use super::draw::Draw;

/// The sets that an offer or an area may have, that of both more often.
const SETS: [Groups; 5] = [
    Groups::ALL,
    Groups::ALL,
    Groups { mot: true, plan: false },
    Groups { mot: false, plan: true },
    Groups::NONE,
];

/// How many events and cycles a whole sequence has.
const STEPS: [usize; 3] = [150, 60, 400];

/// A whole sequence: settings, one of which may be at a bound of what is refused, and events, none where one is.
pub fn sequence(tape: &[u32], profile: Profile) -> (Settings, Vec<Event>) {
    let (own, tape) = tape.split_at(tape.len().min(4));
    let (mut script, mut settings) = Script::new(tape, profile);
    let mut draw = Draw::new(own);
    let steps = draw.pick(&STEPS);
    if draw.one_in(12) {
        at_a_bound(&mut draw, &mut settings);
        script.settings = settings.clone();
    }
    let Ok(mut model) = Monitor::new(settings.clone(), route(), Reading::Exact) else {
        return (settings, Vec::new());
    };
    let step = |_| {
        let event = script.event();
        script.take(&event, &model.step(event.clone()));
        event
    };
    let events = (0..steps).map(step).collect();
    (settings, events)
}

/// A sequence that goes on for ever; behind the end of the tape it is the simplest one.
#[derive(Debug)]
pub struct Script<'t> {
    draw: Draw<'t>,
    settings: Settings,
    now_ns: i64,
    /// MOT and PLAN.
    groups: [GroupState; 2],
    /// Number of the last session that was asked for.
    last_session: i64,
    times: Times,
    scene: Scene,
    /// Where in a period the sequence is.
    phase: usize,
    /// Cycles that come before anything else, at these times.
    cycles_at: Vec<i64>,
    /// How much rarer anything odd is: long sessions are of use for long.
    calm: usize,
    /// For how many periods still each stamp is so much later than it is honest.
    habit: (usize, i64),
}

impl<'t> Script<'t> {
    /// A sequence for a monitor of this profile, and its settings.
    pub fn new(tape: &'t [u32], profile: Profile) -> (Self, Settings) {
        let mut draw = Draw::new(tape);
        let settings = accepted(&mut draw, profile);
        let now_ns = draw.pick(&[0, 0, 1_000_000 * MS, 1_000_000_000_000 * MS]);
        let calm = draw.pick(&[1, 4, 20]);
        let script = Self {
            draw,
            settings: settings.clone(),
            now_ns,
            groups: [GroupState::Local; 2],
            last_session: settings.last_session,
            times: Times::default(),
            scene: Scene::default(),
            phase: 0,
            cycles_at: (1..=6).map(|i| now_ns + i * 100 * MS).rev().collect(),
            calm,
            habit: (0, 0),
        };
        (script, settings)
    }

    /// The next event.
    pub fn event(&mut self) -> Event {
        let kind = self.kind();
        Event { t_ns: self.now_ns, kind }
    }

    /// What became of it.
    pub fn take(&mut self, event: &Event, answer: &Answer) {
        self.groups = [answer.mot, answer.plan];
        for state in self.groups {
            if let GroupState::Requested { session, .. } = state {
                self.last_session = self.last_session.max(session);
            }
        }
        self.times.take(event, answer);
    }

    fn kind(&mut self) -> EventKind {
        if let Some(t_ns) = self.cycles_at.pop() {
            self.now_ns = t_ns.max(self.now_ns);
            return self.cycle();
        }
        if self.draw.one_in(12 * self.calm) {
            return self.any();
        }
        if self.draw.one_in(16 * self.calm) {
            self.aim();
        }
        loop {
            let phase = self.phase;
            self.phase = (phase + 1) % 7;
            // Messages are lost more often: the cycle then has the element before.
            let is_message = matches!(phase, 4 | 5);
            let is_left_out = self.draw.one_in(if is_message { 8 } else { 30 * self.calm });
            let kind = match phase {
                0 => {
                    self.period();
                    let is_due = self.now_ns == 0 || self.draw.one_in(6);
                    let station = self.draw.pick(&[1, 1, 2, 3]);
                    is_due.then_some(EventKind::Offer { station, groups: Groups::ALL })
                }
                1 => Some(EventKind::Tick),
                2 => self.confirm(Group::Mot),
                3 => self.confirm(Group::Plan),
                4 => self.result(Group::Mot),
                5 => self.result(Group::Plan),
                _ => Some(self.cycle()),
            };
            if let Some(kind) = kind.filter(|_| !is_left_out) {
                return kind;
            }
        }
    }

    fn state(&self, group: Group) -> GroupState {
        match group {
            Group::Mot => self.groups[0],
            Group::Plan => self.groups[1],
        }
    }

    /// A new period: mostly 100 ms later, or at a time that something is decided by.
    fn period(&mut self) {
        if self.habit.0 > 0 {
            self.habit.0 -= 1;
        } else if self.draw.one_in(12 * self.calm) {
            let ahead_ns = self.draw.pick(&[60 * MS, 150 * MS, 1_000 * MS, -40 * MS, -90 * MS]);
            self.habit = (self.draw.between(2, 6), ahead_ns);
        } else {
            self.habit = (0, 0);
        }
        if self.draw.one_in(20 * self.calm) {
            return self.set_back();
        }
        if self.draw.one_in(3 * self.calm) {
            return self.aim();
        }
        self.now_ns += self.draw.pick(&[100, 100, 100, 50, 90]) * MS;
        let is_held = self.times.hold_until_ns.is_some_and(|it| it > self.now_ns);
        let is_local = self.groups == [GroupState::Local; 2];
        if is_held && is_local && self.draw.one_in(3) {
            self.wait_for_the_hold();
        }
    }

    /// To the end of the hold, with cycles before it, so that a history is there.
    fn wait_for_the_hold(&mut self) {
        let Some(end_ns) = self.times.hold_until_ns else { return };
        if end_ns.saturating_sub(self.now_ns) > 20_000 * MS {
            return;
        }
        let before = [100, 300, 500 + i64::from(self.draw.one_in(4)), 700];
        let times = before.map(|ms| end_ns - ms * MS);
        self.cycles_at = times.into_iter().filter(|it| *it > self.now_ns).collect();
        self.times.aimed_ns = Some(end_ns + self.draw.pick(&[0, 0, 1, -1]));
    }

    /// To one of the times that the next event may be before, at or behind.
    fn aim(&mut self) {
        let (now_ns, settings) = (self.now_ns, &self.settings);
        let bounds = self.times.bounds(settings, self.groups);
        let near = now_ns..now_ns.saturating_add(3_000 * MS);
        let mut near: Vec<i64> = bounds.into_iter().filter(|it| near.contains(it)).collect();
        if let Some(aimed_ns) = self.times.aimed_ns.take().filter(|it| *it >= now_ns) {
            near = vec![aimed_ns];
        }
        if near.is_empty() {
            return;
        }
        let at_ns = near[self.draw.below(near.len())];
        self.now_ns = self.draw.near_ns(at_ns).max(now_ns);
    }

    fn set_back(&mut self) {
        let back_ns = self.draw.pick(&[60 * MS, 1, 130 * MS, 200 * MS, 999 * MS, 2_000 * MS]);
        let kept_ns = self.times.kept_ns.last().copied().unwrap_or(self.now_ns);
        let at_ns = if self.draw.one_in(3) {
            self.draw.near_ns(kept_ns - 1_000 * MS)
        } else {
            self.now_ns - back_ns
        };
        self.now_ns = at_ns.max(0).min(self.now_ns);
    }

    fn confirm(&mut self, group: Group) -> Option<EventKind> {
        let GroupState::Requested { station, session, .. } = self.state(group) else {
            return None;
        };
        if self.draw.one_in(10) {
            return Some(EventKind::Reject { station, group, session });
        }
        Some(EventKind::Confirm { station, group, session })
    }

    /// A result of the running session, mostly fresh and valid.
    fn result(&mut self, group: Group) -> Option<EventKind> {
        let GroupState::Remote { station, session } = self.state(group) else { return None };
        Some(self.data(group, station, session))
    }

    fn data(&mut self, group: Group, station: i64, session: i64) -> EventKind {
        let l_max_ns = self.settings.requester.l_max_ns;
        let max_age_ns = self.settings.parameters.max_age_ns;
        let draw = &mut self.draw;
        let is_odd = draw.one_in(10 * self.calm);
        let latency_ns = if is_odd { draw.near_ns(l_max_ns) } else { draw.pick(&[0, 10 * MS]) };
        let mut generated_ns = self.now_ns - latency_ns;
        if draw.one_in(20 * self.calm) {
            generated_ns = match (draw.one_in(3), self.times.generated_ns(group)) {
                (true, _) | (_, None) => self.now_ns + 1,
                (false, Some(last_ns)) => draw.near_ns(last_ns),
            };
        }
        let mut stamp_ns = generated_ns + self.habit.1;
        if draw.one_in(10 * self.calm) {
            let oldest_ns = self.now_ns - max_age_ns;
            let stamps = [oldest_ns, oldest_ns - 1, oldest_ns + 1, self.now_ns + 1, self.now_ns];
            stamp_ns = draw.pick(&stamps);
        }
        let is_odd = draw.one_in(10 * self.calm);
        match group {
            Group::Mot => {
                let places = self.settings.memory.tracks;
                let tracks = self.scene.tracks(draw, stamp_ns, is_odd, places);
                EventKind::Tracks { station, session, generated_ns, tracks }
            }
            Group::Plan => {
                let trajectory = self.scene.trajectory(draw, stamp_ns, is_odd);
                EventKind::Trajectory { station, session, generated_ns, trajectory }
            }
        }
    }

    fn cycle(&mut self) -> EventKind {
        let (draw, calm) = (&mut self.draw, 12 * self.calm);
        let last_kept_ns = self.times.kept_ns.last().copied();
        let measured = self.scene.measured(draw, self.now_ns, calm, &self.settings, last_kept_ns);
        EventKind::Cycle { measured: Box::new(measured) }
    }

    /// What nothing asked for.
    fn any(&mut self) -> EventKind {
        let group = Group::ALL[self.draw.below(2)];
        let station = self.draw.pick(&[1, 2, 3]);
        let groups = self.draw.pick(&SETS);
        let session = self.last_session + self.draw.pick(&[0, -1, 1]);
        match self.draw.below(9) {
            0 => EventKind::Offer { station, groups },
            1 => EventKind::Withdraw { station },
            2 => EventKind::Lost { station },
            3 => EventKind::Area { groups },
            4 => EventKind::Reject { station, group, session },
            5 => EventKind::Confirm { station, group, session },
            6 => EventKind::Tick,
            7 => self.cycle(),
            _ => self.data(group, station, session),
        }
    }
}
