//! Cycles as they are when remote data were sent.

use mufasa::input::cycle as twin;
use mufasa_link::message::{EncodeError, Frame, Message, Payload, decode, encode};
use mufasa_model::input::cycle::{Cycle, Track, TrackList, Trajectory, TrajectoryPoint};

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

    /// The cycle with what arrives in place of what was made; the message is made when the CAV decides.
    pub fn arrives(self, cycle: &Cycle, frame: &Frame) -> Result<Cycle, EncodeError> {
        let mut cycle = cycle.clone();
        if self == Self::LateStamps {
            shift(&mut cycle, 999_999);
        }
        if self != Self::Trajectory
            && let Some(list) = cycle.tracks.take()
        {
            cycle.tracks = Some(tracks(&list, cycle.now_ns, frame)?);
        }
        if self != Self::Tracks
            && let Some(made) = cycle.trajectory.take()
        {
            let coarse = self == Self::CoarseTrajectory;
            let made = if coarse { in_units_of_a_cpm(made, frame) } else { made };
            cycle.trajectory = Some(trajectory(&made, cycle.now_ns, frame)?);
        }
        Ok(cycle)
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

/// The list as it arrives. Its ids become places in the list, which fit: no verdict depends on them.
fn tracks(list: &TrackList, now_ns: i64, frame: &Frame) -> Result<TrackList, EncodeError> {
    let track = |(id, track): (i64, &Track)| {
        let &Track { id: _, x, y, cos, sin, vx, vy, length, width } = track;
        twin::Track { id, x, y, cos, sin, vx, vy, length, width }
    };
    let tracks = (0..).zip(&list.items).map(track).collect();
    let sent = Payload::Tracks { session: 1, stamp_ns: list.stamp_ns, tracks };
    let Payload::Tracks { stamp_ns, tracks, .. } = through(sent, now_ns, frame)? else {
        unreachable!("tracks arrive as tracks")
    };
    let back = |(track, old): (twin::Track, &Track)| {
        let twin::Track { id: _, x, y, cos, sin, vx, vy, length, width } = track;
        Track { id: old.id, x, y, cos, sin, vx, vy, length, width }
    };
    Ok(TrackList { stamp_ns, items: tracks.into_iter().zip(&list.items).map(back).collect() })
}

fn trajectory(made: &Trajectory, now_ns: i64, frame: &Frame) -> Result<Trajectory, EncodeError> {
    let point = |&TrajectoryPoint { t_ns, x, y, cos, sin }: &TrajectoryPoint| {
        twin::TrajectoryPoint { t_ns, x, y, cos, sin }
    };
    let points = made.points.iter().map(point).collect();
    let sent = Payload::Trajectory { session: 1, stamp_ns: made.stamp_ns, points };
    let Payload::Trajectory { stamp_ns, points, .. } = through(sent, now_ns, frame)? else {
        unreachable!("a trajectory arrives as one")
    };
    let back =
        |twin::TrajectoryPoint { t_ns, x, y, cos, sin }| TrajectoryPoint { t_ns, x, y, cos, sin };
    Ok(Trajectory { stamp_ns, points: points.into_iter().map(back).collect() })
}

fn in_units_of_a_cpm(mut made: Trajectory, frame: &Frame) -> Trajectory {
    let centimetres = |value: f64, origin: f64| origin + ((value - origin) * 100.0).round() / 100.0;
    for point in &mut made.points {
        let [x, y] = frame.point();
        (point.x, point.y) = (centimetres(point.x, x), centimetres(point.y, y));
        let degrees = point.sin.atan2(point.cos).to_degrees();
        (point.sin, point.cos) = ((degrees * 10.0).round() / 10.0).to_radians().sin_cos();
        point.t_ns = (point.t_ns + 500_000).div_euclid(1_000_000) * 1_000_000;
    }
    made
}
