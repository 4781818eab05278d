//! The town: what it holds, its corridors as cross sections, right of way, signals, pictures.
#![allow(clippy::float_cmp, reason = "the same number on two ways, or copied")]

use mufasa_sim::collision::distance;
use mufasa_sim::map::route::RouteKind;
use mufasa_sim::map::streets;
use mufasa_sim::pictures::{Overlay, View, sheet};
use mufasa_sim::pose::Point;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::snapshot::Reason;
use mufasa_sim::vehicle::Command;
use mufasa_sim::world::World;

#[test]
fn the_town_holds_what_the_experiments_need() {
    let town = streets::town();
    assert_eq!(town.ego_routes().count(), 2);
    for index in town.ego_routes() {
        let route = &town.routes[index];
        let task = route.task.unwrap();
        let way = route.path.project(task.target.pose.at).s - task.start;
        assert!((250.0..400.0).contains(&way), "{way}");
        assert!(!route.signals.is_empty());
    }
    assert!(town.roads().count() >= 20);
    assert_eq!(town.crossings.len(), 12);
    for route in &town.routes {
        assert!(
            route.path.arc_lengths().iter().all(|&s| route.path.curvature_at(s).abs() < 1.0 / 6.0)
        );
        assert!(route.passages.windows(2).all(|pair| pair[0].to < pair[1].from), "{}", route.name);
        let sees = |c: &&mufasa_sim::map::route::Conflict| {
            let back = &town.routes[c.with].conflicts;
            back.iter()
                .any(|d| d.there == c.here && d.here == c.there && d.gives_way != c.gives_way)
        };
        assert!(route.conflicts.iter().all(|c| sees(&c)), "each conflict has one who goes first");
    }
}

#[test]
fn cross_sections_are_in_order_and_left_is_left() {
    let town = streets::town();
    let route = &town.routes[1];
    let sections = route.cross_sections(20.0, 420.0);
    assert_eq!(sections.len(), 201);
    for (index, section) in sections.iter().enumerate() {
        let s = 20.0 + 2.0 * f64::from(u32::try_from(index).unwrap());
        let pose = route.path.pose_at(s);
        let (left, right) = route.half_widths_at(s);
        let (ahead, aside) = pose.local(Point::new(section.left[0], section.left[1]));
        assert!(ahead.abs() < 1e-9 && (aside - left).abs() < 1e-9);
        let (ahead, aside) = pose.local(Point::new(section.right[0], section.right[1]));
        assert!(ahead.abs() < 1e-9 && (aside + right).abs() < 1e-9);
    }
    let way = |i: usize| {
        libm::hypot(sections[i + 1].x - sections[i].x, sections[i + 1].y - sections[i].y)
    };
    assert!((0..200).all(|i| (1.5..2.1).contains(&way(i))));
    // Cut at the ends, and never fewer than two.
    assert!(route.cross_sections(-50.0, 1e4).len() > 200);
    assert_eq!(route.cross_sections(30.0, 30.5).len(), 2);
}

#[test]
fn the_ego_is_told_of_a_red_signal_until_it_turns_green() {
    let town = streets::town();
    let mut scenario = Scenario::draw(&town, 0, 0, 0);
    (scenario.ego_s, scenario.ego_speed, scenario.signal_offset) = (184.0, 0.0, 20.0);
    scenario.walkers.clear();
    let mut world = World::new(&town, &scenario, 0);
    let line = world.snapshot().stops[0];
    assert_eq!(line.reason, Reason::Signal);
    assert_eq!(line.s, town.routes[0].signals[0].s, "the stop line is under the signal");
    for _ in 0..1990 {
        world.step(Command::default());
        assert_eq!(world.snapshot().stops[0], line);
    }
    for _ in 0..20 {
        world.step(Command::default());
    }
    assert!(world.snapshot().stops.first().is_none_or(|stop| stop.s > line.s));
}

#[test]
fn rank_comes_before_turns_and_turns_before_the_right() {
    let town = streets::town();
    let named = |name: &str| town.routes.iter().position(|route| route.name == name).unwrap();
    // (who, whom it meets, whether it gives way).
    let cases = [
        // Left turn at 22 against those straight ahead and those who turn right.
        ("02-12-22-23-24", "42-32-22-12-02", true),
        ("02-12-22-23-24", "42-32-22-23-24", true),
        // Side street onto the main street.
        ("03-13-23-33-43", "20-21-22-23-24", true),
        // Of two side streets the one from the right: at 11 from the west and from the south.
        ("01-11-21-31-41", "10-11-12-13-14", true),
        ("01-11-21-31-41", "14-13-12-11-10", false),
    ];
    for (who, whom, gives_way) in cases {
        let (a, b) = (named(who), named(whom));
        let met = town.routes[a].conflicts.iter().find(|c| c.with == b).unwrap();
        assert_eq!(met.gives_way, gives_way, "{who} {whom}");
    }
    for crossing in &town.crossings {
        assert!(
            town.routes[crossing.route].conflicts.iter().all(|c| !c.gives_way),
            "people go first"
        );
    }
}

#[test]
fn leaving_the_road_and_coming_near_is_seen() {
    let town = streets::town();
    let mut world = World::new(&town, &Scenario::draw(&town, 0, 30, 2), 2);
    assert!(!world.is_off_road() && !world.has_arrived() && world.collision().is_none());
    let mut met = 0;
    for _ in 0..1500 {
        world.step(Command { acceleration: 1.0, steering: 0.05 });
        // The nearest of all, with none left out.
        let (ego, others) = world.agents().split_first().unwrap();
        let all = others.iter().map(|a| distance(&ego.rectangle, &a.rectangle));
        let least = all.fold(f64::INFINITY, f64::min);
        assert_eq!(world.nearest().unwrap().0, least);
        assert_eq!(world.collision().is_some(), least <= 0.0);
        met += i32::from(least < 3.0);
    }
    assert!(world.is_off_road() && met > 0);
    let arrived = Scenario { ego_s: 360.0, ..Scenario::draw(&town, 0, 0, 2) };
    assert!(World::new(&town, &arrived, 2).has_arrived());
    let short = Scenario { ego_s: 350.0, ..arrived };
    assert!(!World::new(&town, &short, 2).has_arrived());
}

#[test]
fn people_cross_and_pictures_show_them() {
    let town = streets::town();
    let scenario = Scenario::draw(&town, 0, 0, 5);
    let mut world = World::new(&town, &scenario, 5);
    let mut crossed = 0;
    for _ in 0..6000 {
        world.step(Command { acceleration: -8.0, steering: 0.0 });
        crossed = crossed.max(world.agents().len() - 1);
    }
    assert!(crossed >= 3);
    let mut snapshot = world.snapshot();
    snapshot.ego.rectangle.pose.at = snapshot.objects[0].rectangle.pose.at;
    let text = sheet(&town, 0, &[&[(&snapshot, &Overlay::default(), View::of_ego(&snapshot))]]);
    assert!(town.routes.iter().any(|route| route.kind == RouteKind::Foot));
    assert!(
        text.starts_with("<svg")
            && text.trim_end().ends_with("</svg>")
            && text.contains("class=\"person\"")
    );
}
