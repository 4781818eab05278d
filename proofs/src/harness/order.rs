//! The order of the stages (`spec/3-stages.md#schedule`), with an arbitrary answer for each stage.

use mufasa::cycle::order::{Given, Idle, Turn, decide, is_current};
use mufasa::input::profile::Profile;
use mufasa::report::{FailedStage, Input, Reason, Stage};
use mufasa::services::configuration::Configuration;

use super::any::{below, integer_within, profile, time_ns};
#[cfg(not(kani))]
use crate::kani;

/// Exactly the stages of the table are run, in their order, none after the first failure; every
/// other one has the right reason; the gap is asked for exactly where stage iv does not run although
/// nothing failed; and the cycle is unsafe exactly when a stage failed or, hardened, nothing
/// compared a current trajectory with obstacles [SCHED-01, SCHED-02, SCHED-03, SCHED-04, SCHED-05, SCHED-06, SCHED-07,
/// SCHED-08, SCHED-09, SCHED-10, SCHED-11, SCHED-15, SCHED-16, SCHED-17, H-02.1, H-02.2, H-02.3, H-04.3, H-05.1,
/// H-05.2, H-10.1, H-14.53].
///
/// Domain: all configurations, profiles, sets of inputs and answers of the stages. Not covered:
/// whether the gap is compared, and H-14 decided, where the gap is asked for (H-04: hardened, not in
/// `Local`), and what the stages answer.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(6))]
pub fn verify_order_is_the_table() {
    let configuration = match below(4) {
        0 => Configuration::MotRemote,
        1 => Configuration::AllRemote,
        2 => Configuration::PlanRemote,
        _ => Configuration::Local,
    };
    let profile = profile();
    let given = Given {
        tracks_of_any_age: kani::any(),
        tracks: kani::any(),
        trajectory: kani::any(),
        detections: kani::any(),
        grid: kani::any(),
    };
    let asked = Asked { profile, configuration, given };
    let answers: [bool; 5] = [kani::any(), kani::any(), kani::any(), kani::any(), kani::any()];
    let (mut at, mut failed, mut ran) = (0, None, [false; 5]);
    let found = decide(profile, configuration, given, |stage, turn| {
        assert!(at < 5 && stage == STAGES[at]);
        let expected = match asked.idle(at, ran, failed.is_some()) {
            None => Turn::Run,
            Some(idle) if at == 3 && failed.is_none() => Turn::Gap(idle),
            Some(idle) => Turn::Rest(idle),
        };
        assert!(turn == expected);
        ran[at] = turn == Turn::Run;
        let fails = answers[at] && !matches!(turn, Turn::Rest(_));
        if fails {
            failed = Some(stage);
        }
        at += 1;
        fails
    });
    assert!(at == 5);
    let unexamined = asked.is_unexamined(ran);
    assert!(match found {
        None => failed.is_none() && !unexamined,
        Some(FailedStage::Stage(stage)) => failed == Some(stage),
        Some(FailedStage::NoObstacleCheck) => failed.is_none() && unexamined,
        Some(FailedStage::Input) => false,
    });
    kani::cover!(found.is_none() && ran[4], "all pass");
    kani::cover!(failed == Some(Stage::V), "stage v fails");
    kani::cover!(failed == Some(Stage::Iv) && !ran[3], "the gap alone fails");
    kani::cover!(found == Some(FailedStage::NoObstacleCheck) && ran[2], "no obstacle check");
    kani::cover!(failed == Some(Stage::Iii) && !ran[3], "nothing runs after a failure");
}

/// An input is current exactly when its stamp is not after now and at most `max_age` old [SCHED-12].
///
/// Domain: all stamps and times of 64 bits, each `max_age` of the domain (0 to 60 s). Not covered: nothing.
#[cfg_attr(kani, kani::proof)]
pub fn verify_an_input_is_current_up_to_max_age() {
    let (stamp_ns, now_ns) = (time_ns(), time_ns());
    let max_age_ns = integer_within(0, 60_000_000_000);
    let age_ns = i128::from(now_ns) - i128::from(stamp_ns);
    let found = is_current(stamp_ns, now_ns, max_age_ns);
    assert!(found == (0 <= age_ns && age_ns <= i128::from(max_age_ns)));
    kani::cover!(found && age_ns == i128::from(max_age_ns), "as old as it may be");
    kani::cover!(found && age_ns == 0, "of now");
    kani::cover!(!found && age_ns < 0, "from the future");
    kani::cover!(!found && age_ns > i128::from(i64::MAX), "older than 64 bits");
}

/// How a stage is marked in the table.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mark {
    Always,
    Conditional,
    Dash,
}

use Mark::{Always, Conditional, Dash};

/// The table of the text: a row for each stage; `MotRemote`, `AllRemote`, `PlanRemote`, `Local`.
const TABLE: [[Mark; 4]; 5] = [
    [Always, Always, Dash, Dash],
    [Always, Always, Always, Dash],
    [Dash, Conditional, Always, Dash],
    [Conditional, Conditional, Conditional, Dash],
    [Always, Conditional, Dash, Dash],
];

const STAGES: [Stage; 5] = [Stage::I, Stage::Ii, Stage::Iii, Stage::Iv, Stage::V];

/// What the table is asked of.
#[derive(Clone, Copy)]
struct Asked {
    profile: Profile,
    configuration: Configuration,
    given: Given,
}

impl Asked {
    /// Why the stage at this place does not run, given which of those before ran and whether one failed.
    fn idle(self, at: usize, ran: [bool; 5], failed: bool) -> Option<Idle> {
        let column = match self.configuration {
            Configuration::MotRemote => 0,
            Configuration::AllRemote => 1,
            Configuration::PlanRemote => 2,
            Configuration::Local => 3,
        };
        let hardened = self.profile == Profile::HARDENED;
        // H-05: v is conditional in PlanRemote, too.
        let mark = if at == 4 && column == 2 && hardened { Conditional } else { TABLE[at][column] };
        let missing = first_missing(self.given, at);
        // H-10: hardened, nothing blocks v.
        let blocked = match at {
            3 => ran[2],
            4 => (ran[2] || ran[3]) && !hardened,
            _ => false,
        };
        match mark {
            Dash => Some(Idle::NotScheduled),
            Always | Conditional if failed => Some(Idle::Skipped(Reason::AfterFailure)),
            Conditional if blocked => Some(Idle::Skipped(Reason::OtherStageRan)),
            Conditional => missing.map(|input| Idle::Skipped(Reason::NoCurrent(input))),
            Always => missing.map(Idle::NotApplicable),
        }
    }

    /// Hardened, nothing compared a current trajectory with obstacles. H-02: in `AllRemote` tracks that stage i
    /// could not check are no obstacle check.
    fn is_unexamined(self, ran: [bool; 5]) -> bool {
        let all_remote = self.configuration == Configuration::AllRemote;
        let iii_counts = ran[2] && (!all_remote || self.given.detections);
        self.profile == Profile::HARDENED
            && self.configuration != Configuration::Local
            && self.given.trajectory
            && !(iii_counts || ran[3] || ran[4])
    }
}

/// What the stage reads and is not there. A list goes to stage i whatever its age.
fn first_missing(given: Given, at: usize) -> Option<Input> {
    let reads_second = match at {
        0 if !given.tracks_of_any_age => return Some(Input::Tracks),
        0 => (given.detections, Input::Detections),
        _ if !given.trajectory => return Some(Input::Trajectory),
        1 => return None,
        2 => (given.tracks, Input::Tracks),
        3 => (given.detections, Input::Detections),
        _ => (given.grid, Input::Grid),
    };
    let (is_there, input) = reads_second;
    if is_there { None } else { Some(input) }
}
