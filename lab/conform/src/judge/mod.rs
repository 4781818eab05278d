//! The exact answer, the answer given, and what breach there is between them.

pub mod answer;
pub mod class;
pub mod examine;
pub mod explain;
pub mod norm;
pub mod states;
