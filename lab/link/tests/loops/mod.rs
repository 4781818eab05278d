//! Vehicle and station over channels, in a time that the test makes: the same every time.

mod clean;
mod faults;
mod forged;
mod told;
mod world;
