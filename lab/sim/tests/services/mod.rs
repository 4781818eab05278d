//! Tests of the services, one by one and together.
// Sizes and counts are small; what is compared for equality is to be equal to the last bit.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    clippy::float_cmp
)]

mod clean;
mod control;
mod detectors;
mod drive;
mod env;
mod give_way;
mod grid;
mod mot;
mod scene;
mod tpl;
