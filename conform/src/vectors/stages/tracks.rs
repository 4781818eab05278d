//! `spec/3-stages.md#stage-iii-trajectory-with-tracks`

use mufasa_model::input::cycle::{Cycle, Profile, Track};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::vectors::base::{NOW, TENTH, base, points_of, track, tracks, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, from, up_to};
use crate::vectors::expected::{fails_by, safe};
use crate::vectors::stages::collision::standing;

const PREDICTION: Topic =
    Topic::new("stages/tracks", "spec/3-stages.md#stage-iii-trajectory-with-tracks.1");
const HORIZON: Topic =
    Topic::new("stages/tracks", "spec/3-stages.md#stage-iii-trajectory-with-tracks.2");

/// Stage iii with one local track.
pub fn stage_iii(profile: Profile, track: Track) -> Cycle {
    with(base(profile, PlanRemote), |cycle| {
        cycle.tracks = Some(tracks(vec![track]));
        (cycle.detections, cycle.grid) = (None, None);
    })
}

/// Adds its vectors.
pub fn add(book: &mut Book) {
    prediction(book);
    horizon(book);
}

fn prediction(book: &mut Book) {
    for (name, profile) in [("paper", Profile::Paper), ("hardened", Profile::Hardened)] {
        let note = "A car from (10, -10) crosses the path at 10 m/s and meets the CAV; where it is \
                    now, it is in nobody's way.";
        let crossing = Track { vy: 10.0, ..track(1, 10.0, -10.0) };
        let expected =
            fails_by("iii", "collision").witness("iii", "point", 8).witness("iii", "track", 1);
        let cycle = stage_iii(profile, crossing);
        book.cycle(PREDICTION, &format!("crossing-{name}"), note, &cycle, &expected);
    }
    for (name, y, expected) in
        [("into-the-way", -2.5, fails_by("iii", "collision")), ("out-of-the-way", 1.5, safe())]
    {
        let note = "The list is 0.1 s old: since its stamp the car has moved on by 1 m.";
        let car = Track { vy: 10.0, ..track(1, 0.0, y) };
        let cycle = with(standing(Profile::Paper, car), |cycle| {
            cycle.tracks.iter_mut().for_each(|list| list.stamp_ns = NOW - TENTH);
        });
        book.cycle(PREDICTION, name, note, &cycle, &expected);
    }
    let sides = Sides {
        name: "backwards",
        note: "The point lies 125 ms before the stamp of the list, and the car is 8 m ahead at \
               vx m/s: it was at 8 - vx/8, and touches the CAV at 4 m.",
        edge: from(32.0),
        accepted: safe(),
        rejected: fails_by("iii", "collision"),
    };
    book.sides(PREDICTION, &sides, |vx| {
        with(standing(Profile::Paper, Track { vx, ..track(1, 8.0, 0.0) }), |cycle| {
            points_of(cycle).iter_mut().for_each(|point| point.t_ns = NOW - 125_000_000);
        })
    });
    let note = "The direction of a track does not follow its velocity: a car across the road that \
                slides along it stays across, and touches the CAV.";
    let sliding = Track { cos: 0.0, sin: 1.0, vx: 1.0, ..track(1, 2.0, 3.0) };
    let cycle = standing(Profile::Paper, sliding);
    book.cycle(PREDICTION, "direction-stays", note, &cycle, &fails_by("iii", "collision"));
}

fn horizon(book: &mut Book) {
    let sides = Sides {
        name: "s-cav",
        note: "A car that the CAV touches first at the point 15 m along; s_CAV = safety_time * 10 \
               m/s reaches that point when safety_time is 1.5 s.",
        edge: from(1.5),
        accepted: safe(),
        rejected: fails_by("iii", "collision").witness("iii", "point", 15),
    };
    book.sides(HORIZON, &sides, |safety_time| {
        with(stage_iii(Profile::Paper, track(1, 19.0, 0.0)), |cycle| {
            cycle.parameters.safety_time = safety_time;
        })
    });
    let note = "Touched at the point 18 m along: s_CAV = 1.8 s * 10 m/s, in doubles and exactly \
                18 m.";
    let cycle = stage_iii(Profile::Paper, track(1, 22.0, 0.0));
    book.cycle(HORIZON, "within", note, &cycle, &fails_by("iii", "collision"));
    let note = "Touched at the point 19 m along, behind s_CAV; the hardened profile looks one \
                point farther (H-04).";
    let cycle = stage_iii(Profile::Paper, track(1, 23.0, 0.0));
    book.cycle(HORIZON, "beyond", note, &cycle, &safe());
    let note = "Touched at the point 20 m along: beyond the horizon of both profiles.";
    let cycle = stage_iii(Profile::Hardened, track(1, 24.0, 0.0));
    book.cycle(HORIZON, "beyond-both", note, &cycle, &safe());
    let sides = Sides {
        name: "width",
        note: "A car 10 m ahead and y m aside: at y = 2 it touches the CAV when passed.",
        edge: up_to(2.0),
        accepted: safe(),
        rejected: fails_by("iii", "collision").witness("iii", "point", 6),
    };
    book.sides(HORIZON, &sides, |y| stage_iii(Profile::Paper, track(1, 10.0, y)));
}
