//! Parts of an experiment that are put together are the experiment (`mufasa merge`).

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use crate::kit::folder;
use crate::kit::run;
use serde_json::{Value, json};

const REPORT: &str = "report.html";
const SIZE: [&str; 4] = ["--scenarios", "1", "--vehicles", "2"];

fn part(folder: &Path, size: &[&str], shard: &str) -> String {
    let arguments = [&["evaluate", "failures", "--out", "parts", "--shard", shard], size].concat();
    let done = run(folder, &arguments);
    assert_eq!(done.status.code(), Some(0), "{done:?}");
    format!("parts/failures.{}.part.json", shard.replace('/', "-of-"))
}

fn refused(folder: &Path, arguments: &[&str], why: &str) {
    let done = run(folder, arguments);
    let said = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(2), "{said}");
    assert!(said.contains(why), "{said}");
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
    let parts = (1..=8).map(|index| format!("results/failures.{index}-of-8.part.json"));
    let parts: Vec<String> = parts.collect();
    let mut merge = vec!["merge", "--out", "merged"];
    merge.extend(parts.iter().map(String::as_str));
    run(&folder, &merge);
    run(&folder, &[&["evaluate", "failures", "--out", "whole"], &SIZE[..]].concat());
    same(&folder, "merged", "whole");
}

#[test]
fn parts_put_together_are_byte_for_byte_the_whole() {
    let folder = folder("whole");
    let whole = run(&folder, &[&["evaluate", "failures", "--out", "whole"], &SIZE[..]].concat());
    let parts = ["2/3", "3/3", "1/3"].map(|shard| part(&folder, &SIZE, shard));
    let mut merge = vec!["merge", "--out", "merged"];
    merge.extend(parts.iter().map(String::as_str));
    let merged = run(&folder, &merge);
    assert_eq!(merged.status.code(), whole.status.code(), "{merged:?}");
    let written = names(&folder.join("whole"));
    let pages = written.iter().filter(|it| it.starts_with("replays")).count();
    assert!(written.contains(&PathBuf::from(REPORT)) && pages > 0, "{written:?}");
    same(&folder, "whole", "merged");
    let table = |output: &Output| {
        let text = String::from_utf8(output.stdout.clone()).expect("UTF-8");
        text.split_inclusive('\n')
            .filter(|line| !line.starts_with("whole/") && !line.starts_with("merged/"))
            .collect::<String>()
    };
    assert_eq!(table(&whole), table(&merged));
    assert!(table(&merged).contains("checked by the model; model and implementation agree"));
    assert!(!folder.join("parts/failures.json").exists(), "a part is no whole");
}

/// What was checked in the parts is summed, and disagreements are named once more, with their exit code.
#[test]
fn what_disagreed_in_a_part_is_said_of_the_whole() {
    let folder = folder("disagrees");
    let parts = ["1/2", "2/2"].map(|shard| part(&folder, &SIZE, shard));
    let file = folder.join(&parts[1]);
    let text = fs::read_to_string(&file).expect("it is there");
    let mut part: Value = serde_json::from_str(&text).expect("JSON");
    assert!(part["checks"]["checked"].as_u64().is_some_and(|it| it > 0), "{}", part["checks"]);
    part["checks"]["disagreements"] = json!([{"id": "failures/x", "t_ns": 7, "why": "differs"}]);
    fs::write(&file, part.to_string()).expect("it can be written");
    let merged = run(&folder, &["merge", &parts[0], &parts[1]]);
    assert_eq!(merged.status.code(), Some(3), "{merged:?}");
    let said = String::from_utf8_lossy(&merged.stderr).into_owned();
    assert!(said.contains("failures/x at 7 ns: differs"), "{said}");
}

#[test]
fn a_part_of_another_program_is_refused() {
    let folder = folder("version");
    let [one, two] = ["1/2", "2/2"].map(|shard| part(&folder, &SIZE, shard));
    let said = String::from_utf8(run(&folder, &["--version"]).stdout).expect("UTF-8");
    let version = said.trim().strip_prefix("mufasa ").expect("a name");
    let text = fs::read_to_string(folder.join(&two)).expect("it is there");
    let mut part: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(part["version"], version);
    part["version"] = json!("0.1.0 (commit 0123456789)");
    fs::write(folder.join(&two), part.to_string()).expect("it can be written");
    let why =
        format!("{two}: it was made by mufasa 0.1.0 (commit 0123456789), and this is {version}");
    refused(&folder, &["merge", &one, &two], &why);
    part.as_object_mut().expect("an object").remove("version");
    fs::write(folder.join(&two), part.to_string()).expect("it can be written");
    refused(
        &folder,
        &["merge", &one, &two],
        &format!("{two}: it does not say which mufasa made it"),
    );
}

#[test]
fn what_is_no_whole_is_refused() {
    let folder = folder("refused");
    let [one, two] = ["1/2", "2/2"].map(|shard| part(&folder, &SIZE, shard));
    refused(&folder, &["merge", &one], "part 2 of 2 is missing");
    refused(&folder, &["merge", &one, &two, &one], "part 1 is there already");
    let other = part(&folder, &["--scenarios", "1", "--vehicles", "1"], "2/2");
    refused(&folder, &["merge", &one, &other], "vehicles: 1");
    let text = fs::read_to_string(folder.join(&one)).expect("it is there");
    let (name, renamed) = ("\"failures/hardened", "\"failures/harder");
    fs::write(folder.join(&one), text.replace(name, renamed)).expect("it can be written");
    let two = part(&folder, &SIZE, "2/2");
    refused(
        &folder,
        &["merge", &one, &two, "--into", "gone.md"],
        "gone.md: no table can be put there",
    );
    refused(&folder, &["merge", &one, &two], "is in none of the parts");
    fs::write(folder.join(&one), "{}").expect("it can be written");
    refused(&folder, &["merge", &one, &two], "no part of an experiment");
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
        let done = run(&folder, &[&["evaluate", "falsify"], &size[..], more].concat());
        assert_eq!(done.status.code(), Some(0), "{done:?}");
    };
    search(&["--out", "whole"]);
    for shard in ["2/2", "1/2"] {
        search(&["--out", "parts", "--shard", shard]);
    }
    let parts = ["parts/falsify.2-of-2.part.json", "parts/falsify.1-of-2.part.json"];
    refused(&folder, &["merge", parts[0]], "part 1 of 2 is missing");
    let nowhere = ["merge", parts[0], parts[1], "--into", "gone.md"];
    refused(&folder, &nowhere, "gone.md: no table can be put there");
    let merged = run(&folder, &["merge", "--out", "merged", parts[0], parts[1]]);
    assert_eq!(merged.status.code(), Some(0), "{merged:?}");
    let written = names(&folder.join("whole"));
    let found = written.iter().filter(|it| it.starts_with("found")).count();
    let files = ["falsify.csv", "falsify.json", "falsify.svg", REPORT];
    assert!(files.iter().all(|it| written.contains(&PathBuf::from(it))), "{written:?}");
    assert!(found > 0, "nothing was found");
    same(&folder, "whole", "merged");
    let without = ["evaluate", "falsify", "--shard", "1/2", "--out", "parts"];
    refused(&folder, &without, "--rounds");
}
