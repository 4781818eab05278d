//! The record is the model's own; its domain and the exact scene are compiled here.

pub use mufasa_model::input::{cycle, parameters, profile};

#[path = "../../../../model/src/input/domain.rs"]
pub mod domain;
#[path = "../../../../model/src/input/scene.rs"]
pub mod scene;
