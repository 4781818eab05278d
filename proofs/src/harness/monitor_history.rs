//! Which lists of detections the monitor keeps, and which of them a cycle looks at (`spec/monitor.md#monitor`).
//!
//! Domain: all times of 64 bits, twelve places with any lists or none; the first or the last is the next to be taken. Not
//! covered: other places; items and indexes.

use mufasa::parts::monitor::Stamps;

use super::any::{near_integer, option};
#[cfg(not(kani))]
use crate::kani;

const PLACES: usize = 12;
const SPACING_NS: i128 = 83_333_334;
const SECOND_NS: i128 = 1_000_000_000;
const _: () = assert!(12 * SPACING_NS > SECOND_NS);
const USABLE_NS: [i128; 2] = [200_000_000, SECOND_NS];

/// A list is kept exactly when none is, or it is 1/12 s younger than the last one kept, or more than 1 s older: then
/// alone. It takes the next place in turn, and all others stay: so of twelve that follow each other by 1/12 s the oldest
/// goes, which is more than 1 s older [MON-12, MON-13, MON-14].
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(14))]
pub fn verify_no_list_of_the_last_second_is_lost() {
    // The place is a constant in each of the two branches.
    if kani::any() { no_list_is_lost(0) } else { no_list_is_lost(PLACES - 1) }
}

fn no_list_is_lost(next: usize) {
    let (before, stamp_ns) = (any_stamps(next), any_ns());
    let Some(after) = before.keep(stamp_ns) else {
        unreachable!("there is no memory to be short of")
    };
    let since_ns = before.youngest_ns.map(|youngest_ns| elapsed_ns(youngest_ns, stamp_ns));
    let is_set_back = since_ns.is_some_and(|it| it < -SECOND_NS);
    let is_early = since_ns.is_some_and(|it| it < SPACING_NS) && !is_set_back;
    let mut expected = before;
    if !is_early {
        if is_set_back {
            expected.kept = [None; PLACES];
        }
        expected.kept[next] = Some(stamp_ns);
        expected.next = (next + 1) % PLACES;
        expected.youngest_ns = Some(stamp_ns);
    }
    assert!(after == expected);
    kani::cover!(is_early, "too early");
    kani::cover!(is_set_back, "the clock was set back");
    kani::cover!(!is_early && !is_set_back && next > 0, "after the last place the first");
}

/// For each of 300, 500 and 800 ms the list that is looked at is usable (from 200 ms to 1 s older than the current one),
/// and no usable one has an age nearer to it, nor one as near and younger; none is looked at exactly when none is usable
/// [MON-15].
///
/// Domain: all times of 64 bits, in the first and the last of the twelve places lists of different times, or none. Not covered:
/// more lists; items and indexes.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(14))]
pub fn verify_the_nearest_usable_lists_are_looked_at() {
    let (stamp_ns, given) = (any_ns(), [(); 2].map(|()| option(any_ns)));
    kani::assume(given[0].is_none() || given[0] != given[1]);
    let mut kept = [None; PLACES];
    [kept[0], kept[PLACES - 1]] = given;
    let stamps = Stamps { kept, next: 0, youngest_ns: None };
    let found = stamps.nearest(stamp_ns);
    let age_of = |stamp: Option<i64>| {
        let age_ns = stamp.map(|it| elapsed_ns(it, stamp_ns));
        let usable_ns = age_ns.filter(|age_ns| USABLE_NS[0] <= *age_ns && *age_ns <= USABLE_NS[1]);
        usable_ns.and_then(|age_ns| i64::try_from(age_ns).ok())
    };
    let ages = given.map(age_of);
    let [one, two, three] = found;
    for (at, wanted_ns) in [(one, 300_000_000), (two, 500_000_000), (three, 800_000_000)] {
        let Some(at) = at else {
            assert!(ages == [None; 2]);
            continue;
        };
        let found_ns = if at == 0 { ages[0] } else { ages[1] };
        assert!(at == 0 || at == PLACES - 1);
        let Some(age_ns) = found_ns else { unreachable!("not usable") };
        let away = |age_ns: i64| (age_ns - wanted_ns).abs();
        assert!(ages.into_iter().flatten().all(|other_ns| {
            let (here, there) = (away(age_ns), away(other_ns));
            here < there || (here == there && age_ns <= other_ns)
        }));
    }
    kani::cover!(one != two && two.is_some(), "the older for 500 ms");
    kani::cover!(two != three && two.is_some(), "the older for 800 ms alone");
    kani::cover!(one == three && one.is_some(), "one list");
    kani::cover!(one.is_none(), "none");
}

/// At a tick a station may be asked, for what was seen, exactly when a kept list is at least 500 ms and at most 1 s old
/// [MON-43].
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(14))]
pub fn verify_half_a_second_was_seen_when_a_list_is_so_old() {
    let (stamps, now_ns) = (any_stamps(0), any_ns());
    let is_seen = |it: &Option<i64>| {
        it.is_some_and(|it| (SECOND_NS / 2..=SECOND_NS).contains(&elapsed_ns(it, now_ns)))
    };
    let expected = stamps.kept.iter().any(is_seen);
    assert!(stamps.reaches_back(now_ns) == Some(expected));
    kani::cover!(expected, "seen");
    kani::cover!(!expected && stamps.youngest_ns.is_some(), "not seen");
}

fn elapsed_ns(earlier_ns: i64, later_ns: i64) -> i128 {
    i128::from(later_ns) - i128::from(earlier_ns)
}

fn any_stamps(next: usize) -> Stamps {
    Stamps { kept: [(); PLACES].map(|()| option(any_ns)), next, youngest_ns: option(any_ns) }
}

/// Any time; an engine that samples looks at the first two seconds.
fn any_ns() -> i64 {
    near_integer(0, 2_000_000_000)
}
