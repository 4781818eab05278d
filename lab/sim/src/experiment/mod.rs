//! Experiments: many runs of one plan each, and tables of what came of them.
//!
//! Each has its own file, with the runs that it makes. What is kept of a run, and what is a row, is the same for all
//! (`kept`, `row`). The runs are made beside each other, but what comes of them stands in the order of the runs, so that a seed
//! gives the same bytes with any number of threads.

pub mod attacks;
pub mod availability;
pub mod axes;
pub mod checks;
pub mod combinations;
pub mod failures;
pub mod falsify;
pub mod job;
pub mod kept;
pub mod left_out;
pub mod made;
pub mod readings;
pub mod row;
pub mod scenes;
pub mod select;
pub mod stages;
pub mod watch;
