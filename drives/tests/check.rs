//! Fallbacks over a drive, and what is said about disagreements.

mod common;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use mufasa_drives::check::checked::Checked;
use mufasa_drives::check::fallback::{Hold, RequesterRun};
use mufasa_drives::check::judge::Judged;
use mufasa_drives::check::{Findings, records, report};
use mufasa_drives::{Attack, Drive, DriveCycle, Injection, Stream, inject};
use mufasa_model::input::cycle::DetectionList;
use mufasa_model::offloading::requester::Parameters;
use mufasa_model::report::{FailedStage, Stage};
use mufasa_props::conformance::Disagreement;
use serde_json::Value;

fn drive(count: u32, blocked: impl Fn(u32) -> bool) -> Drive {
    let cycle = |index| DriveCycle {
        id: format!("straight#{index}"),
        cycle: common::cycle(index, blocked(index)),
    };
    Drive {
        name: "straight".to_owned(),
        source: "test".to_owned(),
        lead_range_m: 80.0,
        cycles: (0..count).map(cycle).collect(),
        notes: Vec::new(),
    }
}

fn checked(drive: &Drive) -> Checked {
    Checked::new(drive.clone(), &Parameters::default(), false, || {})
}

fn text(checked: &Checked) -> String {
    let mut out = Vec::new();
    report::write(&mut out, checked).unwrap();
    String::from_utf8(out).unwrap()
}

fn holds(run: &RequesterRun) -> Vec<(usize, Hold)> {
    run.unsafe_cycles.iter().map(|cycle| (cycle.index, cycle.hold)).collect()
}

#[test]
fn a_safe_drive_has_no_fallback_and_is_offloaded_throughout() {
    let drive = drive(20, |_| false);
    let checked = checked(&drive);
    assert_eq!(checked.disagreements(), 0);
    for run in &checked.requesters {
        assert_eq!((run.fallbacks(), run.offloaded, run.late), (0, 20, 0));
    }
    assert!(text(&checked).contains("20 cycles, AllRemote, hardened: 20 safe, 0 unsafe"));
}

#[test]
fn unsafe_cycles_in_the_wait_start_no_fallback_and_the_one_at_its_end_does() {
    // The wait of 10 s that cycle 5 starts ends at cycle 105, inclusively (I-08).
    let drive = drive(110, |index| [5, 6, 50, 104, 105].contains(&index));
    let checked = checked(&drive);
    let start = drive.cycles[0].cycle.now_ns;
    let until = |seconds: i64| Hold::Started { until_ns: start + seconds * 100_000_000 };
    let expected = vec![
        (5, until(105)),
        (6, Hold::Running),
        (50, Hold::Running),
        (104, Hold::Running),
        (105, until(205)),
    ];
    assert_eq!(holds(&checked.requesters[0]), expected);
    assert_eq!(checked.requesters[0], checked.requesters[1]);
    assert_eq!(checked.requesters[0].offloaded, 7);
    assert_eq!(checked.disagreements(), 0);
    let text = text(&checked);
    assert!(text.contains("at 0.5 s: stage iii, point 3 meets track 7 (4.6 m < 5 m)"), "{text}");
    assert!(text.contains("all local, wait until 10.5 s"), "{text}");
    assert!(text.contains("0.6 s to 10.4 s: 3 more unsafe during that wait (iii 3)"), "{text}");
}

/// The first stage that fails keeps the others from running; what they would have said is counted.
#[test]
fn stages_are_also_counted_on_their_own() {
    let mut drive = drive(6, |index| index == 2 || index == 4);
    // In cycle 4 the trajectory leaves the road, too, so that stage ii fails before stage iii runs.
    for point in &mut drive.cycles[4].cycle.trajectory.as_mut().unwrap().points {
        point.y += 0.8 * (point.x - 4.0) / 5.0;
    }
    let checked = checked(&drive);
    let first = |index: usize| checked.judged[index].model.as_ref().unwrap().failed_stage;
    assert_eq!(first(2), Some(FailedStage::Stage(Stage::Iii)));
    assert_eq!(first(4), Some(FailedStage::Stage(Stage::Ii)));
    assert_eq!(checked.judged[3].alone, []);
    assert_eq!(checked.judged[2].alone, [Stage::Iii, Stage::Iv]);
    assert_eq!(checked.judged[4].alone, [Stage::Ii, Stage::Iii, Stage::Iv]);
    assert_eq!(checked.alone(), [0, 1, 2, 2, 0]);
    let text = text(&checked);
    assert!(text.contains("run on its own, fails: i 0, ii 1, iii 2, iv 2, v 0"), "{text}");
    let line: Value = serde_json::from_str(&records::lines(&checked).unwrap()[4]).unwrap();
    assert_eq!(line["alone"], serde_json::json!(["ii", "iii", "iv"]));
}

/// The known road ends at 390 m, and so does the last plan. A CAV that drives what it is sent at 10 m/s comes near it, as the clean
/// one does, and nobody knows what comes behind: its drive ends where it could just stop before.
#[test]
fn an_attacked_drive_ends_where_the_known_road_does() {
    let mut clean = drive(390, |index| index == 389);
    clean.cycles[389].cycle.trajectory.as_mut().unwrap().points.truncate(2);
    let clean = Stream::from(clean);
    let injection = Injection { attack: Attack::EmptyTracks, from_s: 1.0, to_s: f64::INFINITY };
    let attacked = inject(&clean, &injection).unwrap();
    let note = "the drive ends where the CAV has come to the end of the road that is known";
    assert!(attacked.notes.iter().any(|it| it == note), "{:?}", attacked.notes);
    let last = attacked.cycle(attacked.count() - 1).cycle;
    let braking = last.ego.speed.powi(2) / (2.0 * last.parameters.a_b);
    let left = 390.0 - last.ego.x;
    assert!((braking..braking + 15.0).contains(&left), "{left} m left, {braking} m to brake");
    let early = Injection { to_s: 20.0, ..injection };
    let attacked = inject(&clean, &early).unwrap();
    assert!(!attacked.notes.iter().any(|it| it == note), "{:?}", attacked.notes);
    assert_eq!(attacked.count(), 201);
}

#[test]
fn late_data_end_offloading_without_a_wait() {
    let mut drive = drive(12, |index| index == 8);
    for cycle in &mut drive.cycles[8..] {
        // 60 ms: current for the stages, too late for the quality of service.
        let cycle = &mut cycle.cycle;
        cycle.tracks.as_mut().unwrap().stamp_ns -= 60_000_000;
        cycle.trajectory.as_mut().unwrap().stamp_ns -= 60_000_000;
    }
    let checked = checked(&drive);
    let run = &checked.requesters[0];
    assert_eq!(holds(run), [(8, Hold::Off)]);
    assert_eq!((run.fallbacks(), run.offloaded), (0, 8));
    // Both groups in every cycle: they are asked for again at the next tick.
    assert_eq!(run.late, 8);
    assert_eq!(run, &checked.requesters[1]);
    assert!(text(&checked).contains("data too late 8 times"));
    // Where no cycle is unsafe, too, the summary and the exit code tell.
    let mut late = self::drive(12, |_| false);
    for cycle in &mut late.cycles[8..] {
        cycle.cycle.tracks.as_mut().unwrap().stamp_ns -= 60_000_000;
    }
    let mut findings = Findings::default();
    findings.add(&Checked::new(late, &Parameters::default(), false, || {}));
    assert_eq!(
        (findings.tally.unsafe_cycles(), findings.offloaded, findings.exit_code()),
        (0, 12, 1)
    );
    assert!(findings.summary().contains("4 times back to local for late data or silence"));
}

#[test]
fn a_silence_between_cycles_ends_offloading_without_a_wait() {
    let mut drive = drive(6, |_| false);
    for cycle in &mut drive.cycles[3..] {
        let cycle = &mut cycle.cycle;
        cycle.now_ns += 1;
        let trajectory = cycle.trajectory.as_mut().unwrap();
        trajectory.stamp_ns += 1;
        trajectory.points.iter_mut().for_each(|point| point.t_ns += 1);
        cycle.tracks.as_mut().unwrap().stamp_ns += 1;
    }
    let checked = checked(&drive);
    let run = &checked.requesters[0];
    assert_eq!((run.silent, run.offloaded, run.late), (2, 5, 0));
    assert_eq!(run, &checked.requesters[1]);
    assert!(text(&checked).contains("silence longer than dt_max 2 times"));
}

#[test]
fn fabricated_disagreements_are_counted_written_out_and_decide_the_exit_code() {
    let drive = drive(3, |index| index == 1);
    let mut checked = checked(&drive);
    let mut findings = Findings::default();
    findings.add(&checked);
    assert_eq!(findings.exit_code(), 1);
    let exact = FailedStage::Stage(Stage::Iii);
    checked.judged[1] = Arc::new(Judged {
        implementation: checked.judged[0].model.clone(),
        disagreement: Some(Disagreement::UnsafeAccepted { exact }),
        ..Judged::clone(&checked.judged[1])
    });
    assert_eq!((checked.disagreements(), checked.otherwise()), (1, 1));
    let text = text(&checked);
    assert!(text.contains("DISAGREEMENT in cycle straight#1: unsound"), "{text}");
    assert!(text.contains("model: stage iii") && text.contains("implementation: safe"), "{text}");
    findings.add(&checked);
    assert_eq!(findings.exit_code(), 3);
    assert!(findings.summary().contains("DISAGREE 1 time"));

    let lines = records::lines(&checked).unwrap();
    let records: Vec<Value> =
        lines.iter().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(records[1]["disagreement"].as_str().unwrap().starts_with("unsound"));
    assert_eq!(records[3]["disagreements"], 1);
}

#[test]
fn a_difference_of_the_requesters_is_a_disagreement() {
    let drive = drive(3, |_| false);
    let mut checked = checked(&drive);
    assert_eq!(checked.disagreements(), 0);
    checked.protocol = Some("the requesters differ: here".to_owned());
    assert_eq!(checked.disagreements(), 1);
    assert!(text(&checked).contains("DISAGREEMENT: the requesters differ: here"));
}

/// A cycle that needs more than 10^10 comparisons is left out: the model does not answer, and no
/// answer of the implementation disagrees with that.
#[test]
fn a_cycle_too_large_for_the_model_is_an_error_and_no_disagreement() {
    let mut drive = drive(1, |_| false);
    let cycle = &mut drive.cycles[0].cycle;
    let list = cycle.detections.as_mut().unwrap();
    list.items = vec![list.items[0].clone(); 2048];
    let earlier = |age_ns| DetectionList { stamp_ns: list.stamp_ns - age_ns, ..list.clone() };
    cycle.detection_history = vec![earlier(300_000_000), earlier(500_000_000)];
    let checked = checked(&drive);
    assert_eq!(checked.judged[0].model.as_ref().unwrap_err().field, "work");
    assert!(checked.judged[0].implementation.is_ok());
    let mut findings = Findings::default();
    findings.add(&checked);
    assert_eq!((findings.disagreements, findings.exit_code()), (0, 2));
}

#[test]
fn a_drive_without_cycles_is_no_error() {
    let drive = drive(0, |_| false);
    let checked = checked(&drive);
    assert!(text(&checked).contains("0 cycles"));
    assert_eq!(records::lines(&checked).unwrap().len(), 1);
}

/// A cycle takes 50 kB: of a drive of many there is never more than one.
#[test]
fn cycles_are_made_one_at_a_time_and_judged_before_the_next() {
    let [made, judged] = [(); 2].map(|()| Arc::new(AtomicUsize::new(0)));
    let (counted, seen) = (Arc::clone(&made), Arc::clone(&judged));
    let make = move |index: usize| {
        let before = counted.fetch_add(1, Ordering::SeqCst);
        assert_eq!((before, seen.load(Ordering::SeqCst)), (index, index), "cycles are kept");
        let cycle = common::cycle(u32::try_from(index).unwrap(), index == 5);
        DriveCycle { id: format!("straight#{index}"), cycle }
    };
    let stream = Stream::new("straight".to_owned(), "test".to_owned(), 30, make);
    let done = || {
        judged.fetch_add(1, Ordering::SeqCst);
    };
    let streamed = Checked::new(stream, &Parameters::default(), false, done);
    assert_eq!(made.load(Ordering::SeqCst), 30);
    let whole = checked(&drive(30, |index| index == 5));
    assert_eq!(streamed.judged, whole.judged);
    // Safe ones in succession are one.
    assert!(Arc::ptr_eq(&streamed.judged[0], &streamed.judged[4]));
    assert!(!Arc::ptr_eq(&streamed.judged[4], &streamed.judged[5]));
    assert_eq!((streamed.steps, streamed.requesters), (whole.steps, whole.requesters));
}
