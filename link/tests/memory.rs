//! What a decoder allocates is bounded, whatever the bytes claim. One test, for what others allocate would
//! count.

use mufasa::input::cycle::{Ego, Track, TrajectoryPoint};
use mufasa_link::message::{Frame, Message, Payload, decode, encode};
use peak_alloc::PeakAlloc;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Of any message, bytes.
const MOST: usize = 1 << 20;

/// Bytes that decoding takes on top of what is in use.
fn needed(bytes: &[u8], frame: &Frame) -> usize {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let decoded = decode(bytes, frame);
    let needed = ALLOCATOR.peak_usage() - before;
    drop(decoded);
    needed
}

/// `spec/6-link.md#limits.4`: the largest messages; every byte of them set to claim the most; and messages of
/// the largest size that are nothing but claims.
#[test]
fn a_decoder_needs_less_than_a_mebibyte() {
    let frame = Frame::new(0, 0, [0.0, 0.0]).unwrap();
    let (x, y, cos, sin) = (0.0, 0.0, 1.0, 0.0);
    let point = TrajectoryPoint { t_ns: 0, x, y, cos, sin };
    let track = Track { id: 0, x, y, cos, sin, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 };
    let ego = Ego { x, y, cos, sin, speed: 0.0, length: 4.0, width: 2.0, center_offset: 0.0 };
    let payloads = [
        Payload::Tracks { session: 1, stamp_ns: 0, tracks: vec![track; 128] },
        Payload::Trajectory { session: 1, stamp_ns: 0, points: vec![point; 1024] },
        Payload::State { stamp_ns: 0, ego },
    ];
    let mut largest = 0;
    for payload in payloads {
        let message = Message { sender: 1, receiver: 0, generated_ns: 0, payload };
        let good = encode(&message, &frame).unwrap();
        largest = largest.max(needed(&good, &frame));
        for at in 0..good.len() {
            let mut bytes = good.clone();
            bytes[at] = 0xff;
            largest = largest.max(needed(&bytes, &frame));
        }
        for filler in [0x00, 0x7f, 0x84, 0xc4, 0xff] {
            for start in [0, 17, 25, 40, 60] {
                let mut bytes = good[..start].to_vec();
                bytes.resize(16_384, filler);
                largest = largest.max(needed(&bytes, &frame));
            }
        }
    }
    println!("at most {largest} bytes");
    assert!((10_000..MOST).contains(&largest), "{largest} bytes, or nothing was measured");
    // Beyond the largest size nothing is looked at.
    assert!(needed(&vec![0xff; 100_000_000], &frame) < 1000);
}
