//! Drives: cycles made from recorded traffic, from maps, or read as records; attacks on them; and
//! the check of every cycle by model and implementation side by side, with pictures.

pub mod attacks;
pub mod check;
pub mod drive;
pub mod options;
pub mod pictures;
pub mod readers;
pub mod scene;

pub use attacks::error::{InjectError, ParseInjectionError};
pub use attacks::{Attack, Injection, inject};
pub use drive::{Drive, DriveCycle, PreviousTracks};
pub use options::{GridSize, Options, Sensor, Tail};
pub use readers::error::{OtherLines, ReadError};
pub use readers::read;

/// The drive of the demo, a `CommonRoad` scenario and its solution: names of the files and their text.
pub const DEMO: [(&str, &str); 2] = [
    ("urban.xml", include_str!("../data/demo/urban.xml")),
    ("urban.solution.xml", include_str!("../data/demo/urban.solution.xml")),
];
