//! `spec/3-stages.md#low-level-collision-check-llcc`

use mufasa_model::input::cycle::{Cycle, Profile, Track};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::vectors::base::{base, straight, track, tracks, turn, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, below, from, up_to};
use crate::vectors::expected::{fails_by, safe};

/// A CAV at rest with one point at the origin, and one local track.
pub fn standing(profile: Profile, track: Track) -> Cycle {
    with(base(profile, PlanRemote), |cycle| {
        cycle.ego.speed = 0.0;
        cycle.trajectory = Some(straight(1, 1.0));
        cycle.tracks = Some(tracks(vec![track]));
        (cycle.detections, cycle.grid) = (None, None);
    })
}

const EXAMINED: Topic =
    Topic::new("stages/collision", "spec/3-stages.md#low-level-collision-check-llcc.1");
const COLLISION: Topic =
    Topic::new("stages/collision", "spec/3-stages.md#low-level-collision-check-llcc.2");

/// Adds its vectors.
pub fn add(book: &mut Book) {
    let collision = || fails_by("iii", "collision").witness("iii", "point", 0);
    let sides = Sides {
        name: "theta-obj",
        note: "A lorry of 12 m whose centre is x m ahead overlaps the CAV in any case; it is \
               examined when x < theta_obj = 5 m (F-03, closed by H-03).",
        edge: below(5.0),
        accepted: safe().stages("-PPo-"),
        rejected: collision(),
    };
    book.sides(EXAMINED, &sides, |x| {
        standing(Profile::Paper, Track { length: 12.0, ..track(1, x, 0.0) })
    });
    for (name, center_offset, cos, expected) in [
        ("offset", 2.5, 1.0, collision().witness("iii", "compared/0", "4")),
        ("no-offset", 0.0, 1.0, safe()),
        ("offset-behind", -2.5, 1.0, safe()),
        ("offset-turned", 2.5, -1.0, safe()),
    ] {
        let note = "A car 6.5 m ahead of the pose; the CAV's rectangle is shifted along its \
                    heading by center_offset, and its centre is what theta_obj is compared with.";
        let cycle = with(standing(Profile::Paper, track(1, 6.5, 0.0)), |cycle| {
            cycle.ego.center_offset = center_offset;
            turn(cycle, cos, 0.0);
        });
        book.cycle(EXAMINED, name, note, &cycle, &expected);
    }
    // Hardened, a place ahead of the CAV is examined, too (H-04).
    for (name, profile, edge) in
        [("paper", Profile::Paper, up_to(4.0)), ("hardened", Profile::Hardened, from(-4.0))]
    {
        let name = format!("touching-{name}");
        let sides = Sides {
            name: &name,
            note: "A car of 4 m by 2 m x m ahead: at 4 m or -4 m the rectangles touch, which collides.",
            edge,
            accepted: safe(),
            rejected: collision(),
        };
        book.sides(COLLISION, &sides, |x| standing(profile, track(1, x, 0.0)));
    }
    let sides = Sides {
        name: "corner-to-corner",
        note: "A car at (4, y): at y = 2 the corners touch, which collides.",
        edge: up_to(2.0),
        accepted: safe(),
        rejected: collision(),
    };
    book.sides(COLLISION, &sides, |y| standing(Profile::Paper, track(1, 4.0, y)));
    for (name, x, y, expected) in [
        ("rotated", 2.0, 3.0, collision()),
        ("rotated-apart", 2.0, 3.3, safe()),
        ("rotated-boxes-overlap", 3.9, 2.2, safe()),
    ] {
        let note = format!(
            "A car with the direction (0.6, 0.8) at ({x}, {y}); bounding circles or boxes along \
             the axes would not tell.",
        );
        let rotated = Track { cos: 0.6, sin: 0.8, ..track(1, x, y) };
        book.cycle(COLLISION, name, &note, &standing(Profile::Paper, rotated), &expected);
    }
    let note = "A small object wholly inside the CAV shares points with it.";
    let inside = Track { length: 0.1, width: 0.1, ..track(1, 0.5, 0.25) };
    book.cycle(COLLISION, "inside", note, &standing(Profile::Paper, inside), &collision());
}
