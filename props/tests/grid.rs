//! Stage v of the implementation against the exact model
//! (`spec/3-stages.md#stage-v-trajectory-with-grid-map`, H-04, H-06).

use mufasa_model::input::cycle::Profile;
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::grid;

#[test]
fn paper() {
    agree("stage v", Profile::Paper, grid::cycle, near_threshold).assert_aimed(&["v", "safe"]);
}

#[test]
fn hardened() {
    agree("stage v", Profile::Hardened, grid::cycle, near_threshold).assert_aimed(&["v", "safe"]);
}
