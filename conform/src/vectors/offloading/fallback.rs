//! `spec/2-offloading.md#fallback` and H-08; default t_wait 10 s.

use mufasa_model::input::cycle::Profile::{Hardened, Paper};
use mufasa_model::offloading::requester::Group::{Mot, Plan};
use mufasa_model::offloading::requester::Parameters;

use crate::vectors::book::{Book, Topic};
use crate::vectors::offloading::{LOCAL, tell, with_qos_hold};
use crate::vectors::story::{ALL, MOT, PLAN, Story};

const T_WAIT: i64 = 10_000_000_000;

const fn must(requirement: &'static str) -> Topic {
    Topic::new("offloading/fallback", requirement)
}

const FALL_BACK: Topic = must("spec/2-offloading.md#fallback.1");
const HOLD: Topic = must("spec/2-offloading.md#fallback.2");
const AGAIN: Topic = must("spec/2-offloading.md#fallback.3");
const NO_HOLD: Topic = must("spec/2-offloading.md#fallback.4");
const BACKWARDS: Topic = must("spec/2-offloading.md#fallback.5");
const ORDER: Topic = must("spec/2-offloading.md#fallback.7");
const H_08: Topic = Topic::new("hardened/H-08", "H-08");

/// Adds its vectors.
pub fn add(book: &mut Book) {
    fall_back(book);
    holds(book);
    violations(book);
    order(book);
    h_08(book);
}

fn fall_back(book: &mut Book) {
    let note = "Every remote or requested group returns in the same step, with a release each.";
    let story = Story::requested(Paper, ALL).confirm(1, (1, Plan, 2)).issue(2);
    let actions = ["release mot 1#1", "release plan 1#2", "activate plan"];
    tell(book, FALL_BACK, ("all", note), &story, (LOCAL, Some(2 + T_WAIT), &actions));
    let note = "Releases go to the station of each group.";
    let story = Story::new(Paper).offer(0, 2, MOT).offer(0, 1, PLAN).tick(0);
    let story = story.confirm(0, (2, Mot, 1)).confirm(0, (1, Plan, 2)).issue(1);
    let actions = ["release mot 2#1", "release plan 1#2", "activate mot", "activate plan"];
    tell(book, FALL_BACK, ("stations", note), &story, (LOCAL, Some(1 + T_WAIT), &actions));
    let note = "Data of the ended session that arrive later are dropped.";
    let story = Story::remote(Paper, MOT).issue(2).data(2, (1, Mot, 1), 2);
    tell(book, FALL_BACK, ("late-data", note), &story, (LOCAL, Some(2 + T_WAIT), &["drop mot"]));
    let note = "A safe cycle ends nothing.";
    let story = Story::remote(Paper, MOT).safe(2, MOT);
    tell(book, FALL_BACK, ("safe", note), &story, (["remote:1", "local"], None, &[]));
}

fn holds(book: &mut Book) {
    let note = "A hold starts although every group is local.";
    let story = Story::new(Paper).issue(5);
    tell(book, HOLD, ("local", note), &story, (LOCAL, Some(5 + T_WAIT), &[]));
    let note = "A later issue prolongs it.";
    let story = story.issue(9);
    tell(book, HOLD, ("later", note), &story, (LOCAL, Some(9 + T_WAIT), &[]));
    let note = "An earlier one does not shorten it.";
    tell(book, HOLD, ("earlier", note), &story.issue(7), (LOCAL, Some(9 + T_WAIT), &[]));
    let story = Story::remote(Paper, ALL).issue(1);
    let note = "A nanosecond before hold_until.";
    let early = story.clone().tick(T_WAIT);
    tell(book, AGAIN, ("before", note), &early, (LOCAL, Some(1 + T_WAIT), &[]));
    let note = "At hold_until; its last value stays.";
    let both = ["request mot 1#3", "request plan 1#4"];
    let told = (["requested:1", "requested:1"], Some(1 + T_WAIT), both.as_slice());
    tell(book, AGAIN, ("at", note), &story.tick(1 + T_WAIT), told);
    let story = Story::new(Paper).offer(0, 1, ALL).issue(100);
    for (name, t_ns) in [("still", 100), ("backwards", -1), ("lowest", i64::MIN)] {
        let note = "Time that stands still or runs backwards does not shorten a hold.";
        let story = story.clone().tick(t_ns).issue(t_ns).tick(99 + T_WAIT);
        tell(book, BACKWARDS, (name, note), &story, (LOCAL, Some(100 + T_WAIT), &[]));
    }
    let longest = Parameters { t_wait_ns: i64::MAX, ..Parameters::default() };
    let note = "hold_until saturates at 2^63 - 1.";
    let story = Story::new(Paper).parameters(longest).offer(0, 1, MOT).issue(1);
    let early = story.clone().tick(i64::MAX - 1);
    tell(book, BACKWARDS, ("saturated", note), &early, (LOCAL, Some(i64::MAX), &[]));
    let told = (["requested:1", "local"], Some(i64::MAX), ["request mot 1#1"].as_slice());
    tell(book, BACKWARDS, ("saturated-end", note), &story.tick(i64::MAX), told);
    let note = "A deadline saturates, too.";
    let story = Story::new(Paper).offer(0, 1, MOT).tick(i64::MAX - 1).tick(i64::MIN);
    tell(book, BACKWARDS, ("deadline", note), &story, (["requested:1", "local"], None, &[]));
    let story = story.tick(i64::MAX);
    tell(book, BACKWARDS, ("deadline-end", note), &story, (LOCAL, None, &["release mot 1#1"]));
}

fn violations(book: &mut Book) {
    for (name, qos_hold) in [("without-qos-hold", false), ("with-qos-hold", true)] {
        let note = "A violation of quality of service starts a hold only if qos_hold is set.";
        let story = Story::remote(Paper, MOT).parameters(with_qos_hold(qos_hold));
        let late = story.clone().data(1, (1, Mot, 1), 2);
        let left = ["drop mot", "release mot 1#1", "activate mot"];
        let hold = |at| qos_hold.then_some(at + T_WAIT);
        tell(book, NO_HOLD, (name, note), &late, (LOCAL, hold(1), &left));
        let silent = story.tick(100_000_001);
        let name = format!("silence-{name}");
        tell(book, NO_HOLD, (&name, note), &silent, (LOCAL, hold(100_000_001), &left[1..]));
    }
}

fn order(book: &mut Book) {
    let note = "A tick ends overdue requests (PLAN), then silent sessions (MOT); releases come \
                before activations.";
    let story = Story::requested(Paper, ALL).confirm(0, (1, Mot, 1)).tick(500_000_000);
    let actions = ["release mot 1#1", "release plan 1#2", "activate mot"];
    tell(book, ORDER, ("tick", note), &story, (LOCAL, None, &actions));
    let note = "Requests come last.";
    let story = Story::remote(Paper, MOT).offer(1, 1, ALL).tick(100_000_001);
    let actions = ["release mot 1#1", "activate mot", "request plan 1#2"];
    tell(book, ORDER, ("requests-last", note), &story, (["local", "requested:1"], None, &actions));
    let note = "A hold that a silent session starts forbids the requests of the same tick.";
    let story = Story::remote(Paper, PLAN).parameters(with_qos_hold(true)).offer(1, 1, ALL);
    let told =
        (LOCAL, Some(100_000_001 + T_WAIT), ["release plan 1#1", "activate plan"].as_slice());
    tell(book, ORDER, ("held-at-once", note), &story.tick(100_000_001), told);
}

fn h_08(book: &mut Book) {
    let remote = ["remote:1", "local"];
    let story = Story::remote(Hardened, MOT);
    let note = "The confirmation stops nothing in the hardened profile.";
    tell(book, H_08, ("confirmed", note), &story, (remote, None, &[]));
    let note = "A safe cycle before any result stops nothing.";
    tell(book, H_08, ("no-result", note), &story.clone().safe(1, MOT), (remote, None, &[]));
    let used = story.data(1, (1, Mot, 1), 1);
    let note = "The first safe cycle that names the group after a used result stops them.";
    let told = (remote, None, ["deactivate mot"].as_slice());
    tell(book, H_08, ("used", note), &used.clone().safe(2, MOT), told);
    let note = "A cycle that does not name the group does not.";
    tell(book, H_08, ("not-named", note), &used.clone().safe(2, PLAN), (remote, None, &[]));
    let note = "Leaving before that needs no activation.";
    let told = (LOCAL, Some(2 + T_WAIT), ["release mot 1#1"].as_slice());
    tell(book, H_08, ("left-before", note), &used.clone().issue(2), told);
    let note = "Leaving after that does.";
    let told = (LOCAL, Some(3 + T_WAIT), ["release mot 1#1", "activate mot"].as_slice());
    tell(book, H_08, ("left-after", note), &used.safe(2, MOT).issue(3), told);
    let note = "In the paper profile the confirmation stops them, and a safe cycle matters not.";
    let story = Story::remote(Paper, MOT).data(1, (1, Mot, 1), 1).safe(2, MOT);
    tell(book, H_08, ("paper", note), &story, (remote, None, &[]));
}
