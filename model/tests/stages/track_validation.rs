//! `spec/3-stages.md#stage-i-track-validation`

use mufasa_model::input::cycle::{Cycle, Detection, Profile, Track};
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::MotRemote;

use crate::base::*;

/// Stage i of the paper profile with theta_tr = 1/4, a binary fraction.
fn with(received: Vec<Track>, detected: Vec<Detection>) -> Cycle {
    let mut cycle = base(Profile::Paper, MotRemote);
    cycle.parameters.theta_tr = 0.25;
    cycle.tracks = tracks(received);
    cycle.detections = detections(detected);
    cycle
}

fn stage_i_passes(received: Vec<Track>, detected: Vec<Detection>) -> bool {
    passes(&with(received, detected), Stage::I)
}

/// spec/3-stages.md#stage-i-track-validation.1, spec/3-stages.md#stage-i-track-validation.2: r is
/// the distance to the farthest detection; a track at distance r is gated, beyond it is not.
#[test]
fn only_tracks_within_r_are_assigned() {
    let far = detection(-30.0, -40.0);
    let ghost = |x: f64| vec![track(1, x, 0.0)];
    assert!(!stage_i_passes(ghost(50.0), vec![far.clone(), detection(3.0, 4.0)]));
    assert!(stage_i_passes(ghost(50.0f64.next_up()), vec![far, detection(3.0, 4.0)]));
}

/// spec/3-stages.md#stage-i-track-validation.1: without detections r is 0: only a track at p is
/// gated, and k is 0.
#[test]
fn without_detections_r_is_zero() {
    assert!(stage_i_passes(vec![track(1, 0.0, 0.0), track(2, 1.0, 0.0)], vec![]));
}

/// spec/3-stages.md#stage-i-track-validation.3: the pairing is the one of least sum, not greedy.
#[test]
fn assignment_has_the_least_sum() {
    // Greedy would pair the track at 60.25 with the detection at 60.25 and pay 1 for the other.
    let received = vec![track(1, 60.25, 0.0), track(2, 60.0, 0.0)];
    let detected = vec![detection(60.25, 0.0), detection(60.625, 0.0)];
    let found = witness(&with(received, detected), Stage::I);
    // Both pairings cost 0.625: (0 + 0.625) and (0.375 + 0.25).
    assert_eq!(found.compared.map(f64::to_bits), [0.3125, 0.25].map(f64::to_bits));

    let received = vec![track(1, 60.0, 0.0), track(2, 60.0, 1.0)];
    let detected = vec![detection(60.0, 0.75), detection(60.0, -0.125)];
    // (1 -> -0.125, 2 -> 0.75) costs 0.375, the other pairing 0.75 + 1.125.
    assert!(stage_i_passes(received, detected));
}

/// spec/3-stages.md#stage-i-track-validation.3: with more tracks than detections only as many
/// pairs as detections (F-02), with more detections only as many as tracks.
#[test]
fn k_is_the_smaller_number() {
    let surplus = vec![track(1, 60.0, 0.0), track(2, 10.0, 3.0), track(3, 20.0, -3.0)];
    assert!(stage_i_passes(surplus, vec![detection(60.0, 0.125)]));
    let clutter = vec![detection(60.0, 0.125), detection(1.0, 1.0), detection(70.0, 5.0)];
    assert!(stage_i_passes(vec![track(1, 60.0, 0.0)], clutter));
}

/// spec/3-stages.md#stage-i-track-validation.4, I-02, I-03: the mean over the pairs must be below
/// theta_tr; equality fails; k = 0 passes.
#[test]
fn mean_must_be_below_theta_tr() {
    let one = |y: f64| stage_i_passes(vec![track(1, 60.0, 0.0)], vec![detection(60.0, y)]);
    assert!(!one(0.25));
    assert!(one(0.25f64.next_down()));
    assert!(!one(0.25f64.next_up()));
    let mean = |a: f64, b: f64| {
        let received = vec![track(1, 60.0, 0.0), track(2, 20.0, 0.0)];
        stage_i_passes(received, vec![detection(60.0, a), detection(20.0, b)])
    };
    assert!(mean(0.0, 0.5f64.next_down()));
    assert!(!mean(0.0, 0.5));
    assert!(!mean(2f64.powi(-60), 0.5));
    assert!(stage_i_passes(vec![], vec![detection(60.0, 0.0)]));
}

/// spec/3-stages.md#stage-i-track-validation.4: the witness names the mean and theta_tr.
#[test]
fn witness_names_mean_and_threshold() {
    let found = witness(&with(vec![track(1, 60.0, 0.0)], vec![detection(60.0, 2.0)]), Stage::I);
    assert_eq!(found.rule, Rule::MeanCost);
    assert_eq!(found.compared.map(f64::to_bits), [2.0, 0.25].map(f64::to_bits));
}

/// The mean is compared as a real number: three roots whose sum is exactly 3 theta_tr.
#[test]
fn a_mean_of_roots_equal_to_theta_tr_fails() {
    // Distances sqrt(2)/8 each, theta_tr the double nearest to sqrt(2)/8, which is not equal.
    let theta_tr = 2f64.sqrt() / 8.0;
    let at = |x: f64| (track(1, x, 0.0), detection(x + 0.125, 0.125));
    let (tracks, detections): (Vec<_>, Vec<_>) = [10.0, 20.0, 30.0]
        .into_iter()
        .enumerate()
        .map(|(i, x)| {
            let (track, detection) = at(x);
            (Track { id: i64::try_from(i).expect("small"), ..track }, detection)
        })
        .unzip();
    let mut cycle = with(tracks, detections);
    cycle.detections.as_mut().expect("there are").items.push(detection(90.0, 0.0));
    // 2f64.sqrt() is above the real root, so the mean is below it, by less than a double shows.
    cycle.parameters.theta_tr = theta_tr;
    assert!(passes(&cycle, Stage::I));
    cycle.parameters.theta_tr = theta_tr.next_down();
    assert!(!passes(&cycle, Stage::I));
}
