//! What is around a CAV that stands: so few things that a cycle is quickly decided, and each stage fails
//! now and then, far from its thresholds.

use mufasa_model::input::cycle::{
    CrossSection, Detection, DetectionList, Ego, Grid, Lead, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::messages::Measured;
use mufasa_model::monitor::settings::Settings;

use super::times::MS;
use crate::strategy::draw::Draw;

/// A straight road of 80 m, 8 m wide.
pub fn route() -> Route {
    let at = |x| CrossSection { x, y: 0.0, left: [x, 4.0], right: [x, -4.0] };
    Route { closed: false, cross_sections: [-20.0, 20.0, 60.0].map(at).to_vec() }
}

/// How far the CAV goes at once, m. No sum of such ways is the tolerance of a start, so that no margin decides.
pub(super) const WAY: f64 = 1.25;

/// Where things are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scene {
    /// Of the CAV, m.
    x: f64,
    /// Of the only object, m.
    object: [f64; 2],
}

impl Default for Scene {
    fn default() -> Self {
        Self { x: 0.0, object: [22.0, 2.0] }
    }
}

impl Scene {
    /// The object, or what is wrong about it.
    pub fn tracks(
        &self,
        draw: &mut Draw<'_>,
        stamp_ns: i64,
        is_odd: bool,
        places: i64,
    ) -> TrackList {
        let [x, y] = self.object;
        let (cos, sin, vx, vy, length, width) = (1.0, 0.0, 0.0, 0.0, 4.5, 1.9);
        let track = Track { id: 1, x, y, cos, sin, vx, vy, length, width };
        let beside = |id: i64, x: f64| Track { id, x, ..track.clone() };
        let mut items = vec![track.clone()];
        if is_odd {
            items = match draw.below(6) {
                0 => vec![beside(1, x + 3.17)],
                1 => vec![beside(1, f64::NAN)],
                2 => Vec::new(),
                3 => (0..places).map(|id| beside(id, x)).collect(),
                4 => (0..=places).map(|id| beside(id, x)).collect(),
                _ => vec![beside(1, x + 0.1)],
            };
        }
        TrackList { stamp_ns, items }
    }

    /// Two points at which the CAV stands, or what is wrong about them.
    pub fn trajectory(&self, draw: &mut Draw<'_>, stamp_ns: i64, is_odd: bool) -> Trajectory {
        let at = |i: i64| TrajectoryPoint {
            t_ns: stamp_ns + i * 100 * MS,
            x: self.x,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
        };
        let mut points = vec![at(0), at(1)];
        if is_odd {
            match draw.below(4) {
                0 => points.iter_mut().for_each(|it| it.y = 9.0),
                1 => points.clear(),
                2 => points[1].x = f64::NAN,
                _ => points[1].x += 30.0,
            }
        }
        Trajectory { stamp_ns, points }
    }

    /// What the CAV measures at a time. Things are odd once in `calm` times each.
    pub fn measured(
        &mut self,
        draw: &mut Draw<'_>,
        now_ns: i64,
        calm: usize,
        settings: &Settings,
        last_kept_ns: Option<i64>,
    ) -> Measured {
        if draw.one_in(calm) {
            let way = settings.stall.map_or(WAY, |it| it.way);
            self.x = draw.pick(&[self.x, self.x + way, self.x + way.next_up(), 0.0]);
        }
        if draw.one_in(calm) {
            self.object = draw.pick(&[[22.0, 2.0], [6.0, 2.0], [7.0, -2.0], [25.3, 2.0]]);
        }
        let detections = (!draw.one_in(calm))
            .then(|| self.detections(draw, now_ns, calm, settings, last_kept_ns));
        let speed = if draw.one_in(2 * calm) { draw.pick(&[f64::NAN, -1.0, 12.0]) } else { 0.0 };
        let x = if draw.one_in(4 * calm) { 1e12 } else { self.x };
        let ego = Ego {
            x,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed,
            length: 4.5,
            width: 1.9,
            center_offset: 1.4,
        };
        let [is_odd, other_is_odd] = [draw.one_in(calm), draw.one_in(calm)];
        let trajectory = (!draw.one_in(calm)).then(|| {
            let stamp_ns = Self::stamp(draw, now_ns, calm, settings);
            self.trajectory(draw, stamp_ns, is_odd)
        });
        let tracks = (!draw.one_in(calm)).then(|| {
            let stamp_ns = Self::stamp(draw, now_ns, calm, settings);
            self.tracks(draw, stamp_ns, other_is_odd, settings.memory.tracks)
        });
        let gap = draw.pick(&[0.2, 30.0, -1.0]);
        let lead = draw.one_in(calm).then_some(Lead { stamp_ns: now_ns, gap, speed: 0.0 });
        let grid = draw.one_in(calm).then(|| self.grid(draw, now_ns));
        Measured { ego, trajectory, tracks, detections, lead, grid }
    }

    /// Of what the CAV gives itself.
    fn stamp(draw: &mut Draw<'_>, now_ns: i64, calm: usize, settings: &Settings) -> i64 {
        if !draw.one_in(calm) {
            return now_ns;
        }
        let oldest_ns = now_ns - settings.parameters.max_age_ns;
        draw.pick(&[oldest_ns, oldest_ns - 1, now_ns + 1])
    }

    fn detections(
        &self,
        draw: &mut Draw<'_>,
        now_ns: i64,
        calm: usize,
        settings: &Settings,
        last_kept_ns: Option<i64>,
    ) -> DetectionList {
        let [x, y] = self.object;
        let (cos, sin, length, width) = (1.0, 0.0, 4.5, 1.9);
        // As if it came nearer or went away: which earlier lists a cycle has then decides.
        let moved = if draw.one_in(6) { draw.range(-0.9, 0.9) } else { 0.0 };
        let one = Detection { x: x + moved, y, cos, sin, length, width };
        let places = settings.memory.detections;
        let mut items = vec![one.clone()];
        if draw.one_in(calm) {
            items = match draw.below(4) {
                0 => Vec::new(),
                1 => (0..places).map(|_| one.clone()).collect(),
                2 if settings.profile == Profile::HARDENED => {
                    (0..=places).map(|_| one.clone()).collect()
                }
                _ => vec![Detection { length: -1.0, ..one }],
            };
        }
        let mut stamp_ns = Self::stamp(draw, now_ns, calm, settings);
        if let Some(kept_ns) = last_kept_ns.filter(|_| draw.one_in(calm)) {
            let apart_ns = draw.near_ns(83_333_334);
            let max_age_ns = settings.parameters.max_age_ns;
            let is_current = (0..=max_age_ns).contains(&(now_ns - kept_ns - apart_ns));
            stamp_ns = if is_current { kept_ns + apart_ns } else { stamp_ns };
        }
        DetectionList { stamp_ns, items }
    }

    /// One cell, free or occupied, where the CAV is.
    fn grid(&self, draw: &mut Draw<'_>, now_ns: i64) -> Grid {
        Grid {
            stamp_ns: now_ns,
            x: self.x,
            y: -0.5,
            cos: 1.0,
            sin: 0.0,
            resolution: 1.0,
            width: 1,
            height: 1,
            occupied: vec![draw.pick(&[0, 1])],
            unknown: None,
        }
    }
}
