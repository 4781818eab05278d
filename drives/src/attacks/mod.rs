//! Attacks on the remote services, injected into a drive (paper Sec. V-B, and the findings of
//! `spec/3-stages.md#findings`). An attack changes what the CAV receives, never what it measures
//! itself: detections, route and grid stay as they are, and so do ego and lead unless the CAV is
//! shown driving what it is sent.
//!
//! Data are received where the configuration of the cycle says that their group is remote: tracks
//! in `AllRemote` and `MotRemote`, the trajectory in `AllRemote` and `PlanRemote`. Local data of
//! the other group may change in one way: in `MotRemote` the local planner plans with the received
//! tracks, so where those hide objects the local trajectory believes them, too. In `PlanRemote`
//! the tracks are the CAV's own, and an attack on tracks is none.

pub mod error;
pub mod injection;
mod planner;

use mufasa_model::input::cycle::{Cycle, Track, Trajectory, TrajectoryPoint};

use crate::attacks::error::InjectError;
use crate::attacks::injection::{Attack, Injection};
use crate::attacks::planner::Planner;
use crate::drive::Drive;

/// The same drive under attack.
///
/// Attacks that hide objects (empty tracks, false velocities and sizes) are dangerous only when
/// the CAV drives what it is sent, so in these it does: it leaves its recorded motion at the first
/// attacked cycle, and the drive ends with the last one, because nobody recorded what comes then.
/// `previous_tracks` stay as given, or are carried when the attacked drive is judged: an attacked
/// list that is not found becomes the one that the next is compared with (H-09).
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
    let mut count = 0;
    let mut end = attacked.cycles.len();
    for (i, cycle) in attacked.cycles.iter_mut().map(|c| &mut c.cycle).enumerate() {
        let in_span = (injection.from_s..=injection.to_s).contains(&since_s(cycle));
        if in_span && injection.attack.reaches(cycle) {
            let onset = onset.get_or_insert_with(|| Onset {
                now_ns: cycle.now_ns,
                trajectory: cycle.trajectory.clone(),
                planner: Planner::new(cycle),
            });
            attack(cycle, injection.attack, onset);
            count += usize::from(*cycle != drive.cycles[i].cycle);
        } else if is_driven && onset.is_some() {
            end = i;
            break;
        }
    }
    if count == 0 {
        return Err(unchanged(drive, injection, since_s));
    }
    attacked.notes.push(format!("attack {injection} s changes {count} cycles"));
    if is_driven {
        attacked.cycles.truncate(end);
        attacked.notes.push(String::from(
            "from its first attacked cycle on the CAV drives what it is sent; the drive ends with \
             the attack",
        ));
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
    trajectory: Option<Trajectory>,
    planner: Planner,
}

/// How late the data of `Late` are, ns.
const LATE_NS: i64 = 300_000_000;
/// How much faster the objects of `FalseVelocities` are, m/s.
const FASTER: f64 = 10.0;
/// Sides of the objects of `FalseSizes`, m.
const TINY: f64 = 0.1;

fn attack(cycle: &mut Cycle, attack: Attack, onset: &Onset) {
    if attack.is_driven() {
        let time_s = seconds(cycle.now_ns.saturating_sub(onset.now_ns));
        let objects = cycle.tracks.as_ref().map_or_else(Vec::new, |t| t.items.clone());
        onset.planner.execute(cycle, time_s, &objects);
        Planner::new(cycle).replan(cycle, false, 0.0);
    }
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
