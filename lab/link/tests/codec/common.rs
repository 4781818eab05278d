//! Messages to test with.

use mufasa::input::cycle::{Detection, Ego, Track, TrajectoryPoint};
use mufasa::services::configuration::{Group, Groups};
use mufasa_link::message::{Frame, Message, Payload};

/// A frame near Ulm whose reference position is not the origin of the map.
pub fn frame() -> Frame {
    Frame::new(484_223_000, 99_560_000, [1_000.0, -500.0]).expect("a place on the earth")
}

/// A message of each kind, with items that use what the formats can hold.
pub fn messages() -> Vec<Message> {
    let generated_ns = 1_234_567_890_123;
    let stamp_ns = generated_ns - 30_000_000;
    let (group, session) = (Group::Plan, 7);
    let (sin, cos) = 1.234_f64.sin_cos();
    let ego = Ego {
        x: 1_020.25,
        y: -480.5,
        cos,
        sin,
        speed: 13.87,
        length: 4.508,
        width: 1.61,
        center_offset: 1.4227,
    };
    let detection =
        Detection { x: 1_050.123, y: -499.987, cos: sin, sin: cos, length: 4.0, width: 1.8 };
    let Detection { x, y, length, width, .. } = detection;
    let track = Track { id: 255, x, y, cos: -1.0, sin: 0.0, vx: -13.333, vy: 0.004, length, width };
    let point = |step: i32| TrajectoryPoint {
        t_ns: stamp_ns + i64::from(step) * 100_000_000,
        x: ego.x + 1.387 * f64::from(step) * cos,
        y: ego.y + 1.387 * f64::from(step) * sin,
        cos,
        sin,
    };
    let payloads = vec![
        Payload::Offer { groups: Groups { mot: true, plan: false } },
        Payload::Withdraw,
        Payload::Confirm { group: Group::Mot, session: i64::MAX },
        Payload::Reject { group, session },
        Payload::Tracks { session, stamp_ns, tracks: vec![track, Track { id: 0, ..track }] },
        Payload::Tracks { session, stamp_ns, tracks: Vec::new() },
        Payload::Trajectory { session, stamp_ns, points: (0..51).map(point).collect() },
        Payload::Request { group, session },
        Payload::Release { group, session: 0 },
        Payload::Alive { group, session },
        Payload::State { stamp_ns, ego },
        Payload::Detections { stamp_ns, ego, detections: vec![detection; 3] },
    ];
    let message = |payload| Message { sender: 1, receiver: 2, generated_ns, payload };
    payloads.into_iter().map(message).collect()
}
