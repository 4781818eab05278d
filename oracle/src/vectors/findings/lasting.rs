//! F-24 and F-25: what lasts in the hardened profile, and what arrives too late.

use mufasa_model::configuration::Configuration::{self, AllRemote, MotRemote};
use mufasa_model::cycle::{Cycle, Profile, Track, TrackList};
use mufasa_model::requester::Group::Mot;

use crate::vectors::base::{base, detection, detections, track, tracks, with};
use crate::vectors::book::Book;
use crate::vectors::expected::{after, fails_by, safe};
use crate::vectors::findings::finding;
use crate::vectors::story::{MOT, Story};

/// Adds their vectors.
pub fn add(book: &mut Book) {
    lock_in(book);
    late_verdict(book);
}

/// A true car drives ahead at 30 m/s; (ns ago, x then) of the list that stage i passed last in a
/// safe cycle.
fn car_ahead(configuration: Configuration, previous: Option<(i64, f64)>) -> Cycle {
    with(base(Profile::Hardened, configuration), |cycle| {
        cycle.tracks = Some(tracks(vec![Track { vx: 30.0, ..track(1, 15.0, 0.0) }]));
        cycle.detections = Some(detections(vec![detection(15.0, 0.0)]));
        cycle.previous_tracks = previous.map(|(age_ns, x)| {
            let items = vec![track(1, x, 0.0)];
            TrackList { stamp_ns: cycle.now_ns - age_ns, items }
        });
    })
}

fn lock_in(book: &mut Book) {
    let topic = finding("findings/F-24", "F-24");
    let note = "A true car drives ahead, the last safe cycle was 0.1 s ago.";
    book.cycle(topic, "before", note, &car_ahead(AllRemote, Some((100_000_000, 12.0))), &safe());
    let note = "The same car, the last safe cycle was 1.1 s ago: it counts as standing, and as this \
                cycle is rejected it is no safe one either. So it stays.";
    let stands = fails_by("iii", "collision_standing");
    book.cycle(topic, "after", note, &car_ahead(AllRemote, Some((1_100_000_000, -18.0))), &stands);
    let note = "There never was a safe cycle.";
    book.cycle(topic, "first", note, &car_ahead(AllRemote, None), &stands);
    let note = "The way out: a safe cycle in MotRemote, after which its list is the previous one.";
    book.cycle(topic, "over-mot", note, &car_ahead(MotRemote, None), &safe());
}

fn late_verdict(book: &mut Book) {
    let topic = finding("findings/F-25", "F-25");
    let story = Story::remote(Profile::Hardened, MOT).data(1, (1, Mot, 1), 1).lost(2, 1);
    let story = story.offer(3, 1, MOT).tick(3).confirm(4, (1, Mot, 2));
    let note = "Session 1 was lost, session 2 has given nothing yet: the late verdict on a cycle with \
                data of session 1 stops nothing.";
    let early = story.clone().safe(5, MOT);
    let told = ["remote:1", "local"];
    book.trace(topic, "in-time", note, early.trace(), &after(early.len(), told, None, &[]));
    let note = "The same late verdict after the first data of session 2 stops the local MOT, though \
                nothing of session 2 was found safe: a verdict names no session.";
    let story = story.data(5, (1, Mot, 2), 5).safe(6, MOT);
    let expected = after(story.len(), told, None, &["deactivate mot"]);
    book.trace(topic, "late", note, story.trace(), &expected);
}
