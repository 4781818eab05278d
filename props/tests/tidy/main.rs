//! Rules about the sources that a test can keep. Each is a function from a tree of files to what it
//! finds wrong there; here it is asked of the repository, and in its own file of a small tree that
//! breaks it. Exceptions stand here, each with its reason; one that is not needed any more fails.

mod assumptions;
mod circles;
mod closes;
mod counts;
mod decisions;
mod evidence;
mod failure_modes;
#[path = "../tree/hash.rs"]
mod hash;
mod intervals;
mod length;
mod lifted;
#[expect(dead_code, reason = "of it items and comments are asked for alone")]
#[path = "../tree/lines.rs"]
mod lines;
mod links;
mod loops;
mod misuse;
mod must;
mod names;
#[path = "../tree/numbers.rs"]
mod numbers;
mod packages;
mod safety_case;
mod stamps;
mod style;
#[path = "../tree/mod.rs"]
mod tree;
mod workflows;

use std::io::Write as _;
use std::path::Path;

use tree::Tree;

/// What a rule lets pass, and why.
type Exceptions = [(&'static str, &'static str)];

/// Long files.
const LONG: &Exceptions = &[];

/// Modules of one package that know each other, by a module of the circle.
const CIRCLES: &Exceptions = &[];

/// Modules that only one of model and implementation has.
const UNEQUAL: &Exceptions = &[
    ("impl/src/input/detection_index", "saves time; no verdict depends on it"),
    ("impl/src/input/indexes", "saves time; no verdict depends on it"),
    ("impl/src/stages/order", "a function for the proofs to ask; the model asks in stages/mod"),
    ("impl/src/input/route_index", "saves time; no verdict depends on it"),
    (
        "model/src/input/scene",
        "the cycle in exact numbers; impl computes with the doubles of the record",
    ),
    ("impl/src/input/scratch", "memory that the caller lends; the model allocates"),
    ("model/src/offloading/provider", "runs on the server; a vehicle needs none"),
    ("model/src/services/composition", "of the orchestrator; a vehicle needs none"),
    ("model/src/services/orchestrator", "plans before the drive; a vehicle needs none"),
    ("model/src/services/service", "of the orchestrator; a vehicle needs none"),
];

/// Files that documents name and that are not in the repository.
const ELSEWHERE: &Exceptions = &[("exploration/exploration.json", "`mufasa explore` writes it")];

/// Functions called like their module.
const TWICE: &Exceptions =
    &[("model/src/stages/llcc.rs", "the paper's name of the check, which is this function")];

/// Fails with everything that was found, and with the exceptions that nothing needed.
fn judge(found: &[(String, String)], exceptions: &Exceptions) {
    let mut wrong = Vec::new();
    for (place, what) in found {
        if !exceptions.iter().any(|(name, _)| name == place) {
            wrong.push(format!("{place}: {what}"));
        }
    }
    for (name, reason) in exceptions {
        if !found.iter().any(|(place, _)| place == name) {
            wrong.push(format!("{name}: is no exception any more, strike it out ({reason})"));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// A file that does not fit into the head is read by nobody.
#[test]
fn no_file_of_rust_has_more_than_400_lines() {
    judge(&length::too_long(&Tree::here(), 400), LONG);
}

/// Who has to know a circle has to know all of it at once.
#[test]
fn no_modules_of_a_package_know_each_other_in_a_circle() {
    judge(&circles::of_modules(&Tree::here()), CIRCLES);
}

/// What a rule changes it changes from outside.
#[test]
fn no_stage_knows_a_rule() {
    judge(&circles::stages_that_know_rules(&Tree::here()), &[]);
}

/// As above; tests count, since they too have to be built and read.
#[test]
fn no_packages_depend_on_each_other_in_a_circle() {
    judge(&packages::circles(&Tree::here()), &[]);
}

/// What is certified can be read without the laboratory.
#[test]
fn no_package_outside_of_lab_needs_one_in_it() {
    judge(&packages::need_the_laboratory(&Tree::here()), &[]);
}

/// A version means something where its changes are named.
#[test]
fn the_changelog_begins_with_the_version() {
    judge(&packages::changes_of_another_version(&Tree::here()), &[]);
}

/// A workflow that nobody names is run by nobody by hand.
#[test]
fn the_workflows_call_what_is_named_and_what_is_left_to_the_night() {
    judge(&workflows::wrong(&Tree::here()), &[]);
}

/// What is told of misuse is tested.
#[test]
fn each_row_of_the_tables_of_misuse_has_its_test() {
    judge(&misuse::wrong(&Tree::here()), &[]);
}

/// The table is what a newcomer reads first.
#[test]
fn the_architecture_names_the_packages_with_their_dependencies() {
    judge(&packages::table_is_wrong(&Tree::here()), &[]);
}

/// A reader holds model and implementation side by side.
#[test]
fn model_and_implementation_have_modules_of_one_name() {
    judge(&names::unequal(&Tree::here()), UNEQUAL);
}

/// `tracks::tracks` says nothing twice.
#[test]
fn no_function_is_called_like_its_module() {
    judge(&names::functions_like_modules(&Tree::here()), TWICE);
}

/// The way from one page to the next is all that a newcomer has.
#[test]
fn no_link_leads_nowhere() {
    judge(&links::broken(&Tree::here()), &[]);
}

/// A file that was moved is still named in prose.
#[test]
fn every_file_that_is_named_exists() {
    judge(&links::named(&Tree::here()), ELSEWHERE);
}

/// The README repeats figures of a page that is measured anew.
#[test]
fn the_readme_has_the_figures_of_coverage() {
    let tree = Tree::here();
    let [readme, page] = ["README.md", "docs/coverage.md"].map(|it| tree.0[it].as_str());
    let said =
        readme.split_once("Tests execute ").and_then(|it| it.1.split_once(" (`scripts/coverage`"));
    let is_figure = |word: &&str| word.starts_with(|c: char| c.is_ascii_digit());
    let figures: Vec<&str> =
        said.unwrap_or_default().0.split([' ', '\n', ',']).filter(is_figure).collect();
    let [lines, conditions, changes, noticed] = figures[..] else {
        panic!("{figures:?}");
    };
    for sentence in [
        format!("Lines with code that tests execute: {}", share(page, "Lines with code", lines)),
        format!(
            "Conditions that tests saw true and false: {}",
            share(page, "Conditions", conditions)
        ),
        format!("noticed {noticed} of {changes} changes"),
    ] {
        assert!(page.contains(&sentence), "{sentence}");
    }
}

/// Of the same drives the table has counts for each `tau`.
#[test]
fn the_readme_has_the_shares_of_availability() {
    let tree = Tree::here();
    let count = |start: &str, cell: usize| -> f64 {
        let line = tree.0["docs/drives.md"].lines().find(|it| it.starts_with(start));
        let number = line.and_then(|it| it.split(" | ").nth(cell)).and_then(|it| it.parse().ok());
        number.unwrap_or_else(|| panic!("{start}"))
    };
    let readme = tree.0["README.md"].split_whitespace().collect::<Vec<_>>().join(" ");
    let all = count("| from 0.8 s on | ", 3);
    assert!(readme.contains(&format!("Of {all} clean cycles")), "{all}");
    for (tau, words) in [("0.1", "with 0.1 s"), ("0.25", "with tau 0.25 s")] {
        let share = 100.0 * count(&format!("| {tau} | "), 3) / all;
        assert!(readme.contains(&format!("{share:.1} % {words}")), "{share}");
    }
}

#[test]
fn the_readme_has_the_times_of_the_page_of_speed() {
    let tree = Tree::here();
    let row = |start: &str| -> Vec<f64> {
        let line = tree.0["docs/speed.md"].lines().find_map(|it| it.strip_prefix(start));
        let cells = line.unwrap_or_else(|| panic!("{start}")).split('|');
        cells.filter_map(|cell| cell.trim().parse().ok()).collect()
    };
    let cycle = row("| whole cycle: best libraries, loop by hand in v |");
    let [_, us, ratio, _, _, _, _, most_us, most_ratio] = cycle[..] else { panic!("{cycle:?}") };
    let times = row("| times |");
    let [least, _, most] = times[..] else { panic!("{times:?}") };
    let readme = tree.0["README.md"].split_whitespace().collect::<Vec<_>>().join(" ");
    for words in [
        format!("takes {us:.1} us with 30 tracks and {most_us:.0} us with 1000:"),
        format!("{ratio:.1} and {most_ratio:.1} times less than the best libraries,"),
        format!("Hardened: {least:.0} to {most:.0} times as many instructions"),
    ] {
        assert!(readme.contains(&words), "{words}");
    }
}

/// Of the line of a page that begins so the counts with this share.
fn share(page: &str, start: &str, percent: &str) -> String {
    let line = page.lines().find(|it| it.starts_with(start)).unwrap_or_default();
    let counts = line.split_once(": ").and_then(|it| it.1.split_once(" (")).unwrap_or_default().0;
    format!("{counts} ({percent} %)")
}

/// Nobody types an interval.
#[test]
fn intervals_are_those_of_their_counts() {
    judge(&intervals::wrong(&Tree::here()), &[]);
}

/// `UPDATE_PROBLEMS=1` writes them.
#[test]
fn known_problems_for_programs_are_those_of_the_page() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/known-problems.json");
    let made = intervals::for_programs(&Tree::here());
    if std::env::var_os("UPDATE_PROBLEMS").is_some() {
        std::fs::write(file, &made).expect("it can be written");
    }
    let kept = std::fs::read_to_string(file).unwrap_or_default();
    assert!(kept == made, "{file} is old: UPDATE_PROBLEMS=1 and this test again");
}

#[test]
fn rules_close_the_same_findings_in_all_tables() {
    judge(&closes::wrong(&Tree::here()), &[]);
}

#[test]
fn findings_are_counted_as_their_tables_have_them() {
    judge(&counts::missing(&Tree::here()), &[]);
}

/// An assessor looks it up.
#[test]
fn evidence_that_is_named_exists() {
    judge(&evidence::missing(&Tree::here()), &[]);
}

/// What nobody thought of fails first.
#[test]
fn each_field_of_a_record_or_message_has_a_row_of_failure_modes() {
    let schemas = mufasa_records::schema::all();
    let record = schemas.iter().find(|it| it.0 == "monitor").expect("a schema");
    judge(&failure_modes::missing(&Tree::here(), &record.1), &[]);
}

/// An assumption that no code relies on is none, and one that only code knows is shown by nobody.
#[test]
fn assumptions_are_tied_to_the_code_that_relies_on_them() {
    judge(&assumptions::untied(&Tree::here()), &[]);
}

/// Branches are all that rustc counts.
#[test]
fn branch_coverage_of_conditions_is_mc_dc() {
    judge(&decisions::with_two_ways(&Tree::here()), &[]);
}

/// A figure whose sources nobody has is no evidence.
#[test]
fn measured_tables_are_of_clean_commits() {
    let by_hash = [("docs/proofs.md", "it has the number of its sources, which a test asks for")];
    judge(&stamps::wrong(&Tree::here()), &by_hash);
}

/// A note, since most commits touch some of them; with `MUFASA_RELEASE=1` an error. Not captured, to be seen.
#[test]
fn sources_of_measured_tables_are_those_of_today() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let old = stamps::old(&Tree::here(), &root);
    for it in &old {
        let _ = writeln!(std::io::stderr(), "OLD: {it}");
    }
    assert!(old.is_empty() || std::env::var_os("MUFASA_RELEASE").is_none(), "measure them again");
}

/// A deviation from the guideline that nobody reads of is none that was decided.
#[test]
fn each_lifted_lint_is_on_the_page_of_the_guideline() {
    judge(&lifted::not_listed(&Tree::here()), &[]);
}

/// What is claimed, with the evidence as somebody last looked at it. After a look `UPDATE_SAFETY_CASE=1` confirms it,
/// and draws the pictures.
#[test]
fn the_safety_case_is_well_formed_and_names_what_is_open() {
    if std::env::var_os("UPDATE_SAFETY_CASE").is_some() {
        safety_case::update(&Tree::here());
    }
    judge(&safety_case::wrong(&Tree::here()), &[]);
    judge(&safety_case::old_pictures(&Tree::here()), &[]);
}

/// Comments of Rust name headings of the spec.
#[test]
fn every_heading_that_is_named_exists() {
    judge(&links::headings_named(&Tree::here()), &[]);
}

/// "No remote result MUST reach control" would let each of them.
#[test]
fn what_is_forbidden_says_must_not() {
    judge(&must::turned_round(&Tree::here()), &[]);
}

/// A page that is longer is not read.
#[test]
fn the_readme_has_at_most_8_kb() {
    judge(&length::readme(&Tree::here(), 8_000), &[]);
}

/// Who copies a loop gets what the documents advise.
#[test]
fn loops_to_be_copied_are_as_advised() {
    judge(&loops::periods(&Tree::here()), &[]);
    judge(&loops::left_out(&Tree::here()), &[]);
}

/// See there, each with its reason.
#[test]
fn the_style_is_kept() {
    judge(&style::broken(&Tree::here()), &[]);
}
