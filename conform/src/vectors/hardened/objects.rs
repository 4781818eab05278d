//! H-01, H-03, H-04, H-06, H-09: objects, horizons, cells, velocities.

use mufasa_model::input::cycle::{Cycle, Grid, Profile, Track, TrackList};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, MotRemote, PlanRemote,
};

use crate::vectors::base::{
    NOW, TENTH, base, cell, detection, detections, fine_grid, lead, point, points, straight, track,
    tracks, with,
};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, below, from, up_to};
use crate::vectors::expected::{fails_by, safe};
use crate::vectors::hardened::plan;
use crate::vectors::stages::grid::stage_v;
use crate::vectors::stages::track_validation::stage_i;

const H_01: Topic = Topic::new("hardened/H-01", "H-01");
const H_03: Topic = Topic::new("hardened/H-03", "H-03");
const H_04: Topic = Topic::new("hardened/H-04", "H-04");
const H_06: Topic = Topic::new("hardened/H-06", "H-06");
const H_09: Topic = Topic::new("hardened/H-09", "H-09");

/// Adds their vectors.
pub fn add(book: &mut Book) {
    h_01(book);
    h_03(book);
    h_04(book);
    h_06(book);
    h_09(book);
}

/// Six tracks on their detections but for one, `distance` m off; far clutter.
pub fn ghost_in_the_mean(profile: Profile, distance: f64, miss_budget: i64) -> Cycle {
    let places = [10.0, 20.0, 30.0, 40.0, 50.0, 60.0];
    let received = places.into_iter().zip(1..).map(|(x, id)| track(id, x, 0.0)).collect();
    let mut detected: Vec<_> = places.into_iter().map(|x| detection(x, 0.0)).collect();
    detected[4].y = distance;
    detected.push(detection(100.0, 100.0));
    with(stage_i(profile, received, detected), |cycle| cycle.parameters.miss_budget = miss_budget)
}

fn h_01(book: &mut Book) {
    let sides = Sides {
        name: "pair",
        note: "Track 5 is y m from its detection, in a mean that is far below theta_tr: every \
               matched pair must be closer than theta_track_max = 1 m.",
        edge: from(1.0),
        accepted: safe(),
        rejected: fails_by("i", "no_assignment").witness("i", "track", 5),
    };
    book.sides(H_01, &sides, |y| ghost_in_the_mean(Profile::Hardened, y, 0));
    let note = "With miss_budget = 1 the ghost may be missed, however far it is.";
    let cycle = ghost_in_the_mean(Profile::Hardened, 50.0, 1);
    book.cycle(H_01, "missed", note, &cycle, &safe());
    for (miss_budget, expected) in
        [(0, fails_by("i", "no_assignment").witness("i", "track", 2)), (1, safe()), (64, safe())]
    {
        let note = "Two gated tracks and one detection: k' = max(2 - miss_budget, 0).";
        let received = vec![track(1, 60.0, 0.0), track(2, 30.0, 0.0)];
        let cycle = with(stage_i(Profile::Hardened, received, vec![detection(60.0, 0.0)]), |c| {
            c.parameters.miss_budget = miss_budget;
        });
        book.cycle(H_01, &format!("surplus-{miss_budget}"), note, &cycle, &expected);
    }
    let note = "Of all choices of k' tracks the cheapest counts: the mean of both would be 0.25 m.";
    let received = vec![track(1, 30.0, 0.5), track(2, 60.0, 0.0)];
    let detected = vec![detection(30.0, 0.0), detection(60.0, 0.0)];
    let cycle = with(stage_i(Profile::Hardened, received, detected), |cycle| {
        cycle.parameters.miss_budget = 1;
    });
    book.cycle(H_01, "cheapest-choice", note, &cycle, &safe());
}

fn h_03(book: &mut Book) {
    let sides = Sides {
        name: "circumradii",
        note: "A lorry of 12 m drives ahead at the CAV's speed, its centre x m away, so that they \
               touch at x = 8 m; theta_obj is 5 m, the sum of the circumradii 8.3 m.",
        edge: up_to(8.0),
        accepted: safe(),
        rejected: fails_by("iii", "collision"),
    };
    let lorry = |x: f64| Track { length: 12.0, vx: 10.0, ..track(1, x, 0.0) };
    book.sides(H_03, &sides, |x| plan(|cycle| cycle.tracks = Some(tracks(vec![lorry(x)]))));
    let note = "The same lorry 7.9 m away.";
    let cycle = plan(|cycle| cycle.tracks = Some(tracks(vec![lorry(7.9)])));
    book.cycle(H_03, "lorry", note, &cycle, &fails_by("iii", "collision"));
}

fn h_04(book: &mut Book) {
    let start = |x: f64| {
        plan(|cycle| {
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(3, 1.0));
            cycle.tracks = Some(tracks(vec![track(1, x, 0.0)]));
        })
    };
    let note = "From rest s_stop = 0.02 m, and the next point counts: a first step into a car.";
    let expected = fails_by("iii", "collision").witness("iii", "point", 1);
    book.cycle(H_04, "first-step", note, &start(5.0), &expected);
    let note = "Only the second step would touch it.";
    book.cycle(H_04, "second-step", note, &start(6.0), &safe());
    let ahead = |x: f64| plan(|cycle| cycle.tracks = Some(tracks(vec![track(1, x, 0.0)])));
    let note = "s_CAV = 18 m, and the point 19 m along is the next one.";
    let expected = fails_by("iii", "collision").witness("iii", "point", 19);
    book.cycle(H_04, "next-point", note, &ahead(23.0), &expected);
    let note = "The point 20 m along is the next but one.";
    book.cycle(H_04, "next-but-one", note, &ahead(24.0), &safe());
    for (name, x, expected) in [
        ("s-stop", 112.0, fails_by("iii", "collision").witness("iii", "point", 27)),
        ("beyond-s-stop", 116.0, safe()),
    ] {
        let note = "40 m/s: s_CAV = 72 m, s_stop = 4.015 + 40.3^2/16 = 105.5 m, and one point more \
                    (108 m).";
        let cycle = plan(|cycle| {
            cycle.ego.speed = 40.0;
            cycle.trajectory = Some(straight(51, 4.0));
            cycle.route = crate::vectors::base::road(-100.0, 300.0);
            cycle.tracks = Some(tracks(vec![track(1, x, 0.0)]));
        });
        book.cycle(H_04, name, note, &cycle, &expected);
    }
    beyond(book);
    for (name, configuration) in [("mot", MotRemote), ("all", AllRemote), ("plan", PlanRemote)] {
        let name = format!("gap-{name}");
        let stages = match configuration {
            MotRemote => "DP-dP",
            AllRemote => "DPPdP",
            _ => "-PPoo",
        };
        let sides = Sides {
            name: &name,
            note: "No detections: stage iv does not run, but the gap is compared with s_follow = \
                   15 m at its place.",
            edge: up_to(15.0),
            accepted: safe().stages(stages),
            rejected: fails_by("iv", "gap"),
        };
        book.sides(H_04, &sides, |gap| {
            with(base(Profile::Hardened, configuration), |cycle| {
                cycle.parameters.safety_time = 1.5;
                cycle.lead = lead(gap, 10.0);
                cycle.detections = None;
            })
        });
    }
}

/// The CAV drives at 10 m/s and stands at 8 m; with these parameters s_stop = 10.1875 m.
fn ends_early(configuration: Configuration, change: impl FnOnce(&mut Cycle)) -> Cycle {
    with(base(Profile::Hardened, configuration), |cycle| {
        (cycle.parameters.tau, cycle.parameters.a_max) = (0.25, 4.0);
        let place = |i: i32| point(i64::from(i) * TENTH, (0.75 * f64::from(i)).min(8.0), 0.0);
        cycle.trajectory = Some(points((0..20).map(place).collect()));
        change(cycle);
    })
}

fn beyond(book: &mut Book) {
    let car = |cycle: &mut Cycle, x: f64| {
        cycle.tracks = Some(tracks(vec![track(1, x, 0.0)]));
        cycle.detections = Some(detections(vec![detection(x, 0.0)]));
    };
    let sides = Sides {
        name: "beyond",
        note: "The trajectory ends 2.1875 m before s_stop: the places beyond it are 0.25 to 2.25 m \
               farther, where the CAV touches a car up to 14.25 m.",
        edge: up_to(14.25),
        accepted: safe(),
        rejected: fails_by("iii", "collision").witness("iii", "point", 28),
    };
    book.sides(H_04, &sides, |x| ends_early(PlanRemote, |cycle| car(cycle, x)));
    let note = "The first place beyond the end.";
    let first = fails_by("iii", "collision").witness("iii", "point", 20);
    let cycle = ends_early(AllRemote, |cycle| car(cycle, 12.25));
    book.cycle(H_04, "beyond-first", note, &cycle, &first);
    let note = "A trajectory of the vehicle itself is examined only where it leads.";
    let cycle = ends_early(MotRemote, |cycle| car(cycle, 12.25));
    book.cycle(H_04, "beyond-local", note, &cycle, &safe());
    for (name, x, expected) in [
        ("offset", 14.5, fails_by("iii", "collision").witness("iii", "point", 29)),
        ("offset-clear", 14.501, safe()),
    ] {
        let note = "center_offset = 0.1 m: the multiples of 1/4 m from 0.25 to 2.5 m, the first that \
                    is not below 0.1 + 2.1875 m.";
        let cycle = ends_early(PlanRemote, |cycle| {
            cycle.ego.center_offset = 0.1;
            car(cycle, x);
        });
        book.cycle(H_04, &format!("beyond-{name}"), note, &cycle, &expected);
    }
    let note = "Without tracks stage iv sees the car.";
    let cycle = ends_early(PlanRemote, |cycle| {
        car(cycle, 14.25);
        cycle.tracks = None;
    });
    let expected = fails_by("iv", "collision").witness("iv", "point", 28);
    book.cycle(H_04, "beyond-detected", note, &cycle, &expected);
    let note = "Without tracks and detections stage v sees the cell from 12 to 13 m: the front disk \
                of radius 1.118 m is 1.5 m ahead of the CAV's centre.";
    let cycle = ends_early(PlanRemote, |cycle| {
        (cycle.tracks, cycle.detections) = (None, None);
        cycle.grid = Some(Grid { occupied: cell(24, 12), ..fine_grid() });
    });
    let expected = fails_by("v", "occupied").witness("v", "point", 25);
    book.cycle(H_04, "beyond-occupied", note, &cycle, &expected);
}

fn h_06(book: &mut Book) {
    let wide = |width: f64| {
        with(stage_v(Profile::Hardened, [3, 5]), |cycle| {
            (cycle.ego.length, cycle.ego.width) = (24.0, width);
            if let Some(grid) = &mut cycle.grid {
                (grid.x, grid.y) = (-24.0, -12.0);
                grid.occupied = cell(27, 17);
            }
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(2, 1.0));
        })
    };
    let sides = Sides {
        name: "whole-cell",
        note: "r = sqrt(9 + w^2/4) is 5 m at w = 8; the occupied square begins 5 m beside the \
               path.",
        edge: from(8.0),
        accepted: safe(),
        rejected: fails_by("v", "occupied"),
    };
    book.sides(H_06, &sides, wide);
    let unknown = |profile| {
        with(stage_v(profile, [0, 0]), |cycle| {
            if let Some(grid) = &mut cycle.grid {
                (grid.occupied, grid.unknown) = (vec![0; 120], Some(cell(15, 13)));
            }
        })
    };
    let note = "An unknown cell counts as occupied when stage iv did not run.";
    let cycle = unknown(Profile::Hardened);
    book.cycle(H_06, "unknown", note, &cycle, &fails_by("v", "unknown"));
    let note = "An unknown cell is free when stage iv ran.";
    let cycle = with(unknown(Profile::Hardened), |cycle| {
        cycle.detections = Some(detections(vec![detection(60.0, 0.0)]));
    });
    book.cycle(H_06, "unknown-after-iv", note, &cycle, &safe().stages("TP-PP"));
    let border = |y: f64| {
        with(stage_v(Profile::Hardened, [0, 0]), |cycle| {
            (cycle.ego.length, cycle.ego.width) = (24.0, 8.0);
            if let Some(grid) = &mut cycle.grid {
                (grid.x, grid.y) = (-24.0, y);
                (grid.occupied, grid.resolution) = (vec![0; 120], 2.0);
            }
        })
    };
    let sides = Sides {
        name: "outside",
        note: "The grid ends at y, and r = 5 m: places at distance <= r beyond its border count \
               as occupied.",
        edge: from(-5.0),
        accepted: safe(),
        rejected: fails_by("v", "outside"),
    };
    book.sides(H_06, &sides, border);
    let note = "Beyond the border is free when stage iv ran.";
    let cycle = with(border(-1.0), |cycle| {
        cycle.detections = Some(detections(vec![detection(60.0, 0.0)]));
    });
    book.cycle(H_06, "outside-after-iv", note, &cycle, &safe());
}

/// The one track stands at 60 m; the previous list, `dt_ns` older, has it at x.
pub fn with_previous(profile: Profile, dt_ns: i64, x: f64) -> Cycle {
    with(stage_i(profile, vec![track(1, 60.0, 0.0)], vec![detection(60.0, 0.0)]), |cycle| {
        let items = vec![track(1, x, 0.0)];
        cycle.previous_tracks = Some(TrackList { stamp_ns: NOW - dt_ns, items });
    })
}

fn h_09(book: &mut Book) {
    let half = 500_000_000;
    let sides = Sides {
        name: "velocity",
        note: "A standing track at 60 m was at x m half a second ago: theta_velocity dt = 1 m.",
        edge: below(59.0),
        accepted: safe(),
        rejected: fails_by("i", "velocity").witness("i", "track", 1),
    };
    book.sides(H_09, &sides, |x| with_previous(Profile::Hardened, half, x));
    let note = "Another id: nothing to compare with.";
    let cycle = with(with_previous(Profile::Hardened, half, 0.0), |cycle| {
        cycle.previous_tracks.iter_mut().for_each(|list| list.items[0].id = 2);
    });
    book.cycle(H_09, "other-id", note, &cycle, &safe());
    for (dt_ns, is_used) in
        [(-1, false), (0, false), (1, true), (1_000_000_000, true), (1_000_000_001, false)]
    {
        let note = "The previous list is used when 0 < dt <= 1 s.";
        let expected = if is_used { fails_by("i", "velocity") } else { safe() };
        let cycle = with_previous(Profile::Hardened, dt_ns, 0.0);
        book.cycle(H_09, &format!("dt-{dt_ns}"), note, &cycle, &expected);
    }
    let note = "Every received track is compared, those beyond the field of view too.";
    let cycle = with(with_previous(Profile::Hardened, half, 60.0), |cycle| {
        cycle.tracks.iter_mut().for_each(|list| list.items.push(track(2, 90.0, 0.0)));
        let far = track(2, 80.0, 0.0);
        cycle.previous_tracks.iter_mut().for_each(|list| list.items.push(far.clone()));
    });
    let expected = fails_by("i", "velocity").witness("i", "track", 2);
    book.cycle(H_09, "out-of-view", note, &cycle, &expected);
    let car = Track { vx: 30.0, ..track(1, 15.0, 0.0) };
    let new = |configuration| {
        with(base(Profile::Hardened, configuration), |cycle| {
            cycle.tracks = Some(tracks(vec![car.clone()]));
            cycle.detections = Some(detections(vec![detection(15.0, 0.0)]));
        })
    };
    let note = "A new track is examined standing still, too.";
    let expected = fails_by("iii", "collision_standing").witness("iii", "point", 11);
    book.cycle(H_09, "new", note, &new(AllRemote), &expected);
    let note = "A held track is examined as predicted only.";
    let held = with(new(AllRemote), |cycle| {
        let items = vec![track(1, 12.0, 0.0)];
        cycle.previous_tracks = Some(TrackList { stamp_ns: NOW - TENTH, items });
    });
    book.cycle(H_09, "held", note, &held, &safe());
    let note = "Stage i does not run: no id is held.";
    let cycle = with(held, |cycle| cycle.detections = None);
    book.cycle(H_09, "not-held", note, &cycle, &fails_by("iii", "collision_standing"));
    let note = "Tracks of the local MOT are not doubted.";
    book.cycle(H_09, "local", note, &new(PlanRemote), &safe());
}
