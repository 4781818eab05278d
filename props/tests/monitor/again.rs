//! A station that is of no use again and again takes the plan away for a tenth of the time at most
//! (MON-34, finding F-43), and one whose session was of use for long is asked
//! again at once.

use mufasa::input::profile::Profile;
use mufasa::monitor::{Inputs, Monitor};

use super::habits::{Deed, Habit, PERIOD_NS, drive};
use super::kit::{Buffers, MS, Station, World, at, inputs, look_around, road};

/// Ten minutes.
const PERIODS: i64 = 6_000;

/// All that a station may do when it stops being of use.
const ENDS: [&[Deed]; 8] = [
    &[Deed::Silent],
    &[Deed::Late],
    &[Deed::Ahead(10)],
    &[Deed::Old],
    &[Deed::Withdraws],
    &[Deed::Silent, Deed::Withdraws],
    &[Deed::Lost],
    &[Deed::Silent, Deed::Lost],
];

fn first_good(good: usize, end: &[Deed]) -> Habit {
    Habit::of([&vec![Deed::Good; good], end].concat())
}

/// The bound of the rule, and that sessions begin again at all. Some are of use for less than nine times
/// as long as they are not then, some for as long, some for longer. MON-34, MON-35.
#[test]
fn a_station_of_no_use_takes_the_plan_for_a_tenth_of_the_time_at_most() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let mut at_once = 0;
        for good in [0, 1, 2, 5, 9, 10, 11, 19, 20, 37, 50, 100] {
            for end in ENDS {
                for share in drive(profile, &first_good(good, end), PERIODS) {
                    let case = format!("{profile:?}, {good} good, {end:?}: {share:?}");
                    assert!(10 * share.without_ns() <= PERIODS * PERIOD_NS, "{case}");
                    assert!(share.sessions > 50, "{case}");
                    assert!((share.with > 0) == (good > 0), "{case}");
                    // Not before nine periods, less the time from the first good result to the last one.
                    let used = i64::try_from(good).expect("a few").max(1) - 1;
                    let pause_ns = share.pause_ns.expect("more than one session");
                    assert!(pause_ns >= (9 - used) * PERIOD_NS, "{case}");
                    at_once += u64::from(pause_ns == 0);
                }
            }
        }
        assert!(at_once > 20, "{profile:?}: {at_once} are asked in the period of their end");
    }
}

/// The rule has no price where sessions do not end.
#[test]
fn a_station_of_use_is_kept() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for share in drive(profile, &Habit::of(vec![Deed::Good]), PERIODS) {
            assert_eq!((share.sessions, share.without_ns()), (1, 0), "{profile:?}: {share:?}");
            assert!(share.with > PERIODS - 10, "{profile:?}: {share:?}");
        }
    }
}

/// Good results in each period from the first to the last, which may be any time after the one before it;
/// then none.
fn of_use(monitor: &mut Monitor<'_>, station: &mut Station, first_ns: i64, last_ns: i64) {
    let periods = (first_ns - PERIOD_NS..last_ns).step_by(100 * 1_000_000);
    for now_ns in periods.chain([last_ns]) {
        let world = World::at(now_ns);
        let (tracks, points) = station.period(monitor, &world);
        let is_used = tracks.is_some() && points.is_some();
        assert_eq!(is_used, now_ns >= first_ns, "{now_ns}");
        station.take(&monitor.cycle(&inputs(&world, &tracks, &points)).1);
    }
}

/// What is left of the wait after a session that was of use and then not, ns, when it is withdrawn.
fn left(used_ns: i64, unused_ns: i64) -> Option<i64> {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = Station::default();
    let (first_ns, last_ns) = (PERIOD_NS, PERIOD_NS + used_ns);
    of_use(&mut monitor, &mut station, first_ns, last_ns);
    let before = monitor.requester().hold_until_ns();
    let end_ns = last_ns + unused_ns;
    station.take(&monitor.withdraw(at(end_ns), 1).expect("a station"));
    assert_eq!(station.released, 2);
    let until_ns = monitor.requester().hold_until_ns();
    if until_ns == before {
        // Nothing is left: the next tick asks.
        ask(&mut monitor, &mut station, end_ns, 2);
        return None;
    }
    let until_ns = until_ns.expect("a hold");
    look_around(&mut monitor, until_ns - 1, World::at);
    ask(&mut monitor, &mut station, until_ns - 1, 0);
    ask(&mut monitor, &mut station, until_ns, 2);
    Some(until_ns - end_ns)
}

/// An offer and a tick, and how many groups it asks for.
fn ask(monitor: &mut Monitor<'_>, station: &mut Station, now_ns: i64, requests: usize) {
    use mufasa::offloading::requester::Groups;

    station.take(&monitor.offer(at(now_ns), 1, Groups::ALL).expect("a station"));
    station.take(&monitor.tick(at(now_ns)));
    assert_eq!(station.asked.len(), requests, "{now_ns}");
}

/// Of use for 1 s, and then 100 ms without: no wait; for exactly nine times as long: none; 1 ns less: 1 ns.
/// Less than a period without counts as a period. MON-36.
#[test]
fn the_time_of_use_is_taken_from_the_wait_to_the_nanosecond() {
    for (used_ns, unused_ns, left_ns) in [
        (1_000 * MS, 100 * MS, None),
        (900 * MS, 100 * MS, None),
        (900 * MS - 1, 100 * MS, Some(1)),
        (900 * MS, 100 * MS + 1, Some(9)),
        (900 * MS, 0, None),
        (900 * MS, 100 * MS - 1, None),
        (900 * MS - 1, 0, Some(1)),
        (1_080 * MS, 120 * MS, None),
        (1_080 * MS - 1, 120 * MS, Some(1)),
        (500 * MS, 100 * MS, Some(400 * MS)),
        (0, 100 * MS, Some(900 * MS)),
        (0, 0, Some(900 * MS)),
    ] {
        assert_eq!(left(used_ns, unused_ns), left_ns, "{used_ns} ns of use, {unused_ns} without");
    }
}

/// A clock set back takes from the time of use what it takes back, and that without counts from there. MON-37.
#[test]
fn a_clock_set_back_loses_time_of_use() {
    let (used_ns, whole_ns) = (1_000 * MS, 900 * MS);
    for (set_back_ns, wait_ns) in
        [(0, 0), (100 * MS, 0), (100 * MS + 1, 1), (900 * MS, 800 * MS), (3_000 * MS, whole_ns)]
    {
        let cross_sections = road();
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.on(&cross_sections);
        let mut station = Station::default();
        let (first_ns, last_ns) = (PERIOD_NS, PERIOD_NS + used_ns);
        of_use(&mut monitor, &mut station, first_ns, last_ns);
        let back_ns = last_ns - set_back_ns;
        let world = World::at(back_ns);
        let inputs = Inputs::new(at(back_ns), world.ego);
        assert!(monitor.tick(at(back_ns)).is_empty());
        assert!(monitor.cycle(&inputs.detections(at(back_ns), &world.detections)).1.is_empty());
        let before = monitor.requester().hold_until_ns();
        let end_ns = back_ns + 100 * MS;
        station.take(&monitor.withdraw(at(end_ns), 1).expect("a station"));
        assert_eq!(station.released, 2);
        let until = monitor.requester().hold_until_ns();
        let expected = if wait_ns > 0 { Some(end_ns + wait_ns) } else { before };
        assert_eq!(until, expected, "{set_back_ns} ns set back");
    }
}
