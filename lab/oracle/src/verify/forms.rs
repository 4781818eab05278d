//! The same for build servers: JUnit and SARIF.

use std::path::Path;

use mufasa_conform::xml_text;
use serde_json::{Value, json};

use super::evidence::{Case, Evidence, Outcome, Status};
use super::locations;

/// JUnit XML: a suite for each check. What was not run is skipped, in a release a failure.
pub(super) fn junit(evidence: &Evidence) -> String {
    let suites: Vec<_> =
        evidence.checks.iter().map(|it| suite(it, evidence.is_release())).collect();
    let [tests, failures, skipped] =
        [0, 1, 2].map(|which| suites.iter().map(|(_, counts)| counts[which]).sum::<usize>());
    let suites: String = suites.into_iter().map(|(text, _)| text).collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"mufasa verify\" \
         tests=\"{tests}\" failures=\"{failures}\" skipped=\"{skipped}\">\n{suites}</testsuites>\n"
    )
}

/// The suite of a check, and how many tests, failures and skipped tests it has.
fn suite(outcome: &Outcome, is_release: bool) -> (String, [usize; 3]) {
    let suite = xml_text(&outcome.check.name);
    let (mut failures, mut skipped) = (0, 0);
    let test = |case: Case| {
        let (name, kind) = (xml_text(&case.name), case.status.name());
        let why = xml_text(case.reason.as_deref().unwrap_or_default());
        let end = match case.status {
            Status::Passed => String::new(),
            Status::NotRun if !is_release => {
                skipped += 1;
                format!("<skipped message=\"{why}\"/>")
            }
            Status::NotRun | Status::Failed => {
                failures += 1;
                format!("<failure type=\"{kind}\" message=\"{why}\"/>")
            }
        };
        format!("<testcase classname=\"{suite}\" name=\"{name}\">{end}</testcase>\n")
    };
    let tests: Vec<_> = outcome.entries().into_iter().map(test).collect();
    let (count, time) = (tests.len(), outcome.taken);
    let text = format!(
        "<testsuite name=\"{suite}\" tests=\"{count}\" failures=\"{failures}\" errors=\"0\" skipped=\"{skipped}\" \
         time=\"{time:.1}\">\n{}</testsuite>\n",
        tests.concat()
    );
    (text, [count, failures, skipped])
}

/// SARIF 2.1.0: a result for whatever did not pass.
pub(super) fn sarif(evidence: &Evidence, root: &Path) -> Value {
    let rule =
        |it: &Outcome| json!({"id": it.check.name, "shortDescription": {"text": it.check.shows}});
    let results = evidence.checks.iter().flat_map(|outcome| {
        let wrong = outcome.entries().into_iter().filter(|case| case.status != Status::Passed);
        wrong.map(|case| {
            let (file, line) = locations::of(root, &outcome.check, &case);
            let mut place = json!({"artifactLocation": {"uri": file}});
            if let Some(line) = line {
                place["region"] = json!({"startLine": line});
            }
            let is_error = case.status == Status::Failed || evidence.is_release();
            let reason = case.reason.unwrap_or_default();
            json!({
                "ruleId": outcome.check.name,
                "level": if is_error { "error" } else { "warning" },
                "message": {"text": format!("{}: {}: {reason}", case.name, case.status.name())},
                "locations": [{"physicalLocation": place}],
            })
        })
    });
    let rules: Vec<_> = evidence.checks.iter().map(rule).collect();
    let tool =
        json!({"name": "mufasa verify", "version": env!("CARGO_PKG_VERSION"), "rules": rules});
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{"tool": {"driver": tool}, "results": results.collect::<Vec<_>>()}],
    })
}
