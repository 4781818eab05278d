//! MUFASA as an executable specification: exact, plain, read beside the paper.
//!
//! | paper | here |
//! |---|---|
//! | Sec. III, Def. 1 (service, Eq. (1)), Def. 2 (device switch) | [`services::service`] |
//! | Sec. III, service composition; orchestrator | [`services::composition`], [`services::orchestrator`] |
//! | Sec. IV-A, Table I, configurations | [`services::configuration`] |
//! | Sec. IV-A, Fig. 3, order of the stages | [`stages`] |
//! | Sec. IV-B, Eq. (2), stage i | [`stages::i_track_validation`] |
//! | Sec. IV-C, stage ii | [`stages::ii_trajectory_to_map`] |
//! | Sec. IV-D, Eq. (3), stage iii | [`stages::iii_tracks`], [`stages::distances`] |
//! | Sec. IV-D, LLCC | [`stages::llcc`] |
//! | Sec. IV-D, points within a safety distance | [`stages::horizon`] |
//! | Sec. IV-E, Eq. (4) to (6), stage iv | [`stages::iv_detections`], [`stages::distances`] |
//! | Sec. IV-F, stage v, dilated grid | [`stages::v_grid_map`] |
//! | Sec. IV-A, t_wait; Sec. III, requester and provider | [`offloading::requester`], [`offloading::provider`] |
//! | Sec. V, Eq. (7), l_max and dt_max | [`offloading::quality_of_service`] |
//! | Table II, parameters | [`input::parameters`], [`offloading::requester::Parameters`] |
//!
//! The rules change the stages from outside: [`cycle`] decides a cycle of a profile.
//!
//! | rule | here |
//! |---|---|
//! | H-01 | [`hardened::h01_matched_pairs`] |
//! | H-02, H-05, H-10 | [`hardened::h02_h05_h10_schedule`] |
//! | H-04 | [`cycle`] (places of stage v), [`hardened::h04_gap`] |
//! | H-06 | [`hardened::h06_closed_cells`] |
//! | H-07 | [`hardened::h07_start`] |
//! | H-08 | [`offloading::requester`] |
//! | H-11 | [`hardened::h11_steps`] |
//! | H-14 | [`hardened::h14_fail_safe`] |
//! | what the CAV saw itself | [`hardened::detection_history`] |
//! | strict, exact and lax reading (`spec/4-arithmetic.md`) | [`numbers::reading`] |
//! | the monitor that a vehicle calls (`spec/monitor.md`) | [`monitor`] |
//! | how much the model computes | [`work`] |

pub mod cycle;
pub mod hardened;
pub mod input;
pub mod monitor;
pub mod numbers;
pub mod offloading;
pub mod report;
pub mod services;
pub mod stages;
pub mod work;
