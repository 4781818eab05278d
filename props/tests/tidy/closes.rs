//! Which rule closes which finding: the tables and the pages of rules and findings say the same. That the table of
//! rules is right `props/tests/vectors.rs` shows by vectors.

use std::collections::BTreeSet;

use super::numbers::numbers;
use super::tree::Tree;

const RULES: &str = "spec/hardened/README.md";
const FINDINGS: &str = "findings/README.md";

/// Pairs of a rule and a finding that are not in all four places.
pub fn wrong(tree: &Tree) -> Vec<(String, String)> {
    let text = |path: &str| tree.0.get(path).map_or("", |text| text);
    let rows = |path, start: &'static str| {
        text(path).lines().filter_map(move |line| line.strip_prefix(start)?.split_once(']'))
    };
    let of_rules: BTreeSet<_> = rows(RULES, "| [H-")
        .flat_map(|(rule, row)| pairs(rule, row.rsplit(" | ").next().unwrap_or_default()))
        .collect();
    let of_pages = rows(RULES, "| [H-").flat_map(|(rule, _)| {
        let page = text(&format!("spec/hardened/H-{rule}.md"));
        let closes = page.split_once("Closes").map_or("", |it| it.1);
        pairs(rule, closes.split("[Where").next().unwrap_or_default())
    });
    let of_findings = rows(FINDINGS, "| [F-").flat_map(|(finding, row)| {
        let by = numbers("H-", row.split(" | ").nth(4).unwrap_or_default());
        by.into_iter().map(|rule| (rule, finding.to_owned()))
    });
    // What is said before the evidence; a page of an open finding may name a rule that does not close it.
    let is_open = |finding: &str| of_rules.iter().all(|(_, closed)| closed != finding);
    let of_texts = rows(FINDINGS, "| [F-").filter(|(finding, _)| !is_open(finding)).flat_map(
        |(finding, _)| {
            let page = text(&format!("findings/F-{finding}.md"));
            let said = page.split_once("## Hardened").map_or("", |it| it.1);
            let by = numbers("H-", said.split("\n* ").next().unwrap_or_default());
            by.into_iter().map(|rule| (rule, finding.to_owned()))
        },
    );
    let of_texts = of_texts.collect::<BTreeSet<_>>();
    [
        ("the pages of rules", of_pages.collect::<BTreeSet<_>>()),
        (FINDINGS, of_findings.collect()),
        ("the pages of findings", of_texts),
    ]
    .into_iter()
    .flat_map(|(place, found)| {
        let differ: Vec<_> = found.symmetric_difference(&of_rules).cloned().collect();
        differ.into_iter().map(move |(h, f)| (place.to_owned(), format!("H-{h} closes F-{f}")))
    })
    .collect()
}

fn pairs(rule: &str, text: &str) -> Vec<(String, String)> {
    numbers("F-", text).into_iter().map(|finding| (rule.to_owned(), finding)).collect()
}

#[test]
fn a_rule_that_closes_something_else_in_one_place_is_seen() {
    let of = |row: &str, page: &str, finding: &str| {
        let files = [
            (RULES, format!("| [H-14](x) | r | ii | {row} |")),
            ("spec/hardened/H-14.md", format!("Closes {page}. [Where it is] F-09")),
            (FINDINGS, format!("| [F-03](x) | c | w | v | {finding} | F-07 |")),
            ("findings/F-03.md", "H-01\n## Hardened\n\nH-14: places.\n* theorem H-02\n".to_owned()),
        ];
        wrong(&Tree(files.map(|(path, text)| (path.to_owned(), text)).into()))
    };
    assert_eq!(of("F-03", "F-03", "H-14: places"), []);
    assert_eq!(of("F-03 to F-05", "F-03, F-04, F-05", "H-14").len(), 4);
    assert_eq!(of("F-03", "F-03 and F-04", "H-14").len(), 1);
    assert_eq!(of("F-03", "F-03", "H-11").len(), 2);
    assert_eq!(of("F-03", "none", "open").len(), 2);
    assert_eq!(of("F-03, F-04", "F-03, F-04", "H-14").len(), 2);
}
