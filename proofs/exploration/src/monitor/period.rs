//! What can happen in one period, and the times of the world.

use mufasa_model::input::cycle::{CrossSection, Route};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::settings::{Memory, Settings};
use mufasa_model::offloading::requester;

/// A period, ns. All times below are whole periods except tau, so that equal times occur.
pub const PERIOD_NS: i64 = 100_000_000;
/// `l_max`, periods.
pub const L_MAX: i64 = 1;
/// `dt_max`, periods: the least that is above one.
pub const DT_MAX: i64 = 2;
/// `max_age`, periods.
pub const MAX_AGE: i64 = 2;
/// Time in which a request is to be confirmed, periods.
pub const TIMEOUT: i64 = 3;
/// `t_wait`, periods: the least that a monitor takes, 1 s.
pub const T_WAIT: i64 = 10;
/// tau, ns.
pub const TAU_NS: i64 = 250_000_000;

/// The longest time without use that a session can end with, periods (MON-33).
pub const LONGEST: i64 = 2 * DT_MAX + 2;

/// What the station sends at the start of a period. Ages are periods.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sent {
    /// It is silent.
    Nothing,
    /// Generated and stamped now.
    Honest,
    /// Generated one period more than `l_max` ago.
    Late,
    /// Generated and stamped as long ago as is in time.
    JustInTime,
    /// Generated now, and stamped one period more than `max_age` ago.
    Stale,
    /// Generated now, and stamped a period ahead.
    Ahead,
    /// Generated when the last element used was.
    Repeated,
    /// Of a session that is not the running one.
    OtherSession,
}

/// What happens in a period: the station answers a request and sends, a tick, and a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(clippy::struct_excessive_bools, reason = "four things that happen or do not")]
pub struct Period {
    /// Whether the station takes its offer back, and offers again at once.
    pub withdraws: bool,
    /// Whether the station confirms a request that it has.
    pub confirms: bool,
    /// What it sends for the group.
    pub sent: Sent,
    /// Whether the vehicle gives the monitor a tick.
    pub ticks: bool,
    /// Whether the stages find the cycle safe.
    pub safe: bool,
}

impl Period {
    /// A period without a fault.
    pub const HONEST: Self =
        Self { withdraws: false, confirms: true, sent: Sent::Honest, ticks: true, safe: true };

    /// Everything that can happen in a period.
    pub const ALL: [Self; 20] = {
        const fn sent(sent: Sent, safe: bool) -> Period {
            Period { sent, safe, ..Period::HONEST }
        }
        [
            Self::HONEST,
            sent(Sent::Nothing, true),
            sent(Sent::Late, true),
            sent(Sent::JustInTime, true),
            sent(Sent::Stale, true),
            sent(Sent::Ahead, true),
            sent(Sent::Repeated, true),
            sent(Sent::OtherSession, true),
            sent(Sent::Honest, false),
            sent(Sent::Nothing, false),
            sent(Sent::JustInTime, false),
            sent(Sent::Ahead, false),
            sent(Sent::Stale, false),
            Self { confirms: false, ..Self::HONEST },
            Self { confirms: false, safe: false, ..Self::HONEST },
            Self { withdraws: true, ..Self::HONEST },
            Self { withdraws: true, safe: false, ..Self::HONEST },
            Self { ticks: false, ..Self::HONEST },
            Self { ticks: false, ..sent(Sent::Nothing, true) },
            Self { ticks: false, ..sent(Sent::Ahead, true) },
        ]
    };
}

/// The settings of the monitor in this world.
pub fn settings(profile: Profile) -> Settings {
    #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
    let tau = TAU_NS as f64 / 1e9;
    Settings {
        profile,
        parameters: Parameters { max_age_ns: MAX_AGE * PERIOD_NS, tau, ..Parameters::default() },
        requester: requester::Parameters {
            t_wait_ns: T_WAIT * PERIOD_NS,
            request_timeout_ns: TIMEOUT * PERIOD_NS,
            l_max_ns: L_MAX * PERIOD_NS,
            dt_max_ns: DT_MAX * PERIOD_NS,
            qos_hold: false,
        },
        period_ns: PERIOD_NS,
        last_session: 0,
        supervise_local: false,
        stall: None,
        memory: Memory { tracks: 1, detections: 1, cross_sections: 2 },
    }
}

/// A straight road: the stages do not look at it here.
pub fn route() -> Route {
    let cross_section = |x| CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] };
    Route { closed: false, cross_sections: vec![cross_section(0.0), cross_section(100.0)] }
}
