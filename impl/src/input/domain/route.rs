//! The rules for a route (`spec/4-arithmetic.md#domain`).

use crate::input::cycle::Route;
use crate::input::domain::lists::cross_sections_are_fine;
use crate::input::domain::place::{Check, POSITION, Place};
use crate::numbers::plane::same_point;
use crate::report::Problem;

/// Checks a route; the last and the first cross section of a closed one may be the same.
pub(crate) fn check_route(route: &Route<'_>) -> Check {
    Place { index: None }.size("route.stations", route.cross_sections.len(), [2, 8192])?;
    if cross_sections_are_fine(route.cross_sections) {
        return Ok(());
    }
    let mut before: Option<[f64; 2]> = None;
    for (index, cross_section) in route.cross_sections.iter().enumerate() {
        let at = Place { index: Some(index) };
        at.f64("route.stations.x", cross_section.x, POSITION)?;
        at.f64("route.stations.y", cross_section.y, POSITION)?;
        for value in cross_section.left {
            at.f64("route.stations.left", value, POSITION)?;
        }
        for value in cross_section.right {
            at.f64("route.stations.right", value, POSITION)?;
        }
        // INPUT-04
        if before.is_some_and(|before| same_point(before, [cross_section.x, cross_section.y])) {
            return at.problem("route.stations.x", Problem::EqualPoints);
        }
        before = Some([cross_section.x, cross_section.y]);
    }
    Ok(())
}
