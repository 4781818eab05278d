//! What the rules H-nn add to the stages (`spec/3-stages.md#hardened-profile`).

pub(crate) mod trajectory_rules;
