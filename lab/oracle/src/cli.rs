//! The command line: commands, exit codes, and quiet ends when nobody reads on.

mod arguments;
mod conform;
#[cfg(feature = "link")]
pub(crate) mod link;
#[cfg(test)]
mod tests;
mod written;

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::process::{self, ExitCode};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use clap::error::ErrorKind;
use clap::{Arg, CommandFactory, FromArgMatches, Parser, Subcommand};

use self::arguments::{
    CheckArguments, CompletionsArguments, ComposeArguments, DemoArguments, IntegrateArguments,
    ManArguments, OracleArguments, SchemasArguments, VectorsArguments, file_or, folder_or,
};
use self::conform::{ConformArguments, MergeCommand};
#[cfg(feature = "link")]
use self::link::{StationArguments, VehicleArguments};
use crate::compose;
use crate::demo;
use crate::ended::{BAD_INPUT, Ended, Stopped, cannot, complain, said};
#[cfg(feature = "link")]
use crate::evaluate;
#[cfg(feature = "link")]
use crate::evaluate::arguments::EvaluateArguments;
#[cfg(feature = "link")]
use crate::evaluate::merge::MergeArguments;
use crate::explore;
use crate::integrate;
use crate::parameters_file;
use crate::prove;
use crate::verify;
use mufasa_conform as kit;
use mufasa_conform::reference as oracle;
use mufasa_drives::check::{self, Format, Settings};
use mufasa_drives::{self as drive, inject, progress};
use mufasa_records::files;

/// As a shell says that a program was ended by a closed pipe.
const CLOSED_PIPE: u8 = 141;

/// MUFASA's five validation stages, as an exact model and as an implementation, side by side.
///
/// Without a command: the demo.
#[derive(Parser)]
#[command(name = "mufasa", version = env!("MUFASA_VERSION"), max_term_width = 100)]
struct Cli {
    /// Show no progress.
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Show progress as lines, also where standard error is no terminal.
    #[arg(short, long, global = true)]
    verbose: bool,
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
    /// Replay the log of a vehicle's loop around the monitor: which duties of the safety manual it breaks.
    Integrate(IntegrateArguments),
    /// Find all compositions of a service set.
    Compose(ComposeArguments),
    /// Write the vectors: lines with the answers that they must get, their schemas, a README.
    Vectors(VectorsArguments),
    /// Explore the offloading protocol state by state.
    Explore(explore::Settings),
    /// Prove what is claimed with every engine that is here, and list what is proved.
    Prove(prove::Settings),
    /// Run what shows that this checkout is right, as far as its tools are here, and leave the evidence.
    Verify(verify::Settings),
    /// Experiments in a closed loop: a CAV drives through a town, offloads to a station, and is attacked.
    #[cfg(feature = "link")]
    Evaluate(EvaluateArguments),
    /// Put the parts of an experiment together that were made by `evaluate --shard`.
    #[cfg(feature = "link")]
    Merge(MergeArguments),
    /// Drive a drive with requester and monitor, beside a station or over a broker.
    #[cfg(feature = "link")]
    Vehicle(VehicleArguments),
    /// Serve vehicles over a broker, with stand-in services.
    #[cfg(feature = "link")]
    Station(StationArguments),
    /// Write what a shell needs to complete what is typed on standard output.
    Completions(CompletionsArguments),
    /// Write the manual pages.
    Man(ManArguments),
    /// Write the JSON Schemas of all that is read and written as JSON.
    Schemas(SchemasArguments),
}

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    files_may_be_limited();
    let cli = command().try_get_matches();
    let cli = match cli.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => {
            // Help asked for is no error; whether anybody reads it is not our business.
            let _ = error.print();
            if let Some(tip) = tip(&error, env::args_os().skip(1)) {
                complain(tip);
            }
            return ExitCode::from(if error.use_stderr() { BAD_INPUT } else { 0 });
        }
    };
    progress::set(match (cli.quiet, cli.verbose) {
        (true, _) => progress::Mode::Quiet,
        (false, true) => progress::Mode::Lines,
        (false, false) => progress::Mode::Bar,
    });
    let mut out = BufWriter::new(io::stdout().lock());
    let demo = || {
        let writes = format!("no command, so the demo, which writes into {}/", demo::FOLDER);
        complain(&writes);
        Command::Demo(DemoArguments { out: Some(demo::FOLDER.into()) })
    };
    let result = match cli.command.unwrap_or_else(demo) {
        Command::Check(arguments) => check(&arguments, &mut out),
        Command::Demo(it) => demo::run(&folder_or(it.out, demo::FOLDER), &mut out),
        Command::Oracle(OracleArguments { implementation }) => {
            let answer = if implementation { oracle::by_implementation } else { oracle::by_model };
            if output_is_closed() {
                Err("standard output is closed, so that nobody would get an answer"
                    .to_owned()
                    .into())
            } else {
                let answered = oracle::run(io::stdin().lock(), &mut out, answer);
                answered.map(|()| 0).map_err(Stopped::Stream)
            }
        }
        Command::Conform(arguments) => conform(arguments, &mut out),
        Command::Integrate(IntegrateArguments { log }) => integrate::run(&log, &mut out),
        Command::Compose(arguments) => compose(&arguments, &mut out),
        Command::Vectors(VectorsArguments { out: folder }) => {
            written::vectors(&folder_or(folder, "vectors"), &mut out)
        }
        Command::Explore(settings) => explore(&settings, &mut out),
        Command::Prove(settings) => prove(settings, &mut out),
        Command::Verify(settings) => {
            interrupts().and_then(|stop| verify::here(&settings, &stop, &mut out))
        }
        #[cfg(feature = "link")]
        Command::Evaluate(arguments) => evaluate(&arguments, &mut out),
        #[cfg(feature = "link")]
        Command::Merge(arguments) => merge(&arguments, &mut out),
        #[cfg(feature = "link")]
        Command::Vehicle(arguments) => {
            interrupts().and_then(|stop| crate::link::vehicle(&arguments, &stop, &mut out))
        }
        #[cfg(feature = "link")]
        Command::Station(arguments) => {
            interrupts().and_then(|stop| crate::link::station(&arguments, &stop, &mut out))
        }
        Command::Completions(CompletionsArguments { shell }) => {
            written::completions(shell, command(), &mut out)
        }
        Command::Man(it) => written::man(&folder_or(it.out, "man"), command(), &mut out),
        Command::Schemas(it) => written::schemas(&folder_or(it.out, "schemas"), &mut out),
    };
    let flushed = out.flush().map_err(Stopped::Stream);
    let code = match result.and_then(|code| flushed.map(|()| code)) {
        Ok(code) => code,
        Err(Stopped::Stream(error)) if error.kind() == io::ErrorKind::BrokenPipe => CLOSED_PIPE,
        Err(stopped) => {
            complain(&match stopped {
                Stopped::Stream(error) => format!("standard input or output: {error}"),
                Stopped::Refused(message) => message,
            });
            BAD_INPUT
        }
    };
    // What could not be written is not tried again when the buffer is dropped.
    let _ = out.into_parts();
    ExitCode::from(code)
}

/// Whether standard output was closed before this program began: then Rust has opened /dev/null in its place, to read
/// and write, where who asks for it to write opens it for that alone.
fn output_is_closed() -> bool {
    let is_null = fs::read_link("/proc/self/fd/1").is_ok_and(|it| it == Path::new("/dev/null"));
    let about = fs::read_to_string("/proc/self/fdinfo/1").unwrap_or_default();
    let flags = about.lines().find_map(|line| line.strip_prefix("flags:"));
    is_null && flags.is_some_and(|flags| flags.trim().ends_with('2'))
}

/// What is said behind an error of `conform` whose program stands without `--` before it.
fn tip(error: &clap::Error, mut given: impl Iterator<Item = OsString>) -> Option<&'static str> {
    let is_about = matches!(
        error.kind(),
        ErrorKind::UnknownArgument
            | ErrorKind::InvalidSubcommand
            | ErrorKind::MissingRequiredArgument
    );
    let of_conform =
        given.by_ref().any(|it| it == "conform") && given.all(|it| it != "--" && it != "merge");
    (is_about && of_conform).then_some(
        "the program under test stands behind `--`: mufasa conform [OPTIONS] -- COMMAND...",
    )
}

fn check(arguments: &CheckArguments, out: &mut impl Write) -> Ended {
    let stdin = Path::new(parameters_file::STDIN);
    if arguments.parameters.as_deref() == Some(stdin)
        && arguments.files.iter().any(|it| it == stdin)
    {
        let message =
            "--parameters -: standard input is one of FILES, too, and comes once; name a file";
        return Err(message.to_owned().into());
    }
    let read = arguments.parameters.as_deref().map(parameters_file::read);
    let parameters = read.transpose().map_err(said)?.unwrap_or_default();
    if let Some(note) = &parameters.note {
        complain(note);
    }
    if let Some(folder) = &arguments.svg {
        files::prepare(folder).map_err(cannot(folder, "written to"))?;
    }
    let mut options = arguments.options();
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
    let attacked = |drive: drive::Stream| {
        let injections = &mut arguments.inject.iter();
        injections.try_fold(drive, |drive, it| inject(&drive, it).map_err(|error| error.of(&drive)))
    };
    let drives = drive::streams(&arguments.files, &options);
    let drives: Vec<_> = drives.into_iter().map(|drive| drive.and_then(attacked)).collect();
    let findings = check::run(&drives, &settings, out, &mut io::stderr())?;
    if arguments.svg.is_some() && findings.pictures == 0 {
        complain(
            "no picture: each shows a cycle that a stage fails, and there is none (--inject makes some)",
        );
    }
    Ok(findings.exit_code())
}

/// Exit code 0 with a composition, 1 without, 2 for bad input.
fn compose(arguments: &ComposeArguments, out: &mut impl Write) -> Ended {
    let ComposeArguments { file, dot, .. } = arguments;
    let Some(file) = file else {
        write!(out, "{}", compose::EXAMPLE)?;
        return Ok(0);
    };
    let text = fs::read_to_string(file).map_err(cannot(file, "read"))?;
    let composed =
        compose::composed(&text).map_err(|error| format!("{}: {error}", file.display()))?;
    write!(out, "{}", if *dot { composed.dot() } else { composed.table() })?;
    Ok(u8::from(composed.answer().compositions.is_empty()))
}

fn explore(settings: &explore::Settings, out: &mut impl Write) -> Ended {
    let folder = folder_or(settings.out.clone(), "exploration");
    explore::run(settings, &folder, out).map(explore::End::code)
}

fn prove(mut settings: prove::Settings, out: &mut impl Write) -> Ended {
    // The usual file holds all claims, so that a run of some writes only where it is told.
    if settings.out.is_none() && settings.names.is_empty() && settings.required.is_none() {
        settings.out = Some(file_or(None, prove::FILE));
    }
    prove::run(&settings, out).map(prove::End::code)
}

/// An experiment. Only a search outlives the first interrupt: of the others nothing is left.
#[cfg(feature = "link")]
fn evaluate(arguments: &EvaluateArguments, out: &mut impl Write) -> Ended {
    let stop = if arguments.is_search() { interrupts()? } else { Arc::default() };
    evaluate::run(arguments, &stop, out)
}

fn conform(arguments: ConformArguments, out: &mut impl Write) -> Ended {
    if let Some(MergeCommand::Merge { files, out: folder }) = arguments.merge {
        return conformed(kit::merge(&files, folder.as_ref(), out));
    }
    let settings = kit::Settings {
        version: env!("MUFASA_VERSION").to_owned(),
        command: arguments.command,
        profile: arguments.profile,
        cases: arguments.cases,
        seed: arguments.seed,
        time_limit: Duration::from_millis(arguments.time_limit),
        shrinking: Duration::from_secs(arguments.shrinking),
        kinds: arguments.kinds,
        shard: arguments.shard,
        drives: arguments.drives,
        vectors: !arguments.no_vectors,
        tolerance: arguments.tolerance,
        out: folder_or(arguments.out, "mufasa-conform"),
    };
    conformed(kit::run(&settings, &interrupts()?, out, &mut io::stderr()))
}

/// Parts of an experiment, or of a campaign of `conform`.
#[cfg(feature = "link")]
fn merge(arguments: &MergeArguments, out: &mut impl Write) -> Ended {
    let MergeArguments { parts, map, out: folder } = arguments;
    if parts.first().is_none_or(|it| kit::Summary::read(it).is_err()) {
        return evaluate::shards::merge(arguments, out);
    }
    if map.is_some() {
        return Err(String::from("--map: a campaign of conform has no map").into());
    }
    conformed(kit::merge(parts, folder.as_ref(), out))
}

fn conformed(result: Result<u8, kit::ConformError>) -> Ended {
    result.map_err(|error| match error {
        kit::ConformError::Output(error) => Stopped::Stream(error),
        error => Stopped::Refused(error.to_string()),
    })
}

/// A file that gets longer than a limit of the system (`ulimit -f`) is an error of writing, as on a full disk, and
/// not the end of this program without a word.
fn files_may_be_limited() {
    #[cfg(unix)]
    {
        let reached = Arc::new(AtomicBool::new(false));
        let registered = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, reached);
        if let Err(error) = registered {
            complain(&format!("limits of files: {error}"));
        }
    }
}

/// What the first interrupt sets; the second ends this program at once.
fn interrupts() -> Result<Arc<AtomicBool>, Stopped> {
    let stop = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&stop);
    let handler = ctrlc::set_handler(move || {
        if set.swap(true, Ordering::Relaxed) {
            process::exit(i32::from(kit::INTERRUPTED));
        }
    });
    handler.map_err(|error| format!("interrupts: {error}"))?;
    Ok(stop)
}

/// The commands; a number below 0 is a value and no option, so that its limits are said.
fn command() -> clap::Command {
    let signed = |argument: Arg| {
        let is_number = argument.get_action().takes_values() && !argument.is_positional();
        argument.allow_negative_numbers(is_number)
    };
    Cli::command().mut_subcommands(|command| command.mut_args(signed))
}
