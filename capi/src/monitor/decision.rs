//! What a cycle ends in, and what has to be done about an event.

use core::ptr::null;

use mufasa::input::cycle::{Track, TrackList, Trajectory, TrajectoryPoint};
use mufasa::monitor::{Advice, Brake, Decision, DropReason, Inputs, Monitor, Time, Verified};
use mufasa::offloading::requester::{Action, Actions, Group, Source};
use mufasa::report::{InvalidInput, Witness};

use crate::cycle::{MufasaTrack, MufasaTrackList, MufasaTrajectory, MufasaTrajectoryPoint};
use crate::event::{self, MUFASA_MAX_ACTIONS, MufasaAction, MufasaActionType, MufasaGroup};
use crate::report::{self, MufasaFailedStage, MufasaInvalidInput, MufasaReport, MufasaWitness};
use crate::time::MufasaTime;

/// Why a message of a station was dropped; of several reasons the first in this order, except that
/// OTHER_SESSION comes before TOO_LONG.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaDropReason {
    /// It was not dropped, or the call was about no message.
    None = 0,
    /// It has more tracks or points than the settings say. It is no arrival: a station that goes on so is
    /// silent, and its session ends after dt_max.
    TooLong = 1,
    /// It is not of the running session of its group, or there is none.
    OtherSession = 2,
    /// It was generated after it arrived: the clocks cannot be trusted. The session has ended.
    FromTheFuture = 3,
    /// Its latency is above l_max. The session has ended.
    Late = 4,
    /// Its stamp is more than max_age ago, so that no cycle can use it. It is no arrival.
    TooOld = 5,
    /// For more than dt_max no cycle has had an element of the session that was current. It is no arrival:
    /// the session ends after dt_max.
    Starved = 6,
    /// The time since the last arrival is above dt_max. The session has ended.
    AfterSilence = 7,
    /// It is not generated later than the last one that was used: repeated, or overtaken.
    NotNewer = 8,
}

impl From<DropReason> for MufasaDropReason {
    fn from(why: DropReason) -> Self {
        match why {
            DropReason::TooLong => Self::TooLong,
            DropReason::OtherSession => Self::OtherSession,
            DropReason::FromTheFuture => Self::FromTheFuture,
            DropReason::Late => Self::Late,
            DropReason::TooOld => Self::TooOld,
            DropReason::Starved => Self::Starved,
            DropReason::AfterSilence => Self::AfterSilence,
            DropReason::NotNewer => Self::NotNewer,
        }
    }
}

/// What the program around the monitor seems to get wrong, each told once (`spec/4-arithmetic.md#advice`). No verdict
/// depends on it: write it to a log that somebody reads.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaAdvice {
    /// Nothing new.
    None = 0,
    /// Cycles come in another period than period_ns.
    Period = 1,
    /// Detections are given, and none was current.
    DetectionsNotCurrent = 2,
    /// A lead is given, and none was current: for the stages nobody is ahead.
    LeadNotCurrent = 3,
    /// A grid is given, and none was current.
    GridNotCurrent = 4,
    /// The gap does not change as the speeds of lead and CAV say: km/h, or a speed relative to the CAV.
    LeadSpeed = 5,
    /// The gap is longer than the way to the detection ahead: between centres, or from the reference point.
    GapTooLong = 6,
    /// It is shorter: detections that are too small, or a center_offset that is too small.
    GapTooShort = 7,
    /// No tick comes: nothing is offloaded, and nobody looks for silence.
    NoTick = 8,
}

impl From<Advice> for MufasaAdvice {
    fn from(advice: Advice) -> Self {
        match advice {
            Advice::Period => Self::Period,
            Advice::DetectionsNotCurrent => Self::DetectionsNotCurrent,
            Advice::LeadNotCurrent => Self::LeadNotCurrent,
            Advice::GridNotCurrent => Self::GridNotCurrent,
            Advice::LeadSpeed => Self::LeadSpeed,
            Advice::GapTooLong => Self::GapTooLong,
            Advice::GapTooShort => Self::GapTooShort,
            Advice::NoTick => Self::NoTick,
        }
    }
}

/// What has to be done about an event, in this order.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaActions {
    /// Why the message of this call is of no use, where it is; then a DROP is among the actions.
    pub dropped: MufasaDropReason,
    /// How many; of the array the rest means nothing.
    pub len: usize,
    /// The actions.
    pub items: [MufasaAction; MUFASA_MAX_ACTIONS],
}

/// Why control has to brake.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaBrakeReason {
    /// It has not to.
    None = 0,
    /// The CAV has no current plan of its own.
    NoPlan = 1,
    /// Its plan fails, in `failed_stage`, for `witness`.
    Fails = 2,
    /// The plan, or other local input, is invalid; `input` says what.
    Invalid = 3,
}

/// Whether control has to brake with at least `a_b`, from this cycle on until one says nothing of the kind, instead of
/// following a plan of the CAV's own. Only with `supervise_local`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaBrake {
    /// Whether, and why: `if (decision.brake.reason)`.
    pub reason: MufasaBrakeReason,
    /// Of a plan that fails.
    pub failed_stage: MufasaFailedStage,
    /// Of a plan that fails; none where nothing compared it with obstacles (H-05).
    pub witness: MufasaWitness,
    /// Of invalid input.
    pub input: MufasaInvalidInput,
}

/// The end of a cycle. Remote data come out here alone, in memory of the monitor, and may be read until
/// its next call, which empties the lists.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaDecision {
    /// Whether it is safe, and why not; the requester has been told. Anything but safe has made every group
    /// local.
    pub report: MufasaReport,
    /// Of a safe cycle the tracks of the station, while MOT is remote, they are current, and stage i ran: they were
    /// compared with what the CAV sees; an object that is not among them may still exist. Else null, so while the CAV
    /// has no current detections, too.
    pub tracks: *const MufasaTrackList,
    /// Of a safe cycle the trajectory that was checked, while a group is remote, it is current and, in the hardened
    /// profile, the CAV has current detections: that of the station, or while MOT alone is remote that of the CAV's own
    /// planner; else null.
    pub trajectory: *const MufasaTrajectory,
    /// By when control has to brake along the trajectory, with at least `a_b`, unless a later cycle has given one or, at
    /// a cycle in LOCAL, there is a plan of the CAV's own: what was examined covers no more. INT64_MAX ns where there is no trajectory, and in
    /// the paper profile.
    pub brake_by: MufasaTime,
    /// Releases to be sent, and local services that start or stop.
    pub actions: MufasaActions,
    /// Sum of MufasaGroup: the groups whose local services have to run from now on. Who sets his services to
    /// it in each period has started them even when he lost an action.
    pub local_services: u32,
    /// What this program seems to get wrong, if there is something new; `mufasa_advice_text` says it in words.
    pub advice: MufasaAdvice,
    /// Of the CAV's own plan.
    pub brake: MufasaBrake,
}

/// No time by which to brake.
const NEVER: MufasaTime = MufasaTime { ns: i64::MAX };

/// All are local.
const EVERY_GROUP: u32 = MufasaGroup::Mot as u32 | MufasaGroup::Plan as u32;

pub(super) const NO_LIST: MufasaTrackList =
    MufasaTrackList { stamp: MufasaTime::EPOCH, items: null(), items_len: 0 };
pub(super) const NO_TRAJECTORY: MufasaTrajectory =
    MufasaTrajectory { stamp: MufasaTime::EPOCH, points: null(), points_len: 0 };

/// Where verified data are for C to read.
pub(super) struct Verdicts {
    pub(super) tracks: &'static mut [MufasaTrack],
    pub(super) points: &'static mut [MufasaTrajectoryPoint],
    pub(super) track_list: MufasaTrackList,
    pub(super) trajectory: MufasaTrajectory,
}

impl Verdicts {
    /// A cycle, and its decision for C. A list is there as long as the lists that were given: they fit.
    pub(super) fn of_cycle(
        &mut self,
        monitor: &mut Monitor<'_>,
        inputs: &Inputs<'_>,
    ) -> MufasaDecision {
        let told = self.tell(&monitor.cycle(inputs));
        let is_local = |group: &Group| monitor.source(*group) == Source::Local;
        let local = Group::ALL.into_iter().filter(is_local);
        let local_services = local.fold(0, |sum, group| sum | event::group_number(group) as u32);
        // IMPL-16, IMPL-17
        let advice = monitor.advice().map_or(MufasaAdvice::None, Into::into);
        MufasaDecision { local_services, advice, ..told }
    }

    /// What the last cycle gave ends with it: who kept a pointer finds empty lists, and numbers that are none.
    pub(super) fn forget(&mut self) {
        // MON-03
        let tracks = self.tracks.iter_mut().take(self.track_list.items_len);
        tracks.for_each(|it| (it.x, it.y) = (f64::NAN, f64::NAN));
        let points = self.points.iter_mut().take(self.trajectory.points_len);
        points.for_each(|it| (it.x, it.y) = (f64::NAN, f64::NAN));
        (self.track_list, self.trajectory) = (NO_LIST, NO_TRAJECTORY);
    }

    fn tell(&mut self, (decision, actions): &(Decision<'_>, Actions)) -> MufasaDecision {
        match decision {
            Decision::Safe { tracks, trajectory, report, brake } => {
                let has_tracks = tracks.is_some_and(|list| self.keep_tracks(&list));
                let has_trajectory = trajectory.is_some_and(|it| self.keep_trajectory(&it));
                MufasaDecision {
                    report: report::report_of(report),
                    // After the last use of all of `self`, which would end them.
                    tracks: if has_tracks { &raw const self.track_list } else { null() },
                    trajectory: if has_trajectory { &raw const self.trajectory } else { null() },
                    // MON-40, MON-41
                    brake_by: trajectory.and_then(|it| it.brake_by()).map_or(NEVER, time),
                    actions: actions_of(actions),
                    local_services: EVERY_GROUP,
                    advice: MufasaAdvice::None,
                    brake: brake_of(*brake),
                }
            }
            Decision::Unsafe { report, brake } => MufasaDecision {
                report: match report {
                    Ok(report) => report::report_of(report),
                    Err(problem) => report::error(Some(*problem)),
                },
                tracks: null(),
                trajectory: null(),
                brake_by: NEVER,
                actions: actions_of(actions),
                local_services: EVERY_GROUP,
                advice: MufasaAdvice::None,
                brake: brake_of(*brake),
            },
        }
    }

    /// Whether the list is there for C: it fits.
    fn keep_tracks(&mut self, list: &Verified<'_, TrackList<'_>>) -> bool {
        if list.items.len() > self.tracks.len() {
            return false;
        }
        self.tracks.iter_mut().zip(list.items).for_each(|(place, it)| *place = track(it));
        let (items, items_len) = (self.tracks.as_ptr(), list.items.len());
        self.track_list =
            MufasaTrackList { stamp: MufasaTime { ns: list.stamp_ns }, items, items_len };
        true
    }

    fn keep_trajectory(&mut self, it: &Verified<'_, Trajectory<'_>>) -> bool {
        if it.points.len() > self.points.len() {
            return false;
        }
        self.points.iter_mut().zip(it.points).for_each(|(place, it)| *place = point(it));
        let (points, points_len) = (self.points.as_ptr(), it.points.len());
        self.trajectory =
            MufasaTrajectory { stamp: MufasaTime { ns: it.stamp_ns }, points, points_len };
        true
    }
}

/// A decision without data or actions, of a call that could not be carried out.
pub(super) fn nothing_decided() -> MufasaDecision {
    MufasaDecision {
        report: report::error(None),
        tracks: null(),
        trajectory: null(),
        brake_by: NEVER,
        actions: actions_of(&[]),
        local_services: EVERY_GROUP,
        advice: MufasaAdvice::None,
        brake: brake_of(None),
    }
}

fn brake_of(brake: Option<Brake>) -> MufasaBrake {
    let of = |reason, stage, witness: Option<Witness>, input: Option<InvalidInput>| MufasaBrake {
        reason,
        failed_stage: report::failed_stage(stage),
        witness: witness.as_ref().map_or(report::NO_WITNESS, report::witness),
        input: report::input(input),
    };
    match brake {
        None => of(MufasaBrakeReason::None, None, None, None),
        Some(Brake::NoPlan) => of(MufasaBrakeReason::NoPlan, None, None, None),
        Some(Brake::Fails { stage, witness }) => {
            of(MufasaBrakeReason::Fails, Some(stage), witness, None)
        }
        Some(Brake::Invalid(input)) => of(MufasaBrakeReason::Invalid, None, None, Some(input)),
    }
}

/// The actions for C.
pub(super) fn actions_of(actions: &[Action]) -> MufasaActions {
    let nothing = MufasaAction {
        action_type: MufasaActionType::Drop,
        group: MufasaGroup::Mot,
        station: 0,
        session: 0,
    };
    let dropped = MufasaDropReason::None;
    let mut told = MufasaActions { dropped, len: 0, items: [nothing; MUFASA_MAX_ACTIONS] };
    for (place, action) in told.items.iter_mut().zip(actions) {
        *place = event::action(*action);
        told.len = told.len.saturating_add(1);
    }
    told
}

const fn time(it: Time) -> MufasaTime {
    MufasaTime { ns: it.as_nanoseconds() }
}

fn track(it: &Track) -> MufasaTrack {
    let Track { id, x, y, cos, sin, vx, vy, length, width } = *it;
    MufasaTrack { id, x, y, cos, sin, vx, vy, length, width }
}

fn point(it: &TrajectoryPoint) -> MufasaTrajectoryPoint {
    let TrajectoryPoint { t_ns, x, y, cos, sin } = *it;
    MufasaTrajectoryPoint { t: MufasaTime { ns: t_ns }, x, y, cos, sin }
}
