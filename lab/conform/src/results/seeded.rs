//! What a clean run means: with what chance such a run finds each bug that was seeded into a program.
//! The record is written by `examples/conformance/campaign --write`.

use serde::Deserialize;

use crate::judge::class::Kind;
use crate::results::summary::{Campaign, Summary};

const RECORD: &str = include_str!("../../data/seeded-bugs.json");

/// A bug counts as found by so many cases when they find it with this share of the seeds, percent.
const LIKELY: u64 = 99;

/// So many bugs that are less likely found are named with their chances.
const NAMED: usize = 5;

/// What was measured, as far as it is read here.
#[derive(Clone, Debug, Deserialize)]
struct Record {
    /// Seeds tried with each bug.
    seeds: u64,
    /// Cases of each seed.
    most: u64,
    bugs: Vec<Bug>,
}

/// A bug of a program under test.
#[derive(Clone, Debug, Deserialize)]
struct Bug {
    name: String,
    profile: String,
    /// Of the records in which it shows.
    kind: Kind,
    /// Vectors that find it.
    vectors: u64,
    /// By seed: the first random case that finds it, from 1 on.
    first: Vec<Option<u64>>,
}

impl Bug {
    /// With what share of the seeds so many cases find it, percent, rounded down.
    fn chance(&self, cases: u64) -> u64 {
        let found = self.first.iter().flatten().filter(|first| **first <= cases).count() as u64;
        (100 * found).checked_div(self.first.len() as u64).unwrap_or(0)
    }
}

/// Of the seeded bugs of this profile and these kinds how many the vectors find, how many as many
/// random cases, and the chances of the least likely; `None` for a run that is not clean, of drives,
/// or with a tolerance.
pub fn words(summary: &Summary) -> Option<String> {
    let campaign = &summary.campaign;
    let is_whole = summary.is_complete() && summary.skipped + summary.vectors_skipped == 0;
    let is_clean = summary.classes.is_empty() && is_whole;
    let is_plain = campaign.drives.is_empty() && campaign.tolerance.is_none();
    // It is a file of this package; a test reads it.
    let record = serde_json::from_str(RECORD).ok()?;
    (is_clean && is_plain && !summary.is_empty()).then(|| of_record(&record, campaign))?
}

fn of_record(record: &Record, campaign: &Campaign) -> Option<String> {
    let is_asked =
        |bug: &&Bug| bug.profile == campaign.profile && campaign.kinds.contains(&bug.kind);
    let bugs: Vec<&Bug> = record.bugs.iter().filter(is_asked).collect();
    if bugs.is_empty() {
        return None;
    }
    let cases = campaign.cases.min(record.most);
    let by_vectors = |bug: &&&Bug| campaign.vectors > 0 && bug.vectors > 0;
    let by_cases = |bug: &&&Bug| bug.chance(cases) >= LIKELY;
    let mut ways = Vec::new();
    if campaign.vectors > 0 {
        ways.push(format!("the vectors find {}", bugs.iter().filter(by_vectors).count()));
    }
    if cases > 0 {
        let (count, seeds) = (bugs.iter().filter(by_cases).count(), record.seeds);
        ways.push(format!(
            "{cases} random cases find {count} with a chance of at least {LIKELY} % (seeds: {seeds})"
        ));
    }
    let missed = bugs.iter().filter(|bug| !by_vectors(bug) && !by_cases(bug));
    let missed: Vec<&str> = missed.map(|bug| bug.name.as_str()).collect();
    let missed = if missed.is_empty() { String::from("none") } else { missed.join(", ") };
    let least = match cases {
        0 => String::new(),
        _ => format!("least likely by the cases: {};\n", least_likely(&bugs, cases)),
    };
    Some(format!(
        "what that means: of {} bugs seeded in programs, of this profile and these kinds, {};\n\
         {least}found in neither way: {missed}",
        bugs.len(),
        ways.join(", ")
    ))
}

/// The bugs that so many cases find with the lowest chances, and how many more are not sure.
fn least_likely(bugs: &[&Bug], cases: u64) -> String {
    let mut chances: Vec<(u64, &str)> =
        bugs.iter().map(|bug| (bug.chance(cases), bug.name.as_str())).collect();
    chances.retain(|(chance, _)| *chance < LIKELY);
    chances.sort_unstable();
    let mut words: Vec<String> =
        chances.iter().take(NAMED).map(|(chance, name)| format!("{name} {chance} %")).collect();
    match chances.len().saturating_sub(NAMED) {
        _ if words.is_empty() => return String::from("none"),
        0 => {}
        more => words.push(format!("{more} more below {LIKELY} %")),
    }
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use mufasa_model::input::cycle::Profile;

    use serde_json::Value;

    use super::*;
    use crate::cases::generate::Generator;
    use crate::cases::vectors::fitting;
    use crate::settings::Settings;

    fn campaign(profile: &str, kinds: &[Kind], vectors: u64, cases: u64) -> Campaign {
        let (profile, kinds) = (profile.to_owned(), kinds.into());
        Campaign { profile, vectors, cases, kinds, of: 1, ..Campaign::default() }
    }

    fn summary(campaign: Campaign) -> Summary {
        let (vectors, asked) = (campaign.vectors, campaign.cases);
        Summary { campaign, vectors, asked, shards: vec![0], ..Summary::default() }
    }

    fn bug(name: &str, vectors: u64, first: &[Option<u64>]) -> Bug {
        let (name, profile) = (name.to_owned(), "paper".to_owned());
        Bug { name, profile, kind: Kind::Cycle, vectors, first: first.into() }
    }

    /// The record as plain JSON, read another way than the code reads it.
    fn counts(profile: &str, kinds: &[&str], cases: u64) -> [usize; 3] {
        let record: Value = serde_json::from_str(RECORD).expect("JSON");
        let bugs = record["bugs"].as_array().expect("bugs").iter();
        let bugs: Vec<_> = bugs
            .filter(|bug| {
                bug["profile"] == profile && kinds.iter().any(|kind| bug["kind"] == **kind)
            })
            .collect();
        // Of so few seeds 99 % are all.
        let likely = |bug: &&&Value| {
            let firsts = bug["first"].as_array().expect("first");
            firsts.iter().all(|it| it.as_u64().is_some_and(|it| it <= cases))
        };
        let by_vectors = bugs.iter().filter(|bug| bug["vectors"] != 0).count();
        [bugs.len(), by_vectors, bugs.iter().filter(likely).count()]
    }

    #[test]
    fn a_clean_run_says_what_the_record_says() {
        for (profile, kinds, names, cases) in [
            ("paper", &[Kind::Cycle][..], &["cycle"][..], 1000),
            ("paper", &Kind::USUAL, &["cycle", "offloading", "composition", "line"], 10_000),
            ("hardened", &[Kind::Cycle, Kind::Offloading], &["cycle", "offloading"], 50_000),
        ] {
            let [all, by_vectors, by_cases] = counts(profile, names, cases);
            let said = words(&summary(campaign(profile, kinds, 100, cases))).expect("a clean run");
            assert!(said.contains(&format!("of {all} bugs seeded")), "{said}");
            assert!(said.contains(&format!("the vectors find {by_vectors},")), "{said}");
            let cases = cases.min(10_000);
            assert!(
                said.contains(&format!(" {cases} random cases find {by_cases} with")),
                "{said}"
            );
            assert!(all > 5 && by_vectors <= all && by_cases <= all);
        }
    }

    #[test]
    fn record_list_and_table_have_the_same_bugs() {
        let read = |file: &str| {
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../").to_owned() + file;
            std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
        };
        let record: Value = serde_json::from_str(RECORD).expect("the record");
        let bugs = record["bugs"].as_array().expect("bugs");
        let (list, page) =
            (read("examples/conformance/seeded_bugs.py"), read("docs/conformance.md"));
        let starts = ["python(", "hardened(", "cpp(", "javascript(", "Bug("];
        let of_list = list.lines().filter_map(|line| {
            let line = line.strip_prefix("    ")?;
            let rest = starts.iter().find_map(|start| line.strip_prefix(start))?;
            rest.strip_prefix('"')?.split('"').next()
        });
        let named = bugs.iter().filter_map(|bug| bug["name"].as_str());
        let (floats, others): (Vec<&str>, Vec<&str>) =
            named.partition(|name| name.starts_with("float32-"));
        assert_eq!(others, of_list.collect::<Vec<_>>());
        let (all, of_floats) = (bugs.len(), floats.len());
        // The list has the fields of each part in a line.
        for name in floats {
            let (part, field) = name["float32-".len()..].split_once('-').expect("a field");
            let is_listed = list.split(&format!("\"{part}\": (")).skip(1).any(|rest| {
                let fields = rest.split("),").next().unwrap_or_default();
                fields.split([' ', '"']).any(|it| it == field)
            });
            assert!(is_listed, "{name}");
        }
        let of_monitors =
            list.lines().filter_map(|it| it.strip_prefix("    monitor(\"")?.split('"').next());
        let of_monitors: Vec<&str> = of_monitors.collect();
        assert!(
            of_monitors.len() > 15
                && of_monitors.iter().all(|it| page.contains(&format!("| {it} |")))
        );
        let with_monitors = all + of_monitors.len();
        for (file, words) in [
            ("README.md", format!("{all} seeded bugs")),
            ("docs/conformance.md", format!("In all {all} bugs were seeded")),
            ("docs/conformance.md", format!("among the {all} now, and {of_floats} fields")),
            (
                "examples/conformance/README.md",
                format!("has {with_monitors} bugs, {of_floats} of them one field each"),
            ),
        ] {
            assert!(read(file).contains(&words), "{file}: {words}");
        }
        let is_float =
            |bug: &&Value| bug["name"].as_str().is_some_and(|it| it.starts_with("float32-"));
        let is_sure =
            |bug: &&Value| bug["first"].as_array().is_some_and(|it| !it.contains(&Value::Null));
        for program in ["Python", "C++"] {
            let of = |bug: &&Value| bug["program"] == program && is_float(bug) && is_sure(bug);
            let row =
                format!("| float32-* | each of {} fields, alone,", bugs.iter().filter(of).count());
            assert!(page.contains(&row), "docs/conformance.md has another table: {row}");
        }
        for bug in bugs {
            let first = bug["first"].as_array().expect("first");
            assert_eq!(record["seeds"], first.len());
            if is_float(&bug) && is_sure(&bug) {
                continue;
            }
            let chance = |cases: u64| {
                let is_found = |it: &&Value| it.as_u64().is_some_and(|it| it <= cases);
                let found = first.iter().filter(is_found).count();
                format!("{} %", (200 * found + first.len()) / (2 * first.len()))
            };
            let vectors = if bug["vectors"] == 0 { "-".into() } else { bug["vectors"].to_string() };
            let words = ["program", "profile", "name", "about"];
            let words = words.map(|key| bug[key].as_str().unwrap_or_default()).join(" | ");
            let chances = [100, 1000, 10_000].map(chance).join(" | ");
            let row = format!("| {words} | {vectors} | {chances} |\n");
            assert!(page.contains(&row), "docs/conformance.md has another table: {row}");
        }
    }

    /// As `digest` of `examples/conformance/campaign` has it.
    fn digest(lines: impl Iterator<Item = String>) -> String {
        let mut number = 0xcbf2_9ce4_8422_2325_u64;
        for byte in lines.flat_map(|line| (line + "\n").into_bytes()) {
            number = (number ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        format!("{number:016x}")
    }

    /// What was measured says nothing of other cases and vectors than those that are asked now.
    #[test]
    fn the_bugs_were_measured_with_what_is_asked_now() {
        let record: Value = serde_json::from_str(RECORD).expect("the record");
        for (name, profile) in [("paper", Profile::PAPER), ("hardened", Profile::HARDENED)] {
            let cases = [1, 2].into_iter().flat_map(|seed| {
                let generator = Generator { seed, profile, kinds: Kind::USUAL.into() };
                (0..150).map(move |case| generator.question(case).line(&format!("c-{case}")))
            });
            assert_eq!(
                record["generators"][name],
                digest(cases),
                "the generators of `mufasa conform` have changed since its seeded bugs were measured; \
                 examples/conformance/campaign --bugs ... --write measures those of a profile anew"
            );
        }
        let vectors = [Profile::PAPER, Profile::HARDENED].into_iter().flat_map(|profile| {
            let settings = Settings::of(profile, &Kind::USUAL);
            let given = fitting(&settings).expect("author and model agree");
            given.into_iter().map(|it| it.question.line(&it.id))
        });
        assert_eq!(
            record["vectors_asked"],
            digest(vectors),
            "the vectors of `mufasa conform` have changed since its seeded bugs were measured; \
             examples/conformance/campaign --vectors --write measures that anew (two minutes)"
        );
    }

    #[test]
    fn what_neither_way_finds_is_named() {
        let bugs = vec![
            bug("hidden", 0, &[Some(99), None]),
            bug("written", 2, &[None, None]),
            bug("drawn", 0, &[Some(1), Some(100)]),
        ];
        let record = Record { seeds: 2, most: 1000, bugs };
        let say = |vectors, cases| {
            of_record(&record, &campaign("paper", &[Kind::Cycle], vectors, cases)).expect("words")
        };
        assert_eq!(
            say(5, 100),
            "what that means: of 3 bugs seeded in programs, of this profile and these kinds, the \
             vectors find 1, 100 random cases find 1 with a chance of at least 99 % (seeds: 2);\n\
             least likely by the cases: written 0 %, hidden 50 %;\n\
             found in neither way: hidden"
        );
        assert!(say(5, 99).ends_with(
            "find 0 with a chance of at least 99 % (seeds: 2);\n\
             least likely by the cases: written 0 %, drawn 50 %, hidden 50 %;\n\
             found in neither way: hidden, drawn"
        ));
        assert!(say(0, 100).ends_with("\nfound in neither way: hidden, written"));
        assert!(!say(0, 100).contains("vectors") && !say(5, 0).contains("random"));
        assert_eq!(of_record(&record, &campaign("hardened", &[Kind::Cycle], 5, 100)), None);
    }

    /// What is not named is counted, and what is found with every seed is not among it.
    #[test]
    fn five_of_the_least_likely_are_named() {
        let names = ["a", "b", "c", "d", "e", "f", "g", "sure"];
        let first = |at| -> Vec<_> { (0..7).map(|seed| (seed < at).then_some(9)).collect() };
        let bugs: Vec<Bug> =
            names.iter().enumerate().map(|(at, it)| bug(it, 1, &first(at))).collect();
        let of =
            |count: usize, cases| least_likely(&bugs.iter().take(count).collect::<Vec<_>>(), cases);
        assert_eq!(of(8, 9), "a 0 %, b 14 %, c 28 %, d 42 %, e 57 %, 2 more below 99 %");
        assert_eq!(of(2, 8), "a 0 %, b 0 %");
        assert_eq!(least_likely(&[&bugs[7]], 9), "none");
    }

    #[test]
    fn only_a_clean_and_whole_run_says_it() {
        let clean = || summary(campaign("paper", &[Kind::Cycle], 10, 100));
        assert!(words(&clean()).is_some());
        let tolerance = Some(1e-6);
        let tolerant = Campaign { tolerance, ..clean().campaign };
        assert_eq!(words(&Summary { campaign: tolerant, ..clean() }), None);
        assert_eq!(words(&Summary { interrupted: true, ..clean() }), None);
        assert_eq!(words(&Summary { skipped: 1, ..clean() }), None);
        assert_eq!(words(&Summary { vectors_skipped: 1, ..clean() }), None);
        assert_eq!(words(&Summary { shards: Vec::new(), ..clean() }), None);
    }
}
