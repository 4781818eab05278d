//! The files of the repository as text, for tests that judge the sources. A test makes a small tree
//! of its own to show that a rule can fail.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Text files by their path from the root, with `/` between folders.
pub struct Tree(pub BTreeMap<String, String>);

/// What is read; other files are known by name alone.
const TEXT: [&str; 12] =
    ["rs", "md", "toml", "jsonl", "gitignore", "svg", "c", "py", "lock", "yaml", "yml", "run"];

impl Tree {
    /// The repository, without what is built, downloaded or hidden.
    pub fn here() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let ignored = fs::read_to_string(root.join(".gitignore")).expect("a .gitignore");
        let mut files = BTreeMap::new();
        walk(
            &root,
            "",
            &|path: &str| ignored.lines().any(|line| line == format!("/{path}")),
            &mut files,
        );
        Self(files)
    }

    /// Files of an ending, such as `.rs`.
    pub fn ending<'a>(&'a self, ending: &'a str) -> impl Iterator<Item = (&'a str, &'a str)> {
        let files = self.0.iter().filter(move |(path, _)| path.ends_with(ending));
        files.map(|(path, text)| (path.as_str(), text.as_str()))
    }
}

fn walk(
    root: &Path,
    below: &str,
    ignored: &dyn Fn(&str) -> bool,
    files: &mut BTreeMap<String, String>,
) {
    for entry in fs::read_dir(root.join(below)).expect("folders are readable") {
        let entry = entry.expect("a directory entry");
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if below.is_empty() { name.clone() } else { format!("{below}/{name}") };
        let hidden =
            name == "__pycache__" || (name.starts_with('.') && name != ".ci" && name != ".github");
        if hidden || ignored(&path) {
            continue;
        }
        if entry.file_type().expect("a type").is_dir() {
            walk(root, &path, ignored, files);
        } else {
            let kind = name.rsplit('.').next().unwrap_or_default();
            let read = || fs::read_to_string(entry.path()).expect("text is UTF-8");
            let text = if TEXT.contains(&kind) { read() } else { String::new() };
            files.insert(path, text);
        }
    }
}

/// What stands under a heading of a Markdown text.
pub struct Section<'a> {
    /// The anchor of the heading, as the usual viewers make it.
    pub anchor: String,
    /// The heading and the lines up to the next.
    pub lines: Vec<&'a str>,
}

/// The sections of a Markdown text in their order; what stands in a fenced block is no heading.
pub fn sections(text: &str) -> Vec<Section<'_>> {
    let mut fenced = false;
    let mut found: Vec<Section> = Vec::new();
    for line in text.lines() {
        fenced ^= line.starts_with("```");
        let heading = line.trim_start_matches('#').strip_prefix(' ');
        if let Some(heading) = heading.filter(|_| line.starts_with('#') && !fenced) {
            found.push(Section { anchor: slug(heading), lines: vec![line] });
        } else if let Some(section) = found.last_mut() {
            section.lines.push(line);
        }
    }
    found
}

fn slug(heading: &str) -> String {
    let kept = heading.to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[test]
fn anchors_are_those_of_markdown() {
    assert_eq!(slug("Low-level collision check (LLCC)"), "low-level-collision-check-llcc");
    assert_eq!(slug("Stage v: trajectory with grid map"), "stage-v-trajectory-with-grid-map");
}
