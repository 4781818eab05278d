//! Proof harnesses: plain functions, each a statement about the implementation for every value of
//! a stated domain.
//!
//! CBMC checks those that are small enough, compiled to WebAssembly (`scripts/prove-wasm`); Kani takes those with `kani::proof` (`.github/workflows/kani.yml`).
//! `crate::kani` runs all of them on all or on random values, which is testing. What is expected of
//! each, and what was measured, is in `proofs/expected.toml`; what each is good for, in
//! `proofs/HARNESSES.md`.
#![allow(clippy::missing_panics_doc, reason = "a harness panics when its statement is false")]

pub mod actions;
pub mod any;
pub mod bitmap;
pub mod bounds;
pub mod configuration;
pub mod exact;
pub mod group;
mod items;
pub mod lists;
pub mod order;
pub mod pieces;
pub mod plain_distances;
pub mod quality_of_service;
pub mod requester;
pub mod scene;
mod seen;
pub mod session;
mod states;
pub mod table;
pub mod ticks;

/// Name and body of a harness.
pub type Harness = (&'static str, fn());

macro_rules! harnesses {
    ($($module:ident: $($name:ident)*;)*) => {
        /// All harnesses by their paths below this module.
        pub const ALL: &[Harness] = &[
            $($((concat!(stringify!($module), "::", stringify!($name)), $module::$name as fn()),)*)*
        ];
    };
}

harnesses! {
    actions:
        verify_actions_come_in_their_order;
    bitmap:
        verify_the_first_set_cell_of_a_row_is_found
        verify_a_free_row_has_no_set_cell
        verify_the_first_near_cell_is_found;
    configuration:
        verify_configurations_are_the_sets_of_groups;
    exact:
        verify_limbs_add_like_integers
        verify_four_limbs_add_like_integers
        verify_limbs_multiply_by_powers_of_two;
    group:
        verify_every_law_at_areas
        verify_every_law_at_verdicts
        verify_every_law_at_confirmations
        verify_every_law_at_rejections
        verify_every_law_at_data
        verify_a_session_left_is_released_at_areas
        verify_a_session_left_is_released_at_ticks
        verify_a_session_left_is_released_at_data
        verify_a_session_left_is_released_at_verdicts
        verify_a_group_becomes_remote_by_confirmation
        verify_the_other_group_is_untouched_at_confirmations
        verify_the_other_group_is_untouched_at_rejections
        verify_the_other_group_is_untouched_at_data
        verify_a_rejection_ends_a_request
        verify_data_of_another_session_are_dropped
        verify_a_group_depends_on_itself_alone_at_areas
        verify_a_group_depends_on_itself_alone_at_verdicts
        verify_a_session_left_is_released_at_withdrawals;
    lists:
        verify_a_route_is_checked
        verify_tracks_are_checked
        verify_detections_are_checked
        verify_a_trajectory_is_checked
        verify_a_lead_is_checked
        verify_a_grid_is_checked;
    order:
        verify_order_is_the_table
        verify_an_input_is_current_up_to_max_age;
    pieces:
        verify_points_examined_are_points
        verify_the_start_breaks_rules_of_the_start
        verify_gated_tracks_are_tracks;
    plain_distances:
        verify_s_b_is_bounded
        verify_s_cav_is_bounded
        verify_s_follow_is_at_least_s_cav
        verify_s_follow_is_bounded
        verify_s_follow_is_s_cav_at_equal_speeds
        verify_s_valid_has_two_cases
        verify_s_stop_is_bounded;
    quality_of_service:
        verify_latency_is_exact
        verify_silence_is_exact
        verify_arrivals_take_an_element;
    requester:
        verify_requester_starts_valid
        verify_a_station_below_1_is_refused
        verify_every_law_at_ticks
        verify_every_law_at_withdrawals
        verify_every_law_at_offers
        verify_a_session_left_is_released_at_offers
        verify_a_refused_offer_changes_nothing
        verify_an_error_is_told_as_unsafe
        verify_an_offer_is_taken_or_leaves_no_trace
        verify_the_station_asked_last_waits;
    session:
        verify_data_of_the_running_session_are_judged;
    table:
        verify_a_withdrawal_forgets_the_offer_alone
        verify_a_request_is_remembered
        verify_the_table_stays_valid_at_ticks
        verify_what_is_in_use_stays_offered_at_ticks
        verify_the_table_stays_valid_at_offers;
    ticks:
        verify_t_wait_bars_requests
        verify_a_request_goes_to_who_offers
        verify_what_is_not_due_stays_at_ticks;
}
