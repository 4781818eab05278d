//! Closures: whatever the numbers that the search for the witness of a finding leaves open, the
//! hardened profile rejects the cycle. The whole decision of the model is run, all stages. It is one
//! family of cycles for each finding, not every cycle that the finding is about.

use crate::cycle::decide;
use crate::input::cycle::Profile;
use crate::numbers::real::formula::{Formula, given};
use crate::report::{Outcome, Stage};
use crate::theorem::{Theorem, Wrong, base};
use crate::witness::SEARCHES;

/// A theorem of this file; `$stage`: the stage that must fail, where another one would, too.
macro_rules! closure {
    ($finding:literal, $statement:literal, $domain:literal, $stage:expr) => {
        Theorem {
            id: concat!("the_hardened_profile_rejects_the_family_of_", $finding),
            statement: $statement,
            domain: concat!(
                "the cycle of ",
                $finding,
                " in proofs/theorems/src/witness/searches.rs: a straight road, all \
                 headings along it; ",
                $domain
            ),
            claim: || is_rejected($finding, Profile::HARDENED, $stage),
            wrong: Wrong {
                statement: "the paper profile rejects it, too",
                claim: || is_rejected($finding, Profile::PAPER, $stage),
            },
        }
    };
}

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    closure!(
        "F-02",
        "a track 10 m from the only detection, within the field of view: rejected by H-01",
        "x from 0 to 50",
        None
    ),
    closure!("F-03", "a lorry of 12 m meets the CAV: rejected by H-14", "x from 0 to 7.9", None),
    closure!(
        "F-04",
        "a standing car meets the CAV behind s_CAV, within its braking distance: rejected by H-14",
        "safety_time = 0.2 s, v_now from 4 to 4.25, x from 4 to 4.95",
        None
    ),
    closure!(
        "F-05",
        "a detection meets the CAV behind s_follow, within its braking distance: rejected by H-14",
        "safety_time = 0.2 s, v_now from 4 to 4.25, v_lead from 0 to 10, x from 4 to 4.95",
        None
    ),
    closure!(
        "F-06",
        "the first step of a standing CAV ends in a car, which it cannot stop before any more when it goes on for tau: rejected by H-14",
        "x from 0 to 4.02",
        None
    ),
    closure!(
        "F-07",
        "no object and no grid is known: rejected by H-05",
        "the second point at most 1 m ahead",
        None
    ),
    closure!(
        "F-08",
        "the front disk, of radius 1.118 m around (1.5, y), reaches into the occupied cell from (2, 1) to (3, 2): rejected by H-06",
        "0 < y < 1",
        None
    ),
    closure!(
        "F-09",
        "a point beside the corridor, 0.3 m or less from the reference path: rejected by H-07",
        "y above 0.125 to 0.29",
        None
    ),
    closure!(
        "F-10",
        "the CAV is behind the first point by more than start_tolerance: rejected by H-07",
        "x from -60 to below -2",
        None
    ),
    closure!(
        "F-11",
        "a car of 1 m between two points, where the CAV is at neither of them: rejected by H-11",
        "the second point at most 13 m ahead, the car in between",
        Some(Stage::Ii)
    ),
    closure!(
        "F-13",
        "a car that stands in the way, with a made-up velocity: rejected by H-14",
        "velocities along x from -50 to 50 m/s",
        None
    ),
    closure!(
        "F-14",
        "a car stands where the CAV is, and the remote list is empty: rejected by H-10 and H-14",
        "x from -4 to 4",
        None
    ),
    closure!(
        "F-15",
        "a car that stands in the way, with a made-up length: rejected by H-14",
        "lengths from 1 to 10 m",
        None
    ),
    closure!(
        "F-16",
        "a car that meets the standing CAV in 2 s, from a trajectory of 5 s later: rejected by H-07",
        "velocities along x from -12 to -8 m/s",
        None
    ),
    closure!(
        "F-18",
        "a remote list that nothing has checked is all that is known: rejected by H-02",
        "x from -60 to 60",
        None
    ),
    closure!(
        "F-23",
        "a trajectory that ends before the car in the braking distance: rejected by H-14",
        "the last point at most 0.9 m ahead",
        Some(Stage::Iv)
    ),
    closure!(
        "F-26",
        "a car behind the end of the trajectory, and within the braking distance: rejected by H-14",
        "the last point above 1 to 1.25 m ahead, the car from there on to 5.5 m",
        Some(Stage::Iv)
    ),
    closure!(
        "F-28",
        "a zigzag of y m on the spot, while a car stands 0.5 m ahead of the CAV: rejected by H-14, or by H-11",
        "y from 0 to 1",
        None
    ),
    closure!(
        "F-30",
        "a car at (4.5, -4), said to stand, that crosses before a CAV at 3 m/s: rejected by H-14",
        "seen at (4.5, -8) to (4.5, -7.5) 500 ms ago; a list of one item",
        Some(Stage::Iv)
    ),
    closure!(
        "F-31",
        "a car at (4.5, -4), left out, that crosses before a CAV at 3 m/s: rejected by H-14",
        "seen at (4.5, -8) to (4.5, -7.5) 500 ms ago; a list of one item",
        Some(Stage::Iv)
    ),
    closure!(
        "F-34",
        "empty tracks, empty detections, and an occupied cell where the CAV stands: rejected by H-10",
        "0 < y < 1/2",
        Some(Stage::V)
    ),
    closure!(
        "F-35",
        "a step of 0.3 m ahead and more than 0.1 m aside: rejected by H-11",
        "y above 0.1 to 1 m",
        Some(Stage::Ii)
    ),
    closure!(
        "F-36",
        "a first heading along x of a CAV with another one: rejected by H-07",
        "cos = 1, sin above 0.18 to 1",
        Some(Stage::Ii)
    ),
    closure!(
        "F-37",
        "a trajectory that starts beside the CAV: rejected by H-07",
        "y from -2 to below -1/2",
        Some(Stage::Ii)
    ),
    closure!(
        "F-41",
        "a turn to the right and back to the left, which end more than 0.2 m to the left: rejected by H-11",
        "but for those of the second and the third point, turned by 0.05 rad; y above 0.2 to 1 m",
        Some(Stage::Ii)
    ),
];

fn is_rejected(finding: &str, profile: Profile, by: Option<Stage>) -> Formula {
    let search = SEARCHES.iter().find(|search| search.finding == finding);
    let search = search.expect("every theorem of this file has its search");
    let scene = base::scene(&(search.cycle)(profile));
    let [bounds, wrong] = (search.conditions)(&scene);
    given(bounds);
    given(wrong);
    let report = decide(&scene).expect("theorems count no work");
    Formula::from(match by {
        Some(stage) => matches!(report.stages[stage as usize], Outcome::Failed(_)),
        None => report.failed_stage.is_some(),
    })
}
