//! Empty track lists, by whose they are and how they come.

use mufasa::input::cycle::{Ego, Track};
use mufasa_link::message::{self, Frame, Payload};
use mufasa_sim::attack::means::{Comes, Lists};
use mufasa_sim::attack::{Attack, Attacker, Kind, Results};
use mufasa_sim::radio::{self, Radio, To};

const PERIOD_NS: i64 = 100_000_000;
const EGO: Ego = Ego {
    x: 0.0,
    y: 0.0,
    cos: 1.0,
    sin: 0.0,
    speed: 5.0,
    length: 4.5,
    width: 1.8,
    center_offset: 1.3,
};

fn attacker(lists: Lists, comes: Comes) -> Attacker<'static> {
    let mut attack = Attack::new(Kind::EmptyTracks, 0.0, 1e3, 3);
    (attack.means.lists, attack.means.comes) = (lists, comes);
    Attacker::new(vec![attack], None)
}

fn tracks() -> Vec<Track> {
    let track = |(id, x)| Track {
        id,
        x,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        vx: 0.0,
        vy: 0.0,
        length: 4.5,
        width: 1.8,
    };
    [(1, 20.0), (2, -50.0), (3, 30.0)].map(track).into()
}

fn ids(tracks: &[Track]) -> Vec<i64> {
    tracks.iter().map(|it| it.id).collect()
}

/// Ids of what the planner gets in each of so many periods.
fn believed(attacker: &Attacker<'_>, periods: i64) -> Vec<Vec<i64>> {
    let of = |period: i64| ids(&attacker.believed(period * PERIOD_NS, &EGO, &tracks()));
    (0..periods).map(of).collect()
}

/// Ids of what the CAV is sent in the place of a true list, and whether an empty one is sent beside it.
fn sent(attacker: &mut Attacker<'_>) -> (Vec<i64>, bool) {
    let mut results = Results { stamp_ns: 0, tracks: tracks(), points: Vec::new() };
    attacker.results(&EGO, &mut results);
    attacker.saw([Some(7), None]);
    let frame = Frame::new(484_000_000, 99_500_000, [0.0, 0.0]).expect("a frame");
    let mut radio = Radio::new(radio::Settings { loss: 0.0, ..radio::Settings::default() }, 0);
    attacker.forge(0, &frame, &mut radio);
    let mut forged = false;
    while let Some((_, to, bytes)) = radio.receive(10_000_000_000) {
        let payload = message::decode(&bytes, &frame).expect("it can be read").payload;
        let is_empty = matches!(&payload, Payload::Tracks { tracks, .. } if tracks.is_empty());
        forged |= to == To::Vehicle && is_empty;
    }
    (ids(&results.tracks), forged)
}

#[test]
fn each_list_is_spoiled_as_it_is_said_and_no_other() {
    let (all, none, far) = (vec![1, 2, 3], Vec::new(), vec![2]);
    for (comes, planner, cav) in [
        (Comes::Last, &none, (&all, true)),
        (Comes::Replaced, &none, (&none, false)),
        (Comes::Farthest, &far, (&far, false)),
    ] {
        for lists in [Lists::Planner, Lists::Cav, Lists::Both] {
            let mut attacker = attacker(lists, comes);
            let planner = if lists == Lists::Cav { &all } else { planner };
            let cav = if lists == Lists::Planner { (&all, false) } else { cav };
            let got = believed(&attacker, 50);
            assert!(got.iter().all(|it| it == planner), "{lists:?} {comes:?}: {got:?}");
            assert_eq!(sent(&mut attacker), (cav.0.clone(), cav.1), "{lists:?} {comes:?}");
        }
    }
}

#[test]
fn of_lists_between_the_true_ones_one_in_twenty_is_true_when_the_planner_plans() {
    let got = believed(&attacker(Lists::Planner, Comes::Interleaved), 4000);
    let is_true = got.iter().filter(|it| **it == [1, 2, 3]).count();
    assert_eq!(got.iter().filter(|it| it.is_empty()).count() + is_true, 4000);
    // 200 expected; the standard deviation is 14.
    assert!((140..260).contains(&is_true), "{is_true}");
    let (kept, forged) = sent(&mut attacker(Lists::Both, Comes::Interleaved));
    assert_eq!((kept, forged), (vec![1, 2, 3], true), "the CAV gets both");
}
