//! Proof harnesses: plain functions, each a statement about the implementation for every value of
//! a stated domain.
//!
//! Three engines take them. Kani compiles them to a formula (`.github/workflows/kani.yml`). CBMC
//! checks them compiled to WebAssembly (`scripts/prove-wasm`). `crate::kani` runs them on all or
//! on random values, which is testing. What is expected of each, and what was measured, is in
//! `proofs/expected.toml`; what each is good for, in `proofs/HARNESSES.md`.
#![allow(clippy::missing_panics_doc, reason = "a harness panics when its statement is false")]

pub mod any;
pub mod assignment;
pub mod bounds;
pub mod configuration;
pub mod distance;
pub mod grid;
pub mod input;
pub mod qos;
pub mod requester;
pub mod scene;
pub mod schedule;
pub mod stages;
pub mod world;

/// Name and body of a harness.
pub type Harness = (&'static str, fn());

/// All harnesses by their paths below this module.
pub const ALL: [Harness; 32] = [
    ("assignment::verify_mean_cost_is_minimal", assignment::verify_mean_cost_is_minimal),
    ("assignment::verify_matched_cost_is_minimal", assignment::verify_matched_cost_is_minimal),
    (
        "configuration::verify_configurations_are_the_sets_of_groups",
        configuration::verify_configurations_are_the_sets_of_groups,
    ),
    ("distance::verify_s_follow_is_at_least_s_cav", distance::verify_s_follow_is_at_least_s_cav),
    ("distance::verify_s_follow_falls_with_v_lead", distance::verify_s_follow_falls_with_v_lead),
    ("distance::verify_gap_keeps_its_laws", distance::verify_gap_keeps_its_laws),
    ("distance::verify_s_valid_has_two_cases", distance::verify_s_valid_has_two_cases),
    (
        "grid::verify_paper_cells_include_their_borders",
        grid::verify_paper_cells_include_their_borders,
    ),
    (
        "grid::verify_hardened_cells_are_closed_squares",
        grid::verify_hardened_cells_are_closed_squares,
    ),
    ("input::verify_bad_number_is_never_safe", input::verify_bad_number_is_never_safe),
    ("input::verify_bad_structure_is_never_safe", input::verify_bad_structure_is_never_safe),
    ("qos::verify_latency_is_exact", qos::verify_latency_is_exact),
    ("qos::verify_silence_is_exact", qos::verify_silence_is_exact),
    ("qos::verify_arrivals_take_an_element", qos::verify_arrivals_take_an_element),
    ("requester::verify_requester_starts_valid", requester::verify_requester_starts_valid),
    (
        "requester::verify_requester_keeps_every_law_at_offers",
        requester::verify_requester_keeps_every_law_at_offers,
    ),
    (
        "requester::verify_requester_keeps_every_law_at_areas",
        requester::verify_requester_keeps_every_law_at_areas,
    ),
    (
        "requester::verify_requester_keeps_every_law_at_ticks",
        requester::verify_requester_keeps_every_law_at_ticks,
    ),
    (
        "requester::verify_requester_keeps_every_law_at_answers",
        requester::verify_requester_keeps_every_law_at_answers,
    ),
    (
        "requester::verify_requester_keeps_every_law_at_data",
        requester::verify_requester_keeps_every_law_at_data,
    ),
    (
        "requester::verify_requester_keeps_every_law_at_verdicts",
        requester::verify_requester_keeps_every_law_at_verdicts,
    ),
    ("requester::verify_fallback_ends_everything", requester::verify_fallback_ends_everything),
    ("requester::verify_hold_bars_requests", requester::verify_hold_bars_requests),
    (
        "requester::verify_requester_refuses_without_a_trace",
        requester::verify_requester_refuses_without_a_trace,
    ),
    ("schedule::verify_schedule_is_the_table", schedule::verify_schedule_is_the_table),
    ("stages::verify_stage_i_never_panics", stages::verify_stage_i_never_panics),
    ("stages::verify_stage_ii_never_panics", stages::verify_stage_ii_never_panics),
    ("stages::verify_stage_iii_never_panics", stages::verify_stage_iii_never_panics),
    ("stages::verify_stage_iv_never_panics", stages::verify_stage_iv_never_panics),
    ("stages::verify_stage_v_never_panics", stages::verify_stage_v_never_panics),
    ("stages::verify_index_changes_nothing", stages::verify_index_changes_nothing),
    ("stages::verify_stage_alone_says_the_same", stages::verify_stage_alone_says_the_same),
];
