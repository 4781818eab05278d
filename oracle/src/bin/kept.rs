use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::Decided;
use mufasa_sim::experiment::falsify::danger::Danger;
use mufasa_sim::experiment::falsify::found::Found;
use mufasa_sim::map::streets;
use mufasa_sim::run::{Cycle, Watcher};
use mufasa_sim::snapshot::Snapshot;
struct Both { danger: Danger, lines: Vec<(f64,String)> }
impl Watcher for Both {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        self.danger.cycle(truth, cav, decided, cycle);
        let why = match &decided.report { Some(Ok(r)) => r.stages.iter().enumerate().find_map(|(i,o)| match o { mufasa::report::Outcome::Failed(w) => Some(format!("{} {:?} {:?}", i+1, w.rule, w.compared)), _ => None }).unwrap_or_default(), Some(Err(e)) => format!("{e:?}"), None => String::new() };
        self.lines.push((cycle.t, format!("{:.2} s={:.1} v={:.2} near={:.2} remote={} failed={} att={} {:?} acc={} {why}", cycle.t, cycle.s, cycle.speed, cycle.nearest.unwrap_or(99.0), cycle.remote, cycle.failed, cycle.attacked, cav.guard().configuration(), 0)));
    }
    fn ended(&mut self, truth: &Snapshot, cav: &Cav<'_>) { self.danger.ended(truth, cav); }
}
fn main() {
    let town = streets::town();
    let verbose = std::env::args().nth(2).is_some();
    let only = std::env::args().nth(1).unwrap_or_default();
    let mut files: Vec<_> = std::fs::read_dir("sim/found").unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    for file in files.iter().filter(|f| f.to_string_lossy().contains(&only)) {
        let found: Found = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
        let mut both = Both { danger: Danger::default(), lines: vec![] };
        let outcome = found.case.run(&town, &mut both).unwrap();
        println!("{}: was t={} with {} v {:.2}; now {:?} t={} with {:?} least {:.2} last use {:?}", file.file_stem().unwrap().to_string_lossy(), found.t_s, found.with, found.speed_mps, outcome.end, outcome.t, outcome.with, outcome.least_distance, both.danger.last_use());
        let route = &town.routes[found.case.ego_route(&town)];
        if verbose { for (i,(t,line)) in both.lines.iter().enumerate() { if *t > outcome.t - 8.0 || true { println!("  {line} left={:.1}", both.danger.time_left(route, i)); } } }
        for (what, case) in [("tau .25", { let mut c=found.case.clone(); c.tau_s=0.25; c }), ("brakes by", { let mut c=found.case.clone(); c.drives_on=false; c.tau_s=0.25; c })] {
            if case != found.case { let o = case.run(&town, &mut ()).unwrap(); println!("   {what}: {:?} t={} with {:?}", o.end, o.t, o.with); }
        }
    }
}
