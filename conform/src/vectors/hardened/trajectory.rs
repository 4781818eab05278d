//! H-07, H-11, H-12: where and when a trajectory starts, its steps, whether it can be driven.

use mufasa_model::input::cycle::{CrossSection, Cycle, Route};

use crate::vectors::base::{TENTH, move_point, point, points, shift, straight, tracks, turn, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, above, below};
use crate::vectors::expected::{fails_by, safe};
use crate::vectors::hardened::plan;

const H_07: Topic = Topic::new("hardened/H-07", "H-07");
const H_11: Topic = Topic::new("hardened/H-11", "H-11");
const H_12: Topic = Topic::new("hardened/H-12", "H-12");

/// Adds their vectors.
pub fn add(book: &mut Book) {
    h_07(book);
    directions(book);
    h_11(book);
    turns(book);
    h_12(book);
    ends(book);
}

fn h_07(book: &mut Book) {
    for (name, by_ns, is_due) in [
        ("at-the-latest", TENTH, true),
        ("too-late", TENTH + 1, false),
        ("at-the-earliest", -TENTH, true),
        ("too-early", -TENTH - 1, false),
    ] {
        let note = "The first point is due within max_age of now.";
        let expected = if is_due { safe() } else { fails_by("ii", "start_time") };
        let cycle = plan(|cycle| shift(cycle, by_ns));
        book.cycle(H_07, name, note, &cycle, &expected);
    }
    for (name, age, limit) in
        [("start", 0, 2.0), ("start-past", TENTH, 3.0), ("start-future", -TENTH, 2.0)]
    {
        let sides = Sides {
            name,
            note: "The CAV is x m along the road, the trajectory starts at 0: at most \
                   start_tolerance + v_now max(now - t0, 0) apart.",
            edge: above(limit),
            accepted: safe(),
            rejected: fails_by("ii", "start_position"),
        };
        book.sides(H_07, &sides, |x| {
            plan(|cycle| {
                cycle.ego.x = x;
                shift(cycle, -age);
            })
        });
    }
    let sides = Sides {
        name: "corridor",
        note: "Point 9 lies y m beside the path, nearer than theta_map; the corridor has half \
               width 0.125 m.",
        edge: above(0.125),
        accepted: safe(),
        rejected: fails_by("ii", "corridor").witness("ii", "point", 9),
    };
    book.sides(H_07, &sides, |y| {
        plan(|cycle| {
            for cross_section in &mut cycle.route.cross_sections {
                (cross_section.left[1], cross_section.right[1]) = (0.125, -0.125);
            }
            move_point(cycle, 9, [9.0, y]);
        })
    });
}

fn directions(book: &mut Book) {
    for (name, cos, sin, is_allowed) in [
        ("along", 1.0, 0.0, true),
        ("across", 0.0, 1.0, true),
        ("just-against", -f64::MIN_POSITIVE, 1.0, false),
        ("against", -1.0, 0.0, false),
        ("clearly-along", 0.6, 0.8, true),
        ("clearly-against", -0.6, 0.8, false),
    ] {
        let note = "One point at rest, on a straight route: heading . segment >= 0.";
        let cycle = plan(|cycle| {
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(1, 1.0));
            turn(cycle, cos, sin);
        });
        let expected = if is_allowed { safe() } else { fails_by("ii", "direction") };
        book.cycle(H_07, name, note, &cycle, &expected);
    }
    let wide = |x: f64, y: f64| CrossSection { x, y, left: [x, y + 50.0], right: [x, y - 50.0] };
    for (name, at, cos, is_allowed) in [
        ("hairpin-forward", [0.0, 0.0], 1.0, true),
        ("hairpin-back", [0.0, 0.0], -1.0, true),
        ("hairpin-one-segment", [-1.0, -0.5], -1.0, false),
    ] {
        let note = "A hairpin at the origin: both segments are nearest there, and one that goes \
                    forward is enough; elsewhere there is one nearest segment.";
        let cycle = plan(|cycle| {
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(1, 1.0));
            let cross_sections = vec![wide(-20.0, 0.0), wide(0.0, 0.0), wide(-20.0, 1.0)];
            cycle.route = Route { closed: false, cross_sections };
            move_point(cycle, 0, at);
            turn(cycle, cos, 0.0);
        });
        let expected = if is_allowed { safe() } else { fails_by("ii", "direction") };
        book.cycle(H_07, name, note, &cycle, &expected);
    }
    for (name, cos, is_allowed) in [("ring-forward", 1.0, true), ("ring-back", -1.0, false)] {
        let note = "A closed route that ends where it begins: the closing segment of length 0 is \
                    no segment.";
        let cycle = plan(|cycle| {
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(1, 1.0));
            let corners =
                [(0.0, 0.0), (30.0, 0.0), (30.0, 20.0), (-30.0, 20.0), (-30.0, 0.0), (0.0, 0.0)];
            let cross_section =
                |(x, y): (f64, f64)| CrossSection { x, y, left: [x, 50.0], right: [x, -50.0] };
            let cross_sections = corners.into_iter().map(cross_section).collect();
            cycle.route = Route { closed: true, cross_sections };
            turn(cycle, cos, 0.0);
        });
        let expected = if is_allowed { safe() } else { fails_by("ii", "direction") };
        book.cycle(H_07, name, note, &cycle, &expected);
    }
}

/// Two points, the second `after_ns` later at (x, y) with a direction; the CAV stands and may be
/// anywhere, so that only H-11 speaks.
pub fn step(after_ns: i64, [x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> Cycle {
    plan(|cycle| {
        cycle.ego.speed = 0.0;
        cycle.parameters.a_b = 100.0;
        cycle.parameters.start_tolerance = 100.0;
        let mut last = point(after_ns, x, y);
        (last.cos, last.sin) = (cos, sin);
        cycle.trajectory = Some(points(vec![point(0, 0.0, 0.0), last]));
        cycle.tracks = Some(tracks(vec![]));
    })
}

fn h_11(book: &mut Book) {
    const AHEAD: [f64; 2] = [1.0, 0.0];
    for (name, after_ns, is_short) in
        [("time", 2 * TENTH, true), ("time-too-long", 2 * TENTH + 1, false)]
    {
        let note = "dt <= step_max = 200 ms.";
        let expected = if is_short { safe() } else { fails_by("ii", "step_time") };
        book.cycle(H_11, name, note, &step(after_ns, [1.0, 0.0], AHEAD), &expected);
    }
    for (name, after_ns, limit, rule) in
        [("length", TENTH, 4.0, "step_length"), ("speed", 20_000_000, 3.0, "step_speed")]
    {
        let sides = Sides {
            name,
            note: "A step of x m: at most L = 4 m and at most v_max dt (15 m in 0.1 s, 3 m in \
                   0.02 s).",
            edge: above(limit),
            accepted: safe(),
            rejected: fails_by("ii", rule).witness("ii", "point", 1),
        };
        book.sides(H_11, &sides, |x| step(after_ns, [x, 0.0], AHEAD));
    }
    let sides = Sides {
        name: "lateral",
        note: "A step of 1 m ahead and y m aside: at most W/2 = 1 m.",
        edge: above(1.0),
        accepted: safe(),
        rejected: fails_by("ii", "step_lateral"),
    };
    book.sides(H_11, &sides, |y| step(TENTH, [1.0, y], AHEAD));
    let sides = Sides {
        name: "forward",
        note: "A step of x m ahead and 0.5 m aside goes forward when x >= 0.",
        edge: below(0.0),
        accepted: safe(),
        rejected: fails_by("ii", "step_forward"),
    };
    book.sides(H_11, &sides, |x| step(TENTH, [x, 0.5], AHEAD));
    let note = "A step of length 0 goes nowhere, and passes in every model.";
    book.cycle(H_11, "no-step", note, &step(TENTH, [0.0, 0.0], AHEAD), &safe());
}

fn turns(book: &mut Book) {
    let turned = [0.9, -0.19_f64.sqrt()];
    for (name, to, expected) in [
        ("second-heading-forward", [0.1, 0.5], fails_by("ii", "step_forward")),
        ("both-headings-forward", [1.9, 0.1], safe()),
        ("second-heading-aside", [2.2, 0.0], safe()),
        ("second-heading-too-far-aside", [2.4, 0.0], fails_by("ii", "step_lateral")),
    ] {
        let note = "The second heading is (0.9, -0.436): both headings are asked.";
        book.cycle(H_11, name, note, &step(TENTH, to, turned), &expected);
    }
    let sides = Sides {
        name: "turn",
        note: "Headings (1, 0) and (cos, sqrt(1 - cos^2)): their dot product is at least the \
               double nearest to 0.866 (I-12).",
        edge: below(0.866),
        accepted: safe(),
        rejected: fails_by("ii", "step_turn"),
    };
    book.sides(H_11, &sides, |cos| {
        step(2 * TENTH, [1.931_85, 0.517_64], [cos, (1.0 - cos * cos).sqrt()])
    });
    for (name, x, a_b, expected) in [
        ("curve", 0.5201, 100.0, safe()),
        ("curve-too-tight", 0.5199, 100.0, fails_by("ii", "step_turn")),
        ("turn-on-the-spot", 0.0, 100.0, fails_by("ii", "step_turn")),
        ("swerve", 1.2, 8.401, safe()),
        ("swerve-too-hard", 1.2, 8.399, fails_by("ii", "step_turn")),
    ] {
        let note = "Headings (1, 0) and (0.96, 0.28): 0.28 = 0.5 * 0.52 + 0.1 * 0.2, and 0.28 * 1.2 = \
                    8.4 * 0.2^2.";
        let cycle =
            with(step(2 * TENTH, [x, 0.0], [0.96, 0.28]), |cycle| cycle.parameters.a_b = a_b);
        book.cycle(H_11, name, note, &cycle, &expected);
    }
    let note = "No time to turn, but none is needed.";
    book.cycle(H_11, "equal-headings", note, &step(1, [0.0, 0.0], [1.0, 0.0]), &safe());
}

/// One step of `after_ns` and x m at 10 m/s with a_b = 20 m/s^2 and room for long steps.
fn long_step(after_ns: i64, x: f64, change: impl FnOnce(&mut Cycle)) -> Cycle {
    let mut cycle = step(after_ns, [x, 0.0], [1.0, 0.0]);
    cycle.parameters.step_max_ns = 1_000_000_000;
    cycle.parameters.start_tolerance = 0.5;
    cycle.parameters.a_b = 20.0;
    (cycle.ego.length, cycle.ego.speed) = (40.0, 10.0);
    change(&mut cycle);
    cycle
}

fn h_12(book: &mut Book) {
    let half = 500_000_000;
    let sides = Sides {
        name: "shortest",
        note: "Braking with 20 m/s^2 from 10 m/s takes 0.5 s and 2.5 m; x m after 0.5 s are at \
               least 2.5 - start_tolerance = 2 m.",
        edge: below(2.0),
        accepted: safe(),
        rejected: fails_by("ii", "arc_too_short"),
    };
    book.sides(H_12, &sides, |x| long_step(half, x, |_| ()));
    let sides = Sides {
        name: "longest",
        note: "x m after 0.5 s are at most 5 + 3/8 + start_tolerance = 5.875 m.",
        edge: above(5.875),
        accepted: safe(),
        rejected: fails_by("ii", "arc_too_long"),
    };
    book.sides(H_12, &sides, |x| long_step(half, x, |_| ()));
    let sides = Sides {
        name: "shortest-after-standstill",
        note: "After standstill b(t) stays s_b = 2.5 m.",
        edge: below(2.0),
        accepted: safe(),
        rejected: fails_by("ii", "arc_too_short"),
    };
    book.sides(H_12, &sides, |x| long_step(2 * half, x, |_| ()));
    for (name, by_ns) in [("late", TENTH), ("early", -TENTH)] {
        for (limit, x, expected) in [
            ("shortest", 1.53, safe()),
            ("too-short", 1.52, fails_by("ii", "arc_too_short")),
            ("longest", 17.49, safe()),
            ("too-long", 17.51, fails_by("ii", "arc_too_long")),
        ] {
            let note = "The trajectory starts 0.1 s off now, a_max = 10 m/s^2: v_lo = 9 m/s and \
                        v_hi = 12 m/s, so x m after 1 s are from 81/40 - 0.5 to 12 + 5 + 0.5 m.";
            let cycle = long_step(2 * half, x, |cycle| {
                cycle.parameters.a_max = 10.0;
                shift(cycle, by_ns);
            });
            book.cycle(H_12, &format!("{name}-{limit}"), note, &cycle, &expected);
        }
    }
}

fn ends(book: &mut Book) {
    for (name, step, expected) in [
        ("stands-still", 0.0, fails_by("ii", "arc_too_short").witness("ii", "point", 3)),
        ("too-fast", 2.0, fails_by("ii", "arc_too_long").witness("ii", "point", 3)),
        ("brakes-gently", 0.5, safe()),
    ] {
        let note = "10 m/s: 10 t - 4 t^2 - 2 > 0 and 10 t + 1.5 t^2 + 2 < 20 t from t = 0.3 s on.";
        let cycle = plan(|cycle| cycle.trajectory = Some(straight(21, step)));
        book.cycle(H_12, name, note, &cycle, &expected);
    }
    for (name, count, expected) in
        [("long-enough", 14, safe()), ("ends-too-soon", 13, fails_by("ii", "ends_too_soon"))]
    {
        let note = "The last point has t >= v_lo / a_b = 1.25 s.";
        let cycle = plan(|cycle| cycle.trajectory = Some(straight(count, 1.0)));
        book.cycle(H_12, name, note, &cycle, &expected);
    }
    for (name, first) in [("end", 0.0), ("end-ahead", -1.0), ("end-behind", 1.0)] {
        let sides = Sides {
            name,
            note: "The last point is at most L = 4 m before s_stop, which is longer by the CAV's \
                   distance from the first point.",
            // 10 m/s, tau = 0.25 s, a_max = 4 m/s^2: 2.5 + 0.125 + 11^2 / 16 - 4, no rounding.
            edge: below(6.1875 + f64::max(2.0 * first, 0.0)),
            accepted: safe(),
            rejected: fails_by("ii", "arc_too_short"),
        };
        book.sides(H_12, &sides, |end| {
            plan(|cycle| {
                (cycle.parameters.tau, cycle.parameters.a_max) = (0.25, 4.0);
                cycle.parameters.start_tolerance = 5.0;
                let place = |i: i32| {
                    point(i64::from(i) * TENTH, (first + 0.75 * f64::from(i)).min(end), 0.0)
                };
                cycle.trajectory = Some(points((0..20).map(place).collect()));
            })
        });
    }
    for (name, count, expected) in [
        ("fifty-seconds", 251, safe()),
        ("below-fifty-seconds", 250, fails_by("ii", "ends_too_soon")),
    ] {
        let note = "Braking with 0.1 m/s^2 takes 100 s; 50 s are enough to end within L of s_stop.";
        let cycle = plan(|cycle| {
            cycle.parameters.a_b = 0.1;
            cycle.route = crate::vectors::base::road(-10.0, 600.0);
            cycle.tracks = Some(tracks(vec![]));
            let every = |i: i32| point(i64::from(i) * 2 * TENTH, f64::from(i) * 2.2, 0.0);
            cycle.trajectory = Some(points((0..count).map(every).collect()));
        });
        book.cycle(H_12, name, note, &cycle, &expected);
    }
}
