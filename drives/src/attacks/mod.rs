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

pub mod error;
pub mod injection;
mod meeting;
mod objects;
mod planner;

use mufasa_model::input::cycle::{Cycle, Track, Trajectory, TrajectoryPoint};

use crate::attacks::error::InjectError;
use crate::attacks::injection::{Attack, Injection};
use crate::attacks::planner::{Planner, driven_line};
use crate::drive::Drive;
use crate::geometry::Polyline;

/// The same drive under attack.
///
/// Attacks that hide objects or their motion are dangerous only when the CAV drives what it is
/// sent, so in these it does: it leaves its recorded motion at the first attacked cycle, and the
/// drive ends with the last one, because nobody recorded what comes then. Its notes say what the
/// CAV would drive into.
///
/// Errors: no cycle is changed, because none is in the span, or the data of the attack are local,
/// absent, or as it would make them. An attacked drive that is safe is so in spite of the attack.
pub fn inject(drive: &Drive, injection: &Injection) -> Result<Drive, InjectError> {
    let mut attacked = drive.clone();
    attacked.name = format!("{}+{}", drive.name, injection.attack.name());
    let start_ns = drive.cycles.first().map_or(0, |c| c.cycle.now_ns);
    let since_s = |cycle: &Cycle| seconds(cycle.now_ns.saturating_sub(start_ns));
    let is_driven = injection.attack.is_driven();
    let mut onset: Option<Onset> = None;
    let mut changed: Vec<usize> = Vec::new();
    let (mut end, mut at_the_end) = (attacked.cycles.len(), false);
    for (i, cycle) in attacked.cycles.iter_mut().map(|c| &mut c.cycle).enumerate() {
        let in_span = (injection.from_s..=injection.to_s).contains(&since_s(cycle));
        if in_span && injection.attack.reaches(cycle) {
            if onset.is_none() {
                let clean = drive.cycles[i..].iter().map(|it| &it.cycle);
                onset = Onset::new(cycle, injection.attack, drive.lead_range_m, clean);
            }
            let Some(onset) = &mut onset else { continue };
            if is_driven && onset.is_at_the_end(cycle) {
                (end, at_the_end) = (i, true);
                break;
            }
            attack(cycle, injection.attack, onset);
            changed.extend((*cycle != drive.cycles[i].cycle).then_some(i));
        } else if is_driven && onset.is_some() {
            end = i;
            break;
        }
    }
    let Some(first) = changed.first() else {
        return Err(unchanged(drive, injection, since_s));
    };
    attacked.notes.push(format!(
        "attack {injection} s changes {} cycles, the first at {:.1} s",
        changed.len(),
        since_s(&drive.cycles[*first].cycle)
    ));
    if is_driven {
        attacked.cycles.truncate(end);
        attacked.notes.push(String::from(
            "from its first attacked cycle on the CAV drives what it is sent; the drive ends with \
             the attack",
        ));
        if at_the_end {
            attacked.notes.push(String::from(
                "the drive ends where the CAV has come to the end of the road that is known",
            ));
        }
        attacked.notes.extend(meeting::note(&attacked.cycles, &drive.cycles, since_s));
    }
    Ok(attacked)
}

/// Why the attack changed no cycle.
fn unchanged(drive: &Drive, injection: &Injection, since_s: impl Fn(&Cycle) -> f64) -> InjectError {
    let injection = *injection;
    let cycles = || drive.cycles.iter().map(|c| &c.cycle);
    let span = injection.from_s..=injection.to_s;
    let mut in_span = cycles().filter(|cycle| span.contains(&since_s(cycle))).peekable();
    match in_span.peek().map(|first| first.configuration) {
        None => {
            InjectError::Outside { injection, end_s: cycles().next_back().map_or(0.0, &since_s) }
        }
        Some(configuration) if !in_span.any(|cycle| injection.attack.is_remote(cycle)) => {
            InjectError::Local { injection, configuration }
        }
        Some(_) => InjectError::Unchanged { injection },
    }
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
    /// The object that the attack is on, as long as it is received.
    target: Option<i64>,
}

impl Onset {
    /// The attack begins with this cycle; an attack that would have the CAV drive what it is sent
    /// begins when there is something to hide.
    fn new<'a>(
        cycle: &Cycle,
        attack: Attack,
        lead_range_m: f64,
        clean: impl Iterator<Item = &'a Cycle>,
    ) -> Option<Self> {
        let line = if attack.is_driven() { driven_line(clean) } else { Polyline::new(Vec::new()) };
        let onset = || Self {
            now_ns: cycle.now_ns,
            scan_ns: cycle.detections.as_ref().map_or(cycle.now_ns, |list| list.stamp_ns),
            trajectory: cycle.trajectory.clone(),
            planner: Planner::along(line.clone(), cycle),
            line: line.clone(),
            lead_range_m,
            target: None,
        };
        let mut told = cycle.clone();
        if attack.is_driven() {
            change(&mut told, attack, &mut onset());
        }
        (!attack.is_driven() || told != *cycle).then(onset)
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

fn attack(cycle: &mut Cycle, attack: Attack, onset: &mut Onset) {
    if attack.is_driven() {
        let time_s = onset.time_s(cycle);
        let objects = cycle.tracks.as_ref().map_or_else(Vec::new, |t| t.items.clone());
        onset.planner.execute(cycle, time_s, &objects, onset.lead_range_m);
        Planner::along(onset.line.clone(), cycle).replan(cycle, false, 0.0);
    }
    change(cycle, attack, onset);
}

/// What is sent in place of the truth.
fn change(cycle: &mut Cycle, attack: Attack, onset: &mut Onset) {
    match attack {
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
        Attack::MissingTrack => on_target(cycle, onset, |_| true, objects::leave_out),
        Attack::CrossingStands => objects::stop_crossing(cycle),
        Attack::ExchangedPasts => on_target(cycle, onset, |_| true, objects::exchange_pasts),
        Attack::TakenPast => on_target(cycle, onset, |_| true, objects::take_past),
        Attack::VelocityBias => objects::bias_velocities(cycle),
        Attack::PastGhost => on_target(cycle, onset, objects::leaves, objects::add_past_ghost),
        Attack::BlindDetectors => {
            each_track(cycle, |_| None);
            objects::blind(cycle, onset.scan_ns);
        }
        Attack::Slide => slide(cycle),
    }
}

/// Attacks one object, the same as in the cycles before, or else of those that are wanted the one
/// nearest to the path.
fn on_target(
    cycle: &mut Cycle,
    onset: &mut Onset,
    wanted: impl Fn(&Track) -> bool,
    change: impl Fn(&mut Cycle, &Track),
) {
    let target = objects::target(cycle, onset.target, wanted);
    onset.target = target.as_ref().map(|it| it.id);
    if let Some(target) = target {
        change(cycle, &target);
    }
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
