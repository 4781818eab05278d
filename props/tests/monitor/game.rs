//! Who could game the wait after a session (`spec/5-interfaces.md#monitor.10`): a search over habits.

use mufasa::input::profile::Profile;

use super::habits::{Deed, Habit, Share, drive};

/// A minute.
const PERIODS: i64 = 600;

/// What a station may do in the periods of a pattern.
const LETTERS: [Deed; 5] =
    [Deed::Good, Deed::Silent, Deed::Ahead(1), Deed::Ahead(2), Deed::Ahead(10)];

const ENDS: [&[Deed]; 4] = [&[Deed::Silent], &[Deed::Late], &[Deed::Withdraws], &[Deed::Lost]];

fn patterns(longest: u32) -> Vec<Vec<Deed>> {
    let mut all = vec![vec![]];
    let mut last = all.clone();
    for _ in 0..longest {
        let longer = |word: &Vec<Deed>| LETTERS.map(|it| [&word[..], &[it]].concat());
        last = last.iter().flat_map(longer).collect();
        all.extend(last.iter().cloned());
    }
    all
}

#[test]
fn look() {
    let longest = std::env::var("LONGEST").map_or(3, |it| it.parse().expect("a number"));
    for profile in [Profile::Paper, Profile::Hardened] {
        let mut worst: Vec<(i64, String)> = Vec::new();
        let mut worst_end: Vec<(i64, String)> = Vec::new();
        let mut worst_all: Vec<(i64, String)> = Vec::new();
        for is_after in [false, true] {
            for good in [0, 1, 10, 30] {
                for word in patterns(longest) {
                    for repeats in [1, 4, 30] {
                        for end in ENDS {
                            let deeds =
                                [&vec![Deed::Good; good][..], &word.repeat(repeats), end].concat();
                            let habit = Habit { is_after, ..Habit::of(deeds) };
                            let [_, share]: [Share; 2] = drive(profile, &habit, PERIODS);
                            let text = format!(
                                "{is_after} {good} {word:?} {repeats} {end:?} with {} end {} long {} short {} sessions {}",
                                share.with,
                                share.at_end,
                                share.in_long_gaps,
                                share.in_short_gaps,
                                share.sessions
                            );
                            worst.push((share.in_long_gaps, text.clone()));
                            worst_end.push((share.at_end, text.clone()));
                            worst_all.push((share.without(), text));
                        }
                    }
                }
            }
        }
        for mut list in [worst, worst_end, worst_all] {
            list.sort();
            list.reverse();
            list.dedup_by_key(|it| it.0);
            println!("{profile:?}: {}", list.len());
            list.iter().take(4).for_each(|it| println!("{it:?}"));
        }
    }
}
