//! Drives: cycles made from recorded traffic, from maps, or read as records; attacks on them; and
//! the check of every cycle by model and implementation side by side, with pictures.

pub mod attacks;
pub mod check;
mod counts;
pub mod drive;
mod geometry;
pub mod options;
pub mod pictures;
pub mod progress;
pub mod readers;
mod recording;
mod spool;

pub use attacks::catalogue::Attack;
pub use attacks::error::InjectError;
pub use attacks::inject;
pub use attacks::injection::{Injection, ParseInjectionError};
pub use counts::counted;
pub(crate) use counts::seconds;
pub use drive::{Drive, DriveCycle, Stream};
pub use options::{GridSize, Options, Sensor, Tail};
pub use readers::error::{OtherLines, ReadError};
pub use readers::{demo, read, streams};

/// The drive of the demo, a `CommonRoad` scenario and its solution: names of the files and their text.
pub const DEMO: [(&str, &str); 2] = [
    ("urban.xml", include_str!("../data/demo/urban.xml")),
    ("urban.solution.xml", include_str!("../data/demo/urban.solution.xml")),
];
