//! `spec/3-stages.md#stage-i-track-validation`

use mufasa_model::input::cycle::{Cycle, Detection, Profile, Track};
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote};

use crate::vectors::base::{base, detection, detections, track, tracks, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::edge::{Sides, from, up_to};
use crate::vectors::expected::{fails_by, safe};

/// Stage i alone with theta_tr = 1/4, a binary fraction: without a trajectory nothing else runs.
pub fn stage_i(profile: Profile, received: Vec<Track>, detected: Vec<Detection>) -> Cycle {
    with(base(profile, MotRemote), |cycle| {
        cycle.parameters.theta_tr = 0.25;
        (cycle.trajectory, cycle.grid) = (None, None);
        cycle.tracks = Some(tracks(received));
        cycle.detections = Some(detections(detected));
    })
}

fn paper(received: Vec<Track>, detected: Vec<Detection>) -> Cycle {
    stage_i(Profile::Paper, received, detected)
}

const RADIUS: Topic =
    Topic::new("stages/track-validation", "spec/3-stages.md#stage-i-track-validation.1");
const GATED: Topic =
    Topic::new("stages/track-validation", "spec/3-stages.md#stage-i-track-validation.2");
const PAIRS: Topic =
    Topic::new("stages/track-validation", "spec/3-stages.md#stage-i-track-validation.3");
const MEAN: Topic =
    Topic::new("stages/track-validation", "spec/3-stages.md#stage-i-track-validation.4");
const WORK: Topic =
    Topic::new("stages/track-validation", "spec/3-stages.md#stage-i-track-validation.5");

/// Adds its vectors.
pub fn add(book: &mut Book) {
    gate(book);
    pairs(book);
    mean(book);
    work(book);
}

fn gate(book: &mut Book) {
    let far = || detection(-30.0, -40.0);
    let sides = Sides {
        name: "radius",
        note: "A ghost at x m; the farthest detection is at (-30, -40), so r = 50 m. At distance r \
               it is gated and fails the stage; farther it is not looked at.",
        edge: up_to(50.0),
        accepted: safe().stages("PJ-jJ"),
        rejected: fails_by("i", "mean_cost"),
    };
    book.sides(GATED, &sides, |x| paper(vec![track(1, x, 0.0)], vec![far(), detection(3.0, 4.0)]));
    let name = "radius-of-the-farthest";
    let note = "r is the distance to the farthest detection, not to the nearest or the last: a \
                ghost at 30 m is gated.";
    let cycle = paper(vec![track(1, 30.0, 0.0)], vec![far(), detection(3.0, 4.0)]);
    book.cycle(RADIUS, name, note, &cycle, &fails_by("i", "mean_cost"));
    let note = "Without detections r is 0 and k is 0; the hardened profile rejects the track at p, \
                which no detection is near (H-01).";
    let cycle = paper(vec![track(1, 0.0, 0.0), track(2, 1.0, 0.0)], vec![]);
    book.cycle(RADIUS, "no-detections", note, &cycle, &safe().stages("PJ-jJ"));
    let note = "Without detections r is 0: a track a millimetre off p is not gated, in neither \
                profile.";
    let cycle = stage_i(Profile::Hardened, vec![track(2, 0.001, 0.0)], vec![]);
    book.cycle(RADIUS, "no-detections-off-p", note, &cycle, &safe().stages("PJ-jJ"));
}

fn pairs(book: &mut Book) {
    let note = "The pairing is the one of least sum, 0.125 + 0.25; each track with the detection \
                nearest to it first, in list order, would cost 0.75 + 1.125.";
    let cycle = paper(
        vec![track(1, 60.0, 0.0), track(2, 60.0, 1.0)],
        vec![detection(60.0, 0.75), detection(60.0, -0.125)],
    );
    book.cycle(PAIRS, "least-sum", note, &cycle, &safe().stages("PJ-jJ"));
    let note = "Both pairings cost 0.625 m; the mean 0.3125 is not below 0.25.";
    let cycle = paper(
        vec![track(1, 60.25, 0.0), track(2, 60.0, 0.0)],
        vec![detection(60.25, 0.0), detection(60.625, 0.0)],
    );
    let expected = fails_by("i", "mean_cost");
    let expected = expected.witness("i", "compared", vec!["0.3125", "0.25"]);
    book.cycle(PAIRS, "tied", note, &cycle, &expected);
    let note = "One to one: two tracks cannot share the one detection that is near both.";
    let cycle = paper(
        vec![track(1, 60.0, 0.0), track(2, 60.0, 0.125)],
        vec![detection(60.0, 0.0), detection(61.0, 0.0)],
    );
    book.cycle(PAIRS, "one-to-one", note, &cycle, &fails_by("i", "mean_cost"));
    let note = "More tracks than detections: k = 1 pair (F-02; H-01 rejects it).";
    let received = vec![track(1, 60.0, 0.0), track(2, 10.0, 3.0), track(3, 20.0, -3.0)];
    let cycle = paper(received, vec![detection(60.0, 0.125)]);
    book.cycle(PAIRS, "surplus-tracks", note, &cycle, &safe().stages("PJ-jJ"));
    let note = "More detections than tracks: k = 1 pair.";
    let clutter = vec![detection(60.0, 0.125), detection(1.0, 1.0), detection(70.0, 5.0)];
    let cycle = paper(vec![track(1, 60.0, 0.0)], clutter);
    book.cycle(PAIRS, "surplus-detections", note, &cycle, &safe().stages("PJ-jJ"));
}

fn mean(book: &mut Book) {
    for (name, profile) in [("paper", Profile::Paper), ("hardened", Profile::Hardened)] {
        let name = format!("mean-{name}");
        let sides = Sides {
            name: &name,
            note: "One pair at a distance of y m: the mean must be below theta_tr = 0.25 m.",
            edge: from(0.25),
            accepted: safe().stages("PJ-jJ"),
            rejected: fails_by("i", "mean_cost").witness("i", "compared/1", "0.25"),
        };
        book.sides(MEAN, &sides, |y| {
            stage_i(profile, vec![track(1, 60.0, 0.0)], vec![detection(60.0, y)])
        });
    }
    let sides = Sides {
        name: "mean-of-two",
        note: "Two pairs, at 0 m and y m: the mean y/2 against theta_tr = 0.25 m.",
        edge: from(0.5),
        accepted: safe().stages("PJ-jJ"),
        rejected: fails_by("i", "mean_cost"),
    };
    book.sides(MEAN, &sides, |y| {
        let received = vec![track(1, 60.0, 0.0), track(2, 20.0, 0.0)];
        paper(received, vec![detection(60.0, 0.0), detection(20.0, y)])
    });
    let note = "The mean is over the pairs, not over the tracks: of three tracks one is assigned, \
                at 0.5 m (over the tracks it would be 0.17 m).";
    let received = vec![track(1, 60.0, 0.0), track(2, 50.0, 0.0), track(3, 40.0, 0.0)];
    let cycle = paper(received, vec![detection(60.0, 0.5)]);
    book.cycle(MEAN, "over-the-pairs", note, &cycle, &fails_by("i", "mean_cost"));
    let note = "k = 0: no track is received.";
    let cycle = paper(vec![], vec![detection(60.0, 0.0)]);
    book.cycle(MEAN, "no-tracks", note, &cycle, &safe().stages("PJ-jJ"));
    for (name, theta_tr) in
        [("root-above", 2.0_f64.sqrt() / 8.0), ("root-below", (2.0_f64.sqrt() / 8.0).next_down())]
    {
        let note = "Three pairs at sqrt(2)/8 m each; theta_tr is the double just above or just \
                    below that number, and no rounding may decide.";
        let received = [10.0, 20.0, 30.0].into_iter().zip(1..).map(|(x, id)| track(id, x, 0.0));
        let seen = [10.125, 20.125, 30.125].into_iter().map(|x| detection(x, 0.125));
        let far = std::iter::once(detection(90.0, 0.0));
        let mut cycle = paper(received.collect(), seen.chain(far).collect());
        cycle.parameters.theta_tr = theta_tr;
        let expected = if name == "root-above" { safe() } else { fails_by("i", "mean_cost") };
        book.cycle(MEAN, name, note, &cycle, &expected);
    }
    let note = "The same in AllRemote.";
    let mut cycle = paper(vec![track(1, 60.0, 0.0)], vec![detection(60.0, 2.0)]);
    cycle.configuration = AllRemote;
    book.cycle(MEAN, "all-remote", note, &cycle, &fails_by("i", "mean_cost").stages("Faaaa"));
}

/// The exact model knows no limit; above it the strict model fails, so a program may.
fn work(book: &mut Book) {
    let with_limit = |profile, work_limit, off| {
        let received = vec![track(1, 60.0, off), track(2, 20.0, off)];
        let seen = vec![detection(60.0, 0.0), detection(20.0, 0.0), detection(90.0, 0.0)];
        with(stage_i(profile, received, seen), |cycle| cycle.parameters.work_limit = work_limit)
    };
    let passes = || safe().stages("PJ-jJ");
    let note = "Two tracks and three detections: 2^2 * 3 = 12 steps, as many as work_limit allows.";
    book.cycle(WORK, "work-at-limit", note, &with_limit(Profile::Paper, 12, 0.125), &passes());
    let note = "12 steps, one more than work_limit allows: the strict model fails stage i.";
    book.cycle(WORK, "work-above-limit", note, &with_limit(Profile::Paper, 11, 0.125), &passes());
    let note = "More steps than work_limit allows, and the mean of 0.5 m is too large anyhow: stage \
                i fails in every model.";
    let cycle = with_limit(Profile::Paper, 11, 0.5);
    book.cycle(WORK, "work-above-limit-too-far", note, &cycle, &fails_by("i", "mean_cost"));
    let note = "k = 0 takes no assignment, whatever work_limit is.";
    let cycle = with(paper(vec![], vec![detection(60.0, 0.0)]), |cycle| {
        cycle.parameters.work_limit = 0;
    });
    book.cycle(WORK, "work-none", note, &cycle, &passes());
    for (name, work_limit) in [("work-budget-at-limit", 16), ("work-budget-above-limit", 15)] {
        let note = "Hardened, with a miss budget of 1: c = 3 + 1, hence 2^2 * 4 = 16 steps.";
        let mut cycle = with_limit(Profile::Hardened, work_limit, 0.125);
        cycle.parameters.miss_budget = 1;
        book.cycle(WORK, name, note, &cycle, &safe());
    }
}
