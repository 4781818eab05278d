//! Settings that no road vehicle has (`spec/4-arithmetic.md#usual-settings`).

use std::time::Duration;

use mufasa::input::profile::Profile;
use mufasa::monitor::{Monitor, MonitorError, Settings, Unusual};

use super::kit::settings;

/// The rows of the table in the text, in its order: setting, least and most. Of a number of periods that at the period
/// of these tests.
fn table() -> Vec<(String, f64, f64)> {
    let text = include_str!("../../../spec/4-arithmetic.md");
    let (_, text) = text.split_once("## Usual settings").expect("the section");
    let rows = text.lines().filter_map(|line| line.strip_prefix("| `"));
    rows.map(|row| {
        let mut cells = row.split('|').map(|it| it.trim().trim_end_matches('`'));
        let mut next = || cells.next().expect("a cell");
        let (field, least, most) = (next().to_owned(), next(), next());
        let unit = if field.ends_with("_ns") { 1e9 } else { 1.0 };
        let number = |it: &str| match it.strip_suffix(" periods") {
            Some(periods) => {
                periods.parse::<f64>().expect("a number") * settings().period.as_secs_f64()
            }
            None => it.parse::<f64>().expect("a number") * unit,
        };
        let [least, most] = [least, most].map(number);
        (field, least, most)
    })
    .collect()
}

/// Each setting as a value that nobody means.
fn slips() -> Vec<(&'static str, Settings)> {
    let mut slips = Vec::new();
    let mut slip = |field, change: fn(&mut Settings)| {
        let mut settings = settings();
        change(&mut settings);
        slips.push((field, settings));
    };
    slip("stages.theta_tr", |it| it.stages.theta_tr = 200.0);
    slip("stages.theta_map", |it| it.stages.theta_map = 30.0);
    slip("stages.theta_obj", |it| it.stages.theta_obj = 0.5);
    slip("stages.a_b", |it| it.stages.a_b = 80.0);
    slip("stages.safety_time", |it| it.stages.safety_time = 0.0);
    slip("stages.max_age_ns", |it| it.stages.max_age_ns = 1_000_000_001);
    slip("stages.theta_track_max", |it| it.stages.theta_track_max = 100.0);
    slip("stages.miss_budget", |it| it.stages.miss_budget = 64);
    slip("stages.tau", |it| it.stages.tau = 25.0);
    slip("stages.a_max", |it| it.stages.a_max = 0.3);
    slip("stages.start_tolerance", |it| it.stages.start_tolerance = 200.0);
    slip("stages.v_max", |it| it.stages.v_max = 540.0);
    slip("stages.step_max_ns", |it| it.stages.step_max_ns = 0);
    slip("stages.theta_velocity", |it| it.stages.theta_velocity = 200.0);
    slip("stages.lateral_tolerance", |it| it.stages.lateral_tolerance = 50.0);
    slip("stages.v_object", |it| it.stages.v_object = 0.07);
    slip("stages.t_yield", |it| it.stages.t_yield = 0.0);
    slip("stages.a_yield", |it| it.stages.a_yield = 30.0);
    slip("requester.t_wait_ns", |it| it.requester.t_wait_ns = 0);
    slip("requester.request_timeout_ns", |it| it.requester.request_timeout_ns = 0);
    slip("requester.l_max_ns", |it| it.requester.l_max_ns = 0);
    slip("period", |it| {
        (it.period, it.stages.tau) = (Duration::from_millis(1_001), 3.0);
        it.requester.dt_max_ns = 1_500_000_000;
    });
    // The clock of `calibrate` counts microseconds: 100 of them for 10^5 steps.
    slip("step_ps", |it| it.step_ps = Monitor::calibrate(microseconds()));
    slip("requester.dt_max_ns", |it| it.requester.dt_max_ns = 120_000_000_000);
    slips
}

/// A clock that tells 100 us for each kind of work, in us.
fn microseconds() -> impl FnMut() -> u64 {
    let mut now = 0;
    move || {
        now += 100;
        now
    }
}

/// IMPL-14, IMPL-15: each slip is refused by its name and taken when it is named; the text has the same ranges.
#[test]
fn a_setting_that_no_vehicle_has_is_refused_unless_it_is_named() {
    let mut ranges = Vec::new();
    for (field, settings) in slips() {
        let found: Vec<Unusual> = settings.unusual().collect();
        assert_eq!(found.iter().map(|it| it.field).collect::<Vec<_>>(), [field]);
        assert_eq!(settings.check(), Err(MonitorError::Unusual(found[0])));
        let words = found[0].to_string();
        assert!(words.contains(field) && words.contains(&found[0].value.to_string()), "{words}");
        let alone = field.rsplit('.').next().expect("a name");
        for name in [field, alone] {
            assert_eq!(settings.meaning(name).check(), Ok(()), "{name}");
        }
        assert_eq!(settings.in_any_range().check(), Ok(()));
        let another = if field == "stages.a_b" { "tau" } else { "a_b" };
        assert!(settings.meaning(another).meaning("").check().is_err(), "{field}");
        ranges.push((field.to_owned(), found[0].least, found[0].most));
    }
    assert_eq!(ranges, table());
}

/// DOM-02: the default of `tau` is the double nearest to three periods and 0.1 s.
#[test]
fn the_default_of_tau_is_the_nearest_double() {
    for period in 1..300 {
        let tau = Settings::new(Duration::from_millis(period)).stages.tau;
        let decimal = format!("0.{:03}", 3 * period + 100);
        assert_eq!(Ok(tau.to_bits()), decimal.parse().map(f64::to_bits), "{decimal}");
    }
}

/// IMPL-14: the bounds themselves are usual, as are the defaults in both profiles.
#[test]
fn bounds_and_defaults_are_usual() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for period in [1, 50, 99] {
            let settings = Settings { profile, ..Settings::new(Duration::from_millis(period)) };
            assert_eq!((settings.unusual().next(), settings.check()), (None, Ok(())));
        }
    }
    for (a_b, is_usual) in
        [(1.0_f64, true), (12.0, true), (1.0_f64.next_down(), false), (12.0_f64.next_up(), false)]
    {
        let mut settings = settings();
        settings.stages.a_b = a_b;
        assert_eq!(settings.check().is_ok(), is_usual, "{a_b}");
    }
    let with = |profile, period, tau| {
        let mut settings = Settings { profile, ..Settings::new(Duration::from_millis(period)) };
        settings.stages.tau = tau;
        settings.check().is_ok()
    };
    let short = 0.125_f64.next_down();
    assert_eq!(
        [0.125, short].map(|tau| with(Profile::HARDENED, 50, tau)),
        [true, false],
        "2.5 periods"
    );
    assert_eq!([0.01, 0.009].map(|tau| with(Profile::HARDENED, 1, tau)), [true, false]);
    assert_eq!([0.01, 0.009].map(|tau| with(Profile::PAPER, 50, tau)), [true, false]);
    let mut nothing = settings();
    nothing.stages.a_b = f64::NAN;
    assert_eq!(nothing.unusual().map(|it| it.field).collect::<Vec<_>>(), ["stages.a_b"]);
}
