//! Who could game the wait after a session (MON-34): a search over habits.

use mufasa::input::profile::Profile;

use super::habits::{Deed, Habit, PERIOD_NS, Share, drive};
use super::kit::settings;

/// Half a minute.
const PERIODS: i64 = 300;

/// What a station may do in the periods of a pattern.
const LETTERS: [Deed; 4] = [Deed::Good, Deed::Silent, Deed::Ahead(1), Deed::Ahead(10)];

const ENDS: [&[Deed]; 4] = [&[Deed::Silent], &[Deed::Late], &[Deed::Withdraws], &[Deed::Lost]];

/// All up to a length.
fn patterns(longest: usize) -> Vec<Vec<Deed>> {
    let mut all = vec![vec![]];
    let mut last = all.clone();
    for _ in 0..longest {
        let longer = |word: &Vec<Deed>| LETTERS.map(|it| [&word[..], &[it]].concat());
        last = last.iter().flat_map(longer).collect();
        all.extend(last.iter().cloned());
    }
    all
}

/// Of use for so many periods, then a pattern once or again and again, then an end; with results before the
/// cycle of their period or after it.
fn habits() -> Vec<Habit> {
    let mut all = Vec::new();
    for word in patterns(3) {
        for (good, repeats) in [(0, 1), (0, 20), (1, 1), (10, 1), (10, 4)] {
            for end in ENDS {
                for is_after in [false, true] {
                    let deeds = [&vec![Deed::Good; good], &word.repeat(repeats)[..], end].concat();
                    all.push(Habit { is_after, ..Habit::of(deeds) });
                }
            }
        }
    }
    all
}

/// Until its sessions' ends no group is without anything for more than a tenth of the time and what one
/// session costs, whatever the habit. Of gaps that end before their session does the wait says nothing: only
/// the bound of MON-33 holds for each.
#[test]
fn no_habit_takes_the_plan_for_more_than_a_tenth_of_the_time() {
    let of_session_ns = 2 * settings().requester.dt_max_ns + 2 * PERIOD_NS;
    let time_ns = PERIODS * PERIOD_NS;
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let mut worst: [(i64, String); 3] = Default::default();
        let mut shortened = 0;
        for habit in habits() {
            for share in drive(profile, &habit, PERIODS) {
                let case = format!("{profile:?}, {habit:?}: {share:?}");
                assert!(10 * share.at_end_ns <= time_ns + 10 * of_session_ns, "{case}");
                assert!(share.longest_gap_ns <= of_session_ns, "{case}");
                shortened += u64::from(share.pause_ns.is_some_and(|it| it < 9 * PERIOD_NS));
                let all_ns = [share.at_end_ns, share.in_short_gaps_ns, share.in_long_gaps_ns];
                for (worst, ns) in worst.iter_mut().zip(all_ns) {
                    if ns > worst.0 {
                        *worst = (ns, case.clone());
                    }
                }
            }
        }
        println!("{profile:?}: of {time_ns} ns at ends, in short gaps, in long ones {worst:#?}");
        assert!(worst.iter().all(|(ns, _)| *ns > 0), "{profile:?}: {worst:?}");
        assert!(shortened > 100, "{profile:?}: {shortened}");
    }
}

/// That one group is of use pays nothing for the other, and the other's wait takes nothing from it.
#[test]
fn each_group_pays_for_itself() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for (good, end) in [0, 1, 10, 30].into_iter().flat_map(|it| {
            [Deed::Silent, Deed::Late, Deed::Ahead(10), Deed::Old].map(|end| (it, end))
        }) {
            let of_use = vec![Deed::Good];
            let of_none = [vec![Deed::Good; good], vec![end]].concat();
            for none in [0, 1] {
                let mut habit = Habit::of(of_use.clone());
                habit.deeds[none].clone_from(&of_none);
                let shares: [Share; 2] = drive(profile, &habit, 10 * PERIODS);
                let case = format!("{profile:?}, {habit:?}: {shares:?}");
                assert!(10 * shares[none].without_ns() <= 10 * PERIODS * PERIOD_NS, "{case}");
                assert!(shares[none].sessions > 50, "{case}");
                assert_eq!(
                    (shares[1 - none].sessions, shares[1 - none].without_ns()),
                    (1, 0),
                    "{case}"
                );
            }
        }
    }
}
