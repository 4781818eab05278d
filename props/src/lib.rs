//! What the model and the implementation have to agree on: the only conversion between their
//! types, the rule of conformance, and generators that aim at the thresholds.

pub mod bridge;
pub mod call;
pub mod conformance;
pub mod differential;
pub mod lent;
pub mod refine;
pub mod strategy;
