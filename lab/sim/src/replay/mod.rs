//! A run as one page: frames from above around an event, and a timeline. HTML and SVG without scripts, and
//! nothing that has to be fetched.

mod timeline;

use core::fmt::Write;

use mufasa::input::cycle::{Track, TrajectoryPoint};
use mufasa_drives::pictures::escape;

use crate::cav::Cav;
use crate::cav::guard::Decided;
use crate::map::Town;
use crate::pictures::{DETECTION, LOCAL, Overlay, REJECTED, REMOTE, Shot, TRAJECTORY, View, sheet};
use crate::pose::{Point, Pose, Rectangle};
use crate::run::{Cycle, End, Outcome, Watcher};
use crate::snapshot::Snapshot;

/// Frames of a page, and of a row.
const FRAMES: usize = 8;
const IN_A_ROW: usize = 4;
/// Cycles between two frames.
const APART: usize = 4;
/// Cycles between the event and the last frame, where there are as many.
const AFTER: usize = 8;
/// What a frame shows, m.
const SIZE: (f64, f64) = (64.0, 48.0);

/// What the page is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The CAV touched somebody.
    Collision,
    /// A safety issue was detected for the first time.
    Issue,
    /// The attack began.
    Attack,
    /// The run ended.
    End,
}

impl Event {
    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Collision => "the collision",
            Self::Issue => "the first safety issue that was detected",
            Self::Attack => "the start of the attack",
            Self::End => "the end of the run",
        }
    }
}

/// Keeps a run: it has some hundreds of cycles, and what is the event is known at its end.
#[derive(Clone, Debug, Default)]
pub struct Replay {
    moments: Vec<(Snapshot, Overlay)>,
    cycles: Vec<Cycle>,
    last: Option<(Snapshot, Overlay)>,
}

impl Watcher for Replay {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, _: &Decided, cycle: &Cycle) {
        let mut overlay = overlay(cav);
        if cycle.failed > 0 {
            let (tracks, points) = cav.guard().accepted();
            let [mot, plan] = [1, 2].map(|group| cycle.remote & group != 0);
            overlay.rejected = places(points.filter(|_| plan).unwrap_or(&[]));
            let tracks = tracks.filter(|_| mot).unwrap_or(&[]);
            overlay.rejected_tracks = tracks.iter().map(rectangle).collect();
        }
        self.moments.push((truth.clone(), overlay));
        self.cycles.push(*cycle);
    }

    fn ended(&mut self, truth: &Snapshot, cav: &Cav<'_>) {
        self.last = Some((truth.clone(), overlay(cav)));
    }
}

impl Replay {
    /// What was decided.
    pub fn cycles(&self) -> &[Cycle] {
        &self.cycles
    }

    /// What the page is about, and the cycle in which it is seen first.
    pub fn event(&self, outcome: &Outcome) -> (Event, usize) {
        let last = self.cycles.len().saturating_sub(1);
        let first = |of: fn(&Cycle) -> bool| self.cycles.iter().position(of);
        if outcome.end == End::Collided {
            (Event::Collision, last)
        } else if let Some(at) = first(|cycle| cycle.failed > 0) {
            (Event::Issue, at)
        } else if let Some(at) = first(|cycle| cycle.attacked) {
            (Event::Attack, at)
        } else {
            (Event::End, last)
        }
    }

    /// The frames around the event, as a whole SVG file.
    pub fn frames(&self, town: &Town, route: usize, outcome: &Outcome) -> String {
        let (event, at) = self.event(outcome);
        let last = (at + AFTER).min(self.cycles.len().saturating_sub(1));
        let first = last.saturating_sub(APART * (FRAMES - 1));
        let chosen = (first..=last).rev().step_by(APART).collect::<Vec<_>>();
        let mut frames: Vec<(Snapshot, Overlay)> = Vec::new();
        for &index in chosen.iter().rev() {
            let (truth, overlay) = &self.moments[index];
            let caption = caption(&self.cycles[index]);
            frames.push((truth.clone(), Overlay { caption, ..overlay.clone() }));
        }
        // The collision itself is after the last cycle.
        if event == Event::Collision
            && let Some((truth, overlay)) = &self.last
        {
            let caption = outcome.with.map_or_else(String::new, |id| format!("touches {id}"));
            frames.push((truth.clone(), Overlay { caption, ..overlay.clone() }));
            frames.drain(..frames.len().saturating_sub(FRAMES));
        }
        let view = |truth: &Snapshot| View { width: SIZE.0, height: SIZE.1, ..View::of_ego(truth) };
        let shots: Vec<Shot<'_>> =
            frames.iter().map(|(truth, overlay)| (truth, overlay, view(truth))).collect();
        let rows: Vec<&[Shot<'_>]> = shots.chunks(IN_A_ROW).collect();
        sheet(town, route, &rows)
    }

    /// The timeline, as a whole SVG file.
    pub fn timeline(&self, outcome: &Outcome) -> String {
        let (_, at) = self.event(outcome);
        let is_end = outcome.end == End::Collided;
        let event = if is_end { outcome.t } else { self.cycles.get(at).map_or(0.0, |it| it.t) };
        timeline::svg(&self.cycles, event, outcome.t)
    }

    /// The page of a run with this name, on this of the ego's routes.
    pub fn page(&self, town: &Town, name: &str, route: usize, outcome: &Outcome) -> String {
        let (event, _) = self.event(outcome);
        let title = escape(name);
        let ended = ended(outcome);
        let mut text = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}: {ended}</title>\n\
             <style>\nbody {{ font-family: sans-serif; margin: 1.5em; max-width: 1100px; color: #222 }}\n\
             svg {{ width: 100%; height: auto }}\n.key span {{ margin-right: 1.5em; white-space: nowrap }}\n\
             </style>\n</head>\n<body>\n<h1>{title}</h1>\n<p>{ended}, at {:.2} s. Nearest to another: {}. Remote: \
             MOT in {} and PLAN in {} of {} cycles. Around {}:</p>\n",
            outcome.t,
            nearest(outcome),
            outcome.offloaded[0],
            outcome.offloaded[1],
            outcome.cycles,
            event.name()
        );
        if let Some(route) = town.ego_routes().nth(route) {
            text.push_str(&self.frames(town, route, outcome));
        }
        key(&mut text);
        text.push_str("<h2>The whole run</h2>\n");
        text.push_str(&self.timeline(outcome));
        text.push_str("</body>\n</html>\n");
        text
    }
}

/// What the colours of the frames mean.
fn key(text: &mut String) {
    let entries = [
        ("#1f6fd1", "CAV"),
        ("#5b6770", "vehicle, by number, with its way of the next second"),
        ("#b5541c", "person on foot or bicycle"),
        (TRAJECTORY, "trajectory that control follows"),
        (REMOTE, "remote track"),
        (REJECTED, "dashed: remote trajectory and tracks that were rejected"),
        (LOCAL, "local track"),
        (DETECTION, "detection of the CAV"),
    ];
    text.push_str("<p class=\"key\">");
    for (color, name) in entries {
        // A string takes everything.
        let _ = write!(text, "<span><b style=\"color:{color}\">&#9632;</b> {name}</span> ");
    }
    text.push_str("</p>\n");
}

fn ended(outcome: &Outcome) -> String {
    match (outcome.end, outcome.with) {
        (End::Arrived, _) => String::from("Arrived"),
        (End::Late, _) => String::from("Not there in time"),
        (End::Collided, Some(id)) => format!("Collided with {id}"),
        (End::Collided, None) => String::from("Collided"),
    }
}

fn nearest(outcome: &Outcome) -> String {
    if outcome.least_distance.is_finite() {
        format!("{:.2} m", outcome.least_distance)
    } else {
        String::from("nobody there")
    }
}

fn caption(cycle: &Cycle) -> String {
    let remote = match cycle.remote {
        1 => "MOT remote",
        2 => "PLAN remote",
        3 => "all remote",
        _ => "all local",
    };
    let attacked = if cycle.attacked { ", attacked" } else { "" };
    let row = usize::from(cycle.failed).checked_sub(1);
    let failed = row.map_or_else(String::new, |row| format!(", failed: {}", timeline::FAILED[row]));
    format!("{remote}{attacked}{failed}")
}

fn overlay(cav: &Cav<'_>) -> Overlay {
    let (is_remote, tracks) = cav.tracks().unwrap_or((false, &[]));
    let detections = cav.sensed().map_or(&[][..], |sensed| &sensed.detections);
    Overlay {
        trajectory: places(cav.points()),
        tracks: tracks.iter().map(rectangle).collect(),
        is_remote,
        detections: detections.iter().map(|it| Point::new(it.x, it.y)).collect(),
        ..Overlay::default()
    }
}

/// Places that are numbers: an attacker may send others.
fn places(points: &[TrajectoryPoint]) -> Vec<Point> {
    let places = points.iter().map(|it| Point::new(it.x, it.y));
    places.filter(|it| it.x.is_finite() && it.y.is_finite()).collect()
}

fn rectangle(track: &Track) -> Rectangle {
    let pose = Pose { at: Point::new(track.x, track.y), cos: track.cos, sin: track.sin };
    Rectangle { pose, length: track.length, width: track.width }
}
