//! The command line: commands, exit codes, and quiet ends when nobody reads on.

mod arguments;
mod codes;
mod conform;
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
use mufasa_model::input::cycle::Profile;

use self::arguments::{
    CheckArguments, CompletionsArguments, ComposeArguments, DemoArguments, ExploreArguments,
    ManArguments, OracleArguments, ProveArguments, SchemasArguments, VectorsArguments, file_or,
    folder_or,
};
use self::codes::{BAD_INPUT, CLOSED_PIPE, refused};
use self::conform::{ConformArguments, MergeCommand};
use self::link::{StationArguments, VehicleArguments};
use crate::compose;
use crate::demo;
use crate::evaluate;
use crate::evaluate::arguments::EvaluateArguments;
use crate::evaluate::merge::MergeArguments;
use crate::explore;
use crate::parameters_file;
use crate::prove;
use mufasa_conform as kit;
use mufasa_conform::reference as oracle;
use mufasa_drives::check::{self, Format, Settings, complain};
use mufasa_drives::{self as drive, inject, progress};
use mufasa_records::files;

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
    /// Find all compositions of a service set.
    Compose(ComposeArguments),
    /// Write the vectors: lines with the answers that they must get, their schemas, a README.
    Vectors(VectorsArguments),
    /// Explore the offloading protocol state by state.
    Explore(ExploreArguments),
    /// Prove what is claimed with every engine that is here, and list what is proved.
    Prove(ProveArguments),
    /// Experiments in a closed loop: a CAV drives through a town, offloads to a station, and is attacked.
    Evaluate(EvaluateArguments),
    /// Put the parts of an experiment together that were made by `evaluate --shard`.
    Merge(MergeArguments),
    /// Drive a drive with requester and monitor, beside a station or over a broker.
    Vehicle(VehicleArguments),
    /// Serve vehicles over a broker, with stand-in services.
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
                complain(&mut io::stderr(), tip);
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
        complain(&mut io::stderr(), &writes);
        Command::Demo(DemoArguments { out: Some(demo::FOLDER.into()) })
    };
    let result = match cli.command.unwrap_or_else(demo) {
        Command::Check(arguments) => check(&arguments, &mut out),
        Command::Demo(it) => {
            demo::run(&folder_or(it.out, demo::FOLDER), &mut out, &mut io::stderr())
        }
        Command::Oracle(OracleArguments { implementation }) => {
            let answer = if implementation { oracle::by_implementation } else { oracle::by_model };
            oracle::run(io::stdin().lock(), &mut out, answer).map(|()| 0)
        }
        Command::Conform(arguments) => conform(arguments, &mut out),
        Command::Compose(arguments) => compose(&arguments, &mut out),
        Command::Vectors(VectorsArguments { out: folder }) => {
            written::vectors(&folder_or(folder, "vectors"), &mut out)
        }
        Command::Explore(arguments) => explore(arguments, &mut out),
        Command::Prove(arguments) => prove(arguments, &mut out),
        Command::Evaluate(arguments) => evaluate(&arguments, &mut out),
        Command::Merge(arguments) => merge(&arguments, &mut out),
        Command::Vehicle(arguments) => {
            Ok(linked(|stop| crate::link::vehicle(&arguments, stop, &mut out)))
        }
        Command::Station(arguments) => {
            Ok(linked(|stop| crate::link::station(&arguments, stop, &mut out)))
        }
        Command::Completions(CompletionsArguments { shell }) => {
            written::completions(shell, command(), &mut out)
        }
        Command::Man(it) => written::man(&folder_or(it.out, "man"), command(), &mut out),
        Command::Schemas(it) => written::schemas(&folder_or(it.out, "schemas"), &mut out),
    };
    let code = match result.and_then(|code| out.flush().map(|()| code)) {
        Ok(code) => code,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => CLOSED_PIPE,
        Err(error) => refused(&format!("standard input or output: {error}")),
    };
    // What could not be written is not tried again when the buffer is dropped.
    let _ = out.into_parts();
    ExitCode::from(code)
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

fn check(arguments: &CheckArguments, out: &mut impl Write) -> io::Result<u8> {
    let stdin = Path::new(parameters_file::STDIN);
    if arguments.parameters.as_deref() == Some(stdin)
        && arguments.files.iter().any(|it| it == stdin)
    {
        let message =
            "--parameters -: standard input is one of FILES, too, and comes once; name a file";
        return Ok(refused(message));
    }
    let parameters = match arguments.parameters.as_deref().map(parameters_file::read).transpose() {
        Ok(parameters) => parameters.unwrap_or_default(),
        Err(error) => return Ok(refused(&error.to_string())),
    };
    if let Some(note) = &parameters.note {
        complain(&mut io::stderr(), note);
    }
    if let Some(folder) = &arguments.svg
        && let Err(error) = files::prepare(folder)
    {
        return Ok(refused(&format!("{}: cannot be written to: {error}", folder.display())));
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
    Ok(findings.exit_code())
}

/// Exit code 0 with a composition, 1 without, 2 for bad input.
fn compose(arguments: &ComposeArguments, out: &mut impl Write) -> io::Result<u8> {
    let file = arguments.file.display();
    let text = match fs::read_to_string(&arguments.file) {
        Ok(text) => text,
        Err(error) => return Ok(refused(&format!("{file}: cannot be read: {error}"))),
    };
    let composed = match compose::composed(&text) {
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
    let settings = explore::Settings {
        profiles: arguments
            .profile
            .map_or(vec![Profile::PAPER, Profile::HARDENED], |profile| vec![profile]),
        bounds: arguments.bounds,
        world: arguments.world,
        into: arguments.into,
        folder: folder_or(arguments.out, "exploration"),
    };
    Ok(explore::run(&settings, out, &mut io::stderr())?.code())
}

fn prove(arguments: ProveArguments, out: &mut impl Write) -> io::Result<u8> {
    let settings = prove::Settings {
        // The usual file holds all claims, so that a run of some writes only where it is told.
        out: match arguments.out {
            None if arguments.names.is_empty() && arguments.required.is_none() => {
                Some(file_or(None, prove::FILE))
            }
            out => out,
        },
        names: arguments.names,
        required: arguments.required,
        cbmc: arguments.cbmc,
        markdown: arguments.markdown,
        sources: arguments.sources,
        into: arguments.into,
    };
    prove::run(&settings, out, &mut io::stderr()).map(prove::End::code)
}

/// An experiment. Only a search outlives the first interrupt: of the others nothing is left.
fn evaluate(arguments: &EvaluateArguments, out: &mut impl Write) -> io::Result<u8> {
    let stop = if arguments.is_search() { interrupts() } else { Ok(Arc::default()) };
    match stop {
        Ok(stop) => evaluate::run(arguments, &stop, out, &mut io::stderr()),
        Err(error) => Ok(refused(&format!("interrupts: {error}"))),
    }
}

fn conform(arguments: ConformArguments, out: &mut impl Write) -> io::Result<u8> {
    let result = match arguments.merge {
        Some(MergeCommand::Merge { files, out: folder }) => {
            kit::merge(&files, folder.as_ref(), out)
        }
        None => {
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
            let stop = match interrupts() {
                Ok(stop) => stop,
                Err(error) => return Ok(refused(&format!("interrupts: {error}"))),
            };
            kit::run(&settings, &stop, out, &mut io::stderr())
        }
    };
    conformed(result, out)
}

/// Parts of an experiment, or of a campaign of `conform`.
fn merge(arguments: &MergeArguments, out: &mut impl Write) -> io::Result<u8> {
    let MergeArguments { parts, map, out: folder } = arguments;
    if parts.first().is_none_or(|it| kit::Summary::read(it).is_err()) {
        return evaluate::shards::merge(arguments, out, &mut io::stderr());
    }
    if map.is_some() {
        return Ok(refused("--map: a campaign of conform has no map"));
    }
    conformed(kit::merge(parts, folder.as_ref(), out), out)
}

fn conformed(result: Result<u8, kit::ConformError>, out: &mut impl Write) -> io::Result<u8> {
    match result {
        Ok(code) => Ok(code),
        Err(kit::ConformError::Output(error)) => Err(error),
        Err(error) => {
            out.flush()?;
            Ok(refused(&error.to_string()))
        }
    }
}

/// A file that gets longer than a limit of the system (`ulimit -f`) is an error of writing, as on a full disk, and
/// not the end of this program without a word.
fn files_may_be_limited() {
    #[cfg(unix)]
    {
        let reached = Arc::new(AtomicBool::new(false));
        let registered = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, reached);
        if let Err(error) = registered {
            complain(&mut io::stderr(), &format!("limits of files: {error}"));
        }
    }
}

/// Runs a program of the link, which ends at the first interrupt.
fn linked(run: impl FnOnce(&Arc<AtomicBool>) -> Result<u8, String>) -> u8 {
    let stop = match interrupts() {
        Ok(stop) => stop,
        Err(error) => return refused(&format!("interrupts: {error}")),
    };
    run(&stop).unwrap_or_else(|message| refused(&message))
}

/// What the first interrupt sets; the second ends this program at once.
fn interrupts() -> Result<Arc<AtomicBool>, ctrlc::Error> {
    let stop = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&stop);
    ctrlc::set_handler(move || {
        if set.swap(true, Ordering::Relaxed) {
            process::exit(i32::from(kit::INTERRUPTED));
        }
    })?;
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
