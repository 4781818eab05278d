//! `mufasa prove`: what is not here is not run, what is refuted is no success.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::kit::{Said, folder, write};
use mufasa_mutants::Engine;
use mufasa_oracle::document;
use mufasa_oracle::prove::{SOURCES, TABLE_NAME, sources, tables};
use mufasa_theorems::theorem;

fn prove(arguments: &[&str], path: Option<&str>, folder: &Path) -> Said {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    command.arg("prove").args(arguments).arg("--out").arg(folder.join("prove.json"));
    if let Some(path) = path {
        command.env("PATH", path);
    }
    Said::of(command.output().expect("the program runs"))
}

#[test]
fn without_solvers_nothing_is_proved() {
    let folder = folder("prove-without");
    let all = theorem::all().count();
    let last = format!("0 proved, 0 refuted, 0 unknown, 0 tested, {all} not run");
    prove(&["z3"], Some(""), &folder).has(0, &last, "");
    assert!(all > 50);
    let lines = std::fs::read_to_string(folder.join("prove.json")).expect("the lines");
    assert_eq!(lines.matches("\"verdict\":\"not run\"").count(), all);
}

/// Beside what the release proves, and which package brings the engine.
#[test]
fn a_summary_says_what_is_missing_of_what_was_promised() {
    let told = prove(&["z3", "--summary"], Some(""), &folder("prove-summary"));
    told.has(0, " claims that a release proves: 0 proved, ", "");
    let [missing, promised, counts] = told.out.lines().collect::<Vec<_>>()[..] else {
        panic!("three lines: {}", told.out)
    };
    assert!(missing.starts_with("z3 is missing"), "{missing}");
    assert!(promised.starts_with("asked ") && promised.ends_with(" not run"), "{promised}");
    assert!(counts.starts_with("0 proved, "), "{counts}");
}

/// A line of compiled code, as `scripts/prove-wasm` writes it.
fn compiled(verdict: &str, sources: &str) -> String {
    format!(
        "{{\"id\": \"quality_of_service::verify_latency_is_exact\", \"engine\": \"cbmc-wasm\", \"verdict\": \"{verdict}\", \"seconds\": 1.5, \
         \"sources\": \"{sources}\"}}\n"
    )
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

#[test]
fn a_refuted_harness_is_no_success() {
    let folder = folder("prove-refuted");
    let cbmc = folder.join("cbmc.json");
    let here = sources::hash(root()).expect("the sources are here");
    for (verdict, code) in [("proved", 0), ("refuted", 1), ("unknown", 1), ("perhaps", 2)] {
        std::fs::write(&cbmc, compiled(verdict, &here)).expect("the file");
        let [file, root] = [&cbmc, root()].map(|path| path.to_str().expect("a plain path"));
        prove(&["latency", "--cbmc", file, "--sources", root], None, &folder).has(code, "", "");
    }
}

#[test]
fn a_proof_of_other_sources_counts_nothing() {
    let folder = folder("prove-other");
    let cbmc = folder.join("cbmc.json");
    std::fs::write(&cbmc, compiled("proved", "0123456789abcdef")).expect("the file");
    let [file, root] = [&cbmc, root()].map(|path| path.to_str().expect("a plain path"));
    let told = prove(&["latency", "--cbmc", file, "--sources", root], None, &folder);
    told.has(0, "0 proved, 0 refuted, 0 unknown, 1 tested, 0 not run", "");
    let lines = std::fs::read_to_string(folder.join("prove.json")).expect("the lines");
    assert!(lines.contains("of other sources"), "{lines}");
}

#[test]
fn the_hash_of_the_sources_is_that_of_the_script() {
    let script = root().join("scripts/prove-wasm");
    let Ok(output) = Command::new(script).arg("--hash").output() else {
        println!("NOT RUN: no Python here");
        return;
    };
    let text = String::from_utf8(output.stdout).expect("text");
    assert_eq!(text.trim(), sources::hash(root()).expect("the sources are here"));
}

#[test]
fn the_document_has_a_row_for_every_claim() {
    let claims = mufasa_oracle::prove::claims().expect("the lists of claims");
    let table = document::read(&root().join("docs/proofs.md"), TABLE_NAME).expect("the table");
    let expected = tables::markdown(&claims);
    assert_eq!(tables::claims(&expected).len(), claims.len());
    assert_eq!(
        tables::claims(&table),
        tables::claims(&expected),
        "the table is old: cargo run --release -- prove --into docs/proofs.md"
    );
    // The README says the numbers of the table.
    let counts = table.lines().find(|line| line.contains(" proved, ")).expect("the counts");
    let number = |of: &str| {
        let before = counts.split(of).next().unwrap_or_default();
        before.rsplit([',', ':']).next().unwrap_or_default().trim().to_owned()
    };
    let readme = std::fs::read_to_string(root().join("README.md")).expect("a README");
    // Of what was proved of compiled code alone nothing is proved where `scripts/prove-wasm` was not run.
    let rows = || table.lines().filter(|row| row.starts_with("| `"));
    let is_wasm =
        |row: &&str| row.contains("-wasm | ") && row.contains(" | proved; sampling tested");
    let wasm = rows().filter(is_wasm).count();
    for said in [
        format!("Of {} claims {} are proved", claims.len(), number(" proved")),
        format!(" {} tested", number(" tested")),
        format!("{wasm} of them after `scripts/prove-wasm`"),
    ] {
        assert!(readme.contains(&said), "the README does not say: {said}");
    }
    for line in &claims {
        assert!(!line.mutants.is_empty(), "{}: nothing makes it fail", line.id);
    }
}

#[test]
fn the_document_is_of_these_sources_or_that_is_said() {
    let table = document::read(&root().join("docs/proofs.md"), TABLE_NAME).expect("the table");
    let number = table.split_once(SOURCES).and_then(|(_, rest)| rest.get(..16));
    let number = number.expect("the number of the sources below the table");
    assert!(number.chars().all(|digit| digit.is_ascii_hexdigit()), "{number}");
    if number != sources::hash_of_all(root()).expect("the sources are here") {
        println!(
            "NOT RUN: docs/proofs.md: of other sources: cargo run --release -- prove --into docs/proofs.md"
        );
    }
}

/// Runs a list of required claims.
fn require(folder: &Path, list: &str, more: &[&str], path: Option<&str>) -> Said {
    let file = write(folder, "list.txt", list);
    prove(&[&["--require", &file], more].concat(), path, folder)
}

#[test]
fn a_required_claim_without_its_engine_is_told_first() {
    let folder = folder("prove-required-missing");
    let list = "# of an engine that is not here\ns_b_grows_with_v # z3\n\n";
    let told = require(&folder, list, &[], Some(""));
    let words = "list.txt: 0 of 1 are proved\n  s_b_grows_with_v: z3 is missing\n";
    told.has(4, words, "");
    let first = "z3 is missing (claims: 1): Debian's package z3";
    assert!(told.out.starts_with(first), "{}", told.out);
    // An engine that is compiled in is never missing.
    let list = "requester::verify_an_error_is_told_as_unsafe\n";
    require(&folder, list, &[], Some("")).has(0, "list.txt: 1 of 1 are proved\n", "");
}

#[test]
fn a_required_claim_has_to_be_proved() {
    let folder = folder("prove-required-cbmc");
    let cbmc = folder.join("cbmc.json");
    let here = sources::hash(root()).expect("the sources are here");
    let id = "quality_of_service::verify_latency_is_exact";
    let [file, root] = [&cbmc, root()].map(|path| path.to_str().expect("a plain path"));
    let more = ["--cbmc", file, "--sources", root];
    let other = "0123456789abcdef";
    for (verdict, of, code) in [
        ("proved", here.as_str(), 0),
        ("refuted", &here, 1),
        ("unknown", &here, 1),
        ("proved", other, 4),
        ("refuted", other, 4),
    ] {
        std::fs::write(&cbmc, compiled(verdict, of)).expect("the file");
        let told = require(&folder, id, &more, None);
        told.has(code, "", "");
        let missing = "cbmc-wasm is missing (claims: 1): scripts/install-provers";
        assert_eq!(told.out.starts_with(missing), code == 4, "{}", told.out);
    }
}

#[test]
fn a_list_of_nothing_or_of_no_claim_is_bad_input() {
    for (list, said) in [
        ("# nothing\n", "requires nothing"),
        ("s_b_grows_with_v\ns_b_growz\n", "s_b_growz: there is no such claim"),
    ] {
        let told = require(&folder("prove-required-bad"), list, &[], Some(""));
        told.has(2, "", &format!("{said}\n"));
        assert!(told.out.is_empty(), "{}", told.out);
    }
}

/// A release needs all that the table calls proved; CI runs of these what does not need CBMC, and some that do.
#[test]
fn the_lists_of_required_claims_are_those_of_the_table() {
    let table = document::read(&root().join("docs/proofs.md"), TABLE_NAME).expect("the table");
    let ci = std::fs::read_to_string(root().join(".ci/run")).expect("what CI runs");
    let names = |list: &str| -> Vec<&str> {
        let mut lines = ci.lines().map(str::trim_start);
        let names = lines.find_map(|line| line.strip_prefix(list)?.strip_suffix(')'));
        names.expect("a list of names").split(' ').collect()
    };
    let [compiled, at_night] = ["compiled=(", "at_night=("].map(names);
    let rows = table.lines().filter_map(|row| row.strip_prefix("| `"));
    let proved = rows.filter_map(|row| {
        let (id, rest) = row.split_once('`')?;
        let by_cbmc_alone = rest.contains(" | proved; sampling tested");
        rest.contains(" | proved").then_some((id, by_cbmc_alone))
    });
    let proved: Vec<_> = proved.collect();
    let in_ci = |&(id, by_cbmc): &(&str, bool)| {
        !at_night.contains(&id) && (!by_cbmc || compiled.iter().any(|name| id.contains(name)))
    };
    let text = |head: &str, ids: &mut dyn Iterator<Item = &str>| {
        ids.fold(format!("# {head}\n"), |text, id| text + id + "\n")
    };
    for (name, expected) in [
        (
            "required.txt",
            text(
                "What a release needs proved: mufasa prove --require",
                &mut proved.iter().map(|&(id, _)| id),
            ),
        ),
        (
            "required-ci.txt",
            text(
                "What .ci/run needs proved, of required.txt",
                &mut proved.iter().filter(|it| in_ci(it)).map(|&(id, _)| id),
            ),
        ),
    ] {
        let path = root().join("proofs").join(name);
        if std::env::var_os("UPDATE_REQUIRED").is_some() {
            std::fs::write(&path, &expected).expect("the list is written");
        }
        assert_eq!(
            std::fs::read_to_string(&path).unwrap_or_default(),
            expected,
            "{name} is old: UPDATE_REQUIRED=1 cargo test -p mufasa-oracle --test it prove"
        );
    }
}

/// Before anything is run, with what may be meant.
#[test]
fn a_name_of_nothing_is_bad_input() {
    for (names, said) in [
        (&["no such name"][..], "no such name: nothing has such a name; "),
        (
            &["z3", "s_b_growz_with_v"],
            "s_b_growz_with_v: nothing has such a name; is s_b_grows_with_v meant?",
        ),
        (&["harneses"], "harneses: nothing has such a name; is harnesses meant?"),
    ] {
        let told = prove(names, Some(""), &folder("prove-none"));
        told.has(2, "", &format!("mufasa: {said}"));
        assert!(told.out.is_empty(), "{}", told.out);
    }
}

/// Whatever the table prints can be given back.
#[test]
fn names_are_taken_as_the_table_prints_them() {
    let folder = folder("prove-printed");
    for name in ["s b grows with v", "s_b_grows_with_v"] {
        let told = prove(&[name], Some(""), &folder);
        told.has(0, " 1 not run", "");
        let text = told.out;
        let row = text.lines().skip_while(|line| !line.trim_start().starts_with("id ")).nth(1);
        assert!(row.is_some_and(|row| row.contains("s b grows with v")), "{text}");
    }
}

/// What a few names give is not the whole that such a file holds.
#[test]
fn a_run_of_names_writes_where_it_is_told_only() {
    let folder = folder("prove-some");
    let run = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
        let command = command.args(["prove", "z3"]).args(more).env("PATH", "");
        let told = Said::of(command.current_dir(&folder).output().expect("the program runs"));
        assert_eq!((told.code, told.err.as_str()), (Some(0), ""));
        std::fs::read_dir(&folder).expect("a folder").count()
    };
    assert_eq!(run(&[]), 0);
    assert_eq!(run(&["--out", "z3.json"]), 1);
}

#[test]
fn a_run_of_all_says_first_where_it_writes() {
    let folder = folder("prove-all");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    let command = command.arg("prove").env("PATH", "").current_dir(&folder);
    let mut all = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it runs");
    let mut first = String::new();
    let stderr = all.stderr.take().expect("it is piped");
    let read = BufReader::new(stderr).read_line(&mut first);
    all.kill().expect("it can be ended");
    all.wait().expect("it ends");
    read.expect("there is a line");
    let said = "mufasa: writes into target/proofs/prove.json; --out names another file\n";
    assert_eq!(first, said);
}

#[test]
fn every_mutant_refutes_claims_that_there_are() {
    let claims = mufasa_oracle::prove::claims().expect("the lists of claims");
    for mutant in mufasa_mutants::all().expect("the list is read") {
        // Those are requirements.
        let claims_of = mutant.refutes.iter().filter(|(engine, _)| **engine != Engine::Monitor);
        for claim in claims_of.flat_map(|(_, claims)| claims) {
            assert!(claims.iter().any(|line| line.id == *claim), "{}: {claim}", mutant.change);
        }
    }
}
