//! A check through C reports what a check in Rust reports, on each published cycle, with no byte of memory more than it
//! asks for.

mod records;

use std::collections::BTreeMap;
use std::ffi::{CStr, c_char};
use std::fmt::Debug;
use std::mem::MaybeUninit;
use std::path::{Path, PathBuf};
use std::{fs, ptr};

use mufasa::report::{FailedStage, InvalidInput, Outcome, Reason, Report, Witness};
use mufasa_capi::check::{mufasa_check, mufasa_scratch_bytes};
use mufasa_capi::cycle::{MufasaConfiguration, MufasaCycle, MufasaProfile, MufasaRoute};
use mufasa_capi::report::{MufasaOutcome, MufasaOutcomeKind, MufasaReport, MufasaRule};
use mufasa_capi::status::MufasaStatus;
use mufasa_model::input::cycle::{Cycle, DetectionList, Grid, Track, TrackList};
use mufasa_model::input::profile::Profile;
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge;
use mufasa_records::Record;
use serde_json::value::RawValue;

use records::{detection, detection_list, path, point, time, track, track_list};

/// A report, its words by name.
#[derive(Debug, PartialEq)]
struct Told {
    is_safe: bool,
    failed_stage: String,
    stages: Vec<Stage>,
    /// Field, message and index; empty words where nothing is wrong.
    input: (String, String, Option<i64>),
}

#[derive(Debug, PartialEq)]
struct Stage {
    kind: String,
    reason: String,
    missing: String,
    rule: String,
    /// Point, detection, item, age, segment, disk, column and row of the cell.
    numbers: [Option<i64>; 8],
    track: Option<i64>,
    compared: [f64; 2],
}

fn name(of: impl Debug) -> String {
    format!("{of:?}")
}

fn index(it: Option<usize>) -> Option<i64> {
    it.map(|it| i64::try_from(it).expect("an index"))
}

fn by_rust(report: &Result<Report, InvalidInput>) -> Told {
    let none = "None".to_owned();
    let stage = |kind: &str, reason: &str, missing, witness: Option<Witness>| Stage {
        kind: kind.to_owned(),
        reason: reason.to_owned(),
        missing,
        rule: witness.map_or(none.clone(), |it| name(it.rule)),
        numbers: witness.map_or([None; 8], |it| {
            let [column, row] = [it.cell.map(|it| it.0), it.cell.map(|it| it.1)];
            let of = [it.point, it.detection, it.item, it.segment, it.disk];
            let [point, detection, item, segment, disk] = of.map(index);
            [point, detection, item, it.age_ns, segment, disk, column, row]
        }),
        track: witness.and_then(|it| it.track),
        compared: witness.map_or([0.0; 2], |it| it.compared),
    };
    let not_scheduled = || stage("NotScheduled", "None", none.clone(), None);
    let outcome = |it: &Outcome| match *it {
        Outcome::NotScheduled => not_scheduled(),
        Outcome::Passed => stage("Passed", "None", none.clone(), None),
        Outcome::Failed(witness) => stage("Failed", "None", none.clone(), Some(witness)),
        Outcome::Skipped(Reason::AfterFailure) => {
            stage("Skipped", "AfterFailure", none.clone(), None)
        }
        Outcome::Skipped(Reason::OtherStageRan) => {
            stage("Skipped", "OtherStageRan", none.clone(), None)
        }
        Outcome::Skipped(Reason::NoCurrent(it)) => {
            stage("Skipped", "NoCurrentInput", name(it), None)
        }
        Outcome::NotApplicable(it) => stage("NotApplicable", "None", name(it), None),
    };
    let input = |it: Option<InvalidInput>| {
        it.map_or_else(Default::default, |InvalidInput { field, index: at, problem }| {
            (field.to_owned(), problem.message().to_owned(), index(at))
        })
    };
    match report {
        Ok(report) => Told {
            is_safe: report.failed_stage.is_none(),
            failed_stage: match report.failed_stage {
                None => none.clone(),
                Some(FailedStage::Stage(stage)) => name(stage),
                Some(failed) => name(failed),
            },
            stages: report.stages.iter().map(outcome).collect(),
            input: input(report.input),
        },
        Err(problem) => Told {
            is_safe: false,
            failed_stage: "Error".to_owned(),
            stages: (0..5).map(|_| not_scheduled()).collect(),
            input: input(Some(*problem)),
        },
    }
}

fn by_c(report: &MufasaReport) -> Told {
    let known = |it: i64| (it != -1).then_some(it);
    let stage = |MufasaOutcome { kind, reason, missing, witness }: &MufasaOutcome| {
        let [column, row] = witness.cell;
        let of = [witness.point, witness.detection, witness.item, witness.age_ns];
        let [point, detection, item, age] = of.map(known);
        let [segment, disk] = [witness.segment, witness.disk].map(known);
        let is_failed = *kind == MufasaOutcomeKind::Failed;
        assert_eq!(is_failed, witness.rule != MufasaRule::None, "{witness:?}");
        Stage {
            kind: name(kind),
            reason: name(reason),
            missing: name(missing),
            rule: name(witness.rule),
            numbers: [point, detection, item, age, segment, disk, known(column), known(row)],
            track: (witness.has_track != 0).then_some(witness.track),
            compared: witness.compared,
        }
    };
    let text = |it: &[c_char]| {
        let bytes: Vec<u8> = it.iter().map(|it| it.to_ne_bytes()[0]).collect();
        let ended = CStr::from_bytes_until_nul(&bytes).expect("a text ends with a 0");
        ended.to_str().expect("UTF-8").to_owned()
    };
    let MufasaReport { safe, failed_stage, stages, input } = report;
    Told {
        is_safe: *safe == 1,
        failed_stage: name(failed_stage),
        stages: stages.iter().map(stage).collect(),
        input: (text(&input.field), text(&input.message), known(input.index)),
    }
}

/// What a check in C says.
fn checked(cycle: &Cycle) -> Told {
    let points: Vec<_> = cycle.trajectory.iter().flat_map(|it| &it.points).map(point).collect();
    let trajectory = cycle.trajectory.as_ref().map(|it| path(it.stamp_ns, &points));
    let tracks: Vec<_> = cycle.tracks.iter().flat_map(|it| &it.items).map(track).collect();
    let track_list = cycle.tracks.as_ref().map(|it| track_list(it.stamp_ns, &tracks));
    let seen: Vec<_> = cycle.detections.iter().flat_map(|it| &it.items).map(detection).collect();
    let detections = cycle.detections.as_ref().map(|it| detection_list(it.stamp_ns, &seen));
    let history = &cycle.detection_history;
    let earlier: Vec<Vec<_>> =
        history.iter().map(|it| it.items.iter().map(detection).collect()).collect();
    let lists = history.iter().zip(&earlier);
    let lists: Vec<_> = lists.map(|(it, items)| detection_list(it.stamp_ns, items)).collect();
    let (lead, grid) = (cycle.lead.as_ref().map(records::lead), cycle.grid.as_ref());
    let grid = grid.map(records::grid);
    let sections = records::cross_sections(&cycle.route);
    let given = MufasaCycle {
        profile: if cycle.profile == Profile::PAPER {
            MufasaProfile::Paper
        } else {
            MufasaProfile::Hardened
        } as u32,
        configuration: match cycle.configuration {
            Configuration::Local => MufasaConfiguration::Local,
            Configuration::MotRemote => MufasaConfiguration::MotRemote,
            Configuration::AllRemote => MufasaConfiguration::AllRemote,
            Configuration::PlanRemote => MufasaConfiguration::PlanRemote,
        } as u32,
        now: time(cycle.now_ns),
        parameters: bridge::cycle_parameters(&cycle.parameters).into(),
        ego: records::ego(&cycle.ego),
        route: MufasaRoute {
            closed: u8::from(cycle.route.closed),
            cross_sections: sections.as_ptr(),
            cross_sections_len: sections.len(),
        },
        trajectory: pointer(trajectory.as_ref()),
        tracks: pointer(track_list.as_ref()),
        detections: pointer(detections.as_ref()),
        lead: pointer(lead.as_ref()),
        grid: pointer(grid.as_ref()),
        detection_history: lists.as_ptr(),
        detection_history_len: lists.len(),
    };
    let mut report = MaybeUninit::<MufasaReport>::uninit();
    // SAFETY: what is pointed to lives to the end of this function, here and below.
    let bytes = unsafe { mufasa_scratch_bytes(&raw const given) };
    // At an odd place most of it is lost to alignment.
    let mut memory = vec![0_u8; bytes + 2];
    let odd = usize::from(memory.as_ptr().addr().is_multiple_of(2));
    let scratch = memory.as_mut_ptr().wrapping_add(odd).cast();
    // SAFETY: as above.
    let status = unsafe { mufasa_check(&raw const given, scratch, bytes, report.as_mut_ptr()) };
    assert_eq!(status, MufasaStatus::Ok);
    // SAFETY: it is written whatever the status.
    by_c(unsafe { report.assume_init_ref() })
}

fn pointer<T>(of: Option<&T>) -> *const T {
    of.map_or(ptr::null(), ptr::from_ref)
}

/// The cycles of all vectors, with their names.
fn cycles() -> Vec<(String, Box<Cycle>)> {
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../vectors")];
    let mut found = Vec::new();
    while let Some(folder) = open.pop() {
        let entries = fs::read_dir(folder).expect("the vectors are published");
        let paths = entries.map(|it| it.expect("a directory entry").path());
        let (folders, files): (Vec<PathBuf>, Vec<PathBuf>) = paths.partition(|it| it.is_dir());
        open.extend(folders);
        for path in files.iter().filter(|it| it.extension().is_some_and(|it| it == "jsonl")) {
            for line in fs::read_to_string(path).expect("text").lines() {
                let vector: BTreeMap<String, Box<RawValue>> =
                    serde_json::from_str(line).expect("a vector is JSON");
                let record = mufasa_records::parse(vector["input"].get().as_bytes(), 1);
                if let Ok(Record::Cycle { cycle, .. }) = record {
                    found.push((vector["id"].get().to_owned(), cycle));
                }
            }
        }
    }
    found
}

/// What both say of a cycle.
fn as_in_rust(id: &str, cycle: &Cycle) -> Told {
    let report = bridge::with_impl(cycle, mufasa::cycle::check);
    let in_c = checked(cycle);
    assert_eq!(in_c, by_rust(&report), "{id}");
    in_c
}

/// Lists are passed on up to one element more than the domain has.
#[test]
fn a_list_as_long_as_the_domain_allows_is_whole_and_a_longer_one_refused() {
    let has_all = |it: &Cycle| {
        it.grid.is_some()
            && it.tracks.as_ref().is_some_and(|it| !it.items.is_empty())
            && it.detections.as_ref().is_some_and(|it| !it.items.is_empty())
    };
    let (_, cycle) = cycles().into_iter().find(|it| has_all(&it.1)).expect("such a vector");
    let grid = cycle.grid.clone().expect("a grid");
    for (bytes, words) in [(1 << 21, ""), ((1 << 21) + 1, "grid.occupied")] {
        let occupied = vec![0; bytes];
        let grid = Grid { width: 4096, height: 4096, occupied, unknown: None, ..grid.clone() };
        let told = as_in_rust("grid", &Cycle { grid: Some(grid), ..(*cycle).clone() });
        assert_eq!(told.input.0, words);
    }
    let tracks = cycle.tracks.clone().expect("tracks");
    let detections = cycle.detections.clone().expect("detections");
    for (more, is_refused) in [(0, false), (1, true)] {
        let items = (0..).map(|id| Track { id, ..tracks.items[0].clone() });
        let items = items.take(1024 + more).collect();
        let tracks = Some(TrackList { items, ..tracks });
        let told = as_in_rust("tracks", &Cycle { tracks, ..(*cycle).clone() });
        assert_eq!(told.input.0 == "tracks.items", is_refused, "{told:?}");
        let items = vec![detections.items[0].clone(); 2048 + more];
        let detections = Some(DetectionList { items, ..detections });
        let told = as_in_rust("detections", &Cycle { detections, ..(*cycle).clone() });
        assert_eq!(told.input.0 == "detections.items", is_refused, "{told:?}");
    }
}

#[test]
fn c_reports_on_each_vector_what_rust_reports() {
    let mut count = BTreeMap::<String, u32>::new();
    for (id, cycle) in cycles() {
        if ![Profile::PAPER, Profile::HARDENED].contains(&cycle.profile) {
            continue; // C has no part of a profile.
        }
        let in_c = as_in_rust(&id, &cycle);
        for stage in &in_c.stages {
            for word in [&stage.kind, &stage.reason, &stage.missing, &stage.rule] {
                *count.entry(word.clone()).or_default() += 1;
            }
        }
        *count.entry(in_c.failed_stage).or_default() += 1;
    }
    println!("{count:?}");
    for word in ["Failed", "AfterFailure", "NoCurrentInput", "Grid", "Reach", "Error", "V"] {
        assert!(count.get(word).is_some_and(|it| *it >= 5), "{word}: {count:?}");
    }
}
