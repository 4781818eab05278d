//! F-24 to F-26: what lasts in the hardened profile, what arrives too late, and what ends too soon.

use mufasa_model::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};
use mufasa_model::cycle::{Cycle, Profile, Track, TrackList};
use mufasa_model::requester::Group::Mot;

use crate::vectors::base::{base, detection, detections, point, points, track, tracks, with};
use crate::vectors::book::Book;
use crate::vectors::expected::{after, fails_by, safe};
use crate::vectors::findings::finding;
use crate::vectors::story::{MOT, Story};

/// Adds their vectors.
pub fn add(book: &mut Book) {
    lock_in(book);
    late_verdict(book);
    short_end(book);
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

/// The CAV drives at 10 m/s, a car stands with its rear 6.6 m ahead of the CAV's centre, 4.6 m
/// ahead of its front; the planned trajectory is at these places every so many ns.
fn standing_car(step_ns: i64, places: &[f64]) -> Cycle {
    with(base(Profile::Hardened, PlanRemote), |cycle| {
        let at = (0..).step_by(usize::try_from(step_ns).unwrap_or(1)).zip(places);
        cycle.trajectory = Some(points(at.map(|(t_ns, x)| point(t_ns, *x, 0.0)).collect()));
        cycle.tracks = Some(tracks(vec![track(1, 8.6, 0.0)]));
        (cycle.detections, cycle.lead, cycle.grid) = (None, None, None);
    })
}

fn short_end(book: &mut Book) {
    let topic = finding("findings/F-26", "F-26");
    let note = "The trajectory stops after 4.5 m, within start_tolerance of the braking distance of \
                6.25 m, as H-12 allows: no point meets the car that stands 4.6 m ahead of the CAV.";
    let places = [0.0, 1.0, 2.0, 3.0, 3.8, 4.2, 4.4, 4.5];
    book.cycle(topic, "short", note, &standing_car(200_000_000, &places), &safe());
    let note = "A trajectory that brakes at a_b to the braking distance: it meets the car.";
    let places = [0.0, 1.84, 3.36, 4.56, 5.44, 6.0, 6.24, 6.25];
    let cycle = standing_car(200_000_000, &places);
    book.cycle(topic, "braking", note, &cycle, &fails_by("iii", "collision"));
}
