//! The inner rectangle of H-14 (`spec/hardened/H-14.md#requirements-not-examined`), on both sides of each side of it.

use crate::fail_safe::{AGE, BESIDE, FRONT, met, moving, with};
use mufasa::input::cycle::Track;

/// Who touches a side or the rear of a CAV that stands does so whatever the CAV does: less b alone there,
/// min(0.3 m, `s_b(v)`), but 0.3 m at the front. All that is here comes after T and before `H(w)`.
#[test]
fn who_touches_a_standing_cav_comes_across_but_at_its_front() {
    let met_at = |v: f64, track: Track| {
        let mut scene = with(vec![track]);
        scene.ego.speed = v;
        met(&scene)
    };
    // The front is reached after a second, so far inside of the left side or of the right one.
    let oncoming = |side: f64, inside: f64| {
        moving(FRONT + 4.0 * (1.0 + AGE), side * (BESIDE - inside), [-4.0, 0.0])
    };
    // From the right, so far inside of the front, 3.65 m, or of the rear, -0.85 m.
    let crossing = |x: f64| Track {
        cos: 0.0,
        sin: 1.0,
        ..moving(x, -0.95 - 2.0 - 6.0 * (1.0 + AGE), [0.0, 6.0])
    };
    let front = |inside: f64| crossing(3.65 - inside + 1.0);
    let rear = |inside: f64| crossing(-0.85 + inside - 1.0);
    for side in [1.0, -1.0] {
        assert!(!met_at(0.0, oncoming(side, 0.1)) && met_at(3.0, oncoming(side, 0.1)));
        for (v, b) in [(0.0, 0.0), (1.6, 0.16), (3.0, 0.3)] {
            assert!(!met_at(v, oncoming(side, b + 2e-9)), "{v}");
            // At v = 0 it does not touch the CAV any more.
            assert_eq!(met_at(v, oncoming(side, b - 2e-9)), v > 0.0, "{v}");
        }
    }
    for v in [0.0, 1.6] {
        assert!(met_at(v, front(0.1)), "{v}");
        assert!(met_at(v, front(0.3 - 2e-9)) && !met_at(v, front(0.3 + 2e-9)), "{v}");
    }
    // At 1.6 m/s it may stand from the second place on.
    assert!(!met_at(0.0, rear(0.1)) && !met_at(0.0, rear(2e-9)) && met_at(1.6, rear(0.1)));
    assert!(met_at(1.6, rear(0.16 - 2e-9)) && !met_at(1.6, rear(0.16 + 2e-9)));
}
