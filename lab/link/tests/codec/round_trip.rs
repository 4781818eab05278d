//! What is sent arrives, to within the rounding of `spec/6-link.md#rounding`.

use mufasa::input::cycle::{Detection, Ego, Track, TrajectoryPoint};
use mufasa::services::configuration::{Group, Groups};
use mufasa_link::message::{Frame, Message, Payload, decode, encode};
use proptest::prelude::*;

use super::common::{frame, messages};

/// What doubles add to a rounding, m.
const DOUBLES: f64 = 1e-8;

fn direction() -> impl Strategy<Value = [f64; 2]> {
    let angles = prop_oneof![(-180.0..180.0), (0..3600).prop_map(|count| f64::from(count) / 10.0)];
    angles.prop_map(|degrees: f64| degrees.to_radians().sin_cos()).prop_map(|(sin, cos)| [cos, sin])
}

fn rectangle() -> impl Strategy<Value = Detection> {
    let size = || prop_oneof![0.01..100.0, (1_u16..1000).prop_map(|count| f64::from(count) / 10.0)];
    // At most 1300 m from a vehicle of `ego`, along any axes.
    (-600.0..600.0, -600.0..600.0, direction(), size(), size()).prop_map(
        |(x, y, [cos, sin], length, width)| {
            let [origin_x, origin_y] = frame().point();
            Detection { x: origin_x + x, y: origin_y + y, cos, sin, length, width }
        },
    )
}

fn track() -> impl Strategy<Value = Track> {
    (0..=255_i64, rectangle(), -150.0..150.0, -150.0..150.0).prop_map(|(id, it, vx, vy)| {
        let Detection { x, y, cos, sin, length, width } = it;
        Track { id, x, y, cos, sin, vx, vy, length, width }
    })
}

fn ego() -> impl Strategy<Value = Ego> {
    let size = (0.05..15.0, 0.05..6.0, -7.0..7.0);
    (-300.0..300.0, -300.0..300.0, direction(), 0.0..150.0, size).prop_map(
        |(x, y, [cos, sin], speed, (length, width, center_offset))| {
            let [origin_x, origin_y] = frame().point();
            Ego { x: origin_x + x, y: origin_y + y, cos, sin, speed, length, width, center_offset }
        },
    )
}

fn point(stamp_ns: i64) -> impl Strategy<Value = TrajectoryPoint> {
    (0..100_000_000_000_i64, -1e5..1e5, -1e5..1e5, direction()).prop_map(
        move |(since, x, y, [cos, sin])| TrajectoryPoint { t_ns: stamp_ns + since, x, y, cos, sin },
    )
}

fn message() -> impl Strategy<Value = Message> {
    let ages = -1_400_000_000..1_400_000_000_i64;
    let times = (-1_000_000_000_000_000_000..1_000_000_000_000_000_000_i64, ages);
    let group = prop_oneof![Just(Group::Mot), Just(Group::Plan)];
    let plain = (group, 0..=i64::MAX, any::<[bool; 2]>(), 0..7_u8).prop_map(
        |(group, session, [mot, plan], kind)| match kind {
            0 => Payload::Offer { groups: Groups { mot, plan } },
            1 => Payload::Withdraw,
            2 => Payload::Confirm { group, session },
            3 => Payload::Reject { group, session },
            4 => Payload::Request { group, session },
            5 => Payload::Release { group, session },
            _ => Payload::Alive { group, session },
        },
    );
    let stations = (1..=i64::from(u32::MAX), 0..=i64::from(u32::MAX));
    (stations, times).prop_flat_map(move |((sender, receiver), (generated_ns, age))| {
        let stamp_ns = generated_ns - age;
        let session = 1;
        let tracks = prop::collection::vec(track(), 0..=128);
        let points = prop::collection::vec(point(stamp_ns), 0..100);
        let detections = prop::collection::vec(rectangle(), 0..=128);
        prop_oneof![
            plain.clone(),
            tracks.prop_map(move |tracks| Payload::Tracks { session, stamp_ns, tracks }),
            points.prop_map(move |points| Payload::Trajectory { session, stamp_ns, points }),
            ego().prop_map(move |ego| Payload::State { stamp_ns, ego }),
            (ego(), detections).prop_map(move |(ego, detections)| Payload::Detections {
                stamp_ns,
                ego,
                detections
            }),
        ]
        .prop_map(move |payload| Message { sender, receiver, generated_ns, payload })
    })
}

/// At most so many ns before, and not after.
fn is_rounded_down(sent: i64, arrived: i64) -> bool {
    (0..1_000_000).contains(&(sent - arrived))
}

/// At least as large, by less than 0.1 m more.
fn is_rounded_up(sent: f64, arrived: f64) -> bool {
    (0.0..0.1 + DOUBLES).contains(&(arrived - sent))
}

fn is_near(sent: f64, arrived: f64, bound: f64) -> bool {
    (sent - arrived).abs() <= bound + DOUBLES
}

fn is_turned_by(sent: [f64; 2], arrived: [f64; 2], degrees: f64) -> bool {
    let cross = sent[0] * arrived[1] - sent[1] * arrived[0];
    let dot = sent[0] * arrived[0] + sent[1] * arrived[1];
    cross.atan2(dot).to_degrees().abs() <= degrees + 1e-9
}

fn same_rectangle(sent: &Detection, arrived: &Detection, bound: f64) -> bool {
    let apart = (sent.x - arrived.x).hypot(sent.y - arrived.y);
    apart <= bound * 2.0_f64.sqrt() + DOUBLES
        && is_turned_by([sent.cos, sent.sin], [arrived.cos, arrived.sin], 0.05)
        && is_rounded_up(sent.length, arrived.length)
        && is_rounded_up(sent.width, arrived.width)
}

fn same_track(sent: &Track, arrived: &Track) -> bool {
    let of = |&Track { x, y, cos, sin, length, width, .. }: &Track| Detection {
        x,
        y,
        cos,
        sin,
        length,
        width,
    };
    same_rectangle(&of(sent), &of(arrived), 0.005)
        && is_near(sent.x, arrived.x, 0.005)
        && is_near(sent.y, arrived.y, 0.005)
        && is_near(sent.vx, arrived.vx, 0.005)
        && is_near(sent.vy, arrived.vy, 0.005)
        && sent.id == arrived.id
}

/// 0.1 microdegree of latitude is at most 1.117 cm, of longitude less.
fn same_ego(sent: &Ego, arrived: &Ego) -> bool {
    let offsets = is_near(sent.center_offset, arrived.center_offset, 0.005);
    // The reference point is found to half a count; what the heading is turned by does not move it.
    is_near(sent.x, arrived.x, 0.0056)
        && is_near(sent.y, arrived.y, 0.0056)
        && is_turned_by([sent.cos, sent.sin], [arrived.cos, arrived.sin], 0.05)
        && is_near(sent.speed, arrived.speed, 0.005)
        && is_rounded_up(sent.length, arrived.length)
        && is_rounded_up(sent.width, arrived.width)
        && offsets
}

fn same_point(sent: &TrajectoryPoint, arrived: &TrajectoryPoint) -> bool {
    is_near(sent.x, arrived.x, 0.0005)
        && is_near(sent.y, arrived.y, 0.0005)
        && is_turned_by([sent.cos, sent.sin], [arrived.cos, arrived.sin], 0.005)
        && (sent.t_ns - arrived.t_ns).abs() <= 500
}

fn all_same<T>(sent: &[T], arrived: &[T], same: impl Fn(&T, &T) -> bool) -> bool {
    sent.len() == arrived.len()
        && sent.iter().zip(arrived).all(|(sent, arrived)| same(sent, arrived))
}

/// Whether one payload arrives as the other.
fn same_payload(sent: &Payload, arrived: &Payload) -> bool {
    match (sent, arrived) {
        (
            Payload::Tracks { session, stamp_ns, tracks },
            Payload::Tracks { session: same_session, stamp_ns: stamp, tracks: list },
        ) => {
            session == same_session
                && is_rounded_down(*stamp_ns, *stamp)
                && all_same(tracks, list, same_track)
        }
        (
            Payload::Trajectory { session, stamp_ns, points },
            Payload::Trajectory { session: same_session, stamp_ns: stamp, points: list },
        ) => session == same_session && stamp_ns == stamp && all_same(points, list, same_point),
        (Payload::State { stamp_ns, ego }, Payload::State { stamp_ns: stamp, ego: arrived }) => {
            is_rounded_down(*stamp_ns, *stamp) && same_ego(ego, arrived)
        }
        (
            Payload::Detections { stamp_ns, ego, detections },
            Payload::Detections { stamp_ns: stamp, ego: arrived, detections: list },
        ) => {
            is_rounded_down(*stamp_ns, *stamp)
                && same_ego(ego, arrived)
                && all_same(detections, list, |sent, arrived| same_rectangle(sent, arrived, 0.005))
        }
        (sent, arrived) => sent == arrived,
    }
}

/// The law: what arrives is what was sent, to within the rounding, and is sent again as the same bytes.
fn arrives(message: &Message, frame: &Frame) -> Result<(), String> {
    let bytes = encode(message, frame).map_err(|error| format!("not written: {error}"))?;
    let arrived = decode(&bytes, frame).map_err(|error| format!("not read: {error}"))?;
    let Message { sender, receiver, generated_ns, ref payload } = *message;
    let envelope = (arrived.sender, arrived.receiver, arrived.generated_ns);
    if envelope != (sender, receiver, generated_ns) || !same_payload(payload, &arrived.payload) {
        return Err(format!("{message:?}\narrived as\n{arrived:?}"));
    }
    match encode(&arrived, frame) {
        Ok(again) if again == bytes => Ok(()),
        again => Err(format!("{bytes:?}\nwas sent again as\n{again:?}")),
    }
}

#[test]
fn a_message_of_every_kind_arrives() {
    for message in messages() {
        arrives(&message, &frame()).unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    // LINK-15, LINK-16 LINK-17 LINK-04
    #[test]
    fn messages_arrive_to_within_the_rounding(message in message()) {
        arrives(&message, &frame()).map_err(TestCaseError::fail)?;
    }
}

/// LINK-02: anywhere on the earth but near the poles, and on maps whose coordinates are
/// large.
#[test]
fn every_reference_position_will_do() {
    for latitude in [-800_000_000, -1, 0, 450_000_000, 800_000_000] {
        for longitude in [-1_790_000_000, 0, 1_790_000_000] {
            for point in [[0.0, 0.0], [5e5, 5.4e6], [-16_777_216.0, 16_777_216.0]] {
                let here = Frame::new(latitude, longitude, point).unwrap();
                let moved = |x: f64, y: f64| {
                    let [old_x, old_y] = frame().point();
                    (x - old_x + point[0], y - old_y + point[1])
                };
                for mut message in messages() {
                    match &mut message.payload {
                        Payload::Tracks { tracks, .. } => {
                            tracks.iter_mut().for_each(|it| (it.x, it.y) = moved(it.x, it.y));
                        }
                        Payload::Trajectory { points, .. } => {
                            points.iter_mut().for_each(|it| (it.x, it.y) = moved(it.x, it.y));
                        }
                        Payload::State { ego, .. } => (ego.x, ego.y) = moved(ego.x, ego.y),
                        Payload::Detections { ego, detections, .. } => {
                            (ego.x, ego.y) = moved(ego.x, ego.y);
                            detections.iter_mut().for_each(|it| (it.x, it.y) = moved(it.x, it.y));
                        }
                        _ => {}
                    }
                    arrives(&message, &here).unwrap();
                }
            }
        }
    }
}
