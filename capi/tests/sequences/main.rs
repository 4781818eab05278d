//! The monitor of the C interface answers as its exact model on the sequences of `mufasa_props`
//! (`spec/monitor.md#monitor`).
//!
//! Own tracks beyond the settings, refused even while MOT is remote (MON-65), are left out and counted.

#[path = "../records/mod.rs"]
mod records;
mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Debug;
use std::mem::MaybeUninit;
use std::ptr::{from_ref, null, null_mut};
use std::slice;

use mufasa_capi::cycle::{MufasaProfile, MufasaRoute};
use mufasa_capi::event::MufasaGroup;
use mufasa_capi::monitor::{
    MufasaActions, MufasaBrakeReason, MufasaDecision, MufasaMonitor, MufasaMonitorInputs,
    MufasaMonitorSettings, MufasaTrackMessage, MufasaTrajectoryMessage, mufasa_monitor_bytes,
    mufasa_monitor_cycle, mufasa_monitor_given_back, mufasa_monitor_init, mufasa_monitor_set_route,
    mufasa_monitor_settings_default, mufasa_monitor_state, mufasa_monitor_step,
    mufasa_monitor_tracks, mufasa_monitor_trajectory,
};
use mufasa_capi::report::MufasaFailedStage;
use mufasa_capi::requester::MufasaRequesterState;
use mufasa_capi::status::MufasaStatus;
use mufasa_capi::time::MufasaTime;
use mufasa_model::input::cycle::{Route, TrackList, Trajectory};
use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::Monitor;
use mufasa_model::monitor::messages::{
    Answer, Brake, Decision, Dropped, Event, EventKind, Measured,
};
use mufasa_model::monitor::settings::Settings;
use mufasa_model::offloading::requester::{Action, Group, GroupState, Requester};
use mufasa_model::report::{FailedStage, Reading, Stage};
use mufasa_model::services::configuration::Source;
use mufasa_props::bridge;
use mufasa_props::strategy::monitor::{Script, route};

use records::{detection, detection_list, path, point, time, track, track_list};
use words::{group_state, plain, reason, taken};

/// Sequences of each profile.
const SEQUENCES: u64 = 60;
/// Events and cycles of a sequence, and choices that make it.
const STEPS: usize = 500;
const TAPE: usize = 6_000;

/// What both sides say of an event, as far as C has it.
#[derive(Debug, PartialEq)]
struct Seen {
    groups: [GroupState; 2],
    hold_until_ns: Option<i64>,
    actions: Vec<Action>,
    /// An older element counts as repeated: C has one word for both.
    dropped: Option<Dropped>,
    given_back_ns: Option<i64>,
    decision: Option<Decided>,
}

/// `Err`: an error. Of tracks and trajectory the stamps; what they hold was sent, as `InC` looks.
#[derive(Debug, PartialEq)]
struct Decided {
    failed: Result<MufasaFailedStage, ()>,
    tracks_ns: Option<i64>,
    trajectory_ns: Option<i64>,
    brake_by_ns: Option<i64>,
    /// Bits as of `MufasaGroup`.
    local_services: u32,
    /// The reason, and the stage that failed.
    brake: (MufasaBrakeReason, MufasaFailedStage),
}

/// A monitor in memory of its own.
struct InC {
    _memory: Vec<u64>,
    monitor: *mut MufasaMonitor,
    /// Stamps and contents of what was given, as they are printed.
    sent: BTreeSet<String>,
}

fn printed<T: Debug>(stamp: MufasaTime, items: &[T]) -> String {
    format!("{} {items:?}", stamp.ns)
}

impl InC {
    fn new(settings: &Settings, route: &Route) -> Self {
        let count = |places: i64| usize::try_from(places).expect("places");
        let profile = match settings.profile {
            Profile::PAPER => MufasaProfile::Paper,
            _ => MufasaProfile::Hardened,
        };
        let given = MufasaMonitorSettings {
            profile: profile as u32,
            stages: bridge::cycle_parameters(&settings.parameters).into(),
            requester: bridge::parameters_to_impl(&settings.requester).into(),
            sessions_before: settings.last_session,
            check_time_ns: i64::MAX,
            // As many as those of the sequences have.
            most_points: 2,
            meant: u32::MAX,
            supervise_local: settings.supervise_local.into(),
            stall_way_m: settings.stall.as_ref().map_or(0.0, |it| it.way),
            stall_time_ns: settings.stall.as_ref().map_or(0, |it| it.time_ns),
            most_tracks: count(settings.memory.tracks),
            most_detections: count(settings.memory.detections),
            most_cross_sections: count(settings.memory.cross_sections),
            ..mufasa_monitor_settings_default(settings.period_ns)
        };
        // SAFETY: the settings live to the end of this function.
        let bytes = unsafe { mufasa_monitor_bytes(&raw const given) };
        let mut memory = vec![0_u64; bytes.div_ceil(8)];
        let (place, mut monitor) = (memory.as_mut_ptr().cast(), null_mut());
        // SAFETY: as above; the memory is the monitor's as long as both live.
        let status =
            unsafe { mufasa_monitor_init(&raw const given, place, bytes, &raw mut monitor) };
        assert_eq!(status, MufasaStatus::Ok);
        let sections = records::cross_sections(route);
        let (cross_sections, cross_sections_len) = (sections.as_ptr(), sections.len());
        let closed = u8::from(route.closed);
        let route = MufasaRoute { closed, cross_sections, cross_sections_len };
        // SAFETY: the monitor was just made; the route lives to the end of this function.
        let status = unsafe { mufasa_monitor_set_route(monitor, &raw const route) };
        assert_eq!(status, MufasaStatus::Ok);
        Self { _memory: memory, monitor, sent: BTreeSet::new() }
    }

    fn step(&mut self, event: &Event) -> Seen {
        let mut actions = MaybeUninit::<MufasaActions>::uninit();
        let (to, now, mut decision) = (actions.as_mut_ptr(), time(event.t_ns), None);
        let status = match &event.kind {
            EventKind::Tracks { station, session, generated_ns, tracks } => {
                let items: Vec<_> = tracks.items.iter().map(track).collect();
                let tracks = track_list(tracks.stamp_ns, &items);
                self.sent.insert(printed(tracks.stamp, &items));
                let (station, session, generated) = (*station, *session, time(*generated_ns));
                let message = MufasaTrackMessage { station, session, generated, tracks };
                // SAFETY: what is pointed to lives longer than the call, here and below.
                unsafe { mufasa_monitor_tracks(self.monitor, now, &raw const message, to) }
            }
            EventKind::Trajectory { station, session, generated_ns, trajectory } => {
                let points: Vec<_> = trajectory.points.iter().map(point).collect();
                let trajectory = path(trajectory.stamp_ns, &points);
                self.sent.insert(printed(trajectory.stamp, &points));
                let (station, session, generated) = (*station, *session, time(*generated_ns));
                let message = MufasaTrajectoryMessage { station, session, generated, trajectory };
                // SAFETY: as above.
                unsafe { mufasa_monitor_trajectory(self.monitor, now, &raw const message, to) }
            }
            EventKind::Cycle { measured } => {
                let (decided, told) = self.cycle(now, measured);
                decision = Some(decided);
                actions.write(told);
                MufasaStatus::Ok
            }
            kind => {
                let event = plain(now, kind);
                // SAFETY: as above.
                unsafe { mufasa_monitor_step(self.monitor, &raw const event, to) }
            }
        };
        assert_eq!(status, MufasaStatus::Ok);
        // SAFETY: a call with this status has written them.
        let actions = unsafe { actions.assume_init() };
        let mut state = MaybeUninit::<MufasaRequesterState>::uninit();
        // SAFETY: as above.
        let status = unsafe { mufasa_monitor_state(self.monitor, state.as_mut_ptr()) };
        assert_eq!(status, MufasaStatus::Ok);
        // SAFETY: as above.
        let state = unsafe { state.assume_init() };
        Seen {
            groups: [state.mot, state.plan].map(group_state),
            hold_until_ns: (state.has_hold != 0).then_some(state.hold_until.ns),
            dropped: reason(actions.dropped),
            // SAFETY: as above.
            given_back_ns: Some(unsafe { mufasa_monitor_given_back(self.monitor) }.ns)
                .filter(|it| *it != i64::MIN),
            actions: taken(&actions),
            decision,
        }
    }

    fn cycle(&mut self, now: MufasaTime, measured: &Measured) -> (Decided, MufasaActions) {
        let Measured { ego, trajectory, tracks, detections, lead, grid } = measured;
        let items: Vec<_> = tracks.iter().flat_map(|it| &it.items).map(track).collect();
        let tracks = tracks.as_ref().map(|it: &TrackList| track_list(it.stamp_ns, &items));
        let points: Vec<_> = trajectory.iter().flat_map(|it| &it.points).map(point).collect();
        let trajectory = trajectory.as_ref().map(|it: &Trajectory| path(it.stamp_ns, &points));
        // What the own planner says comes out, too.
        self.sent.extend(trajectory.iter().map(|it| printed(it.stamp, &points)));
        let seen: Vec<_> = detections.iter().flat_map(|it| &it.items).map(detection).collect();
        let detections = detections.as_ref().map(|it| detection_list(it.stamp_ns, &seen));
        let lead = lead.as_ref().map(records::lead);
        let grid = grid.as_ref().map(records::grid);
        let inputs = MufasaMonitorInputs {
            ego: records::ego(ego),
            detections: detections.as_ref().map_or(null(), from_ref),
            lead: lead.as_ref().map_or(null(), from_ref),
            grid: grid.as_ref().map_or(null(), from_ref),
            local_tracks: tracks.as_ref().map_or(null(), from_ref),
            local_trajectory: trajectory.as_ref().map_or(null(), from_ref),
        };
        let mut decision = MaybeUninit::<MufasaDecision>::uninit();
        let to = decision.as_mut_ptr();
        // SAFETY: what is pointed to lives longer than the call.
        let status = unsafe { mufasa_monitor_cycle(self.monitor, now, &raw const inputs, to) };
        // SAFETY: it is written whatever the status.
        let decision = unsafe { decision.assume_init() };
        assert!(
            status == MufasaStatus::Ok || decision.report.failed_stage == MufasaFailedStage::Error
        );
        // SAFETY: null, or valid until the next call.
        let tracks = unsafe { decision.tracks.as_ref() };
        // SAFETY: as above.
        let trajectory = unsafe { decision.trajectory.as_ref() };
        // SAFETY: of a list that is there the items are, too.
        let held = tracks.map(|it| unsafe { slice::from_raw_parts(it.items, it.items_len) });
        let of_tracks = tracks.zip(held).map(|(it, items)| printed(it.stamp, items));
        // SAFETY: as above.
        let held = trajectory.map(|it| unsafe { slice::from_raw_parts(it.points, it.points_len) });
        let of_trajectory = trajectory.zip(held).map(|(it, points)| printed(it.stamp, points));
        for it in of_tracks.into_iter().chain(of_trajectory) {
            assert!(self.sent.contains(&it), "{it}");
        }
        let decided = Decided {
            failed: match decision.report.failed_stage {
                MufasaFailedStage::Error => Err(()),
                failed => Ok(failed),
            },
            tracks_ns: tracks.map(|it| it.stamp.ns),
            trajectory_ns: trajectory.map(|it| it.stamp.ns),
            brake_by_ns: Some(decision.brake_by.ns).filter(|it| *it != i64::MAX),
            local_services: decision.local_services,
            brake: (decision.brake.reason, decision.brake.failed_stage),
        };
        (decided, decision.actions)
    }
}

/// What the model says of that.
fn expected(answer: Answer, requester: &Requester) -> Seen {
    let stage = |failed| match failed {
        None => MufasaFailedStage::None,
        Some(FailedStage::Input) => MufasaFailedStage::Input,
        Some(FailedStage::NoObstacleCheck) => MufasaFailedStage::NoObstacleCheck,
        Some(FailedStage::Stage(Stage::I)) => MufasaFailedStage::I,
        Some(FailedStage::Stage(Stage::Ii)) => MufasaFailedStage::Ii,
        Some(FailedStage::Stage(Stage::Iii)) => MufasaFailedStage::Iii,
        Some(FailedStage::Stage(Stage::Iv)) => MufasaFailedStage::Iv,
        Some(FailedStage::Stage(Stage::V)) => MufasaFailedStage::V,
    };
    let local_of = |group, number| match requester.source(group) {
        Source::Local => number as u32,
        Source::Remote { .. } => 0,
    };
    let local_services =
        local_of(Group::Mot, MufasaGroup::Mot) + local_of(Group::Plan, MufasaGroup::Plan);
    let decided = |Decision { report, tracks, trajectory, brake_by_ns, brake }| Decided {
        failed: report.map(|report| stage(report.failed_stage)).map_err(drop),
        tracks_ns: tracks.map(|it| it.stamp_ns),
        trajectory_ns: trajectory.map(|it| it.stamp_ns),
        brake_by_ns,
        local_services,
        brake: match brake {
            None => (MufasaBrakeReason::None, MufasaFailedStage::None),
            Some(Brake::NoTrajectory) => (MufasaBrakeReason::NoPlan, MufasaFailedStage::None),
            Some(Brake::Failed(failed, _)) => (MufasaBrakeReason::Fails, stage(Some(failed))),
            Some(Brake::Invalid(_)) => (MufasaBrakeReason::Invalid, MufasaFailedStage::None),
        },
    };
    Seen {
        groups: [answer.mot, answer.plan],
        hold_until_ns: answer.hold_until_ns,
        given_back_ns: answer.given_back_ns,
        actions: answer.actions,
        dropped: answer.dropped.map(|it| if it == Dropped::Older { Dropped::Repeated } else { it }),
        decision: answer.decision.map(decided),
    }
}

/// Choices for a sequence.
fn tape(seed: u64) -> Vec<u32> {
    const BY: u64 = 6_364_136_223_846_793_005;
    let mut state = seed;
    let next = || {
        state = state.wrapping_mul(BY).wrapping_add(1_442_695_040_888_963_407);
        u32::try_from(state >> 32).expect("32 bits")
    };
    std::iter::repeat_with(next).take(TAPE).collect()
}

/// MON-01, MON-08, MON-20, MON-40, MON-45, MON-69.
#[test]
fn the_monitor_in_c_answers_as_the_model() {
    let mut count = BTreeMap::<&str, u32>::new();
    let mut saw = |what, is: bool| *count.entry(what).or_default() += u32::from(is);
    let profiles = [Profile::PAPER, Profile::HARDENED];
    for (profile, seed) in (0..SEQUENCES).flat_map(|seed| profiles.map(|it| (it, seed))) {
        let tape = tape(seed);
        let (mut script, settings) = Script::new(&tape, profile);
        let mut model = Monitor::new(settings.clone(), route(), Reading::Exact).expect("settings");
        let mut in_c = InC::new(&settings, &route());
        let mut last_ns = None;
        for step in 0..STEPS {
            let mut event = script.event();
            if let EventKind::Cycle { measured } = &mut event.kind
                && model.requester().configuration().remote().mot
            {
                let most = usize::try_from(settings.memory.tracks).expect("places");
                let too_many = measured.tracks.take_if(|it| it.items.len() > most);
                saw("own tracks left out", too_many.is_some());
            }
            let answer = model.step(event.clone());
            let (found, wanted) = (in_c.step(&event), expected(answer.clone(), model.requester()));
            assert_eq!(found, wanted, "{profile:?}, seed {seed}, step {step}: {event:?}");
            script.take(&event, &answer);
            saw("steps", true);
            saw("dropped", wanted.dropped.is_some());
            saw("given back", wanted.given_back_ns == Some(event.t_ns));
            let Some(decided) = wanted.decision else { continue };
            saw("errors", decided.failed.is_err());
            saw("unsafe", decided.failed.is_ok_and(|it| it != MufasaFailedStage::None));
            saw("tracks", decided.tracks_ns.is_some());
            // No newer list was accepted in between: one was late or lost.
            let kept = decided.tracks_ns.is_some_and(|it| last_ns.replace(it) == Some(it));
            saw("tracks of two cycles", kept);
            saw("trajectories", decided.trajectory_ns.is_some());
            saw("times to brake by", decided.brake_by_ns.is_some());
            saw("own plans that fail", decided.brake.0 == MufasaBrakeReason::Fails);
            saw("no own plan", decided.brake.0 == MufasaBrakeReason::NoPlan);
            saw("invalid own input", decided.brake.0 == MufasaBrakeReason::Invalid);
        }
    }
    assert!(count["steps"] >= 10_000 && count["own tracks left out"] <= 50, "{count:?}");
    count.remove("own tracks left out");
    assert!(count.values().all(|it| *it >= 50), "{count:?}");
}
