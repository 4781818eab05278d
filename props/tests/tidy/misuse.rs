//! The tables of misuse: each names tests that there are, or the duty that is left.

use super::tree::Tree;

const PAGE: &str = "docs/misuse.md";

/// Rows that name no test that there is, or none although they are not silent, and a wrong count.
pub fn wrong(tree: &Tree) -> Vec<(String, String)> {
    let page = tree.0.get(PAGE).map_or("", |text| text);
    let rows: Vec<Vec<&str>> = page
        .lines()
        .filter_map(|line| line.strip_prefix("| ")?.strip_suffix('|'))
        .map(|row| row.split(" |").map(str::trim).collect())
        .filter(|row: &Vec<&str>| row.first() != Some(&"slip"))
        .collect();
    let is_there = |name: &str| {
        let heads = ["fn ", "static void ", "def "].map(|head| format!("{head}{name}("));
        tree.0.iter().any(|(path, text)| {
            path.contains("/tests/") && heads.iter().any(|head| text.contains(head))
        })
    };
    let (mut wrong, mut silent) = (Vec::new(), 0);
    for row in &rows {
        let &[slip, what, tests, ..] = &row[..] else {
            wrong.push((PAGE.to_owned(), format!("not three cells: {row:?}")));
            continue;
        };
        silent += usize::from(what.starts_with("silent"));
        let is_duty = what.starts_with("silent: A-");
        let names: Vec<&str> = tests.split('`').skip(1).step_by(2).collect();
        if names.is_empty() && !is_duty || !names.iter().all(|name| is_there(name)) {
            wrong.push((PAGE.to_owned(), format!("{slip}: no such test: {tests}")));
        }
    }
    let count = format!("Of {} slips {silent} are silent.", rows.len());
    if !page.contains(&count) {
        wrong.push((PAGE.to_owned(), count));
    }
    wrong
}

#[test]
fn slips_are_not_taken_off_the_page_and_no_more_of_them_are_silent() {
    let tree = Tree::here();
    let said = tree.0[PAGE].lines().find(|it| it.ends_with("are silent."));
    let numbers: Vec<u32> =
        said.unwrap_or_default().split(' ').filter_map(|it| it.parse().ok()).collect();
    assert!(matches!(numbers[..], [73..=u32::MAX, 0..=19]), "{numbers:?}");
}

#[test]
fn rows_without_a_test_and_wrong_counts_are_seen() {
    let of = |row: &str, count: &str| {
        let page = format!("{count}\n| slip | what happens | test |\n|---|---|---|\n{row}\n");
        let tests = "#[test]\nfn it_is_seen() {}\n";
        let files = [(PAGE, page.as_str()), ("a/tests/b.rs", tests)];
        wrong(&Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).into())).len()
    };
    let (told, none) = ("Of 1 slips 0 are silent.", "Of 1 slips 1 are silent.");
    assert_eq!(of("| a | refused | `it_is_seen` |", told), 0);
    assert_eq!(of("| a | silent: A-01 | |", none), 0);
    assert_eq!(of("| a | silent: A-01 | |", told), 1);
    assert_eq!(of("| a | refused | `it_is_gone` |", told), 1);
    assert_eq!(of("| a | refused | |", told), 1);
    assert_eq!(of("| a | silent | |", none), 1);
}
