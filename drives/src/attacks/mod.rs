//! Attacks on the remote services, injected into a drive (paper Sec. V-B, and the findings of
//! `spec/3-stages.md#findings`). An attack changes what the CAV receives, never what it measures
//! itself: detections and their history, route and grid stay as they are (but for
//! [`Attack::BlindDetectors`]), and so do ego and lead unless the CAV is shown driving what it is
//! sent.
//!
//! Data are received where the configuration of the cycle says that their group is remote: tracks
//! in `AllRemote` and `MotRemote`, the trajectory in `AllRemote` and `PlanRemote`. Local data of
//! the other group may change in one way: in `MotRemote` the local planner plans with the received
//! tracks, so where those hide objects the local trajectory believes them, too. In `PlanRemote`
//! the tracks are the CAV's own, and an attack on tracks is none.

mod course;
pub mod error;
pub mod injection;
mod meeting;
mod objects;
mod planner;

use mufasa_model::input::cycle::{Cycle, Track, Trajectory, TrajectoryPoint};

use crate::attacks::course::Course;
use crate::attacks::error::InjectError;
use crate::attacks::injection::{Attack, Injection};
use crate::attacks::planner::Planner;
use crate::drive::Stream;
use crate::geometry::Polyline;

/// The same drive under attack. The drive is gone through once for what the attack does, and its cycles
/// are made again when they are asked for: none is kept.
///
/// Attacks that hide objects or their motion are dangerous only when the CAV drives what it is
/// sent, so in these it does: it leaves its recorded motion at the first attacked cycle, and the
/// drive ends with the last one, because nobody recorded what comes then. Its notes say what the
/// CAV would drive into.
///
/// Errors: no cycle is changed, because none is in the span, or the data of the attack are local,
/// absent, or as it would make them. An attacked drive that is safe is so in spite of the attack.
pub fn inject(drive: &Stream, injection: &Injection) -> Result<Stream, InjectError> {
    let (course, onset) = Course::of(drive, *injection)?;
    let (attack, clean, targets) = (injection.attack, drive.clone(), course.targets);
    let name = format!("{}+{}", drive.name, attack.name());
    let count = targets.len();
    let mut attacked = Stream::new(name, drive.source.clone(), count, move |index| {
        let mut made = clean.cycle(index);
        if let Some(target) = targets[index] {
            apply(&mut made.cycle, attack, &onset, target);
        }
        made
    });
    attacked.lead_range_m = drive.lead_range_m;
    attacked.notes = drive.notes.iter().cloned().chain(course.notes).collect();
    Ok(attacked)
}

#[expect(clippy::cast_precision_loss, reason = "drives last minutes")]
fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}

/// The first attacked cycle.
struct Onset {
    now_ns: i64,
    /// Of its scan.
    scan_ns: i64,
    trajectory: Option<Trajectory>,
    planner: Planner,
    /// What the CAV follows when it drives what it is sent.
    line: Polyline,
    lead_range_m: f64,
}

impl Onset {
    /// The attack begins with this cycle; an attack that would have the CAV drive what it is sent
    /// begins when there is something to hide.
    fn new(
        cycle: &Cycle,
        attack: Attack,
        lead_range_m: f64,
        clean: impl FnOnce() -> Polyline,
    ) -> Option<Self> {
        let with = |line: Polyline| Self {
            now_ns: cycle.now_ns,
            scan_ns: cycle.detections.as_ref().map_or(cycle.now_ns, |list| list.stamp_ns),
            trajectory: cycle.trajectory.clone(),
            planner: Planner::along(line.clone(), cycle),
            line,
            lead_range_m,
        };
        let onset = with(Polyline::new(Vec::new()));
        if !attack.is_driven() {
            return Some(onset);
        }
        let mut told = cycle.clone();
        change(&mut told, attack, &onset, None);
        (told != *cycle).then(|| with(clean()))
    }

    /// Whether the CAV has come to the end of its line when it drives what it is sent.
    fn is_at_the_end(&self, cycle: &Cycle) -> bool {
        let mut there = cycle.clone();
        self.planner.execute(&mut there, self.time_s(cycle), &[], self.lead_range_m);
        Planner::along(self.line.clone(), &there).is_at_the_end(&there)
    }

    fn time_s(&self, cycle: &Cycle) -> f64 {
        seconds(cycle.now_ns.saturating_sub(self.now_ns))
    }
}

/// How late the data of `Late` are, ns.
const LATE_NS: i64 = 300_000_000;
/// How much faster the objects of `FalseVelocities` are, m/s.
const FASTER: f64 = 10.0;
/// Sides of the objects of `FalseSizes`, m.
const TINY: f64 = 0.1;
/// `Slide`: sideways from point to point, in widths of the CAV (the bound is 0.5); in all, m.
const SLIDE_STEP: f64 = 0.45;
const SLIDE: f64 = 1.4;

/// Attacks a cycle. `target`: the object that the attack was on before; returned is the one that it
/// is on now.
fn apply(cycle: &mut Cycle, attack: Attack, onset: &Onset, target: Option<i64>) -> Option<i64> {
    if attack.is_driven() {
        let time_s = onset.time_s(cycle);
        let objects = cycle.tracks.as_ref().map_or_else(Vec::new, |t| t.items.clone());
        onset.planner.execute(cycle, time_s, &objects, onset.lead_range_m);
        Planner::along(onset.line.clone(), cycle).replan(cycle, false, 0.0);
    }
    change(cycle, attack, onset, target)
}

/// What is sent in place of the truth; the target as of [`apply`].
fn change(cycle: &mut Cycle, attack: Attack, onset: &Onset, target: Option<i64>) -> Option<i64> {
    match attack {
        Attack::MissingTrack => return on_target(cycle, target, |_| true, objects::leave_out),
        Attack::ExchangedPasts => {
            return on_target(cycle, target, |_| true, objects::exchange_pasts);
        }
        Attack::TakenPast => return on_target(cycle, target, |_| true, objects::take_past),
        Attack::PastGhost => {
            return on_target(cycle, target, objects::leaves, objects::add_past_ghost);
        }
        Attack::WrongMap => {
            let planner = Planner::new(cycle);
            planner.replan(cycle, false, planner.width);
        }
        Attack::EmptyTracks => each_track(cycle, |_| None),
        Attack::GhostTracks => {
            let ghosts = Planner::new(cycle).ghosts(&cycle.ego);
            if let Some(list) = &mut cycle.tracks {
                list.items.extend(ghosts);
            }
        }
        Attack::FalseVelocities => each_track(cycle, |t| {
            let (vx, vy) = (t.vx + FASTER * t.cos, t.vy + FASTER * t.sin);
            Some(Track { vx, vy, ..t.clone() })
        }),
        Attack::FalseSizes => {
            each_track(cycle, |t| Some(Track { length: TINY, width: TINY, ..t.clone() }));
        }
        Attack::Backwards => Planner::new(cycle).replan(cycle, true, 0.0),
        Attack::Frozen => freeze(cycle, onset.trajectory.as_ref()),
        Attack::Late => {
            let remote = cycle.configuration.remote();
            if let Some(list) = cycle.tracks.as_mut().filter(|_| remote.mot) {
                list.stamp_ns = list.stamp_ns.saturating_sub(LATE_NS);
            }
            if let Some(trajectory) = cycle.trajectory.as_mut().filter(|_| remote.plan) {
                trajectory.stamp_ns = trajectory.stamp_ns.saturating_sub(LATE_NS);
            }
        }
        Attack::TooFast => {
            let now_ns = cycle.now_ns;
            for point in cycle.trajectory.iter_mut().flat_map(|t| &mut t.points) {
                point.t_ns = now_ns.saturating_add(point.t_ns.saturating_sub(now_ns) / 3);
            }
        }
        Attack::CrossingStands => objects::stop_crossing(cycle),
        Attack::VelocityBias => objects::bias_velocities(cycle),
        Attack::BlindDetectors => {
            each_track(cycle, |_| None);
            objects::blind(cycle, onset.scan_ns);
        }
        Attack::Slide => slide(cycle),
    }
    None
}

/// Attacks one object, the same as in the cycles before, or else of those that are wanted the one
/// nearest to the path.
fn on_target(
    cycle: &mut Cycle,
    target: Option<i64>,
    wanted: impl Fn(&Track) -> bool,
    change: impl Fn(&mut Cycle, &Track),
) -> Option<i64> {
    let target = objects::target(cycle, target, wanted)?;
    change(cycle, &target);
    Some(target.id)
}

/// Moves the points to the left, nearly half a width each, as far as most lanes are wide.
fn slide(cycle: &mut Cycle) {
    let step = SLIDE_STEP * cycle.ego.width;
    let mut aside: f64 = 0.0;
    for point in cycle.trajectory.iter_mut().flat_map(|t| &mut t.points).skip(1) {
        aside = (aside + step).min(SLIDE);
        (point.x, point.y) = (point.x - aside * point.sin, point.y + aside * point.cos);
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
    let moved = |t_ns: i64| t_ns.saturating_sub(start_ns).saturating_add(cycle.now_ns);
    let points = first.points.iter();
    current.points = points.map(|p| TrajectoryPoint { t_ns: moved(p.t_ns), ..p.clone() }).collect();
}
