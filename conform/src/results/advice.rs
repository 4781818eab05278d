//! The classes of a campaign by rule, and what to mend first.

use std::cmp::Reverse;
use std::io::{self, Write};

use crate::judge::class::{Breach, Kind, Scale};
use crate::results::summary::{Found, Summary};

/// So many places of a rule are named.
const PLACES: usize = 4;

/// Prints a line per rule with its commonest places, and what to mend first.
pub fn print(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    for (kind, breach) in rules(summary) {
        let mut places: Vec<(&str, u64)> = Vec::new();
        for found in &summary.classes {
            let class = &found.class;
            if (class.kind, class.breach) != (kind, breach) {
                continue;
            }
            match places.iter_mut().find(|(place, _)| *place == class.place) {
                Some((_, count)) => *count += found.count,
                None => places.push((&class.place, found.count)),
            }
        }
        let count: u64 = places.iter().map(|(_, count)| count).sum();
        places.sort_by_key(|(_, count)| Reverse(*count));
        let named = places.iter().filter(|(place, _)| !place.is_empty()).take(PLACES);
        let mut words: Vec<String> =
            named.map(|(place, count)| format!("{place} ({count})")).collect();
        if places.len() > PLACES {
            words.push(format!("{} more", places.len() - PLACES));
        }
        let colon = if words.is_empty() { "" } else { ": " };
        let (kind, breach) = (kind.name(), breach.name());
        writeln!(out, "{count:>8} x  {kind} {breach}{colon}{}", words.join(", "))?;
    }
    if let Some(first) = first(summary) {
        writeln!(out, "mend first: {} ({} cases; id {})", first.class, first.count, first.id)?;
    }
    if is_beginning(summary) {
        writeln!(out, "most cases disagree; begin with fewer: --profile paper --kinds cycle")?;
    }
    Ok(())
}

/// Kinds and rules that break, in the order of the classes.
fn rules(summary: &Summary) -> Vec<(Kind, Breach)> {
    let mut rules: Vec<_> =
        summary.classes.iter().map(|found| (found.class.kind, found.class.breach)).collect();
    rules.dedup();
    rules
}

/// What to mend first: what gives no answer, then what rounding does not explain, cycles before
/// other records, the commonest, the smallest.
fn first(summary: &Summary) -> Option<&Found> {
    summary.classes.iter().min_by_key(|found| {
        let class = &found.class;
        let is_threshold = class.scale == Scale::Threshold;
        (!class.breach.is_broken(), is_threshold, class.kind, Reverse(found.count), found.size)
    })
}

/// Whether most cases disagree, of more than the smallest task.
fn is_beginning(summary: &Summary) -> bool {
    let campaign = &summary.campaign;
    let is_least = campaign.profile == "paper" && campaign.kinds == [Kind::Cycle];
    campaign.drives.is_empty()
        && !is_least
        && 2 * summary.disagreements() > summary.asked + summary.vectors
}
