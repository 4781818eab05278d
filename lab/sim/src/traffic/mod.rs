//! The others: vehicles that follow, stop and give way, and people who cross.
//!
//! Everybody, the ego too, is an agent on a route. An agent's acceleration is decided every 50 ms: that of
//! the driver model (`idm`) behind whoever is ahead in its corridor (`ahead`) and behind the stop line of
//! the next passage that it was not granted (`give_way`). The ego is granted passages like the others but
//! need not care; what it occupies, the others see.

pub mod agent;
pub mod ahead;
pub mod give_way;
pub mod idm;
pub mod start;
