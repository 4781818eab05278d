//! Stage v: dilation by `imageproc` of the region around the disks, by the squared distance transform (which is
//! exact for every radius); and, without any library, a loop over the cells around each disk centre. Grids that are
//! not turned.

use image::{GrayImage, Luma};
use imageproc::distance_transform::euclidean_squared_distance_transform;
use mufasa::input::cycle::Cycle;
use mufasa::report::Stage;

use super::{Peer, braking, within};

/// What is prepared outside the measured time.
pub struct Prepared {
    image: GrayImage,
    /// Squared radius in cells.
    radius_squared: f64,
    reach: u32,
    offsets: Vec<(i64, i64)>,
}

/// Both ways.
pub fn peers<'a>(cycle: &'a Cycle<'a>) -> Vec<Peer<'a>> {
    let peer = |name, decide: fn(&Cycle<'_>, &Prepared) -> bool| {
        let prepared = Prepared::new(cycle);
        let decide = move || decide(std::hint::black_box(cycle), &prepared);
        Peer { name, stage: Stage::V, decide: Box::new(decide) }
    };
    vec![
        peer("imageproc, region, distances", |cycle, it| {
            let (corner, region) = it.region(cycle);
            let distances = euclidean_squared_distance_transform(&region);
            free(cycle, corner, |x, y| distances.get_pixel(x, y)[0] > it.radius_squared)
        }),
        peer("loop around the disk centres", |cycle, it| {
            let samples = it.image.as_raw();
            let (width, height) = (i64::from(it.image.width()), i64::from(it.image.height()));
            free(cycle, (0, 0), |x, y| {
                it.offsets.iter().all(|&(dx, dy)| {
                    let (x, y) = (i64::from(x) + dx, i64::from(y) + dy);
                    let inside = (0..width).contains(&x) && (0..height).contains(&y);
                    let at = usize::try_from(y * width + x).unwrap_or(0);
                    !inside || samples[at] == 0
                })
            })
        }),
    ]
}

impl Prepared {
    /// # Panics
    /// When the cycle has no grid.
    pub fn new(cycle: &Cycle<'_>) -> Self {
        let grid = cycle.grid.expect("a cycle with a grid");
        let (width, height) = (pixels(grid.width), pixels(grid.height));
        let image = GrayImage::from_fn(width, height, |x, y| {
            let bit = y as usize * width as usize + x as usize;
            Luma([255 * (grid.occupied[bit / 8] >> (bit % 8) & 1)])
        });
        let share = cycle.ego.length / small(cycle.parameters.n);
        let radius = 0.5 * share.hypot(cycle.ego.width) / grid.resolution;
        let whole = cell(radius);
        let near = |&(dx, dy): &(i64, i64)| small(dx * dx + dy * dy) <= radius * radius;
        let square = (-whole..=whole).flat_map(|dy| (-whole..=whole).map(move |dx| (dx, dy)));
        let offsets: Vec<_> = square.filter(near).collect();
        Self { image, radius_squared: radius * radius, reach: pixels(whole) + 1, offsets }
    }

    /// The part of the image within reach of some disk centre, and its corner.
    fn region(&self, cycle: &Cycle<'_>) -> ((u32, u32), GrayImage) {
        let (mut least, mut most) = ((u32::MAX, u32::MAX), (0, 0));
        free(cycle, (0, 0), |x, y| {
            least = (least.0.min(x), least.1.min(y));
            most = (most.0.max(x), most.1.max(y));
            true
        });
        let corner = (least.0.saturating_sub(self.reach), least.1.saturating_sub(self.reach));
        let end = (
            (most.0 + self.reach + 1).min(self.image.width()),
            (most.1 + self.reach + 1).min(self.image.height()),
        );
        let (width, height) = (end.0.saturating_sub(corner.0), end.1.saturating_sub(corner.1));
        let view = image::imageops::crop_imm(&self.image, corner.0, corner.1, width, height);
        (corner, view.to_image())
    }
}

/// Whether `is_free` holds for the cell of every disk centre, relative to a corner; outside
/// the grid nothing is occupied.
fn free(
    cycle: &Cycle<'_>,
    (left, top): (u32, u32),
    mut is_free: impl FnMut(u32, u32) -> bool,
) -> bool {
    let (Some(trajectory), Some(grid)) = (cycle.trajectory, cycle.grid) else { return true };
    let n = cycle.parameters.n;
    let share = cycle.ego.length / small(n);
    within(trajectory.points, braking(cycle)).iter().all(|point| {
        (0..n).all(|i| {
            let along = cycle.ego.center_offset + share * (small(i) + 0.5) - 0.5 * cycle.ego.length;
            let x = cell((point.x + along * point.cos - grid.x) / grid.resolution);
            let y = cell((point.y + along * point.sin - grid.y) / grid.resolution);
            let inside = (0..grid.width).contains(&x) && (0..grid.height).contains(&y);
            !inside || is_free(pixels(x) - left, pixels(y) - top)
        })
    })
}

fn pixels(count: i64) -> u32 {
    u32::try_from(count).unwrap_or(0)
}

#[expect(clippy::cast_precision_loss, reason = "counts of cells and disks are small")]
fn small(count: i64) -> f64 {
    count as f64
}

#[expect(clippy::cast_possible_truncation, reason = "cells of a grid")]
fn cell(value: f64) -> i64 {
    value.floor() as i64
}
