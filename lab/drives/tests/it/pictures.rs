//! Pictures of failing cycles: well-formed, with the witness marked, whatever the input.

use mufasa_drives::check::words;
use mufasa_drives::pictures::{Content, picture};
use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Grid, Lead, Track};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{
    FailedStage, InvalidInput, Outcome, Reason, Report, Rule, Stage, Witness,
};
use roxmltree::{Document, Node};

/// A straight road with two tracks, four detections, two earlier lists, a lead and a grid.
fn cycle() -> Cycle {
    let mut cycle = crate::common::cycle(0, true);
    let stamp_ns = cycle.now_ns;
    let list = |ago_ms: i64, places: &[[f64; 2]]| {
        let item = |[x, y]: &[f64; 2]| {
            let (x, y) = (*x, *y);
            Detection { x, y, cos: 1.0, sin: 0.0, length: 4.4, width: 1.9 }
        };
        let items = places.iter().map(item).collect();
        DetectionList { stamp_ns: stamp_ns - ago_ms * 1_000_000, items }
    };
    cycle.detections = Some(list(0, &[[9.1, 0.1], [30.0, 3.5], [44.0, -6.0], [20.0, -3.0]]));
    cycle.detection_history =
        vec![list(300, &[[18.6, -5.2]]), list(500, &[[21.0, 0.2], [17.0, -8.0]])];
    let tracks = &mut cycle.tracks.as_mut().unwrap().items;
    tracks[0].vx = 3.0;
    tracks.push(Track { id: 12, x: 30.0, y: 3.6, vx: -9.0, ..tracks[0].clone() });
    cycle.lead = Some(Lead { stamp_ns, gap: 17.0, speed: 3.0 });
    let (width, height) = (300, 150);
    let mut occupied = vec![0_u8; 300 * 150 / 8];
    for bit in (100..106).flat_map(|row| (120..150).map(move |column| row * 300 + column)) {
        occupied[bit / 8] |= 1 << (bit % 8);
    }
    let (x, y, cos, sin, resolution, unknown) = (-10.0, -15.0, 1.0, 0.0, 0.2, None);
    cycle.grid =
        Some(Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown });
    cycle
}

fn witness(rule: Rule) -> Witness {
    Witness::new(rule, &Real::from_double(4.1), &Real::from_double(5.0))
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
    let fail_safe = Witness { point: Some(42), rule: Rule::FailSafe, ..track.clone() };
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
        ("start", failed(Stage::Ii, Witness { point: Some(0), ..witness(Rule::Position) })),
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
