//! `spec/3-stages.md#stage-iv-trajectory-with-detections`

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::vectors::base::{base, detection, detections, lead, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, up_to};
use crate::vectors::expected::{fails_by, safe};

const STANDING: Topic =
    Topic::new("stages/detections", "spec/3-stages.md#stage-iv-trajectory-with-detections.1");
const FAILS: Topic =
    Topic::new("stages/detections", "spec/3-stages.md#stage-iv-trajectory-with-detections.2");

/// A detection x m ahead; a_b = 12.5 m/s^2: s_b = 4 m, and safety_time = 1 s: s_CAV = 10 m.
fn ahead(x: f64) -> Cycle {
    with(base(Profile::Paper, MotRemote), |cycle| {
        cycle.parameters.a_b = 12.5;
        cycle.parameters.safety_time = 1.0;
        cycle.tracks = None;
        cycle.detections = Some(detections(vec![detection(x, 0.0)]));
        cycle.grid = None;
    })
}

/// Adds its vectors.
pub fn add(book: &mut Book) {
    let note = "A detection stands still: the CAV touches it at the point 3 m along, whatever \
                moves.";
    let expected = fails_by("iv", "collision").stages("TP-Fa");
    let expected = expected.witness("iv", "point", 3).witness("iv", "detection", 0);
    book.cycle(STANDING, "stands-still", note, &ahead(7.0), &expected);
    let note = "A track says that the car drives away; in MotRemote stage iv takes the detection.";
    let cycle = with(ahead(7.0), |cycle| {
        let mut track = crate::vectors::base::track(1, 7.0, 0.0);
        track.vx = 20.0;
        cycle.tracks = Some(crate::vectors::base::tracks(vec![track]));
    });
    book.cycle(STANDING, "track-drives-away", note, &cycle, &fails_by("iv", "collision"));

    let sides = Sides {
        name: "without-lead",
        note: "Without a leading vehicle the horizon is s_b = 100 / (2 a_b); the detection is \
               touched at the point 4 m along, which s_b reaches up to a_b = 12.5 m/s^2.",
        edge: up_to(12.5),
        accepted: safe().stages("TP-PG"),
        rejected: fails_by("iv", "collision").witness("iv", "point", 4),
    };
    book.sides(FAILS, &sides, |a_b| with(ahead(8.0), |cycle| cycle.parameters.a_b = a_b));
    let sides = Sides {
        name: "behind-a-lead",
        note: "Behind a leading vehicle at 5 m/s the horizon is s_follow = 4 - 1 + 10 = 13 m when \
               its speed is 5 m/s; the detection is touched at the point 13 m along.",
        edge: up_to(5.0),
        accepted: safe(),
        rejected: fails_by("iv", "collision").witness("iv", "point", 13),
    };
    book.sides(FAILS, &sides, |speed| Cycle { lead: lead(100.0, speed), ..ahead(17.0) });
    let sides = Sides {
        name: "gap",
        note: "The gap against s_follow = max(4 - 1, 0) + 10 = 13 m: equality fails.",
        edge: up_to(13.0),
        accepted: safe(),
        rejected: fails_by("iv", "gap").witness("iv", "compared/1", "13"),
    };
    book.sides(FAILS, &sides, |gap| Cycle { lead: lead(gap, 5.0), ..ahead(60.0) });
    let sides = Sides {
        name: "gap-to-a-faster-one",
        note: "The leading vehicle is faster, so the difference of the braking distances counts as \
               0 and s_follow is s_CAV = 10 m.",
        edge: up_to(10.0),
        accepted: safe(),
        rejected: fails_by("iv", "gap").witness("iv", "compared/1", "10"),
    };
    book.sides(FAILS, &sides, |gap| Cycle { lead: lead(gap, 15.0), ..ahead(60.0) });
    let note = "Both rules are broken: the gap is the first and is named.";
    let cycle = Cycle { lead: lead(13.0, 5.0), ..ahead(7.0) };
    book.cycle(FAILS, "gap-first", note, &cycle, &fails_by("iv", "gap"));
    let note = "Detections are an empty list: stage iv runs, on the gap alone.";
    let mut cycle = Cycle { lead: lead(13.5, 5.0), ..ahead(60.0) };
    cycle.detections = Some(detections(vec![]));
    book.cycle(FAILS, "empty-list", note, &cycle, &safe().stages("TP-PG"));
}
