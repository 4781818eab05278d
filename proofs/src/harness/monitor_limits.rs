//! Times and limits of the monitor: until when a trajectory is covered, which settings there are, and where planning gets
//! nowhere (`spec/monitor.md#monitor`).

use core::time::Duration;

use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::monitor::{Settings, Stall};
use mufasa::offloading::requester;
use mufasa::parts::monitor::{brake_by, get_on};

use super::any::{
    below, duration_ns, integer_within, near, near_integer, option, profile, same_number, time_ns,
    within,
};
#[cfg(not(kani))]
use crate::kani;

/// In the hardened profile `brake_by` is `tau` after the cycle: the double `tau` times 10^9 rounded down, so never later
/// than that, nor sooner by 1 ns or more; where 64 bits end it saturates. Of two cycles the later one does not have the
/// earlier one. In the paper profile there is none [MON-40, MON-41].
///
/// Domain: each `tau` of the domain (0 to 60 s), all times of 64 bits, both profiles. Not covered: what control does by
/// then.
#[cfg_attr(kani, kani::proof)]
pub fn verify_brake_by_is_tau_after_the_cycle() {
    let (tau, now_ns, later_ns) = (within(0.0, 60.0), time_ns(), time_ns());
    let stages = Parameters { tau, ..Parameters::default() };
    let settings = Settings { profile: profile(), stages, ..Settings::new(Duration::ZERO) };
    let [found, later] = [now_ns, later_ns].map(|now_ns| brake_by(&settings, now_ns));
    let is_paper = settings.profile == Profile::PAPER;
    assert!(found.is_none() == is_paper && later.is_none() == is_paper);
    let (Some(by_ns), Some(later_by_ns)) = (found, later) else { return };
    let left_ns = i128::from(by_ns) - i128::from(now_ns);
    let tau_ns = tau * 1e9;
    assert!((0..=60_000_000_000).contains(&left_ns));
    // Below 2^53 integers are doubles.
    let [high, low] = [left_ns >> 32, left_ns & 0xffff_ffff]
        .map(|half| u32::try_from(half).map_or(f64::MAX, f64::from));
    let left = high * 4_294_967_296.0 + low;
    assert!(left <= tau_ns);
    assert!(by_ns == i64::MAX || tau_ns < left + 1.0);
    assert!(later_ns < now_ns || later_by_ns >= by_ns);
    kani::cover!(by_ns == i64::MAX && left_ns < 1_000_000_000 && tau >= 1.0, "saturated");
    kani::cover!(left < tau_ns && tau >= 1.0, "rounded down");
    kani::cover!(left_ns == 60_000_000_000, "a minute");
}

/// Settings are taken exactly when there is a period, `dt_max` is above it, no time is above 0 and below 1 ms nor `t_wait`
/// above 0 and below 1 s, `max_age` is not below `l_max`, sessions are numbered from 0 and below 2^63 - 1, and a `stall`
/// has a way that is finite and not negative and at least 1 s [MON-22, MON-24, MON-25, MON-26, MON-29, MON-60, MON-62].
///
/// Domain: the paper profile, times of the requester from 0, periods and stalls below 2^32 s, `max_age` and `step_max` of their
/// domains, the other parameters of the stages by default. Not covered: parameters outside their domain, `tau` in the
/// hardened profile, and usual ranges: all is meant.
#[cfg_attr(kani, kani::proof)]
pub fn verify_settings_are_refused_exactly_by_rule() {
    let settings = any_settings().in_any_range();
    let Settings { stages, requester, period, sessions_before, stall, .. } = settings;
    let period_ns = i64::try_from(period.as_nanos()).unwrap_or(i64::MAX);
    let least = |ns: i64, least_ns: i64| ns == 0 || ns >= least_ns;
    let is_long = |ns: i64| least(ns, 1_000_000);
    let times = !period.is_zero()
        && is_long(period_ns)
        && is_long(stages.max_age_ns)
        && is_long(stages.step_max_ns)
        && is_long(requester.request_timeout_ns)
        && is_long(requester.l_max_ns)
        && is_long(requester.dt_max_ns)
        && least(requester.t_wait_ns, 1_000_000_000);
    let fits = stages.max_age_ns >= requester.l_max_ns
        && u128::from(requester.dt_max_ns.unsigned_abs()) > period.as_nanos();
    let is_numbered = (0..i64::MAX).contains(&sessions_before);
    let gets_on = stall.is_none_or(|Stall { way_m, time }| {
        (0.0..f64::INFINITY).contains(&way_m) && time.as_nanos() >= 1_000_000_000
    });
    let expected = times && fits && is_numbered && gets_on;
    assert!(settings.check().is_ok() == expected);
    kani::cover!(expected && stall.is_some(), "taken");
    kani::cover!(times && !fits && is_numbered && gets_on, "dt_max or max_age is too short");
}

/// The remote time begins at 0 where the CAV is found farther than the way from the mark, which is there then; each time
/// between two cycles with PLAN remote adds to it, a negative one as 0 [MON-55, MON-56].
///
/// Domain: a way of 1 m, a mark at the origin, a CAV that is found half a metre from it, 5 m from it or nowhere, all times of 64
/// bits, from 0 the remote time. Not covered: other places, when PLAN is given back.
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_remote_time_counts_where_the_cav_gets_nowhere() {
    let (remote_ns, last_ns, now_ns) = (duration_ns(), option(time_ns), time_ns());
    let (place, is_remote) = (below(3), kani::any());
    let found = match place {
        0 => None,
        1 => Some([0.0, 0.5]),
        _ => Some([3.0, 4.0]),
    };
    let (mark, found_ns, cycle_ns) =
        get_on(([0.0; 2], remote_ns, last_ns), now_ns, found, is_remote, 1.0);
    let leaves = place == 2;
    let counted = i128::from(if leaves { 0 } else { remote_ns });
    let since = match last_ns {
        Some(last_ns) if is_remote && now_ns > last_ns => i128::from(now_ns) - i128::from(last_ns),
        Some(_) | None => 0,
    };
    let expected_ns = i64::try_from(counted + since).unwrap_or(i64::MAX);
    let expected = if leaves { [3.0, 4.0] } else { [0.0; 2] };
    assert!(same_number(mark[0], expected[0]) && same_number(mark[1], expected[1]));
    assert!(found_ns == expected_ns && cycle_ns == is_remote.then_some(now_ns));
    kani::cover!(leaves && found_ns > 0, "it gets on");
    kani::cover!(!leaves && since > 0 && counted > 0, "it stays");
}

fn any_settings() -> Settings {
    let domain_ns = || integer_within(0, 60_000_000_000);
    let stages =
        Parameters { max_age_ns: domain_ns(), step_max_ns: domain_ns(), ..Parameters::default() };
    let requester = requester::Parameters {
        t_wait_ns: any_ns(),
        request_timeout_ns: any_ns(),
        l_max_ns: any_ns(),
        dt_max_ns: any_ns(),
        qos_hold: kani::any(),
    };
    let (way_m, time) = (near(0.0, 2.0), span());
    Settings {
        profile: Profile::PAPER,
        stages,
        requester,
        sessions_before: near_integer(0, 4),
        supervise_local: kani::any(),
        stall: option(|| Stall { way_m, time }),
        ..Settings::new(span())
    }
}

/// Any time from 0; an engine that samples looks at the first two seconds.
fn any_ns() -> i64 {
    let ns = near_integer(0, 2_000_000_000);
    kani::assume(ns >= 0);
    ns
}

/// Below 2^32 s.
fn span() -> Duration {
    let (secs, nanos) = (near_integer(0, 1), integer_within(0, 999_999_999));
    kani::assume((0..1 << 32).contains(&secs));
    Duration::new(secs.unsigned_abs(), u32::try_from(nanos).unwrap_or(0))
}
