use std::collections::BTreeMap;
use mufasa_model::input::cycle::Profile;
use mufasa_model::report::{Outcome, Reading};
use mufasa_model::stages::check;
use mufasa_props::conformance::{name, rank};
use mufasa_props::differential::{conforming, near_threshold, same_witness, runner};
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::*;
use proptest::strategy::{Strategy, ValueTree};
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let n: u64 = args[2].parse().unwrap();
    let want = args.get(3).map(|s| s.parse::<u64>().unwrap());
    let generator = match args[1].as_str() {
        "fs" => fail_safe::cycle as fn(&mut Draw<'_>, Profile) -> _,
        "det" => detections::cycle,
        "map" => map_validation::cycle,
        "tracks" => tracks::cycle,
        "grid" => grid::cycle,
        "beside" => grid::beside_iv,
        _ => whole::cycle,
    };
    let mut runner = runner();
    let (mut verdicts, mut near, mut sampled, mut bad) = (BTreeMap::new(), 0, 0, 0);
    let mut mono = 0;
    let mut slow = std::time::Duration::ZERO;
    for i in 0..n {
        let tape = tape().new_tree(&mut runner).unwrap().current();
        let cycle = generator(&mut Draw::new(&tape), Profile::Hardened);
        if let Some(w) = want { if w != i { continue; } 
            println!("{cycle:#?}");
        }
        let t = std::time::Instant::now();
        let [e, s, l] = [Reading::Exact, Reading::Strict, Reading::Lax].map(|r| check(&cycle, r));
        let dt = t.elapsed();
        if dt > slow { slow = dt; eprintln!("{i}: {dt:?}"); }
        let aim = if args[1] == "fs" { let mut d = Draw::new(&tape); fail_safe::AIMS[d.below(12)].0 } else { "" };
        let v = match &e { Ok(r) => { let w = r.stages.iter().find_map(|o| if let Outcome::Failed(w) = o { Some(format!("{:?}", w.rule)) } else { None }); format!("{} {}", name(r.failed_stage), w.unwrap_or_default()) }, Err(_) => "error".into() };
        let nr = if i % 4 == 0 { sampled += 1; let x = near_threshold(&cycle); near += u64::from(x); Some(x) } else { None };
        let x: &mut [u64; 3] = verdicts.entry((aim, v)).or_default();
        x[0] += 1;
        if let Some(nr) = nr { x[1] += 1; x[2] += u64::from(nr); }
        if let (Ok(e), Ok(s), Ok(l)) = (&e, &s, &l) {
            if rank(s.failed_stage) > rank(e.failed_stage) || rank(e.failed_stage) > rank(l.failed_stage) { mono += 1; println!("MONO {i}: {:?} {:?} {:?}", s.failed_stage, e.failed_stage, l.failed_stage); }
        }
        let mut result = conforming(&cycle, &e, &s);
        if result.is_ok() { result = same_witness(&cycle, &e, &s); }
        if let Err(what) = result {
            bad += 1;
            if bad < 12 || want.is_some() { println!("#{i} {} {what}\n", aim); }
        }
    }
    println!("{n} cases, {bad} bad, {mono} not monotone, near {near}/{sampled}");
    for (k, v) in verdicts { println!("{k:?}: {} near {}/{}", v[0], v[2], v[1]); }
}
