//! F-24 to F-29: what lasts in the hardened profile, what arrives too late, what ends too soon,
//! starts too late, or goes across.

use mufasa_model::input::cycle::{Cycle, Profile, Track, TrackList, TrajectoryPoint};
use mufasa_model::offloading::requester::Group::Mot;
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, MotRemote, PlanRemote,
};

use crate::vectors::base::{base, detection, detections, point, points, road, track, tracks, with};
use crate::vectors::book::Book;
use crate::vectors::expected::{after, fails_by, safe};
use crate::vectors::findings::finding;
use crate::vectors::story::{MOT, Story};

/// Adds their vectors.
pub fn add(book: &mut Book) {
    lock_in(book);
    late_verdict(book);
    short_end(book);
    behind(book);
    zigzag(book);
    turns(book);
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

/// The CAV drives at 10 m/s, a car stands with its rear so far ahead of the CAV's front; the planned
/// trajectory is at these places every 0.2 s.
fn standing_car(profile: Profile, gap: f64, places: &[f64]) -> Cycle {
    with(base(profile, PlanRemote), |cycle| {
        let at = (0..).step_by(200_000_000).zip(places);
        cycle.trajectory = Some(points(at.map(|(t_ns, x)| point(t_ns, *x, 0.0)).collect()));
        cycle.tracks = Some(tracks(vec![track(1, 4.0 + gap, 0.0)]));
        (cycle.detections, cycle.lead, cycle.grid) = (None, None, None);
    })
}

fn short_end(book: &mut Book) {
    let topic = finding("findings/F-26", "F-26");
    let note = "The trajectory stops after 4.5 m, within start_tolerance of the braking distance of \
                6.25 m; the car stands 4.6 m ahead. No point of the trajectory meets it.";
    let places = [0.0, 1.0, 2.0, 3.0, 3.8, 4.2, 4.4, 4.5];
    let paper = standing_car(Profile::Paper, 4.6, &places);
    book.cycle(topic, "paper", note, &paper, &safe());
    let short = |gap: f64| standing_car(Profile::Hardened, gap, &places);
    let note = "The first place beyond the end meets the car 4.6 m ahead.";
    let expected = fails_by("iii", "collision").witness("iii", "point", 8);
    book.cycle(topic, "hardened", note, &short(4.6), &expected);
    let note = "s_stop = 7.65 m: the last place beyond the end is 7.75 m ahead.";
    let expected = fails_by("iii", "collision").witness("iii", "point", 20);
    book.cycle(topic, "hardened-last", note, &short(7.75), &expected);
    let note = "No place is 7.8 m ahead.";
    book.cycle(topic, "hardened-clear", note, &short(7.8), &safe());
    let note = "A local trajectory is examined only where it leads.";
    let local = Cycle { configuration: MotRemote, ..short(4.6) };
    let seen = Some(detections(vec![detection(8.6, 0.0)]));
    book.cycle(topic, "local", note, &Cycle { detections: seen, ..local }, &safe());
    let note = "A trajectory that brakes at a_b to the braking distance: it meets the car itself.";
    let places = [0.0, 1.84, 3.36, 4.56, 5.44, 6.0, 6.24, 6.25];
    let cycle = standing_car(Profile::Hardened, 4.6, &places);
    book.cycle(topic, "braking", note, &cycle, &fails_by("iii", "collision"));
}

/// A trajectory of 28 m/s from `start` on; the CAV drives at 28 m/s.
fn late_start(profile: Profile, start: f64, gap: f64) -> Cycle {
    let places: Vec<f64> = (0..40).map(|i| start + 5.6 * f64::from(i)).collect();
    with(standing_car(profile, gap, &places), |cycle| {
        cycle.ego.speed = 28.0;
        cycle.ego.length = 6.0;
        cycle.tracks = Some(tracks(vec![track(1, 5.0 + gap, 0.0)]));
        cycle.route = road(-100.0, 300.0);
    })
}

fn behind(book: &mut Book) {
    let topic = finding("findings/F-27", "F-27");
    let note = "The first point is 1.9 m behind the CAV, s_CAV = 50.4 m reaches 48.5 m ahead of it; \
                braking takes 49 m, and a car stands 48.9 m ahead of the front.";
    book.cycle(topic, "paper", note, &late_start(Profile::Paper, -1.9, 48.9), &safe());
    let note = "s_stop counts from the CAV.";
    let hardened = late_start(Profile::Hardened, -1.9, 48.9);
    book.cycle(topic, "hardened", note, &hardened, &fails_by("iii", "collision"));
}

fn zigzag(book: &mut Book) {
    let topic = finding("findings/F-28", "F-28");
    let across = |profile| {
        let side = |i: i64| if i % 2 == 0 { 0.0 } else { 0.9 };
        with(standing_car(profile, 0.5, &[]), |cycle| {
            let point = |i: i64| point(i * 100_000_000, 0.0, side(i));
            cycle.trajectory = Some(points((0..20).map(point).collect()));
        })
    };
    let note = "The CAV drives at 10 m/s, a car stands 0.5 m ahead; the trajectory goes 0.9 m to the \
                left and back every 0.2 s for s_CAV = 18 m, and nothing further ahead is examined.";
    book.cycle(topic, "paper", note, &across(Profile::Paper), &safe());
    let note =
        "H-11 allows the steps, which are below W/2 = 1 m, but they are no way along the road.";
    let expected = fails_by("ii", "arc_too_short").witness("ii", "point", 3);
    book.cycle(topic, "hardened", note, &across(Profile::Hardened), &expected);
}

/// The trajectory stops after 4.5 m and turns by three times 29 degrees there.
fn turned_end(profile: Profile) -> Cycle {
    with(standing_car(profile, 6.0, &[0.0, 1.0, 2.0, 3.0, 3.8, 4.2, 4.4, 4.5]), |cycle| {
        let Some(trajectory) = &mut cycle.trajectory else { return };
        let last_ns = trajectory.points.last().map_or(0, |last| last.t_ns);
        let turned = (1..=3).map(|i: i32| {
            let angle = f64::from(29 * i).to_radians();
            let (sin, cos) = angle.sin_cos();
            TrajectoryPoint { t_ns: last_ns + i64::from(i), x: 4.5, y: 0.0, cos, sin }
        });
        trajectory.points.extend(turned);
    })
}

/// The trajectory turns across the road on the spot, goes 2.5 m to the side, turns round, and so on.
fn across(profile: Profile) -> Cycle {
    with(standing_car(profile, 0.5, &[]), |cycle| {
        // Where across the road, the heading in degrees, and ms since the place before.
        let mut places = vec![(0.0, 0, 0), (0.0, 29, 1), (0.0, 58, 1)];
        for (sweep, from) in [0.0, 2.5, 0.0, 2.5, 0.0].into_iter().enumerate() {
            let side = if sweep % 2 == 0 { 1 } else { -1 };
            let turned = [-58, -29, 0, 29, 58, 87].map(|angle| (from, angle * side, 1));
            places.extend(&turned[if sweep == 0 { 5 } else { 0 }..]);
            places.extend((1..=5).map(|i| (from + 0.5 * f64::from(side * i), 87 * side, 50)));
        }
        let mut t_ns = 0;
        let point = |(y, angle, after_ms): (f64, i32, i64)| {
            t_ns += after_ms * 1_000_000;
            let (sin, cos) = f64::from(angle).to_radians().sin_cos();
            TrajectoryPoint { cos, sin, ..point(t_ns, 0.0, y) }
        };
        cycle.trajectory = Some(points(places.into_iter().map(point).collect()));
    })
}

fn turns(book: &mut Book) {
    let topic = finding("findings/F-29", "F-29");
    let note = "The trajectory ends before the braking distance, as in F-26, and turns by 87 degrees \
                there: the places beyond its end miss the car 6 m ahead.";
    let caught = fails_by("ii", "step_turn");
    book.cycle(topic, "paper", note, &turned_end(Profile::Paper), &safe());
    book.cycle(topic, "hardened", note, &turned_end(Profile::Hardened), &caught);
    let note = "A car stands 0.5 m ahead; the trajectory turns on the spot and goes across the road, along \
                its headings.";
    book.cycle(topic, "across-paper", note, &across(Profile::Paper), &safe());
    book.cycle(topic, "across-hardened", note, &across(Profile::Hardened), &caught);
}
