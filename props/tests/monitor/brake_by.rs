//! By when control has to brake (MON-40, finding F-47): what each trajectory that comes out
//! names, and that a CAV which obeys it stands before what stands ahead, one that does not hits it.

use std::cell::RefCell;

use mufasa::input::cycle::{CrossSection, Detection, Ego, Route, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::monitor::{Decision, Inputs, Message, Monitor, Settings, Time};
use mufasa::offloading::requester::{Group, Groups};
use mufasa::services::configuration::Configuration;
use mufasa_props::differential::runner;
use mufasa_props::strategy::draw::{Draw, long_tape, tape};

use super::kit::{Buffers, MS, Station, at, message, place, road, seconds, settings};

const LENGTH: f64 = 4.5;
/// From the reference point to the front edge.
const FRONT: f64 = 1.4 + LENGTH / 2.0;

fn ego(x: f64, speed: f64) -> Ego {
    Ego { x, y: 0.0, cos: 1.0, sin: 0.0, speed, length: LENGTH, width: 1.9, center_offset: 1.4 }
}

/// Sends what is asked for, at once.
fn confirmed(monitor: &mut Monitor<'_>, now: Time, groups: Groups) -> Station {
    let mut station = Station::default();
    station.take(&monitor.offer(now, 1, groups).expect("a station"));
    station.take(&monitor.tick(now));
    for (group, session) in std::mem::take(&mut station.asked) {
        station.take(&monitor.confirm(now, 1, group, session).expect("a station"));
    }
    station
}

/// A time in whole nanoseconds, rounded down, by its digits.
fn whole_ns(seconds: f64) -> i64 {
    format!("{:.0}", (seconds * 1e9).floor()).parse().expect("in the domain")
}

/// What the first trajectory that comes out at a time names, these groups being remote: on an empty road of 1 km,
/// which the CAV uses up fast, so that 6.5 s of trajectory reach s_stop for every tau of the domain.
fn named(profile: Profile, tau: f64, now_ns: i64, groups: Groups) -> Option<Time> {
    let mut settings = Settings { profile, ..settings() };
    settings.stages.tau = tau;
    settings.stages.a_max = 0.1;
    settings.stages.start_tolerance = 1e3;
    let section = |x| CrossSection { x, y: 0.0, left: [x, 3.0], right: [x, -3.0] };
    let cross_sections = [section(-100.0), section(900.0)];
    let mut buffers = Buffers::new(16, 2);
    let mut monitor = buffers.monitor(settings).expect("a monitor");
    monitor.set_route(&Route { closed: false, cross_sections: &cross_sections }).expect("a route");
    for ago in (1..=6).rev() {
        let before = at(now_ns - 100 * ago * MS);
        let _none = monitor.cycle(&Inputs::new(before, ego(0.0, 5.0)).detections(before, &[]));
    }
    let now = at(now_ns);
    let mut station = confirmed(&mut monitor, now, groups);
    let [mot, plan] = station.sessions;
    let point = |i: i32| TrajectoryPoint {
        t_ns: now_ns + i64::from(i) * 50 * MS,
        x: 4.0 * f64::from(i),
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
    };
    let points: Vec<TrajectoryPoint> = (0..130).map(point).collect();
    let tracks = mot.and_then(|session| {
        let arrival = monitor.tracks(now, message(session, now, Vec::new()));
        station.accepted(arrival.expect("a station"))
    });
    let remote_points = plan.and_then(|session| {
        let arrival = monitor.trajectory(now, message(session, now, points.clone()));
        station.accepted(arrival.expect("a station"))
    });
    let mut inputs = Inputs::new(now, ego(0.0, 5.0)).detections(now, &[]);
    inputs = match &tracks {
        Some(tracks) => inputs.remote_tracks(tracks),
        None => inputs.local_tracks(now, &[]),
    };
    inputs = match &remote_points {
        Some(points) => inputs.remote_trajectory(points),
        None => inputs.local_trajectory(now, &points),
    };
    let (decision, _actions) = monitor.cycle(&inputs);
    match decision {
        Decision::Safe { trajectory: Some(trajectory), .. } => trajectory.brake_by(),
        other => panic!("tau {tau} at {now_ns}: {other:?}"),
    }
}

/// Times of cycles: the clock may start anywhere. The last leave room for the points alone.
const TIMES: [i64; 7] = [
    0,
    -1,
    600 * MS,
    -7_000_000_000_000_000_000,
    i64::MIN + 61_000 * MS,
    i64::MAX - 61_000 * MS,
    i64::MAX - 6_500 * MS,
];

/// Some are no whole number of ns, and for some the product of doubles and the decimal differ.
const TAUS: [f64; 8] = [0.100_000_001, 0.25, 0.3, 0.290_000_000_9, 1.1, 6.499_999_999, 6.5, 60.0];

const GROUPS: [fn() -> Groups; 3] =
    [|| Groups::ALL, || Groups::from(Group::Mot), || Groups::from(Group::Plan)];

/// Whoever made the trajectory, the station or the CAV itself. MON-40, MON-41.
#[test]
fn a_trajectory_names_the_time_of_its_cycle_plus_tau() {
    let saturated = RefCell::new(0);
    let one = |tau: f64, now_ns: i64, groups: Groups| {
        let by_ns = now_ns.saturating_add(whole_ns(tau));
        let by = named(Profile::HARDENED, tau, now_ns, groups);
        assert_eq!(by, Some(at(by_ns)), "tau {tau} at {now_ns}, {groups:?}");
        assert_eq!(named(Profile::PAPER, tau, now_ns, groups), None, "the paper has no tau");
        *saturated.borrow_mut() += u32::from(now_ns.checked_add(whole_ns(tau)).is_none());
    };
    for tau in TAUS {
        TIMES.into_iter().for_each(|now_ns| GROUPS.iter().for_each(|it| one(tau, now_ns, it())));
    }
    let result = runner().run(&tape(), |tape| {
        let draw = &mut Draw::new(&tape);
        let fraction = f64::from(draw.bits()) / f64::from(u32::MAX);
        let tau = 0.100_000_1 + fraction * draw.pick(&[0.2, 2.0, 59.8]);
        let offset_ns = i64::from(draw.bits());
        let now_ns = draw.pick(&TIMES).saturating_sub(offset_ns).max(i64::MIN + 61_000 * MS);
        one(tau, now_ns, GROUPS[draw.below(3)]());
        Ok(())
    });
    assert_eq!(result, Ok(()));
    let saturated = saturated.into_inner();
    assert!(saturated > 10, "{saturated} were beyond the last time");
}

/// A CAV in one dimension.
#[derive(Clone, Copy, Debug)]
struct Car {
    x: f64,
    v: f64,
}

impl Car {
    /// After so long with this acceleration; it does not drive backwards.
    fn after(self, a: f64, s: f64) -> Self {
        let s = if a < 0.0 { s.min(self.v / -a) } else { s };
        Self { x: self.x + (self.v + a * s / 2.0) * s, v: (self.v + a * s).max(0.0) }
    }

    /// Where its front stands when it brakes now.
    fn stop(self, a_b: f64) -> f64 {
        self.x + FRONT + self.v * self.v / (2.0 * a_b)
    }

    fn point(self, t_ns: i64) -> TrajectoryPoint {
        TrajectoryPoint { t_ns, x: self.x, y: 0.0, cos: 1.0, sin: 0.0 }
    }
}

/// Speeds up, or goes on, towards a car that stands, and is seen from `sight` on.
#[derive(Clone, Copy, Debug)]
struct Drive {
    groups: Groups,
    first: Car,
    a: f64,
    wall: f64,
    sight: f64,
    /// From this cycle on the station is of use in one of so many cycles (1: in none).
    until: i64,
    now_and_then: usize,
    is_ahead: bool,
}

/// What a drive ends in.
#[derive(Default)]
struct End {
    verified: u32,
    /// Cycles that were safe with nothing examined.
    nothing: u32,
    /// How far beyond the rear of the car its front stands, m, where it was ever verified.
    beyond: Option<f64>,
}

/// Control drives on along what was verified; it brakes when nothing newer came by `brake_by`, or, where it does
/// not obey, as late as a period and tau after the first cycle that was unsafe or in `Local`.
fn end_of(it: Drive, draw: &mut Draw<'_>, obeys: bool) -> End {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.started_on(&cross_sections);
    let stages = settings().stages;
    let wall = Detection {
        x: it.wall + LENGTH / 2.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        length: LENGTH,
        width: 1.9,
    };
    let seen_from = |car: Car| {
        let is_seen = it.wall - car.x - FRONT <= it.sight;
        if is_seen { vec![wall] } else { Vec::new() }
    };
    for ago in (1..=6).rev() {
        let now = at(-100 * ago * MS);
        let before = Car { x: it.first.x + it.first.v * seconds(-100 * ago * MS), ..it.first };
        let seen = seen_from(before);
        let _none =
            monitor.cycle(&Inputs::new(now, ego(before.x, it.first.v)).detections(now, &seen));
    }
    let mut station = confirmed(&mut monitor, at(0), it.groups);
    let (mut car, mut end, mut brake_by_ns) = (it.first, End::default(), None);
    for i in 0..40_i64 {
        let now_ns = 100 * i * MS;
        let now = at(now_ns);
        station.take(&monitor.tick(now));
        let is_of_use = i < it.until || draw.one_in(it.now_and_then);
        let stamp = if is_of_use { now } else { at(now_ns + 1_000 * MS) };
        let comes = is_of_use || it.is_ahead;
        let seen = seen_from(car);
        let points = (0..30).map(|k| {
            let later_ns = 100 * k * MS;
            car.after(it.a, seconds(later_ns)).point(now_ns + later_ns)
        });
        let [mot, plan] = [Group::Mot, Group::Plan].map(|it| station.sessions[place(it)]);
        let tracks = mot.filter(|_| comes).and_then(|session| {
            let new = Message { stamp, ..message(session, now, Vec::new()) };
            let arrival = monitor.tracks(now, new);
            station.accepted(arrival.expect("a station"))
        });
        let points = plan.filter(|_| comes).and_then(|session| {
            let new = Message { stamp, ..message(session, now, points.collect::<Vec<_>>()) };
            let arrival = monitor.trajectory(now, new);
            station.accepted(arrival.expect("a station"))
        });
        let mut inputs = Inputs::new(now, ego(car.x, car.v)).detections(now, &seen);
        if let Some(tracks) = &tracks {
            inputs = inputs.remote_tracks(tracks);
        }
        if let Some(points) = &points {
            inputs = inputs.remote_trajectory(points);
        }
        let is_remote = monitor.configuration() != Configuration::Local;
        let (decision, actions) = monitor.cycle(&inputs);
        station.take(&actions);
        match decision {
            Decision::Safe { trajectory: Some(trajectory), .. } => {
                end.verified += 1;
                brake_by_ns = trajectory.brake_by().filter(|_| obeys).map(Time::as_nanoseconds);
            }
            Decision::Safe { .. } if is_remote => end.nothing += 1,
            Decision::Safe { .. } | Decision::Unsafe { .. } if end.verified == 0 => return end,
            Decision::Safe { .. } | Decision::Unsafe { .. } => {
                // Its own planner brakes, at the latest by then.
                let by_ns = now_ns + whole_ns(stages.tau) - 100 * MS;
                let by_ns = brake_by_ns.unwrap_or(by_ns).max(now_ns);
                car = car.after(it.a, seconds(by_ns - now_ns));
                break;
            }
        }
        if end.verified == 0 {
            return end;
        }
        let until_ns = brake_by_ns.unwrap_or(i64::MAX).clamp(now_ns, now_ns + 100 * MS);
        car = car.after(it.a, seconds(until_ns - now_ns));
        car = car.after(-stages.a_b, seconds(now_ns + 100 * MS - until_ns));
    }
    end.beyond = Some(car.stop(stages.a_b) - it.wall);
    end
}

/// Domain: 2 to 14 m/s, up to a_max, a car that stands up to 45 m ahead and is seen from where it matters at the
/// latest, no lead measured, tracks emptied or none. Not covered: objects that move, bends. MON-42.
#[test]
fn who_brakes_by_then_hits_nothing_and_who_does_not_hits_what_stands() {
    let hits = RefCell::new([0; 4]);
    let result = runner().run(&(tape(), long_tape()), |(drive, steps)| {
        let draw = &mut Draw::new(&drive);
        let mut fraction = || f64::from(draw.bits()) / f64::from(u32::MAX);
        let v = 2.0 + 12.0 * fraction();
        let (near, wall) = (fraction(), FRONT + 45.0 * fraction());
        let a_max = settings().stages.a_max;
        let a = (2.0 * a_max * fraction()).min(a_max);
        let it = Drive {
            groups: draw.pick(&[Groups::ALL, Groups::from(Group::Plan)]),
            first: Car { x: 0.0, v },
            a,
            wall,
            // s_stop is below 27 m up to 20 m/s.
            sight: 27.0 + 20.0 * near,
            until: i64::try_from(draw.between(1, 12)).expect("a few"),
            now_and_then: draw.pick(&[1, 1, 3, 8]),
            is_ahead: draw.one_in(2),
        };
        let [obeys, drives_on] =
            [true, false].map(|it_obeys| end_of(it, &mut Draw::new(&steps), it_obeys));
        let hits = &mut *hits.borrow_mut();
        if let Some(beyond) = obeys.beyond {
            hits[0] += 1;
            hits[1] += u32::from(obeys.nothing > 0);
            assert!(beyond < 0.0, "{it:?}: {beyond} m too far");
        }
        hits[2] += u32::from(drives_on.beyond.is_some_and(|beyond| beyond >= 0.0));
        // Not that it brakes at the first chance: it may come near.
        hits[3] += u32::from(obeys.beyond.is_some_and(|beyond| beyond > -1.0));
        Ok(())
    });
    let hits @ [drives, nothing, hit, near] = hits.into_inner();
    println!(
        "drives, with cycles of nothing, hit without brake_by, nearer than 1 m with it: {hits:?}"
    );
    assert_eq!(result, Ok(()));
    assert!(nothing > drives / 4 && hit > 0 && near > 0, "{hits:?}");
}
