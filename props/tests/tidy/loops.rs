//! Vehicle loops that users copy, in examples and in the pages beside them.

use super::tree::Tree;

/// How each loop writes its period of so many milliseconds.
const LOOPS: [(&str, [&str; 2]); 6] = [
    ("impl/examples/vehicle.rs", ["Duration::from_millis(", ")"]),
    ("impl/src/lib.rs", ["Duration::from_millis(", ")"]),
    ("capi/examples/vehicle.c", ["#define PERIOD_MS ", "\n"]),
    ("capi/README.md", ["settings_default(", "000000)"]),
    ("lab/python/examples/vehicle.py", ["timedelta(milliseconds=", ")"]),
    ("lab/python/README.md", ["timedelta(milliseconds=", ")"]),
];
const ADVICE: (&str, [&str; 2]) =
    ("docs/configuration.md", ["| period of the cycle and of the results | ", " ms |"]);
/// What a page says of a loop, whoever writes it anew.
const SAID: [(&str, &str); 4] = [
    ("capi/README.md", "take(&decision.actions);"),
    ("lab/python/README.md", "take(decision.actions)"),
    ("impl/README.md", "`docs/assumptions.md`"),
    ("impl/README.md", "`docs/configuration.md`"),
];

/// Loops with another period than the documents advise.
pub fn periods(tree: &Tree) -> Vec<(String, String)> {
    let advised = between(tree, ADVICE.0, ADVICE.1);
    let found = LOOPS.into_iter().filter_map(|(path, of_loop)| {
        let own = between(tree, path, of_loop);
        let is_wrong = own.is_none() || own != advised;
        is_wrong.then(|| (path.to_owned(), format!("{own:?} ms, advised {advised:?}")))
    });
    found.collect()
}

/// Pages that leave out what must not be left out of a loop, and statuses that nobody looks at.
pub fn left_out(tree: &Tree) -> Vec<(String, String)> {
    let text = |path: &str| tree.0.get(path).map_or("", String::as_str);
    let missing = SAID.into_iter().filter(|(path, words)| !text(path).contains(words));
    let mut wrong: Vec<_> =
        missing.map(|(path, words)| (path.to_owned(), format!("`{words}` is missing"))).collect();
    for line in text("capi/README.md").lines() {
        if line.trim_start().starts_with("status = mufasa_") {
            wrong.push(("capi/README.md".to_owned(), format!("nobody looks at it: {line}")));
        }
    }
    wrong
}

fn between<'a>(tree: &'a Tree, path: &str, [before, behind]: [&str; 2]) -> Option<&'a str> {
    let (_, rest) = tree.0.get(path)?.split_once(before)?;
    Some(rest.split_once(behind)?.0)
}

#[test]
fn another_period_and_what_is_left_out_are_seen() {
    let mut tree = Tree::here();
    let mut change = |path: &str, from: &str, to: &str| {
        let text = tree.0.get_mut(path).unwrap();
        assert!(text.contains(from), "{path}: {from}");
        *text = text.replacen(from, to, 1);
    };
    change("capi/examples/vehicle.c", "PERIOD_MS 50", "PERIOD_MS 100");
    change("capi/README.md", "take(&decision.actions);", "status = mufasa_monitor_cycle();");
    let named = |found: Vec<(String, String)>| found.into_iter().map(|it| it.0).collect::<Vec<_>>();
    change("capi/README.md", "settings_default(50", "settings_default(40");
    assert_eq!(named(periods(&tree)), ["capi/examples/vehicle.c", "capi/README.md"]);
    assert_eq!(left_out(&tree).len(), 2);
    assert_eq!(named(left_out(&tree)), ["capi/README.md"; 2]);
}
