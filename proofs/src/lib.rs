//! Laws of the implementation, and the exhaustive runs that prove them within stated bounds.

#[cfg(feature = "explore")]
pub mod explore;
pub mod law;
