//! The two profiles (`spec/3-stages.md#hardened-profile`).

/// The published method, or the published method with the rules H-nn. Source:
/// `spec/3-stages.md#hardened-profile`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Profile {
    /// The published method, read as the interpretations I-nn say.
    Paper,
    /// The published method and the rules H-nn.
    Hardened,
}
