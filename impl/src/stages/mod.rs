//! The stages of the paper and their order (`spec/3-stages.md`). What stands here knows no rule of the
//! hardened profile: `cycle` puts both together.

pub(crate) mod distances;
pub(crate) mod horizon;
pub(crate) mod i_track_validation;
pub(crate) mod ii_trajectory_to_map;
pub(crate) mod iii_tracks;
pub(crate) mod iv_detections;
pub(crate) mod llcc;
pub mod order;
pub(crate) mod v_grid_map;
