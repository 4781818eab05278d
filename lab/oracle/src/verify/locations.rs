//! Where in the checkout a viewer of code finds what did not pass.

use std::path::Path;
use std::process::Command;

use super::checks::Check;
use super::evidence::Case;

/// The file and line of a test; else the script or the program of tests that is called; else the row of the table.
pub(super) fn of(root: &Path, check: &Check, case: &Case) -> (String, Option<usize>) {
    let folders = folders(root, check);
    test(root, &folders, check, case)
        .or_else(|| called(root, &folders, check).map(|file| (file, None)))
        .unwrap_or_else(|| ("lab/oracle/src/verify/checks.toml".to_owned(), check.row()))
}

/// The folders of the packages that a check names.
fn folders(root: &Path, check: &Check) -> Vec<String> {
    let pairs = check.command.iter().zip(check.command.iter().skip(1));
    let names = pairs.filter(|(it, _)| *it == "-p" || *it == "--package").map(|(_, name)| name);
    let manifests = names.flat_map(|name| {
        let name = format!("name = \"{name}\"");
        grep(root, &["-lF", &name, "--", "*Cargo.toml"])
    });
    manifests.filter_map(|it| it.strip_suffix("/Cargo.toml").map(str::to_owned)).collect()
}

/// The function of a test; that of the file that its module names, if several have its name.
fn test(
    root: &Path,
    folders: &[String],
    check: &Check,
    case: &Case,
) -> Option<(String, Option<usize>)> {
    let path = case.name.split(": ").next()?;
    let (module, name) = path.rsplit_once("::").unwrap_or(("", path));
    let is_name = |it: &str| it.bytes().all(|it| it == b'_' || it.is_ascii_alphanumeric());
    if path.is_empty() || path == check.name || !is_name(name) {
        return None;
    }
    let of = format!("fn {name}(");
    let places: Vec<&str> = folders.iter().map(String::as_str).collect();
    let places = if places.is_empty() { vec!["*.rs"] } else { places };
    let found = grep(root, &[&["-nF", &of, "--"], &places[..]].concat());
    let module = module.rsplit("::").find(|it| *it != "tests").unwrap_or_default();
    let line = found.iter().find(|it| it.contains(module)).or(found.first())?;
    let (file, rest) = line.split_once(':')?;
    Some((file.to_owned(), rest.split(':').next()?.parse().ok()))
}

/// The first file that the command names, or that of the first tests.
fn called(root: &Path, folders: &[String], check: &Check) -> Option<String> {
    let mut words = check.command.iter().flat_map(|it| it.split_whitespace());
    let file = words.find(|it| it.contains('/') && root.join(it).is_file()).map(str::to_owned);
    let of_tests = || {
        let tests = check.command.iter().skip_while(|it| *it != "--test").nth(1)?;
        let folder = folders.first()?;
        let files = ["", "/main"].map(|it| format!("{folder}/tests/{tests}{it}.rs"));
        files.into_iter().find(|it| root.join(it).is_file())
    };
    file.or_else(of_tests)
}

fn grep(root: &Path, words: &[&str]) -> Vec<String> {
    let done = Command::new("git").arg("grep").args(words).current_dir(root).output();
    let said = done.map(|it| String::from_utf8_lossy(&it.stdout).into_owned()).unwrap_or_default();
    said.lines().map(str::to_owned).collect()
}
