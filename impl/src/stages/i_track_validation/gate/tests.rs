use std::vec;
use std::vec::Vec;

use super::{Places, gated_tracks};
use crate::input::cycle::{Detection, Track};
use crate::input::scratch::Row;
use crate::random::Random;

fn detection([x, y]: [f64; 2]) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 1.0, width: 1.0 }
}

fn track([x, y]: [f64; 2]) -> Track {
    Track { id: 0, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 1.0, width: 1.0 }
}

/// Places on a small lattice, many of them equally far, some of them off by a few ulps, so
/// that doubles find the wrong one farther; integers do not.
#[test]
fn the_gate_is_exact() {
    const ULP: f64 = 1.0 / 4_503_599_627_370_496.0;
    let mut random = Random::new(5);
    let (mut equal, mut next) = (0, 0);
    for _ in 0..5_000 {
        let mut coordinate = || (i128::from(random.below(4)), i128::from(random.below(9)) - 4);
        let mut place = || [coordinate(), coordinate()];
        let float = |(whole, ulps): (i128, i128)| 1.0 + whole as f64 / 4.0 + ulps as f64 * ULP;
        let squared = |place: [(i128, i128); 2]| -> i128 {
            let integer = |(whole, ulps): (i128, i128)| (1 << 52) + (whole << 50) + ulps;
            place.map(integer).iter().map(|it| it * it).sum()
        };
        let tracks: Vec<_> = (0..6).map(|_| place()).collect();
        let detections: Vec<_> = (0..4).map(|_| place()).collect();
        let farthest = detections.iter().map(|&it| squared(it)).max().unwrap_or(0);
        let expected: Vec<_> = (0..6).filter(|&it| squared(tracks[it]) <= farthest).collect();
        for &it in &tracks {
            let off = (squared(it) - farthest).abs();
            equal += u32::from(off == 0);
            next += u32::from(off > 0 && off < 1 << 57);
        }
        let of = |place: [(i128, i128); 2]| place.map(float);
        let tracks: Vec<_> = tracks.into_iter().map(|it| track(of(it))).collect();
        let detections: Vec<_> = detections.into_iter().map(|it| detection(of(it))).collect();
        let mut rows = vec![Row::default(); 6];
        let places = Places::standing(&tracks);
        let gated = gated_tracks([0.0; 2], &places, &detections, &mut rows);
        let found: Vec<_> = rows[..gated].iter().map(|row| usize::from(row.track)).collect();
        assert_eq!(found, expected);
    }
    assert!(equal > 30 && next > 500, "{equal} {next}");
}
