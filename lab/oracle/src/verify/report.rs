//! The evidence as one page that needs nothing else.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use mufasa_drives::pictures::escape;
use serde_json::Value;

use super::documents;
use super::evidence::{Case, Evidence, Outcome, Status};
use super::figures::Record;
use super::run::Place;
use crate::rows::{Rows, number, text};

const STYLE: &str = include_str!("report.css");
/// Most lines of a log that a page shows.
const SHOWN: usize = 30;
const PROBLEMS: &str = "docs/known-problems.md";
/// What lies beside the page.
const BESIDE: [(&str, &str); 4] = [
    ("evidence.json", "all of this for programs"),
    ("junit.xml", "for build servers"),
    ("results.sarif", "what did not pass, for viewers of code"),
    ("SHA256SUMS", "checksums of all that lies here: sha256sum -c SHA256SUMS"),
];
/// Where the rest is, from the root of the checkout.
const REST: [(&str, &str); 10] = [
    ("README.md", "what this is, and its limits"),
    ("spec/README.md", "the normative text"),
    ("docs/safety-manual.md", "what the integrator has to do"),
    ("docs/hazards.md", "failure modes and triggering conditions"),
    ("docs/assumptions.md", "assumptions of use"),
    ("docs/chain.md", "from the paper to code, tests and proofs"),
    ("docs/proofs.md", "each claim with its domain"),
    ("findings/README.md", "all findings"),
    ("docs/tools.md", "what a fault of a tool could hide"),
    ("SECURITY.md", "threats, and how to report one"),
];

/// The page. What a document of the checkout says is shown as far as it is there.
pub(super) fn page(evidence: &Evidence, place: &Place<'_>) -> String {
    let root = place.root;
    let up = place.out.strip_prefix(root).ok().map(|it| "../".repeat(it.components().count()));
    let up = up.as_deref();
    let record = Record::new(root, up);
    let problems = fs::read_to_string(root.join(PROBLEMS)).unwrap_or_default();
    let sections = [
        ("checks", "Checks", checks(evidence, place)),
        ("proofs", "Proofs", proofs(&place.out)),
        ("safety-case", "Safety case", documents::pictures(root, "docs/safety-case")),
        ("requirements", "Traceability", documents::matrix(root, "docs/requirements.csv")),
        ("strength", "Strength of the tests", record.strength()),
        (
            "findings",
            "Open findings, and rests of closed ones",
            documents::tables(&problems, PROBLEMS, up, 9),
        ),
        ("figures", "Figures", record.figures()),
        ("versions", "Versions", versions(evidence)),
        ("rest", "Where the rest is", rest(up)),
    ];
    let link = |(id, name, _): &(&str, &str, String)| format!("<a href=\"#{id}\">{name}</a>\n");
    let links: String = sections.iter().map(link).collect();
    let section = |(id, name, text): &(&str, &str, String)| {
        let text = if text.is_empty() {
            "<p>Nothing of it is in this checkout, or was run.</p>\n"
        } else {
            text.as_str()
        };
        format!("<section>\n<h2 id=\"{id}\">{name}</h2>\n{text}</section>\n")
    };
    let sections: String = sections.iter().map(section).collect();
    let kind = if evidence.is_release() { "release" } else { "run" };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>mufasa verify</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body class=\"{kind}\">\n{}<nav>\n{links}</nav>\n\
         {sections}</body>\n</html>\n",
        verdict(evidence, &record.old())
    )
}

fn class(status: Status) -> &'static str {
    match status {
        Status::Passed => "passed",
        Status::NotRun => "not-run",
        Status::Failed => "failed",
    }
}

fn verdict(evidence: &Evidence, old: &str) -> String {
    let all = evidence.checks.len();
    let words = match evidence.worst() {
        Status::Failed => format!("Failed: {} of {all} checks", evidence.count(Status::Failed)),
        Status::NotRun if evidence.is_release() => String::from("No release: not all was run"),
        Status::NotRun => String::from("Whatever was run passed, but not all was run"),
        Status::Passed => format!("Passed: all {all} checks"),
    };
    let count = |status: Status| {
        let tests: usize = evidence.checks.iter().map(|it| it.count(status)).sum();
        let (checks, class, name) = (evidence.count(status), class(status), status.name());
        format!("<li class=\"{class}\"><b>{checks}</b> {name}; tests and claims: {tests}</li>\n")
    };
    let counts = Status::ALL.map(count).concat();
    let began = evidence.versions.get("began, UTC").and_then(Option::as_deref).unwrap_or("?");
    let [asked, commit, began] = [evidence.asked, evidence.commit.as_str(), began].map(escape);
    format!(
        "<h1>mufasa verify</h1>\n<p class=\"verdict {}\">{words}</p>\n<ul class=\"counts\">\n{counts}</ul>\n{old}\
         <p>Commit <code>{commit}</code>, {began} UTC; asked for: {asked}.</p>\n",
        class(evidence.worst())
    )
}

fn checks(evidence: &Evidence, place: &Place<'_>) -> String {
    let most = evidence.checks.iter().map(|it| it.taken).fold(1.0, f64::max);
    let row = |outcome: &Outcome| {
        let Outcome { check, status, reason, taken, .. } = outcome;
        let [name, shows] = [&check.name, &check.shows].map(|it| escape(it));
        let left_out = outcome.cases.iter().filter(|it| it.status == Status::NotRun);
        let left_out: Vec<_> = left_out.map(|it| it.name.as_str()).collect();
        let (why, how) = match reason {
            Some(reason) => (escape(reason), class(*status)),
            None => (escape(&left_out.join("; ")), class(Status::NotRun)),
        };
        let (class, said, share) = (class(*status), status.name(), 100.0 * taken / most);
        let time = if *taken > 0.0 { format!("{taken:.1} s") } else { String::new() };
        format!(
            "<tr><td><b>{name}</b></td><td class=\"status {class}\">{said}</td>\
             <td class=\"number\" style=\"--share:{share:.0}%\">{time}</td>\
             <td class=\"long\">{shows}<div class=\"{how}\">{why}</div>\n{}</td></tr>\n",
            details(outcome, place)
        )
    };
    let rows: String = evidence.checks.iter().map(row).collect();
    format!(
        "<table class=\"checks\">\n<thead><tr><th>check</th><th>verdict</th><th>time</th>\
         <th>what it shows if it passed</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n"
    )
}

/// The tests of a check, those first that did not pass, and the end of its log if it failed.
fn details(outcome: &Outcome, place: &Place<'_>) -> String {
    let log = outcome.check.log();
    let Ok(said) = fs::read(place.out.join(&log)) else { return String::new() };
    let has_failed = outcome.status == Status::Failed;
    let said = String::from_utf8_lossy(&said);
    let lines: Vec<_> = said.lines().filter(|_| has_failed).map(escape).collect();
    let end = lines[lines.len().saturating_sub(SHOWN)..].join("\n");
    let end = if end.is_empty() { end } else { format!("<pre>{end}</pre>\n") };
    let mut cases: Vec<&Case> = outcome.cases.iter().collect();
    cases.sort_by_key(|case| Reverse(case.status));
    let item = |case: &&Case| {
        let reason = case.reason.as_deref().unwrap_or_default();
        let (class, said) = (class(case.status), case.status.name());
        let [name, reason] = [case.name.as_str(), reason].map(escape);
        format!("<li>{name}: <span class=\"status {class}\">{said}</span> {reason}</li>\n")
    };
    let items: String = cases.iter().map(item).collect();
    let counts = Status::ALL.map(|it| (outcome.count(it), it.name()));
    let counts = counts.into_iter().filter(|(count, _)| *count > 0);
    let counts: Vec<_> = counts.map(|(count, name)| format!("{count} {name}")).collect();
    let counts = if counts.is_empty() { String::from("log") } else { counts.join(", ") };
    let (open, log) = (if has_failed { " open=\"open\"" } else { "" }, escape(&log));
    format!(
        "<details{open}>\n<summary>{counts}</summary>\n<p><code>{}</code>; <a href=\"{log}\">{log}</a></p>\n\
         {end}<ul>\n{items}</ul>\n</details>\n",
        escape(&outcome.check.command.join(" "))
    )
}

/// The claims by engine and verdict, as `mufasa prove` left them.
fn proofs(folder: &Path) -> String {
    let lines = fs::read_to_string(folder.join("prove.jsonl")).unwrap_or_default();
    let mut counts = BTreeMap::<_, usize>::new();
    for line in lines.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok()) {
        let said = ["verdict", "engine"].map(|it| line[it].as_str().unwrap_or("?").to_owned());
        *counts.entry(said).or_default() += 1;
    }
    let rows: Vec<_> = counts.into_iter().collect();
    let table = Rows::new(
        &rows,
        &[
            text("verdict", |([verdict, _], _)| verdict.clone()),
            text("engine", |([_, engine], _)| engine.clone()),
            number("claims", |(_, count)| count.to_string()),
        ],
    );
    if rows.is_empty() { String::new() } else { table.html().replace("--bar:", "--share:") }
}

fn versions(evidence: &Evidence) -> String {
    let row = |(tool, version): (&&str, &Option<String>)| {
        let version = version.as_deref().unwrap_or("not here");
        format!("<tr><td>{}</td><td>{}</td></tr>\n", escape(tool), escape(version))
    };
    let rows: String = evidence.versions.iter().map(row).collect();
    format!("<table>\n{rows}</table>\n")
}

fn rest(up: Option<&str>) -> String {
    let item = |file: &str, what: &str, up| {
        format!("<li>{}: {what}</li>\n", documents::link(file, file, up))
    };
    let beside = BESIDE.map(|(file, what)| item(file, what, Some(""))).concat();
    format!("<ul>\n{beside}{}</ul>\n", REST.map(|(file, what)| item(file, what, up)).concat())
}
