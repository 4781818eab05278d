//! What detectors, trackers and planners owe to physics; all else of them is in `pinned`.
// Sizes and counts are small; what is compared for equality is to be equal to the last bit.
#![allow(clippy::cast_precision_loss, clippy::float_cmp)]

mod detectors;
mod drive;
mod mot;
mod scene;
mod tpl;
