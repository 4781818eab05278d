//! The table of ratios: the implementation against the best peer of each stage, and against all of
//! these in one call.

use std::fmt::Write as _;

use crate::race::Time;

/// The tasks of the five stages.
pub const STAGES: [&str; 5] = ["stage i", "stage ii", "stage iii", "stage iv", "stage v"];
/// Name of the implementation among the contestants, in the paper profile.
pub const OURS: &str = "mufasa";
/// A peer that is no library.
pub const BY_HAND: &str = "loop around the disk centres";

/// A whole cycle in which only the grid says what is in the way.
pub const UNSEEN: &str = "whole cycle MotRemote without detections";

/// The best peer of each stage in one call, to compare a whole cycle with.
#[derive(Clone, Copy, Debug)]
pub struct Team {
    /// In the tables.
    pub name: &'static str,
    /// The loop by hand is one of the peers of stage v.
    pub by_hand: bool,
    /// The input is checked first, as ours always is.
    pub validates: bool,
}

/// All teams.
pub const TEAMS: [Team; 4] = [
    Team { name: "best libraries", by_hand: false, validates: false },
    Team { name: "best libraries, loop by hand in v", by_hand: true, validates: false },
    Team { name: "plain validation, best libraries", by_hand: false, validates: true },
    Team {
        name: "plain validation, best libraries, loop by hand in v",
        by_hand: true,
        validates: true,
    },
];

/// Warm or cold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cache {
    /// Called again and again.
    Warm,
    /// Caches full of other data.
    Cold,
}

impl Time {
    fn us(&self, cache: Cache) -> Option<f64> {
        match cache {
            Cache::Warm => Some(self.warm_us),
            Cache::Cold => self.cold_us,
        }
    }
}

/// The times of one workload.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Results {
    /// `W1`
    pub workload: String,
    /// Everything that was timed.
    pub times: Vec<Time>,
}

impl Results {
    /// A contestant's time, us.
    pub fn time(&self, task: &str, name: &str, cache: Cache) -> Option<f64> {
        let mut all = self.times.iter();
        all.find(|time| time.task == task && time.name == name)?.us(cache)
    }

    /// The fastest peer of a task that `counts`, us.
    fn best(&self, task: &str, cache: Cache, counts: fn(&str) -> bool) -> Option<(&str, f64)> {
        let peers = self
            .times
            .iter()
            .filter(|time| time.task == task && !time.name.starts_with(OURS) && counts(&time.name));
        peers
            .filter_map(|time| Some((time.name.as_str(), time.us(cache)?)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The names of the fastest peers of the five stages; `by_hand`: the loop counts too.
    ///
    /// # Panics
    /// When a stage has not been timed.
    pub fn fastest(&self, cache: Cache, by_hand: bool) -> [&str; 5] {
        let counts: fn(&str) -> bool = if by_hand { |_| true } else { |name| name != BY_HAND };
        STAGES.map(|stage| self.best(stage, cache, counts).expect("timed").0)
    }
}

impl Cache {
    /// The task of a whole cycle with the peers that are fastest so.
    pub fn task(self) -> String {
        format!("all, {self:?}").to_lowercase()
    }
}

/// The tables of all workloads as Markdown.
pub fn markdown(results: &[Results]) -> String {
    let mut text = String::from("Warm, us per cycle (median), paper profile:\n\n");
    let cache = Cache::Warm;
    head(&mut text, results);
    let mut parts = vec![("validation", "validation")];
    parts.extend(STAGES.map(|stage| (stage, stage)));
    parts.push(("stage v, libraries only", "stage v"));
    for (title, task) in parts {
        let counts: fn(&str) -> bool =
            if title.contains("only") { |name| name != BY_HAND } else { |_| true };
        line(&mut text, title, results, |it| {
            let (name, best) = it.best(task, cache, counts)?;
            Some(ratio(name, best, it.time(task, OURS, cache)?))
        });
    }
    let task = cache.task();
    for Team { name, .. } in TEAMS {
        line(&mut text, &format!("whole cycle: {name}"), results, |it| {
            let peers = it.time(&task, name, cache)?;
            Some(ratio("", peers, it.time(&task, OURS, cache)?))
        });
    }
    line(&mut text, &format!("{}, ours hardened", TEAMS[0].name), results, |it| {
        let ours = it.time(&task, &hardened(), cache)?;
        Some(ratio("", it.time(&task, TEAMS[0].name, cache)?, ours))
    });
    line(&mut text, "building the index of the route, once", results, |it| {
        let (name, peer) = it.best("index", cache, |_| true)?;
        Some(ratio(name, peer, it.time("index", OURS, cache)?))
    });
    text.push('\n');
    goals(&mut text, results);
    cycles(&mut text, results);
    failures(&mut text, results);
    text
}

/// Name of the implementation in the hardened profile.
pub fn hardened() -> String {
    format!("{OURS}, hardened")
}

fn head(text: &mut String, results: &[Results]) {
    text.push_str("| |");
    for it in results {
        let _ = write!(text, " {}: best peer, us | ours, us | ratio |", it.workload);
    }
    text.push_str("\n|---|");
    for _ in results {
        text.push_str("---|---|---|");
    }
    text.push('\n');
}

fn line(
    text: &mut String,
    title: &str,
    results: &[Results],
    cells: impl Fn(&Results) -> Option<String>,
) {
    let _ = write!(text, "| {title} |");
    for it in results {
        let cells = cells(it).unwrap_or_else(|| " - | - | - |".to_owned());
        text.push_str(&cells);
    }
    text.push('\n');
}

fn ratio(name: &str, peer: f64, ours: f64) -> String {
    let name = if name.is_empty() { String::new() } else { format!("{name} ") };
    format!(" {name}{} | {} | {} |", digits(peer), digits(ours), digits(peer / ours))
}

/// The ratios of a whole cycle that were aimed at, of W1, W2, W3.
const GOALS: [(Cache, [f64; 3]); 2] =
    [(Cache::Warm, [8.0, 15.0, 30.0]), (Cache::Cold, [4.0, 8.0, 13.0])];

/// Whole cycles against what was aimed at.
fn goals(text: &mut String, results: &[Results]) {
    text.push_str("| whole cycle against | caches |");
    for it in results {
        let _ = write!(text, " {}: ratio | aimed at | |", it.workload);
    }
    let _ = writeln!(text, "\n|---|---|{}", "--:|--:|---|".repeat(results.len()));
    for Team { name, .. } in TEAMS.iter().filter(|team| !team.validates) {
        for (cache, goals) in GOALS {
            let title = format!("{name} | {}", format!("{cache:?}").to_lowercase());
            let mut goals = goals.into_iter();
            let mut row = String::new();
            for it in results {
                let task = cache.task();
                let times = [*name, OURS].map(|name| it.time(&task, name, cache));
                let ([Some(peers), Some(ours)], Some(goal)) = (times, goals.next()) else {
                    continue;
                };
                let ratio = peers / ours;
                let met = if ratio >= goal { "met" } else { "**missed**" };
                let _ = write!(row, " {} | {goal} | {met} |", digits(ratio));
            }
            let _ = writeln!(text, "| {title} |{row}");
        }
    }
    text.push('\n');
}

/// What a vehicle asks for: whole cycles as the schedule has them.
fn cycles(text: &mut String, results: &[Results]) {
    text.push_str("| warm |");
    for it in results {
        let _ = write!(text, " {}, us |", it.workload);
    }
    let _ = writeln!(text, "\n|---|{}", "--:|".repeat(results.len()));
    let tasks = ["MotRemote", "AllRemote", "PlanRemote"].map(|it| format!("whole cycle {it}"));
    for task in tasks.iter().map(String::as_str).chain([UNSEEN]) {
        for name in [OURS.to_owned(), hardened()] {
            if task == UNSEEN && name == OURS {
                continue;
            }
            line(text, &format!("{task}, {name}"), results, |it| {
                Some(format!(" {} |", digits(it.time(task, &name, Cache::Warm)?)))
            });
        }
    }
    text.push('\n');
}

/// Cycles that must be rejected: time until the stage says so.
fn failures(text: &mut String, results: &[Results]) {
    text.push_str("Rejected inputs, warm:\n\n");
    head(text, results);
    for task in ["ghost", "drift", "fail i", "fail ii", "fail iii", "fail iv", "fail v"] {
        for (title, ours) in
            [(task.to_owned(), OURS.to_owned()), (format!("{task}, ours hardened"), hardened())]
        {
            line(text, &title, results, |it| {
                let (name, best) = it.best(task, Cache::Warm, |_| true)?;
                Some(ratio(name, best, it.time(task, &ours, Cache::Warm)?))
            });
        }
    }
    text.push('\n');
}

/// Three significant digits.
fn digits(value: f64) -> String {
    let places = if value >= 100.0 {
        0
    } else if value >= 10.0 {
        1
    } else if value >= 1.0 {
        2
    } else {
        3
    };
    format!("{value:.places$}")
}
