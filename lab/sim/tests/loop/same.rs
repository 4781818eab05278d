//! The same arguments give the same run.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;

use super::digest::{Log, drive};

#[test]
fn the_same_seed_gives_the_same_run() {
    for (variant, kind) in [
        (Variant::Sofof, Some(Kind::GhostTracks)),
        (Variant::Paper, Some(Kind::EmptyTracks)),
        (Variant::Hardened, None),
    ] {
        let [(first, a), (second, b)] = [(); 2].map(|()| drive::<Log>(variant, kind, (0, 3), 12.0));
        assert_eq!(first, second, "{variant:?}");
        assert_eq!(a.cycles, b.cycles, "{variant:?}");
        assert!(a.cycles.len() > 100, "{variant:?}: {} cycles", a.cycles.len());
    }
}

#[test]
fn another_seed_gives_another_run() {
    let (_, a) = drive::<Log>(Variant::Sofof, None, (0, 3), 3.0);
    let (_, b) = drive::<Log>(Variant::Sofof, None, (0, 4), 3.0);
    assert_ne!(a.cycles, b.cycles);
}
