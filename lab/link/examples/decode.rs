//! `decode KIND`: reads a message as long as there is one, in a function of its own, whose instructions `scripts/flood`
//! counts; prints how many bytes it has. Without arguments: the kinds.

use std::error::Error;
use std::hint::black_box;

use mufasa::input::cycle::{Track, TrajectoryPoint};
use mufasa_link::message::{Frame, Message, Payload, decode, encode};

/// The last one ends in the middle of a point.
const KINDS: [&str; 4] = ["128 tracks", "1024 points", "1024 points, spoiled", "1024 points, cut"];
const SENT_NS: i64 = 1_234_567_890_123;

fn main() -> Result<(), Box<dyn Error>> {
    let Some(kind) = std::env::args().nth(1) else {
        KINDS.iter().for_each(|kind| println!("{kind}"));
        return Ok(());
    };
    let frame = Frame::new(484_223_000, 99_560_000, [0.0; 2])?;
    let payload = if kind == KINDS[0] { tracks() } else { points() };
    let message = Message { sender: 1, receiver: 2, generated_ns: SENT_NS, payload };
    let mut bytes = encode(&message, &frame)?;
    let end = bytes.len();
    match kind.rsplit(", ").next() {
        Some("spoiled") => bytes[end / 2..].fill(0xff),
        Some("cut") => bytes.truncate(end - 7),
        Some(_) | None => {}
    }
    println!("{} {}", bytes.len(), if measured(&bytes, &frame) { "read" } else { "refused" });
    Ok(())
}

/// What is counted.
#[inline(never)]
fn measured(bytes: &[u8], frame: &Frame) -> bool {
    black_box(decode(bytes, frame)).is_ok()
}

fn tracks() -> Payload {
    let (sin, cos) = 1.234_f64.sin_cos();
    let track =
        Track { id: 0, x: 9.0, y: 5.0, cos, sin, vx: 3.3, vy: 0.0, length: 4.5, width: 1.8 };
    let tracks = (0..128_u8).map(|id| Track { id: id.into(), x: 0.25 * f64::from(id), ..track });
    let tracks = tracks.collect();
    Payload::Tracks { session: 7, stamp_ns: SENT_NS, tracks }
}

fn points() -> Payload {
    let point = |step: i32| TrajectoryPoint {
        t_ns: SENT_NS + i64::from(step) * 50_000_000,
        x: 0.5 * f64::from(step),
        y: 1.0,
        cos: 1.0,
        sin: 0.0,
    };
    Payload::Trajectory { session: 7, stamp_ns: SENT_NS, points: (0..1024).map(point).collect() }
}
