//! A station whose results come in time and are current in no cycle is left (MON-31,
//! finding F-43); one that any cycle can use is kept.

use mufasa::monitor::{Decision, Inputs, Message, Monitor, Time};
use mufasa::offloading::requester::{Action, Actions, Group, Groups};
use mufasa::report::Problem;
use mufasa::services::configuration::Configuration;

use super::kit::{
    Buffers, MS, Points, Station, Tracks, World, at, inputs, look_around, message, road, settings,
};

const PERIOD_NS: i64 = 100 * MS;

/// When results are generated, how much later they arrive and the cycle looks, and how far ahead of
/// their arrival they are stamped, ns.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_field_names, reason = "a unit is no postfix")]
struct Habit {
    latency_ns: i64,
    phase_ns: i64,
    ahead_ns: i64,
}

/// The first cycle with a current element, of a session that is asked for at time 0.
const FIRST_NS: i64 = PERIOD_NS;

const HONEST: Habit = Habit { latency_ns: 0, phase_ns: 0, ahead_ns: 0 };

/// The events of one period that begins at `start_ns` and its cycle; whether remote tracks and a remote
/// trajectory come out.
fn period(
    monitor: &mut Monitor<'_>,
    station: &mut Station,
    (start_ns, habit): (i64, Habit),
) -> [bool; 2] {
    let Habit { latency_ns, phase_ns, ahead_ns } = habit;
    let arrival_ns = start_ns + latency_ns;
    let world = World::at(arrival_ns + phase_ns);
    station.take(&monitor.tick(at(arrival_ns)));
    let [mot, plan] = station.sessions;
    let generated = at(start_ns);
    // Tracks far from their detections are a failure, so that these are where they will be.
    let later = World::at(arrival_ns + ahead_ns.min(1_000 * MS));
    let mut tracks: Tracks = None;
    if let Some(session) = mot {
        let stamp = at(later.now_ns);
        let new = Message { stamp, ..message(session, generated, later.tracks) };
        let arrival = monitor.tracks(at(arrival_ns), new);
        tracks = station.accepted(arrival.expect("a station"));
    }
    let mut points: Points = None;
    if let Some(session) = plan {
        let stamp = at(arrival_ns.saturating_add(ahead_ns));
        let new = Message { stamp, ..message(session, generated, world.points.clone()) };
        let arrival = monitor.trajectory(at(arrival_ns), new);
        points = station.accepted(arrival.expect("a station"));
    }
    let (decision, actions) = monitor.cycle(&inputs(&world, &tracks, &points));
    let Decision::Safe { tracks, trajectory, .. } = decision else {
        panic!("{habit:?} at {start_ns}: {decision:?}");
    };
    station.take(&actions);
    [tracks.is_some(), trajectory.is_some()]
}

/// Periods of good results, then those of a habit until the session ends, for at most 40 periods: when
/// the last cycle had a current element, when the session ended, and what came out last.
fn drive(habit: impl Fn(i64) -> Habit) -> (i64, Option<i64>, [bool; 2]) {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = Station::default();
    let mut last_ns = begin(&mut monitor, &mut station, 0);
    let mut out = [false; 2];
    for i in 5..45 {
        let (start_ns, habit) = (i * PERIOD_NS, habit(i));
        out = period(&mut monitor, &mut station, (start_ns, habit));
        if out == [true; 2] {
            last_ns = start_ns + habit.latency_ns + habit.phase_ns;
        }
        if monitor.configuration() == Configuration::Local {
            assert_eq!(station.released, 2, "both groups, once");
            let end_ns = start_ns + habit.latency_ns;
            let wait_ns = 9 * (end_ns - last_ns).max(PERIOD_NS) - (last_ns - FIRST_NS);
            assert!(wait_ns > 0, "{habit:?}: of use for {FIRST_NS} to {last_ns}");
            let again_ns = end_ns + wait_ns;
            look_around(&mut monitor, again_ns - 50 * MS, World::at);
            station.take(&monitor.tick(at(again_ns - 1)));
            assert_eq!(station.asked, [], "{habit:?}: not before {again_ns}");
            // The next session is no worse for it.
            let _last_ns = begin(&mut monitor, &mut station, again_ns);
            assert_eq!(monitor.configuration(), Configuration::AllRemote);
            return (last_ns, Some(end_ns), out);
        }
    }
    (last_ns, None, out)
}

/// Five periods of which the last four have everything.
fn begin(monitor: &mut Monitor<'_>, station: &mut Station, start_ns: i64) -> i64 {
    for i in 0..5 {
        let world = World::at(start_ns + i * PERIOD_NS);
        if i == 0 {
            let _lists = station.period(monitor, &world);
        } else {
            for (group, session) in std::mem::take(&mut station.asked) {
                let actions = monitor.confirm(at(world.now_ns), 1, group, session);
                station.take(&actions.expect("a station"));
            }
            let out = period(monitor, station, (world.now_ns, HONEST));
            assert_eq!(out, [true; 2], "period {i}");
        }
    }
    start_ns + 4 * PERIOD_NS
}

/// The bound of MON-31: 2 dt_max and two periods.
#[test]
fn results_that_are_current_in_no_cycle_end_their_session() {
    let dt_max_ns = settings().requester.dt_max_ns;
    let max_age_ns = settings().stages.max_age_ns;
    for (phase_ns, ahead_ns) in [
        (0, 1),
        (0, 60 * MS),
        (0, PERIOD_NS),
        (0, 1_000 * MS),
        (0, 50_000 * MS),
        (30 * MS, 30 * MS + 1),
        // Not too old when they arrive.
        (1, -max_age_ns),
        (30 * MS, 29 * MS - max_age_ns),
    ] {
        let habit = Habit { latency_ns: 10 * MS, phase_ns, ahead_ns };
        let (last_ns, end_ns, out) = drive(|_| habit);
        let end_ns = end_ns.unwrap_or_else(|| panic!("{habit:?} keeps its session: {out:?}"));
        let left_after_ns = end_ns - last_ns;
        assert!(left_after_ns > dt_max_ns, "{habit:?}: {left_after_ns}");
        assert!(left_after_ns <= 2 * dt_max_ns + 2 * PERIOD_NS, "{habit:?}: {left_after_ns}");
        assert_eq!(out, [false; 2], "{habit:?}");
    }
}

/// A stamp ahead of its arrival and not of the cycle, a bound of age that is met exactly, an honest
/// station whose messages are now quick and now slow, and one that is useless for as long as dt_max and
/// no longer: each keeps its session. MON-33.
#[test]
fn results_that_cycles_can_use_keep_their_session() {
    let l_max_ns = settings().requester.l_max_ns;
    let max_age_ns = settings().stages.max_age_ns;
    for (phase_ns, ahead_ns) in
        [(30 * MS, 20 * MS), (30 * MS, 30 * MS), (30 * MS, 30 * MS - max_age_ns)]
    {
        let habit = Habit { latency_ns: 10 * MS, phase_ns, ahead_ns };
        let (_, end_ns, out) = drive(|_| habit);
        assert_eq!((end_ns, out), (None, [true; 2]), "{habit:?}");
    }
    let jitter = |i: i64| Habit { latency_ns: (i * 29 * MS) % (l_max_ns + 1), ..HONEST };
    let (_, end_ns, out) = drive(jitter);
    assert_eq!((end_ns, out), (None, [true; 2]), "jitter");
    // From one cycle with an element to one without it dt_max passes; or a nanosecond more, and what
    // comes then is dropped.
    for (late_ns, is_kept) in [(50 * MS, true), (50 * MS + 1, false)] {
        let now_and_then = |i: i64| match i % 3 {
            1 => Habit { ahead_ns: PERIOD_NS, latency_ns: 0, phase_ns: late_ns },
            _ => HONEST,
        };
        let (_, end_ns, _) = drive(now_and_then);
        assert_eq!(end_ns.is_none(), is_kept, "{late_ns}");
    }
}

/// MON-38: the hold that begins when a tick finds silence bars the requests of that
/// tick, and ends to the nanosecond.
#[test]
fn the_tick_that_ends_a_session_asks_nobody() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = Station::default();
    let _none = monitor.offer(at(0), 1, Groups::from(Group::Mot)).expect("a station");
    station.take(&monitor.tick(at(0)));
    let [(group, session)] = std::mem::take(&mut station.asked)[..] else { panic!("MOT alone") };
    let _none = monitor.confirm(at(0), 1, group, session).expect("a station");
    let _none = monitor.offer(at(0), 1, Groups::ALL).expect("a station");
    let silent_ns = settings().requester.dt_max_ns + 1;
    station.take(&monitor.tick(at(silent_ns)));
    assert_eq!((station.released, station.asked.len()), (1, 0));
    // Nothing was current since the confirmation.
    let again_ns = 10 * silent_ns;
    look_around(&mut monitor, again_ns - 50 * MS, World::at);
    for (t_ns, requests) in [(again_ns - 1, 0), (again_ns, 2)] {
        station.take(&monitor.tick(at(t_ns)));
        assert_eq!(station.asked.len(), requests, "{t_ns}");
    }
}

/// Something that returns groups to local at a time.
type End = fn(&mut Monitor<'_>, Time) -> Actions;

/// MON-34, MON-35, MON-36: withdrawn, lost, out of the area, late: after each no station is asked
/// for nine periods, as the last cycle had what it needs, less the time from the first such cycle to that one.
#[test]
fn after_every_end_of_a_session_nine_periods_less_its_use_are_waited() {
    let ends: [(&str, End, usize); 5] = [
        ("withdrawn", |it, now| it.withdraw(now, 1).expect("a station"), 2),
        ("lost", |it, now| it.lost(now, 1).expect("a station"), 2),
        ("area", |it, now| it.area(now, Groups::NONE), 2),
        (
            "late",
            |it, now| {
                let session = it.requester().session_of(Group::Mot).expect("remote").session;
                let late = message(session, at(0), World::at(0).tracks);
                it.tracks(now, late).expect("a station").1
            },
            1,
        ),
        (
            "a cycle",
            |it, now| {
                assert!(it.tick(now).is_empty());
                it.cycle(&Inputs::new(now, World::at(0).ego)).1
            },
            0,
        ),
    ];
    let cross_sections = road();
    for (name, end, left) in ends {
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.on(&cross_sections);
        let mut station = Station::default();
        let last_ns = begin(&mut monitor, &mut station, 0);
        let before = monitor.requester().hold_until_ns();
        let actions = end(&mut monitor, at(last_ns));
        let activated = actions.iter().filter(|it| matches!(it, Action::Activate(_))).count();
        assert_eq!(activated, left, "{name}");
        let hold = monitor.requester().hold_until_ns();
        // Nine periods, less the three from the first cycle with everything to the last.
        assert_eq!(last_ns - FIRST_NS, 3 * PERIOD_NS);
        let ended = Some(last_ns + 6 * PERIOD_NS);
        assert_eq!(hold, if left == 0 { before } else { ended }, "{name}");
    }
}

/// MON-45, MON-46: a loop that ticks only when something came would never notice that a station
/// is silent. With ticks the session ends; without, the next cycle says what was forgotten.
#[test]
fn who_ticks_only_when_something_came_is_told() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = Station::default();
    let last_ns = begin(&mut monitor, &mut station, 0);
    let silent = |monitor: &mut Monitor<'_>, now_ns: i64| {
        let world = World::at(now_ns);
        let (decision, _) = monitor.cycle(&inputs(&world, &None, &None));
        match decision {
            Decision::Safe { .. } => None,
            Decision::Unsafe { report, .. } => report.err().map(|it| (it.field, it.problem)),
        }
    };
    assert_ne!(monitor.configuration(), Configuration::Local);
    // The tick of this period belongs to the cycle before.
    assert_eq!(silent(&mut monitor, last_ns + PERIOD_NS), Some(("tick", Problem::NoTick)));
    assert_eq!(monitor.configuration(), Configuration::Local);
    // Nothing is remote any more, so that there is no silence to notice.
    assert_eq!(silent(&mut monitor, last_ns + 2 * PERIOD_NS), None);
}

/// MON-45: a tick whose time is not that of the cycle, or is before the cycle before, notices no silence in time.
#[test]
fn a_tick_of_another_time_is_none() {
    let dt_max_ns = settings().requester.dt_max_ns;
    for (periods, ago_ns, is_one) in [
        (1, 0, true),
        (1, 1, true),
        (2, dt_max_ns, true),
        (2, dt_max_ns + 1, false),
        (1, -1, false),
        (1, i64::MAX, false),
        // The clock was set back.
        (1, PERIOD_NS, true),
        (1, PERIOD_NS + 1, false),
        (-1, 0, false),
    ] {
        let cross_sections = road();
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.on(&cross_sections);
        let before_ns = begin(&mut monitor, &mut Station::default(), 0);
        let now_ns = before_ns + periods * PERIOD_NS;
        let _nothing = monitor.tick(at(now_ns.saturating_sub(ago_ns)));
        assert_ne!(monitor.configuration(), Configuration::Local, "{ago_ns} ns");
        let world = World::at(now_ns);
        let (decision, _) = monitor.cycle(&inputs(&world, &None, &None));
        assert_eq!(matches!(decision, Decision::Safe { .. }), is_one, "{ago_ns} ns: {decision:?}");
        assert_eq!(monitor.configuration() == Configuration::Local, !is_one, "{ago_ns} ns");
    }
}
