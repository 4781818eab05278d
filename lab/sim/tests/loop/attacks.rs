//! No attack is a stub: each changes what the CAV has, and none before its time.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;

use super::digest::{FROM, Log, drive};

/// Routes and seeds of the scenarios.
const SCENARIOS: [(usize, u64); 3] = [(0, 0), (1, 1), (0, 2)];
/// Those after which SOFOF drives as before: a flood is dropped, and long lists cost time that a run does
/// not know.
const HARMLESS: [Kind; 2] = [Kind::Flood, Kind::Slow];

#[test]
fn every_attack_changes_what_the_cav_does_and_none_before_it_starts() {
    let clean = |variant| SCENARIOS.map(|it| drive::<Log>(variant, None, it, 32.0));
    let (sofof, hardened) = (clean(Variant::Sofof), clean(Variant::Hardened));
    let mut stubs = Vec::new();
    for kind in Kind::IN_THE_LOOP {
        let (mut has_effect, mut moves) = (false, false);
        // SOFOF asks no stamp.
        let (variant, clean) = match kind {
            Kind::StampsAhead => (Variant::Hardened, &hardened),
            _ => (Variant::Sofof, &sofof),
        };
        for (scenario, (_, clean)) in SCENARIOS.into_iter().zip(clean) {
            let (_, attacked) = drive::<Log>(variant, Some(kind), scenario, 32.0);
            let pairs = || clean.cycles.iter().zip(&attacked.cycles);
            let first = pairs().position(|(a, b)| a.1 != b.1);
            if let Some(first) = first {
                has_effect = true;
                assert!(clean.cycles[first].0 >= FROM, "{}: before it starts", kind.name());
            }
            moves |= clean.moves.iter().zip(&attacked.moves).any(|(a, b)| a != b);
            if has_effect && moves {
                break;
            }
        }
        println!("{:16} effect {has_effect}, moves {moves}", kind.name());
        if !has_effect || moves == HARMLESS.contains(&kind) {
            stubs.push((kind.name(), has_effect, moves));
        }
    }
    assert_eq!(stubs, [], "name, whether the CAV notices, whether it drives otherwise");
}
