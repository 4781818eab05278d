//! Attacks on the remote services, injected into a drive (paper Sec. V-B, and the findings of
//! `spec/3-stages.md#findings`). An attack changes what the CAV receives, never what it measures
//! itself: ego, detections, lead, route and grid stay as they are.

use std::fmt;
use std::str::FromStr;

use mufasa_model::cycle::{Cycle, Track, Trajectory, TrajectoryPoint};

use super::Drive;
use super::geometry::{Point, Polyline, add, direction, distance, scale, sub};

/// What an attacker does to the received data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Attack {
    /// The planner is given another map: its trajectory leads off to the left by the width of
    /// the corridor (the paper's first attack).
    WrongMap,
    /// Track lists are emptied, and the trajectory, planned without them, goes on at speed (the
    /// paper's second attack).
    EmptyTracks,
    /// Three tracks of objects that are not there, ahead on the path and on both sides (the
    /// paper's third attack).
    GhostTracks,
    /// True positions, velocities 10 m/s too fast forwards, and a trajectory that believes them
    /// (F-13).
    FalseVelocities,
    /// True positions, sizes of a hand, and a trajectory that believes them (F-15).
    FalseSizes,
    /// The trajectory leads backwards along the path (F-10).
    Backwards,
    /// The trajectory of the first attacked cycle again and again, under fresh stamps (F-16).
    Frozen,
    /// Trajectory and tracks arrive 300 ms late, with true stamps.
    Late,
    /// The points of the trajectory come three times too soon (F-22).
    TooFast,
}

impl Attack {
    /// All attacks.
    pub const ALL: [Self; 9] = [
        Self::WrongMap,
        Self::EmptyTracks,
        Self::GhostTracks,
        Self::FalseVelocities,
        Self::FalseSizes,
        Self::Backwards,
        Self::Frozen,
        Self::Late,
        Self::TooFast,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::WrongMap => "wrong-map",
            Self::EmptyTracks => "empty-tracks",
            Self::GhostTracks => "ghost-tracks",
            Self::FalseVelocities => "false-velocities",
            Self::FalseSizes => "false-sizes",
            Self::Backwards => "backwards",
            Self::Frozen => "frozen",
            Self::Late => "late",
            Self::TooFast => "too-fast",
        }
    }
}

impl FromStr for Attack {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|a| a.name() == text).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            format!("`{text}` is no attack; known are {names}")
        })
    }
}

/// An attack and its time, in seconds since the first cycle of a drive, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Injection {
    /// What is done.
    pub attack: Attack,
    /// First attacked time, s.
    pub from_s: f64,
    /// Last attacked time, s.
    pub to_s: f64,
}

/// `NAME@FROM..TO`, such as `wrong-map@2..3.5`; either bound may be left out.
impl FromStr for Injection {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, span) = text.split_once('@').unwrap_or((text, ".."));
        let attack = name.parse()?;
        let (from, to) = span
            .split_once("..")
            .ok_or_else(|| format!("`{span}` is not of the form FROM..TO, in seconds"))?;
        let bound = |text: &str, open: f64| {
            if text.is_empty() {
                return Ok(open);
            }
            match text.parse::<f64>() {
                Ok(s) if s >= 0.0 => Ok(s),
                _ => Err(format!("`{text}` is no time in seconds")),
            }
        };
        Ok(Self { attack, from_s: bound(from, 0.0)?, to_s: bound(to, f64::INFINITY)? })
    }
}

impl fmt::Display for Injection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}..", self.attack.name(), self.from_s)?;
        if self.to_s.is_finite() { write!(f, "{}", self.to_s) } else { Ok(()) }
    }
}

/// The same drive under attack. The true `previous_tracks` stay: H-09 keeps the last list that
/// was found good, which an attacked one is not taken to be.
#[must_use]
pub fn inject(drive: &Drive, injection: &Injection) -> Drive {
    let mut attacked = drive.clone();
    attacked.name = format!("{}+{}", drive.name, injection.attack.name());
    let start_ns = drive.cycles.first().map_or(0, |c| c.cycle.now_ns);
    let mut first: Option<Trajectory> = None;
    let mut count = 0;
    for cycle in attacked.cycles.iter_mut().map(|c| &mut c.cycle) {
        let since_ns = cycle.now_ns.saturating_sub(start_ns);
        #[expect(clippy::cast_precision_loss, reason = "drives last minutes")]
        let since_s = since_ns as f64 / 1e9;
        if (injection.from_s..=injection.to_s).contains(&since_s) {
            if first.is_none() {
                first.clone_from(&cycle.trajectory);
            }
            attack(cycle, injection.attack, first.as_ref());
            count += 1;
        }
    }
    attacked.notes.push(format!("attack {injection} s changes {count} cycles"));
    attacked
}

/// How late the data of `Late` are, ns.
const LATE_NS: i64 = 300_000_000;
/// How much faster the objects of `FalseVelocities` are, m/s.
const FASTER: f64 = 10.0;
/// Sides of the objects of `FalseSizes`, m.
const TINY: f64 = 0.1;
/// Ids of ghosts count down from here.
const GHOST_ID: i64 = -1;
/// Ghosts: ahead along the path and to the left, m.
const GHOSTS: [Point; 3] = [[15.0, 0.0], [10.0, 4.0], [20.0, -4.0]];

fn attack(cycle: &mut Cycle, attack: Attack, first: Option<&Trajectory>) {
    let planner = Planner::new(cycle);
    match attack {
        Attack::WrongMap => {
            let aside = planner.width;
            planner.replan(cycle, |s| s, aside);
        }
        Attack::EmptyTracks => {
            each_track(cycle, |_| None);
            planner.replan(cycle, |s| s, 0.0);
        }
        Attack::GhostTracks => {
            let ghosts = planner.ghosts(cycle);
            if let Some(list) = &mut cycle.tracks {
                list.items.extend(ghosts);
            }
        }
        Attack::FalseVelocities => {
            each_track(cycle, |t| {
                let (vx, vy) = (t.vx + FASTER * t.cos, t.vy + FASTER * t.sin);
                Some(Track { vx, vy, ..t.clone() })
            });
            planner.replan(cycle, |s| s, 0.0);
        }
        Attack::FalseSizes => {
            each_track(cycle, |t| Some(Track { length: TINY, width: TINY, ..t.clone() }));
            planner.replan(cycle, |s| s, 0.0);
        }
        Attack::Backwards => planner.replan(cycle, |s| -s, 0.0),
        Attack::Frozen => freeze(cycle, first),
        Attack::Late => {
            if let Some(list) = &mut cycle.tracks {
                list.stamp_ns = list.stamp_ns.saturating_sub(LATE_NS);
            }
            if let Some(trajectory) = &mut cycle.trajectory {
                trajectory.stamp_ns = trajectory.stamp_ns.saturating_sub(LATE_NS);
            }
        }
        Attack::TooFast => {
            let now_ns = cycle.now_ns;
            for point in cycle.trajectory.iter_mut().flat_map(|t| &mut t.points) {
                point.t_ns = now_ns.saturating_add(point.t_ns.saturating_sub(now_ns) / 3);
            }
        }
    }
}

fn each_track(cycle: &mut Cycle, change: impl Fn(&Track) -> Option<Track>) {
    if let Some(list) = &mut cycle.tracks {
        list.items = list.items.iter().filter_map(change).collect();
    }
}

/// The first trajectory with its times moved to now.
fn freeze(cycle: &mut Cycle, first: Option<&Trajectory>) {
    let (Some(first), Some(current)) = (first, cycle.trajectory.as_mut()) else { return };
    let Some(start_ns) = first.points.first().map(|p| p.t_ns) else { return };
    current.points = first
        .points
        .iter()
        .map(|p| TrajectoryPoint {
            t_ns: p.t_ns.saturating_sub(start_ns).saturating_add(cycle.now_ns),
            ..p.clone()
        })
        .collect();
}

/// A planner that knows the route and nothing else.
struct Planner {
    path: Polyline,
    /// Of the corridor where the CAV is, m.
    width: f64,
    /// Place and offset of the CAV on the path, m.
    start: (f64, f64),
}

/// Trajectories of the attacks: points 100 ms apart over 5 s.
const POINTS: u32 = 50;
const STEP_S: f64 = 0.1;
/// A careless planner speeds up with this, m/s^2, until it drives at least so fast, m/s.
const PULL: f64 = 2.0;
const CRUISE: f64 = 8.0;
/// A wrong lane is reached after this way, m, or this time, s.
const ASIDE: [f64; 2] = [15.0, 2.0];

impl Planner {
    fn new(cycle: &Cycle) -> Self {
        let mut points: Vec<Point> = cycle.route.stations.iter().map(|s| [s.x, s.y]).collect();
        if cycle.route.closed {
            points.extend(points.first().copied());
        }
        let path = Polyline::new(points);
        let ego = [cycle.ego.x, cycle.ego.y];
        let foot = path.project(ego);
        let near = |s: f64| {
            let station = &cycle.route.stations[path.locate(s).0];
            distance(station.left, station.right)
        };
        let width = foot.map_or(3.5, |f| near(f.s));
        Self { width, start: foot.map_or((0.0, 0.0), |f| (f.s, f.lateral)), path }
    }

    /// The place `lateral` left of the path at arc length `s`; beyond its ends it goes straight
    /// on. `None` when there is no path.
    fn place(&self, s: f64, lateral: f64) -> Option<Point> {
        if self.path.points.len() < 2 {
            return None;
        }
        let (i, _) = self.path.locate(s);
        let (a, b) = (self.path.points[i], self.path.points[i + 1]);
        let length = distance(a, b);
        if length <= 0.0 {
            return None;
        }
        let along = scale(sub(b, a), 1.0 / length);
        let foot = add(a, scale(along, s - self.path.arc[i]));
        Some(add(foot, scale([-along[1], along[0]], lateral)))
    }

    /// A new trajectory from the CAV along the path, at its speed or faster, `aside` to the left
    /// of where it would be; `way` turns the way made good into the way along the path.
    fn replan(&self, cycle: &mut Cycle, way: impl Fn(f64) -> f64, aside: f64) {
        let now_ns = cycle.now_ns;
        let ego = &cycle.ego;
        let (s0, lateral0) = self.start;
        let ramp = ASIDE[0].max(ASIDE[1] * ego.speed);
        let mut points =
            vec![TrajectoryPoint { t_ns: now_ns, x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin }];
        let (mut speed, mut driven) = (ego.speed, 0.0);
        for k in 1..=POINTS {
            let faster = (speed + PULL * STEP_S).min(CRUISE).max(speed);
            driven += speed.midpoint(faster) * STEP_S;
            speed = faster;
            let made = way(driven);
            let u = (driven / ramp).min(1.0);
            let lateral = lateral0 + aside * u * u * (3.0 - 2.0 * u);
            let Some([x, y]) = self.place(s0 + made, lateral) else { return };
            // The heading is that of the step, or of its reverse when driving backwards.
            let last = &points[points.len() - 1];
            let step = if made < 0.0 { [last.x - x, last.y - y] } else { [x - last.x, y - last.y] };
            let still = step[0].hypot(step[1]) < 1e-6;
            let [cos, sin] =
                if still { [last.cos, last.sin] } else { direction(step[1].atan2(step[0])) };
            let t_ns = now_ns.saturating_add(i64::from(k) * 100_000_000);
            points.push(TrajectoryPoint { t_ns, x, y, cos, sin });
        }
        if let Some(trajectory) = &mut cycle.trajectory {
            trajectory.points = points;
        }
    }

    /// Standing cars where there are none.
    fn ghosts(&self, cycle: &Cycle) -> Vec<Track> {
        let ego = &cycle.ego;
        let place = |ahead: f64, left: f64| {
            self.place(self.start.0 + ahead, left).unwrap_or([ego.x + ahead, ego.y + left])
        };
        let ids = (0..).map(|i: i64| GHOST_ID - i);
        GHOSTS
            .iter()
            .zip(ids)
            .map(|([ahead, left], id)| {
                let [x, y] = place(*ahead, *left);
                let (cos, sin) = (ego.cos, ego.sin);
                Track { id, x, y, cos, sin, vx: 0.0, vy: 0.0, length: 4.5, width: 1.8 }
            })
            .collect()
    }
}
