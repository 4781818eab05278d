//! What an integrator reads of settings that are refused.

use core::ffi::CStr;

use super::{MufasaMonitorSettings, checked};
use crate::cycle::MufasaProfile;
use crate::monitor::settings::mufasa_monitor_settings_default;

/// The field, and the value, least and most, that are told of settings with one change.
fn told(change: impl FnOnce(&mut MufasaMonitorSettings)) -> (String, [f64; 3]) {
    let (field, numbers, _) = all(change);
    (field, numbers)
}

/// With the message.
fn all(change: impl FnOnce(&mut MufasaMonitorSettings)) -> (String, [f64; 3], String) {
    let mut settings = mufasa_monitor_settings_default(50_000_000);
    change(&mut settings);
    let (_, told) = checked(&settings);
    let [field, message] = [told.field, told.message].map(|it| {
        let bytes = it.map(|byte| byte.to_ne_bytes()[0]);
        CStr::from_bytes_until_nul(&bytes).unwrap().to_str().unwrap().to_owned()
    });
    (field, [told.value, told.least, told.most], message)
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
    let (field, [value, least, _]) = told(|it| it.stages.max_age_ns = 1_000_000);
    assert_eq!((field.as_str(), [value, least]), ("parameters.max_age_ns", [1e6, 5e7]));
    let (field, [value, least, _]) = told(|it| it.stages.tau = 0.05);
    assert_eq!((field.as_str(), [value, least]), ("parameters.tau", [0.05; 2]));
    let stalls = |way_m: f64, ns: i64| told(|it| (it.stall_way_m, it.stall_time_ns) = (way_m, ns));
    assert_eq!(stalls(f64::NAN, 0).0, "");
    let (field, [value, least, _]) = stalls(0.0, 999_999_999);
    assert_eq!((field.as_str(), [value, least]), ("stall_time_ns", [999_999_999.0, 1e9]));
    let (field, [value, least, _]) = stalls(-1.0, 1_000_000_000);
    assert_eq!((field.as_str(), [value, least]), ("stall_way_m", [-1.0, 0.0]));
    assert_eq!([stalls(0.0, 1_000_000_000).0, stalls(1.0, -1).0], ["", "stall_time_ns"]);
    // The hardened rules alone need places for detections.
    assert_eq!(told(|it| it.most_detections = 0).0, "most_detections");
    let paper = |it: &mut MufasaMonitorSettings| {
        (it.profile, it.most_detections) = (MufasaProfile::Paper as u32, 0);
    };
    assert_eq!(told(paper).0, "");
}

/// The remedy differs though the field does not.
#[test]
fn a_time_is_told_the_unit_that_is_missing() {
    let (field, [value, ..], message) = all(|it| it.requester.t_wait_ns = 10_000);
    assert_eq!((field.as_str(), value), ("requester.t_wait_ns", 1e4));
    assert!(message.starts_with("above 0 and below 1 s;"), "{message}");
    let (field, [value, ..], message) = all(|it| it.requester.request_timeout_ns = 500);
    assert_eq!((field.as_str(), value), ("requester.request_timeout_ns", 500.0));
    assert!(message.starts_with("above 0 and below 1 ms;"), "{message}");
    let (field, _, message) = all(|it| it.period_ns = 500);
    assert_eq!(field, "period_ns");
    assert!(message.starts_with("above 0 and below 1 ms;"), "{message}");
    let (field, [value, least, most], message) = all(|it| it.stages.tau = 0.06);
    assert_eq!((field.as_str(), value), ("stages.tau", 0.06));
    assert!(0.0 < least && least < most && message.contains("(A-07)"), "{message}");
    let (field, [value, least, most], message) = all(|it| it.stages.a_b = 80.0);
    assert_eq!((field.as_str(), value), ("stages.a_b", 80.0));
    assert!(0.0 < least && most < 80.0 && message.contains("another unit"), "{message}");
}
