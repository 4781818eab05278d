//! Fallbacks over a drive, and what is said about disagreements.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use mufasa_drives::check::checked::{Checked, Seen};
use mufasa_drives::check::fallback::Hold;
use mufasa_drives::check::findings::Findings;
use mufasa_drives::check::judge::Judged;
use mufasa_drives::check::records::Records;
use mufasa_drives::check::report::Report;
use mufasa_drives::check::{self, Format, Settings};
use mufasa_drives::{Attack, Drive, DriveCycle, Injection, ReadError, Stream, inject};
use mufasa_model::input::cycle::DetectionList;
use mufasa_model::offloading::requester::Parameters;
use mufasa_model::report::{FailedStage, Stage};
use mufasa_props::conformance::Disagreement;
use serde_json::Value;

fn drive(count: u32, blocked: impl Fn(u32) -> bool) -> Drive {
    let cycle = |index| DriveCycle {
        id: format!("straight#{index}"),
        cycle: crate::common::cycle(index, blocked(index)),
    };
    Drive {
        name: "straight".to_owned(),
        source: "test".to_owned(),
        lead_range_m: 80.0,
        cycles: (0..count).map(cycle).collect(),
        notes: Vec::new(),
    }
}

/// A drive, judged, with all that was shown of it.
struct Whole {
    checked: Checked,
    judged: Vec<Judged>,
    holds: Vec<[Option<Hold>; 2]>,
}

impl Whole {
    fn of(drive: impl Into<Stream>) -> Self {
        let (mut judged, mut holds) = (Vec::new(), Vec::new());
        let checked = Checked::new(drive, &Parameters::default(), false, |seen| {
            judged.push(seen.judged.clone());
            holds.push(seen.holds);
            Ok(())
        });
        Self { checked: checked.unwrap(), judged, holds }
    }

    /// Shows every cycle again.
    fn each(&self, mut each: impl FnMut(&Seen<'_>)) {
        let made = || self.checked.drive.cycles().map(Result::unwrap);
        let start_ns = made().next().map_or(0, |first| first.cycle.now_ns);
        for (index, made) in made().enumerate() {
            let (judged, holds) = (&self.judged[index], self.holds[index]);
            each(&Seen { index, start_ns, made: &made, judged, holds });
        }
    }

    /// Counts again, of judgements that were changed.
    fn count(&mut self) {
        let Checked { drive, requesters, alike, .. } =
            Whole::of(self.checked.drive.clone()).checked;
        let mut checked = Checked::of(drive);
        (checked.requesters, checked.alike) = (requesters, alike);
        self.each(|seen| checked.take(seen));
        self.checked = checked;
    }

    fn text(&self) -> String {
        let (mut report, mut out) = (Report::default(), Vec::new());
        self.each(|seen| report.take(seen).unwrap());
        report.write(&mut out, &self.checked).unwrap();
        String::from_utf8(out).unwrap()
    }

    fn records(&self) -> Vec<Value> {
        let (mut records, mut out) = (Records::default(), Vec::new());
        self.each(|seen| records.take(&self.checked.drive.name, seen).unwrap());
        records.write(&mut out, &self.checked).unwrap();
        let lines = String::from_utf8(out).unwrap();
        lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }

    /// The unsafe cycles, by one of the requesters.
    fn holds(&self, side: usize) -> Vec<(usize, Hold)> {
        let each = self.holds.iter().enumerate();
        each.filter_map(|(index, holds)| Some((index, holds[side]?))).collect()
    }
}

fn checked(drive: &Drive) -> Whole {
    Whole::of(drive.clone())
}

#[test]
fn a_safe_drive_has_no_fallback_and_is_offloaded_throughout() {
    let drive = drive(20, |_| false);
    let whole = checked(&drive);
    assert_eq!(whole.checked.disagreements(), 0);
    for run in &whole.checked.requesters {
        assert_eq!((run.fallbacks, run.offloaded, run.late), (0, 20, 0));
    }
    assert!(whole.text().contains("20 cycles, AllRemote, hardened: 20 safe, 0 unsafe"));
}

#[test]
fn unsafe_cycles_in_the_wait_start_no_fallback_and_the_one_at_its_end_does() {
    // The wait of 10 s that cycle 5 starts ends at cycle 105, inclusively (I-08).
    let drive = drive(110, |index| [5, 6, 50, 104, 105].contains(&index));
    let whole = checked(&drive);
    let start = drive.cycles[0].cycle.now_ns;
    let until = |seconds: i64| Hold::Started { until_ns: start + seconds * 100_000_000 };
    let expected = vec![
        (5, until(105)),
        (6, Hold::Running),
        (50, Hold::Running),
        (104, Hold::Running),
        (105, until(205)),
    ];
    assert_eq!((whole.holds(0), whole.holds(1)), (expected.clone(), expected));
    let Checked { requesters: [model, implementation], alike, .. } = &whole.checked;
    assert_eq!((model, *alike), (implementation, true));
    assert_eq!((model.offloaded, model.fallbacks, model.unsafe_cycles), (7, 2, 5));
    assert_eq!(whole.checked.disagreements(), 0);
    let text = whole.text();
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
    let whole = checked(&drive);
    let first = |index: usize| whole.judged[index].model.as_ref().unwrap().failed_stage;
    assert_eq!(first(2), Some(FailedStage::Stage(Stage::Iii)));
    assert_eq!(first(4), Some(FailedStage::Stage(Stage::Ii)));
    assert_eq!(whole.judged[3].alone, []);
    assert_eq!(whole.judged[2].alone, [Stage::Iii, Stage::Iv]);
    assert_eq!(whole.judged[4].alone, [Stage::Ii, Stage::Iii, Stage::Iv]);
    assert_eq!(whole.checked.alone, [0, 1, 2, 2, 0]);
    let text = whole.text();
    assert!(text.contains("run on its own, fails: i 0, ii 1, iii 2, iv 2, v 0"), "{text}");
    assert_eq!(whole.records()[4]["alone"], serde_json::json!(["ii", "iii", "iv"]));
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
    let last = attacked.cycle(attacked.count() - 1).unwrap().cycle;
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
    let whole = checked(&drive);
    let run = &whole.checked.requesters[0];
    assert_eq!(whole.holds(0), [(8, Hold::Off)]);
    assert_eq!((run.fallbacks, run.offloaded), (0, 8));
    // Both groups in every cycle: they are asked for again at the next tick.
    assert_eq!(run.late, 8);
    assert_eq!(run, &whole.checked.requesters[1]);
    let text = whole.text();
    assert!(text.contains("  8 results too late, of tracking and of planning each"), "{text}");
    assert!(text.contains("0.06 s old, more than l_max_ns = 50000000 (0.05 s)"), "{text}");
    // Where no cycle is unsafe, too, the summary and the exit code tell.
    let mut late = self::drive(12, |_| false);
    for cycle in &mut late.cycles[8..] {
        cycle.cycle.tracks.as_mut().unwrap().stamp_ns -= 60_000_000;
    }
    let mut findings = Findings::default();
    findings.add(&checked(&late).checked);
    assert_eq!(
        (findings.tally.unsafe_cycles(), findings.offloaded, findings.exit_code()),
        (0, 12, 1)
    );
    let summary = findings.summary();
    assert!(
        summary
            .contains("4 times tracking or planning went back to local for late data or silence"),
        "{summary}"
    );
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
    let whole = checked(&drive);
    let run = &whole.checked.requesters[0];
    assert_eq!((run.silent, run.offloaded, run.late), (2, 5, 0));
    assert_eq!(run, &whole.checked.requesters[1]);
    let text = whole.text();
    assert!(text.contains("silence longer than dt_max 2 times"), "{text}");
    assert!(text.contains("gaps of up to 0.100000001 s between cycles"), "{text}");
}

#[test]
fn fabricated_disagreements_are_counted_written_out_and_decide_the_exit_code() {
    let drive = drive(3, |index| index == 1);
    let mut whole = checked(&drive);
    let mut findings = Findings::default();
    findings.add(&whole.checked);
    assert_eq!(findings.exit_code(), 1);
    let exact = FailedStage::Stage(Stage::Iii);
    whole.judged[1] = Judged {
        implementation: whole.judged[0].model.clone(),
        disagreement: Some(Disagreement::UnsafeAccepted { exact }),
        ..whole.judged[1].clone()
    };
    whole.count();
    assert_eq!((whole.checked.disagreements(), whole.checked.otherwise), (1, 1));
    let text = whole.text();
    assert!(text.contains("DISAGREEMENT in cycle straight#1: unsound"), "{text}");
    assert!(text.contains("model: stage iii") && text.contains("implementation: safe"), "{text}");
    findings.add(&whole.checked);
    assert_eq!(findings.exit_code(), 3);
    assert!(findings.summary().contains("DISAGREE 1 time"));

    let records = whole.records();
    assert!(records[1]["disagreement"].as_str().unwrap().starts_with("unsound"));
    assert_eq!(records[3]["disagreements"], 1);
}

#[test]
fn a_difference_of_the_requesters_is_a_disagreement() {
    let drive = drive(3, |_| false);
    let mut whole = checked(&drive);
    assert_eq!(whole.checked.disagreements(), 0);
    whole.checked.protocol = Some("the requesters differ: here".to_owned());
    assert_eq!(whole.checked.disagreements(), 1);
    assert!(whole.text().contains("DISAGREEMENT: the requesters differ: here"));
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
    let whole = checked(&drive);
    assert_eq!(whole.judged[0].model.as_ref().unwrap_err().field, "work");
    assert!(whole.judged[0].implementation.is_ok());
    let mut findings = Findings::default();
    findings.add(&whole.checked);
    assert_eq!((findings.disagreements, findings.exit_code()), (0, 2));
}

#[test]
fn a_drive_without_cycles_is_no_error() {
    let drive = drive(0, |_| false);
    let whole = checked(&drive);
    assert!(whole.text().contains("0 cycles"));
    assert_eq!(whole.records().len(), 1);
}

/// A cycle takes 50 kB: of a drive of many there is never more than one.
#[test]
fn cycles_are_made_one_at_a_time_and_judged_before_the_next() {
    let [made, judged] = [(); 2].map(|()| Arc::new(AtomicUsize::new(0)));
    let (counted, seen) = (Arc::clone(&made), Arc::clone(&judged));
    let make = move |index: usize| {
        let before = counted.fetch_add(1, Ordering::SeqCst);
        assert_eq!((before, seen.load(Ordering::SeqCst)), (index, index), "cycles are kept");
        let cycle = crate::common::cycle(u32::try_from(index).unwrap(), index == 5);
        DriveCycle { id: format!("straight#{index}"), cycle }
    };
    let stream = Stream::new("straight".to_owned(), "test".to_owned(), 30, make);
    let mut answers = Vec::new();
    let streamed = Checked::new(stream, &Parameters::default(), false, |shown| {
        judged.fetch_add(1, Ordering::SeqCst);
        answers.push(shown.judged.clone());
        Ok(())
    });
    assert_eq!(made.load(Ordering::SeqCst), 30);
    let whole = checked(&drive(30, |index| index == 5));
    assert_eq!(answers, whole.judged);
    assert_eq!(streamed.unwrap().requesters, whole.checked.requesters);
}

/// Steps longer than `dt_max` lose offloading in a drive where every cycle is safe: what does it is named,
/// with what to do, in every format.
#[test]
fn a_drive_with_long_steps_says_which_parameter_ends_offloading() {
    let every_other = || {
        let cycles = drive(40, |_| false).cycles.into_iter().step_by(2).collect();
        Drive { cycles, ..drive(0, |_| false) }
    };
    let out = |format| {
        let settings = Settings { requester: Parameters::default(), format, pictures: None };
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let drives = [Ok(every_other().into()), Ok(every_other().into())];
        let findings = check::run(&drives, &settings, &mut out, &mut err).unwrap();
        assert_eq!((findings.exit_code(), findings.tally.safe, err.len()), (1, 40, 0));
        String::from_utf8(out).unwrap()
    };
    let note = "a cycle every 0.2 s, more than dt_max_ns = 100000000 (0.1 s)";
    let advice = "write `dt_max_ns = 250000000` into a file and give it by --parameters";
    let [text, summary, json] = [Format::Text, Format::Summary, Format::Json].map(out);
    for (out, times) in [(&text, 2), (&summary, 1), (&json, 2)] {
        assert_eq!([out.matches(note).count(), out.matches(advice).count()], [times; 2], "{out}");
    }
    assert!(summary.contains("(1 more drive alike)"), "{summary}");
    // With that parameter nothing is lost.
    let requester = Parameters { dt_max_ns: 250_000_000, ..Parameters::default() };
    let settings = Settings { requester, format: Format::Text, pictures: None };
    let mut out = Vec::new();
    let drives = [Ok(every_other().into())];
    let findings = check::run(&drives, &settings, &mut out, &mut Vec::new()).unwrap();
    assert_eq!(findings.exit_code(), 0);
    assert!(!String::from_utf8(out).unwrap().contains("dt_max"));
}

/// A drive that breaks off is no shorter drive: nothing is written of it, and what is wrong is said.
#[test]
fn a_drive_whose_cycles_are_lost_is_refused_as_a_whole() {
    let whole = drive(9, |_| false);
    let lost = Stream::fallible("gone".to_owned(), "l.jsonl".to_owned(), 9, |index| {
        let made = DriveCycle { id: format!("l#{index}"), cycle: crate::common::cycle(0, false) };
        let error = || ReadError::file(Path::new("l.jsonl"), "the disk fails");
        if index < 7 { Ok(made) } else { Err(error()) }
    });
    for format in [Format::Text, Format::Summary, Format::Json] {
        let settings = Settings { requester: Parameters::default(), format, pictures: None };
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let drives = [Ok(lost.clone()), Ok(whole.clone().into())];
        let findings = check::run(&drives, &settings, &mut out, &mut err).unwrap();
        assert_eq!((findings.exit_code(), findings.drives, findings.unreadable), (2, 1, 1));
        let [out, err] = [out, err].map(|bytes| String::from_utf8(bytes).unwrap());
        assert!(!out.contains("l#") && !out.contains("gone"), "{out}");
        assert_eq!(err, "mufasa: l.jsonl: the disk fails\n");
    }
    let injection = Injection { attack: Attack::EmptyTracks, from_s: 0.0, to_s: f64::INFINITY };
    let error = inject(&lost, &injection).unwrap_err();
    assert_eq!(error.to_string(), "l.jsonl: the disk fails");
}
