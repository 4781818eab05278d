//! `spec/2-offloading.md#requester`: confirmations, rejections, deadlines.

use mufasa_model::offloading::requester::Group::Mot;
use mufasa_model::offloading::requester::GroupState;

use crate::{Cav, MOT, TICK, offer, release};

/// FALL-09
#[test]
fn deadlines_saturate_at_the_limits_of_64_bits() {
    let mut cav = Cav::paper();
    cav.at(0, offer(1, MOT));
    cav.at(i64::MAX - 1, TICK);
    let saturated = GroupState::Requested { station: 1, session: 1, deadline_ns: i64::MAX };
    assert_eq!(cav.model().state(Mot), saturated);
    cav.ignores(i64::MAX - 1, TICK);
    cav.ignores(i64::MIN, TICK);
    assert_eq!(cav.at(i64::MAX, TICK), [release(1, Mot, 1)]);
}
