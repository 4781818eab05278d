//! Cycles from the model's owned types to the implementation's borrowed ones.

use mufasa::input::cycle as twin;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Route, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration;

use super::profile::{profile_from_impl, profile_to_impl};
use super::requester::configuration_from_impl;

/// The lists of a cycle in the implementation's types; `borrow` makes the cycle of them.
#[derive(Clone, Debug)]
pub struct Owned {
    profile: mufasa::input::profile::Profile,
    parameters: mufasa::input::parameters::Parameters,
    now_ns: i64,
    configuration: mufasa::services::configuration::Configuration,
    ego: twin::Ego,
    trajectory: Option<(i64, Vec<twin::TrajectoryPoint>)>,
    tracks: Option<(i64, Vec<twin::Track>)>,
    detections: Option<(i64, Vec<twin::Detection>)>,
    lead: Option<twin::Lead>,
    closed: bool,
    cross_sections: Vec<twin::CrossSection>,
    grid: Option<Grid>,
    detection_history: Vec<(i64, Vec<twin::Detection>)>,
}

/// A cycle in the implementation's types.
pub fn to_impl(cycle: &Cycle) -> Owned {
    let Cycle {
        profile,
        parameters,
        now_ns,
        configuration,
        ego,
        trajectory,
        tracks,
        detections,
        lead,
        route,
        grid,
        detection_history,
    } = cycle;
    let (closed, cross_sections) = route_to_impl(route);
    Owned {
        profile: profile_to_impl(*profile),
        parameters: cycle_parameters(parameters),
        now_ns: *now_ns,
        configuration: configuration_to_impl(*configuration),
        ego: ego_to_impl(ego),
        trajectory: trajectory.as_ref().map(|Trajectory { stamp_ns, points }| {
            (*stamp_ns, points.iter().map(point_to_impl).collect())
        }),
        tracks: tracks.as_ref().map(tracks_to_impl),
        detections: detections.as_ref().map(detections_to_impl),
        lead: lead.as_ref().map(lead_to_impl),
        closed,
        cross_sections,
        grid: grid.clone(),
        detection_history: detection_history.iter().map(detections_to_impl).collect(),
    }
}

/// A cycle of the implementation in the model's types.
pub fn from_impl(cycle: &twin::Cycle<'_>) -> Cycle {
    let twin::Cycle {
        profile,
        parameters,
        now_ns,
        configuration,
        ego,
        trajectory,
        tracks,
        detections,
        lead,
        route,
        grid,
        detection_history,
    } = cycle;
    let twin::Route { closed, cross_sections } = route;
    Cycle {
        profile: profile_from_impl(*profile),
        parameters: parameters_from_impl(parameters),
        now_ns: *now_ns,
        configuration: configuration_from_impl(*configuration),
        ego: ego_from_impl(ego),
        trajectory: trajectory.map(|twin::Trajectory { stamp_ns, points }| Trajectory {
            stamp_ns,
            points: points.iter().map(point_from_impl).collect(),
        }),
        tracks: tracks.map(|twin::TrackList { stamp_ns, items }| TrackList {
            stamp_ns,
            items: items.iter().map(track_from_impl).collect(),
        }),
        detections: detections.as_ref().map(detections_from_impl),
        lead: lead.as_ref().map(lead_from_impl),
        route: Route {
            closed: *closed,
            cross_sections: cross_sections.iter().map(cross_section_from_impl).collect(),
        },
        grid: grid.as_ref().map(grid_from_impl),
        detection_history: detection_history.iter().map(detections_from_impl).collect(),
    }
}

impl Owned {
    /// The detection history that the cycle borrows.
    pub fn history(&self) -> Vec<twin::DetectionList<'_>> {
        self.detection_history.iter().map(borrow_detections).collect()
    }

    /// The cycle that the implementation takes. `history`: that of `self`.
    pub fn borrow<'a>(&'a self, history: &'a [twin::DetectionList<'a>]) -> twin::Cycle<'a> {
        twin::Cycle {
            profile: self.profile,
            parameters: self.parameters,
            now_ns: self.now_ns,
            configuration: self.configuration,
            ego: self.ego,
            trajectory: self
                .trajectory
                .as_ref()
                .map(|(stamp_ns, points)| twin::Trajectory { stamp_ns: *stamp_ns, points }),
            tracks: self.tracks.as_ref().map(borrow_tracks),
            detections: self.detections.as_ref().map(borrow_detections),
            lead: self.lead,
            route: twin::Route { closed: self.closed, cross_sections: &self.cross_sections },
            grid: self.grid.as_ref().map(borrow_grid),
            detection_history: history,
        }
    }
}

macro_rules! same_names {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// The parameters of the stages in the implementation's type, as that lists them; a name
        /// that only one of the two has does not compile.
        pub fn cycle_parameters(parameters: &Parameters) -> mufasa::input::parameters::Parameters {
            let Parameters { $($name),* } = *parameters;
            mufasa::input::parameters::Parameters { $($name),* }
        }

        fn parameters_from_impl(parameters: &mufasa::input::parameters::Parameters) -> Parameters {
            let mufasa::input::parameters::Parameters { $($name),* } = *parameters;
            Parameters { $($name),* }
        }
    };
}

mufasa::parameters!(same_names);

same_variants! {
    fn configuration_to_impl(Configuration) -> mufasa::services::configuration::Configuration {
        Local, MotRemote, AllRemote, PlanRemote,
    }
}

same_fields! {
    pub(super) fn ego_to_impl(Ego) -> twin::Ego { x, y, cos, sin, speed, length, width, center_offset }

    pub(super) fn point_to_impl(TrajectoryPoint) -> twin::TrajectoryPoint { t_ns, x, y, cos, sin }

    fn track_to_impl(Track) -> twin::Track { id, x, y, cos, sin, vx, vy, length, width }

    fn detection_to_impl(Detection) -> twin::Detection { x, y, cos, sin, length, width }

    fn lead_to_impl(Lead) -> twin::Lead { stamp_ns, gap, speed }

    fn cross_section_to_impl(CrossSection) -> twin::CrossSection { x, y, left, right }

    fn ego_from_impl(twin::Ego) -> Ego { x, y, cos, sin, speed, length, width, center_offset }

    /// A point in the model's type.
    pub fn point_from_impl(twin::TrajectoryPoint) -> TrajectoryPoint { t_ns, x, y, cos, sin }

    /// A track in the model's type.
    pub fn track_from_impl(twin::Track) -> Track { id, x, y, cos, sin, vx, vy, length, width }

    fn detection_from_impl(twin::Detection) -> Detection { x, y, cos, sin, length, width }

    fn lead_from_impl(twin::Lead) -> Lead { stamp_ns, gap, speed }

    fn cross_section_from_impl(twin::CrossSection) -> CrossSection { x, y, left, right }
}

pub(super) fn tracks_to_impl(list: &TrackList) -> (i64, Vec<twin::Track>) {
    let TrackList { stamp_ns, items } = list;
    (*stamp_ns, items.iter().map(track_to_impl).collect())
}

pub(super) fn detections_to_impl(list: &DetectionList) -> (i64, Vec<twin::Detection>) {
    let DetectionList { stamp_ns, items } = list;
    (*stamp_ns, items.iter().map(detection_to_impl).collect())
}

/// A route in the implementation's types: whether it is closed, and its cross sections.
pub fn route_to_impl(route: &Route) -> (bool, Vec<twin::CrossSection>) {
    let Route { closed, cross_sections } = route;
    (*closed, cross_sections.iter().map(cross_section_to_impl).collect())
}

fn borrow_detections((stamp_ns, items): &(i64, Vec<twin::Detection>)) -> twin::DetectionList<'_> {
    twin::DetectionList { stamp_ns: *stamp_ns, items }
}

fn borrow_tracks((stamp_ns, items): &(i64, Vec<twin::Track>)) -> twin::TrackList<'_> {
    twin::TrackList { stamp_ns: *stamp_ns, items }
}

fn borrow_grid(grid: &Grid) -> twin::Grid<'_> {
    let Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown } = grid;
    twin::Grid {
        stamp_ns: *stamp_ns,
        x: *x,
        y: *y,
        cos: *cos,
        sin: *sin,
        resolution: *resolution,
        width: *width,
        height: *height,
        occupied,
        unknown: unknown.as_deref(),
    }
}

fn detections_from_impl(list: &twin::DetectionList<'_>) -> DetectionList {
    let twin::DetectionList { stamp_ns, items } = *list;
    DetectionList { stamp_ns, items: items.iter().map(detection_from_impl).collect() }
}

fn grid_from_impl(grid: &twin::Grid<'_>) -> Grid {
    let twin::Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown } =
        *grid;
    let (occupied, unknown) = (occupied.to_vec(), unknown.map(<[u8]>::to_vec));
    Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown }
}

#[cfg(test)]
mod tests {
    use mufasa_model::input::profile::Profile;

    use super::*;
    use crate::strategy::draw::Draw;
    use crate::strategy::whole;

    #[test]
    fn the_defaults_of_both_crates_are_the_same_doubles() {
        let model = cycle_parameters(&Parameters::default());
        let implementation = mufasa::input::parameters::Parameters::default();
        assert_eq!(model, implementation);
        // `==` would let -0.0 pass for 0.0; the text of a double does not.
        assert_eq!(format!("{model:?}"), format!("{implementation:?}"));
    }

    #[test]
    fn a_cycle_comes_back_as_it_was() {
        let (mut parts, mut tape) = ([false; 6], Vec::new());
        for seed in 0..400_u32 {
            tape.clear();
            tape.extend((0..600_u32).map(|at| (seed * 600 + at).wrapping_mul(2_654_435_761)));
            for profile in [Profile::PAPER, Profile::HARDENED] {
                let mut cycle = whole::cycle(&mut Draw::new(&tape), profile);
                if let Some(grid) = cycle.grid.as_mut().filter(|_| seed.is_multiple_of(2)) {
                    // Which such short tapes do not draw.
                    grid.unknown = Some(grid.occupied.clone());
                }
                let owned = to_impl(&cycle);
                let history = owned.history();
                // The text of a NaN is that of another.
                let back = from_impl(&owned.borrow(&history));
                assert_eq!(format!("{back:?}"), format!("{cycle:?}"));
                let of_cycle = [
                    cycle.trajectory.is_some(),
                    cycle.tracks.is_some(),
                    cycle.detections.is_some(),
                    cycle.lead.is_some(),
                    cycle.grid.is_some_and(|grid| grid.unknown.is_some()),
                    !cycle.detection_history.is_empty(),
                ];
                parts = std::array::from_fn(|at| parts[at] || of_cycle[at]);
            }
        }
        assert_eq!(parts, [true; 6], "every part is in some cycle");
    }
}
