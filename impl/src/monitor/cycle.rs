//! One cycle: choose, check, tell the requester, keep what was seen (`spec/monitor.md#monitor`).

use super::Monitor;
use super::decision::{Decision, Verified};
use super::element::Element;
use super::inputs::Inputs;
use super::released::{Released, if_kept, is_last_used, is_ticked};
use super::settings::{MonitorError, Settings};
use super::stall::Stall;
use super::time::Time;
use crate::cycle::check_unless;
use crate::cycle::steps::{Counts, LISTS};
use crate::input::cycle::{Cycle, Track, TrackList, Trajectory, TrajectoryPoint};
use crate::input::indexes::Indexes;
use crate::input::profile::HardenedRule;
use crate::input::scratch::Scratch;
use crate::offloading::requester::{Actions, EventKind, Running, Source};
use crate::report::{InvalidInput, Problem, Report};
use crate::services::configuration::{Configuration, Group};
use crate::stages::order::is_current;

impl Monitor<'_> {
    /// Decides on the inputs and tells the requester: after an unsafe cycle no group is remote, and
    /// nothing is left for the caller but to take the actions. They are beside the decision, whatever it
    /// is: releases to be sent, local services that start, and after a safe one those that stop (H-08). To be called in each period, offloading
    /// or not, so that the detections of the last second are there when they are needed.
    ///
    /// Time: that of `cycle::check` with indexes, and linear in the detections.
    ///
    /// A decision is to be looked at before the next one:
    ///
    /// ```compile_fail,E0499
    /// # use mufasa::monitor::{Inputs, Monitor};
    /// fn from_an_earlier_cycle<'m>(
    ///     monitor: &'m mut Monitor<'_>,
    ///     inputs: &Inputs<'m>,
    /// ) {
    ///     let earlier = monitor.cycle(inputs);
    ///     let later = monitor.cycle(inputs);
    ///     drop((earlier, later));
    /// }
    /// ```
    ///
    /// Nor is anything of it there once the monitor has taken another event:
    ///
    /// ```compile_fail,E0499
    /// # use mufasa::monitor::{Decision, Inputs, Monitor, Time};
    /// fn after_the_session<'m>(monitor: &'m mut Monitor<'_>, inputs: &Inputs<'m>, now: Time) {
    ///     let (decision, _to_be_done) = monitor.cycle(inputs);
    ///     if let Decision::Safe { trajectory: Some(trajectory), .. } = decision {
    ///         let actions = monitor.tick(now);
    ///         drop((trajectory, actions));
    ///     }
    /// }
    /// ```
    ///
    /// It cannot be left aside where `unused_must_use` is denied, nor can what any event answers; the
    /// same code compiles with each answer looked at:
    ///
    /// ```compile_fail
    /// #![deny(unused_must_use)]
    /// # use mufasa::monitor::{Inputs, Monitor};
    /// fn thrown_away<'m>(monitor: &'m mut Monitor<'_>, inputs: &Inputs<'m>) {
    ///     monitor.cycle(inputs);
    /// }
    /// ```
    ///
    /// ```compile_fail
    /// #![deny(unused_must_use)]
    /// # use mufasa::monitor::{Monitor, Time};
    /// fn thrown_away(monitor: &mut Monitor<'_>, now: Time) {
    ///     monitor.tick(now);
    /// }
    /// ```
    ///
    /// ```compile_fail
    /// #![deny(unused_must_use)]
    /// # use mufasa::monitor::{Monitor, Time};
    /// fn thrown_away(monitor: &mut Monitor<'_>, now: Time) {
    ///     monitor.lost(now, 1).unwrap();
    /// }
    /// ```
    ///
    /// ```
    /// #![deny(unused_must_use)]
    /// # use mufasa::monitor::{Inputs, Monitor, Time};
    /// fn taken<'m>(monitor: &'m mut Monitor<'_>, inputs: &Inputs<'m>, now: Time) {
    ///     let _to_be_done = monitor.tick(now);
    ///     let _to_be_done = monitor.lost(now, 1).unwrap();
    ///     let (_decision, _to_be_done) = monitor.cycle(inputs);
    /// }
    /// ```
    ///
    /// Nor can the actions alone, unless in sight, as by `.0` or `_`: they come beside each decision.
    ///
    /// ```compile_fail,E0308
    /// # use mufasa::monitor::{Decision, Inputs, Monitor};
    /// fn actions_forgotten<'m>(monitor: &'m mut Monitor<'_>, inputs: &Inputs<'m>) -> usize {
    ///     match monitor.cycle(inputs) {
    ///         Decision::Safe { trajectory, .. } => trajectory.map_or(0, |it| it.points.len()),
    ///         Decision::Unsafe { .. } => 0,
    ///     }
    /// }
    /// ```
    ///
    /// There is no verdict to look at alone, as `is_ok()` of a report is, and the configuration is no
    /// argument:
    ///
    /// ```compile_fail,E0599
    /// # use mufasa::monitor::{Inputs, Monitor};
    /// fn looks_safe<'m>(monitor: &'m mut Monitor<'_>, inputs: &Inputs<'m>) -> bool {
    ///     monitor.cycle(inputs).0.is_ok()
    /// }
    /// ```
    ///
    /// ```compile_fail,E0609
    /// # use mufasa::{monitor::Inputs, services::configuration::Configuration};
    /// fn nothing_to_check(mut inputs: Inputs<'_>) {
    ///     inputs.configuration = Configuration::Local;
    /// }
    /// ```
    ///
    /// Source: `spec/monitor.md#monitor`.
    // MON-03
    pub fn cycle<'m>(&'m mut self, inputs: &Inputs<'m>) -> (Decision<'m>, Actions) {
        let now_ns = inputs.now.as_nanoseconds();
        let remote = Group::ALL.map(|group| self.requester.session_of(group));
        let [mot, plan] = remote;
        let tracks = match &mot {
            Some(running) => last_used(running, inputs.remote_tracks).map(track_list),
            None => inputs.local_tracks,
        };
        let trajectory = match &plan {
            Some(running) => last_used(running, inputs.remote_trajectory).map(trajectory_of),
            None => inputs.local_trajectory,
        };
        let has_route = self.route.is_set();
        // MON-06
        let mut report = self.check(self.configuration(), inputs, tracks, trajectory, true);
        if let Err(problem) = &mut report {
            *problem = named(*problem, has_route);
        }
        let is_valid = report.is_ok();
        let max_age_ns = self.settings.stages.max_age_ns;
        let dt_max_ns = self.settings.requester.dt_max_ns;
        // MON-45
        let [ticked_ns, before_ns] = [self.ticked.take(), self.cycled.replace(inputs.now)]
            .map(|it| it.map(Time::as_nanoseconds));
        let is_ticked = is_ticked(ticked_ns, before_ns, now_ns, dt_max_ns);
        if is_valid {
            // IMPL-18
            self.watch.cycle(inputs, &self.settings, is_ticked);
        }
        let is_remote = mot.is_some() || plan.is_some();
        if report.is_ok() && is_remote && !is_ticked {
            // MON-46: nobody looked for silence.
            report = Err(InvalidInput { field: "tick", index: None, problem: Problem::NoTick });
        }

        let current = |stamp_ns| is_current(stamp_ns, now_ns, max_age_ns);
        let has_current = [
            tracks.is_some_and(|list| current(list.stamp_ns)),
            trajectory.is_some_and(|it| current(it.stamp_ns)),
        ];
        // MON-66
        let has_seen = !self.settings.profile.has(HardenedRule::H14)
            || inputs.detections.is_some_and(|list| current(list.stamp_ns));
        if has_seen && is_ticked {
            // MON-69
            for (group, has_current) in Group::ALL.into_iter().zip(has_current) {
                self.served.get_mut(group).cycle(now_ns, has_current, dt_max_ns);
            }
        }
        let in_use = remote.map(|running| running.map(|running| running.session));
        let Released { is_safe, tracks: gives_tracks, trajectory: gives_trajectory, sessions } =
            Released::of(&report, in_use, has_current, has_seen);
        let tracks = tracks.filter(|_| gives_tracks);
        let trajectory = trajectory.filter(|_| gives_trajectory);
        // MON-10
        let kind = EventKind::Verdict { safe: is_safe, sessions };
        let actions = self.step_alone(inputs.now, kind);
        // MON-49
        let brake = self.supervise(inputs, trajectory.is_some());
        if let Some(Stall { way_m, .. }) = self.settings.stall {
            let is_remote = self.configuration().is_remote(Group::Plan);
            // A place in invalid input is none.
            let place = is_valid.then_some([inputs.ego.x, inputs.ego.y]);
            self.progress.cycle(now_ns, place, is_remote, way_m);
        }
        match report {
            Ok(report) if is_safe => {
                let [mot, plan] = remote.map(source);
                let tracks = tracks.map(|list| Verified::of_safe_cycle(list, mot, None));
                // MON-40
                let brake_by = self.settings.brake_by(now_ns);
                let trajectory = trajectory.map(|it| Verified::of_safe_cycle(it, plan, brake_by));
                (Decision::Safe { tracks, trajectory, report, brake }, actions)
            }
            report => (Decision::Unsafe { report, brake }, actions),
        }
    }

    /// Checks the inputs as in this configuration, and `keeps` the detections when they are valid and current. Never inlined: a cycle needs the stack of one run of the stages at a time.
    #[inline(never)]
    pub(super) fn check<'m>(
        &mut self,
        configuration: Configuration,
        inputs: &Inputs<'m>,
        tracks: Option<TrackList<'m>>,
        trajectory: Option<Trajectory<'m>>,
        keeps: bool,
    ) -> Result<Report, InvalidInput> {
        let now_ns = inputs.now.as_nanoseconds();
        // MON-06
        let mut cycle = Cycle {
            profile: self.settings.profile,
            parameters: self.settings.stages,
            now_ns,
            configuration,
            ego: inputs.ego,
            trajectory,
            tracks,
            detections: inputs.detections,
            lead: inputs.lead,
            route: self.route.route(),
            grid: inputs.grid,
            detection_history: &[],
        };
        let tracks_fit = tracks.is_none_or(|list| list.items.len() <= self.rows.len());
        let index = self.route.index();
        let route = index.as_ref();
        let scratch = &mut Scratch::new(self.rows, self.columns);
        // MON-16, MON-17
        let (true, Some(list)) = (self.settings.profile.looks_back(), inputs.detections) else {
            let indexes = Indexes { route, detections: &[] };
            let late = too_long(&self.settings, &self.in_time, &cycle);
            let report = check_unless(late, &cycle, &indexes, scratch);
            if_kept(&report, [true, tracks_fit])?;
            return report;
        };
        let holds = self.history.holds(&list);
        let selection = self.history.select(&list);
        cycle.detection_history = selection.lists.get(..selection.count).unwrap_or(&[]);
        let late = too_long(&self.settings, &self.in_time, &cycle);
        let indexes = Indexes { route, detections: &selection.indexes };
        let report = check_unless(late, &cycle, &indexes, scratch);
        let kept = if_kept(&report, [holds, tracks_fit]);
        // A list that does not fit is never kept.
        let is_valid = kept.is_ok() || (holds && late.is_some_and(|it| kept == Err(it)));
        let [own, ..] = selection.indexes;
        let shape = own.shape();
        // MON-12
        if keeps && is_valid && is_current(list.stamp_ns, now_ns, self.settings.stages.max_age_ns) {
            self.history.keep(&list, shape);
        }
        kept?;
        report
    }
}

/// The list that is too long for the cycle to be checked in time, whatever it holds
/// (`spec/4-arithmetic.md#steps`): what is no longer than `known` is not.
fn too_long(settings: &Settings, known: &Counts, cycle: &Cycle<'_>) -> Option<InvalidInput> {
    let counts = Counts { stations: known.stations, ..Counts::of(cycle) };
    if counts.is_within(known) {
        return None;
    }
    // IMPL-13; A-14
    let error = settings.check_steps(&counts, &LISTS).err()?;
    let field = if let MonitorError::TooSlow { list, .. } = error { list } else { "check_time" };
    Some(InvalidInput { field, index: None, problem: Problem::TooMany })
}

/// The problem; of a route that was never set that, and not that it has too few cross sections.
pub(super) fn named(problem: InvalidInput, has_route: bool) -> InvalidInput {
    if !has_route && (problem.field, problem.problem) == ("route.stations", Problem::TooFew) {
        return InvalidInput { field: "route", index: None, problem: Problem::NoRoute };
    }
    problem
}

/// The element, if it is the last one that the requester used in this session: of a session each that
/// is used was generated later than the one before.
fn last_used<'c, T>(running: &Running, element: Option<Element<'c, T>>) -> Option<Element<'c, T>> {
    // MON-08
    element.filter(|it| is_last_used(running, it.station, it.session, it.generated))
}

fn track_list(element: Element<'_, Track>) -> TrackList<'_> {
    TrackList { stamp_ns: element.stamp.as_nanoseconds(), items: element.items }
}

fn trajectory_of(element: Element<'_, TrajectoryPoint>) -> Trajectory<'_> {
    Trajectory { stamp_ns: element.stamp.as_nanoseconds(), points: element.items }
}

fn source(running: Option<Running>) -> Source {
    running.map_or(Source::Local, |Running { station, .. }| Source::Remote { station })
}
