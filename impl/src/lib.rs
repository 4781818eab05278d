//! A safety monitor for vehicles that let a remote server do their tracking and their trajectory
//! planning: MUFASA (Dehler, Schumann, Ruof, Buchholz, ITSC 2025) with the rules that close its gaps.
//! `no_std`, no heap, no clock, no `unsafe` of its own, and no panics, which lints forbid and tests look for; of few
//! parts it is proved (`proofs/HARNESSES.md`).
//!
//! [`Monitor`](monitor::Monitor) is what a vehicle uses: it takes what happens and what was measured,
//! decides each cycle by the five stages, falls back to the local services when one of them fails, and
//! hands out what a station sent only in a cycle that is safe.
//!
//! # A vehicle loop
//!
//! With a stand-in for the station, which answers at once: when the CAV has seen what is around for half
//! a second both groups are asked for, and what comes of them is driven once it is checked. With a drive
//! and a station that goes wrong: `examples/vehicle.rs`.
//!
//! ```
//! use std::time::Duration;
//!
//! use mufasa::input::cycle::{CrossSection, Detection, Ego, Route, Track, TrajectoryPoint};
//! use mufasa::input::detection_index::Slot;
//! use mufasa::input::route_index::Block;
//! use mufasa::input::scratch::{Column, Row};
//! use mufasa::monitor::{Arrival, Decision, Inputs, Memory, Message, Monitor, Settings, Time};
//! use mufasa::offloading::requester::{Action, Group, Groups, StationRecord};
//!
//! let settings = Settings::new(Duration::from_millis(50));
//! // Two periods and 20 ms of jitter: one lost message ends no session.
//! assert_eq!(settings.requester.dt_max_ns, 120_000_000);
//! // From `now` of a cycle to braking with `a_b`: `tau` has 0.1 s for the brake of this vehicle.
//! assert_eq!(settings.stages.tau, 0.25);
//! let memory = Memory {
//!     stations: &mut [StationRecord::FREE; 4],
//!     rows: &mut vec![Row::default(); 64],
//!     columns: &mut vec![Column::default(); 68],
//!     detections: &mut vec![Detection::default(); Memory::detections_for(64)],
//!     slots: &mut vec![Slot::default(); Memory::slots_for(64)],
//!     cross_sections: &mut vec![CrossSection::default(); 528],
//!     blocks: &mut vec![Block::default(); Block::needed(528)],
//! };
//! let mut monitor = Monitor::new(settings, memory)?;
//! let at = |x| CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] };
//! monitor.set_route(&Route { closed: false, cross_sections: &[at(-10.0), at(90.0)] })?;
//!
//! // The CAV stands, a parked car is beside it, and the plan is to stay.
//! let ego = Ego {
//!     x: 0.0, y: 0.0, cos: 1.0, sin: 0.0, speed: 0.0, length: 4.5, width: 1.9, center_offset: 1.4,
//! };
//! let parked = Detection { x: 3.0, y: 5.0, cos: 1.0, sin: 0.0, length: 4.5, width: 1.9 };
//! let mut driven_as_verified = 0;
//! // The last of each that was accepted stays until a newer one comes: it bridges a lost message while it is current.
//! let (mut tracks, mut trajectory) = (None, None);
//! for period in 0..30 {
//!     let now = Time::from_milliseconds(50 * period)?;
//!
//!     // Events in, actions out. A real loop sends requests and releases to their stations, and starts
//!     // and stops its own services; this one answers its own requests.
//!     if period == 0 {
//!         let actions = monitor.offer(now, 1, Groups::ALL)?;
//!         assert!(actions.is_empty());
//!     }
//!     let asked = monitor.tick(now);
//!     for action in &asked {
//!         if let Action::Request { station, group, session } = *action {
//!             let actions = monitor.confirm(now, station, group, session)?;
//!             assert!(actions.is_empty(), "local services go on until a safe cycle (H-08)");
//!         }
//!     }
//!     let [mot, plan] = Group::ALL.map(|group| monitor.requester().session_of(group));
//!     if let Some(session) = mot.map(|running| running.session) {
//!         let Detection { x, y, cos, sin, length, width } = parked;
//!         let items = vec![Track { id: 1, x, y, cos, sin, vx: 0.0, vy: 0.0, length, width }];
//!         let message = Message { station: 1, session, generated: now, stamp: now, items };
//!         match monitor.tracks(now, message)? {
//!             (Arrival::Accepted(element), _none) => tracks = Some(element),
//!             (Arrival::Dropped { why }, actions) => panic!("{why}, to be done: {actions:?}"),
//!         }
//!     }
//!     if let Some(session) = plan.map(|running| running.session) {
//!         let t_ns = now.as_nanoseconds();
//!         let items = vec![TrajectoryPoint { t_ns, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 }];
//!         let message = Message { station: 1, session, generated: now, stamp: now, items };
//!         match monitor.trajectory(now, message)? {
//!             (Arrival::Accepted(element), _none) => trajectory = Some(element),
//!             (Arrival::Dropped { why }, actions) => panic!("{why}, to be done: {actions:?}"),
//!         }
//!     }
//!
//!     // What the CAV measured itself, and what it accepted: the cycle decides.
//!     let detections = [parked];
//!     let mut inputs = Inputs::new(now, ego).detections(now, &detections);
//!     if let Some(tracks) = &tracks {
//!         inputs = inputs.remote_tracks(tracks);
//!     }
//!     if let Some(trajectory) = &trajectory {
//!         inputs = inputs.remote_trajectory(trajectory);
//!     }
//!     // Whatever it decides, local services start or stop, and releases are sent.
//!     let (decision, actions) = monitor.cycle(&inputs);
//!     match decision {
//!         Decision::Safe { trajectory: Some(trajectory), .. } => {
//!             // Only here is there a trajectory of the station to be driven.
//!             assert_eq!(trajectory.points.len(), 1);
//!             driven_as_verified += 1;
//!         }
//!         Decision::Safe { trajectory: None, .. } => {
//!             // In `Local` the local planner is followed. Else nothing current was there to be checked, or the
//!             // CAV has no current detections: a copy of what it followed last, and by its `brake_by` it brakes.
//!         }
//!         Decision::Unsafe { report, .. } => {
//!             // Nothing of the station is used. From the next cycle on the CAV's own plan is driven; until its
//!             // planner, which was just told to start, has one, that copy, by its `brake_by` braking.
//!             panic!("{report:?}, to be done: {actions:?}");
//!         }
//!     }
//!     // What this program seems to get wrong: for a log that somebody reads.
//!     assert_eq!(monitor.advice(), None);
//! }
//! assert_eq!(driven_as_verified, 20);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Assumptions of use
//!
//! * Detections, lead, grid, pose and speed are the CAV's own and right; what they do not see, only the
//!   remote knows (`findings/README.md`, F-33, F-39). The route is right.
//! * All times are of one monotonic clock ([`monitor::Time`]); the stations' clocks are synchronised with
//!   it. All places are in one right-handed frame (`spec/5-interfaces.md#cycle`).
//! * `tick` and `cycle` are called in each period, offloading or not, and every action is taken.
//! * Control follows the trajectory of a safe decision, and the local planner's at cycles in `Local`; else a copy of what
//!   it followed last. By the `brake_by` of that, `tau` after its cycle, control brakes along it with at least `a_b`
//!   (F-47, F-61); such a manoeuvre is within its reach and that of the local services.
//! * Messages come from who they say: signatures are checked before, by whoever receives them.
//! * A verdict is as good as the method: some findings are open in the hardened profile
//!   (`docs/known-problems.md`). Nothing here is certified.
//!
//! # Where things are
//!
//! | `spec/` | here |
//! |---|---|
//! | `monitor.md#monitor` | [`monitor`] |
//! | `5-interfaces.md#precheck` | [`provider`] |
//! | `3-stages.md#schedule` | [`cycle`] |
//! | stage i to stage v, without a rule | `stages::{i_track_validation, .., v_grid_map}` |
//! | `3-stages.md#distances`, LLCC | `stages::{distances, horizon, llcc}` |
//! | `3-stages.md#invalid-input` | `input::domain` |
//! | the rules H-nn | `hardened`, a file for each rule or group of rules |
//! | `5-interfaces.md#cycle` | [`input::cycle`], [`report`] |
//! | `2-offloading.md` | [`offloading::requester`], [`offloading::quality_of_service`] |
//! | `1-services.md#configuration` | [`services::configuration`] |
//! | `4-arithmetic.md` | `numbers` |
//!
//! Numbers are IEEE 754 doubles with bounds on their errors, so that rounding does not accept what
//! the exact model rejects (`spec/4-arithmetic.md#conformance-of-an-implementation`). The bounds
//! are argued where they stand and tested against exact arithmetic; they are not proved by machine.
//! Fast paths are submodules of their stage: what they cannot decide is left to the numbers with
//! bounds.
// IMPL-07
#![no_std]
// Tests may panic: that is how they fail. Their sizes and draws are small.
#![cfg_attr(
    test,
    allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_precision_loss,
        clippy::cast_sign_loss
    )
)]
// IMPL-07, INPUT-08
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::indexing_slicing,
        clippy::panic,
        clippy::arithmetic_side_effects
    )
)]

pub mod cycle;
pub mod input;
pub mod monitor;
pub mod offloading;
#[cfg(feature = "parts")]
#[doc(hidden)]
pub mod parts;
pub mod provider;
pub mod report;
pub mod services;

mod hardened;
mod numbers;
mod stages;

#[cfg(test)]
extern crate std;

#[cfg(test)]
mod random;
