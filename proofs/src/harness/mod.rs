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
pub mod monitor_arriving;
pub mod monitor_history;
pub mod monitor_limits;
pub mod monitor_memory;
pub mod monitor_released;
pub mod monitor_served;
pub mod order;
pub mod pieces;
pub mod plain_distances;
pub mod quality_of_service;
pub mod requester;
pub mod scene;
mod seen;
pub mod session;
mod states;
pub mod steps;
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
        verify_a_word_has_the_bits_from_a_place
        verify_a_word_ends_with_the_bitmap
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
        verify_a_group_depends_on_itself_alone_at_offers
        verify_a_group_depends_on_itself_alone_at_ticks
        verify_a_session_left_is_released_at_withdrawals;
    lists:
        verify_a_route_is_checked
        verify_tracks_are_checked
        verify_detections_are_checked
        verify_a_trajectory_is_checked
        verify_a_lead_is_checked
        verify_a_grid_is_checked;
    monitor_arriving:
        verify_a_message_is_accepted_exactly_when_it_is_of_use
        verify_the_reason_of_a_drop_is_the_first_that_holds
        verify_what_no_cycle_can_use_is_no_arrival;
    monitor_history:
        verify_no_list_of_the_last_second_is_lost
        verify_the_nearest_usable_lists_are_looked_at
        verify_half_a_second_was_seen_when_a_list_is_so_old;
    monitor_limits:
        verify_brake_by_is_tau_after_the_cycle
        verify_settings_are_refused_exactly_by_rule
        verify_the_remote_time_counts_where_the_cav_gets_nowhere;
    monitor_memory:
        verify_too_little_memory_is_refused
        verify_a_route_that_does_not_fit_is_refused
        verify_a_route_whose_index_does_not_fit_is_refused
        verify_a_route_is_kept_whole;
    monitor_released:
        verify_nothing_comes_out_of_an_unsafe_cycle
        verify_what_comes_out_is_current_and_of_a_remote_group
        verify_the_verdict_names_exactly_what_comes_out
        verify_detections_that_do_not_fit_are_an_error
        verify_an_element_is_the_last_one_used
        verify_a_tick_is_in_time_up_to_dt_max;
    monitor_served:
        verify_a_new_monitor_is_valid
        verify_the_monitor_stays_valid_at_areas
        verify_the_monitor_stays_valid_at_verdicts
        verify_the_monitor_stays_valid_at_confirmations
        verify_the_monitor_stays_valid_at_rejections
        verify_the_monitor_stays_valid_at_data
        verify_the_monitor_stays_valid_at_ticks
        verify_the_monitor_stays_valid_at_withdrawals
        verify_nobody_is_asked_before_half_a_second_was_seen
        verify_the_requester_hears_what_came_out
        verify_the_wait_is_nine_times_without_use
        verify_a_cycle_counts_what_was_of_use;
    order:
        verify_order_is_the_table
        verify_an_input_is_current_up_to_max_age;
    pieces:
        verify_points_examined_are_a_prefix
        verify_a_way_is_plainly_within_the_horizon
        verify_a_trajectory_starts_about_now
        verify_gated_tracks_are_tracks;
    plain_distances:
        verify_s_b_is_bounded
        verify_s_cav_is_bounded
        verify_s_follow_adds_to_s_cav
        verify_s_follow_is_the_sum
        verify_s_follow_is_exact_where_doubles_are
        verify_s_valid_has_two_cases
        verify_the_way_until_tau_is_bounded
        verify_s_stop_is_the_sum;
    quality_of_service:
        verify_latency_is_exact
        verify_silence_is_exact
        verify_arrivals_take_an_element;
    requester:
        verify_requester_starts_valid
        verify_a_time_below_0_is_refused
        verify_a_hold_is_never_shortened
        verify_a_station_below_1_is_refused
        verify_every_law_at_ticks
        verify_every_law_at_withdrawals
        verify_every_law_at_offers
        verify_a_session_left_is_released_at_offers
        verify_an_error_is_told_as_unsafe
        verify_an_offer_is_taken_or_leaves_no_trace
        verify_the_station_asked_last_waits;
    session:
        verify_data_of_the_running_session_are_judged;
    steps:
        verify_an_assignment_asks_for_no_more_costs_than_its_work
        verify_a_search_looks_at_each_item_at_most_once;
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
