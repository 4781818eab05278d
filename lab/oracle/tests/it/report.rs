//! What `mufasa evaluate` leaves for people: the report and replays.

use std::fs;
use std::path::Path;

use crate::kit::{folder, said};
use roxmltree::Document;

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
