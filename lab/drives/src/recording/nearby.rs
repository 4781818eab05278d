//! The part of a long route that a cycle needs: with all of it each cycle takes time in proportion to the whole
//! drive.

use mufasa_model::input::cycle::{CrossSection, Route};

use crate::geometry::Point;

/// Routes with at most so many cross sections stay whole.
pub(super) const WHOLE: usize = 512;
/// How far around what a cycle is about the route is kept, m; far above every threshold of the stages.
pub(super) const MARGIN: f64 = 100.0;

/// The route from its first to its last cross section near these points (where it comes by again later, all until then),
/// and one more on either side.
pub(super) fn part_near(route: &Route, points: &[Point]) -> Route {
    let all = &route.cross_sections;
    if all.len() <= WHOLE || route.closed {
        return route.clone();
    }
    let bounds = [0, 1].map(|axis| {
        let of_axis = || points.iter().map(move |point| point[axis]);
        let least = of_axis().fold(f64::INFINITY, f64::min);
        [least - MARGIN, of_axis().fold(f64::NEG_INFINITY, f64::max) + MARGIN]
    });
    let within = |value: f64, [least, most]: [f64; 2]| least <= value && value <= most;
    let is_near = |it: &CrossSection| within(it.x, bounds[0]) && within(it.y, bounds[1]);
    let first = all.iter().position(is_near);
    let last = all.iter().rposition(is_near);
    let (Some(first), Some(last)) = (first, last) else { return route.clone() };
    let kept = &all[first.saturating_sub(1)..all.len().min(last + 2)];
    Route { closed: false, cross_sections: kept.to_vec() }
}

#[cfg(test)]
mod tests {
    use mufasa_model::cycle::check;
    use mufasa_model::input::cycle::{CrossSection, Route};
    use mufasa_model::report::{Outcome, Reading};

    use super::WHOLE;
    use crate::geometry::{Point, direction, scale};
    use crate::options::{Options, Tail};
    use crate::recording::object::State;
    use crate::recording::{Recording, drive};

    /// A place beside a road of a radius of 300 m that goes round once and a half, 5 m farther out each time.
    fn place(s: f64, left: f64) -> (Point, f64) {
        let angle = s / 300.0;
        let radius = 300.0 + 5.0 * angle / std::f64::consts::TAU - left;
        (scale(direction(angle), radius), angle + std::f64::consts::FRAC_PI_2)
    }

    fn section(s: f64) -> CrossSection {
        let [at, left, right] = [0.0, 1.75, -1.75].map(|left| place(s, left).0);
        CrossSection { x: at[0], y: at[1], left, right }
    }

    #[test]
    fn of_a_long_route_a_cycle_has_what_decides_it() {
        let route = Route {
            closed: false,
            cross_sections: (0..1571).map(|i| section(2.0 * f64::from(i))).collect(),
        };
        assert!(route.cross_sections.len() > WHOLE);
        // Away from the middle of its lane and back, at most 2.2 m.
        let state = |i: i32| {
            let s = 30.0 + 1.3 * f64::from(i);
            let (position, heading) = place(s, 2.2 * (s / 90.0).sin());
            State { step: i64::from(i), position, heading, speed: 13.0, slip: 0.0 }
        };
        let ego = (0..2300).map(state).collect();
        let [name, source] = ["long", "made up"].map(String::from);
        let (size, objects, notes) = ([4.5, 1.8], Vec::new(), Vec::new());
        let recording = Recording {
            name,
            source,
            dt_ns: 100_000_000,
            ego,
            size,
            objects,
            route: route.clone(),
            notes,
        };
        let options = Options { tail: Tail::Keep, ..Options::default() };
        let drive = drive(recording, &options, 1);
        let (mut shorter, mut failed) = (0, 0);
        for i in (0..2300).step_by(23) {
            let near = drive.cycle(i).expect("it is made").cycle;
            let mut whole = near.clone();
            whole.route = route.clone();
            let [near_report, whole_report] =
                [&near, &whole].map(|it| check(it, Reading::Exact).expect("valid"));
            assert_eq!(near_report.failed_stage, whole_report.failed_stage, "{i}");
            for (near, whole) in near_report.stages.iter().zip(&whole_report.stages) {
                let (Outcome::Failed(near), Outcome::Failed(whole)) = (near, whole) else {
                    assert_eq!(near, whole, "{i}");
                    continue;
                };
                assert_eq!((near.rule, near.point), (whole.rule, whole.point), "{i}");
                let [near, whole] = [near, whole].map(|it| it.compared.map(f64::to_bits));
                assert_eq!(near, whole, "{i}");
                failed += 1;
            }
            shorter += usize::from(near.route.cross_sections.len() < 200);
        }
        assert!(shorter > 5 && (20..80).contains(&failed), "{shorter} {failed}");
    }
}
