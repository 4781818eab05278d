//! Every theorem, except a long one, is proved and its wrong variant refuted, where z3 is there.

#[cfg(unix)]
mod solver;

use std::collections::BTreeSet;

use mufasa_theorems::claim::Decision;
use mufasa_theorems::prove::judge;
use mufasa_theorems::theorem;
use rayon::prelude::*;

/// They take minutes. `mufasa prove` proves them, at night.
const LONG: [&str; 1] =
    ["the_motion_of_a_detection_that_every_list_shows_is_examined_whatever_tracks_say"];

#[test]
fn theorems_are_proved_and_their_wrong_variants_refuted() {
    if !mufasa_theorems::solver::is_new_enough() {
        println!("NOT RUN: no z3 4.8 here");
        return;
    }
    let (long, others): (Vec<_>, Vec<_>) =
        theorem::all().partition(|theorem| LONG.contains(&theorem.id));
    assert_eq!(long.len(), LONG.len());
    for id in LONG {
        println!("NOT RUN: {id}, which `mufasa prove` proves");
    }
    others.par_iter().with_max_len(1).for_each(|theorem| {
        let judgement = judge(theorem).expect("z3 answers");
        println!("{}: {} paths, {:.1?}", theorem.id, judgement.paths, judgement.time);
        if let Some(drive) = judgement.drive() {
            println!("false: {}\n{drive}", theorem.wrong.statement);
        }
        assert_eq!(*judgement.decision(), Decision::Proved, "{}: {judgement:?}", theorem.id);
    });
}

#[test]
fn ids_are_unique() {
    let ids: BTreeSet<&str> = theorem::all().map(|theorem| theorem.id).collect();
    assert_eq!(ids.len(), theorem::all().count());
}
