//! The stop theorem (`findings/F-04.md`): a CAV that keeps as a transition system over the
//! reals, along its way, for every time. Its invariant is inductive: it holds at the start, and each transition
//! keeps it. `standing` and `lead` say of what, `drive` shows what happens without one of the assumptions.

pub mod drive;
pub mod lead;
pub mod motion;
pub mod standing;
pub mod system;
