//! What comes out of a cycle of the monitor, whatever the stages say (`spec/monitor.md#monitor`).
//!
//! Domain: an error or a report with any failed stage, whether stage i ran, any running sessions, any data that are
//! current or not, current detections or none. Not covered: what the stages answer, of which `cycle` is tested.

use mufasa::monitor::Time;
use mufasa::offloading::requester::Running;
use mufasa::parts::monitor::{Released, if_kept, is_last_used, is_ticked};
use mufasa::report::{FailedStage, Input, InvalidInput, Outcome, Problem, Report, Stage};

use super::any::{below, duration_ns, near_integer, option, time_ns};
#[cfg(not(kani))]
use crate::kani;

/// Nothing comes out of an unsafe cycle, nor of one that ended in an error [SCHED-18, FALL-03, FALL-11, MON-01,
/// MON-10].
#[cfg_attr(kani, kani::proof)]
pub fn verify_nothing_comes_out_of_an_unsafe_cycle() {
    let cycle = cycle();
    let Released { is_safe, tracks, trajectory, sessions } = cycle.released();
    let failed = cycle.is_error() || cycle.failed_stage.is_some();
    assert!(is_safe != failed);
    assert!(!failed || (!tracks && !trajectory));
    assert!(!failed || (sessions.mot.is_none() && sessions.plan.is_none()));
    let all = cycle.in_use[0].is_some() && cycle.has_current == [true; 2];
    kani::cover!(cycle.is_error() && all, "an error with current data");
    kani::cover!(!cycle.is_error() && failed && all, "a failed stage with current data");
    kani::cover!(tracks && trajectory, "both come out");
}

/// From a safe cycle remote tracks come out exactly when MOT is remote, they are current, and stage i ran; a trajectory
/// exactly when a group is remote, it is current, and there was what it is examined with: current detections, in the
/// hardened profile. In `Local` nothing does [SCHED-18, MON-01, MON-02, MON-04, MON-05, MON-66].
#[cfg_attr(kani, kani::proof)]
pub fn verify_what_comes_out_is_current_and_of_a_remote_group() {
    let cycle = cycle();
    let Released { is_safe, tracks, trajectory, .. } = cycle.released();
    let [mot, plan] = cycle.in_use.map(|session| session.is_some());
    assert!(tracks == (is_safe && mot && cycle.has_current[0] && !cycle.lacks_input));
    assert!(trajectory == (is_safe && (mot || plan) && cycle.has_current[1] && cycle.has_seen));
    assert!(mot || plan || !(tracks || trajectory));
    kani::cover!(tracks && !trajectory, "tracks alone");
    kani::cover!(trajectory && !plan, "a trajectory of the local planner");
    kani::cover!(is_safe && mot && cycle.has_current[0] && !tracks, "stage i did not run");
    kani::cover!(is_safe && plan && cycle.has_current[1] && !trajectory, "nothing was seen");
    kani::cover!(is_safe && !mot && !plan && cycle.has_current[1], "local");
}

/// The verdict names exactly the sessions of what comes out [MON-11].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_verdict_names_exactly_what_comes_out() {
    let cycle = cycle();
    let Released { tracks, trajectory, sessions, .. } = cycle.released();
    let [mot, plan] = cycle.in_use;
    assert!(sessions.mot == if tracks { mot } else { None });
    assert!(sessions.plan == if trajectory { plan } else { None });
    kani::cover!(sessions.mot.is_some() && sessions.plan.is_none(), "MOT alone");
    kani::cover!(sessions.plan.is_some() && sessions.mot.is_none(), "PLAN alone");
    kani::cover!(trajectory && plan.is_none(), "nothing to name");
}

/// A list of detections or own tracks that does not fit makes of each report an error; else the answer of the stages
/// stays [MON-19, MON-65].
#[cfg_attr(kani, kani::proof)]
pub fn verify_detections_that_do_not_fit_are_an_error() {
    let cycle = cycle();
    let each: [bool; 2] = [kani::any(), kani::any()];
    let fits = each == [true; 2];
    let answer = cycle.answer();
    let kept = if_kept(&answer, each);
    assert!(kept.is_err() == (cycle.is_error() || !fits));
    if let Err(problem) = kept {
        let is_own = problem.problem == Problem::ScratchTooSmall;
        assert!(is_own != cycle.is_error());
    }
    let found = kept.and(answer);
    let released = Released::of(&found, cycle.in_use, cycle.has_current, cycle.has_seen);
    assert!(fits || !(released.is_safe || released.tracks || released.trajectory));
    kani::cover!(!fits && cycle.failed_stage.is_none() && !cycle.is_error(), "it does not fit");
    kani::cover!(fits && released.tracks, "it fits");
}

/// An element is looked at exactly when it is the last one that the requester used in the running session: its
/// station, its session, its time of generation [MON-07, MON-08].
///
/// Domain: all running sessions and elements of 64 bits. Not covered: nothing of this function.
#[cfg_attr(kani, kani::proof)]
pub fn verify_an_element_is_the_last_one_used() {
    let running = Running {
        station: near_integer(1, 3),
        session: near_integer(1, 6),
        last_arrival_ns: time_ns(),
        last_used_ns: option(time_ns),
        local_computes: kani::any(),
    };
    let (station, session, generated_ns) = (near_integer(1, 3), near_integer(1, 6), time_ns());
    let found = is_last_used(&running, station, session, Time::from_nanoseconds(generated_ns));
    let is_of_it = station == running.station && session == running.session;
    let is_newest = running.last_used_ns == Some(generated_ns);
    assert!(found == (is_of_it && is_newest));
    kani::cover!(found, "the last one used");
    kani::cover!(is_of_it && running.last_used_ns.is_none(), "none was used");
    kani::cover!(is_of_it && running.last_used_ns.is_some() && !found, "an earlier one");
    kani::cover!(is_newest && !is_of_it, "of another session");
}

/// A tick is in time exactly when it came since the cycle before, not before that one, and not after the cycle and at
/// most `dt_max` before it [MON-45].
///
/// Domain: all times and each `dt_max` of 64 bits. Not covered: that nothing else keeps the last tick.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_tick_is_in_time_up_to_dt_max() {
    let (ticked_ns, before_ns) = (option(time_ns), option(time_ns));
    let (now_ns, dt_max_ns) = (time_ns(), duration_ns());
    let found = is_ticked(ticked_ns, before_ns, now_ns, dt_max_ns);
    let since_ns = ticked_ns.map(|tick_ns| i128::from(now_ns) - i128::from(tick_ns));
    let is_near = since_ns.is_some_and(|it| 0 <= it && it <= i128::from(dt_max_ns));
    // None is below every time.
    assert!(found == (is_near && before_ns <= ticked_ns));
    kani::cover!(is_near && !found && before_ns < Some(now_ns), "set back");
    kani::cover!(found && since_ns == Some(i128::from(dt_max_ns)), "as old as it may be");
    kani::cover!(!found && since_ns.is_some_and(|it| it < 0), "after the cycle");
    kani::cover!(!found && ticked_ns.is_none(), "none");
}

/// What a cycle lets out depends on these alone.
#[derive(Clone, Copy)]
pub(super) struct AnyCycle {
    kind: u8,
    failed_stage: Option<FailedStage>,
    lacks_input: bool,
    pub(super) in_use: [Option<i64>; 2],
    pub(super) has_current: [bool; 2],
    pub(super) has_seen: bool,
}

impl AnyCycle {
    fn is_error(&self) -> bool {
        self.kind == 0
    }

    pub(super) fn answer(&self) -> Result<Report, InvalidInput> {
        if self.is_error() {
            let problem = Problem::NotFinite;
            return Err(InvalidInput { field: "now_ns", index: None, problem });
        }
        let mut stages = [Outcome::NotScheduled; 5];
        if self.lacks_input {
            stages[0] = Outcome::NotApplicable(Input::Detections);
        }
        Ok(Report { failed_stage: self.failed_stage, stages, input: None })
    }

    fn released(&self) -> Released {
        Released::of(&self.answer(), self.in_use, self.has_current, self.has_seen)
    }
}

fn cycle() -> AnyCycle {
    cycle_of([option(|| near_integer(1, 6)), option(|| near_integer(1, 6))])
}

/// A cycle of any answer while these sessions run.
pub(super) fn cycle_of(in_use: [Option<i64>; 2]) -> AnyCycle {
    let failed_stage = match below(8) {
        0 => Some(FailedStage::Stage(Stage::I)),
        1 => Some(FailedStage::Stage(Stage::Ii)),
        2 => Some(FailedStage::Stage(Stage::Iii)),
        3 => Some(FailedStage::Stage(Stage::Iv)),
        4 => Some(FailedStage::Stage(Stage::V)),
        5 => Some(FailedStage::NoObstacleCheck),
        6 => Some(FailedStage::Input),
        _ => None,
    };
    AnyCycle {
        kind: below(2),
        failed_stage,
        lacks_input: kani::any(),
        in_use,
        has_current: [kani::any(), kani::any()],
        has_seen: kani::any(),
    }
}
