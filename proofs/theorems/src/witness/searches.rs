//! The searches: a cycle with holes for each finding, as free of other faults as it can be, so that
//! in the hardened profile nothing but the rule that closes the finding rejects it; and its closure: whatever
//! the numbers in the holes, the hardened profile rejects the cycle. The whole decision of the model is run,
//! all stages. It is one family of cycles for each finding, not every cycle that the finding is about.

use super::scenes::{
    above, aside, bare, below, crossed, crossing, detections, every, grid, hurried, met_too_late,
    seen, straight, track, tracks, up_to, within,
};
use crate::claim::{Theorem, Wrong};
use crate::cycle::decide;
use crate::input::cycle::{CrossSection, Cycle, Lead, Profile, Track};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, given, less};
use crate::numbers::real::hole::open_number;
use crate::report::{Outcome, Stage};
use crate::services::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};
use crate::theorem::base::{self, NOW_NS};

/// A finding whose witness is searched.
#[derive(Debug)]
pub struct Search {
    /// The finding.
    pub finding: &'static str,
    /// The configuration of its cycle.
    configuration: Configuration,
    /// What makes the cycle, with its holes, of one of nothing.
    edit: fn(&mut Cycle),
    /// What the holes are within, and what is wrong.
    conditions: fn() -> Vec<Formula>,
    /// That the hardened profile rejects every such cycle.
    pub closure: Theorem,
}

impl Search {
    /// The cycle with holes.
    pub fn cycle(&self, profile: Profile) -> Cycle {
        let mut cycle = bare(profile, self.configuration);
        (self.edit)(&mut cycle);
        cycle
    }

    /// What the model decides of the cycle, of which the conditions are assumed: whether this stage fails, or
    /// any.
    ///
    /// # Panics
    /// Never: theorems count no work.
    pub fn is_rejected(&self, profile: Profile, by: Option<Stage>) -> bool {
        let scene = base::scene(&self.cycle(profile));
        (self.conditions)().into_iter().for_each(given);
        let report = decide(&scene).expect("theorems count no work");
        match by {
            Some(stage) => matches!(report.stages[stage as usize], Outcome::Failed(_)),
            None => report.failed_stage.is_some(),
        }
    }
}

fn is_rejected(finding: &str, profile: Profile, by: Option<Stage>) -> Formula {
    let search = SEARCHES.iter().find(|search| search.finding == finding);
    let search = search.expect("every closure has its search");
    Formula::from(search.is_rejected(profile, by))
}

/// A search with its closure; `$stage`: the stage that must fail, where another one would, too.
macro_rules! closure {
    (
        ($finding:literal, $configuration:expr, $stage:expr),
        $statement:literal, $domain:literal, $edit:expr, $conditions:expr $(,)?
    ) => {
        Search {
            finding: $finding,
            configuration: $configuration,
            edit: $edit,
            conditions: $conditions,
            closure: Theorem {
                id: concat!("the_hardened_profile_rejects_the_family_of_", $finding),
                statement: $statement,
                domain: concat!(
                    "the cycle of ",
                    $finding,
                    " in proofs/theorems/src/witness/searches.rs: a straight road, all headings along it; ",
                    $domain
                ),
                claim: || is_rejected($finding, Profile::HARDENED, $stage),
                wrong: Wrong {
                    statement: "the paper profile rejects it, too",
                    claim: || is_rejected($finding, Profile::PAPER, $stage),
                },
            },
        }
    };
}

/// All searches. Objects are as large as the CAV and along x, so that two of them meet when their
/// centres on the x axis are at most 4 m apart.
pub static SEARCHES: [Search; 25] = [
    closure!(
        ("F-02", MotRemote, None),
        "a track 10 m from the only detection, within the field of view: rejected by H-01",
        "x from 0 to 50",
        |cycle| {
            tracks(cycle, vec![track(1, 60.0), track(2, open_number("x"))]);
            detections(cycle, 60.0);
        },
        || vec![within("x", 0, 50)]
    ),
    closure!(
        ("F-03", PlanRemote, None),
        "a lorry of 12 m meets the CAV: rejected by H-14",
        "x from 0 to 7.9",
        |cycle| {
            tracks(cycle, vec![Track { length: 12.0, ..track(1, open_number("x")) }]);
        },
        || vec![within("x", 0, 60), up_to("x", 79, 10)]
    ),
    closure!(
        ("F-04", PlanRemote, None),
        "a standing car meets the CAV behind s_CAV, within its braking distance: rejected by H-14",
        "safety_time = 0.2 s, v_now from 4 to 4.25, x from 4 to 4.95",
        |cycle| {
            hurried(cycle);
            tracks(cycle, vec![track(1, open_number("x"))]);
        },
        met_too_late
    ),
    closure!(
        ("F-05", MotRemote, None),
        "a detection meets the CAV behind s_follow, within its braking distance: rejected by H-14",
        "safety_time = 0.2 s, v_now from 4 to 4.25, v_lead from 0 to 10, x from 4 to 4.95",
        |cycle| {
            hurried(cycle);
            cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 200.0, speed: open_number("v_lead") });
            detections(cycle, open_number("x"));
        },
        || [met_too_late(), vec![within("v_lead", 0, 10)]].concat()
    ),
    closure!(
        ("F-06", PlanRemote, None),
        "the first step of a standing CAV ends in a car, which it cannot stop before any more when it goes on for tau: rejected by H-14",
        "x from 0 to 4.02",
        |cycle| {
            straight(cycle, &[0.0, 1.0]);
            tracks(cycle, vec![track(1, open_number("x"))]);
        },
        || vec![within("x", 0, 60), up_to("x", 402, 100)]
    ),
    closure!(
        ("F-07", PlanRemote, None),
        "no object and no grid is known: rejected by H-05",
        "the second point at most 1 m ahead",
        |cycle| {
            straight(cycle, &[0.0, open_number("end")]);
        },
        || vec![within("end", 0, 1)]
    ),
    closure!(
        ("F-08", MotRemote, None),
        "the front disk, of radius 1.118 m around (1.5, y), reaches into the occupied cell from (2, 1) to (3, 2): rejected by H-06",
        "0 < y < 1",
        |cycle| {
            straight(cycle, &[0.0]);
            aside(cycle, 0);
            cycle.grid = Some(grid(14, 13));
        },
        || vec![above("y", 0, 1), below("y", 1, 1)]
    ),
    closure!(
        ("F-09", PlanRemote, None),
        "a point beside the corridor, 0.3 m or less from the reference path: rejected by H-07",
        "y above 0.125 to 0.29",
        |cycle| {
            straight(cycle, &[0.0, 1.0]);
            aside(cycle, 1);
            let cross_section =
                |x: f64| CrossSection { x, y: 0.0, left: [x, 0.125], right: [x, -0.125] };
            cycle.route.cross_sections = vec![cross_section(-50.0), cross_section(150.0)];
            tracks(cycle, Vec::new());
        },
        || vec![above("y", 1, 8), up_to("y", 29, 100)]
    ),
    closure!(
        ("F-10", PlanRemote, None),
        "the CAV is behind the first point by more than start_tolerance: rejected by H-07",
        "x from -60 to below -2",
        |cycle| {
            cycle.parameters.start_tolerance = 2.0;
            cycle.ego.x = open_number("x");
            tracks(cycle, Vec::new());
        },
        || vec![within("x", -60, 0), below("x", -2, 1)]
    ),
    closure!(
        ("F-11", PlanRemote, Some(Stage::Ii)),
        "a car of 1 m between two points, where the CAV is at neither of them: rejected by H-11",
        "the second point at most 13 m ahead, the car in between",
        |cycle| {
            cycle.ego.speed = 10.0;
            cycle.parameters.step_max_ns = 1_000_000_000;
            cycle.trajectory = Some(every(1_000_000_000, &[0.0, open_number("end"), 20.0]));
            tracks(cycle, vec![Track { length: 1.0, ..track(1, open_number("x")) }]);
        },
        || {
            let [x, end] = ["x", "end"].map(Real::named);
            vec![within("end", 0, 13), above("x", 5, 2), less(&x, &(end - Real::ratio(5, 2)))]
        }
    ),
    closure!(
        ("F-13", AllRemote, None),
        "a car that stands in the way, with a made-up velocity: rejected by H-14",
        "velocities along x from -50 to 50 m/s",
        |cycle| {
            cycle.ego.speed = 5.0;
            straight(cycle, &[0.0, 0.5, 1.0, 1.5, 2.0]);
            tracks(cycle, vec![Track { vx: open_number("vx"), ..track(1, 4.5) }]);
            detections(cycle, 4.5);
        },
        || vec![within("vx", -50, 50)]
    ),
    closure!(
        ("F-14", AllRemote, None),
        "a car stands where the CAV is, and the remote list is empty: rejected by H-10 and H-14",
        "x from -4 to 4",
        |cycle| {
            tracks(cycle, Vec::new());
            detections(cycle, open_number("x"));
        },
        || vec![within("x", -4, 4)]
    ),
    closure!(
        ("F-15", AllRemote, None),
        "a car that stands in the way, with a made-up length: rejected by H-14",
        "lengths from 1 to 10 m",
        |cycle| {
            cycle.ego.speed = 0.3;
            straight(cycle, &[0.0, 0.5]);
            tracks(cycle, vec![Track { length: open_number("length"), ..track(1, 4.05) }]);
            detections(cycle, 4.05);
        },
        || vec![within("length", 1, 10)]
    ),
    closure!(
        ("F-16", PlanRemote, None),
        "a car that meets the standing CAV in 2 s, from a trajectory of 5 s later: rejected by H-07",
        "velocities along x from -12 to -8 m/s",
        |cycle| {
            cycle.parameters.step_max_ns = 2_000_000_000;
            let mut later = every(2_000_000_000, &[0.0, 0.0]);
            later.points.iter_mut().for_each(|point| point.t_ns += 5_000_000_000);
            cycle.trajectory = Some(later);
            tracks(cycle, vec![Track { vx: open_number("vx"), ..track(1, 20.0) }]);
        },
        || vec![within("vx", -12, -8)]
    ),
    closure!(
        ("F-18", AllRemote, None),
        "a remote list that nothing has checked is all that is known: rejected by H-02",
        "x from -60 to 60",
        |cycle| {
            tracks(cycle, vec![track(1, open_number("x"))]);
        },
        || vec![within("x", -60, 60)]
    ),
    closure!(
        ("F-23", PlanRemote, Some(Stage::Iv)),
        "a trajectory that ends before the car in the braking distance: rejected by H-14",
        "the last point at most 0.9 m ahead",
        |cycle| {
            cycle.ego.speed = 4.0;
            straight(cycle, &[0.0, open_number("end")]);
            tracks(cycle, vec![track(1, 4.9)]);
        },
        || vec![within("end", 0, 1), below("end", 9, 10)]
    ),
    closure!(
        ("F-26", PlanRemote, Some(Stage::Iv)),
        "a car behind the end of the trajectory, and within the braking distance: rejected by H-14",
        "the last point above 1 to 1.25 m ahead, the car from there on to 5.5 m",
        |cycle| {
            cycle.ego.speed = 4.0;
            straight(cycle, &[0.0, 0.5, 1.0, open_number("end")]);
            tracks(cycle, vec![track(1, open_number("x"))]);
        },
        || {
            let [x, end] = ["x", "end"].map(Real::named);
            vec![
                within("end", 1, 2),
                up_to("end", 5, 4),
                less(&(end + Real::from_integer(4)), &x),
                up_to("x", 11, 2),
            ]
        }
    ),
    closure!(
        ("F-28", PlanRemote, None),
        "a zigzag of y m on the spot, while a car stands 0.5 m ahead of the CAV: rejected by H-14, or by H-11",
        "y from 0 to 1",
        |cycle| {
            cycle.ego.speed = 10.0;
            let mut zigzag = every(100_000_000, &[0.0; 14]);
            let aside = zigzag.points.iter_mut().skip(1).step_by(2);
            aside.for_each(|point| point.y = open_number("y"));
            cycle.trajectory = Some(zigzag);
            tracks(cycle, vec![track(1, 4.5)]);
        },
        || vec![within("y", 0, 1)]
    ),
    closure!(
        ("F-30", MotRemote, Some(Stage::Iv)),
        "a car at (4.5, -4), said to stand, that crosses before a CAV at 3 m/s: rejected by H-14",
        "seen at (4.5, -8) to (4.5, -7.5) 500 ms ago; a list of one item",
        |cycle| {
            crossed(cycle);
            tracks(cycle, vec![track(1, 60.0), Track { y: -4.0, ..track(2, 4.5) }]);
        },
        crossing
    ),
    closure!(
        ("F-31", MotRemote, Some(Stage::Iv)),
        "a car at (4.5, -4), left out, that crosses before a CAV at 3 m/s: rejected by H-14",
        "seen at (4.5, -8) to (4.5, -7.5) 500 ms ago; a list of one item",
        crossed,
        crossing
    ),
    closure!(
        ("F-34", AllRemote, Some(Stage::V)),
        "empty tracks, empty detections, and an occupied cell where the CAV stands: rejected by H-10",
        "0 < y < 1/2",
        |cycle| {
            straight(cycle, &[0.0]);
            aside(cycle, 0);
            tracks(cycle, Vec::new());
            seen(cycle, Vec::new());
            cycle.grid = Some(grid(13, 12));
        },
        || vec![above("y", 0, 1), below("y", 1, 2)]
    ),
    closure!(
        ("F-35", PlanRemote, Some(Stage::Ii)),
        "a step of 0.3 m ahead and more than 0.1 m aside: rejected by H-11",
        "y above 0.1 to 1 m",
        |cycle| {
            cycle.trajectory = Some(every(20_000_000, &[0.0, 0.3]));
            aside(cycle, 1);
            tracks(cycle, Vec::new());
        },
        || vec![within("y", 0, 1), above("y", 1, 10)]
    ),
    closure!(
        ("F-36", PlanRemote, Some(Stage::Ii)),
        "a first heading along x of a CAV with another one: rejected by H-07",
        "cos = 0.6, sin above 0.7999999 to below 0.8000001",
        |cycle| {
            // Turned by 53 degrees, a direction within what rounding allows.
            (cycle.ego.cos, cycle.ego.sin) = (0.6, open_number("sin"));
            tracks(cycle, Vec::new());
        },
        || vec![above("sin", 7_999_999, 10_000_000), below("sin", 8_000_001, 10_000_000)]
    ),
    closure!(
        ("F-37", PlanRemote, Some(Stage::Ii)),
        "a trajectory that starts beside the CAV: rejected by H-07",
        "y from -2 to below -1/2",
        |cycle| {
            cycle.ego.y = open_number("y");
            tracks(cycle, Vec::new());
        },
        || vec![within("y", -2, 0), below("y", -1, 2)]
    ),
    closure!(
        ("F-41", PlanRemote, Some(Stage::Ii)),
        "a turn to the right and back to the left, which end more than 0.2 m to the left: rejected by H-11",
        "but for those of the second and the third point, turned by 0.05 rad; y above 0.2 to 1 m",
        |cycle| {
            let mut wiggle = every(3_000_000, &[0.0, 0.001, 0.012]);
            for (point, sin) in wiggle.points[1..].iter_mut().zip([-0.05, 0.05]) {
                (point.cos, point.sin) = (0.998_749_217_771_909, sin);
            }
            wiggle.points[2].y = open_number("y");
            cycle.trajectory = Some(wiggle);
            tracks(cycle, Vec::new());
        },
        || vec![within("y", 0, 1), above("y", 1, 5)]
    ),
];
