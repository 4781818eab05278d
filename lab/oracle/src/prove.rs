//! What is proved, by which engine, of which inputs: all engines that are here are run, the others
//! are listed as not run.

pub mod claim;
pub mod engines;
pub mod required;
pub mod settings;
pub mod sources;
pub mod tables;

use std::io::{self, Write};
use std::path::Path;

use indicatif::ProgressBar;

use crate::document;
use crate::ended::{Stopped, cannot, complain, said};
use crate::spelling::near;
use claim::{Claim, Status};
use engines::ClaimSource;
use mufasa_proofs::OVERFLOW_PANICS;
use mufasa_records::files;
pub use settings::{CBMC, Settings};

/// Where the claims are written if all are judged and nobody names another file.
pub const FILE: &str = "target/proofs/prove.json";

/// Name of the table in a document.
pub const TABLE_NAME: &str = "mufasa prove";

/// What stands before the number of the sources (`sources::hash_of_all`) below the table in a document.
pub const SOURCES: &str = "Number of the sources: `";

/// How it ended; the worst that applies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// Whatever was run is proved, or tested where no engine proves it.
    #[default]
    Proved,
    /// A required claim is not proved, because its engine is missing.
    LeftOut,
    /// Something that should hold is refuted or not known, or a required claim is not proved by an engine that is here.
    NotProved,
    /// No line has such a name, a file could not be read or written, or an engine broke down.
    BadInput,
}

impl End {
    /// The exit code.
    pub const fn code(self) -> u8 {
        match self {
            Self::Proved => 0,
            Self::NotProved => 1,
            Self::BadInput => 2,
            Self::LeftOut => 4,
        }
    }
}

/// Runs the engines and writes the table to `out`. Errors: those of writing to `out`, and what makes proving of no use.
pub fn run(settings: &Settings, out: &mut impl Write) -> Result<End, Stopped> {
    known(&settings.names)?;
    document::has_place(settings.into.as_deref(), TABLE_NAME)?;
    is_of_a_vehicle(settings)?;
    files_are_there(settings)?;
    let required = settings.required.as_deref().map(required::read).transpose()?;
    let is_wanted = |source: ClaimSource, claim: &Claim| match &required {
        Some(ids) => ids.contains(&claim.id),
        None => source.is_wanted(&settings.names, claim),
    };
    let missing = engines::missing(settings, &is_wanted).map_err(said)?;
    // A document has the number of claims that were not run of each engine.
    if !settings.markdown {
        write!(out, "{}", tables::missing(&missing))?;
    }
    out.flush()?;
    let mut lines = Vec::new();
    let mut end = End::default();
    for source in ClaimSource::ALL {
        match source.lines(settings, &is_wanted, &bar(source)) {
            Ok(more) => lines.extend(more),
            Err(problem) => {
                complain(&format!("{}: {problem}", source.name()));
                end = End::BadInput;
            }
        }
    }
    if lines.iter().any(|line| matches!(line.answer.status, Status::Refuted | Status::Unknown)) {
        end = end.max(End::NotProved);
    }
    if let (Some(ids), Some(path)) = (&required, &settings.required) {
        let (summary, found) = required::summary(path, ids, &lines);
        write!(out, "{summary}")?;
        end = end.max(found);
    }
    if settings.markdown {
        write!(out, "{}", tables::markdown(&lines))?;
    } else {
        if required.is_none() {
            writeln!(out, "{}", required::promised(&lines))?;
        }
        if !settings.summary {
            write!(out, "{}", tables::text(&lines))?;
        }
        writeln!(out, "{}", tables::counts(&lines))?;
    }
    if let Some(path) = &settings.into {
        write_document(path, settings, &lines).map_err(cannot(path, "written"))?;
    }
    if let Some(path) = &settings.out {
        write_lines(path, &lines).map_err(cannot(path, "written"))?;
    }
    Ok(end)
}

/// Whether the file of the compiled proofs is there if it is not the usual one, and the other can be written.
fn files_are_there(settings: &Settings) -> Result<(), String> {
    let Settings { cbmc, out, .. } = settings;
    if cbmc != Path::new(CBMC) && !cbmc.exists() {
        return Err(format!("{}: is not there; scripts/prove-wasm writes {CBMC}", cbmc.display()));
    }
    let Some(out) = out else { return Ok(()) };
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).map_err(cannot(out, "written"))?;
    }
    files::prepare_file(out).map_err(cannot(out, "written"))
}

/// Whether what is run natively is the code of a vehicle, if it is for a document: in the builds of tests an overflow
/// panics, in those of a vehicle it wraps.
fn is_of_a_vehicle(settings: &Settings) -> Result<(), String> {
    match &settings.into {
        Some(path) if OVERFLOW_PANICS => Err(format!(
            "{}: not written by this build, in which an overflow panics; in a vehicle it wraps: cargo run --release",
            path.display()
        )),
        _ => Ok(()),
    }
}

/// Whether something has each of these names. Errors, in words: the first that nothing has, with the one that is near.
fn known(names: &[String]) -> Result<(), String> {
    if names.is_empty() {
        return Ok(());
    }
    let mut all = Vec::new();
    for source in ClaimSource::ALL {
        let claims = source.claims().map_err(|error| format!("{}: {error}", source.name()))?;
        all.push((source, claims));
    }
    let means = |name: &str| {
        all.iter().any(|(source, claims)| claims.iter().any(|it| source.is_meant(name, it)))
    };
    let Some(name) = names.iter().find(|name| !means(name)) else { return Ok(()) };
    let engines = ClaimSource::ALL.map(|it| it.name().to_owned());
    let ids = all.iter().flat_map(|(_, claims)| claims).map(|claim| claim.id.clone());
    let advice = match near(name, ids.chain(engines)) {
        Some(near) => format!("is {near} meant?"),
        None => "docs/proofs.md lists all claims, --help the engines".to_owned(),
    };
    Err(format!("{name}: nothing has such a name; {advice}"))
}

/// All claims, of which nothing was asked. Errors are those of reading the lists of them.
pub fn claims() -> io::Result<Vec<Claim>> {
    let claims: io::Result<Vec<_>> =
        ClaimSource::ALL.into_iter().map(ClaimSource::claims).collect();
    Ok(claims?.into_iter().flatten().collect())
}

/// The table, and of which sources it is.
fn write_document(path: &Path, settings: &Settings, lines: &[Claim]) -> io::Result<()> {
    let sources = sources::hash_of_all(&settings.sources)?;
    let table = format!("{}\n{}{sources}`.\n", tables::markdown(lines), SOURCES);
    document::write(path, TABLE_NAME, &table)
}

fn write_lines(path: &Path, lines: &[Claim]) -> io::Result<()> {
    let mut text = String::new();
    for line in lines {
        text.push_str(&serde_json::to_string(line)?);
        text.push('\n');
    }
    files::write(path, &text)
}

fn bar(source: ClaimSource) -> ProgressBar {
    let bar = mufasa_drives::progress::bar(0, "{prefix} {bar:30} {pos}/{len} {msg}");
    bar.set_prefix(source.name());
    bar
}
