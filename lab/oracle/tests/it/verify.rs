//! `mufasa verify`: how each check ends is told as it was, and nothing looks complete that is not.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use crate::kit::{folder, said};
use crate::report::links;
use crate::schemas::{assert_valid, validators};
use mufasa_oracle::verify::checks::{self, Check};
use mufasa_oracle::verify::{self, Settings};
use roxmltree::Document;
use serde_json::Value;

/// A row of a table: what a shell runs, with the folder of the evidence as `$0`, and other fields.
fn check(name: &str, script: &str, more: &str) -> String {
    let command = format!("command = ['sh', '-c', \"\"\"{script}\"\"\", '{{out}}']");
    format!("[[check]]\nname = '{name}'\nshows = '1 < 2 & <b>'\nseconds = 1\n{command}\n{more}\n")
}

/// Passes and leaves a file.
fn good() -> String {
    let script = "echo 'test a::one ... ok'; echo 'test a::two ... ok'; echo whole >$0/left.txt";
    check("good tests", script, "writes = ['left.txt']\nquick = true")
}

fn bad() -> String {
    let script =
        "echo 'test one ... ok'; echo 'test two ... FAILED'; echo '<script>' >&2; exit 101";
    check("a bad test", script, "")
}

/// Takes long, and needs what only a command can tell.
fn long(asked: &str) -> String {
    let needs =
        format!("needs = [{{ name = 'a network', package = 'a cable', asks = ['{asked}'] }}]");
    check("long", "echo 'test one ... ok'", &format!("night = true\n{needs}"))
}

/// Its tool is not here.
fn missing() -> String {
    let needs = "needs = [{ name = 'no-such-engine', package = 'the package of engines' }]";
    check("an engine", "echo 'test one ... ok'", needs)
}

fn others() -> String {
    let claims = "for it in proved tested 'not run' unknown; do \
                  printf '{\"id\": \"%s\", \"engine\": \"z3\", \"verdict\": \"%s\"}\\\\n' \"$it\" \"$it\"; done >$0/prove.jsonl";
    let some =
        "echo 'test one ... ok'; echo 'test two ... NOT RUN: no data'; echo 'NOT RUN: no data'";
    let others = [
        check("killed", "kill -9 $$", ""),
        check("all left out", "echo 'NOT RUN: no valgrind' >&2", ""),
        check("some left out", some, ""),
        check("wrote nothing", "true", "writes = ['nothing.txt']"),
        check("claims", claims, "writes = ['prove.jsonl']"),
        "[[check]]\nname = 'no script'\nshows = ''\nseconds = 1\ncommand = ['scripts/none']\n".to_owned(),
        "[[check]]\nname = 'no test'\nshows = ''\nseconds = 1\ncommand = ['cargo', 'test', '--help']\n"
            .to_owned(),
    ];
    others.concat()
}

fn table(parts: &[String]) -> Vec<Check> {
    checks::read(&parts.concat()).expect("a table")
}

/// The exit code, and the place of what was left.
fn verify(root: &Path, parts: &[String], settings: &Settings) -> (u8, PathBuf) {
    let (stop, mut out) = (AtomicBool::new(false), Vec::new());
    let code = verify::run(&table(parts), root, settings, &stop, &mut out).expect("it is written");
    (code, root.join("target/evidence"))
}

fn text(place: &Path, name: &str) -> String {
    fs::read_to_string(place.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn evidence(place: &Path) -> Value {
    let evidence = serde_json::from_str(&text(place, "evidence.json")).expect("JSON");
    assert_valid(&validators()["evidence"], &evidence);
    evidence
}

fn release() -> Settings {
    Settings { release: true, ..Settings::default() }
}

#[test]
fn each_end_of_a_check_is_told_with_its_reason() {
    let all = [good(), bad(), missing(), others()];
    let (code, place) = verify(&folder("ends"), &all, &Settings::default());
    assert_eq!(code, 1);
    let evidence = evidence(&place);
    assert_eq!(evidence["complete"], true);
    let checks = evidence["checks"].as_array().expect("a list");
    let told = checks.iter().map(|it| {
        let [name, status] = ["name", "status"].map(|field| it[field].as_str().expect("words"));
        let reason = it["reason"].as_str().unwrap_or_default();
        (name, (status, reason, it["cases"].as_array().expect("a list").len()))
    });
    let told: BTreeMap<_, _> = told.collect();
    for (name, status, reason, cases) in [
        ("good tests", "passed", "", 2),
        ("a bad test", "failed", "two failed", 2),
        (
            "an engine",
            "not run",
            "no-such-engine is missing; it comes with the package of engines",
            0,
        ),
        ("no script", "not run", "scripts/none cannot be run: ", 0),
        ("killed", "failed", "signal: 9", 0),
        ("all left out", "not run", "no valgrind", 1),
        ("some left out", "passed", "", 2),
        ("wrote nothing", "failed", "nothing.txt was not written", 0),
        ("no test", "failed", "no test was run", 0),
        ("claims", "failed", "unknown failed", 4),
    ] {
        let (is, why, has) = told[name];
        assert_eq!((is, has), (status, cases), "{name}: {why}");
        assert!(why.starts_with(reason) && why.is_empty() == reason.is_empty(), "{name}: {why}");
    }
    assert_eq!(told.len(), checks.len());
    let claims = checks.iter().find(|it| it["name"] == "claims").expect("it is there");
    assert_eq!(claims["cases"][2]["status"], "not run");
}

#[test]
fn what_was_not_run_is_no_failure_but_in_a_release() {
    let root = folder("codes");
    let code = |parts: &[String], settings: &Settings| verify(&root, parts, settings).0;
    let usual = Settings::default();
    assert_eq!(code(&[good()], &release()), 0);
    assert_eq!(code(&[good(), missing()], &usual), 0);
    assert_eq!(code(&[good(), missing()], &release()), 4);
    assert_eq!(code(&[missing()], &usual), 4);
    assert_eq!(code(&[good(), missing(), bad()], &release()), 1);
    // A test that was left out, too, by a check that passed.
    let left_out = good().replace("test a::two ... ok", "NOT RUN: two: no data");
    assert_eq!([&usual, &release()].map(|it| code(std::slice::from_ref(&left_out), it)), [0, 4]);
    let quick = Settings { quick: true, ..Settings::default() };
    assert_eq!(code(&[good(), bad()], &quick), 0);
    let only = |name: &str| Settings { only: vec![name.to_owned()], ..Settings::default() };
    assert_eq!(code(&[good(), bad()], &only("good tests")), 0);
    assert_eq!(code(&[good(), bad()], &only("a bad test")), 1);
    let night = |release| Settings { night: true, release, ..Settings::default() };
    assert_eq!(
        [usual, release(), night(true)].map(|it| code(&[good(), long("true")], &it)),
        [0, 4, 0]
    );
    assert_eq!(code(&[good(), long("false")], &night(true)), 4);
    assert_eq!(code(&[long("true")], &night(false)), 0);
    assert_eq!(code(&[long("true")], &only("long")), 0);
}

#[test]
fn what_takes_hours_is_named_with_its_command() {
    let (_, place) = verify(&folder("night"), &[good(), long("true")], &release());
    let reason = "it takes hours; --night runs it: sh -c echo &#39;test one ... ok&#39; {out}";
    let reason = reason.replace("&#39;", "'");
    assert_eq!(evidence(&place)["checks"][1]["reason"], reason);
    assert!(text(&place, "report.html").contains("it takes hours; --night runs it: sh -c echo"));
}

#[test]
fn what_did_not_pass_is_located_where_it_is() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let out = folder("locations");
    let settings = Settings { out: Some(out.clone()), ..Settings::default() };
    let fails = |name: &str, words: &str, more: &str| {
        check(name, &format!("echo 'test {words} ... FAILED'"), "").replace("'{out}'", more)
    };
    let name = "what_did_not_pass_is_located_where_it_is";
    let tests = fails("tests", &format!("verify::{name}"), "'-p', 'mufasa-oracle'");
    let script = fails("script", "no::such_test", "'scripts/nearest'");
    let other = fails("vectors", "no::such_test", "'--test', 'vectors'");
    let of_tests = fails("its tests", "no::such_test", "'-p', 'mufasa-props', '--test', 'tidy'");
    verify(&root, &[tests, script, other, of_tests], &settings);
    let sarif: Value = serde_json::from_str(&text(&out, "results.sarif")).expect("JSON");
    let results = sarif["runs"][0]["results"].as_array().expect("a list");
    let places = results.iter().map(|it| &it["locations"][0]["physicalLocation"]);
    let places = places
        .map(|it| (it["artifactLocation"]["uri"].as_str(), it["region"]["startLine"].as_u64()));
    let line_of = |text: &str, line: &str| {
        let at = text.lines().position(|it| it == line).expect("it is there");
        Some(at as u64 + 1)
    };
    let here = line_of(include_str!("verify.rs"), &format!("fn {name}() {{"));
    let row = line_of(include_str!("../../src/verify/checks.toml"), "name = \"vectors\"");
    let expected = [
        (Some("lab/oracle/tests/it/verify.rs"), here),
        (Some("scripts/nearest"), None),
        (Some("lab/oracle/src/verify/checks.toml"), row),
        (Some("props/tests/tidy/main.rs"), None),
    ];
    assert_eq!(places.collect::<Vec<_>>(), expected);
}

#[test]
fn build_servers_get_the_same_counts() {
    let root = folder("forms");
    for (settings, failures, skipped, levels) in
        [(Settings::default(), 1, 1, ["error", "warning"]), (release(), 2, 0, ["error"; 2])]
    {
        let (_, place) = verify(&root, &[good(), bad(), missing()], &settings);
        let junit = text(&place, "junit.xml");
        let document = Document::parse(&junit).expect("XML");
        let is = |tag: &'static str| document.descendants().filter(move |it| it.has_tag_name(tag));
        let sum = |of: &str| {
            let counts = is("testsuite").map(|it| it.attribute(of).expect("a count"));
            counts.map(|it| it.parse::<usize>().expect("a number")).sum::<usize>()
        };
        let counted = [is("testcase").count(), is("failure").count(), is("skipped").count()];
        assert_eq!(counted, [5, failures, skipped], "{junit}");
        assert_eq!(["tests", "failures", "skipped"].map(sum), counted, "{junit}");
        let said = is("skipped").chain(is("failure")).filter_map(|it| it.attribute("message"));
        assert!(said.into_iter().any(|it| it.ends_with("it comes with the package of engines")));
        let sarif: Value = serde_json::from_str(&text(&place, "results.sarif")).expect("JSON");
        assert_eq!(sarif["version"], "2.1.0");
        let results = sarif["runs"][0]["results"].as_array().expect("a list");
        let told: Vec<_> = results.iter().map(|it| it["level"].as_str().expect("words")).collect();
        assert_eq!(told, levels);
        let wrong: Vec<_> = results.iter().map(|it| it["ruleId"].clone()).collect();
        assert_eq!(wrong, ["a bad test", "an engine"]);
    }
}

#[test]
fn the_page_shows_all_and_fetches_nothing() {
    let root = folder("page");
    let picture = "<svg xmlns=\"http://www.w3.org/2000/svg\"><script>1</script></svg>";
    for (file, content) in [
        (
            "docs/known-problems.md",
            "# A\n\n| id | | `x` |\n|---|---|---|\n| [F-19](../findings/F-19.md) | | a \\| <b> |\n\n| rest |\n|---|\n| F-05 |\n",
        ),
        ("docs/coverage.md", "Words.\nLines with code that tests execute: 8 of 9. The others:\n"),
        (
            "docs/speed.md",
            "Measured with: commit 0123456789, today.\n<!-- race: begin -->\n| us |\n| --: |\n| 1 |\n<!-- race: end -->\n",
        ),
        ("docs/requirements.csv", "id,text\nR-1,\"a, <b>\nc\"\n"),
        ("docs/demo.svg", picture),
        ("docs/safety-case/top.svg", picture),
    ] {
        fs::create_dir_all(root.join(file).parent().expect("a folder")).expect("it can be made");
        fs::write(root.join(file), content).expect("it can be written");
    }
    let (_, place) = verify(&root, &[good(), bad(), missing()], &release());
    let page = text(&place, "report.html");
    for needed in [
        "Failed: 1 of 3 checks",
        "1 &lt; 2 &amp; &lt;b&gt;",
        "<pre>test one ... ok",
        "&lt;script&gt;</pre>",
        "it comes with the package of engines",
        "<a href=\"../../findings/F-19.md\">F-19</a></td><td></td><td>a | &lt;b&gt;</td>",
        "<th><code>x</code></th>",
        "<td>F-05</td>",
        "<p>Lines with code that tests execute: 8 of 9.</p>",
        "<p class=\"not-run\">OLD: the sources of 1 of 1 <a",
        "docs/speed.md:1</a>: <b class=\"not-run\">OLD: 0123456789 is not in",
        "<tr><th>us</th></tr>\n<tr><td>1</td>",
        "<td>R-1</td><td>a, &lt;b&gt;; c</td>",
        "alt=\"docs/safety-case/top.svg\"",
        "<body class=\"release\">",
    ] {
        assert!(page.contains(needed), "{needed}: {page}");
    }
    let others = verify(&folder("page-others"), &[good(), others()], &release()).1;
    let left_out = "<div class=\"not-run\">no data</div>";
    assert!(text(&others, "report.html").contains(left_out));
    assert!(!page.contains("<script") && !page.contains("http:"), "{page}");
    let sources: Vec<_> = page.split(" src=\"").skip(1).collect();
    assert!(sources.len() == 2 && sources.iter().all(|it| it.starts_with("data:image/svg")));
    for link in links(&page).iter().filter(|it| !it.starts_with("../") && *it != "SHA256SUMS") {
        let is_place = link.strip_prefix('#').map(|id| page.contains(&format!("id=\"{id}\"")));
        assert!(is_place.unwrap_or_else(|| place.join(link).exists()), "{link}");
    }
}

#[test]
fn the_checksums_are_those_of_all_files() {
    let (_, place) = verify(&folder("sums"), &[good(), bad()], &Settings::default());
    let sums = text(&place, "SHA256SUMS");
    let named: BTreeSet<_> = sums.lines().filter_map(|it| it.split("  ").nth(1)).collect();
    let logs = ["log/a-bad-test.txt", "log/good-tests.txt"];
    let written = ["evidence.json", "junit.xml", "left.txt", "report.html", "results.sarif"];
    assert_eq!(named, written.into_iter().chain(logs).collect());
    let is_right = || {
        let check = ["--check", "--strict", "SHA256SUMS"];
        let summed = Command::new("sha256sum").args(check).current_dir(&place).output();
        summed.expect("coreutils").status.success()
    };
    assert!(is_right());
    fs::write(place.join("left.txt"), "changed").expect("it can be written");
    assert!(!is_right());
}

#[test]
fn an_interrupted_run_leaves_nothing_that_looks_complete_and_ends_what_it_started() {
    let root = folder("interrupted");
    let (_, place) = verify(&root, &[good()], &Settings::default());
    assert!(place.join("report.html").exists() && place.join("left.txt").exists());
    let sleeps = good()
        .replace("good tests", "sleeps")
        .replace("echo whole", "sleep 600 & echo $!; wait; echo whole");
    let (stop, mut out) = (AtomicBool::new(false), Vec::new());
    let log = place.join("log/sleeps.txt");
    let sleeper = || {
        let text = fs::read_to_string(&log).unwrap_or_default();
        text.lines().last().and_then(|it| it.parse::<u32>().ok())
    };
    let code = thread::scope(|scope| {
        let waits = || {
            while sleeper().is_none() {
                thread::sleep(Duration::from_millis(10));
            }
            stop.store(true, Ordering::Relaxed);
        };
        scope.spawn(waits);
        verify::run(&table(&[bad(), sleeps]), &root, &Settings::default(), &stop, &mut out)
    });
    assert_eq!(code.expect("it is written"), 130);
    assert!(String::from_utf8(out).expect("UTF-8").contains("INTERRUPTED"));
    for gone in ["report.html", "junit.xml", "results.sarif", "SHA256SUMS", "left.txt"] {
        assert!(!place.join(gone).exists(), "{gone}");
    }
    let evidence = evidence(&place);
    assert_eq!(evidence["complete"], false);
    assert_eq!(evidence["checks"].as_array().expect("a list").len(), 1);
    let sleeper = sleeper().expect("it ran").to_string();
    let lives = || {
        let state = fs::read_to_string(format!("/proc/{sleeper}/stat")).unwrap_or_default();
        !state.is_empty() && !state.contains(") Z ")
    };
    assert!((0..100).any(|_| {
        thread::sleep(Duration::from_millis(50));
        !lives()
    }));
}

#[test]
fn the_table_names_what_there_is() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let all = checks::all().expect("a table");
    assert_eq!(all.iter().map(|it| &it.name).collect::<BTreeSet<_>>().len(), all.len());
    assert!(all.iter().filter(|it| it.quick).map(|it| it.seconds).sum::<u64>() < 180);
    let mut cargo = Command::new("cargo");
    cargo.args(["metadata", "--no-deps", "--offline", "--format-version", "1"]).current_dir(&root);
    let manifests = cargo.output().expect("cargo").stdout;
    let manifests: Value = serde_json::from_slice(&manifests).expect("JSON");
    let packages = manifests["packages"].as_array().expect("a list");
    for check in &all {
        let command = &check.command;
        let mut named = command.iter().zip(&command[1..]).filter(|(it, _)| *it == "-p");
        let is_known = |name: &String| packages.iter().any(|it| it["name"] == **name);
        assert!(named.all(|(_, name)| is_known(name)), "{}", check.name);
        let is_there = !command[0].contains('/') || root.join(&command[0]).exists();
        assert!(is_there, "{}", check.name);
    }
}

#[test]
fn mistakes_are_said() {
    let elsewhere = Path::new("/");
    said(elsewhere, &["verify", "--quick"]).has(2, "", "is in no checkout of the project");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    said(root, &["verify", "--only", "vector"]).has(
        2,
        "",
        "vector: no such check; there are documents, vectors, ",
    );
    said(root, &["verify", "--release", "--quick"]).has(2, "", "cannot be used with");
}
