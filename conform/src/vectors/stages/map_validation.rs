//! `spec/3-stages.md#stage-ii-trajectory-to-map`

use mufasa_model::input::cycle::{CrossSection, Cycle, Profile, Route};
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use crate::vectors::base::{base, cross_section, move_point, tracks, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, above};
use crate::vectors::expected::{fails_by, safe};

/// Stage ii, an empty local track list for stage iii, and theta_map = 1/4, a binary fraction.
pub fn stage_ii(profile: Profile) -> Cycle {
    with(base(profile, PlanRemote), |cycle| {
        cycle.parameters.theta_map = 0.25;
        cycle.tracks = Some(tracks(vec![]));
        (cycle.detections, cycle.grid) = (None, None);
    })
}

const REFERENCE: Topic =
    Topic::new("stages/map-validation", "spec/3-stages.md#stage-ii-trajectory-to-map.1");
const CORRIDOR: Topic =
    Topic::new("stages/map-validation", "spec/3-stages.md#stage-ii-trajectory-to-map.2");
const BOTH: Topic =
    Topic::new("stages/map-validation", "spec/3-stages.md#stage-ii-trajectory-to-map.3");

/// Adds its vectors.
pub fn add(book: &mut Book) {
    reference(book);
    corridor(book);
    both(book);
}

fn narrow(cycle: &mut Cycle) {
    for cross_section in &mut cycle.route.cross_sections {
        (cross_section.left[1], cross_section.right[1]) = (0.125, -0.125);
    }
}

fn reference(book: &mut Book) {
    let sides = Sides {
        name: "end-of-the-path",
        note: "The path ends at (15, 0); the last point, at (x, 4), is 3-4-5 from that end when \
               x = 18, and theta_map is 5 m.",
        edge: above(18.0),
        accepted: safe().stages("-PPo-"),
        rejected: fails_by("ii", "theta_map").witness("ii", "point", 1),
    };
    book.sides(REFERENCE, &sides, |x| {
        with(stage_ii(Profile::Paper), |cycle| {
            cycle.route.cross_sections =
                vec![cross_section(-100.0, 0.125), cross_section(15.0, 0.125)];
            cycle.parameters.theta_map = 5.0;
            move_point(cycle, 1, [x, 4.0]);
            if let Some(trajectory) = &mut cycle.trajectory {
                trajectory.points.truncate(2);
            }
        })
    });
    for (name, closed) in [("closed", true), ("open", false)] {
        let note = "The trajectory follows the segment from the last cross section to the first, which \
                    only a closed route has.";
        let cycle = with(stage_ii(Profile::Paper), |cycle| {
            let corner = |x: f64, y: f64, d: f64| CrossSection {
                x,
                y,
                left: [x - d, y - 1.0],
                right: [x + d, y + 1.0],
            };
            let cross_sections = vec![
                cross_section(100.0, 1.0),
                corner(100.0, 100.0, 1.0),
                corner(-100.0, 100.0, -1.0),
                cross_section(-100.0, 1.0),
            ];
            cycle.route = Route { closed, cross_sections };
        });
        let expected = if closed { safe() } else { fails_by("ii", "theta_map") };
        book.cycle(REFERENCE, &format!("{name}-route"), note, &cycle, &expected);
    }
}

fn corridor(book: &mut Book) {
    let places = [
        ("first-triangle", [5.0, 1.0], true),
        ("second-triangle", [40.0, 6.0], true),
        ("shared-edge", [5.0, 5.0], true),
        ("corner", [10.0, 2.0], true),
        ("other-diagonal", [50.0, -0.5], false),
        ("beside-the-corner", [10.5, 2.0], false),
    ];
    for (name, [x, y], is_inside) in places {
        let note = format!(
            "Triangles (0,8) (0,-8) (10,2) and (0,8) (10,2) (100,8); the quad is not convex, and \
             with the diagonal from right_i to left_i+1 it would be another region. Point 20 is at \
             ({x}, {y}).",
        );
        let cycle = with(stage_ii(Profile::Paper), |cycle| {
            cycle.route.cross_sections = vec![
                CrossSection { x: 0.0, y: 0.0, left: [0.0, 8.0], right: [0.0, -8.0] },
                CrossSection { x: 100.0, y: 0.0, left: [100.0, 8.0], right: [10.0, 2.0] },
            ];
            move_point(cycle, 20, [x, y]);
        });
        let expected =
            if is_inside { safe() } else { fails_by("ii", "theta_map").witness("ii", "point", 20) };
        book.cycle(CORRIDOR, name, &note, &cycle, &expected);
    }
}

fn both(book: &mut Book) {
    let sides = Sides {
        name: "border",
        note: "Point 20 at (20, y): the corridor ends at y = 3 and contains its border, and \
               theta_map is 0.25 m.",
        edge: above(3.0),
        accepted: safe(),
        rejected: fails_by("ii", "theta_map").witness("ii", "point", 20),
    };
    book.sides(BOTH, &sides, |y| {
        with(stage_ii(Profile::Paper), |cycle| move_point(cycle, 20, [20.0, y]))
    });
    let sides = Sides {
        name: "theta-map",
        note: "Point 20 at (20, y), outside of a corridor of half width 0.125 m: at distance \
               theta_map = 0.25 m from the path it is accepted still.",
        edge: above(0.25),
        accepted: safe(),
        rejected: fails_by("ii", "theta_map").witness("ii", "compared/1", "0.25"),
    };
    book.sides(BOTH, &sides, |y| {
        with(stage_ii(Profile::Paper), |cycle| {
            narrow(cycle);
            move_point(cycle, 20, [20.0, y]);
        })
    });
    let note = "The whole trajectory is looked at, the last point included, in both profiles.";
    for (name, profile) in [("paper", Profile::Paper), ("hardened", Profile::Hardened)] {
        let cycle = with(stage_ii(profile), |cycle| move_point(cycle, 20, [19.5, 3.5]));
        let expected = fails_by("ii", "theta_map").witness("ii", "point", 20);
        book.cycle(BOTH, &format!("last-point-{name}"), note, &cycle, &expected);
    }
    for (name, configuration, stages) in
        [("mot-remote", MotRemote, "PF-aa"), ("all-remote", AllRemote, "PFaaa")]
    {
        let note = "Stage ii compares a local trajectory as well as a remote one.";
        let cycle = with(base(Profile::Paper, configuration), |cycle| {
            move_point(cycle, 7, [7.0, -3.5]);
        });
        let expected = fails_by("ii", "theta_map").stages(stages).witness("ii", "point", 7);
        book.cycle(BOTH, name, note, &cycle, &expected);
    }
}
