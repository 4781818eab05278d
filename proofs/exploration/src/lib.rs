//! The offloading protocol as one distributed system, explored state by state
//! (`spec/2-offloading.md#properties-of-the-whole-protocol`).
//!
//! * `bounds`: every bound with its reason.
//! * `mufasa_props::refine`: the model's and the implementation's requester, step by step.
//! * `automaton`, `cav`, `station`: the real parts as finite automata, and why that loses nothing.
//! * `state`, `flight`, `moves`, `possible`, `system`: the whole system.
//! * `properties`, `observer`: what has to hold, judged from outside.
//! * `search`, `lasso`, `runs`: the exact search, and the search for endless runs.
//! * `replay`: traces walked with real numbers and times; `words`: states and moves in words.
//! * `monitor`: the monitor, whose cycles an adversary decides.
//! * `run`: a world explored, with the verdict of every property.

pub mod automaton;
pub mod bounds;
pub mod cav;
mod fit;
mod flight;
pub mod lasso;
pub mod monitor;
pub mod moves;
pub mod observer;
mod possible;
pub mod properties;
pub mod replay;
pub mod run;
pub mod runs;
pub mod search;
pub mod state;
pub mod station;
pub mod stimulus;
pub mod system;
pub mod words;
