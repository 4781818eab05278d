//! The arguments of every command, and how their values are read.

use std::path::PathBuf;

use clap::Args;
use mufasa_model::input::cycle::Profile;
use mufasa_model::services::configuration::Configuration;

use mufasa_drives::{Attack, GridSize, Injection, Options, Sensor, Tail};

use crate::ended::complain;
use crate::limits::{configuration, number, profile, whole};

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 all cycles safe, 1 some unsafe or offloading lost (data too late, silence), 2 bad
input (the other files are still checked), 3 model and implementation disagree; the highest that applies.")]
pub(super) struct CheckArguments {
    /// CommonRoad scenarios (each followed by its solutions, if any), cycles as JSON Lines, maps
    /// as .npy; recognised by their content, each also as .gz or from a pipe; - is standard input.
    #[arg(required = true)]
    pub(super) files: Vec<PathBuf>,
    /// Profile of recorded drives; records name their own.
    #[arg(long, default_value = "hardened", value_parser = profile(), ignore_case = true)]
    pub(super) profile: Profile,
    /// Parameters as lines `name = value` (TOML); records name their own of the stages; - is standard input.
    #[arg(long, value_name = "FILE")]
    pub(super) parameters: Option<PathBuf>,
    /// Which groups of a recorded drive are remote.
    #[arg(long, default_value = "AllRemote", value_parser = configuration(), ignore_case = true)]
    pub(super) configuration: Configuration,
    #[arg(long, value_name = "ATTACK", help = inject_help())]
    pub(super) inject: Vec<Injection>,
    /// Write JSON Lines: the answer to every cycle, a record per drive, a last one.
    #[arg(long, conflicts_with = "summary")]
    pub(super) json: bool,
    /// Write the table over all drives only.
    #[arg(long)]
    pub(super) summary: bool,
    /// Draw every unsafe cycle into this folder.
    #[arg(long, value_name = "DIR")]
    pub(super) svg: Option<PathBuf>,
    #[command(flatten)]
    pub(super) recording: RecordingArguments,
}

fn inject_help() -> String {
    format!(
        "Attack the remote data: NAME@FROM..TO, such as wrong-map@2..3.5 (s); may be given again. It must change some \
         cycle of every drive. Names: {}",
        Attack::ON_DRIVES.map(Attack::name).join(", ")
    )
}

/// What a recording does not say.
#[derive(Args)]
#[command(next_help_heading = "Recorded drives")]
pub(super) struct RecordingArguments {
    /// Recorded vehicle that is the CAV; by default the car that goes farthest on the lanelets.
    #[arg(long, value_name = "ID", value_parser = whole(i64::MIN, i64::MAX))]
    pub(super) ego: Option<i64>,
    /// Length of the planned trajectories, s.
    #[arg(long, value_name = "S", default_value = "5", value_parser = number(0.1, 60.0))]
    pub(super) horizon: f64,
    /// Keep the last cycles, whose trajectories end before the CAV could stand; beyond their ends the way is taken as straight on.
    #[arg(long)]
    pub(super) keep_tail: bool,
    /// Range of the local detectors, m.
    #[arg(long, value_name = "M", default_value = "80", value_parser = number(0.0, 1e4))]
    pub(super) sensor_range: f64,
    /// Range of the sensor of the leading vehicle, m; 0 for none [default: that of the detectors].
    #[arg(long, value_name = "M", value_parser = number(0.0, 1e4))]
    pub(super) lead_range: Option<f64>,
    /// Standard deviation of detected positions per axis, m.
    #[arg(long, value_name = "M", default_value = "0.05", value_parser = number(0.0, 100.0))]
    pub(super) sensor_sigma: f64,
    /// Probability that an object in range is detected.
    #[arg(long, value_name = "P", default_value = "1", value_parser = number(0.0, 1.0))]
    pub(super) sensor_probability: f64,
    /// Mean number of clutter detections in a scan.
    #[arg(long, value_name = "N", default_value = "0.5", value_parser = number(0.0, 100.0))]
    pub(super) sensor_clutter: f64,
    /// Age of the track lists, ms; they are exact, and that old. The detections are 30 ms old.
    #[arg(long, value_name = "MS", default_value = "30", value_parser = whole(0_u16, 1000))]
    pub(super) track_age: u16,
    /// Seed of misses, noise and clutter, now and in the history.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole(0, u64::MAX))]
    pub(super) seed: u64,
    /// Side of a cell of the grid map, m.
    #[arg(long, value_name = "M", default_value = "0.2", value_parser = number(0.01, 10.0))]
    pub(super) grid_resolution: f64,
    /// Cells of the grid map along the CAV.
    #[arg(long, value_name = "N", default_value = "500", value_parser = whole(1_u32, 4096))]
    pub(super) grid_width: u32,
    /// Cells of the grid map across.
    #[arg(long, value_name = "N", default_value = "300", value_parser = whole(1_u32, 4096))]
    pub(super) grid_height: u32,
}

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 the clean drive is safe and the attacks are caught, 1 not so, 2 the folder cannot
be written, 3 model and implementation disagree.")]
pub(super) struct DemoArguments {
    /// Folder of the drive's files and the pictures [default: mufasa-demo].
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
}

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 every line was answered, a bad one with an error, 2 standard input or output fails.")]
pub(super) struct OracleArguments {
    /// Answer with the implementation in place of the exact model: fast and cautious, without the
    /// strict and the lax verdict, and without compositions.
    #[arg(long)]
    pub(super) implementation: bool,
}

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 there is a composition, 1 there is none, 2 bad input.")]
pub(super) struct ComposeArguments {
    /// A composition record (JSON).
    #[arg(required_unless_present = "example")]
    pub(super) file: Option<PathBuf>,
    /// Print a record to begin with, that of the paper's Fig. 2, and end.
    #[arg(long, conflicts_with_all = ["file", "dot"])]
    pub(super) example: bool,
    /// Write the graph in the language of Graphviz.
    #[arg(long)]
    pub(super) dot: bool,
}

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 written, 2 the folder cannot be written, 3 the vectors contradict the model.")]
pub(super) struct VectorsArguments {
    /// Folder; files of other names there stay [default: vectors].
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
}

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 the log breaks no duty, 1 it breaks some, 2 it cannot be read.

Each line of the log is {\"made\": ...}, {\"call\": ...} or {\"control\": ...}; `mufasa schemas` writes their schema
(loop-log), `mufasa evaluate replay --calls FILE` a log of the simulator's loop.")]
pub(super) struct IntegrateArguments {
    /// The log (JSON Lines).
    pub(super) log: PathBuf,
}

#[derive(Args)]
pub(super) struct CompletionsArguments {
    /// The shell that completes what is typed.
    pub(super) shell: clap_complete::Shell,
}

#[derive(Args)]
#[command(after_help = "Exit codes: 0 written, 2 the folder cannot be written.")]
pub(super) struct ManArguments {
    /// Folder of the pages, one for each command [default: man].
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
}

#[derive(Args)]
#[command(after_help = "Exit codes: 0 written, 2 the folder cannot be written.")]
pub(super) struct SchemasArguments {
    /// Folder of the schemas [default: schemas].
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
}

impl CheckArguments {
    /// How recordings become drives, with the parameters of the stages at their defaults.
    pub(super) fn options(&self) -> Options {
        let recording = &self.recording;
        Options {
            profile: self.profile,
            configuration: self.configuration,
            ego: recording.ego,
            horizon_s: recording.horizon,
            tail: if recording.keep_tail { Tail::Keep } else { Tail::Stop },
            sensor: Sensor {
                range_m: recording.sensor_range,
                lead_range_m: recording.lead_range.unwrap_or(recording.sensor_range),
                sigma_m: recording.sensor_sigma,
                probability: recording.sensor_probability,
                clutter: recording.sensor_clutter,
                seed: recording.seed,
            },
            track_age_ns: i64::from(recording.track_age) * 1_000_000,
            grid: GridSize {
                resolution_m: recording.grid_resolution,
                width: recording.grid_width,
                height: recording.grid_height,
            },
            ..Options::default()
        }
    }
}

/// The folder that is to be written, which is said first where nobody named it.
pub(super) fn folder_or(named: Option<PathBuf>, usual: &str) -> PathBuf {
    named.unwrap_or_else(|| unnamed(usual, "/", "folder"))
}

/// The same of a file.
pub(super) fn file_or(named: Option<PathBuf>, usual: &str) -> PathBuf {
    named.unwrap_or_else(|| unnamed(usual, "", "file"))
}

fn unnamed(usual: &str, end: &str, kind: &str) -> PathBuf {
    let note = format!("writes into {usual}{end}; --out names another {kind}");
    complain(&note);
    PathBuf::from(usual)
}
