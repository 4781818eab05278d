//! The leading vehicle, as a front radar measures it.

use crate::path::Path;
use crate::pose::Point;
use crate::services::detectors::random::Draws;
use crate::services::detectors::scan::Scan;
use crate::services::detectors::seen::Seen;

/// Whose front radar it is.
#[derive(Clone, Copy, Debug)]
pub struct Front {
    /// Arc length of the CAV's reference point on its path, m.
    pub s: f64,
    /// From the reference point to the front edge of the rectangle, m.
    pub ahead: f64,
    /// Half of the width of the strip along the path in which vehicles are leading ones, m.
    pub half_width: f64,
}

/// A measured leading vehicle, but for the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredLead {
    /// Free distance along the path from the front edge to the nearest point of the vehicle, m.
    pub gap: f64,
    /// Speed along the path, m/s, at least 0.
    pub speed: f64,
}

/// The nearest object of a scan that is in the strip along the path and does not cross it: an object that
/// is faster across than along (and than 1 m/s) leads nobody. `error`: standard deviation of gap, m, and
/// speed, m/s.
///
/// Gap as in `spec/5-interfaces.md#cycle` (`lead.gap`).
pub fn measured_lead(
    objects: &[Seen],
    scan: &Scan,
    path: &Path,
    front: Front,
    error: f64,
    draws: &mut Draws,
) -> Option<MeasuredLead> {
    let leads = scan.visible(objects).filter_map(|it| lead(it, path, front, scan.range));
    let nearest = leads.min_by(|a, b| a.gap.total_cmp(&b.gap))?;
    let [gap, speed] = draws.normal_pair();
    Some(MeasuredLead {
        gap: (nearest.gap + error * gap).max(0.0),
        speed: (nearest.speed + error * speed).max(0.0),
    })
}

/// An object as a leading vehicle, if it is one.
fn lead(object: &Seen, path: &Path, front: Front, range: f64) -> Option<MeasuredLead> {
    let rectangle = object.rectangle;
    let middle = path.project_within(rectangle.pose.at, front.s - range, front.s + range);
    let reach = Point::default().distance(Point::new(rectangle.length, rectangle.width)) / 2.0;
    if middle.left.abs() > reach + front.half_width {
        return None;
    }
    let along = path.pose_at(middle.s);
    let velocity = object.velocity;
    let speed = velocity.x * along.cos + velocity.y * along.sin;
    let across = velocity.y * along.cos - velocity.x * along.sin;
    if across.abs() > speed.abs().max(1.0) {
        return None;
    }
    let (mut gap, mut least, mut most) = (f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY);
    for (ahead, left) in [(0.5, 0.5), (0.5, -0.5), (-0.5, 0.5), (-0.5, -0.5)] {
        let corner = rectangle.pose.ahead(ahead * rectangle.length, left * rectangle.width);
        let corner = path.project_within(corner, middle.s - reach - 5.0, middle.s + reach + 5.0);
        gap = gap.min(corner.s - front.s);
        (least, most) = (least.min(corner.left), most.max(corner.left));
    }
    let inside = least <= front.half_width && most >= -front.half_width;
    let is_ahead = middle.s - front.s > front.ahead;
    let gap = (gap - front.ahead).max(0.0);
    (inside && is_ahead).then(|| MeasuredLead { gap, speed: speed.max(0.0) })
}
