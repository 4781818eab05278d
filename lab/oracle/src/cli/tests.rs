//! What the command line takes.

use std::collections::BTreeSet;

use super::*;
use crate::schemas;
use mufasa_drives::Options;

#[test]
fn the_arguments_are_consistent() {
    command().debug_assert();
}

/// Command and option of all that says in its help that it writes JSON.
fn writes_json(command: &clap::Command, path: &str, found: &mut BTreeSet<(String, String)>) {
    let says = |help: Option<&clap::builder::StyledStr>, words: &[&str]| {
        let help = help.map(ToString::to_string).unwrap_or_default();
        words.iter().any(|it| help.contains(it))
    };
    let mut note = |option: &str| {
        found.insert((path.to_owned(), option.to_owned()));
    };
    if says(command.get_about(), &["JSON Lines of standard input"]) {
        note("");
    }
    let options = command.get_arguments().filter(|it| !it.is_positional());
    options
        .filter(|it| says(it.get_help(), &["as JSON", "and JSON", "Write JSON", "(JSON)"]))
        .for_each(|it| note(it.get_id().as_str()));
    for inner in command.get_subcommands() {
        writes_json(inner, format!("{path} {}", inner.get_name()).trim(), found);
    }
}

#[test]
fn all_that_is_written_as_json_has_a_schema() {
    let mut found = BTreeSet::new();
    writes_json(&command(), "", &mut found);
    let known = schemas::WRITTEN.map(|(command, option, _)| (command.into(), option.into()));
    assert_eq!(found, BTreeSet::from(known));
    let schemas: Vec<_> = schemas::all().into_iter().map(|(name, _)| name).collect();
    for name in schemas::WRITTEN.iter().flat_map(|(_, _, names)| *names) {
        assert!(schemas.contains(name), "{name}");
    }
}

#[test]
fn defaults_of_the_command_line_are_those_of_the_readers() {
    let cli = Cli::try_parse_from(["mufasa", "check", "x"]).unwrap();
    let Some(Command::Check(arguments)) = cli.command else { panic!("not check") };
    assert_eq!(arguments.options(), Options::default());
}
