//! Tests of the closed loop: the link, the CAV, the station, the attacks, and what is made of a run.
#![allow(clippy::cast_precision_loss, reason = "counts are small")]

mod attacks;
mod digest;
mod empty;
mod guard;
mod late;
mod lies;
mod precheck;
mod radio;
mod records;
mod replay;
mod same;
mod services;
