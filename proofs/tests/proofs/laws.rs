//! The laws over complete finite domains; and `proofs/laws.toml` and the sources list the same. `LAW=name cargo
//! test -p mufasa-proofs --test proofs every_law_holds` asks one law.

use std::collections::BTreeSet;

use mufasa_proofs::exhaust::{TOPICS, Topic};
use toml::{Table, Value};

#[test]
fn every_law_holds_of_its_complete_domain() {
    let only = std::env::var("LAW").unwrap_or_default();
    let mut asked = 0;
    for topic in TOPICS {
        let id = |law: &str| format!("{}::{law}", topic.name);
        if !topic.laws().any(|law| id(law).contains(&only)) {
            continue;
        }
        let run = topic.run().expect("no panic");
        println!("{}: {} cases, {:?}", topic.name, run.cases, run.reached);
        assert_eq!(run.laws.keys().copied().collect::<BTreeSet<_>>(), topic.laws().collect());
        for (law, broken) in run.laws.iter().filter(|(law, _)| id(law).contains(&only)) {
            assert_eq!(*broken, None, "{law} is broken");
            asked += 1;
        }
        assert!(!only.is_empty() || run.missed().is_empty(), "never occurs: {:?}", run.missed());
    }
    assert!(asked > 0, "no law has such a name");
}

#[test]
fn every_law_has_a_statement() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/laws.toml");
    let table: Table = std::fs::read_to_string(file).expect("a file").parse().expect("TOML");
    let mut listed = Vec::new();
    for law in table["law"].as_array().expect("a list") {
        let text = |key: &str| law.get(key).and_then(Value::as_str).expect("text").to_owned();
        assert!(!text("statement").is_empty());
        listed.push(text("id"));
    }
    let ids = |topic: &Topic| -> Vec<String> {
        topic.laws().map(|law| format!("{}::{law}", topic.name)).collect()
    };
    assert_eq!(listed, TOPICS.iter().flat_map(ids).collect::<Vec<_>>());
}
