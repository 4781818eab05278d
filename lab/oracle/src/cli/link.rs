//! The arguments of the two programs of the link.

use std::path::PathBuf;

use clap::Args;
use mufasa_drives::Injection;
use mufasa_link::transport::disturbed::Disturbance;
use mufasa_model::input::cycle::Profile;

use crate::limits::{profile, whole};

/// Drives a drive with requester and monitor, beside a station that computes for it: in the same process,
/// or over a broker.
#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 every cycle safe and offloading never lost, 1 not so, or the broker never reached, 2 bad
input, 3 a remote result was used that no safe decision covers, 130 interrupted.")]
pub(crate) struct VehicleArguments {
    #[command(flatten)]
    pub(crate) drive: DriveArguments,
    /// Talk over this broker to `mufasa station` there.
    #[arg(long, value_name = "URL")]
    pub(crate) broker: Option<String>,
    /// Id of the vehicle.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole(1_i64, 4_294_967_295))]
    pub(crate) id: i64,
    /// Parameters as lines `name = value` (TOML), of the stages (records name their own) and of the requester. Without it
    /// dt_max_ns is 50 ms above the period of the drive, with it what it says [default there: 100 ms].
    /// `tau` is raised to 2.5 periods of the drive where it is less, and the output says so.
    #[arg(long, value_name = "FILE")]
    pub(crate) parameters: Option<PathBuf>,
    /// How often the drive is driven; each time the vehicle is started anew.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole(1_u32, 1_000_000))]
    pub(crate) laps: u32,
    /// Disturb what arrives: delay=60@4..6 (ms, s), duplicate@.., reorder@.. or cut@..; may be given again.
    #[arg(long, value_name = "FAULT")]
    pub(crate) disturb: Vec<Disturbance>,
    /// Let the station in this process attack its results, as `check` does: NAME@FROM..TO (s).
    #[arg(long, value_name = "ATTACK", conflicts_with = "broker")]
    pub(crate) inject: Vec<Injection>,
    /// The station in this process sends what it has, and does not ask the stages before.
    #[arg(long, conflicts_with = "broker")]
    pub(crate) without_precheck: bool,
    /// Write the summary as JSON.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Write what happens as JSON Lines.
    #[arg(long, value_name = "FILE")]
    pub(crate) log: Option<PathBuf>,
}

/// Serves vehicles over a broker, with stand-in services that replay the drive, until it is interrupted.
#[derive(Args)]
#[command(after_help = "Exit codes: 0 it has served, 1 it never reached the broker, 2 bad input.")]
pub(crate) struct StationArguments {
    #[command(flatten)]
    pub(crate) drive: DriveArguments,
    /// The broker.
    #[arg(long, value_name = "URL")]
    pub(crate) broker: String,
    /// Id of the station.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole(1_i64, 4_294_967_295))]
    pub(crate) id: i64,
    /// Attack the results, as `check` does: NAME@FROM..TO (s of the drive); may be given again.
    #[arg(long, value_name = "ATTACK")]
    pub(crate) inject: Vec<Injection>,
    /// End after so many seconds.
    #[arg(long, value_name = "S", value_parser = whole(1_u64, 1_000_000_000))]
    pub(crate) seconds: Option<u64>,
    /// The station sends what it has, and does not ask the stages before.
    #[arg(long)]
    pub(crate) without_precheck: bool,
    /// Write the summary as JSON.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
}

/// The drive that both programs have.
#[derive(Args)]
pub(crate) struct DriveArguments {
    /// Files of one drive, as of `check`: a CommonRoad scenario with its solution, or JSON Lines of cycles;
    /// without any the drive of the demo, which is built in.
    pub(crate) files: Vec<PathBuf>,
    /// Profile of a recorded drive; records name their own.
    #[arg(long, default_value = "hardened", value_parser = profile(), ignore_case = true)]
    pub(crate) profile: Profile,
}
