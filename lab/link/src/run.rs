//! Vehicle and station in real time.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use mufasa::input::profile::Profile;
use mufasa::monitor::Settings;
use mufasa_model::offloading::requester::Parameters;
use mufasa_props::bridge;

use crate::clock::SharedClock;
use crate::message::EncodeError;
use crate::play::Played;
use crate::station::{Station, StationSummary};
use crate::transport::{Health, Transport};
use crate::vehicle::memory::lent;
use crate::vehicle::summary::Tally;
use crate::vehicle::{Vehicle, VehicleError};

/// The longest that is waited without a look at whether the program is to stop.
const LOOK: Duration = Duration::from_millis(20);

/// A vehicle to be run.
#[derive(Clone, Debug)]
pub struct VehicleRun {
    /// Its station id, 1 to 4294967295.
    pub id: i64,
    /// Those of its monitor.
    pub settings: Settings,
    /// How often it drives the drive; each time it is started anew.
    pub laps: u32,
}

impl VehicleRun {
    /// Drives until the drive has ended so often, or until `stop` is set.
    ///
    /// Errors: settings, or a route, that no monitor can keep.
    pub fn run(
        &self,
        played: &Played,
        clock: SharedClock,
        transport: &mut impl Transport,
        tally: &mut Tally,
        stop: &AtomicBool,
    ) -> Result<(), VehicleError> {
        let mut lent = lent(played);
        for _ in 0..self.laps {
            let (id, now_ns) = (self.id, clock.now_ns());
            let mut vehicle =
                Vehicle::new(id, now_ns, played, self.settings, &mut lent, transport, tally)?;
            while let Some(due_ns) = vehicle.step(clock.now_ns())? {
                if stop.load(Ordering::Relaxed) {
                    vehicle.leave(clock.now_ns());
                    tally.interrupt();
                    return Ok(());
                }
                vehicle.wait(until(due_ns, clock));
            }
        }
        Ok(())
    }
}

/// Runs a station until `stop` is set. `heard` is told how its transport does, after each step.
///
/// It replays the `offered` drive, which may be attacked; of what that and the clean one have in common it asks
/// the stages before, with the settings of the vehicle, if they are given.
///
/// Errors: a drive too far from the origin of its frame.
pub fn station(
    id: i64,
    [clean, offered]: [&Played; 2],
    asks: Option<&Settings>,
    clock: SharedClock,
    transport: &mut impl Transport,
    stop: &AtomicBool,
    heard: &mut dyn FnMut(Health),
) -> Result<StationSummary, EncodeError> {
    let mut station = Station::new(id, offered, transport)?;
    if let Some(settings) = asks {
        station = station.asking(clean, settings);
    }
    while !stop.load(Ordering::Relaxed) {
        let due_ns = station.step(clock.now_ns());
        heard(station.health());
        station.wait(until(due_ns, clock));
    }
    Ok(station.end(clock.now_ns()))
}

/// Vehicle and station in one process, each on its own thread and transport, until the drive has ended.
/// `offered`: the drive as the station, whose id is given, replays it; it may be attacked. `asks`: whether it
/// asks before it sends.
///
/// Errors: those of the vehicle and of the station.
pub fn both(
    run: &VehicleRun,
    (station_id, asks): (i64, bool),
    [driven, offered]: [&Played; 2],
    clock: SharedClock,
    (of_vehicle, of_station): (&mut impl Transport, &mut (impl Transport + Send)),
    tally: &mut Tally,
    stop: &AtomicBool,
) -> Result<StationSummary, VehicleError> {
    let has_ended = AtomicBool::new(false);
    thread::scope(|scope| {
        let serving = scope.spawn(|| {
            let asks = asks.then_some(&run.settings);
            station(station_id, [driven, offered], asks, clock, of_station, &has_ended, &mut |_| ())
        });
        let driven = run.run(driven, clock, of_vehicle, tally, stop);
        has_ended.store(true, Ordering::Relaxed);
        let served = serving.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        driven.and(served.map_err(VehicleError::Frame))
    })
}

fn until(due_ns: i64, clock: SharedClock) -> Duration {
    let ns = u64::try_from(due_ns.saturating_sub(clock.now_ns())).unwrap_or(0);
    Duration::from_nanos(ns).min(LOOK)
}

/// `tau` in periods (A-07 of `docs/assumptions.md`): one until the next cycle, 0.6 until it is decided, the rest until
/// the brakes act.
pub const TAU_PERIODS: f64 = 2.5;

/// The settings of a monitor for a drive: its profile, parameters and period, and the times of the
/// requester. `tau`, of the hardened profile alone, is at least [`TAU_PERIODS`] periods: what the CAV needs to brake is the vehicle's, not the
/// drive's. The sessions are numbered by the vehicle.
pub fn settings(played: &Played, requester: &Parameters) -> Settings {
    let period = Duration::from_nanos(played.period_ns().unsigned_abs());
    let mut stages = bridge::cycle_parameters(played.parameters());
    let profile = bridge::profile_to_impl(played.profile());
    if profile == Profile::HARDENED {
        stages.tau = stages.tau.max(TAU_PERIODS * period.as_secs_f64());
    }
    let settings = Settings {
        profile,
        stages,
        requester: bridge::parameters_to_impl(requester),
        period,
        ..Settings::new(period)
    };
    // Lent memory for all of the domain.
    settings.in_any_time().in_any_range()
}
