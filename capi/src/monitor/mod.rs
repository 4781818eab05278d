//! `mufasa::monitor` for C: requester, earlier detections, route and the last elements that were
//! accepted live in memory of the caller. Remote data come out of `mufasa_monitor_cycle` alone.

mod calls;
mod decision;
mod element;
mod place;
mod problem;
mod settings;
mod state;

pub use self::calls::{
    mufasa_monitor_cycle, mufasa_monitor_init, mufasa_monitor_set_route, mufasa_monitor_step,
    mufasa_monitor_tracks, mufasa_monitor_trajectory,
};
pub use self::decision::{
    MufasaActions, MufasaAdvice, MufasaBrake, MufasaBrakeReason, MufasaDecision, MufasaDropReason,
};
pub use self::element::{MufasaTrackMessage, MufasaTrajectoryMessage};
pub use self::place::{
    MUFASA_MONITOR_ALIGN, MufasaMonitor, MufasaMonitorInputs, mufasa_monitor_bytes,
};
pub use self::problem::{mufasa_monitor_route_problem, mufasa_monitor_settings_problem};
pub use self::settings::{MufasaMonitorSettings, mufasa_monitor_settings_default};
pub use self::state::{mufasa_monitor_given_back, mufasa_monitor_state};
