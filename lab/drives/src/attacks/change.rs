//! What an attack makes of one cycle.

use mufasa_model::input::cycle::{Cycle, Track, Trajectory, TrajectoryPoint};

use super::catalogue::Attack;
use super::objects;
use super::planner::Planner;
use crate::geometry::Polyline;
use crate::readers::error::ReadError;
use crate::seconds;

/// The first attacked cycle.
pub(super) struct Onset {
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
    /// begins when there is something to hide. Errors: of `clean`, the way of the CAV.
    pub(super) fn new(
        cycle: &Cycle,
        attack: Attack,
        lead_range_m: f64,
        clean: impl FnOnce() -> Result<Polyline, ReadError>,
    ) -> Result<Option<Self>, ReadError> {
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
            return Ok(Some(onset));
        }
        let mut told = cycle.clone();
        change(&mut told, attack, &onset, None);
        if told == *cycle { Ok(None) } else { clean().map(|line| Some(with(line))) }
    }

    /// Whether the CAV has come to the end of its line when it drives what it is sent.
    pub(super) fn is_at_the_end(&self, cycle: &Cycle) -> bool {
        let mut there = cycle.clone();
        self.planner.execute(&mut there, self.time_s(cycle), &[], self.lead_range_m);
        Planner::along(self.line.clone(), &there).is_at_the_end(&there)
    }

    fn time_s(&self, cycle: &Cycle) -> f64 {
        seconds(self.now_ns, cycle.now_ns)
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
pub(super) fn apply(
    cycle: &mut Cycle,
    attack: Attack,
    onset: &Onset,
    target: Option<i64>,
) -> Option<i64> {
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
        Attack::EmptyTracks => objects::each_track(cycle, |_| None),
        Attack::GhostTracks => {
            let ghosts = Planner::new(cycle).ghosts(&cycle.ego);
            if let Some(list) = &mut cycle.tracks {
                list.items.extend(ghosts);
            }
        }
        Attack::FalseVelocities => objects::each_track(cycle, |t| {
            let (vx, vy) = (t.vx + FASTER * t.cos, t.vy + FASTER * t.sin);
            Some(Track { vx, vy, ..t.clone() })
        }),
        Attack::FalseSizes => {
            objects::each_track(cycle, |t| Some(Track { length: TINY, width: TINY, ..t.clone() }));
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
            objects::each_track(cycle, |_| None);
            objects::blind(cycle, onset.scan_ns);
        }
        Attack::Slide => slide(cycle),
        // Of the closed loop alone.
        _ => {}
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

/// The first trajectory with its times moved to now.
fn freeze(cycle: &mut Cycle, first: Option<&Trajectory>) {
    let (Some(first), Some(current)) = (first, cycle.trajectory.as_mut()) else { return };
    let Some(start_ns) = first.points.first().map(|p| p.t_ns) else { return };
    let moved = |t_ns: i64| t_ns.saturating_sub(start_ns).saturating_add(cycle.now_ns);
    let points = first.points.iter();
    current.points = points.map(|p| TrajectoryPoint { t_ns: moved(p.t_ns), ..p.clone() }).collect();
}
