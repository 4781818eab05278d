//! One run as a page (`mufasa_sim::replay`).

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, value_parser};
use mufasa_drives::check::complain;
use mufasa_records::files;
use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::falsify::found::Found;
use mufasa_sim::map::streets::town;
use mufasa_sim::replay::Id;
use mufasa_sim::run::Outcome;

/// Bad input, or a file that cannot be written.
const BAD_INPUT: u8 = 2;

/// Which run, and where its page goes.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit codes: 0 the page is written, however the run ended; 2 bad input or the file cannot be written.")]
pub struct ReplayArguments {
    /// A collision that `mufasa evaluate falsify` found; it says which run it is.
    #[arg(value_name = "FILE", conflicts_with_all = ["attack", "variant", "route", "scenario", "vehicles", "from"])]
    pub found: Option<PathBuf>,
    /// What the attacker does [default: nothing].
    #[arg(long, value_name = "KIND", value_parser = kind())]
    pub attack: Option<Kind>,
    /// What is checked of remote data.
    #[arg(long, value_name = "VARIANT", default_value = "hardened", value_parser = variant())]
    pub variant: Variant,
    /// Which of the CAV's routes.
    #[arg(long, value_name = "N", default_value = "0", value_parser = value_parser!(u8).range(0..=1), allow_negative_numbers = true)]
    pub route: u8,
    /// Seed of the scenario, of noise and of the link.
    #[arg(long, value_name = "SEED", default_value = "0", value_parser = value_parser!(u64).range(0..=1_000_000_000), allow_negative_numbers = true)]
    pub scenario: u64,
    /// Other vehicles in the town.
    #[arg(long, value_name = "N", default_value = "15", value_parser = value_parser!(u16).range(0..=200), allow_negative_numbers = true)]
    pub vehicles: u16,
    /// Start of the attack, s; it goes on to the end.
    #[arg(long, value_name = "S", default_value = "5", value_parser = value_parser!(u16), allow_negative_numbers = true)]
    pub from: u16,
    /// The page; by default its name says which run it is.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Makes the run and writes its page. Returns the exit code. Errors: those of writing to `out`.
pub fn run(
    arguments: &ReplayArguments,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    if let Some(found) = &arguments.found {
        return run_found(found, arguments.out.as_deref(), out, err);
    }
    let &ReplayArguments { attack, variant, route, scenario, vehicles, from, .. } = arguments;
    let id = Id { variant, attack, route: route.into(), scenario };
    let (outcome, page) = match id.page(&town(), vehicles.into(), from.into()) {
        Ok(Some(made)) => made,
        Ok(None) => {
            complain(err, &format!("route {route}: the town has fewer"));
            return Ok(BAD_INPUT);
        }
        Err(error) => {
            complain(err, &error.to_string());
            return Ok(BAD_INPUT);
        }
    };
    write_page(&id.to_string(), &outcome, &page, arguments.out.as_deref(), out, err)
}

/// The same of a collision in a file.
fn run_found(
    found: &Path,
    file: Option<&Path>,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    let read = std::fs::read_to_string(found).map_err(|error| error.to_string());
    let read = read.and_then(|text| {
        serde_json::from_str::<Found>(&text).map_err(|error| format!("no collision: {error}"))
    });
    let town = town();
    let made = read.and_then(|found| {
        let routes = town.ego_routes().count();
        if found.case.route >= routes {
            return Err(format!("route {}: the town has {routes}", found.case.route));
        }
        let made = found.case.page(&town).map_err(|error| error.to_string())?;
        Ok((found.case.name(), made))
    });
    match made {
        Ok((name, (outcome, page))) => write_page(&name, &outcome, &page, file, out, err),
        Err(message) => {
            complain(err, &format!("{}: {message}", found.display()));
            Ok(BAD_INPUT)
        }
    }
}

fn write_page(
    name: &str,
    outcome: &Outcome,
    page: &str,
    file: Option<&Path>,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    let named = || PathBuf::from(format!("{}.html", name.replace('/', "-")));
    let file = file.map_or_else(named, Path::to_path_buf);
    if let Err(error) = files::write(&file, page) {
        complain(err, &format!("{}: cannot be written: {error}", file.display()));
        return Ok(BAD_INPUT);
    }
    writeln!(out, "{name}: {:?} at {:.2} s, {}", outcome.end, outcome.t, file.display())?;
    Ok(0)
}

pub(super) fn kind() -> impl TypedValueParser<Value = Kind> {
    PossibleValuesParser::new(Kind::ALL.map(Kind::name)).try_map(|given| {
        Kind::ALL.into_iter().find(|kind| kind.name() == given).ok_or("unknown attack")
    })
}

pub(super) fn variant() -> impl TypedValueParser<Value = Variant> {
    PossibleValuesParser::new(Variant::ALL.map(Variant::name)).try_map(|given| {
        Variant::ALL.into_iter().find(|it| it.name() == given).ok_or("unknown variant")
    })
}
