//! What a vehicle says when it has measured, and gives its monitor, whatever drives it.

use mufasa::input::cycle::{
    Detection, DetectionList, Ego, Grid, Lead, Track, TrackList, Trajectory,
};
use mufasa::monitor::{Gap, GridMap, Inputs, Time};
use mufasa::offloading::requester::GroupState;
use mufasa::services::configuration::Group;

use crate::message::Payload;

/// What a vehicle measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// When, ns.
    pub stamp_ns: i64,
    /// Where it was.
    pub ego: Ego,
    /// What its detectors saw, with its time, ns; none: nothing is known.
    pub detections: Option<(i64, Vec<Detection>)>,
    /// Its own tracks with their time, ns, where MOT is its own and PLAN a station's: stage iii will compare with them what
    /// the station plans.
    pub tracks: Option<(i64, Vec<Track>)>,
}

impl Measured {
    /// The messages, each with its station: a sign of life for each session that runs, and to each station that computes
    /// for the vehicle what it knows. `states`: of the groups, in their order.
    pub fn told(self, states: [GroupState; 2]) -> Vec<(i64, Payload)> {
        let sessions = states.map(|state| match state {
            GroupState::Remote { station, session } => Some((station, session)),
            GroupState::Local | GroupState::Requested { .. } => None,
        });
        let running = Group::ALL.into_iter().zip(sessions);
        let mut said: Vec<(i64, Payload)> = running
            .filter_map(|(group, it)| it.map(|(station, session)| (station, group, session)))
            .map(|(station, group, session)| (station, Payload::Alive { group, session }))
            .collect();
        let [mot, plan] = sessions;
        let plan_elsewhere = plan.filter(|it| mot.is_none_or(|other| other.0 != it.0));
        let Self { stamp_ns, ego, detections, tracks } = self;
        for (station, _) in mot.into_iter().chain(plan_elsewhere) {
            said.push((station, Payload::State { stamp_ns, ego }));
            if let (None, Some((_, session)), Some((stamp_ns, tracks))) = (mot, plan, &tracks) {
                let (stamp_ns, tracks) = (*stamp_ns, tracks.clone());
                said.push((station, Payload::Tracks { session, stamp_ns, tracks }));
            }
            if let Some((stamp_ns, detections)) = &detections {
                let (stamp_ns, detections) = (*stamp_ns, detections.clone());
                said.push((station, Payload::Detections { stamp_ns, ego, detections }));
            }
        }
        said
    }
}

/// What a vehicle knows of a cycle; tracks and trajectory are its own.
#[derive(Clone, Copy, Debug)]
pub struct Given<'c> {
    /// What its detectors saw.
    pub detections: Option<DetectionList<'c>>,
    /// The leading vehicle.
    pub lead: Option<Lead>,
    /// The occupancy grid.
    pub grid: Option<Grid<'c>>,
    /// The result of its MOT.
    pub tracks: Option<TrackList<'c>>,
    /// The result of its PLAN.
    pub trajectory: Option<Trajectory<'c>>,
}

impl<'c> Given<'c> {
    /// The inputs with it, all stamps so much later, ns.
    pub fn inputs(self, mut inputs: Inputs<'c>, later_ns: i64) -> Inputs<'c> {
        let later = |ns: i64| Time::from_nanoseconds(ns.saturating_add(later_ns));
        if let Some(list) = self.detections {
            inputs = inputs.detections(later(list.stamp_ns), list.items);
        }
        if let Some(lead) = self.lead {
            inputs = inputs.lead(later(lead.stamp_ns), Gap::between_bumpers(lead.gap), lead.speed);
        }
        if let Some(grid) = self.grid {
            let Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown } =
                grid;
            let map = GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown };
            inputs = inputs.grid(later(stamp_ns), map);
        }
        if let Some(list) = self.tracks {
            inputs = inputs.local_tracks(later(list.stamp_ns), list.items);
        }
        if let Some(trajectory) = self.trajectory {
            inputs = inputs.local_trajectory(later(trajectory.stamp_ns), trajectory.points);
        }
        inputs
    }
}
