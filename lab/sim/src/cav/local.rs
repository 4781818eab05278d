//! The services of the CAV itself, which stop while somebody else computes for it.

use std::collections::VecDeque;

use mufasa::input::cycle::{Detection, Ego, Track, TrackList, TrajectoryPoint};
use mufasa::services::configuration::Group;

use crate::planner::{Road, plan};
use crate::services::mot::Tracker;

/// Lists of detections that a tracker that starts again goes through first.
const REMEMBERED: usize = 6;

/// MOT, and ENV with TPL, each running or not.
#[derive(Debug)]
pub struct Services {
    runs: [bool; 2],
    tracker: Tracker,
    remembered: VecDeque<(i64, Vec<Detection>)>,
    /// How often each ran.
    pub executions: [u64; 2],
}

impl Default for Services {
    fn default() -> Self {
        Self {
            runs: [true; 2],
            tracker: Tracker::default(),
            remembered: VecDeque::new(),
            executions: [0; 2],
        }
    }
}

impl Services {
    /// Starts the services of a group. MOT takes up the detections of the last half second, which the CAV
    /// keeps for that.
    pub fn start(&mut self, group: Group) {
        let runs = &mut self.runs[place(group)];
        if *runs {
            return;
        }
        *runs = true;
        if group == Group::Mot {
            self.tracker.reset();
            for (stamp_ns, list) in &self.remembered {
                self.tracker.update(*stamp_ns, list);
            }
        }
    }

    /// Stops them.
    pub fn stop(&mut self, group: Group) {
        self.runs[place(group)] = false;
    }

    /// Whether they run.
    pub fn run(&self, group: Group) -> bool {
        self.runs[place(group)]
    }

    /// A list of detections comes. Returns the tracks of its time, if MOT runs.
    pub fn track(&mut self, stamp_ns: i64, detections: &[Detection]) -> Option<Vec<Track>> {
        if self.remembered.len() == REMEMBERED {
            self.remembered.pop_front();
        }
        self.remembered.push_back((stamp_ns, detections.to_vec()));
        self.run(Group::Mot).then(|| {
            self.executions[place(Group::Mot)] += 1;
            self.tracker.update(stamp_ns, detections);
            self.tracker.tracks(stamp_ns)
        })
    }

    /// A trajectory from now on, if ENV and TPL run.
    pub fn plan(
        &mut self,
        now_ns: i64,
        ego: &Ego,
        road: &Road<'_>,
        tracks: &TrackList<'_>,
    ) -> Option<Vec<TrajectoryPoint>> {
        self.run(Group::Plan).then(|| {
            self.executions[place(Group::Plan)] += 1;
            plan(now_ns, ego, road, tracks)
        })
    }
}

const fn place(group: Group) -> usize {
    match group {
        Group::Mot => 0,
        Group::Plan => 1,
    }
}
