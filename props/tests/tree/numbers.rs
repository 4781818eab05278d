//! Numbers of rules and findings, as texts list them.

use std::collections::BTreeSet;

/// The numbers of two digits behind a mark; `F-03 to F-05` are three.
pub fn numbers(mark: &str, text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut last = None;
    let mut parts = text.split(mark);
    let mut before = parts.next().unwrap_or_default();
    for part in parts {
        let Some(number) = part.get(..2).and_then(|it| it.parse::<u32>().ok()) else { continue };
        let from = last.filter(|_| before.ends_with(" to ")).unwrap_or(number);
        found.extend((from..=number).map(|it| format!("{it:02}")));
        (last, before) = (Some(number), part);
    }
    found
}
