//! The searches: a cycle with holes for each finding, as free of other faults as it can be, so that
//! in the hardened profile nothing but the rule that closes the finding rejects it.

use super::Search;
use super::scenes::{
    bare, both, crossed, crossing, detections, every, grid, hurried, integer, met_too_late,
    straight, track, tracks, within,
};
use crate::input::cycle::{CrossSection, Lead, Track};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, less};
use crate::numbers::real::hole::open_number;
use crate::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};
use crate::theorem::base::NOW_NS;

/// All searches. Objects are as large as the CAV and along x, so that two of them meet when their
/// centres on the x axis are at most 4 m apart.
pub const SEARCHES: [Search; 25] = [
    Search {
        finding: "F-02",
        cycle: |profile| {
            let mut cycle = bare(profile, MotRemote);
            cycle.tracks = Some(tracks(vec![track(1, 60.0), track(2, open_number("x"))]));
            cycle.detections = Some(detections(60.0));
            cycle
        },
        conditions: |_| [within("x", 0, 60), at_most(&Real::named("x"), &integer(50))],
    },
    Search {
        finding: "F-03",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.tracks = Some(tracks(vec![Track { length: 12.0, ..track(1, open_number("x")) }]));
            cycle
        },
        conditions: |_| [within("x", 0, 60), at_most(&Real::named("x"), &Real::ratio(79, 10))],
    },
    Search {
        finding: "F-04",
        cycle: |profile| {
            let mut cycle = hurried(profile, PlanRemote);
            cycle.tracks = Some(tracks(vec![track(1, open_number("x"))]));
            cycle
        },
        conditions: |_| [within("v_now", 4, 5), met_too_late()],
    },
    Search {
        finding: "F-05",
        cycle: |profile| {
            let mut cycle = hurried(profile, MotRemote);
            cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 200.0, speed: open_number("v_lead") });
            cycle.detections = Some(detections(open_number("x")));
            cycle
        },
        conditions: |_| [both(within("v_now", 4, 5), within("v_lead", 0, 10)), met_too_late()],
    },
    Search {
        finding: "F-06",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.trajectory = Some(straight(&[0.0, 1.0]));
            cycle.tracks = Some(tracks(vec![track(1, open_number("x"))]));
            cycle
        },
        conditions: |_| [within("x", 0, 60), at_most(&Real::named("x"), &Real::ratio(402, 100))],
    },
    Search {
        finding: "F-07",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.trajectory = Some(straight(&[0.0, open_number("end")]));
            cycle
        },
        conditions: |_| [within("end", 0, 1), Formula::Known(true)],
    },
    Search {
        finding: "F-08",
        cycle: |profile| {
            let mut cycle = bare(profile, MotRemote);
            cycle.trajectory = Some(straight(&[0.0]));
            cycle.trajectory.iter_mut().for_each(|list| list.points[0].y = open_number("y"));
            cycle.grid = Some(grid(14, 13));
            cycle
        },
        conditions: |_| {
            let y = Real::named("y");
            [both(less(&Real::zero(), &y), less(&y, &integer(1))), Formula::Known(true)]
        },
    },
    Search {
        finding: "F-09",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.trajectory = Some(straight(&[0.0, 1.0]));
            cycle.trajectory.iter_mut().for_each(|list| list.points[1].y = open_number("y"));
            let cross_section =
                |x: f64| CrossSection { x, y: 0.0, left: [x, 0.125], right: [x, -0.125] };
            cycle.route.cross_sections = vec![cross_section(-50.0), cross_section(150.0)];
            cycle.tracks = Some(tracks(Vec::new()));
            cycle
        },
        conditions: |_| {
            let y = Real::named("y");
            [at_most(&y, &Real::ratio(29, 100)), less(&Real::ratio(1, 8), &y)]
        },
    },
    Search {
        finding: "F-10",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.parameters.start_tolerance = 2.0;
            cycle.ego.x = open_number("x");
            cycle.tracks = Some(tracks(Vec::new()));
            cycle
        },
        conditions: |_| [within("x", -60, 0), less(&Real::named("x"), &integer(-2))],
    },
    Search {
        finding: "F-11",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.ego.speed = 10.0;
            cycle.parameters.step_max_ns = 1_000_000_000;
            cycle.trajectory = Some(every(1_000_000_000, &[0.0, open_number("end"), 20.0]));
            cycle.tracks = Some(tracks(vec![Track { length: 1.0, ..track(1, open_number("x")) }]));
            cycle
        },
        conditions: |_| {
            let [x, end] = ["x", "end"].map(Real::named);
            let between = both(less(&Real::ratio(5, 2), &x), less(&x, &(end - Real::ratio(5, 2))));
            [within("end", 0, 13), between]
        },
    },
    Search {
        finding: "F-13",
        cycle: |profile| {
            let mut cycle = bare(profile, AllRemote);
            cycle.ego.speed = 5.0;
            cycle.trajectory = Some(straight(&[0.0, 0.5, 1.0, 1.5, 2.0]));
            cycle.tracks = Some(tracks(vec![Track { vx: open_number("vx"), ..track(1, 4.5) }]));
            cycle.detections = Some(detections(4.5));
            cycle
        },
        conditions: |_| [within("vx", -50, 50), Formula::Known(true)],
    },
    Search {
        finding: "F-14",
        cycle: |profile| {
            let mut cycle = bare(profile, AllRemote);
            cycle.tracks = Some(tracks(Vec::new()));
            cycle.detections = Some(detections(open_number("x")));
            cycle
        },
        conditions: |_| [within("x", -4, 4), Formula::Known(true)],
    },
    Search {
        finding: "F-15",
        cycle: |profile| {
            let mut cycle = bare(profile, AllRemote);
            cycle.ego.speed = 0.3;
            cycle.trajectory = Some(straight(&[0.0, 0.5]));
            cycle.tracks =
                Some(tracks(vec![Track { length: open_number("length"), ..track(1, 4.05) }]));
            cycle.detections = Some(detections(4.05));
            cycle
        },
        conditions: |_| [within("length", 1, 10), Formula::Known(true)],
    },
    Search {
        finding: "F-16",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.parameters.step_max_ns = 2_000_000_000;
            let mut later = every(2_000_000_000, &[0.0, 0.0]);
            later.points.iter_mut().for_each(|point| point.t_ns += 5_000_000_000);
            cycle.trajectory = Some(later);
            cycle.tracks = Some(tracks(vec![Track { vx: open_number("vx"), ..track(1, 20.0) }]));
            cycle
        },
        conditions: |_| [within("vx", -12, -8), Formula::Known(true)],
    },
    Search {
        finding: "F-18",
        cycle: |profile| {
            let mut cycle = bare(profile, AllRemote);
            cycle.tracks = Some(tracks(vec![track(1, open_number("x"))]));
            cycle
        },
        conditions: |_| [within("x", -60, 60), Formula::Known(true)],
    },
    Search {
        finding: "F-23",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.ego.speed = 4.0;
            cycle.trajectory = Some(straight(&[0.0, open_number("end")]));
            cycle.tracks = Some(tracks(vec![track(1, 4.9)]));
            cycle
        },
        conditions: |_| [within("end", 0, 1), less(&Real::named("end"), &Real::ratio(9, 10))],
    },
    Search {
        finding: "F-26",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.ego.speed = 4.0;
            cycle.trajectory = Some(straight(&[0.0, 0.5, 1.0, open_number("end")]));
            cycle.tracks = Some(tracks(vec![track(1, open_number("x"))]));
            cycle
        },
        conditions: |_| {
            let [x, end] = ["x", "end"].map(Real::named);
            let reached = both(within("end", 1, 2), at_most(&end, &Real::ratio(5, 4)));
            [reached, both(less(&(end + integer(4)), &x), at_most(&x, &Real::ratio(11, 2)))]
        },
    },
    Search {
        finding: "F-28",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.ego.speed = 10.0;
            let mut zigzag = every(100_000_000, &[0.0; 14]);
            zigzag
                .points
                .iter_mut()
                .skip(1)
                .step_by(2)
                .for_each(|point| point.y = open_number("y"));
            cycle.trajectory = Some(zigzag);
            cycle.tracks = Some(tracks(vec![track(1, 4.5)]));
            cycle
        },
        conditions: |_| [within("y", 0, 1), Formula::Known(true)],
    },
    Search {
        finding: "F-30",
        cycle: |profile| {
            let mut cycle = crossed(profile);
            cycle
                .tracks
                .iter_mut()
                .for_each(|list| list.items.push(Track { y: -4.0, ..track(2, 4.5) }));
            cycle
        },
        conditions: |_| [crossing(), Formula::Known(true)],
    },
    Search { finding: "F-31", cycle: crossed, conditions: |_| [crossing(), Formula::Known(true)] },
    Search {
        finding: "F-34",
        cycle: |profile| {
            let mut cycle = bare(profile, AllRemote);
            cycle.trajectory = Some(straight(&[0.0]));
            cycle.trajectory.iter_mut().for_each(|list| list.points[0].y = open_number("y"));
            (cycle.tracks, cycle.detections) = (Some(tracks(Vec::new())), Some(detections(60.0)));
            cycle.detections.iter_mut().for_each(|list| list.items.clear());
            cycle.grid = Some(grid(13, 12));
            cycle
        },
        conditions: |_| {
            let y = Real::named("y");
            [both(less(&Real::zero(), &y), less(&y, &Real::ratio(1, 2))), Formula::Known(true)]
        },
    },
    Search {
        finding: "F-35",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.trajectory = Some(every(20_000_000, &[0.0, 0.3]));
            cycle.trajectory.iter_mut().for_each(|list| list.points[1].y = open_number("y"));
            cycle.tracks = Some(tracks(Vec::new()));
            cycle
        },
        conditions: |_| [within("y", 0, 1), less(&Real::ratio(1, 10), &Real::named("y"))],
    },
    Search {
        finding: "F-36",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            // Turned by 53 degrees, a direction within what rounding allows.
            (cycle.ego.cos, cycle.ego.sin) = (0.6, open_number("sin"));
            cycle.tracks = Some(tracks(Vec::new()));
            cycle
        },
        conditions: |_| {
            [
                less(&Real::ratio(7_999_999, 10_000_000), &Real::named("sin")),
                less(&Real::named("sin"), &Real::ratio(8_000_001, 10_000_000)),
            ]
        },
    },
    Search {
        finding: "F-37",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.ego.y = open_number("y");
            cycle.tracks = Some(tracks(Vec::new()));
            cycle
        },
        conditions: |_| [within("y", -2, 0), less(&Real::named("y"), &Real::ratio(-1, 2))],
    },
    Search {
        finding: "F-41",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            let mut wiggle = every(3_000_000, &[0.0, 0.001, 0.012]);
            for (point, sin) in wiggle.points[1..].iter_mut().zip([-0.05, 0.05]) {
                (point.cos, point.sin) = (0.998_749_217_771_909, sin);
            }
            wiggle.points[2].y = open_number("y");
            cycle.trajectory = Some(wiggle);
            cycle.tracks = Some(tracks(Vec::new()));
            cycle
        },
        conditions: |_| [within("y", 0, 1), less(&Real::ratio(1, 5), &Real::named("y"))],
    },
];
