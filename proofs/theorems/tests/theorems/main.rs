//! Every theorem, except a long one, is proved and its wrong variant refuted, where z3 is there.

mod rounding;
#[cfg(unix)]
mod solver;

use std::collections::BTreeSet;

use mufasa_theorems::claim::Decision;
use mufasa_theorems::prove::judge;
use mufasa_theorems::{doubles, gappa, theorem};
use rayon::prelude::*;

/// It takes a quarter of the time of all. `.ci/run` proves it once, by `mufasa prove`.
const LONG: &str = "the_motion_of_a_confirmed_track_is_examined_whatever_the_track_says";

#[test]
fn theorems_are_proved_and_their_wrong_variants_refuted() {
    if !mufasa_theorems::solver::is_new_enough() {
        println!("NOT RUN: no z3 4.8 here");
        return;
    }
    let (long, others): (Vec<_>, Vec<_>) = theorem::all().partition(|theorem| theorem.id == LONG);
    assert_eq!(long.len(), 1, "{LONG}");
    println!("NOT RUN: {LONG}, which `mufasa prove` proves");
    others.par_iter().with_max_len(1).for_each(|theorem| {
        let judgement = judge(theorem).expect("z3 answers");
        println!("{}: {} paths, {:.1?}", theorem.id, judgement.paths, judgement.time);
        assert_eq!(*judgement.decision(), Decision::Proved, "{}: {judgement:?}", theorem.id);
    });
}

#[test]
fn every_bound_is_proved_and_a_smaller_one_is_not() {
    let Some(version) = gappa::version() else {
        println!("NOT RUN: no Gappa here");
        return;
    };
    println!("{version}");
    for bound in &gappa::BOUNDS {
        let (decision, time) = bound.judge().expect("Gappa runs");
        println!("{}: {time:.1?}", bound.id);
        assert_eq!(decision, Decision::Proved, "{}", bound.id);
    }
}

#[test]
fn every_range_is_proved_and_its_wrong_variant_refuted() {
    let Some(version) = doubles::version() else {
        println!("NOT RUN: no bitwuzla here");
        return;
    };
    println!("bitwuzla {version}");
    for range in &doubles::RANGES {
        let judgement = range.judge().expect("bitwuzla runs");
        println!("{}: {judgement:?}", range.id);
        assert_eq!(*judgement.decision(), Decision::Proved, "{}", range.id);
        let Decision::Refuted(values) = judgement.control else { panic!("{}", range.id) };
        let names: Vec<&str> = values.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["v_now", "v_lead", "a_b", "safety_time"], "the values are read");
        assert!(values.iter().all(|(_, value)| (0.0..=150.0).contains(value)), "{values:?}");
    }
}

#[test]
fn the_scripts_are_the_steps_of_the_source() {
    let [_, s_b, s_follow] = &gappa::BOUNDS;
    let expected = "@rnd = float<ieee_64, ne>;
a_b = rnd(a_b_);
v = rnd(v_);
t1 rnd= v * v;
t2 rnd= 2 * a_b;
t3 rnd= t1 / t2;
T1 = v * v;
T2 = 2 * a_b;
T3 = T1 / T2;
{ a_b in [1, 12]
  /\\ v in [0, 70]
  -> |t3 - T3| <= 4.6e-13 }
";
    assert_eq!(s_b.scripts("4.6e-13"), [expected]);
    let scripts = s_follow.scripts("1.5e-12");
    assert_eq!(scripts.len(), 2, "the difference of the braking distances, and all of it");
    println!("{}", scripts.join("\n"));
}

#[test]
fn ids_are_unique() {
    let ids: BTreeSet<&str> = theorem::all().map(|theorem| theorem.id).collect();
    assert_eq!(ids.len(), theorem::all().count());
}
