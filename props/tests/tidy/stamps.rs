//! `commit X` on pages with tables that were measured: that X had no changes, and what changed since.

use std::path::Path;
use std::process::Command;

use super::tree::Tree;

/// Of each page with stamps the sources that its tables depend on.
const SOURCES: [(&str, &str); 7] = [
    ("docs/configuration.md", "impl/src benches/src"),
    ("docs/conformance.md", "model/src lab/conform/src examples/conformance"),
    // The other tests of props execute no code of a vehicle.
    ("docs/coverage.md", COVERED),
    ("docs/drives.md", "impl/src lab/drives/src lab/sim/src"),
    ("docs/embedded.md", "impl/src capi/src benches/src"),
    ("docs/link.md", "impl/src lab/link/src"),
    ("docs/speed.md", "impl/src benches/src"),
];

const COVERED: &str = "impl capi model/src props/src props/tests/monitor props/tests/offloading \
                       props/tests/stages props/tests/vectors.rs records/src vectors";

/// What a stamp depends on besides, by words before it: random cases are drawn anew, and know no vector.
const BESIDES: (&str, &str) = ("The vectors: ", "vectors");

/// Page and line of each stamp, its commit, and whether the sources were changed then.
fn stamps(tree: &Tree) -> Vec<(String, &str, bool)> {
    let pages = tree.ending(".md").flat_map(|(page, text)| {
        text.lines().enumerate().filter_map(move |(number, line)| {
            let (commit, rest) = line.split_once("ommit ")?.1.split_at_checked(10)?;
            let has_changes = rest.starts_with(" with changes");
            let besides = if line.starts_with(BESIDES.0) { BESIDES.1 } else { "" };
            let is_commit = commit.bytes().all(|it| it.is_ascii_hexdigit());
            is_commit.then(|| (format!("{page}:{} {besides}", number + 1), commit, has_changes))
        })
    });
    pages.collect()
}

fn sources(place: &str) -> Option<&'static str> {
    let page = place.split(':').next();
    SOURCES.iter().find(|(of, _)| Some(*of) == page).map(|it| it.1)
}

/// Stamps of no commit, or of a page whose sources are not known; pages without a stamp.
pub fn wrong(tree: &Tree) -> Vec<(String, String)> {
    let found = stamps(tree);
    let mut wrong = Vec::new();
    for (place, commit, has_changes) in &found {
        let page = || place.split(':').next().unwrap_or_default().to_owned();
        if *has_changes {
            wrong.push(((*commit).to_owned(), format!("{place}: with changes, measure it again")));
        }
        if sources(place).is_none() {
            wrong.push((page(), format!("{place}: SOURCES does not say of what")));
        }
    }
    if tree.0.get("docs/conformance.md").is_some_and(|it| !it.contains(BESIDES.0)) {
        wrong.push((BESIDES.0.to_owned(), "no stamp depends on vectors".to_owned()));
    }
    let is_there = |page: &str| found.iter().any(|it| it.0.starts_with(&format!("{page}:")));
    let none = SOURCES.iter().filter(|(page, _)| !is_there(page));
    wrong.extend(none.map(|(page, _)| ((*page).to_owned(), "has no stamp any more".to_owned())));
    wrong
}

/// Of each stamp whose sources are others now what changed, or why nobody can know.
pub fn old(tree: &Tree, root: &Path) -> Vec<String> {
    let git = |words: &[&str]| Command::new("git").args(words).current_dir(root).output();
    let of = |(place, commit, _): (String, &str, bool)| {
        let is_known = git(&["cat-file", "-e", &format!("{commit}^{{commit}}")]);
        if !is_known.is_ok_and(|it| it.status.success()) {
            return Some(format!("{place}: {commit} is not in this clone: nobody can know"));
        }
        let is_new = |it: &&str| {
            // The tables themselves stand in Markdown.
            let sources = ["diff", "--quiet", commit, "--", it, ":!*.md"];
            git(&sources).is_ok_and(|it| !it.status.success())
        };
        let (place, besides) = place.split_once(' ')?;
        let all = sources(place)?.split(' ').chain(besides.split_whitespace());
        let changed: Vec<&str> = all.filter(is_new).collect();
        (!changed.is_empty()).then(|| format!("{place}: since {commit}: {}", changed.join(", ")))
    };
    stamps(tree).into_iter().filter_map(of).collect()
}

#[test]
fn a_stamp_that_says_too_little_is_seen() {
    let of = |text: &str, page: &str| {
        let pages = SOURCES
            .map(|(it, _)| (it.to_owned(), "The vectors: commit 0123456789, rustc\n".to_owned()));
        let more = [(page.to_owned(), text.to_owned())];
        Tree(pages.into_iter().chain(more).collect())
    };
    let page = SOURCES[0].0;
    let changed = of("Measured with: commit 0123456789 with changes, rustc", page);
    assert_eq!((wrong(&changed).len(), stamps(&changed)[0].1), (1, "0123456789"));
    assert_eq!(wrong(&of("It may commit everything.", page)).len(), 1, "no stamp");
    assert_eq!(wrong(&of("Commit 0123456789.", "docs/b.md")).len(), 1, "no sources");
    assert_eq!(wrong(&of("commit 0123456789", "docs/conformance.md")).len(), 1, "no vectors");
    let tree = of("1 (commit 0123456789)", page);
    assert_eq!(wrong(&tree), []);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    assert!(old(&tree, root).iter().all(|it| it.ends_with("nobody can know")), "no such commit");
}
