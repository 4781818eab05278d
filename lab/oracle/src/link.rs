//! The commands `vehicle` and `station`: the two programs of the link.

use std::fs::File;
use std::io::{LineWriter, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use comfy_table::{Table, presets};
use indicatif::ProgressBar;
use mufasa_drives::check;
use mufasa_drives::check::checked::IGNORED;
use mufasa_drives::{Drive, Injection, Options, Stream, demo, inject, progress, streams};
use mufasa_link::clock::SharedClock;
use mufasa_link::play::Played;
use mufasa_link::run::{self, TAU_PERIODS, VehicleRun};
use mufasa_link::station::StationSummary;
use mufasa_link::traffic::{Counts, Traffic};
use mufasa_link::transport::amqp::Amqp;
use mufasa_link::transport::channels::Hub;
use mufasa_link::transport::disturbed::Disturbed;
use mufasa_link::transport::{Address, Health, Transport};
use mufasa_link::vehicle::log::{Entry, What};
use mufasa_link::vehicle::summary::{Listener, Spread, Summary, Tally};
use mufasa_model::offloading::requester;
use mufasa_props::bridge;
use mufasa_records::files;
use serde::Serialize;

use crate::cli::link::{DriveArguments, StationArguments, VehicleArguments};
use crate::ended::{DISAGREES, Ended, INTERRUPTED, cannot, complain, said};
use crate::parameters_file;

/// What `dt_max` is above the period of the drive, unless a file of parameters says otherwise, ns.
const JITTER_NS: i64 = 50_000_000;

/// How long the first attempt to reach a broker is waited for: RabbitMQ refuses a password after 3 s.
const FIRST_ATTEMPT: Duration = Duration::from_secs(4);

/// The station in the process of the vehicle.
const STATION: i64 = 1;

/// Drives, and says how it went. The exit code.
pub fn vehicle(arguments: &VehicleArguments, stop: &AtomicBool, out: &mut impl Write) -> Ended {
    let (drive, parameters) = drive(&arguments.drive, arguments.parameters.as_deref())?;
    prepare(arguments.json.as_deref())?;
    let offered = attacked(drive.clone(), &arguments.inject)?;
    let driven = Played::new(drive).map_err(said)?;
    let offered = Played::new(offered).map_err(said)?;
    let jitter = || requester::Parameters {
        dt_max_ns: driven.period_ns().saturating_add(JITTER_NS),
        ..requester::Parameters::default()
    };
    let settings = run::settings(&driven, &parameters.unwrap_or_else(jitter));
    if let Some(raised) = raised_tau(&driven, settings.stages.tau) {
        writeln!(out, "{raised}")?;
    }
    let run = VehicleRun { id: arguments.id, settings, laps: arguments.laps };
    let laps = usize::try_from(run.laps).unwrap_or(usize::MAX);
    let bar = check::progress(driven.count().saturating_mul(laps));
    let mut tally = Tally::heard_by(listener(arguments.log.as_deref(), bar.clone())?);
    let clock = SharedClock::new().map_err(said)?;
    let me = Address::Vehicle(arguments.id);
    let disturb = arguments.disturb.clone();
    let station = if let Some(url) = &arguments.broker {
        let broker = Amqp::new(url, me).map_err(said)?;
        tell_unless_connected(url, &broker);
        let mut broker = Disturbed::new(broker, disturb);
        run.run(&driven, clock, &mut broker, &mut tally, stop).map_err(said)?;
        None
    } else {
        let hub = Hub::default();
        let mut of_vehicle = Disturbed::new(hub.join(me), disturb);
        let mut of_station = hub.join(Address::Station(STATION));
        let channels = (&mut of_vehicle, &mut of_station);
        let plays = [&driven, &offered];
        let station = (STATION, !arguments.without_precheck);
        let served = run::both(&run, station, plays, clock, channels, &mut tally, stop);
        Some(served.map_err(said)?)
    };
    bar.finish_and_clear();
    let summary = tally.summary();
    write_json(arguments.json.as_deref(), &summary)?;
    writeln!(out, "{}", of_vehicle(&summary).trim_fmt())?;
    if let Some(station) = &station {
        writeln!(out, "{}", of_station(station).trim_fmt())?;
    }
    Ok(code(&summary).max(never_connected(&summary.traffic)))
}

/// Serves until it is stopped, and says how it went. The exit code.
pub fn station(
    arguments: &StationArguments,
    stop: &Arc<AtomicBool>,
    out: &mut impl Write,
) -> Ended {
    let (drive, _) = drive(&arguments.drive, None)?;
    prepare(arguments.json.as_deref())?;
    let offered = attacked(drive.clone(), &arguments.inject)?;
    let clean = Played::new(drive).map_err(said)?;
    let played = Played::new(offered).map_err(said)?;
    let settings = run::settings(&clean, &requester::Parameters::default());
    let asks = Some(&settings).filter(|_| !arguments.without_precheck);
    let mut broker = Amqp::new(&arguments.broker, Address::Station(arguments.id)).map_err(said)?;
    tell_unless_connected(&arguments.broker, &broker);
    if let Some(seconds) = arguments.seconds {
        let stop = Arc::clone(stop);
        thread::spawn(move || {
            thread::sleep(Duration::from_secs(seconds));
            stop.store(true, Ordering::Relaxed);
        });
    }
    let clock = SharedClock::new().map_err(said)?;
    let (began, mut seen) = (Instant::now(), None);
    let mut heard = |health: Health| {
        let change = What::of_link(health, &mut seen).and_then(|it| it.change());
        if let Some(change) = change.filter(|_| !progress::is_quiet()) {
            complain(&format!("{:.1} s: {change}", began.elapsed().as_secs_f64()));
        }
    };
    let plays = [&clean, &played];
    let served = run::station(arguments.id, plays, asks, clock, &mut broker, stop, &mut heard);
    let summary = served.map_err(said)?;
    write_json(arguments.json.as_deref(), &summary)?;
    writeln!(out, "{}", of_station(&summary).trim_fmt())?;
    Ok(never_connected(&summary.traffic))
}

/// The one drive that is named, or that of the demo, and the parameters of the requester if a file names them.
fn drive(
    arguments: &DriveArguments,
    parameters: Option<&Path>,
) -> Result<(Drive, Option<requester::Parameters>), String> {
    let parameters = parameters.map(parameters_file::read).transpose().map_err(said)?;
    let stages = parameters.as_ref().map(|it| it.stages.clone()).unwrap_or_default();
    let options = Options { profile: arguments.profile, parameters: stages, ..Options::default() };
    if let Some(note) = parameters.as_ref().and_then(|it| it.note.as_ref()) {
        complain(note);
    }
    let requester = parameters.map(|it| it.requester);
    if arguments.files.is_empty() {
        return Ok((demo(&options).and_then(Stream::collect).map_err(said)?, requester));
    }
    let drives: Result<Vec<_>, _> = streams(&arguments.files, &options).into_iter().collect();
    let mut drives = drives.map_err(said)?.into_iter();
    match (drives.next(), drives.next()) {
        (Some(drive), None) => {
            if drive.ignores_options {
                complain(IGNORED);
            }
            Ok((drive.collect().map_err(said)?, requester))
        }
        _ => Err("the files are more than one drive, or none; give those of one".to_owned()),
    }
}

/// The drive as a station that attacks offers it: as long as the clean one. The vehicle drives on where an
/// attacked drive ends with its attack, and is answered with the clean cycles there.
fn attacked(drive: Drive, injections: &[Injection]) -> Result<Drive, String> {
    injections.iter().try_fold(drive, |drive, injection| {
        let clean = Stream::from(drive);
        let attacked = inject(&clean, injection).map_err(said)?;
        let mut attacked = attacked.collect().map_err(said)?;
        for index in attacked.cycles.len()..clean.count() {
            attacked.cycles.push(clean.cycle(index).map_err(said)?);
        }
        Ok(attacked)
    })
}

/// What is said where `tau` is not that of the drive, s, but the least that its period allows.
fn raised_tau(driven: &Played, tau_s: f64) -> Option<String> {
    let asked_s = bridge::cycle_parameters(driven.parameters()).tau;
    let period_ms = driven.period_ns() / 1_000_000;
    (tau_s > asked_s).then(|| {
        format!(
            "tau is {tau_s} s, not {asked_s} s: at least {TAU_PERIODS} periods, of {period_ms} ms here \
             (A-07 of docs/assumptions.md)"
        )
    })
}

/// Refuses a file that cannot be written before the drive, not after it.
fn prepare(file: Option<&Path>) -> Result<(), String> {
    file.map_or(Ok(()), |file| files::prepare_file(file).map_err(cannot(file, "written")))
}

/// Writes every entry into the log, says what changes on standard error, and moves the bar on by each cycle.
fn listener(log: Option<&Path>, bar: ProgressBar) -> Result<Listener, String> {
    let create = |file: &Path| File::create(file).map_err(cannot(file, "written"));
    let mut log = log.map(create).transpose()?.map(LineWriter::new);
    let mut began_ns = None;
    Ok(Box::new(move |entry: &Entry| {
        let began_ns = *began_ns.get_or_insert(entry.at_ns);
        if let Some(change) = entry.what.change().filter(|_| !progress::is_quiet()) {
            let ms = entry.at_ns.saturating_sub(began_ns) / 1_000_000;
            let line = format!("{}.{} s: {change}", ms / 1_000, ms % 1_000 / 100);
            bar.suspend(|| complain(&line));
        }
        if matches!(entry.what, What::Decided { .. }) {
            bar.inc(1);
        }
        // A disk that is full ends the log, and not the drive.
        let written = |log: &mut LineWriter<File>| -> std::io::Result<()> {
            serde_json::to_writer(&mut *log, entry)?;
            log.write_all(b"\n")
        };
        if log.as_mut().is_some_and(|log| written(log).is_err()) {
            log = None;
        }
    }))
}

/// Says when the first attempt to reach the broker fails, or takes long; it is tried again and again.
fn tell_unless_connected(url: &str, broker: &Amqp) {
    let host = url.rsplit('@').next().unwrap_or_default();
    let end = Instant::now() + FIRST_ATTEMPT;
    while Instant::now() < end {
        let health = broker.health();
        if health.connections > 0 {
            return;
        }
        if let Some(error) = health.last_error {
            let message =
                format!("the broker at {host} cannot be reached, and is tried again: {error}");
            return complain(&message);
        }
        thread::sleep(Duration::from_millis(10));
    }
    let message = format!("the broker at {host} does not answer, and is tried again");
    complain(&message);
}

/// Exit code 1 for who never had a connection.
fn never_connected(traffic: &Traffic) -> u8 {
    u8::from(traffic.connections == 0)
}

fn write_json(file: Option<&Path>, summary: &impl Serialize) -> Result<(), String> {
    let Some(file) = file else { return Ok(()) };
    let text = serde_json::to_string_pretty(summary).map_err(said)? + "\n";
    files::write(file, &text).map_err(cannot(file, "written"))
}

fn code(summary: &Summary) -> u8 {
    if summary.interrupted && summary.uncovered.is_empty() {
        return INTERRUPTED;
    }
    let lost = summary.left.keys().any(|why| why != "end");
    if summary.uncovered.is_empty() {
        u8::from(lost || !summary.unsafe_by_stage.is_empty())
    } else {
        DISAGREES
    }
}

fn of_vehicle(summary: &Summary) -> Table {
    let mut table = table("vehicle");
    let mut row = |name: &str, value: String| {
        table.add_row([name.to_owned(), value]);
    };
    let cycles = if summary.interrupted { "cycles until it was interrupted" } else { "cycles" };
    row(cycles, summary.cycles.to_string());
    row("  nothing remote, nothing checked", summary.local.to_string());
    row("  checked and safe", summary.safe.to_string());
    row("  unsafe, by what failed", counts(&summary.unsafe_by_stage));
    row("  before which the drive waited for this computer", summary.paused.to_string());
    let offloaded = format!("{}, {:.1} s", summary.offloaded, summary.offloaded_s);
    row("cycles with a remote result used", offloaded);
    row("remote results used", summary.used.to_string());
    row("  of them not covered by a safe decision", counts(&summary.uncovered));
    row("fallbacks", summary.fallbacks.to_string());
    row("sessions ended, by the reason", counts(&summary.left));
    row("local services", counts(&summary.local_services));
    row("latency of tracks", spread(summary.latency_tracks));
    row("latency of trajectories", spread(summary.latency_trajectories));
    row("Monitor::cycle", spread(summary.monitor));
    traffic(&mut table, &summary.traffic);
    table
}

fn of_station(summary: &StationSummary) -> Table {
    let mut table = table("station");
    table.add_row(["most sessions at a time", &summary.sessions.to_string()]);
    traffic(&mut table, &summary.traffic);
    table
}

/// What went to and fro.
fn traffic(table: &mut Table, traffic: &Traffic) {
    let Traffic { sent, unsent, received, dropped, malformed, .. } = traffic;
    let connections = connections(traffic.connections, traffic.last_error.as_deref());
    for (name, value) in [
        ("sent", counts(sent)),
        ("  could not be written", counts(unsent)),
        ("received", counts(received)),
        ("  dropped", counts(dropped)),
        ("  malformed", counts(malformed)),
        ("  shed by the transport", traffic.shed.to_string()),
        ("connections", connections),
    ] {
        table.add_row([name, &value]);
    }
}

fn table(who: &str) -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table.set_header([who, ""]);
    table
}

fn counts(counts: &Counts) -> String {
    if counts.is_empty() {
        return "0".to_owned();
    }
    let each: Vec<_> = counts.iter().map(|(name, count)| format!("{name} {count}")).collect();
    each.join(", ")
}

fn spread(Spread { count, p50_us, p99_us, max_us }: Spread) -> String {
    if count == 0 {
        return "-".to_owned();
    }
    format!("p50 {p50_us:.0} us, p99 {p99_us:.0} us, longest {max_us:.0} us, of {count}")
}

fn connections(count: u64, last_error: Option<&str>) -> String {
    match last_error {
        Some(error) => format!("{count}; the last error: {error}"),
        None => count.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use mufasa_drives::Attack;

    use super::*;

    /// In the demo nobody crosses.
    const WITHOUT_TARGET: [Attack; 1] = [Attack::CrossingStands];

    #[test]
    fn a_station_that_attacks_offers_the_whole_drive_and_the_clean_one_after_each_attack() {
        let drive = demo(&Options::default()).unwrap().collect().unwrap();
        let count = drive.cycles.len();
        for attack in Attack::ON_DRIVES {
            let injections =
                [[5.0, 6.0], [8.0, 9.0]].map(|[from_s, to_s]| Injection { attack, from_s, to_s });
            let offered = attacked(drive.clone(), &injections);
            assert_eq!(offered.is_err(), WITHOUT_TARGET.contains(&attack), "{attack:?}");
            let Ok(offered) = offered else { continue };
            assert_eq!(offered.cycles.len(), count, "{attack:?}");
            let differ = |index: usize| offered.cycles[index].cycle != drive.cycles[index].cycle;
            let differing: Vec<_> = (0..count).filter(|index| differ(*index)).collect();
            let in_spans = |index: &usize| (50..=60).contains(index) || (80..=90).contains(index);
            assert!(differing.iter().all(in_spans), "{attack:?} {differing:?}");
            assert!(differing.first() <= Some(&60) && differing.last() >= Some(&80), "{attack:?}");
            Played::new(offered).unwrap();
        }
    }
}
