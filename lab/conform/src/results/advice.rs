//! The classes of a campaign by rule, and what to mend first.

use std::cmp::Reverse;
use std::io::{self, Write};

use crate::judge::class::{Breach, Class, Kind, Scale};
use crate::results::found::Found;
use crate::results::summary::Summary;

/// So many places of a rule are named; of lines that are no records, whose places are many and
/// alike, fewer.
const PLACES: usize = 5;
const LINES: usize = 2;

/// Of a program that is at its beginning one answer in so many is wrong, or more.
const BEGINNING: u64 = 5;

/// Prints with what to begin, where much is wrong and less can be asked.
pub fn begin(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    if is_beginning(summary) && !is_least(summary) {
        writeln!(out, "\nmuch disagrees; begin with fewer: --profile paper --kinds cycle")?;
    }
    Ok(())
}

/// Prints a line per rule with its commonest places.
pub fn print(summary: &Summary, out: &mut impl Write) -> io::Result<()> {
    for (kind, breach) in rules(summary) {
        let classes = || {
            let is_of_rule = |it: &&Found| (it.class.kind, it.class.breach) == (kind, breach);
            summary.classes.iter().filter(is_of_rule)
        };
        let mut places: Vec<(&str, u64)> = Vec::new();
        for found in classes() {
            match places.iter_mut().find(|(place, _)| *place == found.class.place) {
                Some((_, count)) => *count += found.count,
                None => places.push((&found.class.place, found.count)),
            }
        }
        let count: u64 = places.iter().map(|(_, count)| count).sum();
        let is_rounding = |it: &&Found| it.class.scale == Scale::Threshold;
        let rounding: u64 = classes().filter(is_rounding).map(|it| it.count).sum();
        let rounding = match rounding {
            0 => String::new(),
            some => format!(" ({some} at the threshold)"),
        };
        let words = named(places, if kind == Kind::Line { LINES } else { PLACES });
        let (kind, breach) = (kind.name(), breach.name());
        writeln!(out, "{count:>8} x  {kind} {breach}{rounding}{words}")?;
    }
    Ok(())
}

/// The commonest places with their counts, so many at most.
fn named(mut places: Vec<(&str, u64)>, most: usize) -> String {
    places.retain(|(place, _)| !place.is_empty());
    places.sort_by_key(|(_, count)| Reverse(*count));
    let words: Vec<String> =
        places.iter().take(most).map(|(place, count)| format!("{place} ({count})")).collect();
    match places.len().saturating_sub(most) {
        _ if words.is_empty() => String::new(),
        0 => format!(": {}", words.join(", ")),
        more => format!(": {} and {more} more", words.join(", ")),
    }
}

/// Kinds and rules that break, in the order of the classes.
fn rules(summary: &Summary) -> Vec<(Kind, Breach)> {
    let mut rules: Vec<_> =
        summary.classes.iter().map(|found| (found.class.kind, found.class.breach)).collect();
    rules.dedup();
    rules
}

/// One class of each rule, in the order in which to mend them: what gives no answer, then what
/// rounding does not explain, cycles before other records, what is unsound, what was made small, the commonest, the
/// smallest.
pub fn order(summary: &Summary) -> Vec<&Found> {
    let mut classes: Vec<&Found> = summary.classes.iter().collect();
    classes.sort_by_key(|found| {
        let Found { class, count, size, .. } = found;
        (urgency(class), !found.is_tried(), Reverse(*count), *size)
    });
    let mut order: Vec<&Found> = Vec::new();
    for found in classes {
        if !order.iter().any(|it| it.class.is_of_rule(&found.class)) {
            order.push(found);
        }
    }
    order
}

/// What is to be mended before others: the lower.
pub fn urgency(class: &Class) -> impl Ord {
    let is_sound = class.breach != Breach::Soundness;
    (!class.breach.is_broken(), class.scale == Scale::Threshold, class.kind, is_sound)
}

/// Whether so many answers are wrong that one record says more than several.
pub fn is_beginning(summary: &Summary) -> bool {
    is_much(summary.disagreements(), summary.asked + summary.vectors)
}

/// Whether so many of the answers are wrong that the program is at its beginning.
pub fn is_much(wrong: u64, asked: u64) -> bool {
    BEGINNING * wrong >= asked && asked > 0
}

/// Whether less cannot be asked, or other options would not mean less.
fn is_least(summary: &Summary) -> bool {
    let campaign = &summary.campaign;
    let is_least = campaign.profile == "paper" && campaign.kinds == [Kind::Cycle];
    !campaign.drives.is_empty() || is_least || !campaign.kinds.contains(&Kind::Cycle)
}
