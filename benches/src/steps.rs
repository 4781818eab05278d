//! Inputs that are as slow as one of their size can be, for one stage each, and how many steps it may take then
//! (`spec/4-arithmetic.md#steps`).

use crate::contestant::Contestant;
use crate::worst::{
    NOW_NS, base, detection, earlier, list, point, timed, track, tracks, trajectory,
};
use mufasa::cycle::steps::{Counts, most_steps};
use mufasa::input::cycle::{CrossSection, Cycle, Detection, Ego, Grid, Track, TrackList};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::report::{Outcome, Rule, Stage};

/// Their names, and what is run: a stage, or the checks of the input.
pub const INPUTS: [(&str, Option<Stage>); 25] = [
    ("ids", None),
    ("crowd", None),
    ("assignment", Some(Stage::I)),
    ("history", Some(Stage::I)),
    ("turned", Some(Stage::I)),
    ("turned-history", Some(Stage::I)),
    ("surplus", Some(Stage::I)),
    ("one-place", Some(Stage::I)),
    ("as-far", Some(Stage::I)),
    ("off-route", Some(Stage::Ii)),
    ("on-route", Some(Stage::Ii)),
    ("along-route", Some(Stage::Ii)),
    ("on-a-line", Some(Stage::Ii)),
    ("at-rest", Some(Stage::Ii)),
    ("wide", Some(Stage::Ii)),
    ("edge", Some(Stage::Ii)),
    ("tracks", Some(Stage::Iii)),
    ("detections", Some(Stage::Iv)),
    ("moving", Some(Stage::Iv)),
    ("beside-route", Some(Stage::Iv)),
    ("far-behind", Some(Stage::Iv)),
    ("touching", Some(Stage::Iv)),
    ("coming", Some(Stage::Iv)),
    ("cells", Some(Stage::V)),
    ("dilated", Some(Stage::V)),
];

/// Of each input.
pub const SIZES: [u32; 3] = [8, 32, 128];

/// Cells of a side of the grid, side of a cell, m, and of the grid, m.
const SIDE: i64 = 128;
const CELL: f64 = 0.0625;
const ROOM: f64 = 8.0;

/// Calls `run` with the input of this name and size.
///
/// # Panics
/// Where there is no such input, or the size is below 1.
pub fn input(name: &str, size: u32, run: &mut dyn FnMut(Option<Stage>, &Cycle<'_>)) {
    let (_, stage) = INPUTS.iter().find(|it| it.0 == name).expect("an input");
    let road = road(name, size);
    let hardened = Cycle { profile: Profile::HARDENED, ..base(&road, &[0; 8]) };
    let base = Cycle { grid: None, ..hardened };
    let run = &mut |cycle: &Cycle<'_>| run(*stage, &just_enough(*stage, cycle));
    if FOUND.contains(&name) {
        return found(name, size, &base, run);
    }
    let numbered = |at: &dyn Fn(i64) -> Track| (0..i64::from(size)).map(at).collect::<Vec<_>>();
    let seen_as = |track: Track| detection(track.x, track.y);

    let along = timed(places(size, 0.5).map(|x| point(x, 0.0)).collect());
    // Beside the road, and on its last part.
    let off = timed(places(size, 0.01).map(|x| point(x, -0.3)).collect());
    let on = timed(places(size, 0.01).map(|x| point(x, 0.3)).collect());
    // From one end of a roof to the other: what is below it is in every box around it.
    let roof = |x: f64| point(x, 30.0 - (x - 30.0).abs());
    let roof = timed(places(size, 60.0 / f64::from(size - 1)).map(roof).collect());
    let below = numbered(&|id| track(id, 30.0, 5.0));
    let below_seen: Vec<_> = below.iter().copied().map(seen_as).collect();
    // Ids whose low twelve bits are equal.
    let same = numbered(&|id| track((i64::from(size) - id) << 12, 0.0, 0.0));
    let line: Vec<_> = places(2 * size, 1.0).map(|x| detection(x, 0.0)).collect();
    let crowd: Vec<_> = places(size, 1e-3).zip(0..).map(|(y, id)| track(id, -1.0, y)).collect();
    // They look like one place to every index, as there is one thing far off.
    let far = std::iter::once(detection(1e5, 1e5));
    let row: Vec<_> = places(2 * size - 1, 1e-4).map(|x| detection(x, 0.0)).chain(far).collect();
    let in_row = places(size, 1e-4).zip(0..).map(|(x, id)| track(id, x + 3e-5, 0.01));
    let in_row: Vec<_> = in_row.collect();
    let rows = [300, 500, 800].map(|ms| earlier(&row, ms));
    let [turned_crowd, turned_in_row] = [&crowd, &in_row].map(|items| turned_tracks(items));
    let [turned_line, turned_row] = [&line, &row].map(|items| turned(items));
    let turned_rows = [300, 500, 800].map(|ms| earlier(&turned_row, ms));
    // Three times as many tracks as detections, all of them seen before.
    let upright: Vec<_> = places(size, 1.0).zip(0..).map(|(y, id)| track(id, 0.0, y)).collect();
    let upright_seen: Vec<_> = upright.iter().copied().map(seen_as).collect();
    let few = places(size / 3, 1e-3).map(|y| detection(0.5, y));
    let few: Vec<_> = few.chain([detection(0.0, 2.0 * f64::from(size))]).collect();
    let all = [300, 500, 800].map(|ms| earlier(&upright_seen, ms));
    let (alike, beside_them) = at_one_place(size);
    // Beside the CAV's way, as near as plain doubles tell apart, and still or from a metre farther aside.
    let touching = 0.5 * (base.ego.width + 1.8) + 1e-3;
    let beside: Vec<_> = (0..size).map(|_| detection(9.0, touching)).collect();
    let moved: Vec<_> = beside.iter().map(|it| Detection { y: it.y + 0.5, ..*it }).collect();
    let seen = [300, 500, 800].map(|ms| earlier(&moved, ms));
    // They drift from the other lane into the CAV's way.
    let oncoming = numbered(&|id| Track { vx: -20.0, vy: -2.0, ..track(id, 60.0, 4.0) });
    // They keep beside, of a route that is looked through.
    let behind = numbered(&|id| Track { vx: 30.0, vy: -0.9, ..track(id, -100.0, 4.7) });

    let strict = Parameters { theta_tr: 0.2, ..base.parameters };
    let wide = Parameters { theta_map: 1e3, ..base.parameters };
    let plan = |points| Cycle { trajectory: Some(trajectory(points)), ..base };
    let lists = |tracked, seen| {
        let (tracks, detections) = (Some(tracks(tracked)), Some(list(seen)));
        Cycle { tracks, detections, parameters: strict, ..base }
    };
    let fail_safe = Cycle {
        parameters: Parameters::default(),
        ego: Ego { speed: 20.0, ..base.ego },
        trajectory: Some(trajectory(&along)),
        ..base
    };
    // Everything but what its disks cover is occupied, and unknown.
    let ring = around_disks(&base);
    let cells = Grid {
        occupied: &ring,
        unknown: Some(&ring),
        ..hardened.grid.map(|grid| Grid { width: SIDE, height: SIDE, ..grid }).expect("a grid")
    };
    let cells = Grid { resolution: CELL, x: -1.0 - 0.5 * ROOM, y: -0.5 * ROOM, ..cells };
    let at_rest = timed(vec![point(-1.0, 0.0); size as usize]);
    let at_rest = Cycle { ego: Ego { speed: 0.0, ..base.ego }, ..plan(&at_rest) };
    let cycle = match name {
        "ids" => Cycle { tracks: Some(tracks(&same)), ..base },
        "crowd" => Cycle { detection_history: &rows, ..lists(&crowd, &row) },
        "assignment" => lists(&crowd, &line),
        "history" => Cycle { detection_history: &rows, ..lists(&in_row, &row) },
        "turned" => lists(&turned_crowd, &turned_line),
        "turned-history" => {
            Cycle { detection_history: &turned_rows, ..lists(&turned_in_row, &turned_row) }
        }
        "one-place" => lists(&alike, &beside_them),
        "surplus" => Cycle { detection_history: &all, ..lists(&upright, &few) },
        "off-route" => Cycle { parameters: wide, ..plan(&off) },
        "on-route" => plan(&on),
        "along-route" | "on-a-line" => until_the_points_end(&plan(&along)),
        "tracks" => Cycle { tracks: Some(tracks(&below)), ..plan(&roof) },
        "detections" => {
            let detections = Some(list(&below_seen));
            Cycle { detections, profile: Profile::PAPER, ..plan(&roof) }
        }
        "moving" => {
            let detections = Some(list(&beside));
            Cycle { detections, detection_history: &seen, ..fail_safe }
        }
        "beside-route" => {
            let tracks = Some(tracks(&oncoming));
            Cycle { tracks, detections: Some(list(&[])), ..fail_safe }
        }
        "edge" => plan(&along[..1]),
        "far-behind" => Cycle {
            ego: Ego { speed: 2.0, ..base.ego },
            tracks: Some(tracks(&behind)),
            detections: Some(list(&[])),
            ..fail_safe
        },
        "cells" => Cycle { grid: Some(cells), ..at_rest },
        _ => Cycle { grid: Some(cells), profile: Profile::PAPER, ..at_rest },
    };
    run(&cycle);
}

/// Inputs like those that `slow` found, and one that the widening walks along.
const FOUND: [&str; 5] = ["as-far", "at-rest", "wide", "touching", "coming"];

fn found(name: &str, size: u32, base: &Cycle<'_>, run: &mut dyn FnMut(&Cycle<'_>)) {
    let Ego { x, y, .. } = base.ego;
    let numbered = |at: &dyn Fn(i64) -> Track| (0..i64::from(size)).map(at).collect::<Vec<_>>();
    let touching = 0.5 * (base.ego.width + 1.8);
    let base =
        &Cycle { parameters: Parameters::default(), ego: Ego { speed: 10.0, ..base.ego }, ..*base };
    match name {
        // Just as far as the farthest detection, and carried forward: compared in integers.
        "as-far" => {
            let items = numbered(&|id| track(id, x - 3.0, y - 4.0));
            let (items, seen) = (
                TrackList { stamp_ns: NOW_NS - 37_000_001, items: &items },
                [detection(x + 3.0, y + 4.0)],
            );
            run(&Cycle { tracks: Some(items), detections: Some(list(&seen)), ..*base });
        }
        // Many points for few cross sections.
        "at-rest" => {
            let points =
                timed(places(size, 1e-3).map(|along| point(x + along, y + 1e-7)).collect());
            let ego = Ego { speed: 0.0, ..base.ego };
            run(&Cycle { ego, trajectory: Some(trajectory(&points)), ..*base });
        }
        // Along what the CAV can drive, on a circle of 3 m: each place is beyond it by more than those before.
        "wide" => {
            let way = |f: f64| point(x + f, y + f * f / 6.0 + 1e-6 * f);
            let points = timed(places(size, 4.0 / f64::from(size)).map(way).collect());
            let ego = Ego { speed: 5.0, ..base.ego };
            run(&Cycle { ego, trajectory: Some(trajectory(&points)), ..*base });
        }
        // Tracks that stand 6 nm beside all places, so that each place is asked about.
        "touching" => {
            let points = timed(places(size, 0.5).map(|along| point(x + along, y)).collect());
            let standing = |id| Track { length: 100.0, ..track(id, x, y + touching + 6e-9) };
            let items = numbered(&standing);
            run(&Cycle {
                tracks: Some(tracks(&items)),
                detections: Some(list(&[])),
                trajectory: Some(trajectory(&points)),
                ..*base
            });
        }
        // Long things that come nearer beside the CAV, which stands: each from where any of them was.
        _ => {
            let points = timed(vec![point(x, y); 2]);
            let at = |ago: f64| {
                let (along, aside) = (x - 0.9 * ago, y - touching - 1.0 - 0.5 * ago);
                let item = Detection { length: 100.0, ..detection(along, aside) };
                vec![item; size as usize / 4 + 2]
            };
            let [now, before @ ..] = [0.0, 0.3, 0.5, 0.8].map(at);
            let [a, b, c] = &before;
            let seen = [earlier(a, 300), earlier(b, 500), earlier(c, 800)];
            let standing = Cycle { ego: Ego { speed: 0.0, ..base.ego }, ..*base };
            let detections = Some(list(&now));
            let trajectory = Some(trajectory(&points));
            run(&Cycle { detections, detection_history: &seen, trajectory, ..standing });
        }
    }
}

/// The cycle with as much work for H-14 as it takes, if it is for H-14.
pub fn just_enough<'a>(stage: Option<Stage>, cycle: &Cycle<'a>) -> Cycle<'a> {
    if stage != Some(Stage::Iv) || cycle.profile != Profile::HARDENED {
        return *cycle;
    }
    let with = |work_limit| {
        let parameters = Parameters { work_limit, ..cycle.parameters };
        Cycle { parameters, ..*cycle }
    };
    let is_too_little = |work_limit| {
        let outcome = Contestant::new(&with(work_limit)).outcome(Stage::Iv);
        matches!(outcome, Outcome::Failed(witness) if witness.rule == Rule::WorkLimit)
    };
    let (mut too_little, mut enough) = (-1, 1 << 40);
    while enough - too_little > 1 {
        let middle = i64::midpoint(too_little, enough);
        *if is_too_little(middle) { &mut too_little } else { &mut enough } = middle;
    }
    with(enough)
}

/// How many steps a stage may take, or the checks of the input.
pub fn allowed(stage: Option<Stage>, cycle: &Cycle<'_>) -> u64 {
    let most = most_steps(&Counts::of(cycle), &cycle.parameters);
    match stage {
        None => most.input,
        Some(Stage::Iv) if cycle.profile == Profile::HARDENED => most.stages[3] + most.fail_safe,
        // There are no detections.
        Some(Stage::V) => most.stages[4] + most.without_detections,
        Some(stage) => most.stages[stage as usize],
    }
}

/// So many multiples of a step, from 0 on.
fn places(count: u32, step: f64) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| f64::from(i) * step)
}

/// Many tracks at one place, about as near to each of a third as many detections.
fn at_one_place(size: u32) -> (Vec<Track>, Vec<Detection>) {
    let alike = (0..i64::from(size)).map(|id| track(id, 0.0, 0.0)).collect();
    let beside_them = places(size / 3, 3.6e-3).map(|y| detection(0.04, y)).collect();
    (alike, beside_them)
}

fn turned_tracks(items: &[Track]) -> Vec<Track> {
    items.iter().map(|it| Track { x: it.y, y: it.x, ..*it }).collect()
}

fn turned(items: &[Detection]) -> Vec<Detection> {
    items.iter().map(|it| Detection { x: it.y, y: it.x, ..*it }).collect()
}

/// As fast that the places end about where the points do.
fn until_the_points_end<'a>(cycle: &Cycle<'a>) -> Cycle<'a> {
    let last = cycle.trajectory.and_then(|it| it.points.last());
    let ego = Ego { speed: last.map_or(0.0, |it| (12.0 * it.x).sqrt()), ..cycle.ego };
    Cycle { ego, parameters: Parameters { v_max: 1e3, ..cycle.parameters }, ..*cycle }
}

fn road(input: &str, size: u32) -> Vec<CrossSection> {
    match input {
        "along-route" => straight(8 * size),
        "far-behind" => places(64 * size, 0.1).map(|x| upright(x - 400.0)).collect(),
        "on-a-line" => aside(8 * size),
        "edge" => slivers(8 * size),
        input => folded(if input.ends_with("route") { 8 * size } else { 4 }),
    }
}

/// A road that goes back and forth, so that every place between is near all of it; without width but for its
/// end, which goes along.
fn folded(count: u32) -> Vec<CrossSection> {
    let cross_section = |i: u32| {
        let side = if i.is_multiple_of(2) { -1.0 } else { 1.0 };
        let (x, y) = (500.0 * side, 5.0 * side + 1e-4 * f64::from(i));
        let half: f64 = if i + 2 < count { 0.0 } else { 0.5 };
        CrossSection { x, y, left: [x, y + half.copysign(x)], right: [x, y - half.copysign(x)] }
    };
    (0..count).map(cross_section).collect()
}

/// Along the way, with more cross sections than places.
fn straight(count: u32) -> Vec<CrossSection> {
    places(count, 0.0625 * 1.25).map(|x| upright(x - 2.5)).collect()
}

fn upright(x: f64) -> CrossSection {
    CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] }
}

/// Nearly across the way, which is on the line through the boundaries of its middle, nearer than places are told apart in
/// plain doubles.
fn aside(count: u32) -> Vec<CrossSection> {
    let middle = 0.5 * f64::from(count);
    let cross_section = |i: f64| {
        let y = 0.1 * (i - middle) + 1e-9;
        CrossSection { x: 40.0 + 1e-3 * i, y: y + 0.05, left: [-5.0, y], right: [90.0, y] }
    };
    places(count, 1.0).map(cross_section).collect()
}

/// Parts thinner than plain doubles tell, all along the way, which is a nanometre inside the edge of the last one.
fn slivers(count: u32) -> Vec<CrossSection> {
    let sliver =
        |y: f64| CrossSection { x: y * 1e9, y: 0.0, left: [-5.0, y], right: [90.0, y - 3e-9] };
    let last = |x: f64| CrossSection { x, y: 0.0, left: [x, 3.0], right: [x, -1e-9] };
    let ends = [CrossSection { x: -100.0, ..last(-10.0) }, last(300.0)];
    places(count, 2e-12).map(|y| sliver(y - 3e-7)).chain(ends).collect()
}

/// A bit for each cell of the grid that no disk of the standing CAV touches.
fn around_disks(cycle: &Cycle<'_>) -> Vec<u8> {
    let Ego { length, width, .. } = cycle.ego;
    let (part, disks) = (length / 4.0, [-1.5, -0.5, 0.5, 1.5]);
    let radius = 0.5 * part.hypot(width) + 1e-6;
    let nearest = |cell: i64, centre: f64| {
        let from = CELL * f64::from(i32::try_from(cell).unwrap_or(0)) - 0.5 * ROOM;
        (from - centre).max(centre - from - CELL).max(0.0)
    };
    let is_touched = |at: i64| {
        let (i, k) = (at % SIDE, at / SIDE);
        disks.iter().any(|disk| nearest(i, disk * part).hypot(nearest(k, 0.0)) <= radius)
    };
    let byte =
        |at: i64| (0..8).filter(|bit| !is_touched(8 * at + bit)).fold(0, |sum, bit| sum | 1 << bit);
    (0..SIDE * SIDE / 8).map(byte).collect()
}
