//! One assumption that does not hold, by a size (`docs/safety-manual.md#measured-margins`).

use std::error::Error;

use mufasa::input::cycle::{Cycle, Detection, DetectionList, Ego, TrackList};
use plotters::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::named::named;

named! {
    /// What is wrong. Each goes the way that hides a collision.
    Axis {
        /// The CAV is ahead of where it is measured, with all that it detects, m.
        Pose = "pose",
        /// The CAV is faster than measured, m/s.
        Speed = "speed",
        /// The tracks are older than they are stamped, s.
        Clock = "clock",
        /// The CAV brakes later than `tau` says, s.
        Latency = "latency",
        /// Others are nearer than all say, and than the gap, m.
        Detection = "detection",
        /// The part of `a_b` that the road does not bear.
        Friction = "friction",
    }
}

/// An axis, and how wrong it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Wrong {
    /// What.
    pub axis: Axis,
    /// By how much, in the unit of the axis.
    pub size: f64,
}

impl Axis {
    /// The unit of its sizes.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Pose | Self::Detection => "m",
            Self::Speed => "m/s",
            Self::Clock | Self::Latency => "s",
            Self::Friction => "of a_b",
        }
    }

    /// Sizes of the study, the first of them none.
    pub const fn sizes(self) -> [f64; 6] {
        match self {
            Self::Pose | Self::Detection => [0.0, 0.1, 0.2, 0.5, 1.0, 2.0],
            Self::Speed => [0.0, 0.2, 0.5, 1.0, 2.0, 4.0],
            Self::Clock | Self::Latency => [0.0, 0.02, 0.05, 0.1, 0.2, 0.4],
            Self::Friction => [0.0, 0.05, 0.1, 0.2, 0.4, 0.6],
        }
    }
}

impl Wrong {
    /// The size, where it is of this axis; 0 elsewhere.
    pub(super) fn of(wrong: Option<Self>, axis: Axis) -> f64 {
        wrong.filter(|it| it.axis == axis).map_or(0.0, |it| it.size)
    }

    /// What the job makes of the cycle as it is measured.
    pub(super) fn measured<T>(self, cycle: &Cycle<'_>, job: impl FnOnce(&Cycle<'_>) -> T) -> T {
        let Self { axis, size } = self;
        let Ego { x, y, cos, sin, .. } = cycle.ego;
        let back = [-size * cos, -size * sin];
        // Away from the CAV.
        let away = |at: [f64; 2]| {
            let [dx, dy] = [at[0] - x, at[1] - y];
            let far = libm::hypot(dx, dy).max(1e-9);
            [size * dx / far, size * dy / far]
        };
        let by = |at: [f64; 2]| match axis {
            Axis::Pose => back,
            Axis::Detection => away(at),
            Axis::Speed | Axis::Clock | Axis::Latency | Axis::Friction => [0.0; 2],
        };
        let moved = |list: &DetectionList<'_>| -> Vec<Detection> {
            let moved = |it: &Detection| {
                let [dx, dy] = by([it.x, it.y]);
                Detection { x: it.x + dx, y: it.y + dy, ..*it }
            };
            list.items.iter().map(moved).collect()
        };
        let now = cycle.detections.as_ref().map(moved).unwrap_or_default();
        let before: Vec<_> = cycle.detection_history.iter().map(moved).collect();
        let history: Vec<_> = (cycle.detection_history.iter().zip(&before))
            .map(|(list, items)| DetectionList { items, ..*list })
            .collect();
        let mut tracks = cycle.tracks.map_or_else(Vec::new, |it| it.items.to_vec());
        for it in &mut tracks {
            let [dx, dy] = match axis {
                Axis::Clock => [-it.vx * size, -it.vy * size],
                Axis::Detection => away([it.x, it.y]),
                Axis::Pose | Axis::Speed | Axis::Latency | Axis::Friction => [0.0; 2],
            };
            (it.x, it.y) = (it.x + dx, it.y + dy);
        }
        let mut cycle = Cycle {
            detections: cycle.detections.map(|it| DetectionList { items: &now, ..it }),
            detection_history: &history,
            tracks: cycle.tracks.map(|it| TrackList { items: &tracks, ..it }),
            ..*cycle
        };
        match axis {
            Axis::Pose => (cycle.ego.x, cycle.ego.y) = (x + back[0], y + back[1]),
            Axis::Speed => cycle.ego.speed = (cycle.ego.speed - size).max(0.0),
            Axis::Detection => {
                if let Some(lead) = &mut cycle.lead {
                    lead.gap += size;
                }
            }
            Axis::Clock | Axis::Latency | Axis::Friction => {}
        }
        job(&cycle)
    }
}

/// A picture of each axis: the size, and how many scenes collide because of the error.
pub fn picture(curves: &[(Axis, Vec<(f64, u64)>)]) -> String {
    let mut text = String::new();
    let drawn = draw(&mut text, curves);
    drawn.unwrap_or_else(|error| unreachable!("a string takes everything: {error}"));
    text
}

fn draw(text: &mut String, curves: &[(Axis, Vec<(f64, u64)>)]) -> Result<(), Box<dyn Error>> {
    let page = SVGBackend::with_string(text, (900, 440)).into_drawing_area();
    page.fill(&WHITE)?;
    for (area, (axis, values)) in page.split_evenly((2, 3)).iter().zip(curves) {
        let farthest = values.last().map_or(1.0, |it| it.0);
        let most = values.iter().map(|it| it.1).max().unwrap_or(0).max(10);
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .caption(format!("{}, {}", axis.name(), axis.unit()), ("sans-serif", 16))
            .set_label_area_size(LabelAreaPosition::Left, 44)
            .set_label_area_size(LabelAreaPosition::Bottom, 22)
            .build_cartesian_2d(0.0..farthest, 0..most)?;
        chart.configure_mesh().x_labels(5).y_labels(5).light_line_style(TRANSPARENT).draw()?;
        let line = RGBColor(0xd6, 0x28, 0x28);
        chart.draw_series([PathElement::new(values.clone(), line.stroke_width(2))])?;
        chart.draw_series(values.iter().map(|at| Circle::new(*at, 3, line.filled())))?;
    }
    page.present()?;
    Ok(())
}
