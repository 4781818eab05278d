//! H-02, H-05, H-10: which stages run, and when nothing looked for obstacles.

use mufasa_model::input::cycle::Profile;
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use crate::vectors::base::{base, detection, detections, track, tracks, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::{fails, fails_by, safe};
use crate::vectors::stages::schedule::without;

const H_02: Topic = Topic::new("hardened/H-02", "H-02");
const H_05: Topic = Topic::new("hardened/H-05", "H-05");
const H_10: Topic = Topic::new("hardened/H-10", "H-10");

/// Adds their vectors.
pub fn add(book: &mut Book) {
    let unchecked = || without(base(Profile::Hardened, AllRemote), "dg");
    let note = "A list that stage i could not check passes stage iii, which is no obstacle check.";
    book.cycle(H_02, "passes", note, &unchecked(), &fails("no_obstacle_check").stages("DPPdg"));
    let note = "It can fail the cycle nevertheless.";
    let cycle = with(unchecked(), |c| c.tracks = Some(tracks(vec![track(1, 10.0, 0.0)])));
    book.cycle(H_02, "fails", note, &cycle, &fails("iii").stages("DPFaa"));
    let note = "With detections the list is checked, and stage iv looks besides.";
    let cycle = without(base(Profile::Hardened, AllRemote), "g");
    book.cycle(H_02, "checked", note, &cycle, &safe().stages("PPPPo"));

    for (name, configuration, missing, expected) in [
        ("mot", MotRemote, "dg", fails("no_obstacle_check").stages("DP-dG")),
        ("mot-grid", MotRemote, "d", safe().stages("DP-dP")),
        ("mot-detections", MotRemote, "g", safe().stages("PP-PG")),
        ("all", AllRemote, "tdg", fails("no_obstacle_check").stages("TPtdg")),
        ("all-grid", AllRemote, "td", safe().stages("TPtdP")),
        ("plan", PlanRemote, "tdg", fails("no_obstacle_check").stages("-PTdg")),
        ("plan-grid", PlanRemote, "td", safe().stages("-PTdP")),
        ("plan-tracks", PlanRemote, "dg", safe().stages("-PPoo")),
        ("no-trajectory", AllRemote, "jtdg", safe().stages("TJjjj")),
    ] {
        let note = "A current trajectory that none of iii, iv, v looked at fails the cycle.";
        let cycle = without(base(Profile::Hardened, configuration), missing);
        book.cycle(H_05, name, note, &cycle, &expected);
    }
    let note = "A stage failed: that is the reason, not the missing check.";
    let cycle = with(without(base(Profile::Hardened, MotRemote), "dg"), |cycle| {
        crate::vectors::base::move_point(cycle, 3, [3.0, 9.0]);
    });
    book.cycle(H_05, "other-failure", note, &cycle, &fails("ii").stages("DF-aa"));

    let note = "The tracks are an empty list, the detections show a car ahead: stage iv runs \
                whatever iii did.";
    let attacked = |detected| {
        with(base(Profile::Hardened, AllRemote), |cycle| {
            cycle.tracks = Some(tracks(vec![]));
            cycle.detections = detected;
        })
    };
    let cycle = attacked(Some(detections(vec![detection(8.0, 0.0)])));
    book.cycle(H_10, "iv", note, &cycle, &fails_by("iv", "collision").stages("PPPFa"));
    let note = "Without detections stage v runs whatever iii did.";
    let cycle = with(attacked(None), |cycle| {
        cycle.grid.iter_mut().for_each(|grid| grid.occupied = vec![0xff; 5]);
    });
    book.cycle(H_10, "v", note, &cycle, &fails_by("v", "occupied").stages("DPPdF"));
    let note = "Stage iv ran: v does not.";
    let cycle = with(attacked(Some(detections(vec![]))), |cycle| {
        cycle.grid.iter_mut().for_each(|grid| grid.occupied = vec![0xff; 5]);
    });
    book.cycle(H_10, "not-v", note, &cycle, &safe().stages("PPPPo"));
    let note = "In PlanRemote the list is local, and stage iii alone is meant so.";
    let mut cycle = attacked(Some(detections(vec![detection(8.0, 0.0)])));
    cycle.configuration = PlanRemote;
    book.cycle(H_10, "plan", note, &cycle, &safe().stages("-PPoo"));
}
