//! Exact reals, their comparison in the three readings, and the geometry and the assignment that the
//! stages decide with.

pub mod assignment;
pub mod cells;
pub mod polygon;
pub mod polyline;
pub mod reading;
pub mod real;
pub mod rectangle;
pub mod vector;
