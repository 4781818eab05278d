//! No attack is a stub: each changes what the CAV has, and none before its time.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;

use crate::digest::{FROM, Log, drive};

/// Routes and seeds of the scenarios.
const SCENARIOS: [(usize, u64); 3] = [(0, 0), (1, 1), (0, 2)];
/// Those that change nothing of what a CAV does, because what checks the link drops all of it.
const HARMLESS: [Kind; 1] = [Kind::Flood];

#[test]
fn every_attack_changes_what_the_cav_does_and_none_before_it_starts() {
    let clean = SCENARIOS.map(|it| drive::<Log>(Variant::Sofof, None, it, 20.0));
    for kind in Kind::ALL {
        let (mut has_effect, mut moves) = (false, false);
        for (scenario, (_, clean)) in SCENARIOS.into_iter().zip(&clean) {
            let (_, attacked) = drive::<Log>(Variant::Sofof, Some(kind), scenario, 20.0);
            let pairs = || clean.cycles.iter().zip(&attacked.cycles);
            let first = pairs().position(|(a, b)| a.1 != b.1);
            if let Some(first) = first {
                has_effect = true;
                assert!(clean.cycles[first].0 >= FROM, "{}: before it starts", kind.name());
            }
            moves |= clean.moves.iter().zip(&attacked.moves).any(|(a, b)| a != b);
        }
        println!("{:16} effect {has_effect}, moves {moves}", kind.name());
        assert!(has_effect, "{} is a stub", kind.name());
        assert!(moves || HARMLESS.contains(&kind), "{} moves nothing", kind.name());
    }
}
