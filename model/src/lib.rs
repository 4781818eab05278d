//! MUFASA as an executable specification: exact, plain, read beside the paper.

pub mod assignment;
pub mod collision;
pub mod composition;
pub mod configuration;
pub mod cycle;
pub mod detections;
pub mod distance;
pub mod grid;
pub mod input;
pub mod map_validation;
pub mod orchestrator;
pub mod parameters;
pub mod polygon;
pub mod provider;
pub mod qos;
pub mod real;
pub mod rectangle;
pub mod requester;
pub mod scene;
pub mod schedule;
pub mod service;
pub mod track_validation;
pub mod tracks;
pub mod trajectory_rules;
pub mod vector;
pub mod verdict;
