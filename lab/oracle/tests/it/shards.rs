//! Parts of an experiment that are put together are the experiment (`mufasa merge`).

use std::fs;
use std::path::{Path, PathBuf};

use crate::kit::{Said, folder, said};
use serde_json::{Value, json};

const REPORT: &str = "report.html";
const SIZE: [&str; 4] = ["--scenarios", "1", "--vehicles", "2"];

fn part(folder: &Path, size: &[&str], shard: &str) -> String {
    let arguments = [&["evaluate", "failures", "--out", "parts", "--shard", shard], size].concat();
    said(folder, &arguments).has(0, "", "");
    format!("parts/failures.{}.part.json", shard.replace('/', "-of-"))
}

fn refused(folder: &Path, arguments: &[&str], why: &str) {
    said(folder, arguments).has(2, "", why);
}

/// The files below a folder, in order.
fn names(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|it| it.expect("an entry").path());
    let below = entries.flat_map(|path| {
        let name = PathBuf::from(path.file_name().expect("a name"));
        if !path.is_dir() {
            return vec![name];
        }
        names(&path).into_iter().map(|it| name.join(it)).collect()
    });
    let mut all: Vec<_> = below.collect();
    all.sort();
    all
}

/// The same files with the same bytes.
fn same(folder: &Path, one: &str, other: &str) {
    let [one, other] = [one, other].map(|it| folder.join(it));
    let all = names(&one);
    assert_eq!(all, names(&other));
    for name in all {
        let [one, other] = [&one, &other].map(|it| fs::read(it.join(&name)).expect("a file"));
        assert!(one == other, "{}", name.display());
    }
}

/// The command of the job of Kubernetes in `docs/experiments.md`, which sets a number in the environment, with
/// fewer scenarios.
#[cfg(unix)]
#[test]
fn every_index_of_the_job_in_the_documents_makes_a_part() {
    use std::process::Command;

    let docs = include_str!("../../../../docs/experiments.md");
    let behind = docs.split_once("command: [sh, -c, '").expect("a job").1;
    let command = behind.split_once("']").expect("its end").0;
    let ours = format!("exec \"$MUFASA\" evaluate failures {}", SIZE.join(" "));
    let script = command.replace("exec mufasa evaluate failures", &ours);
    let script = script.replace("/results", "results");
    assert!(script != command && script.contains("+ 1))/8\""), "{script}");
    let folder = folder("job");
    for index in 0..8 {
        let mut shell = Command::new("sh");
        shell.args(["-c", &script]).current_dir(&folder);
        shell.env("MUFASA", env!("CARGO_BIN_EXE_mufasa"));
        let done = shell.env("JOB_COMPLETION_INDEX", index.to_string()).output().expect("sh runs");
        assert_eq!(done.status.code(), Some(0), "{done:?}");
    }
    let parts = (1..=8).rev().map(|index| format!("results/failures.{index}-of-8.part.json"));
    let parts: Vec<String> = parts.collect();
    let mut merge = vec!["merge", "--out", "merged"];
    merge.extend(parts.iter().map(String::as_str));
    let merged = said(&folder, &merge);
    let whole = said(&folder, &[&["evaluate", "failures", "--out", "whole"], &SIZE[..]].concat());
    assert_eq!(merged.code, whole.code, "{}", merged.err);
    same(&folder, "merged", "whole");
    let written = names(&folder.join("whole"));
    let pages = written.iter().filter(|it| it.starts_with("replays")).count();
    assert!(written.contains(&PathBuf::from(REPORT)) && pages > 0, "{written:?}");
    let table = |told: &Said| {
        let is_file = |line: &&str| line.starts_with("whole/") || line.starts_with("merged/");
        told.out.lines().filter(|line| !is_file(line)).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(table(&whole), table(&merged));
    merged.has(0, "checked by the model; model and implementation agree", "");
}

#[test]
fn what_is_no_whole_is_refused_and_what_disagreed_is_said() {
    let folder = folder("refused");
    let [one, two] = ["1/2", "2/2"].map(|shard| part(&folder, &SIZE, shard));
    assert!(!folder.join("parts/failures.json").exists(), "a part is no whole");
    refused(&folder, &["merge", &one], "part 2 of 2 is missing");
    refused(&folder, &["merge", &one, &two, &one], "part 1 is there already");
    let text = fs::read_to_string(folder.join(&two)).expect("it is there");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut part = whole.clone();
        change(&mut part);
        fs::write(folder.join(&two), part.to_string()).expect("it can be written");
    };
    // What was checked in the parts is summed, and disagreements are named once more, with their exit code.
    assert!(whole["checks"]["checked"].as_u64().is_some_and(|it| it > 0), "{}", whole["checks"]);
    let differs = json!([{"id": "failures/x", "t_ns": 7, "why": "differs"}]);
    changed(&|part| part["checks"]["disagreements"] = differs.clone());
    said(&folder, &["merge", &one, &two]).has(3, "", "failures/x at 7 ns: differs");
    let version = said(&folder, &["--version"]).out;
    let version = version.trim().strip_prefix("mufasa ").expect("a name");
    assert_eq!(whole["version"], version);
    changed(&|part| part["version"] = json!("0.1.0 (commit 0123456789)"));
    let why =
        format!("{two}: it was made by mufasa 0.1.0 (commit 0123456789), and this is {version}");
    refused(&folder, &["merge", &one, &two], &why);
    changed(&|part| drop(part.as_object_mut().expect("an object").remove("version")));
    let why = format!("{two}: it does not say which mufasa made it");
    refused(&folder, &["merge", &one, &two], &why);
    fs::write(folder.join(&two), text.replace("\"failures/hardened", "\"failures/harder"))
        .expect("it can be written");
    refused(&folder, &["merge", &one, &two], "is in none of the parts");
    fs::write(folder.join(&two), "{}").expect("it can be written");
    refused(&folder, &["merge", &one, &two], "no part of an experiment");
    let other = part(&folder, &["--scenarios", "1", "--vehicles", "1"], "2/2");
    refused(&folder, &["merge", &one, &other], "vehicles: 1");
    for shard in ["0/2", "3/2", "1", "a/b", "1/0"] {
        let arguments = ["evaluate", "failures", "--out", "parts", "--shard", shard];
        refused(&folder, &arguments, "a part is I/N");
    }
    refused(&folder, &["evaluate", "failures", "--shard", "1/2"], "--out");
}

/// Rounds do not know of each other: a search in parts is the search, collisions and all.
#[test]
fn a_search_in_parts_is_byte_for_byte_the_search() {
    let folder = folder("falsify");
    // Nothing is checked, so that searches end soon.
    let size =
        ["--profile", "sofof", "--attack", "empty-tracks", "--vehicles", "8", "--rounds", "2"];
    let search = |more: &[&str]| {
        said(&folder, &[&["evaluate", "falsify"], &size[..], more].concat()).has(0, "", "");
    };
    search(&["--out", "whole"]);
    for shard in ["2/2", "1/2"] {
        search(&["--out", "parts", "--shard", shard]);
    }
    let parts = ["parts/falsify.2-of-2.part.json", "parts/falsify.1-of-2.part.json"];
    refused(&folder, &["merge", parts[0]], "part 1 of 2 is missing");
    said(&folder, &["merge", "--out", "merged", parts[0], parts[1]]).has(0, "", "");
    let written = names(&folder.join("whole"));
    let found = written.iter().filter(|it| it.starts_with("found")).count();
    let files = ["falsify.csv", "falsify.json", REPORT];
    assert!(files.iter().all(|it| written.contains(&PathBuf::from(it))), "{written:?}");
    assert!(found > 0, "nothing was found");
    same(&folder, "whole", "merged");
    let without = ["evaluate", "falsify", "--shard", "1/2", "--out", "parts"];
    refused(&folder, &without, "--rounds");
}
