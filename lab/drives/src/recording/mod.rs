//! Cycles from a recording: the CAV's states, the objects around it, and a route.
//!
//! Every cycle is one time step. Its data have the ages of a real system, and the values they
//! had then: the scan, and the track list made from that scan, are 30 ms old; the trajectory was
//! made 20 ms ago and starts now; lead and grid are 10 ms old. Tracks and detections belong to
//! the same scan because the paper's stage i compares their positions as they are: 20 ms between
//! them are 0.6 m at 30 m/s, three times `theta_tr` (F-32; [`Options::track_age_ns`] changes it).
//!
//! There is one scan to a step, a function of step and seed, so that the detections of a cycle are
//! those that later cycles find in their history.

mod history;
pub mod lead;
mod nearby;
pub mod object;
pub mod sensor;

use mufasa_model::input::cycle::{
    Cycle, DetectionList, Ego, Route, Track, TrackList, Trajectory, TrajectoryPoint,
};

use crate::counted;
use crate::drive::{DriveCycle, Stream};
use crate::geometry::{Point, add, cross, direction, mix, mix_angle, scale, sub};
use crate::options::{Options, Sensor, Tail};
use crate::recording::lead::{Cav, leading_vehicle};
use crate::recording::nearby::{MARGIN, WHOLE, part_near};
use crate::recording::object::{Motion, Object, Seen, State, state_before};
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
pub(crate) fn drive(mut recording: Recording, options: &Options, every: usize) -> Stream {
    let every = every.max(1);
    let mut notes = std::mem::take(&mut recording.notes);
    let count = cycles(&recording.ego, recording.dt_ns, options);
    notes.push(format!(
        "{} from {}",
        counted(count.div_ceil(every), "cycle"),
        counted(recording.ego.len(), "state")
    ));
    let short = recording.ego.len() - count;
    if short > 0 {
        notes.push(format!(
            "no cycle for {short} states at the end: less is recorded after them than braking \
             takes (v / a_b), so that there is no plan to judge"
        ));
    }
    let Sensor { range_m, lead_range_m, sigma_m, probability, clutter, seed } = &options.sensor;
    notes.push(format!(
        "detectors: range {range_m} m (of the lead {lead_range_m} m), deviation {sigma_m} m, \
         probability {probability}, {clutter} clutter detections a scan, seed {seed}; tracks exact, \
         {} ms old",
        options.track_age_ns / 1_000_000
    ));
    if let Some(first) = recording.ego.first()
        && recording.first_scan() < first.step
    {
        notes.push(String::from(
            "the history begins before the first cycle: the recording has the other objects there",
        ));
    }
    if recording.route.cross_sections.len() > WHOLE && !recording.route.closed {
        notes.push(format!(
            "the route of each cycle is the part within {MARGIN} m of the CAV and its trajectory"
        ));
    }
    let is_outside = |state: &&State| {
        let route = part_near(&recording.route, &[state.position]);
        !in_corridor(&route, state.position)
    };
    let outside = recording.ego.iter().filter(is_outside).count();
    if outside > 0 {
        notes.push(format!(
            "{outside} of {} positions of the CAV are outside the corridor of its route",
            recording.ego.len()
        ));
    }
    let lead_range_m = *lead_range_m;
    let (name, source) = (recording.name.clone(), recording.source.clone());
    let maker = Maker { first_scan: recording.first_scan(), recording, options: options.clone() };
    let make = move |index| maker.cycle(index * every);
    let mut drive = Stream::new(name, source, count.div_ceil(every), make);
    (drive.lead_range_m, drive.notes) = (lead_range_m, notes);
    drive
}

impl Recording {
    /// The step of the first scan: that of the CAV's first state, or an earlier one where the
    /// recording has objects that move. What only stands says nothing about when the CAV came.
    fn first_scan(&self) -> i64 {
        let first = self.ego.first().map_or(0, |state| state.step);
        let moves = |object: &Object| match &object.motion {
            Motion::Standing(_) => None,
            Motion::Moving(states) => states.first().map(|state| state.step),
            Motion::Occupied { initial, .. } => Some(initial.step),
        };
        self.objects.iter().filter_map(moves).fold(first, i64::min)
    }
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

struct Maker {
    recording: Recording,
    options: Options,
    first_scan: i64,
}

impl Maker {
    #[expect(clippy::cast_precision_loss, reason = "at most 10 s")]
    fn dt_s(&self) -> f64 {
        self.recording.dt_ns as f64 / 1e9
    }

    fn cycle(&self, i: usize) -> DriveCycle {
        let id = format!("{}#{}", self.recording.name, self.recording.ego[i].step);
        DriveCycle { id, cycle: self.record(i) }
    }

    fn record(&self, i: usize) -> Cycle {
        let Recording { ego, size, dt_ns, route, .. } = &self.recording;
        let state = ego[i];
        let now_ns = START_NS + i64::try_from(i).unwrap_or(0).saturating_mul(*dt_ns);
        let options = &self.options;
        let [x, y] = state.position;
        let [cos, sin] = direction(state.heading);
        let recent = self.objects(state.step, GRID_AGE_NS);
        let measured = state_before(ego, state.step, self.back(GRID_AGE_NS), self.dt_s());
        let cav = Cav {
            position: measured.map_or(state.position, |s| s.position),
            length: size[0],
            width: size[1],
        };
        let track_ns = now_ns - options.track_age_ns;
        let grid_ns = now_ns - GRID_AGE_NS;
        let points = self.plan(i, now_ns);
        let driven: Vec<Point> =
            points.iter().map(|it| [it.x, it.y]).chain([state.position]).collect();
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
            trajectory: Some(Trajectory { stamp_ns: now_ns - TRAJECTORY_AGE_NS, points }),
            tracks: Some(TrackList {
                stamp_ns: track_ns,
                items: self.objects(state.step, options.track_age_ns).iter().map(track).collect(),
            }),
            detections: Some(self.scan(i, 0)),
            lead: leading_vehicle(route, grid_ns, &cav, &recent, options.sensor.lead_range_m),
            route: part_near(route, &driven),
            grid: Some(grid(options.grid, grid_ns, state.position, state.heading, &recent)),
            detection_history: self.history(i),
        }
    }

    /// The earlier scans that come with the cycle of state `i`, the youngest first.
    fn history(&self, i: usize) -> Vec<DetectionList> {
        let kept = self.recording.ego[i].step - self.first_scan;
        let ago = history::steps_ago(self.recording.dt_ns, kept);
        ago.into_iter().map(|ago| self.scan(i, ago)).collect()
    }

    /// The scan `ago` steps before that of state `i`. Before its first state the CAV goes on
    /// backwards as it came.
    fn scan(&self, i: usize, ago: i64) -> DetectionList {
        let Recording { ego, dt_ns, .. } = &self.recording;
        let before = i64::try_from(i).unwrap_or(i64::MAX).saturating_sub(ago);
        let cav = if let Ok(before) = usize::try_from(before) {
            ego[before].position
        } else {
            #[expect(clippy::cast_precision_loss, reason = "at most 1 s of steps")]
            let way = ego[0].speed * self.dt_s() * before as f64;
            add(ego[0].position, scale(direction(ego[0].heading + ego[0].slip), way))
        };
        let step = ego[i].step - ago;
        let stream = u64::try_from(step).unwrap_or(0);
        let stamp_ns = START_NS + before.saturating_mul(*dt_ns) - SCAN_AGE_NS;
        scan(&self.options.sensor, stream, stamp_ns, cav, &self.objects(step, SCAN_AGE_NS))
    }

    /// An age in time steps, up to one.
    #[expect(clippy::cast_precision_loss, reason = "at most 10 s")]
    fn back(&self, age_ns: i64) -> f64 {
        (age_ns as f64 / self.recording.dt_ns as f64).min(1.0)
    }

    /// What there is `age_ns` before a step.
    fn objects(&self, step: i64, age_ns: i64) -> Vec<Seen> {
        let Recording { objects, dt_ns, .. } = &self.recording;
        // The last of the steps that are needed lies up to one step after that time.
        let whole = (age_ns - 1).div_euclid(*dt_ns).max(0);
        let back = self.back(age_ns - whole * dt_ns);
        objects.iter().flat_map(|o| o.seen(step - whole, back, self.dt_s())).collect()
    }

    /// The rest of the recording, up to the horizon, from now on.
    fn plan(&self, i: usize, now_ns: i64) -> Vec<TrajectoryPoint> {
        let Recording { ego, dt_ns, .. } = &self.recording;
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
