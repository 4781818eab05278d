//! What experiments left in a folder, as one page that needs nothing else: settings, tables, and links to
//! replays of runs that failed. Each experiment has a section, which the next one of its name replaces.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use mufasa_drives::pictures::escape;
use mufasa_records::files;
use mufasa_sim::experiment::checks::Checks;
use mufasa_sim::run::End;

use crate::ended::cannot;
use crate::rows::Rows;

/// The name of the page.
pub(super) const FILE: &str = "report.html";
/// The folder of replays beside it.
pub(super) const REPLAYS: &str = "replays";
/// Most runs of a section that are named.
const NAMED: usize = 200;

const HEAD: &str = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
<meta name=\"color-scheme\" content=\"light dark\">\n<title>mufasa evaluate</title>\n<style>\n\
body { font-family: 'DejaVu Sans', Verdana, Helvetica, sans-serif; font-size: 15px; line-height: 1.45; \
margin: 2em auto; max-width: 940px; padding: 0 1em; color: #1d2733; background: #fff }\n\
table { border-collapse: collapse; font-size: 13px; margin: 1em 0 }\n\
th, td { border-bottom: 1px solid #d5dbe1; padding: .25em .7em; text-align: left }\n\
th { border-bottom: 2px solid #6a7683 }\ntd.number { text-align: right; \
background: linear-gradient(to left, #cfe3f5 var(--bar, 0%), transparent 0) }\nh2 { margin-top: 2.5em }\n\
code { background: #eef1f4; padding: .1em .3em }\ndetails { margin: 1em 0 }\n\
.wide { overflow-x: auto }\n\
@media (prefers-color-scheme: dark) { body { color: #e8edf2; background: #15191e } a { color: #7db8f0 }\n\
th, td { border-color: #343c45 }\n\
td.number { background: linear-gradient(to left, #24445f var(--bar, 0%), transparent 0) } code { background: #252c33 } }\n</style>\n</head>\n<body>\n\
<h1>Experiments in a closed loop</h1>\n\
<p>A CAV drives through a town and lets a station track and plan for it, while somebody attacks. What is \
checked of what comes back: <b>sofof</b>, its age alone; <b>paper</b>, the five stages as published; \
<b>hardened</b>, with the rules H-nn. <code>docs/evaluation.md</code> of the project says what the \
experiments are, and what agrees with the paper.</p>\n";
const TAIL: &str = "</body>\n</html>\n";

/// A run that failed, and the file that shows it, if there is one.
pub(super) struct FailedRun {
    pub(super) id: String,
    pub(super) end: End,
    /// Beside the page.
    pub(super) page: Option<String>,
    /// The command that draws it.
    pub(super) command: String,
}

/// What is said of an experiment.
pub(super) struct Section<'s> {
    pub(super) name: &'s str,
    /// The command that makes it again.
    pub(super) command: String,
    /// Names and values.
    pub(super) settings: Vec<(&'static str, String)>,
    pub(super) failed: Vec<FailedRun>,
    /// What the model was asked; none: nothing is checked in this experiment.
    pub(super) checks: Option<&'s Checks>,
}

/// What an experiment leaves.
pub(super) struct Leaves<'s> {
    pub(super) table: Rows,
    /// Names of files, and their texts.
    pub(super) files: Vec<(PathBuf, String)>,
    /// Of the report; none: it has none.
    pub(super) section: Option<Section<'s>>,
}

impl Leaves<'_> {
    /// Writes all files into the folder, each there completely or not at all. What was written. Errors: in words, with
    /// the file.
    pub(super) fn write(&self, folder: Option<&Path>) -> Result<Vec<PathBuf>, String> {
        let Some(folder) = folder else { return Ok(Vec::new()) };
        let mut written = Vec::new();
        let mut wrote = |file: PathBuf, done: io::Result<()>| {
            done.map_err(cannot(&file, "written")).map(|()| written.push(file))
        };
        for (name, text) in &self.files {
            let file = folder.join(name);
            let made = file.parent().map_or(Ok(()), fs::create_dir_all);
            let done = made.and_then(|()| files::write(&file, text));
            wrote(file, done)?;
        }
        if let Some(section) = &self.section {
            let file = folder.join(FILE);
            let done = section.write(&file, &self.table);
            wrote(file, done)?;
        }
        Ok(written)
    }
}

impl Section<'_> {
    /// Puts the section into a page. Errors: the page cannot be read or written.
    fn write(&self, file: &Path, table: &Rows) -> io::Result<()> {
        let old = match fs::read_to_string(file) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(error),
        };
        files::write(file, &page(&old, self.name, &text(self, table)))
    }
}

/// The page with this section in the place of the one of its name, or as the last.
fn page(old: &str, name: &str, section: &str) -> String {
    let [begin, end] = marks(name);
    let section = format!("{begin}\n{section}{end}\n");
    let old_part = old.find(&begin).zip(old.find(&end)).filter(|(from, to)| from < to);
    let others = old.strip_suffix(TAIL).and_then(|it| it.strip_prefix(HEAD)).unwrap_or("");
    match old_part {
        Some((from, to)) if !others.is_empty() => {
            let to = to + end.len() + 1;
            format!("{}{section}{}", &old[..from], &old[to..])
        }
        _ => format!("{HEAD}{others}{section}{TAIL}"),
    }
}

fn marks(name: &str) -> [String; 2] {
    ["begin", "end"].map(|what| format!("<!-- {name}: {what} -->"))
}

fn text(section: &Section<'_>, table: &Rows) -> String {
    let mut text = format!("<h2>{}</h2>\n<p>", escape(section.name));
    for (name, value) in &section.settings {
        put(&mut text, format_args!("{}: {}. ", escape(name), escape(value)));
    }
    put(&mut text, format_args!("Again by <code>{}</code>.</p>\n", escape(&section.command)));
    if let Some(checks) = section.checks {
        put(&mut text, format_args!("<p>{}.</p>\n", escape(&checked(checks))));
        let all = checks.disagreements.iter().take(NAMED);
        for it in all {
            let line = format!("{} at {} ns: {}", it.id, it.t_ns, it.why);
            put(&mut text, format_args!("<p><b>{}</b></p>\n", escape(&line)));
        }
    }
    put(&mut text, format_args!("<div class=\"wide\">\n{}</div>\n", table.html()));
    failed(&mut text, &section.failed);
    text
}

fn failed(text: &mut String, failed: &[FailedRun]) {
    if failed.is_empty() {
        return text.push_str("<p>No run failed.</p>\n");
    }
    let count = failed.len();
    put(text, format_args!("<details>\n<summary>{count} runs that failed</summary>\n<ul>\n"));
    for run in failed.iter().take(NAMED) {
        let (id, command) = (escape(&run.id), escape(&run.command));
        let id = run
            .page
            .as_ref()
            .map_or(id.clone(), |page| format!("<a href=\"{}\">{id}</a>", escape(page)));
        let end = match run.end {
            End::Arrived => "arrived",
            End::Collided => "collided",
            End::Late => "late",
        };
        put(text, format_args!("<li>{id}: {end}; <code>{command}</code></li>\n"));
    }
    if count > NAMED {
        put(text, format_args!("<li>and {} more</li>\n", count - NAMED));
    }
    text.push_str("</ul>\n</details>\n");
}

/// What was checked, in words.
pub(super) fn checked(checks: &Checks) -> String {
    let Checks { decided, checked, disagreements } = checks;
    let ends = match disagreements.len() {
        0 if *checked == 0 => "",
        0 => "; model and implementation agree",
        _ => "; model and implementation DISAGREE",
    };
    format!("{decided} cycles decided by stages, {checked} of them checked by the model{ends}")
}

fn put(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    // A string takes whatever is written.
    let _ = text.write_fmt(arguments);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_replaces_its_own_and_leaves_the_others() {
        let one = page("", "failures", "<p>one</p>\n");
        let two = page(&one, "stages", "<p>two</p>\n");
        let again = page(&two, "failures", "<p>new</p>\n");
        assert!(again.starts_with(HEAD) && again.ends_with(TAIL), "{again}");
        assert!(!again.contains(">one<") && again.contains(">new<") && again.contains(">two<"));
        assert!(again.find(">new<") < again.find(">two<"), "in its old place");
        assert_eq!(again.matches("<h1>").count(), 1);
        assert_eq!(page(&again, "failures", "<p>new</p>\n"), again);
        // What is no such page is none of ours.
        assert_eq!(page("something else", "failures", "<p>one</p>\n"), one);
    }
}
