//! The deciding case of every row of `spec/3-stages.md#interpretations`, one file per row.

use mufasa_model::input::cycle::Profile::Paper;
use mufasa_model::offloading::requester::EventKind;
use mufasa_model::offloading::requester::Group::Mot;
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use crate::vectors::base::{base, detection, detections, lead, track, tracks, with};
use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::{after, compositions, fails, fails_by, refused, safe};
use crate::vectors::offloading::with_qos_hold;
use crate::vectors::services::chain;
use crate::vectors::stages::collision::standing;
use crate::vectors::stages::grid::stage_v;
use crate::vectors::stages::schedule::without;
use crate::vectors::stages::track_validation::stage_i;
use crate::vectors::story::{ALL, MOT, Story};

/// Adds them.
pub fn add(book: &mut Book) {
    stations(book);
    thresholds(book);
    stages(book);
    protocol(book);
    doubles(book);
}

const fn row(file: &'static str, requirement: &'static str, name: &'static str) -> Topic {
    Topic::new(file, requirement).read_as(name)
}

fn stations(book: &mut Book) {
    let topic = row("interpretations/I-01", "spec/1-services.md#composition.6", "I-01");
    for (name, station, expected) in [
        ("cav", 0, compositions(1)),
        ("mec", 1, compositions(0).that("/none/rule", "local_only")),
        ("negative", -1, refused("services.station", Some(1))),
    ] {
        let note = "Station 0 is the CAV: what is local_only runs there. Ids are integers >= 0.";
        let mut task = chain(station);
        task.local_only = vec![String::from("mot")];
        book.composition(topic, name, note, &task, &expected);
    }
}

fn thresholds(book: &mut Book) {
    let topic = row("interpretations/I-02", "spec/3-stages.md#stage-i-track-validation.4", "I-02");
    let note = "One pair at 0.5 m and two tracks without a partner: the mean over the pairs.";
    let received = vec![track(1, 60.0, 0.0), track(2, 50.0, 0.0), track(3, 40.0, 0.0)];
    let cycle = stage_i(Paper, received, vec![detection(60.0, 0.5)]);
    book.cycle(topic, "over-the-pairs", note, &cycle, &fails_by("i", "mean_cost"));
    let note = "k = 0 passes.";
    let cycle = stage_i(Paper, vec![], vec![detection(60.0, 0.0)]);
    book.cycle(topic, "no-pairs", note, &cycle, &safe().stages("PJ-jJ"));
    let touching =
        row("interpretations/I-03", "spec/3-stages.md#low-level-collision-check-llcc.2", "I-03");
    let note = "Touching rectangles collide.";
    let cycle = standing(Paper, track(1, 4.0, 0.0));
    book.cycle(touching, "touching", note, &cycle, &fails_by("iii", "collision"));
    let gap = row(
        "interpretations/I-03",
        "spec/3-stages.md#stage-iv-trajectory-with-detections.2",
        "I-03",
    );
    let note = "A gap equal to s_follow = 15 m fails.";
    let cycle = with(without(base(Paper, MotRemote), "tg"), |cycle| {
        cycle.parameters.safety_time = 1.5;
        cycle.lead = lead(15.0, 10.0);
    });
    book.cycle(gap, "gap", note, &cycle, &fails_by("iv", "gap"));
}

fn stages(book: &mut Book) {
    let topic = row("interpretations/I-04", "spec/3-stages.md#schedule.2", "I-04");
    let note = "A rejected track list ends the cycle; the detections alone would be safe.";
    let cycle = with(base(Paper, MotRemote), |cycle| {
        cycle.tracks = Some(tracks(vec![track(1, 59.0, 0.0)]));
    });
    book.cycle(topic, "stop", note, &cycle, &fails("i").stages("Fa-aa"));
    let topic = row("interpretations/I-05", "spec/3-stages.md#schedule.5", "I-05");
    for (name, missing, stages) in [("tracks", "t", "TP-PP"), ("grid", "g", "PP-PG")] {
        let note = "An always stage without its input is reported, not failed.";
        let cycle = without(base(Paper, MotRemote), missing);
        book.cycle(topic, name, note, &cycle, &safe().stages(stages));
    }
    let topic = row("interpretations/I-06", "spec/3-stages.md#schedule.5", "I-06");
    let note = "Stage iii finds a collision: a failure at once, though detections and grid are \
                free.";
    let cycle = with(base(Paper, PlanRemote), |cycle| {
        cycle.tracks = Some(tracks(vec![track(1, 5.0, 0.0)]));
    });
    book.cycle(topic, "collision", note, &cycle, &fails("iii").stages("-PFa-"));
    let note = "Stage iv finds a collision: the grid is not asked instead.";
    let cycle = with(without(base(Paper, AllRemote), "t"), |cycle| {
        cycle.detections = Some(detections(vec![detection(8.0, 0.0)]));
    });
    book.cycle(topic, "detections", note, &cycle, &fails("iv").stages("TPtFa"));
    let topic =
        row("interpretations/I-07", "spec/3-stages.md#stage-v-trajectory-with-grid-map.3", "I-07");
    let unknown = |x: f64, unknown: u8| {
        with(stage_v(Paper, [0, 0]), |cycle| {
            cycle.grid.iter_mut().for_each(|grid| {
                (grid.x, grid.occupied) = (x, vec![0; 120]);
                grid.unknown = Some(vec![unknown; 120]);
            });
        })
    };
    let note = "Unknown cells are free in the paper profile.";
    book.cycle(topic, "unknown", note, &unknown(-12.0, 0xff), &safe());
    let note = "Places outside the grid are free in the paper profile.";
    book.cycle(topic, "outside", note, &unknown(500.0, 0), &safe());
    let topic = row("interpretations/I-11", "spec/3-stages.md#schedule.4", "I-11");
    let note = "An empty track list is a track list: stage iii runs, and iv does not.";
    let cycle = with(base(Paper, PlanRemote), |cycle| cycle.tracks = Some(tracks(vec![])));
    book.cycle(topic, "empty", note, &cycle, &safe().stages("-PPo-"));
    let note = "No track list: stage iii cannot run, and iv does.";
    let cycle = without(base(Paper, PlanRemote), "t");
    book.cycle(topic, "none", note, &cycle, &safe().stages("-PTP-"));
}

fn protocol(book: &mut Book) {
    let hold = 10_000_000_001;
    let topic = row("interpretations/I-08", "spec/2-offloading.md#fallback.3", "I-08");
    let note = "At the end of the waiting time offloading is possible again.";
    let story = Story::new(Paper).offer(0, 1, MOT).issue(1).tick(hold);
    let expected = after(story.len(), ["requested:1", "local"], Some(hold), &["request mot 1#1"]);
    book.trace(topic, "inclusive", note, story.trace(), &expected);
    let topic = row("interpretations/I-09", "spec/2-offloading.md#fallback.4", "I-09");
    for (name, qos_hold) in [("no-hold", false), ("switch", true)] {
        let note = "A violation of quality of service starts no hold, unless the switch is set.";
        let story = Story::remote(Paper, MOT).parameters(with_qos_hold(qos_hold));
        let story = story.data(1, (1, Mot, 1), 2);
        let actions = ["drop mot", "release mot 1#1", "activate mot"];
        let hold = qos_hold.then_some(hold);
        let expected = after(story.len(), ["local", "local"], hold, &actions);
        book.trace(topic, name, note, story.trace(), &expected);
    }
    let topic = row("interpretations/I-10", "spec/2-offloading.md#fallback.1", "I-10");
    let note = "The unsafe cycle used MOT alone; the fallback ends PLAN, too.";
    let story = Story::remote(Paper, ALL);
    let story = story.at(1, EventKind::Verdict { safe: false, groups: MOT });
    let actions = ["release mot 1#1", "release plan 1#2", "activate mot", "activate plan"];
    let expected = after(story.len(), ["local", "local"], Some(hold), &actions);
    book.trace(topic, "all", note, story.trace(), &expected);
}

fn doubles(book: &mut Book) {
    let topic = row("interpretations/I-12", "spec/4-arithmetic.md#domain.1", "I-12");
    let note = "theta_tr is the double nearest to 0.2, which is 1.1e-17 above the decimal. Four \
                distances, three of that double and one of the double below it: their mean lies \
                between the decimal and the double, so it passes.";
    let mut received = Vec::new();
    let mut seen = Vec::new();
    for (id, x) in (1..).zip([10.0, 20.0, 30.0, 40.0]) {
        received.push(track(id, x, 0.0));
        seen.push(detection(x, if id == 1 { 0.2_f64.next_down() } else { 0.2 }));
    }
    seen.push(detection(90.0, 0.0));
    let cycle = with(stage_i(Paper, received, seen), |cycle| cycle.parameters.theta_tr = 0.2);
    book.cycle(topic, "nearest-double", note, &cycle, &safe());
    let note = "A mean of exactly the double nearest to 0.2 fails.";
    let cycle =
        with(stage_i(Paper, vec![track(1, 60.0, 0.0)], vec![detection(60.0, 0.2)]), |cycle| {
            cycle.parameters.theta_tr = 0.2;
        });
    book.cycle(topic, "equal", note, &cycle, &fails_by("i", "mean_cost"));
}
