//! Decisions of the model against decisions made otherwise: by trying everything, in integers, or
//! by the program of somebody else (`docs/exactness.md`). Thresholds are met exactly, and missed by
//! a tiny distance on either side.

mod assignments;
mod cells;
mod distances;
mod rectangles;

use std::fs;
use std::path::Path;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Reproducible numbers.
pub struct Draw(ChaCha8Rng);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// An integer from `low` to `high`.
    pub fn between(&mut self, low: i32, high: i32) -> i32 {
        self.0.random_range(low..=high)
    }
}

/// The page that argues for exactness names tests and vectors that exist.
#[test]
fn the_tests_that_the_docs_name_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let docs = fs::read_to_string(root.join("docs/exactness.md")).expect("the page");
    let mut named = 0;
    for words in docs.split('`').skip(1).step_by(2) {
        let Some((file, name)) = words.split_once("::") else { continue };
        let (line, after) = match Path::new(file).extension().and_then(|it| it.to_str()) {
            Some("rs") => (format!("fn {name}() {{"), Some("#[test]")),
            Some("jsonl") => (format!("{{\"id\": \"{name}\","), None),
            _ => continue,
        };
        let text = fs::read_to_string(root.join(file));
        let text = text.unwrap_or_else(|error| panic!("{words}: {error}"));
        let mut lines = text.lines().map(str::trim);
        let lines = lines.by_ref().skip_while(|line| after.is_some_and(|after| *line != after));
        assert!(lines.into_iter().any(|found| found.starts_with(&line)), "{words}");
        named += 1;
    }
    assert!(named > 30, "{named}");
}
