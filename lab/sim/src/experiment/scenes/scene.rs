//! A scene: one other on its way to where the CAV will be, what is lied, and how the trajectory is moved.

use super::kinds::{Drive, Lie, Motion, Remote, Shift, Side, pick};
use super::other::{Line, Other};
use super::pace::Pace;
use super::way::{Change, Way};
use crate::collision;
use crate::pose::{Pose, Rectangle};
use crate::services::detectors::random::Draws;

/// Draws of a scene before one with somebody in the CAV at the start is taken.
const ATTEMPTS: u64 = 50;
/// Least distance at the start, m.
const APART: f64 = 0.5;
/// Sideways accelerations of the CAV in a bend, and of who turns, m/s^2.
const BEND: f64 = 3.0;
const TURN: f64 = 4.0;
/// Sharpest turn of the other, 1/m.
const SHARPEST: f64 = 0.2;

/// Of what kinds a scene is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kinds {
    /// What is remote.
    pub remote: Remote,
    /// How the trajectory is moved.
    pub shift: Shift,
    /// What is lied.
    pub lie: Lie,
    /// Where the other comes from.
    pub side: Side,
    /// What it does.
    pub motion: Motion,
    /// What the CAV does.
    pub drive: Drive,
}

/// Size of the CAV.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    pub(super) length: f64,
    pub(super) width: f64,
    pub(super) center_offset: f64,
}

/// By how much a trajectory is moved, of which a shift may be nothing.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moved {
    /// Of the first point, and how many times the speed, s, are added at most: m.
    pub(super) ahead: f64,
    pub(super) ahead_s: f64,
    /// Of its time, s.
    pub(super) later: f64,
    /// Of the first point, to the left, m.
    pub(super) aside: f64,
    /// Tangent of its turn.
    pub(super) turned: f64,
    /// Within what length it comes back, m.
    pub(super) fades: f64,
}

/// A scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Of what kinds it is.
    pub kinds: Kinds,
    pub(super) body: Body,
    pub(super) way: Way,
    pub(super) pace: Pace,
    pub(super) other: Other,
    pub(super) moved: Moved,
    /// Length of the trajectory, s.
    pub(super) plan: f64,
    /// When they meet if nobody reacts, s.
    pub(super) meeting: f64,
    /// Cosine and sine of the turn, and the factor, of a velocity that is lied.
    pub(super) velocity: [f64; 3],
    /// Factor of a size that is lied.
    pub(super) size: f64,
    /// Noise of the places of detections, m, and who draws it.
    pub(super) noise: f64,
    pub(super) seed: [u64; 2],
    /// Whether the gap to the other is measured, as to a leading vehicle.
    pub(super) has_lead: bool,
}

impl Scene {
    /// The scene of a seed with this number.
    pub fn new(seed: u64, number: u64) -> Self {
        let mut scene = Self::drawn([seed, number], 0);
        let apart = |scene: &Self| collision::distance(&scene.cav(0.0), &scene.object(0.0));
        for attempt in 1..ATTEMPTS {
            if apart(&scene) >= APART {
                break;
            }
            scene = Self::drawn([seed, number], attempt);
        }
        scene
    }

    /// Its kinds in one word.
    pub fn name(&self) -> String {
        let Kinds { remote, shift, lie, side, motion, drive } = self.kinds;
        let words =
            [remote.name(), shift.name(), lie.name(), side.name(), motion.name(), drive.name()];
        words.join("/")
    }

    /// The CAV when nobody stops it.
    pub(super) fn cav(&self, t: f64) -> Rectangle {
        self.cav_at(self.pace.at(t).0)
    }

    /// The CAV after so much of its way, m.
    pub(super) fn cav_at(&self, driven: f64) -> Rectangle {
        let Body { length, width, center_offset } = self.body;
        let pose = self.way.pose(driven, (0.0, 0.0));
        Rectangle { pose: Pose { at: pose.ahead(center_offset, 0.0), ..pose }, length, width }
    }

    /// The other.
    pub(super) fn object(&self, t: f64) -> Rectangle {
        self.other.at(&self.way, t)
    }

    fn drawn(seed: [u64; 2], attempt: u64) -> Self {
        let draws = &mut Draws::new([seed[0], seed[1], 21, attempt]);
        let kinds = kinds(draws);
        let body = Body {
            length: draws.between(4.0, 5.0),
            width: draws.between(1.8, 2.0),
            center_offset: draws.between(0.0, 1.4),
        };
        let meeting = draws.between(1.0, 6.0);
        let (way, pace) = driven(draws, kinds, meeting);
        let other = other(draws, kinds, (&way, &pace, body), meeting);
        let moved = moved(draws, kinds.shift, pace.at(meeting).1);
        let (sin, cos) = libm::sincos(draws.between(-1.5, 1.5));
        Self {
            kinds,
            body,
            way,
            pace,
            other,
            moved,
            plan: pick(draws, &[3.0, 5.0, 8.0]),
            meeting,
            velocity: [cos, sin, draws.between(0.2, 2.0)],
            size: draws.between(0.2, 0.8),
            noise: pick(draws, &[0.0, 0.0, 0.0, 0.05]),
            seed,
            has_lead: kinds.side == Side::AheadInLane && draws.share() < 0.5,
        }
    }
}

fn kinds(draws: &mut Draws) -> Kinds {
    let remote = pick(draws, &Remote::ALL);
    let (shift, lie) = (pick(draws, &Shift::ALL), pick(draws, &Lie::ALL));
    let (side, motion) = (pick(draws, &Side::ALL), pick(draws, &Motion::ALL));
    let drive = pick(draws, &Drive::ALL);
    Kinds {
        remote,
        shift,
        lie: if remote == Remote::Plan { Lie::True } else { lie },
        side,
        motion: match (side, motion) {
            (Side::Standing, Motion::Brakes | Motion::Turns) => Motion::Keeps,
            (_, motion) => motion,
        },
        drive: if shift == Shift::Ends { Drive::Stops } else { drive },
    }
}

/// Between two positive numbers, all orders of magnitude alike.
fn scaled(draws: &mut Draws, least: f64, most: f64) -> f64 {
    least * libm::exp(draws.share() * libm::log(most / least))
}

/// The way of the CAV, and how it goes along it.
fn driven(draws: &mut Draws, kinds: Kinds, meeting: f64) -> (Way, Pace) {
    let is_straight = draws.share() < 0.5;
    let radius = scaled(draws, 15.0, 200.0);
    let fastest = if is_straight { 30.0 } else { (BEND * radius).sqrt().min(30.0) };
    let speed = scaled(draws, 1.0, fastest);
    let acceleration = draws.between(0.5, 2.8);
    let pace = match kinds.drive {
        Drive::Keeps => Pace { speed, parts: Vec::new() },
        Drive::Creeps => Pace { speed: draws.between(0.3, 2.5), parts: Vec::new() },
        Drive::Starts => {
            let wait = draws.between(0.0, meeting / 2.0);
            Pace { speed: 0.0, parts: vec![(wait, 0.0), (speed / acceleration, acceleration)] }
        }
        Drive::SpeedsUp => {
            let slow = speed * draws.between(0.3, 0.9);
            let wait = draws.between(0.0, meeting / 2.0);
            let parts = vec![(wait, 0.0), ((speed - slow) / acceleration, acceleration)];
            Pace { speed: slow, parts }
        }
        Drive::Stops => {
            let stands = meeting - draws.between(-0.5, 1.0);
            Pace { speed, parts: Vec::new() }
                .braking((stands - speed / acceleration).max(0.0), acceleration)
        }
    };
    let met = pace.at(meeting).0;
    let sign = if draws.share() < 0.5 { 1.0 } else { -1.0 };
    let begins = draws.between(-5.0, met.max(10.0));
    let length = radius * draws.between(0.4, 2.6);
    let bend = if is_straight { (0.0, 0.0, 0.0) } else { (sign / radius, begins, length) };
    let lane = draws.between(2.5, 4.0) * if draws.share() < 0.5 { 1.0 } else { -1.0 };
    let length = (pace.at(meeting).1 * draws.between(2.6, 4.0)).max(12.0);
    let from = met - length * draws.between(0.3, 1.1);
    let change = Change { from, length, aside: lane };
    let is_change = kinds.shift == Shift::LaneChange;
    let way = Way::new(bend, is_change.then_some(change), pace.at(meeting + 20.0).0);
    (way, pace)
}

/// Who comes to where the CAV is when they meet.
fn other(
    draws: &mut Draws,
    kinds: Kinds,
    (way, pace, body): (&Way, &Pace, Body),
    meeting: f64,
) -> Other {
    let (size, fastest) = pick(
        draws,
        &[([4.5, 1.8], 30.0), ([12.0, 2.5], 25.0), ([1.8, 0.6], 10.0), ([0.5, 0.5], 3.0)],
    );
    let (met, cav_speed) = pace.at(meeting);
    let speed = match kinds.side {
        Side::Standing => 0.0,
        Side::AheadInLane => cav_speed * draws.share(),
        Side::Behind => cav_speed + draws.between(1.0, 10.0),
        Side::Crossing | Side::Oncoming | Side::Adjacent => scaled(draws, 0.4, fastest),
    };
    let from = draws.between(-0.3, meeting.min(2.0));
    let wait = from.max(0.0);
    let (brake, more) = (draws.between(1.0, 8.0), draws.between(0.5, 3.0));
    let parts = match kinds.motion {
        Motion::Keeps | Motion::Turns => Vec::new(),
        Motion::Brakes => vec![(wait, 0.0), (speed / brake, -brake)],
        Motion::SpeedsUp => vec![(wait, 0.0), (draws.between(1.0, 5.0), more)],
    };
    let pace = Pace { speed, parts };
    let sharpest = (TURN / (speed * speed).max(1.0)).min(SHARPEST);
    let curvature = sharpest * draws.between(-1.0, 1.0);
    let turn = (kinds.motion == Motion::Turns).then_some((wait, curvature));
    let line = Line::Straight(Pose::new(crate::pose::Point::default(), 0.0));
    let unaimed = Other { size, pace, line, turn };
    let spread = if draws.share() < 0.7 { [1.5, 0.7] } else { [8.0, 4.0] };
    let [ahead, left] = draws.normal_pair();
    let (ahead, left) = (ahead * spread[0], left * spread[1]);
    let beside = draws.between(2.0, 4.0) * if draws.share() < 0.5 { 1.0 } else { -1.0 };
    let left = left + if is_beside(draws, kinds) { beside } else { 0.0 };
    let shape = unaimed.shape(meeting);
    let pose = way.pose(met, (0.0, 0.0));
    let line = match kinds.side {
        Side::Crossing | Side::Standing => {
            let angle = draws.between(0.5, 2.6) * if draws.share() < 0.5 { 1.0 } else { -1.0 };
            let heading = pose.angle() + angle - shape.angle();
            let start = Pose::new(pose.ahead(body.center_offset + ahead, left), heading);
            Line::Straight(Pose { at: start.ahead(-shape.at.x, -shape.at.y), ..start })
        }
        Side::Oncoming | Side::Behind | Side::AheadInLane | Side::Adjacent => {
            let against = match kinds.side {
                Side::Oncoming => true,
                Side::Adjacent => draws.share() < 0.5,
                _ => false,
            };
            let sign = if against { -1.0 } else { 1.0 };
            let reference = way.reference(met);
            let (_, lane) = way.beside(reference, 0.0, 0.0).local(pose.at);
            let from = reference + body.center_offset + ahead - sign * shape.at.x;
            Line::Way { from, aside: lane + left - sign * shape.at.y, against }
        }
    };
    Other { line, ..unaimed }
}

/// Whether the other is aimed beside the CAV.
fn is_beside(draws: &mut Draws, kinds: Kinds) -> bool {
    let share = match (kinds.side, kinds.shift) {
        (_, Shift::LaneChange) | (Side::Crossing | Side::Standing | Side::AheadInLane, _) => 0.0,
        (Side::Adjacent, _) => 0.7,
        (Side::Oncoming, _) => 0.3,
        (Side::Behind, _) => 0.8,
    };
    draws.share() < share
}

/// Farthest that a trajectory begins ahead, m: with a time of its own, and without.
pub(super) const FARTHEST: f64 = 4.0;
const NEARER: f64 = 1.9;

/// What the shift does to the trajectory of a CAV of this speed, m/s.
fn moved(draws: &mut Draws, shift: Shift, speed: f64) -> Moved {
    let none = Moved { fades: (speed * draws.between(0.6, 1.5)).max(3.0), ..Moved::default() };
    // Near the most, more often than not.
    let (size, later) = (draws.share().max(draws.share()), draws.between(0.0, 0.1));
    let ahead = NEARER * size;
    match shift {
        Shift::None | Shift::Ends => none,
        Shift::Ahead => Moved { ahead, ..none },
        Shift::Aside => {
            Moved { aside: draws.between(-0.49, 0.49), turned: draws.between(-0.16, 0.16), ..none }
        }
        Shift::Old => Moved { ahead, ahead_s: later * size, later: -later, ..none },
        Shift::Early => Moved { ahead: -ahead, later, ..none },
        Shift::LaneChange => Moved { ahead: if draws.share() < 0.5 { 0.0 } else { ahead }, ..none },
    }
}
