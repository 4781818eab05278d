//! Cycles from a recording: the CAV's states, the objects around it, and a route.
//!
//! Every cycle is one time step. Its data have the ages of a real system, and the values they
//! had then: the scan, and the track list made from that scan, are 30 ms old; the trajectory was
//! made 20 ms ago and starts now; lead and grid are 10 ms old. Tracks and detections belong to
//! the same scan because stage i compares their positions as they are: 20 ms between them are
//! 0.6 m at 30 m/s, three times `theta_tr`.
//!
//! `previous_tracks` stay `None`: they depend on verdicts (H-09), hence [`PreviousTracks::Carried`].

pub mod lead;
pub mod object;
pub mod sensor;

use mufasa_model::input::cycle::{
    Cycle, Ego, Route, Track, TrackList, Trajectory, TrajectoryPoint,
};

use crate::drive::{Drive, DriveCycle, PreviousTracks};
use crate::geometry::{Point, cross, direction, mix, mix_angle, sub};
use crate::options::{Options, Sensor, Tail};
use crate::recording::lead::{Cav, leading_vehicle};
use crate::recording::object::{Object, Seen, State, state_before};
use crate::recording::sensor::{grid, scan};

/// The first cycle's time, ns.
const START_NS: i64 = 1_000_000_000;
/// Ages of the data, ns.
const SCAN_AGE_NS: i64 = 30_000_000;
const TRAJECTORY_AGE_NS: i64 = 20_000_000;
const GRID_AGE_NS: i64 = 10_000_000;
/// Longest time between points of a trajectory, ns; longer steps are divided evenly.
const POINT_NS: i64 = 100_000_000;
/// Points of a trajectory; the domain's limit.
const POINTS_MAX: usize = 1024;

/// What happened, before anything is decided about services, sensors and ages.
pub(crate) struct Recording {
    pub name: String,
    pub source: String,
    pub dt_ns: i64,
    /// The CAV, one state for every step; positions are the centre of its rectangle.
    pub ego: Vec<State>,
    /// Its length and width, m.
    pub size: [f64; 2],
    /// Everything else.
    pub objects: Vec<Object>,
    pub route: Route,
    pub notes: Vec<String>,
}

/// The drive of a recording. `every`: a cycle at every so many steps only.
pub(crate) fn drive(recording: Recording, options: &Options, every: usize) -> Drive {
    let maker = Maker { recording: &recording, options };
    let mut cycles: Vec<DriveCycle> = Vec::new();
    let count = self::cycles(&recording.ego, recording.dt_ns, options);
    for i in (0..count).step_by(every.max(1)) {
        let id = format!("{}#{}", recording.name, recording.ego[i].step);
        cycles.push(DriveCycle { id, cycle: maker.cycle(i) });
    }
    let mut notes = recording.notes.clone();
    notes.push(format!("{} cycles from {} states", cycles.len(), recording.ego.len()));
    let short = recording.ego.len() - count;
    if short > 0 {
        notes.push(format!(
            "no cycle for {short} states at the end: less is recorded after them than braking \
             takes (v / a_b), so that there is no plan to judge"
        ));
    }
    let Sensor { range_m, sigma_m, probability, clutter, seed } = &options.sensor;
    notes.push(format!(
        "detectors: range {range_m} m, deviation {sigma_m} m, probability {probability}, {clutter} \
         clutter detections a scan, seed {seed}"
    ));
    let outside = recording.ego.iter().filter(|s| !in_corridor(&recording.route, s.position));
    let outside = outside.count();
    if outside > 0 {
        notes.push(format!(
            "{outside} of {} positions of the CAV are outside the corridor of its route",
            recording.ego.len()
        ));
    }
    let Recording { name, source, .. } = recording;
    Drive { name, source, cycles, previous_tracks: PreviousTracks::Carried, notes }
}

/// States of a recording that give a cycle: all, or those up to the last that is followed by as
/// much as braking from it takes, and by one step at least.
pub(crate) fn cycles(states: &[State], dt_ns: i64, options: &Options) -> usize {
    let a_b = options.parameters.a_b;
    // With a deceleration outside the domain the monitor is to say so.
    if options.tail == Tail::Keep || !(0.1..=100.0).contains(&a_b) {
        return states.len();
    }
    let long_enough = |(i, state): (usize, &State)| {
        let steps = states.len() - 1 - i;
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 steps of 10 s")]
        let rest_s = steps as f64 * (dt_ns as f64 / 1e9);
        steps > 0 && rest_s >= state.speed.abs() / a_b
    };
    states.iter().enumerate().rposition(long_enough).map_or(0, |last| last + 1)
}

struct Maker<'a> {
    recording: &'a Recording,
    options: &'a Options,
}

impl Maker<'_> {
    #[expect(clippy::cast_precision_loss, reason = "at most 10 s")]
    fn dt_s(&self) -> f64 {
        self.recording.dt_ns as f64 / 1e9
    }

    fn cycle(&self, i: usize) -> Cycle {
        let Recording { ego, size, dt_ns, route, .. } = self.recording;
        let state = ego[i];
        let now_ns = START_NS + i64::try_from(i).unwrap_or(0).saturating_mul(*dt_ns);
        let options = self.options;
        let [x, y] = state.position;
        let [cos, sin] = direction(state.heading);
        let scanned = self.objects(state.step, SCAN_AGE_NS);
        let recent = self.objects(state.step, GRID_AGE_NS);
        let measured = state_before(ego, state.step, self.back(GRID_AGE_NS), self.dt_s());
        let cav = Cav {
            position: measured.map_or(state.position, |s| s.position),
            length: size[0],
            width: size[1],
        };
        let stream = u64::try_from(state.step).unwrap_or(0);
        let scan_ns = now_ns - SCAN_AGE_NS;
        let grid_ns = now_ns - GRID_AGE_NS;
        Cycle {
            profile: options.profile,
            parameters: options.parameters.clone(),
            now_ns,
            configuration: options.configuration,
            ego: Ego {
                x,
                y,
                cos,
                sin,
                speed: state.speed.abs(),
                length: size[0],
                width: size[1],
                center_offset: 0.0,
            },
            trajectory: Some(Trajectory {
                stamp_ns: now_ns - TRAJECTORY_AGE_NS,
                points: self.plan(i, now_ns),
            }),
            tracks: Some(TrackList {
                stamp_ns: scan_ns,
                items: scanned.iter().map(track).collect(),
            }),
            detections: Some(scan(&options.sensor, stream, scan_ns, state.position, &scanned)),
            lead: leading_vehicle(route, grid_ns, &cav, &recent, options.sensor.range_m),
            route: route.clone(),
            grid: Some(grid(options.grid, grid_ns, state.position, state.heading, &recent)),
            previous_tracks: None,
        }
    }

    /// An age in time steps; older data than the last step are taken from there.
    #[expect(clippy::cast_precision_loss, reason = "at most 10 s")]
    fn back(&self, age_ns: i64) -> f64 {
        (age_ns as f64 / self.recording.dt_ns as f64).min(1.0)
    }

    fn objects(&self, step: i64, age_ns: i64) -> Vec<Seen> {
        let back = self.back(age_ns);
        self.recording.objects.iter().flat_map(|o| o.seen(step, back, self.dt_s())).collect()
    }

    /// The rest of the recording, up to the horizon, from now on.
    fn plan(&self, i: usize, now_ns: i64) -> Vec<TrajectoryPoint> {
        let Recording { ego, dt_ns, .. } = self.recording;
        let parts = (dt_ns + POINT_NS - 1) / POINT_NS;
        let steps = (self.options.horizon_s / self.dt_s() + 1e-6).floor();
        let mut points = vec![point(&ego[i], now_ns)];
        for (k, pair) in (1_i64..).zip(ego[i..].windows(2)) {
            #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 steps")]
            if k as f64 > steps {
                break;
            }
            for part in 1..=parts {
                #[expect(clippy::cast_precision_loss, reason = "at most 100 parts")]
                let w = part as f64 / parts as f64;
                let between = State {
                    position: mix(pair[0].position, pair[1].position, w),
                    heading: mix_angle(pair[0].heading, pair[1].heading, w),
                    ..pair[1]
                };
                let t_ns = now_ns + (k - 1) * dt_ns + dt_ns * part / parts;
                points.push(point(&between, t_ns));
            }
        }
        points.truncate(POINTS_MAX);
        points
    }
}

fn point(state: &State, t_ns: i64) -> TrajectoryPoint {
    let [x, y] = state.position;
    let [cos, sin] = direction(state.heading);
    TrajectoryPoint { t_ns, x, y, cos, sin }
}

fn track(seen: &Seen) -> Track {
    let [x, y] = seen.shape.center;
    let [cos, sin] = direction(seen.shape.heading);
    let [vx, vy] = seen.velocity;
    let (length, width) = (seen.shape.length, seen.shape.width);
    Track { id: seen.id, x, y, cos, sin, vx, vy, length, width }
}

/// Whether a point is in the corridor, in doubles: for notes, not for verdicts.
fn in_corridor(route: &Route, p: Point) -> bool {
    let next = route.cross_sections.iter().cycle().skip(1);
    let segments = route.cross_sections.len() - usize::from(!route.closed);
    route.cross_sections.iter().zip(next).take(segments).any(|(a, b)| {
        in_triangle(p, [a.left, a.right, b.right]) || in_triangle(p, [a.left, b.right, b.left])
    })
}

fn in_triangle(p: Point, [a, b, c]: [Point; 3]) -> bool {
    let sides = [[a, b], [b, c], [c, a]].map(|[q, r]| cross(sub(r, q), sub(p, q)));
    sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
}
