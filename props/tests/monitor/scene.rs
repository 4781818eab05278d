//! What the CAV has of its own in a sequence of cycles, for both sides.

use mufasa::input::cycle::{CrossSection, Detection, Ego, Grid, Lead, Track, TrajectoryPoint};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::monitor::{Brake, Gap, GridMap, Inputs, Settings, Stall};
use mufasa::report::{InvalidInput, Outcome, Report, Witness};
use mufasa_props::bridge::{Owned, profile_from_impl, to_impl};
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::whole;

use super::kit::{World, at, road, settings};
use super::plain::Own;

/// What is around at a time.
pub struct Scene<'c> {
    pub ego: Ego,
    pub detections: Option<(i64, Vec<Detection>)>,
    pub tracks: Option<(i64, Vec<Track>)>,
    pub points: Option<(i64, Vec<TrajectoryPoint>)>,
    pub lead: Option<Lead>,
    pub grid: Option<Grid<'c>>,
}

/// A cycle of the generators that stands still, or a road on which all drive.
pub enum Base {
    Still(Box<Owned>),
    Road,
}

/// Where a sequence begins.
pub struct Start {
    pub base: Base,
    pub closed: bool,
    pub cross_sections: Vec<CrossSection>,
    pub now_ns: i64,
    pub stages: Parameters,
}

/// On the road, or in a cycle of the generators.
pub fn start(draw: &mut Draw<'_>, profile: Profile) -> Start {
    if draw.one_in(2) {
        let (cross_sections, stages) = (road(), settings().stages);
        return Start { base: Base::Road, closed: false, cross_sections, now_ns: 0, stages };
    }
    let mut cycle = whole::cycle(draw, profile_from_impl(profile));
    cycle.detection_history.clear();
    let owned = to_impl(&cycle);
    let it = owned.borrow(&[]);
    let (closed, cross_sections) = (it.route.closed, it.route.cross_sections.to_vec());
    let (now_ns, stages) = (it.now_ns, it.parameters);
    Start { base: Base::Still(Box::new(owned)), closed, cross_sections, now_ns, stages }
}

impl Base {
    pub fn scene(&self, now_ns: i64) -> Scene<'_> {
        match self {
            Self::Road => {
                let World { ego, detections, tracks, points, .. } = World::at(now_ns);
                Scene {
                    ego,
                    detections: Some((now_ns, detections)),
                    tracks: Some((now_ns, tracks)),
                    points: Some((now_ns, points)),
                    lead: Some(Lead { stamp_ns: now_ns, gap: 19.0, speed: 5.0 }),
                    grid: None,
                }
            }
            Self::Still(owned) => {
                let it = owned.borrow(&[]);
                // A time at the limits of 64 bits stays there: it is invalid for both.
                let moved =
                    |stamp_ns: i64| stamp_ns.saturating_sub(it.now_ns).saturating_add(now_ns);
                let point = |p: &TrajectoryPoint| TrajectoryPoint { t_ns: moved(p.t_ns), ..*p };
                Scene {
                    ego: it.ego,
                    detections: it.detections.map(|l| (moved(l.stamp_ns), l.items.to_vec())),
                    tracks: it.tracks.map(|l| (moved(l.stamp_ns), l.items.to_vec())),
                    points: it
                        .trajectory
                        .map(|l| (moved(l.stamp_ns), l.points.iter().map(point).collect())),
                    lead: it.lead.map(|l| Lead { stamp_ns: moved(l.stamp_ns), ..l }),
                    grid: it.grid.map(|g| Grid { stamp_ns: moved(g.stamp_ns), ..g }),
                }
            }
        }
    }
}

/// The same for the monitor.
pub fn inputs<'c>(own: &Own<'c>) -> Inputs<'c> {
    let mut inputs = Inputs::new(at(own.now_ns), own.ego);
    if let Some((stamp_ns, items)) = own.detections {
        inputs = inputs.detections(at(stamp_ns), items);
    }
    if let Some(Lead { stamp_ns, gap, speed }) = own.lead {
        inputs = inputs.lead(at(stamp_ns), Gap::between_bumpers(gap), speed);
    }
    if let Some(grid) = own.grid {
        let Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown } = grid;
        let map = GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown };
        inputs = inputs.grid(at(stamp_ns), map);
    }
    if let Some((stamp_ns, items)) = own.tracks {
        inputs = inputs.local_tracks(at(stamp_ns), items);
    }
    if let Some((stamp_ns, points)) = own.trajectory {
        inputs = inputs.local_trajectory(at(stamp_ns), points);
    }
    inputs
}

/// The same but for the segment of a witness: with an index of two that are equally near either may be
/// named.
pub fn same(one: &Result<Report, InvalidInput>, other: &Result<Report, InvalidInput>) -> bool {
    let plain = |outcome: Outcome| match outcome {
        Outcome::Failed(witness) => Outcome::Failed(Witness { segment: None, ..witness }),
        other => other,
    };
    let text = |report: &Result<Report, InvalidInput>| {
        let report = report.map(|report| Report { stages: report.stages.map(plain), ..report });
        format!("{report:?}")
    };
    text(one) == text(other)
}

/// Without the segment, which an index may find otherwise.
pub fn without_segment(brake: Option<Brake>) -> String {
    let plain = brake.map(|brake| match brake {
        Brake::Fails { stage, witness } => {
            let witness = witness.map(|it| Witness { segment: None, ..it });
            Brake::Fails { stage, witness }
        }
        other => other,
    });
    format!("{plain:?}")
}

/// Own plans examined or not, and planning given back after a second or never.
pub fn with_rules(settings: &mut Settings, draw: &mut Draw<'_>) {
    settings.supervise_local = draw.one_in(2);
    let stall = Stall { time: std::time::Duration::from_secs(1), ..Stall::default() };
    settings.stall = draw.one_in(4).then_some(stall);
}
