//! A vehicle loop at 20 Hz around the monitor, with a stand-in for the road and for a station. From 4 s
//! on to 5 s the station's tracks are 3 m aside: the monitor falls back to the local services, waits
//! `t_wait`, and offloads again. `cargo run -p mufasa --example vehicle`

use std::error::Error;
use std::time::Duration;

use mufasa::input::cycle::{CrossSection, Detection, Ego, Route, Track, TrajectoryPoint};
use mufasa::input::detection_index::Slot;
use mufasa::input::route_index::Block;
use mufasa::input::scratch::{Column, Row};
use mufasa::monitor::{
    Accepted, Arrival, Decision, Gap, Inputs, Memory, Message, Monitor, Settings, Time, Verified,
};
use mufasa::offloading::requester::{
    Action, Actions, Group, Groups, RequesterError, StationRecord,
};
use mufasa::services::configuration::Configuration;

/// As `docs/configuration.md` advises.
const PERIOD: Duration = Duration::from_millis(50);
const TAU: Duration = Duration::from_millis(250);
/// Cycles in a second, and in the whole loop.
const SECOND: i64 = 20;
const CYCLES: i64 = 20 * SECOND;
const MOST_DETECTIONS: usize = 16;
/// From the command to full braking, the vehicle's own.
const BUILD_UP: Duration = Duration::from_millis(100);
/// The network loses what the station sends in this cycle.
const LOST: i64 = 2 * SECOND;

fn main() -> Result<(), Box<dyn Error>> {
    let mut settings = Settings::new(PERIOD);
    // From `now` of a cycle to braking with a_b (docs/assumptions.md, A-07).
    settings.stages.tau = TAU.as_secs_f64();
    let route = road();
    let memory = Memory {
        stations: &mut [StationRecord::FREE; 4],
        rows: &mut vec![Row::default(); 64],
        columns: &mut vec![Column::default(); 68],
        detections: &mut vec![Detection::default(); Memory::detections_for(MOST_DETECTIONS)],
        slots: &mut vec![Slot::default(); Memory::slots_for(MOST_DETECTIONS)],
        cross_sections: &mut vec![CrossSection::default(); route.len()],
        blocks: &mut vec![Block::default(); Block::needed(route.len())],
    };
    let mut monitor = Monitor::new(settings, memory)?;
    monitor.set_route(&Route { closed: false, cross_sections: &route })?;

    let mut station = Station::default();
    let (mut driven, mut fallbacks, mut copied, mut advised) = (Vec::new(), 0, 0, 0);
    // What was followed last, verified or its own: followed where no other is there, also after an unsafe cycle, until its `brake_by`.
    // The CAV brakes fully by then, so begins earlier by the build-up of its brakes; here it is then no point.
    // Control, which runs more often than cycles do, has to look at that time itself.
    let (mut kept, mut brake_by) = (Vec::new(), None);
    // The last of each that was accepted: it bridges a lost message while it is current.
    let (mut tracks, mut trajectory) = (None, None);
    for cycle in 0..CYCLES {
        // The period after the loss comes 1 ms late, which a dt_max of two periods alone would not bear.
        let late = i64::from(cycle == LOST + 1);
        let now = Time::from_milliseconds(1000 / SECOND * cycle + late)?;
        let world = World::at(now);

        // What came over the network since the last period, and time itself.
        if cycle == 0 {
            station.hear(monitor.offer(now, 1, Groups::ALL));
            station.hear(monitor.offer(now, 0, Groups::ALL));
        }
        for (group, session) in std::mem::take(&mut station.asked) {
            station.hear(monitor.confirm(now, 1, group, session));
        }
        station.take(&monitor.tick(now));
        let aside = if (4 * SECOND..5 * SECOND).contains(&cycle) { 3.0 } else { 0.0 };
        if let Some(message) = station.tracks(now, world.tracks(aside)).filter(|_| cycle != LOST) {
            tracks = station.accepted(monitor.tracks(now, message)).or(tracks);
        }
        if let Some(message) = station.trajectory(now, world.trajectory()).filter(|_| cycle != LOST)
        {
            trajectory = station.accepted(monitor.trajectory(now, message)).or(trajectory);
        }

        // What the CAV measured and planned itself.
        // A planner that stands has no plan, also in the period in which it is told to start.
        let detections = world.detections();
        let own_plan = (!station.planner_stands).then(|| world.trajectory());
        let lead = Gap::between_bumpers(world.gap);
        let mut inputs =
            Inputs::new(now, world.ego).detections(now, &detections).lead(now, lead, 5.0);
        if let Some(own_plan) = &own_plan {
            inputs = inputs.local_trajectory(now, own_plan);
        }
        if let Some(tracks) = &tracks {
            inputs = inputs.remote_tracks(tracks);
        }
        if let Some(trajectory) = &trajectory {
            inputs = inputs.remote_trajectory(trajectory);
        }

        // The one way to what the station sent.
        let is_local = monitor.configuration() == Configuration::Local;
        let (decision, actions) = monitor.cycle(&inputs);
        let has_trajectory = matches!(decision, Decision::Safe { trajectory: Some(_), .. });
        if (LOST..LOST + 2).contains(&cycle) && !has_trajectory {
            return Err("a lost message was not bridged".into());
        }
        if let Decision::Unsafe { report, .. } = &decision {
            let why = report.as_ref().map(|report| report.failed_stage);
            println!("{:4.1} s: unsafe: {why:?}, back to the local services", seconds(cycle));
            fallbacks += 1;
        }
        driven.push(match (decision, &own_plan) {
            (Decision::Safe { trajectory: Some(trajectory), .. }, _) => {
                (kept, brake_by) = (trajectory.points.to_vec(), trajectory.brake_by());
                follow(trajectory)
            }
            // Of a cycle with anything remote an own plan is driven only when it came out (MON-67).
            (_, Some(own_plan)) if is_local => {
                (kept, brake_by) = (own_plan.clone(), now.checked_add(TAU));
                first(own_plan)
            }
            _ if brake_by.is_some_and(|by| now.checked_add(BUILD_UP).is_none_or(|at| at >= by)) => {
                None
            }
            _ => {
                copied += 1;
                kept.iter().find(|point| point.t_ns > now.as_nanoseconds()).copied()
            }
        });
        station.take(&actions);
        // What this program seems to get wrong: nothing.
        if let Some(advice) = monitor.advice() {
            println!("{}", advice.message());
            advised += 1;
        }
        if cycle % SECOND == 0 {
            println!("{:4.1} s: {:?}", seconds(cycle), monitor.configuration());
        }
    }
    let (configuration, ignored) = (monitor.configuration(), station.ignored);
    if [fallbacks, copied, ignored, advised] != [1, 1, 1, 0]
        || configuration != Configuration::AllRemote
    {
        return Err(format!("{fallbacks} fallbacks, {copied} copies, {ignored} ignored, {advised} advices, {configuration:?}").into());
    }
    println!("{} points driven, one fallback, offloading again", driven.len());
    Ok(())
}

/// A controller for what others planned takes a verified trajectory and nothing else.
fn follow(
    trajectory: Verified<'_, mufasa::input::cycle::Trajectory<'_>>,
) -> Option<TrajectoryPoint> {
    trajectory.points.first().copied()
}

/// The CAV's own plan.
fn first(points: &[TrajectoryPoint]) -> Option<TrajectoryPoint> {
    points.first().copied()
}

fn seconds(cycle: i64) -> f64 {
    f64::from(i32::try_from(1000 / SECOND * cycle).unwrap_or(0)) / 1000.0
}

/// A straight road of 300 m, 6 m wide.
fn road() -> Vec<CrossSection> {
    let at = |x| CrossSection { x, y: 0.0, left: [x, 3.0], right: [x, -3.0] };
    (-5..26).map(|i| at(10.0 * f64::from(i))).collect()
}

/// The CAV, driving at 5 m/s, a car 20 m ahead of it and one beside the road that do the same.
struct World {
    now: Time,
    ego: Ego,
    gap: f64,
}

impl World {
    fn at(now: Time) -> Self {
        #[allow(clippy::cast_precision_loss, reason = "a few seconds")]
        let x = 5e-9 * now.as_nanoseconds() as f64;
        let ego = Ego {
            x,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 5.0,
            length: 4.5,
            width: 1.9,
            center_offset: 1.4,
        };
        Self { now, ego, gap: 20.0 }
    }

    fn ahead(&self) -> f64 {
        self.ego.x + self.ego.center_offset + 0.5 * self.ego.length + self.gap + 2.25
    }

    fn detections(&self) -> Vec<Detection> {
        let car = |(x, y)| Detection { x, y, cos: 1.0, sin: 0.0, length: 4.5, width: 1.9 };
        vec![car((self.ahead(), 0.0)), car((self.ahead() + 20.0, 8.0))]
    }

    fn tracks(&self, aside: f64) -> Vec<Track> {
        let (cos, sin, vx, vy, length, width) = (1.0, 0.0, 5.0, 0.0, 4.5, 1.9);
        let car = |id, x, y| Track { id, x, y, cos, sin, vx, vy, length, width };
        vec![car(7, self.ahead(), aside), car(8, self.ahead() + 20.0, 8.0)]
    }

    fn trajectory(&self) -> Vec<TrajectoryPoint> {
        let point = |i: i32| TrajectoryPoint {
            t_ns: self.now.as_nanoseconds() + i64::from(i) * 100_000_000,
            x: self.ego.x + 0.5 * f64::from(i),
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
        };
        (0..30).map(point).collect()
    }
}

/// It confirms what it is asked for, and sends results until it is released.
#[derive(Default)]
struct Station {
    asked: Vec<(Group, i64)>,
    mot: Option<i64>,
    plan: Option<i64>,
    /// Whether the CAV's own planner is stopped.
    planner_stands: bool,
    ignored: u32,
}

impl Station {
    /// What the monitor says to a message. A station can make it an error: it names a station below 1, or one for which
    /// the table has no place. Nothing has changed then, and the loop goes on.
    fn hear(&mut self, said: Result<Actions, RequesterError>) {
        match said {
            Ok(actions) => self.take(&actions),
            Err(why) => {
                println!("ignored: {why}");
                self.ignored += 1;
            }
        }
    }

    /// The data that were accepted, if they were.
    fn accepted<L>(
        &mut self,
        said: Result<(Arrival<L>, Actions), RequesterError>,
    ) -> Option<Accepted<L>> {
        let (arrival, actions) = match said {
            Ok((arrival, actions)) => (Some(arrival), Ok(actions)),
            Err(why) => (None, Err(why)),
        };
        self.hear(actions);
        match arrival? {
            Arrival::Accepted(element) => Some(element),
            Arrival::Dropped { why } => {
                println!("dropped: {why}");
                None
            }
        }
    }

    /// Where the vehicle's actions go: to the network, and to its own services.
    fn take(&mut self, actions: &Actions) {
        for action in actions {
            match *action {
                Action::Request { group, session, .. } => {
                    self.asked.push((group, session));
                    *self.of(group) = Some(session);
                }
                Action::Release { group, .. } => *self.of(group) = None,
                Action::Activate(group) => {
                    println!("        local services of {group:?} start");
                    self.planner_stands &= group != Group::Plan;
                }
                Action::Deactivate(group) => {
                    println!("        local services of {group:?} stop");
                    self.planner_stands |= group == Group::Plan;
                }
                Action::Drop(_) => {}
            }
        }
    }

    fn of(&mut self, group: Group) -> &mut Option<i64> {
        match group {
            Group::Mot => &mut self.mot,
            Group::Plan => &mut self.plan,
        }
    }

    fn tracks(&self, now: Time, items: Vec<Track>) -> Option<Message<Vec<Track>>> {
        self.mot.map(|session| Message { station: 1, session, generated: now, stamp: now, items })
    }

    fn trajectory(
        &self,
        now: Time,
        items: Vec<TrajectoryPoint>,
    ) -> Option<Message<Vec<TrajectoryPoint>>> {
        self.plan.map(|session| Message { station: 1, session, generated: now, stamp: now, items })
    }
}
