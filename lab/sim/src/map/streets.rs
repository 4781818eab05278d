//! A town of our own: three streets each way, one junction with signals, some bends, crossings.
//!
//! Nodes are named by column and row, 0 to 4; 0 and 4 are the edges of the town, so the junctions are the
//! nine nodes between. Streets are two-way with one lane for each direction; traffic keeps to the right.
//! Row 2 and column 2 are main streets (50 km/h, they go first), the others are 30 km/h streets where who
//! comes from the right goes first. The junction 22 has signals.

use crate::map::conflicts;
use crate::map::route::{Route, RouteKind, Signal};
use crate::map::{Crossing, Lane, Program, Town};
use crate::path::Path;
use crate::pose::{Point, Pose};

/// Places of columns and rows, m.
const COLUMNS: [f64; 5] = [-80.0, 0.0, 120.0, 240.0, 320.0];
const ROWS: [f64; 5] = [-80.0, 0.0, 110.0, 220.0, 300.0];
/// From a junction's node to its stop lines, m.
const BOX: f64 = 12.0;
/// Width of a lane, m.
const LANE: f64 = 3.5;
/// Half width of the corridor of a turn, m: the rear wheels cut the bend.
const HALF_TURN: f64 = 2.5;
/// Limits of main and other streets, m/s.
const LIMITS: [f64; 2] = [50.0 / 3.6, 30.0 / 3.6];
/// Ways through the town, node by node; the two of the ego first.
const WAYS: [&str; 18] = [
    "02 12 22 32 42",
    "20 21 22 32 33 34",
    "02 12 22 23 24",
    "02 12 22 21 20",
    "42 32 22 21 20",
    "42 32 22 23 24",
    "20 21 22 32 42",
    "20 21 22 12 02",
    "24 23 22 12 02",
    "24 23 22 32 42",
    "01 11 12 22 32 42",
    "41 31 32 33 43",
    "10 11 21 22 23 24",
    "34 33 32 22 12 02",
    "30 31 32 22 21 20",
    "03 13 23 22 21 20",
    "43 33 23 22 32 42",
    "14 13 12 22 32 42",
];
/// Start and target of the ego on the first two ways, m.
const TASKS: [(f64, f64); 2] = [(30.0, 365.0), (40.0, 425.0)];
/// Legs that swing to one side on their way, by their ends, m.
const BENDS: [(&str, &str, f64); 3] = [("23", "33", 6.0), ("11", "12", 5.0), ("33", "34", 6.0)];
/// Crossings: the leg and whether bicycles use it.
const CROSSINGS: [(&str, &str, bool); 6] = [
    ("12", "22", false),
    ("22", "32", false),
    ("21", "22", true),
    ("32", "33", true),
    ("11", "21", false),
    ("12", "13", false),
];

type Node = (usize, usize);

/// The town. Routes are the ways of the ego, those of others, the straight ways, and those across the
/// crossings, either direction.
pub fn town() -> Town {
    let mut ways: Vec<Vec<Node>> =
        WAYS.iter().map(|way| way.split(' ').map(node).collect()).collect();
    for line in 1..=3 {
        let row: Vec<Node> = (0..5).map(|column| (column, line)).collect();
        let column: Vec<Node> = (0..5).map(|row| (line, row)).collect();
        for way in [row, column] {
            let back = way.iter().rev().copied().collect();
            ways.extend([way, back].into_iter().filter(|way| *way != ways[0]).collect::<Vec<_>>());
        }
    }
    let mut routes: Vec<Route> = ways.iter().map(|way| route(way)).collect();
    for (route, (start, target)) in routes.iter_mut().zip(TASKS) {
        route.set_task(start, target);
    }
    let crossings =
        CROSSINGS.iter().flat_map(|&(a, b, bicycles)| across(node(a), node(b), bicycles));
    let mut places = Vec::new();
    for (route, width) in crossings {
        places.push(Crossing { route: routes.len(), width });
        routes.push(route);
    }
    let phase = |green_from| Program { green_from, green: 14.0, yellow: 3.0, cycle: 40.0 };
    let signals = vec![phase(0.0), phase(20.0)];
    let mut town = Town { lanes: lanes(), crossings: places, routes, signals, ..Town::default() };
    conflicts::compute(&mut town);
    town
}

fn node(name: &str) -> Node {
    let digits: Vec<usize> = name.bytes().map(|digit| usize::from(digit - b'0')).collect();
    (digits[0], digits[1])
}

const fn place((column, row): Node) -> Point {
    Point::new(COLUMNS[column], ROWS[row])
}

fn is_junction((column, row): Node) -> bool {
    (1..=3).contains(&column) && (1..=3).contains(&row)
}

/// 0 for a main street, 1 for another.
fn rank(from: Node, to: Node) -> u8 {
    let line = if from.1 == to.1 { from.1 } else { from.0 };
    u8::from(line != 2)
}

/// The middle of the lane from one node to its neighbour, between the junctions' boxes.
fn leg(from: Node, to: Node) -> Vec<Point> {
    let (a, b) = (place(from), place(to));
    let whole = a.distance(b);
    let direction = Pose { at: a, cos: (b.x - a.x) / whole, sin: (b.y - a.y) / whole };
    let start = if is_junction(from) { BOX } else { 0.0 };
    let end = whole - if is_junction(to) { BOX } else { 0.0 };
    let swing = BENDS.iter().find_map(|&(p, q, swing)| {
        let (p, q) = (node(p), node(q));
        if (p, q) == (from, to) {
            Some(swing)
        } else if (q, p) == (from, to) {
            Some(-swing)
        } else {
            None
        }
    });
    let turn = core::f64::consts::TAU / (end - start);
    let pieces = (end - start).round();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a leg is some 100 m long"
    )]
    let count = pieces as u32;
    (0..=count)
        .map(|index| {
            let way = (end - start) * f64::from(index) / pieces;
            let swing = swing.unwrap_or(0.0);
            let aside = swing * (1.0 - libm::cos(turn * way)) / 2.0;
            let slope = swing * turn * libm::sin(turn * way) / 2.0;
            let lean = (1.0 + slope * slope).sqrt();
            direction.ahead(start + way + slope / lean * LANE / 2.0, aside - LANE / 2.0 / lean)
        })
        .collect()
}

/// Through a junction, between the ends of two lanes: a cubic whose ends turn less than its middle.
fn turn(from: Pose, to: Pose) -> Vec<Point> {
    let reach = from.at.distance(to.at) / core::f64::consts::SQRT_2;
    let along = from.cos * to.cos + from.sin * to.sin;
    let handle = if along > 0.5 { reach / 2.0 } else { 0.62 * reach };
    let (b, c) = (from.ahead(handle, 0.0), to.ahead(-handle, 0.0));
    (1..32)
        .map(|index| {
            let u = f64::from(index) / 32.0;
            let v = 1.0 - u;
            let weights = [v * v * v, 3.0 * v * v * u, 3.0 * v * u * u, u * u * u];
            let points = [from.at, b, c, to.at];
            let sum = |part: fn(&Point) -> f64| {
                weights.iter().zip(&points).map(|(w, p)| w * part(p)).sum()
            };
            Point::new(sum(|p| p.x), sum(|p| p.y))
        })
        .collect()
}

fn line(points: Vec<Point>) -> Path {
    Path::new(points).unwrap_or_else(|error| unreachable!("streets have a length: {error}"))
}

fn end_pose(points: &[Point], last: bool) -> Pose {
    let path = line(points.to_vec());
    path.pose_at(if last { path.length() } else { 0.0 })
}

fn route(way: &[Node]) -> Route {
    let legs: Vec<Vec<Point>> = way.windows(2).map(|pair| leg(pair[0], pair[1])).collect();
    let mut points: Vec<Point> = Vec::new();
    // Where each leg ends and the next begins, by the path's length up to there.
    let mut boxes = Vec::new();
    for (index, leg) in legs.iter().enumerate() {
        points.extend(leg);
        if let Some(next) = legs.get(index + 1) {
            let before = line(points.clone()).length();
            points.extend(turn(end_pose(leg, true), end_pose(next, false)));
            let mut with = points.clone();
            with.push(next[0]);
            boxes.push((before, line(with).length()));
        }
    }
    let path = line(points).resampled(1.0).unwrap_or_else(|error| unreachable!("{error}"));
    let name: Vec<String> = way.iter().map(|(column, row)| format!("{column}{row}")).collect();
    let mut route = Route::new(&name.join("-"), RouteKind::Road, path, LANE / 2.0, 0.0);
    for (index, &s) in route.path.arc_lengths().iter().enumerate() {
        let leg = boxes.iter().filter(|(_, end)| *end <= s).count();
        let rank = rank(way[leg], way[leg + 1]);
        (route.rank[index], route.limits[index]) = (rank, LIMITS[usize::from(rank)]);
        if let Some(&(from, to)) = boxes.get(leg)
            && from <= s
        {
            let (a, b) = (route.path.pose_at(from), route.path.pose_at(to));
            if a.cos * b.cos + a.sin * b.sin < 0.5 {
                (route.left[index], route.right[index]) = (HALF_TURN, HALF_TURN);
            }
        }
    }
    for (index, &(before, _)) in boxes.iter().enumerate() {
        if way[index + 1] == (2, 2) {
            route.signals.push(Signal { s: before, group: usize::from(way[index].0 == 2) });
        }
    }
    route.set_pace();
    route
}

/// The two routes across the middle of a leg, and the width of the strip.
fn across(from: Node, to: Node, bicycles: bool) -> Vec<(Route, f64)> {
    let (a, b) = (place(from), place(to));
    let whole = a.distance(b);
    let middle = Point::new(f64::midpoint(a.x, b.x), f64::midpoint(a.y, b.y));
    let pose = Pose { at: middle, cos: (b.x - a.x) / whole, sin: (b.y - a.y) / whole };
    let (kind, speed, width) =
        if bicycles { (RouteKind::Cycle, 4.0, 3.0) } else { (RouteKind::Foot, 1.4, 4.0) };
    let name = format!("across {}{}-{}{}", from.0, from.1, to.0, to.1);
    [1.0, -1.0]
        .into_iter()
        .map(|side| {
            // Either direction keeps to its own right.
            let points = [-9.0, 9.0].map(|left| pose.ahead(side * 0.8, side * left)).to_vec();
            let path = line(points).resampled(1.0).unwrap_or_else(|error| unreachable!("{error}"));
            (Route::new(&name, kind, path, width / 4.0, speed), width)
        })
        .collect()
}

/// All lanes: the legs both ways, and the boxes of the junctions.
fn lanes() -> Vec<Lane> {
    let mut lanes = Vec::new();
    for line_of in 1..=3 {
        for step in 0..4 {
            let pairs =
                [((step, line_of), (step + 1, line_of)), ((line_of, step), (line_of, step + 1))];
            for (from, to) in pairs {
                lanes.push(Lane { path: line(leg(from, to)), width: LANE });
                lanes.push(Lane { path: line(leg(to, from)), width: LANE });
            }
        }
    }
    for column in 1..=3 {
        for row in 1..=3 {
            let middle = place((column, row));
            let ends = [-BOX, BOX].map(|x| Point::new(middle.x + x, middle.y)).to_vec();
            lanes.push(Lane { path: line(ends), width: 2.0 * LANE });
            let ends = [-BOX, BOX].map(|y| Point::new(middle.x, middle.y + y)).to_vec();
            lanes.push(Lane { path: line(ends), width: 2.0 * LANE });
        }
    }
    lanes
}
