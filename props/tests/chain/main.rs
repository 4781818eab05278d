//! `docs/chain.md`: from each heading of the spec that has a requirement, each rule, interpretation
//! and symbol to its places in model, implementation, laws, theorems, harnesses, tests, vectors and
//! benches. It is made from what the sources say: headings and rules in comments, requirements of
//! vectors, claims and what refutes them. `UPDATE_CHAIN=1 cargo test -p mufasa-props --test chain`
//! writes it.

mod claims;
mod comments;
#[path = "../tree/ids.rs"]
mod ids;
#[path = "../tree/lines.rs"]
mod lines;
mod page;
mod rows;
mod symbols;
#[path = "../tree/mod.rs"]
mod tree;

use std::path::Path;
use std::sync::OnceLock;

use mufasa_model::input::profile::HardenedRule;
use rows::{Cell, Row};
use tree::Tree;

const PAGE: &str = "docs/chain.md";

const TESTED: &str = "tested only, on both sides of the threshold";

/// Cells that may be empty: start of the names of the rows, cell, and why. A reason that no row needs
/// any more fails.
const EMPTY: &[(&str, Cell, &str)] = &[
    ("spec/1-services.md", Cell::Bench, "nothing of it is computed in a cycle"),
    ("spec/1-services.md#service", Cell::Impl, PLANS),
    ("spec/1-services.md#device-switch", Cell::Impl, PLANS),
    ("spec/1-services.md#composition", Cell::Impl, PLANS),
    ("spec/1-services.md#service", Cell::Proof, RANDOM),
    ("spec/1-services.md#device-switch", Cell::Proof, RANDOM),
    ("spec/1-services.md#composition", Cell::Proof, RANDOM),
    ("spec/1-services.md#device-switch", Cell::Vector, "key `switches` of compositions"),
    ("spec/1-services.md#configuration", Cell::Vector, "every cycle of `vectors/` names one"),
    ("spec/2-offloading.md#provider", Cell::Impl, "it runs on the server"),
    ("spec/2-offloading.md#provider", Cell::Bench, "of the server, which the model plays"),
    ("spec/2-offloading.md#provider", Cell::Vector, "no record drives a provider"),
    (PROTOCOL, Cell::Model, "of requester, provider and network: `proofs/exploration`"),
    (PROTOCOL, Cell::Impl, "as of the model"),
    (PROTOCOL, Cell::Bench, "of all parts together"),
    (PROTOCOL, Cell::Vector, "a vector is one trace, they are about all"),
    (
        "spec/4-arithmetic.md#the-model-is-exact",
        Cell::Vector,
        "docs/exactness.md names a test of each",
    ),
    ("spec/5-interfaces.md#cycle", Cell::Vector, "every vector is a record"),
    ("spec/5-interfaces.md#programs-under-test", Cell::Model, "of the tools: `lab/`"),
    ("spec/5-interfaces.md#programs-under-test", Cell::Impl, "of the tools"),
    ("spec/5-interfaces.md#programs-under-test", Cell::Proof, "tested only"),
    ("spec/5-interfaces.md#programs-under-test", Cell::Vector, "of the tools"),
    ("spec/5-interfaces.md#programs-under-test", Cell::Bench, "of the tools"),
    ("spec/5-interfaces.md#vectors", Cell::Model, "of the tools: `lab/conform/src/vectors`"),
    ("spec/5-interfaces.md#vectors", Cell::Impl, "of the tools"),
    ("spec/5-interfaces.md#vectors", Cell::Proof, "tested only"),
    ("spec/5-interfaces.md#vectors", Cell::Vector, "about all of them"),
    ("spec/5-interfaces.md#vectors", Cell::Bench, "of the tools"),
    ("spec/5-interfaces.md#precheck", Cell::Model, "has no rule: it asks the stages"),
    ("spec/5-interfaces.md#precheck", Cell::Vector, "of a station: nothing that a CAV answers"),
    ("spec/6-link.md", Cell::Model, "bytes, not verdicts: `lab/link/src/message`"),
    ("spec/6-link.md", Cell::Impl, "of whoever receives messages, before the monitor"),
    ("spec/6-link.md", Cell::Proof, "tested only"),
    ("spec/6-link.md", Cell::Vector, "`lab/link/tests/codec/messages.hex` has bytes of every kind"),
    ("spec/6-link.md", Cell::Bench, "nothing of it is computed in a cycle"),
    ("spec/3-stages.md#stage-ii-trajectory-to-map", Cell::Proof, TESTED),
    ("theta_map", Cell::Proof, TESTED),
    ("miss_budget", Cell::Proof, TESTED),
    ("theta_obj", Cell::Proof, TESTED),
    ("t_yield", Cell::Proof, TESTED),
    ("a_yield", Cell::Proof, TESTED),
    ("v_max", Cell::Proof, TESTED),
    ("step_max", Cell::Proof, TESTED),
    ("lateral_tolerance", Cell::Proof, TESTED),
    ("work_limit", Cell::Proof, TESTED),
    ("I-01", Cell::Impl, "a number: nothing is computed with it"),
    ("I-01", Cell::Proof, "a number: nothing is claimed of it"),
    ("I-01", Cell::Bench, "a number: nothing is computed with it"),
    ("n", Cell::Proof, "the theorems on disks (stage v) hold for every n and do not name it"),
    ("lease", Cell::Vector, "no record drives a provider"),
];

const PLANS: &str = "the orchestrator plans before the drive, in the model's program";

const RANDOM: &str = "tested against every choice on random sets";

const PROTOCOL: &str = "spec/2-offloading.md#properties-of-the-whole-protocol";

fn rows() -> &'static [Row] {
    static ROWS: OnceLock<Vec<Row>> = OnceLock::new();
    ROWS.get_or_init(|| rows::all(&Tree::here()))
}

#[test]
fn the_page_is_what_the_sources_say() {
    let page = page::write(rows(), EMPTY);
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(PAGE);
    if std::env::var_os("UPDATE_CHAIN").is_some() {
        std::fs::write(&file, &page).expect("the page can be written");
    }
    let kept = std::fs::read_to_string(&file).expect("the page is there");
    assert!(kept == page, "{PAGE} is old: UPDATE_CHAIN=1 cargo test -p mufasa-props --test chain");
}

#[test]
fn no_link_of_the_chain_is_missing_without_a_reason() {
    let rows = rows();
    let wrong = page::missing(rows, EMPTY);
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Each heading with a requirement, each rule and each interpretation, and the symbols of the paper.
#[test]
fn every_requirement_has_a_row() {
    let rows = rows();
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    let rules = HardenedRule::ALL.map(|rule| rule.id().to_owned());
    let numbers = (1..=12).map(|n| format!("I-{n:02}")).chain(rules);
    let symbols =
        ["r", "s_follow", "s_CAV", "s_b", "s_valid", "theta_tr", "theta_map", "theta_obj", "a_b"];
    let symbols = symbols.into_iter().chain(["t_wait", "l_max", "dt_max"]).map(str::to_owned);
    for name in
        numbers.chain(symbols).chain(["spec/3-stages.md#stage-i-track-validation".to_owned()])
    {
        assert!(names.contains(&name.as_str()), "{name} has no row");
    }
    assert!(rows.len() > 60, "{}", rows.len());
}

/// A link that the sources do not support is seen to be missing, and so is a reason without need.
#[test]
fn a_missing_link_is_seen() {
    let files = [
        (
            "spec/3-stages.md",
            "# Stages\n\n## Distances\n\nPaper Sec. IV-D, eq. (3).\n\n    s_CAV = 1.8 v   (3)\n\n* **[DIST-01]** It MUST be so.\n",
        ),
        ("spec/README.md", "| `DIST` | [distances](3-stages.md#distances) |\n"),
        (
            "model/src/stages/distances.rs",
            "//! Distances (`spec/3-stages.md#distances`).\n\npub fn s_cav() {}\n",
        ),
    ];
    let tree = Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).into());
    let rows = rows::all(&tree);
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    assert_eq!(names, ["spec/3-stages.md#distances", "s_CAV"]);
    let wrong = page::missing(&rows, &[]).join("\n");
    assert!(wrong.contains("spec/3-stages.md#distances: no impl"), "{wrong}");
    assert!(!wrong.contains("no model"), "{wrong}");
    let stale = page::missing(&rows, &[("s_CAV", Cell::Bench, "why")]).join("\n");
    assert!(stale.contains("s_CAV: bench: is there"), "{stale}");
}
