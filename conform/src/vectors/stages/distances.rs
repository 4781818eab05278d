//! `spec/3-stages.md#distances`

use mufasa_model::input::cycle::Profile;
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::vectors::base::{base, detection, detections, lead, move_point, points_of, track, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, from, up_to};
use crate::vectors::expected::{fails_by, refused, safe};
use crate::vectors::stages::tracks::stage_iii;

const SPEEDS: Topic = Topic::new("stages/distances", "spec/3-stages.md#distances.1");
const WITHIN: Topic = Topic::new("stages/distances", "spec/3-stages.md#distances.2");

/// Adds its vectors.
pub fn add(book: &mut Book) {
    speeds(book);
    within(book);
}

fn speeds(book: &mut Book) {
    for (name, speed, expected) in [
        ("v-now-zero", 0.0, safe()),
        ("v-now-minus-zero", -0.0, safe()),
        ("v-now-negative", -0.5, refused("ego.speed", None)),
    ] {
        let note = "v_now is a speed, at least 0.";
        let cycle = with(base(Profile::Paper, MotRemote), |cycle| cycle.ego.speed = speed);
        book.cycle(SPEEDS, name, note, &cycle, &expected);
    }
    for (name, speed, expected) in [
        ("v-lead-zero", 0.0, fails_by("iv", "gap").witness("iv", "compared/1", "24.25")),
        ("v-lead-negative", -0.5, refused("lead.speed", None)),
    ] {
        let note = "v_lead is a speed, at least 0: s_follow = 100/16 + 18 = 24.25 m at most, the \
                    gap is 24 m.";
        let cycle = with(base(Profile::Paper, MotRemote), |cycle| cycle.lead = lead(24.0, speed));
        book.cycle(SPEEDS, name, note, &cycle, &expected);
    }
    let note = "s_b = v^2 / (2 a_b) is 16 m at 16 m/s and 8 m/s^2: the point there is within.";
    let cycle = |x: f64| {
        with(base(Profile::Paper, MotRemote), |cycle| {
            cycle.ego.speed = 16.0;
            cycle.tracks = None;
            cycle.detections = Some(detections(vec![detection(x, 0.0)]));
            cycle.grid = None;
        })
    };
    let expected = fails_by("iv", "collision").witness("iv", "point", 16);
    book.cycle(SPEEDS, "s-b", note, &cycle(20.0), &expected);
    let note = "And the next one is not.";
    book.cycle(SPEEDS, "s-b-beyond", note, &cycle(21.0), &safe());
}

fn within(book: &mut Book) {
    let note = "At speed 0 every distance is 0; the first point is within it, and collides.";
    let at_rest =
        |x: f64| with(stage_iii(Profile::Paper, track(1, x, 0.0)), |cycle| cycle.ego.speed = 0.0);
    let expected = fails_by("iii", "collision").witness("iii", "point", 0);
    book.cycle(WITHIN, "first-point", note, &at_rest(4.0), &expected);
    let note = "At speed 0 the second point is not within, and only it would collide (F-06).";
    book.cycle(WITHIN, "second-point", note, &at_rest(5.0), &safe());
    let sides = Sides {
        name: "polyline",
        note: "3-4-5 zigzag: every step is 1.25 m long and moves on by 1 m, so the point at x = 4 \
               is 5 m along; s_CAV = 10 m/s * safety_time reaches it from 0.5 s on. The distance \
               as the crow flies would be 4 m.",
        edge: from(0.5),
        accepted: safe(),
        rejected: fails_by("iii", "collision").witness("iii", "point", 4),
    };
    book.sides(WITHIN, &sides, |safety_time| {
        with(stage_iii(Profile::Paper, track(1, 8.0, 0.0)), |cycle| {
            cycle.parameters.safety_time = safety_time;
            for point in points_of(cycle).iter_mut().skip(1).step_by(2) {
                point.y = 0.75;
            }
        })
    });
    let sides = Sides {
        name: "later-points",
        note: "The point 9 m along stands at (x, 0) instead of (9, 0), and is the first to touch \
               the car; its arc length is x, and s_CAV is 9 m.",
        edge: up_to(9.0).clear(0.25),
        accepted: safe(),
        rejected: fails_by("iii", "collision").witness("iii", "point", 9),
    };
    book.sides(WITHIN, &sides, |x| {
        with(stage_iii(Profile::Paper, track(1, 12.5, 0.0)), |cycle| {
            cycle.parameters.safety_time = 0.9;
            move_point(cycle, 9, [x, 0.0]);
        })
    });
}
