//! Tests of the services, one by one and together.

mod clean;
mod control;
mod detectors;
mod drive;
mod env;
mod grid;
mod mot;
mod scene;
mod tpl;
