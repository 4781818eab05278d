//! What `mufasa evaluate` leaves for people: the report, replays and logs.

use std::fs;
use std::path::Path;

use crate::kit::{folder, said};
use mcap::{MessageStream, Schema};
use roxmltree::Document;
use serde_json::Value;

fn done(folder: &Path, code: i32, arguments: &[&str]) -> String {
    let told = said(folder, arguments);
    told.has(code, "", "");
    told.out
}

fn text(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The links of a page. It is XML but for its doctype and its meta elements: so every tag is closed in its order.
pub fn links(page: &str) -> Vec<String> {
    let page = page.strip_prefix("<!DOCTYPE html>\n").expect("a doctype");
    let closed = |line: &str| match line.strip_suffix('>') {
        Some(meta) if line.starts_with("<meta ") => format!("{meta}/>"),
        _ => line.to_owned(),
    };
    let page = page.lines().map(closed).collect::<Vec<_>>().join("\n");
    let document = Document::parse(&page).unwrap_or_else(|error| panic!("{error}\n{page}"));
    document.descendants().filter_map(|it| it.attribute("href")).map(str::to_owned).collect()
}

const SMALL: [&str; 6] = ["--scenarios", "1", "--vehicles", "8", "--out", "results"];

#[test]
fn a_folder_has_one_page_with_a_section_of_each_experiment() {
    let folder = folder("page");
    let evaluate = |experiment: &str| {
        let told = said(&folder, &[&["evaluate", experiment], &SMALL[..]].concat());
        assert!(matches!(told.code, Some(0 | 1)), "{}", told.err);
        // Under the table stands what its names mean.
        let legend = told.out.lines().any(|line| line.starts_with("sofof checks the age alone"));
        assert_eq!(legend, told.out.contains("sofof"), "{}", told.out);
        legend
    };
    assert!(evaluate("failures"));
    let one = text(&folder, "results/report.html");
    evaluate("stages");
    evaluate("failures");
    let page = text(&folder, "results/report.html");
    assert!(page.starts_with(one.strip_suffix("</body>\n</html>\n").expect("an end")));
    assert_eq!(page.matches("<h2>").count(), 2);
    assert!(page.matches("--bar:").count() > 10);
    for needed in
        ["checked by the model; model and implementation agree", "seed: 0.", "<th>attack</th>"]
    {
        assert!(page.contains(needed), "{needed}");
    }
    // Nothing is fetched.
    assert!(!page.contains("http") && !page.contains("<script") && !page.contains("NaN"));
    // Runs that failed are linked, and their pages are there.
    let links = links(&page);
    assert!(links.len() >= 3, "{links:?}");
    for link in links {
        let replay = text(&folder, &format!("results/{link}"));
        assert!(replay.contains("Collided") || replay.contains("Not there in time"), "{link}");
    }
}

#[test]
fn all_cycles_are_checked_where_that_is_asked_for() {
    let folder = folder("checked");
    let ask = |more: &[&str]| {
        let only = [
            "evaluate",
            "failures",
            "--only",
            "failures/hardened/ghost-tracks",
            "--scenarios",
            "1",
        ];
        let said = done(&folder, 0, &[&only[..], more].concat());
        let line =
            said.lines().find(|it| it.contains("checked by the model")).expect("a line").to_owned();
        let numbers = line.split_whitespace().filter_map(|it| it.parse::<u64>().ok());
        <[u64; 2]>::try_from(numbers.collect::<Vec<_>>()).expect("two numbers")
    };
    let [decided, checked] = ask(&[]);
    assert!((decided / 100 - 2..=decided / 100 + 2).contains(&checked), "{decided} {checked}");
    assert_eq!(ask(&["--check-all"]), [decided, decided]);
}

/// `check` reads the cycles of a log as it reads them as lines, and answers the same.
#[test]
fn a_run_as_a_log_is_read_back() {
    let folder = folder("log");
    let replay =
        ["evaluate", "replay", "--attack", "wrong-map", "--variant", "hardened", "--scenario", "0"];
    done(&folder, 0, &[&replay[..], &["--out", "run.html", "--mcap", "run.mcap"]].concat());
    let bytes = fs::read(folder.join("run.mcap")).expect("a log");
    let mut counts = std::collections::BTreeMap::new();
    let (mut lines, mut verdicts) = (String::new(), Vec::new());
    for message in MessageStream::new(&bytes).expect("a log") {
        let message = message.expect("a message");
        let Schema { name, encoding, data, .. } = &**message.channel.schema.as_ref().expect("one");
        assert_eq!(
            (encoding.as_str(), message.channel.message_encoding.as_str()),
            ("jsonschema", "json")
        );
        let value: Value = serde_json::from_slice(&message.data).expect("JSON");
        // Foxglove follows no references.
        let schema: Value = serde_json::from_slice(data).expect("JSON");
        assert!(!schema.to_string().contains("$ref"));
        jsonschema::validate(&schema, &value).unwrap_or_else(|error| panic!("{name}: {error}"));
        if name == "mufasa.Cycle" {
            lines += std::str::from_utf8(&message.data).expect("UTF-8");
            lines.push('\n');
        } else if name == "mufasa.Verdict" {
            let stage = value["failed_stage"].as_str().expect("a text").to_owned();
            verdicts.push((value["verdict"].as_str().expect("a text").to_owned(), stage));
        }
        *counts.entry(message.channel.topic.clone()).or_insert(0) += 1;
    }
    let topics = ["/actions", "/believed", "/cycle", "/ego", "/objects", "/verdict"];
    assert_eq!(counts.keys().map(String::as_str).collect::<Vec<_>>(), topics);
    assert!(counts.values().all(|count| *count == verdicts.len() && *count > 100), "{counts:?}");
    fs::write(folder.join("run.jsonl"), lines).expect("lines");
    let [log, lines] = ["run.mcap", "run.jsonl"].map(|file| {
        let told = said(&folder, &["check", "--json", file]);
        (told.code, told.out.replace(file, "FILE"))
    });
    assert_eq!(log, lines);
    // And the answers are those of the run.
    let cycles = log.1.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
    let cycles = cycles.filter(|it| it["kind"] == "checked_cycle");
    let answers = cycles.map(|it| {
        let of = |name: &str| it["implementation"][name].as_str().unwrap_or_default().to_owned();
        (of("verdict"), of("failed_stage"))
    });
    assert_eq!(answers.collect::<Vec<_>>(), verdicts);
    assert!(verdicts.iter().any(|it| it.0 == "unsafe") && verdicts.iter().any(|it| it.0 == "safe"));
}

#[test]
fn a_run_is_drawn_by_its_id() {
    let folder = folder("id");
    let id = "failures/sofof/empty-tracks/0/0";
    let replay = ["evaluate", "replay", "--run", id, "--vehicles", "8"];
    let file = "failures-sofof-empty-tracks-0-0.html";
    let note = format!("writes into {file}; --out names another file");
    said(&folder, &replay).has(0, &format!("{id}: "), &note);
    assert!(text(&folder, file).contains(id));
    for wrong in ["failures/sofof/empty-tracks/0/99", "nothing", "failures/sofof"] {
        said(&folder, &["evaluate", "replay", "--run", wrong]).has(2, "", "no run of");
    }
}

/// A run of F-45: it is late, and no stage asks for that.
#[test]
fn a_run_that_fails_in_the_hardened_profile_is_the_exit_code_of_any_experiment() {
    let folder = folder("code");
    let only = |id| ["evaluate", "attacks", "--without-precheck", "--only", id];
    done(&folder, 1, &["evaluate", "scenes", "-q", "--scenes", "200"]);
    done(&folder, 0, &["evaluate", "scenes", "-q", "--scenes", "200", "--profile", "paper"]);
    done(&folder, 0, &only("attacks/hardened/into-lead/plan/1/1"));
    done(&folder, 0, &only("attacks/sofof/into-lead/plan/1/0"));
}
