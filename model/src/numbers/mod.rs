//! Exact reals, and what the stages decide with them.

pub mod assignment;
pub mod polygon;
pub mod real;
pub mod rectangle;
pub mod vector;
