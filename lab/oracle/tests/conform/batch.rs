//! The commands of `docs/conformance.md#large-campaigns` run as they stand there, with fewer cases.
//! GNU parallel is used where it is installed and `xargs` in its place elsewhere; what Slurm and
//! Kubernetes do, to run a script with a number in its environment, is done by this test.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::{MUFASA, folder, summary, text};

const DOCS: &str = include_str!("../../../../docs/conformance.md");

/// The block of code behind the line that begins with these words.
fn block(words: &str) -> String {
    let behind = DOCS.lines().skip_while(|line| !line.starts_with(words)).skip(2);
    let code = behind.map_while(|line| line.strip_prefix("    "));
    let code: String = code.flat_map(|line| [line, "\n"]).collect();
    assert!(code.contains("mufasa conform"), "no commands behind {words:?}");
    code
}

/// Runs a script where `mufasa` is in the path and `./your-program` conforms.
fn run(folder: &Path, script: &str, number: Option<(&str, u32)>) -> Output {
    let mut path = vec![PathBuf::from(MUFASA).parent().expect("a folder").to_owned()];
    path.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()));
    let mut shell = Command::new("sh");
    shell.args(["-c", script]).current_dir(folder);
    shell.env("PATH", std::env::join_paths(path).expect("a path"));
    if let Some((name, number)) = number {
        shell.env(name, number.to_string());
    }
    shell.output().expect("sh runs")
}

fn prepared(test: &str) -> PathBuf {
    let folder = folder(test);
    let program = folder.join("your-program");
    fs::write(&program, "#!/bin/sh\nexec mufasa oracle\n").expect("a file");
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).expect("executable");
    folder
}

/// The script with so many cases, and no vectors.
fn with_cases(script: &str, cases: u32) -> String {
    let (before, rest) = script.split_once("--cases ").expect("a number of cases");
    format!(
        "{before}--no-vectors --cases {cases}{}",
        rest.trim_start_matches(|c: char| c.is_ascii_digit())
    )
}

/// Runs every shard, and merges as the docs do.
fn shards(test: &str, script: &str, variable: &str, of: u32) {
    let folder = prepared(test);
    let script = with_cases(script, 2 * of);
    assert!(script.contains(&format!("{variable}/{of}\"")), "{script}");
    for shard in 0..of {
        let output = run(&folder, &script, Some((variable, shard)));
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
    }
    let merge = format!("mufasa conform merge results/summary.*-of-{of}.json --out results");
    is_whole(&folder, &run(&folder, &merge, None), of);
}

fn is_whole(folder: &Path, output: &Output, of: u32) {
    assert_eq!(output.status.code(), Some(0), "{}", text(output));
    let summary = summary(&folder.join("results"));
    assert_eq!((summary.asked, summary.campaign.of), (u64::from(2 * of), 1));
    assert!(summary.is_complete());
}

#[test]
fn gnu_parallel() {
    let folder = prepared("parallel");
    let mut script = with_cases(&block("GNU parallel"), 32);
    let version = Command::new("parallel").arg("--version").output();
    if !version.is_ok_and(|it| text(&it).contains("GNU parallel")) {
        script = script.replacen("| parallel ", "| xargs -P 2 -I{} ", 1);
        assert!(script.contains("xargs"));
    }
    is_whole(&folder, &run(&folder, &script, None), 16);
}

#[test]
fn slurm() {
    let script = block("Slurm");
    assert!(script.contains("#SBATCH --array=0-63\n"));
    shards("slurm", &script, "SLURM_ARRAY_TASK_ID", 64);
}

#[test]
fn kubernetes() {
    let job = block("Kubernetes");
    assert!(job.contains("completions: 16\n"));
    let command = job.split_once("[sh, -c, '").and_then(|(_, rest)| rest.split_once("']"));
    let (command, _) = command.expect("a command");
    let here = command.replace(" /results ", " results ").replace(" /your-", " ./your-");
    shards("kubernetes", &here, "JOB_COMPLETION_INDEX", 16);
}
