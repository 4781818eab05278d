//! Cycles as they are when remote data were sent.

use mufasa::input::cycle::{Track, TrackList, Trajectory};
use mufasa_link::message::{EncodeError, Frame, Message, Payload, decode, encode};
use mufasa_model::input::cycle::{self as model, Cycle};
use mufasa_props::bridge::{from_impl, to_impl};

/// What of a cycle is sent, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Tracks and trajectory, over the link.
    Link,
    /// The tracks alone.
    Tracks,
    /// The trajectory alone.
    Trajectory,
    /// As `Link`, with all times of the cycle 999,999 ns later: the most that a stamp can lose.
    LateStamps,
    /// Tracks over the link, the trajectory in the units of a CPM: cm, 0.1 degree, ms.
    CoarseTrajectory,
}

impl Way {
    pub const ALL: [Self; 5] =
        [Self::Link, Self::Tracks, Self::Trajectory, Self::LateStamps, Self::CoarseTrajectory];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Link => "the link",
            Self::Tracks => "tracks alone",
            Self::Trajectory => "trajectory alone",
            Self::LateStamps => "the link, stamps 999,999 ns past the ms",
            Self::CoarseTrajectory => "the link, trajectory in cm, 0.1 degree and ms",
        }
    }

    /// The cycle with what arrives in place of what was made; the message is made when the CAV decides. Ids of
    /// tracks become places in their list, which fit: no verdict depends on them.
    pub fn arrives(self, cycle: &Cycle, frame: &Frame) -> Result<Cycle, EncodeError> {
        let mut cycle = cycle.clone();
        if self == Self::LateStamps {
            shift(&mut cycle, 999_999);
        }
        if self == Self::CoarseTrajectory {
            cycle.trajectory.iter_mut().for_each(|made| in_units_of_a_cpm(made, frame));
        }
        let (owned, now_ns) = (to_impl(&cycle), cycle.now_ns);
        let history = owned.history();
        let mut sent = owned.borrow(&history);
        let (items, arrived);
        if self != Self::Trajectory
            && let Some(list) = sent.tracks
        {
            let tracks = (0..).zip(list.items).map(|(id, track)| Track { id, ..*track }).collect();
            let tracks = Payload::Tracks { session: 1, stamp_ns: list.stamp_ns, tracks };
            let Payload::Tracks { stamp_ns, tracks, .. } = through(tracks, now_ns, frame)? else {
                unreachable!("tracks arrive as tracks")
            };
            let named = tracks.into_iter().zip(list.items);
            items = named.map(|(track, made)| Track { id: made.id, ..track }).collect::<Vec<_>>();
            sent.tracks = Some(TrackList { stamp_ns, items: &items });
        }
        if self != Self::Tracks
            && let Some(Trajectory { stamp_ns, points }) = sent.trajectory
        {
            let made = Payload::Trajectory { session: 1, stamp_ns, points: points.to_vec() };
            let Payload::Trajectory { stamp_ns, points, .. } = through(made, now_ns, frame)? else {
                unreachable!("a trajectory arrives as one")
            };
            arrived = points;
            sent.trajectory = Some(Trajectory { stamp_ns, points: &arrived });
        }
        Ok(from_impl(&sent))
    }
}

fn shift(cycle: &mut Cycle, by_ns: i64) {
    cycle.now_ns += by_ns;
    if let Some(trajectory) = &mut cycle.trajectory {
        trajectory.stamp_ns += by_ns;
        trajectory.points.iter_mut().for_each(|point| point.t_ns += by_ns);
    }
    cycle.tracks.iter_mut().for_each(|list| list.stamp_ns += by_ns);
    cycle.detections.iter_mut().for_each(|list| list.stamp_ns += by_ns);
    cycle.lead.iter_mut().for_each(|lead| lead.stamp_ns += by_ns);
    cycle.grid.iter_mut().for_each(|grid| grid.stamp_ns += by_ns);
    cycle.detection_history.iter_mut().for_each(|list| list.stamp_ns += by_ns);
}

/// A payload as it arrives.
fn through(payload: Payload, generated_ns: i64, frame: &Frame) -> Result<Payload, EncodeError> {
    let message = Message { sender: 1, receiver: 2, generated_ns, payload };
    let bytes = encode(&message, frame)?;
    Ok(decode(&bytes, frame).expect("what was written can be read").payload)
}

fn in_units_of_a_cpm(made: &mut model::Trajectory, frame: &Frame) {
    let centimetres = |value: f64, origin: f64| origin + ((value - origin) * 100.0).round() / 100.0;
    for point in &mut made.points {
        let [x, y] = frame.point();
        (point.x, point.y) = (centimetres(point.x, x), centimetres(point.y, y));
        let degrees = point.sin.atan2(point.cos).to_degrees();
        (point.sin, point.cos) = ((degrees * 10.0).round() / 10.0).to_radians().sin_cos();
        point.t_ns = (point.t_ns + 500_000).div_euclid(1_000_000) * 1_000_000;
    }
}
