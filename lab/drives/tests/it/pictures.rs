//! Pictures of failing cycles: well-formed, with the witness marked, whatever the input.

use mufasa_drives::check::words;
use mufasa_drives::pictures::{Content, picture};
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Profile, Route, Track,
    TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::report::{
    FailedStage, InvalidInput, Outcome, Reason, Report, Rule, Stage, Witness,
};
use mufasa_model::services::configuration::Configuration;
use roxmltree::{Document, Node};

/// A car on a bend to the left, with two tracks, four detections, two earlier lists and a grid.
fn cycle() -> Cycle {
    let at = |s: f64, offset: f64| {
        let angle = 0.4 + s / 120.0;
        let radius = 120.0 - offset;
        [500.0 + radius * angle.sin(), 900.0 - radius * angle.cos(), angle]
    };
    let route = |index: i32| {
        let s = f64::from(index) * 5.0;
        let [x, y, _] = at(s, 0.0);
        let [left, right] = [at(s, 1.9), at(s, -1.9)].map(|[x, y, _]| [x, y]);
        CrossSection { x, y, left, right }
    };
    let point = |index: i32| {
        let [x, y, angle] = at(f64::from(index) * 2.0, 0.0);
        let t_ns = 1_000_000_000 + i64::from(index) * 200_000_000;
        TrajectoryPoint { t_ns, x, y, cos: angle.cos(), sin: angle.sin() }
    };
    let track = |id, s, offset, speed: f64| {
        let [x, y, angle] = at(s, offset);
        let (sin, cos) = angle.sin_cos();
        let [vx, vy] = [speed * cos, speed * sin];
        Track { id, x, y, cos, sin, vx, vy, length: 4.5, width: 1.8 }
    };
    let detection = |s, offset| {
        let [x, y, angle] = at(s, offset);
        Detection { x, y, cos: angle.cos(), sin: angle.sin(), length: 4.4, width: 1.9 }
    };
    let [x, y, angle] = at(0.0, 0.0);
    let mut occupied = vec![0_u8; 300 * 150 / 8];
    for row in 100..106 {
        for column in 120..150 {
            let bit = row * 300 + column;
            occupied[bit / 8] |= 1 << (bit % 8);
        }
    }
    Cycle {
        profile: Profile::HARDENED,
        parameters: Parameters::default(),
        now_ns: 1_000_000_000,
        configuration: Configuration::AllRemote,
        ego: Ego {
            x,
            y,
            cos: angle.cos(),
            sin: angle.sin(),
            speed: 10.0,
            length: 4.8,
            width: 1.9,
            center_offset: 1.4,
        },
        trajectory: Some(Trajectory {
            stamp_ns: 1_000_000_000,
            points: (0..25).map(point).collect(),
        }),
        tracks: Some(TrackList {
            stamp_ns: 1_000_000_000,
            items: vec![track(7, 22.0, 0.3, 3.0), track(12, 30.0, 3.6, -9.0)],
        }),
        detections: Some(DetectionList {
            stamp_ns: 1_000_000_000,
            items: vec![
                detection(22.1, 0.2),
                detection(30.0, 3.5),
                detection(44.0, -6.0),
                detection(20.0, -3.0),
            ],
        }),
        lead: Some(Lead { stamp_ns: 1_000_000_000, gap: 17.0, speed: 3.0 }),
        route: Route { closed: false, cross_sections: (-4..18).map(route).collect() },
        grid: Some(Grid {
            stamp_ns: 1_000_000_000,
            x: x - 10.0,
            y: y - 15.0,
            cos: 1.0,
            sin: 0.0,
            resolution: 0.2,
            width: 300,
            height: 150,
            occupied,
            unknown: None,
        }),
        detection_history: vec![
            DetectionList { stamp_ns: 700_000_000, items: vec![detection(18.6, -5.2)] },
            DetectionList {
                stamp_ns: 500_000_000,
                items: vec![detection(21.0, 0.2), detection(17.0, -8.0)],
            },
        ],
    }
}

fn witness(rule: Rule) -> Witness {
    Witness {
        rule,
        point: None,
        track: None,
        detection: None,
        item: None,
        age_ns: None,
        segment: None,
        disk: None,
        cell: None,
        compared: [4.1, 5.0],
    }
}

fn failed(stage: Stage, witness: Witness) -> Report {
    let index = Stage::ALL.iter().position(|other| *other == stage).unwrap();
    let mut stages = [const { Outcome::Skipped(Reason::AfterFailure) }; 5];
    stages[..index].fill(Outcome::Passed);
    stages[index] = Outcome::Failed(witness);
    Report { failed_stage: Some(FailedStage::Stage(stage)), stages, input: None }
}

fn drawn(cycle: &Cycle, report: &Report) -> String {
    let subtitle = words::answer(&Ok(report.clone()));
    picture(&Content { title: "bend <1> & \"2\"".to_owned(), subtitle, cycle, report })
}

/// Reports of every kind of witness.
fn reports() -> Vec<(&'static str, Report)> {
    let point = Some(9);
    let track = Witness { point, track: Some(7), ..witness(Rule::Collision) };
    let fail_safe = Witness { point: Some(27), rule: Rule::FailSafe, ..track.clone() };
    let detection = Witness { point, detection: Some(0), ..witness(Rule::Collision) };
    let moving = Witness {
        rule: Rule::FailSafe,
        detection: Some(3),
        item: Some(1),
        age_ns: Some(500_000_000),
        ..detection.clone()
    };
    let corridor = Witness { point: Some(20), segment: Some(12), ..witness(Rule::Corridor) };
    let occupied = Witness {
        point: Some(6),
        disk: Some(3),
        cell: Some((125, 102)),
        compared: [0.9, 1.124],
        ..witness(Rule::Occupied)
    };
    let mut reports = vec![
        ("mean", failed(Stage::I, witness(Rule::MeanCost))),
        ("corridor", failed(Stage::Ii, corridor)),
        ("start", failed(Stage::Ii, Witness { point: Some(0), ..witness(Rule::StartPosition) })),
        ("track", failed(Stage::Iii, track)),
        ("fail-safe", failed(Stage::Iv, fail_safe)),
        ("detection", failed(Stage::Iv, detection)),
        ("moving", failed(Stage::Iv, moving)),
        ("gap", failed(Stage::Iv, witness(Rule::Gap))),
        ("grid", failed(Stage::V, occupied)),
    ];
    let none = [const { Outcome::Skipped(Reason::AfterFailure) }; 5];
    let problem = InvalidInput {
        field: "tracks.items.vx".to_owned(),
        index: Some(1),
        message: "must be finite".to_owned(),
    };
    reports.push((
        "input",
        Report {
            failed_stage: Some(FailedStage::Input),
            stages: none.clone(),
            input: Some(problem),
        },
    ));
    reports.push((
        "nothing",
        Report { failed_stage: Some(FailedStage::NoObstacleCheck), stages: none, input: None },
    ));
    reports
}

fn with_id<'a>(document: &'a Document<'_>, id: &str) -> Option<Node<'a, 'a>> {
    document.descendants().find(|node| node.attribute("id") == Some(id))
}

#[test]
fn every_kind_of_witness_is_drawn_in_a_well_formed_document() {
    for (name, report) in reports() {
        let svg = drawn(&cycle(), &report);
        if let Some(folder) = std::env::var_os("MUFASA_PICTURES") {
            std::fs::write(std::path::Path::new(&folder).join(format!("{name}.svg")), &svg)
                .unwrap();
        }
        let document = Document::parse(&svg).unwrap_or_else(|error| panic!("{name}: {error}"));
        let group = with_id(&document, "witness").unwrap_or_else(|| panic!("{name}: no witness"));
        let marks = group.children().filter(|node| {
            node.attribute("class").is_some_and(|class| class.starts_with("witness"))
        });
        assert!(marks.count() > 0, "{name}: nothing is marked");
        let labels = group.children().filter(|node| node.attribute("class") == Some("label-text"));
        assert_eq!(labels.count(), 1, "{name}");
        for word in ["CAV", "trajectory", "track", "detection", "bend <1> & \"2\""] {
            assert!(document.descendants().any(|node| node.text() == Some(word)), "{name}: {word}");
        }
    }
}

#[test]
fn the_marked_track_is_where_it_will_be_at_the_point() {
    let reports = reports();
    let picture_of = |wanted: &str| {
        let (_, report) = reports.iter().find(|(name, _)| *name == wanted).unwrap();
        drawn(&cycle(), report)
    };
    let [moving, fail_safe] = ["track", "fail-safe"].map(picture_of);
    let last_mark = |svg: &str| {
        let document = Document::parse(svg).unwrap();
        let group = with_id(&document, "witness").unwrap();
        let mut shapes = group.children().filter(|node| node.has_tag_name("polygon"));
        shapes.next_back().unwrap().attribute("points").unwrap().to_owned()
    };
    let track_now = |svg: &str| {
        let document = Document::parse(svg).unwrap();
        let track = document
            .descendants()
            .find(|n| n.has_tag_name("polygon") && n.attribute("class") == Some("track"));
        track.unwrap().attribute("points").unwrap().to_owned()
    };
    // H-14 asks about a time span: the track is marked where it is now.
    assert_eq!(last_mark(&fail_safe), track_now(&fail_safe));
    assert_ne!(last_mark(&moving), track_now(&moving));
}

/// From the item of 0.5 s ago to the detection that it became.
#[test]
fn what_was_seen_to_move_has_an_arrow() {
    let reports = reports();
    let (_, report) = reports.iter().find(|(name, _)| *name == "moving").unwrap();
    let svg = drawn(&cycle(), report);
    let document = Document::parse(&svg).unwrap();
    let group = with_id(&document, "witness").unwrap();
    let of = |class: &str| {
        let nodes = group.children().filter(move |n| n.attribute("class") == Some(class));
        nodes.filter_map(|n| n.attribute("points")).collect::<Vec<_>>()
    };
    let corners = |points: &str| points.split(' ').count();
    let counts = ["disk", "witness-line", "witness-tip", "witness"].map(|class| of(class).len());
    assert_eq!((counts, corners(of("disk")[0])), ([1, 1, 1, 2], 4));
    let earlier = document.descendants().filter(|n| n.attribute("class") == Some("history"));
    assert_eq!(earlier.filter(|n| n.has_tag_name("polygon")).count(), 3);
}

#[test]
fn numbers_that_cannot_be_drawn_do_not_reach_the_document() {
    let mut broken = cycle();
    broken.ego.x = f64::NAN;
    broken.trajectory.as_mut().unwrap().points[3].x = f64::INFINITY;
    broken.tracks.as_mut().unwrap().items[0].vx = f64::NAN;
    broken.detections.as_mut().unwrap().items[1].cos = 1e300;
    broken.route.cross_sections[2].left = [f64::NAN, 1e308];
    let grid = broken.grid.as_mut().unwrap();
    (grid.resolution, grid.width) = (0.0, i64::MAX);
    for (name, report) in reports() {
        let svg = drawn(&broken, &report);
        assert!(Document::parse(&svg).is_ok(), "{name}");
        assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{name}");
    }
}

#[test]
fn witnesses_beyond_the_lists_are_no_error() {
    let beyond = Witness {
        point: Some(999),
        track: Some(-1),
        detection: Some(999),
        item: Some(999),
        age_ns: Some(i64::MIN),
        segment: Some(999),
        disk: Some(999),
        cell: Some((i64::MAX, i64::MIN)),
        ..witness(Rule::Occupied)
    };
    for rule in [Rule::Occupied, Rule::FailSafe] {
        let svg = drawn(&cycle(), &failed(Stage::V, Witness { rule, ..beyond.clone() }));
        assert!(with_id(&Document::parse(&svg).unwrap(), "witness").is_some());
    }
}
