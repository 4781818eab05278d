//! The model's `numbers` with symbolic numbers in the place of its exact ones.

pub mod real;

#[path = "../../../../model/src/numbers/assignment.rs"]
pub mod assignment;
#[path = "../../../../model/src/numbers/cells.rs"]
pub mod cells;
#[path = "../../../../model/src/numbers/polygon.rs"]
pub mod polygon;
#[path = "../../../../model/src/numbers/polyline.rs"]
pub mod polyline;
#[path = "../../../../model/src/numbers/reading.rs"]
pub mod reading;
#[path = "../../../../model/src/numbers/rectangle.rs"]
pub mod rectangle;
#[path = "../../../../model/src/numbers/vector.rs"]
pub mod vector;
