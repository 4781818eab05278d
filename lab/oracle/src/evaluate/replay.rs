//! One run as a page (`mufasa_sim::replay`).

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use mufasa_records::files;
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::cav::recorder::Share;
use mufasa_sim::experiment::axes::Axes;
use mufasa_sim::experiment::falsify::found::Found;
use mufasa_sim::experiment::job::{Job, kind_name};
use mufasa_sim::experiment::select::Options;
use mufasa_sim::map::Town;
use mufasa_sim::replay::Replay;
use mufasa_sim::run::{Cycle, Outcome, Watcher};
use mufasa_sim::snapshot::Snapshot;

use super::maps;
use crate::ended::{Ended, cannot, complain, said};
use crate::limits::whole;

/// Other vehicles if nothing is said.
const VEHICLES: usize = 15;

/// Which run, and where its page goes.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Exit codes: 0 the page is written, however the run ended; 2 bad input or a file cannot be written.")]
pub struct ReplayArguments {
    /// A collision that `mufasa evaluate falsify` found; it says which run it is.
    #[arg(value_name = "FILE", conflicts_with_all = ["run", "attack", "variant", "route", "scenario", "vehicles", "from"])]
    pub found: Option<PathBuf>,
    /// A run of an experiment by its id, such as failures/paper/empty-tracks/0/3. With `--scenarios`,
    /// `--vehicles` and `--seed` as they were given to the experiment.
    #[arg(long, value_name = "ID", conflicts_with_all = ["attack", "variant", "route", "scenario", "from"])]
    pub run: Option<String>,
    /// Scenarios of the experiment [default: that of the experiment].
    #[arg(long, value_name = "N", requires = "run", value_parser = whole(1_u64, 10_000), allow_negative_numbers = true)]
    pub scenarios: Option<u64>,
    /// Seed of the experiment's first scenario.
    #[arg(long, value_name = "SEED", requires = "run", default_value = "0", value_parser = whole(0_u64, 1_000_000_000), allow_negative_numbers = true)]
    pub seed: u64,
    /// Drive on the map in this folder, not in the town; as it was given to the experiment, or to the search.
    #[arg(long, value_name = "FOLDER")]
    pub map: Option<PathBuf>,
    /// What the attacker does [default: nothing].
    #[arg(long, value_name = "KIND", value_parser = kind())]
    pub attack: Option<Kind>,
    /// What is checked of remote data.
    #[arg(long, value_name = "VARIANT", default_value = "hardened", value_parser = variant())]
    pub variant: Variant,
    /// Which of the CAV's routes.
    #[arg(long, value_name = "N", default_value = "0", value_parser = whole(0_u8, 1), allow_negative_numbers = true)]
    pub route: u8,
    /// Seed of the scenario, of noise and of the link.
    #[arg(long, value_name = "SEED", default_value = "0", value_parser = whole(0_u64, 1_000_000_000), allow_negative_numbers = true)]
    pub scenario: u64,
    /// Other vehicles in the town [default: 15, or that of the experiment].
    #[arg(long, value_name = "N", value_parser = whole(0_u16, 200), allow_negative_numbers = true)]
    pub vehicles: Option<u16>,
    /// Start of the attack, s; it goes on to the end.
    #[arg(long, value_name = "S", default_value = "5", value_parser = whole(0, u16::MAX), allow_negative_numbers = true)]
    pub from: u16,
    /// The station sends what it has, as in an experiment `--without-precheck`.
    #[arg(long, conflicts_with = "found")]
    pub without_precheck: bool,
    /// The page; by default its name says which run it is.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write the calls of the CAV's monitor, too, as a log for `mufasa integrate`.
    #[arg(long, value_name = "FILE")]
    pub calls: Option<PathBuf>,
}

/// The runs of an experiment by its name and its size, which is made of its defaults; none, if there is no such one.
pub(super) type Jobs = fn(&str, &dyn Fn(Options) -> Options, &Town) -> Vec<Job>;

/// Makes the run and writes its page, and its calls. Returns the exit code.
pub fn run(arguments: &ReplayArguments, jobs: Jobs, out: &mut impl Write) -> Ended {
    let (town, job) = job(arguments, jobs)?;
    let (name, outcome, files) = write(arguments, &town, &job)?;
    let files: Vec<String> = files.iter().map(|it| it.display().to_string()).collect();
    let files = files.join(", ");
    writeln!(out, "{name}: {:?} at {:.2} s, {files}", outcome.end, outcome.t)?;
    Ok(0)
}

/// The run that is meant, and its map. Errors: there is none.
fn job(arguments: &ReplayArguments, jobs: Jobs) -> Result<(Town, Job), String> {
    let &ReplayArguments { attack: attack_of, variant, route, scenario, vehicles, from, .. } =
        arguments;
    let folder = arguments.map.as_deref();
    let (town, job) = match (&arguments.found, &arguments.run) {
        (Some(file), _) => {
            let case = found(file)?.case;
            (maps::same(folder, case.map, &file.display().to_string())?, case.job())
        }
        (None, Some(id)) => {
            let town = maps::of(folder)?;
            let job = of_experiment(id, arguments, jobs, &town)?;
            (town, job)
        }
        (None, None) => {
            let town = maps::of(folder)?;
            let place = (variant, usize::from(route), scenario);
            let vehicles = vehicles.map_or(VEHICLES, usize::from);
            let without_precheck = arguments.without_precheck;
            let of = Options { map: town.id, without_precheck, ..Options::town(1, vehicles, 0) };
            let mut job = Job::new("replay", (kind_name(attack_of), Axes::default()), place, of);
            let attack = |kind| Attack::new(kind, from.into(), f64::INFINITY, scenario);
            job.settings.attacks = attack_of.into_iter().map(attack).collect();
            (town, job)
        }
    };
    let routes = town.ego_routes().count();
    if job.route >= routes {
        return Err(format!("route {}: the map has {routes}", job.route));
    }
    Ok((town, job))
}

/// A collision in a file.
fn found(file: &Path) -> Result<Found, String> {
    let text =
        std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    serde_json::from_str(&text)
        .map_err(|error| format!("{}: no collision: {error}", file.display()))
}

/// A run of an experiment.
fn of_experiment(
    id: &str,
    arguments: &ReplayArguments,
    jobs: Jobs,
    town: &Town,
) -> Result<Job, String> {
    let name = id.split('/').next().unwrap_or_default();
    let sized = |defaults: Options| Options {
        scenarios: arguments.scenarios.unwrap_or(defaults.scenarios),
        vehicles: arguments.vehicles.map_or(defaults.vehicles, usize::from),
        seed: arguments.seed,
        map: town.id,
        without_precheck: arguments.without_precheck,
    };
    let mut jobs = jobs(name, &sized, town);
    let at = jobs.iter().position(|job| job.id == id);
    at.map(|at| jobs.swap_remove(at)).ok_or_else(|| {
        format!(
            "--run {id}: no run of an experiment on {} has such an id; one is its experiment, variant, what \
             is special, route and scenario, such as failures/paper/empty-tracks/{}/3",
            town.id,
            town.id.route(0)
        )
    })
}

/// The name of the run, how it ended, and the files.
fn write(
    arguments: &ReplayArguments,
    town: &Town,
    job: &Job,
) -> Result<(String, Outcome, Vec<PathBuf>), String> {
    let name = job.id.clone();
    let file = arguments.out.clone();
    let file = file.unwrap_or_else(|| {
        let usual = format!("{}.html", name.replace('/', "-"));
        complain(&format!("writes into {usual}; --out names another file"));
        PathBuf::from(usual)
    });
    for file in [Some(&file), arguments.calls.as_ref()].into_iter().flatten() {
        files::prepare_file(file).map_err(cannot(file, "written"))?;
    }
    let mut both = Both { replay: Replay::default(), calls: String::new() };
    let mut job = job.clone();
    if arguments.calls.is_some() {
        (job.settings.recorded, job.settings.logged) = (Share::ALL, true);
    }
    let outcome = job.run(town, &mut both).map_err(said)?;
    let page = both.replay.page(town, &name, job.route, &outcome);
    files::write(&file, &page).map_err(cannot(&file, "written"))?;
    let mut written = vec![file];
    if let Some(file) = &arguments.calls {
        files::write(file, &both.calls).map_err(cannot(file, "written"))?;
        written.push(file.clone());
    }
    Ok((name, outcome, written))
}

/// What is made of a run.
struct Both {
    replay: Replay,
    calls: String,
}

impl Watcher for Both {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        self.replay.cycle(truth, cav, decided, cycle);
    }

    fn ended(&mut self, truth: &Snapshot, cav: &Cav<'_>) {
        self.replay.ended(truth, cav);
        self.calls = cav.guard().calls().map(ToString::to_string).unwrap_or_default();
    }
}

pub(super) fn kind() -> impl TypedValueParser<Value = Kind> {
    PossibleValuesParser::new(Kind::IN_THE_LOOP.map(Kind::name))
        .try_map(|given| Kind::named(&given, &Kind::IN_THE_LOOP).ok_or("unknown attack"))
}

pub(super) fn variant() -> impl TypedValueParser<Value = Variant> {
    PossibleValuesParser::new(Variant::ALL.map(Variant::name)).try_map(|given| {
        Variant::ALL.into_iter().find(|it| it.name() == given).ok_or("unknown variant")
    })
}
