//! What a monitor is refused for because its cycles may be late (`spec/4-arithmetic.md#steps`).

use std::cell::RefCell;
use std::time::Duration;

use mufasa::cycle::steps::{Counts, Steps, most_steps};
use mufasa::input::cycle::{CrossSection, Cycle, Ego, Grid, Trajectory, TrajectoryPoint};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::{HardenedRule, Profile};
use mufasa::monitor::{Decision, GridMap, Inputs, Monitor, MonitorError, Settings};
use mufasa::offloading::requester::Groups;
use mufasa::report::{InvalidInput, Problem};
use mufasa::services::configuration::Configuration;
use mufasa_props::differential::runner;
use mufasa_props::lent::Lent;
use proptest::prelude::{Just, prop_oneof};
use proptest::{prop_assert, prop_assert_eq};

use super::kit::{MS, Station, World, at, road, route};

/// With steps of 1 ns.
fn within(steps: u64) -> Settings {
    let settings = Settings::new(Duration::from_millis(50));
    Settings { check_time: Duration::from_nanos(steps), step_ps: 1000, ..settings }
}

/// Memory for so many tracks, detections and cross sections.
fn memory([tracks, detections, cross_sections]: [usize; 3]) -> Lent {
    let mut lent = Lent::new(8, detections, cross_sections);
    lent.rows.truncate(tracks);
    lent.columns.truncate(tracks.max(detections + 4));
    lent
}

/// IMPL-11: the lists of docs/configuration.md in the time of the default, 15 ms, as the page says.
#[test]
fn the_recommended_lists_are_checked_in_time() {
    let settings = Settings::new(Duration::from_millis(50));
    let recommended = |settings| Monitor::new(settings, memory([128, 256, 528]).memory()).map(drop);
    assert_eq!(recommended(settings), Ok(()));
    let Err(MonitorError::TooSlow { steps, .. }) = recommended(within(1)) else {
        panic!("in time")
    };
    let said = format!("({:.2} ms)", 1e3 * Duration::from_nanos(steps).as_secs_f64());
    let page = include_str!("../../../docs/configuration.md");
    let lengths = "`cross_sections` 528, `blocks` `Block::needed(528)`";
    for said in [said.as_str(), "800,000 do not fit", lengths] {
        assert!(page.contains(said), "{said}");
    }
    let stages = Parameters { work_limit: 800_000, ..settings.stages };
    assert!(recommended(Settings { stages, ..settings }).is_err());
    let all = || Monitor::new(settings, memory([1024, 2048, 8192]).memory()).map(drop);
    assert!(matches!(all(), Err(MonitorError::TooSlow { most: 0, .. })));
    assert!(Monitor::new(settings.in_any_time(), memory([1024, 2048, 8192]).memory()).is_ok());
}

/// IMPL-11: 64 messages and a route count, too: a table of many stations is refused, since each message looks into it.
#[test]
fn messages_and_routes_between_two_cycles_count() {
    let check = |stations| Settings::new(Duration::from_millis(50)).check_lists(8, 8, 8, stations);
    let Err(MonitorError::TooSlow { list: "stations", most, .. }) = check(1_000_000) else {
        panic!("in time");
    };
    let most = usize::try_from(most).expect("an index");
    assert!(10_000 < most && check(most).is_ok() && check(most + 1).is_err(), "{most}");
    let of = |cross_sections, stations| {
        let counts = Counts { cross_sections, stations, ..Counts::default() };
        most_steps(&counts, &Parameters::default())
    };
    assert_eq!([of(0, 0).messages, of(0, 8).messages, of(0, 9).route], [8192, 11_264, 64]);
    assert_eq!(of(640, 0).route, 64 + 16 * 640);
    let sum = of(640, 8).total() - of(640, 0).total();
    assert_eq!(sum, 64 * 6 * 8);
}

/// IMPL-13: full lists of docs/configuration.md with its `tau`, a point each 0.1 s and cells of 0.2 m.
#[test]
fn the_recommended_lists_are_in_time_at_30_metres_a_second() {
    let (world, road, bits) = (World::at(0), road(), [0; 8]);
    let points: Vec<_> = (0..128_i32)
        .map(|i| TrajectoryPoint {
            t_ns: i64::from(i) * 100 * MS,
            x: world.ego.x + 3.0 * f64::from(i),
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
        })
        .collect();
    let settings = Settings::new(Duration::from_millis(50));
    let parameters = settings.stages;
    let ego = Ego { speed: 30.0, ..world.ego };
    let cycle = Cycle { parameters, ego, ..alone(&world, &road, &points, grid(0.2, &bits)) };
    let counts = Counts::of(&cycle);
    let full = Counts {
        tracks: 128,
        detections: 256,
        lists: 3,
        cross_sections: 528,
        stations: 8,
        ..counts
    };
    let ps = most_steps(&full, &parameters).total() * settings.step_ps;
    assert!(Duration::from_nanos(ps / 1000) <= settings.check_time, "{ps} ps, {full:?}");
}

/// IMPL-13, H-14.7, H-14.60: behind a short plan places count up to where the CAV stops, and of a plan that goes to and fro up
/// to the greatest length.
#[test]
fn no_places_count_behind_the_end_of_the_path() {
    let (world, road, bits) = (World::at(0), road(), [0; 8]);
    let places = |speed: f64, at: &dyn Fn(i32) -> [f64; 2], count: i32| {
        let point = |i: i32| {
            let ([x, y], t_ns) = (at(i), i64::from(i) * 50 * MS);
            TrajectoryPoint { t_ns, x: world.ego.x + x, y: world.ego.y + y, cos: 1.0, sin: 0.0 }
        };
        let points: Vec<_> = (0..count).map(point).collect();
        let ego = Ego { speed, ..world.ego };
        Counts::of(&Cycle { ego, ..alone(&world, &road, &points, grid(0.2, &bits)) }).places
    };
    let Parameters { tau, a_max, a_b, .. } = Parameters::default();
    let (v_tau, to_stop) = (30.0 + a_max * tau, |v: f64| v * v / (2.0 * a_b));
    let s_stop = 30.0 * tau + a_max * tau * tau / 2.0 + to_stop(v_tau);
    let straight = places(30.0, &|i| [f64::from(i), 0.0], 2);
    assert!(f64::from(straight) < 4.0 * s_stop + 20.0, "{straight} for {s_stop} m");
    let to_and_fro = places(1.0, &|i| [0.15, 0.8 * f64::from(i % 2)], 1000);
    assert!(to_and_fro < 60, "{to_and_fro}");
}

/// IMPL-13, H-14.27: a disk counts as wide as it may be where stage ii asks the widening, else as it is.
#[test]
fn disks_count_with_the_tolerance_where_stage_ii_asks_the_widening() {
    let (world, road, bits) = (World::at(0), road(), [0; 8]);
    let points = still(&world);
    let rows = |profile, lateral_tolerance| {
        let parameters = Parameters { lateral_tolerance, ..Parameters::default() };
        let cycle = alone(&world, &road, &points, grid(0.2, &bits));
        Counts::of(&Cycle { profile, parameters, ..cycle }).disk_rows
    };
    let of_width = |width: f64| {
        let across = (world.ego.length / 4.0).hypot(width);
        (0..100).rfind(|rows| f64::from(*rows) <= across / 0.2 + 7.0).expect("rows")
    };
    let (plain, wide) = (of_width(world.ego.width), of_width(world.ego.width + 1.0));
    assert!(plain < wide);
    assert_eq!([0.0, 0.5].map(|it| rows(Profile::HARDENED, it)), [plain, wide]);
    for rule in [HardenedRule::H07, HardenedRule::H14] {
        assert_eq!(rows(Profile::HARDENED.without(rule), 0.5), plain, "{rule:?}");
    }
    assert_eq!(rows(Profile::PAPER, 0.5), plain);
}

fn grid(resolution: f64, bits: &[u8; 8]) -> Grid<'_> {
    let (width, height) = (8, 8);
    let (x, y, cos, sin) = (0.0, 0.0, 1.0, 0.0);
    let (stamp_ns, unknown) = (0, None);
    Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied: bits, unknown }
}

/// A local plan with a grid, and nothing else.
fn alone<'a>(
    world: &World,
    road: &'a [CrossSection],
    points: &'a [TrajectoryPoint],
    grid: Grid<'a>,
) -> Cycle<'a> {
    Cycle {
        profile: Profile::HARDENED,
        parameters: Parameters::default(),
        now_ns: 0,
        configuration: Configuration::Local,
        ego: world.ego,
        trajectory: Some(Trajectory { stamp_ns: 0, points }),
        tracks: None,
        detections: None,
        lead: None,
        route: route(road),
        grid: Some(grid),
        detection_history: &[],
    }
}

/// IMPL-11, IMPL-12: as many steps as fit are taken, one more is refused; the list that is named is too long
/// by one.
#[test]
fn what_just_fits_is_taken_and_one_more_refused() {
    let lent = [30, 40, 2000];
    let error = within(1).check_lists(lent[0], lent[1], lent[2], 8).expect_err("too slow");
    let MonitorError::TooSlow { list, given, most, steps, most_steps } = error else {
        panic!("{error}");
    };
    assert_eq!((list, given, most, most_steps), ("cross_sections", 2000, 0, 1));
    assert!(Monitor::new(within(steps), memory(lent).memory()).is_ok());
    let shorter = within(steps - 1);
    let error = Monitor::new(shorter, memory(lent).memory()).expect_err("too slow by a step");
    let expected = MonitorError::TooSlow { list, given, most: 1999, steps, most_steps: steps - 1 };
    assert_eq!(error, expected);
    assert!(error.to_string().contains("cross_sections: memory for 2000 is too much by 1:"));
    assert!(Monitor::new(shorter, memory([30, 40, 1999]).memory()).is_ok());
    let twice = Settings { supervise_local: true, ..within(2 * steps) };
    assert!(Monitor::new(twice, memory(lent).memory()).is_ok());
    let twice = Settings { supervise_local: true, ..within(2 * steps - 1) };
    assert!(Monitor::new(twice, memory(lent).memory()).is_err());
}

/// IMPL-13: a trajectory that fits into no memory of the monitor, and a grid.
#[test]
fn a_cycle_that_may_be_late_is_refused() {
    let (world, road, bits) = (World::at(0), road(), [0; 8]);
    let points = still(&world);
    let now = at(0);
    let inputs =
        Inputs::new(now, world.ego).local_trajectory(now, &points).grid(now, map(0.01, &bits));
    let mut cycle = alone(&world, &road, &points, grid(0.01, &bits));
    cycle.parameters = within(1).stages;
    let counts = Counts { stations: 8, ..Counts::of(&cycle) };
    let total = most_steps(&counts, &cycle.parameters).total();
    for (steps, is_late) in [(total, false), (total - 1, true)] {
        let mut lent = memory([8, 8, road.len()]);
        let mut monitor = Monitor::new(within(steps), lent.memory()).expect("in time");
        monitor.set_route(&route(&road)).expect("a route");
        assert_eq!(problem(&mut monitor, &inputs), is_late.then_some(LATE));
    }
}

/// IMPL-13, INPUT-05, MON-12: what is invalid is named before what is too long, and the detections of a late cycle are
/// kept: half a second later a station is asked.
#[test]
fn a_cycle_that_may_be_late_is_a_cycle_all_the_same() {
    let (world, road, bits) = (World::at(0), road(), [0; 8]);
    let points = still(&world);
    let now = at(0);
    let inputs = |resolution: f64| {
        let inputs = Inputs::new(now, world.ego).detections(now, &world.detections);
        inputs.local_trajectory(now, &points).grid(now, map(resolution, &bits))
    };
    let lent = [8, 8, road.len()];
    let Err(MonitorError::TooSlow { steps, .. }) =
        within(1).check_lists(lent[0], lent[1], lent[2], 8)
    else {
        panic!("one step is enough");
    };
    let mut settings = within(steps).meaning("t_wait_ns");
    settings.requester.t_wait_ns = 0;
    for (resolution, field, requests) in [(0.01, "cells", 2), (0.0, "grid.resolution", 0)] {
        let mut lent = memory(lent);
        let mut monitor = Monitor::new(settings, lent.memory()).expect("in time");
        monitor.set_route(&route(&road)).expect("a route");
        let found = problem(&mut monitor, &inputs(resolution)).expect("an error");
        assert_eq!(found.field, field);
        assert_eq!(asked(&mut monitor, 600 * MS), requests, "{field}");
    }
}

/// How many requests a tick sends.
fn asked(monitor: &mut Monitor<'_>, now_ns: i64) -> usize {
    let mut station = Station::default();
    station.take(&monitor.offer(at(now_ns), 1, Groups::ALL).expect("a station"));
    station.take(&monitor.tick(at(now_ns)));
    station.asked.len()
}

const LATE: InvalidInput = InvalidInput { field: "cells", index: None, problem: Problem::TooMany };

/// A CAV that stands, in as many points as there may be.
fn still(world: &World) -> Vec<TrajectoryPoint> {
    let point = |i| TrajectoryPoint { t_ns: i * MS, x: world.ego.x, y: 0.0, cos: 1.0, sin: 0.0 };
    (0..1024_i64).map(point).collect()
}

fn map(resolution: f64, occupied: &[u8; 8]) -> GridMap<'_> {
    let (x, y, cos, sin, width, height) = (0.0, 0.0, 1.0, 0.0, 8, 8);
    GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown: None }
}

fn problem(monitor: &mut Monitor<'_>, inputs: &Inputs<'_>) -> Option<InvalidInput> {
    match monitor.cycle(inputs).0 {
        Decision::Unsafe { report: Err(problem), .. } => Some(problem),
        Decision::Unsafe { report: Ok(_), .. } | Decision::Safe { .. } => None,
    }
}

/// IMPL-10: each part beside the text. Only without objects the fail-safe rule has fewer than the table says: no motion.
#[test]
fn the_steps_of_a_cycle_are_those_of_the_table() {
    let few = |most: u32| prop_oneof![1 => Just(0), 3 => 0..=most];
    let lists = (few(1024), few(1024), few(2048), 0..=4_u32, few(8192), few(65_536));
    let rows = (few(100_000), few(3000), few(10_000), few(1_000_000));
    let cases = (
        lists,
        rows,
        0..=64_i64,
        0..=16_i64,
        prop_oneof![Just(0), Just(i64::MAX), 0..=1_000_000_i64],
    );
    let saw = RefCell::new([0_u32; 4]);
    let result = runner().run(&cases, |(lists, rows, n, miss_budget, work_limit)| {
        let (tracks, points, detections, lists, cross_sections, stations) = lists;
        let (places, disk_rows, cav_rows, way_rows) = rows;
        let miss_budget = miss_budget.min(tracks.into());
        let counts = Counts {
            tracks,
            points,
            detections,
            lists,
            cross_sections,
            stations,
            places,
            disk_rows,
            cav_rows,
            way_rows,
        };
        let parameters = Parameters { n, miss_budget, work_limit, ..Parameters::default() };
        let found = most_steps(&counts, &parameters);
        let [t, p, d, s, k, stations] =
            [tracks, points, detections, cross_sections, places, stations].map(u128::from);
        let [u, q, r, f] = [
            d * u128::from(lists),
            disk_rows.into(),
            (disk_rows + cav_rows).into(),
            way_rows.into(),
        ];
        let whole = |it: i64| u128::try_from(it).expect("not below 0");
        let [n, spare, limit] = [n, miss_budget, work_limit].map(whole);
        let columns = d + spare;
        let (m, b) = (t.max(columns), r / 57 + 3);
        let w = (t.min(columns).pow(2) * m).min(limit);
        let v = if q == 0 { 0 } else { (p + k) * (8 * r * b + n * (340 + 20 * q)) + 200 * f * b };
        let table = [
            64 * (128 + 6 * stations),
            64 + 16 * s,
            64 * t + t * t + 32 * p + 128 * d,
            1464 * (t + d) + 64 * u + 3 * t * (d + u) + 64 * (m + (w * m).isqrt()) + 3 * w,
            2048 * p + 64 * k + 32 * p * s + 2 * k * s,
            128 * p + 64 * t + 20 * p * t,
            128 * p + 64 * d + 20 * p * d,
            v,
            if q == 0 { 0 } else { v + 340 * n * (p + k) },
        ];
        let Steps {
            messages,
            route,
            input,
            stages: [i, ii, iii, iv, of_v],
            without_detections,
            fail_safe,
        } = found;
        let steps = [messages, route, input, i, ii, iii, iv, of_v, without_detections];
        prop_assert_eq!(steps.map(u128::from), table);
        let rule = 1024 * p + 224 * k + 10 * k * s + 4 * d * (t + d);
        let fail_safe = u128::from(fail_safe);
        let objects = u128::from(t + d > 0);
        let most = if k == 0 { 0 } else { rule + objects * (8192 + 32 * s) + limit };
        prop_assert!(fail_safe <= most && (limit > 0 || fail_safe == most), "{fail_safe}, {most}");
        let [messages, route, input, i, ii, iii, iv, v, without] = table;
        let all = messages + route + input + ii + iii + v + (i + iv).max(without) + fail_safe;
        prop_assert_eq!(u128::from(found.total()), all);
        let is = [
            t + d == 0 && k > 0,
            w == limit && w > 0,
            without > i + iv,
            fail_safe == most && limit > 0,
        ];
        saw.borrow_mut().iter_mut().zip(is).for_each(|(count, it)| *count += u32::from(it));
        Ok(())
    });
    assert_eq!(result, Ok(()));
    assert!(saw.borrow().iter().all(|it| *it >= 10), "{saw:?}");
}
