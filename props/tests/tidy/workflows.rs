//! What the workflows call: CONTRIBUTING names it, and what `.ci/run` leaves to the night is called there.

use std::collections::BTreeSet;

use super::tree::Tree;

const NIGHT: &str = ".github/workflows/nightly.yml";
const PAGE: &str = "CONTRIBUTING.md";
const RUN: &str = ".ci/run";

/// What the page does not name, what the night does not call, and a workflow that does not call what is called by hand.
pub fn wrong(tree: &Tree) -> Vec<(String, String)> {
    let text = |path: &str| tree.0.get(path).map_or("", String::as_str);
    let (night, page) = (called(text(NIGHT)), text(PAGE));
    let is_named = |it: &str| ["`", " "].iter().any(|end| page.contains(&format!("`{it}{end}")));
    let unnamed = night.iter().filter(|it| !is_named(it));
    let unnamed = unnamed.map(|it| (PAGE, format!("does not name `{it}`")));
    let left = text(RUN).split("at night (").skip(1).filter_map(|it| it.split([')', ' ']).next());
    let left = left.filter(|it| !night.contains(*it));
    let left = left.map(|it| (NIGHT, format!("does not call `{it}`, which {RUN} leaves to it")));
    let lacks_run = !called(text(".github/workflows/ci.yml")).contains(RUN);
    let lacks_run = lacks_run.then(|| (RUN, "is not called by ci.yml".to_owned()));
    let found = unnamed.chain(left).chain(lacks_run);
    found.map(|(place, what)| (place.to_owned(), what)).collect()
}

/// Scripts, and the subcommands of `mufasa`, without their arguments.
fn called(workflow: &str) -> BTreeSet<String> {
    let places = ["scripts/", "examples/", ".ci/"];
    let scripts = workflow.split_whitespace();
    let scripts = scripts.filter(|word| places.iter().any(|it| word.starts_with(it)));
    let programs =
        workflow.lines().filter_map(|line| line.split_once("cargo run ")?.1.split_once(" -- "));
    let subcommand = |(_, words): (&str, &str)| {
        let words =
            words.split(' ').take_while(|it| it.starts_with(|c: char| c.is_ascii_lowercase()));
        format!("mufasa {}", words.take(2).collect::<Vec<_>>().join(" "))
    };
    scripts.map(str::to_owned).chain(programs.map(subcommand)).collect()
}

#[test]
fn a_command_that_nobody_names_is_seen() {
    let of = |night: &str, run: &str, page: &str| {
        let files = [
            (NIGHT, night),
            (RUN, run),
            (PAGE, page),
            (".github/workflows/ci.yml", "bash .ci/run"),
        ];
        let tree = Tree(files.map(|(path, text)| (path.to_owned(), text.to_owned())).into());
        wrong(&tree).into_iter().map(|it| it.1).collect::<Vec<_>>()
    };
    let night = "run: scripts/fuzz 600 && cargo run -r -- evaluate falsify --seed 1";
    let run = "not_run \"fuzzing: at night (scripts/fuzz 600)\"";
    assert_eq!(of(night, run, "`scripts/fuzz 600` and `mufasa evaluate falsify`"), [""; 0]);
    assert_eq!(of(night, run, "`scripts/fuzz`"), ["does not name `mufasa evaluate falsify`"]);
    let left = "does not call `scripts/fuzz`, which .ci/run leaves to it";
    assert_eq!(of("", run, ""), [left]);
    assert_eq!(wrong(&Tree([].into())).len(), 1, "no ci.yml");
}
