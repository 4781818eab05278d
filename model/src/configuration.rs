//! Which groups of services run where (`spec/1-services.md#configurations`).

/// The four configurations of a CAV.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Configuration {
    /// Everything on station 0.
    Local,
    /// MOT remote, ENV and TPL local.
    MotRemote,
    /// MOT, ENV and TPL remote.
    AllRemote,
    /// MOT local, ENV and TPL remote.
    PlanRemote,
}
