//! The cycle that the stages are asked about, put together from what is there when it is decided.

use mufasa::input::cycle::{
    CrossSection, Cycle, DetectionList, Ego, Lead, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::monitor::Message;
use mufasa::offloading::requester::{Requester, Running};
use mufasa::services::configuration::{Configuration, Group};

use super::decided::Local;
use super::sensing::Sensed;
use super::withheld::Withheld;

/// What does not change from cycle to cycle.
#[derive(Clone, Debug)]
pub(super) struct Fixed {
    pub(super) profile: Profile,
    pub(super) parameters: Parameters,
    /// Whether the route is closed, and its cross sections.
    pub(super) route: (bool, Vec<CrossSection>),
    pub(super) withheld: Option<Withheld>,
}

/// The last results of stations that the requester used.
#[derive(Clone, Debug, Default)]
pub(super) struct Last {
    pub(super) tracks: Option<Message<Vec<Track>>>,
    pub(super) points: Option<Message<Vec<TrajectoryPoint>>>,
}

/// Results with their stamps, ns.
pub(super) type Stamped<'c, T> = (i64, &'c [T]);

/// The results of a cycle: of a station where a group is remote, the CAV's own where it is not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen<'c> {
    pub(super) tracks: Option<Stamped<'c, Track>>,
    pub(super) points: Option<Stamped<'c, TrajectoryPoint>>,
}

impl<'c> Chosen<'c> {
    /// Those of now.
    pub(super) fn new(requester: &Requester<'_>, last: &'c Last, local: Local<'c>) -> Self {
        let [mot, plan] = Group::ALL.map(|group| requester.session_of(group));
        Self {
            tracks: mot.map_or(local.tracks, |it| used(&it, last.tracks.as_ref())),
            points: plan.map_or(local.points, |it| used(&it, last.points.as_ref())),
        }
    }
}

/// The message that the requester used last, if it is the one that is kept.
fn used<'m, T>(running: &Running, kept: Option<&'m Message<Vec<T>>>) -> Option<Stamped<'m, T>> {
    let is_it = |it: &&Message<Vec<T>>| {
        (Some(it.generated.as_nanoseconds()), it.session) == (running.last_used_ns, running.session)
    };
    kept.filter(is_it).map(|it| (it.stamp.as_nanoseconds(), it.items.as_slice()))
}

/// The cycle of a time, ns.
pub(super) fn cycle<'c>(
    fixed: &'c Fixed,
    configuration: Configuration,
    (now_ns, ego): (i64, Ego),
    sensed: &'c Sensed,
    chosen: Chosen<'c>,
    detection_history: &'c [DetectionList<'c>],
) -> Cycle<'c> {
    let stamp_ns = sensed.stamp_ns;
    let (closed, cross_sections) = (fixed.route.0, fixed.route.1.as_slice());
    let cycle = Cycle {
        profile: fixed.profile,
        parameters: fixed.parameters,
        now_ns,
        configuration,
        ego,
        trajectory: chosen.points.map(|(stamp_ns, points)| Trajectory { stamp_ns, points }),
        tracks: chosen.tracks.map(|(stamp_ns, items)| TrackList { stamp_ns, items }),
        detections: Some(DetectionList { stamp_ns, items: &sensed.detections }),
        lead: sensed.lead.map(|lead| Lead { stamp_ns, gap: lead.gap, speed: lead.speed }),
        route: Route { closed, cross_sections },
        grid: Some(sensed.grid.borrow(true)),
        detection_history,
    };
    fixed.withheld.map_or(cycle, |it| it.taken_from(cycle))
}
