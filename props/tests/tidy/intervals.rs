//! Rates of known problems: the interval beside a count is that of Wilson, 95 %. The table, for programs.

use serde_json::{Value, json};

use super::tree::Tree;

const PAGE: &str = "docs/known-problems.md";

/// Rates, `A of B, x % (y % to z %)`, that the counts do not give; that there are none.
pub fn wrong(tree: &Tree) -> Vec<(String, String)> {
    let page = tree.0.get(PAGE).map_or("", |text| text);
    let places = rates(page);
    let is_wrong = |at: &&usize| !is_right(&page[..**at], &page[**at + " % (".len()..]);
    let line = |at: &usize| page[..*at].lines().next_back().unwrap_or_default().to_owned();
    let mut wrong: Vec<String> = places.iter().filter(is_wrong).map(line).collect();
    if places.is_empty() {
        wrong.push("no rate".to_owned());
    }
    wrong.into_iter().map(|what| (PAGE.to_owned(), what)).collect()
}

/// The rows of the page for programs: of a rate the counts and the first command.
pub fn for_programs(tree: &Tree) -> String {
    let page = tree.0.get(PAGE).map_or("", |text| text);
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches(['|', ' ']).split(" | ").collect();
        let [id, problem, severity, rate, work_around, since] = cells[..] else { panic!("{line}") };
        let counts = rates(rate).into_iter().filter_map(|at| counts(&rate[..at]));
        let counts: Vec<Value> =
            counts.map(|(hits, n, _)| json!({"hits": hits, "count": n})).collect();
        json!({
            "id": id[1..].split(']').next(), "problem": problem, "severity": severity, "rates": counts,
            "command": rate.split('`').nth(1), "since": since,
            "work_around": Some(work_around).filter(|it| *it != "none"),
        })
    };
    let rows: Vec<Value> = page.lines().filter(|it| it.starts_with("| [F-")).map(row).collect();
    serde_json::to_string_pretty(&rows).expect("JSON") + "\n"
}

/// Where rates are.
fn rates(text: &str) -> Vec<usize> {
    text.match_indices(" % (").map(|(at, _)| at).collect()
}

/// Of `A of B, x` the three.
fn counts(before: &str) -> Option<(u32, u32, &str)> {
    let mut words = before.rsplit(' ');
    let [x, all, of, hits] = [(); 4].map(|()| words.next().unwrap_or_default());
    let count = |text: &str| text.replace(',', "").parse().ok();
    (of == "of").then_some((count(hits)?, count(all)?, x))
}

/// Whether `A of B, x` and `y % to z %` fit together.
fn is_right(before: &str, after: &str) -> bool {
    let mut after = after.split(' ');
    let [y, _, to, z] = [(); 4].map(|()| after.next().unwrap_or_default());
    let (Some((hits, n, x)), "to") = (counts(before), to) else { return false };
    let [hits, n] = [hits, n].map(f64::from);
    let (p, zz) = (hits / n, 1.959_964 * 1.959_964);
    let centre = p + zz / (2.0 * n);
    let half = (zz * (p * (1.0 - p) / n + zz / (4.0 * n * n))).sqrt();
    let bound = |part: f64| 100.0 * part / (1.0 + zz / n);
    [(x, 100.0 * p), (y, bound(centre - half)), (z, bound(centre + half))].iter().all(
        |(text, value)| {
            let digits = text.split_once('.').map_or(0, |(_, digits)| digits.len());
            format!("{:.digits$}", value.abs()) == *text
        },
    )
}

#[test]
fn a_rate_that_the_counts_do_not_give_is_seen() {
    let of = |page: &str| wrong(&Tree([(PAGE.to_owned(), page.to_owned())].into())).len();
    assert_eq!(of("98 of 20,000, 0.49 % (0.40 % to 0.60 %); 0 of 800, 0 % (0 % to 0.5 %)"), 0);
    for page in [
        "97 of 20,000, 0.49 % (0.40 % to 0.60 %)",
        "98 of 20,000, 0.48 % (0.40 % to 0.60 %)",
        "98 of 20,000, 0.49 % (0.39 % to 0.60 %)",
        "98 of 20,000, 0.49 % (0.40 % to 0.61 %)",
        "0.49 % (0.40 % to 0.60 %)",
        "none",
    ] {
        assert_eq!(of(page), 1, "{page}");
    }
}
