//! `spec/2-offloading.md#quality-of-service`; defaults: l_max 50 ms, dt_max 100 ms.

use mufasa_model::input::cycle::Profile::{Hardened, Paper};
use mufasa_model::offloading::requester::Group::{Mot, Plan};

use crate::vectors::book::{Book, Topic};
use crate::vectors::offloading::{LOCAL, tell};
use crate::vectors::story::{ALL, MOT, Story};

const MS: i64 = 1_000_000;

const fn must(requirement: &'static str) -> Topic {
    Topic::new("offloading/quality-of-service", requirement)
}

const ARRIVAL: Topic = must("spec/2-offloading.md#quality-of-service.1");
const LIMITS: Topic = must("spec/2-offloading.md#quality-of-service.2");
const SILENCE: Topic = must("spec/2-offloading.md#quality-of-service.3");
const FUTURE: Topic = must("spec/2-offloading.md#quality-of-service.4");
const ALONE: Topic = must("spec/2-offloading.md#quality-of-service.5");
const IN_ORDER: Topic = must("spec/2-offloading.md#quality-of-service.6");

const REMOTE: [&str; 2] = ["remote:1", "local"];
/// What a violation of MOT's session 1 does.
const LEFT: [&str; 3] = ["drop mot", "release mot 1#1", "activate mot"];
const SESSION: (i64, mufasa_model::offloading::requester::Group, i64) = (1, Mot, 1);

/// Adds its vectors.
pub fn add(book: &mut Book) {
    let mot = || Story::remote(Paper, MOT);
    let note = "A latency of l_max is no violation.";
    let story = mot().data(60 * MS, SESSION, 10 * MS);
    tell(book, LIMITS, ("latency", note), &story, (REMOTE, None, &[]));
    let note = "A nanosecond more is.";
    let story = mot().data(60 * MS, SESSION, 10 * MS - 1);
    tell(book, LIMITS, ("latency-exceeded", note), &story, (LOCAL, None, &LEFT));
    let note = "dt_max since the activation is no violation.";
    let story = mot().data(100 * MS, SESSION, 100 * MS);
    tell(book, LIMITS, ("inter-arrival", note), &story, (REMOTE, None, &[]));
    let note = "dt_max since the last arrival, too.";
    let story = story.data(200 * MS, SESSION, 200 * MS);
    tell(book, LIMITS, ("inter-arrival-next", note), &story, (REMOTE, None, &[]));
    let note = "A nanosecond more is.";
    let story = story.data(300 * MS + 1, SESSION, 300 * MS);
    tell(book, LIMITS, ("inter-arrival-exceeded", note), &story, (LOCAL, None, &LEFT));

    let note = "An element out of order is an arrival: 100 ms later the next is in time.";
    let story = mot().data(60 * MS, SESSION, 60 * MS).data(100 * MS, SESSION, 60 * MS);
    let story = story.data(200 * MS, SESSION, 200 * MS);
    tell(book, ARRIVAL, ("out-of-order", note), &story, (REMOTE, None, &[]));
    let note = "An old element that is late, too, is a violation: latency is checked first.";
    let story = mot().data(40 * MS, SESSION, 40 * MS).data(90 * MS + 1, SESSION, 40 * MS);
    tell(book, ARRIVAL, ("late-and-old", note), &story, (LOCAL, None, &LEFT));
    let note = "Data of others are no arrivals: the session is silent.";
    let story = mot().data(90 * MS, (2, Mot, 1), 90 * MS).data(90 * MS, (1, Mot, 9), 90 * MS);
    tell(book, ARRIVAL, ("others", note), &story.tick(100 * MS + 1), (LOCAL, None, &LEFT[1..]));

    let note = "Silent for dt_max since the activation.";
    tell(book, SILENCE, ("dt-max", note), &mot().tick(100 * MS), (REMOTE, None, &[]));
    let note = "A nanosecond longer: the tick ends the session.";
    let told = (LOCAL, None, &LEFT[1..]);
    tell(book, SILENCE, ("exceeded", note), &mot().tick(100 * MS + 1), told);
    let note = "Counted from the last arrival.";
    let story = mot().data(50, SESSION, 50).tick(50 + 100 * MS);
    tell(book, SILENCE, ("since-arrival", note), &story, (REMOTE, None, &[]));
    let note = "Counted from the confirmation, not from the request.";
    let story = Story::requested(Paper, MOT).confirm(400 * MS, SESSION).tick(500 * MS);
    tell(book, SILENCE, ("since-confirmation", note), &story, (REMOTE, None, &[]));

    let note = "Generated now.";
    let story = mot().data(10, SESSION, 10);
    tell(book, FUTURE, ("now", note), &story, (REMOTE, None, &[]));
    let note = "Generated later than it arrived: a violation.";
    let story = mot().data(10, SESSION, 11);
    tell(book, FUTURE, ("generated-later", note), &story, (LOCAL, None, &LEFT));

    let note = "A violation returns that group and no other, without a hold.";
    let story = Story::remote(Paper, ALL).data(1, SESSION, 2);
    tell(book, ALONE, ("alone", note), &story, (["local", "remote:1"], None, &LEFT));
    let note = "At the next tick it may be requested again.";
    let told = (["requested:1", "remote:1"], None, ["request mot 1#3"].as_slice());
    tell(book, ALONE, ("again", note), &story.tick(2), told);
    let note = "Hardened: the local services compute still and need no activation.";
    let story = Story::remote(Hardened, ALL).data(1, SESSION, 2);
    tell(book, ALONE, ("hardened", note), &story, (["local", "remote:1"], None, &LEFT[..2]));

    let note = "Generated later than the last one used.";
    let story = mot().data(10, SESSION, 5).data(11, SESSION, 6);
    tell(book, IN_ORDER, ("later", note), &story, (REMOTE, None, &[]));
    for (name, generated_ns) in [("same", 5), ("earlier", 4)] {
        let note = "Not generated later than the last one used: dropped.";
        let story = mot().data(10, SESSION, 5).data(11, SESSION, generated_ns);
        tell(book, IN_ORDER, (name, note), &story, (REMOTE, None, &["drop mot"]));
    }
    let note = "The order is that of a group.";
    let story = Story::remote(Paper, ALL).data(10, SESSION, 5).data(11, (1, Plan, 2), 4);
    tell(book, IN_ORDER, ("per-group", note), &story, (["remote:1", "remote:1"], None, &[]));
    let note = "A new session starts anew.";
    let story = mot().data(10, SESSION, 5).withdraw(13, 1).offer(13, 1, MOT).tick(13);
    let story = story.confirm(13, (1, Mot, 2)).data(14, (1, Mot, 2), 2);
    tell(book, IN_ORDER, ("new-session", note), &story, (REMOTE, None, &[]));
}
