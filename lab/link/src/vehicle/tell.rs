//! What a vehicle says when it has measured, whatever drives it.

use mufasa::input::cycle::{Detection, Ego, Track};
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
