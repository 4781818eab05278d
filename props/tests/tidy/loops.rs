//! Vehicle loops that users copy, in examples and in the pages beside them.

use super::tree::Tree;

/// How each loop writes its period of so many milliseconds.
const PERIODS: [(&str, [&str; 2]); 6] = [
    ("impl/examples/vehicle.rs", ["Duration::from_millis(", ")"]),
    ("impl/src/lib.rs", ["Duration::from_millis(", ")"]),
    ("capi/examples/vehicle.c", ["#define PERIOD_MS ", "\n"]),
    ("capi/README.md", ["mufasa_monitor_settings_default(", "000000)"]),
    ("lab/python/examples/vehicle.py", ["timedelta(milliseconds=", ")"]),
    ("lab/python/README.md", ["timedelta(milliseconds=", ")"]),
];
/// How each writes its dt_max of so many milliseconds.
const DT_MAX: [(&str, [&str; 2]); 6] = [
    ("impl/examples/vehicle.rs", ["dt_max_ns = ", "_000_000;"]),
    ("impl/src/lib.rs", ["dt_max_ns = ", "_000_000;"]),
    ("capi/examples/vehicle.c", ["dt_max_ns = ", " * MS;"]),
    ("capi/README.md", ["dt_max_ns = ", "000000;"]),
    ("lab/python/examples/vehicle.py", ["\"dt_max_ns\": ", "_000_000"]),
    ("lab/python/README.md", ["\"dt_max_ns\": ", "_000_000"]),
];
const DT_MAX_ADVICE: (&str, [&str; 2]) =
    ("docs/configuration.md", ["two periods and the largest jitter, ", " ms say"]);
const ADVICE: (&str, [&str; 2]) =
    ("docs/configuration.md", ["| period of the cycle and of the results | ", " ms |"]);
/// What a page says of a loop, whoever writes it anew.
const SAID: [(&str, &str); 4] = [
    ("capi/README.md", "take(&decision.actions);"),
    ("lab/python/README.md", "take(decision.actions)"),
    ("impl/README.md", "`docs/assumptions.md`"),
    ("impl/README.md", "`docs/configuration.md`"),
];

/// Loops with another period, or another dt_max, than the documents advise.
pub fn periods(tree: &Tree) -> Vec<(String, String)> {
    let mut wrong = Vec::new();
    for ((page, marks), loops) in [(ADVICE, PERIODS), (DT_MAX_ADVICE, DT_MAX)] {
        let advised = between(tree, page, marks);
        for (path, marks) in loops {
            let own = between(tree, path, marks);
            if own.is_none() || own != advised {
                wrong.push((path.to_owned(), format!("{own:?} ms, advised {advised:?}")));
            }
        }
    }
    wrong
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
    change("capi/README.md", "dt_max_ns = 120", "dt_max_ns = 100");
    assert_eq!(named(periods(&tree)), ["capi/examples/vehicle.c", "capi/README.md"]);
    assert_eq!(left_out(&tree).len(), 2);
    assert_eq!(named(left_out(&tree)), ["capi/README.md"; 2]);
}
