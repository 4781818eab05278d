//! What an integrator reads of settings that are refused.

use core::ffi::CStr;

use super::{MufasaMonitorSettings, checked};
use crate::monitor::settings::mufasa_monitor_settings_default;

/// The field, and the value, least and most, that are told of settings with one change.
fn told(change: impl FnOnce(&mut MufasaMonitorSettings)) -> (String, [f64; 3]) {
    let mut settings = mufasa_monitor_settings_default(50_000_000);
    settings.requester.dt_max_ns = 120_000_000;
    change(&mut settings);
    let (_, told) = checked(&settings);
    let bytes = told.field.map(|byte| byte.to_ne_bytes()[0]);
    let field = CStr::from_bytes_until_nul(&bytes).unwrap().to_str().unwrap();
    (field.to_owned(), [told.value, told.least, told.most])
}

#[test]
fn each_problem_names_its_field_and_its_numbers() {
    assert_eq!(told(|_| ()).0, "");
    assert_eq!(told(|it| it.profile = 7).0, "profile");
    assert_eq!(told(|it| it.period_ns = 0).0, "period_ns");
    assert_eq!(told(|it| it.check_time_ns = -1).0, "check_time_ns");
    let (field, [value, least, most]) = told(|it| it.stages.a_b = -2.0);
    assert_eq!((field.as_str(), value), ("parameters.a_b", -2.0));
    assert!(0.0 < least && least < most);
    let (field, [value, least, _]) = told(|it| it.requester.dt_max_ns = 50_000_000);
    assert_eq!((field.as_str(), [value, least]), ("requester.dt_max_ns", [5e7; 2]));
    assert_eq!(told(|it| it.requester.dt_max_ns = -1).0, "requester.dt_max_ns");
    let (field, [value, ..]) = told(|it| it.sessions_before = -3);
    assert_eq!((field.as_str(), value), ("sessions_before", -3.0));
    assert_eq!(told(|it| it.most_tracks = 0).0, "most_tracks");
    let (field, [value, _, most]) = told(|it| it.most_detections = 2048);
    assert_eq!((field.as_str(), value), ("most_detections", 2048.0));
    assert!(most < 2048.0);
    let (field, [value, ..]) = told(|it| it.stages.max_age_ns = 1_000_000);
    assert_eq!((field.as_str(), value), ("parameters.max_age_ns", 1e6));
}
