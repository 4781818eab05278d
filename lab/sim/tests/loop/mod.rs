//! Tests of the closed loop: the CAV, the station, the attacks, and what is made of a run.
#![allow(clippy::cast_precision_loss, reason = "counts are small")]

mod drive;
mod guard;
mod late;
mod precheck;
mod records;
mod replay;
mod services;
