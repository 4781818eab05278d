//! `spec/3-stages.md#schedule`

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{FailedStage, Input, Outcome, Reason, Stage};
use mufasa_model::services::configuration::Configuration::{
    AllRemote, Local, MotRemote, PlanRemote,
};
use mufasa_model::stages::{Scheduled, scheduled};

use crate::base::*;

/// An outcome in two letters: P passed, F failed, s skipped (a after failure, o other stage ran,
/// j d g t no current trajectory, detections, grid, tracks), n not applicable, - not scheduled.
fn letters(cycle: &Cycle) -> String {
    let input = |input| match input {
        Input::Trajectory => "j",
        Input::Tracks => "t",
        Input::Detections => "d",
        Input::Grid => "g",
    };
    let stages = report(cycle).stages.map(|outcome| match outcome {
        Outcome::Passed => "P".into(),
        Outcome::Failed(_) => "F".into(),
        Outcome::Skipped(Reason::AfterFailure) => "sa".into(),
        Outcome::Skipped(Reason::OtherStageRan) => "so".into(),
        Outcome::Skipped(Reason::NoCurrent(missing)) => format!("s{}", input(missing)),
        Outcome::NotApplicable(missing) => format!("n{}", input(missing)),
        Outcome::NotScheduled => "-".into(),
    });
    stages.join(" ")
}

/// Removes the inputs whose letters are named.
fn without(mut cycle: Cycle, inputs: &str) -> Cycle {
    for input in inputs.chars() {
        match input {
            'j' => cycle.trajectory = None,
            't' => cycle.tracks = None,
            'd' => cycle.detections = None,
            'g' => cycle.grid = None,
            other => panic!("no input {other}"),
        }
    }
    cycle
}

/// spec/3-stages.md#schedule.1: in `Local` no stage runs, whatever is wrong with the data.
#[test]
fn in_local_no_stage_runs() {
    for profile in PROFILES {
        let mut cycle = base(profile, Local);
        cycle.trajectory.as_mut().expect("there is one").points[0].y = 50.0;
        assert_eq!(letters(&cycle), "- - - - -");
        assert_eq!(failed(&cycle), None);
    }
}

/// spec/3-stages.md#schedule.4, spec/3-stages.md#schedule.5, I-05: the table of the paper profile
/// with every input missing in turn.
#[test]
fn paper_schedule_is_the_table() {
    let rows = [
        (MotRemote, "", "P P - P P"),
        (MotRemote, "t", "nt P - P P"),
        (MotRemote, "d", "nd P - sd P"),
        (MotRemote, "g", "P P - P ng"),
        (MotRemote, "j", "P nj - sj nj"),
        (MotRemote, "td", "nt P - sd P"),
        (MotRemote, "dg", "nd P - sd ng"),
        (AllRemote, "", "P P P so so"),
        (AllRemote, "t", "nt P st P so"),
        (AllRemote, "d", "nd P P so so"),
        (AllRemote, "td", "nt P st sd P"),
        (AllRemote, "tdg", "nt P st sd sg"),
        (AllRemote, "j", "P nj sj sj sj"),
        (AllRemote, "jtdg", "nt nj sj sj sj"),
        (PlanRemote, "", "- P P so -"),
        (PlanRemote, "t", "- P nt P -"),
        (PlanRemote, "td", "- P nt sd -"),
        (PlanRemote, "tdg", "- P nt sd -"),
        (PlanRemote, "j", "- nj nj sj -"),
    ];
    for (configuration, missing, expected) in rows {
        let cycle = without(base(Profile::Paper, configuration), missing);
        assert_eq!(letters(&cycle), expected, "{configuration:?} without {missing:?}");
        assert_eq!(failed(&cycle), None, "{configuration:?} without {missing:?}");
    }
}

/// H-02, H-05, H-10: the table of the hardened profile.
#[test]
fn hardened_schedule_is_the_table() {
    let fails = Some(FailedStage::NoObstacleCheck);
    let rows = [
        (MotRemote, "", "P P - P P", None),
        (MotRemote, "d", "nd P - sd P", None),
        (MotRemote, "dg", "nd P - sd ng", fails),
        (MotRemote, "g", "P P - P ng", None),
        // H-10: iv whenever detections are current, v whenever iv did not run.
        (AllRemote, "", "P P P P so", None),
        (AllRemote, "g", "P P P P so", None),
        (AllRemote, "d", "nd P P sd P", None),
        // H-02: stage i did not check the list, so stage iii is no obstacle check.
        (AllRemote, "dg", "nd P P sd sg", fails),
        (AllRemote, "t", "nt P st P so", None),
        (AllRemote, "td", "nt P st sd P", None),
        (AllRemote, "tdg", "nt P st sd sg", fails),
        (AllRemote, "jtdg", "nt nj sj sj sj", None),
        // H-05: v is conditional in PlanRemote, too.
        (PlanRemote, "", "- P P so so", None),
        (PlanRemote, "t", "- P nt P so", None),
        (PlanRemote, "td", "- P nt sd P", None),
        (PlanRemote, "tdg", "- P nt sd sg", fails),
        (PlanRemote, "dg", "- P P so so", None),
        (PlanRemote, "jtdg", "- nj nj sj sj", None),
    ];
    for (configuration, missing, expected, verdict) in rows {
        // Without stage i no id is held, and the standing track 60 m ahead is far away.
        let cycle = without(base(Profile::Hardened, configuration), missing);
        assert_eq!(letters(&cycle), expected, "{configuration:?} without {missing:?}");
        assert_eq!(failed(&cycle), verdict, "{configuration:?} without {missing:?}");
    }
}

/// spec/3-stages.md#schedule.2, I-04: after the first failure no later stage runs, an always stage
/// included, and no other stage is asked instead.
#[test]
fn after_the_first_failure_no_stage_runs() {
    for profile in PROFILES {
        let mut cycle = base(profile, MotRemote);
        cycle.tracks = tracks(vec![track(1, 59.0, 0.0)]);
        assert_eq!(letters(&cycle), "F sa - sa sa");
        assert_eq!(failed(&cycle), Some(FailedStage::Stage(Stage::I)));

        let mut cycle = base(profile, AllRemote);
        cycle.trajectory.as_mut().expect("there is one").points[3].y = 9.0;
        assert_eq!(letters(&cycle), "P F sa sa sa");
        assert_eq!(failed(&cycle), Some(FailedStage::Stage(Stage::Ii)));
    }
}

/// spec/3-stages.md#schedule.3: stage i runs on received tracks of any age, but only with current
/// detections; the other stages need a current trajectory.
#[test]
fn stage_i_runs_on_old_received_tracks() {
    let mut cycle = base(Profile::Paper, AllRemote);
    cycle.tracks.as_mut().expect("there are tracks").stamp_ns = NOW - 59_000_000_000;
    assert_eq!(letters(&cycle), "P P st P so");
    cycle.trajectory.as_mut().expect("there is one").stamp_ns = NOW - 100_000_001;
    assert_eq!(letters(&cycle), "P nj sj sj sj");
    cycle.detections.as_mut().expect("there are detections").stamp_ns = NOW - 100_000_001;
    assert_eq!(letters(&cycle), "nd nj sj sj sj");
}

/// spec/3-stages.md#schedule.6: 0 <= now - stamp <= max_age, both ends included.
#[test]
fn data_are_current_up_to_max_age() {
    let with_age = |age: i64| {
        let mut cycle = base(Profile::Paper, MotRemote);
        cycle.grid.as_mut().expect("there is a grid").stamp_ns = NOW - age;
        outcome(&cycle, Stage::V)
    };
    assert_eq!(with_age(0), Outcome::Passed);
    assert_eq!(with_age(100_000_000), Outcome::Passed);
    assert_eq!(with_age(100_000_001), Outcome::NotApplicable(Input::Grid));
    assert_eq!(with_age(-1), Outcome::NotApplicable(Input::Grid));
}

/// spec/3-stages.md#schedule.6: a local list that is not current counts as missing, the lead too.
#[test]
fn old_lead_is_no_lead() {
    let mut cycle = base(Profile::Paper, MotRemote);
    cycle.lead = lead(1.0, 0.0);
    assert_eq!(failed(&cycle), Some(FailedStage::Stage(Stage::Iv)));
    cycle.lead.as_mut().expect("there is a lead").stamp_ns = NOW - 100_000_001;
    assert_eq!(failed(&cycle), None);
}

/// spec/3-stages.md#schedule.4: in MotRemote the received tracks are not used by iii.
#[test]
fn received_tracks_are_not_used_by_iii_in_mot_remote() {
    for profile in PROFILES {
        let mut cycle = base(profile, MotRemote);
        cycle.tracks = tracks(vec![track(1, 5.0, 0.0)]);
        cycle.detections = None;
        assert_eq!(failed(&cycle), None, "a track in the way, which nothing looks at");
    }
}

/// I-06: a conditional stage replaces a stage that cannot be performed, not one that found
/// something: a collision found by iii is a failure at once.
#[test]
fn a_collision_found_is_a_failure_at_once() {
    let mut cycle = base(Profile::Paper, PlanRemote);
    cycle.tracks = tracks(vec![track(1, 5.0, 0.0)]);
    assert_eq!(letters(&cycle), "- P F sa -");
}

/// I-11: an empty track list is a track list: stage iii runs on it.
#[test]
fn an_empty_track_list_is_a_track_list() {
    let mut cycle = base(Profile::Paper, PlanRemote);
    cycle.tracks = tracks(vec![]);
    assert_eq!(letters(&cycle), "- P P so -");
}

/// spec/3-stages.md#schedule.7, spec/3-stages.md#schedule.8: every scheduled stage has an outcome,
/// and the verdict is unsafe exactly when one failed or H-05 applies.
#[test]
fn unsafe_exactly_when_a_stage_failed() {
    let mut unsafe_cycles = 0;
    for profile in PROFILES {
        for configuration in REMOTE {
            for mask in 0..16u32 {
                let missing: String = "jtdg"
                    .chars()
                    .enumerate()
                    .filter(|(i, _)| mask >> i & 1 == 1)
                    .map(|(_, c)| c)
                    .collect();
                for bad_y in [0.0, 9.0] {
                    let mut cycle = without(base(profile, configuration), &missing);
                    if let Some(trajectory) = cycle.trajectory.as_mut() {
                        trajectory.points[2].y = bad_y;
                    }
                    let report = report(&cycle);
                    let failed = report.stages.iter().any(|o| matches!(o, Outcome::Failed(_)));
                    let no_check = report.failed_stage == Some(FailedStage::NoObstacleCheck);
                    assert!(!(failed && no_check));
                    assert_eq!(report.failed_stage.is_some(), failed || no_check);
                    unsafe_cycles += u32::from(report.failed_stage.is_some());
                    for stage in Stage::ALL {
                        let never = scheduled(profile, configuration, stage) == Scheduled::Never;
                        let outcome = &report.stages[stage as usize];
                        assert_eq!(never, *outcome == Outcome::NotScheduled);
                    }
                }
            }
        }
    }
    assert!(unsafe_cycles > 40, "{unsafe_cycles}");
}

/// spec/3-stages.md#schedule.9: of several witnesses the first by rule, then by point, then by list.
#[test]
fn witness_is_the_first() {
    let mut cycle = base(Profile::Paper, PlanRemote);
    cycle.tracks = tracks(vec![track(8, 12.0, 0.0), track(9, 9.0, 0.0), track(7, 9.0, 0.5)]);
    let found = witness(&cycle, Stage::Iii);
    // The front of the CAV at point 5 reaches 7.0, where the cars at 9.0 begin.
    assert_eq!((found.point, found.track), (Some(5), Some(9)));
    assert_eq!(found.compared.map(f64::to_bits), [4.0, 5.0].map(f64::to_bits));
}
