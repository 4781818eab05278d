//! The monitor, which a vehicle calls in the order of its periods (`spec/monitor.md`).
//!
//! [`Monitor::step`] takes one event in one state. Beneath it are the requester and the stages, as they are:
//! the monitor gives the stages their inputs and the requester the verdict.
//!
//! | part of the page | here |
//! |---|---|
//! | what comes out | `cycle` |
//! | what a cycle uses | [`elements`], `cycle` |
//! | the history of detections | [`history`] |
//! | memory, settings | [`settings`] |
//! | elements that no cycle can use | [`elements`], [`wait`] |
//! | the wait after a session | [`wait`] |
//! | when to brake | [`brake_by`] |
//! | ticks | [`ticks`] |
//! | local services | [`supervision`] |
//! | where planning gets nowhere | [`stall`] |

pub mod brake_by;
pub mod elements;
pub mod history;
pub mod messages;
pub mod settings;
pub mod stall;
pub mod supervision;
pub mod ticks;
pub mod wait;

mod cycle;
mod inspect;

use std::collections::BTreeMap;

use crate::cycle::check;
use crate::input::cycle::{Cycle, Route, TrackList, Trajectory};
use crate::offloading::requester::{self, Action, Requester};
use crate::report::{InvalidInput, Reading, Report};
use crate::services::configuration::{Group, Groups};
use elements::{Arrival, Element};
use history::History;
use messages::{Answer, Brake, Dropped, Event, EventKind};
use settings::{Settings, fits};
use stall::Progress;
use ticks::Ticks;
use wait::Use;

/// The state of a monitor.
#[derive(Clone, Debug)]
pub struct Monitor {
    settings: Settings,
    route: Route,
    /// How the stages decide.
    reading: Reading,
    requester: Requester,
    /// The use of each running session, by its number.
    uses: BTreeMap<Group, (i64, Use)>,
    tracks: Option<Element<TrackList>>,
    trajectory: Option<Element<Trajectory>>,
    history: History,
    ticks: Ticks,
    progress: Progress,
    /// What the last decision said of braking at once.
    brake: Option<Brake>,
}

/// What the stages say of a cycle; `Err` is invalid local input.
pub type Judge<'a> = &'a dyn Fn(&Cycle) -> Result<Report, InvalidInput>;

/// What an event made the monitor do, beside its state.
#[derive(Default)]
struct Done {
    actions: Vec<Action>,
    dropped: Option<Dropped>,
}

impl Monitor {
    /// Everything local. `Err` names the first setting that is refused, or a route that is invalid or does not fit.
    /// `spec/monitor.md`, settings and memory.
    pub fn new(settings: Settings, route: Route, reading: Reading) -> Result<Self, InvalidInput> {
        settings.check(&route)?;
        let requester = Requester::new(settings.profile, settings.requester)
            .numbered_on_from(settings.last_session); // [MON-28]
        Ok(Self {
            settings,
            route,
            reading,
            requester,
            uses: BTreeMap::new(),
            tracks: None,
            trajectory: None,
            history: History::default(),
            ticks: Ticks::default(),
            progress: Progress::new(),
            brake: None,
        })
    }

    /// Takes one event, or decides one cycle.
    pub fn step(&mut self, event: Event) -> Answer {
        let reading = self.reading;
        self.step_judged(event, &|cycle| check(cycle, reading))
    }

    /// As [`Self::step`], with another judge in place of the stages: an exploration asks what follows from
    /// any verdict.
    pub fn step_judged(&mut self, event: Event, judge: Judge<'_>) -> Answer {
        use requester::EventKind as Protocol;
        let Event { t_ns, kind } = event;
        let mut decision = None;
        let done = match kind {
            EventKind::Offer { station, groups } => {
                self.tell(t_ns, Protocol::Offer { station, groups })
            }
            EventKind::Withdraw { station } => self.tell(t_ns, Protocol::Withdraw { station }),
            EventKind::Lost { station } => self.tell(t_ns, Protocol::Lost { station }),
            EventKind::Area { groups } => self.tell(t_ns, Protocol::Area { groups }),
            EventKind::Tick => self.tick(t_ns),
            EventKind::Confirm { station, group, session } => {
                self.tell(t_ns, Protocol::Confirm { station, group, session })
            }
            EventKind::Reject { station, group, session } => {
                self.tell(t_ns, Protocol::Reject { station, group, session })
            }
            EventKind::Tracks { station, session, generated_ns, tracks } => {
                self.tracks(Arrival::new(t_ns, station, session, generated_ns), tracks)
            }
            EventKind::Trajectory { station, session, generated_ns, trajectory } => {
                self.trajectory(Arrival::new(t_ns, station, session, generated_ns), trajectory)
            }
            EventKind::Cycle { measured } => {
                let (decided, done) = self.cycle(t_ns, *measured, judge);
                decision = Some(decided);
                done
            }
        };
        Answer {
            mot: self.requester.state(Group::Mot),
            plan: self.requester.state(Group::Plan),
            hold_until_ns: self.requester.hold_until_ns(),
            actions: done.actions,
            dropped: done.dropped,
            given_back_ns: self.progress.given_back_ns,
            decision,
        }
    }

    /// Results of MOT arrive.
    fn tracks(&mut self, arrival: Arrival, list: TrackList) -> Done {
        let has_places = fits(&list.items, self.settings.memory.tracks);
        let done = self.data(Group::Mot, arrival, list.stamp_ns, has_places);
        if done.dropped.is_none() {
            self.tracks = Some(arrival.element(list));
        }
        done
    }

    /// A result of PLAN arrives.
    fn trajectory(&mut self, arrival: Arrival, trajectory: Trajectory) -> Done {
        let done = self.data(Group::Plan, arrival, trajectory.stamp_ns, true);
        if done.dropped.is_none() {
            self.trajectory = Some(arrival.element(trajectory));
        }
        done
    }

    /// [MON-09] [MON-20] [MON-30] [MON-32]
    fn data(&mut self, group: Group, arrival: Arrival, stamp_ns: i64, fits: bool) -> Done {
        let Arrival { t_ns, station, session, generated_ns } = arrival;
        let (running, protocol) = (self.requester.session_of(group), self.settings.requester);
        if arrival.is_of(running) {
            let starved = self.uses.get(&group).is_some_and(|(_, it)| it.starved);
            let max_age_ns = self.settings.parameters.max_age_ns;
            let times = [protocol.l_max_ns, max_age_ns];
            if let Some(why) = arrival.unheard(stamp_ns, fits, starved, times) {
                return Done { actions: vec![Action::Drop(group)], dropped: Some(why) };
            }
        }
        let dropped = arrival.dropped(running, &protocol);
        let data = requester::EventKind::Data { station, group, session, generated_ns };
        Done { dropped, ..self.tell(t_ns, data) }
    }

    /// A tick, before which PLAN may be given back, and requests may be held.
    fn tick(&mut self, t_ns: i64) -> Done {
        self.ticks.tick(t_ns);
        // [MON-43] [MON-44]
        if history::is_kept(self.settings.profile) && !self.history.has_seen_long(t_ns) {
            self.requester.hold_at_least(t_ns.saturating_add(1));
        }
        let is_remote = self.requester.configuration().remote().plan;
        let is_stalled = |stall| is_remote && self.progress.is_stalled(stall);
        if !self.settings.stall.as_ref().is_some_and(is_stalled) {
            return self.tell(t_ns, requester::EventKind::Tick);
        }
        // [MON-54] [MON-57] [MON-58]: out of the area for a moment; the hold alone bars requests.
        self.progress.give_back(t_ns);
        self.requester.hold_at_least(t_ns.saturating_add(self.settings.requester.t_wait_ns));
        let groups = self.requester.in_area();
        let outside = Groups { plan: false, ..groups };
        let events = [
            requester::EventKind::Area { groups: outside },
            requester::EventKind::Area { groups },
            requester::EventKind::Tick,
        ];
        let mut actions: Vec<Action> =
            events.into_iter().flat_map(|kind| self.tell(t_ns, kind).actions).collect();
        actions.sort_by_key(|action| action.place());
        Done { actions, dropped: None }
    }

    /// Gives the requester an event. When it ends sessions, their waits begin before it: so no request of
    /// the same tick is sent in them. [MON-34] [MON-38] [MON-39] [MON-64]
    fn tell(&mut self, t_ns: i64, kind: requester::EventKind) -> Done {
        let event = requester::Event { t_ns, kind };
        let mut after = self.requester.clone();
        after.step(&event);
        for (group, (number, used)) in &self.uses {
            let goes_on = after.session_of(*group).is_some_and(|it| it.number == *number);
            let end = used.wait_until_ns(t_ns, self.settings.period_ns);
            if let Some(until_ns) = end.filter(|_| !goes_on) {
                self.requester.hold_at_least(until_ns);
            }
        }
        let actions = self.requester.step(&event);
        for group in Group::ALL {
            let running = self.requester.session_of(group).map(|session| session.number);
            let known = self.uses.get(&group).map(|(number, _)| *number);
            match running {
                None => drop(self.uses.remove(&group)),
                Some(number) if known == Some(number) => {}
                Some(number) => drop(self.uses.insert(group, (number, Use::confirmed(t_ns)))),
            }
        }
        Done { actions, dropped: None }
    }
}
