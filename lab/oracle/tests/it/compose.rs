//! Compositions as a table; the example is the service set of the paper's Fig. 2.

use mufasa_oracle::compose::{Composed, EXAMPLE as FIG_2, composed};
use mufasa_records::{Answer, answer};

fn fig_2() -> Composed {
    composed(FIG_2).expect("the example composes")
}

/// Composes services given as (id, requires, guarantees, station).
fn of_services(goal: &str, services: &[(&str, &[&str], &[&str], i64)]) -> Composed {
    let services: Vec<String> = services
        .iter()
        .map(|(id, requires, guarantees, station)| {
            format!(
                "{{\"id\": {id:?}, \"requires\": {requires:?}, \"guarantees\": {guarantees:?}, \
                 \"station\": {station}}}"
            )
        })
        .collect();
    let services = services.join(",\n");
    composed(&format!(
        "{{\"kind\": \"composition\", \"id\": \"s\", \"goal\": {goal:?}, \"services\": [{services}]}}"
    ))
    .expect("the services compose")
}

/// The vectors say what the answer must be, `model/tests/services/figure_2.rs` why.
#[test]
fn the_example_composes_as_the_vector_of_fig_2() {
    let vectors = include_str!("../../../../vectors/services/composition.jsonl");
    let vectors = vectors.lines().map(|line| serde_json::from_str(line).expect("a vector"));
    let of_fig_2 = |it: &serde_json::Value| it["id"] == "composition-figure-2";
    let vector = vectors.into_iter().find(of_fig_2).expect("there is one");
    let answer = serde_json::to_value(fig_2().answer()).expect("JSON");
    assert_eq!(answer["compositions"], vector["expect"]["compositions"]);
}

#[test]
fn the_table_has_one_row_per_composition() {
    let table = fig_2().table();
    assert!(table.starts_with("8 compositions for actuation, 7 distributed\n"), "{table}");
    assert!(table.contains("in every one: actuation, cav-ego-motion, control\n"), "{table}");
    for row in 1..=8 {
        assert!(table.contains(&format!("\u{2502} {row} \u{2506}")), "{table}");
    }
    assert!(!table.contains("\u{2502} 9 "), "{table}");
    assert!(table.contains("mec-tpl \u{2192} control"), "{table}");
}

#[test]
fn the_table_says_what_is_chosen_when_the_members_do_not() {
    // Both serve `top` and `left` in turn, so that two compositions have the same members.
    let all = of_services(
        "top",
        &[
            ("top", &["a", "b"], &[], 0),
            ("left", &[], &["a", "b"], 0),
            ("right", &[], &["a", "b"], 0),
            ("spare", &[], &["c"], 0),
        ],
    );
    let table = all.table();
    assert!(table.starts_with("4 compositions for top, 0 distributed\n"), "{table}");
    for chosen in ["a of top: left", "a of top: right", "b of top: left", "b of top: right"] {
        assert_eq!(table.matches(chosen).count(), 2, "{table}");
    }
    assert!(table.contains("in none: spare\n"), "{table}");
}

#[test]
fn without_a_composition_the_table_says_why() {
    let nobody = of_services("top", &[("top", &["a"], &[], 0)]);
    assert_eq!(nobody.table(), "no composition for top: nobody guarantees a, which top requires\n");
    let round = of_services("top", &[("top", &["a"], &["a"], 0)]);
    assert_eq!(round.table(), "no composition for top: the rule acyclic stands in the way\n");
}

#[test]
fn a_composition_is_answered_as_the_line_protocol_answers_it() {
    let line = FIG_2.replace('\n', " ");
    assert_eq!(answer(line.as_bytes(), 1), Answer::Composition(fig_2().answer()));
}

#[test]
fn a_file_that_is_no_composition_is_an_error_with_its_line() {
    let broken = FIG_2.replace("\"goal\": \"actuation\",", "\"goal\": actuation,");
    let error = composed(&broken).err().expect("no JSON");
    let line = FIG_2.lines().position(|line| line.contains("\"goal\"")).expect("there") + 1;
    assert_eq!((error.line, error.field.as_str()), (line, ""));
    let trace = r#"{"kind": "offloading", "id": "o", "events": []}"#;
    assert_eq!(composed(trace).err().expect("a trace").field, "kind");
    let goal = FIG_2.replace("\"goal\": \"actuation\"", "\"goal\": \"brake\"");
    let error = composed(&goal).err().expect("no such service");
    assert_eq!((error.field.as_str(), error.id.as_deref()), ("goal", Some("paper-fig-2")));
    assert!(error.to_string().contains("brake"));
}

/// Layers of services, each of which requires something of all in the next: 400 of one, and 40 of
/// two, through which there are 2^40 ways.
#[test]
fn long_chains_are_composed() {
    for (layers, width) in [(400, 1), (40, 2)] {
        let interfaces = |layer: usize| (0..width).map(move |at| format!("i{layer}-{at}"));
        let ids: Vec<Vec<String>> = (0..=layers).map(|layer| interfaces(layer).collect()).collect();
        let ids: Vec<Vec<&str>> =
            ids.iter().map(|layer| layer.iter().map(String::as_str).collect()).collect();
        let mut services: Vec<(&str, &[&str], &[&str], i64)> = vec![("goal", &ids[0], &[], 0)];
        for layer in 0..layers {
            let requires = if layer + 1 < layers { &ids[layer + 1][..] } else { &[] };
            let provides = ids[layer].iter().map(std::slice::from_ref);
            services.extend(provides.map(|id| (id[0], requires, id, 0)));
        }
        let compositions = of_services("goal", &services).answer().compositions;
        let links: Vec<_> = compositions.iter().map(|it| it.links.len()).collect();
        assert_eq!(links, [width + (layers - 1) * width * width]);
    }
}
