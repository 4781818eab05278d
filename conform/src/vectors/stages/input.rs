//! `spec/3-stages.md#invalid-input`: values outside the domain of `spec/4-arithmetic.md#domain`.

use mufasa_model::input::cycle::{Cycle, Profile, TrackList};
use mufasa_model::services::configuration::Configuration::{
    AllRemote, Local, MotRemote, PlanRemote,
};

use crate::vectors::base::{NOW, base, detection, lead, track, tracks, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::{invalid_remote, refused, safe};

const DOMAIN: Topic = Topic::new("stages/input", "spec/3-stages.md#invalid-input.2");
const SIDES: Topic = Topic::new("stages/input", "spec/3-stages.md#invalid-input.3");
const NUMBERS: Topic =
    Topic::new("stages/input", "spec/4-arithmetic.md#conformance-of-an-implementation.4");

/// Ten minutes, ns: more than the minute within which times have to be.
const LONG: i64 = 600_000_000_000;

/// A field with its index, and how to spoil it.
type Spoilt = (&'static str, Option<usize>, fn(&mut Cycle));

/// Local whatever the configuration.
const ALWAYS_LOCAL: [Spoilt; 48] = [
    ("parameters.theta_tr", None, |c| c.parameters.theta_tr = 0.9e-3),
    ("parameters.theta_map", None, |c| c.parameters.theta_map = 1e3_f64.next_up()),
    ("parameters.theta_obj", None, |c| c.parameters.theta_obj = f64::NAN),
    ("parameters.a_b", None, |c| c.parameters.a_b = 0.1_f64.next_down()),
    ("parameters.safety_time", None, |c| c.parameters.safety_time = -f64::MIN_POSITIVE),
    ("parameters.max_age_ns", None, |c| c.parameters.max_age_ns = 60_000_000_001),
    ("parameters.n", None, |c| c.parameters.n = 0),
    ("parameters.theta_track_max", None, |c| c.parameters.theta_track_max = f64::INFINITY),
    ("parameters.miss_budget", None, |c| c.parameters.miss_budget = 65),
    ("parameters.tau", None, |c| c.parameters.tau = 60.0_f64.next_up()),
    ("parameters.a_max", None, |c| c.parameters.a_max = 100.0_f64.next_up()),
    ("parameters.start_tolerance", None, |c| c.parameters.start_tolerance = 0.0),
    ("parameters.v_max", None, |c| c.parameters.v_max = 0.0),
    ("parameters.step_max_ns", None, |c| c.parameters.step_max_ns = -1),
    ("parameters.theta_velocity", None, |c| c.parameters.theta_velocity = 0.0),
    ("parameters.delta", None, |c| c.parameters.delta = 1e-8_f64.next_down()),
    ("ego.x", None, |c| c.ego.x = 16_777_216.0_f64.next_up()),
    ("ego.y", None, |c| c.ego.y = f64::NAN),
    ("ego.cos", None, |c| c.ego.cos = 1.000_001),
    ("ego.sin", None, |c| c.ego.sin = f64::NEG_INFINITY),
    ("ego.speed", None, |c| c.ego.speed = 150.0_f64.next_up()),
    ("ego.length", None, |c| c.ego.length = 0.01_f64.next_down()),
    ("ego.width", None, |c| c.ego.width = 100.0_f64.next_up()),
    ("ego.center_offset", None, |c| c.ego.center_offset = -100.0_f64.next_up()),
    ("lead.gap", None, |c| c.lead.iter_mut().for_each(|lead| lead.gap = -1e-300)),
    ("lead.speed", None, |c| c.lead.iter_mut().for_each(|lead| lead.speed = f64::NAN)),
    ("lead.stamp_ns", None, |c| c.lead.iter_mut().for_each(|lead| lead.stamp_ns = NOW + LONG)),
    ("route.stations.y", Some(1), |c| c.route.cross_sections[1].y = f64::NAN),
    ("route.stations.left", Some(1), |c| c.route.cross_sections[1].left[1] = f64::INFINITY),
    ("route.stations.right", Some(0), |c| c.route.cross_sections[0].right[0] = 1e9),
    ("route.stations", None, |c| c.route.cross_sections.truncate(1)),
    ("route.stations.x", Some(1), |c| {
        c.route.cross_sections[1] = c.route.cross_sections[0].clone();
    }),
    ("grid.x", None, |c| c.grid.iter_mut().for_each(|grid| grid.x = f64::NAN)),
    ("grid.cos", None, |c| c.grid.iter_mut().for_each(|grid| grid.cos = 0.0)),
    ("grid.resolution", None, |c| c.grid.iter_mut().for_each(|grid| grid.resolution = 11.0)),
    ("grid.width", None, |c| c.grid.iter_mut().for_each(|grid| grid.width = 0)),
    ("grid.height", None, |c| c.grid.iter_mut().for_each(|grid| grid.height = 32_769)),
    ("grid.occupied", None, |c| c.grid.iter_mut().for_each(|grid| grid.occupied.truncate(3))),
    ("grid.unknown", None, |c| c.grid.iter_mut().for_each(|grid| grid.unknown = Some(vec![]))),
    ("grid.stamp_ns", None, |c| c.grid.iter_mut().for_each(|grid| grid.stamp_ns = i64::MAX)),
    ("detections.items.x", Some(0), |c| {
        c.detections.iter_mut().for_each(|list| list.items[0].x = f64::NAN);
    }),
    ("detections.items.cos", Some(1), |c| {
        c.detections.iter_mut().for_each(|list| list.items[1].cos = 0.5);
    }),
    ("detections.items.length", Some(1), |c| {
        c.detections.iter_mut().for_each(|list| list.items[1].length = 101.0);
    }),
    ("detections.items.width", Some(0), |c| {
        c.detections.iter_mut().for_each(|list| list.items[0].width = 0.0);
    }),
    ("detections.stamp_ns", None, |c| {
        c.detections.iter_mut().for_each(|list| list.stamp_ns = i64::MAX);
    }),
    ("previous_tracks.items.vx", Some(0), |c| {
        c.previous_tracks.iter_mut().for_each(|list| list.items[0].vx = 151.0);
    }),
    ("previous_tracks.items.id", Some(1), |c| {
        c.previous_tracks.iter_mut().for_each(|list| list.items.push(track(1, 0.0, 0.0)));
    }),
    ("previous_tracks.stamp_ns", None, |c| {
        c.previous_tracks.iter_mut().for_each(|list| list.stamp_ns = NOW + LONG);
    }),
];

const TRACKS: [Spoilt; 7] = [
    ("tracks.items.x", Some(0), |c| c.tracks.iter_mut().for_each(|t| t.items[0].x = f64::NAN)),
    ("tracks.items.cos", Some(0), |c| c.tracks.iter_mut().for_each(|t| t.items[0].cos = 0.99)),
    ("tracks.items.vx", Some(0), |c| c.tracks.iter_mut().for_each(|t| t.items[0].vx = 151.0)),
    ("tracks.items.vy", Some(0), |c| c.tracks.iter_mut().for_each(|t| t.items[0].vy = -151.0)),
    ("tracks.items.width", Some(0), |c| c.tracks.iter_mut().for_each(|t| t.items[0].width = 0.0)),
    ("tracks.items.id", Some(1), |c| {
        c.tracks.iter_mut().for_each(|t| t.items.push(track(1, 0.0, 0.0)));
    }),
    ("tracks.stamp_ns", None, |c| c.tracks.iter_mut().for_each(|t| t.stamp_ns = NOW + LONG)),
];

const TRAJECTORY: [Spoilt; 6] = [
    ("trajectory.points", None, |c| c.trajectory.iter_mut().for_each(|t| t.points.clear())),
    ("trajectory.points.x", Some(7), |c| {
        c.trajectory.iter_mut().for_each(|t| t.points[7].x = f64::NEG_INFINITY);
    }),
    ("trajectory.points.cos", Some(4), |c| {
        c.trajectory.iter_mut().for_each(|t| t.points[4].sin = 0.01);
    }),
    ("trajectory.points.t_ns", Some(4), |c| {
        c.trajectory.iter_mut().for_each(|t| t.points[4].t_ns = t.points[3].t_ns);
    }),
    ("trajectory.points.t_ns", Some(20), |c| {
        c.trajectory.iter_mut().for_each(|t| t.points[20].t_ns = NOW + LONG);
    }),
    ("trajectory.stamp_ns", None, |c| {
        c.trajectory.iter_mut().for_each(|t| t.stamp_ns = NOW + LONG);
    }),
];

/// Adds its vectors.
pub fn add(book: &mut Book) {
    outside(book);
    ends(book);
    order(book);
}

fn whole(
    profile: Profile,
    configuration: mufasa_model::services::configuration::Configuration,
) -> Cycle {
    with(base(profile, configuration), |cycle| {
        cycle.lead = lead(90.0, 10.0);
        cycle.detections.iter_mut().for_each(|list| list.items.push(detection(80.0, 9.0)));
        let items = vec![track(1, 60.0, 0.0)];
        cycle.previous_tracks = Some(TrackList { stamp_ns: NOW - 1, items });
    })
}

fn outside(book: &mut Book) {
    let note = "A local value outside of its domain, or a list that breaks a rule, is an error.";
    for (field, index, spoil) in ALWAYS_LOCAL {
        let cycle = with(whole(Profile::Paper, AllRemote), spoil);
        book.cycle(DOMAIN, &format!("local-{field}"), note, &cycle, &refused(field, index));
    }
    let remote_note = "In remote data it makes the cycle unsafe.";
    for (list, configuration, spoilt) in [
        ("tracks", PlanRemote, TRACKS.as_slice()),
        ("trajectory", MotRemote, TRAJECTORY.as_slice()),
    ] {
        for (place, (field, index, spoil)) in spoilt.iter().enumerate() {
            let cycle = with(whole(Profile::Paper, configuration), spoil);
            let name = format!("local-{field}-{place}");
            book.cycle(SIDES, &name, note, &cycle, &refused(field, *index));
            let cycle = with(whole(Profile::Paper, AllRemote), spoil);
            let expected = invalid_remote(field, *index).stages("aaaaa");
            book.cycle(SIDES, &format!("remote-{field}-{place}"), remote_note, &cycle, &expected);
        }
        let (field, index, spoil) = spoilt[0];
        let cycle = with(whole(Profile::Hardened, Local), spoil);
        let note = "In Local everything is local.";
        book.cycle(SIDES, &format!("in-local-{list}"), note, &cycle, &refused(field, index));
    }
    let note = "Invalid remote data: of the stages the scheduled ones are skipped.";
    let cycle = with(whole(Profile::Hardened, MotRemote), TRACKS[0].2);
    let expected = invalid_remote("tracks.items.x", Some(0)).stages("aa-aa");
    book.cycle(SIDES, "remote-in-mot-remote", note, &cycle, &expected);
    for (name, number) in
        [("nan", f64::NAN), ("inf", f64::INFINITY), ("minus-inf", f64::NEG_INFINITY)]
    {
        let note = "What is no finite number is invalid, locally an error, remotely unsafe.";
        let cycle = with(whole(Profile::Paper, AllRemote), |cycle| cycle.ego.speed = number);
        book.cycle(NUMBERS, &format!("local-{name}"), note, &cycle, &refused("ego.speed", None));
        let cycle = with(whole(Profile::Paper, AllRemote), |cycle| {
            cycle.tracks.iter_mut().for_each(|list| list.items[0].vy = number);
        });
        let expected = invalid_remote("tracks.items.vy", Some(0));
        book.cycle(NUMBERS, &format!("remote-{name}"), note, &cycle, &expected);
    }
}

fn ends(book: &mut Book) {
    let inside: [Spoilt; 10] = [
        ("theta_tr", None, |c| c.parameters.theta_tr = 1e3),
        ("theta_map", None, |c| c.parameters.theta_map = 1e-3),
        ("n", None, |c| c.parameters.n = 64),
        ("v_max", None, |c| c.parameters.v_max = 1000.0),
        ("delta", None, |c| c.parameters.delta = 1e-2),
        ("gap", None, |c| c.lead = lead(1e6, 150.0)),
        ("direction", None, |c| c.ego.cos = 1.000_000_4),
        ("velocity", None, |c| {
            c.tracks.iter_mut().for_each(|list| list.items[0].vx = 150.0);
        }),
        ("id", None, |c| c.tracks.iter_mut().for_each(|list| list.items[0].id = i64::MIN)),
        ("stamp", None, |c| {
            c.lead.iter_mut().for_each(|lead| lead.stamp_ns = NOW + 60_000_000_000);
        }),
    ];
    let note = "The ends of a domain are inside.";
    for (name, _, change) in inside {
        let cycle = with(whole(Profile::Paper, AllRemote), change);
        book.cycle(DOMAIN, &format!("end-{name}"), note, &cycle, &safe());
    }
    let note = "Local data older than 60 s count as missing, but their values are checked.";
    let old = |cycle: &mut Cycle| {
        cycle.detections.iter_mut().for_each(|list| list.stamp_ns = i64::MIN);
    };
    let cycle = with(whole(Profile::Paper, AllRemote), old);
    book.cycle(DOMAIN, "old-local", note, &cycle, &safe().stages("DPPoo"));
    let cycle = with(whole(Profile::Paper, AllRemote), |cycle| {
        old(cycle);
        cycle.detections.iter_mut().for_each(|list| list.items[0].x = f64::NAN);
    });
    let expected = refused("detections.items.x", Some(0));
    book.cycle(DOMAIN, "old-local-invalid", note, &cycle, &expected);
    let note = "A remote list older than 60 s is invalid, a local one is missing.";
    let old = |cycle: &mut Cycle| {
        cycle.tracks.iter_mut().for_each(|list| list.stamp_ns = NOW - 60_000_000_001);
    };
    let cycle = with(whole(Profile::Paper, AllRemote), old);
    book.cycle(SIDES, "old-remote", note, &cycle, &invalid_remote("tracks.stamp_ns", None));
    let cycle = with(whole(Profile::Paper, PlanRemote), old);
    book.cycle(SIDES, "old-local-tracks", note, &cycle, &safe().stages("-PTP-"));
    let note = "A closed route may end where it begins.";
    let cycle = with(whole(Profile::Paper, PlanRemote), |cycle| {
        cycle.route.closed = true;
        let first = cycle.route.cross_sections[0].clone();
        cycle.route.cross_sections.push(first);
    });
    book.cycle(DOMAIN, "closed-route", note, &cycle, &safe());
    for (name, count, expected) in
        [("1024-tracks", 1024, safe()), ("1025-tracks", 1025, refused("tracks.items", None))]
    {
        let note = "At most 1024 tracks.";
        let cycle = with(whole(Profile::Paper, PlanRemote), |cycle| {
            let far = |id: i32| track(id.into(), 500.0, f64::from(id));
            cycle.tracks = Some(tracks((0..count).map(far).collect()));
        });
        book.cycle(DOMAIN, name, note, &cycle, &expected);
    }
}

fn order(book: &mut Book) {
    let note = "The first in the order parameters, ego, lead, route, grid, detections, previous \
                tracks, tracks, trajectory; everything from the named one on is spoilt.";
    let spoilt: [Spoilt; 9] = [
        ("parameters.n", None, |c| c.parameters.n = 0),
        ("ego.x", None, |c| c.ego.x = f64::NAN),
        ("lead.gap", None, |c| c.lead = lead(-1.0, 0.0)),
        ("route.stations.x", Some(0), |c| c.route.cross_sections[0].x = f64::NAN),
        ("grid.x", None, |c| c.grid.iter_mut().for_each(|grid| grid.x = f64::NAN)),
        ALWAYS_LOCAL[40],
        ("previous_tracks.items.x", Some(0), |c| {
            c.previous_tracks.iter_mut().for_each(|list| list.items[0].x = f64::NAN);
        }),
        TRACKS[0],
        TRAJECTORY[1],
    ];
    for (first, (field, index, _)) in spoilt.iter().enumerate() {
        let cycle = with(whole(Profile::Paper, Local), |cycle| {
            spoilt[first..].iter().for_each(|(_, _, spoil)| spoil(cycle));
        });
        book.cycle(DOMAIN, &format!("order-{field}"), note, &cycle, &refused(field, *index));
    }
    let both = |cycle: &mut Cycle| {
        TRACKS[0].2(cycle);
        TRAJECTORY[1].2(cycle);
    };
    let note = "Local problems come before remote ones, whatever their place in the order.";
    let cycle = with(whole(Profile::Paper, MotRemote), both);
    let expected = refused("trajectory.points.x", Some(7));
    book.cycle(SIDES, "local-before-remote", note, &cycle, &expected);
    let cycle = with(whole(Profile::Paper, AllRemote), both);
    let expected = invalid_remote("tracks.items.x", Some(0));
    book.cycle(SIDES, "tracks-before-trajectory", note, &cycle, &expected);
}
