//! A period of the monitor, tick and cycle, beside the same by the plain calls: the stages, and a tick and the verdict to
//! the requester (`spec/monitor.md#monitor`). The plain side keeps no detections for later cycles.

use std::hint::black_box;
use std::time::Duration;

use mufasa::input::cycle::{CrossSection, Cycle, Detection, Grid};
use mufasa::input::detection_index::Slot;
use mufasa::input::route_index::Block;
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::monitor::{
    Accepted, Arrival, Decision, GridMap, Inputs, Memory, Message, Monitor, Settings, Time,
};
use mufasa::offloading::requester::{
    Actions, Event, EventKind, Parameters, Requester, Sessions, StationRecord,
};
use mufasa::services::configuration::{Configuration, Group, Groups};

use crate::contestant::Contestant;

/// A session for each group.
const SESSIONS: Sessions = Sessions { mot: Some(1), plan: Some(2) };

/// The stages and a requester with both groups remote.
pub struct Plain<'a> {
    stages: Contestant<'a>,
    requester: Requester<'a>,
    now_ns: i64,
}

impl<'a> Plain<'a> {
    /// Memory is never freed: a bench ends soon.
    ///
    /// # Panics
    /// If a group does not become remote.
    pub fn new(cycle: &'a Cycle<'a>) -> Self {
        let (now_ns, table) = (cycle.now_ns, vec![StationRecord::FREE; 1].leak());
        let requester = Requester::new(cycle.profile, Parameters::default(), table);
        let mut requester = requester.expect("the defaults are in the domain");
        let mut kinds = vec![EventKind::Offer { station: 1, groups: Groups::ALL }, EventKind::Tick];
        let station = 1;
        for (group, session) in Group::ALL.into_iter().zip(1..) {
            kinds.push(EventKind::Confirm { station, group, session });
            kinds.push(EventKind::Data { station, group, session, generated_ns: now_ns });
        }
        for kind in kinds {
            let _done = requester.step(&Event { t_ns: now_ns, kind }).expect("a station");
        }
        assert_eq!(requester.configuration(), Configuration::AllRemote);
        Self { stages: Contestant::new(cycle), requester, now_ns }
    }

    /// Whether the cycle is safe.
    ///
    /// # Panics
    /// Never: neither tick nor verdict names a station.
    pub fn cycle(&mut self) -> bool {
        let tick = Event { t_ns: self.now_ns, kind: EventKind::Tick };
        let _done = black_box(self.requester.step(&tick).expect("a tick names no station"));
        let report = Ok(self.stages.check());
        let kind = EventKind::of_cycle(&report, SESSIONS);
        let actions = self.requester.step(&Event { t_ns: self.now_ns, kind });
        let _done = black_box(actions.expect("a verdict names no station"));
        report.is_ok_and(|report| report.failed_stage.is_none())
    }
}

/// A monitor that has seen the history of the cycle.
pub struct Monitored<'a> {
    monitor: Monitor<'a>,
    now: Time,
    inputs: Inputs<'a>,
}

impl<'a> Monitored<'a> {
    /// Memory is never freed: a bench ends soon.
    ///
    /// # Panics
    /// If a group does not become remote.
    pub fn new(cycle: &'a Cycle<'a>) -> Self {
        let lists = cycle.detection_history.iter().chain(&cycle.detections);
        let most = lists.map(|list| list.items.len()).max().unwrap_or(0);
        let sections = cycle.route.cross_sections.len();
        let memory = Memory {
            stations: vec![StationRecord::FREE; 1].leak(),
            rows: vec![Row::default(); Sizes::MAX.rows].leak(),
            columns: vec![Column::default(); Sizes::MAX.columns].leak(),
            detections: vec![Detection::default(); Memory::detections_for(most)].leak(),
            slots: vec![Slot::default(); Memory::slots_for(most)].leak(),
            cross_sections: vec![CrossSection::default(); sections].leak(),
            blocks: vec![Block::default(); Block::needed(sections)].leak(),
        };
        let settings = Settings {
            profile: cycle.profile,
            stages: cycle.parameters,
            ..Settings::new(Duration::from_millis(50))
        }
        .in_any_time()
        .in_any_range();
        let mut monitor = Monitor::new(settings, memory).expect("the workloads are valid input");
        monitor.set_route(&cycle.route).expect("the workloads are valid input");
        // As at 10 Hz; between the lists of the history any others.
        for age in (1..=10).rev() {
            let stamp_ns = cycle.now_ns - age * 100_000_000;
            let known = cycle.detection_history.iter().find(|list| list.stamp_ns == stamp_ns);
            let items = known.or(cycle.detections.as_ref()).map_or(&[][..], |list| list.items);
            let then = Time::from_nanoseconds(stamp_ns);
            let inputs = Inputs::new(then, cycle.ego).detections(then, items);
            let (decision, _none) = monitor.cycle(&inputs);
            assert!(matches!(decision, Decision::Safe { .. }));
        }
        let now = Time::from_nanoseconds(cycle.now_ns);
        let _none = monitor.offer(now, 1, Groups::ALL).expect("a station");
        let _requests = monitor.tick(now);
        for (group, session) in Group::ALL.into_iter().zip(1..) {
            let _done = monitor.confirm(now, 1, group, session).expect("a station");
        }
        assert_eq!(monitor.configuration(), Configuration::AllRemote);
        let tracks = cycle.tracks.expect("the workloads have tracks");
        let tracks = monitor.tracks(now, message(1, now, tracks.stamp_ns, tracks.items));
        let points = cycle.trajectory.expect("the workloads have a trajectory");
        let points = monitor.trajectory(now, message(2, now, points.stamp_ns, points.points));
        let mut inputs = Inputs::new(now, cycle.ego)
            .remote_tracks(accepted(tracks.expect("a station")))
            .remote_trajectory(accepted(points.expect("a station")));
        if let Some(list) = cycle.detections {
            inputs = inputs.detections(Time::from_nanoseconds(list.stamp_ns), list.items);
        }
        if let Some(Grid {
            stamp_ns,
            x,
            y,
            cos,
            sin,
            resolution,
            width,
            height,
            occupied,
            unknown,
        }) = cycle.grid
        {
            let map = GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown };
            inputs = inputs.grid(Time::from_nanoseconds(stamp_ns), map);
        }
        Self { monitor, now, inputs }
    }

    /// Whether the cycle is safe, and both results of the station come out.
    pub fn cycle(&mut self) -> bool {
        let _nothing = black_box(self.monitor.tick(self.now));
        let (decision, _actions) = black_box(self.monitor.cycle(black_box(&self.inputs)));
        match decision {
            Decision::Safe { tracks, trajectory, .. } => tracks.is_some() && trajectory.is_some(),
            Decision::Unsafe { .. } => false,
        }
    }
}

fn message<L>(session: i64, now: Time, stamp_ns: i64, items: L) -> Message<L> {
    let stamp = Time::from_nanoseconds(stamp_ns);
    Message { station: 1, session, generated: now, stamp, items }
}

fn accepted<'a, L: 'a>((arrival, actions): (Arrival<L>, Actions)) -> &'a Accepted<L> {
    match arrival {
        Arrival::Accepted(element) => Box::leak(Box::new(element)),
        Arrival::Dropped { why } => panic!("{why}: {actions:?}"),
    }
}

#[cfg(test)]
mod tests {
    use mufasa::input::profile::Profile;

    use super::{Configuration, Monitored, Plain};
    use crate::workload::{SIZES, Variant, Workload};

    #[test]
    fn both_pass_and_both_fail() {
        let workload = |variant| Workload::new(&SIZES[0], variant);
        for (variant, passes) in [(Variant::Pass, true), (Variant::Ghost, false)] {
            for profile in [Profile::PAPER, Profile::HARDENED] {
                let workload = workload(variant);
                let cycle = workload.cycle(profile, Configuration::AllRemote);
                assert_eq!(Plain::new(&cycle).cycle(), passes);
                assert_eq!(Monitored::new(&cycle).cycle(), passes);
            }
        }
    }
}
