//! F-12 to F-23: what is assumed of tracks, of trajectories and of the inputs that are there.

use mufasa_model::input::cycle::{Profile, Track};
use mufasa_model::offloading::requester::Group::Mot;
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use crate::vectors::base::{
    base, detection, detections, point, points, shift, straight, track, tracks, with,
};
use crate::vectors::book::Book;
use crate::vectors::expected::{after, fails, fails_by, safe};
use crate::vectors::findings::{bare, finding, witness};
use crate::vectors::stages::grid::stage_v;
use crate::vectors::stages::track_validation::stage_i;
use crate::vectors::story::{MOT, Story};

/// Adds their vectors.
pub fn add(book: &mut Book) {
    handover(book);
    remote_tracks(book);
    remote_trajectory(book);
    availability(book);
}

fn handover(book: &mut Book) {
    let topic = finding("findings/F-12", "F-12");
    let note = "The local MOT stops at the confirmation, before any remote result: there is none \
                of either until the first data.";
    let story = Story::requested(Profile::Paper, MOT).confirm(1, (1, Mot, 1));
    let expected = after(story.len(), ["remote:1", "local"], None, &["deactivate mot"]);
    book.trace(topic, "paper", note, story.trace(), &expected);
    let note = "Hardened: it goes on until a result was used in a safe cycle.";
    let story = Story::requested(Profile::Hardened, MOT).confirm(1, (1, Mot, 1));
    let expected = after(story.len(), ["remote:1", "local"], None, &[]);
    book.trace(topic, "hardened", note, story.trace(), &expected);
    let note = "Open in both: on the way back the local services start with no result.";
    let story = Story::remote(Profile::Hardened, MOT).data(1, (1, Mot, 1), 1).safe(2, MOT).issue(3);
    let actions = ["release mot 1#1", "activate mot"];
    let expected = after(story.len(), ["local", "local"], Some(10_000_000_003), &actions);
    book.trace(topic, "way-back", note, story.trace(), &expected);
}

fn remote_tracks(book: &mut Book) {
    let topic = finding("findings/F-13", "F-13");
    let note = "The car ahead stands; the remote MOT says that it drives away at 20 m/s.";
    witness(book, topic, ("", note), &fails_by("iii", "collision_standing"), |profile| {
        bare(profile, AllRemote, |cycle| {
            cycle.tracks = Some(tracks(vec![Track { vx: 20.0, ..track(1, 15.0, 0.0) }]));
            cycle.detections = Some(detections(vec![detection(15.0, 0.0)]));
        })
    });
    let topic = finding("findings/F-14", "F-14");
    let note = "The paper's own attack: an empty list, although a car stands 8 m ahead.";
    witness(book, topic, ("", note), &fails_by("iv", "collision"), |profile| {
        bare(profile, AllRemote, |cycle| {
            cycle.tracks = Some(tracks(vec![]));
            cycle.detections = Some(detections(vec![detection(8.0, 0.0)]));
        })
    });
    let topic = finding("findings/F-15", "F-15");
    let note = "The car half in the way is reported as 2 cm long and wide.";
    witness(book, topic, ("", note), &fails_by("iv", "collision"), |profile| {
        bare(profile, AllRemote, |cycle| {
            let small = Track { length: 0.02, width: 0.02, ..track(1, 10.0, 1.5) };
            cycle.tracks = Some(tracks(vec![small]));
            cycle.detections = Some(detections(vec![detection(10.0, 1.5)]));
        })
    });
    let topic = finding("findings/F-18", "F-18");
    let note = "No detections: the remote list, which nothing has checked, is the only obstacle \
                check, and the grid, full of obstacles, is not asked.";
    witness(book, topic, ("", note), &fails_by("v", "occupied"), |profile| {
        with(base(profile, AllRemote), |cycle| {
            (cycle.tracks, cycle.detections) = (Some(tracks(vec![])), None);
            cycle.grid.iter_mut().for_each(|grid| grid.occupied = vec![0xff; 5]);
        })
    });
}

fn remote_trajectory(book: &mut Book) {
    let crossing = Track { vy: 10.0, ..track(1, 10.0, -10.0) };
    let topic = finding("findings/F-16", "F-16");
    let note = "All times lie 5 s later: the car that crosses in a second is gone by then.";
    let in_time = bare(Profile::Paper, PlanRemote, |cycle| {
        cycle.tracks = Some(tracks(vec![crossing.clone()]));
    });
    witness(book, topic, ("", note), &fails_by("ii", "start_time"), |profile| {
        with(in_time.clone(), |cycle| {
            cycle.profile = profile;
            shift(cycle, 5_000_000_000);
        })
    });
    let note = "With true times it collides.";
    book.cycle(topic, "in-time", note, &in_time, &fails_by("iii", "collision"));
    let topic = finding("findings/F-17", "F-17");
    let note = "Zigzag on the spot for 18 m = s_CAV, then into the car.";
    witness(book, topic, ("", note), &fails("ii"), |profile| {
        bare(profile, PlanRemote, |cycle| {
            let zigzag = |i: i64| point(i * 100_000_000, 0.0, if i % 2 == 0 { 0.0 } else { 1.0 });
            let mut path: Vec<_> = (0..19).map(zigzag).collect();
            path.push(point(1_900_000_000, 8.0, 0.0));
            cycle.trajectory = Some(points(path));
            cycle.tracks = Some(tracks(vec![track(1, 8.0, 0.0)]));
        })
    });
    let topic = finding("findings/F-22", "F-22");
    let note = "The CAV drives at 10 m/s, its trajectory at 40 m/s: by that it has passed before \
                the other car crosses.";
    witness(book, topic, ("", note), &fails_by("ii", "arc_too_long"), |profile| {
        with(in_time.clone(), |cycle| {
            cycle.profile = profile;
            cycle.trajectory = Some(straight(21, 4.0));
        })
    });
    let topic = finding("findings/F-23", "F-23");
    let note = "The trajectory ends after 4 m; braking takes 6.25 m, and a car is touched at 5 m.";
    witness(book, topic, ("", note), &fails_by("ii", "ends_too_soon"), |profile| {
        bare(profile, PlanRemote, |cycle| {
            cycle.trajectory = Some(straight(5, 1.0));
            cycle.tracks = Some(tracks(vec![track(1, 9.0, 0.0)]));
        })
    });
}

fn availability(book: &mut Book) {
    let topic = finding("findings/F-20", "F-20");
    let missed = |profile, miss_budget| {
        let received = vec![track(1, 20.0, 0.0), track(2, 60.0, 0.0)];
        let seen = vec![detection(60.0, 0.0), detection(30.0, 20.0)];
        with(stage_i(profile, received, seen), |cycle| cycle.parameters.miss_budget = miss_budget)
    };
    let note = "The car at 20 m is not detected, and is matched with clutter 22 m away.";
    let cycle = missed(Profile::Paper, 0);
    book.cycle(topic, "paper", note, &cycle, &fails_by("i", "mean_cost"));
    let cycle = missed(Profile::Hardened, 0);
    book.cycle(topic, "hardened", note, &cycle, &fails("i"));
    let note = "miss_budget = 1 trades it against F-01 and F-02.";
    book.cycle(topic, "miss-budget", note, &missed(Profile::Hardened, 1), &safe());
    let note = "A true car that drives ahead is in its first list, and counts as standing, too.";
    let cycle = bare(Profile::Hardened, AllRemote, |cycle| {
        cycle.tracks = Some(tracks(vec![Track { vx: 10.0, ..track(1, 15.0, 0.0) }]));
        cycle.detections = Some(detections(vec![detection(15.0, 0.0)]));
    });
    book.cycle(topic, "first-list", note, &cycle, &fails_by("iii", "collision_standing"));
    let topic = finding("findings/F-21", "F-21");
    let note = "The stopping distance leaves the grid: the hardened profile takes what is outside \
                as occupied, unless stage iv ran.";
    let leaves = |profile| {
        with(stage_v(profile, [0, 0]), |cycle| {
            cycle.grid.iter_mut().for_each(|grid| {
                (grid.occupied, grid.x) = (vec![0; 120], -35.0);
            });
        })
    };
    witness(book, topic, ("", note), &fails_by("v", "outside"), leaves);
    let cycle = with(leaves(Profile::Hardened), |cycle| {
        cycle.configuration = MotRemote;
        cycle.detections = Some(detections(vec![detection(60.0, 0.0)]));
    });
    book.cycle(topic, "after-iv", note, &cycle, &safe());
}
