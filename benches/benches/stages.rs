//! `cargo bench -p mufasa-benches -- [--json FILE]`: checks that implementation and peers come to the same
//! verdicts, then times them in one process and prints the tables of ratios as Markdown; `--from FILE` prints those
//! of an earlier run. `cargo test` checks the same verdicts, and times each once.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use mufasa::input::cycle::Cycle;
use mufasa::input::profile::Profile;
use mufasa::input::route_index::{Block, RouteIndex};
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::peer::{self, corridor::Trees};
use mufasa_benches::race::{Entry, Rounds, measure};
use mufasa_benches::table::{Cache, OURS, Results, TEAMS, Team, UNSEEN, hardened, markdown};
use mufasa_benches::workload::recipe::Size;
use mufasa_benches::workload::{SIZES, Variant, Workload};

fn main() -> Result<(), Box<dyn Error>> {
    let mut json_file = None;
    let mut rounds = Rounds { warm: 1, cold: 1 };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--json" => json_file = Some(arguments.next().ok_or("--json needs a file")?),
            "--from" => {
                let file = arguments.next().ok_or("--from needs a file")?;
                let results: Vec<Results> = serde_json::from_str(&std::fs::read_to_string(file)?)?;
                print!("{}", markdown(&results));
                return Ok(());
            }
            "--bench" => rounds = Rounds { warm: 31, cold: 21 },
            // Words for the harness of the tests beside it.
            _ => {}
        }
    }
    let mut results = Vec::new();
    for size in &SIZES {
        let start = Instant::now();
        results.push(run(size, rounds));
        eprintln!("W{}: {:.1} s", size.number, start.elapsed().as_secs_f64());
    }
    print!("{}", markdown(&results));
    if let Some(file) = json_file {
        std::fs::write(file, serde_json::to_string_pretty(&results)? + "\n")?;
    }
    Ok(())
}

const VARIANTS: [(&str, Variant, Stage); 7] = [
    ("ghost", Variant::Ghost, Stage::I),
    ("drift", Variant::Drift, Stage::I),
    ("fail i", Variant::Fail(Stage::I), Stage::I),
    ("fail ii", Variant::Fail(Stage::Ii), Stage::Ii),
    ("fail iii", Variant::Fail(Stage::Iii), Stage::Iii),
    ("fail iv", Variant::Fail(Stage::Iv), Stage::Iv),
    ("fail v", Variant::Fail(Stage::V), Stage::V),
];

/// Everything about one workload.
fn run(size: &Size, rounds: Rounds) -> Results {
    let workload = Workload::new(size, Variant::Pass);
    let paper = workload.cycle(Profile::PAPER, Configuration::AllRemote);
    let strict = workload.cycle(Profile::HARDENED, Configuration::AllRemote);
    let mut contestants = Vec::new();
    for stage in Stage::ALL {
        contestants.push(ours(&of_stage(stage), OURS.to_owned(), &paper, stage));
        contestants.push(ours(&of_stage(stage), hardened(), &strict, stage));
    }
    contestants
        .extend(peer::all(&paper).into_iter().map(|peer| by_peer(&of_stage(peer.stage), peer)));
    for (name, cycle) in [(OURS.to_owned(), &paper), (hardened(), &strict)] {
        let mut it = Contestant::new(cycle);
        let run = move || it.validate();
        contestants.push(contestant("validation", name, Box::new(run)));
    }
    let plain_loop = || peer::validation::plain_loop(black_box(&paper));
    contestants.push(contestant("validation", "plain loop".to_owned(), Box::new(plain_loop)));
    let blocks = vec![Block::default(); Block::needed(paper.route.cross_sections.len())].leak();
    let build = || RouteIndex::new(black_box(paper.route), &mut *blocks).is_ok();
    contestants.push(contestant("index", OURS.to_owned(), Box::new(build)));
    let build = || Trees::new(black_box(&paper)).is_built();
    contestants.push(contestant("index", "geo and rstar".to_owned(), Box::new(build)));
    for configuration in Configuration::ALL {
        let task = format!("whole cycle {configuration:?}");
        for (name, profile) in [(OURS.to_owned(), Profile::PAPER), (hardened(), Profile::HARDENED)]
        {
            let cycle = Box::leak(Box::new(workload.cycle(profile, configuration)));
            let mut it = Contestant::new(cycle);
            let run = move || it.check().failed_stage.is_none();
            contestants.push(contestant(&task, name, Box::new(run)));
        }
    }
    // Stage iv cannot run, so that unknown cells count.
    let base = workload.cycle(Profile::HARDENED, Configuration::MotRemote);
    let cycle = Box::leak(Box::new(Cycle { detections: None, ..base }));
    let mut it = Contestant::new(cycle);
    let run = move || it.check().failed_stage.is_none();
    contestants.push(contestant(UNSEEN, hardened(), Box::new(run)));
    agree(&mut contestants, true);
    let times = measure(&mut contestants, rounds);
    let mut results = Results { workload: workload.name.clone(), times };
    let mut contestants = whole_cycles(&results, [&paper, &strict]);
    agree(&mut contestants, true);
    results.times.extend(measure(&mut contestants, rounds));
    for (task, variant, stage) in VARIANTS {
        let workload = Workload::new(size, variant);
        let cycle = workload.cycle(Profile::PAPER, Configuration::AllRemote);
        let strict = workload.cycle(Profile::HARDENED, Configuration::AllRemote);
        let mut contestants = vec![
            ours(task, OURS.to_owned(), &cycle, stage),
            ours(task, hardened(), &strict, stage),
        ];
        let peers = peer::all(&cycle).into_iter();
        let peers = peers.filter(|peer| peer.stage == stage);
        contestants.extend(peers.map(|peer| by_peer(task, peer)));
        agree(&mut contestants, false);
        let rounds = Rounds { warm: (rounds.warm / 3) | 1, cold: (rounds.cold / 3) | 1 };
        results.times.extend(measure(&mut contestants, rounds));
    }
    results
}

/// All stages in one call, so that caches are emptied once before each of the contestants: the
/// implementation in both profiles, and the peers that were fastest, warm and cold.
fn whole_cycles<'a>(results: &Results, [paper, strict]: [&'a Cycle<'a>; 2]) -> Vec<Entry<'a>> {
    let mut contestants = Vec::new();
    for cache in [Cache::Warm, Cache::Cold] {
        for (name, cycle) in [(OURS.to_owned(), paper), (hardened(), strict)] {
            let mut it = Contestant::new(cycle);
            let run = move || it.all_stages();
            contestants.push(contestant(&cache.task(), name, Box::new(run)));
        }
        for Team { name, by_hand, validates } in TEAMS {
            let run = peer::team(paper, results.fastest(cache, by_hand), validates);
            contestants.push(contestant(&cache.task(), name.to_owned(), Box::new(run)));
        }
    }
    contestants
}

/// The task of a stage alone.
fn of_stage(stage: Stage) -> String {
    format!("stage {stage:?}").to_lowercase()
}

/// Wrong answers are not timed.
fn agree(contestants: &mut [Entry<'_>], expected: bool) {
    for it in contestants {
        assert_eq!((it.run)(), expected, "{} {}", it.task, it.name);
    }
}

fn contestant<'a>(task: &str, name: String, run: Box<dyn FnMut() -> bool + 'a>) -> Entry<'a> {
    Entry { task: task.to_owned(), name, run }
}

/// A stage of the implementation alone, after validation.
fn ours<'a>(task: &str, name: String, cycle: &'a Cycle<'a>, stage: Stage) -> Entry<'a> {
    let mut it = Contestant::new(cycle);
    let run = move || it.stage(stage);
    contestant(task, name, Box::new(run))
}

fn by_peer<'a>(task: &str, peer: peer::Peer<'a>) -> Entry<'a> {
    contestant(task, peer.name.to_owned(), peer.decide)
}
