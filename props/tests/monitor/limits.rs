//! What a monitor is refused for, and what does not fit into its memory.

use std::time::Duration;

use mufasa::input::cycle::{Detection, Ego, Route};
use mufasa::input::profile::{HardenedRule, Profile};
use mufasa::monitor::{Decision, Gap, Inputs, Message, Monitor, MonitorError, Settings};
use mufasa::offloading::requester::{Group, Groups, RequesterError};
use mufasa::report::{InvalidInput, Problem};
use mufasa::services::configuration::Configuration;

use super::kit::{Buffers, MS, Station, World, at, inputs, message, road, route, settings};

fn refused(settings: Settings) -> (MonitorError, String) {
    let mut buffers = Buffers::new(16, 40);
    let error = buffers.monitor(settings).expect_err("refused");
    (error, error.to_string())
}

/// MON-22: equality is refused; the default bears a lost message.
#[test]
fn a_dt_max_that_is_not_above_the_period_is_refused() {
    let period = Duration::from_millis(100);
    let default = Settings::new(period);
    assert_eq!(default.requester.dt_max_ns, 220 * MS);
    assert!(Buffers::new(16, 40).monitor(default).is_ok());
    let mut equal = default;
    equal.requester.dt_max_ns = 100 * MS;
    let (error, words) = refused(equal);
    assert_eq!(error, MonitorError::DtMaxNotAbovePeriod { dt_max_ns: 100 * MS, period });
    assert!(words.contains("dt_max_ns = 100000000") && words.contains("jitter"), "{words}");
    let mut by_a_nanosecond = equal;
    by_a_nanosecond.requester.dt_max_ns += 1;
    assert!(Buffers::new(16, 40).monitor(by_a_nanosecond).is_ok());
    assert_eq!(refused(Settings::new(Duration::ZERO)).0, MonitorError::NoPeriod);
    let (dt_max_ns, period) = (i64::MAX, Duration::MAX);
    let forever = MonitorError::DtMaxNotAbovePeriod { dt_max_ns, period };
    assert_eq!(refused(Settings::new(Duration::MAX)).0, forever);
}

/// MON-27: equality is refused, in the hardened profile alone, and in a study with one of the two rules that reckon the way to stop.
#[test]
fn a_tau_that_is_not_above_the_period_is_refused() {
    let period = Duration::from_millis(100);
    let with = |profile, tau| {
        let mut settings = Settings { profile, ..settings() }.meaning("tau");
        settings.stages.tau = tau;
        settings
    };
    for tau in [0.1, 0.0] {
        let (error, words) = refused(with(Profile::HARDENED, tau));
        assert_eq!(error, MonitorError::TauNotAbovePeriod { tau, period });
        assert!(words.contains(&format!("tau = {tau} s")) && words.contains("0.1 s:"), "{words}");
        assert!(Buffers::new(16, 40).monitor(with(Profile::PAPER, tau)).is_ok());
    }
    assert!(Buffers::new(16, 40).monitor(with(Profile::HARDENED, 0.1_f64.next_up())).is_ok());
    let [without_h04, without_h14] =
        [HardenedRule::H04, HardenedRule::H14].map(|rule| Profile::HARDENED.without(rule));
    for profile in [without_h04, without_h14] {
        let tau = 0.1;
        assert_eq!(refused(with(profile, tau)).0, MonitorError::TauNotAbovePeriod { tau, period });
    }
    let neither = without_h04.without(HardenedRule::H14);
    assert!(Buffers::new(16, 40).monitor(with(neither, 0.1)).is_ok());
}

/// IMPL-11: places count with each of the two rules that look at them, and without both not.
#[test]
fn places_count_where_a_rule_looks_at_them() {
    let check_time = Duration::ZERO;
    let steps =
        |profile| match (Settings { profile, check_time, ..settings() }).check_lists(8, 8, 8, 8) {
            Err(MonitorError::TooSlow { steps, .. }) => steps,
            other => panic!("{other:?}"),
        };
    let [without_h04, without_h14] =
        [HardenedRule::H04, HardenedRule::H14].map(|rule| Profile::HARDENED.without(rule));
    let all = steps(Profile::HARDENED);
    assert_eq!([without_h04, without_h14].map(steps), [all; 2]);
    assert!(steps(without_h04.without(HardenedRule::H14)) < all);
}

/// MON-23, MON-29: "or a parameter outside its domain".
#[test]
fn parameters_outside_of_their_domain_are_refused() {
    let mut wrong = settings();
    wrong.stages.a_b = f64::NAN;
    let (error, words) = refused(wrong);
    assert!(matches!(error, MonitorError::Stages(InvalidInput { field: "parameters.a_b", .. })));
    assert!(words.contains("a_b") && words.contains("finite"), "{words}");
    let mut wrong = settings();
    wrong.requester.t_wait_ns = -1;
    let field = "t_wait_ns";
    let below = MonitorError::Requester(RequesterError::NegativeParameter { field });
    assert_eq!(refused(wrong).0, below);
    for sessions_before in [-1, i64::MAX] {
        let wrong = Settings { sessions_before, ..settings() };
        assert_eq!(refused(wrong).0, MonitorError::SessionsBefore { sessions_before });
    }
    let last = Settings { sessions_before: i64::MAX - 1, ..settings() };
    assert!(Buffers::new(16, 40).monitor(last).is_ok());
}

/// MON-26: equality is no error, and the defaults are far from it.
#[test]
fn a_max_age_below_l_max_is_refused() {
    let with = |max_age_ns, l_max_ns| {
        let mut settings = settings();
        settings.stages.max_age_ns = max_age_ns;
        settings.requester.l_max_ns = l_max_ns;
        settings
    };
    let (max_age_ns, l_max_ns) = (100 * MS, 100 * MS + 1);
    let (error, words) = refused(with(max_age_ns, l_max_ns));
    assert_eq!(error, MonitorError::MaxAgeBelowLMax { max_age_ns, l_max_ns });
    assert!(words.contains("max_age_ns = 100000000") && words.contains("100000001"), "{words}");
    assert!(Buffers::new(16, 40).monitor(with(100 * MS, 100 * MS)).is_ok());
    let default = settings();
    assert_eq!((default.stages.max_age_ns, default.requester.l_max_ns), (100 * MS, 50 * MS));
}

/// Sets a time, ns.
type Change = fn(&mut Settings, i64);

/// MON-24, MON-25: milliseconds given for nanoseconds; 0 is no slip.
#[test]
fn times_below_a_millisecond_are_refused_and_zero_is_not() {
    let changes: [(&str, Change); 6] = [
        ("stages.max_age_ns", |it, ns| it.stages.max_age_ns = ns),
        ("stages.step_max_ns", |it, ns| it.stages.step_max_ns = ns),
        ("requester.t_wait_ns", |it, ns| it.requester.t_wait_ns = ns),
        ("requester.request_timeout_ns", |it, ns| it.requester.request_timeout_ns = ns),
        ("requester.l_max_ns", |it, ns| it.requester.l_max_ns = ns),
        ("requester.dt_max_ns", |it, ns| it.requester.dt_max_ns = ns),
    ];
    for (field, change) in changes {
        let with = |ns| {
            let mut wrong = settings();
            change(&mut wrong, ns);
            wrong
        };
        let least_ns = if field == "requester.t_wait_ns" { 1_000 * MS } else { MS };
        for ns in [1, 100, 10_000, least_ns - 1] {
            let (error, words) = refused(with(ns));
            assert_eq!(error, MonitorError::TimeTooShort { field, ns });
            assert!(words.contains(field) && words.contains("unit"), "{words}");
        }
        // dt_max has to be above the period anyway.
        if field != "requester.dt_max_ns" {
            for ns in [0, least_ns] {
                let mut right = with(ns);
                right.requester.l_max_ns = right.requester.l_max_ns.min(right.stages.max_age_ns);
                assert!(Buffers::new(16, 40).monitor(right).is_ok(), "{field} {ns}");
            }
        }
    }
    let period = Duration::from_nanos(100);
    let short = MonitorError::TimeTooShort { field: "period", ns: 100 };
    assert_eq!(refused(Settings { period, ..settings() }).0, short);
}

/// MON-21, IMPL-08: memory that can never be enough is refused at once.
#[test]
fn too_little_memory_is_refused_by_name() {
    let without = |change: fn(&mut Buffers), profile| {
        let mut buffers = Buffers::new(16, 40);
        change(&mut buffers);
        let made = buffers.monitor(Settings { profile, ..settings() });
        made.err().map(|error| match error {
            MonitorError::Memory { field, needed, given } => (field, needed, given),
            other => panic!("{other}"),
        })
    };
    let stations = without(|it| it.0.stations.clear(), Profile::PAPER);
    assert_eq!(stations, Some(("stations", 1, 0)));
    let few = without(|it| it.0.detections.truncate(11), Profile::HARDENED);
    assert_eq!(few, Some(("detections", 12, 11)));
    let slots = without(|it| it.0.slots.truncate(207), Profile::HARDENED);
    assert_eq!(slots, Some(("slots", 208, 207)));
    let rows = without(|it| it.0.rows.clear(), Profile::PAPER);
    assert_eq!(rows, Some(("rows", 1, 0)));
    let columns = without(|it| it.0.columns.truncate(9), Profile::PAPER);
    assert!(matches!(columns, Some(("columns", needed, 9)) if needed > 9), "{columns:?}");
    let mut few = Buffers::new(16, 40);
    few.0.columns.truncate(9);
    let words = few.monitor(settings()).expect_err("too few").to_string();
    assert!(words.contains("scratch::Sizes::for_cycle"), "{words}");
    let nothing = |it: &mut Buffers| (it.0.detections.clear(), it.0.slots.clear()).1;
    assert_eq!(without(nothing, Profile::PAPER), None, "nothing is kept in this profile");
}

/// MON-18: memory for the cross sections alone is too little for a route.
#[test]
fn a_route_without_room_for_its_index_is_refused() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, cross_sections.len());
    buffers.0.blocks.pop();
    let mut monitor = buffers.monitor(settings()).expect("memory");
    let told = monitor.set_route(&Route { closed: false, cross_sections: &cross_sections });
    let (field, problem) = ("route", Problem::ScratchTooSmall);
    assert_eq!(told, Err(InvalidInput { field, index: None, problem }));
}

/// MON-19: a list of detections that could not be kept makes its own cycle
/// unsafe, and one item fewer does not.
#[test]
fn a_list_of_detections_that_does_not_fit_is_an_error() {
    let cross_sections = road();
    for (items, fits) in [(16, true), (17, false)] {
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.on(&cross_sections);
        let world = World::at(0);
        let detections: Vec<Detection> = world.detections.into_iter().cycle().take(items).collect();
        let inputs = Inputs::new(at(0), world.ego).detections(at(0), &detections);
        match monitor.cycle(&inputs).0 {
            Decision::Safe { .. } => assert!(fits),
            Decision::Unsafe { report, .. } => {
                let (field, problem) = ("detections.items", Problem::ScratchTooSmall);
                assert!(!fits);
                assert_eq!(report, Err(InvalidInput { field, index: None, problem }));
                assert_eq!(monitor.requester().hold_until_ns(), Some(10_000 * MS));
            }
        }
    }
}

/// MON-18: the route before stays; without any no cycle is safe.
#[test]
fn a_route_that_does_not_fit_or_is_invalid_changes_nothing() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, cross_sections.len());
    let mut monitor = buffers.monitor(settings()).expect("a monitor");
    let world = World::at(0);
    let inputs = Inputs::new(at(0), world.ego);
    let nowhere = Inputs::new(at(0), Ego { x: f64::NAN, ..world.ego });
    match monitor.cycle(&nowhere).0 {
        Decision::Unsafe { report: Err(error), .. } => assert_eq!(error.field, "ego.x"),
        decision => panic!("{decision:?}"),
    }
    match monitor.cycle(&inputs).0 {
        Decision::Unsafe { report, .. } => {
            let error = report.expect_err("no route");
            assert_eq!((error.field, error.problem), ("route", Problem::NoRoute));
            assert!(error.to_string().contains("no route was set"), "{error}");
        }
        decision @ Decision::Safe { .. } => panic!("{decision:?}"),
    }
    assert_eq!(monitor.set_route(&route(&cross_sections)), Ok(()));
    let mut longer = cross_sections.clone();
    longer.push(mufasa::input::cycle::CrossSection { x: 500.0, ..cross_sections[0] });
    let refused = monitor.set_route(&route(&longer)).expect_err("one too many");
    assert_eq!((refused.field, refused.problem), ("route", Problem::ScratchTooSmall));
    let mut invalid = cross_sections.clone();
    invalid[3].y = f64::NAN;
    assert_eq!(monitor.set_route(&route(&invalid)).map_err(|it| it.index), Err(Some(3)));
    assert!(matches!(monitor.cycle(&inputs).0, Decision::Safe { .. }), "the first one");
    let shorter = Route { closed: false, cross_sections: &cross_sections[..2] };
    assert_eq!(monitor.set_route(&shorter), Ok(()));
}

/// Times at the limits of 64 bits, forwards and backwards, with every input, in one monitor and each alone:
/// no panic, and data that are not current never come out.
#[test]
fn times_at_the_limits_of_64_bits_do_no_harm() {
    let cross_sections = road();
    let times = [i64::MIN, i64::MIN + 1, -1, 0, 1, i64::MAX - 1, i64::MAX];
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut came_out = 0;
    for (now_ns, stamp_ns) in
        times.iter().flat_map(|now_ns| times.map(|stamp_ns| (*now_ns, stamp_ns)))
    {
        came_out += i32::from(comes_out(&mut monitor, now_ns, stamp_ns));
        let mut buffers = Buffers::new(16, 40);
        let mut alone = buffers.started_on(&cross_sections);
        came_out += i32::from(comes_out(&mut alone, now_ns, stamp_ns));
    }
    assert!(came_out >= 5, "{came_out}");
}

/// Whether tracks come out that a station sends at a time.
fn comes_out(monitor: &mut Monitor<'_>, now_ns: i64, stamp_ns: i64) -> bool {
    let world = World::at(0);
    let (now, stamp) = (at(now_ns), at(stamp_ns));
    let before = at(now_ns.saturating_sub(500 * MS));
    let seen = Inputs::new(before, world.ego).detections(before, &world.detections);
    let _decided = monitor.cycle(&seen);
    let mut station = Station::default();
    station.take(&monitor.offer(now, 1, Groups::ALL).expect("a station"));
    station.take(&monitor.tick(now));
    for (group, session) in Group::ALL.into_iter().zip(station.sessions) {
        let Some(session) = session else { continue };
        let _done = monitor.confirm(now, 1, group, session).expect("a station");
    }
    let items = world.tracks.clone();
    let session = station.sessions[0].unwrap_or(0);
    let message = Message { station: 1, session, generated: stamp, stamp, items };
    let tracks = monitor.tracks(now, message).expect("a station");
    let tracks = station.accepted(tracks);
    let mut inputs = Inputs::new(now, world.ego)
        .detections(stamp, &world.detections)
        .lead(stamp, Gap::between_bumpers(20.0), 5.0)
        .local_trajectory(stamp, &world.points);
    if let Some(tracks) = &tracks {
        inputs = inputs.remote_tracks(tracks);
    }
    let (Decision::Safe { tracks: Some(tracks), .. }, _) = monitor.cycle(&inputs) else {
        return false;
    };
    let age = i128::from(now_ns) - i128::from(tracks.stamp_ns);
    assert!((0..=i128::from(100 * MS)).contains(&age));
    true
}

/// MON-30: results that are made in time and that no cycle can use, because they
/// are too old, end their session like silence; at the bound they are used.
#[test]
fn results_that_no_cycle_can_use_end_their_session() {
    let cross_sections = road();
    let max_age_ns = settings().stages.max_age_ns;
    let mut activated = 0;
    for (age_ns, is_used) in [
        (0, true),
        (max_age_ns, true),
        (max_age_ns + 1, false),
        (50_000 * MS, false),
        (i64::MAX / 2, false),
    ] {
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.on(&cross_sections);
        let mut station = Station::default();
        for i in 0..20 {
            let world = World::at(100 * i * MS);
            let now = at(world.now_ns);
            let (tracks, points) = if i < 5 {
                station.period(&mut monitor, &world)
            } else {
                station.take(&monitor.tick(now));
                let [mot, plan] = station.sessions;
                let Some((mot, plan)) = mot.zip(plan) else { break };
                let tracks = message(mot, now, world.tracks.clone());
                let tracks = monitor.tracks(now, tracks).expect("a station");
                let stamp = at(world.now_ns - age_ns);
                let points = Message { stamp, ..message(plan, now, world.points.clone()) };
                let points = monitor.trajectory(now, points).expect("a station");
                (station.accepted(tracks), station.accepted(points))
            };
            assert_eq!(points.is_some(), i > 0 && (i < 5 || is_used), "{age_ns} in period {i}");
            let (Decision::Safe { trajectory, .. }, actions) =
                monitor.cycle(&inputs(&world, &tracks, &points))
            else {
                panic!("nothing is wrong with what is used");
            };
            assert_eq!(trajectory.is_some(), points.is_some());
            station.take(&actions);
        }
        let is_remote = monitor.configuration() == Configuration::AllRemote;
        assert_eq!(is_remote, is_used, "{age_ns}");
        activated += usize::from(station.released > 0);
    }
    assert_eq!(activated, 3);
}

/// A monitor that refuses an offer is the one that never got it.
#[test]
fn an_offer_that_is_refused_changes_nothing() {
    let road = road();
    let asked = [false, true].map(|is_told| {
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.on(&road);
        let _none = monitor.area(at(0), Groups::ALL);
        for station in 1..=8 {
            assert!(monitor.offer(at(0), station, Groups::ALL).expect("there is room").is_empty());
        }
        if is_told {
            let full = RequesterError::TableFull { station: 9, capacity: 8 };
            assert_eq!(monitor.offer(at(0), 9, Groups::ALL), Err(full));
            let wrong = RequesterError::Station { station: 0 };
            assert_eq!(monitor.offer(at(0), 0, Groups::ALL), Err(wrong));
            assert_eq!(monitor.lost(at(0), 0), Err(wrong));
        }
        let table = monitor.requester().stations().to_vec();
        (monitor.tick(at(0)).to_vec(), table)
    });
    assert_eq!(asked[0].0.len(), 2, "both groups are asked for");
    assert_eq!(asked[0], asked[1]);
}
