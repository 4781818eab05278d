//! The loop of an integrator, by its log: what it does that the safety manual forbids.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::time::Duration;

use mufasa::monitor::{Advice, Monitor, MonitorError, Unusual};
use mufasa::offloading::requester::StationRecord;
use mufasa_model::input::cycle::Route;
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::monitor::messages::{Answer, Event, EventKind};
use mufasa_model::offloading::requester::{Action, GroupState};
use mufasa_model::services::configuration::Groups;
use mufasa_props::bridge::{self, Bridged};
use mufasa_props::lent::Lent;
use mufasa_records::calls::{Call, Follows, Line, Made, Sender};
use mufasa_records::monitor_answer::{MonitorState, VerifiedAnswer};
use mufasa_records::record::Recorded;
use serde_json::{Value, json};

use self::duty::{Duty, Findings};
use self::units::{is_in_another_unit, stamps};
use crate::ended::{Ended, FAILED, cannot};

pub mod duty;
mod units;

/// Replays the calls of a log, writes what is wrong to `out`; the exit code.
pub fn run(file: &Path, out: &mut impl Write) -> Ended {
    let text = fs::read_to_string(file).map_err(cannot(file, "read"))?;
    let bad = |problem: String| format!("{}: {problem}", file.display());
    let (found, seen) = examine(&text).map_err(bad)?;
    writeln!(out, "{}{seen}", found.text(&file.display().to_string()))?;
    Ok(if found.broken().is_empty() { 0 } else { FAILED })
}

/// What is wrong with the loop, and what its log shows. Errors: a line cannot be read, or is out of place.
pub fn examine(text: &str) -> Result<(Findings, String), String> {
    let parsed = text.lines().enumerate().map(|(at, line)| (at + 1, Line::parse(line, at + 1)));
    let mut lines = parsed.peekable();
    let (mut found, mut seen) = (Findings::default(), Seen::default());
    while let Some((number, line)) = lines.next() {
        let Line::Made(made) = line.map_err(|it| it.to_string())? else {
            return Err(format!("line {number}: the log begins with a monitor that is made"));
        };
        let mut calls = Vec::new();
        while let Some(call) = lines.next_if(|(_, it)| !matches!(it, Ok(Line::Made(_)))) {
            calls.push((call.0, call.1.map_err(|it| it.to_string())?));
        }
        replay(number, *made, calls, &mut found, &mut seen)?;
    }
    if seen.cycles == 0 && found.broken().is_empty() {
        return Err("the log has no cycle".to_owned());
    }
    Ok((found, seen.text()))
}

/// What a log shows.
#[derive(Default)]
struct Seen {
    cycles: u64,
    /// The highest session that was asked for.
    session: i64,
    /// What happened, by its name.
    shown: BTreeMap<&'static str, u64>,
}

const SHOWN: [&str; 6] = [
    "safe cycle with remote data",
    "unsafe cycle",
    "message that is dropped",
    "release",
    "followed trajectory of a station",
    "braking",
];

impl Seen {
    fn see(&mut self, what: &'static str, is_so: bool) {
        *self.shown.entry(what).or_default() += u64::from(is_so);
    }

    fn text(&self) -> String {
        let count = |it: &&str| self.shown.get(*it).copied().unwrap_or(0);
        let not: Vec<&str> = SHOWN.into_iter().filter(|it| count(it) == 0).collect();
        let not = if not.is_empty() { "nothing".to_owned() } else { not.join(", ") };
        format!("{} cycles. Not tested, since the log does not show it: {not}.", self.cycles)
    }
}

/// One life of a monitor.
fn replay(
    number: usize,
    made: Made,
    calls: Vec<(usize, Line)>,
    found: &mut Findings,
    seen: &mut Seen,
) -> Result<(), String> {
    let Made { record, check_time_ns, step_ps, meant, stations } = made;
    let sequence = record.into_model();
    let settings = sequence.settings();
    found.check(number, Duty::Sessions, sequence.last_session >= seen.session, || {
        format!(
            "sessions are numbered on from {}, {} was used",
            sequence.last_session, seen.session
        )
    });
    found.check_made(number, settings.profile, check_time_ns);
    let table = vec![StationRecord::FREE; stations];
    let mut lent = Lent { stations: table, ..bridge::lent(&settings) };
    let made = bridge::settings_to_impl(&settings).ok_or("a time is negative")?;
    let check_time = Duration::from_nanos(check_time_ns);
    let made = mufasa::monitor::Settings { check_time, step_ps, meant, ..made };
    let mut monitor = match Monitor::new(made, lent.memory()) {
        Ok(monitor) => monitor,
        Err(error) => {
            found.check(number, duty_of(&error), false, || error.to_string());
            return Ok(());
        }
    };
    set_route(&mut monitor, &sequence.route)?;
    let is_restarted = seen.cycles > 0;
    let tau = Duration::from_secs_f64(made.stages.tau);
    let tau_ns = i64::try_from(tau.as_nanos()).unwrap_or(i64::MAX);
    let mut examined = Loop {
        monitor: Bridged::new(monitor),
        waits_ns: if is_restarted { settings.requester.t_wait_ns } else { 0 },
        first_ns: None,
        period_ns: sequence.period_ns,
        check_time_ns,
        now_ns: None,
        cycle_ns: None,
        is_ticked: false,
        released: BTreeMap::new(),
        follows: Follows::OwnPlan,
        tau_ns: if settings.profile.has(HardenedRule::H14) { tau_ns } else { i64::MAX },
        own_by_ns: i64::MAX,
        is_local: true,
        brakes: false,
        offers: BTreeSet::new(),
        asked: BTreeSet::new(),
        most_stations: stations,
        line: number,
        found,
        seen,
    };
    for (number, line) in calls {
        examined.line = number;
        match line {
            Line::Call(call) => examined.call(*call),
            Line::Control { t_ns, follows } => examined.control(t_ns, follows),
            Line::Made(_) => {}
        }
    }
    Ok(())
}

fn set_route(monitor: &mut Monitor<'_>, route: &Route) -> Result<(), String> {
    let (closed, cross_sections) = bridge::route_to_impl(route);
    let route = mufasa::input::cycle::Route { closed, cross_sections: &cross_sections };
    monitor.set_route(&route).map_err(|error| error.to_string())
}

fn duty_of(error: &MonitorError) -> Duty {
    match error {
        MonitorError::TauNotAbovePeriod { .. }
        | MonitorError::Unusual(Unusual { field: "stages.tau", .. }) => Duty::Tau,
        MonitorError::Memory { .. } | MonitorError::TooSlow { .. } => Duty::CheckTime,
        MonitorError::SessionsBefore { .. } => Duty::Sessions,
        MonitorError::Stages(_)
        | MonitorError::Requester(_)
        | MonitorError::NoPeriod
        | MonitorError::TimeTooShort { .. }
        | MonitorError::MaxAgeBelowLMax { .. }
        | MonitorError::DtMaxNotAbovePeriod { .. }
        | MonitorError::Stall { .. }
        | MonitorError::Unusual(_) => Duty::Settings,
    }
}

fn duty_of_advice(advice: Advice) -> Duty {
    match advice {
        Advice::Period | Advice::NoTick => Duty::Period,
        Advice::DetectionsNotCurrent | Advice::LeadNotCurrent | Advice::GridNotCurrent => {
            Duty::Clock
        }
        Advice::LeadSpeed | Advice::GapTooLong | Advice::GapTooShort => Duty::Gap,
    }
}

/// A trajectory that came out: by when control brakes along it, and whether its verdict came in time.
struct Release {
    brake_by_ns: Option<i64>,
    is_in_time: bool,
}

struct Loop<'a> {
    monitor: Bridged<'a>,
    /// For how long from its first call on the monitor may ask nobody, and that call.
    waits_ns: i64,
    first_ns: Option<i64>,
    period_ns: i64,
    check_time_ns: u64,
    now_ns: Option<i64>,
    /// The last cycle, or when its absence was last told.
    cycle_ns: Option<i64>,
    /// Whether a tick came since the last cycle.
    is_ticked: bool,
    released: BTreeMap<VerifiedAnswer, Release>,
    follows: Follows,
    /// `tau`, by when control brakes along a plan of the CAV's own, ns (MON-68), and whether everything is local.
    tau_ns: i64,
    own_by_ns: i64,
    is_local: bool,
    /// Whether the last decision said that control has to brake.
    brakes: bool,
    /// The stations that have a place of the table, since they offer something or were asked; and its places.
    offers: BTreeSet<i64>,
    asked: BTreeSet<i64>,
    most_stations: usize,
    line: usize,
    found: &'a mut Findings,
    seen: &'a mut Seen,
}

impl Loop<'_> {
    fn check(&mut self, duty: Duty, is_kept: bool, what: impl FnOnce() -> String) {
        self.found.check(self.line, duty, is_kept, what);
    }

    /// Time has come to this.
    fn passes(&mut self, t_ns: i64) {
        let before_ns = self.now_ns.replace(t_ns).unwrap_or(t_ns);
        self.check(Duty::Clock, t_ns >= before_ns, || format!("{t_ns} ns comes after {before_ns}"));
        let most_ns = self.period_ns.saturating_mul(3) / 2;
        let since_ns = t_ns.saturating_sub(*self.cycle_ns.get_or_insert(t_ns));
        self.check(Duty::Period, since_ns <= most_ns, || {
            format!("no cycle for {since_ns} ns, more than 1.5 periods")
        });
        if since_ns > most_ns {
            self.cycle_ns = Some(t_ns);
        }
        self.brake_in_time(t_ns);
    }

    /// Control has to brake by the time that what it follows names.
    fn brake_in_time(&mut self, t_ns: i64) {
        let of = |it| self.released.get(&it).and_then(|it| it.brake_by_ns).unwrap_or(i64::MAX);
        let by_ns = match self.follows {
            Follows::Verified(it) => of(it),
            Follows::OwnPlan => self.own_by_ns,
            Follows::Brakes => return,
        };
        self.check(Duty::BrakeBy, t_ns <= by_ns, || {
            format!("at {t_ns} ns control follows what it has to brake along from {by_ns} ns on")
        });
    }

    fn control(&mut self, t_ns: i64, follows: Follows) {
        self.passes(t_ns);
        self.follows = follows;
        self.seen.see("braking", follows == Follows::Brakes);
        let Follows::Verified(it) = follows else { return self.brake_in_time(t_ns) };
        self.seen.see("followed trajectory of a station", it.station > 0);
        let is_in_time = self.released.get(&it).map(|it| it.is_in_time);
        self.check(Duty::Verified, is_in_time.is_some(), || {
            format!(
                "no safe cycle gave the trajectory of {} ns of station {}",
                it.stamp_ns, it.station
            )
        });
        self.check(Duty::Late, is_in_time != Some(false), || {
            "the cycle that gave the trajectory took longer than check_time, or was not heard"
                .to_owned()
        });
        self.brake_in_time(t_ns);
    }

    /// Whether the table has a place for a station, or one is its own.
    fn has_place(&self, station: i64) -> bool {
        let taken: BTreeSet<_> = self.offers.union(&self.asked).collect();
        taken.contains(&station) || taken.len() < self.most_stations
    }

    fn call(&mut self, call: Call) {
        let Call { event, sender, took_ns, mut answer, advice } = call;
        let words = json!(event);
        let event = event.into_model();
        let Event { t_ns, kind } = &event;
        self.passes(*t_ns);
        self.first_ns.get_or_insert(*t_ns);
        let handed = Sender::handed(&words);
        self.check(Duty::Sender, handed == sender, || {
            format!("the call names {}, the message {}", json!(handed), json!(sender))
        });
        for (what, ns) in stamps(&words) {
            let is_other = is_in_another_unit(*t_ns, ns);
            self.check(Duty::Clock, !is_other, || {
                format!("{what} {ns} at {t_ns} ns seems to be in another unit")
            });
        }
        match kind {
            EventKind::Tick => self.is_ticked = true,
            EventKind::Cycle { .. } => self.cycle_ns = Some(*t_ns),
            EventKind::Offer { station, groups }
                if *groups != Groups::NONE && !self.has_place(*station) =>
            {
                // It is refused, and changes nothing.
                let actions = &answer["actions"];
                let takes_none = actions.as_array().is_none_or(Vec::is_empty);
                self.check(Duty::Actions, takes_none, || {
                    format!("the loop took the actions {actions} of an offer beyond its table")
                });
                return;
            }
            EventKind::Offer { station, groups } if *groups != Groups::NONE => {
                self.offers.insert(*station);
            }
            EventKind::Offer { station, .. }
            | EventKind::Withdraw { station }
            | EventKind::Lost { station } => drop(self.offers.remove(station)),
            _ => {}
        }
        if matches!(kind, EventKind::Cycle { .. }) && self.is_local {
            self.own_by_ns = t_ns.saturating_add(self.tau_ns);
        }
        let (replayed, why) = self.monitor.step(&event);
        let is_remote = |it: &GroupState| matches!(it, GroupState::Remote { .. });
        self.is_local = !is_remote(&replayed.mot) && !is_remote(&replayed.plan);
        self.seen.see("message that is dropped", why.is_some());
        for action in &replayed.actions {
            self.seen.see("release", matches!(action, Action::Release { .. }));
            if let Action::Request { station, session, .. } = action {
                self.asked.insert(*station);
                self.seen.session = self.seen.session.max(*session);
                let since_ns = t_ns.saturating_sub(self.first_ns.unwrap_or(*t_ns));
                self.found.check(self.line, Duty::Wait, since_ns >= self.waits_ns, || {
                    format!("a station is asked {since_ns} ns after a restart")
                });
            }
        }
        let heard = answer["decision"]["verdict"].is_string();
        if matches!(kind, EventKind::Cycle { .. }) {
            self.cycle(&replayed, heard, took_ns, advice.is_some());
        }
        let mut replayed = json!(MonitorState::new(replayed));
        let taken = |it: &mut Value| it.as_object_mut().and_then(|it| it.remove("actions"));
        let actions = [taken(&mut answer), taken(&mut replayed)].map(|it| it.unwrap_or(json!([])));
        self.check(Duty::Actions, actions[0] == actions[1], || {
            format!("the loop took the actions {}, the monitor gave {}", actions[0], actions[1])
        });
        self.check(Duty::Arithmetic, agrees(&answer, &replayed), || {
            format!("the answer is {answer}, replayed {replayed}")
        });
    }

    fn cycle(&mut self, replayed: &Answer, is_heard: bool, took_ns: u64, has_asked: bool) {
        self.seen.cycles += 1;
        let is_ticked = std::mem::take(&mut self.is_ticked);
        self.check(Duty::Period, is_ticked, || "no tick since the last cycle".to_owned());
        let most_ns = self.check_time_ns;
        let is_in_time = took_ns <= most_ns;
        self.check(Duty::CheckTime, is_in_time, || {
            format!("{took_ns} ns, check_time is {most_ns}")
        });
        let says = self.monitor.advice();
        self.check(Duty::Advice, has_asked, || "nobody asked for advice".to_owned());
        if let Some(says) = says {
            self.check(duty_of_advice(says), false, || format!("the monitor says: {says}"));
        }
        let brakes = self.brakes && self.follows != Follows::Brakes;
        self.check(Duty::OwnPlans, !brakes, || {
            "the decision before said that control has to brake, and it does not".to_owned()
        });
        let Some(decision) = &replayed.decision else { return };
        self.brakes = decision.brake.is_some();
        self.seen.see("unsafe cycle", !decision.is_safe());
        let remote = [decision.tracks, decision.trajectory].into_iter().flatten();
        self.seen
            .see("safe cycle with remote data", remote.into_iter().any(|it| it.remote.is_some()));
        if let Some(it) = decision.trajectory {
            let (it, is_in_time) = (VerifiedAnswer::new(it), is_in_time && is_heard);
            if is_in_time || !self.released.contains_key(&it) {
                let release = Release { brake_by_ns: decision.brake_by_ns, is_in_time };
                self.released.insert(it, release);
            }
        }
    }
}

/// Whether the answer has what is said of it. Why something was dropped has finer words in the model.
fn agrees(said: &Value, answer: &Value) -> bool {
    match (said, answer) {
        (Value::Object(said), Value::Object(answer)) => said.iter().all(|(key, it)| {
            key == "dropped" || answer.get(key).is_some_and(|other| agrees(it, other))
        }),
        _ => said == answer,
    }
}
