//! What a decoder allocates is bounded, whatever the bytes claim. One test, for what others allocate would
//! count.

use c_its_parser::standards::cam_1_4_1::cam_pdu_descriptions::GenerationDeltaTime;
use c_its_parser::standards::cdd_1_3_1_1::its_container::{
    Altitude, AltitudeConfidence, AltitudeValue, HeadingValue, ItsPduHeader, Latitude, Longitude,
    PosConfidenceEllipse, ReferencePosition, SemiAxisLength, SpeedConfidence, StationID,
    StationType,
};
use c_its_parser::standards::cpm_1::cpm_pdu_descriptions::{
    CPM, CollectivePerceptionMessage, CpmManagementContainer, CpmParameters, DistanceConfidence,
    DistanceValue, Identifier, NumberOfPerceivedObjects, ObjectConfidence,
    ObjectDistanceWithConfidence, ObjectRefPoint, PerceivedObject, PerceivedObjectContainer,
    SpeedExtended, SpeedValueExtended, TimeOfMeasurement,
};
use mufasa::input::cycle::{Ego, Track, TrajectoryPoint};
use mufasa_link::message::{DecodeError, Frame, Message, Payload, decode, encode};
use peak_alloc::PeakAlloc;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Of the shortest object.
const OBJECT_BITS: usize = 133;
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

fn bits(bytes: &[u8]) -> Vec<u8> {
    bytes.iter().flat_map(|byte| (0..8).map(move |at| byte >> (7 - at) & 1)).collect()
}

fn bytes(bits: &[u8]) -> Vec<u8> {
    bits.chunks(8).map(|byte| (0..).zip(byte).map(|(at, bit)| bit << (7 - at)).sum()).collect()
}

/// A message with tracks whose CPM has these bytes: its envelope is 215 bits long, and a length of 15 bits follows.
fn with_cpm(good: &[u8], cpm: &[u8]) -> Vec<u8> {
    let length = u16::try_from(cpm.len() << 1).unwrap().to_be_bytes();
    bytes(&[&bits(good)[..215], &bits(&length)[..15], &bits(cpm)].concat())
}

/// As many objects, each as short as it can be, as fit into a message.
fn crowded_cpm() -> Vec<u8> {
    let distance = ObjectDistanceWithConfidence::new(DistanceValue(0), DistanceConfidence(0));
    let speed = SpeedExtended::new(SpeedValueExtended(0), SpeedConfidence(1));
    let object = || {
        let (distance, speed) = (|| distance.clone(), || speed.clone());
        PerceivedObject::new(
            Identifier(0),
            None,
            TimeOfMeasurement(0),
            None,
            ObjectConfidence(0),
            distance(),
            distance(),
            None,
            speed(),
            speed(),
            None,
            None,
            None,
            None,
            None,
            None,
            None,
            None,
            ObjectRefPoint(0),
            None,
            None,
            None,
        )
    };
    let position = ReferencePosition {
        latitude: Latitude(0),
        longitude: Longitude(0),
        position_confidence_ellipse: PosConfidenceEllipse::new(
            SemiAxisLength(0),
            SemiAxisLength(0),
            HeadingValue(0),
        ),
        altitude: Altitude::new(AltitudeValue(0), AltitudeConfidence::unavailable),
    };
    let cpm = |count| {
        let objects = PerceivedObjectContainer((0..count).map(|_| object()).collect());
        let management = CpmManagementContainer::new(StationType(15), None, position.clone());
        let count = NumberOfPerceivedObjects(255);
        let parameters = CpmParameters::new(management, None, None, Some(objects), None, count);
        let header = ItsPduHeader { protocol_version: 1, message_id: 14, station_id: StationID(1) };
        let body = CollectivePerceptionMessage::new(GenerationDeltaTime(0), parameters);
        rasn::uper::encode(&CPM { header, cpm: body }).unwrap()
    };
    // The number of objects is what lists of one and of two differ in first: 7 bits, behind one that says that
    // there are at most 128. With more it is set, and a length of 16 bits follows (`rasn` does not write that).
    let [one, two] = [1, 2].map(|count| bits(&cpm(count)));
    let last = one.iter().zip(&two).position(|(a, b)| a != b).unwrap();
    let (head, object) = (&one[..last - 7], &one[last + 1..last + 1 + OBJECT_BITS]);
    let count = (16_000 * 8 - head.len()) / OBJECT_BITS;
    let length = (0x8000 | u16::try_from(count).unwrap()).to_be_bytes();
    bytes(&[head, &[1], &bits(&length), &object.repeat(count), &[1; 8]].concat())
}

/// LINK-24, LINK-23: the largest messages; every byte of them set to claim the most; messages of the
/// largest size that are nothing but claims; and one crowded with the shortest objects.
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
    let none = Payload::Tracks { session: 1, stamp_ns: 0, tracks: Vec::new() };
    let none = Message { sender: 1, receiver: 0, generated_ns: 0, payload: none };
    let crowded = with_cpm(&encode(&none, &frame).unwrap(), &crowded_cpm());
    let error = decode(&crowded, &frame).unwrap_err();
    assert!(matches!(error, DecodeError::Incomplete { named: 255, given: 500.. }), "{error}");
    largest = largest.max(needed(&crowded, &frame));
    println!("at most {largest} bytes");
    assert!((10_000..MOST).contains(&largest), "{largest} bytes, or nothing was measured");
    // Beyond the largest size nothing is looked at.
    assert!(needed(&vec![0xff; 100_000_000], &frame) < 1000);
}
