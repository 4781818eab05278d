//! `commit X` on pages with tables that were measured: what a table depends on, and what of it changed since X.

use std::path::Path;
use std::process::Command;

/// Of each page with stamps the sources that its tables depend on.
pub const SOURCES: [(&str, &str); 10] = [
    ("docs/conformance.md", "model/src lab/conform/src examples/conformance"),
    // The other tests of props execute no code of a vehicle.
    ("docs/coverage.md", COVERED),
    ("docs/drives.md", "impl/src model/src lab/drives/src lab/sim/src"),
    ("docs/embedded.md", "impl/src capi/src benches/src benches/embedded vectors"),
    ("docs/evaluation.md", "impl/src lab/sim/src"),
    ("docs/exploration.md", EXPLORED),
    ("docs/link.md", "impl/src lab/link/src"),
    ("docs/safety-manual.md", "impl/src lab/sim/src"),
    ("docs/speed.md", "impl/src benches/src"),
    ("findings/F-52.md", "model/src scripts/nearest"),
];

const COVERED: &str = "impl capi model/src props/src props/tests/monitor props/tests/offloading \
                       props/tests/stages props/tests/vectors.rs records/src vectors";
// No stage is executed there.
const EXPLORED: &str = "model/src/monitor model/src/offloading model/src/services impl/src/offloading \
                        impl/src/services props/src/refine proofs/exploration/src";

/// What a stamp depends on besides, by words before it: random cases are drawn anew, and know no vector.
pub const BESIDES: (&str, &str) = ("The vectors: ", "vectors");

/// The commit that tables of a page are of.
pub struct Stamp<'t> {
    /// Number of its line.
    pub line: usize,
    /// Its line.
    pub text: &'t str,
    /// The commit.
    pub commit: &'t str,
    /// What the tables depend on; none: the page is not known.
    pub sources: Option<Vec<&'static str>>,
}

/// The stamps of a page, in their order.
pub fn stamps<'t>(page: &str, text: &'t str) -> Vec<Stamp<'t>> {
    let known = SOURCES.iter().find(|(of, _)| *of == page).map(|it| it.1);
    let of = |(number, text): (usize, &'t str)| {
        let commit = text.split_once("ommit ")?.1.get(..10)?;
        let besides = if text.starts_with(BESIDES.0) { BESIDES.1 } else { "" };
        let all = |it: &'static str| it.split(' ').chain(besides.split_whitespace()).collect();
        let is_commit = commit.bytes().all(|it| it.is_ascii_hexdigit());
        is_commit.then(|| Stamp { line: number + 1, text, commit, sources: known.map(all) })
    };
    text.lines().enumerate().filter_map(of).collect()
}

impl Stamp<'_> {
    /// Which sources are others now, or why nobody can know; none: they are those of today.
    pub fn old(&self, root: &Path) -> Option<String> {
        let git = |words: &[&str]| {
            let done = Command::new("git").args(words).current_dir(root).output();
            done.is_ok_and(|it| it.status.success())
        };
        if !git(&["cat-file", "-e", &format!("{}^{{commit}}", self.commit)]) {
            return Some(format!("{} is not in this clone: nobody can know", self.commit));
        }
        // The tables themselves stand in Markdown.
        let is_new = |it: &&&str| !git(&["diff", "--quiet", self.commit, "--", it, ":!*.md"]);
        let changed: Vec<&str> = self.sources.iter().flatten().filter(is_new).copied().collect();
        (!changed.is_empty()).then(|| format!("since {}: {}", self.commit, changed.join(", ")))
    }
}
