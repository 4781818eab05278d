//! Theorems over the reals, proved of the model's source and not of a copy.
//!
//! The files of `model/src` that compute are compiled here a second time, with the symbolic
//! numbers of [`real`] in the place of the model's exact ones: `crate::real::Real` is the only
//! thing that differs. Executing a formula then yields a polynomial, and a comparison that is not
//! decided by what is known forks the execution. Each path that can be reached becomes one question
//! to z3: is there a counterexample?

pub mod doubles;
pub mod gappa;
pub mod prove;
pub mod real;
pub mod solver;
pub mod theorem;
pub mod witness;

pub use mufasa_model::{configuration, cycle, parameters};

#[path = "../../model/src/assignment.rs"]
pub mod assignment;
#[path = "../../model/src/collision.rs"]
pub mod collision;
#[path = "../../model/src/detections.rs"]
pub mod detections;
#[path = "../../model/src/distance.rs"]
pub mod distance;
#[path = "../../model/src/grid.rs"]
pub mod grid;
#[path = "../../model/src/input.rs"]
pub mod input;
#[path = "../../model/src/map_validation.rs"]
pub mod map_validation;
#[path = "../../model/src/polygon.rs"]
pub mod polygon;
#[path = "../../model/src/rectangle.rs"]
pub mod rectangle;
#[path = "../../model/src/scene.rs"]
pub mod scene;
#[path = "../../model/src/schedule.rs"]
pub mod schedule;
#[path = "../../model/src/track_validation.rs"]
pub mod track_validation;
#[path = "../../model/src/tracks.rs"]
pub mod tracks;
#[path = "../../model/src/trajectory_rules.rs"]
pub mod trajectory_rules;
#[path = "../../model/src/vector.rs"]
pub mod vector;
#[path = "../../model/src/verdict.rs"]
pub mod verdict;
