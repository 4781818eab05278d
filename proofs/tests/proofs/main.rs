//! `proofs/expected.toml`, the source of the harnesses and the list of them say the same.

mod expected;
mod harness;
mod source;

use std::collections::{BTreeMap, BTreeSet};

use mufasa_proofs::harness::ALL;

#[test]
fn file_and_source_list_the_same_harnesses() {
    let (written, covers) = source::written();
    let expected = expected::expected();
    assert!(written.len() > 20);
    let listed: Vec<&str> = ALL.iter().map(|(id, _)| *id).collect();
    assert_eq!(written.iter().map(|one| one.id.as_str()).collect::<Vec<_>>(), listed);
    assert_eq!(expected.iter().map(|one| one.id.as_str()).collect::<Vec<_>>(), listed);
    for (written, expected) in written.iter().zip(&expected) {
        let id = &written.id;
        assert!(!written.not_covered.is_empty(), "{id}: the doc does not say what is not covered");
        assert_eq!(written.statement, expected.statement, "{id}");
        assert_eq!(written.domain, expected.domain, "{id}");
        assert_eq!(written.not_covered, expected.not_covered, "{id}");
        assert_eq!(written.kani, expected.shard.is_some(), "{id}: Kani takes what has a shard");
        assert_eq!(written.unwind, expected.unwind.map(|most| most.to_string()), "{id}");
        assert_eq!(written.solver, expected.solver, "{id}");
        assert!(!expected.covers.is_empty(), "{id}");
    }
    let mut named: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for one in expected {
        let (module, _) = one.id.split_once("::").expect("a path");
        named.entry(module.to_owned()).or_default().extend(one.covers);
    }
    assert_eq!(named, covers, "covers of the file and of the source");
}

#[test]
fn every_entry_says_whether_cbmc_proves_it() {
    for one in expected::expected() {
        let is_known = ["quick", "slow", "no"].contains(&one.cbmc.as_str());
        assert!(is_known, "{}: cbmc is {}", one.id, one.cbmc);
        let has_reason = one.cbmc_reason.is_some();
        assert_eq!(one.cbmc == "no", has_reason, "{}: a reason for `no` alone", one.id);
        assert!(["every", "some"].contains(&one.stand_in.as_str()), "{}", one.id);
        let has_shard = one.shard.is_none_or(|shard| (1..=2).contains(&shard));
        assert!(has_shard, "{}: the workflow has shards 1 and 2", one.id);
        // Under Kani nothing answers instead of these parts, and a bound that CBMC needs is not there: it needs its own.
        let is_compiled_only = !one.arbitrary.is_empty() || one.cbmc_unwind.is_some();
        let is_bounded = one.shard.is_none() || one.unwind.is_some();
        assert!(!is_compiled_only || is_bounded, "{}: nothing is known of Kani", one.id);
    }
}

/// The workflow of Kani has the shards of the file, and asks as `mufasa verify` does.
#[test]
fn the_workflow_asks_for_the_shards_of_the_file() {
    let workflow = include_str!("../../../.github/workflows/kani.yml");
    let shards: BTreeSet<i64> = expected::expected().iter().filter_map(|one| one.shard).collect();
    let listed = workflow.lines().find_map(|line| line.trim().strip_prefix("shard: "));
    assert_eq!(listed, Some(format!("{:?}", Vec::from_iter(shards)).as_str()));
    let (_, behind) = workflow.split_once("args: >-").expect("arguments");
    let (asked, _) = behind.split_once("${{ steps.shard.outputs.harnesses }}").expect("harnesses");
    let checks = include_str!("../../../lab/oracle/src/verify/checks.toml");
    let start = "command = [\"cargo\", \"kani\", ";
    let call = checks.lines().find_map(|line| line.strip_prefix(start)).expect("a check by Kani");
    let call = call.replace(['"', ',', ']'], "");
    assert_eq!(asked.split_whitespace().collect::<Vec<_>>().join(" "), call);
}

/// The rows of the document are about the harnesses of the file, each once an engine of compiled code,
/// exhaustion or sampling.
#[test]
fn the_document_names_the_harnesses_of_the_file() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/proofs.md");
    let page = std::fs::read_to_string(path).expect("docs/proofs.md");
    let names = page.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next());
    let named: BTreeSet<&str> = names.filter(|name| name.contains("::verify_")).collect();
    let expected = expected::expected();
    let listed: BTreeSet<&str> = expected.iter().map(|one| one.id.as_str()).collect();
    assert!(listed.len() > 20);
    assert_eq!(
        named, listed,
        "the table is old: cargo run --release -- prove --into docs/proofs.md"
    );
}
