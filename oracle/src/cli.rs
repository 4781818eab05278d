//! The command line: arguments, exit codes, and quiet ends when nobody reads on.

use std::ffi::OsString;
use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::str::FromStr;
use std::time::Duration;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use mufasa_model::configuration::Configuration;
use mufasa_model::cycle::Profile;
use mufasa_proofs::explore::bounds::Bounds;

use crate::check::{self, Format, Settings, complain, files};
use crate::compose;
use crate::conform::{self, Kind};
use crate::demo;
use crate::drive::{self, GridSize, Injection, Options, Sensor, Tail, inject};
use crate::explore;
use crate::json::names;
use crate::oracle;
use crate::parameters_file;
use crate::vectors;

/// Bad input or arguments.
const BAD_INPUT: u8 = 2;
/// Model and text, or model and implementation, disagree.
const DISAGREE: u8 = 3;
/// As a shell says that a program was ended by a closed pipe.
const CLOSED_PIPE: u8 = 141;

/// MUFASA's five validation stages, as an exact model and as an implementation, side by side.
///
/// Without a command: the demo.
#[derive(Parser)]
#[command(name = "mufasa", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Check drives: every cycle by the model and by the implementation.
    Check(CheckArguments),
    /// Check a drive that is built in, clean and attacked, in both profiles.
    Demo(DemoArguments),
    /// Answer the JSON Lines of standard input on standard output.
    Oracle(OracleArguments),
    /// Hold a program under test against the exact model.
    Conform(ConformArguments),
    /// Find all compositions of a service set.
    Compose(ComposeArguments),
    /// Write the vectors: lines with the answers that they must get, their schemas, a README.
    Vectors(VectorsArguments),
    /// Explore the offloading protocol state by state.
    Explore(ExploreArguments),
}

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 all cycles safe, 1 some unsafe, 2 bad input (the other files are still checked),
3 model and implementation disagree; the highest that applies.")]
struct CheckArguments {
    /// CommonRoad scenarios (each followed by its solutions, if any), JSON Lines of cycles, maps
    /// as .npy; recognised by their content.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Profile of recorded drives; records name their own.
    #[arg(long, default_value = "hardened", value_parser = profile(), ignore_case = true)]
    profile: Profile,
    /// Parameters as lines `name = value` (TOML); records name their own of the stages.
    #[arg(long, value_name = "FILE")]
    parameters: Option<PathBuf>,
    /// Which groups of a recorded drive are remote.
    #[arg(long, default_value = "AllRemote", value_parser = configuration(), ignore_case = true)]
    configuration: Configuration,
    /// Attack the remote data: NAME@FROM..TO, such as wrong-map@2..3.5 (s); may be given again.
    /// It must change some cycle of every drive.
    /// Names: wrong-map, empty-tracks, ghost-tracks, false-velocities, false-sizes, backwards,
    /// frozen, late, too-fast.
    #[arg(long, value_name = "ATTACK")]
    inject: Vec<Injection>,
    /// Write JSON Lines: the answer to every cycle, a record per drive, a last one.
    #[arg(long, conflicts_with = "summary")]
    json: bool,
    /// Write the table over all drives only.
    #[arg(long)]
    summary: bool,
    /// Draw every unsafe cycle into this folder.
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    recording: RecordingArguments,
}

/// What a recording does not say.
#[derive(Args)]
#[command(next_help_heading = "Recorded drives")]
struct RecordingArguments {
    /// Recorded vehicle that is the CAV; by default one is picked.
    #[arg(long, value_name = "ID")]
    ego: Option<i64>,
    /// Length of the planned trajectories, s.
    #[arg(long, value_name = "S", default_value = "5", value_parser = number(0.1, 60.0))]
    horizon: f64,
    /// Keep the last cycles, whose trajectories end before the CAV could stand (H-12 rejects them).
    #[arg(long)]
    keep_tail: bool,
    /// Range of the local detectors, m.
    #[arg(long, value_name = "M", default_value = "80", value_parser = number(0.0, 1e4))]
    sensor_range: f64,
    /// Standard deviation of detected positions per axis, m.
    #[arg(long, value_name = "M", default_value = "0.05", value_parser = number(0.0, 100.0))]
    sensor_sigma: f64,
    /// Probability that an object in range is detected.
    #[arg(long, value_name = "P", default_value = "1", value_parser = number(0.0, 1.0))]
    sensor_probability: f64,
    /// Mean number of clutter detections in a scan.
    #[arg(long, value_name = "N", default_value = "0.5", value_parser = number(0.0, 100.0))]
    sensor_clutter: f64,
    /// Seed of noise and clutter.
    #[arg(long, value_name = "N", default_value = "1")]
    seed: u64,
    /// Side of a cell of the grid map, m.
    #[arg(long, value_name = "M", default_value = "0.2", value_parser = number(0.01, 10.0))]
    grid_resolution: f64,
    /// Cells of the grid map along the CAV.
    #[arg(long, value_name = "N", default_value = "500", value_parser = clap::value_parser!(u32).range(1..=4096))]
    grid_width: u32,
    /// Cells of the grid map across.
    #[arg(long, value_name = "N", default_value = "300", value_parser = clap::value_parser!(u32).range(1..=4096))]
    grid_height: u32,
}

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 the clean drive is safe and the attacks are caught, 1 not so, 2 the folder cannot
be written, 3 model and implementation disagree.")]
struct DemoArguments {
    /// Folder of the drive's files and the pictures.
    #[arg(long, value_name = "DIR", default_value = demo::FOLDER)]
    out: PathBuf,
}

#[derive(Args)]
struct OracleArguments {
    /// Answer with the implementation in place of the exact model: fast and cautious, without the
    /// strict and the lax verdict, and without compositions.
    #[arg(long)]
    implementation: bool,
}

#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "\
Exit codes: 0 the program conforms in every case, 1 it disagrees in some, 2 bad input, nothing was
compared, or (merge) a shard is missing."
)]
struct ConformArguments {
    #[command(subcommand)]
    merge: Option<MergeCommand>,
    /// Profile of generated cases and of recorded drives.
    #[arg(long, default_value = "hardened", value_parser = profile(), ignore_case = true)]
    profile: Profile,
    /// Number of cases, all shards together; by default 10000, or all that the drives give.
    #[arg(long, value_name = "N")]
    cases: Option<u64>,
    /// Seed of the cases.
    #[arg(long, value_name = "S", default_value = "0")]
    seed: u64,
    /// Longest time that an answer may take, ms.
    #[arg(long, value_name = "MS", default_value = "1000", value_parser = clap::value_parser!(u64).range(1..=3_600_000))]
    time_limit: u64,
    /// Kinds of generated records.
    #[arg(
        long,
        value_name = "KINDS",
        value_delimiter = ',',
        default_value = "cycle,offloading,composition"
    )]
    kinds: Vec<Kind>,
    /// Ask only the cases whose number leaves I when divided by N, such as 0/8.
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<(u64, u64)>,
    /// Take the cycles of drives, clean and attacked, in place of generated ones.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "kinds")]
    drives: Vec<PathBuf>,
    /// Let a disagreement pass that a margin of so many metres explains (rounding), 1e-8 to 1e-2.
    #[arg(long, value_name = "M", value_parser = number(1e-8, 1e-2))]
    tolerance: Option<f64>,
    /// Folder for the summary (JSON), the report (JUnit XML) and the shrunk records.
    #[arg(long, value_name = "DIR", default_value = "mufasa-conform")]
    out: PathBuf,
    /// The program under test and its arguments.
    #[arg(last = true, required = true)]
    command: Vec<OsString>,
}

#[derive(Subcommand)]
enum MergeCommand {
    /// Join the summaries of shards.
    Merge {
        /// Summaries of all shards of one campaign.
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// Folder for the joined files.
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
}

#[derive(Args)]
#[command(after_help = "\
Exit codes: 0 there is a composition, 1 there is none, 2 bad input.")]
struct ComposeArguments {
    /// A composition record (JSON).
    file: PathBuf,
    /// Write the graph in the language of Graphviz.
    #[arg(long, conflicts_with = "svg")]
    dot: bool,
    /// Draw the graph into this file.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Exit codes: 0 all properties that the profile claims hold, 1 one fails, 2 bad input, 3 model
/// and implementation disagree, or the two engines do.
#[derive(Args)]
struct ExploreArguments {
    /// Profile; by default both.
    #[arg(long, value_parser = profile(), ignore_case = true)]
    profile: Option<Profile>,
    /// How much: small takes minutes, large hours.
    #[arg(long, default_value = "small", value_parser = bounds(), ignore_case = true)]
    bounds: Bounds,
    /// Only this world.
    #[arg(long, value_name = "NAME")]
    world: Option<String>,
    /// Threads of the second engine, stateright; 0 leaves it out. By default all.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Folder for the tables as JSON and Markdown, and the vectors and charts of what fails.
    #[arg(long, value_name = "DIR", default_value = "exploration")]
    out: PathBuf,
    /// Serve stateright's explorer page for a world at this address instead.
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, default_missing_value = "127.0.0.1:3000")]
    serve: Option<String>,
}

/// Exit codes: 0 written, 2 the folder cannot be written, 3 the vectors contradict the model.
#[derive(Args)]
struct VectorsArguments {
    /// Folder; files of other names there stay.
    #[arg(long, value_name = "DIR", default_value = "vectors")]
    out: PathBuf,
}

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help asked for is no error; whether anybody reads it is not our business.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { BAD_INPUT } else { 0 });
        }
    };
    let mut out = BufWriter::new(io::stdout().lock());
    let demo = || Command::Demo(DemoArguments { out: demo::FOLDER.into() });
    let result = match cli.command.unwrap_or_else(demo) {
        Command::Check(arguments) => check(&arguments, &mut out),
        Command::Demo(arguments) => demo::run(&arguments.out, &mut out, &mut io::stderr()),
        Command::Oracle(OracleArguments { implementation }) => {
            let answer = if implementation { oracle::by_implementation } else { oracle::by_model };
            oracle::run(io::stdin().lock(), &mut out, answer).map(|()| 0)
        }
        Command::Conform(arguments) => conform(arguments, &mut out),
        Command::Compose(arguments) => compose(&arguments, &mut out),
        Command::Vectors(arguments) => vectors(&arguments.out, &mut out),
        Command::Explore(arguments) => explore(arguments, &mut out),
    };
    let code = match result.and_then(|code| out.flush().map(|()| code)) {
        Ok(code) => code,
        Err(error) if error.kind() == ErrorKind::BrokenPipe => CLOSED_PIPE,
        Err(error) => refused(&format!("standard input or output: {error}")),
    };
    // What could not be written is not tried again when the buffer is dropped.
    let _ = out.into_parts();
    ExitCode::from(code)
}

fn check(arguments: &CheckArguments, out: &mut impl Write) -> io::Result<u8> {
    let parameters = match arguments.parameters.as_deref().map(parameters_file::read).transpose() {
        Ok(parameters) => parameters.unwrap_or_default(),
        Err(error) => return Ok(refused(&error.to_string())),
    };
    if let Some(folder) = &arguments.svg
        && let Err(error) = files::prepare(folder)
    {
        return Ok(refused(&format!("{}: cannot be written to: {error}", folder.display())));
    }
    let mut options = options(arguments);
    options.parameters = parameters.stages;
    let settings = Settings {
        requester: parameters.requester,
        format: match (arguments.json, arguments.summary) {
            (true, _) => Format::Json,
            (false, true) => Format::Summary,
            (false, false) => Format::Text,
        },
        pictures: arguments.svg.clone(),
    };
    let attacked = |drive: drive::Drive| {
        let injections = &mut arguments.inject.iter();
        injections.try_fold(drive, |drive, it| inject(&drive, it).map_err(|error| error.of(&drive)))
    };
    let drives = drive::read(&arguments.files, &options);
    let drives: Vec<_> = drives.into_iter().map(|drive| drive.and_then(attacked)).collect();
    let findings = check::run(&drives, &settings, out, &mut io::stderr())?;
    Ok(findings.exit_code())
}

fn options(arguments: &CheckArguments) -> Options {
    let recording = &arguments.recording;
    Options {
        profile: arguments.profile,
        configuration: arguments.configuration,
        ego: recording.ego,
        horizon_s: recording.horizon,
        tail: if recording.keep_tail { Tail::Keep } else { Tail::Stop },
        sensor: Sensor {
            range_m: recording.sensor_range,
            sigma_m: recording.sensor_sigma,
            probability: recording.sensor_probability,
            clutter: recording.sensor_clutter,
            seed: recording.seed,
        },
        grid: GridSize {
            resolution_m: recording.grid_resolution,
            width: recording.grid_width,
            height: recording.grid_height,
        },
        ..Options::default()
    }
}

/// Exit code 0 with a composition, 1 without, 2 for bad input.
fn compose(arguments: &ComposeArguments, out: &mut impl Write) -> io::Result<u8> {
    let file = arguments.file.display();
    let text = match fs::read_to_string(&arguments.file) {
        Ok(text) => text,
        Err(error) => return Ok(refused(&format!("{file}: cannot be read: {error}"))),
    };
    let composed = match compose::compose(&text) {
        Ok(composed) => composed,
        Err(error) => return Ok(refused(&format!("{file}: {error}"))),
    };
    if arguments.dot {
        write!(out, "{}", composed.dot())?;
    } else {
        write!(out, "{}", composed.table())?;
    }
    if let Some(picture) = &arguments.svg
        && let Err(error) = files::write(picture, &composed.svg())
    {
        return Ok(refused(&format!("{}: cannot be written: {error}", picture.display())));
    }
    Ok(u8::from(composed.answer().compositions.is_empty()))
}

fn explore(arguments: ExploreArguments, out: &mut impl Write) -> io::Result<u8> {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let settings = explore::Settings {
        profiles: arguments
            .profile
            .map_or(vec![Profile::Paper, Profile::Hardened], |profile| vec![profile]),
        bounds: arguments.bounds,
        world: arguments.world,
        threads: arguments.threads.unwrap_or(all),
        folder: arguments.out,
    };
    let end = match &arguments.serve {
        Some(address) => explore::serve(&settings, address, out, &mut io::stderr())?,
        None => explore::run(&settings, out, &mut io::stderr())?,
    };
    Ok(end.code())
}

fn conform(arguments: ConformArguments, out: &mut impl Write) -> io::Result<u8> {
    let result = match arguments.merge {
        Some(MergeCommand::Merge { files, out: folder }) => {
            conform::merge(&files, folder.as_ref(), out)
        }
        None => {
            let settings = conform::Settings {
                command: arguments.command,
                profile: arguments.profile,
                cases: arguments.cases,
                seed: arguments.seed,
                time_limit: Duration::from_millis(arguments.time_limit),
                kinds: arguments.kinds,
                shard: arguments.shard,
                drives: arguments.drives,
                tolerance: arguments.tolerance,
                out: arguments.out,
            };
            conform::run(&settings, out, &mut io::stderr())
        }
    };
    match result {
        Ok(code) => Ok(code),
        Err(conform::ConformError::Output(error)) => Err(error),
        Err(error) => {
            out.flush()?;
            Ok(refused(&error.to_string()))
        }
    }
}

fn vectors(folder: &Path, out: &mut impl Write) -> io::Result<u8> {
    let contents = match vectors::contents() {
        Ok(contents) => contents,
        Err(refused) => {
            for vector in refused {
                complain(&mut io::stderr(), &vector.to_string());
            }
            return Ok(DISAGREE);
        }
    };
    if let Err(error) = vectors::write(folder, &contents) {
        return Ok(refused(&format!("{}: cannot be written: {error}", folder.display())));
    }
    let lines = |(name, text): (&String, &String)| {
        if Path::new(name).extension().is_some_and(|kind| kind == "jsonl") {
            text.lines().count()
        } else {
            0
        }
    };
    let count: usize = contents.iter().map(lines).sum();
    writeln!(out, "{}: {} files, {count} vectors", folder.display(), contents.len())?;
    Ok(0)
}

fn refused(message: &str) -> u8 {
    complain(&mut io::stderr(), message);
    BAD_INPUT
}

fn profile() -> impl TypedValueParser<Value = Profile> {
    one_of([Profile::Paper, Profile::Hardened], names::profile)
}

fn configuration() -> impl TypedValueParser<Value = Configuration> {
    use Configuration::{AllRemote, Local, MotRemote, PlanRemote};
    one_of([Local, MotRemote, AllRemote, PlanRemote], names::configuration)
}

fn bounds() -> impl TypedValueParser<Value = Bounds> {
    one_of([Bounds::Small, Bounds::Large], Bounds::name)
}

/// One of these values by its name in the records.
fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    values: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(values.map(name)).try_map(move |given| {
        let same = |value: &T| name(*value).eq_ignore_ascii_case(&given);
        values.into_iter().find(same).ok_or("unknown name")
    })
}

/// `I/N` with I below N.
fn shard(text: &str) -> Result<(u64, u64), String> {
    let (at, of) = text.split_once('/').ok_or("must be I/N, such as 0/8")?;
    match (at.parse(), of.parse()) {
        (Ok(at), Ok(of)) if at < of => Ok((at, of)),
        (Ok(_), Ok(_)) => Err(String::from("I must be below N; shards are counted from 0")),
        (_, _) => Err(String::from("must be two whole numbers I/N, such as 0/8")),
    }
}

/// A number within limits; NaN is in none.
fn number(low: f64, high: f64) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync {
    move |text| match f64::from_str(text) {
        Ok(number) if (low..=high).contains(&number) => Ok(number),
        Ok(_) | Err(_) => Err(format!("must be a number from {low} to {high}")),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn defaults_of_the_command_line_are_those_of_the_readers() {
        let cli = Cli::try_parse_from(["mufasa", "check", "x"]).unwrap();
        let Some(Command::Check(arguments)) = cli.command else { panic!("not check") };
        assert_eq!(options(&arguments), Options::default());
    }

    #[test]
    fn numbers_outside_their_limits_are_refused() {
        for text in ["nan", "inf", "-1", "2", "", "x", "1e999"] {
            assert!(number(0.0, 1.0)(text).is_err(), "{text}");
        }
        assert_eq!(number(0.0, 1.0)("0.5"), Ok(0.5));
    }
}
