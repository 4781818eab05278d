//! Mutants of the stages.

use mufasa_conform::vectors::flag;
use mufasa_model::input::cycle::{Cycle, TrackList};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::report::{FailedStage, Outcome, Report};
use mufasa_model::services::configuration::Configuration::{
    AllRemote, Local, MotRemote, PlanRemote,
};
use mufasa_props::bridge::{Answer, check_impl};
use mufasa_props::strategy::input::directions;

/// What a program with a fault answers.
type Mutant = fn(&Cycle) -> Answer;

/// The answer to a cycle that was changed on the way in.
fn seen_as(cycle: &Cycle, change: impl FnOnce(&mut Cycle)) -> Answer {
    let mut seen = cycle.clone();
    change(&mut seen);
    check_impl(&seen)
}

/// A mutant that sees another cycle.
macro_rules! sees {
    ($name:literal, |$cycle:ident| $change:expr) => {
        ($name, |cycle| seen_as(cycle, |$cycle| $change))
    };
}

/// Numbers that are compared with what is computed, all of them by a factor.
fn scale(parameters: &mut Parameters, factor: f64) {
    for number in [
        &mut parameters.theta_tr,
        &mut parameters.theta_map,
        &mut parameters.theta_obj,
        &mut parameters.theta_track_max,
        &mut parameters.start_tolerance,
        &mut parameters.v_max,
        &mut parameters.theta_velocity,
    ] {
        *number *= factor;
    }
}

/// Every finite number of the input or, without one, zero in its place.
fn zero_for_nan(cycle: &mut Cycle) {
    let mend = |number: &mut f64| {
        if !number.is_finite() {
            *number = 0.0;
        }
    };
    mend(&mut cycle.ego.y);
    mend(&mut cycle.ego.x);
    mend(&mut cycle.ego.speed);
    for track in cycle.tracks.iter_mut().flat_map(|list| &mut list.items) {
        [&mut track.x, &mut track.vx, &mut track.vy].into_iter().for_each(mend);
    }
    let lists = cycle.detections.iter_mut().chain(&mut cycle.detection_history);
    for detection in lists.flat_map(|list| &mut list.items) {
        mend(&mut detection.x);
    }
    for point in cycle.trajectory.iter_mut().flat_map(|list| &mut list.points) {
        mend(&mut point.x);
    }
}

/// Directions within rounding of the bound of their norm as who computes it in doubles sees them.
fn norm_in_doubles(cycle: &mut Cycle) {
    for (cos, sin) in directions(cycle) {
        let excess = (*cos * *cos + *sin * *sin - 1.0).abs();
        if (excess - 1e-6).abs() < 1e-15 {
            (*cos, *sin) = if excess <= 1e-6 { (1.0, 0.0) } else { (0.0, 0.0) };
        }
    }
}

fn each_track(
    list: &mut Option<TrackList>,
    change: impl Fn(&mut mufasa_model::input::cycle::Track),
) {
    list.iter_mut().flat_map(|list| &mut list.items).for_each(change);
}

fn stretch(cycle: &mut Cycle, by: f64) {
    cycle.ego.length += by;
    cycle.ego.width += by;
}

/// An answer that was changed on the way out.
fn answers(cycle: &Cycle, change: impl FnOnce(&mut Answer)) -> Answer {
    let mut answer = check_impl(cycle);
    change(&mut answer);
    answer
}

fn forget_index(answer: &mut Answer) {
    match answer {
        Ok(report) => report.input.iter_mut().for_each(|problem| problem.index = None),
        Err(problem) => problem.index = None,
    }
}

/// Remote problems as errors, local ones as remote: who is to blame is mixed up.
fn swap_blame(answer: &mut Answer) {
    if let Ok(report) = answer
        && let Some(problem) = report.input.clone()
    {
        *answer = Err(problem);
    }
}

/// All mutants by name.
pub const MUTANTS: &[(&str, Mutant)] = &[
    ("the other profile", |cycle| seen_as(cycle, |seen| seen.profile = flag::other(cycle.profile))),
    sees!("parameters ignored", |c| c.parameters = Parameters::default()),
    sees!("thresholds 0.1 % higher", |c| scale(&mut c.parameters, 1.001)),
    sees!("thresholds 0.1 % lower", |c| scale(&mut c.parameters, 0.999)),
    sees!("thresholds 10 ppm higher", |c| scale(&mut c.parameters, 1.000_01)),
    sees!("thresholds doubled", |c| scale(&mut c.parameters, 2.0)),
    sees!("thresholds halved", |c| scale(&mut c.parameters, 0.5)),
    sees!("stage i off", |c| {
        (c.parameters.theta_tr, c.parameters.theta_track_max) = (1e3, 1e3);
        c.parameters.miss_budget = 64;
    }),
    sees!("stage ii near the path only", |c| c.parameters.theta_map = 1e3),
    sees!("track list emptied", |c| c.tracks.iter_mut().for_each(|list| list.items.clear())),
    sees!("track list missing", |c| c.tracks = None),
    sees!("detections emptied", |c| c.detections.iter_mut().for_each(|list| list.items.clear())),
    sees!("detections missing", |c| c.detections = None),
    sees!("grid missing", |c| c.grid = None),
    sees!("grid all free", |c| c.grid.iter_mut().for_each(|grid| grid.occupied.fill(0))),
    sees!("grid all occupied", |c| c.grid.iter_mut().for_each(|grid| grid.occupied.fill(0xff))),
    sees!("grid not turned", |c| {
        c.grid.iter_mut().for_each(|grid| (grid.cos, grid.sin) = (1.0, 0.0));
    }),
    sees!("unknown cells free", |c| c.grid.iter_mut().for_each(|grid| grid.unknown = None)),
    sees!("unknown cells occupied", |c| c.grid.iter_mut().for_each(|grid| {
        grid.unknown.iter().for_each(|unknown| grid.occupied.clone_from(unknown));
    })),
    sees!("lead ignored", |c| c.lead = None),
    sees!("lead stands", |c| c.lead.iter_mut().for_each(|lead| lead.speed = 0.0)),
    sees!("gap half a metre shorter", |c| c.lead.iter_mut().for_each(|lead| lead.gap -= 0.5)),
    sees!("history ignored", |c| c.detection_history.clear()),
    sees!("trajectory missing", |c| c.trajectory = None),
    sees!("last point forgotten", |c| c.trajectory.iter_mut().for_each(|it| {
        it.points.pop();
    })),
    sees!("first point only", |c| c.trajectory.iter_mut().for_each(|it| it.points.truncate(1))),
    sees!("points in the past", |c| {
        c.trajectory
            .iter_mut()
            .flat_map(|it| &mut it.points)
            .for_each(|p| p.t_ns = p.t_ns.saturating_sub(1_000_000_000));
    }),
    sees!("heading backwards", |c| {
        c.trajectory.iter_mut().flat_map(|it| &mut it.points).for_each(|p| p.cos = -p.cos);
    }),
    sees!("trajectory a centimetre left", |c| {
        c.trajectory.iter_mut().flat_map(|it| &mut it.points).for_each(|p| p.y += 0.01);
    }),
    sees!("no prediction", |c| each_track(&mut c.tracks, |t| (t.vx, t.vy) = (0.0, 0.0))),
    sees!("prediction backwards", |c| each_track(&mut c.tracks, |t| {
        (t.vx, t.vy) = (-t.vx, -t.vy);
    })),
    sees!("objects turned along x", |c| each_track(&mut c.tracks, |t| {
        (t.cos, t.sin) = (1.0, 0.0);
    })),
    sees!("tracks of now", |c| {
        let now_ns = c.now_ns;
        c.tracks.iter_mut().for_each(|list| list.stamp_ns = now_ns);
    }),
    sees!("detections of now", |c| {
        let now_ns = c.now_ns;
        c.detections.iter_mut().for_each(|list| list.stamp_ns = now_ns);
    }),
    sees!("history a nanosecond older", |c| {
        c.detection_history.iter_mut().for_each(|list| list.stamp_ns -= 1);
    }),
    sees!("history a nanosecond younger", |c| {
        c.detection_history.iter_mut().for_each(|list| list.stamp_ns += 1);
    }),
    sees!("trajectory begins at the CAV", |c| {
        let (x, y) = (c.ego.x, c.ego.y);
        let first = c.trajectory.iter_mut().filter_map(|it| it.points.first_mut());
        first.for_each(|point| (point.x, point.y) = (x, y));
    }),
    sees!("route without ends", |c| {
        let far = [(0, -1e3), (c.route.cross_sections.len().wrapping_sub(1), 1e3)];
        for (end, by) in far {
            c.route.cross_sections.get_mut(end).into_iter().for_each(|it| it.x += by);
        }
    }),
    sees!("center_offset ignored", |c| c.ego.center_offset = 0.0),
    sees!("center_offset backwards", |c| c.ego.center_offset = -c.ego.center_offset),
    sees!("routes open", |c| c.route.closed = false),
    sees!("routes closed", |c| c.route.closed = true),
    sees!("corridor a millimetre narrower", |c| c.route.cross_sections.iter_mut().for_each(|s| {
        (s.left[1], s.right[1]) = (s.left[1] - 1e-3, s.right[1] + 1e-3);
    })),
    sees!("corridor ignored", |c| c.route.cross_sections.iter_mut().for_each(|s| {
        (s.left, s.right) = ([s.x, s.y], [s.x, s.y]);
    })),
    sees!("corridor endless", |c| c.route.cross_sections.iter_mut().for_each(|s| {
        (s.left[1], s.right[1]) = (s.y + 1e4, s.y - 1e4);
    })),
    sees!("left and right swapped", |c| {
        c.route.cross_sections.iter_mut().for_each(|s| std::mem::swap(&mut s.left, &mut s.right));
    }),
    sees!("CAV a centimetre larger", |c| stretch(c, 0.01)),
    sees!("CAV a centimetre smaller", |c| stretch(c, -0.01)),
    sees!("CAV 2 m larger", |c| stretch(c, 2.0)),
    sees!("CAV at rest", |c| c.ego.speed = 0.0),
    sees!("CAV 0.1 % faster", |c| c.ego.speed *= 1.001),
    sees!("CAV 0.1 % slower", |c| c.ego.speed *= 0.999),
    sees!("CAV twice as fast", |c| c.ego.speed *= 2.0),
    sees!("CAV at the origin", |c| (c.ego.x, c.ego.y) = (0.0, 0.0)),
    sees!("weaker brakes", |c| c.parameters.a_b *= 0.5),
    sees!("stronger brakes", |c| c.parameters.a_b *= 2.0),
    sees!("longer safety time", |c| c.parameters.safety_time *= 2.0),
    sees!("no safety time", |c| c.parameters.safety_time = 0.0),
    sees!("stronger engine", |c| c.parameters.a_max *= 2.0),
    sees!("later brakes", |c| c.parameters.tau += 1e-3),
    sees!("earlier brakes", |c| c.parameters.tau = (c.parameters.tau - 1e-3).max(0.0)),
    sees!("others yield in twice the time", |c| c.parameters.t_yield *= 2.0),
    sees!("others yield at once", |c| c.parameters.t_yield = 0.0),
    sees!("others brake half as hard for the CAV", |c| c.parameters.a_yield *= 0.5),
    sees!("objects of any speed", |c| c.parameters.v_object = 1e3),
    sees!("one disk", |c| c.parameters.n = 1),
    sees!("64 disks", |c| c.parameters.n = 64),
    sees!("one miss allowed", |c| c.parameters.miss_budget =
        c.parameters.miss_budget.saturating_add(1)),
    sees!("no miss allowed", |c| c.parameters.miss_budget = 0),
    sees!("ages a nanosecond longer", |c| c.parameters.max_age_ns =
        c.parameters.max_age_ns.saturating_add(1)),
    sees!("ages a nanosecond shorter", |c| c.parameters.max_age_ns =
        c.parameters.max_age_ns.saturating_sub(1)),
    sees!("steps a nanosecond longer", |c| c.parameters.step_max_ns =
        c.parameters.step_max_ns.saturating_add(1)),
    sees!("steps a nanosecond shorter", |c| c.parameters.step_max_ns =
        c.parameters.step_max_ns.saturating_sub(1)),
    sees!("a step of work less", |c| c.parameters.work_limit =
        c.parameters.work_limit.saturating_sub(1)),
    sees!("clock a nanosecond late", |c| c.now_ns = c.now_ns.saturating_sub(1)),
    sees!("column Local of the schedule", |c| c.configuration = Local),
    sees!("column MotRemote of the schedule", |c| c.configuration = MotRemote),
    sees!("column AllRemote of the schedule", |c| c.configuration = AllRemote),
    sees!("column PlanRemote of the schedule", |c| c.configuration = PlanRemote),
    sees!("zero for NaN", |c| zero_for_nan(c)),
    sees!("norms in doubles", |c| norm_in_doubles(c)),
    ("indices not reported", |cycle| answers(cycle, forget_index)),
    ("remote problems are errors", |cycle| answers(cycle, swap_blame)),
    ("a missing input fails", |cycle| {
        answers(cycle, |answer| {
            if let Ok(report) = answer
                && report.stages.iter().any(|it| matches!(it, Outcome::NotApplicable(_)))
            {
                report.failed_stage = Some(FailedStage::NoObstacleCheck);
            }
        })
    }),
    ("an error is a safe cycle", |cycle| {
        let stages = [const { Outcome::NotScheduled }; 5];
        check_impl(cycle).or(Ok(Report { failed_stage: None, stages, input: None }))
    }),
];
