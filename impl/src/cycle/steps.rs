//! How many steps a cycle takes at most, by the sizes of its input (`spec/4-arithmetic.md#steps`): what a
//! monitor compares with the time that it is given.

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::times::{Times, longest};
use crate::hardened::h14_fail_safe::widening::wider_by;
use crate::input::cycle::{Cycle, TrajectoryPoint};
use crate::input::parameters::Parameters;
use crate::input::profile::{HardenedRule, Profile};
use crate::report::Stage;

/// Steps of H-14: a motion, the boxes around stretches of the path, a walk along the path, an object in numbers with error
/// bounds.
pub(crate) const MOTION: u64 = 160;
pub(crate) const STRETCHES: u64 = 320;
pub(crate) const WALK: u64 = 1200;
pub(crate) const EXACT: u64 = 2000;
/// A piece of the path, a place at a node, another place, a box around places.
pub(crate) const PIECE: u64 = 320;
pub(crate) const NODE: u64 = 160;
pub(crate) const PLACE: u64 = 320;
pub(crate) const BOX: u64 = 48;
/// A pair of a detection and an item, one that is looked for in other lists (and 1 for each item of a list that is looked
/// into).
pub(crate) const PAIR: u64 = 16;
pub(crate) const SUPPORT: u64 = 64;
/// An object beside the route, and a segment that is looked at for it.
pub(crate) const BESIDE: u64 = 512;
pub(crate) const SEGMENT: u64 = 32;

/// Sizes of the input of a cycle. Source: `spec/4-arithmetic.md#steps`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Tracks.
    pub tracks: u32,
    /// Points of the trajectory.
    pub points: u32,
    /// Detections of the longest list, be it the current one.
    pub detections: u32,
    /// Lists of the history.
    pub lists: u32,
    /// Cross sections of the route.
    pub cross_sections: u32,
    /// Stations in the table of the monitor; 0 of a cycle alone.
    pub stations: u32,
    /// Places of the path (H-14); 0 where no rule looks at them.
    pub places: u32,
    /// Rows of cells that a disk covers, the greatest one; 0 without a grid.
    pub disk_rows: u32,
    /// Rows of cells that the CAV is long.
    pub cav_rows: u32,
    /// Rows of cells that the path to `s_stop` is long at most.
    pub way_rows: u32,
}

/// A list of `Counts`, for its name.
pub(crate) type List = (&'static str, fn(&mut Counts) -> &mut u32);

/// What may be too long: what memory is lent for, and what else a cycle may have too much of.
pub(crate) const LISTS: [List; 7] = [
    ("tracks", |it| &mut it.tracks),
    ("detections", |it| &mut it.detections),
    ("cross_sections", |it| &mut it.cross_sections),
    ("stations", |it| &mut it.stations),
    ("points", |it| &mut it.points),
    ("places", |it| &mut it.places),
    ("cells", |it| &mut it.disk_rows),
];

impl Counts {
    /// Memory for so many tracks, detections, cross sections and stations, and what it does not bound as it usually is: 128
    /// points, the 430 places straight on at 30 m/s with a tau of 0.25 s and a point each 0.1 s, and cells of 0.2 m under a car of 4.8 m by 1.9 m in four disks, 0.5 m beside its plan where a rule looks at places.
    pub(crate) fn lent(profile: Profile, lent: [usize; 4]) -> Self {
        let [tracks, detections, cross_sections, stations] = lent.map(count);
        Self {
            tracks: tracks.min(1024),
            points: 128,
            detections: detections.min(2048),
            lists: if profile.looks_back() { 3 } else { 0 },
            cross_sections: cross_sections.min(8192),
            stations,
            places: if looks_along(profile) { 448 } else { 0 },
            disk_rows: if looks_along(profile) { 22 } else { 18 },
            cav_rows: 31,
            way_rows: 1052,
        }
    }

    /// Of this cycle. Source: `spec/4-arithmetic.md#steps`.
    pub fn of(cycle: &Cycle<'_>) -> Self {
        let listed = cycle.detection_history.iter().map(|list| list.items.len());
        let detections = cycle.detections.map_or(0, |list| list.items.len());
        let points = cycle.trajectory.map_or(&[][..], |it| it.points);
        let looks_along = looks_along(cycle.profile);
        let places = if looks_along { whole(Nodes::new(cycle, points).most_places()) } else { 0 };
        let mut counts = Self {
            tracks: count(cycle.tracks.map_or(0, |list| list.items.len())),
            points: count(points.len()),
            detections: count(listed.fold(detections, usize::max)),
            lists: count(cycle.detection_history.len()),
            cross_sections: count(cycle.route.cross_sections.len()),
            stations: 0,
            places,
            disk_rows: 0,
            cav_rows: 0,
            way_rows: 0,
        };
        if let Some(grid) = &cycle.grid {
            let ego = &cycle.ego;
            let disks = f64::from(i32::try_from(cycle.parameters.n).unwrap_or(i32::MAX));
            let part = ego.length / disks;
            let width = ego.width + 2.0 * most_wider(cycle, points);
            let across = libm::sqrt(part * part + width * width);
            let rows = |metres: f64| whole(metres / grid.resolution + 6.0);
            counts.disk_rows = rows(across);
            counts.cav_rows = rows(ego.length);
            counts.way_rows = rows(longest(Times::<f64>::new(cycle).s_stop));
        }
        counts
    }

    /// Whether no size is above that of the other.
    pub(crate) const fn is_within(&self, other: &Self) -> bool {
        self.tracks <= other.tracks
            && self.points <= other.points
            && self.detections <= other.detections
            && self.lists <= other.lists
            && self.cross_sections <= other.cross_sections
            && self.stations <= other.stations
            && self.places <= other.places
            && self.disk_rows <= other.disk_rows
            && self.cav_rows <= other.cav_rows
            && self.way_rows <= other.way_rows
    }

    /// The list that is too long by itself for so many steps, how long it is, and how long it may be: of
    /// several that without which the fewest steps are left. Source: `spec/4-arithmetic.md#steps`.
    pub(crate) fn too_long(
        &self,
        parameters: &Parameters,
        most: u64,
        among: &[List],
    ) -> Option<(&'static str, u32, u32)> {
        let with = |list: &List, length: u32| {
            let mut counts = *self;
            *(list.1)(&mut counts) = length;
            most_steps(&counts, parameters).total()
        };
        let longest = among.iter().min_by_key(|list| with(list, 0))?;
        let given = *(longest.1)(&mut { *self });
        // IMPL-12
        let (mut fits, mut above) = (0, given);
        while fits < above {
            let middle = above.saturating_sub(above.saturating_sub(fits) >> 1);
            if with(longest, middle) <= most {
                fits = middle;
            } else {
                above = middle.saturating_sub(1);
            }
        }
        Some((longest.0, given, fits))
    }
}

/// Whether a rule looks at the places of the path.
pub(crate) const fn looks_along(profile: Profile) -> bool {
    profile.has(HardenedRule::H04) || profile.has(HardenedRule::H14)
}

/// By how much half the CAV is wider at places of stage v at most, m (H-14.27): where stage ii asks the widening, it fails above
/// the tolerance.
fn most_wider(cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> f64 {
    let profile = cycle.profile;
    let [h04, h07, h14] =
        [HardenedRule::H04, HardenedRule::H07, HardenedRule::H14].map(|rule| profile.has(rule));
    if h07 && h14 && profile.runs(Stage::Ii) {
        return cycle.parameters.lateral_tolerance;
    }
    if h04 { wider_by(cycle, points) } else { 0.0 }
}

/// So many messages, offers, ticks and other events count between two cycles.
const MESSAGES: u64 = 64;

/// The most steps of a cycle, and of what comes between two. Source: `spec/4-arithmetic.md#steps`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Steps {
    /// 64 messages and other events.
    pub messages: u64,
    /// A new route.
    pub route: u64,
    /// The checks of the input.
    pub input: u64,
    /// The stages, each without H-14.
    pub stages: [u64; 5],
    /// What stage v takes more without detections: unknown cells and the border of the grid are looked at, too.
    pub without_detections: u64,
    /// H-14.
    pub fail_safe: u64,
}

impl Steps {
    /// All together. Source: `spec/4-arithmetic.md#steps`.
    ///
    /// Detections go to stages i and iv.
    pub fn total(&self) -> u64 {
        let &Self { messages, route, input, stages, without_detections, fail_safe } = self;
        let [i, ii, iii, iv, v] = stages;
        let either = i.saturating_add(iv).max(without_detections);
        sum([messages, route, input, ii, iii, v, either, fail_safe])
    }
}

/// The most steps that a cycle of these sizes takes. Source: `spec/4-arithmetic.md#steps`.
pub fn most_steps(counts: &Counts, parameters: &Parameters) -> Steps {
    // IMPL-10
    let &Counts { tracks, points, detections, lists, cross_sections, places, .. } = counts;
    let [t, p, d] = [tracks, points, detections].map(u64::from);
    let [s, k, lists, stations] = [cross_sections, places, lists, counts.stations].map(u64::from);
    let [disk_rows, cav_rows, way_rows] =
        [counts.disk_rows, counts.cav_rows, counts.way_rows].map(u64::from);
    let items = d.saturating_mul(lists);
    let limit = u64::try_from(parameters.work_limit).unwrap_or(0);
    let disks = u64::try_from(parameters.n).unwrap_or(0);
    let columns = d.saturating_add(u64::try_from(parameters.miss_budget).unwrap_or(0).min(t));
    let (few, many) = (t.min(columns), t.max(columns));
    let assignment = product([few, few, many]).min(limit);
    let poses = p.saturating_add(k);
    let rows = disk_rows.saturating_add(cav_rows);
    let words = rows.wrapping_div(57).saturating_add(3);
    let of_disk = sum([340, product([20, disk_rows])]);
    let at_pose = sum([product([8, rows, words]), product([disks, of_disk])]);
    let v = if disk_rows == 0 {
        0
    } else {
        sum([product([poses, at_pose]), product([200, way_rows, words])])
    };
    let has_objects = u64::from(t.max(d) > 0);
    Steps {
        messages: product([MESSAGES, sum([128, product([6, stations])])]),
        route: sum([64, product([16, s])]),
        input: sum([product([64, t]), product([t, t]), product([32, p]), product([128, d])]),
        stages: [
            sum([
                product([1464, t.saturating_add(d)]),
                product([64, items]),
                product([3, t, d.saturating_add(items)]),
                // For each track of the assignment some for each track and column; of at most so many.
                product([64, many.saturating_add(assignment.saturating_mul(many).isqrt())]),
                product([3, assignment]),
            ]),
            sum([
                product([2048, p]),
                product([64, k]),
                product([2, s, sum([product([16, p]), k])]),
            ]),
            sum([product([128, p]), product([64, t]), product([20, p, t])]),
            sum([product([128, p]), product([64, d]), product([20, p, d])]),
            v,
        ],
        without_detections: if v == 0 { 0 } else { sum([v, product([poses, disks, 340])]) },
        fail_safe: if k == 0 {
            0
        } else {
            sum([
                product([1024, p]),
                product([224, k]),
                product([10, k, s]),
                product([4, d, t.saturating_add(d)]),
                // What is begun before it is too much.
                product([has_objects, sum([8192, product([SEGMENT, s])])]),
                limit.min(fail_safe_work(counts)),
            ])
        },
    }
}

/// The steps of H-14 that count for `work_limit`, of as many motions as there may be.
fn fail_safe_work(counts: &Counts) -> u64 {
    let &Counts { tracks, points, detections, lists, places, cross_sections, .. } = counts;
    let [tracks, d, lists, cross_sections] =
        [tracks, detections, lists, cross_sections].map(u64::from);
    let along = u64::from(places).saturating_add(u64::from(points));
    let longest = if lists == 0 { 1 } else { d.max(1) };
    let motions = sum([tracks, product([2, d, longest]), d]);
    let of_pairs = sum([512, product([8, lists, d])]);
    sum([product([d, longest, of_pairs]), product([motions, motion(along, cross_sections)])])
}

/// The most that one motion takes.
fn motion(places: u64, cross_sections: u64) -> u64 {
    sum([6656, product([1088, places]), product([SEGMENT, cross_sections])])
}

fn sum<const N: usize>(terms: [u64; N]) -> u64 {
    terms.into_iter().fold(0, u64::saturating_add)
}

fn product<const N: usize>(factors: [u64; N]) -> u64 {
    factors.into_iter().fold(1, u64::saturating_mul)
}

fn count(items: usize) -> u32 {
    u32::try_from(items).unwrap_or(u32::MAX)
}

/// A whole number that is not less, and at most 1 more.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "casts saturate")]
fn whole(number: f64) -> u32 {
    (number + 1.0) as u32
}

#[cfg(test)]
mod tests {
    use super::{Counts, LISTS, most_steps};
    use crate::input::parameters::Parameters;
    use crate::random::Random;

    /// IMPL-11: what fits with the longest lists fits with shorter ones.
    #[test]
    fn more_of_anything_takes_no_fewer_steps() {
        let mut random = Random::new(32);
        for _ in 0..20_000 {
            let mut below = |most: u32| u32::try_from(random.below(most.into())).unwrap_or(0);
            let counts = Counts {
                tracks: below(1025),
                points: below(1025),
                detections: below(2049),
                lists: below(5),
                cross_sections: below(8193),
                stations: below(70_000),
                places: below(100_000),
                disk_rows: below(3000),
                cav_rows: below(10_000),
                way_rows: below(1_000_000),
            };
            let work_limit = i64::from(below(u32::MAX)) >> below(32);
            let parameters = Parameters { work_limit, ..Parameters::default() };
            let total = |counts| most_steps(&counts, &parameters).total();
            let mut longer = [counts; 10];
            LISTS.iter().zip(&mut longer).for_each(|(list, it)| *(list.1)(it) += 1);
            longer[7].cav_rows += 1;
            longer[8].way_rows += 1;
            longer[9].lists += 1;
            for more in longer {
                assert!(total(counts) <= total(more), "{counts:?}, {more:?}, {work_limit}");
                // IMPL-13
                assert!(counts.is_within(&more) && !more.is_within(&counts), "{more:?}");
            }
        }
    }
}
