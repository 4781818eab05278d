//! What does not fit is refused, with its name, and what only just fits is sent.

use mufasa::input::cycle::{Detection, Ego, Track, TrajectoryPoint};
use mufasa::services::configuration::Group;
use mufasa_link::message::{Frame, Message, Payload, Problem, decode, encode};

use super::common::{frame, messages};

fn tracks_of(message: &mut Message) -> &mut Vec<Track> {
    match &mut message.payload {
        Payload::Tracks { tracks, .. } => tracks,
        other => panic!("{other:?} has no tracks"),
    }
}

fn points_of(message: &mut Message) -> &mut Vec<TrajectoryPoint> {
    match &mut message.payload {
        Payload::Trajectory { points, .. } => points,
        other => panic!("{other:?} has no points"),
    }
}

fn ego_of(message: &mut Message) -> &mut Ego {
    match &mut message.payload {
        Payload::State { ego, .. } | Payload::Detections { ego, .. } => ego,
        other => panic!("{other:?} has no vehicle"),
    }
}

fn detections_of(message: &mut Message) -> &mut Vec<Detection> {
    match &mut message.payload {
        Payload::Detections { detections, .. } => detections,
        other => panic!("{other:?} has no detections"),
    }
}

fn stamp_of(message: &mut Message) -> &mut i64 {
    match &mut message.payload {
        Payload::Tracks { stamp_ns, .. }
        | Payload::Trajectory { stamp_ns, .. }
        | Payload::State { stamp_ns, .. }
        | Payload::Detections { stamp_ns, .. } => stamp_ns,
        other => panic!("{other:?} has no stamp"),
    }
}

/// Places of `messages()`.
const TRACKS: usize = 4;
const TRAJECTORY: usize = 6;
const STATE: usize = 10;
const DETECTIONS: usize = 11;

/// A message of `messages()`, changed, is sent; changed a little more, it is refused there.
fn edge<T: Copy>(kind: usize, place: &str, change: impl Fn(&mut Message, T), fits: T, does_not: T) {
    let message = |value| {
        let mut message = messages().swap_remove(kind);
        change(&mut message, value);
        message
    };
    let sent = encode(&message(fits), &frame());
    let sent = sent.unwrap_or_else(|error| panic!("{place} of {:?}: {error}", message(fits)));
    decode(&sent, &frame()).unwrap_or_else(|error| panic!("{place}: {error}"));
    let error = encode(&message(does_not), &frame()).expect_err(place);
    assert_eq!(error.place.to_string(), place, "{error}");
    let expected = matches!(error.problem, Problem::OutOfRange { .. } | Problem::TooMany { .. });
    assert!(expected, "{error}");
}

// LINK-18
#[test]
fn envelope() {
    edge(0, "message.sender", |it, value| it.sender = value, 1, 0);
    edge(0, "message.sender", |it, value| it.sender = value, 4_294_967_295, 4_294_967_296);
    edge(0, "message.receiver", |it, value| it.receiver = value, 0, -1);
    edge(0, "message.receiver", |it, value| it.receiver = value, 4_294_967_295, i64::MAX);
    let session = |it: &mut Message, session| {
        it.payload = Payload::Request { group: Group::Mot, session };
    };
    edge(0, "message.session", session, 0, -1);
    edge(0, "message.session", session, i64::MAX, i64::MIN);
}

// LINK-18 LINK-05, LINK-06, LINK-07
#[test]
fn times() {
    let generated_ns = messages()[0].generated_ns;
    let ms = generated_ns / 1_000_000 * 1_000_000;
    let stamp = |it: &mut Message, stamp_ns| *stamp_of(it) = stamp_ns;
    for kind in [TRACKS, DETECTIONS] {
        edge(kind, "message.stamp_ns", stamp, ms - 1_500_000_000, ms - 1_500_000_001);
        edge(kind, "message.stamp_ns", stamp, ms + 1_500_999_999, ms + 1_501_000_000);
        edge(kind, "message.stamp_ns", stamp, ms, i64::MIN);
    }
    edge(STATE, "message.stamp_ns", stamp, ms - 32_768_000_000, ms - 32_768_000_001);
    edge(STATE, "message.stamp_ns", stamp, ms + 32_767_999_999, ms + 32_768_000_000);
    let last = |it: &mut Message, since| {
        let stamp_ns = *stamp_of(it);
        points_of(it)[50].t_ns = stamp_ns.saturating_add(since);
    };
    edge(TRAJECTORY, "points[50].t_ns", last, 134_217_727_499, 134_217_727_500);
    edge(TRAJECTORY, "points[50].t_ns", last, -134_217_728_500, -134_217_728_501);
    edge(TRAJECTORY, "points[50].t_ns", last, 0, i64::MAX);
}

// LINK-18 LINK-19
#[test]
fn tracks() {
    let [x, y] = frame().point();
    edge(TRACKS, "tracks[1].id", |it, id| tracks_of(it)[1].id = id, 255, 256);
    edge(TRACKS, "tracks[1].id", |it, id| tracks_of(it)[1].id = id, 0, -1);
    edge(TRACKS, "tracks[1].x", |it, d| tracks_of(it)[1].x = x + d, 1327.674, 1327.676);
    edge(TRACKS, "tracks[0].x", |it, d| tracks_of(it)[0].x = x + d, -1327.684, -1327.686);
    edge(TRACKS, "tracks[1].y", |it, d| tracks_of(it)[1].y = y + d, 1327.674, 1327.676);
    edge(TRACKS, "tracks[1].vx", |it, v| tracks_of(it)[1].vx = v, 163.824, 163.826);
    edge(TRACKS, "tracks[1].vy", |it, v| tracks_of(it)[1].vy = v, -163.824, -163.826);
    edge(TRACKS, "tracks[0].length", |it, l| tracks_of(it)[0].length = l, 102.3, 102.31);
    edge(TRACKS, "tracks[0].length", |it, l| tracks_of(it)[0].length = l, 1e-6, 0.0);
    edge(TRACKS, "tracks[0].width", |it, w| tracks_of(it)[0].width = w, 102.3, 102.300_001);
    let count = |it: &mut Message, count| {
        let track = tracks_of(it)[0];
        *tracks_of(it) = vec![track; count];
    };
    edge(TRACKS, "message.tracks", count, 128, 129);
}

// LINK-18
#[test]
fn vehicle() {
    let [x, y] = frame().point();
    for kind in [STATE, DETECTIONS] {
        edge(kind, "ego.speed", |it, v| ego_of(it).speed = v, 163.824, 163.826);
        edge(kind, "ego.speed", |it, v| ego_of(it).speed = v, 0.0, -0.006);
        edge(kind, "ego.length", |it, l| ego_of(it).length = l, 102.1, 102.11);
        edge(kind, "ego.width", |it, w| ego_of(it).width = w, 6.0, 6.01);
        edge(kind, "ego.center_offset", |it, o| ego_of(it).center_offset = o, -100.0, 100.006);
    }
    edge(STATE, "ego.x", |it, d| ego_of(it).x = x + d, 134_000.0, 134_300.0);
    edge(STATE, "ego.y", |it, d| ego_of(it).y = y + d, -134_000.0, -134_300.0);
    let count = |it: &mut Message, count| {
        let detection = detections_of(it)[0];
        *detections_of(it) = vec![detection; count];
    };
    edge(DETECTIONS, "message.detections", count, 128, 1_000_000);
    // Along the body: ahead of the vehicle, which looks along the map's y.
    let ahead = |it: &mut Message, ahead| {
        (ego_of(it).cos, ego_of(it).sin) = (0.0, 1.0);
        detections_of(it)[2].y = ego_of(it).y + ahead;
    };
    edge(DETECTIONS, "detections[2].x", ahead, 1_330.0, 1_333.0);
    edge(DETECTIONS, "detections[2].x", ahead, -1_323.0, -1_326.0);
    // Near 180 degrees the map ends there.
    let frame = Frame::new(0, 1_800_000_000, [x, y]).unwrap();
    let mut message = messages().swap_remove(STATE);
    let error = encode(&message, &frame).unwrap_err();
    assert_eq!(error.place.to_string(), "ego.x", "{error}");
    ego_of(&mut message).x = x - 100.0;
    encode(&message, &frame).unwrap();
}

// LINK-18
#[test]
fn trajectory() {
    let [x, y] = frame().point();
    edge(TRAJECTORY, "points[7].x", |it, d| points_of(it)[7].x = x + d, 134_217.727, 134_217.728);
    edge(TRAJECTORY, "points[7].y", |it, d| points_of(it)[7].y = y + d, -134_217.728, -134_217.729);
    let count = |it: &mut Message, count| {
        let point = points_of(it)[0];
        *points_of(it) = vec![point; count];
    };
    edge(TRAJECTORY, "trajectory.points", count, 1024, 1025);
}

/// LINK-18: NaN, infinities and what is no direction.
#[test]
fn what_is_no_number_is_not_sent() {
    type Change = fn(&mut Message, f64);
    let numbers: [(usize, &str, Change); 11] = [
        (TRACKS, "tracks[1].x", |it, value| tracks_of(it)[1].x = value),
        (TRACKS, "tracks[1].vy", |it, value| tracks_of(it)[1].vy = value),
        (TRACKS, "tracks[1].length", |it, value| tracks_of(it)[1].length = value),
        (TRAJECTORY, "points[9].x", |it, value| points_of(it)[9].x = value),
        (TRAJECTORY, "points[9].y", |it, value| points_of(it)[9].y = value),
        (STATE, "ego.x", |it, value| ego_of(it).x = value),
        (STATE, "ego.y", |it, value| ego_of(it).y = value),
        (STATE, "ego.speed", |it, value| ego_of(it).speed = value),
        (STATE, "ego.width", |it, value| ego_of(it).width = value),
        (STATE, "ego.center_offset", |it, value| ego_of(it).center_offset = value),
        (DETECTIONS, "detections[0].x", |it, value| detections_of(it)[0].x = value),
    ];
    let directions: [(usize, &str, Change); 4] = [
        (TRACKS, "tracks[0].(cos, sin)", |it, value| tracks_of(it)[0].cos = value),
        (TRAJECTORY, "points[3].(cos, sin)", |it, value| points_of(it)[3].sin = value),
        (STATE, "ego.(cos, sin)", |it, value| ego_of(it).cos = value),
        (DETECTIONS, "detections[2].(cos, sin)", |it, value| detections_of(it)[2].sin = value),
    ];
    let infinite = (Problem::NotFinite, [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].as_slice());
    let turned = (Problem::NoDirection, [f64::NAN, f64::INFINITY, 0.999, 2.0].as_slice());
    for (fields, (problem, values)) in [(&numbers[..], infinite), (&directions, turned)] {
        for &(kind, place, change) in fields {
            for &value in values {
                let mut message = messages().swap_remove(kind);
                change(&mut message, value);
                let error = encode(&message, &frame()).expect_err(place);
                assert_eq!((error.place.to_string().as_str(), error.problem), (place, problem));
            }
        }
    }
}

/// LINK-02
#[test]
fn a_frame_is_near_a_place_on_the_earth() {
    for (latitude, longitude, point, place) in [
        (800_000_001, 0, [0.0, 0.0], "frame.latitude"),
        (i32::MIN, 0, [0.0, 0.0], "frame.latitude"),
        (0, 1_800_000_001, [0.0, 0.0], "frame.longitude"),
        (0, 0, [f64::NAN, 0.0], "frame.x"),
        (0, 0, [0.0, f64::INFINITY], "frame.y"),
        (0, 0, [0.0, 16_777_217.0], "frame.y"),
    ] {
        let error = Frame::new(latitude, longitude, point).unwrap_err();
        assert_eq!(error.place.to_string(), place, "{error}");
    }
}

/// Every error says which value it is, and what to do or what fits.
#[test]
fn errors_in_words() {
    let mut message = messages().swap_remove(TRACKS);
    tracks_of(&mut message)[1].length = 110.0;
    let error = encode(&message, &frame()).unwrap_err();
    assert_eq!(error.to_string(), "tracks[1].length does not fit; it can be 0.1 to 102.3");
}
