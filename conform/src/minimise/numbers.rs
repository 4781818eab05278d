//! The numbers of a cycle, to be changed in place.

use mufasa_model::input::cycle::Cycle;

/// Every place, m.
pub fn places(cycle: &mut Cycle) -> Vec<(&mut f64, &mut f64)> {
    let mut all = vec![(&mut cycle.ego.x, &mut cycle.ego.y)];
    let points = cycle.trajectory.iter_mut().flat_map(|list| &mut list.points);
    all.extend(points.map(|point| (&mut point.x, &mut point.y)));
    let lists = [&mut cycle.tracks, &mut cycle.previous_tracks];
    let tracks = lists.into_iter().flatten().flat_map(|list| &mut list.items);
    all.extend(tracks.map(|track| (&mut track.x, &mut track.y)));
    let detections = cycle.detections.iter_mut().flat_map(|list| &mut list.items);
    all.extend(detections.map(|it| (&mut it.x, &mut it.y)));
    for station in &mut cycle.route.cross_sections {
        all.push((&mut station.x, &mut station.y));
        for [x, y] in [&mut station.left, &mut station.right] {
            all.push((x, y));
        }
    }
    all.extend(cycle.grid.iter_mut().map(|grid| (&mut grid.x, &mut grid.y)));
    all
}

/// Every direction but the CAV's.
pub fn directions(cycle: &mut Cycle) -> Vec<(&mut f64, &mut f64)> {
    let mut all = Vec::new();
    let points = cycle.trajectory.iter_mut().flat_map(|list| &mut list.points);
    all.extend(points.map(|point| (&mut point.cos, &mut point.sin)));
    let lists = [&mut cycle.tracks, &mut cycle.previous_tracks];
    let tracks = lists.into_iter().flatten().flat_map(|list| &mut list.items);
    all.extend(tracks.map(|track| (&mut track.cos, &mut track.sin)));
    let detections = cycle.detections.iter_mut().flat_map(|list| &mut list.items);
    all.extend(detections.map(|it| (&mut it.cos, &mut it.sin)));
    all.extend(cycle.grid.iter_mut().map(|grid| (&mut grid.cos, &mut grid.sin)));
    all
}

/// Every direction but the CAV's, and every velocity: what turns with the frame.
pub fn vectors(cycle: &mut Cycle) -> Vec<(&mut f64, &mut f64)> {
    let mut all = Vec::new();
    let points = cycle.trajectory.iter_mut().flat_map(|list| &mut list.points);
    all.extend(points.map(|point| (&mut point.cos, &mut point.sin)));
    let lists = [&mut cycle.tracks, &mut cycle.previous_tracks];
    for track in lists.into_iter().flatten().flat_map(|list| &mut list.items) {
        all.push((&mut track.cos, &mut track.sin));
        all.push((&mut track.vx, &mut track.vy));
    }
    let detections = cycle.detections.iter_mut().flat_map(|list| &mut list.items);
    all.extend(detections.map(|it| (&mut it.cos, &mut it.sin)));
    all.extend(cycle.grid.iter_mut().map(|grid| (&mut grid.cos, &mut grid.sin)));
    all
}

/// Every number of the inputs; parameters are not among them.
pub fn numbers(cycle: &mut Cycle) -> Vec<&mut f64> {
    let ego = &mut cycle.ego;
    let mut all = vec![&mut ego.x, &mut ego.y, &mut ego.cos, &mut ego.sin, &mut ego.speed];
    all.extend([&mut ego.length, &mut ego.width, &mut ego.center_offset]);
    for point in cycle.trajectory.iter_mut().flat_map(|list| &mut list.points) {
        all.extend([&mut point.x, &mut point.y, &mut point.cos, &mut point.sin]);
    }
    let lists = [&mut cycle.tracks, &mut cycle.previous_tracks];
    for track in lists.into_iter().flatten().flat_map(|list| &mut list.items) {
        all.extend([&mut track.x, &mut track.y, &mut track.cos, &mut track.sin]);
        all.extend([&mut track.vx, &mut track.vy, &mut track.length, &mut track.width]);
    }
    for it in cycle.detections.iter_mut().flat_map(|list| &mut list.items) {
        all.extend([&mut it.x, &mut it.y, &mut it.cos, &mut it.sin]);
        all.extend([&mut it.length, &mut it.width]);
    }
    all.extend(cycle.lead.iter_mut().flat_map(|lead| [&mut lead.gap, &mut lead.speed]));
    for station in &mut cycle.route.cross_sections {
        all.extend([&mut station.x, &mut station.y]);
        all.extend(station.left.iter_mut().chain(&mut station.right));
    }
    if let Some(grid) = &mut cycle.grid {
        all.extend([&mut grid.x, &mut grid.y, &mut grid.cos, &mut grid.sin]);
        all.push(&mut grid.resolution);
    }
    all
}

/// The times at which the inputs were made, ns.
pub fn stamps(cycle: &mut Cycle) -> Vec<&mut i64> {
    let mut all = Vec::new();
    all.extend(cycle.trajectory.iter_mut().map(|list| &mut list.stamp_ns));
    let lists = [&mut cycle.tracks, &mut cycle.previous_tracks];
    all.extend(lists.into_iter().flatten().map(|list| &mut list.stamp_ns));
    all.extend(cycle.detections.iter_mut().map(|list| &mut list.stamp_ns));
    all.extend(cycle.lead.iter_mut().map(|lead| &mut lead.stamp_ns));
    all.extend(cycle.grid.iter_mut().map(|grid| &mut grid.stamp_ns));
    all
}
