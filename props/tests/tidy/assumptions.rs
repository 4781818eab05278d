//! Assumptions of use at the lines of the code that rely on them.

use std::collections::BTreeSet;

use super::lines::{Place, lines};
use super::numbers::numbers;
use super::tree::Tree;

const PAGE: &str = "docs/safety-manual.md";

/// Items that only one of both ties to an assumption: the column "relied on by" of the page, or a comment there.
pub fn untied(tree: &Tree) -> Vec<(String, String)> {
    let page = tree.0.get(PAGE).map_or("", String::as_str);
    let rows = page.lines().filter(|line| line.starts_with("| A-"));
    let on_page = rows.flat_map(|row| {
        let cells: Vec<&str> = row.split(" | ").collect();
        let items = cells.get(2).map_or("", |it| it).split('`').skip(1).step_by(2);
        let items = items.filter(|it| it.starts_with("impl/src/"));
        items.map(|it| (cells[0]["| A-".len()..].to_owned(), it.to_owned())).collect::<Vec<_>>()
    });
    let on_page: BTreeSet<_> = on_page.collect();
    let code = tree.ending(".rs").filter(|(path, _)| path.starts_with("impl/src/"));
    let in_code = code.flat_map(|(path, text)| {
        lines(text).into_iter().flat_map(move |line| {
            let place = match line.at {
                Place::Head => path.to_owned(),
                Place::Item(name) => format!("{path}::{name}"),
            };
            numbers("A-", line.comment).into_iter().map(move |number| (number, place.clone()))
        })
    });
    let in_code: BTreeSet<_> = in_code.collect();
    let wrong = on_page.symmetric_difference(&in_code);
    wrong.map(|(number, item)| (item.clone(), format!("A-{number} there or in {PAGE}"))).collect()
}

#[test]
fn an_assumption_that_one_of_both_names_is_seen() {
    let of = |row: &str, code: &str| {
        let files = [(PAGE, row), ("impl/src/a.rs", code)];
        untied(&Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).into())).len()
    };
    let code = "fn f() {\n    // why; A-01\n    g();\n}\n";
    assert_eq!(of("| A-01 | asks | `impl/src/a.rs::f`, as `b` | 0 |", code), 0);
    assert_eq!(of("| A-01 | asks | `impl/src/a.rs` | 0 |", "//! A-01\n"), 0);
    assert_eq!(of("| A-01 | asks | no code | 0 |", code), 1);
    assert_eq!(of("| A-02 | asks | `impl/src/a.rs::f` | 0 |", code), 2);
    assert_eq!(of("| A-01 | asks | `impl/src/a.rs::f` | 0 |", "fn f() {}\n"), 1);
}
