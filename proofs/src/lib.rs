//! Laws of the implementation, and the exhaustive runs that prove them within stated bounds.

pub mod law;
