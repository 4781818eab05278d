//! Compositions as a table and as a graph; the example is the service set of the paper's Fig. 2.

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

/// Its arrows are those of the figure: `model/tests/services/figure_2.rs`.
#[test]
fn the_graph_of_fig_2_has_every_service_and_knows_device_switches() {
    let graph = fig_2().graph();
    assert_eq!((graph.nodes.len(), graph.edges.len()), (13, 17));
    assert_eq!(graph.nodes[0].id, "actuation");
    for edge in &graph.edges {
        let [from, to] = [edge.provider, edge.consumer].map(|node| graph.nodes[node].station);
        assert_eq!(edge.switch, from != to);
    }
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
    assert_eq!((round.graph().nodes.len(), round.graph().edges.len()), (1, 0));
}

/// Two compositions may need a service above and below another: the union has a cycle.
#[test]
fn compositions_that_form_a_cycle_together_can_be_drawn() {
    let both = of_services(
        "goal",
        &[
            ("goal", &["x", "y"], &[], 0),
            ("a", &["u"], &["x", "v"], 0),
            ("b", &["v"], &["y", "u"], 1),
            ("sensor", &[], &["u", "v"], 0),
        ],
    );
    assert!(both.answer().compositions.len() > 1);
    let graph = both.graph();
    let id = |node: usize| graph.nodes[node].id.as_str();
    let has = |from: &str, to: &str| {
        graph.edges.iter().any(|edge| (id(edge.provider), id(edge.consumer)) == (from, to))
    };
    assert!(has("a", "b") && has("b", "a"));
    let dot = both.dot();
    for (from, to, interface) in [("b", "a", "u"), ("a", "b", "v")] {
        let place = |of| graph.nodes.iter().position(|node| node.id == of).expect("a node");
        let link = format!("n{} -> n{} [label=\"{interface}\"", place(from), place(to));
        assert!(dot.contains(&link), "{link}: {dot}");
    }
}

#[test]
fn names_that_graphviz_cannot_hold_are_escaped() {
    let odd = of_services(
        "<goal> & \"co\"",
        &[("<goal> & \"co\"", &["a\\b"], &[], 0), ("tab\tand \u{e9}\u{1f697}", &[], &["a\\b"], 9)],
    );
    let dot = odd.dot();
    assert!(dot.contains("label=\"tab\u{fffd}and \u{e9}\u{1f697}\""), "{dot}");
    assert!(dot.contains(r#"label="<goal> & \"co\"""#), "{dot}");
    assert!(dot.contains(r#"n1 -> n0 [label="a\\b", style=dashed];"#), "{dot}");
}

#[test]
fn the_dot_file_has_every_service_and_every_link() {
    let dot = fig_2().dot();
    assert!(dot.starts_with("digraph services {\n  rankdir=BT;\n") && dot.ends_with("}\n"));
    assert_eq!(dot.matches("fillcolor").count(), 13);
    assert_eq!(dot.matches(" -> ").count(), 17);
    assert_eq!(dot.matches("style=dashed").count(), 6);
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
